/* Which methods of which distributions: the rows of a plan. All of them are made, tables too, which takes less than a
 * second; what nobody asked for is neither measured nor timed. */
#include <math.h>
#include <string.h>

#include "evidence/evidence.h"

const table_size table_sizes[SIZES] = {
    {2048, 2, "table 2 KiB, 2 moments"}, {2048, 3, "table 2 KiB, 3 moments"},  {2048, 4, "table 2 KiB, 4 moments"},
    {0, 4, "table by default"},          {4096, 2, "table 4 KiB, 2 moments"},  {4096, 3, "table 4 KiB, 3 moments"},
    {4096, 4, "table 4 KiB, 4 moments"}, {8192, 2, "table 8 KiB, 2 moments"},  {8192, 3, "table 8 KiB, 3 moments"},
    {8192, 4, "table 8 KiB, 4 moments"}, {32768, 4, "table 32 KiB, 4 moments"}};

void subject_begin(subject *s, vndf_source *source, const char *name)
{
    *s = (subject){.source = source};
    snprintf(s->name, sizeof s->name, strlen(name) < sizeof s->name ? "%s" : "%.60s...", name);
}

void subject_free(subject *s)
{
    for (size_t i = 0; i < SIZES; i++)
        vndf_free(s->table[i]);
    vndf_source_free(s->source);
    *s = (subject){.source = NULL};
}

const vndf_distribution *subject_table(subject *s, size_t i, const evidence_plan *plan, vndf_error *error)
{
    const vndf_build_options options = {.max_bytes = table_sizes[i].bytes,
                                        .moments = table_sizes[i].moments,
                                        .progress = progress_show,
                                        .progress_user = plan->progress};
    if (!s->table[i])
        s->table[i] = vndf_build(s->source, &options, NULL, error);
    return s->table[i];
}

/* Adds a row for the method, which it owns then. */
static evidence_row *add(evidence *to, const method_reference *of, method m)
{
    if (!m.each || to->count == ROWS_MAX) {
        method_release(&m);
        return NULL;
    }
    const vndf_info info = vndf_distribution_info(m.d);
    evidence_row *r = &to->row[to->count++];
    *r = (evidence_row){.m = m, .of = of, .variance = {NAN, NAN, NAN}};
    r->law = (block_law){of->canonical.distribution, 0.05f / of->scale, 0.95f / of->scale, NAN, 0};
    for (evidence_column c = 0; c < COLUMNS; c++)
        r->number[c] = NAN;
    if (m.kind != ROW_EFFECT)
        r->number[COL_MEMORY] = (double)m.memory;
    if (info.bytes) {
        r->number[COL_FILE] = (double)info.bytes;
        r->number[COL_MOMENTS] = info.moments;
    }
    return r;
}

static evidence_row *find(evidence *in, const char *name, const method_reference *of)
{
    for (evidence_row *r = in->row; name && r < in->row + in->count; r++)
        if (r->of == of && strcmp(r->m.name, name) == 0)
            return r;
    return NULL;
}

static void add_calls(evidence *to, const method_reference *of, const vndf_distribution *d, const char *name,
                      method_call first, method_call last)
{
    for (method_call call = first; call <= last; call++)
        add(to, of, method_ours(d, name, call));
}

/* The closed forms; all tables, the default one by all calls; and the published ways. */
static void list_normals(evidence *to)
{
    const method_reference *ggx = to->reference, *at_hand = ggx + 2;
    evidence_row *caps = add(to, ggx, method_ggx_caps());
    for (const method_reference *of = ggx; of < at_hand; of++) {
        const vndf_distribution *d = of->canonical.distribution;
        add(to, of, method_all_normals(of));
        add_calls(to, of, d, "closed form", METHOD_SAMPLE, METHOD_SAMPLE);
        add_calls(to, of, d, "closed form", METHOD_SIXTEEN, of == ggx ? METHOD_EXPORTED : METHOD_EIGHT_LOBES);
    }
    for (size_t i = 0; i < SIZES; i++)
        add_calls(to, at_hand, to->plan->at_hand->table[i], table_sizes[i].name, METHOD_SAMPLE,
                  i == SIZE_DEFAULT ? METHOD_EXPORTED : METHOD_SAMPLE);
    add(to, at_hand, method_all_normals(at_hand));
    add(to, at_hand, method_warp(at_hand));
    for (evidence_row *r = to->row; r < to->row + to->count; r++) {
        r->beside = caps;
        r->normals = find(to, "all normals (2007)", r->of);
    }
}

static vndf_status list_materials(evidence *to, const method_reference *of)
{
    const vndf_surface surface = vndf_rough(of->canonical.distribution, to->plan->alpha_x, to->plan->alpha_y);
    for (const effect_set *set = effect_sets; set < effect_sets + effect_set_count; set++) {
        if (set->by_hand && of->canonical.distribution != vndf_ggx())
            continue;
        evidence_row *r = add(to, of, method_effect(set, &surface, to->error));
        if (!r)
            return to->error->status;
        r->law = effect_law(set);
        r->number[COL_ALPHA_X] = (double)surface.xx;
        r->number[COL_ALPHA_Y] = (double)surface.yy;
        r->beside = find(to, effect_sets[EFFECT_BARE].name, of);
        r->normals = find(to, set->visible, of);
    }
    return VNDF_OK;
}

/* Behind a refusal the name, or the word of one, that --only nearly is. */
static const char *near_name(const evidence *all)
{
    char name[64];
    const char *hint = "";
    for (size_t i = 0; i < 2 * all->count && !*hint; i++) {
        snprintf(name, sizeof name, "%s", i % 2 ? all->row[i / 2].m.name : all->row[i / 2].of->name);
        for (const char *word = strtok(name, " ,:()"); word && !*hint; word = strtok(NULL, " ,:()"))
            hint = did_you_mean(all->plan->only, &word, 1);
    }
    return hint;
}

static vndf_status choose(evidence *all)
{
    const char *only = all->plan->only;
    size_t shown = 0;
    for (evidence_row *r = all->row; r < all->row + all->count; r++)
        if (!only || strstr(r->m.name, only) || strstr(r->of->name, only)) {
            evidence_row *const needed[] = {r, r->beside, r->normals};
            for (int i = 0; i < 3; i++)
                if (needed[i])
                    needed[i]->is_needed = 1;
            r->is_shown = 1;
            shown++;
        }
    if (shown)
        return VNDF_OK;
    all->error->status = VNDF_ERROR_ARGUMENT;
    snprintf(all->error->message, sizeof all->error->message, "no %s or distribution has '%.64s' in its name%s",
             all->plan->is_of_materials ? "set of effects" : "method", only, near_name(all));
    return VNDF_ERROR_ARGUMENT;
}

vndf_status evidence_list(evidence *to)
{
    const int is_of_materials = to->plan->is_of_materials;
    subject *s = to->plan->at_hand;
    vndf_status status = VNDF_OK;
    for (size_t i = is_of_materials ? SIZE_DEFAULT : 0; i < (is_of_materials ? SIZE_FINE : SIZES); i++)
        if (!subject_table(s, i, to->plan, to->error))
            return to->error->status;
    to->reference[0] = method_reference_of(vndf_ggx(), "ggx");
    to->reference[1] = method_reference_of(vndf_beckmann(), "beckmann");
    to->reference[2] = method_reference_of(s->table[is_of_materials ? SIZE_DEFAULT : SIZE_FINE], s->name);
    for (int i = 0; i < 3 && is_of_materials && status == VNDF_OK; i++)
        status = list_materials(to, &to->reference[i]);
    if (!is_of_materials)
        list_normals(to);
    return status == VNDF_OK ? choose(to) : status;
}
