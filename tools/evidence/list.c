/* Which methods of which distributions: the entries of a plan, each made ready if it is wanted or a yardstick. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "evidence/evidence.h"

const table_size table_sizes[SIZES] = {{2048, 2, "table 2 KiB, 2 moments"}, {2048, 3, "table 2 KiB, 3 moments"},
                                       {2048, 4, "table 2 KiB, 4 moments"}, {4096, 2, "table 4 KiB, 2 moments"},
                                       {4096, 3, "table 4 KiB, 3 moments"}, {4096, 4, "table 4 KiB, 4 moments"},
                                       {8192, 2, "table 8 KiB, 2 moments"}, {8192, 3, "table 8 KiB, 3 moments"},
                                       {8192, 4, "table 8 KiB, 4 moments"}, {32768, 4, "table 32 KiB, 4 moments"}};

static const char student[] = "student-t:2.5";

/* The first stands for the scalar calls. */
static const vndf_instructions sets[] = {VNDF_INSTRUCTIONS_BEST, VNDF_INSTRUCTIONS_PORTABLE,
                                         VNDF_INSTRUCTIONS_AVX2, VNDF_INSTRUCTIONS_AVX512};

enum { SETS = sizeof sets / sizeof *sets };

/* ---- subjects ------------------------------------------------------------------------------------ */

void subject_begin(subject *s, vndf_source *source, const char *name)
{
    *s = (subject){.source = source};
    snprintf(s->name, sizeof s->name, "%s", name);
    if (strlen(name) >= sizeof s->name)
        memcpy(s->name + sizeof s->name - 4, "...", 4);
}

void subject_free(subject *s)
{
    for (size_t i = 0; i < SIZES; i++)
        vndf_free(s->table[i]);
    vndf_source_free(s->source);
    *s = (subject){.source = NULL};
}

static int build_progress(double done, const char *what, void *user)
{
    (void)done;
    return !evidence_go_on(user, what);
}

const vndf_distribution *subject_table(subject *s, size_t i, const evidence_plan *plan, vndf_error *error)
{
    evidence_plan asked = *plan;
    const vndf_build_options options = {.max_bytes = table_sizes[i].bytes,
                                        .moments = table_sizes[i].moments,
                                        .progress = build_progress,
                                        .progress_user = &asked};
    if (!s->table[i])
        s->table[i] = vndf_build(s->source, &options, NULL, error);
    return s->table[i];
}

/* ---- entries ------------------------------------------------------------------------------------- */

static int is_wanted(evidence_list *to, const method *m, const char *distribution)
{
    const char *only = to->plan->only;
    return !only || strstr(m->name, only) || strstr(distribution, only) || strstr(m->instructions, only);
}

/* Takes the method, or releases it if it cannot run here or is neither wanted nor a yardstick. */
static entry *add(evidence_list *to, method m, const char *distribution, int is_yardstick)
{
    int is_shown = is_wanted(to, &m, distribution);
    if (!m.each || !(is_shown || is_yardstick) || to->count == ENTRIES_MAX) {
        method_release(&m);
        return NULL;
    }
    entry *e = &to->entry[to->count++];
    *e = (entry){.m = m, .is_shown = is_shown, .variance = {NAN, NAN, NAN}};
    e->row = (evidence_row){.instructions = m.instructions, .kind = m.kind};
    snprintf(e->row.method, sizeof e->row.method, "%s", m.name);
    snprintf(e->row.distribution, sizeof e->row.distribution, "%.63s", distribution);
    for (evidence_column c = 0; c < COLUMNS; c++)
        e->row.number[c] = NAN;
    return e;
}

/* The entry from `from` on of that name. */
static const entry *find(const evidence_list *list, size_t from, const char *name)
{
    for (size_t i = from; name && i < list->count; i++)
        if (strcmp(list->entry[i].m.name, name) == 0)
            return &list->entry[i];
    return NULL;
}

/* ---- normals ------------------------------------------------------------------------------------- */

static void add_normals(evidence_list *to, subject_id of, method m, int is_yardstick)
{
    const char *const names[SUBJECTS] = {"ggx", "beckmann", to->plan->at_hand->name, student};
    entry *e = add(to, m, names[of], is_yardstick);
    if (!e)
        return;
    e->of = of;
    e->row.number[COL_MEMORY] = (double)m.memory;
    if (m.file_bytes) {
        e->row.number[COL_FILE] = (double)m.file_bytes;
        e->row.number[COL_MOMENTS] = m.moments;
    }
}

static void add_closed(evidence_list *to, subject_id of, const vndf_distribution *d)
{
    static const char name[] = "closed form";
    to->reference[of] = method_reference_of(d);
    add_normals(to, of, method_all_normals(&to->reference[of]), 1);
    for (method_call call = METHOD_SAMPLE; call < METHOD_CALLS; call++)
        for (size_t i = 0; i < SETS && (call == METHOD_SAMPLE || call >= METHOD_AFFINE); i++)
            add_normals(to, of, method_ours(d, name, call, sets[i]), 0);
    if (of == OF_GGX)
        add_normals(to, of, method_exported(d, name), 0);
}

/* One of the tables by all its calls up to `last`; it is built if any of them is wanted. */
static vndf_status add_table(evidence_list *to, subject_id of, subject *s, size_t size, method_call last)
{
    const char *name = table_sizes[size].name;
    for (method_call call = METHOD_SAMPLE; call <= last; call++)
        for (size_t i = 0; i < SETS; i++) {
            method m = method_ours(NULL, name, call, sets[i]);
            if (!m.each || !is_wanted(to, &m, s->name))
                continue;
            const vndf_distribution *d = subject_table(s, size, to->plan, to->error);
            if (!d)
                return to->error->status;
            add_normals(to, of, method_ours(d, name, call, sets[i]), 0);
        }
    if (last == METHOD_SAMPLE)
        return VNDF_OK;
    const method exported = method_exported(NULL, name);
    if (is_wanted(to, &exported, s->name) && !subject_table(s, size, to->plan, to->error))
        return to->error->status;
    if (s->table[size])
        add_normals(to, of, method_exported(s->table[size], name), 0);
    return VNDF_OK;
}

/* The tables that are wanted, the published ways for any D, and the fine table, which stands for D. */
static vndf_status add_at_hand(evidence_list *to)
{
    subject *s = to->plan->at_hand;
    size_t before = to->count;
    const method published[] = {method_all_normals(NULL), method_warp(NULL)};
    for (size_t i = 0; i < SIZES; i++) {
        method_call last = i == SIZE_DEFAULT ? METHOD_TWO_LOBES : METHOD_SAMPLE;
        if (add_table(to, AT_HAND, s, i, last) != VNDF_OK)
            return to->error->status;
    }
    if (to->count == before && !is_wanted(to, &published[0], s->name) && !is_wanted(to, &published[1], s->name))
        return VNDF_OK;
    if (!subject_table(s, SIZE_FINE, to->plan, to->error))
        return to->error->status;
    method_reference *reference = &to->reference[AT_HAND];
    *reference = method_reference_of(s->table[SIZE_FINE]);
    add_normals(to, AT_HAND, method_all_normals(reference), 1);
    add_normals(to, AT_HAND, method_warp(reference), 0);
    return VNDF_OK;
}

static vndf_status add_beside(evidence_list *to)
{
    subject *s = &to->student;
    if (strcmp(to->plan->at_hand->name, student) == 0)
        return VNDF_OK;
    vndf_source *source = vndf_source_family(student, to->error);
    if (!source)
        return to->error->status;
    subject_begin(s, source, student);
    vndf_status status = add_table(to, BESIDE, s, SIZE_DEFAULT, METHOD_SAMPLE);
    if (s->table[SIZE_DEFAULT])
        to->reference[BESIDE] = method_reference_of(s->table[SIZE_DEFAULT]);
    return status;
}

static vndf_status make_normals(evidence_list *to)
{
    add_normals(to, OF_GGX, method_ggx_caps(), 1);
    for (size_t i = 1; i < SETS; i++)
        add_normals(to, OF_GGX, method_ggx_caps_batch(sets[i]), 0);
    add_closed(to, OF_GGX, vndf_ggx());
    add_normals(to, OF_BECKMANN, method_beckmann_newton(), 0);
    add_closed(to, OF_BECKMANN, vndf_beckmann());
    vndf_status status = add_at_hand(to);
    if (status == VNDF_OK)
        status = add_beside(to);
    for (entry *e = to->entry; e < to->entry + to->count; e++) {
        const method_reference *r = &to->reference[e->of];
        e->law = (block_law){r->canonical.distribution, 0.05f / r->scale, 0.95f / r->scale, NAN, 0};
        e->beside = &to->entry[0];
        for (const entry *n = to->entry; n < to->entry + to->count; n++)
            if (n->of == e->of && strncmp(n->m.name, "all normals", 11) == 0)
                e->normals = n;
    }
    return status;
}

/* ---- materials ----------------------------------------------------------------------------------- */

/* Whether a set that is wanted is compared with this one. */
static int is_yardstick(evidence_list *to, const effect_set *set)
{
    const char *only = to->plan->only;
    for (size_t i = 0; i < effect_set_count; i++)
        if (effect_sets[i].visible && strcmp(effect_sets[i].visible, set->name) == 0 &&
            (!only || strstr(effect_sets[i].name, only)))
            return 1;
    return set == &effect_sets[EFFECT_BARE];
}

/* The sets of effects of one distribution. */
static vndf_status add_materials(evidence_list *to, const char *name, const vndf_surface *surface)
{
    size_t first = to->count;
    for (const effect_set *set = effect_sets; set < effect_sets + effect_set_count; set++) {
        method m = {.instructions = ""};
        snprintf(m.name, sizeof m.name, "%s", set->name);
        if (!is_wanted(to, &m, name) && !is_yardstick(to, set))
            continue;
        m = method_effect(set, surface, to->error);
        if (!m.each)
            return to->error->status;
        entry *e = add(to, m, name, 1);
        if (!e)
            continue;
        e->law = effect_law(set, NAN);
        e->row.number[COL_ALPHA_X] = (double)surface->alpha_x;
        e->row.number[COL_ALPHA_Y] = (double)surface->alpha_y;
    }
    for (entry *e = to->entry + first; e < to->entry + to->count; e++) {
        e->beside = find(to, first, effect_sets[EFFECT_BARE].name);
        e->normals = find(to, first, effect_find(e->m.name)->visible);
    }
    return VNDF_OK;
}

/* ---- all of it ----------------------------------------------------------------------------------- */

vndf_status evidence_list_make(evidence_list *list, const evidence_plan *plan, vndf_error *error)
{
    list->plan = plan;
    list->error = error;
    vndf_status status = plan->at_hand ? make_normals(list) : VNDF_OK;
    for (size_t i = 0; i < plan->count && status == VNDF_OK; i++) {
        const vndf_surface surface = {plan->of[i].distribution, plan->alpha_x, plan->alpha_y};
        status = add_materials(list, plan->of[i].name, &surface);
    }
    if (status != VNDF_OK)
        return status;
    for (size_t i = 0; i < list->count; i++)
        if (list->entry[i].is_shown)
            return VNDF_OK;
    error->status = VNDF_ERROR_ARGUMENT;
    snprintf(error->message, sizeof error->message, "no %s, distribution or instruction set has '%s' in its name",
             plan->at_hand ? "method" : "set of effects", plan->only);
    return VNDF_ERROR_ARGUMENT;
}

void evidence_list_free(evidence_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        method_release(&list->entry[i].m);
    subject_free(&list->student);
    list->count = 0;
}
