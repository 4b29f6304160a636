/* The list of all commands, `vndf --help`, and vndf help: the help of a command, or of all as a manual page. */
#include <stdio.h>
#include <string.h>

#include "cli/arguments.h"
#include "cli/output.h"
#include "command.h"
#include "vndf.h"

const subcommand *const subcommands[] = {
    &command_build,   &command_info,   &command_check,         &command_sample, &command_plot,
    &command_report,  &command_bench,  &command_bench_effects, &command_bake,   &command_export,
    &command_explore, &command_render, &command_judge,         &command_help,   NULL};

static const char name[] = "vndf help";

static const char *const help[] = {"usage: vndf help [COMMAND]\n"
                                   "       vndf help --man [-o FILE]\n"
                                   "\n"
                                   "Prints what `vndf COMMAND --help` prints.\n"
                                   "\n"
                                   "  --man            the manual page vndf(1), of all commands\n"
                                   "    -o FILE        where it goes; - for stdout (the default)\n"
                                   "\n"
                                   "example: vndf help bench effects\n"
                                   "         vndf help --man -o vndf.1 && man -l vndf.1\n",
                                   NULL};

/* ---- all commands -------------------------------------------------------------------------------- */

static const char purpose[] = "sampling of visible normals for any isotropic distribution of microfacet normals";

static const char rest[] =
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
    "figures: lines of a name, a value and its unit, or rows; --json prints them as JSON, -q not at all;\n"
    "every command takes both\n";

void command_list_text(char text[HELP_MAX])
{
    int at = snprintf(
        text, HELP_MAX,
        "vndf - %s\n\nusage: vndf COMMAND ...        vndf COMMAND --help says more, with an example\n\n", purpose);
    for (const subcommand *const *c = subcommands; *c; c++)
        at += snprintf(text + at, HELP_MAX - (size_t)at, "  %-13s %s\n", (*c)->name + strlen("vndf "),
                       (*c)->purpose);
    snprintf(text + at, HELP_MAX - (size_t)at, "\n%s", rest);
}

/* What every command takes stands before its last example. */
void command_help_text(const subcommand *of, char text[HELP_MAX])
{
    static const char every[] = "\n"
                                "  --json           prints figures as JSON, here and in every command\n"
                                "  -q               prints neither figures nor progress\n";
    const size_t length = sizeof every - 1;
    char *last = text;
    text[0] = '\0';
    for (const char *const *chapter = of->help; *chapter; chapter++)
        strncat(text, *chapter, HELP_MAX - length - 1 - strlen(text));
    for (char *at = text; (at = strstr(at, "\nexample: ")) != NULL; at++)
        last = at;
    memmove(last + length, last, strlen(last) + 1);
    memcpy(last, every, length);
}

/* `bench effects` is two words, which are looked for first. */
const subcommand *command_named(const char *who, int argc, const char *const *argv, int *used)
{
    const char *names[WORDS_MAX] = {"--help", "--version"}, *hint = NULL, *word = NULL;
    char two[128];
    size_t count = 2;
    for (const subcommand *const *c = subcommands; *c; c++)
        names[count++] = (*c)->name + strlen("vndf ");
    snprintf(two, sizeof two, "%.60s %.60s", argv[0], argc > 1 ? argv[1] : "");
    for (*used = argc > 1 ? 2 : 1; *used > 0 && !hint; --*used) {
        word = *used == 2 ? two : argv[0];
        for (const subcommand *const *c = subcommands; *c; c++)
            if (strcmp((*c)->name + strlen("vndf "), word) == 0)
                return *c;
        hint = nearest_word(word, names, count);
        hint = hint && *used == 2 && !strchr(hint, ' ') ? NULL : hint;
    }
    if (hint)
        complain(who, "there is no command '%s'; did you mean '%s'?", word, hint);
    else if (strchr(word, '.'))
        complain(who, "there is no command '%s'; did you mean `vndf info %s`?", word, word);
    else
        complain(who, "there is no command '%s'; `vndf --help` lists them", word);
    return NULL;
}

/* ---- the manual page ----------------------------------------------------------------------------- */

/* In the macros that man and mandoc share: the text as it stands, with what troff reads otherwise escaped. */
static void put_man(FILE *to, const char *text)
{
    static const char special[] = "\\-'`^~";
    static const char *const as[] = {"\\e", "\\-", "\\(aq", "\\(ga", "\\(ha", "\\(ti"};
    fputs(".nf\n\\&", to); /* a dot at the beginning of a line would be a request */
    for (; *text; text++) {
        const char *found = strchr(special, *text);
        if (found)
            fputs(as[found - special], to);
        else
            fputc(*text, to);
        fputs(*text == '\n' && text[1] ? "\\&" : "", to);
    }
    fputs(".fi\n", to);
}

static void write_man(FILE *to)
{
    static char text[HELP_MAX];
    fprintf(to,
            ".\\\" Made by `vndf help --man`.\n.TH VNDF 1 \"\" \"vndf %s\" \"User Commands\"\n"
            ".SH NAME\nvndf \\- %s\n.SH DESCRIPTION\n",
            VNDF_VERSION, purpose);
    command_list_text(text);
    put_man(to, strstr(text, "usage: "));
    for (const subcommand *const *c = subcommands; *c; c++) {
        fprintf(to, ".SH \"%s\"\n", (*c)->name);
        command_help_text(*c, text);
        put_man(to, text);
    }
}

/* ---- the command --------------------------------------------------------------------------------- */

static int run(const arguments *given)
{
    static char text[HELP_MAX];
    const words *asked = &given->positional;
    const char *path = option_value(given, "-o");
    output_file output;
    int used;
    if (option_value(given, "--man")) {
        if (asked->count)
            return complain(name, "'%s' is not expected: --man is of all commands", asked->item[0]);
        if (!output_open(&output, name, path ? path : "-"))
            return STATUS_USE;
        write_man(output.file);
        return output_commit(&output);
    }
    if (asked->count) {
        const subcommand *c = command_named(name, (int)asked->count, asked->item, &used);
        if (c && asked->count > (size_t)used)
            return complain(name, "'%s' is one word too many", asked->item[used]);
        if (!c)
            return STATUS_USE;
        command_help_text(c, text);
    } else
        command_list_text(text);
    return fputs(text, stdout) < 0 ? STATUS_USE : STATUS_GOOD;
}

const subcommand command_help = {name, "the help of a command; the manual page", "COMMAND", 0, 2, run, help};
