/* vndf: one program, a command for each thing that can be done with a distribution of normals. This file lists them and
 * their helps, as a manual page too, reads the words by the help of the command, and runs it. */
#include <string.h>

#include "cli/arguments.h"
#include "cli/output.h"
#include "command.h"
#include "vndf.h"

static const subcommand *const subcommands[] = {
    &command_build,  &command_info,  &command_check, &command_sample, &command_plot,
    &command_report, &command_bench, &command_bake,  &command_export, &command_explore,
    &command_render, &command_judge, NULL,
};

static const char purpose[] = "sampling of visible normals for any isotropic distribution of microfacet normals";

static const char usage[] =
    "usage: vndf COMMAND ...    vndf help COMMAND says more, with an example; vndf --man is all of it\n"
    "\n";

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

enum { HELP_MAX = 1 << 14 };

static void list_text(char text[HELP_MAX])
{
    int at = snprintf(text, HELP_MAX, "vndf - %s\n\n%s", purpose, usage);
    for (const subcommand *const *c = subcommands; *c; c++)
        at += snprintf(text + at, HELP_MAX - (size_t)at, "  %-13s %s\n", (*c)->name + strlen("vndf "),
                       (*c)->purpose);
    snprintf(text + at, HELP_MAX - (size_t)at, "\n%s", rest);
}

/* What every command takes stands before its last example. */
static void help_text(const subcommand *of, char text[HELP_MAX])
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

static const subcommand *find_command(const char *word)
{
    const char *names[WORDS_MAX] = {"--help", "--version", "help"};
    size_t count = 3;
    for (const subcommand *const *c = subcommands; *c; c++) {
        names[count++] = (*c)->name + strlen("vndf ");
        if (strcmp(names[count - 1], word) == 0)
            return *c;
    }
    const char *hint = did_you_mean(word, names, count);
    if (!*hint && strchr(word, '.'))
        complain("vndf", "there is no command '%s'; did you mean `vndf info %s`?", word, word);
    else
        complain("vndf", "there is no command '%s'%s", word, *hint ? hint : "; `vndf --help` lists them");
    return NULL;
}

/* In the macros that man and mandoc share: the text as it stands, with what troff reads otherwise escaped. */
static void put_man(FILE *to, const char *text)
{
    static const char special[] = "\\-'`^~";
    static const char *const as[] = {"\\e", "\\-", "\\(aq", "\\(ga", "\\(ha", "\\(ti"};
    fputs(".nf\n", to);
    for (char before = '\n'; *text; before = *text++) {
        const char *found = strchr(special, *text);
        fputs(before == '\n' ? "\\&" : "", to); /* a dot at the beginning of a line would be a request */
        fprintf(to, found ? "%s" : "%.1s", found ? as[found - special] : text);
    }
    fputs(".fi\n", to);
}

static void write_man(FILE *to)
{
    static char text[HELP_MAX];
    fprintf(to,
            ".\\\" Made by `vndf --man`.\n.TH VNDF 1 \"\" \"vndf %s\" \"User Commands\"\n"
            ".SH NAME\nvndf \\- %s\n.SH DESCRIPTION\n",
            VNDF_VERSION, purpose);
    list_text(text);
    put_man(to, strstr(text, "usage: "));
    for (const subcommand *const *c = subcommands; *c; c++) {
        fprintf(to, ".SH \"%s\"\n", (*c)->name);
        help_text(*c, text);
        put_man(to, text);
    }
}

static int asks(const char *word, const char *long_name, const char *short_name)
{
    return strcmp(word, long_name) == 0 || strcmp(word, short_name) == 0;
}

static int run(const subcommand *c, const char *help, int argc, char **argv)
{
    static arguments given;
    if (!arguments_read(&given, c->name, help, argc, argv))
        return STATUS_USE;
    if (given.positional.count < c->least)
        return complain(c->name, "%s is missing; `%s --help` has an example", c->positional, c->name);
    if (given.positional.count <= c->most)
        return c->run(&given);
    const char *word = given.positional.item[c->most];
    return complain(c->name, "'%s' is not expected; %s%s%s", word,
                    c->most ? "words that are no options are only " : "only options are", c->positional,
                    strspn(word, "0123456789.") == strlen(word) ? "; lists have commas, as in 1,2" : "");
}

static int dispatch(int argc, char **argv)
{
    static char help[HELP_MAX];
    if (argc < 2)
        return complain("vndf", "a command is missing; `vndf --help` lists them");
    int is_help = asks(argv[1], "--help", "-h") || asks(argv[1], "help", "help");
    const int used = 2 + is_help;
    const subcommand *c = NULL;
    if (asks(argv[1], "--version", "-V"))
        puts("vndf " VNDF_VERSION);
    else if (asks(argv[1], "--man", "--man"))
        write_man(stdout);
    else if (is_help && argc == 2)
        list_text(help);
    else if (!(c = find_command(argv[used - 1])))
        return STATUS_USE;
    else if (is_help && argc > used)
        return complain("vndf help", "'%s' is one word too many", argv[used]);
    else
        help_text(c, help);
    for (int i = used; c && i < argc && strcmp(argv[i], "--") != 0; i++)
        is_help |= asks(argv[i], "--help", "-h");
    if (c && !is_help)
        return run(c, help, argc - used, argv + used);
    fputs(help, stdout);
    return STATUS_GOOD;
}

int main(int argc, char **argv)
{
    int status = output_begin() ? dispatch(argc, argv) : complain("vndf", "cannot open /dev/null");
    int delivered = output_finish_stdout("vndf");
    return delivered == STATUS_GOOD ? status : delivered;
}
