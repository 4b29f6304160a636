/* The distribution of a lobe, and how it lies: alpha with its maps, axes or a matrix, a mean slope, maps of slopes. */
#include "render/scene/material_clauses.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- alpha ---- */

/* The first channel of a map, times alpha, is the roughness: the product must be a valid alpha. */
static int read_map(scene_reader *r, const clause *both, const clause *one, textured *made)
{
    const clause *c = one->at ? one : both;
    const image_range rough = {"roughness", 1, 1e-6 / (double)made->value, 1e3 / (double)made->value};
    return !c->at || (reader_image(r, c, &made->map) && reader_within(r, c->values, made->map, &rough));
}

static int read_alpha(scene_reader *r, const clause c[CLAUSES], scene_lobe *l)
{
    const clause *alpha = &c[ALPHA], *both = &c[ALPHA_MAP];
    if (alpha->at && !reader_number(r, alpha, 0, 1e-6, 1e3, &l->alpha_x.value))
        return 0;
    l->alpha_y = l->alpha_x;
    if (alpha->count == 2 && !reader_number(r, alpha, 1, 1e-6, 1e3, &l->alpha_y.value))
        return 0;
    if (both->at && (c[ALPHA_X_MAP].at || c[ALPHA_Y_MAP].at))
        return reader_refuse(r, both->at,
                             "'alpha-map' is of x and y; leave it out beside 'alpha-x-map' or "
                             "'alpha-y-map'");
    return read_map(r, both, &c[ALPHA_X_MAP], &l->alpha_x) && read_map(r, both, &c[ALPHA_Y_MAP], &l->alpha_y);
}

/* ---- axes ---- */

static int read_rotation(scene_reader *r, const clause *c, scene_lobe *l)
{
    float degrees;
    if (!c->at)
        return 1;
    if (!reader_number(r, c, 0, -360, 360, &degrees))
        return 0;
    l->rotation = degrees * 0.0174532925f;
    const float cosine = cosf(l->rotation), sine = sinf(l->rotation);
    const float axes[4] = {cosine, -sine, sine, cosine};
    memcpy(l->axes, axes, sizeof axes);
    return 1;
}

/* Its singular values lie within the square root of the sum of squares, and the determinant over that. */
static int check_matrix(scene_reader *r, const clause *c, const float m[4])
{
    double determinant = fabs((double)m[0] * (double)m[3] - (double)m[1] * (double)m[2]), square = 0;
    for (int i = 0; i < 4; i++)
        square += (double)m[i] * (double)m[i];
    return (square > 0 && determinant / sqrt(square) >= 1e-6) ||
           reader_refuse(r, c->at,
                         "this matrix is singular, or nearly so: it must stretch all slopes by 1e-6 at least");
}

static int read_matrix(scene_reader *r, const clause c[CLAUSES], scene_lobe *l)
{
    static const int others[] = {ALPHA, ROTATION, ALPHA_MAP, ALPHA_X_MAP, ALPHA_Y_MAP};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        if (c[others[i]].at)
            return reader_refuse(r, c[others[i]].at, "'matrix' says roughness and axes; leave out '%s'",
                                 c[others[i]].keyword);
    for (size_t i = 0; i < 4; i++)
        if (!reader_number(r, &c[MATRIX], i, -1e3, 1e3, &l->axes[i]))
            return 0;
    l->is_matrix = 1;
    return check_matrix(r, &c[MATRIX], l->axes);
}

/* ---- maps of slopes ---- */

static int add_relief(scene_reader *r, const clause *c, relief *added)
{
    scene *s = r->made;
    if (!s->reliefs)
        s->reliefs = calloc(SCENE_RELIEFS_MAX, sizeof *s->reliefs);
    if (!s->reliefs)
        return reader_refuse(r, c->at, "there is no memory for maps of slopes");
    if (s->relief_count == SCENE_RELIEFS_MAX)
        return reader_refuse(r, c->at, "these are more than %d maps of slopes", SCENE_RELIEFS_MAX);
    relief *kept = malloc(sizeof *kept);
    if (!kept)
        return reader_refuse(r, c->at, "there is no memory for this map of slopes");
    *kept = *added;
    s->reliefs[s->relief_count++] = kept;
    return 1;
}

static int read_form(scene_reader *r, const clause c[CLAUSES], const image *map, relief_form *form)
{
    unsigned texels = 0;
    const clause *scale = &c[SCALE], *filtered = &c[FILTERED];
    *form = (relief_form){1.0f, 1.0f, 0};
    if (scale->at && !reader_number(r, scale, 0, -1e6, 1e6, &form->scale_x))
        return 0;
    form->scale_y = form->scale_x;
    if ((scale->count == 2 && !reader_number(r, scale, 1, -1e6, 1e6, &form->scale_y)) ||
        (filtered->at && !reader_whole(r, filtered, 0, 1, IMAGE_SIDE_MAX, &texels)))
        return 0;
    form->texels = (int)texels;
    if (texels && (map->width % form->texels || map->height % form->texels))
        return reader_refuse(r, filtered->values, "squares of %d texels do not divide an image of %d x %d",
                             form->texels, map->width, map->height);
    return 1;
}

static int check_normals(scene_reader *r, const clause *c, const image *map)
{
    const image_range normal = {"half a normal and 1/2", 3, 0, 1};
    if (!reader_within(r, c->values, map, &normal))
        return 0;
    for (int y = 0; y < map->height; y++)
        for (int x = 0; x < map->width; x++) {
            float rgb[3];
            image_at(map, x, y, rgb);
            if (!(rgb[2] > 0.5f))
                return reader_refuse(
                    r, c->values,
                    "a normal must not lie in the surface or below: blue is %g in column %d of row "
                    "%d (from the top, from 0), it must be above 0.5",
                    (double)rgb[2], x, y);
        }
    return 1;
}

/* Counts the pixels before they are made. */
static int check_pixels(scene_reader *r, const clause *c, const image *map, const relief_form *form)
{
    size_t side = form->texels ? (size_t)form->texels : 1;
    r->pixels += (form->texels ? 2u : 1u) * ((size_t)map->width / side) * ((size_t)map->height / side);
    return r->pixels <= SCENE_PIXELS_MAX ||
           reader_refuse(r, c->at, "all images and maps of slopes together have more than %d pixels",
                         SCENE_PIXELS_MAX);
}

static int make_relief(scene_reader *r, const clause *c, const image *map, const relief_form *form, int of_heights)
{
    relief made;
    if (!check_pixels(r, c, map, form))
        return 0;
    if (!(of_heights ? relief_of_heights(&made, map, form) : relief_of_normals(&made, map, form)))
        return reader_refuse(r, c->at, "there is no memory for this map of slopes");
    int good = made.steepest <= (float)SCENE_STEEP ||
               reader_refuse(r, c->at, "slopes of this map go up to %g, they must stay within %g",
                             (double)made.steepest, SCENE_STEEP);
    good = good && add_relief(r, c, &made);
    if (!good)
        relief_free(&made);
    return good;
}

static int read_relief(scene_reader *r, const clause c[CLAUSES], scene_lobe *l)
{
    const clause *of = c[HEIGHT_MAP].at ? &c[HEIGHT_MAP] : &c[NORMAL_MAP];
    const image *map;
    relief_form form;
    for (int i = SCALE; i <= FILTERED; i++)
        if (c[i].at && !of->at)
            return reader_refuse(r, c[i].at, "'%s' is of a 'height-map' or a 'normal-map'", c[i].keyword);
    if (!of->at)
        return 1;
    if (c[HEIGHT_MAP].at && c[NORMAL_MAP].at)
        return reader_refuse(r, c[NORMAL_MAP].at,
                             "slopes come from one map; leave out 'height-map' or 'normal-map'");
    if (!reader_image(r, of, &map) || !read_form(r, c, map, &form) ||
        (c[NORMAL_MAP].at && !check_normals(r, of, map)) ||
        !make_relief(r, of, map, &form, c[HEIGHT_MAP].at != NULL))
        return 0;
    l->relief = r->made->reliefs[r->made->relief_count - 1];
    return 1;
}

/* ---- the rest ---- */

static int read_mean(scene_reader *r, const clause *c, scene_lobe *l)
{
    return !c->at || (reader_number(r, c, 0, -SCENE_STEEP, SCENE_STEEP, &l->mean_x) &&
                      reader_number(r, c, 1, -SCENE_STEEP, SCENE_STEEP, &l->mean_y));
}

static int read_table(scene_reader *r, const clause c[CLAUSES], scene_lobe *l)
{
    const char *form = c[DISTRIBUTION].values->text;
    if (is_family(&c[DISTRIBUTION]))
        return read_family(r, c, l);
    for (int i = PARAMETER; i <= PARAMETER_MAP; i++)
        if (c[i].at)
            return reader_refuse(
                r, c[i].at, "'%s' is of a family of tables, as in 'distribution family FILE.vndfs'", c[i].keyword);
    int closed = strcmp(form, "ggx") == 0 || strcmp(form, "beckmann") == 0;
    unsigned bytes = 4096;
    if (closed && !c[ALPHA].at && !c[MATRIX].at)
        return reader_refuse(r, c[DISTRIBUTION].at, "'distribution %s' needs 'alpha A' or 'alpha AX AY'", form);
    if (c[BYTES].at && (closed || strcmp(form, "table") == 0))
        return reader_refuse(r, c[BYTES].at, "'bytes' is of tables that are made here: family, slope or ndf");
    return (!c[BYTES].at || reader_whole(r, &c[BYTES], 0, 2048, 1 << 20, &bytes)) &&
           read_distribution(r, &c[DISTRIBUTION], bytes, &l->distribution);
}

static int read_weight(scene_reader *r, const clause c[CLAUSES], scene_lobe *l)
{
    const image_range weight = {"weight", 1, 0, 1e6};
    const clause *map = &c[WEIGHT_MAP];
    return (!c[WEIGHT].at || reader_number(r, &c[WEIGHT], 0, 0, 1e6, &l->weight.value)) &&
           (!map->at ||
            (reader_image(r, map, &l->weight.map) && reader_within(r, map->values, l->weight.map, &weight)));
}

int read_slopes(scene_reader *r, const clause c[CLAUSES], scene_lobe *made)
{
    *made = (scene_lobe){.axes = {1.0f, 0.0f, 0.0f, 1.0f},
                         .alpha_x = {1.0f, NULL},
                         .alpha_y = {1.0f, NULL},
                         .weight = {1.0f, NULL}};
    int laid =
        c[MATRIX].at ? read_matrix(r, c, made) : read_alpha(r, c, made) && read_rotation(r, &c[ROTATION], made);
    return laid && read_table(r, c, made) && read_mean(r, &c[MEAN], made) && read_relief(r, c, made) &&
           read_weight(r, c, made);
}
