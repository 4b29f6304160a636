/* vndf render: a scene file into a picture, by one sampler or by several side by side. Reads the words, prepares
 * the scene, renders, saves the picture, prints figures. */
#include <math.h>
#include <string.h>

#include "cli/arguments.h"
#include "cli/figures.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "command.h"
#include "render/compare.h"

static const char name[] = "vndf render";

static const char *const help[] = {
    "usage: vndf render SCENE -o OUT.png|OUT.pfm [options]\n"
    "       vndf render SCENE --compare LIST [-o SHEET.png] [options]\n"
    "       vndf render --grammar\n"
    "\n"
    "Renders a scene file by path tracing. The picture is the same for any number of threads. An\n"
    "interrupt (^C) saves the samples so far; the exit status is then 130.\n"
    "\n"
    "  -o OUT          the picture: .png has the exposure of the scene, .pfm linear light; - for stdout,\n"
    "                  in place of the text, and an interrupt then leaves nothing\n"
    "  --format png|pfm  whatever OUT ends in (default, for -: png)\n"
    "  --spp N         samples a pixel (default: as in the scene)\n"
    "  --threads T     threads, 1 to 256 (default: one for each processor)\n"
    "  --seed N        another choice of random numbers (default 0)\n"
    "  --sampler NAME  how rough materials draw directions: by visible normals (the default), by all\n"
    "                  normals, or perfect: in proportion to the BSDF, a yardstick that is slow\n"
    "  --width W       pixels across; the height follows\n"
    "  --exposure X    of the PNG, in place of the exposure of the scene\n"
    "  --compare LIST  renders by several samplers, as in visible,all,perfect, and prints the noise of\n"
    "                  each, the samples it needs for that of the first, its efficiency, and whether all\n"
    "                  show the same; OUT has the pictures side by side, and their noise below\n"
    "  --equal time|samples  the others get the time of the first, or its samples (default: time)\n"
    "  --against F     prints whether the picture is that in F, a PFM of the same size, taken to be as\n"
    "                  noisy\n"
    "  --json          prints figures as JSON\n"
    "  --grammar       prints the language of scene files\n"
    "\n"
    "The exit status is 1 where pictures differ by more than chance.\n"
    "\n"
    "example: vndf render tools/scenes/metal.scene -o metal.png --spp 64\n"
    "         vndf render tools/scenes/metal.scene --compare visible,all --width 240 -o sheet.png\n",
    NULL};

typedef struct render_choice {
    unsigned long long spp, threads, seed, width;
    double exposure;
    const char *output, *format, *against; /* NULL: none */
    int compares, has_json;
} render_choice;

/* ---- words ---- */

static int read_sampler(const char *what, const char *word, size_t letters, comparison *c)
{
    char copy[32];
    snprintf(copy, sizeof copy, "%.*s", (int)(letters < sizeof copy ? letters : sizeof copy - 1), word);
    for (size_t i = 0; i < SAMPLERS; i++) {
        if (strcmp(copy, path_sampler_names[i]) != 0)
            continue;
        for (size_t k = 0; k < c->count; k++)
            if (c->way[k].sampler == (path_sampler)i)
                return complain(name, "%s: '%s' stands there twice", what, copy), 0;
        c->way[c->count++].sampler = (path_sampler)i;
        return 1;
    }
    const char *hint = nearest_word(copy, path_sampler_names, SAMPLERS);
    complain(name, "%s: '%s' is none of visible, all and perfect%s%s%s", what, copy,
             hint ? "; did you mean '" : "", hint ? hint : "", hint ? "'?" : "");
    return 0;
}

/* A list separated by commas, or one word. */
static int read_samplers(const arguments *given, comparison *c)
{
    const char *list = option_value(given, "--compare"), *one = option_value(given, "--sampler");
    if (list && one)
        return complain(name, "--sampler is of one picture, --compare of several; leave one out"), 0;
    if (option_value(given, "--equal") && !list)
        return complain(name, "--equal goes with --compare"), 0;
    c->has_equal_time = option_choice(given, "--equal", 0) == 0;
    if (!list)
        return read_sampler("--sampler", one ? one : "visible", strlen(one ? one : "visible"), c);
    for (const char *at = list;; at++) {
        size_t letters = strcspn(at, ",");
        if (!read_sampler("--compare", at, letters, c))
            return 0;
        at += letters;
        if (!*at)
            return c->count > 1 || (complain(name, "--compare takes two samplers at least"), 0);
    }
}

static int read_choice(const arguments *given, render_choice *r, comparison *c)
{
    *r = (render_choice){.threads = film_processors(),
                         .output = option_value(given, "-o"),
                         .format = option_value(given, "--format"),
                         .against = option_value(given, "--against"),
                         .compares = option_value(given, "--compare") != NULL,
                         .has_json = option_value(given, "--json") != NULL};
    *c = (comparison){.count = 0};
    return option_count(given, "--spp", 1, 1e9, &r->spp) &&
           option_count(given, "--threads", 1, 256, &r->threads) &&
           option_count(given, "--seed", 0, 0x1p53, &r->seed) &&
           option_count(given, "--width", 1, IMAGE_SIDE_MAX, &r->width) &&
           option_number(given, "--exposure", 1e-6, 1e6, &r->exposure) && read_samplers(given, c);
}

/* Whether OUT is a PNG (0) or a PFM (1); -1 after a complaint. */
static int form_of(const render_choice *r)
{
    static const char *const forms[] = {"png", "pfm", NULL};
    return output_form(name, r->output, r->format, forms);
}

/* Before anything is read or rendered; 0 after a complaint. */
static int is_output_usable(const render_choice *r)
{
    if (!r->output)
        return r->compares || (complain(name, "-o OUT.png or -o OUT.pfm is missing"), 0);
    if (output_is_stdout(r->output) && (r->compares || r->against || r->has_json))
        return complain(name, "figures go to stdout, where -o - puts the picture; give -o a file"), 0;
    return form_of(r) >= 0 && output_replaceable(name, r->output);
}

/* ---- figures ---- */

static void print_film(const film *f, const render_choice *r, int is_whole)
{
    double rays = (double)(f->counts.segments + f->counts.shadow_rays), seconds = fmax(f->seconds, 1e-9);
    double paths = (double)f->counts.paths;
    printf("%d x %d pixels, %llu samples each%s\n", f->width, f->height, (unsigned long long)f->samples,
           is_whole ? "" : " (interrupted)");
    printf("%.3g s on %llu thread%s: %.3g paths/s, %.3g rays/s, %.3g segments and %.3g shadow rays a path\n",
           seconds, r->threads, r->threads == 1 ? "" : "s", paths / seconds, rays / seconds,
           (double)f->counts.segments / paths, (double)f->counts.shadow_rays / paths);
    if (f->counts.lost)
        printf("%llu samples were not finite and count as black\n", (unsigned long long)f->counts.lost);
}

static void print_agreement(const char *what, const char *with, const agreement *a, int is_read)
{
    static const char *const said[3] = {"the same", "they differ", "unknown"};
    printf("%s beside %s: %s%s\n    light %+.3f%%", what, with, said[a->is],
           is_read && a->is != VERDICT_UNKNOWN ? ", if it is as noisy" : "", 100 * (a->ratio - 1));
    if (a->is == VERDICT_UNKNOWN)
        printf("; fewer than %d samples a pixel have no variance to judge by\n", VERDICT_SAMPLES);
    else
        printf(", %+.1f standard deviations; blocks: mean square %.2f, worst %+.1f at (%d, %d)\n", a->whole,
               a->mean_square, a->worst, a->x, a->y);
}

static void print_ways(const comparison *c, const noise *noises)
{
    const film *first = &c->way[0].film;
    printf("%-8s %8s %8s %18s %25s %25s\n", "sampler", "samples", "seconds", "noise (trimmed)",
           "samples needed (trimmed)", "efficiency (trimmed)");
    for (size_t i = 0; i < c->count; i++) {
        const film *f = &c->way[i].film;
        char text[3][64];
        const measured of[4] = {samples_ratio(noises[0].all, noises[i].all, first, f),
                                samples_ratio(noises[0].trimmed, noises[i].trimmed, first, f),
                                efficiency(noises[0].all, noises[i].all, first, f),
                                efficiency(noises[0].trimmed, noises[i].trimmed, first, f)};
        printf("%-8s %8llu %8.2f", path_sampler_names[c->way[i].sampler], (unsigned long long)f->samples,
               f->processor);
        if (f->samples < 2) {
            puts("  one sample a pixel has no variance");
            continue;
        }
        snprintf(text[0], sizeof text[0], "%.2f%% (%.2f%%)", 100 * sqrt(noises[i].all.value),
                 100 * sqrt(noises[i].trimmed.value));
        for (size_t k = 0; k < 2; k++)
            snprintf(text[1 + k], sizeof text[1 + k], "%.3f +- %.3f (%.3f)", of[2 * k].value, of[2 * k].spread,
                     of[2 * k + 1].value);
        printf(" %18s %25s %25s\n", text[0], text[1], text[2]);
    }
    printf("noise: of a pixel, beside its light; samples needed for the noise of %s, in its own;\n"
           "efficiency: one over squared noise and seconds of processors; trimmed: without the worst\n"
           "thousandth of the pixels\n",
           path_sampler_names[c->way[0].sampler]);
}

static void print_json(const comparison *c, const noise *noises, const agreement *agrees, int has_agreement,
                       int is_whole)
{
    const film *first = &c->way[0].film;
    figures to = {.file = stdout, .form = FIGURES_JSON};
    figures_number(&to, "width", 9, first->width, "pixels");
    figures_number(&to, "height", 9, first->height, "pixels");
    figures_truth(&to, "interrupted", !is_whole);
    figures_list(&to, "pictures");
    for (size_t i = 0; i < c->count; i++) {
        const film *f = &c->way[i].film;
        const agreement *a = &agrees[i];
        figures_record(&to);
        figures_text(&to, "sampler", path_sampler_names[c->way[i].sampler]);
        figures_number(&to, "samples", 9, (double)f->samples, "");
        figures_number(&to, "seconds", 9, f->seconds, "s");
        figures_number(&to, "processor_seconds", 9, f->processor, "s");
        figures_number(&to, "lost", 9, (double)f->counts.lost, "");
        figures_number(&to, "noise", 9, sqrt(noises[i].all.value), "");
        figures_number(&to, "noise_trimmed", 9, sqrt(noises[i].trimmed.value), "");
        figures_number(&to, "samples_needed", 9, samples_ratio(noises[0].all, noises[i].all, first, f).value, "");
        figures_number(&to, "efficiency", 9, efficiency(noises[0].all, noises[i].all, first, f).value, "");
        if (!has_agreement && !i)
            continue;
        figures_text(&to, "verdict", verdict_names[a->is]);
        figures_number(&to, "light_ratio", 9, a->ratio, "");
        figures_number(&to, "deviations", 9, a->whole, "");
        figures_number(&to, "worst_block", 9, a->worst, "");
        figures_number(&to, "mean_square", 9, a->mean_square, "");
    }
    figures_list_end(&to);
    figures_end(&to);
}

/* What the films say; STATUS_NO if one shows something else. `against` may be NULL. */
static int tell(const comparison *c, const render_choice *r, const film *against, int is_whole)
{
    const film *other = against ? against : &c->way[0].film;
    noise noises[SAMPLERS];
    agreement agrees[SAMPLERS];
    film all;
    int status = STATUS_GOOD, good = comparison_mean(c, &all);
    for (size_t i = 0; i < c->count && good; i++) {
        const film *f = &c->way[i].film;
        good = noise_of(f, &all, &noises[i]);
        agrees[i] = agreement_between(f, other, against != NULL);
        if (agrees[i].is == VERDICT_DIFFERS && f != other)
            status = STATUS_NO;
    }
    film_free(&all);
    if (!good)
        return complain(name, "no memory for figures");
    if (r->has_json) {
        print_json(c, noises, agrees, against != NULL, is_whole);
        return status;
    }
    if (r->compares)
        print_ways(c, noises);
    else
        print_film(&c->way[0].film, r, is_whole);
    for (size_t i = against ? 0 : 1; i < c->count; i++)
        print_agreement(path_sampler_names[c->way[i].sampler],
                        against ? r->against : path_sampler_names[c->way[0].sampler], &agrees[i], against != NULL);
    return status;
}

/* ---- rendering ---- */

/* 0 if it was stopped, or there is no memory. */
static int render_ways(comparison *c, const scene *s)
{
    progress line = progress_begin(c->count > 1 ? "comparing" : "rendering", 0);
    line.tells_left = 1;
    c->progress = progress_tell;
    c->user = &line;
    int is_whole = 1;
    for (size_t i = 0; i < c->count && is_whole; i++)
        is_whole = film_make(&c->way[i].film, s->width, s->height);
    const film_run run = {
        .samples = c->samples, .threads = c->threads, .seed = c->seed, .progress = progress_tell, .user = &line};
    if (is_whole)
        is_whole = c->count > 1 ? comparison_run(c) : film_render(&c->way[0].film, c->way[0].plan, &run);
    progress_end(&line);
    return is_whole;
}

static int save(output_file *output, const comparison *c, const render_choice *r, float exposure)
{
    image made;
    const int is_pfm = form_of(r) == 1;
    const float scale_by = r->exposure > 0 ? (float)r->exposure : exposure;
    if (!(c->count > 1 ? comparison_image(c, is_pfm ? 1.0f : scale_by, &made)
                       : film_image(&c->way[0].film, &made)))
        return output_give_up(output, "no memory for the picture");
    int is_written = is_pfm ? image_write_pfm(output->file, &made)
                            : image_write_png(output->file, &made, c->count > 1 ? 1.0f : scale_by);
    image_free(&made);
    if (is_written || ferror(output->file)) /* which is told by closing */
        return output_commit(output);
    return output_give_up(output, "no memory for the picture");
}

/* Figures alone: no file is open, and signals wait for the end of a pass. */
static int render_figures(comparison *c, const render_choice *r, const scene *s, const film *against)
{
    output_hold_signals();
    int status = STATUS_USE;
    if (render_ways(c, s))
        status = tell(c, r, against, 1);
    else
        complain(name, output_stopping() ? "interrupted; nothing was written" : "no memory for the films");
    output_release_signals();
    return status;
}

static int render_picture(comparison *c, const render_choice *r, const scene *s, const film *against)
{
    output_file output;
    if (!output_open(&output, name, r->output))
        return STATUS_USE;
    const int is_whole = render_ways(c, s);
    if (!is_whole && (r->compares || !c->way[0].film.samples))
        return output_give_up(&output, !output_stopping() ? "no memory for the films"
                                       : r->compares      ? "interrupted; nothing was written"
                                                          : "interrupted before every pixel had a sample");
    const int verdict_is = output.path ? tell(c, r, against, is_whole) : STATUS_GOOD;
    fflush(stdout); /* a signal that waits ends the program when the picture is saved */
    const int saved = save(&output, c, r, s->exposure);
    return saved != STATUS_GOOD ? saved : verdict_is;
}

static int read_against(const render_choice *r, const scene *s, film *made)
{
    image_error error;
    image of;
    if (!image_read_pfm(&of, r->against, &error))
        return complain(name, "--against: %s", error.message), 0;
    int fits = of.width == s->width && of.height == s->height;
    if (!fits)
        complain(name, "--against: %s has %d x %d pixels, this picture has %d x %d", r->against, of.width,
                 of.height, s->width, s->height);
    else if (!film_from_image(made, &of))
        fits = (complain(name, "no memory for %s", r->against), 0);
    image_free(&of);
    return fits;
}

static int render_scene(comparison *c, const render_choice *r, scene *s)
{
    char message[640];
    film against = {.sum = NULL};
    if (r->width && !scene_resize(s, (int)r->width, message, sizeof message))
        return complain(name, "--width: %s", message);
    c->samples = r->spp ? r->spp : s->samples;
    c->threads = (unsigned)r->threads;
    c->seed = r->seed;
    for (size_t i = 0; i < c->count; i++)
        if (!(c->way[i].plan = path_prepare(s, c->way[i].sampler, message, sizeof message)))
            return complain(name, "%s", message);
    if (r->against && !read_against(r, s, &against))
        return STATUS_USE;
    const film *other = r->against ? &against : NULL;
    int status = r->output ? render_picture(c, r, s, other) : render_figures(c, r, s, other);
    film_free(&against);
    return status;
}

static int run(const arguments *given)
{
    char message[1024];
    render_choice r;
    comparison c;
    if (option_value(given, "--grammar"))
        return fputs(scene_grammar, stdout) < 0 ? STATUS_USE : STATUS_GOOD;
    if (!given->positional.count)
        return complain(name, "SCENE is missing; `%s --help` has an example", name);
    if (!read_choice(given, &r, &c) || !is_output_usable(&r))
        return STATUS_USE;
    scene *s = scene_read(given->positional.item[0], message, sizeof message);
    if (!s)
        return complain(name, "%s", message);
    int status = render_scene(&c, &r, s);
    for (size_t i = 0; i < c.count; i++) {
        path_free(c.way[i].plan);
        film_free(&c.way[i].film);
    }
    scene_free(s);
    return status;
}

const subcommand command_render = {
    name, "a picture of a scene, by one sampler or several side by side", "SCENE", 0, 1, run, help};
