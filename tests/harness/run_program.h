/* Runs the program as a user does, by a line for the shell, with quotes, files for stdin and stdout, limits and
 * signals. For tests whose property is about words, files and processes; POSIX. */
#pragma once

#ifndef _XOPEN_SOURCE
#  define _XOPEN_SOURCE 700 /* where this is the first header */
#endif

#include <dirent.h>
#include <signal.h>
#include <stdarg.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "harness/test.h"

enum { RUN_TEXT = 1 << 16 };

typedef struct run_outcome {
    int status;          /* of exit; 128 and its number for a signal */
    char text[RUN_TEXT]; /* stdout and stderr, their first bytes */
} run_outcome;

/* What becomes of a line, in which vndf is the program, for exec "$VNDF"; stdin is empty unless the line says
 * otherwise. It has to end with this status and to print these words. The outcome stays until the next is asked for. */
static inline const run_outcome *run_line(int status, const char *says, const char *format, ...)
{
    static run_outcome o;
    static char line[4096], whole[4200];
    const char *other = getenv("VNDF_PROGRAM"); /* see mutants.py */
    va_list list;
    va_start(list, format);
    vsnprintf(line, sizeof line, format, list);
    va_end(list);
    setenv("VNDF", other ? other : VNDF_PROGRAM, 1);
    snprintf(whole, sizeof whole, "exec 2>&1 </dev/null; vndf() { \"$VNDF\" \"$@\"; }\n%s", line);
    FILE *said = popen(whole, "r");
    o = (run_outcome){-1, ""};
    if (said) {
        o.text[fread(o.text, 1, sizeof o.text - 1, said)] = '\0';
        while (fgetc(said) != EOF) /* what does not fit */
            continue;
        int is = pclose(said);
        o.status = WIFSIGNALED(is) ? 128 + WTERMSIG(is) : WEXITSTATUS(is);
    }
    if (!(TEST(o.status == status) & TEST_HAS(o.text, says)))
        fprintf(stderr, "  %s: status %d, not %d, or without '%s':\n%.400s\n", line, o.status, status, says,
                o.text);
    return &o;
}

/* What a line prints that has to end with 0. */
#define run_said(into, ...) strcpy(into, run_line(0, "", __VA_ARGS__)->text)

/* A new folder to work in, which has to be empty at the end; signals are as a shell in the foreground leaves them. */
static inline int run_begin(char folder[])
{
    static const int signals[] = {SIGINT, SIGTERM, SIGHUP, SIGPIPE};
    for (int i = 0; i < 4; i++)
        signal(signals[i], SIG_DFL);
    return TEST(mkdtemp(folder) && chdir(folder) == 0);
}

static inline int run_put(const char *name, const char *text)
{
    FILE *file = fopen(name, "wb");
    int good = file && fputs(text, file) >= 0;
    return file && fclose(file) == 0 && good;
}

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
        count += strcmp(entry->d_name, ".") && strcmp(entry->d_name, "..") && strstr(entry->d_name, part);
    if (directory)
        closedir(directory);
    return directory ? count : -1;
}

/* A scene of a ball, small and quick. */
static const char run_scene[] =
    "camera --from 0,0,5 --to 0,0,0 --width 8 --height 8\nenvironment --constant 1,1,1\n"
    "material gold --conductor gold --distribution ggx --alpha 0.2\n"
    "sphere --centre 0,0,0 --radius 1 --material gold\n";

static inline int run_end(const char *folder)
{
    TEST(run_count(".", "") == 0 && chdir("..") == 0 && rmdir(folder) == 0);
    return test_done();
}
