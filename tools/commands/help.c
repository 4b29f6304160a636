/* The list of all commands, `vndf --help`, and vndf help: the help of a command, the manual page, completion. */
#include <stdio.h>
#include <string.h>

#include "cli/arguments.h"
#include "cli/output.h"
#include "command.h"
#include "manual/manual.h"

const subcommand subcommands[] = {
    {"build", command_build, "make a table from a formula, a CSV, a named family or a file of measurements"},
    {"info", command_info, "what a table is, where it came from, its certificate"},
    {"check", command_check, "measure a table again; exit 1 if a claim fails"},
    {"sample", command_sample, "draw visible normals into a CSV or a file of floats"},
    {"eval", command_eval, "ndf, pdf, lambda, g1 for normals read from stdin"},
    {"plot", command_plot, "draw density and samples as an SVG"},
    {"report", command_report, "a page of plots: what accuracy costs, and which table to ship"},
    {"bench", command_bench, "time, error and efficiency of all methods side by side"},
    {"albedo", command_albedo, "what single scattering keeps of the light, for energy compensation"},
    {"export", command_export, "the sampler with your tables as one file for C, CUDA, GLSL and other languages"},
    {"explore", command_explore, "a page that draws tables, GGX and Beckmann side by side in a browser"},
    {"render", command_render, "a picture of a scene, by one sampler or several side by side"},
    {"help", command_help, "the help of a command; the manual page and completion of bash"},
};

const size_t subcommand_count = sizeof subcommands / sizeof subcommands[0];

static const char name[] = "vndf help";

static const char help[] =
    "usage: vndf help [COMMAND]\n"
    "       vndf help --man [-o FILE]\n"
    "       vndf help --completion bash [-o FILE]\n"
    "\n"
    "Prints what `vndf COMMAND --help` prints; or what packages install, made from the options of all commands.\n"
    "\n"
    "  --man            the manual page vndf(1)\n"
    "  --completion bash    what completes commands, options and files in bash: a file vndf in\n"
    "                   share/bash-completion/completions. zsh reads it after bashcompinit\n"
    "  -o FILE          where it goes; - for stdout (the default)\n"
    "\n"
    "example: vndf help bench effects\n"
    "         vndf help --man -o vndf.1 && man -l vndf.1\n"
    "         source <(vndf help --completion bash)\n";

/* ---- all commands -------------------------------------------------------------------------------- */

static const char head_begin[] =
    "vndf - sampling of visible normals for any isotropic distribution of microfacet normals\n"
    "\n"
    "usage: vndf COMMAND ...        vndf COMMAND --help says more, with an example\n"
    "\n";

static const char head_end[] =
    "\n"
    "example: vndf build --slope 'exp(-3*r)*(1+0.8*cos(6*r))' -o wavy.vndf\n"
    "         vndf check wavy.vndf\n"
    "         vndf sample wavy.vndf --theta 60 --alpha 0.3 -n 1000000 -o normals.f32\n"
    "\n"
    "exit status: 0 good; 1 the answer is no; 2 wrong use, or an input or output failed. Text for a full\n"
    "stdout is such a failure, even if the file of -o is whole. A reader that closes the pipe ends\n"
    "the program quietly, by SIGPIPE or, where SIGPIPE is ignored, with status 2\n"
    "\n"
    "files: a written file appears whole or not at all, keeps its permissions, and is never an input of the\n"
    "same command; symbolic links are followed to their file. `-o -` is stdout, without other text, and - in\n"
    "the place of an input is stdin, once\n"
    "\n"
    "figures: lines of a name, a value and its unit, or rows; --json prints them as JSON, -q not at all\n";

enum { HEAD_SIZE = 8192 };

static void write_head(char head[HEAD_SIZE])
{
    size_t at = (size_t)snprintf(head, HEAD_SIZE, "%s", head_begin);
    for (size_t i = 0; i < subcommand_count && at < HEAD_SIZE; i++)
        at += (size_t)snprintf(head + at, HEAD_SIZE - at, "  %-8s %s\n", subcommands[i].name,
                               subcommands[i].purpose);
    if (at < HEAD_SIZE)
        snprintf(head + at, HEAD_SIZE - at, "%s", head_end);
}

int print_help(void)
{
    char head[HEAD_SIZE];
    write_head(head);
    return fputs(head, stdout) < 0 ? STATUS_USE : STATUS_GOOD;
}

int refuse_subcommand(const char *command, const char *wrong)
{
    const char *names[WORDS_MAX] = {"--help", "--version"};
    for (size_t i = 0; i < subcommand_count; i++)
        names[2 + i] = subcommands[i].name;
    const char *hint = nearest_word(wrong, names, 2 + subcommand_count);
    if (hint)
        return complain(command, "there is no command '%s'; did you mean '%s'?", wrong, hint);
    if (strchr(wrong, '.'))
        return complain(command, "there is no command '%s'; did you mean `vndf info %s`?", wrong, wrong);
    return complain(command, "there is no command '%s'; `vndf --help` lists them", wrong);
}

/* ---- the command --------------------------------------------------------------------------------- */

static int show(const words *asked)
{
    static char word[] = "--help";
    char *argv[] = {word, NULL};
    static const char *const modes[] = {"effects", NULL};
    if (asked->count == 2 && strcmp(asked->item[0], "bench") == 0)
        return word_among(name, "what follows bench,", asked->item[1], modes) < 0 ? STATUS_USE
                                                                                  : command_bench_effects(1, argv);
    if (asked->count == 2)
        return complain(name, "'%s' is one word too many", asked->item[1]);
    for (size_t i = 0; i < subcommand_count; i++)
        if (strcmp(asked->item[0], subcommands[i].name) == 0)
            return subcommands[i].run(1, argv);
    return refuse_subcommand(name, asked->item[0]);
}

static int write(int is_man, const char *path)
{
    char head[HEAD_SIZE];
    output_file output;
    if (!output_open(&output, name, path ? path : "-"))
        return STATUS_USE;
    write_head(head);
    if (is_man)
        manual_write_man(output.file, head);
    else
        manual_write_bash(output.file);
    return output_commit(&output);
}

int command_help(int argc, char **argv)
{
    words asked = {{NULL}, 0}, man = {{NULL}, 0}, completion = {{NULL}, 0}, output = {{NULL}, 0};
    static const char *const shells[] = {"bash", NULL};
    const option_form options[] = {
        {"--man", 0, 1, &man}, {"--completion", 1, 1, &completion}, {"-o", 1, 1, &output}};
    const command_form form = {name, help, options, sizeof options / sizeof options[0], "COMMAND", 0, 2};
    int parsed = parse_arguments(&form, argc, argv, &asked);
    if (parsed != PARSE_GO_ON)
        return parsed;
    if (asked.count + man.count + completion.count == 0)
        return output.count ? complain(name, "-o goes with --man or --completion") : print_help();
    if ((asked.count > 0) + man.count + completion.count > 1 || (asked.count && output.count))
        return complain(name, "one of a command, --man and --completion is possible");
    if (asked.count)
        return show(&asked);
    if (completion.count && word_among(name, "--completion", only_word(&completion), shells) < 0)
        return STATUS_USE;
    return write(man.count > 0, only_word(&output));
}
