#define _XOPEN_SOURCE 700 /* SIGXFSZ */
#include "cli/output.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/arguments.h"
#include "command.h"
#include "cli/files.h"

/* The wrong way round, so that reading from a stdin that was closed fails, as writing to a stdout does. */
int output_begin(void)
{
    static const int modes[] = {O_WRONLY, O_RDONLY, O_RDONLY};
    for (int i = 0; i < 3; i++)
        if (fcntl(i, F_GETFD) < 0 && open("/dev/null", modes[i]) != i)
            return 0;
#ifdef SIGXFSZ
    signal(SIGXFSZ, SIG_IGN);
#endif
    return 1;
}

enum { STOPPING = 3 };

static const int stopping[STOPPING] = {SIGINT, SIGTERM, SIGHUP};

/* Of output_hold_signals: those that wait, and how many callers want that. */
static sigset_t held;
static int holders;

/* A signal that the parent told us to ignore, or holds itself, is left alone: it would count as pending for ever, or be
 * let through by us. */
void output_hold_signals(void)
{
    struct sigaction action;
    sigset_t before;
    if (holders++)
        return;
    sigemptyset(&held);
    sigprocmask(SIG_BLOCK, NULL, &before);
    for (int i = 0; i < STOPPING; i++)
        if (sigaction(stopping[i], NULL, &action) == 0 && action.sa_handler != SIG_IGN &&
            !sigismember(&before, stopping[i]))
            sigaddset(&held, stopping[i]);
    sigprocmask(SIG_BLOCK, &held, NULL);
}

void output_release_signals(void)
{
    if (--holders == 0)
        sigprocmask(SIG_UNBLOCK, &held, NULL);
}

int output_stopping(void)
{
    sigset_t pending;
    int stops = 0;
    sigpending(&pending);
    for (int i = 0; holders && i < STOPPING; i++)
        stops |= sigismember(&held, stopping[i]) && sigismember(&pending, stopping[i]);
    return stops;
}

int output_is_stdout(const char *path)
{
    return strcmp(path, "-") == 0;
}

int output_open(output_file *output, const char *command, const char *path)
{
    struct stat is;
    const output_file opened = {.command = command, .path = output_is_stdout(path) ? NULL : path, .file = stdout};
    *output = (output_file){.command = NULL};
    if (!opened.path)
        return *output = opened, 1;
    if (path[0] == '\0')
        return denied(command, "the name of the output file is empty");
    if (stat(path, &is) == 0 && !S_ISREG(is.st_mode))
        return denied(command, "'%s' is a %s; the output has to be a file", path,
                      S_ISDIR(is.st_mode) ? "folder" : "device or a pipe (- is stdout)");
    const char *role = files_note(path, 1);
    if (role)
        return denied(command, "'%s' is not replaced: it is %s", path, role);
    output_hold_signals();
    if (vndf_replace_begin(&output->replaces, path)) {
        *output = (output_file){command, path, output->replaces.file, output->replaces};
        return 1;
    }
    complain(command, "cannot write '%s': %s", path, strerror(errno));
    output_release_signals();
    return 0;
}

/* The error is cleared once it is told, so that it is told once. */
int output_finish_stdout(const char *command)
{
    if (vndf_replace_flush(stdout))
        return STATUS_GOOD;
    clearerr(stdout);
    if (errno != EPIPE)
        complain(command, "cannot write to stdout%s%s", errno ? ": " : "", errno ? strerror(errno) : "");
    return STATUS_USE;
}

static int written(const output_file *output, int good)
{
    return good ? STATUS_GOOD
                : complain(output->command, "cannot write '%s': %s", output->path,
                           errno ? strerror(errno) : "write failed");
}

int output_commit_all(output_file *output, size_t count, int status)
{
    for (output_file *o = output; o < output + count && status == STATUS_GOOD; o++)
        if (o->command)
            status = o->path ? written(o, vndf_replace_flush(o->file)) : output_finish_stdout(o->command);
    for (output_file *o = output + count; o-- > output;)
        if (o->command && status != STATUS_GOOD)
            output_give_up(o, NULL);
        else if (o->path) {
            status = written(o, vndf_replace_commit(&o->replaces));
            output_release_signals();
        }
    return status;
}

int output_commit(output_file *output)
{
    return output_commit_all(output, 1, STATUS_GOOD);
}

/* First the temporary goes, there may be nobody to complain to and a signal for trying; the signals that waited
 * are let through last, when all is said. */
int output_give_up(output_file *output, const char *why)
{
    if (output->path)
        vndf_replace_discard(&output->replaces);
    if (why)
        complain(output->command, "%s", why);
    if (output->path)
        output_release_signals();
    return STATUS_USE;
}

int output_form(const char *command, const char *path, const char *const *forms)
{
    const char *dot = strrchr(path, '.');
    if (output_is_stdout(path))
        return 0;
    for (int i = 0; forms[i] && dot; i++)
        if (strcmp(dot + 1, forms[i]) == 0)
            return i;
    return complain(command, "-o '%s': the name must end in %s, or be - for stdout", path, list_words(forms, ".")),
           -1;
}
