/* A comparison: its ways (ways.c), a reference that is rendered or read, the contest, and its page. */
#include "compare/ways.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/arguments.h"
#include "command.h"
#include "cli/output.h"

enum { REFERENCE_TIMES = 4 };

/* ---- rendering ----------------------------------------------------------------------------------- */

/* Seconds for a sample of all pixels, from half a second of the first way. */
static double sample_seconds(const under_way *run)
{
    const way *w = &run->contest.way[0];
    film f;
    film_run some = {.samples = 1000000, .seconds = 0.5, .threads = run->contest.threads, .seed = 1};
    int good = film_make(&f, w->scene->width, w->scene->height) && film_render(&f, w->plan, &some);
    double seconds = good ? f.seconds / (double)f.samples : 1;
    film_free(&f);
    return seconds;
}

/* Of a pixel; 0 if the reference is read. */
static double reference_samples(const under_way *run)
{
    const compare_choice *c = run->choice;
    if (c->reference)
        return 0;
    return c->reference_spp ? (double)c->reference_spp : REFERENCE_TIMES * (double)run->contest.samples;
}

/* The work beside the reference, in samples of one way. */
static double ways_samples(const under_way *run)
{
    return (double)run->contest.samples * (double)run->contest.count * (run->choice->table_count ? 2 : 1);
}

/* As many as fit into the seconds, the reference included. */
static void choose_samples(under_way *run)
{
    const compare_choice *c = run->choice;
    run->contest.samples = c->spp ? c->spp : 1;
    if (c->spp)
        return;
    double fit = c->seconds / sample_seconds(run), each = ways_samples(run);
    if (c->reference_spp)
        fit -= reference_samples(run);
    else
        each += reference_samples(run);
    run->contest.samples = (uint64_t)fmax(floor(fit / each), 4);
}

static int stopped(const under_way *run)
{
    return output_stopping(run->progress.held) ? complain(run->choice->command, "interrupted; nothing was written")
                                               : complain(run->choice->command, "no memory for the films");
}

static int render_reference(under_way *run)
{
    const compare_choice *c = run->choice;
    const way *w = &run->contest.way[0];
    film_run whole = {.samples = (uint64_t)reference_samples(run),
                      .threads = run->contest.threads,
                      .seed = c->seed + 1000003,
                      .progress = progress_tell,
                      .user = &run->progress};
    char message[512];
    path_plan *plan =
        path_prepare(w->scene, c->table_count ? SAMPLER_MATERIAL : SAMPLER_VISIBLE, 0, message, sizeof message);
    if (!plan)
        return complain(run->choice->command, "the reference: %s", message);
    int good = film_make(&run->reference, w->scene->width, w->scene->height) &&
               film_render(&run->reference, plan, &whole);
    path_free(plan);
    snprintf(run->reference_is, sizeof run->reference_is, "%llu samples %s", (unsigned long long)whole.samples,
             c->table_count ? "of the first way" : "of visible normals");
    return good ? STATUS_GOOD : stopped(run);
}

/* An image as a film of one sample, whose noise nobody knows. */
static int film_of_image(film *f, const image *from)
{
    size_t count = 3 * (size_t)from->width * (size_t)from->height;
    if (!film_make(f, from->width, from->height))
        return 0;
    for (size_t i = 0; i < count; i++)
        f->sum[i] = (double)from->rgb[i];
    f->samples = 1;
    return 1;
}

static int read_reference(under_way *run)
{
    const char *path = run->choice->reference;
    const scene *s = run->contest.way[0].scene;
    image_error error;
    image read;
    if (!image_read_pfm(&read, path, &error))
        return complain(run->choice->command, "--reference: %s", error.message);
    int fits = read.width == s->width && read.height == s->height;
    int good = fits && film_of_image(&run->reference, &read);
    if (!fits)
        complain(run->choice->command, "--reference '%s': it is %d x %d pixels, the film %d x %d", path,
                 read.width, read.height, s->width, s->height);
    image_free(&read);
    snprintf(run->reference_is, sizeof run->reference_is, "%.80s", path);
    run->result.reference_read = 1;
    return good ? STATUS_GOOD : fits ? stopped(run) : STATUS_USE;
}

/* The same numbers for all ways, twice. */
static int find_common(under_way *run)
{
    contest *c = &run->contest;
    film more[WAYS_MAX] = {{0}};
    int good = contest_repeat(c, c->seed + 2000003, more);
    for (size_t i = 1; i < c->count && good; i++) {
        const film of[2] = {c->way[i].at_samples, more[i]}, exact[2] = {c->way[0].at_samples, more[0]};
        run->result.common[i] = common_error(of, exact, &run->result.common_noise[i]);
    }
    for (size_t i = 0; i < c->count; i++)
        film_free(&more[i]);
    run->result.has_common = good;
    return good ? STATUS_GOOD : stopped(run);
}

static int render(under_way *run)
{
    contest *c = &run->contest;
    choose_samples(run);
    double once = (double)c->count * (double)c->samples, all = ways_samples(run) + reference_samples(run);
    progress_step(&run->progress, run->progress.to + reference_samples(run) / all);
    int status = run->choice->reference ? read_reference(run) : render_reference(run);
    c->reference = &run->reference;
    progress_step(&run->progress, run->progress.to + once / all);
    if (status == STATUS_GOOD && !contest_run(c))
        status = stopped(run);
    progress_step(&run->progress, 1);
    return status == STATUS_GOOD && run->choice->table_count ? find_common(run) : status;
}

/* ---- telling ------------------------------------------------------------------------------------- */

/* At the end of the remarks, as much as fits. */
static void remark_lost(comparison *r, const way *w)
{
    size_t at = strlen(r->remarks);
    if (w->film.counts.samples_lost)
        snprintf(r->remarks + at, sizeof r->remarks - at,
                 "%s: %llu of %llu samples were not finite and count as "
                 "black. ",
                 w->name, (unsigned long long)w->film.counts.samples_lost,
                 (unsigned long long)w->film.counts.paths);
}

static int judge(under_way *run)
{
    comparison *r = &run->result;
    const scene *s = run->contest.way[0].scene;
    r->contest = &run->contest;
    r->title = s->title ? s->title : "A scene in several ways";
    r->arguments = run->choice->arguments;
    r->exposure = s->integrator.exposure;
    r->by = run->choice->table_count ? "tables" : "normals";
    r->reference_is = run->reference_is;
    for (size_t i = 0; i < run->contest.count; i++) {
        r->agrees[i] = agreement_between(&run->contest.way[i].at_time, &run->reference);
        remark_lost(r, &run->contest.way[i]);
    }
    return choose_crops(&run->contest, r->exposure, r->crops);
}

static int tell(under_way *run, const char *folder, folder_state state)
{
    html_page page = {.html = NULL};
    int status = judge(run) && comparison_page(&page, &run->result)
                     ? folder_write(run->choice->command, folder, page.file, page.count, run->progress.held)
                     : complain(run->choice->command, "no memory for the page");
    if (status == STATUS_GOOD) {
        if (!comparison_print(stdout, &run->result))
            status = complain(run->choice->command, "no memory for the tables");
        printf("\n%s %s/index.html\n", state == FOLDER_OURS ? "replaced" : "wrote", folder);
    }
    page_free(&page);
    return status;
}

static void free_run(under_way *run)
{
    contest_free(&run->contest);
    film_free(&run->reference);
    ways_free(run);
}

/* Signals end the program as long as scenes are read and tables made; then they wait. */
int compare_run(const compare_choice *c, const char *folder, folder_state state)
{
    under_way *run = calloc(1, sizeof *run);
    if (!run)
        return complain(c->command, "no memory");
    run->choice = c;
    run->progress = progress_begin("comparing", 0);
    run->contest = (contest){
        .threads = (unsigned)c->threads, .seed = c->seed, .progress = progress_tell, .user = &run->progress};
    progress_show(0, "reading the scene, making its tables", &run->progress);
    int status = ways_prepare(run);
    run->progress = progress_begin("comparing", output_hold_signals());
    run->progress.tells_left = 1;
    if (status == STATUS_GOOD)
        status = render(run);
    progress_end(&run->progress);
    if (status == STATUS_GOOD)
        status = tell(run, folder, state);
    output_release_signals(run->progress.held);
    free_run(run);
    free(run);
    return status;
}
