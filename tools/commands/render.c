/* vndf render: a scene file into a picture. Reads the words, prepares the scene, renders in passes, saves what is
 * there - also when it is interrupted. */
#include "render/film.h"

#include <math.h>
#include <string.h>

#include "cli/arguments.h"
#include "cli/clock.h"
#include "command.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "commands/parts/render_against.h"
#include "commands/parts/render_explain.h"

static const char name[] = "vndf render";

static const char help[] =
    "usage: vndf render SCENE -o OUT.png|OUT.pfm [options]\n"
    "       vndf render SCENE --explain\n"
    "       vndf render --grammar\n"
    "\n"
    "Renders a scene file by path tracing, only with the effects that the scene calls for. The image is the same\n"
    "for any number of threads. An interrupt (^C) saves the samples so far; the exit status is then 130.\n"
    "\n"
    "  -o OUT          the picture: .png has the exposure of the scene, .pfm linear light; - for stdout, in place\n"
    "                  of the text, and an interrupt then leaves nothing\n"
    "  --format NAME   png or pfm, whatever OUT ends in (default, for -: png)\n"
    "  --spp N         samples a pixel (default: as in the scene)\n"
    "  --seconds S     stop after S seconds; without --spp takes as many samples as fit\n"
    "  --threads T     threads, 1 to 256 (default: one for each processor)\n"
    "  --seed N        another choice of random numbers (default 0)\n"
    "  --sampler NAME  how rough materials draw normals: all, visible, bounded, or material, as each says (the\n"
    "                  default). With perfect they draw directions, from tables made for the whole of each BSDF\n"
    "  --width W       pixels across; the height follows\n"
    "  --exposure X    of the PNG, in place of the exposure of the scene\n"
    "  --against F     prints how far the picture is from F, a PFM of the same size\n"
    "  --explain       lists the effects that the scene calls for and the cost of each, measured in some seconds on\n"
    "                  one thread\n"
    "  --grammar       prints the language of scene files\n"
    "\n"
    "example: vndf render tools/scenes/metal.scene -o metal.png --spp 64\n"
    "         vndf render tools/scenes/glass.scene -o glass.pfm --seconds 20 --sampler visible --explain\n";

typedef struct render_words {
    words output, format, spp, seconds, threads, seed, sampler, width, exposure, against, explain, grammar;
} render_words;

typedef struct render_choice {
    unsigned long long spp, threads, seed, width;
    double seconds, exposure;
    path_sampler sampler;
    const char *against; /* NULL: nothing */
    image other;         /* the picture of that name */
} render_choice;

/* ---- words ---- */

static int read_sampler(const words *given, path_sampler *sampler)
{
    const char *word = only_word(given);
    for (size_t i = 0; word && i < SAMPLERS; i++)
        if (strcmp(word, path_sampler_names[i]) == 0) {
            *sampler = (path_sampler)i;
            return 1;
        }
    if (!word)
        return 1;
    const char *hint = nearest_word(word, path_sampler_names, SAMPLERS);
    complain(name, "--sampler: '%s' is none of all, visible, bounded, perfect and material%s%s%s", word,
             hint ? "; did you mean '" : "", hint ? hint : "", hint ? "'?" : "");
    return 0;
}

static int read_choice(const render_words *given, render_choice *c)
{
    *c = (render_choice){.threads = film_processors(), .sampler = SAMPLER_MATERIAL};
    c->against = only_word(&given->against);
    return option_count(name, "--spp", &given->spp, 1, 1e9, &c->spp) &&
           option_number(name, "--seconds", &given->seconds, 1e-3, 1e6, &c->seconds) &&
           option_count(name, "--threads", &given->threads, 1, 256, &c->threads) &&
           option_count(name, "--seed", &given->seed, 0, 0x1p53, &c->seed) &&
           option_count(name, "--width", &given->width, 1, IMAGE_SIDE_MAX, &c->width) &&
           option_number(name, "--exposure", &given->exposure, 1e-6, 1e6, &c->exposure) &&
           read_sampler(&given->sampler, &c->sampler);
}

typedef int image_writer(FILE *file, const image *made, float exposure);

static int write_pfm(FILE *file, const image *made, float exposure)
{
    (void)exposure;
    return image_write_pfm(file, made);
}

static image_writer *writer_of(const char *path, const char *format)
{
    static const char *const forms[2] = {"png", "pfm"};
    int form = output_form(name, path, format, forms);
    return form < 0 ? NULL : form == 0 ? image_write_png : write_pfm;
}

/* ---- progress ---- */

typedef struct watch {
    progress line;
    double seconds; /* the limit; 0: none */
} watch;

static int show_progress(double done, void *user)
{
    watch *w = user;
    if (w->seconds > 0)
        done = fmax(done, fmin((clock_seconds() - w->line.begun) / w->seconds, 1));
    return progress_tell(done, &w->line);
}

/* ---- rendering ---- */

static void print_summary(const film *f, const render_choice *c, int whole)
{
    double rays = (double)(f->counts.segments + f->counts.shadow_rays), seconds = fmax(f->seconds, 1e-9);
    printf("%d x %d pixels, %llu samples each%s\n", f->width, f->height, (unsigned long long)f->samples,
           whole ? "" : " (interrupted)");
    printf("%.3g s on %llu thread%s: %.3g paths/s, %.3g rays/s, %.3g segments and %.3g shadow rays a path\n",
           seconds, c->threads, c->threads == 1 ? "" : "s", (double)f->counts.paths / seconds, rays / seconds,
           (double)f->counts.segments / (double)f->counts.paths,
           (double)f->counts.shadow_rays / (double)f->counts.paths);
    if (f->counts.samples_lost)
        printf("%llu samples were not finite and count as black\n", (unsigned long long)f->counts.samples_lost);
    fflush(stdout); /* a signal that waits ends the program when the image is saved */
}

static int save(output_file *output, image_writer *write, const film *f, float exposure)
{
    image made;
    if (!film_image(f, &made))
        return output_give_up(output, "no memory for the image");
    int written = write(output->file, &made, exposure);
    image_free(&made);
    if (written || ferror(output->file)) /* which is told by closing */
        return output_commit(output);
    return output_give_up(output, "no memory for the image");
}

static int render_film(output_file *output, image_writer *write, const path_plan *plan, const scene *s,
                       const render_choice *c)
{
    film f;
    watch w = {progress_begin("rendering", output->held), c->seconds};
    film_run run = {.samples = c->spp ? c->spp : s->integrator.samples,
                    .seconds = c->seconds,
                    .seed = c->seed,
                    .threads = (unsigned)c->threads,
                    .progress = show_progress,
                    .user = &w};
    if (!c->spp && c->seconds > 0)
        run.samples = 1000000000;
    w.line.tells_left = 1;
    if (!film_make(&f, s->width, s->height))
        return output_give_up(output, "no memory for the film");
    int whole = film_render(&f, plan, &run), status;
    progress_end(&w.line);
    if (f.samples) {
        if (output->path)
            print_summary(&f, c, whole);
        if (output->path && c->against)
            render_against_print(&f, &c->other, c->against);
        status = save(output, write, &f, c->exposure > 0 ? (float)c->exposure : s->integrator.exposure);
    } else {
        status = output_give_up(output, output_interrupted(output) ? "interrupted before every pixel had a sample"
                                                                   : "no memory for a pass");
    }
    film_free(&f);
    return status;
}

static int render_to_file(const render_words *given, const path_plan *plan, const scene *s, const render_choice *c)
{
    output_file output;
    image_writer *write = writer_of(only_word(&given->output), only_word(&given->format));
    if (!write || !output_open(&output, name, only_word(&given->output)))
        return STATUS_USE;
    return render_film(&output, write, plan, s, c);
}

/* Signals end the program as long as this goes on. */
static int make_albedos(scene *s)
{
    char message[640];
    progress line = progress_begin("albedos", 0);
    int good = scene_make_albedos(s, progress_show, &line, message, sizeof message);
    progress_end(&line);
    return good || (complain(name, "%s", message), 0);
}

static void print_precomputed(const scene *s, const path_plan *plan)
{
    path_precomputed cost = path_perfect_cost(plan);
    if (s->albedo_count)
        printf("energy compensation: %zu table%s of albedos built, %.3g KiB, %.3g s\n", s->albedo_count,
               s->albedo_count == 1 ? "" : "s", (double)scene_albedo_bytes(s) / 1024, s->albedo_seconds);
    if (cost.count)
        printf("perfect sampling: %zu BSDF%s precomputed, %.3g MiB, %.3g s\n", cost.count,
               cost.count == 1 ? "" : "s", (double)cost.bytes / 1048576, cost.seconds);
}

static int render_scene(const render_words *given, scene *s, const render_choice *c)
{
    char message[512];
    if (!make_albedos(s))
        return STATUS_USE;
    path_plan *plan = path_prepare(s, c->sampler, 0, message, sizeof message);
    int status = STATUS_GOOD;
    if (!plan)
        return complain(name, "%s", message);
    if (!given->output.count || !output_is_stdout(only_word(&given->output)))
        print_precomputed(s, plan);
    if (given->explain.count)
        status = render_explain(name, s, c->sampler);
    if (status == STATUS_GOOD && given->output.count)
        status = render_to_file(given, plan, s, c);
    path_free(plan);
    return status;
}

/* Before anything is read or rendered; 0 after a complaint. */
static int is_output_usable(const render_words *given)
{
    const char *path = only_word(&given->output);
    if (path && given->explain.count && output_is_stdout(path))
        return complain(name, "--explain prints to stdout, where -o - puts the picture; give one of them"), 0;
    if (given->against.count && (!path || output_is_stdout(path)))
        return complain(name, "--against prints to stdout how far the picture in -o OUT is; give -o a file"), 0;
    return !path || (writer_of(path, only_word(&given->format)) && output_replaceable(name, path));
}

static int read_and_render(const render_words *given, const char *path)
{
    render_choice c;
    scene s;
    char message[1024];
    if (!read_choice(given, &c) || !is_output_usable(given))
        return STATUS_USE;
    if (!scene_read(&s, path, message, sizeof message))
        return complain(name, "%s", message);
    int fits = !c.width || scene_resize(&s, (int)c.width, message, sizeof message), status = STATUS_USE;
    if (!fits)
        complain(name, "--width: %s", message);
    else if (!c.against || render_against_read(name, c.against, s.width, s.height, &c.other))
        status = render_scene(given, &s, &c);
    image_free(&c.other);
    scene_free(&s);
    return status;
}

int command_render(int argc, char **argv)
{
    render_words given = {0};
    words positional = {{NULL}, 0};
    const option_form options[] = {
        {"-o", 1, 1, &given.output},           {"--format", 1, 1, &given.format},
        {"--spp", 1, 1, &given.spp},           {"--seconds", 1, 1, &given.seconds},
        {"--threads", 1, 1, &given.threads},   {"--seed", 1, 1, &given.seed},
        {"--sampler", 1, 1, &given.sampler},   {"--width", 1, 1, &given.width},
        {"--exposure", 1, 1, &given.exposure}, {"--explain", 0, 1, &given.explain},
        {"--against", 1, 1, &given.against},   {"--grammar", 0, 1, &given.grammar},
    };
    const command_form form = {name, help, options, sizeof options / sizeof options[0], "SCENE", 0, 1};
    int parsed = parse_arguments(&form, argc, argv, &positional);
    if (parsed == PARSE_GO_ON && given.grammar.count) {
        for (size_t i = 0; i < SCENE_GRAMMAR_PARTS; i++)
            fputs(scene_grammar[i], stdout);
        return STATUS_GOOD;
    }
    if (parsed != PARSE_GO_ON)
        return parsed;
    if (!positional.count)
        return complain(name, "SCENE is missing; `%s --help` has an example", name);
    if (!given.output.count && !given.explain.count)
        return complain(name, "-o OUT.png or -o OUT.pfm is missing");
    return read_and_render(&given, only_word(&positional));
}
