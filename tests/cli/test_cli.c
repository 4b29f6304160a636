/* Wrong words are refused with exit status 2, in a line that names the word and what would be right, and no command
 * that failed leaves a file behind. It notices a hint that is lost and an option that is taken for another one. */
#include "harness/run_program.h"

#define TABLE VNDF_SOURCE_DIR "/tables/student-t-2.5-small.vndf"
#define NONE "-o", "none.csv"

typedef struct refusal {
    const char *says;
    const char *words[RUN_WORDS];
} refusal;

static void test_refusals(const refusal *list, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!TEST_HAS(run_expect(2, NULL, list[i].words)->text, list[i].says))
            fprintf(stderr, "  '%s'\n", list[i].says);
}

#define REFUSALS(list) test_refusals(list, sizeof list / sizeof *list)

static const refusal words[] = {
    {"a command is missing", {NULL}},
    {"did you mean 'sample'?", {"smaple"}},
    {"did you mean '--version'?", {"--versoin"}},
    {"did you mean `vndf info a.vndf`?", {"a.vndf"}},
    {"there is no command 'bulid'; did you mean 'build'?", {"help", "bulid"}},
    {"did you mean 'bench effects'?", {"help", "bench", "efects"}},
    {"one word too many", {"help", "build", "sample"}},
    {"one of a command, --man and --completion", {"help", "build", "--man"}},
    {"-o goes with --man or --completion", {"help", "-o", "manual"}},
    {"--completion 'csh' is not bash", {"help", "--completion", "csh"}},
    {"did you mean '--theta'?", {"sample", "ggx", "--thta", "3"}},
    {"did you mean '--alpha'?", {"sample", "ggx", "-a", "3"}},
    {"--theta needs a value", {"sample", "ggx", "--theta"}},
    {"--theta is given twice", {"sample", "ggx", "--theta", "1", "--theta", "2", "-n", "9", NONE}},
    {"FILE|ggx|beckmann|FILE.vndfs is missing", {"info"}},
    {"one word too many", {"info", "ggx", "beckmann"}},
    {"cannot read missing.vndf: No such file", {"info", "missing.vndf"}},
    {"did you mean 'ggx'?", {"info", "GXG"}},
    {"cannot read .: Is a directory", {"info", "."}},
    {"text.txt: not a vndf table: it must begin", {"info", "text.txt"}},
    {"a single table is needed (eval and sample take", {"check", "two.vndfs@2"}},
};

static const refusal build[] = {
    {"exactly one is needed of --ndf", {"build", NONE}},
    {"--slope and --family are given; only one is possible",
     {"build", "--slope", "exp(-r)", "--family", "ggx", NONE}},
    {"-o FILE is missing", {"build", "--slope", "exp(-r)"}},
    {"did you mean '--max-tv'?", {"build", "--slope", "exp(-r)", "--maxtv", "1e-3", NONE}},
    {"did you mean '--set a=0.3'?", {"build", "--slope", "exp(-a*r)", "-a", "0.3", NONE}},
    {"did you mean '--set a=0.3'?", {"build", "--slope", "exp(-a*r)", "--a=0.3", NONE}},
    {"--slope: column 8: unexpected ')'", {"build", "--slope", "exp(-r))", NONE}},
    {"a formula is --slope 'EXPR'", {"build", "exp(-r)", NONE}},
    {"-o needs a value, as in -o FILE", {"build", "--slope", "exp(-r)", "-o"}},
    {"--slope needs a value", {"build", "--slope", NONE}},
    {"has its value by --set NAME=X", {"build", "--slope", "exp(-a*r)", NONE}},
    {"did you mean 'cos'?", {"build", "--slope", "exp(-r)*cso(r)", NONE}},
    {"--set '1e400' is too large", {"build", "--slope", "exp(-r*k)", "--set", "k=1e400", NONE}},
    {"NAME=NUMBER", {"build", "--slope", "exp(-r)", "--set", "k", NONE}},
    {"--set is for --ndf and --slope", {"build", "--family", "ggx", "--set", "k=1", NONE}},
    {"parameter 'b': the formula 'exp(-a*r)' has no 'b'",
     {"build", "--slope", "exp(-a*r)", "--set", "a=1", "--set", "b=2", NONE}},
    {"has no 'e3'", {"build", "--slope", "r*0+1e3*exp(-r)", "--set", "e3=1", NONE}},
    {"has no 'gamma'", {"build", "--ndf", "gamma (2)*c", "--set", "gamma=1", NONE}},
    {"column 5: the number 1e400 is too large", {"build", "--family", "epd:1e400", NONE}},
    {"cannot read missing.csv", {"build", "--csv", "missing.csv", NONE}},
    {"cannot read .: Is a directory", {"build", "--csv", ".", NONE}},
    {"stdin: line 1", {"build", "--csv", "-", NONE}},
    {"from 2048 to 1048576", {"build", "--slope", "exp(-r)", "--max-bytes", "100", NONE}},
    {"'KiB' stands behind it", {"build", "--slope", "exp(-r)", "--max-bytes", "4KiB", NONE}},
    {"--break '0' is not in the range", {"build", "--slope", "exp(-r)", "--break", "0", NONE}},
    {"--finest '2' is not in the range", {"build", "--slope", "exp(-r)", "--finest", "2", NONE}},
    {"--moments '5' is not 2, 3 or 4", {"build", "--slope", "exp(-r)", "--moments", "5", NONE}},
    {"--max-bytes N allows a larger table",
     {"build", "--slope", "exp(-r)", "--max-bytes", "2048", "--max-tv", "1e-9", NONE}},
    {"", {"build", "--slope", "0*r", NONE}},
    {"cannot write 'no/none.vndf': No such file", {"build", "--slope", "exp(-r)", "-o", "no/none.vndf"}},
    {"'.' is a folder", {"build", "--slope", "exp(-r)", "-o", "."}},
    {"known by .vndfs, and this is one table", {"build", "--slope", "exp(-r)", "-o", "none.vndfs"}},
};

#define FAMILY(name, range) "build", "--family", name, "--parameter", range, "-o", "none.vndfs"

static const refusal families[] = {
    {"--parameter is for --family", {"build", "--slope", "exp(-r)", "--parameter", "1..2", NONE}},
    {"--knots is for --parameter", {"build", "--family", "student-t:2", "--knots", "3", NONE}},
    {"--knots and --max-tv are given", {FAMILY("student-t", "2..3"), "--knots", "3", "--max-tv", "0.1"}},
    {"--parameter takes no --break", {FAMILY("student-t", "2..3"), "--break", "1"}},
    {"--parameter takes no --finest", {FAMILY("student-t", "2..3"), "--finest", "1e-3"}},
    {"--parameter '2' is not LOW..HIGH", {FAMILY("student-t", "2")}},
    {"--parameter 'x' is not a number", {FAMILY("student-t", "x..3")}},
    {"the first must be below the second", {FAMILY("student-t", "3..2")}},
    {"column 5: too many parameters", {FAMILY("ggx", "1..2")}},
    {"C is missing; right would be abc:B,C", {FAMILY("abc:{p}", "1..2")}},
    {"--knots '1' is not in the range from 2 to 256", {FAMILY("student-t", "2..3"), "--knots", "1"}},
    {"at the parameter 1: student-t: GAMMA is 1", {FAMILY("student-t", "1..3")}},
    {"'abc:2' does not say where the parameter stands", {FAMILY("abc:2", "1..3")}},
    {"has to end in .vndfs", {"build", "--family", "student-t", "--parameter", "2..3", NONE}},
};

#define AIM "sample", "--theta", "60", "-n", "9", NONE

static const refusal surfaces[] = {
    {".csv or .f32", {"sample", "ggx", "--theta", "60", "-n", "9", "-o", "a.txt"}},
    {"--theta is missing", {"sample", "ggx", "-n", "9", NONE}},
    {"-n N is missing", {"sample", "ggx", "--theta", "60", NONE}},
    {"-n '1.5' is not a whole number", {"sample", "ggx", "--theta", "60", "-n", "1.5", NONE}},
    {"-n '0' is not in the range", {"sample", "ggx", "--theta", "60", "-n", "0", NONE}},
    {"from 0 to 180", {"sample", "ggx", "--theta", "181", "-n", "9", NONE}},
    {"--theta '0x10' is not a number", {"sample", "ggx", "--theta", "0x10", "-n", "9", NONE}},
    {"--theta 'nan' is not a number", {"sample", "ggx", "--theta", "nan", "-n", "9", NONE}},
    {"--alpha '0' is not in the range", {AIM, "ggx", "--alpha", "0"}},
    {"--alpha '1,2,3' has too many numbers: it takes 2", {AIM, "ggx", "--alpha", "1,2,3"}},
    {"--alpha '-0.1' is not in the range", {AIM, "ggx", "--alpha", "-0.1"}},
    {"--alpha '0.1,1e400' is too large", {AIM, "ggx", "--alpha", "0.1,1e400"}},
    {"FILE|ggx|beckmann|FILE.vndfs@P is missing", {AIM}},
    {"--alpha and --matrix are given", {AIM, "ggx", "--alpha", "1", "--matrix", "1,0,0,1"}},
    {"--matrix '1,0,1' has too few numbers: it takes 4", {AIM, "ggx", "--matrix", "1,0,1"}},
    {"--matrix '1,2,2,4' is singular", {AIM, "ggx", "--matrix", "1,2,2,4"}},
    {"--mean '' is not a number", {AIM, "ggx", "--mean", ""}},
    {"did you mean '--matrix'?", {AIM, "ggx", "--matrx", "1,0,0,1"}},
    {"say at which parameter, as in two.vndfs@2.5", {AIM, "two.vndfs"}},
    {"'3.1' is not in the range of the family, from 1.8 to 3", {AIM, "two.vndfs@3.1"}},
    {"the parameter 'x' is not a number", {AIM, "two.vndfs@x"}},
    {"svg", {"plot", TABLE, "-o", "none.png"}},
    {"--samples '10' is not in the range", {"check", TABLE, "--samples", "10"}},
    {"a closed form was not made of a CSV", {"check", "ggx", "--csv", "text.txt"}},
};

/* Of eval: the second of two lines. */
static void test_lines(void)
{
    static const char *const bad[] = {"0,0", "0,0,1,1", "0,0,x", "0,0,1.1", "0,0,nan", "0 0 1", ""};
    static const char *const eval[] = {"eval", "ggx", "--theta", "60", NULL};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        char text[64];
        snprintf(text, sizeof text, "0,0,1\n%s\n", bad[i]);
        TEST(run_put("text.txt", text));
        TEST_HAS(run_expect(2, "text.txt", eval)->text, "stdin, line 2");
    }
    TEST_HAS(run_expect(2, TABLE, RUN_LIST("eval", "-", "--theta", "60"))->text, "this command reads it twice");
}

int main(void)
{
    char folder[] = "cli.XXXXXX";
    if (!run_begin(folder))
        return test_done();
    TEST(run_put("text.txt", "text\n"));
    free(PRINTED(NULL, "build", "--family", "student-t", "--parameter", "1.8..3", "--knots", "2", "--max-bytes",
                 "2048", "-o", "two.vndfs"));
    REFUSALS(words);
    REFUSALS(build);
    REFUSALS(families);
    REFUSALS(surfaces);
    test_lines();
    TEST(remove("text.txt") == 0 && remove("two.vndfs") == 0);
    return run_end(folder);
}
