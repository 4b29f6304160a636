/* Prints the rows as lists of columns. People get two tables: the costs of the sets, in Markdown with the distributions
 * side by side, and visible beside bounded normals. CSV has every number. */
#include <math.h>
#include <string.h>

#include "bench/effects/effects.h"
#include "draw/table.h"

static const char cost_legend[] =
    "ns: hit and sample, a direction each over the hemisphere (median of turns; spread: half of what lies\n"
    "between quartiles); to bare: ns more than bare reflection in the same turn; shared, eval, pdf: one hit for\n"
    "256; batch: an element of one call for 1024, or 256 that share a hit,\n"
    "with the best instructions here. Of the weights of one direction: mean, part of samples lost, largest,\n"
    "variance; eff: 1/(variance ns) over that of the same with visible normals.\n\n";

static const char variance_legend[] =
    "Bare reflection, the albedo in one direction: variance of the weight with visible normals and with those\n"
    "of them that reflect to above the horizon, ratio of the two, eff: 1/(variance ns) of bounded over visible.\n";

static void percent(text_table *t, const char *heading, double part)
{
    table_number(t, heading, part == 0 ? "%.0f" : "%.2f%%", 100 * part);
}

static void time_or_wrong(text_table *t, const char *heading, const effects_row *r)
{
    if (r->wrong)
        table_figure(t, heading, "wrong");
    else
        table_time(t, heading, r->ns);
}

static void worth_columns(text_table *t, const effects_row *r)
{
    table_number(t, "mean", "%.4f", r->mean);
    percent(t, "lost", r->lost);
    table_number(t, "max", "%.4g", r->max_weight);
    table_number(t, "variance", "%.3e", r->variance);
    table_number(t, "eff", "%.3g", r->efficiency);
}

static void cost_columns(text_table *t, const effects_entry *e)
{
    const effects_row *r = &e->row;
    table_text(t, "distribution", e->distribution);
    table_text(t, "effects", e->subject.set->name);
    time_or_wrong(t, "ns", r);
    table_number(t, "spread", "%.1f%%", 50 * (r->ns_high - r->ns_low) / r->ns);
    table_number(t, "to bare", "%+.1f", r->to_bare);
    table_time(t, "shared", r->shared_ns);
    table_time(t, "eval", r->eval_ns);
    table_time(t, "pdf", r->pdf_ns);
    worth_columns(t, r);
}

/* A pair: visible normals, then bounded. */
static void variance_columns(text_table *t, const effects_entry *pair)
{
    const effects_row *v = &pair[0].row, *b = &pair[1].row;
    table_text(t, "distribution", pair->distribution);
    table_number(t, "alpha", "%.3g", (double)pair->subject.surface.alpha_x);
    table_number(t, "theta", "%.3g", pair->theta);
    table_number(t, "mean", "%.4f", b->mean);
    percent(t, "lost:\nvisible", v->lost);
    percent(t, "lost:\nbounded", b->lost);
    table_number(t, "variance:\nvisible", "%.3e", v->variance);
    table_number(t, "variance:\nbounded", "%.3e", b->variance);
    table_number(t, "ratio", "%.3g", v->variance / b->variance);
    time_or_wrong(t, "ns:\nvisible", v);
    time_or_wrong(t, "ns:\nbounded", b);
    table_number(t, "eff", "%.3g", b->efficiency);
    table_number(t, "max:\nbounded", "%.4g", b->max_weight);
}

/* Every number. */
static void all_columns(text_table *t, const effects_entry *e)
{
    const effects_row *r = &e->row;
    table_text(t, "set", e->subject.set->name);
    table_text(t, "distribution", e->distribution);
    table_value(t, "alpha_x", (double)e->subject.surface.alpha_x);
    table_value(t, "alpha_y", (double)e->subject.surface.alpha_y);
    table_value(t, "directions_theta", e->theta);
    table_value(t, "weight_theta", e->worth_theta);
    table_value(t, "wrong", r->wrong);
    table_value(t, "ns", r->ns);
    table_value(t, "ns_low", r->ns_low);
    table_value(t, "ns_high", r->ns_high);
    table_value(t, "to_bare", r->to_bare);
    table_value(t, "shared_ns", r->shared_ns);
    table_value(t, "eval_ns", r->eval_ns);
    table_value(t, "pdf_ns", r->pdf_ns);
    table_value(t, "mean", r->mean);
    table_value(t, "noise", r->noise);
    table_value(t, "lost", r->lost);
    table_value(t, "max_weight", r->max_weight);
    table_value(t, "variance", r->variance);
    table_value(t, "efficiency", r->efficiency);
}

/* ---- which rows -------------------------------------------------------------------------------- */

static int is_cost(const effects_entry *e)
{
    return e->shown && !e->of_variance;
}

static int is_pair(const effects_entry *e)
{
    return e->shown && e->of_variance && e->visible == EFFECTS_NONE;
}

static int is_shown(const effects_entry *e)
{
    return e->shown;
}

/* Prints nothing at all if there are no rows. */
static int print(FILE *file, const effects_list *list, int (*is_row)(const effects_entry *),
                 void (*columns)(text_table *, const effects_entry *), int (*form)(FILE *, const text_table *),
                 const char *legend)
{
    text_table t = {.rows = 0};
    for (size_t i = 0; i < list->count; i++)
        if (is_row(&list->entry[i])) {
            table_row(&t);
            columns(&t, &list->entry[i]);
        }
    int good = !t.rows || form(file, &t);
    if (t.rows)
        fputs(legend, file);
    table_free(&t);
    return good;
}

/* ---- distributions side by side ---------------------------------------------------------------- */

static const effects_entry *find(const effects_list *list, const char *set, const char *distribution)
{
    for (size_t i = 0; i < list->count; i++) {
        const effects_entry *e = &list->entry[i];
        if (is_cost(e) && strcmp(e->subject.set->name, set) == 0 && strcmp(e->distribution, distribution) == 0)
            return e;
    }
    return NULL;
}

/* Finds the distributions that have costs, in their order. Returns how many. */
static size_t distributions_of(const effects_list *list, const char *of[EFFECTS_DISTRIBUTIONS_MAX])
{
    size_t count = 0;
    for (size_t i = 0; i < list->count; i++) {
        const effects_entry *e = &list->entry[i];
        if (is_cost(e) && (!count || strcmp(of[count - 1], e->distribution) != 0))
            of[count++] = e->distribution;
    }
    return count;
}

/* A row for a set: its costs with each distribution, and its worth with the last one. */
static void side_by_side(text_table *t, const effects_list *list, const char *set, const char *const *of,
                         size_t count)
{
    const effects_entry *e = NULL;
    table_row(t);
    table_text(t, "effects", set);
    for (size_t k = 0; k < count; k++) {
        char heading[256];
        e = find(list, set, of[k]);
        const effects_row *r = e ? &e->row : &effects_nothing;
        snprintf(heading, sizeof heading, "%s: ns", of[k]);
        time_or_wrong(t, heading, r);
        table_time(t, "eval", r->eval_ns);
        table_time(t, "pdf", r->pdf_ns);
    }
    worth_columns(t, e ? &e->row : &effects_nothing);
}

static int print_side_by_side(FILE *file, const effects_list *list)
{
    const char *of[EFFECTS_DISTRIBUTIONS_MAX];
    size_t count = distributions_of(list, of);
    text_table t = {.rows = 0};
    for (size_t i = 0; i < effects_set_count; i++) {
        size_t found = 0;
        for (size_t k = 0; k < count; k++)
            found += find(list, effects_sets[i].name, of[k]) != NULL;
        if (found)
            side_by_side(&t, list, effects_sets[i].name, of, count);
    }
    int good = !t.rows || table_print_markdown(file, &t);
    fputs(t.rows ? "\n" : "", file);
    table_free(&t);
    return good;
}

/* ---- printing ---------------------------------------------------------------------------------- */

int effects_print(FILE *file, const void *list, figures_form form)
{
    if (form == FIGURES_CSV || form == FIGURES_JSON)
        return print(file, list, is_shown, all_columns, form == FIGURES_CSV ? table_print_csv : table_print_json,
                     "");
    if (form == FIGURES_MARKDOWN)
        return print_side_by_side(file, list) &&
               print(file, list, is_pair, variance_columns, table_print_markdown, "");
    return print(file, list, is_cost, cost_columns, table_print_text, cost_legend) &&
           print(file, list, is_pair, variance_columns, table_print_text, variance_legend);
}
