/* Whatever goes wrong around the program, a file that it writes is whole or as it was, no temporary is left, and a line
 * says why: a full disk, a step of saving that fails, a signal, a closed pipe, an output that is an input under another
 * name, a name that is no file. A file that is replaced keeps its mode, a link its place, and `-o -` gives the bytes of
 * the file. It notices a rename before the sync, and an input that is replaced. */
#include "harness/run_program.h"

#include <errno.h>

#include "vndf_build.h"

static const char table[] = VNDF_SOURCE_DIR "/tables/student-t-2.5-small.vndf";
static const char old_text[] = "the old file\n";

static int is_alone(void)
{
    return run_count(".", ".tmp") == 0 && run_count("folder", ".tmp") == 0;
}

static int is_written(const char *name)
{
    struct stat is;
    return stat(name, &is) == 0 && is.st_size > 100 && is_alone();
}

static int put_old(const char *name)
{
    return run_put(name, old_text) && chmod(name, 0751) == 0;
}

static int is_old(const char *name)
{
    return run_has(name, old_text) && is_alone();
}

/* Fails a test of this line if it does not end so: with this status, and a text that holds `why`. */
static void expect(int good, const char *line, const run_outcome *o, int status, const char *why)
{
    if (!(TEST(good) & TEST(o->status == status) & TEST_HAS(o->text, why)))
        fprintf(stderr, "  vndf %s: status %d, signal %d\n%.300s\n", line, o->status, o->signal, o->text);
}

/* ---- steps of saving, which the linker lets fail (--wrap) ---- */

#ifdef VNDF_TEST_WRAP

int __real_fsync(int file);
int __real_fclose(FILE *file);
int __real_rename(const char *from, const char *to);
int __wrap_fsync(int file);
int __wrap_fclose(FILE *file);
int __wrap_rename(const char *from, const char *to);

enum { NONE, SYNC, CLOSE, RENAME, STEPS };

static int failing, steps; /* steps: digits of the first that were taken */

static int fails(int step)
{
    steps = steps < 1000 ? 10 * steps + step : steps;
    if (failing == step)
        errno = EDQUOT;
    return failing == step;
}

int __wrap_fsync(int file)
{
    return fails(SYNC) ? -1 : __real_fsync(file);
}

int __wrap_fclose(FILE *file)
{
    int closed = __real_fclose(file);
    return fails(CLOSE) ? EOF : closed;
}

int __wrap_rename(const char *from, const char *to)
{
    return fails(RENAME) ? -1 : __real_rename(from, to);
}

static void test_steps(void)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_distribution *loaded = vndf_load(table, &error);
    for (int step = NONE; loaded && step < STEPS; step++) {
        TEST(put_old("old.vndf"));
        steps = 0;
        failing = step;
        vndf_status status = vndf_save(loaded, "old.vndf", &error);
        int taken = steps;
        failing = NONE;
        int good = step ? status == VNDF_ERROR_IO && is_old("old.vndf") && strstr(error.message, strerror(EDQUOT))
                        : status == VNDF_OK && run_same("old.vndf", table) && is_alone() && taken == 123;
        if (!TEST(good))
            fprintf(stderr, "  step %d, steps %d: %s\n", step, taken, error.message);
    }
    vndf_free(loaded);
    remove("old.vndf");
}

#else

static void test_steps(void)
{
    puts("the linker has no --wrap: no step was made to fail");
}

#endif

/* ---- what every command writes ---- */

/* The output of the line and the file's name, which is the last word. */
static void write_to(const char *line, const run_setting *setting, const char *name, int status, const char *why)
{
    char whole[256];
    snprintf(whole, sizeof whole, "%s%s", line, name);
    expect(1, whole, run_line(setting, whole), status, why);
}

static void test_writer(const char *line, const char *name)
{
    const run_setting full = {.file_limit = 30};
    struct stat is;
    TEST(put_old(name));
    write_to(line, &full, name, 2, strerror(EFBIG));
    TEST(is_old(name));
    write_to(line, &run_plain, name, 0, "");
    TEST(is_written(name) && stat(name, &is) == 0 && (is.st_mode & 07777) == 0751 && remove(name) == 0);

    TEST(symlink("folder/link", name) == 0 && symlink("../real", "folder/link") == 0 && put_old("real"));
    write_to(line, &run_plain, name, 0, "");
    TEST(lstat(name, &is) == 0 && S_ISLNK(is.st_mode) && is_written("real"));
    TEST(remove("real") == 0 && remove("folder/link") == 0 && remove(name) == 0);

    TEST(run_put("vndf.0.tmp", "left by a crash"));
    write_to(line, &run_plain, name, 0, "");
    TEST(run_has("vndf.0.tmp", "left by a crash") && run_count(".", ".tmp") == 1);
    TEST(system("rm *.tmp") == 0 && is_written(name) && remove(name) == 0);

    TEST(mkfifo("pipe", 0666) == 0);
    write_to(line, &run_plain, "pipe", 2, "");
    write_to(line, &run_plain, "folder", 2, "");
    write_to(line, &run_plain, "", 2, "");
    TEST(stat("pipe", &is) == 0 && S_ISFIFO(is.st_mode) && remove("pipe") == 0 && is_alone());
}

/* ---- outputs that are inputs ---- */

static const char all_png[] = "film width 8 height 8\ncamera from 0 0 5 to 0 0 0\nenvironment constant 1 1 1\n"
                              "material gold conductor of gold distribution table table.png alpha 0.2\n"
                              "mesh file mesh.png material gold\n";

/* Names with the ending of the input: by a folder, by a link, by another hard link, its own. */
static void test_reader(const char *line, const char *name)
{
    char whole[256], by_folder[64], other[64];
    snprintf(by_folder, sizeof by_folder, "folder/../%s", name);
    snprintf(other, sizeof other, "other%s", strrchr(name, '.'));
    TEST(run_copy(name, "before"));
    for (int kind = 0; kind < 4; kind++) {
        if (kind >= 2)
            TEST((kind == 2 ? symlink : link)(name, other) == 0);
        snprintf(whole, sizeof whole, "%s%s", line, kind == 0 ? name : kind == 1 ? by_folder : other);
        const run_outcome *o = run_line(&run_plain, whole);
        expect(run_same(name, "before"), whole, o, 2, strstr(o->text, "is kept;") ? "" : "put of this command");
        if (kind >= 2)
            TEST(remove(other) == 0);
    }
}

/* ---- stdin and stdout ---- */

/* What prints to a full disk ends with 2 and says so. */
static void test_full(void)
{
    static const char *const lines[] = {"--help", "build --list", "info table.csv",
                                        "sample table.csv --theta 60 -n 5000 -o -"};
    const run_setting s = {.out = open("/dev/full", O_WRONLY)};
    for (size_t i = 0; i < sizeof lines / sizeof *lines && s.out > 0; i++)
        expect(1, lines[i], run_line(&s, lines[i]), 2, strerror(ENOSPC));
    close(s.out);
}

static void test_stdout(void)
{
    static const char line[] = "build --family ggx --max-bytes 2048 -o ";
    const run_setting to_file = {.out = open("b", O_WRONLY | O_CREAT, 0666)};
    write_to(line, &run_plain, "a.vndf", 0, "");
    write_to(line, &to_file, "-", 0, "");
    TEST(close(to_file.out) == 0 && run_same("a.vndf", "b") && remove("a.vndf") == 0 && remove("b") == 0);
}

/* A reader that goes away ends the program by SIGPIPE, or quietly with 2 where that is ignored. */
static void test_pipe(void)
{
    static const char *const words[] = {"sample", "ggx", "--theta", "60", "-n", "1000000", "-o", "-", NULL};
    for (int ignores = 0; ignores < 2; ignores++) {
        int ends[2];
        if (!TEST(pipe(ends) == 0))
            return;
        const run_setting s = {.out = ends[1], .ignores_pipe = ignores};
        close(ends[0]);
        run_child c = run_start(&s, words);
        close(ends[1]);
        const run_outcome *o = run_finish(c);
        expect((ignores || o->signal == SIGPIPE) && !o->text[0], "sample | ", o, ignores ? 2 : -1, "");
    }
}

/* ---- signals ---- */

/* The signal comes once the temporary is there. What there is of a picture is saved; samples are not. */
static void test_signal(int number)
{
    static const char *const sample[] = {"sample", "ggx", "--theta", "60", "-n", "1e9", "-o", "a.csv", NULL};
    static const char *const render[] = {"render", "ball.scene", "-o", "a.pfm", "--spp",
                                         "1e9",    "--threads",  "1",  NULL};
    TEST(put_old("a.csv"));
    for (int renders = 0; renders < 2; renders++) {
        run_child c = run_start(&run_plain, renders ? render : sample);
        for (int i = 0; i < 1000 && run_count(".", ".tmp") == 0; i++)
            run_pause(10);
        run_pause(renders ? 1500 : 0);
        kill(c.pid, number);
        const run_outcome *o = run_finish(c);
        expect(o->signal == number && is_alone(), renders ? "render" : "sample", o, -1, "interrupted");
    }
    TEST(is_old("a.csv") && is_written("a.pfm") && remove("a.csv") == 0 && remove("a.pfm") == 0);
}

int main(void)
{
    char folder[] = "outputs.XXXXXX";
    if (!run_begin(folder))
        return test_done();
    umask(022);
    TEST(mkdir("folder", 0777) == 0 && run_put("ball.scene", run_scene) && run_put("all.png", all_png));
    TEST(run_put("gloss.csv", "slope,p22\n0,1\n0.5,0.8\n1,0.3\n2,0.01\n") && run_copy(table, "table.csv"));
    TEST(run_put("mesh.png", "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n") && run_copy(table, "table.png"));
    test_steps();
    test_writer("build --family ggx --max-bytes 2048 -o ", "a.vndf");
    test_writer("sample table.csv --theta 60 -n 5000 -o ", "a.csv");
    test_writer("sample table.csv --theta 60 -n 5000 -o ", "a.f32");
    test_writer("plot table.csv --theta 60 -o ", "a.svg");
    test_writer("bench --only ggx --seconds 0.1 -o ", "a.md");
    test_writer("render ball.scene --spp 1 -o ", "a.png");
    test_reader("build --csv gloss.csv -o ", "gloss.csv");
    test_reader("sample table.csv --theta 60 -n 10 -o ", "table.csv");
    test_reader("bench --csv gloss.csv --only ggx --seconds 0.1 -o ", "gloss.csv");
    test_reader("render all.png --spp 1 -o ", "all.png"); /* a scene, which reads both others */
    test_reader("render all.png --spp 1 -o ", "table.png");
    test_reader("render all.png --spp 1 -o ", "mesh.png");
    test_full();
    test_stdout();
    test_pipe();
    test_signal(SIGINT);
    test_signal(SIGTERM);
    TEST(system("rm ball.scene all.png gloss.csv table.csv mesh.png table.png before") == 0);
    TEST(rmdir("folder") == 0);
    return run_end(folder);
}
