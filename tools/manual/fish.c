/* Completion for fish. */
#include <string.h>

#include "manual/help_text.h"
#include "manual/manual.h"
#include "manual/values.h"

static void put_quoted(FILE *to, const char *text)
{
    putc('\'', to);
    for (; *text; text++)
        fprintf(to, strchr("'\\", *text) ? "\\%c" : "%c", *text);
    putc('\'', to);
}

/* "complete -c vndf -n CONDITION": where the words of the command's name are there, and no mode of it is. */
static void put_begin(FILE *to, const manual *from, const manual_command *command)
{
    const char *second = strchr(command->name, ' '), *mode = manual_mode(from, command);
    fprintf(to, "complete -c vndf -n '__fish_seen_subcommand_from %.*s", (int)strcspn(command->name, " "),
            command->name);
    if (second)
        fprintf(to, "; and __fish_seen_subcommand_from %s", second + 1);
    if (mode)
        fprintf(to, "; and not __fish_seen_subcommand_from %s", mode);
    putc('\'', to);
}

static void put_option(FILE *to, const manual *from, const manual_command *command, const manual_option *option)
{
    help_option said;
    help_option_find(command->help, option->name, &said);
    values may = values_of(option->takes_value ? said.value : "");
    put_begin(to, from, command);
    if (strncmp(option->name, "--", 2) == 0)
        fprintf(to, " -l %s", option->name + 2);
    else
        fprintf(to, " -s %s", option->name + 1);
    if (option->takes_value)
        fputs(may.files ? " -r -F" : " -x", to);
    if (may.words[0])
        fprintf(to, " -a '%s'", may.words);
    if (said.about[0]) {
        fputs(" -d ", to);
        put_quoted(to, said.about);
    }
    putc('\n', to);
}

static void put_command(FILE *to, const manual *from, const manual_command *command)
{
    values may = manual_positional(from, command);
    for (size_t i = 0; i < command->option_count; i++)
        put_option(to, from, command, &command->option[i]);
    put_begin(to, from, command);
    fputs(" -l help -d 'says what it does'\n", to);
    if (may.files || may.words[0]) {
        put_begin(to, from, command);
        fprintf(to, "%s -a '%s'\n", may.files ? " -F" : "", may.words);
    }
}

void manual_write_fish(const manual *from, FILE *to)
{
    fputs("# fish completion for vndf; made by `vndf help --completion fish`.\ncomplete -c vndf -f\n", to);
    for (size_t i = 0; i < from->count; i++) {
        if (strchr(from->command[i].name, ' '))
            continue;
        fprintf(to, "complete -c vndf -n __fish_use_subcommand -a %s -d ", from->command[i].name);
        put_quoted(to, from->command[i].purpose);
        putc('\n', to);
    }
    for (size_t i = 0; i < from->count; i++)
        put_command(to, from, &from->command[i]);
}
