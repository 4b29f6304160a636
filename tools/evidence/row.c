/* The one list of columns, which every printer reads. */
#include "evidence/method.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "draw/table.h"

/* How a column is named and shown to people; without a heading it is for files alone. A terminal has no room for
 * those that are wide. */
enum { NUMBER, TIME, BYTES, WIDE = 4 };

static const struct {
    const char *key, *heading, *format;
    double factor;
    int style;
} columns[COLUMNS] = {
    [COL_ALPHA_X] = {"alpha_x", "alpha", "%.3g", 1, NUMBER},
    [COL_ALPHA_Y] = {"alpha_y", NULL, NULL, 1, NUMBER},
    [COL_MEMORY] = {"memory", "memory", NULL, 1, BYTES | WIDE},
    [COL_FILE] = {"file_bytes", "file", NULL, 1, BYTES | WIDE},
    [COL_MOMENTS] = {"moments", NULL, NULL, 1, NUMBER},
    [COL_WRONG] = {"wrong", NULL, NULL, 1, NUMBER},
    [COL_NS] = {"ns", "ns", NULL, 1, TIME},
    [COL_SPREAD] = {"spread", "spread", "%.1f%%", 100, NUMBER | WIDE},
    [COL_RATIO] = {"ratio", "ratio", "%.3g", 1, NUMBER},
    [COL_SHARED] = {"shared_ns", "shared", NULL, 1, TIME},
    [COL_EVAL] = {"eval_ns", "eval", NULL, 1, TIME},
    [COL_PDF] = {"pdf_ns", "pdf", NULL, 1, TIME},
    [COL_TV] = {"tv", "TV", "%.1e", 1, NUMBER},
    [COL_TV_BELOW] = {"tv_below", "below", "%.1e", 1, NUMBER | WIDE},
    [COL_WEIGHT] = {"max_weight", "weight", "%.4g", 1, NUMBER},
    [COL_SOBOL] = {"stratified", "Sobol'", "%.2f", 1, NUMBER},
    [COL_EFF_60] = {"efficiency_60", "eff 60", "%.3g", 1, NUMBER | WIDE},
    [COL_EFF_85] = {"efficiency_85", "eff 85", "%.3g", 1, NUMBER | WIDE},
    [COL_EFF_LIGHT] = {"efficiency_light", "eff light", "%.3g", 1, NUMBER | WIDE},
    [COL_MEAN] = {"mean", "mean", "%.4f", 1, NUMBER | WIDE},
    [COL_NOISE] = {"noise", NULL, NULL, 1, NUMBER},
    [COL_LOST] = {"lost", "lost", "%.2f%%", 100, NUMBER | WIDE},
    [COL_VARIANCE] = {"variance", "variance", "%.2e", 1, NUMBER},
    [COL_EFF_VISIBLE] = {"efficiency", "eff", "%.3g", 1, NUMBER},
};

static const char legend_normals[] =
    "set: of instructions. memory: bytes of its tables when loaded; file: of a table of ours on disk.\n"
    "ns: view, sample and density, a direction each (median of turns; spread: half of what lies between\n"
    "quartiles); ratio: to spherical caps; shared: 256 samples of one direction.\n"
    "TV, below: largest total variation to the true visible normals from above the horizon and from all\n"
    "directions; weight: largest true over drawn density. Sobol': RMSE of 64 scrambled Sobol' points\n"
    "over that of spherical caps. eff: 1/(variance time) over that of all normals, for the albedo of\n"
    "gold at 60 and 85 degrees and under a small light.\n";

static const char legend_effects[] =
    "ns: hit and sample, a direction each (median of turns; spread: half of what lies between\n"
    "quartiles); ratio: to bare reflection; shared, eval, pdf: one hit for 256. Of the weights from one\n"
    "direction: the largest, mean, part of samples lost, variance; eff: 1/(variance ns) over that of the\n"
    "same with visible normals.\n";

void rows_free(evidence_rows *of)
{
    free(of->row);
    *of = (evidence_rows){NULL, 0};
}

/* ---- for people ---------------------------------------------------------------------------------- */

static void put_cell(text_table *t, const evidence_row *r, evidence_column c)
{
    double x = r->number[c] * columns[c].factor;
    const char *heading = columns[c].heading;
    if (c == COL_NS && r->number[COL_WRONG] > 0)
        table_figure(t, heading, "wrong");
    else if ((columns[c].style & ~WIDE) == TIME)
        table_time(t, heading, x);
    else if ((columns[c].style & ~WIDE) == BYTES)
        table_number(t, heading, x >= 10240 ? "%.0f KiB" : "%.0f", x >= 10240 ? x / 1024 : x);
    else
        table_number(t, heading, fabs(x) < 1e-9 ? "%.0f" : columns[c].format, x);
}

/* Whether a reader is shown the column: some row has a number in it. */
static int is_shown(const evidence_rows *all, evidence_column c, int is_wide)
{
    for (size_t i = 0; i < all->count; i++)
        if (!isnan(all->row[i].number[c]))
            return columns[c].heading && (is_wide || !(columns[c].style & WIDE));
    return 0;
}

static void put_row(text_table *t, const evidence_rows *all, const evidence_row *r, int is_wide)
{
    table_text(t, "distribution", r->distribution);
    table_text(t, r->kind == ROW_EFFECT ? "effects" : "method", r->method);
    table_word(t, "set", r->instructions);
    for (evidence_column c = 0; c < COLUMNS; c++)
        if (is_shown(all, c, is_wide))
            put_cell(t, r, c);
}

/* Every number, for files. */
static void put_whole_row(text_table *t, const evidence_row *r)
{
    static const char *const kinds[] = {"published", "closed", "table", "exported", "call", "effects"};
    table_text(t, "method", r->method);
    table_text(t, "distribution", r->distribution);
    table_word(t, "instructions", r->instructions);
    table_word(t, "kind", kinds[r->kind]);
    for (evidence_column c = 0; c < COLUMNS; c++)
        table_number(t, columns[c].key, "%.6g", r->number[c]);
}

int evidence_print(FILE *file, const evidence_rows *all, figures_form form)
{
    const int is_whole = form == FIGURES_CSV || form == FIGURES_JSON;
    text_table t = {.rows = 0};
    for (const evidence_row *r = all->row; r < all->row + all->count; r++) {
        table_row(&t);
        if (is_whole)
            put_whole_row(&t, r);
        else
            put_row(&t, all, r, form != FIGURES_TEXT);
    }
    int good = table_print(file, &t, form);
    table_free(&t);
    if (good && !is_whole)
        good = fprintf(file, "\n%s", all->row[0].kind == ROW_EFFECT ? legend_effects : legend_normals) > 0;
    return good;
}
