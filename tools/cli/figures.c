#include "cli/figures.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"

figures figures_begin(const arguments *given)
{
    return (figures){.command = given->command,
                     .form = option_value(given, "-q")       ? FIGURES_NONE
                             : option_value(given, "--json") ? FIGURES_JSON
                                                             : FIGURES_TEXT};
}

void figures_free(figures *f)
{
    for (size_t i = 0; i < f->count; i++)
        free(f->at[i].text);
    free(f->at);
    *f = (figures){.form = f->form};
}

/* ---- filling ----------------------------------------------------------------------------------- */

static void add(figures *f, figure_kind kind, const char *name, const char *text, const char *unit)
{
    const size_t room = f->count < f->room ? f->room : 2 * f->room + 64, length = strlen(text) + 1;
    figure *at = room > f->room ? realloc(f->at, room * sizeof *at) : f->at;
    char *copy = malloc(length + strlen(name) + 1); /* the name stands behind the text */
    f->at = at ? at : f->at;
    f->room = at ? room : f->room;
    if (at && copy) {
        strcpy(copy, text);
        strcpy(copy + length, name);
        at[f->count++] = (figure){f->list, copy + length, unit, NULL, copy, kind, f->row};
    } else {
        f->failed = 1;
        free(copy);
    }
}

void figures_add(figures *f, figure_kind kind, const char *name, const char *text)
{
    add(f, kind, name, text, "");
}

void figures_text(figures *f, const char *name, const char *text)
{
    add(f, FIGURE_TEXT, name, text, "");
}

void figures_number(figures *f, const char *name, const char *format, double x, const char *unit)
{
    char text[64];
    snprintf(text, sizeof text, format, x);
    add(f, FIGURE_NUMBER, name, isnan(x) ? "" : text, unit);
}

void figures_time(figures *f, const char *name, double ns)
{
    figures_number(f, name, ns < 10 ? "%.2f" : "%.1f", ns, "");
}

void figures_truth(figures *f, const char *name, int is)
{
    add(f, FIGURE_TRUTH, name, is ? "yes" : "no", "");
}

void figures_mark(figures *f, const char *mark)
{
    if (f->count)
        f->at[f->count - 1].mark = mark;
}

void figures_list(figures *f, const char *name)
{
    figures_list_end(f);
    add(f, FIGURE_LIST, name, "", "");
    f->list = name;
}

void figures_record(figures *f)
{
    f->row = ++f->rows;
}

void figures_list_end(figures *f)
{
    f->list = NULL;
    f->row = 0;
}

/* ---- text -------------------------------------------------------------------------------------- */

/* Whether a figure begins a record; or one ends before it. */
static int is_new(const figures *f, size_t i)
{
    return i == 0 || i == f->count || f->at[i].row == 0 || f->at[i].row != f->at[i - 1].row;
}

static const char *text_of(const figure *c)
{
    return *c->text || c->kind != FIGURE_NUMBER ? c->text : "-";
}

static void print_lines(FILE *file, const figures *f)
{
    enum { WIDTH = 100 };
    int column = 0;
    for (size_t i = 0; i < f->count; i++) {
        const figure *c = &f->at[i];
        const char *text = text_of(c), *space = *c->unit ? " " : "";
        if (c->kind == FIGURE_LIST)
            continue;
        if (c->row && is_new(f, i))
            column = fprintf(file, "%s", c->list);
        if (c->row && column + snprintf(NULL, 0, " %s %s%s%s", c->name, text, space, c->unit) > WIDTH)
            column = fprintf(file, "\n   ") - 1;
        column += fprintf(file, "%s%s %s%s%s", c->row ? " " : "", c->name, text, space, c->unit);
        if (is_new(f, i + 1))
            fputc('\n', file);
    }
}

size_t figures_columns(const figures *f)
{
    return f->rows ? f->count / f->rows : 0;
}

const char *figures_shown(const figures *f, size_t row, size_t column)
{
    return text_of(&f->at[row * figures_columns(f) + column]);
}

size_t text_glyphs(const char *text)
{
    size_t length = 0;
    for (; *text; text++)
        length += ((unsigned char)*text & 0xc0) != 0x80;
    return length;
}

static void put_padded(FILE *file, const char *text, size_t width, int is_right)
{
    const int spaces = (int)(width - text_glyphs(text));
    fprintf(file, "%*s%s%*s", is_right ? spaces : 0, "", text, is_right ? 0 : spaces, "");
}

static size_t width_of(const figures *f, size_t column, size_t width)
{
    for (size_t i = 0; i < f->rows; i++) {
        const size_t length = text_glyphs(figures_shown(f, i, column));
        width = length > width ? length : width;
    }
    return width;
}

/* What a terminal shows: groups by the first column, then a label if the second one holds texts. Labels and groups
 * share the first column of it; the headings stand in the line of each group. */
static void print_text(FILE *file, const figures *f)
{
    const size_t columns = figures_columns(f), first = columns > 1 && f->at[1].kind == FIGURE_TEXT ? 2 : 1;
    const size_t labels = width_of(f, first - 1, width_of(f, 0, 0));
    for (size_t i = 0; i < f->rows; i++) {
        const int begins = i == 0 || strcmp(figures_shown(f, i, 0), figures_shown(f, i - 1, 0)) != 0;
        for (int is_body = !begins; is_body < 2; is_body++) {
            const char *label = !is_body ? figures_shown(f, i, 0) : first > 1 ? figures_shown(f, i, 1) : "";
            fputs(is_body ? "  " : i ? "\n" : "", file);
            put_padded(file, label, labels + (is_body ? 0 : 2), 0);
            for (size_t k = first; k < columns; k++) {
                fputs("  ", file);
                put_padded(file, is_body ? figures_shown(f, i, k) : f->at[k].name,
                           width_of(f, k, text_glyphs(f->at[k].name)), f->at[k].kind == FIGURE_NUMBER);
            }
            fputc('\n', file);
        }
    }
}

/* ---- files ------------------------------------------------------------------------------------- */

static void print_grid(FILE *file, const figures *f, int is_csv)
{
    const size_t columns = figures_columns(f);
    for (size_t i = 0; i < columns + f->count; i++) {
        const int is_heading = i < columns, is_last = i % columns + 1 == columns;
        const figure *c = &f->at[is_heading ? i : i - columns];
        const char *text = is_heading ? c->name : is_csv ? c->text : text_of(c);
        const char *quote = is_csv && !is_heading && c->kind == FIGURE_TEXT ? "\"" : "";
        fputs(is_csv ? quote : i % columns ? " " : "| ", file);
        for (; *text; text++) {
            fputs(is_csv         ? *text == '"' ? "\"" : ""
                  : *text == '|' ? "\\"
                                 : "",
                  file); /* which would end the cell */
            fputc(*text == '\n' && !is_csv ? ' ' : *text, file);
        }
        fprintf(file, "%s%s", is_csv ? quote : " |", is_last ? "\n" : is_csv ? "," : "");
        for (size_t k = 0; !is_csv && is_heading && is_last && k < columns; k++)
            fprintf(file, "%s%s%s", k ? "" : "|", f->at[k].kind == FIGURE_NUMBER ? "--:|" : "---|",
                    k + 1 == columns ? "\n" : "");
    }
}

/* Between quotes; bytes that are no UTF-8 are the caller's. */
static void put_string(FILE *file, const char *text)
{
    fputc('"', file);
    for (; *text; text++) {
        unsigned char letter = (unsigned char)*text;
        if (letter < 0x20)
            fprintf(file, "\\u%04x", letter);
        else if (letter == '"' || letter == '\\')
            fprintf(file, "\\%c", letter);
        else
            fputc(letter, file);
    }
    fputc('"', file);
}

/* A number is one that strtod reads whole; infinities are none in JSON. */
static void put_member(FILE *file, const figure *c)
{
    char *end;
    put_string(file, c->name);
    fputs(": ", file);
    if (c->kind == FIGURE_TRUTH)
        fputs(*c->text == 'y' ? "true" : "false", file);
    else if (c->kind == FIGURE_NUMBER)
        fputs(isfinite(strtod(c->text, &end)) && end != c->text && *end == '\0' ? c->text : "null", file);
    else
        put_string(file, c->text);
}

/* The records from i on as an array, each on such a line, the bracket on the last one; returns what comes behind it. */
static size_t put_records(FILE *file, const figures *f, size_t i, const char *line, const char *last)
{
    const size_t first = i;
    fputc('[', file);
    for (; i < f->count && f->at[i].row; i++) {
        if (is_new(f, i))
            fprintf(file, "%s%s{", i > first ? "}," : "", line);
        else
            fputs(", ", file);
        put_member(file, &f->at[i]);
    }
    fprintf(file, "%s%s]", i > first ? "}" : "", i > first ? last : "");
    return i;
}

/* Units stand at the end, each once, as "list.name": "unit". */
static void print_json(FILE *file, const figures *f)
{
    const char *between = "{";
    for (size_t i = 0; i < f->count;) {
        const figure *c = &f->at[i++];
        fprintf(file, "%s\n  ", between);
        between = ",";
        if (c->kind == FIGURE_LIST) {
            fprintf(file, "\"%s\": ", c->name);
            i = put_records(file, f, i, "\n    ", "\n  ");
        } else {
            put_member(file, c);
        }
    }
    fprintf(file, "%s\n  \"units\": {", between);
    between = "";
    for (size_t i = 0; i < f->count; i++) {
        const figure *c = &f->at[i];
        size_t first = 0;
        while (strcmp(f->at[first].name, c->name) != 0 || f->at[first].list != c->list)
            first++;
        if (first < i || !*c->unit)
            continue;
        fprintf(file, "%s\"%s%s%s\": \"%s\"", between, c->list ? c->list : "", c->list ? "." : "", c->name,
                c->unit);
        between = ", ";
    }
    fputs("}\n}\n", file);
}

int figures_end(figures *f)
{
    const int status = f->failed ? complain(f->command, "no memory") : STATUS_GOOD;
    if (!f->failed && f->form == FIGURES_JSON)
        print_json(stdout, f);
    else if (!f->failed && f->form == FIGURES_TEXT)
        print_lines(stdout, f);
    figures_free(f);
    return status;
}

int figures_print(FILE *file, const figures *f, figures_form form)
{
    if (f->failed)
        return 0;
    if (form == FIGURES_JSON) {
        put_records(file, f, 0, "\n", "\n");
        fputc('\n', file);
    } else if (form == FIGURES_TEXT)
        print_text(file, f);
    else
        print_grid(file, f, form == FIGURES_CSV);
    return 1;
}
