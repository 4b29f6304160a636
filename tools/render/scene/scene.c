/* Reads a scene: the words of the file, statement after statement, then checks of the whole scene. */
#include "render/scene/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "render/scene/reader.h"
#include "render/whole_file.h"

typedef struct statement_kind {
    const char *name;
    int (*read)(scene_reader *r, const statement *s);
    int once;
} statement_kind;

static const statement_kind statements[] = {
    {"title", read_title, 1},
    {"film", read_film, 1},
    {"camera", read_camera, 1},
    {"integrator", read_integrator, 1},
    {"environment", read_environment, 1},
    {"image", read_image, 0},
    {"lobe", read_lobe, 0},
    {"material", read_material, 0},
    {"sphere", read_sphere, 0},
    {"rectangle", read_rectangle, 0},
    {"box", read_box, 0},
    {"mesh", read_mesh, 0},
};
enum { STATEMENTS = sizeof statements / sizeof statements[0] };

static int read_statement(scene_reader *r, const statement *s)
{
    const char *names[STATEMENTS];
    const word *w = &s->words[0];
    for (size_t i = 0; i < STATEMENTS; i++) {
        names[i] = statements[i].name;
        if (w->quoted || strcmp(w->text, names[i]) != 0)
            continue;
        if (statements[i].once && r->seen >> i & 1u)
            return reader_refuse(r, w, "'%s' stands in this scene twice", w->text);
        r->seen |= 1u << i;
        return statements[i].read(r, s);
    }
    return reader_unknown(r, w, "statement", names, STATEMENTS);
}

static int read_statements(scene_reader *r)
{
    for (size_t at = 0; at < r->count;) {
        statement s = {r->words + at, 1};
        while (at + s.count < r->count && !r->words[at + s.count].begins)
            s.count++;
        if (!read_statement(r, &s))
            return 0;
        at += s.count;
    }
    return 1;
}

/* The scene needs a camera and a light: without light it is black, which nobody means. */
static int check_whole(scene_reader *r)
{
    const environment *e = &r->made->environment;
    const word *last = r->count ? &r->words[r->count - 1] : NULL;
    const word end = {NULL, last ? last->line : 1, last ? last->end : 1, 0, 0, 0};
    if (!(r->seen >> 2 & 1u))
        return reader_refuse(r, &end, "the scene ends without a camera, as in 'camera from 0 1 5 to 0 0 0'");
    if (!r->gives_light && !e->map && !(e->constant[0] + e->constant[1] + e->constant[2] > 0.0f))
        return reader_refuse(r, &end, "the scene ends without light: an environment, or a shape of a light");
    return geometry_build(&r->made->geometry) || reader_refuse(r, &end, "there is no memory for the shapes");
}

static size_t folder_of(const char *name)
{
    const char *slash = strrchr(name, '/');
    return slash ? (size_t)(slash - name) + 1 : 0;
}

static int read_text(scene *made, const char *name, const scene_tables *tables, char *text, size_t length,
                     char *message, size_t size)
{
    scene_reader r = {.name = name,
                      .folder = folder_of(name),
                      .message = message,
                      .size = size,
                      .made = made,
                      .tables = *tables};
    *made = (scene){.camera = {.up = {0.0f, 1.0f, 0.0f}, .field = 40.0f},
                    .width = 640,
                    .height = 360,
                    .integrator = {.depth = 12, .roulette = 4, .samples = 64, .exposure = 1.0f},
                    .environment = {.scale = 1.0f}};
    int good = reader_split(&r, text, length) && read_statements(&r) && check_whole(&r);
    free(r.words);
    free(r.lobes);
    if (!good)
        scene_free(made);
    return good;
}

static const scene_tables as_it_says = {0, 0};

int scene_read_text(scene *made, const char *name, char *text, size_t length, char *message, size_t size)
{
    return read_text(made, name, &as_it_says, text, length, message, size);
}

int scene_read_with(scene *made, const char *path, const scene_tables *tables, char *message, size_t size)
{
    char reason[128];
    size_t length;
    char *text = whole_file(path, SCENE_BYTES_MAX, &length, reason, sizeof reason);
    if (!text) {
        *made = (scene){.title = NULL};
        snprintf(message, size, "%s:1:1: %s", path, reason);
        return 0;
    }
    int good = read_text(made, path, tables, text, length, message, size);
    free(text);
    return good;
}

int scene_read(scene *made, const char *path, char *message, size_t size)
{
    return scene_read_with(made, path, &as_it_says, message, size);
}

int scene_resize(scene *s, int width, char *message, size_t size)
{
    double height = floor((double)s->height * width / s->width + 0.5);
    if (!(height >= 1 && height <= IMAGE_SIDE_MAX && height * width <= IMAGE_PIXELS_MAX)) {
        snprintf(message, size,
                 "a film of %d x %d pixels becomes %d x %.0f: it has 1 to %d rows and %d pixels at "
                 "most",
                 s->width, s->height, width, height, IMAGE_SIDE_MAX, IMAGE_PIXELS_MAX);
        return 0;
    }
    s->height = (int)height;
    s->width = width;
    return 1;
}

void scene_free(scene *s)
{
    for (size_t i = 0; i < s->material_count; i++) {
        free(s->materials[i].name);
        free(s->materials[i].lobes);
    }
    for (size_t i = 0; i < s->relief_count; i++) {
        relief_free(s->reliefs[i]);
        free(s->reliefs[i]);
    }
    for (size_t i = 0; i < s->image_count; i++) {
        image_free(&s->images[i]);
        free(s->image_names[i]);
    }
    for (size_t i = 0; i < s->table_count; i++) {
        vndf_free(s->tables[i]);
        free(s->table_names[i]);
    }
    scene_free_albedos(s);
    for (size_t i = 0; i < s->family_count; i++) {
        vndf_family_free(s->families[i]);
        free(s->family_names[i]);
    }
    free(s->families);
    free(s->family_names);
    free(s->title);
    free(s->materials);
    free(s->reliefs);
    free(s->images);
    free(s->image_names);
    free(s->tables);
    free(s->table_names);
    geometry_free(&s->geometry);
    *s = (scene){.title = NULL};
}
