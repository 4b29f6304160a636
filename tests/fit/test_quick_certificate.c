/* A quick certificate stands in the same table as the full one: every byte is the same but for the certificate and the
 * checksum. What it claims is no less than the full one divided by 1.5, for every shipped recipe and for distributions
 * that are not shipped: jumps, rings, mixtures of widths, heavy tails. The file says that it is quick. Where the size
 * of a table depends on a total variation both lead to the same size. */
#include "harness/test.h"
#include "oracle/oracle.h"
#include "table/file.h"

static const double FACTOR = 1.5;

/* Where the certificate stands in the file, and its end (table/file.h). */
enum { BEFORE = 60, AFTER = BEFORE + VNDF_CERTIFICATE_BYTES };

static const struct subject {
    const char *name;
    size_t bytes;
    int soon; /* tried without `more`, too */
} SUBJECTS[] = {
    {"exp(-r^2)*(1+r)", 4096, 1},
    {"step(1-r)", 4096, 1},
    {"exp(-((r-1)/0.01)^2)", 4096, 1},
    {"mix:(0.5,1,ggx)+(0.5,0.01,ggx)", 4096, 1},
    {"student-t:1.7", 4096, 1},
    {"abc:two-layer-gold", 2048, 1}, /* its largest weight stands at 89.9 degrees */
    {"exp(-3*r)*(1+0.8*cos(6*r))", 4096, 0},
    {"1/(1+r^4)", 4096, 0},
    {"ggx", 2048, 0},
    {"beckmann", 16384, 0},
    {"student-t:1.6", 2048, 0},
    {"student-t:10", 4096, 0},
    {"gtr:0.7", 4096, 0},
    {"gtr:5", 2048, 0},
    {"epd:0.3", 4096, 0},
    {"epd:3", 2048, 0},
    {"phong:20", 4096, 0},
    {"sgd:red-fabric/r", 2048, 0},
    {"mix:(0.5,1,ggx)+(0.5,0.0001,ggx)", 4096, 0},
    {"mix:(0.5,1,student-t:6)+(0.5,0.1,ggx)", 4096, 0},
    {"mix:(0.9,1,beckmann)+(0.1,0.05,beckmann)", 2048, 0},
    {"exp(-r)*(1+0.5*sin(20*r))", 4096, 0},
    {"1/(1+r^2)^3*(1+0.9*cos(10*log(1+r)))", 4096, 0},
    {"exp(-((r-1)/0.3)^2)", 2048, 0},
    {"exp(-((r-1)/0.1)^2)", 16384, 0},
    {"exp(-((r-1)/0.03)^2)", 4096, 0},
    {"exp(-((r-1)/0.001)^2)", 4096, 0},
    {"exp(-r)+100*exp(-((r-2)/0.001)^2)", 4096, 0},
    {"exp(-r^2)+0.01*exp(-((r-3)/0.05)^2)", 4096, 0},
    {"step(1-abs(r-1)*5)", 4096, 0},
    {"step(2-r)*step(r-1)", 2048, 0},
    {"step(1-r)+0.1*step(3-r)", 16384, 0},
    {"max(0,1-r)", 4096, 0},
    {"max(0,1-r)", 16384, 0}, /* a narrow maximum of the weight between two rows */
    {"exp(-((r-1)/0.01)^2)", 2048, 0},
    {"mix:(0.5,1,ggx)+(0.5,0.0001,ggx)", 16384, 0},
    {"sqrt(max(0,1-r^2))", 4096, 0},
    {"r^4*exp(-r^2)", 4096, 0},
    {"exp(-r^0.3)", 4096, 0},
    {"r^-1.5*exp(-r)", 4096, 0},
    {"1/(1+r^3.3)", 4096, 0},
    {"1/(0.01+(r-1)^2)^2", 2048, 0},
};

static unsigned char bytes_of[2][1 << 20];

static size_t save(const vndf_distribution *table, unsigned char *bytes)
{
    size_t size = vndf_distribution_info(table).bytes;
    TEST(size <= sizeof bytes_of[0] && vndf_save_memory(table, bytes, size, NULL) == VNDF_OK);
    return size;
}

static int same_but_for_certificates(const vndf_distribution *a, const vndf_distribution *b)
{
    size_t size = save(a, bytes_of[0]), other = save(b, bytes_of[1]);
    return TEST(size == other) && TEST(memcmp(bytes_of[0], bytes_of[1], BEFORE) == 0) &&
           TEST(memcmp(bytes_of[0] + AFTER, bytes_of[1] + AFTER, size - AFTER - 4) == 0);
}

/* An error of the full certificate against that of the quick one. */
static int is_near(float full, float quick)
{
    return (double)full <= FACTOR * (double)quick + 1e-7;
}

static int claims_agree(vndf_certificate full, vndf_certificate quick)
{
    return TEST(is_near(full.tv, quick.tv)) & TEST(is_near(full.tv_above, quick.tv_above)) &
           TEST(is_near(full.max_weight - 1, quick.max_weight - 1)) &
           TEST(is_near(full.area_error, quick.area_error)) & TEST(is_near(full.ndf_error, quick.ndf_error)) &
           TEST(is_near(full.consistency, quick.consistency)) & TEST(quick.consistency >= 4e-8f) &
           TEST(full.weight_bounded == quick.weight_bounded) & TEST(full.horizon_power == quick.horizon_power) &
           TEST(full.hidden == quick.hidden) & TEST(full.finest == quick.finest);
}

/* The mark is in the file, and costs nothing else of it. */
static int is_marked(const vndf_distribution *table, vndf_certificate claim)
{
    vndf_distribution *again = vndf_load_memory(bytes_of[1], save(table, bytes_of[1]), NULL);
    if (!TEST(again != NULL))
        return 0;
    vndf_certificate read = vndf_distribution_info(again).certificate;
    vndf_free(again);
    return TEST(claim.quick == 1) & TEST(memcmp(&read, &claim, sizeof claim) == 0);
}

static vndf_distribution *build(const vndf_source *source, size_t bytes, double tv, int quick,
                                vndf_certificate *claim)
{
    const vndf_build_options options = {.max_bytes = bytes, .max_tv = tv, .quick = quick};
    return vndf_build(source, &options, claim, NULL);
}

static void test_source(const char *name, vndf_source *source, size_t bytes)
{
    vndf_certificate full = {.tv = 1}, quick = full;
    vndf_distribution *a = source ? build(source, bytes, 0, 0, &full) : NULL;
    vndf_distribution *b = source ? build(source, bytes, 0, 1, &quick) : NULL;
    int good = TEST(a && b) && (same_but_for_certificates(a, b) & TEST(full.quick == 0) & is_marked(b, quick) &
                                claims_agree(full, quick));
    if (!good)
        fprintf(stderr,
                "  %s, %lu bytes: full TV %.4g (%.4g above), weight %.6g, area %.3g, D %.3g;"
                " quick TV %.4g (%.4g), weight %.6g, area %.3g, D %.3g\n",
                name, (unsigned long)bytes, (double)full.tv, (double)full.tv_above, (double)full.max_weight,
                (double)full.area_error, (double)full.ndf_error, (double)quick.tv, (double)quick.tv_above,
                (double)quick.max_weight, (double)quick.area_error, (double)quick.ndf_error);
    vndf_free(a);
    vndf_free(b);
    vndf_source_free(source);
}

/* FILE.vndf --family NAME [--max-bytes N], NAME perhaps between quotes, or FILE.vndf --csv NAME. */
static int test_recipe(const char *line)
{
    char name[256] = "", path[512];
    unsigned long bytes = 0;
    const char *size = strstr(line, "--max-bytes ");
    if (size)
        bytes = strtoul(size + strlen("--max-bytes "), NULL, 10);
    if (sscanf(line, "%*s --csv %255s", name) == 1) {
        snprintf(path, sizeof path, VNDF_SOURCE_DIR "/tables/%s", name);
        test_source(name, vndf_source_csv_file(path, NULL), bytes);
        return 1;
    }
    if (sscanf(line, "%*s --family '%255[^']'", name) == 1 || sscanf(line, "%*s --family %255s", name) == 1) {
        test_source(name, vndf_source_family(name, NULL), bytes);
        return 1;
    }
    return 0;
}

static void test_recipes(void)
{
    char line[1024];
    size_t found = 0, most = test_amount(2, 15, 15);
    FILE *recipes = fopen(VNDF_SOURCE_DIR "/tables/recipes.txt", "r");
    if (!TEST(recipes != NULL))
        return;
    while (found < most && fgets(line, sizeof line, recipes))
        if (line[0] != '#' && line[0] != '\n' && TEST(test_recipe(line)))
            found++;
    fclose(recipes);
    TEST(found == most);
}

/* A target between the two total variations: the full certificate does not reach it, so neither kind of build does. */
static void test_target(void)
{
    vndf_certificate full = {.tv = 0}, quick = full;
    vndf_source *source = oracle_source_of("epd:0.6", NULL);
    vndf_build_options all = {.max_bytes = 4096, .sphere = 1}; /* as tables for a target are */
    vndf_free(vndf_build(source, &all, &full, NULL));
    all.quick = 1;
    vndf_free(vndf_build(source, &all, &quick, NULL));
    double between = ((double)full.tv + (double)quick.tv) / 2;
    TEST((double)full.tv > 1.01 * (double)quick.tv);
    vndf_distribution *a = build(source, 4096, between, 0, NULL), *b = build(source, 4096, between, 1, NULL);
    TEST(a == NULL && b == NULL);
    vndf_free(a);
    vndf_free(b);
    a = build(source, 4096, 3 * between, 0, NULL);
    b = build(source, 4096, 3 * between, 1, NULL);
    TEST(a && b && same_but_for_certificates(a, b));
    vndf_free(a);
    vndf_free(b);
    vndf_source_free(source);
}

static void test_refusal(void)
{
    vndf_error error = {VNDF_OK, ""};
    const vndf_build_options options = {.quick = 2};
    vndf_source *source = vndf_source_family("ggx", NULL);
    TEST(vndf_build(source, &options, NULL, &error) == NULL && error.status == VNDF_ERROR_ARGUMENT);
    TEST_HAS(error.message, "quick is 2");
    vndf_source_free(source);
}

int main(void)
{
    test_recipes();
    for (size_t i = 0; i < sizeof SUBJECTS / sizeof *SUBJECTS; i++)
        if (test_long() || SUBJECTS[i].soon)
            test_source(SUBJECTS[i].name, oracle_source_of(SUBJECTS[i].name, NULL), SUBJECTS[i].bytes);
    test_target();
    test_refusal();
    return test_done();
}
