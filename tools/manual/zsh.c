/* Completion for zsh, a function for a folder of its fpath. */
#include <string.h>

#include "manual/help_text.h"
#include "manual/manual.h"
#include "manual/values.h"

/* Inside single quotes; letters that _arguments reads are escaped. */
static void put_quoted(FILE *to, const char *text)
{
    for (; *text; text++)
        if (*text == '\'')
            fputs("'\\''", to);
        else
            fprintf(to, strchr(":[]\\", *text) ? "\\%c" : "%c", *text);
}

static void put_value(FILE *to, const char *label, const values *may)
{
    putc(':', to);
    put_quoted(to, label[0] ? label : "value");
    if (may->words[0] && may->files)
        fprintf(to, ":{compadd -- %s; _files}", may->words);
    else if (may->words[0])
        fprintf(to, ":(%s)", may->words);
    else
        fputs(may->files ? ":_files" : ": ", to);
}

static void put_option(FILE *to, const manual_command *command, const manual_option *option)
{
    help_option said;
    help_option_find(command->help, option->name, &said);
    values may = values_of(said.value);
    fprintf(to, " \\\n            '%s%s[", option->repeats ? "*" : "", option->name);
    put_quoted(to, said.about);
    putc(']', to);
    if (option->takes_value)
        put_value(to, said.value, &may);
    putc('\'', to);
}

static void put_arguments(FILE *to, const manual *from, const manual_command *command)
{
    values may = manual_positional(from, command);
    fputs("_arguments", to);
    for (size_t i = 0; i < command->option_count; i++)
        put_option(to, command, &command->option[i]);
    fputs(" \\\n            '--help[says what it does]'", to);
    if (may.words[0] || may.files) {
        fputs(" \\\n            '*", to);
        put_value(to, command->positional, &may);
        putc('\'', to);
    }
    putc('\n', to);
}

void manual_write_zsh(const manual *from, FILE *to)
{
    fputs("#compdef vndf\n# Made by `vndf help --completion zsh`.\n"
          "_vndf() {\n    local -a commands\n    local command=$words[2]\n"
          "    if (( CURRENT == 2 )); then\n        commands=(\n",
          to);
    for (size_t i = 0; i < from->count; i++)
        if (!strchr(from->command[i].name, ' ')) {
            fprintf(to, "            '%s:", from->command[i].name);
            put_quoted(to, from->command[i].purpose);
            fputs("'\n", to);
        }
    fputs("        )\n        _describe command commands\n        return\n    fi\n"
          "    if (( CURRENT > 3 )) && [[ $command == bench && $words[3] == effects ]]; then\n"
          "        command='bench effects'\n        shift words\n        (( CURRENT-- ))\n    fi\n"
          "    shift words\n    (( CURRENT-- ))\n    case $command in\n",
          to);
    for (size_t i = 0; i < from->count; i++) {
        fprintf(to, "    '%s')\n        ", from->command[i].name);
        put_arguments(to, from, &from->command[i]);
        fputs("        ;;\n", to);
    }
    fputs("    esac\n}\n_vndf \"$@\"\n", to);
}
