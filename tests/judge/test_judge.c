/* `vndf judge` passes the samplers of tools/judge/examples and names what is wrong with others, which are those with
 * their answers edited, by words and exit status; what it tells of GGX beside Beckmann is known in closed form.
 * `python` as an argument: that example alone. */
#include "harness/run_program.h"

/* `more` words follow. */
static const char *judged(int status, const char *command, const char *more)
{
    setenv("JUDGED", command, 1);
    return run_line(status, "", "vndf judge \"$JUDGED\" --samples 30000 %s", more)->text;
}

/* The sampler, with its answers through awk if there is a program for it. */
static const char *sampler(const char *alpha, const char *program)
{
    static char command[1024];
    snprintf(command, sizeof command, "%s %s%s%s%s", VNDF_JUDGED, alpha, program ? " | awk '" : "",
             program ? program : "", program ? "'" : "");
    return command;
}

/* The i-th number behind this word; -1: there is none. */
static double number_of(const char *text, const char *word, int i)
{
    for (; i >= 0 && text; i--)
        if ((text = strstr(text, word)) != NULL)
            text += strlen(word);
    return text ? strtod(text, NULL) : -1;
}

static void test_right(void)
{
    const char *text = judged(0, sampler("0.3 0.1", NULL), "--ndf ggx --alpha 0.3,0.1");
    TEST_HAS(text, "result good");
    for (int i = 0; i < 6; i++) {
        TEST_NEAR(number_of(text, "degrees mass ", i), 1, 1e-5);
        TEST_NEAR(number_of(text, " tv ", i), 0, 1e-5);
        TEST_NEAR(number_of(text, " scatter ", i), 0.2, 0.2);
    }
    TEST_HAS(judged(0, sampler("0.02", NULL), ""), "result good");
    TEST_HAS(judged(0, sampler("1 0.05", NULL), ""), "result good");
    /* Straight down x = R^2 has the densities (1 + x)^-2 and e^-x, which meet at 2.51286. */
    text = judged(0, sampler("0.3", NULL), "--ndf beckmann --alpha 0.3");
    TEST_NEAR(number_of(text, " tv ", 0), 0.2036, 1e-3);
    TEST_NEAR(number_of(text, " efficiency ", 0), 0.8, 1e-3); /* 1/integral e^-2x (1 + x)^2 */
    /* Numbers that are shuffled have lost their strata, and nothing else. */
    char command[1024];
    snprintf(command, sizeof command,
             "awk '$1 == \"s\" {$5 = $5*7919.123%%1; $6 = $6*6101.7%%1} {print}' | %s 0.3", VNDF_JUDGED);
    text = judged(0, command, "");
    for (int i = 0; i < 6; i++)
        TEST_NEAR(number_of(text, " scatter ", i), 1, 0.3);
}

static void test_wrong(void)
{
    static const char *const defects[][3] = {
        {"{$NF *= 1.01; print}", "fails mass\n", ""},           /* of both, so that they agree */
        {"NF == 4 {$4 *= 1.01} {print}", "fails agrees\n", ""}, /* of a sample */
        {"NF == 4 {$1 = -$1} {print}", "fails facing, ", "chi-square\n"},
        {"NF == 4 && $1 > 0 && $2 > 0 {$1 = -$1} {print}", "holes theta_of_wi 0 degrees theta_from 0 degrees",
         "phi_from 0 degrees"},
        {"NF == 4 {$1 *= 1.001} {print}", "fails unit", ""},
        {"NF == 4 {$1 *= 1.03; $2 *= 1.03; n = sqrt($1*$1 + $2*$2 + $3*$3); $1 /= n; $2 /= n; $3 /= n} {print}",
         "chi-square\n", ""}, /* rougher by 3% than the density */
        {"{$NF = 0; print}", "fails valid, agrees, mass, covers, chi-square\n", ""},
        {"{$NF = \"nan\"; print}", "fails valid, agrees, mass, covers, chi-square\n", ""},
    };
    static const char *const broken[][2] = {
        {"NR == 7 {$0 = \"1 2 abc\"} {print}",
         "line 7, '1 2 abc', is not wm.x wm.y wm.z pdf; it answers: s 0 0 1 "},
        {"NF == 1 {$0 = $0 \" 1\"} {print}", "1', is not a number, pdf; it answers: p 0 "},
        {"NR <= 5 {print}", "5 of "},
        {"{print} END {print 5}", "there are more answers than the "},
        {"{exit 3}", "ended with status 3"},
    };
    for (size_t i = 0; i < sizeof defects / sizeof *defects; i++) {
        const char *text = judged(1, sampler("0.3 0.1", defects[i][0]), "--ndf ggx --alpha 0.3,0.1");
        if (!(TEST_HAS(text, defects[i][1]) & TEST_HAS(text, defects[i][2])))
            fprintf(stderr, "  %s\n%s", defects[i][0], text);
    }
    for (size_t i = 0; i < sizeof broken / sizeof *broken; i++)
        if (!TEST_HAS(judged(2, sampler("0.3", broken[i][0]), ""), broken[i][1]))
            fprintf(stderr, "  %s\n", broken[i][0]);
    TEST_HAS(judged(2, "./no-such-sampler", ""), "'./no-such-sampler' ended with status 127: there is no such");
    TEST_HAS(judged(2, "yes nan", ""), "'yes nan' writes without an end");
    TEST_HAS(judged(2, sampler("0.3", NULL), "--alpha 0.3"), "--alpha is for --ndf");
    TEST(strcmp(judged(1, sampler("0.3", "{$NF = 0; print}"), "-q"), "") == 0);
}

int main(int argc, char **argv)
{
    (void)argv;
    if (argc > 1 && system("python3 -c pass") != 0)
        puts("SKIPPED: no python3");
    else if (argc > 1)
        TEST_HAS(judged(0, "python3 " VNDF_SOURCE_DIR "/tools/judge/examples/ggx_caps.py 0.3 0.1", ""),
                 "result good");
    else {
        test_right();
        test_wrong();
    }
    return argc > 1 && test_checks == 0 ? 0 : test_done();
}
