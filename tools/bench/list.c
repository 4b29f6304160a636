/* The methods of the benchmark. Each is made ready if the plan wants it. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/parts.h"

static const char closed_name[] = "closed form";

/* Both axes of what accuracy costs, and a table so fine that it stands for D itself. */
static const struct {
    size_t bytes;
    int moments;
    const char *name;
} tables[BENCH_TABLES] = {{2048, 2, "table 2 KiB, 2 moments"}, {2048, 3, "table 2 KiB, 3 moments"},
                          {2048, 4, "table 2 KiB, 4 moments"}, {4096, 2, "table 4 KiB, 2 moments"},
                          {4096, 3, "table 4 KiB, 3 moments"}, {4096, 4, "table 4 KiB, 4 moments"},
                          {8192, 2, "table 8 KiB, 2 moments"}, {8192, 3, "table 8 KiB, 3 moments"},
                          {8192, 4, "table 8 KiB, 4 moments"}, {32768, 4, "table 32 KiB, 4 moments"}};

enum { DEFAULT_TABLE = 8, FINE_TABLE = 9 };

/* The first stands for the scalar calls. */
static const vndf_instructions sets[] = {VNDF_INSTRUCTIONS_BEST, VNDF_INSTRUCTIONS_PORTABLE,
                                         VNDF_INSTRUCTIONS_AVX2, VNDF_INSTRUCTIONS_AVX512};
enum { SETS = sizeof sets / sizeof *sets };

/* ---- entries ----------------------------------------------------------------------------------- */

static int wanted(const bench_plan *plan, const char *method_name, const char *subject, const char *instructions)
{
    return !plan->only || strstr(method_name, plan->only) || strstr(subject, plan->only) ||
           strstr(instructions, plan->only);
}

static const char *distribution_name(const bench_list *list, bench_subject subject, const method *m)
{
    return m->kind == BENCH_MOVE ? "-" : list->name[subject];
}

static void describe(bench_entry *e, const char *distribution)
{
    bench_row *row = &e->row;
    *row = (bench_row){
        .kind = e->m.kind, .memory = e->m.memory, .file_bytes = e->m.file_bytes, .moments = e->m.moments};
    row->ns = row->ns_low = row->ns_high = row->shared_ns = row->latency_ns = row->ratio = NAN;
    row->tv = row->tv_theta = row->tv_below = row->max_weight = row->efficiency_light = row->stratified = NAN;
    row->efficiency[0] = row->efficiency[1] = row->bias[0] = row->bias[1] = NAN;
    snprintf(row->method, sizeof row->method, "%s", e->m.name);
    snprintf(row->distribution, sizeof row->distribution, "%s", distribution);
    snprintf(row->instructions, sizeof row->instructions, "%s", e->m.instructions);
}

/* Takes the method, or releases it if it cannot run here or is neither wanted nor a yardstick. */
static void add(bench_list *list, const bench_plan *plan, bench_subject subject, method m, int yardstick)
{
    const char *distribution = distribution_name(list, subject, &m);
    int shown = wanted(plan, m.name, distribution, m.instructions);
    if (!m.each || !(shown || yardstick) || list->count == BENCH_ENTRIES_MAX) {
        if (m.release && m.state)
            m.release((void *)m.state);
        return;
    }
    bench_entry *e = &list->entry[list->count++];
    *e = (bench_entry){.m = m, .subject = subject, .shown = shown};
    describe(e, distribution);
}

static void add_ours(bench_list *list, const bench_plan *plan, bench_subject subject, const vndf_distribution *d,
                     const char *name)
{
    for (size_t i = 0; i < SETS; i++)
        add(list, plan, subject, method_ours(d, name, sets[i]), 0);
}

static void add_surfaces(bench_list *list, const bench_plan *plan, bench_subject subject,
                         const vndf_distribution *d, const char *name)
{
    for (method_surface surface = 0; surface < METHOD_SURFACES; surface++)
        for (size_t i = 0; i < SETS; i++)
            add(list, plan, subject, method_ours_surface(d, name, surface, sets[i]), 0);
}

/* The published ways for any D. All three makers are asked alike: the CDF has no side. */
static method any_all_normals(const method_reference *reference, size_t side)
{
    (void)side;
    return method_any_all_normals(reference);
}

static const struct {
    method (*make)(const method_reference *reference, size_t side);
    size_t side;
    int yardstick;
} any_methods[] = {
    {any_all_normals, 0, 1},          {method_inverse_tables, 64, 0}, {method_inverse_tables, 256, 0},
    {method_inverse_tables, 1024, 0}, {method_warp, 32, 0},           {method_warp, 128, 0},
};

enum { ANY_METHODS = sizeof any_methods / sizeof *any_methods };

static void add_ggx(bench_list *list, const bench_plan *plan)
{
    add(list, plan, BENCH_GGX, method_ggx_caps(), 1);
    for (size_t i = 1; i < SETS; i++)
        add(list, plan, BENCH_GGX, method_ggx_caps_batch(sets[i]), 0);
    add(list, plan, BENCH_GGX, method_ggx_2018(), 0);
    add(list, plan, BENCH_GGX, method_ggx_all_normals(), 1);
    add_ours(list, plan, BENCH_GGX, vndf_ggx(), closed_name);
    add(list, plan, BENCH_GGX, method_exported(vndf_ggx(), closed_name), 0);
    add_surfaces(list, plan, BENCH_GGX, vndf_ggx(), closed_name);
    for (size_t i = 1; i < SETS; i++)
        add(list, plan, BENCH_GGX, method_move(sets[i]), 0);
}

static void add_beckmann(bench_list *list, const bench_plan *plan)
{
    add(list, plan, BENCH_BECKMANN, method_beckmann_newton(), 0);
    add(list, plan, BENCH_BECKMANN, method_beckmann_all_normals(), 1);
    add_ours(list, plan, BENCH_BECKMANN, vndf_beckmann(), closed_name);
    add_surfaces(list, plan, BENCH_BECKMANN, vndf_beckmann(), closed_name);
}

static void add_any(bench_list *list, const bench_plan *plan)
{
    const method_reference *reference = &list->reference[BENCH_USER];
    for (size_t i = 0; i < ANY_METHODS; i++)
        add(list, plan, BENCH_USER, any_methods[i].make(reference, any_methods[i].side), any_methods[i].yardstick);
}

static void add_calls(bench_list *list, const bench_plan *plan, const vndf_distribution *d)
{
    for (method_call call = 0; call < METHOD_CALLS; call++)
        for (size_t i = 0; i < SETS; i++)
            add(list, plan, BENCH_USER, method_ours_call(d, tables[DEFAULT_TABLE].name, call, sets[i]), 0);
}

/* ---- tables ------------------------------------------------------------------------------------ */

static int build_progress(double done, const char *what, void *user)
{
    (void)done;
    return !bench_go_on(user, what);
}

static vndf_distribution *build(const bench_clock *at, size_t i, vndf_error *error)
{
    bench_clock clock = *at;
    vndf_build_options options = {.max_bytes = tables[i].bytes,
                                  .moments = tables[i].moments,
                                  .progress = build_progress,
                                  .progress_user = &clock};
    return vndf_build(at->plan->source, &options, NULL, error);
}

/* Whether any row of a table, by whatever set of instructions, is asked for. */
static int table_wanted(const bench_list *list, const bench_plan *plan, size_t i)
{
    const char *instructions = "scalar portable avx2 avx512";
    char name[160];
    snprintf(name, sizeof name, "%s, batch, exported C%s", tables[i].name,
             i == DEFAULT_TABLE ? ": sample, weight: pdf: invert: ndf: lambda: diagonal: affine: two lobes" : "");
    return wanted(plan, name, list->name[BENCH_USER], instructions);
}

static void keep(bench_list *list, const bench_plan *plan, vndf_distribution *table, size_t i)
{
    list->table[list->table_count++] = table;
    add_ours(list, plan, BENCH_USER, table, tables[i].name);
    if (i == DEFAULT_TABLE) {
        add(list, plan, BENCH_USER, method_exported(table, tables[i].name), 0);
        add_calls(list, plan, table);
        add_surfaces(list, plan, BENCH_USER, table, tables[i].name);
    }
}

/* The tables that are wanted, and the one that becomes the reference. */
static vndf_status add_tables(bench_list *list, const bench_clock *at, size_t fine, vndf_error *error)
{
    for (size_t i = 0; i < BENCH_TABLES; i++) {
        if (i != fine && !table_wanted(list, at->plan, i))
            continue;
        vndf_distribution *table = build(at, i, error);
        if (!table)
            return error->status;
        keep(list, at->plan, table, i);
    }
    return VNDF_OK;
}

/* ---- all of it --------------------------------------------------------------------------------- */

static method_reference reference_of(const vndf_distribution *d, double scale)
{
    float alpha = (float)(1 / scale);
    return (method_reference){{d, alpha, alpha}, (float)scale};
}

/* The largest table is the reference; in a hurry the default one has to do. */
static vndf_status add_user(bench_list *list, const bench_clock *at, vndf_error *error)
{
    size_t fine = at->plan->seconds < 10 ? DEFAULT_TABLE : FINE_TABLE;
    vndf_status status = add_tables(list, at, fine, error);
    if (status != VNDF_OK)
        return status;
    const vndf_distribution *finest = list->table[list->table_count - 1];
    list->reference[BENCH_USER] = reference_of(finest, vndf_distribution_info(finest).scale);
    add_any(list, at->plan);
    return VNDF_OK;
}

static int any_shown(const bench_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        if (list->entry[i].shown)
            return 1;
    return 0;
}

/* Names that any row of the user's distribution may have: without one of them, no table is built. */
static int user_wanted(const bench_list *list, const bench_plan *plan)
{
    int is_wanted = 0;
    for (size_t i = 0; i < BENCH_TABLES; i++)
        is_wanted |= table_wanted(list, plan, i);
    for (size_t i = 0; i < ANY_METHODS; i++)
        is_wanted |=
            wanted(plan, any_methods[i].make(NULL, any_methods[i].side).name, list->name[BENCH_USER], "scalar");
    return is_wanted;
}

static vndf_status refuse(bench_list *list, vndf_error *error, const char *only)
{
    bench_list_free(list);
    error->status = VNDF_ERROR_ARGUMENT;
    snprintf(error->message, sizeof error->message,
             "no method, distribution or instruction set has '%s' in its name", only);
    return VNDF_ERROR_ARGUMENT;
}

vndf_status bench_list_make(bench_list *list, const bench_clock *at, vndf_error *error)
{
    *list = (bench_list){.name = {"ggx", "beckmann", at->plan->name}};
    list->reference[BENCH_GGX] = reference_of(vndf_ggx(), 1);
    list->reference[BENCH_BECKMANN] = reference_of(vndf_beckmann(), 1);
    add_ggx(list, at->plan);
    add_beckmann(list, at->plan);
    if (user_wanted(list, at->plan)) {
        vndf_status status = add_user(list, at, error);
        if (status != VNDF_OK) {
            bench_list_free(list);
            return status;
        }
    }
    return any_shown(list) ? VNDF_OK : refuse(list, error, at->plan->only);
}

void bench_list_free(bench_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        if (list->entry[i].m.release && list->entry[i].m.state)
            list->entry[i].m.release((void *)list->entry[i].m.state);
    for (size_t i = 0; i < list->table_count; i++)
        vndf_free(list->table[i]);
    list->count = list->table_count = 0;
}

const bench_entry *bench_list_find(const bench_list *list, bench_subject subject, const char *name,
                                   const char *instructions)
{
    for (size_t i = 0; i < list->count; i++) {
        const bench_entry *e = &list->entry[i];
        if (e->subject == subject && strncmp(e->m.name, name, strlen(name)) == 0 &&
            strcmp(e->m.instructions, instructions) == 0)
            return e;
    }
    return NULL;
}
