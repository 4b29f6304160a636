#include "manual/manual.h"

#include <ctype.h>
#include <string.h>

#include "cli/arguments.h"
#include "command.h"
#include "vndf.h"

/* ---- the manual page, in the macros that man and mandoc share ------------------------------------ */

/* With what troff reads otherwise escaped. */
static void put_text(FILE *to, const char *text, size_t length)
{
    static const char special[] = "\\-'`^~\"";
    static const char *const as[] = {"\\e", "\\-", "\\(aq", "\\(ga", "\\(ha", "\\(ti", "\\(dq"};
    fputs("\\&", to); /* a dot in front would be a request */
    for (size_t i = 0; i < length; i++) {
        const char *found = strchr(special, text[i]);
        if (found)
            fputs(as[found - special], to);
        else
            fputc(text[i], to);
    }
    fputc('\n', to);
}

static void put_heading(FILE *to, const char *text, size_t length)
{
    fputs(".SH \"", to);
    for (size_t i = 0; i < length; i++)
        fputc(toupper((unsigned char)text[i]), to);
    fputs("\"\n", to);
}

/* "TERM  what it is" */
static void put_item(FILE *to, const char *text, size_t length)
{
    size_t term = 0;
    while (term < length && (text[term] != ' ' || term + 1 == length || text[term + 1] != ' '))
        term++;
    fputs(".TP\n.B ", to);
    put_text(to, text, term);
    term += strspn(text + term, " ");
    put_text(to, text + term, term < length ? length - term : 0);
}

typedef enum block { PARAGRAPH, ITEM, LITERAL } block;

static void put_help(FILE *to, const char *help)
{
    block at = PARAGRAPH;
    for (size_t length; *help; help += length + (help[length] == '\n')) {
        length = strcspn(help, "\n");
        size_t indent = strspn(help, " ");
        const int is_usage = strncmp(help, "usage: ", 7) == 0;
        const int is_literal = is_usage || strncmp(help, "example: ", 9) == 0;
        if (at == LITERAL && (indent == 0 || length == 0))
            fputs(".fi\n", to);
        if (length == 0) {
            fputs(".PP\n", to);
            at = PARAGRAPH;
        } else if (is_literal) {
            fputs(is_usage ? ".nf\n" : "For example:\n.PP\n.nf\n", to);
            put_text(to, strchr(help, ' ') + 1, length - (size_t)(strchr(help, ' ') + 1 - help));
            at = LITERAL;
        } else if (at == LITERAL && indent > 0) { /* below the first line, behind "usage: " or "example: " */
            size_t skip = indent < 9 ? indent : 9;
            put_text(to, help + skip, length - skip);
        } else if (indent == 2) {
            put_item(to, help + indent, length - indent);
            at = ITEM;
        } else {
            if (at == ITEM && (indent == 6 || indent == 0))
                fputs(indent ? ".br\n" : ".PP\n", to);
            put_text(to, help + indent, length - indent);
            at = indent ? at : PARAGRAPH;
        }
    }
    fputs(at == LITERAL ? ".fi\n" : "", to);
}

void manual_write_man(FILE *to, const char *head)
{
    static const char *const sections[] = {"exit status: ", "files: ", "figures: "};
    static char help[HELP_MAX];
    const char *purpose = strstr(head, " - ") + 3;
    fputs(".\\\" Made by `vndf help --man`.\n.TH VNDF 1 \"\" \"vndf " VNDF_VERSION
          "\" \"User Commands\"\n.nh\n.ad l\n"
          ".SH NAME\nvndf \\- ",
          to);
    fprintf(to, "%.*s\n", (int)strcspn(purpose, "\n"), purpose);
    fputs(
        ".SH SYNOPSIS\n\\fBvndf\\fP \\fICOMMAND\\fP ...\n.br\n\\fBvndf\\fP \\fICOMMAND\\fP \\fB\\-\\-help\\fP\n.br\n"
        "\\fBvndf \\-\\-version\\fP\n.SH COMMANDS\n",
        to);
    for (const subcommand *const *c = subcommands; *c; c++) {
        const char *name = (*c)->name + strlen("vndf ");
        fputs(".TP\n.B ", to);
        put_text(to, name, strlen(name));
        put_text(to, (*c)->purpose, strlen((*c)->purpose));
    }
    for (const subcommand *const *c = subcommands; *c; c++) {
        command_help_text(*c, help);
        put_heading(to, (*c)->name, strlen((*c)->name));
        put_help(to, help);
    }
    for (size_t i = 0; i < sizeof sections / sizeof sections[0]; i++) { /* paragraphs "files: ..." of the head */
        const char *at = strstr(head, sections[i]);
        size_t title = strlen(sections[i]);
        put_heading(to, at, title - 2);
        for (at += title; *at && *at != '\n'; at += strcspn(at, "\n") + 1)
            put_text(to, at, strcspn(at, "\n"));
    }
}

/* ---- completion ---------------------------------------------------------------------------------- */

void manual_write_bash(FILE *to)
{
    static char help[HELP_MAX];
    fputs(
        "# bash completion for vndf; made by `vndf help --completion bash`: commands, their options, and files.\n"
        "_vndf()\n{\n    local current=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]} words='' files=-f\n"
        "    [[ $command == bench && ${COMP_WORDS[2]} == effects ]] && command='bench effects'\n"
        "    if ((COMP_CWORD == 1)) || [[ $command == help ]]; then\n        files='' words='",
        to);
    for (const subcommand *const *c = subcommands; *c; c++)
        fprintf(to, "%s ", (*c)->name + strlen("vndf "));
    fputs("--help --version'\n    fi\n    [[ $current == -* ]] && case $command in\n", to);
    for (const subcommand *const *c = subcommands; *c; c++) {
        option_term term;
        command_help_text(*c, help);
        fprintf(to, "    '%s') words='", (*c)->name + strlen("vndf "));
        for (const char *at = help; next_option(&at, &term);)
            fprintf(to, "%.*s ", (int)term.name_length, term.name);
        fputs("--help' ;;\n", to);
    }
    fputs("    esac\n    mapfile -t COMPREPLY < <(compgen -W \"$words\" $files -- \"$current\")\n}\n"
          "complete -o filenames -F _vndf vndf\n",
          to);
}
