/* Figures are the same whoever prints them: build and info, of a file and of stdin; the verdict is the last of them,
 * and a table that is worth little is told of on stderr too; check fails a table whose certificate says less than is
 * true. It notices a figure without a unit, a verdict that praises a poor table, and a check that forgives. (JSON:
 * python_formats.) */
#include "harness/run_program.h"

#include "harness/damage.h"

static char text[RUN_TEXT], again[RUN_TEXT];

static double number_behind(const char *key)
{
    const char *at = strstr(text, key);
    return at ? strtod(at + strlen(key), NULL) : NAN;
}

/* A certificate that says 0.62 of what is true fails, whichever figure says it. */
static void test_false(void)
{
    static const int figures[] = {0, 2, 4, 6, 8}; /* tv, tv_above, max_weight, area_error, ndf_error */
    static unsigned char bytes[DAMAGE_BYTES_MAX];
    vndf_distribution *table = vndf_load("t", NULL);
    const vndf_certificate claim = vndf_distribution_info(table).certificate;
    const float *number = &claim.tv;
    size_t size = read_bytes("t", bytes, sizeof bytes), at = 0;
    while (at + sizeof claim < size && memcmp(bytes + at, &claim, sizeof claim) != 0)
        at++;
    for (int i = 0; i < 5; i++) {
        const float less = 0.62f * number[figures[i]];
        memcpy(bytes + at, &claim, sizeof claim);
        memcpy(bytes + at + sizeof less * (size_t)figures[i], &less, sizeof less);
        mend_checksum(bytes, size);
        FILE *file = fopen("false", "wb");
        TEST(file && fwrite(bytes, 1, size, file) == size && fclose(file) == 0);
        run_line(1, "result FAILED", "vndf check false --samples 1000");
    }
    vndf_free(table);
}

int main(void)
{
    char folder[] = "figures.XXXXXX";
    struct stat is;
    if (!run_begin(folder))
        return test_done();
    run_said(text, "vndf build --slope 'exp(-k*r)' --set k=2 --max-bytes 4096 -o t");
    TEST_HAS(text, "source --slope 'exp(-k*r)' --set k=2\n");
    TEST(stat("t", &is) == 0 && number_behind("\nbytes ") == (double)is.st_size && is.st_size <= 4096);
    TEST(strcmp(text, run_said(again, "vndf info t")) == 0 &&
         strcmp(text, run_said(again, "vndf info - <t")) == 0);
    TEST(strstr(text, " of the mass\ntv_theta ") && strstr(text, " degrees\n"));
    run_said(text, "vndf build --family phong --parameter 2..200 --knots 2 --max-bytes 2048 -q -o far.vndfs");
    TEST_HAS(text, "doubtful: mixtures are worth little: try more --knots");
    TEST(run_put("rows.csv", "slope,p22\n0,1\n0.5,0.8\n1,0.3\n2,0.01\n"));
    TEST_HAS(run_said(text, "vndf build --csv - -o c <rows.csv"), "source --csv stdin (crc32 ");
    run_said(text, "vndf build --slope 'exp(-r)*(1+0.9*sin(300*r))' --max-bytes 2048 -o - 2>&1 >m");
    TEST_HAS(text, "vndf build: within ");
    TEST(strstr(text, "doubtful: worth little at ") && strstr(text, "try a larger --max-bytes"));
    run_said(text, "vndf check t --samples 20000");
    TEST(strstr(text, "\ncertificate of tv_above ") && strstr(text, "\nchi_square alpha_x 1 ") &&
         strstr(text, "\nresult good\n"));
    TEST(*run_said(text, "vndf check ggx --samples 1000 -q") == '\0');
    test_false();
    TEST(system("rm t m c false rows.csv far.vndfs") == 0);
    return run_end(folder);
}
