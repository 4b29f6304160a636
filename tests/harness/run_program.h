/* Runs the program as a shell would: words, files for stdin and stdout, limits and signals. For tests whose property is
 * about processes and files; POSIX. */
#ifndef TESTS_HARNESS_RUN_PROGRAM_H
#define TESTS_HARNESS_RUN_PROGRAM_H

#ifndef _XOPEN_SOURCE
#  define _XOPEN_SOURCE 700 /* where this is the first header */
#endif

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "harness/test.h"

enum { RUN_WORDS = 24, RUN_NOT_RUN = 126, RUN_TEXT = 1 << 16 };

typedef struct run_setting {
    const char *in;    /* what stdin is opened from; NULL: /dev/null */
    int out;           /* a descriptor in the place of stdout; 0: `text` of the outcome, as stderr */
    rlim_t file_limit; /* bytes of a file, for a full disk; 0: none */
    int ignores_pipe;
} run_setting;

static const run_setting run_plain = {.in = NULL};

typedef struct run_outcome {
    int status;          /* of exit; -1: another end */
    int signal;          /* that ended it; 0: none */
    char text[RUN_TEXT]; /* stdout and stderr, their first bytes */
} run_outcome;

/* In the child: its files, `said` being the pipe, a limit, and signals as a shell in the foreground leaves them. */
static inline void run_become(const run_setting *s, int said)
{
    static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
    const struct rlimit limit = {s->file_limit, s->file_limit};
    int in = open(s->in ? s->in : "/dev/null", O_RDONLY);
    if (in < 0 || dup2(in, 0) < 0 || dup2(s->out ? s->out : said, 1) < 0 || dup2(said, 2) < 0 ||
        (s->file_limit && setrlimit(RLIMIT_FSIZE, &limit) != 0))
        _exit(RUN_NOT_RUN);
    for (int i = 3; i < 64; i++)
        close(i);
    for (int i = 0; i < 3; i++)
        signal(signals[i], SIG_DFL);
    signal(SIGPIPE, s->ignores_pipe ? SIG_IGN : SIG_DFL);
}

static inline void run_read(int from, run_outcome *o)
{
    char more[4096];
    size_t used = 0;
    ssize_t got;
    while ((got = read(from, o->text + used, sizeof o->text - 1 - used)) > 0)
        used += (size_t)got;
    o->text[used] = '\0';
    while (read(from, more, sizeof more) > 0) /* what does not fit */
        continue;
}

typedef struct run_child {
    pid_t pid;
    int said; /* the reading end of its text */
} run_child;

/* words: ended by NULL. */
static inline run_child run_start(const run_setting *s, const char *const *words)
{
    int ends[2];
    run_child c = {-1, -1};
    const char *other = getenv("VNDF_PROGRAM"), *program = other ? other : VNDF_PROGRAM; /* see mutants.py */
    char *argv[RUN_WORDS + 2] = {(char *)(size_t)(const void *)program};
    for (int i = 0; i < RUN_WORDS && words[i]; i++)
        argv[i + 1] = (char *)(size_t)(const void *)words[i];
    if (!TEST(pipe(ends) == 0))
        return c;
    c.pid = fork();
    if (c.pid == 0) {
        run_become(s, ends[1]);
        execv(program, argv);
        _exit(RUN_NOT_RUN);
    }
    close(ends[1]);
    c.said = ends[0];
    return c;
}

/* The outcome stays until the next is asked for. */
static inline const run_outcome *run_finish(run_child c)
{
    static run_outcome o;
    int status = 0;
    o = (run_outcome){-1, 0, ""};
    if (c.pid < 0)
        return &o;
    run_read(c.said, &o);
    close(c.said);
    waitpid(c.pid, &status, 0);
    o.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    o.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    return &o;
}

static inline const run_outcome *run_program(const run_setting *s, const char *const *words)
{
    return run_finish(run_start(s, words));
}

/* The same of a line, whose words are between single blanks. */
static inline const run_outcome *run_line(const run_setting *s, const char *line)
{
    char text[512], *at = text;
    const char *words[RUN_WORDS + 1] = {NULL};
    snprintf(text, sizeof text, "%s", line);
    for (int i = 0; at && *text && i < RUN_WORDS; i++) {
        words[i] = at;
        at = strchr(at, ' ');
        if (at)
            *at++ = '\0';
    }
    return run_program(s, words);
}

/* What a line prints that has to end with 0; it may read `in`. */
static inline char *run_said(char into[RUN_TEXT], const char *in, const char *line)
{
    const run_setting s = {.in = in};
    const run_outcome *o = run_line(&s, line);
    if (!TEST(o->status == 0))
        fprintf(stderr, "  vndf %s: %.300s\n", line, o->text);
    return strcpy(into, o->text);
}

static inline void run_pause(long milliseconds)
{
    const struct timespec time = {milliseconds / 1000, milliseconds % 1000 * 1000000};
    nanosleep(&time, NULL);
}

/* ---- files ---- */

/* The whole file, to be freed, with its size; NULL if it is not there. */
static inline char *run_file(const char *name, size_t *size)
{
    struct stat is;
    FILE *file = fopen(name, "rb");
    char *text = file && fstat(fileno(file), &is) == 0 ? calloc(1, (size_t)is.st_size + 1) : NULL;
    *size = text ? fread(text, 1, (size_t)is.st_size, file) : 0;
    if (file)
        fclose(file);
    return text;
}

/* Names in a folder that hold `part`, without . and ..; -1: there is no such folder. */
static inline int run_count(const char *folder, const char *part)
{
    DIR *directory = opendir(folder);
    const struct dirent *entry;
    int count = 0;
    while (directory && (entry = readdir(directory)) != NULL)
        count +=
            strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0 && strstr(entry->d_name, part);
    if (!directory)
        return -1;
    closedir(directory);
    return count;
}

static inline int run_put(const char *name, const char *text)
{
    FILE *file = fopen(name, "wb");
    int good = file && fputs(text, file) >= 0;
    return file && fclose(file) == 0 && good;
}

/* Whether a file has exactly this text. */
static inline int run_has(const char *name, const char *text)
{
    size_t size;
    char *found = run_file(name, &size);
    int same = found && size == strlen(text) && memcmp(found, text, size) == 0;
    free(found);
    return same;
}

static inline int run_same(const char *a, const char *b)
{
    size_t size_of_a, size_of_b;
    char *in_a = run_file(a, &size_of_a), *in_b = run_file(b, &size_of_b);
    int same = in_a && in_b && size_of_a == size_of_b && memcmp(in_a, in_b, size_of_a) == 0;
    free(in_a);
    free(in_b);
    return same;
}

static inline int run_copy(const char *from, const char *to)
{
    size_t size;
    char *bytes = run_file(from, &size);
    FILE *file = fopen(to, "wb");
    int good = bytes && file && fwrite(bytes, 1, size, file) == size;
    free(bytes);
    return file && fclose(file) == 0 && good;
}

/* A scene of a ball, small and quick. */
static const char run_scene[] = "film width 8 height 8\ncamera from 0 0 5 to 0 0 0\nenvironment constant 1 1 1\n"
                                "material gold conductor of gold distribution ggx alpha 0.2\n"
                                "sphere centre 0 0 0 radius 1 material gold\n";

/* The outcome of words that have to end with this status; `in` may be NULL. */
static inline const run_outcome *run_expect(int status, const char *in, const char *const *words)
{
    const run_setting s = {.in = in};
    const run_outcome *o = run_program(&s, words);
    if (TEST(o->status == status))
        return o;
    fputs("  vndf", stderr);
    for (int i = 0; i < RUN_WORDS && words[i]; i++)
        fprintf(stderr, " %s", words[i]);
    fprintf(stderr, ": status %d, signal %d\n%.300s\n", o->status, o->signal, o->text);
    return o;
}

#define RUN_LIST(...)   \
  (const char *const[]) \
  {                     \
    __VA_ARGS__, NULL   \
  }

/* A new folder to work in, which has to be empty at the end. */
static inline int run_begin(char folder[])
{
    return TEST(mkdtemp(folder) && chdir(folder) == 0);
}

static inline int run_end(const char *folder)
{
    TEST(run_count(".", "") == 0 && chdir("..") == 0 && rmdir(folder) == 0);
    return test_done();
}

#endif
