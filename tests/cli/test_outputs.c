/* Whatever goes wrong around the program, a file that it writes is whole or as it was, no temporary is left, and a line
 * says why: a full disk, a signal, a closed pipe, an output that is an input under another name, a name that is no file
 * (a step of saving: test_withheld). A file that is replaced keeps its mode, a link its place, and `-o -` gives the
 * bytes of the file. It notices an input that is replaced. */
#include "harness/run_program.h"

#include <errno.h>

static const char table[] = VNDF_SOURCE_DIR "/tables/student-t-2.5-small.vndf";

static void shell(const char *line)
{
    if (!TEST(system(line) == 0))
        fprintf(stderr, "  does not hold: %s\n", line);
}

static int is_alone(void)
{
    return run_count(".", ".tmp") == 0 && run_count("folder", ".tmp") == 0;
}

/* ---- what every command writes, $F, and what it reads ---- */

static void test_writer(const char *line, const char *name)
{
    const struct {
        int status;
        const char *says, *before, *holds; /* lines */
    } cases[] = {
        {2, strerror(EFBIG), "echo old >$F; chmod 751 $F; ulimit -f 0", "grep -q old $F"},
        {0, "", ":", "ls -l $F | grep -q '^-rwxr-x--x' && [ $(wc -c <$F) -gt 100 ] && rm $F"},
        {0, "", "ln -s folder/link $F; ln -s ../real folder/link; echo old >real",
         "[ -L $F ] && [ -L folder/link ] && [ $(wc -c <real) -gt 100 ] && rm $F folder/link real"},
        {0, "", "echo left >vndf.0.tmp",
         "grep -q left vndf.0.tmp && [ $(wc -c <$F) -gt 100 ] && rm $F vndf.0.tmp"},
        {2, "device or a pipe", "F=p.${F##*.}; mkfifo $F", "[ -p p.* ] && rm p.*"},
        {2, "is a folder", "F=d.${F##*.}; mkdir $F", "rmdir d.*"},
        {2, "", "F=", ":"},
    };
    setenv("F", name, 1);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        run_line(cases[i].status, cases[i].says, "%s\nexec \"$VNDF\" %s -o \"$F\"", cases[i].before, line);
        shell(cases[i].holds);
        TEST(is_alone());
    }
}

/* Its own name, one by a folder, a link, another hard link, all with the ending of the input. */
static void test_reader(const char *line, const char *name)
{
    static const char *const others[] = {"O=$F", "O=folder/../$F", "O=other.${F##*.}; ln -s $F $O",
                                         "O=other.${F##*.}; ln $F $O"};
    setenv("F", name, 1);
    shell("cp $F before");
    for (int i = 0; i < 4; i++) {
        run_line(2, "put of this command", "%s\nexec \"$VNDF\" %s -o $O", others[i], line);
        shell("cmp $F before && rm -f other.*");
    }
    remove("before");
}

/* ---- stdout and signals ---- */

static void test_stdout(void)
{
    static const char *const full[] = {"--help", "build --list", "info table.csv",
                                       "sample table.csv --theta 60 -n 5000 -o -"};
    for (int i = 0; i < 4; i++) /* what prints to a full disk says so */
        run_line(2, strerror(ENOSPC), "vndf %s >/dev/full", full[i]);
    run_line(0, "", "vndf build --family ggx --max-bytes 2048 -o a.vndf");
    run_line(0, "", "vndf build --family ggx --max-bytes 2048 -o - >b && cmp a.vndf b && rm a.vndf b");
    /* A reader that goes away ends the program by SIGPIPE, or with 2 where that is ignored; quietly. */
    for (int ignores = 0; ignores < 2; ignores++) {
        const run_outcome *o =
            run_line(0, "", "%s (\"$VNDF\" sample ggx --theta 60 -n 1000000 -o -; echo $? >&2) | true",
                     ignores ? "trap '' PIPE;" : "");
        TEST(strcmp(o->text, ignores ? "2\n" : "141\n") == 0);
    }
}

/* The signal comes once the temporary is there. What there is of a picture is saved; samples are not. */
static void test_signal(const char *name, int number)
{
    static const char at_work[] =
        "(until ls | grep -q tmp; do sleep 0.1; done; sleep %d; kill -s %s $$) &\nexec \"$VNDF\" %s";
    shell("echo old >a.csv");
    run_line(128 + number, "interrupted", at_work, 0, name, "sample ggx --theta 60 -n 1e9 -o a.csv");
    run_line(128 + number, "interrupted", at_work, 2, name, "render ball.scene -o a.pfm --spp 1e9 --threads 1");
    shell("grep -q old a.csv && [ $(wc -c <a.pfm) -gt 100 ] && rm a.csv a.pfm");
    TEST(is_alone());
}

/* Of a report nothing is left behind; the page is larger than 100 KiB, most of the data is not. */
static void test_unfinished_report(void)
{
    run_line(128 + SIGINT, "interrupted", "(sleep 1; kill -s INT $$) &\nexec \"$VNDF\" report --seconds 60 page");
    run_line(2, "cannot write", "ulimit -f 200; vndf report --family ggx --seconds 1 page");
    TEST(run_count("page", "") == -1);
}

int main(void)
{
    char folder[] = "outputs.XXXXXX";
    if (!run_begin(folder))
        return test_done();
    setenv("T", table, 1);
    umask(022);
    shell("mkdir folder && cp \"$T\" table.csv && cp \"$T\" table.png");
    TEST(run_put("ball.scene", run_scene) && run_put("gloss.csv", "slope,p22\n0,1\n0.5,0.8\n1,0.3\n2,0.01\n"));
    TEST(run_put("mesh.png", "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n"));
    shell("sed -e 's/ggx/table.png/; s/^sphere.*/mesh --file mesh.png --material gold/' ball.scene >all.png");
    test_writer("build --family ggx --max-bytes 2048", "a.vndf");
    test_writer("sample table.csv --theta 60 -n 5000", "a.csv");
    test_writer("sample table.csv --theta 60 -n 5000", "a.f32");
    test_writer("plot table.csv --theta 60", "a.svg");
    test_writer("bench --only ggx --seconds 0.1", "a.md");
    test_writer("render ball.scene --spp 1", "a.png");
    test_reader("build --csv gloss.csv", "gloss.csv");
    test_reader("sample table.csv --theta 60 -n 10", "table.csv");
    test_reader("bench --csv gloss.csv --only ggx --seconds 0.1", "gloss.csv");
    test_reader("render all.png --spp 1", "all.png"); /* a scene, which reads both others */
    test_reader("render all.png --spp 1", "table.png");
    test_reader("render all.png --spp 1", "mesh.png");
    test_stdout();
    test_signal("INT", SIGINT);
    test_signal("TERM", SIGTERM);
    test_unfinished_report();
    shell("rm *.scene *.png *.csv && rmdir folder");
    return run_end(folder);
}
