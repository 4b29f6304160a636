/* How far the work is, on a line of stderr where that is a terminal; and whether the user asked to stop, by a signal
 * that waits (output_hold_signals). */
#pragma once

typedef struct progress {
    const char *name;    /* of the work: "building" */
    int tells_left;      /* how many seconds are left: where the work goes on evenly */
    int is_seen;         /* stderr is a terminal */
    double from, to;     /* the step at hand, as a part of all the work */
    double begun, shown; /* on the clock: the work; the last line */
} progress;

/* All the work is one step until progress_step divides it. */
progress progress_begin(const char *name, int is_quiet);

/* The next step, from where the last one ended (the first: 0) up to `to`, a part of all the work. */
void progress_step(progress *p, double to);

/* `done` of the step, 0 to 1, is done; what is under way, or NULL. Not 0: stop. A vndf_progress of a progress. */
int progress_show(double done, const char *what, void *user);

void progress_end(const progress *p);

/* Seconds that pass, on a clock that only goes forward; and seconds that all threads of this process worked. */
double clock_seconds(void);
double clock_processor_seconds(void);
