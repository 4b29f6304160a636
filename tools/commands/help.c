/* The list of all commands, `vndf --help`; the help of one; and of all as a manual page, `vndf --man`. */
#include <stdio.h>
#include <string.h>

#include "cli/arguments.h"
#include "command.h"
#include "vndf.h"

const subcommand *const subcommands[] = {&command_build,   &command_info,
                                         &command_check,   &command_sample,
                                         &command_plot,    &command_report,
                                         &command_bench,   &command_bench_effects,
                                         &command_bake,    &command_export,
                                         &command_explore, &command_render,
                                         &command_judge,   NULL};

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
        "vndf - %s\n\nusage: vndf COMMAND ...    vndf help COMMAND says more, with an example; vndf --man is all of it\n\n",
        purpose);
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
const subcommand *command_named(int argc, const char *const *argv, int *used)
{
    const char *names[WORDS_MAX] = {"--help", "--version", "help"}, *hint = NULL, *word = NULL;
    char two[128];
    size_t count = 3;
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
        complain("vndf", "there is no command '%s'; did you mean '%s'?", word, hint);
    else if (strchr(word, '.'))
        complain("vndf", "there is no command '%s'; did you mean `vndf info %s`?", word, word);
    else
        complain("vndf", "there is no command '%s'; `vndf --help` lists them", word);
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

void command_write_man(FILE *to)
{
    static char text[HELP_MAX];
    fprintf(to,
            ".\\\" Made by `vndf --man`.\n.TH VNDF 1 \"\" \"vndf %s\" \"User Commands\"\n"
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
