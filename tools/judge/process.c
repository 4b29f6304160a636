/* The command's stdin and stdout are temporary files, so that neither side waits for the other. */
#define _XOPEN_SOURCE 700
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/arguments.h"
#include "judge/judge.h"

enum { LINE = 512 };

static void print_query(char text[LINE], const query *q)
{
    snprintf(text, LINE, "%c %.9g %.9g %.9g %.9g %.9g %.9g", q->kind, (double)q->wi.x, (double)q->wi.y,
             (double)q->wi.z, (double)q->x.x, (double)q->x.y, (double)q->x.z);
}

/* 1, or 0 after a complaint. What is written beyond LINE bytes for each query is not taken, so that no disk fills. */
static int run(const char *who, const char *command, size_t queries, FILE *in, FILE *out)
{
    struct rlimit was, limit;
    struct stat written;
    fflush(stdout);
    getrlimit(RLIMIT_FSIZE, &was);
    limit = was;
    limit.rlim_cur = (rlim_t)(LINE * (queries + 1));
    int stdin_was = dup(0), stdout_was = dup(1), status = -1;
    if (dup2(fileno(in), 0) >= 0 && dup2(fileno(out), 1) >= 0)
        status = setrlimit(RLIMIT_FSIZE, &limit) == 0 ? system(command) : -1;
    int reason = errno;
    setrlimit(RLIMIT_FSIZE, &was);
    dup2(stdin_was, 0);
    dup2(stdout_was, 1);
    close(stdin_was);
    close(stdout_was);
    if (status == -1)
        return complain(who, "'%s' cannot be run: %s", command, strerror(reason)), 0;
    if (fstat(fileno(out), &written) == 0 && (rlim_t)written.st_size >= limit.rlim_cur)
        return complain(who, "'%s' writes without an end: more than %d bytes for each of %zu queries", command,
                        LINE, queries),
               0;
    if (WIFSIGNALED(status))
        return complain(who, "'%s' was ended by signal %d", command, WTERMSIG(status)), 0;
    if (WEXITSTATUS(status) != 0)
        return complain(who, "'%s' ended with status %d%s", command, WEXITSTATUS(status),
                        WEXITSTATUS(status) == 127 ? ": there is no such command" : ", which has to be 0"),
               0;
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
    char line[LINE], asked[LINE];
    for (size_t i = 0; i < count; i++) {
        const int is_sample = queries[i].kind == 's';
        double number[4] = {0, 0, 0, 0};
        print_query(asked, &queries[i]);
        if (!fgets(line, sizeof line, out))
            return complain(who, "%zu of %zu queries were answered; the next is: %s", i, count, asked), 0;
        if (!read_numbers(line, is_sample ? 4 : 1, is_sample ? number : number + 3))
            return complain(who, "line %zu, '%.*s', is not %s; it answers: %s", i + 1, (int)strcspn(line, "\r\n"),
                            line, is_sample ? "wm.x wm.y wm.z pdf" : "a number, pdf", asked),
                   0;
        answers[i] = (answer){number[0], number[1], number[2], number[3]};
    }
    if (fgets(line, sizeof line, out))
        return complain(who, "there are more answers than the %zu queries", count), 0;
    return 1;
}

answer *process_ask(const char *who, const char *command, const query *queries, size_t count)
{
    char text[LINE];
    FILE *in = tmpfile(), *out = tmpfile();
    answer *answers = queries ? malloc(count * sizeof *answers) : NULL;
    int good = answers && in && out;
    for (size_t i = 0; i < count && good; i++) {
        print_query(text, &queries[i]);
        good = fprintf(in, "%s\n", text) > 0;
    }
    if (!answers)
        complain(who, "no memory");
    else if (!good || fflush(in) != 0 || fseek(in, 0, SEEK_SET) != 0)
        good = !complain(who, "a temporary file cannot be written: %s", strerror(errno));
    else
        good = run(who, command, count, in, out) && fseek(out, 0, SEEK_SET) == 0 &&
               read_answers(who, out, queries, count, answers);
    if (in)
        fclose(in);
    if (out)
        fclose(out);
    if (good)
        return answers;
    free(answers);
    return NULL;
}
