/* `vndf build` from measured files and `vndf export --rgl`: what goes out comes in as the same distribution, and tables
 * say what file they were made of and what was found. */
#include "harness/run_program.h"

static char text[RUN_TEXT], found[RUN_TEXT];

/* Of a line `KEY number` of the figures in text. */
static double number(const char *key)
{
    char line[64];
    snprintf(line, sizeof line, "\n%s ", key);
    const char *at = strstr(text, line);
    return at ? strtod(at + strlen(line), NULL) : NAN;
}

/* What building a table of 2 KiB says of the rest of the words. */
static void build(const char *words)
{
    run_said(text, "vndf build %s --max-bytes 2048", words);
}

static void test_bsdf(void)
{
    TEST(*run_said(text, "vndf export ggx --rgl --alpha 0.4 --f0 0.9,0.6,0.3 -o out.bsdf") == '\0');
    build("--rgl out.bsdf -o in.vndf");
    TEST_HAS(text, "source --rgl out.bsdf (crc32 ");
    TEST_NEAR(number("scale"), 0.4, 2e-4); /* the median slope of GGX is its alpha */
    run_line(0, "", "vndf export in.vndf --rgl --wavelengths 400,700 --f0 0.5 -o spectral.bsdf");
    run_line(0, "", "[ $(wc -c <spectral.bsdf) -lt 4000000 ]");
}

/* 48 x 48 heights, smoothed along rows: slopes of both axes differ. */
static void test_heights(void)
{
    static const char *const doubt = "doubtful with the matrix ";
    unsigned long long state = 1;
    double height = 0;
    FILE *file = fopen("heights.txt", "w");
    for (int i = 0; i < 48 * 48; i++) {
        height = (3 * height + 1000 * test_uniform_double(&state)) / 4;
        fprintf(file, "%.0f%c", height, i % 48 == 47 ? '\n' : ' ');
    }
    fclose(file);
    build("--height heights.txt --step 200,300 -o heights.vndf");
    TEST_HAS(text, "source --height heights.txt --step 200,300 (crc32 ");
    TEST_HAS(text, "\nheights 48 x 48, 200 x 300 apart\nslopes 2116\n");
    const double finer = number("rms_slope");
    build("--height heights.txt --step 400,400 --profile curve.csv -o heights.vndf");
    const double before = number("scale");
    TEST(finer > number("rms_slope"));
    run_line(0, "", "grep -q '^# --height heights.txt --step 400,400 (crc32 ' curve.csv");
    run_line(0, "", "grep -A 1 -x slope,p22 curve.csv | grep -q '^[-.e0-9]*,[-.e0-9]*$'");
    build("--csv curve.csv -o again.vndf");
    TEST(number("scale") == before);
    build("--height heights.txt --step 0.001 --cutoff 4 -o heights.vndf");
    TEST_HAS(text, "\ncutoff 4\nslopes 1936\n");
    TEST_HAS(text, doubt);
    /* What was found stays with the table. */
    const char *from = strstr(text, "\nheights 48 x 48"), *verdict = from ? strstr(from, "\nverdict ") : NULL;
    if (TEST(verdict && strstr(from, "\ntilt ") && strstr(from, "\nmatrix ") && strstr(from, "\np22_error_99 "))) {
        snprintf(found, sizeof found, "%.*s", (int)(verdict - from), from);
        TEST_HAS(run_line(0, "\nresult good", "vndf check heights.vndf --samples 1000")->text, found);
    }
    run_line(0, doubt, "vndf info heights.vndf --json -q");
}

int main(void)
{
    char folder[] = "measured.XXXXXX";
    if (!run_begin(folder))
        return test_done();
    test_bsdf();
    test_heights();
    run_line(0, "", "rm *.bsdf *.vndf curve.csv heights.txt");
    return run_end(folder);
}
