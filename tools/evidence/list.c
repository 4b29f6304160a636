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

static const char closed_name[] = "closed form", student[] = "student-t:2.5", variance[] = "variance";

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

typedef struct maker {
    evidence_list *list;
    const evidence_plan *plan;
    vndf_error *error;
} maker;

static int is_in(const char *text, const char *only)
{
    return !only || strstr(text, only) != NULL;
}

/* Room for one more; 0 and an error if there is none. */
static int make_room(evidence_list *list, vndf_error *error)
{
    enum { STEP = 64 };
    entry *room = list->entry;
    if (list->count % STEP == 0)
        room = realloc(list->entry, (list->count + STEP) * sizeof *room);
    if (room)
        list->entry = room;
    else
        *error = (vndf_error){VNDF_ERROR_MEMORY, "no memory"};
    return room != NULL;
}

/* Takes the method, or releases it if it cannot run here, is neither wanted nor a yardstick, or there is no room. */
static entry *add(const maker *to, method m, const char *distribution, int is_yardstick)
{
    const char *only = to->plan->only;
    int is_shown = is_in(m.name, only) || is_in(distribution, only) || is_in(m.instructions, only);
    if (!m.each || !(is_shown || is_yardstick) || !make_room(to->list, to->error)) {
        method_release(&m);
        return NULL;
    }
    entry *e = &to->list->entry[to->list->count++];
    *e = (entry){.m = m, .is_shown = is_shown, .beside = NO_ENTRY, .visible = NO_ENTRY};
    e->row = (evidence_row){.instructions = m.instructions, .kind = m.kind};
    snprintf(e->row.method, sizeof e->row.method, "%s", m.name);
    snprintf(e->row.distribution, sizeof e->row.distribution, "%.63s", distribution);
    for (evidence_column c = 0; c < COLUMNS; c++)
        e->row.number[c] = NAN;
    for (int k = 0; k < 3; k++)
        e->variance[k] = NAN;
    return e;
}

static int find(const evidence_list *list, size_t from, const char *name, const char *instructions)
{
    for (size_t i = from; name && i < list->count; i++)
        if (strncmp(list->entry[i].m.name, name, strlen(name)) == 0 &&
            strcmp(list->entry[i].m.instructions, instructions) == 0)
            return (int)i;
    return NO_ENTRY;
}

/* ---- normals ------------------------------------------------------------------------------------- */

static void add_normals(const maker *to, subject_id of, method m, int is_yardstick)
{
    static const char *const names[SUBJECTS] = {"ggx", "beckmann", NULL, student};
    const char *name = of == AT_HAND ? to->plan->at_hand->name : names[of];
    entry *e = add(to, m, m.kind == ROW_MOVE ? "-" : name, is_yardstick);
    if (!e)
        return;
    e->of = of;
    e->row.number[COL_MEMORY] = (double)m.memory;
    if (m.file_bytes) {
        e->row.number[COL_FILE] = (double)m.file_bytes;
        e->row.number[COL_MOMENTS] = m.moments;
    }
}

static void add_ours(const maker *to, subject_id of, const vndf_distribution *d, const char *name,
                     method_call first, method_call last)
{
    for (method_call call = first; call <= last; call++)
        for (size_t i = 0; i < SETS; i++)
            add_normals(to, of, method_ours(d, name, call, sets[i]), 0);
}

static void add_closed(const maker *to)
{
    add_normals(to, OF_GGX, method_ggx_caps(), 1);
    for (size_t i = 1; i < SETS; i++)
        add_normals(to, OF_GGX, method_ggx_caps_batch(sets[i]), 0);
    add_normals(to, OF_GGX, method_ggx_all_normals(), 1);
    add_ours(to, OF_GGX, vndf_ggx(), closed_name, METHOD_SAMPLE, METHOD_SAMPLE);
    add_normals(to, OF_GGX, method_exported(vndf_ggx(), closed_name), 0);
    add_ours(to, OF_GGX, vndf_ggx(), closed_name, METHOD_DIAGONAL, METHOD_TWO_LOBES);
    for (size_t i = 1; i < SETS; i++)
        add_normals(to, OF_GGX, method_move(sets[i]), 0);
    add_normals(to, OF_BECKMANN, method_beckmann_newton(), 0);
    add_normals(to, OF_BECKMANN, method_beckmann_all_normals(), 1);
    add_ours(to, OF_BECKMANN, vndf_beckmann(), closed_name, METHOD_SAMPLE, METHOD_SAMPLE);
    add_ours(to, OF_BECKMANN, vndf_beckmann(), closed_name, METHOD_DIAGONAL, METHOD_TWO_LOBES);
}

/* The published ways for any D. */
static method (*const any_methods[])(const method_reference *) = {method_any_all_normals, method_inverse_tables,
                                                                  method_warp};

enum { ANY_METHODS = sizeof any_methods / sizeof *any_methods };

/* Whether any row of a table, by whatever call and set of instructions, is asked for. */
static int table_wanted(const char *only, const char *subject_name, size_t i, int has_calls)
{
    char names[200];
    snprintf(names, sizeof names, "%s, batch, exported C%s", table_sizes[i].name,
             has_calls ? ": weight: pdf: invert: ndf: lambda: diagonal: affine: mixture" : "");
    return is_in(names, only) || is_in(subject_name, only) || is_in("scalar portable avx2 avx512", only);
}

static int any_wanted(const evidence_plan *plan)
{
    int is_wanted = 0;
    for (size_t i = 0; i < SIZES; i++)
        is_wanted |= table_wanted(plan->only, plan->at_hand->name, i, i == SIZE_DEFAULT);
    for (size_t i = 0; i < ANY_METHODS; i++)
        is_wanted |= is_in(any_methods[i](NULL).name, plan->only);
    return is_wanted;
}

/* The tables that are wanted, and the fine one, which stands for D. */
static vndf_status add_at_hand(const maker *to)
{
    subject *s = to->plan->at_hand;
    for (size_t i = 0; i < SIZES; i++) {
        if (i != SIZE_FINE && !table_wanted(to->plan->only, s->name, i, i == SIZE_DEFAULT))
            continue;
        const vndf_distribution *d = subject_table(s, i, to->plan, to->error);
        if (!d)
            return to->error->status;
        add_ours(to, AT_HAND, d, table_sizes[i].name, METHOD_SAMPLE,
                 i == SIZE_DEFAULT ? METHOD_TWO_LOBES : METHOD_SAMPLE);
        if (i == SIZE_DEFAULT)
            add_normals(to, AT_HAND, method_exported(d, table_sizes[i].name), 0);
    }
    method_reference *reference = &to->list->reference[AT_HAND];
    *reference = method_reference_of(s->table[SIZE_FINE]);
    for (size_t i = 0; i < ANY_METHODS; i++)
        add_normals(to, AT_HAND, any_methods[i](reference), i == 0);
    return VNDF_OK;
}

static vndf_status add_beside(const maker *to)
{
    subject *s = &to->list->student;
    if (strcmp(to->plan->at_hand->name, student) == 0 || !table_wanted(to->plan->only, student, SIZE_DEFAULT, 0))
        return VNDF_OK;
    vndf_source *source = vndf_source_family(student, to->error);
    if (!source)
        return to->error->status;
    subject_begin(s, source, student);
    const vndf_distribution *d = subject_table(s, SIZE_DEFAULT, to->plan, to->error);
    if (!d)
        return to->error->status;
    to->list->reference[BESIDE] = method_reference_of(d);
    add_ours(to, BESIDE, d, table_sizes[SIZE_DEFAULT].name, METHOD_SAMPLE, METHOD_SAMPLE);
    return VNDF_OK;
}

static vndf_status make_normals(const maker *to)
{
    evidence_list *list = to->list;
    list->reference[OF_GGX] = method_reference_of(vndf_ggx());
    list->reference[OF_BECKMANN] = method_reference_of(vndf_beckmann());
    add_closed(to);
    vndf_status status = any_wanted(to->plan) ? add_at_hand(to) : VNDF_OK;
    if (status == VNDF_OK)
        status = add_beside(to);
    for (size_t i = 0; i < list->count; i++) {
        entry *e = &list->entry[i];
        const method_reference *r = &list->reference[e->of];
        e->law = (block_law){r->canonical.distribution, 0.05f / r->scale, 0.95f / r->scale, NAN, 0, 0};
        e->beside = find(list, 0, method_ggx_caps().name, "scalar");
        e->visible = find(list, 0, "all normals", "scalar");
        while (e->visible != NO_ENTRY && list->entry[e->visible].of != e->of)
            e->visible = find(list, (size_t)e->visible + 1, "all normals", "scalar");
    }
    return status;
}

/* ---- materials ----------------------------------------------------------------------------------- */

/* Whether a set that is wanted is compared with this one. */
static int is_yardstick(const effect_set *set, const char *only)
{
    for (size_t i = 0; i < effect_set_count; i++)
        if (effect_sets[i].visible && strcmp(effect_sets[i].visible, set->name) == 0 &&
            is_in(effect_sets[i].name, only))
            return 1;
    return set == &effect_sets[EFFECT_BARE];
}

static vndf_status add_material(const maker *to, size_t of, const effect_set *set, float ax, float ay,
                                double theta, int is_needed)
{
    const char *name = to->plan->of[of].name;
    const vndf_surface surface = {to->plan->of[of].distribution, ax, ay};
    if (!is_needed && !is_in(set->name, to->plan->only) && !is_in(name, to->plan->only))
        return VNDF_OK;
    method m = method_effect(set, &surface, to->error);
    if (!m.each)
        return to->error->status;
    entry *e = add(to, m, name, 1);
    if (!e)
        return VNDF_OK;
    e->law = effect_law(set, theta);
    e->worth_theta = isnan(theta) ? to->plan->theta : theta;
    e->row.number[COL_ALPHA_X] = (double)ax;
    e->row.number[COL_ALPHA_Y] = (double)ay;
    e->row.number[COL_THETA] = theta;
    return VNDF_OK;
}

/* The cost of each set over directions of the whole hemisphere. */
static vndf_status add_costs(const maker *to, size_t of)
{
    size_t first = to->list->count;
    for (size_t i = 0; i < effect_set_count; i++) {
        const effect_set *set = &effect_sets[i];
        if (set->kind == EFFECT_BY_CAPS && to->plan->of[of].distribution != vndf_ggx())
            continue;
        vndf_status status = add_material(to, of, set, to->plan->alpha_x, to->plan->alpha_y, NAN,
                                          is_yardstick(set, to->plan->only));
        if (status != VNDF_OK)
            return status;
    }
    for (size_t i = first; i < to->list->count; i++) {
        entry *e = &to->list->entry[i];
        const effect_set *set = effect_find(e->m.name);
        e->beside = find(to->list, first, effect_sets[EFFECT_BARE].name, "scalar");
        e->visible = find(to->list, first, set->visible, "scalar");
    }
    return VNDF_OK;
}

/* The worth of bounded normals beside visible ones, by roughness and angle. */
static vndf_status add_variance(const maker *to, size_t of)
{
    static const float alphas[] = {0.2f, 0.5f, 1.0f};
    static const double thetas[] = {0, 30, 60, 85};
    const effect_set *bounded = effect_find("bounded normals");
    int is_wanted = is_in(variance, to->plan->only) || is_in(bounded->name, to->plan->only) ||
                    is_in(to->plan->of[of].name, to->plan->only);
    for (size_t i = 0; is_wanted && i < 12; i++) {
        float alpha = alphas[i / 4];
        vndf_status status = add_material(to, of, &effect_sets[EFFECT_BARE], alpha, alpha, thetas[i % 4], 1);
        if (status == VNDF_OK)
            status = add_material(to, of, bounded, alpha, alpha, thetas[i % 4], 1);
        if (status != VNDF_OK)
            return status;
        entry *last = &to->list->entry[to->list->count - 1];
        last[0].visible = (int)to->list->count - 2;
        last[0].is_shown = last[-1].is_shown = 1;
    }
    return VNDF_OK;
}

static vndf_status make_materials(const maker *to)
{
    vndf_status status = VNDF_OK;
    for (size_t i = 0; i < to->plan->count && status == VNDF_OK; i++) {
        status = add_costs(to, i);
        if (status == VNDF_OK)
            status = add_variance(to, i);
    }
    return status;
}

/* ---- all of it ----------------------------------------------------------------------------------- */

vndf_status evidence_list_make(evidence_list *list, const evidence_plan *plan, vndf_error *error)
{
    *list = (evidence_list){.count = 0};
    *error = (vndf_error){VNDF_OK, ""};
    const maker to = {list, plan, error};
    vndf_status status = plan->at_hand ? make_normals(&to) : make_materials(&to);
    if (status != VNDF_OK || error->status != VNDF_OK) /* the error is that of an entry without room */
        return error->status;
    for (size_t i = 0; i < list->count; i++)
        if (list->entry[i].is_shown)
            return VNDF_OK;
    error->status = VNDF_ERROR_ARGUMENT;
    snprintf(error->message, sizeof error->message,
             "no %s, distribution or instruction set has '%s' in its name%s",
             plan->at_hand ? "method" : "set of effects", plan->only,
             plan->at_hand ? "" : ", and it is no part of 'variance'");
    return VNDF_ERROR_ARGUMENT;
}

void evidence_list_free(evidence_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        method_release(&list->entry[i].m);
    free(list->entry);
    subject_free(&list->student);
    *list = (evidence_list){.count = 0};
}
