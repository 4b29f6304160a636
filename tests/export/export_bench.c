/* export_bench TABLE [SECONDS]: nanoseconds for a visible normal by the exported C, beside plain GGX caps and the
 * library, which take turns; as `vndf bench`, each sample with a direction of its own. The target export_bench builds
 * it; nothing else does. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "bench/parts.h"
#include "cli/clock.h"
#include "export/bench_method.h"

static void add(bench_list *list, bench_subject subject, method m, const char *name)
{
    bench_entry *e = &list->entry[list->count++];
    snprintf(m.name, sizeof m.name, "%s", name);
    *e = (bench_entry){.m = m, .subject = subject, .shown = 1};
}

static void add_all(bench_list *list, const vndf_distribution *table, const bench_exported *exported)
{
    static const bench_exported ggx = {NULL};
    add(list, BENCH_GGX, method_ggx_caps(), "GGX caps as published");
    add(list, BENCH_GGX, method_ours(vndf_ggx(), "", VNDF_INSTRUCTIONS_BEST), "GGX, library");
    add(list, BENCH_GGX, bench_exported_plain(&ggx), "GGX, exported C");
    add(list, BENCH_GGX, bench_exported_fast(&ggx), "GGX, exported C -ffast-math -march=native");
    add(list, BENCH_USER, method_ours(table, "", VNDF_INSTRUCTIONS_BEST), "table, library");
    add(list, BENCH_USER, method_ours(table, "", VNDF_INSTRUCTIONS_PORTABLE),
        "table, batch of the library, portable");
    add(list, BENCH_USER, bench_exported_plain(exported), "table, exported C");
    add(list, BENCH_USER, bench_exported_fast(exported), "table, exported C -ffast-math -march=native");
}

static void print(const bench_list *list)
{
    printf("%-42s %8s %8s %8s %8s %8s\n", "ns a sample", "median", "25%", "75%", "one view", "of caps");
    for (size_t i = 0; i < list->count; i++) {
        const bench_row *row = &list->entry[i].row;
        printf("%-42s %8.1f %8.1f %8.1f %8.1f %8.2f\n", list->entry[i].m.name, row->ns, row->ns_low, row->ns_high,
               row->shared_ns, row->ns / list->entry[0].row.ns);
    }
}

int main(int argc, char **argv)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_distribution *table = argc > 1 ? vndf_load(argv[1], &error) : NULL;
    bench_list *list = calloc(1, sizeof *list);
    size_t count = vndf_numbers(table, NULL, 0);
    float *numbers = calloc(count + 1, sizeof *numbers);
    if (!table || !list || !numbers) {
        fprintf(stderr, "export_bench: %s\n", argc > 1 ? error.message : "usage: export_bench TABLE [SECONDS]");
        return 2;
    }
    vndf_numbers(table, numbers, count);
    float scale = (float)vndf_distribution_info(table).scale;
    const bench_exported exported = {numbers};
    const bench_plan plan = {.seconds = argc > 2 ? strtod(argv[2], NULL) : 10};
    const bench_clock at = {&plan, clock_seconds()};
    list->reference[BENCH_GGX] = (method_reference){{vndf_ggx(), 1, 1}, 1};
    list->reference[BENCH_USER] = (method_reference){{table, 1 / scale, 1 / scale}, scale};
    add_all(list, table, &exported);
    vndf_status status = bench_time(list, &at);
    if (status == VNDF_OK)
        print(list);
    free(numbers);
    free(list);
    vndf_free(table);
    return status != VNDF_OK;
}
