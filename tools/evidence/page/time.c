/* What a caller pays: a bar for each way to call, of the table that is advised, of Student-T beside it, of
 * closed forms and of published methods; and below it every row that was measured. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "draw/svg.h"
#include "evidence/page/report.h"

enum { WAYS = 4, LINES_MAX = 8 };

static const char *const ways[WAYS] = {"one by one, a direction each", "one by one, one direction for many",
                                       "in a batch, a direction each", "in a batch, one direction for all"};

typedef struct line {
    char name[96];
    double ns[WAYS];
} line;

static double number_of(const evidence_row *r, evidence_column c)
{
    return r ? r->number[c] : (double)NAN;
}

/* The two names differ where a batch is another method. */
static line line_of(const report *r, const char *name, const char *called, const char *distribution)
{
    char batch[80];
    line l;
    snprintf(batch, sizeof batch, "%s, batch", called);
    snprintf(l.name, sizeof l.name, "%s", name);
    const evidence_row *one = report_row(r, called, distribution, "scalar");
    const evidence_row *many = report_row(r, batch, distribution, r->batch);
    l.ns[0] = number_of(one, COL_NS);
    l.ns[1] = number_of(one, COL_SHARED);
    l.ns[2] = number_of(many, COL_NS);
    l.ns[3] = number_of(many, COL_SHARED);
    return l;
}

static size_t lines_of(const report *r, line lines[LINES_MAX])
{
    const report_subject *s = &r->subject[0];
    const char *table = table_sizes[s->chosen].name, *standard = table_sizes[SIZE_DEFAULT].name;
    char name[96];
    size_t count = 0;
    snprintf(name, sizeof name, "%.50s, advised", s->of.name);
    lines[count++] = line_of(r, name, table, s->of.name);
    snprintf(name, sizeof name, "%.50s, 8 KiB", s->of.name);
    lines[count++] = line_of(r, name, standard, s->of.name);
    if (strcmp(s->of.name, "student-t:2.5") != 0)
        lines[count++] = line_of(r, "student-t:2.5, 8 KiB", standard, "student-t:2.5");
    lines[count++] = line_of(r, "vndf_ggx()", "closed form", "ggx");
    lines[count++] = line_of(r, "vndf_beckmann()", "closed form", "beckmann");
    lines[count++] = line_of(r, "GGX, spherical caps", "spherical caps (2023)", "ggx");
    lines[count++] = line_of(r, "inverse CDFs, 2 x 256²", "inverse CDFs (2014), 2 x 256^2", s->of.name);
    lines[count++] = line_of(r, "bilinear warps, 8 x 128²", "bilinear warps, 8 x 128^2", s->of.name);
    return count;
}

enum { LEFT = 270, WIDE = 660, RIGHT = 70, BAR = 11, TOP = 30 };

static void draw_line(FILE *file, const line *l, double *y, double per_ns)
{
    double first = *y;
    for (int way = 0; way < WAYS; way++)
        if (l->ns[way] > 0) {
            fprintf(
                file,
                "<rect class=\"f%d\" x=\"%d\" y=\"%.1f\" width=\"%.1f\" height=\"%d\"/>\n<text class=\"tick quiet\" "
                "x=\"%.1f\" y=\"%.1f\">%.*f</text>\n",
                way, LEFT, *y, l->ns[way] * per_ns, BAR - 2, LEFT + l->ns[way] * per_ns + 5, *y + BAR - 2,
                l->ns[way] < 10, l->ns[way]);
            *y += BAR;
        }
    fprintf(file, "<text class=\"ink\" text-anchor=\"end\" x=\"%d\" y=\"%.1f\">", LEFT - 8, (first + *y) / 2 + 4);
    svg_escape(file, l->name);
    fputs("</text>\n", file);
    *y += 10;
}

static void draw_times(FILE *file, const line *lines, size_t count)
{
    double most = 1, y = TOP, height = TOP;
    for (size_t i = 0; i < count; i++) {
        for (int way = 0; way < WAYS; way++) {
            most = fmax(most, lines[i].ns[way] > 0 ? lines[i].ns[way] : 0);
            height += lines[i].ns[way] > 0 ? BAR : 0;
        }
        height += 10;
    }
    fprintf(file,
            "<svg class=\"chart\" width=\"%d\" height=\"%.0f\" viewBox=\"0 0 %d %.0f\" role=\"img\" "
            "aria-label=\"nanoseconds per sample\">\n",
            LEFT + WIDE + RIGHT, height, LEFT + WIDE + RIGHT, height);
    for (int way = 0; way < WAYS; way++)
        fprintf(file,
                "<rect class=\"f%d\" x=\"%d\" y=\"4\" width=\"14\" height=\"12\"/>\n<text class=\"ink\" x=\"%d\" "
                "y=\"14\">%s</text>\n",
                way, 10 + 245 * way, 30 + 245 * way, ways[way]);
    for (size_t i = 0; i < count; i++)
        draw_line(file, &lines[i], &y, WIDE / most);
    fputs("</svg>\n", file);
}

int report_times(html_page *page, const report *r)
{
    line lines[LINES_MAX];
    size_t count = lines_of(r, lines);
    page_section(
        page, "time", "What a sample costs",
        "Nanoseconds that a caller pays for view, sample and density: medians over turns in which all methods "
        "run one after the other, one thread, data in cache. Time hardly depends on D.");
    fputs("<figure class=\"scroll wide\">\n", page->html);
    draw_times(page->html, lines, count);
    fputs("</figure>\n<details><summary>Every method</summary>\n", page->html);
    int good = evidence_print_html(page->html, &r->rows);
    fputs("</details>\n", page->html);
    FILE *data = good ? page_file_begin(page, "methods.csv") : NULL;
    good = data && evidence_print(data, &r->rows, FIGURES_CSV) &&
           page_data_end(page, "all methods, as vndf bench -o FILE.csv has them");
    page_section_end(page);
    return good;
}
