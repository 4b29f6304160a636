#include "draw/table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "draw/svg.h"

void table_free(text_table *t)
{
    free(t->cell);
    *t = (text_table){.count = 0};
}

/* ---- filling ----------------------------------------------------------------------------------- */

void table_row(text_table *t)
{
    t->rows++;
}

static void add(text_table *t, const char *heading, table_kind kind, const char *text)
{
    if (t->rows == 1 && t->columns < TABLE_COLUMNS_MAX) {
        t->kind[t->columns] = kind;
        t->heading[t->columns++] = heading;
    }
    if (t->count == t->room) {
        size_t room = t->room ? 2 * t->room : 256;
        table_cell *cell = realloc(t->cell, room * sizeof *cell);
        t->failed |= cell == NULL;
        if (!cell)
            return;
        t->room = room;
        t->cell = cell;
    }
    t->cell[t->count] = (table_cell){.mark = NULL};
    snprintf(t->cell[t->count++].text, TABLE_CELL, "%s", text);
}

void table_text(text_table *t, const char *heading, const char *text)
{
    add(t, heading, TABLE_TEXT, text);
}

void table_word(text_table *t, const char *heading, const char *word)
{
    add(t, heading, TABLE_WORD, word);
}

void table_figure(text_table *t, const char *heading, const char *figure)
{
    add(t, heading, TABLE_NUMBER, figure);
}

void table_number(text_table *t, const char *heading, const char *format, double x)
{
    char text[64];
    snprintf(text, sizeof text, format, x);
    add(t, heading, TABLE_NUMBER, isnan(x) ? "" : text);
}

void table_time(text_table *t, const char *heading, double ns)
{
    table_number(t, heading, ns < 10 ? "%.2f" : "%.1f", ns);
}

void table_mark(text_table *t, const char *mark)
{
    if (t->count)
        t->cell[t->count - 1].mark = mark;
}

void table_row_mark(text_table *t, const char *mark)
{
    if (t->count >= t->rows * t->columns && t->rows)
        t->cell[(t->rows - 1) * t->columns].row_mark = mark;
}

/* ---- text -------------------------------------------------------------------------------------- */

static const char *shown(const text_table *t, size_t row, size_t column)
{
    const char *text = t->cell[row * t->columns + column].text;
    return *text || t->kind[column] != TABLE_NUMBER ? text : "-";
}

/* Characters of UTF-8. */
static size_t length_of(const char *text)
{
    size_t length = 0;
    for (; *text; text++)
        length += ((unsigned char)*text & 0xc0) != 0x80;
    return length;
}

/* With spaces before or behind it. */
static void put_padded(FILE *file, const char *text, size_t width, int is_right)
{
    size_t length = length_of(text), spaces = width > length ? width - length : 0;
    fprintf(file, "%*s%s%*s", is_right ? (int)spaces : 0, "", text, is_right ? 0 : (int)spaces, "");
}

/* What a terminal shows: groups by the first column, then a label if the second one holds texts. Labels and groups
 * share the first column of it; the headings stand in the line of each group. */
static void print_text(FILE *file, const text_table *t)
{
    size_t width[TABLE_COLUMNS_MAX] = {0}, first = t->columns > 1 && t->kind[1] == TABLE_TEXT ? 2 : 1;
    for (size_t i = 0; i < t->rows; i++)
        for (size_t k = 0; k < t->columns; k++) {
            size_t *of = &width[k < first ? 0 : k], length = length_of(shown(t, i, k));
            size_t heading = k < first ? 0 : length_of(t->heading[k]);
            length = length > heading ? length : heading;
            *of = length > *of ? length : *of;
        }
    for (size_t i = 0; i < t->rows; i++) {
        int is_new = i == 0 || strcmp(shown(t, i, 0), shown(t, i - 1, 0)) != 0;
        for (int is_body = !is_new; is_body < 2; is_body++) {
            const char *label = !is_body ? shown(t, i, 0) : first > 1 ? shown(t, i, 1) : "";
            fputs(is_body ? "  " : i ? "\n" : "", file);
            put_padded(file, label, width[0] + (is_body ? 0 : 2), 0);
            for (size_t k = first; k < t->columns; k++) {
                fputs("  ", file);
                put_padded(file, is_body ? shown(t, i, k) : t->heading[k], width[k], t->kind[k] == TABLE_NUMBER);
            }
            fputc('\n', file);
        }
    }
}

/* ---- files ------------------------------------------------------------------------------------- */

/* A bar would end the cell, and a line the row. */
static void put_markdown(FILE *file, const char *text, const char *end)
{
    for (; *text; text++) {
        fputs(*text == '|' ? "\\" : "", file);
        fputc(*text == '\n' ? ' ' : *text, file);
    }
    fputs(end, file);
}

static void print_markdown(FILE *file, const text_table *t)
{
    for (size_t k = 0; k < t->columns; k++)
        fprintf(file, k ? " %s |" : "| %s |", t->heading[k]);
    fputs("\n|", file);
    for (size_t k = 0; k < t->columns; k++)
        fputs(t->kind[k] == TABLE_NUMBER ? "--:|" : "---|", file);
    for (size_t i = 0; i < t->count; i++) {
        fputs(i % t->columns ? " " : "\n| ", file);
        put_markdown(file, shown(t, i / t->columns, i % t->columns), " |");
    }
    fputc('\n', file);
}

static void print_csv(FILE *file, const text_table *t)
{
    for (size_t k = 0; k < t->columns; k++)
        fprintf(file, k ? ",%s" : "%s", t->heading[k]);
    for (size_t i = 0; i < t->count; i++) {
        const char *text = t->cell[i].text, *quote = t->kind[i % t->columns] == TABLE_TEXT ? "\"" : "";
        fprintf(file, "%s%s", i % t->columns ? "," : "\n", quote);
        for (; *text; text++)
            fprintf(file, *text == '"' ? "\"%c" : "%c", *text);
        fputs(quote, file);
    }
    fputc('\n', file);
}

/* A number is one that strtod reads whole; infinities are none in JSON. */
static void print_json(FILE *file, const text_table *t)
{
    fputc('[', file);
    for (size_t i = 0; i < t->count; i++) {
        const char *text = t->cell[i].text;
        size_t column = i % t->columns;
        char *end;
        fputs(column ? ", " : i ? "},\n{" : "\n{", file);
        figures_json_text(file, t->heading[column]);
        fputs(": ", file);
        if (t->kind[column] != TABLE_NUMBER)
            figures_json_text(file, text);
        else
            fputs(isfinite(strtod(text, &end)) && end != text && *end == '\0' ? text : "null", file);
    }
    fputs(t->count ? "}\n]\n" : "]\n", file);
}

int table_print(FILE *file, const text_table *t, figures_form form)
{
    static void (*const printers[])(FILE *, const text_table *) = {[FIGURES_TEXT] = print_text,
                                                                   [FIGURES_CSV] = print_csv,
                                                                   [FIGURES_MARKDOWN] = print_markdown,
                                                                   [FIGURES_JSON] = print_json};
    if (!t->failed)
        printers[form](file, t);
    return !t->failed;
}

/* ---- a page ------------------------------------------------------------------------------------ */

static void put_tag(FILE *file, const char *tag, const char *mark)
{
    fprintf(file, mark ? "<%s class=\"%s\">" : "<%s>", tag, mark);
}

int table_print_html(FILE *file, const text_table *t)
{
    if (t->failed)
        return 0;
    fputs("<div class=\"scroll\"><table><thead><tr>", file);
    for (size_t k = 0; k < t->columns; k++) {
        put_tag(file, "th", t->kind[k] == TABLE_NUMBER ? NULL : "text");
        svg_escape(file, t->heading[k]);
        fputs("</th>", file);
    }
    fputs("</tr></thead>\n<tbody>\n", file);
    for (size_t i = 0; i < t->rows; i++) {
        put_tag(file, "tr", t->cell[i * t->columns].row_mark);
        for (size_t k = 0; k < t->columns; k++) {
            put_tag(file, "td", t->kind[k] == TABLE_NUMBER ? t->cell[i * t->columns + k].mark : "text");
            svg_escape(file, shown(t, i, k));
            fputs("</td>", file);
        }
        fputs("</tr>\n", file);
    }
    fputs("</tbody></table></div>\n", file);
    return 1;
}

/* ---- sizes ------------------------------------------------------------------------------------- */

void table_bytes_text(char text[TABLE_BYTES], double bytes)
{
    double power = exp2(round(log2(bytes)));
    double size = fabs(bytes / power - 1) < 0.03 ? power : bytes;
    int is_large = size >= 1048576;
    snprintf(text, TABLE_BYTES, "%.3g %s", size / (is_large ? 1048576 : 1024), is_large ? "MiB" : "KiB");
}
