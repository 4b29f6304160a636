/* sample and eval speak of one surface: eval gives each normal the density that sample wrote, in every form of file;
 * a diagonal matrix prints the bytes of its roughness, and a family the numbers of its tables. It notices an option
 * that is not used, and a column that is another one. */
#include "harness/run_program.h"

#define TABLE VNDF_SOURCE_DIR "/tables/student-t-2.5-small.vndf"

/* Frees both. */
static void test_same(char *a, char *b)
{
    if (!TEST(a && b && *a && strcmp(a, b) == 0))
        fprintf(stderr, "%.200s\n---\n%.200s\n", a, b);
    free(a);
    free(b);
}

/* The numbers of a line, and the line behind it. */
static const char *read_line(const char *text, double number[5])
{
    for (int i = 0; i < 5; i++) {
        char *end;
        number[i] = strtod(text, &end);
        text = end + (*end == ',');
        if (*end != ',')
            break;
    }
    return text + (*text == '\n');
}

/* Every normal of `sample` (the words behind the command) has its density in `eval`. */
static void test_densities(char *csv, const char *const *eval)
{
    static const char header[] = "wm.x,wm.y,wm.z,pdf\n";
    const char *rows = csv + strlen(header);
    double drawn[5], found[5];
    FILE *in = fopen("in", "w");
    TEST(strncmp(csv, header, strlen(header)) == 0);
    for (const char *at = rows; in && *at;) {
        at = read_line(at, drawn);
        fprintf(in, "%.9g,%.9g,%.9g\r\n", drawn[0], drawn[1], drawn[2]);
    }
    TEST(in && fclose(in) == 0);
    char *values = run_printed("in", eval);
    const char *at = values;
    int count = 0;
    for (; *rows; count++) {
        rows = read_line(rows, drawn);
        at = read_line(at, found);
        TEST_RELATIVE(found[1], drawn[3], 1e-4); /* the promise below the horizon */
        TEST_NEAR(found[3], 1 / (1 + found[2]), 1e-6);
    }
    TEST(count == 100 && *at == '\0');
    free(values);
    free(csv);
}

static void test_sample(void)
{
#define ROUGH "--theta", "60", "--phi", "30", "--alpha", "0.1,0.3"
#define SHEARED "--theta", "70", "--matrix", "0.2,0.1,-0.05,0.3", "--mean", "0.3,-0.2"
    static const char *const eval_rough[] = {"eval", TABLE, ROUGH, NULL};
    static const char *const eval_sheared[] = {"eval", "beckmann", SHEARED, NULL};
    const char *const names[] = {"ggx", "beckmann", TABLE};
    size_t size;
    test_densities(PRINTED("in", "sample", TABLE, ROUGH, "-n", "100", "-o", "-"), eval_rough);
    test_densities(PRINTED("in", "sample", "beckmann", SHEARED, "-n", "100", "-o", "-"), eval_sheared);
    free(PRINTED("in", "sample", TABLE, ROUGH, "-n", "100", "--seed=1", "-o", "a.csv"));
    free(PRINTED("in", "sample", TABLE, ROUGH, "-n", "1e2", "-o", "a.f32"));
    char *other = PRINTED("in", "sample", TABLE, ROUGH, "-n", "9", "--seed", "2", "-o", "-");
    char *file = run_file("a.csv", &size), *floats = run_file("a.f32", &size);
    TEST(floats && size == 1600 && strncmp(other, file, 60) != 0);
    test_same(PRINTED("in", "sample", TABLE, ROUGH, "-n", "100", "-o", "-"), file);
    free(floats);
    free(other);
    TEST(remove("a.csv") == 0 && remove("a.f32") == 0);
    for (int i = 0; i < 3; i++)
        test_same(PRINTED("in", "sample", names[i], ROUGH, "-n", "50", "-o", "-"),
                  PRINTED("in", "sample", names[i], "--theta", "60", "--phi", "30", "--matrix", "0.1,0,0,0.3",
                          "-n", "50", "-o", "-"));
}

/* ndf, pdf, lambda and g1 of the first line of "in". */
static void test_values(const char *const *words, double ndf, double pdf, double lambda, double g1)
{
    double found[5];
    char *text = run_printed("in", words);
    read_line(text, found);
    TEST_NEAR(found[0], ndf, 2e-5);
    TEST_NEAR(found[1], pdf, 2e-5);
    TEST_NEAR(found[2], lambda, 2e-5);
    TEST_NEAR(found[3], g1, 2e-5);
    free(text);
}

#define VALUES(ndf, pdf, lambda, g1, ...) \
  test_values((const char *const[]){"eval", __VA_ARGS__, NULL}, ndf, pdf, lambda, g1)

static void test_maps(void)
{
    const double pi = 3.14159265358979;
    TEST(run_put("in", "0,0,1\n0.6,0,0.8\n-0.48,0.64,0.6\n"));
    /* GGX of alpha 1: D is 1/pi; from 60 degrees A = 3/4. */
    VALUES(1 / pi, 2 / (3 * pi), 0.5, 2.0 / 3, "ggx", "--theta", "60");
    VALUES(8 / pi, 8 / pi, 0, 1, "ggx", "--matrix", "0,0.5,0.25,0", "--theta", "0");
    /* The mean slope (1, 0) leans the normal to (-1, 0, 1), where GGX has its peak; lambda is of the mean plane. */
    TEST(run_put("in", "-0.70710678,0,0.70710678\n"));
    VALUES(4 / pi, 4 / pi * sqrt(0.5), 0, 1, "ggx", "--mean", "1,0", "--theta", "0");
}

static void test_families(void)
{
    double middle[5], first[5], last[5]; /* linear in 1/p: 1/2.25 is the mean of 1/1.8 and 1/3 */
    free(PRINTED("in", "build", "--family", "student-t", "--parameter", "1.8..3", "--knots", "2", "--max-bytes",
                 "2048", "-o", "two.vndfs"));
    free(PRINTED("in", "build", "--family", "student-t:1.8", "--max-bytes", "2048", "-o", "first.vndf"));
    TEST(run_put("in", "0,0,1\n0.6,0,0.8\n"));
    test_same(PRINTED("in", "sample", "two.vndfs@1.8", "--theta", "70", "-n", "50", "-o", "-"),
              PRINTED("in", "sample", "first.vndf", "--theta", "70", "-n", "50", "-o", "-"));
    test_same(PRINTED("in", "eval", "two.vndfs@2.4", "--theta", "70", "--alpha", "0.3"),
              PRINTED("in", "eval", "two.vndfs@2.4", "--theta", "70", "--matrix", "0.3,0,0,0.3"));
    char *texts[] = {PRINTED("in", "eval", "two.vndfs@2.25", "--theta", "0"),
                     PRINTED("in", "eval", "two.vndfs@1.8", "--theta", "0"),
                     PRINTED("in", "eval", "two.vndfs@3", "--theta", "0")};
    read_line(texts[0], middle);
    read_line(texts[1], first);
    read_line(texts[2], last);
    TEST_RELATIVE(middle[0], (first[0] + last[0]) / 2, 1e-5);
    for (int i = 0; i < 3; i++)
        free(texts[i]);
    TEST(remove("two.vndfs") == 0 && remove("first.vndf") == 0);
}

int main(void)
{
    char folder[] = "surfaces.XXXXXX";
    if (!run_begin(folder) || !TEST(run_put("in", "")))
        return test_done();
    test_sample();
    test_maps();
    test_families();
    TEST(remove("in") == 0);
    return run_end(folder);
}
