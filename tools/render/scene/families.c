/* distribution family FILE.vndfs parameter ...: a family of tables with a parameter that may be a texture. Lobes with
 * the same file share the family. */
#include "render/scene/material_clauses.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char family_end[] = ".vndfs";

int is_family(const clause *distribution)
{
    const char *name = distribution->count > 1 ? distribution->values[1].text : "";
    size_t length = strlen(name), end = sizeof family_end - 1;
    return strcmp(distribution->values->text, "family") == 0 && length > end &&
           strcmp(name + length - end, family_end) == 0;
}

/* ---- files ---- */

/* Takes the family. */
static int keep(scene_reader *r, const word *at, vndf_family *family)
{
    scene *s = r->made;
    if (!s->families)
        s->families = calloc(SCENE_FAMILIES_MAX, sizeof *s->families);
    if (!s->family_names)
        s->family_names = calloc(SCENE_FAMILIES_MAX, sizeof *s->family_names);
    int is_full = s->family_count == SCENE_FAMILIES_MAX;
    if (!s->families || !s->family_names || is_full) {
        vndf_family_free(family);
        return reader_refuse(r, at,
                             is_full ? "these are more than %d families" : "there is no memory for %d families",
                             SCENE_FAMILIES_MAX);
    }
    s->families[s->family_count] = family;
    s->family_names[s->family_count] = reader_copy(r, at);
    return s->family_names[s->family_count++] != NULL;
}

static int load(scene_reader *r, const word *at)
{
    vndf_error error = {VNDF_OK, ""};
    char *path = reader_path(r, at);
    vndf_family *family = path ? vndf_family_load(path, &error) : NULL;
    if (path && !family)
        reader_refuse(r, at, "%s", error.message);
    free(path);
    return family && keep(r, at, family);
}

static int find(scene_reader *r, const word *at, const vndf_family **found)
{
    const scene *s = r->made;
    for (size_t i = 0; i < s->family_count; i++)
        if (strcmp(s->family_names[i], at->text) == 0) {
            *found = s->families[i];
            return 1;
        }
    if (!load(r, at))
        return 0;
    *found = s->families[s->family_count - 1];
    return 1;
}

/* ---- the parameter ---- */

/* Parameters of knots have seven digits: 1.6, where the float is 1.60000002. */
static double seven_digits(float parameter)
{
    char text[32];
    snprintf(text, sizeof text, "%.7g", (double)parameter);
    return strtod(text, NULL);
}

static int read_ends(scene_reader *r, const clause *c, const vndf_family *family, scene_parameter *p)
{
    const vndf_family_facts is = vndf_family_info(family);
    const double low = seven_digits(is.low), high = seven_digits(is.high);
    if (!reader_number(r, c, 0, low, high, &p->from))
        return 0;
    p->to = p->from;
    return c->count < 2 || reader_number(r, c, 1, low, high, &p->to);
}

static int read_map(scene_reader *r, const clause *ends, const clause *c, scene_parameter *p)
{
    const image_range part = {"the way from one parameter to the other", 1, 0, 1};
    if (c->at && ends->count < 2)
        return reader_refuse(r, c->at, "'parameter-map' goes from one parameter to another: 'parameter FROM TO'");
    if (!c->at && ends->count > 1)
        return reader_refuse(r, &ends->values[1], "'parameter FROM TO' needs 'parameter-map IMAGE'");
    return !c->at || (reader_image(r, c, &p->map) && reader_within(r, c->values, p->map, &part));
}

/* The table that stands for the family where one has to. */
static const vndf_distribution *nearest(const vndf_family *family, float parameter)
{
    size_t best = 0, count = vndf_family_info(family).count;
    for (size_t i = 1; i < count; i++)
        if (fabsf(vndf_family_parameter(family, i) - parameter) <
            fabsf(vndf_family_parameter(family, best) - parameter))
            best = i;
    return vndf_family_distribution(family, best);
}

int read_family(scene_reader *r, const clause c[CLAUSES], scene_lobe *made)
{
    const clause *distribution = &c[DISTRIBUTION], *ends = &c[PARAMETER];
    if (!ends->at)
        return reader_refuse(r, distribution->at,
                             "'distribution family %.64s' needs 'parameter P' or 'parameter FROM TO'",
                             distribution->values[1].text);
    if (c[BYTES].at)
        return reader_refuse(r, c[BYTES].at, "'bytes' is of tables that are made here, this family has its own");
    if (!find(r, &distribution->values[1], &made->family) || !read_ends(r, ends, made->family, &made->parameter) ||
        !read_map(r, ends, &c[PARAMETER_MAP], &made->parameter))
        return 0;
    made->distribution = nearest(made->family, 0.5f * (made->parameter.from + made->parameter.to));
    return 1;
}
