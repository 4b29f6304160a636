/* Whatever goes wrong around the program - a full disk, a folder that may not be written, a signal in the
 * middle, a reader that goes away - the old file stays whole, no temporary is left, and what is said is clear,
 * or nothing. */
#if defined(__unix__) || defined(__APPLE__)
#  define _XOPEN_SOURCE 700
#  define HAS_PROCESSES 1
#endif

#include "harness/test.h"

#ifdef HAS_PROCESSES

#  include <dirent.h>
#  include <errno.h>
#  include <fcntl.h>
#  include <signal.h>
#  include <stdlib.h>
#  include <sys/resource.h>
#  include <sys/stat.h>
#  include <sys/wait.h>
#  include <time.h>
#  include <unistd.h>

#  include "vndf_build.h"

enum { WORDS = 16, NOBODY = 65534, NOT_RUN = 126 };

static const char table[] = VNDF_SOURCE_DIR "/tables/student-t-2.5-small.vndf";
static const char old_text[] = "the old file\n";

/* ---- running the program ---- */

/* What is special about a child. */
typedef struct setting {
    int out, in;       /* descriptors for stdout and stdin; -1: /dev/null */
    rlim_t file_limit; /* bytes; 0: none */
    int unprivileged;  /* becomes nobody if it is root, whom no folder refuses */
    int ignores_pipe;
} setting;

static const setting plain = {-1, -1, 0, 0, 0};

typedef struct child {
    pid_t pid;
    int errors; /* the reading end of its stderr */
} child;

typedef struct outcome {
    int status; /* of waitpid */
    char errors[4096];
} outcome;

static void limit_file(rlim_t bytes)
{
    struct rlimit limit = {bytes, bytes};
    setrlimit(RLIMIT_FSIZE, &limit);
}

static void become(const setting *s, int errors)
{
    int null = open("/dev/null", O_RDWR);
    dup2(s->in < 0 ? null : s->in, 0);
    dup2(s->out < 0 ? null : s->out, 1);
    dup2(errors, 2);
    if (s->file_limit)
        limit_file(s->file_limit);
    signal(SIGPIPE, s->ignores_pipe ? SIG_IGN : SIG_DFL);
    if (s->unprivileged && geteuid() == 0 && (setgid(NOBODY) != 0 || setuid(NOBODY) != 0))
        _exit(NOT_RUN);
}

static child start(const setting *s, const char *const *words)
{
    int errors[2];
    child c = {-1, -1};
    char *argv[WORDS + 2] = {(char *)(size_t)(const void *)VNDF_PROGRAM};
    for (int i = 0; i < WORDS && words[i]; i++)
        argv[i + 1] = (char *)(size_t)(const void *)words[i];
    if (!TEST(pipe(errors) == 0))
        return c;
    c.pid = fork();
    if (c.pid == 0) {
        become(s, errors[1]);
        close(errors[0]);
        close(errors[1]);
        execv(VNDF_PROGRAM, argv);
        _exit(NOT_RUN);
    }
    close(errors[1]);
    c.errors = errors[0];
    return c;
}

static outcome finish(child c)
{
    outcome o = {0, ""};
    size_t used = 0;
    ssize_t got;
    while (used + 1 < sizeof o.errors && (got = read(c.errors, o.errors + used, sizeof o.errors - 1 - used)) > 0)
        used += (size_t)got;
    o.errors[used] = '\0';
    close(c.errors);
    waitpid(c.pid, &o.status, 0);
    return o;
}

static outcome run(const setting *s, const char *const *words)
{
    return finish(start(s, words));
}

static int exited(outcome o, int status)
{
    return WIFEXITED(o.status) && WEXITSTATUS(o.status) == status;
}

static int killed(outcome o, int number)
{
    return WIFSIGNALED(o.status) && WTERMSIG(o.status) == number;
}

/* ---- files ---- */

static void put_old(const char *name)
{
    FILE *file = fopen(name, "wb");
    TEST(file && fputs(old_text, file) >= 0);
    if (file)
        fclose(file);
}

static int is_old(const char *name)
{
    char text[64] = "";
    FILE *file = fopen(name, "rb");
    size_t size = file ? fread(text, 1, sizeof text - 1, file) : 0;
    if (file)
        fclose(file);
    return size == strlen(old_text) && strcmp(text, old_text) == 0;
}

/* Names in the folder that hold ".tmp". */
static int temporaries(void)
{
    int count = 0;
    DIR *folder = opendir(".");
    for (struct dirent *entry; folder && (entry = readdir(folder)) != NULL;)
        count += strstr(entry->d_name, ".tmp") != NULL;
    if (folder)
        closedir(folder);
    return count;
}

static void pause_for(long milliseconds)
{
    struct timespec time = {milliseconds / 1000, milliseconds % 1000 * 1000000};
    nanosleep(&time, NULL);
}

/* ---- full disks ---- */

static const char *const writers[][WORDS] = {
    {"build", "--family", "ggx", "--max-bytes", "2048", "-o", "old.vndf", NULL},
    {"sample", "ggx", "--theta", "60", "-n", "100000", "-o", "old.csv", NULL},
    {"sample", "ggx", "--theta", "60", "-n", "100000", "-o", "old.f32", NULL},
    {"plot", "ggx", "-o", "old.svg", NULL},
};

enum { WRITERS = sizeof writers / sizeof *writers };

static const char *output_of(const char *const *words)
{
    while (strcmp(*words, "-o") != 0)
        words++;
    return words[1];
}

/* A limit on the size of files stands for a full disk: writes come back short, then fail. */
static void test_full_disk(void)
{
    for (int i = 0; i < WRITERS; i++) {
        setting s = plain;
        const char *name = output_of(writers[i]);
        s.file_limit = 1000;
        put_old(name);
        outcome o = run(&s, writers[i]);
        if (!(TEST(exited(o, 2)) & TEST_HAS(o.errors, "cannot write") & TEST_HAS(o.errors, name) &
              TEST_HAS(o.errors, strerror(EFBIG)) & TEST(is_old(name)) & TEST(temporaries() == 0)))
            fprintf(stderr, "  %s: status %d, %s\n", name, o.status, o.errors);
        remove(name);
    }
}

static void test_full_stdout(void)
{
    static const char *const printers[][WORDS] = {
        {"info", "ggx", NULL},
        {"--help", NULL},
        {"build", "--list", NULL},
        {"sample", "ggx", "--theta", "60", "-n", "3", "-o", "-", NULL},
        {"sample", "ggx", "--theta", "60", "-n", "100000", "-o", "-", NULL},
        {"check", "ggx", "--at", "1,0,0,1,1,0.5,0", NULL}};
    setting s = plain;
    s.out = open("/dev/full", O_WRONLY);
    for (size_t i = 0; s.out >= 0 && i < sizeof printers / sizeof *printers; i++) {
        outcome o = run(&s, printers[i]);
        if (!(TEST(exited(o, 2)) & TEST_HAS(o.errors, "cannot write to stdout: ") &
              TEST_HAS(o.errors, strerror(ENOSPC))))
            fprintf(stderr, "  %s: status %d, %s\n", printers[i][0], o.status, o.errors);
    }
    if (s.out >= 0)
        close(s.out);
    else
        fprintf(stderr, "no /dev/full here\n");
}

/* ---- folders ---- */

static void test_no_folder(void)
{
    static const char *const words[] = {"build", "--family", "ggx", "-o", "old.vndf/table.vndf", NULL};
    static const char *const sample[] = {"sample", "ggx", "--theta",        "60", "-n",
                                         "3",      "-o",  "old.vndf/a.csv", NULL};
    put_old("old.vndf");
    outcome o = run(&plain, words);
    TEST(exited(o, 2));
    TEST_HAS(o.errors, "cannot write old.vndf/table.vndf");
    TEST_HAS(o.errors, strerror(ENOTDIR));
    o = run(&plain, sample);
    TEST(exited(o, 2) && strstr(o.errors, strerror(ENOTDIR)));
    TEST(is_old("old.vndf") && temporaries() == 0);
    remove("old.vndf");
}

static void test_read_only_folder(void)
{
    setting s = plain;
    s.unprivileged = 1;
    for (int i = 0; i < WRITERS; i++) {
        const char *name = output_of(writers[i]);
        put_old(name);
        chmod(".", 0555);
        outcome o = run(&s, writers[i]);
        chmod(".", 0755);
        if (exited(o, NOT_RUN))
            fprintf(stderr, "the program cannot be run as nobody here: no read-only folder was tried\n");
        else if (!(TEST(exited(o, 2)) & TEST_HAS(o.errors, name) & TEST_HAS(o.errors, strerror(EACCES)) &
                   TEST(is_old(name)) & TEST(temporaries() == 0)))
            fprintf(stderr, "  %s: status %d, %s\n", name, o.status, o.errors);
        remove(name);
    }
}

/* ---- signals ---- */

/* The signal comes while the program works: after `delay`, or once its temporary is there. */
static outcome interrupt_in(const setting *s, const char *const *words, int number, long delay,
                            int awaits_temporary)
{
    child c = start(s, words);
    for (int i = 0; awaits_temporary && i < 1000 && temporaries() == 0; i++)
        pause_for(10);
    pause_for(delay);
    kill(c.pid, number);
    return finish(c);
}

static outcome interrupt(const char *const *words, int number, long delay, int awaits_temporary)
{
    return interrupt_in(&plain, words, number, delay, awaits_temporary);
}

/* A build of many seconds. The child of a busy machine may not have begun it yet: then the signal waits longer. */
static void test_interrupted_build(int number)
{
    static const char *const words[] = {
        "build", "--slope", "exp(-r)*(1+0.9*sin(300*r))", "--max-bytes", "65536", "-o", "old.vndf", NULL};
    outcome o = {0, ""};
    put_old("old.vndf");
    for (long delay = 300; delay < 5000 && !o.errors[0]; delay *= 2)
        o = interrupt(words, number, delay, 0);
    if (!(TEST(killed(o, number)) & TEST_HAS(o.errors, "vndf build: interrupted") &
          TEST_HAS(o.errors, "'old.vndf' was not touched") & TEST(is_old("old.vndf")) & TEST(temporaries() == 0)))
        fprintf(stderr, "  signal %d: status %d, %s\n", number, o.status, o.errors);
    remove("old.vndf");
}

static void test_interrupted_sample(int number)
{
    static const char *const words[] = {"sample", "ggx", "--theta", "60", "-n", "1e9", "-o", "old.csv", NULL};
    put_old("old.csv");
    outcome o = interrupt(words, number, 0, 1);
    if (!(TEST(killed(o, number)) & TEST_HAS(o.errors, "vndf sample: interrupted") & TEST(is_old("old.csv")) &
          TEST(temporaries() == 0)))
        fprintf(stderr, "  signal %d: status %d, %s\n", number, o.status, o.errors);
    remove("old.csv");
}

/* Rows are written at the end, so that a signal before leaves the old ones. */
static void test_interrupted_bench(int number)
{
    static const char *const words[] = {"bench", "--only", "table", "--markdown", "old.csv", NULL};
    put_old("old.csv");
    outcome o = interrupt(words, number, 1000, 0);
    if (!(TEST(killed(o, number)) & TEST_HAS(o.errors, "vndf bench: interrupted") & TEST(is_old("old.csv")) &
          TEST(temporaries() == 0)))
        fprintf(stderr, "  signal %d: status %d, %s\n", number, o.status, o.errors);
    remove("old.csv");
}

static void put_scene(void)
{
    FILE *file = fopen("ball.scene", "w");
    TEST(file && fputs("film width 8 height 8\ncamera from 0 0 5 to 0 0 0\nenvironment constant 1 1 1\n"
                       "material gold conductor of gold distribution ggx alpha 0.2\n"
                       "sphere centre 0 0 0 radius 1 material gold\n",
                       file) >= 0);
    if (file)
        fclose(file);
}

/* What is there of a picture is saved, and it is said. On a busy machine even the first pass, of some
 * milliseconds, may not be there yet: then the signal waits longer. */
static void test_interrupted_render(void)
{
    static const char *const words[] = {"render", "ball.scene", "-o", "ball.pfm", "--spp",
                                        "1e9",    "--threads",  "1",  NULL};
    char said[256] = "";
    outcome o = {0, "before"};
    FILE *out = tmpfile();
    setting s = plain;
    put_scene();
    s.out = out ? fileno(out) : -1;
    for (long delay = 100; delay < 5000 && strstr(o.errors, "before"); delay *= 2)
        o = interrupt_in(&s, words, SIGINT, delay, 1);
    if (TEST(out != NULL) && fseek(out, 0, SEEK_SET) == 0)
        said[fread(said, 1, sizeof said - 1, out)] = '\0';
    if (!(TEST(killed(o, SIGINT)) & TEST(o.errors[0] == '\0') & TEST_HAS(said, "8 x 8 pixels, ") &
          TEST_HAS(said, " samples each (interrupted)") & TEST(temporaries() == 0) &
          TEST(remove("ball.pfm") == 0)))
        fprintf(stderr, "  status %d, %s\n", o.status, o.errors);
    if (out)
        fclose(out);
    remove("ball.scene");
}

static void test_interrupted_compare(void)
{
    static const char *const words[] = {"compare", "ball.scene", "page", "--spp", "1e8", "--threads", "1", NULL};
    outcome o = {0, ""};
    put_scene();
    for (long delay = 100; delay < 5000 && !o.errors[0]; delay *= 2)
        o = interrupt(words, SIGINT, delay, 0);
    if (!(TEST(killed(o, SIGINT)) & TEST_HAS(o.errors, "vndf compare: interrupted; nothing was written") &
          TEST(rmdir("page") != 0 && errno == ENOENT)))
        fprintf(stderr, "  status %d, %s\n", o.status, o.errors);
    remove("ball.scene");
}

/* ---- pipes ---- */

/* Reads one line and goes away; with `lines` 0 goes before the first. */
static outcome run_into_closed_pipe(const char *const *words, int ignores_pipe, int lines)
{
    int ends[2];
    char first[16];
    setting s = plain;
    outcome o = {0, "no pipe"};
    if (pipe(ends) != 0)
        return o;
    fcntl(ends[0], F_SETFD, FD_CLOEXEC);
    s.out = ends[1];
    s.ignores_pipe = ignores_pipe;
    if (!lines)
        close(ends[0]);
    child c = start(&s, words);
    close(ends[1]);
    if (lines) {
        TEST(read(ends[0], first, sizeof first) > 0);
        close(ends[0]);
    }
    return finish(c);
}

static void test_closed_pipe(void)
{
    static const char *const printers[][WORDS] = {
        {"sample", "ggx", "--theta", "60", "-n", "1000000", "-o", "-", NULL},
        {"sample", "ggx", "--theta", "60", "-n", "3", "-o", "-", NULL},
        {"info", table, NULL},
        {"build", "--list", NULL},
        {"check", "ggx", "--at", "1,0,0,1,1,0.5,0", NULL},
        {"build", "--family", "ggx", "--max-bytes", "2048", "-o", "new.vndf", NULL}};
    for (size_t i = 0; i < sizeof printers / sizeof *printers; i++)
        for (int ignores = 0; ignores < 2; ignores++) {
            outcome o = run_into_closed_pipe(printers[i], ignores, i == 0);
            if (!(TEST(ignores ? exited(o, 2) : killed(o, SIGPIPE)) & TEST(o.errors[0] == '\0')))
                fprintf(stderr, "  %s: status %d, %s\n", printers[i][0], o.status, o.errors);
        }
    vndf_distribution *built = vndf_load("new.vndf", NULL);
    TEST(built != NULL && temporaries() == 0); /* it is saved before it is described */
    vndf_free(built);
    remove("new.vndf");
}

static void test_closed_pipe_of_eval(void)
{
    static const char *const words[] = {"eval", "ggx", "--theta", "60", NULL};
    FILE *normals = fopen("normals.csv", "w+");
    setting s = plain;
    for (int i = 0; normals && i < 20000; i++)
        fputs("0.6,0,0.8\n", normals);
    for (int ignores = 0; normals && ignores < 2; ignores++) {
        int ends[2];
        fflush(normals);
        lseek(fileno(normals), 0, SEEK_SET);
        if (!TEST(pipe(ends) == 0))
            return;
        s.in = fileno(normals);
        s.out = ends[1];
        s.ignores_pipe = ignores;
        close(ends[0]);
        child c = start(&s, words);
        close(ends[1]);
        outcome o = finish(c);
        TEST(ignores ? exited(o, 2) : killed(o, SIGPIPE));
        TEST(o.errors[0] == '\0');
    }
    if (normals)
        fclose(normals);
    remove("normals.csv");
}

/* ---- the library ---- */

/* What a crash left under the temporary's name is neither overwritten nor in the way. */
static void test_taken_name(void)
{
    char taken[64];
    vndf_error error = {VNDF_OK, ""};
    vndf_distribution *loaded = vndf_load(table, &error);
    snprintf(taken, sizeof taken, "new.vndf.%ld.tmp", (long)getpid());
    put_old(taken);
    TEST(loaded && vndf_save(loaded, "new.vndf", &error) == VNDF_OK);
    vndf_distribution *again = vndf_load("new.vndf", &error);
    TEST(again && is_old(taken) && temporaries() == 1);
    vndf_free(loaded);
    vndf_free(again);
    remove(taken);
    remove("new.vndf");
}

int main(void)
{
    static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
    char folder[] = "processes.XXXXXX";
    if (!TEST(mkdtemp(folder) != NULL && chmod(folder, 0755) == 0 && chdir(folder) == 0))
        return test_done();
    test_full_disk();
    test_full_stdout();
    test_no_folder();
    test_read_only_folder();
    for (int i = 0; i < 3; i++) {
        test_interrupted_build(signals[i]);
        test_interrupted_sample(signals[i]);
        test_interrupted_bench(signals[i]);
    }
    test_interrupted_render();
    test_interrupted_compare();
    test_closed_pipe();
    test_closed_pipe_of_eval();
    test_taken_name();
    TEST(chdir("..") == 0 && rmdir(folder) == 0); /* nothing is left */
    return test_done();
}

#else

int main(void)
{
    puts("SKIPPED: no fork, pipes and signals here");
    return 0;
}

#endif
