/* What is withheld from a command - a descriptor, or the memory of one allocation - makes it fail with status 2 and a
 * line that says so, or does not matter: what it writes is then what it always writes. Files that it would replace are
 * as they were where it fails, but for text that a closed stdout did not take. Every command, with small work. It
 * notices a file that becomes descriptor 1, and one that is replaced before the figures are made. */
#include "harness/run_program.h"

static const struct {
    const char *words; /* outputs are in out/ */
    int varies;        /* from run to run: times */
    long tries;        /* in which an allocation fails; 0: all is for the long test, which has most allocations */
} commands[] = {
    {"build --slope 'exp(-r)' --max-bytes 2048 -o out/a.vndf", 0, 40},
    {"build --csv gloss.csv --max-bytes 2048 -o out/a.vndf", 0, 10},
    {"build --height heights.txt --max-bytes 2048 --cutoff 2 --profile out/a.csv -o out/a.vndf", 0, 40},
    {"build --family student-t --parameter 2..3 --knots 2 --max-bytes 2048 -o out/a.vndfs", 0, 5},
    {"build --list", 0, 3},
    {"info table.vndf", 0, 40},
    {"info two.vndfs --json", 0, 10},
    {"sample table.vndf --theta 60 -n 100 -o out/a.csv", 0, 20},
    {"sample two.vndfs@2.5 --theta 60 -n 100 -o out/a.f32", 0, 20},
    {"plot table.vndf -o out/a.svg", 0, 30},
    {"export table.vndf --language glsl -o out/a.glsl", 0, 30},
    {"export two.vndfs --language c --bsdf both --fresnel dielectric --buffer out/a.raw -o out/a.c", 0, 40},
    {"export table.vndf --rgl -o out/a.bsdf", 0, 20},
    {"explore table.vndf -o out/a.html", 0, 30},
    {"explore table.vndf --engines 4 -o out/a.html", 0, 0},
    {"render ball.scene --spp 1 --threads 1 -o out/a.png", 0, 20},
    {"render ball.scene --spp 1 --threads 1 --compare visible,all --equal samples -o out/a.png", 0, 40},
    {"bake ggx --what dfg,prefilter --size 4 -o out/a", 0, 10},
    {"bench --only ggx --seconds 0.01 -o out/a.csv", 1, 3},
    {"bench --effects --only bare --seconds 0.01 -o out/a.json", 1, 0},
    {"check table.vndf --samples 1000", 0, 5},
    {"judge \"$JUDGED 0.3\" --samples 1000", 0, 5},
    {"report --family ggx --seconds 1 out/a", 1, 1},
};

/* As it is without anything withheld: its outputs in good/, and in old/ what is changed by a byte. Returns whether it
 * prints. */
static int run_whole(const char *words)
{
    const run_outcome *o = run_line(0, "", "rm -rf out old good; mkdir out; vndf %s", words);
    const int prints = o->text[0] != '\0';
    run_line(0, "", "cp -r out good; cp -r out old; find old -type f | while read f; do echo >>\"$f\"; done");
    return prints;
}

/* With `before` in the line of the command; its complaints are told. */
static const run_outcome *run_without(int status, const char *says, const char *before, const char *words,
                                      const char *after, const char *holds)
{
    return run_line(
        status, says,
        "rm -rf out; cp -r old out; { %s \"$VNDF\" %s %s; } 2>said; s=$?; cat said 2>&-\n%s || exit 99; "
        "exit $s",
        before, words, after, holds);
}

static void test_descriptors(const char *words, int varies, int prints)
{
    static const char *const closed[] = {"<&-", "2>&-", ">&-", "<&- >&- 2>&-"};
    for (int i = 0; i < 4; i++)
        run_without(prints && i > 1 ? 2 : 0, prints && i == 2 ? "cannot write to stdout" : "", "", words,
                    closed[i], varies ? ":" : "diff -r out good");
}

#ifdef VNDF_FAILING_MALLOC

static long allocations(const char *words)
{
    size_t size;
    run_line(0, "", "LD_PRELOAD=\"$FAILING\" FAIL_COUNT=count \"$VNDF\" %s >said", words);
    char *text = run_file("count", &size);
    const long count = text ? atol(text) : 0;
    free(text);
    return count;
}

/* The last ones are those of figures. */
static void test_allocations(const char *words, int varies, long tries)
{
    const long count = allocations(words), last = count - (tries > 5 ? 10 : 1);
    const long step = test_long() ? 1 : 1 + 2 * count / (tries + 1);
    char before[64], holds[256];
    snprintf(holds, sizeof holds,
             "{ if [ $s = 0 ]; then %s; else [ $s = 2 ] && [ -s said ] && diff -r out old && s=0; fi; }",
             varies ? "! ls out | grep tmp" : "diff -r out good");
    for (long n = 1, next; n <= count; n = next) {
        next = n + (test_long() && n > 200 ? 17 : step);
        next = n >= last ? n + 1 : next > last ? last : next;
        snprintf(before, sizeof before, "LD_PRELOAD=\"$FAILING\" FAIL_AT=%ld", n);
        run_without(0, "", before, words, ">printed", holds);
    }
}

#else

static void test_allocations(const char *words, int varies, long tries)
{
    (void)words, (void)varies, (void)tries;
}

#endif

int main(void)
{
    char folder[] = "withheld.XXXXXX";
    if (!run_begin(folder))
        return test_done();
#ifdef VNDF_FAILING_MALLOC
    setenv("FAILING", VNDF_FAILING_MALLOC, 1);
#else
    puts("no allocation was made to fail: sanitizers, or a system without LD_PRELOAD");
#endif
    setenv("JUDGED", VNDF_JUDGED, 1);
    run_line(0, "", "cp '%s' table.vndf; cp '%s' two.vndfs", VNDF_SOURCE_DIR "/tables/student-t-2.5-small.vndf",
             VNDF_SOURCE_DIR "/tests/corpus/family/two.vndfs");
    run_line(0, "",
             "awk 'BEGIN { for (i = 0; i < 64; i++) { for (k = 0; k < 64; k++) printf \"%%.3f \", rand(); "
             "print \"\" } }' >heights.txt");
    TEST(run_put("ball.scene", run_scene) && run_put("gloss.csv", "slope,p22\n0,1\n0.5,0.8\n1,0.3\n2,0.01\n"));
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
        if (commands[i].tries < (long)test_amount(10, 1, 0))
            continue;
        const int prints = run_whole(commands[i].words);
        test_descriptors(commands[i].words, commands[i].varies, prints);
        test_allocations(commands[i].words, commands[i].varies, commands[i].tries);
    }
    run_line(2, "cannot read stdin", "vndf info - <&-");
    run_line(0, "", "rm -r *");
    return run_end(folder);
}
