/* sample and eval speak of one surface: eval gives each normal the density that sample wrote, in every form of file;
 * a diagonal matrix prints the bytes of its roughness, and a family the numbers of its tables. It notices an option
 * that is not used, and a column that is another one. */
#include "harness/run_program.h"

static char line[256], text[RUN_TEXT], other[RUN_TEXT];

#define ROUGH "--theta 60 --phi 30 --alpha 0.1,0.3"

/* 100 samples of a surface, in these words, as a CSV. */
static char *samples(char into[RUN_TEXT], const char *surface)
{
    snprintf(line, sizeof line, "sample %s -n 100 -o -", surface);
    return run_said(into, NULL, line);
}

static void test_same(const char *a, const char *b)
{
    if (!TEST(strlen(a) > 100 && strcmp(a, b) == 0))
        fprintf(stderr, "%.200s\n---\n%.200s\n", a, b);
}

/* The four numbers of a line, and the line behind it. */
static const char *read_line(const char *from, double number[4])
{
    int length = 0;
    TEST(sscanf(from, "%lf,%lf,%lf,%lf%n", &number[0], &number[1], &number[2], &number[3], &length) == 4);
    return from + length + (from[length] == '\n');
}

/* Every normal of `sample` has its density in `eval`, with the same words for the surface. */
static void test_densities(const char *surface)
{
    static const char header[] = "wm.x,wm.y,wm.z,pdf\n";
    const char *rows = samples(text, surface) + strlen(header), *at = other;
    double drawn[4], found[4];
    int count = 0;
    FILE *in = fopen("in", "w");
    TEST(strncmp(text, header, strlen(header)) == 0);
    for (const char *row = rows; in && *row;) {
        row = read_line(row, drawn);
        fprintf(in, "%.9g,%.9g,%.9g\r\n", drawn[0], drawn[1], drawn[2]);
    }
    TEST(in && fclose(in) == 0);
    snprintf(line, sizeof line, "eval %s", surface);
    for (run_said(other, "in", line); *rows; count++) {
        rows = read_line(rows, drawn);
        at = read_line(at, found);
        TEST_RELATIVE(found[1], drawn[3], 1e-4); /* the promise below the horizon */
        TEST_NEAR(found[3], 1 / (1 + found[2]), 1e-6);
    }
    TEST(count == 100 && *at == '\0');
}

static void test_sample(void)
{
    static const char *const rough[][2] = {
        {"ggx " ROUGH, "ggx --theta 60 --phi 30 --matrix 0.1,0,0,0.3"},
        {"beckmann " ROUGH, "beckmann --theta 60 --phi 30 --matrix 0.1,0,0,0.3"},
        {"table " ROUGH, "table --theta 60 --phi 30 --matrix 0.1,0,0,0.3"},
    };
    double first[4];
    size_t size;
    test_densities("table " ROUGH);
    test_densities("beckmann --theta 70 --matrix 0.2,0.1,-0.05,0.3 --mean 0.3,-0.2");
    run_said(text, NULL, "sample table " ROUGH " -n 1e2 --seed=1 -o a.csv");
    run_said(text, NULL, "sample table " ROUGH " -n 100 -o a.f32");
    TEST(run_has("a.csv", samples(text, "table " ROUGH)));
    TEST(strcmp(text, samples(other, "table " ROUGH " --seed 2")) != 0);
    read_line(strchr(text, '\n') + 1, first);
    unsigned char *raw = (unsigned char *)run_file("a.f32", &size);
    for (int i = 0; TEST(raw && size == 1600) && i < 4; i++) {
        const float number = (float)first[i];
        unsigned bits;
        memcpy(&bits, &number, sizeof bits);
        TEST((raw[4 * i] | raw[4 * i + 1] << 8 | raw[4 * i + 2] << 16 | (unsigned)raw[4 * i + 3] << 24) == bits);
    }
    free(raw);
    for (int i = 0; i < 3; i++)
        test_same(samples(text, rough[i][0]), samples(other, rough[i][1]));
}

/* ndf, pdf, lambda and g1 of the first line of "in". */
static void test_values(const char *eval, double ndf, double pdf, double lambda, double g1)
{
    const double known[4] = {ndf, pdf, lambda, g1};
    double found[4];
    read_line(run_said(text, "in", eval), found);
    for (int i = 0; i < 4; i++)
        TEST_NEAR(found[i], known[i], 2e-5);
}

static void test_maps(void)
{
    const double pi = 3.14159265358979;
    TEST(run_put("in", "0,0,1\n0.6,0,0.8\n-0.48,0.64,0.6\n"));
    /* GGX of alpha 1: D is 1/pi; from 60 degrees A = 3/4. */
    test_values("eval ggx --theta 60", 1 / pi, 2 / (3 * pi), 0.5, 2.0 / 3);
    test_values("eval ggx --matrix 0,0.5,0.25,0 --theta 0", 8 / pi, 8 / pi, 0, 1);
    /* The mean slope (1, 0) leans the normal to (-1, 0, 1), where GGX has its peak; lambda is of the mean plane. */
    TEST(run_put("in", "-0.70710678,0,0.70710678\n"));
    test_values("eval ggx --mean 1,0 --theta 0", 4 / pi, 4 / pi * sqrt(0.5), 0, 1);
}

/* Linear in 1/p: 1/2.25 is the mean of 1/1.8 and 1/3. */
static void test_families(void)
{
    double middle[4], first[4], last[4];
    run_said(text, NULL, "build --family student-t --parameter 1.8..3 --knots 2 --max-bytes 2048 -o two.vndfs");
    run_said(text, NULL, "build --family student-t:1.8 --max-bytes 2048 -o first.vndf");
    test_same(samples(text, "two.vndfs@1.8 --theta 70"), samples(other, "first.vndf --theta 70"));
    test_same(samples(text, "two.vndfs@2.4 --theta 70 --alpha 0.3"),
              samples(other, "two.vndfs@2.4 --theta 70 --matrix 0.3,0,0,0.3"));
    TEST(run_put("in", "0,0,1\n"));
    read_line(run_said(text, "in", "eval two.vndfs@2.25 --theta 0"), middle);
    read_line(run_said(text, "in", "eval two.vndfs@1.8 --theta 0"), first);
    read_line(run_said(text, "in", "eval two.vndfs@3 --theta 0"), last);
    TEST_RELATIVE(middle[0], (first[0] + last[0]) / 2, 1e-5);
}

int main(void)
{
    char folder[] = "surfaces.XXXXXX";
    if (!run_begin(folder) || !TEST(run_copy(VNDF_SOURCE_DIR "/tables/student-t-2.5-small.vndf", "table")))
        return test_done();
    test_sample();
    test_maps();
    test_families();
    TEST(system("rm in table a.csv a.f32 two.vndfs first.vndf") == 0);
    return run_end(folder);
}
