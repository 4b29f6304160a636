/* `vndf judge` passes right samplers - tools/judge/examples, and one whose density has 400 constant cells - and names
 * what is wrong with others, by words, exit status and a query that shows it; what it tells of GGX beside Beckmann is
 * known in closed form. An argument is a part, `python`, `right` or a fault; `sampler FAULT`: a sampler with it. */
#include "harness/run_program.h"
#include "vndf.h"

static const char *self; /* this program */

/* ---- samplers ------------------------------------------------------------------------------------ */

static int is(const char *fault, const char *name)
{
    return strcmp(fault, name) == 0;
}

/* u to u' of 20 x 20 cells: half of each pair of cells along u1 has 3 times the density of the other. */
static double cells(double *u, int is_inverse)
{
    const double pair = floor(u[0] * 10) / 10, at = fmin(10 * (u[0] - pair), 1), row = floor(u[1] * 20);
    const double edge = fmod(row, 2) == 0 ? 0.25 : 0.75, from = is_inverse ? 0.5 : edge,
                 to = is_inverse ? edge : 0.5;
    u[0] = pair + 0.1 * (at < from ? at / from * to : to + (at - from) / (1 - from) * (1 - to));
    return at < from ? to / from : (1 - to) / (1 - from);
}

/* The density at wm of a direction, with what is wrong of densities. */
static double density(const char *fault, const vndf_view *view, vndf_vec3 wi, vndf_vec3 wm)
{
    double p = (double)vndf_pdf(view, wm);
    if (is(fault, "cells") || is(fault, "cells of mass 1.01")) {
        float u1, u2;
        vndf_invert(view, wm, &u1, &u2);
        double u[2] = {(double)u1, (double)u2};
        p *= cells(u, 1);
    }
    if (is(fault, "mass") || is(fault, "cells of mass 1.01"))
        p *= 1.01;
    if (is(fault, "zero"))
        p = 0;
    if (is(fault, "spikes"))
        p *= 1e-3 / pow(1e-4 + fabs(sin(4e3 * (double)wm.x)), 4);
    return is(fault, "grazing") && wi.z < 0.0262f ? NAN : p;
}

static int sampler(const char *fault)
{
    const vndf_surface surface = vndf_rough(vndf_ggx(), 0.3f, 0.1f);
    vndf_vec3 wi, x;
    for (char kind; scanf(" %c %f %f %f %f %f %f", &kind, &wi.x, &wi.y, &wi.z, &x.x, &x.y, &x.z) == 7;) {
        const vndf_view view = vndf_view_from(&surface, wi);
        if (kind == 'p') {
            printf("%.9g\n", density(fault, &view, wi, x));
            continue;
        }
        double u[2] = {(double)x.x, (double)x.y};
        if (is(fault, "clump") && u[1] < 0.002)
            u[0] = 0.3, u[1] = 0.001;
        if (is(fault, "clamped"))
            u[0] = fmin(u[0], 0.999);
        if (is(fault, "hole") && u[0] > 0.4 && u[0] < 0.4316 && u[1] > 0.5 && u[1] < 0.5316)
            u[0] = fmod(u[0] * 1e3, 1), u[1] = fmod(u[1] * 1e3, 1);
        if (is(fault, "cells") || is(fault, "cells of mass 1.01"))
            cells(u, 0);
        vndf_vec3 wm = vndf_sample(&view, (float)u[0], (float)u[1], NULL);
        if (is(fault, "mirrored") && wi.y > wi.x && wi.x > 0) {
            const float across = 2 * (wm.x * wi.y - wm.y * wi.x) / (wi.x * wi.x + wi.y * wi.y);
            wm.x -= across * wi.y, wm.y += across * wi.x;
        }
        if ((is(fault, "turned") && wi.y < 0) || (is(fault, "above") && wi.z == 1 && wm.x < 0))
            wm.x = -wm.x;
        if (is(fault, "long"))
            wm.z *= 1.001f;
        double p = density(fault, &view, wi, wm) * (is(fault, "disagrees") ? 1.01 : 1);
        if ((is(fault, "u1 = 0") && x.x == 0) || (is(fault, "last u2") && x.y == 1 - 0x1p-24f))
            p = NAN;
        printf("%.9g %.9g %.9g %.9g\n", (double)wm.x, (double)wm.y, (double)wm.z, p);
    }
    return 0;
}

/* ---- what is said of them ------------------------------------------------------------------------ */

/* `more` words follow. */
static const char *judged(int status, const char *command, const char *more)
{
    setenv("JUDGED", command, 1);
    const char *samples = strstr(more, "--samples") ? ""
                          : test_amount(0, 1, 1)    ? "--samples 10000"
                                                    : "--samples 4000";
    return run_line(status, "", "vndf judge \"$JUDGED\" %s %s", samples, more)->text;
}

/* The example, with its answers through awk if there is a program for it. */
static const char *example(const char *alpha, const char *program)
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
    const char *text = judged(0, example("0.3 0.1", NULL), "--ndf ggx --alpha 0.3,0.1");
    TEST_HAS(text, "result good");
    TEST_HAS(text, "nearest_alpha 0.3,0.1\n");
    for (int i = 0; i < 14; i++) {
        TEST_NEAR(number_of(text, " degrees mass ", i), 1, number_of(text, " mass_error ", i) + 1e-4);
        TEST(number_of(text, " mass_error ", i) < 5e-3);
        TEST_NEAR(number_of(text, " tv ", i), 0, 1e-5);
        TEST_NEAR(number_of(text, " scatter ", i), 0.4, 0.4);
    }
    TEST_HAS(judged(0, example("0.02", NULL), "--seed 2"), "result good");
    /* Straight down x = R^2 has the densities (1 + x)^-2 and e^-x, which meet at 2.51286. */
    text = judged(1, example("0.3", NULL), "--ndf beckmann --alpha 0.3");
    TEST_HAS(text, "fails normals\nresult unbiased, but not these normals, nor of another alpha\n");
    TEST_NEAR(number_of(text, " tv ", 0), 0.2036, 1e-3);
    TEST_NEAR(number_of(text, " efficiency ", 0), 0.8, 4e-3); /* 1/integral e^-2x (1 + x)^2 */
    TEST_HAS(judged(1, example("0.25", NULL), "--ndf ggx --alpha 0.5"),
             "result unbiased, but not these normals: alpha 0.25 fits\n");
    /* Numbers that are shuffled have lost their strata, and nothing else. */
    char command[1024];
    snprintf(command, sizeof command,
             "awk '$1 == \"s\" {$5 = $5*7919.123%%1; $6 = $6*6101.7%%1} {print}' | %s 0.3", VNDF_JUDGED);
    TEST_NEAR(number_of(judged(0, command, ""), " scatter ", 0), 1, 0.3);
}

/* A query of the verdict, asked again, has the answer of the verdict. */
static void test_query(const char *text, const char *fault)
{
    char query[200] = "", answer[200] = "";
    const char *at = strstr(text, "query ");
    TEST(at && sscanf(at, "query %199[^\n]", query) == 1);
    char *end = strstr(query, " answer"), *next = at ? strstr(at, "answer ") : NULL;
    if (end)
        *end = '\0';
    TEST(next && sscanf(next, "answer %199[^\n]", answer) == 1);
    const char *again = run_line(0, "", "echo '%s' | '%s' sampler '%s'", query, self, fault)->text;
    if (!TEST(strncmp(answer, again, strlen(again) - 1) == 0))
        fprintf(stderr, "  %s: %s: %s, not %s", fault, query, again, answer);
}

/* Of one fault, or of all and of answers that are none. */
static void test_wrong(const char *only)
{
    static const char *const faults[][3] = {
        {"none", "result good\n", ""},
        {"disagrees", "fails agrees\n", ""},
        {"long", "fails unit", ""},
        {"mass", "fails mass\n", ""},
        {"zero", "fails valid, agrees, mass, covers, normals, chi-square\n", "--ndf ggx --alpha 0.3,0.1"},
        {"grazing", "fails valid, agrees, mass, covers, normals, chi-square\n", "--ndf ggx --alpha 0.3,0.1"},
        {"u1 = 0", "fails valid\n", "--seed 2"},
        {"last u2", "fails valid\n", "--seed 3"},
        {"clump", "fails moves", "--seed 4"},
        {"mirrored", "fails chi-square\n", "--seed 6"},
        {"clamped", "fails moves\n", "--seed 5"},
        {"turned", "chi-square\n", "--seed 7"},
        {"hole", "fails chi-square\n", "--samples 100000"},
        {"above", "farthest off theta_of_wi 0 degrees", "--seed 8"},
        {"spikes", "cannot_tell mass", ""}, /* from here on at full length */
        {"cells", "result good\n", ""},
        {"cells of mass 1.01", "fails mass\n", ""},
    };
    static const char *const broken[][2] = {
        {"NR == 7 {$0 = \"1 2 abc\"} {print}",
         "line 7, '1 2 abc', is not wm.x wm.y wm.z pdf; it answers: s 0 0 1 "},
        {"NF == 1 {$0 = $0 \" 1\"} {print}", "1', is not a number, pdf; it answers: p 0 "},
        {"NR <= 5 {print}", "5 of "},
        {"{print} END {print 5}", "there are more answers than the "},
        {"{exit 3}", "ended with status 3"},
    };
    const size_t all = sizeof faults / sizeof *faults;
    for (size_t i = 0; i < test_amount(all - 3, all - 3, all); i += only ? 1 : test_amount(3, 1, 1)) {
        if (only && !is(faults[i][0], only))
            continue;
        static char text[RUN_TEXT];
        const int is_right = strstr(faults[i][1], "good") != NULL;
        char line[1024];
        snprintf(line, sizeof line, "%s sampler '%s'", self, faults[i][0]);
        strcpy(text, judged(!is_right, line, faults[i][2]));
        if (!TEST_HAS(text, faults[i][1]))
            fprintf(stderr, "  %s\n%s", faults[i][0], text);
        else if (strstr(faults[i][1], "fails"))
            test_query(text, faults[i][0]);
    }
    if (only)
        return;
    for (size_t i = 0; i < sizeof broken / sizeof *broken; i++)
        if (!TEST_HAS(judged(2, example("0.3", broken[i][0]), ""), broken[i][1]))
            fprintf(stderr, "  %s\n", broken[i][0]);
    TEST_HAS(judged(2, "./no-such-sampler", ""), "'./no-such-sampler' ended with status 127: there is no such");
    TEST_HAS(judged(2, "yes nan", ""), "'yes nan' writes without an end");
    TEST_HAS(judged(2, "sleep 71 | cat", "--timeout 0.3"),
             "'sleep 71 | cat' wrote nothing for 0.3 s and was ended");
    run_line(1, "", "ps -o args -A | grep '^sleep 71'");
    TEST_HAS(judged(2, example("0.3", NULL), "--alpha 0.3"), "--alpha is for --ndf");
    TEST(strcmp(judged(1, example("0.3", "{$NF = 0; print}"), "-q"), "") == 0);
}

int main(int argc, char **argv)
{
    self = argv[0];
    if (argc > 2)
        return sampler(argv[2]);
    const char *only = argc > 1 ? argv[1] : NULL;
    const int is_python = only && is(only, "python");
    if (is_python && system("python3 -c pass") != 0)
        return puts("SKIPPED: no python3") < 0;
    if (is_python)
        TEST_HAS(judged(0, "python3 " VNDF_SOURCE_DIR "/tools/judge/examples/ggx_caps.py 0.3 0.1", ""),
                 "result good");
    if (!only || is(only, "right"))
        test_right();
    test_wrong(only);
    return test_done();
}
