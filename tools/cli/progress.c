#define _POSIX_C_SOURCE 200809L
#include "cli/progress.h"

#include <math.h>
#include <time.h>
#include <unistd.h>

#include "cli/output.h"

static double seconds_of(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double clock_seconds(void)
{
    return seconds_of(CLOCK_MONOTONIC);
}

double clock_processor_seconds(void)
{
    return seconds_of(CLOCK_PROCESS_CPUTIME_ID);
}

enum { BAR = 20 };

static const double between = 0.1; /* seconds, from line to line */

progress progress_begin(const char *name, int is_quiet)
{
    return (progress){.name = name, .is_seen = !is_quiet && isatty(STDERR_FILENO), .begun = clock_seconds()};
}

void progress_step(progress *p, double to)
{
    p->from = p->to;
    p->to = fmin(to, 1);
    p->shown = 0;
}

static void show(progress *p, double all, const char *what)
{
    char bar[BAR + 1] = "";
    double spent = clock_seconds() - p->begun;
    for (int i = 0; i < BAR; i++)
        bar[i] = i < all * BAR ? '#' : '.';
    fprintf(stderr, "\r\033[K%s [%s] %3.0f%%", p->name, bar, 100 * all);
    if (p->tells_left && spent > 1 && all > 0)
        fprintf(stderr, ", %.0f s left", spent * (1 - all) / all);
    if (what)
        fprintf(stderr, " %.60s", what);
    fputc('\r', stderr); /* what is printed to stdout begins its line */
    fflush(stderr);
}

int progress_show(double done, const char *what, void *user)
{
    progress *p = user;
    double now = clock_seconds(), to = p->to > 0 ? p->to : 1;
    if (p->is_seen && now - p->shown >= between) {
        show(p, fmin(fmax(p->from + done * (to - p->from), 0), 1), what);
        p->shown = now;
    }
    return output_stopping();
}

void progress_end(const progress *p)
{
    if (p->is_seen)
        fputs("\r\033[K", stderr);
}
