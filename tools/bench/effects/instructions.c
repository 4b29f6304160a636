/* Instructions for a sample. The program runs itself under `valgrind --tool=callgrind` with the option --run, for one
 * set and one block of inputs. One run does the block once, another twice: start-up cancels in the difference. */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/effects/effects.h"

extern char **environ;

enum { WORD = 64, PATH_LENGTH = 4096, ARGUMENTS = 16 };

/* ---- a process --------------------------------------------------------------------------------- */

/* Runs argv[0], found in PATH, without stdout and with stderr to a pipe. Returns 0 or an errno. */
static int start(char *const argv[], int from[2], pid_t *child)
{
    posix_spawn_file_actions_t actions;
    if (pipe(from) != 0)
        return errno;
    int failed = posix_spawn_file_actions_init(&actions);
    if (!failed) {
        failed = posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        failed = failed ? failed : posix_spawn_file_actions_adddup2(&actions, from[1], STDERR_FILENO);
        failed = failed ? failed : posix_spawn_file_actions_addclose(&actions, from[0]);
        failed = failed ? failed : posix_spawnp(child, argv[0], &actions, NULL, argv, environ);
        posix_spawn_file_actions_destroy(&actions);
    }
    close(from[1]);
    if (failed)
        close(from[0]);
    return failed;
}

/* The number in a line "==123== Collected : 456", or NaN. Reads the whole text. */
static double collected_in(FILE *text)
{
    char line[512];
    unsigned long long count = 0;
    double found = NAN;
    while (fgets(line, sizeof line, text)) {
        const char *at = strstr(line, "Collected :");
        if (at && sscanf(at, "Collected : %llu", &count) == 1)
            found = (double)count;
    }
    return found;
}

/* The instructions of a run; NaN if it did not end well. */
static double collect(char *const argv[], int *failed)
{
    int from[2], status = 1;
    pid_t child;
    *failed = start(argv, from, &child);
    if (*failed)
        return NAN;
    FILE *text = fdopen(from[0], "r");
    double count = text ? collected_in(text) : NAN;
    if (text)
        fclose(text);
    else
        close(from[0]);
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
        continue;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? count : NAN;
}

/* ---- one set ------------------------------------------------------------------------------------ */

typedef struct worker {
    char program[PATH_LENGTH];
    const char *path; /* of the distribution */
    char alpha[WORD];
} worker;

static double count_passes(const worker *w, const effects_set *set, const char *passes, int *failed)
{
    const char *argv[ARGUMENTS] = {"valgrind",
                                   "--tool=callgrind",
                                   "--callgrind-out-file=/dev/null",
                                   w->program,
                                   "bench",
                                   "effects",
                                   "--run",
                                   set->name,
                                   "--passes",
                                   passes,
                                   "--distribution",
                                   w->path,
                                   "--alpha",
                                   w->alpha,
                                   NULL};
    return collect((char *const *)argv, failed);
}

static int find_program(char program[PATH_LENGTH])
{
    ssize_t length = readlink("/proc/self/exe", program, PATH_LENGTH - 1);
    if (length <= 0)
        return 0;
    program[length] = '\0';
    return 1;
}

static const char *path_of(const effects_plan *plan, const effects_entry *e)
{
    for (size_t i = 0; i < plan->count; i++)
        if (plan->of[i].distribution == e->subject.surface.distribution)
            return plan->of[i].path;
    return NULL;
}

static int count_entry(worker *w, effects_entry *e, const effects_plan *plan, char *why, size_t size)
{
    int failed;
    w->path = path_of(plan, e);
    if (!w->path)
        return 1;
    double once = count_passes(w, e->subject.set, "1", &failed);
    double twice = failed ? NAN : count_passes(w, e->subject.set, "2", &failed);
    e->row.instructions = (twice - once) / EFFECTS_BLOCK;
    if (failed)
        snprintf(why, size, "valgrind: %s", strerror(failed));
    else if (isnan(e->row.instructions))
        snprintf(why, size, "valgrind ran, but told no number for %s, %s", e->subject.set->name, e->distribution);
    return !failed && !isnan(e->row.instructions);
}

vndf_status effects_count(effects_list *list, const effects_plan *plan, char *why, size_t size)
{
    worker w = {.path = NULL};
    why[0] = '\0';
    snprintf(w.alpha, sizeof w.alpha, "%.9g,%.9g", (double)plan->alpha_x, (double)plan->alpha_y);
    if (!find_program(w.program)) {
        snprintf(why, size, "this program does not find itself (no /proc/self/exe)");
        return VNDF_OK;
    }
    for (size_t i = 0; i < list->count; i++) {
        effects_entry *e = &list->entry[i];
        if (!e->shown || e->of_variance || e->row.wrong)
            continue;
        if (progress_show((double)i / (double)list->count, "counting instructions", plan->progress))
            return VNDF_ERROR_ARGUMENT;
        if (!count_entry(&w, e, plan, why, size))
            break;
    }
    return VNDF_OK;
}
