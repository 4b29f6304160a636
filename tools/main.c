/* vndf: one program, a subcommand for each thing that can be done with a distribution of normals.
 * This file only dispatches; each subcommand has a file of its own, and help.c lists them. */
#include <stdio.h>
#include <string.h>

#include "cli/arguments.h"
#include "command.h"
#include "cli/output.h"
#include "vndf.h"

static int dispatch(int argc, char **argv)
{
    if (argc < 2)
        return complain("vndf", "a command is missing; `vndf --help` lists them");
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0)
        return print_help();
    if (strcmp(argv[1], "--version") == 0)
        return puts("vndf " VNDF_VERSION) < 0 ? STATUS_USE : STATUS_GOOD;
    for (size_t i = 0; i < subcommand_count; i++)
        if (strcmp(argv[1], subcommands[i].name) == 0)
            return subcommands[i].run(argc - 2, argv + 2);
    return refuse_subcommand("vndf", argv[1]);
}

int main(int argc, char **argv)
{
    output_begin();
    int status = dispatch(argc, argv);
    int delivered = output_finish_stdout("vndf");
    return delivered == STATUS_GOOD ? status : delivered;
}
