/* All numbers as CSV; and the tables in Markdown, where the costs of all distributions stand side by side. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bench/cells.h"
#include "bench/effects/effects.h"

/* ---- CSV --------------------------------------------------------------------------------------- */

void effects_print_csv(FILE *file, const effects_list *list)
{
    fputs("set,distribution,alpha_x,alpha_y,directions_theta,weight_theta,wrong,ns,ns_low,ns_high,to_bare,"
          "shared_ns,eval_ns,pdf_ns,instructions,mean,noise,lost,max_weight,variance,efficiency\n",
          file);
    for (size_t i = 0; i < list->count; i++) {
        const effects_entry *e = &list->entry[i];
        const effects_row *r = &e->row;
        const vndf_surface *s = &e->subject.surface;
        const double given[] = {(double)s->alpha_x, (double)s->alpha_y, e->theta, e->worth_theta, r->wrong};
        const double found[] = {r->ns,      r->ns_low,     r->ns_high,      r->to_bare,   r->shared_ns,
                                r->eval_ns, r->pdf_ns,     r->instructions, r->mean,      r->noise,
                                r->lost,    r->max_weight, r->variance,     r->efficiency};
        if (!e->shown)
            continue;
        csv_text(file, e->subject.set->name);
        fputc(',', file);
        csv_text(file, e->distribution);
        for (size_t k = 0; k < sizeof given / sizeof *given; k++)
            csv_number(file, given[k]);
        for (size_t k = 0; k < sizeof found / sizeof *found; k++)
            csv_number(file, found[k]);
        fputs("\n", file);
    }
}

/* ---- costs in Markdown ------------------------------------------------------------------------- */

/* Entries of one set stand in the order of the distributions. */
static const effects_entry *find(const effects_list *list, const char *set, const char *distribution)
{
    for (size_t i = 0; i < list->count; i++) {
        const effects_entry *e = &list->entry[i];
        if (e->shown && !e->of_variance && strcmp(e->subject.set->name, set) == 0 &&
            strcmp(e->distribution, distribution) == 0)
            return e;
    }
    return NULL;
}

/* The distributions that have rows, in their order. Returns how many. */
static size_t distributions_of(const effects_list *list, const char *of[EFFECTS_DISTRIBUTIONS_MAX])
{
    size_t count = 0;
    for (size_t i = 0; i < list->count; i++) {
        const effects_entry *e = &list->entry[i];
        if (e->shown && !e->of_variance && (!count || strcmp(of[count - 1], e->distribution) != 0))
            of[count++] = e->distribution;
    }
    return count;
}

static void cell(FILE *file, const char *format, double x)
{
    char text[CELL];
    cell_number(text, format, x);
    fprintf(file, " %s |", text);
}

static void time_cell(FILE *file, double ns)
{
    char text[CELL];
    cell_time(text, ns);
    fprintf(file, " %s |", text);
}

static void put_costs(FILE *file, const effects_row *r)
{
    if (!r || r->wrong) {
        fputs(r ? " wrong | - | - | - |" : " - | - | - | - |", file);
        return;
    }
    time_cell(file, r->ns);
    cell(file, "%.0f", r->instructions);
    time_cell(file, r->eval_ns);
    time_cell(file, r->pdf_ns);
}

static void put_worth(FILE *file, const effects_row *r)
{
    cell(file, "%.3f", r ? r->mean : NAN);
    cell(file, "%.1f%%", r ? 100 * r->lost : NAN);
    cell(file, "%.3g", r ? r->max_weight : NAN);
    cell(file, "%.2g", r ? r->variance : NAN);
    cell(file, "%.2f", r ? r->efficiency : NAN);
}

static void put_cost_row(FILE *file, const effects_list *list, const char *set, const char *const *of,
                         size_t count)
{
    const effects_entry *last = NULL;
    size_t found = 0;
    for (size_t k = 0; k < count; k++)
        found += find(list, set, of[k]) != NULL;
    if (!found)
        return;
    fprintf(file, "| %s |", set);
    for (size_t k = 0; k < count; k++) {
        last = find(list, set, of[k]);
        put_costs(file, last ? &last->row : NULL);
    }
    put_worth(file, last ? &last->row : NULL);
    fputs("\n", file);
}

static void print_costs(FILE *file, const effects_list *list)
{
    const char *of[EFFECTS_DISTRIBUTIONS_MAX];
    size_t count = distributions_of(list, of);
    if (!count)
        return;
    fputs("| effects |", file);
    for (size_t k = 0; k < count; k++) {
        fputs(" ", file);
        markdown_text(file, of[k]);
        fputs(": ns | instr | eval | pdf |", file);
    }
    fputs(" mean | lost | max | variance | eff |\n|---|", file);
    for (size_t k = 0; k < 4 * count + 5; k++)
        fputs("--:|", file);
    fputs("\n", file);
    for (size_t i = 0; i < effects_set_count; i++)
        put_cost_row(file, list, effects_sets[i].name, of, count);
    fputs("\n", file);
}

/* ---- variance in Markdown ---------------------------------------------------------------------- */

static void put_pair(FILE *file, const effects_entry *pair)
{
    const effects_row *v = &pair[0].row, *b = &pair[1].row;
    fputs("| ", file);
    markdown_text(file, pair->distribution);
    fputs(" |", file);
    cell(file, "%.3g", (double)pair->subject.surface.alpha_x);
    cell(file, "%.3g", pair->theta);
    cell(file, "%.1f%%", 100 * v->lost);
    cell(file, "%.1f%%", 100 * b->lost);
    cell(file, "%.3g", v->variance);
    cell(file, "%.3g", b->variance);
    time_cell(file, v->ns);
    time_cell(file, b->ns);
    cell(file, "%.3g", b->efficiency);
    fputs("\n", file);
}

static void print_variances(FILE *file, const effects_list *list)
{
    int begun = 0;
    for (size_t i = 0; i < list->count; i++) {
        const effects_entry *e = &list->entry[i];
        if (!e->shown || !e->of_variance || e->visible != EFFECTS_NONE)
            continue;
        if (!begun)
            fputs("| distribution | alpha | theta | lost: visible | bounded | variance: visible | bounded |"
                  " ns: visible | bounded | eff |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n",
                  file);
        begun = 1;
        put_pair(file, e);
    }
}

void effects_print_markdown(FILE *file, const effects_list *list)
{
    print_costs(file, list);
    print_variances(file, list);
}
