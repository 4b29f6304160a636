/* image NAME file PATH, image NAME pattern NAME width W height H. */
#include "render/scene/reader.h"

#include <stdlib.h>
#include <string.h>

/* Reads the file of an image; the image may still be refused. */
static int load_file(scene_reader *r, const clause *file, image *made)
{
    image_error error;
    char *path = reader_path(r, file->values);
    if (!path)
        return 0;
    int good = image_read_pfm(made, path, &error);
    free(path);
    return good || reader_refuse(r, file->values, "%s", error.message);
}

static int make_pattern(scene_reader *r, const clause c[4], image *made)
{
    image_error error;
    unsigned side[2] = {512, 512};
    for (size_t i = 0; i < 2; i++)
        if (c[2 + i].at && !reader_whole(r, &c[2 + i], 0, 1, IMAGE_SIDE_MAX, &side[i]))
            return 0;
    if (side[0] * side[1] > IMAGE_PIXELS_MAX)
        return reader_refuse(r, c[1].values, "%u x %u pixels are more than %d", side[0], side[1],
                             IMAGE_PIXELS_MAX);
    return image_make_pattern(made, c[1].values->text, (int)side[0], (int)side[1], &error) ||
           reader_refuse(r, c[1].values, "%s", error.message);
}

/* Materials point at images, so the array must not move: the first image allocates room for all. */
static int add_image(scene_reader *r, const word *name, const image *added)
{
    scene *s = r->made;
    if (!s->images)
        s->images = calloc(SCENE_IMAGES_MAX, sizeof *s->images);
    if (!s->image_names)
        s->image_names = calloc(SCENE_IMAGES_MAX, sizeof *s->image_names);
    if (!s->images || !s->image_names)
        return reader_refuse(r, name, "there is no memory for images");
    if (!(s->image_names[s->image_count] = reader_copy(r, name)))
        return 0;
    s->images[s->image_count++] = *added;
    return 1;
}

int reader_within(scene_reader *r, const word *at, const image *map, const image_range *range)
{
    for (int y = 0; y < map->height; y++)
        for (int x = 0; x < map->width; x++) {
            float rgb[3];
            image_at(map, x, y, rgb);
            for (int i = 0; i < range->channels; i++)
                if (!((double)rgb[i] >= range->low && (double)rgb[i] <= range->high))
                    return reader_refuse(r, at,
                                         "as %s the image must be from %g to %g; %s is %g in column %d of "
                                         "row %d (from the top, from 0)",
                                         range->what, range->low, range->high,
                                         i == 0   ? "red"
                                         : i == 1 ? "green"
                                                  : "blue",
                                         (double)rgb[i], x, y);
        }
    return 1;
}

static int check_name(scene_reader *r, const word *name)
{
    const scene *s = r->made;
    for (size_t i = 0; i < s->image_count; i++)
        if (strcmp(s->image_names[i], name->text) == 0)
            return reader_refuse(r, name, "there is an image '%s' already", name->text);
    return s->image_count < SCENE_IMAGES_MAX ||
           reader_refuse(r, name, "these are more than %d images", SCENE_IMAGES_MAX);
}

int read_image(scene_reader *r, const statement *s)
{
    clause c[] = {{.keyword = "file", .takes = "PATH", .least = 1, .most = 1},
                  {.keyword = "pattern", .takes = "NAME", .least = 1, .most = 1},
                  {.keyword = "width", .takes = "PIXELS", .least = 1, .most = 1},
                  {.keyword = "height", .takes = "PIXELS", .least = 1, .most = 1}};
    const word *name;
    image made = {0, 0, NULL};
    if (!reader_name(r, s, "image", &name) || !check_name(r, name) || !reader_clauses(r, s, 2, c, 4))
        return 0;
    if (!c[0].at == !c[1].at)
        return reader_refuse(r, &s->words[0], "'image' needs one of 'file PATH' and 'pattern NAME'");
    for (int i = 2; i < 4; i++)
        if (c[0].at && c[i].at)
            return reader_refuse(r, c[i].at, "'%s' is of a pattern; a file has its own", c[i].keyword);
    if (!(c[0].at ? load_file(r, &c[0], &made) : make_pattern(r, c, &made)))
        return 0;
    r->pixels += (size_t)made.width * (size_t)made.height;
    int good = r->pixels <= SCENE_PIXELS_MAX ||
               reader_refuse(r, name, "all images together have more than %d pixels", SCENE_PIXELS_MAX);
    good = good && add_image(r, name, &made);
    if (!good)
        image_free(&made);
    return good;
}
