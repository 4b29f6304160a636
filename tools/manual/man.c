/* vndf(1), in the macros that man and mandoc share: a section for each command. */
#include <ctype.h>
#include <string.h>

#include "manual/help_text.h"
#include "manual/manual.h"

/* Letters that troff reads otherwise. */
static void put_text(FILE *to, const char *text)
{
    static const struct {
        char letter;
        const char *as;
    } special[] = {{'\\', "\\e"},  {'-', "\\-"},   {'\'', "\\(aq"}, {'`', "\\(ga"},
                   {'^', "\\(ha"}, {'~', "\\(ti"}, {'"', "\\(dq"}};
    fputs("\\&", to); /* a dot in front would be a request */
    for (; *text; text++) {
        size_t i = 0;
        while (i < sizeof special / sizeof special[0] && special[i].letter != *text)
            i++;
        if (i < sizeof special / sizeof special[0])
            fputs(special[i].as, to);
        else
            putc(*text, to);
    }
}

static void put_line(FILE *to, const char *macro, const char *text)
{
    fputs(macro, to);
    put_text(to, text);
    putc('\n', to);
}

static void put_item(FILE *to, const help_part *part)
{
    fputs(".TP\n\\fB", to);
    put_text(to, part->term);
    fputs("\\fP\n", to);
    put_text(to, part->text);
    putc('\n', to);
}

static void put_heading(FILE *to, const char *text, size_t length)
{
    fputs(".SH \"", to);
    for (size_t i = 0; i < length; i++)
        putc(toupper((unsigned char)text[i]), to);
    fputs("\"\n", to);
}

/* Items of an item stand farther in, examples are not filled. */
static void put_change(FILE *to, help_kind before, help_kind kind)
{
    if (before == HELP_SUBITEM && kind != HELP_SUBITEM)
        fputs(".RE\n", to);
    if (before != HELP_SUBITEM && kind == HELP_SUBITEM)
        fputs(".RS\n", to);
    if (before == HELP_EXAMPLE && kind != HELP_EXAMPLE)
        fputs(".fi\n.RE\n", to);
    if (before != HELP_EXAMPLE && kind == HELP_EXAMPLE)
        fputs(".PP\nFor example:\n.PP\n.RS 4\n.nf\n", to);
}

static void put_part(FILE *to, const help_part *part, int first)
{
    if (part->kind == HELP_ITEM || part->kind == HELP_SUBITEM)
        put_item(to, part);
    else if (part->kind == HELP_EXAMPLE) {
        put_text(to, part->text);
        putc('\n', to);
    } else
        put_line(to, first ? "" : ".PP\n", part->text);
}

static void put_help(FILE *to, const char *help)
{
    help_part part = {HELP_TEXT, "", ""};
    help_kind before = HELP_TEXT;
    int at_begin = 1;
    for (const char *at = help; help_part_next(&at, &part); before = part.kind, at_begin = 0) {
        put_change(to, before, part.kind);
        put_part(to, &part, at_begin);
    }
    put_change(to, before, HELP_TEXT);
}

/* The parts of `vndf --help` behind its first line, which is the purpose; "exit status: ..." and "files: ..." are
 * sections of their own. */
static void put_head(FILE *to, const char *head, int sections)
{
    static const char *const titles[] = {"exit status", "files"};
    help_part part = {HELP_TEXT, "", ""};
    const char *at = head;
    help_part_next(&at, &part);
    while (help_part_next(&at, &part)) {
        size_t title = 0;
        for (size_t i = 0; i < sizeof titles / sizeof titles[0]; i++)
            if (part.kind == HELP_TEXT && strncmp(part.text, titles[i], strlen(titles[i])) == 0)
                title = strlen(titles[i]);
        if (title && sections) {
            put_heading(to, part.text, title);
            put_text(to, part.text + title + 2);
            putc('\n', to);
        } else if (part.kind == HELP_ITEM && !sections)
            put_item(to, &part);
    }
}

void manual_write_man(const manual *from, FILE *to)
{
    const char *purpose = strstr(from->head, " - ");
    fprintf(to, ".\\\" Made by `vndf help --man`.\n.TH VNDF 1 \"\" \"%s\" \"User Commands\"\n.nh\n.ad l\n",
            from->version);
    fputs(".SH NAME\nvndf \\- ", to);
    fprintf(to, "%.*s\n", (int)strcspn(purpose + 3, "\n"), purpose + 3);
    fputs(
        ".SH SYNOPSIS\n\\fBvndf\\fP \\fICOMMAND\\fP ...\n.br\n\\fBvndf\\fP \\fICOMMAND\\fP \\fB\\-\\-help\\fP\n.br\n"
        "\\fBvndf \\-\\-version\\fP\n.SH COMMANDS\n",
        to);
    put_head(to, from->head, 0);
    for (size_t i = 0; i < from->count; i++) {
        char name[64];
        snprintf(name, sizeof name, "vndf %s", from->command[i].name);
        put_heading(to, name, strlen(name));
        put_help(to, from->command[i].help);
    }
    put_head(to, from->head, 1);
}
