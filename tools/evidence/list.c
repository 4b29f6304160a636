/* Which methods of which distributions: the entries of a plan. All of them are made, tables too, which takes less than
 * a second; what nobody asked for is neither measured nor timed. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/arguments.h"
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

/* Takes the method; NULL if it cannot run here. */
static entry *add(evidence_list *to, const method_reference *of, method m)
{
    if (!m.each || to->count == ENTRIES_MAX) {
        method_release(&m);
        return NULL;
    }
    entry *e = &to->entry[to->count++];
    *e = (entry){.m = m, .of = of, .variance = {NAN, NAN, NAN}};
    e->law = (block_law){of->canonical.distribution, 0.05f / of->scale, 0.95f / of->scale, NAN, 0};
    e->row = (evidence_row){.instructions = m.instructions, .kind = m.kind};
    snprintf(e->row.method, sizeof e->row.method, "%s", m.name);
    snprintf(e->row.distribution, sizeof e->row.distribution, "%.63s", of->name);
    for (evidence_column c = 0; c < COLUMNS; c++)
        e->row.number[c] = NAN;
    if (m.kind != ROW_EFFECT)
        e->row.number[COL_MEMORY] = (double)m.memory;
    if (m.file_bytes) {
        e->row.number[COL_FILE] = (double)m.file_bytes;
        e->row.number[COL_MOMENTS] = m.moments;
    }
    return e;
}

/* The first entry of that name and distribution. */
static entry *find(evidence_list *list, const char *name, const method_reference *of)
{
    for (entry *e = list->entry; name && e < list->entry + list->count; e++)
        if (e->of == of && strcmp(e->m.name, name) == 0)
            return e;
    return NULL;
}

/* Calls of ours, one by one and in batches. */
static void add_calls(evidence_list *to, const method_reference *of, const vndf_distribution *d, const char *name,
                      method_call first, method_call last)
{
    for (method_call call = first; call <= last; call++)
        for (size_t i = 0; i < SETS; i++)
            add(to, of, method_ours(d, name, call, sets[i]));
}

static void add_closed(evidence_list *to, const method_reference *of)
{
    const vndf_distribution *d = of->canonical.distribution;
    add(to, of, method_all_normals(of));
    add_calls(to, of, d, "closed form", METHOD_SAMPLE, METHOD_SAMPLE);
    add_calls(to, of, d, "closed form", METHOD_AFFINE, METHOD_TWO_LOBES);
}

/* All tables, the default one by all calls, and the published ways for any D. */
static void add_at_hand(evidence_list *to, const method_reference *of, const subject *s)
{
    for (size_t i = 0; i < SIZES; i++)
        add_calls(to, of, s->table[i], table_sizes[i].name, METHOD_SAMPLE,
                  i == SIZE_DEFAULT ? METHOD_TWO_LOBES : METHOD_SAMPLE);
    add(to, of, method_exported(s->table[SIZE_DEFAULT], table_sizes[SIZE_DEFAULT].name));
    add(to, of, method_all_normals(of));
    add(to, of, method_warp(of));
}

static vndf_status make_normals(evidence_list *to, subject *s)
{
    method_reference *ggx = to->reference, *beckmann = ggx + 1, *at_hand = ggx + 2, *beside = ggx + 3;
    for (size_t i = 0; i < SIZES; i++)
        if (!subject_table(s, i, to->plan, to->error))
            return to->error->status;
    *ggx = method_reference_of(vndf_ggx(), "ggx");
    *beckmann = method_reference_of(vndf_beckmann(), "beckmann");
    *at_hand = method_reference_of(s->table[SIZE_FINE], s->name);
    add(to, ggx, method_ggx_caps());
    for (size_t i = 1; i < SETS; i++)
        add(to, ggx, method_ggx_caps_batch(sets[i]));
    add_closed(to, ggx);
    add(to, ggx, method_exported(vndf_ggx(), "closed form"));
    add_closed(to, beckmann);
    add_at_hand(to, at_hand, s);
    if (strcmp(s->name, student) != 0) { /* time for a D that everybody has, beside that at hand */
        subject_begin(&to->student, vndf_source_family(student, to->error), student);
        if (!to->student.source || !subject_table(&to->student, SIZE_DEFAULT, to->plan, to->error))
            return to->error->status;
        *beside = method_reference_of(to->student.table[SIZE_DEFAULT], student);
        add_calls(to, beside, to->student.table[SIZE_DEFAULT], table_sizes[SIZE_DEFAULT].name, METHOD_SAMPLE,
                  METHOD_SAMPLE);
    }
    for (entry *e = to->entry; e < to->entry + to->count; e++) {
        e->beside = &to->entry[0];
        e->normals = find(to, "all normals (2007)", e->of);
    }
    return VNDF_OK;
}

static vndf_status make_materials(evidence_list *to, method_reference *of, const evidence_plan *plan)
{
    const vndf_surface surface = {of->canonical.distribution, plan->alpha_x, plan->alpha_y};
    for (const effect_set *set = effect_sets; set < effect_sets + effect_set_count; set++) {
        method m = method_effect(set, &surface, to->error);
        if (!m.each)
            return to->error->status;
        entry *e = add(to, of, m);
        if (!e)
            continue;
        e->law = effect_law(set);
        e->row.number[COL_ALPHA_X] = (double)plan->alpha_x;
        e->row.number[COL_ALPHA_Y] = (double)plan->alpha_y;
        e->beside = find(to, effect_sets[EFFECT_BARE].name, of);
        e->normals = find(to, set->visible, of);
    }
    return VNDF_OK;
}

/* ---- all of it ----------------------------------------------------------------------------------- */

/* A name, or a word of one, that --only nearly is; near[] is empty if there is none. */
static void find_near(const evidence_list *list, char near[64])
{
    for (const entry *e = list->entry; e < list->entry + list->count; e++) {
        const char *const names[] = {e->row.method, e->row.distribution, e->row.instructions};
        for (int i = 0; i < 3; i++) {
            char text[64];
            snprintf(text, sizeof text, "%s", names[i]);
            for (char *word = strtok(text, " ,:()"); word; word = strtok(NULL, " ,:()")) {
                const char *const candidate = word;
                if (nearest_word(list->plan->only, &candidate, 1)) {
                    snprintf(near, 64, "%s", word);
                    return;
                }
            }
        }
    }
}

static vndf_status choose(evidence_list *list)
{
    const char *only = list->plan->only;
    char near[64] = "";
    size_t shown = 0;
    for (entry *e = list->entry; e < list->entry + list->count; e++)
        if (!only || strstr(e->row.method, only) || strstr(e->row.distribution, only) ||
            strstr(e->row.instructions, only)) {
            e->is_shown = e->is_needed = 1;
            shown++;
            if (e->beside)
                e->beside->is_needed = 1;
            if (e->normals)
                e->normals->is_needed = 1;
        }
    if (shown)
        return VNDF_OK;
    find_near(list, near);
    list->error->status = VNDF_ERROR_ARGUMENT;
    snprintf(list->error->message, sizeof list->error->message,
             "no %s, distribution or instruction set has '%.64s' in its name%s%s%s",
             list->plan->at_hand ? "method" : "set of effects", only, *near ? "; did you mean '" : "", near,
             *near ? "'?" : "");
    return VNDF_ERROR_ARGUMENT;
}

vndf_status evidence_list_make(evidence_list *list, const evidence_plan *plan, vndf_error *error)
{
    list->plan = plan;
    list->error = error;
    vndf_status status = plan->at_hand ? make_normals(list, plan->at_hand) : VNDF_OK;
    for (size_t i = 0; i < plan->count && status == VNDF_OK; i++) {
        list->reference[i] = method_reference_of(plan->of[i].distribution, plan->of[i].name);
        status = make_materials(list, &list->reference[i], plan);
    }
    return status == VNDF_OK ? choose(list) : status;
}

void evidence_list_free(evidence_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        method_release(&list->entry[i].m);
    subject_free(&list->student);
    list->count = 0;
}
