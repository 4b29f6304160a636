/* Statements that stand once in a scene: title, film, camera, integrator, environment. */
#include "render/scene/reader.h"

#include <math.h>

int read_title(scene_reader *r, const statement *s)
{
    if (s->count != 2)
        return reader_refuse(r, &s->words[s->count < 2 ? 0 : 2],
                             "'title' takes one word, or several between quotes");
    r->made->title = reader_copy(r, &s->words[1]);
    return r->made->title != NULL;
}

int read_film(scene_reader *r, const statement *s)
{
    clause c[] = {{.keyword = "width", .takes = "PIXELS", .least = 1, .most = 1, .needed = 1},
                  {.keyword = "height", .takes = "PIXELS", .least = 1, .most = 1, .needed = 1}};
    unsigned width, height;
    if (!reader_clauses(r, s, 1, c, 2) || !reader_whole(r, &c[0], 0, 1, IMAGE_SIDE_MAX, &width) ||
        !reader_whole(r, &c[1], 0, 1, IMAGE_SIDE_MAX, &height))
        return 0;
    if (width * height > IMAGE_PIXELS_MAX)
        return reader_refuse(r, c[0].values, "%u x %u pixels are more than %d", width, height, IMAGE_PIXELS_MAX);
    r->made->width = (int)width;
    r->made->height = (int)height;
    return 1;
}

int read_camera(scene_reader *r, const statement *s)
{
    clause c[] = {{.keyword = "from", .takes = "X Y Z", .least = 3, .most = 3, .needed = 1},
                  {.keyword = "to", .takes = "X Y Z", .least = 3, .most = 3, .needed = 1},
                  {.keyword = "up", .takes = "X Y Z", .least = 3, .most = 3},
                  {.keyword = "field", .takes = "DEGREES", .least = 1, .most = 1}};
    camera *made = &r->made->camera;
    if (!reader_clauses(r, s, 1, c, 4) || !reader_vector(r, &c[0], &made->from) ||
        !reader_vector(r, &c[1], &made->to) || (c[2].at && !reader_vector(r, &c[2], &made->up)) ||
        (c[3].at && !reader_number(r, &c[3], 0, 1, 170, &made->field)))
        return 0;
    vndf_vec3 along = subtract(made->to, made->from);
    if (!(dot(along, along) > 1e-12f))
        return reader_refuse(r, c[1].at, "the camera looks nowhere: 'to' is the same place as 'from'");
    vndf_vec3 side = cross(along, made->up);
    if (!(dot(side, side) > 1e-8f * dot(along, along) * dot(made->up, made->up)))
        return reader_refuse(r, c[2].at ? c[2].at : c[1].at,
                             "the camera looks along 'up', so nothing says which "
                             "way is up; give another, as in 'up 0 0 1'");
    return 1;
}

int read_integrator(scene_reader *r, const statement *s)
{
    clause c[] = {{.keyword = "depth", .takes = "SURFACES", .least = 1, .most = 1},
                  {.keyword = "roulette", .takes = "SURFACES", .least = 1, .most = 1},
                  {.keyword = "samples", .takes = "COUNT", .least = 1, .most = 1},
                  {.keyword = "exposure", .takes = "FACTOR", .least = 1, .most = 1}};
    integrator *made = &r->made->integrator;
    return reader_clauses(r, s, 1, c, 4) && (!c[0].at || reader_whole(r, &c[0], 0, 1, 10000, &made->depth)) &&
           (!c[1].at || reader_whole(r, &c[1], 0, 1, 10000, &made->roulette)) &&
           (!c[2].at || reader_whole(r, &c[2], 0, 1, 1e9, &made->samples)) &&
           (!c[3].at || reader_number(r, &c[3], 0, 1e-6, 1e6, &made->exposure));
}

int read_environment(scene_reader *r, const statement *s)
{
    clause c[] = {{.keyword = "constant", .takes = "R G B", .least = 3, .most = 3},
                  {.keyword = "image", .takes = "NAME", .least = 1, .most = 1},
                  {.keyword = "scale", .takes = "FACTOR", .least = 1, .most = 1},
                  {.keyword = "turn", .takes = "DEGREES", .least = 1, .most = 1}};
    environment *made = &r->made->environment;
    if (!reader_clauses(r, s, 1, c, 4) || (c[0].at && !reader_three(r, &c[0], 0, 1e6, made->constant)) ||
        (c[1].at && !reader_image(r, &c[1], &made->map)) ||
        (c[2].at && !reader_number(r, &c[2], 0, 0, 1e6, &made->scale)) ||
        (c[3].at && !reader_number(r, &c[3], 0, -360, 360, &made->turn)))
        return 0;
    if (!c[0].at && !c[1].at)
        return reader_refuse(r, &s->words[0], "'environment' needs 'constant R G B' or 'image NAME'");
    for (int i = 2; i < 4; i++)
        if (c[i].at && !c[1].at)
            return reader_refuse(r, c[i].at, "'%s' is of an image, and this statement has none", c[i].keyword);
    const image_range light = {"light", 3, 0, made->scale > 1.0f ? 1e6 / (double)made->scale : 1e6};
    return !made->map || reader_within(r, c[1].values, made->map, &light);
}
