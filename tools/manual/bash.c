/* Completion for bash 4 and later. */
#include <string.h>

#include "manual/help_text.h"
#include "manual/manual.h"
#include "manual/values.h"

static void put_compgen(FILE *to, const values *may)
{
    fputs("mapfile -t COMPREPLY < <(compgen", to);
    if (may->words[0])
        fprintf(to, " -W '%s'", may->words);
    fprintf(to, "%s -- \"$current\")", may->files ? " -f" : "");
}

/* After an option that takes a value, only its values; nothing where none is known. */
static void put_values(FILE *to, const manual_command *command)
{
    for (size_t i = 0; i < command->option_count; i++) {
        const manual_option *option = &command->option[i];
        char said[HELP_VALUE_SIZE];
        if (!option->takes_value)
            continue;
        help_option_find(command->help, option->name, said);
        values may = values_of(said);
        fprintf(to, "    '%s %s') ", command->name, option->name);
        if (may.files || may.words[0]) {
            put_compgen(to, &may);
            fputs("; return ;;\n", to);
        } else
            fputs("return ;;\n", to);
    }
}

static void put_options(FILE *to, const manual *from, const manual_command *command)
{
    values may = manual_positional(from, command);
    fprintf(to, "    '%s') options='", command->name);
    for (size_t i = 0; i < command->option_count; i++)
        fprintf(to, "%s ", command->option[i].name);
    fprintf(to, "--help' words='%s' files=%d ;;\n", may.words, may.files);
}

void manual_write_bash(const manual *from, FILE *to)
{
    fputs("# bash completion for vndf; made by `vndf help --completion bash`.\n"
          "_vndf()\n{\n"
          "    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
          "    local command=${COMP_WORDS[1]} options='' words='' files=0\n"
          "    COMPREPLY=()\n"
          "    if ((COMP_CWORD == 1)); then\n"
          "        mapfile -t COMPREPLY < <(compgen -W '",
          to);
    for (size_t i = 0; i < from->count; i++)
        if (!strchr(from->command[i].name, ' '))
            fprintf(to, "%s ", from->command[i].name);
    fputs("--help --version' -- \"$current\")\n        return\n    fi\n", to);
    fputs("    if ((COMP_CWORD > 2)) && [[ $command == bench && ${COMP_WORDS[2]} == effects ]]; then\n"
          "        command='bench effects'\n    fi\n"
          "    case \"$command $previous\" in\n",
          to);
    for (size_t i = 0; i < from->count; i++)
        put_values(to, &from->command[i]);
    fputs("    esac\n    case $command in\n", to);
    for (size_t i = 0; i < from->count; i++)
        put_options(to, from, &from->command[i]);
    fputs("    esac\n"
          "    if [[ $current == -* ]]; then\n"
          "        mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$current\")\n"
          "    elif ((files)); then\n"
          "        mapfile -t COMPREPLY < <(compgen -W \"$words\" -f -- \"$current\")\n"
          "    else\n"
          "        mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n"
          "    fi\n}\n"
          "complete -o filenames -F _vndf vndf\n",
          to);
}
