/* The two tables for people: costs of the sets by distribution, and plain visible beside bounded normals. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bench/cells.h"
#include "bench/effects/effects.h"

enum { COLUMNS = 12 };

typedef struct cells {
    char of[COLUMNS][CELL];
} cells;

static const char *const cost_headings[COLUMNS] = {"ns",    "spread", "to bare", "shared", "eval",     "pdf",
                                                   "instr", "mean",   "lost",    "max",    "variance", "eff"};
static const char *const variance_headings[COLUMNS] = {"alpha",    "theta", "mean", "lost", "lost", "variance",
                                                       "variance", "ratio", "ns",   "ns",   "eff",  "max"};
static const char *const variance_of[COLUMNS] = {"",        "", "",        "visible", "bounded", "visible",
                                                 "bounded", "", "visible", "bounded", "",        "bounded"};

static const char cost_legend[] =
    "ns: hit and sample, a direction each over the hemisphere (median of turns; spread: half of what lies\n"
    "between quartiles); to bare: ns more than bare reflection in the same turn; shared, eval, pdf: one hit for\n"
    "256; instr: instructions of hit and sample. Of the weights of one direction: mean, part of samples lost,\n"
    "largest, variance; eff: 1/(variance ns) over that of the same with visible normals.\n";

static const char variance_legend[] =
    "Bare reflection, the albedo in one direction: variance of the weight with visible normals and with those\n"
    "of them that reflect to above the horizon, ratio of the two, eff: 1/(variance ns) of bounded over visible.\n";

static void percent(char cell[CELL], double part)
{
    cell_number(cell, part == 0 ? "%.0f" : "%.2f%%", 100 * part);
}

static void fill_cost(cells *c, const effects_row *r)
{
    cell_time(c->of[0], r->ns);
    cell_number(c->of[1], "%.1f%%", 50 * (r->ns_high - r->ns_low) / r->ns);
    cell_number(c->of[2], "%+.1f", r->to_bare);
    cell_time(c->of[3], r->shared_ns);
    cell_time(c->of[4], r->eval_ns);
    cell_time(c->of[5], r->pdf_ns);
    cell_number(c->of[6], "%.0f", r->instructions);
    cell_number(c->of[7], "%.4f", r->mean);
    percent(c->of[8], r->lost);
    cell_number(c->of[9], "%.4g", r->max_weight);
    cell_number(c->of[10], "%.3e", r->variance);
    cell_number(c->of[11], "%.3g", r->efficiency);
    if (r->wrong)
        snprintf(c->of[0], CELL, "wrong");
}

/* A pair: visible normals, then bounded. */
static void fill_variance(cells *c, const effects_entry *pair)
{
    const effects_row *v = &pair[0].row, *b = &pair[1].row;
    cell_number(c->of[0], "%.3g", (double)pair->subject.surface.alpha_x);
    cell_number(c->of[1], "%.3g", pair->theta);
    cell_number(c->of[2], "%.4f", b->mean);
    percent(c->of[3], v->lost);
    percent(c->of[4], b->lost);
    cell_number(c->of[5], "%.3e", v->variance);
    cell_number(c->of[6], "%.3e", b->variance);
    cell_number(c->of[7], "%.3g", v->variance / b->variance);
    cell_time(c->of[8], v->ns);
    cell_time(c->of[9], b->ns);
    cell_number(c->of[10], "%.3g", b->efficiency);
    cell_number(c->of[11], "%.4g", b->max_weight);
    if (v->wrong | b->wrong)
        snprintf(c->of[7], CELL, "wrong");
}

/* ---- text -------------------------------------------------------------------------------------- */

static void text_row(FILE *file, int width, const char *name, const cells *c)
{
    fprintf(file, "  %-*s", width, name);
    for (int k = 0; k < COLUMNS; k++)
        fprintf(file, " %9s", c->of[k]);
    fputs("\n", file);
}

static void text_heading(FILE *file, int width, const char *name, const char *const *headings)
{
    fprintf(file, "%-*s  ", width, name);
    for (int k = 0; k < COLUMNS; k++)
        fprintf(file, " %9s", headings[k]);
    fputs("\n", file);
}

static int is_cost(const effects_entry *e)
{
    return e->shown && !e->of_variance;
}

static int is_pair(const effects_entry *e)
{
    return e->shown && e->of_variance && e->visible == EFFECTS_NONE;
}

/* The first of a distribution's rows in its table. */
static int is_first(const effects_list *list, size_t i, int of_variance)
{
    for (size_t before = i; before-- > 0;)
        if (list->entry[before].shown && list->entry[before].of_variance == of_variance)
            return strcmp(list->entry[before].distribution, list->entry[i].distribution) != 0;
    return 1;
}

static void print_costs(FILE *file, const effects_list *list, int width)
{
    size_t printed = 0;
    for (size_t i = 0; i < list->count; i++) {
        const effects_entry *e = &list->entry[i];
        cells c;
        if (!is_cost(e))
            continue;
        if (!printed++ || is_first(list, i, 0))
            text_heading(file, width, e->distribution, cost_headings);
        fill_cost(&c, &e->row);
        text_row(file, width, e->subject.set->name, &c);
    }
    if (printed)
        fprintf(file, "%s\n", cost_legend);
}

static void print_variances(FILE *file, const effects_list *list, int width)
{
    size_t printed = 0;
    for (size_t i = 0; i < list->count; i++) {
        const effects_entry *e = &list->entry[i];
        cells c;
        if (!is_pair(e))
            continue;
        if (!printed++ || is_first(list, i, 1)) {
            text_heading(file, width, e->distribution, variance_headings);
            text_heading(file, width, "", variance_of);
        }
        fill_variance(&c, e);
        text_row(file, width, "", &c);
    }
    if (printed)
        fputs(variance_legend, file);
}

void effects_print_text(FILE *file, const effects_list *list)
{
    int width = 0;
    for (size_t i = 0; i < list->count; i++)
        if (list->entry[i].shown)
            width = cell_wider(cell_wider(width, list->entry[i].subject.set->name), list->entry[i].distribution);
    print_costs(file, list, width);
    print_variances(file, list, width);
}
