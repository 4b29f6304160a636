/* Whatever goes wrong around the program - a full disk, a folder that may not be written, a signal in the
 * middle, a reader that goes away - the old file stays whole, no temporary is left, and what is said is clear,
 * or nothing. */
#if defined(__unix__) || defined(__APPLE__)
#  define _XOPEN_SOURCE 700
#  define HAS_PROCESSES 1
#endif

#include "harness/test.h"

#ifdef HAS_PROCESSES

#  include <errno.h>

#  include "harness/run_program.h"
#  include "vndf_build.h"

static const char table[] = VNDF_SOURCE_DIR "/tables/student-t-2.5-small.vndf";
static const char old_text[] = "the old file\n";

/* stdout of nearly all programs here; what they say is their stderr. */
static int null;

static void put_old(const char *name)
{
    TEST(run_put(name, old_text));
}

static int is_old(const char *name)
{
    return run_has(name, old_text);
}

static int temporaries(void)
{
    return run_count(".", ".tmp");
}

/* ---- full disks ---- */

static const char *const writers[][RUN_WORDS] = {
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
        const run_setting s = {.out = null, .file_limit = 1000};
        const char *name = output_of(writers[i]);
        put_old(name);
        const run_outcome *o = run_program(&s, writers[i]);
        if (!(TEST(o->status == 2) & TEST_HAS(o->text, "cannot write") & TEST_HAS(o->text, name) &
              TEST_HAS(o->text, strerror(EFBIG)) & TEST(is_old(name)) & TEST(temporaries() == 0)))
            fprintf(stderr, "  %s: status %d, %s\n", name, o->status, o->text);
        remove(name);
    }
}

static void test_full_stdout(void)
{
    static const char *const printers[][RUN_WORDS] = {
        {"info", "ggx", NULL},
        {"--help", NULL},
        {"build", "--list", NULL},
        {"sample", "ggx", "--theta", "60", "-n", "3", "-o", "-", NULL},
        {"sample", "ggx", "--theta", "60", "-n", "100000", "-o", "-", NULL},
        {"check", "ggx", "--samples", "1000", NULL}};
    const run_setting s = {.out = open("/dev/full", O_WRONLY)};
    for (size_t i = 0; s.out > 0 && i < sizeof printers / sizeof *printers; i++) {
        const run_outcome *o = run_program(&s, printers[i]);
        if (!(TEST(o->status == 2) & TEST_HAS(o->text, "cannot write to stdout: ") &
              TEST_HAS(o->text, strerror(ENOSPC))))
            fprintf(stderr, "  %s: status %d, %s\n", printers[i][0], o->status, o->text);
    }
    if (s.out > 0)
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
    const run_setting s = {.out = null};
    const run_outcome *o = run_program(&s, words);
    TEST(o->status == 2);
    TEST_HAS(o->text, "cannot write old.vndf/table.vndf");
    TEST_HAS(o->text, strerror(ENOTDIR));
    o = run_program(&s, sample);
    TEST(o->status == 2 && strstr(o->text, strerror(ENOTDIR)));
    TEST(is_old("old.vndf") && temporaries() == 0);
    remove("old.vndf");
}

static void test_read_only_folder(void)
{
    const run_setting s = {.out = null, .unprivileged = 1};
    for (int i = 0; i < WRITERS; i++) {
        const char *name = output_of(writers[i]);
        put_old(name);
        chmod(".", 0555);
        const run_outcome *o = run_program(&s, writers[i]);
        chmod(".", 0755);
        if (o->status == RUN_NOT_RUN)
            fprintf(stderr, "the program cannot be run as nobody here: no read-only folder was tried\n");
        else if (!(TEST(o->status == 2) & TEST_HAS(o->text, name) & TEST_HAS(o->text, strerror(EACCES)) &
                   TEST(is_old(name)) & TEST(temporaries() == 0)))
            fprintf(stderr, "  %s: status %d, %s\n", name, o->status, o->text);
        remove(name);
    }
}

/* ---- signals ---- */

/* The signal comes while the program works: after `delay`, or once its temporary is there. */
static const run_outcome *interrupt(int out, const char *const *words, int number, long delay,
                                    int awaits_temporary)
{
    const run_setting s = {.out = out};
    run_child c = run_start(&s, words);
    for (int i = 0; awaits_temporary && i < 1000 && temporaries() == 0; i++)
        run_pause(10);
    run_pause(delay);
    kill(c.pid, number);
    return run_finish(c);
}

/* A build of many seconds. The child of a busy machine may not have begun it yet: then the signal waits longer. */
static void test_interrupted_build(int number)
{
    static const char *const words[] = {
        "build", "--slope", "exp(-r)*(1+0.9*sin(300*r))", "--max-bytes", "65536", "-o", "old.vndf", NULL};
    const run_outcome *o = NULL;
    put_old("old.vndf");
    for (long delay = 300; delay < 5000 && (!o || !o->text[0]); delay *= 2)
        o = interrupt(null, words, number, delay, 0);
    if (!(TEST(o->signal == number) & TEST_HAS(o->text, "vndf build: interrupted") &
          TEST_HAS(o->text, "'old.vndf' was not touched") & TEST(is_old("old.vndf")) & TEST(temporaries() == 0)))
        fprintf(stderr, "  signal %d: status %d, %s\n", number, o->status, o->text);
    remove("old.vndf");
}

static void test_interrupted_sample(int number)
{
    static const char *const words[] = {"sample", "ggx", "--theta", "60", "-n", "1e9", "-o", "old.csv", NULL};
    put_old("old.csv");
    const run_outcome *o = interrupt(null, words, number, 0, 1);
    if (!(TEST(o->signal == number) & TEST_HAS(o->text, "vndf sample: interrupted") & TEST(is_old("old.csv")) &
          TEST(temporaries() == 0)))
        fprintf(stderr, "  signal %d: status %d, %s\n", number, o->status, o->text);
    remove("old.csv");
}

/* Rows are written at the end, so that a signal before leaves the old ones. */
static void test_interrupted_bench(int number)
{
    static const char *const words[] = {"bench", "--only", "table", "--markdown", "old.csv", NULL};
    put_old("old.csv");
    const run_outcome *o = interrupt(null, words, number, 1000, 0);
    if (!(TEST(o->signal == number) & TEST_HAS(o->text, "vndf bench: interrupted") & TEST(is_old("old.csv")) &
          TEST(temporaries() == 0)))
        fprintf(stderr, "  signal %d: status %d, %s\n", number, o->status, o->text);
    remove("old.csv");
}

/* What is there of a picture is saved, and it is said. On a busy machine even the first pass, of some
 * milliseconds, may not be there yet: then the signal waits longer. */
static void test_interrupted_render(void)
{
    static const char *const words[] = {"render", "ball.scene", "-o", "ball.pfm", "--spp",
                                        "1e9",    "--threads",  "1",  NULL};
    char said[256] = "";
    const run_outcome *o = NULL;
    FILE *out = tmpfile();
    TEST(run_put("ball.scene", run_scene));
    for (long delay = 100; delay < 5000 && (!o || strstr(o->text, "before")); delay *= 2)
        o = interrupt(out ? fileno(out) : null, words, SIGINT, delay, 1);
    if (TEST(out != NULL) && fseek(out, 0, SEEK_SET) == 0)
        said[fread(said, 1, sizeof said - 1, out)] = '\0';
    if (!(TEST(o->signal == SIGINT) & TEST(o->text[0] == '\0') & TEST_HAS(said, "8 x 8 pixels, ") &
          TEST_HAS(said, " samples each (interrupted)") & TEST(temporaries() == 0) &
          TEST(remove("ball.pfm") == 0)))
        fprintf(stderr, "  status %d, %s\n", o->status, o->text);
    if (out)
        fclose(out);
    remove("ball.scene");
}

static void test_interrupted_compare(void)
{
    static const char *const words[] = {"render",    "ball.scene", "--compare", "visible,all", "--spp", "1e8",
                                        "--threads", "1",          "-o",        "sheet.png",   NULL};
    const run_outcome *o = NULL;
    TEST(run_put("ball.scene", run_scene));
    for (long delay = 100; delay < 5000 && (!o || !o->text[0]); delay *= 2)
        o = interrupt(null, words, SIGINT, delay, 0);
    if (!(TEST(o->signal == SIGINT) & TEST_HAS(o->text, "vndf render: interrupted; nothing was written") &
          TEST(remove("sheet.png") != 0 && errno == ENOENT) & TEST(temporaries() == 0)))
        fprintf(stderr, "  status %d, %s\n", o->status, o->text);
    remove("ball.scene");
}

/* ---- pipes ---- */

/* Reads one line and goes away; with `lines` 0 goes before the first. */
static const run_outcome *run_into_closed_pipe(const char *in, const char *const *words, int ignores_pipe,
                                               int lines)
{
    int ends[2];
    char first[16];
    if (!TEST(pipe(ends) == 0))
        return run_finish((run_child){-1, -1});
    const run_setting s = {.in = in, .out = ends[1], .ignores_pipe = ignores_pipe};
    if (!lines)
        close(ends[0]);
    run_child c = run_start(&s, words);
    close(ends[1]);
    if (lines) {
        TEST(read(ends[0], first, sizeof first) > 0);
        close(ends[0]);
    }
    return run_finish(c);
}

static void test_closed_pipe(void)
{
    static const char *const printers[][RUN_WORDS] = {
        {"sample", "ggx", "--theta", "60", "-n", "1000000", "-o", "-", NULL},
        {"sample", "ggx", "--theta", "60", "-n", "3", "-o", "-", NULL},
        {"info", table, NULL},
        {"build", "--list", NULL},
        {"check", "ggx", "--samples", "1000", NULL},
        {"build", "--family", "ggx", "--max-bytes", "2048", "-o", "new.vndf", NULL}};
    for (size_t i = 0; i < sizeof printers / sizeof *printers; i++)
        for (int ignores = 0; ignores < 2; ignores++) {
            const run_outcome *o = run_into_closed_pipe(NULL, printers[i], ignores, i == 0);
            if (!(TEST(ignores ? o->status == 2 : o->signal == SIGPIPE) & TEST(o->text[0] == '\0')))
                fprintf(stderr, "  %s: status %d, %s\n", printers[i][0], o->status, o->text);
        }
    vndf_distribution *built = vndf_load("new.vndf", NULL);
    TEST(built != NULL && temporaries() == 0); /* it is saved before it is described */
    vndf_free(built);
    remove("new.vndf");
}

static void test_closed_pipe_of_eval(void)
{
    static const char *const words[] = {"eval", "ggx", "--theta", "60", NULL};
    FILE *normals = fopen("normals.csv", "w");
    for (int i = 0; normals && i < 20000; i++)
        fputs("0.6,0,0.8\n", normals);
    TEST(normals && fclose(normals) == 0);
    for (int ignores = 0; ignores < 2; ignores++) {
        const run_outcome *o = run_into_closed_pipe("normals.csv", words, ignores, 0);
        TEST(ignores ? o->status == 2 : o->signal == SIGPIPE);
        TEST(o->text[0] == '\0');
    }
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
    null = open("/dev/null", O_WRONLY);
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
