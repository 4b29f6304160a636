#include "compare/ways.h"

#include <string.h>

#include "cli/arguments.h"
#include "command.h"

static scene *add_scene(under_way *run, const scene_tables *tables)
{
    char message[1024];
    scene *s = &run->scenes[run->scene_count];
    if (!scene_read_with(s, run->choice->scene, tables, message, sizeof message)) {
        complain(run->choice->command, "%s", message);
        return NULL;
    }
    run->scene_count++;
    if (!scene_make_albedos(s, NULL, NULL, message, sizeof message)) {
        complain(run->choice->command, "%s", message);
        return NULL;
    }
    if (!run->choice->width || scene_resize(s, (int)run->choice->width, message, sizeof message))
        return s;
    complain(run->choice->command, "--width: %s", message);
    return NULL;
}

/* 1; 0 and a message. */
static int add_way(under_way *run, const char *way_name, const scene *s, path_sampler sampler, char *message,
                   size_t size)
{
    contest *c = &run->contest;
    path_plan *plan = path_prepare(s, sampler, 0, message, size);
    if (!plan)
        return 0;
    run->plans[c->count] = plan;
    way *w = &c->way[c->count++];
    w->scene = s;
    w->plan = plan;
    snprintf(w->name, sizeof w->name, "%s", way_name);
    return 1;
}

/* The page mentions a way that the scene cannot have, unless the user named it. */
static int add_samplers(under_way *run)
{
    const scene_tables as_it_says = {0, 0};
    const compare_choice *c = run->choice;
    const scene *s = add_scene(run, &as_it_says);
    for (size_t i = 0; i < c->sampler_count && s; i++) {
        char message[512];
        const char *sampler = path_sampler_names[c->sampler[i]];
        if (add_way(run, sampler, s, c->sampler[i], message, sizeof message))
            continue;
        if (c->named)
            return complain(run->choice->command, "--samplers %s: %s", sampler, message);
        snprintf(run->result.remarks + strlen(run->result.remarks),
                 sizeof run->result.remarks - strlen(run->result.remarks), "Without %s: %.200s. ", sampler,
                 message);
    }
    return s ? STATUS_GOOD : STATUS_USE;
}

static int is_rebuilt(const scene *s)
{
    for (size_t i = 0; i < s->table_count; i++)
        if (strncmp(s->table_names[i], "table ", 6) != 0)
            return 1;
    return 0;
}

static void name_size(char made[WAY_NAME_MAX], unsigned bytes)
{
    if (bytes % 1024)
        snprintf(made, WAY_NAME_MAX, "%u bytes", bytes);
    else
        snprintf(made, WAY_NAME_MAX, "%u KiB", bytes / 1024);
}

static int add_material_way(under_way *run, const char *way_name, const scene *s)
{
    char message[512];
    return add_way(run, way_name, s, SAMPLER_MATERIAL, message, sizeof message)
               ? STATUS_GOOD
               : complain(run->choice->command, "%s", message);
}

/* All distributions but those of files. */
static int add_table_way(under_way *run, unsigned bytes)
{
    char way_name[WAY_NAME_MAX];
    const scene_tables tables = {bytes, 1};
    const scene *s = add_scene(run, &tables);
    name_size(way_name, bytes);
    if (!s)
        return STATUS_USE;
    return is_rebuilt(s) ? add_material_way(run, way_name, s)
                         : complain(run->choice->command,
                                    "%s: every distribution is a table of a file, which "
                                    "--tables cannot build anew",
                                    run->choice->scene);
}

static int has_table(const material *m)
{
    for (int i = 0; i < m->lobe_count; i++)
        if (vndf_distribution_info(m->lobes[i].distribution).bytes > 0)
            return 1;
    return m->kind == MATERIAL_MICROFACET && vndf_distribution_info(m->is.distribution).bytes > 0;
}

static int is_closed(const scene *s)
{
    for (size_t i = 0; i < s->material_count; i++)
        if (has_table(&s->materials[i]))
            return 0;
    return 1;
}

static int add_closed_forms(under_way *run)
{
    const scene_tables as_it_says = {0, 0};
    const scene *s = add_scene(run, &as_it_says);
    if (!s)
        return STATUS_USE;
    return is_closed(s) ? add_material_way(run, "closed forms", s) : STATUS_GOOD;
}

/* The finest table, as good as exact, by which the others are measured; then the tables that were asked for. */
static int add_tables(under_way *run)
{
    const compare_choice *c = run->choice;
    unsigned finest = COMPARE_FINE_TABLE;
    for (size_t i = 0; i < c->table_count; i++)
        finest = c->table[i] > finest ? (unsigned)c->table[i] : finest;
    int status = add_table_way(run, finest);
    for (size_t i = 0; i < c->table_count && status == STATUS_GOOD; i++)
        if ((unsigned)c->table[i] != finest)
            status = add_table_way(run, (unsigned)c->table[i]);
    return status == STATUS_GOOD ? add_closed_forms(run) : status;
}

int ways_prepare(under_way *run)
{
    int status = run->choice->table_count ? add_tables(run) : add_samplers(run);
    if (status != STATUS_GOOD || run->contest.count)
        return status;
    return complain(run->choice->command, "the scene can have none of the ways. %s", run->result.remarks);
}

void ways_free(under_way *run)
{
    for (size_t i = 0; i < run->contest.count; i++)
        path_free(run->plans[i]);
    for (size_t i = 0; i < run->scene_count; i++)
        scene_free(&run->scenes[i]);
}
