/* The one list of columns, which every printer reads. */
#include <math.h>
#include <string.h>

#include "evidence/evidence.h"

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
    [COL_PORTABLE] = {"portable_ns", "batch", NULL, 1, TIME},
    [COL_AVX2] = {"avx2_ns", "avx2", NULL, 1, TIME},
    [COL_AVX512] = {"avx512_ns", "avx512", NULL, 1, TIME},
    [COL_SHARED] = {"shared_ns", "shared", NULL, 1, TIME},
    [COL_EVAL] = {"eval_ns", "eval", NULL, 1, TIME},
    [COL_PDF] = {"pdf_ns", "pdf", NULL, 1, TIME},
    [COL_SPREAD] = {"spread", "spread", "%.1f%%", 100, NUMBER | WIDE},
    [COL_RATIO] = {"ratio", "ratio", "%.3g", 1, NUMBER},
    [COL_TV] = {"tv", "TV", "%.1e", 1, NUMBER},
    [COL_TV_BELOW] = {"tv_below", "below", "%.1e", 1, NUMBER | WIDE},
    [COL_WEIGHT] = {"max_weight", "weight", "%.4g", 1, NUMBER},
    [COL_SOBOL] = {"stratified", "Sobol'", "%.2f", 1, NUMBER | WIDE},
    [COL_EFF_60] = {"efficiency_60", "eff 60", "%.3g", 1, NUMBER | WIDE},
    [COL_EFF_85] = {"efficiency_85", "eff 85", "%.3g", 1, NUMBER | WIDE},
    [COL_EFF_LIGHT] = {"efficiency_light", "eff light", "%.3g", 1, NUMBER | WIDE},
    [COL_MEAN] = {"mean", "mean", "%.4f", 1, NUMBER | WIDE},
    [COL_NOISE] = {"noise", NULL, NULL, 1, NUMBER},
    [COL_LOST] = {"lost", "lost", "%.2f%%", 100, NUMBER | WIDE},
    [COL_VARIANCE] = {"variance", "variance", "%.2e", 1, NUMBER},
    [COL_EFF_VISIBLE] = {"efficiency", "eff", "%.3g", 1, NUMBER},
};

const char evidence_legend[] =
    "ns: view, sample and density, a direction each (median of turns; spread: half of what lies between\n"
    "quartiles); batch, avx2, avx512: the same by batches, compiled for every machine and for these;\n"
    "shared: 256 samples of one direction; ratio: to spherical caps. memory: bytes of its tables when\n"
    "loaded; file: of a table of ours on disk. TV, below: largest total variation to the true visible\n"
    "normals from above the horizon and from all directions; weight: largest true over drawn density.\n"
    "Sobol': RMSE of 64 scrambled Sobol' points over that of spherical caps. eff: 1/(variance time) over\n"
    "that of all normals, for the albedo of gold at 60 and 85 degrees and under a small light.\n";

static const char legend_materials[] =
    "ns: hit and sample, a direction each (median of turns; spread: half of what lies between\n"
    "quartiles); batch, avx2, avx512: the same by batches, compiled for every machine and for these;\n"
    "shared, eval, pdf: one hit for 256; ratio: to bare reflection. Of the weights from one direction:\n"
    "the largest, mean, part of samples lost, variance; eff: 1/(variance ns) over that of the same with\n"
    "visible normals.\n";

static void put_cell(figures *t, const evidence_row *r, evidence_column c)
{
    double x = r->number[c] * columns[c].factor;
    const char *heading = columns[c].heading;
    if (c == COL_NS && r->number[COL_WRONG] > 0)
        figures_add(t, FIGURE_NUMBER, heading, "wrong");
    else if ((columns[c].style & ~WIDE) == TIME)
        figures_time(t, heading, x);
    else if ((columns[c].style & ~WIDE) == BYTES)
        figures_number(t, heading, x >= 10240 ? "%.0f KiB" : "%.0f", x >= 10240 ? x / 1024 : x, "");
    else
        figures_number(t, heading, fabs(x) < 1e-9 ? "%.0f" : columns[c].format, x, "");
}

/* Whether a reader is shown the column: some row has a number in it. */
static int is_told(const evidence *all, evidence_column c, int is_wide)
{
    for (const evidence_row *r = all->row; r < all->row + all->count; r++)
        if (r->is_shown && !isnan(r->number[c]))
            return columns[c].heading && (is_wide || !(columns[c].style & WIDE));
    return 0;
}

figures evidence_table(const evidence *all, figures_form form)
{
    static const char *const kinds[] = {"published", "closed", "table", "exported", "call", "effects"};
    const int is_whole = form == FIGURES_CSV || form == FIGURES_JSON, is_of_materials = all->plan->is_of_materials;
    figures t = {.rows = 0};
    for (const evidence_row *r = all->row; r < all->row + all->count; r++) {
        if (!r->is_shown)
            continue;
        figures_record(&t);
        figures_text(&t, "distribution", r->of->name);
        figures_text(&t, is_of_materials && !is_whole ? "effects" : "method", r->m.name);
        if (is_whole)
            figures_add(&t, FIGURE_WORD, "kind", kinds[r->m.kind]);
        for (evidence_column c = 0; c < COLUMNS; c++)
            if (is_whole)
                figures_number(&t, columns[c].key, "%.6g", r->number[c], "");
            else if (is_told(all, c, form != FIGURES_TEXT))
                put_cell(&t, r, c);
    }
    return t;
}

int evidence_print(FILE *file, const evidence *all, figures_form form)
{
    figures t = evidence_table(all, form);
    int good = figures_print(file, &t, form);
    figures_free(&t);
    if (good && (form == FIGURES_TEXT || form == FIGURES_MARKDOWN))
        good = fprintf(file, "\n%s", all->plan->is_of_materials ? legend_materials : evidence_legend) > 0;
    return good;
}
