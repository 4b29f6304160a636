/* The command's stdin and stdout are temporary files, so that neither side waits for the other. It is a process group
 * of its own, which ends as a whole: when it is silent for too long, when the user stops the program, when it ends. */
#define _XOPEN_SOURCE 700
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "cli/arguments.h"
#include "cli/output.h"
#include "judge/judge.h"

/* Close to 1 nine digits are the number for those who read a float alone. */
static int digits(float x)
{
    return x > 0.99f ? 17 : 9;
}

void process_line(char text[JUDGE_LINE], const query *q, const query *before)
{
    static int start;
    if (!before || before->kind != q->kind || memcmp(&before->wi, &q->wi, sizeof q->wi) != 0)
        start = sprintf(text, "%c %.9g %.9g %.9g", q->kind, (double)q->wi.x, (double)q->wi.y, (double)q->wi.z);
    sprintf(text + start, " %.*g %.*g %.*g", digits(q->x.x), (double)q->x.x, digits(q->x.y), (double)q->x.y,
            digits(q->x.z), (double)q->x.z);
}

static pid_t begin(const char *command, rlim_t bytes, FILE *in, FILE *out)
{
    fflush(stdout);
    const pid_t child = fork();
    if (child != 0)
        return child;
    struct rlimit limit;
    setpgid(0, 0);
    output_release_signals();
    getrlimit(RLIMIT_FSIZE, &limit);
    limit.rlim_cur = bytes < limit.rlim_max ? bytes : limit.rlim_max;
    if (dup2(fileno(in), 0) >= 0 && dup2(fileno(out), 1) >= 0 && setrlimit(RLIMIT_FSIZE, &limit) == 0)
        execl("/bin/sh", "sh", "-c", command, (char *)NULL);
    _exit(127);
}

/* The status that it ended with; -1: it wrote nothing for too long, or the user stops. */
static int wait_for(pid_t child, double timeout, FILE *out)
{
    struct timespec pause = {0, 500000};
    struct stat written = {0};
    double since = clock_seconds();
    int status = -1;
    for (off_t before = 0; waitpid(child, &status, WNOHANG) == 0; nanosleep(&pause, NULL)) {
        pause.tv_nsec = pause.tv_nsec < 16000000 ? 2 * pause.tv_nsec : pause.tv_nsec;
        if (fstat(fileno(out), &written) == 0 && written.st_size != before)
            since = clock_seconds();
        before = written.st_size;
        if (clock_seconds() - since > timeout || output_stopping()) {
            kill(-child, SIGKILL);
            waitpid(child, &status, 0);
            return -1;
        }
    }
    kill(-child, SIGKILL);
    return status;
}

/* 1, or 0 after a complaint. What is written beyond a line for each query is not taken, so that no disk fills. */
static int run(const judge_task *task, size_t queries, FILE *in, FILE *out)
{
    const rlim_t bytes = (rlim_t)(JUDGE_LINE * (queries + 1));
    const char *who = task->who, *command = task->command;
    struct stat written;
    output_hold_signals();
    const pid_t child = begin(command, bytes, in, out);
    const int reason = errno, status = child > 0 ? wait_for(child, task->timeout, out) : -1;
    output_release_signals();
    if (child < 0)
        return denied(who, "'%s' cannot be run: %s", command, strerror(reason));
    if (fstat(fileno(out), &written) == 0 && (rlim_t)written.st_size >= bytes)
        return denied(who, "'%s' writes without an end: more than %d bytes for each of %zu queries", command,
                      JUDGE_LINE, queries);
    if (status == -1)
        return denied(who, "'%s' wrote nothing for %g s and was ended; --timeout allows it longer", command,
                      task->timeout);
    if (WIFSIGNALED(status))
        return denied(who, "'%s' was ended by signal %d", command, WTERMSIG(status));
    if (WEXITSTATUS(status) != 0)
        return denied(who, "'%s' ended with status %d%s", command, WEXITSTATUS(status),
                      WEXITSTATUS(status) == 127 ? ": there is no such command" : ", which has to be 0");
    return 1;
}

/* Whether a line is so many numbers and nothing else. */
static int read_numbers(const char *line, size_t count, double *number)
{
    for (size_t i = 0; i < count; i++) {
        char *end;
        number[i] = strtod(line, &end);
        if (end == line || !strchr(" \t\r\n", *end))
            return 0;
        line = end;
    }
    return line[strspn(line, " \t\r\n")] == '\0';
}

static int read_answers(const char *who, FILE *out, const query *queries, size_t count, answer *answers)
{
    char line[JUDGE_LINE], asked[JUDGE_LINE];
    for (size_t i = 0; i < count; i++) {
        const int is_sample = queries[i].kind == 's';
        double number[4] = {0, 0, 0, 0};
        const int is_there = fgets(line, sizeof line, out) != NULL;
        if (!is_there || !read_numbers(line, is_sample ? 4 : 1, is_sample ? number : number + 3)) {
            process_line(asked, &queries[i], NULL);
            if (!is_there)
                return denied(who, "%zu of %zu queries were answered; the next is: %s", i, count, asked);
            return denied(who, "line %zu, '%.*s', is not %s; it answers: %s", i + 1, (int)strcspn(line, "\r\n"),
                          line, is_sample ? "wm.x wm.y wm.z pdf" : "a number, pdf", asked);
        }
        answers[i] = (answer){number[0], number[1], number[2], number[3]};
    }
    if (fgets(line, sizeof line, out))
        return denied(who, "there are more answers than the %zu queries", count);
    return 1;
}

answer *process_ask(const judge_task *task, const query *queries, size_t count)
{
    char text[JUDGE_LINE];
    FILE *in = tmpfile(), *out = tmpfile();
    answer *answers = queries ? malloc(count * sizeof *answers) : NULL;
    int good = answers && in && out;
    for (size_t i = 0; i < count && good; i++) {
        process_line(text, &queries[i], i ? &queries[i - 1] : NULL);
        good = fputs(text, in) >= 0 && putc('\n', in) >= 0;
    }
    if (!answers)
        complain(task->who, "no memory");
    else if (!good || fflush(in) != 0 || fseek(in, 0, SEEK_SET) != 0)
        good = denied(task->who, "a temporary file cannot be written: %s", strerror(errno));
    else
        good = run(task, count, in, out) && fseek(out, 0, SEEK_SET) == 0 &&
               read_answers(task->who, out, queries, count, answers);
    if (in)
        fclose(in);
    if (out)
        fclose(out);
    if (good)
        return answers;
    free(answers);
    return NULL;
}
