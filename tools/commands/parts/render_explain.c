/* What each effect costs in a scene: the same pixels and numbers are rendered on one thread with all effects and
 * with one of them left out, in turns, and the medians of the times count. What is left out changes where paths
 * go, so both the time of a path and its rays are told: an effect may also save time, by ending paths.
 *
 * Leaving out the microfacets makes their materials smooth, mirror or glass: what is left is the cost of finding
 * rays, and the rest of a segment is shading by this library. */
#include "commands/parts/render_explain.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/arguments.h"
#include "cli/clock.h"
#include "cli/random.h"
#include "command.h"
#include "measure/turns.h"
#include "render/path/parts.h"

enum { TURNS = 15, VARIANTS_MAX = 24 };

/* What is timed: nanoseconds for a path, for a segment of it, for a ray of either kind; and the part that a variant
 * saves of the time of a path with all effects. */
enum { PATH = 0, SEGMENT = 1, RAY = 2, SAVES = 3, SERIES = 4 };

static const double turn_seconds = 0.02; /* of one variant */

typedef struct effect_word {
    unsigned effect;
    int can_leave;
    const char *name, *without; /* what it is, and what stands for it when it is left out */
} effect_word;

static const effect_word effect_words[] = {
    {EFFECT_MICROFACETS, 1, "microfacets", "smooth materials of the same kind"},
    {EFFECT_REFRACTION, 0, "refraction", NULL},
    {EFFECT_MULTIPLE, 1, "multiple scattering", "single scattering"},
    {EFFECT_COMPENSATION, 1, "energy compensation", "single scattering"},
    {EFFECT_TEXTURED_ALPHA, 1, "textured roughness", "the roughness beside the map"},
    {EFFECT_ROTATED_AXES, 1, "rotated axes", "axes as the shape has them"},
    {EFFECT_MATRICES, 1, "matrices of slopes", "round lobes of the same determinant"},
    {EFFECT_MEAN_SLOPES, 1, "mean slopes", "means of 0"},
    {EFFECT_RELIEFS, 1, "maps of slopes", "the roughness beside the map"},
    {EFFECT_MIXTURES, 1, "several lobes", "the heaviest lobe"},
    {EFFECT_FAMILIES, 1, "families of tables", "one table of each, amid its parameters"},
    {EFFECT_TEXTURED_WEIGHTS, 1, "textured weights", "the weights beside the maps"},
    {EFFECT_RETROREFLECTION, 1, "retroreflection", "light that is mirrored"},
    {EFFECT_COLOUR_MAPS, 1, "maps of colour", "the colour beside the map"},
    {EFFECT_MATTE, 0, "matte surfaces", NULL},
    {EFFECT_SPECULAR, 0, "smooth surfaces", NULL},
    {EFFECT_ABSORPTION, 1, "absorption", "clear bodies"},
    {EFFECT_MESHES, 0, "triangles", NULL},
    {EFFECT_LIGHTS, 1, "lights, drawn", "lights that paths meet"},
    {EFFECT_ENVIRONMENT, 0, "light from far away", NULL},
    {EFFECT_ENVIRONMENT_MAP, 1, "environment image, drawn", "an image that paths meet"},
};

enum { EFFECT_WORDS = sizeof effect_words / sizeof effect_words[0] };

typedef struct variant {
    const effect_word *word; /* NULL: all effects */
    path_plan *plan;
    path_counts counts;
    int is_repeated; /* every call of the library is made twice: see repeat.c */
    turns_quartiles of[SERIES];
} variant;

/* ---- measuring ---- */

/* `count` paths through pixels all over the film. */
static path_counts trace(const variant *v, const scene *s, uint64_t seed, size_t count)
{
    random_stream stream = random_from(seed);
    path_counts counts = {0, 0, 0, 0};
    for (size_t i = 0; i < count; i++) {
        float rgb[3];
        int x = (int)(random_bits(&stream) % (uint64_t)s->width);
        int y = (int)(random_bits(&stream) % (uint64_t)s->height);
        path_trace(v->plan, x, y, i, seed, &counts, rgb);
    }
    return counts;
}

static void time_variant(variant *v, const scene *s, uint64_t seed, size_t count, double number[SERIES])
{
    double start = clock_seconds();
    path_counts counts = trace(v, s, seed, count);
    double ns = 1e9 * (clock_seconds() - start);
    number[PATH] = ns / (double)count;
    number[SEGMENT] = ns / (double)counts.segments;
    number[RAY] = ns / (double)(counts.segments + counts.shadow_rays);
    v->counts.paths += counts.paths;
    v->counts.segments += counts.segments;
    v->counts.shadow_rays += counts.shadow_rays;
}

/* As many paths as take a turn, found by doubling. */
static size_t paths_of_turn(const variant *all, const scene *s)
{
    size_t count = 64;
    for (double spent = 0; spent < turn_seconds / 2; count *= 2) {
        double start = clock_seconds();
        trace(all, s, 1000, count);
        spent = clock_seconds() - start;
    }
    return count;
}

typedef struct contenders {
    const scene *scene;
    variant *list;
    size_t count, paths;
} contenders;

static int take_turn(void *user, size_t turn, double *number)
{
    const contenders *c = user;
    for (size_t i = 0; i < c->count; i++) {
        time_variant(&c->list[i], c->scene, turn, c->paths, number + i * SERIES);
        number[i * SERIES + SAVES] = 1 - number[i * SERIES + PATH] / number[PATH];
    }
    return 1;
}

/* 0 if there is no memory. */
static int measure(variant *list, size_t count, const scene *s)
{
    turns_quartiles found[VARIANTS_MAX * SERIES];
    contenders c = {s, list, count, paths_of_turn(&list[0], s)};
    const turns_plan plan = {
        .series = count * SERIES, .least = TURNS, .most = TURNS, .take = take_turn, .user = &c};
    if (turns_run(&plan, found) != VNDF_OK)
        return 0;
    for (size_t i = 0; i < count; i++)
        memcpy(list[i].of, found + i * SERIES, sizeof list[i].of);
    return 1;
}

/* ---- variants ---- */

/* All effects first; then each that the scene calls for and that can be left out; at last all with the library's
 * calls made twice. The count; 0 after a complaint. */
static size_t prepare(const char *command, const scene *s, path_sampler sampler, variant list[VARIANTS_MAX])
{
    char message[512];
    size_t count = 0;
    list[0] = (variant){.plan = path_prepare(s, sampler, 0, message, sizeof message)};
    if (list[0].plan)
        count = 1;
    for (size_t i = 0; i < EFFECT_WORDS && count; i++) {
        const effect_word *word = &effect_words[i];
        if (!word->can_leave || !(path_effects(list[0].plan) & word->effect))
            continue;
        list[count] =
            (variant){.word = word, .plan = path_prepare(s, sampler, word->effect, message, sizeof message)};
        if (list[count].plan)
            count++;
    }
    if (!count)
        return complain(command, "%s", message), 0;
    list[count] = (variant){.is_repeated = 1, .plan = path_prepare(s, sampler, 0, message, sizeof message)};
    if (list[count].plan)
        path_repeat(list[count++].plan);
    return count;
}

/* ---- printing ---- */

static const variant *without(const variant *list, size_t count, const effect_word *word)
{
    for (size_t i = 1; i < count; i++)
        if (list[i].word == word && !list[i].is_repeated)
            return &list[i];
    return NULL;
}

static void print_line(const char *what, const variant *v)
{
    printf("  %-26s %10.0f %9.2f %9.2f %9.0f %9.0f\n", what, v->of[PATH].median,
           (double)v->counts.segments / (double)v->counts.paths,
           (double)v->counts.shadow_rays / (double)v->counts.paths, v->of[SEGMENT].median, v->of[RAY].median);
}

static void print_effects(const variant *list, size_t count)
{
    unsigned effects = path_effects(list[0].plan);
    puts("what this scene calls for, and what stands for it when it is left out:");
    for (size_t i = 0; i < EFFECT_WORDS; i++) {
        const effect_word *word = &effect_words[i];
        const variant *v = without(list, count, word);
        if (!(effects & word->effect))
            continue;
        if (!v)
            printf("  %-26s (cannot be left out)\n", word->name);
        else
            printf("  %-26s %+7.1f%% ± %.1f of the time of a path, over %s\n", word->name,
                   100 * v->of[SAVES].median, 50 * (v->of[SAVES].high - v->of[SAVES].low), word->without);
    }
    puts("(a minus: without it paths go on for longer, or their time differs by less than can be told)");
    fputs("nothing is run for:", stdout);
    for (size_t i = 0, said = 0; i < EFFECT_WORDS; i++)
        if (!(effects & effect_words[i].effect))
            printf("%s %s", said++ ? "," : "", effect_words[i].name);
    puts("\n");
}

static void print_share(const variant *list, size_t count)
{
    const variant *smooth = without(list, count, &effect_words[0]), *all = &list[0];
    printf("\n%.3g rays/s and %.3g paths/s on one thread\n", 1e9 / all->of[RAY].median,
           1e9 / all->of[PATH].median);
    if (!smooth)
        return;
    double ratio = all->of[SEGMENT].median / smooth->of[SEGMENT].median;
    double rays = all->of[RAY].median / smooth->of[RAY].median;
    printf("a segment of a path costs %.2f times what it costs with smooth materials, a ray %.2f times (aim: 2);\n"
           "microfacets take %.0f%% of the time of a segment, with the rays to the lights that they ask for\n",
           ratio, rays, 100 * (1 - 1 / ratio));
    if (list[count - 1].is_repeated)
        printf("this library takes %.0f%% of the time of a path: what its calls cost when they are made twice\n",
               100 * (list[count - 1].of[PATH].median / all->of[PATH].median - 1));
}

static void print_all(const variant *list, size_t count)
{
    print_effects(list, count);
    puts("                                ns, path  segments   shadow  ns, segment   ns, ray");
    print_line("all", &list[0]);
    for (size_t i = 1; i < count; i++) {
        char what[64];
        snprintf(what, sizeof what, "%s%s", list[i].is_repeated ? "" : "no ",
                 list[i].is_repeated ? "all, the library twice" : list[i].word->name);
        print_line(what, &list[i]);
    }
    print_share(list, count);
}

int render_explain(const char *command, const scene *s, path_sampler sampler)
{
    variant *list = calloc(VARIANTS_MAX, sizeof *list);
    size_t count = list ? prepare(command, s, sampler, list) : 0;
    int status = count ? STATUS_GOOD : STATUS_USE;
    if (!list || (count && !measure(list, count, s)))
        status = complain(command, "no memory");
    if (status == STATUS_GOOD)
        print_all(list, count);
    for (size_t i = 0; i < count; i++)
        path_free(list[i].plan);
    free(list);
    return status;
}
