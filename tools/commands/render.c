/* vndf render: a scene file into a picture, by one sampler or by several side by side. Reads the words, prepares
 * the scene, renders, saves the picture, prints figures. */

#include "cli/figures.h"
#include "cli/files.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "command.h"
#include "render/film.h"

static const char name[] = "vndf render";

static const char *const help[] = {
    "usage: vndf render SCENE -o OUT.png|OUT.pfm [options]\n"
    "       vndf render SCENE --compare A,B,... [-o SHEET.png] [options]\n"
    "       vndf render --grammar\n"
    "\n"
    "Renders a scene file by path tracing. The picture is the same for any number of threads. An\n"
    "interrupt (^C) saves the samples so far; the exit status is then 130.\n"
    "\n"
    "  -o OUT          the picture: .png has the exposure of the scene, .pfm linear light; - for stdout\n"
    "                  (PNG), in place of the text, and an interrupt then leaves nothing\n"
    "  --spp N         samples a pixel (default: as in the scene)\n"
    "  --threads T     threads, 1 to 256 (default: one for each processor)\n"
    "  --seed N        another choice of random numbers (default 0)\n"
    "  --sampler visible|all|perfect  how rough materials draw directions: by visible normals (the default),\n"
    "                  by all normals, or perfect: in proportion to the BSDF, a yardstick that is slow\n"
    "  --width W       pixels across; the height follows\n"
    "  --exposure X    of the PNG, in place of the exposure of the scene\n"
    "  --compare visible,all,perfect  renders by two samplers or three, and prints the noise of a pixel beside\n"
    "                  its light, the samples each needs for the noise of the first, its efficiency (one over\n"
    "                  squared noise and seconds), and whether all show the same (unknown of fewer than 16\n"
    "                  samples a pixel); OUT has the pictures side by side, their noise below\n"
    "    --equal time|samples  the others get the time of the first, or its samples (default: time)\n"
    "  --grammar       prints how scenes are written\n"
    "\n"
    "The exit status is 1 where pictures differ by more than chance.\n"
    "\n"
    "example: vndf render tools/scenes/metal.scene -o metal.png --spp 64\n"
    "         vndf render tools/scenes/metal.scene --compare visible,all --width 240 -o sheet.png\n",
    NULL};

/* What was asked for, and what comes of it. */
typedef struct render_work {
    comparison ways; /* one of them is no comparison */
    unsigned long long samples, width;
    double exposure;
    const char *path; /* of the picture; NULL: none */
    output_file output;
    int is_pfm;
    figures_form form;
} render_work;

/* All words, before anything is read or rendered. */
static int read_words(const arguments *given, render_work *w)
{
    static const char *const forms[] = {"png", "pfm", NULL};
    unsigned long long threads = film_processors(), seed = 0;
    int sampler[WORDS_MAX] = {option_choice(given, "--sampler", 0)};
    const size_t compared = option_choices(given, "--compare", sampler);
    comparison *c = &w->ways;
    *w = (render_work){.path = option_value(given, "-o"), .form = figures_begin(given).form};
    if (!option_count(given, "--spp", 1, 1e9, &w->samples) ||
        !option_count(given, "--threads", 1, 256, &threads) || !option_count(given, "--seed", 0, 0x1p53, &seed) ||
        !option_count(given, "--width", 1, IMAGE_SIDE_MAX, &w->width) ||
        !option_number(given, "--exposure", 1e-6, 1e6, &w->exposure))
        return 0;
    if (compared && option_value(given, "--sampler"))
        return complain(name, "--sampler is of one picture, --compare of several; leave one out"), 0;
    if (compared == 1)
        return complain(name, "--compare takes two samplers at least"), 0;
    *c = (comparison){.count = compared ? compared : 1, .threads = (unsigned)threads, .seed = seed};
    c->has_equal_time = option_choice(given, "--equal", 0) == 0;
    for (size_t k = 0; k < c->count; k++)
        c->way[k].sampler = (path_sampler)sampler[k];
    if (!w->path)
        return compared || (complain(name, "-o OUT.png or -o OUT.pfm is missing"), 0);
    if (output_is_stdout(w->path) && (compared || w->form == FIGURES_JSON))
        return complain(name, "figures go to stdout, where -o - puts the picture; give -o a file"), 0;
    w->is_pfm = output_form(name, w->path, forms);
    return w->is_pfm >= 0;
}

/* A row for each way. */
static int print_rows(const render_work *w, const finding *found, int is_whole)
{
    const comparison *c = &w->ways;
    const int has_json = w->form == FIGURES_JSON;
    const char *digits = has_json ? "%.9g" : "%.3g";
    figures t = {.rows = 0};
    for (size_t i = 0; i < c->count; i++) {
        const film *f = &c->way[i].film;
        const finding *a = &found[i];
        figures_record(&t);
        figures_text(&t, "equal", c->has_equal_time ? "equal time" : "equal samples");
        figures_add(&t, FIGURE_WORD, "sampler", path_sampler_names[c->way[i].sampler]);
        figures_number(&t, "samples", "%.0f", (double)f->samples, "");
        figures_number(&t, "seconds", "%.3g", f->processor, "");
        figures_number(&t, "noise", digits, sqrt(a->noise.value), "");
        figures_number(&t, "samples_needed", digits, a->samples.value, "");
        figures_number(&t, "samples_needed_spread", digits, a->samples.spread, "");
        figures_number(&t, "efficiency", digits, a->efficiency.value, "");
        figures_number(&t, "efficiency_spread", digits, a->efficiency.spread, "");
        figures_number(&t, "light", has_json ? digits : "%.5f", a->ratio, "");
        figures_add(&t, FIGURE_WORD, "verdict", i ? verdict_names[a->is] : "");
        if (has_json) {
            figures_number(&t, "deviations", "%.9g", a->whole, "");
            figures_number(&t, "worst_block", "%.9g", a->worst, "");
            figures_number(&t, "mean_square", "%.9g", a->mean_square, "");
            figures_number(&t, "width", "%.0f", f->width, "");
            figures_number(&t, "height", "%.0f", f->height, "");
            figures_number(&t, "lost", "%.0f", (double)f->counts.lost, "");
            figures_add(&t, FIGURE_WORD, "interrupted", is_whole ? "no" : "yes");
        }
    }
    int good = figures_print(stdout, &t, w->form);
    figures_free(&t);
    return good;
}

/* What the films say; STATUS_NO if one shows something else. */
static int tell(const render_work *w, int is_whole)
{
    const comparison *c = &w->ways;
    const film *f = &c->way[0].film;
    const double seconds = fmax(f->seconds, 1e-9), paths = (double)film_pixels(f) * (double)f->samples;
    finding found[SAMPLERS];
    int status = STATUS_GOOD;
    comparison_find(c, found);
    for (size_t i = 0; i < c->count; i++) {
        const finding *a = &found[i];
        if (a->is != VERDICT_DIFFERS)
            continue;
        status = STATUS_NO;
        complain(
            name,
            "%s shows something else: light by %+.1f standard deviations, at worst a block by %+.1f, at (%d, %d)",
            path_sampler_names[c->way[i].sampler], a->whole, a->worst, a->x, a->y);
    }
    if (w->form == FIGURES_TEXT) {
        printf("%d x %d pixels, %llu samples each%s\n", f->width, f->height, (unsigned long long)f->samples,
               is_whole ? "" : " (interrupted)");
        printf("%.3g s on %u thread%s: %.3g paths/s, %.3g rays a path\n", seconds, c->threads,
               c->threads == 1 ? "" : "s", paths / seconds, (double)f->counts.rays / paths);
        if (f->counts.lost)
            printf("%llu samples were not finite and count as black\n", (unsigned long long)f->counts.lost);
    }
    if (w->form != FIGURES_NONE && (w->form == FIGURES_JSON || c->count > 1) && !print_rows(w, found, is_whole))
        return complain(name, "no memory for figures");
    return status;
}

static int save(render_work *w)
{
    image made;
    int is_made = comparison_image(&w->ways, w->is_pfm ? 1.0f : (float)w->exposure, &made);
    if (is_made && !(w->is_pfm ? image_write_pfm : image_write_png)(w->output.file, &made))
        is_made = ferror(w->output.file); /* which is told by closing */
    image_free(&made);
    return is_made ? output_commit(&w->output) : output_give_up(&w->output, "no memory for the picture");
}

/* With a picture, which is open, or figures alone. */
static int render(render_work *w)
{
    comparison *c = &w->ways;
    progress line = progress_begin(c->count > 1 ? "comparing" : "rendering", w->form == FIGURES_NONE);
    line.tells_left = 1;
    c->progress = progress_show;
    c->user = &line;
    const int is_whole = comparison_run(c);
    progress_end(&line);
    if (!is_whole && c->count > 1) {
        complain(name, "interrupted; nothing was written");
        return w->path ? output_give_up(&w->output, NULL) : STATUS_USE;
    }
    const int status = w->path && !w->output.path ? STATUS_GOOD : tell(w, is_whole);
    if (status == STATUS_USE)
        return w->path ? output_give_up(&w->output, NULL) : status;
    fflush(stdout); /* a signal that waits ends the program when the picture is saved */
    const int saved = w->path ? save(w) : STATUS_GOOD;
    return saved != STATUS_GOOD ? saved : status;
}

static int run(const arguments *given)
{
    const char *path = given->positional.item[0];
    render_work w;
    size_t length;
    int status = STATUS_USE;
    if (option_value(given, "--grammar"))
        return scene_print_manual(), STATUS_GOOD;
    if (!given->positional.count)
        return complain(name, "SCENE is missing; `%s --help` has an example", name);
    if (!read_words(given, &w))
        return STATUS_USE;
    char *text = input_read(name, path, SCENE_BYTES_MAX, &length);
    scene *s = text ? scene_read(path, text, length, (int)w.width) : NULL;
    if (s && comparison_begin(&w.ways, s) && (!w.path || output_open(&w.output, name, w.path))) {
        w.ways.samples = w.samples ? (uint64_t)w.samples : (uint64_t)s->samples;
        w.exposure = w.exposure > 0 ? w.exposure : s->exposure;
        status = render(&w);
    }
    comparison_end(&w.ways);
    scene_free(s);
    return status;
}

const subcommand command_render = {
    name, "a picture of a scene, by one sampler or several side by side", "SCENE", 0, 1, run, help};
