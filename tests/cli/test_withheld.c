/* What is withheld from a command - a descriptor, the memory of one allocation, a step of saving - makes it fail with
 * status 2 and a line that says so, or does not matter: what it writes is then what it always writes. Files that it
 * would replace are as they were where it fails, but for text that a closed stdout did not take. Every command, with
 * small work. It notices a file that becomes descriptor 1, one that is replaced before the figures are made, and a
 * rename before the sync. */
#include "harness/run_program.h"

#include <errno.h>

static const struct {
    const char *words; /* outputs are in out/ */
    int varies;        /* from run to run: times */
    long tries;        /* in which an allocation fails; in the long test it is most of them */
} commands[] = {
    {"build --slope 'exp(-r)' --max-bytes 2048 -o out/a.vndf", 0, 40},
    {"build --csv gloss.csv --max-bytes 2048 -o out/a.vndf", 0, 10},
    {"build --height heights.txt --max-bytes 2048 --profile out/a.csv -o out/a.vndf", 0, 40},
    {"build --family student-t --parameter 2..3 --knots 2 --max-bytes 2048 -o out/a.vndfs", 0, 5},
    {"info two.vndfs --json", 0, 40},
    {"sample two.vndfs@2.5 --theta 60 -n 100 -o out/a.csv", 0, 20},
    {"plot table.vndf -o out/a.svg", 0, 30},
    {"export two.vndfs --language c --bsdf both --fresnel dielectric --buffer out/a.raw -o out/a.c", 0, 40},
    {"export table.vndf --rgl -o out/a.bsdf", 0, 20},
    {"explore table.vndf -o out/a.html", 0, 30},
    {"render ball.scene --spp 1 --threads 1 -o out/a.png", 0, 20},
    {"render ball.scene --spp 1 --threads 1 --compare visible,all --equal samples -o out/a.png", 0, 40},
    {"bake ggx --what dfg,prefilter --size 4 -o out/a", 0, 10},
    {"bench --only ggx --seconds 0.01 -o out/a.csv", 1, 3},
    {"check table.vndf --samples 1000", 0, 5},
    {"judge \"$JUDGED 0.3\" --samples 1000", 0, 5},
    {"report --family ggx --seconds 1 out/a", 1, 1},
};

/* Outputs are those of good/ where it ends with 0, or with 2 since stdout is closed; else those of old/, where there
 * is a reason, too. `before` and `behind` are of the command. */
static void try_without(const char *before, const char *words, const char *behind, int varies, const char *kept)
{
    run_line(0, "",
             "rm -rf out; cp -r old out; { %s \"$VNDF\" %s >printed %s; } 2>said; s=$?\n"
             "if [ $s = 0 ] || [ %s = good ]; then %s; else [ $s = 2 ] && [ -s said ] && diff -r out old; fi",
             before, words, behind, kept, varies ? "! ls out | grep tmp" : "diff -r out good");
}

/* Descriptors, each of them and all; what prints says that stdout is closed. */
static void test_descriptors(const char *words, int varies)
{
    const int prints = *run_line(0, "", "rm -rf out old good; mkdir out; vndf %s", words)->text;
    run_line(0, "", "cp -r out good; cp -r out old; find old -type f | while read f; do echo >>\"$f\"; done");
    try_without("", words, "<&-", varies, "good");
    try_without("", words, "2>&-", varies, "good");
    try_without("", words, "<&- >&- 2>&-", varies, "good");
    try_without("", words, ">&-", varies, "good");
    run_line(0, "", "%s grep -q 'cannot write to stdout' said", prints ? "" : "!");
}

/* The last ones are those of figures. */
static void test_allocations(const char *words, int varies, long tries)
{
    const char *told = run_line(0, "", "LD_PRELOAD=\"$FAILING\" \"$VNDF\" %s 9>&1 >printed 2>said", words)->text;
    const long count = atol(told), last = count - (tries > 5 ? 10 : 1);
    char before[64];
    for (long n = 1, next; n <= count; n = next) {
        next = n + (!test_long() ? 1 + 2 * count / (tries + 1) : n > 200 ? 17 : 1);
        next = n >= last ? n + 1 : next > last ? last : next;
        snprintf(before, sizeof before, "LD_PRELOAD=\"$FAILING\" FAIL_AT=%ld", n);
        try_without(before, words, "", varies, "old");
    }
    TEST(count > 0);
}

/* A file that is saved is synced, closed and renamed, or it is none. */
static void test_steps(const char *words)
{
    static const char *const steps[] = {"fsync", "fclose", "rename"};
    for (int i = 0; i < 3 && strstr(words, "-o out/"); i++)
        run_line(0, strerror(EDQUOT),
                 "rm -rf out; cp -r old out; LD_PRELOAD=\"$FAILING\" FAIL_STEP=%s \"$VNDF\" %s >printed 2>said "
                 "9>&1; s=$?\ncat said; [ $s = 2 ] && diff -r out old",
                 steps[i], words);
}

int main(void)
{
    char folder[] = "withheld.XXXXXX";
    if (!run_begin(folder))
        return test_done();
    setenv("FAILING", VNDF_FAILING_MALLOC, 1);
    setenv("JUDGED", VNDF_JUDGED, 1);
    setenv("SOURCE", VNDF_SOURCE_DIR, 1);
    run_line(0, "",
             "cp $SOURCE/tables/student-t-2.5-small.vndf table.vndf; cp $SOURCE/tests/corpus/family/two.vndfs .");
    run_line(0, "",
             "awk 'BEGIN { for (; i < 64; i++) { for (k = 0; k < 64; k++) printf \"%%.3f \", rand(); print \"\" } "
             "}' >heights.txt");
    TEST(run_put("ball.scene", run_scene) && run_put("gloss.csv", "slope,p22\n0,1\n0.5,0.8\n1,0.3\n2,0.01\n"));
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
        if (commands[i].tries < (long)test_amount(10, 0, 0))
            continue;
        test_descriptors(commands[i].words, commands[i].varies);
        if (*VNDF_FAILING_MALLOC) {
            test_steps(commands[i].words);
            test_allocations(commands[i].words, commands[i].varies, commands[i].tries);
        }
    }
    run_line(2, "cannot read stdin", "vndf info - <&-");
    run_line(0, "", "rm -r *");
    return run_end(folder);
}
