/* The verdict is made from all that a table says of itself: each number of its certificate and each note that is beyond
 * its limit is a doubt that names it, none within is one; what is advised would help; what a table needs is said with
 * it; and a table says the same after it was saved and loaded. It notices a doubt that is left out, a limit that is
 * moved, and advice that no size or number of moments makes true. */
#include "cli/verdict.h"

#include <stddef.h>

#include "harness/damage.h"

enum { ROOM = 1 << 14, CLAIMS = 44 }; /* where the certificate stands in the file */

/* A table of exp(-r^2) with `scale` times its density and these notes. */
static vndf_distribution *table_of(double scale, const char *notes)
{
    enum { ROWS = 60 };
    vndf_error error = {VNDF_OK, ""};
    double x[ROWS], value[ROWS];
    for (int i = 0; i < ROWS; i++) {
        x[i] = i * 0.06;
        value[i] = scale * exp(-x[i] * x[i]) / PI;
    }
    vndf_source *source = vndf_source_rows(VNDF_ROWS_OVER_SLOPE, VNDF_ROWS_OF_P22, x, value, ROWS, NULL, &error);
    const vndf_build_options small = {.max_bytes = 4096};
    vndf_distribution *made =
        vndf_source_note(source, notes, &error) == VNDF_OK ? vndf_build(source, &small, NULL, &error) : NULL;
    if (!TEST(made != NULL))
        fprintf(stderr, "  %s\n", error.message);
    vndf_source_free(source);
    return made;
}

/* Saves, puts the numbers in the certificate, loads; what the verdict says behind the size must be `want`. */
typedef struct claim {
    size_t member;
    double value;
} claim;

static void test_worth(const vndf_distribution *table, const claim *claims, size_t count, const char *want)
{
    static unsigned char bytes[ROOM];
    char text[VERDICT_TEXT];
    const size_t size = vndf_distribution_info(table).bytes;
    if (!TEST(size > 0 && size < ROOM && vndf_save_memory(table, bytes, size, NULL) == VNDF_OK))
        return;
    for (size_t i = 0; i < count; i++) {
        const float value = (float)claims[i].value;
        memcpy(bytes + CLAIMS + claims[i].member, &value, sizeof value);
    }
    mend_checksum(bytes, size);
    vndf_distribution *loaded = vndf_load_memory(bytes, size, NULL);
    const table_verdict is = verdict_of(&(chosen_distribution){.distribution = loaded});
    const char *found = strstr(verdict_text(&is, text), "KiB; ");
    if (!TEST(loaded && found && strcmp(found + 5, want) == 0))
        fprintf(stderr, "  %s\n  wanted: %s\n", text, want);
    TEST(strcmp(vndf_distribution_info(loaded).notes, vndf_distribution_info(table).notes) == 0);
    vndf_free(loaded);
}

#define OF(member) offsetof(vndf_certificate, member)

static void test_claims(void)
{
    static const struct {
        claim within, beyond[4];
        const char *says;
    } cases[] = {
        {{OF(tv), 0.0499},
         {{OF(tv), 0.0501}, {OF(tv_theta), 100}},
         "worth little at 100 degrees: try a larger --max-bytes"},
        {{OF(tv), 0.0499},
         {{OF(tv), 0.0501}, {OF(tv_theta), 100}, {OF(floor), 0.045}},
         "worth little at 100 degrees, and no size mends it"},
        {{OF(tv_above), 0.0499},
         {{OF(tv_above), 0.06}, {OF(tv_above_theta), 9}},
         "worth little at 9 degrees: try a larger --max-bytes"},
        {{OF(tv_above), 0.0499},
         {{OF(tv_above), 0.06}, {OF(tv_above_theta), 9}, {OF(floor_above), 0.06}},
         "worth little at 9 degrees, and no size mends it"},
        {{OF(max_weight), 9.9},
         {{OF(max_weight), (double)INFINITY}},
         "weights up to inf, which show as fireflies"},
        {{OF(area_error), 0.0499}, {{OF(area_error), 0.06}}, "Lambda and G1 are up to 6% off"},
        {{OF(consistency), 0.0019},
         {{OF(consistency), 0.0022}},
         "densities integrate to 1 within 0.0022 alone, a bias"},
        {{OF(ndf_error), 0.9}, {{OF(ndf_error), 1.5}}, "D is up to 150% off"},
        {{OF(hidden), 9e-4}, {{OF(hidden), 0.01}}, "0.01 of the normals may have been missed"},
        {{OF(horizon_power), -0.9},
         {{OF(tv), 0.2}, {OF(tv_theta), 5}, {OF(max_weight), 30}},
         "worth little at 5 degrees: try a larger --max-bytes; weights up to 30, which show as fireflies"},
        {{OF(weight_bounded), 0}, {{OF(max_weight), 11}}, "weights up to 11, which show as fireflies"},
    };
    vndf_distribution *table = table_of(1, "");
    char want[512];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        size_t count = 1;
        while (count < 4 && (cases[i].beyond[count].value > 0 || cases[i].beyond[count].value < 0))
            count++;
        test_worth(table, &cases[i].within, 1, "good to ship");
        snprintf(want, sizeof want, "doubtful: %s", cases[i].says);
        test_worth(table, cases[i].beyond, count, want);
    }
    const claim sampled[] = {{OF(hidden), 1}, {OF(finest), 1e-3}};
    test_worth(table, sampled, 2, "good to ship if no feature is narrower than 0.001 of its slope");
    vndf_free(table);
}

static void test_notes(void)
{
    static const struct {
        double scale;
        const char *notes, *worth;
    } cases[] = {
        {3, "", "good to ship"},
        {3, "origin a laboratory\n", "good to ship"},
        {1.03, "residual_isotropy 0.049\n", "good to ship"},
        {1.7, "residual_isotropy 0.02\n", "doubtful: the measured D integrates to 1.7, not 1"},
        {0.5, "residual_reflectance 0.02\n", "doubtful: the measured D integrates to 0.5, not 1"},
        {1, "residual_isotropy 0.82\n",
         "doubtful: 0.82 of the normals would have to turn about z: the slopes are no ellipse"},
        {1, "residual_isotropy 0.1\nslopes 1500\n",
         "doubtful: 0.1 of the normals would have to turn about z: too few slopes to tell; measure more of the "
         "surface"},
        {1, "residual_isotropy 0.1\nslopes 5000\n",
         "doubtful: 0.1 of the normals would have to turn about z: the slopes are no ellipse"},
        {1, "residual_reflectance 0.099\n", "good to ship"},
        {1, "residual_reflectance 0.2\n", "doubtful: 0.2 of the light is not that of one D"},
        {1, "p22_error_median 0.09\np22_error_99 0.5\n", "good to ship"},
        {1, "p22_error_median 0.3\n", "doubtful: P22 is known within 30% alone: measure more of the surface"},
        {1, "left_out 9\nslopes 991\n", "good to ship"},
        {1, "left_out 200\nslopes 800\n", "doubtful: 20% of the pixels are no normals"},
        {1, "implausible scale: in mm?\nimplausible too\n",
         "doubtful: implausible scale: in mm?; implausible too"},
        {1, "tilt 1e-3,0\nrms_slope 0.2\n", "good to ship"},
        {1, "tilt 0.02,-0.1\nrms_slope 0.2\n", "good to ship with the mean slope 0.02,-0.1"},
        {1, "tilt 0.4,0\nrms_slope 0.2\n",
         "doubtful with the mean slope 0.4,0: the surface leans as a whole, is it meant to?"},
        {1, "rms_slope 0.2\nmatrix 2,0,0,0.5\ntilt 0.1,0\n",
         "good to ship with the matrix 2,0,0,0.5 and the mean slope 0.1,0"},
        {1, "matrix 2,0,0,0.5\nresidual_isotropy 0.3\n",
         "doubtful with the matrix 2,0,0,0.5: 0.3 of the normals would have to turn about z: the slopes are no "
         "ellipse"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        vndf_distribution *table = table_of(cases[i].scale, cases[i].notes);
        TEST(strcmp(vndf_distribution_info(table).notes, cases[i].notes) == 0);
        test_worth(table, NULL, 0, cases[i].worth);
        vndf_free(table);
    }
}

/* More moments are advised where they help alone: with two, whose floor is above what is poor. */
static void test_moments(void)
{
    const claim floored[] = {{OF(tv_above), 0.06}, {OF(tv_above_theta), 80}, {OF(floor_above), 0.058}};
    const vndf_build_options two = {.max_bytes = 2048, .moments = 2};
    vndf_source *source = vndf_source_family("student-t:2.5", NULL);
    vndf_distribution *table = vndf_build(source, &two, NULL, NULL);
    test_worth(table, floored, 3, "doubtful: worth little at 80 degrees: try --moments 4");
    test_worth(table, floored, 2, "doubtful: worth little at 80 degrees: try a larger --max-bytes");
    vndf_free(table);
    vndf_source_free(source);
}

int main(void)
{
    test_claims();
    test_notes();
    test_moments();
    return test_done();
}
