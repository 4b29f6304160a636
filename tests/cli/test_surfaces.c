/* The normals that `vndf sample` writes have the densities of the surface that its words say, by the library, in both
 * forms of file; the seed and the number are those asked for; a diagonal matrix prints the bytes of its roughness. It
 * notices an option that is not used, numbers that are exchanged, and a family that is taken at another parameter. */
#include "harness/run_program.h"

#include "cli/files.h"
#include "vndf.h"

static char text[RUN_TEXT], other[RUN_TEXT];

#define ROUGH " --theta 60 --phi 30 --alpha 0.1,0.3"

/* 100 samples in these words, as a CSV. */
static char *samples(char into[RUN_TEXT], const char *words)
{
    return run_said(into, "vndf sample %s -n 100 -o -", words);
}

/* What is seen from theta and phi, degrees. */
static void test_densities(const char *words, const vndf_mixture *surface, double theta, double phi)
{
    static const char header[] = "wm.x,wm.y,wm.z,pdf\n";
    const double t = theta * PI / 180, p = phi * PI / 180;
    const vndf_vec3 wi = {(float)(sin(t) * cos(p)), (float)(sin(t) * sin(p)), (float)cos(t)};
    const vndf_mixture_view view = vndf_mixture_view_from(surface, wi);
    double x, y, z, pdf;
    int count = 0, length = 0;
    samples(text, words);
    TEST(strncmp(text, header, strlen(header)) == 0);
    for (const char *at = text + strlen(header); *at; at += length, count++) {
        if (!TEST(sscanf(at, "%lf,%lf,%lf,%lf\n%n", &x, &y, &z, &pdf, &length) == 4))
            return;
        const vndf_vec3 wm = {(float)x, (float)y, (float)z};
        TEST_RELATIVE((double)vndf_mixture_pdf(&view, wm), pdf, 2e-4); /* wi is rounded otherwise */
    }
    TEST(count == 100);
}

static void test_surfaces(void)
{
    vndf_distribution *table = vndf_load("table", NULL);
    vndf_family *family = vndf_family_load("two.vndfs", NULL);
    vndf_surface map = vndf_rough(table, 0.1f, 0.3f);
    vndf_mixture of_family = {.count = 0};
    if (!TEST(table && family))
        return;
    test_densities("table" ROUGH, &(vndf_mixture){1, {{map, 1}}}, 60, 30);
    map = (vndf_surface){vndf_beckmann(), 0.2f, 0.1f, -0.05f, 0.3f, 0.3f, -0.2f};
    test_densities("beckmann --theta 110 --matrix 0.2,0.1,-0.05,0.3 --mean 0.3,-0.2",
                   &(vndf_mixture){1, {{map, 1}}}, 110, 0);
    map = vndf_rough(vndf_ggx(), 0.3f, 0.3f);
    vndf_family_at(family, 2.4f, &map, &of_family);
    test_densities("two.vndfs@2.4 --theta 70 --alpha 0.3", &of_family, 70, 0);
    vndf_free(table);
    vndf_family_free(family);
}

static void test_files(void)
{
    size_t size;
    float first[4], raw[4] = {0};
    run_said(text, "vndf sample table" ROUGH " -n 1e2 --seed=1 -o a.csv");
    run_said(text, "vndf sample table" ROUGH " -n 100 -o a.f32");
    TEST(strcmp(samples(text, "table" ROUGH), run_said(other, "cat a.csv")) == 0);
    TEST(strcmp(text, samples(other, "table" ROUGH " --seed 2")) != 0);
    TEST(sscanf(strchr(text, '\n'), "%f,%f,%f,%f", &first[0], &first[1], &first[2], &first[3]) == 4);
    char *bytes = run_file("a.f32", &size);
    for (size_t i = 0; TEST(bytes && size == 1600) && i < 4; i++)
        raw[i] = (float)little_number((const unsigned char *)bytes + 4 * i, 4);
    TEST(memcmp(raw, first, sizeof raw) == 0);
    free(bytes);
    TEST(strcmp(text, samples(other, "table --theta 60 --phi 30 --matrix 0.1,0,0,0.3")) == 0);
    samples(text, "ggx" ROUGH);
    TEST(strlen(text) > 100 && strcmp(text, samples(other, "ggx --theta 60 --phi 30 --matrix 0.1,0,0,0.3")) == 0);
}

int main(void)
{
    char folder[] = "surfaces.XXXXXX";
    if (!run_begin(folder))
        return test_done();
    run_said(text, "cp '" VNDF_SOURCE_DIR "/tables/student-t-2.5-small.vndf' table; vndf build --family student-t "
                   "--parameter 1.8..3 --knots 2 --max-bytes 2048 -o two.vndfs");
    test_surfaces();
    test_files();
    TEST(system("rm table a.csv a.f32 two.vndfs") == 0);
    return run_end(folder);
}
