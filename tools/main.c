/* vndf: one program, a command for each thing that can be done with a distribution of normals. This file reads the
 * words by the help of the command and runs it; commands/help.c lists all. */
#include <stdio.h>
#include <string.h>

#include "cli/arguments.h"
#include "cli/output.h"
#include "command.h"
#include "vndf.h"

static int asks(const char *word, const char *long_name, const char *short_name)
{
    return strcmp(word, long_name) == 0 || strcmp(word, short_name) == 0;
}

static int print(const char *text)
{
    return fputs(text, stdout) < 0 ? STATUS_USE : STATUS_GOOD;
}

static int dispatch(int argc, char **argv)
{
    static char help[HELP_MAX];
    int used = 0;
    if (argc < 2)
        return complain("vndf", "a command is missing; `vndf --help` lists them");
    if (asks(argv[1], "--version", "-V"))
        return print("vndf " VNDF_VERSION "\n");
    if (asks(argv[1], "--man", "--man")) {
        command_write_man(stdout);
        return STATUS_GOOD;
    }
    int is_help = asks(argv[1], "--help", "-h") || asks(argv[1], "help", "help");
    if (is_help && argc == 2) {
        command_list_text(help);
        return print(help);
    }
    argc -= 1 + is_help;
    argv += 1 + is_help;
    const subcommand *c = command_named(argc, (const char *const *)argv, &used);
    if (!c)
        return STATUS_USE;
    command_help_text(c, help);
    if (is_help && argc > used)
        return complain("vndf help", "'%s' is one word too many", argv[used]);
    for (int i = used; i < argc && strcmp(argv[i], "--") != 0; i++)
        is_help |= asks(argv[i], "--help", "-h");
    if (is_help)
        return print(help);
    arguments given = {.command = c->name, .help = help};
    if (!arguments_read(&given, argc - used, argv + used))
        return STATUS_USE;
    if (given.positional.count < c->least)
        return complain(c->name, "%s is missing; `%s --help` has an example", c->positional, c->name);
    if (given.positional.count > c->most) {
        const char *word = given.positional.item[c->most];
        return complain(c->name, "'%s' is not expected; %s%s%s", word,
                        c->most ? "words that are no options are only " : "only options are", c->positional,
                        strspn(word, "0123456789.") == strlen(word) ? "; lists have commas, as in 1,2" : "");
    }
    return c->run(&given);
}

int main(int argc, char **argv)
{
    output_begin();
    int status = dispatch(argc, argv);
    int delivered = output_finish_stdout("vndf");
    return delivered == STATUS_GOOD ? status : delivered;
}
