/* Where the time goes: nanoseconds to make a view, to draw from it and to evaluate a density, one by one and in
 * batches, and a chart of them.
 *
 * For 4096 incident directions, uniform over the upper hemisphere, and roughness from 0.1 to 1: few enough to stay
 * in cache with a table, too many for a branch predictor to learn. Each loop is timed 11 times; the median counts.
 * Results are added up and the sum is read, so that no compiler leaves the work out. The time of a sample is the time
 * of view and sample together, less the view. */
#include <math.h>
#include <stdlib.h>

#include "draw/chart.h"
#include "draw/svg.h"
#include "cli/clock.h"
#include "cli/random.h"
#include "measure/turns.h"
#include "report/report.h"

enum { DIRECTIONS = 4096, TURNS = 11 };

static const double pi = 3.14159265358979323846;

typedef struct workload {
    vndf_surface surface[DIRECTIONS];
    vndf_vec3 wi[DIRECTIONS], wm[DIRECTIONS];
    vndf_view view[DIRECTIONS];
    float alpha[DIRECTIONS], x[DIRECTIONS], y[DIRECTIONS], z[DIRECTIONS], u1[DIRECTIONS], u2[DIRECTIONS];
    float out_x[DIRECTIONS], out_y[DIRECTIONS], out_z[DIRECTIONS], pdf[DIRECTIONS];
    float sum;
} workload;

static void fill(workload *w, const vndf_distribution *distribution)
{
    random_stream stream = random_from(1);
    for (int i = 0; i < DIRECTIONS; i++) {
        double z = random_double(&stream), phi = 2 * pi * random_double(&stream), s = sqrt(1 - z * z);
        w->alpha[i] = (float)(0.1 + 0.9 * random_double(&stream));
        w->x[i] = (float)(s * cos(phi));
        w->y[i] = (float)(s * sin(phi));
        w->z[i] = (float)z;
        w->wi[i] = (vndf_vec3){w->x[i], w->y[i], w->z[i]};
        w->surface[i] = (vndf_surface){distribution, w->alpha[i], w->alpha[i]};
        w->u1[i] = random_float(&stream);
        w->u2[i] = random_float(&stream);
        w->view[i] = vndf_view_from(&w->surface[i], w->wi[i]);
        w->wm[i] = vndf_sample(&w->view[i], w->u1[i], w->u2[i], NULL);
    }
    w->sum = 0;
}

/* ---- the loops ----------------------------------------------------------------------------------- */

typedef void loop(workload *w);

static void make_views(workload *w)
{
    for (int i = 0; i < DIRECTIONS; i++)
        w->sum += vndf_view_from(&w->surface[i], w->wi[i]).numbers[0];
}

static void draw_samples(workload *w)
{
    for (int i = 0; i < DIRECTIONS; i++) {
        float pdf;
        vndf_view view = vndf_view_from(&w->surface[i], w->wi[i]);
        w->sum += vndf_sample(&view, w->u1[i], w->u2[i], &pdf).z + pdf;
    }
}

static void evaluate(workload *w)
{
    for (int i = 0; i < DIRECTIONS; i++)
        w->sum += vndf_pdf(&w->view[i], w->wm[i]);
}

static void draw_batch(workload *w, unsigned shared)
{
    vndf_batch batch = {w->surface[0].distribution,
                        DIRECTIONS,
                        shared,
                        VNDF_INSTRUCTIONS_BEST,
                        w->alpha,
                        w->alpha,
                        w->x,
                        w->y,
                        w->z};
    vndf_normals out = {w->out_x, w->out_y, w->out_z};
    vndf_sample_n(&batch, w->u1, w->u2, out, w->pdf);
    w->sum += w->pdf[DIRECTIONS / 2];
}

static void draw_apart(workload *w)
{
    draw_batch(w, 0);
}

static void draw_shared(workload *w)
{
    draw_batch(w, VNDF_SHARED_ALPHA | VNDF_SHARED_WI);
}

typedef struct timed_loop {
    workload *w;
    loop *run;
} timed_loop;

static int take_turn(void *user, size_t turn, double *number)
{
    const timed_loop *t = user;
    (void)turn;
    double begin = clock_seconds();
    t->run(t->w);
    *number = 1e9 * (clock_seconds() - begin) / DIRECTIONS;
    return 1;
}

/* Times a loop by itself: another loop would leave other data in the caches. */
static double time_loop(workload *w, loop *run)
{
    timed_loop timed = {w, run};
    turns_quartiles found = {(double)NAN, (double)NAN, (double)NAN};
    const turns_plan plan = {.series = 1, .least = TURNS, .most = TURNS, .take = take_turn, .user = &timed};
    turns_run(&plan, &found); /* NaN if there is no memory */
    return found.median;
}

report_time report_time_of(const vndf_distribution *distribution)
{
    report_time none = {(double)NAN, (double)NAN, (double)NAN, (double)NAN, (double)NAN};
    workload *w = malloc(sizeof *w);
    if (!w)
        return none;
    fill(w, distribution);
    double view = time_loop(w, make_views);
    report_time time = {view, time_loop(w, draw_samples) - view, time_loop(w, evaluate), time_loop(w, draw_apart),
                        time_loop(w, draw_shared)};
    int good = isfinite(w->sum); /* always: densities of valid views are finite, but no compiler knows */
    free(w);
    return good ? time : none;
}

/* ---- the section --------------------------------------------------------------------------------- */

enum { PARTS = 5, LINES_MAX = REPORT_SIZES + 2 };

static const char *const part_names[PARTS] = {"view", "sample, density included", "density of a given normal",
                                              "in a batch: view, sample, density",
                                              "in a batch, one direction for all"};

typedef struct time_line {
    char name[48];
    double part[PARTS];
} time_line;

static time_line line_of(const char *name, const report_time *t)
{
    time_line line = {"", {t->view, t->sample, t->pdf, t->batch, t->batch_shared}};
    snprintf(line.name, sizeof line.name, "%s", name);
    return line;
}

static size_t lines_of(const report *r, time_line lines[LINES_MAX])
{
    size_t count = 0;
    lines[count++] = line_of("ggx, closed form", &r->ggx);
    lines[count++] = line_of("beckmann, closed form", &r->beckmann);
    for (size_t i = 0; i < r->subject[0].count; i++) {
        char size[16], name[48];
        table_bytes_text(size, (double)r->subject[0].table[i].info.bytes);
        snprintf(name, sizeof name, "table, %s", size);
        lines[count++] = line_of(name, &r->subject[0].table[i].time);
    }
    return count;
}

static double longest(const time_line *lines, size_t count)
{
    double most = 1;
    for (size_t i = 0; i < count; i++)
        most = fmax(most, fmax(lines[i].part[0] + lines[i].part[1] + lines[i].part[2],
                               fmax(lines[i].part[3], lines[i].part[4])));
    return most;
}

/* The end of the axis: a round number of steps. */
static double nice_step(double most)
{
    double power = pow(10, floor(log10(most / 4)));
    double lead = most / 4 / power;
    return power * (lead > 5 ? 10 : lead > 2 ? 5 : lead > 1 ? 2 : 1);
}

enum { ROW = 54, BAR = 14, LEFT = 170, WIDE = 640, RIGHT = 120 };

/* Draws parts `from` to `to` end to end, and their lengths as numbers. */
static void draw_bar(FILE *file, double y, const time_line *line, int from, int to, double per_ns)
{
    double x = LEFT;
    for (int p = from; p < to; p++) {
        fprintf(file, "<rect class=\"f%d\" x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"/>\n", p, x, y,
                line->part[p] * per_ns, BAR - 2.0);
        x += line->part[p] * per_ns;
    }
    fprintf(file, "<text class=\"tick quiet\" x=\"%.1f\" y=\"%.1f\">", x + 5, y + BAR - 3.5);
    for (int p = from; p < to; p++)
        fprintf(file, "%s%.*f", p > from ? " + " : "", line->part[p] < 10, line->part[p]);
    fputs("</text>\n", file);
}

static void draw_legend(FILE *file, double y)
{
    for (int p = 0; p < PARTS; p++) {
        double x = 10 + 250 * (p % 3), at = y + 20 * (p / 3);
        fprintf(file,
                "<rect class=\"f%d\" x=\"%.1f\" y=\"%.1f\" width=\"14\" height=\"12\"/>\n"
                "<text class=\"ink\" x=\"%.1f\" y=\"%.1f\">%s</text>\n",
                p, x, at - 10, x + 20, at, part_names[p]);
    }
}

static void draw_axis(FILE *file, double most, double step, double bottom, double per_ns)
{
    for (double ns = 0; ns <= most * 1.001; ns += step)
        fprintf(file,
                "<path class=\"grid\" d=\"M%.1f 50V%.1f\"/>\n<text class=\"tick quiet\" text-anchor=\"middle\" "
                "x=\"%.1f\" y=\"%.1f\">%g</text>\n",
                LEFT + ns * per_ns, bottom, LEFT + ns * per_ns, bottom + 16, ns);
    fprintf(file,
            "<text class=\"ink\" text-anchor=\"middle\" x=\"%.1f\" y=\"%.1f\">nanoseconds per sample</text>\n",
            LEFT + most * per_ns / 2, bottom + 36);
}

static void draw_times(FILE *file, const time_line *lines, size_t count)
{
    double most = longest(lines, count), step = nice_step(most), per_ns;
    most = step * ceil(most / step);
    per_ns = WIDE / most;
    double bottom = 56 + (double)ROW * (double)count;
    fprintf(file,
            "<svg class=\"chart\" width=\"%d\" height=\"%.0f\" viewBox=\"0 0 %d %.0f\" role=\"img\" "
            "aria-label=\"time of view, sample and pdf\">\n",
            LEFT + WIDE + RIGHT, bottom + 48, LEFT + WIDE + RIGHT, bottom + 48);
    draw_legend(file, 16);
    draw_axis(file, most, step, bottom, per_ns);
    for (size_t i = 0; i < count; i++) {
        double y = 58 + (double)ROW * (double)i;
        fprintf(file, "<text class=\"ink\" text-anchor=\"end\" x=\"%d\" y=\"%.1f\">%s</text>\n", LEFT - 8, y + 25,
                lines[i].name);
        draw_bar(file, y, &lines[i], 0, 3, per_ns);
        draw_bar(file, y + BAR, &lines[i], 3, 4, per_ns);
        draw_bar(file, y + 2 * BAR, &lines[i], 4, PARTS, per_ns);
    }
    fputs("</svg>\n", file);
}

int report_write_time(html_page *page, const report *r)
{
    time_line lines[LINES_MAX];
    size_t count = lines_of(r, lines);
    page_section(
        page, "time", "Where the time goes",
        "Median nanoseconds on this machine, one thread, tables in cache. First bar: the calls one by one, a "
        "direction each; a sample needs the first two parts, the third is for a normal from elsewhere. Second "
        "and third bar: a sample of a batch. Each loop runs by itself; where methods take turns, as in error "
        "against time, they start colder and take longer.");
    fputs("<figure class=\"scroll wide\">\n", page->html);
    draw_times(page->html, lines, count);
    fprintf(page->html, "<figcaption>Tables are those of ");
    svg_escape(page->html, r->subject[0].name);
    fputs(".</figcaption></figure>\n", page->html);
    text_table data = {.rows = 0};
    for (size_t i = 0; i < count; i++) {
        static const char *const fields[PARTS] = {"view_ns", "sample_ns", "pdf_ns", "batch_ns", "batch_shared_ns"};
        table_row(&data);
        table_text(&data, "sampler", lines[i].name);
        for (int p = 0; p < PARTS; p++)
            table_value(&data, fields[p], lines[i].part[p]);
    }
    int good = page_data(page, "time.csv", "nanoseconds of each part", data);
    page_section_end(page);
    return good;
}
