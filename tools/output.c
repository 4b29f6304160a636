#define _POSIX_C_SOURCE 200809L
#include "output.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "arguments.h"
#include "command.h"

/* ---- signals ------------------------------------------------------------------------------------- */

enum { STOPPING_COUNT = 3 };

static const int stopping[STOPPING_COUNT] = {SIGINT, SIGTERM, SIGHUP};

static sigset_t set_of(unsigned held)
{
    sigset_t set;
    sigemptyset(&set);
    for (unsigned i = 0; i < STOPPING_COUNT; i++)
        if (held >> i & 1u)
            sigaddset(&set, stopping[i]);
    return set;
}

/* A signal that the parent told us to ignore, or holds itself, is left alone: it would count as
 * pending for ever, or be let through by us. */
unsigned output_hold_signals(void)
{
    unsigned held = 0;
    sigset_t before;
    sigprocmask(SIG_BLOCK, NULL, &before);
    for (unsigned i = 0; i < STOPPING_COUNT; i++) {
        struct sigaction action;
        if (sigaction(stopping[i], NULL, &action) == 0 && action.sa_handler != SIG_IGN &&
            !sigismember(&before, stopping[i]))
            held |= 1u << i;
    }
    sigset_t set = set_of(held);
    sigprocmask(SIG_BLOCK, &set, NULL);
    return held;
}

void output_release_signals(unsigned held)
{
    sigset_t set = set_of(held);
    sigprocmask(SIG_UNBLOCK, &set, NULL);
}

int output_stopping(unsigned held)
{
    sigset_t pending;
    if (sigpending(&pending) != 0)
        return 0;
    for (unsigned i = 0; i < STOPPING_COUNT; i++)
        if ((held >> i & 1u) && sigismember(&pending, stopping[i]))
            return 1;
    return 0;
}

int output_interrupted(const output_file *output)
{
    return output->temporary && output_stopping(output->held);
}

void output_ignore_size_signal(void)
{
#ifdef SIGXFSZ
    signal(SIGXFSZ, SIG_IGN);
#endif
}

/* ---- opening ------------------------------------------------------------------------------------- */

int output_replaceable(const char *command, const char *path)
{
    struct stat status;
    if (path[0] == '\0') {
        complain(command, "the name of the output file is empty");
        return 0;
    }
    if (stat(path, &status) != 0 || S_ISREG(status.st_mode))
        return 1;
    complain(command, "'%s' is not a file that can be replaced", path);
    return 0;
}

static char *temporary_beside(const char *path)
{
    size_t size = strlen(path) + 32;
    char *name = malloc(size);
    if (name)
        snprintf(name, size, "%s.%ld.tmp", path, (long)getpid());
    return name;
}

/* O_EXCL: never write through something that another user put there. */
static FILE *create_new(const char *path)
{
    int descriptor = open(path, O_WRONLY | O_CREAT | O_EXCL, 0666);
    FILE *file = descriptor < 0 ? NULL : fdopen(descriptor, "wb");
    if (descriptor >= 0 && !file)
        close(descriptor);
    return file;
}

static int open_file(output_file *output)
{
    output->temporary = temporary_beside(output->path);
    if (!output->temporary) {
        complain(output->command, "no memory");
        return 0;
    }
    output->held = output_hold_signals();
    output->file = create_new(output->temporary);
    if (output->file)
        return 1;
    complain(output->command, "cannot write '%s': %s", output->path, strerror(errno));
    output_release_signals(output->held);
    free(output->temporary);
    return 0;
}

int output_open(output_file *output, const char *command, const char *path)
{
    output->command = command;
    output->path = path;
    output->temporary = NULL;
    if (strcmp(path, "-") != 0)
        return output_replaceable(command, path) && open_file(output);
    output->path = NULL;
    output->file = stdout;
    return 1;
}

/* ---- closing ------------------------------------------------------------------------------------- */

/* Flushes; 0 and errno if that or any write before failed. Of a write before, the reason may be lost: another
 * one, of a byte that nobody will read, shows it. */
static int flush(FILE *file)
{
    int failed_before = ferror(file);
    errno = 0;
    if (fflush(file) == 0 && !failed_before)
        return 1;
    if (errno == 0 && write(fileno(file), "", 1) >= 0)
        errno = 0; /* it would work by now */
    return 0;
}

/* The error is cleared once it is told, so that it is told once. */
int output_finish_stdout(const char *command)
{
    if (flush(stdout))
        return STATUS_GOOD;
    clearerr(stdout);
    if (errno != EPIPE)
        complain(command, "cannot write to stdout%s%s", errno ? ": " : "", errno ? strerror(errno) : "");
    return STATUS_USE;
}

static void close_file(output_file *output)
{
    free(output->temporary);
    output->temporary = NULL;
    output_release_signals(output->held);
}

/* To the disk before the rename, so that a crash leaves the old file or the new one; not every file can be
 * synced. */
static int close_and_rename(output_file *output)
{
    int good = flush(output->file) && (fsync(fileno(output->file)) == 0 || errno == EINVAL || errno == EROFS);
    int reason = errno, closed = fclose(output->file) == 0;
    if (!good)
        errno = reason;
    return good && closed && rename(output->temporary, output->path) == 0;
}

int output_commit(output_file *output)
{
    if (!output->temporary)
        return output_finish_stdout(output->command);
    if (close_and_rename(output)) {
        close_file(output);
        return STATUS_GOOD;
    }
    int reason = errno;
    remove(output->temporary);
    complain(output->command, "cannot write '%s': %s", output->path, reason ? strerror(reason) : "write failed");
    close_file(output);
    return STATUS_USE;
}

static void remove_temporary(output_file *output)
{
    if (!output->temporary)
        return;
    fclose(output->file);
    remove(output->temporary);
}

/* First the temporary goes, there may be nobody to complain to and a signal for trying; the signals that waited
 * are let through last, when all is said. */
int output_give_up(output_file *output, const char *why)
{
    remove_temporary(output);
    complain(output->command, "%s", why);
    if (output->temporary)
        close_file(output);
    return STATUS_USE;
}

void output_discard(output_file *output)
{
    remove_temporary(output);
    if (output->temporary)
        close_file(output);
}

static int is_usable(const char *command, const char *path)
{
    output_file output;
    if (!path || strcmp(path, "-") == 0)
        return 1;
    if (!output_open(&output, command, path))
        return 0;
    output_discard(&output);
    return 1;
}

int outputs_distinct(const char *command, const char *csv, const char *markdown)
{
    if (!is_usable(command, csv) || !is_usable(command, markdown))
        return 0;
    if (csv && markdown && strcmp(csv, markdown) == 0) {
        complain(command, "--csv and --markdown both name '%s'", csv);
        return 0;
    }
    return 1;
}

const char *output_extension(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot && !strchr(dot, '/') ? dot + 1 : "";
}
