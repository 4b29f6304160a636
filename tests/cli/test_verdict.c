/* The verdict is made from all that a table says of itself: each number of its certificate and each note that is beyond
 * its limit is a doubt, none within is one; what is advised would help; and what a table needs is said with it. It
 * notices a doubt that is left out, a limit that is moved, and advice that does not help. */
#include "commands/parts/describe.h"

#include "harness/test.h"

static const struct {
    float tv, tv_above, floor, floor_above, weight, area, consistency, ndf, hidden, finest;
    double integral;
    const char *notes, *worth;
} cases[] = {
    {0.0499f, 0.0499f, 0, 0, 9.9f, 0.0499f, 0.0019f, 0.9f, 9e-4f, 0, 3, "origin a laboratory\n", "good to ship"},
    {0, 0, 0, 0, 0, 0, 0, 0, 1, 1e-3f, 1, "", "good to ship if no feature is narrower than 0.001 of its slope"},
    {0.06f, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, "", "doubtful: worth little at 99 degrees: try a larger --max-bytes"},
    {0.06f, 0, 0.055f, 0, 0, 0, 0, 0, 0, 0, 1, "", "doubtful: worth little at 99 degrees, and no size mends it"},
    {0, 0.06f, 1, 0, 0, 0, 0, 0, 0, 0, 1, "", "doubtful: worth little at 9 degrees: try a larger --max-bytes"},
    {0, 0.06f, 0, 0.055f, 0, 0, 0, 0, 0, 0, 1, "", "doubtful: worth little at 9 degrees: try --moments 4"},
    {0, 0, 0, 0, 11, 0.06f, 0, 0, 0, 0, 1, "", "doubtful: weights up to 11, fireflies; Lambda and G1 off by 0.06"},
    {0, 0, 0, 0, 0, 0, 0.003f, 3.5f, 0, 0, 1, "", "doubtful: densities biased by 0.003; D off by 3.5 of itself"},
    {.hidden = 0.01f, 0, 1, "", "doubtful: 0.01 of D may be missing"},
    {.integral = 1.03, "residual_isotropy 0.049\np22_error_median 0.09\nleft_out 9\nslopes 991\n", "good to ship"},
    {.integral = 1.03, "residual_reflectance 0.099\ntilt 1e-3,0\nrms_slope 0.2\n", "good to ship"},
    {.integral = 1.7, "residual_isotropy 0\n", "doubtful: the integral of the measured D off by 0.7"},
    {.integral = 1, "residual_reflectance nan\n", "doubtful: nan of the light is not that of one D"},
    {.integral = 1, "residual_isotropy 0.06\n", "doubtful: no ellipse: 0.06 of the normals would have to turn"},
    {.integral = 1, "p22_error_median 0.3\n", "doubtful: P22 known within 0.3, measure more"},
    {.integral = 1, "left_out 20\nslopes 79\n", "doubtful: 0.2 of the pixels no normals"},
    {.integral = 1, "implausible scale: in mm?\nx 1\n", "doubtful: implausible scale: in mm?"},
    {.integral = 1,
     "rms_slope 0.2\nmatrix 2,0,0,0.5\ntilt 0.1,0\n",
     "good to ship with the matrix 2,0,0,0.5 and the mean slope 0.1,0"},
    {.integral = 1, "tilt 0.02,-0.1\nrms_slope 0.2\n", "good to ship with the mean slope 0.02,-0.1"},
};

int main(void)
{
    char worth[DESCRIBE_WORTH];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const vndf_certificate c = {cases[i].tv,          99,
                                    cases[i].tv_above,    9,
                                    cases[i].weight,      0,
                                    cases[i].area,        cases[i].consistency,
                                    cases[i].ndf,         cases[i].hidden,
                                    cases[i].finest,      -0.9f,
                                    cases[i].floor_above, cases[i].floor};
        const vndf_info info = {"", "", cases[i].notes, 1, 1, 1, 3, 1 / cases[i].integral, 1, c};
        TEST(describe_worth(&info, worth) == (cases[i].worth[0] == 'g'));
        if (!TEST(strcmp(worth, cases[i].worth) == 0))
            fprintf(stderr, "  %s\n  wanted: %s\n", worth, cases[i].worth);
    }
    const vndf_info largest = {"", "", "", 1, 1, 4095, 3, 1, 1, {.tv = 0.06f}};
    TEST(!describe_worth(&largest, worth) && TEST_HAS(worth, "no size mends it"));
    return test_done();
}
