/* vndf: one program, a subcommand for each thing that can be done with a distribution of normals.
 * This file only dispatches; each subcommand has a file of its own. */
#include <stdio.h>
#include <string.h>

#include "cli/arguments.h"
#include "command.h"
#include "cli/files.h"
#include "cli/output.h"
#include "vndf.h"

typedef struct subcommand {
    const char *name;
    int (*run)(int argc, char **argv);
    const char *purpose;
} subcommand;

static const subcommand subcommands[] = {
    {"build", command_build, "make a table from a formula, a CSV, a named family or a file of measurements"},
    {"info", command_info, "what a table is, where it came from, its certificate"},
    {"check", command_check, "measure a table again; exit 1 if a claim fails"},
    {"sample", command_sample, "draw visible normals into a CSV or a file of floats"},
    {"eval", command_eval, "ndf, pdf, lambda, g1 for normals read from stdin"},
    {"plot", command_plot, "draw density and samples as an SVG"},
    {"report", command_report, "a page of plots: what accuracy costs, and which table to ship"},
    {"bench", command_bench, "time, error and efficiency of all methods side by side"},
    {"masking", command_masking, "which masking functions are exact, over incident angles"},
    {"albedo", command_albedo, "what single scattering keeps of the light, for energy compensation"},
    {"export", command_export, "the sampler with your tables as one file for C, CUDA, GLSL and other languages"},
    {"explore", command_explore, "a page that draws tables, GGX and Beckmann side by side in a browser"},
    {"render", command_render, "a picture of a scene, with only the effects that it calls for"},
    {"compare", command_compare, "a scene by several ways of drawing normals, in equal time: a page"},
};

static const size_t subcommand_count = sizeof subcommands / sizeof subcommands[0];

static int print_help(void)
{
    puts("vndf - sampling of visible normals for any isotropic distribution of microfacet normals\n"
         "\n"
         "usage: vndf COMMAND ...        vndf COMMAND --help says more, with an example\n");
    for (size_t i = 0; i < subcommand_count; i++)
        printf("  %-8s %s\n", subcommands[i].name, subcommands[i].purpose);
    puts("\n"
         "example: vndf build --slope 'exp(-3*r)*(1+0.8*cos(6*r))' -o wavy.vndf\n"
         "         vndf check wavy.vndf\n"
         "         vndf sample wavy.vndf --theta 60 --alpha 0.3 -n 1000000 -o normals.f32\n"
         "\n"
         "exit status: 0 good; 1 the answer is no; 2 wrong use, or an input or output failed. Text for a closed\n"
         "or full stdout is such a failure, even if the file of -o is whole. A reader that closes the pipe ends\n"
         "the program quietly, by SIGPIPE or, where SIGPIPE is ignored, with status 2\n"
         "\n"
         "files: a written file appears whole or not at all, keeps its permissions, and is never an input of the\n"
         "same command; symbolic links are followed to their file. `-o -` is stdout, without other text");
    return STATUS_GOOD;
}

static int refuse_subcommand(const char *name)
{
    const char *names[sizeof subcommands / sizeof subcommands[0]];
    for (size_t i = 0; i < subcommand_count; i++)
        names[i] = subcommands[i].name;
    const char *hint = nearest_word(name, names, subcommand_count);
    if (hint)
        return complain("vndf", "there is no command '%s'; did you mean '%s'?", name, hint);
    return complain("vndf", "there is no command '%s'; `vndf --help` lists them", name);
}

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
    return refuse_subcommand(argv[1]);
}

int main(int argc, char **argv)
{
    if (!files_begin())
        return STATUS_USE;
    output_ignore_size_signal();
    int status = dispatch(argc, argv);
    int delivered = output_finish_stdout("vndf");
    return delivered == STATUS_GOOD ? status : delivered;
}
