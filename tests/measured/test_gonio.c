/* A goniometer table of a known surface gives its D back, with F0 from its scale or with another scale; columns may
 * stand in any order; and what is no such table is refused with the line. */
#include "harness/constants.h"
#include "harness/test.h"

#include "measured/brdf/gonio.h"
#include "measured/model.h"

static char text[1 << 18];

/* Scans at four angles of incidence, every `step` degrees; scaled. */
static size_t make_scans(const vndf_surface *surface, double f0, double step, double scale, int is_intensity)
{
    static const double incident[4] = {5, 20, 40, 60};
    size_t used = (size_t)sprintf(text, "\xEF\xBB\xBF# scans\r\n\n %s ,theta_o, theta_i\r\n",
                                  is_intensity ? "intensity" : "brdf");
    for (int i = 0; i < 4; i++)
        for (double o = -88; o <= 88; o += step) {
            double theta_i = incident[i] * PI / 180, theta_o = o * PI / 180;
            direction wi = direction_at(theta_i, 0), wo = direction_at(theta_o, PI);
            double rise = model_schlick(direction_dot(wi, direction_between(wi, wo)));
            double f_cos = model_reflected(surface, wi, wo) * (f0 + (1 - f0) * rise) * scale;
            used += (size_t)sprintf(text + used, "%.9g,%g,%g%s\n", is_intensity ? f_cos : f_cos / wo.z, o,
                                    incident[i], i % 2 ? "\r" : "");
        }
    return used;
}

static double number_after(const char *from, const char *key)
{
    const char *at = strstr(from, key);
    return at ? strtod(at + strlen(key), NULL) : NAN;
}

/* The largest difference of D from that of the surface up to 40 degrees, relative, D normalised. */
static double read_back(const vndf_surface *surface, size_t size, double f0, notes *said)
{
    gonio_points points;
    profile rows;
    refusal why = {""};
    double worst = 0;
    *said = (notes){"", 0};
    if (!TEST(gonio_read(&points, "made", text, size, &why)) ||
        !TEST(gonio_law(&points, f0, "made", &rows, said, &why))) {
        fprintf(stderr, "  %s\n", why.message);
        exit(1);
    }
    vndf_distribution *table = profile_table(&rows, "made", &why);
    const vndf_surface found = {table, 1, 1};
    for (double theta = 0.02; theta < 40 * PI / 180; theta += 0.01)
        worst = fmax(worst, fabs(model_ndf(&found, theta) / model_ndf(surface, theta) - 1));
    printf("D off by %.4f; %s", worst, said->text);
    vndf_free(table);
    profile_free(&rows);
    gonio_free(&points);
    return worst;
}

static void test_scans(void)
{
    notes said;
    const vndf_surface rough = {vndf_ggx(), 0.4f, 0.4f}, smooth = {vndf_beckmann(), 0.2f, 0.2f};
    TEST(read_back(&rough, make_scans(&rough, 0.6, 1, 1, 0), -1, &said) < 0.01);
    TEST_RELATIVE(number_after(said.text, "\nf0 "), 0.6, 0.01);
    TEST(number_after(said.text, "residual_reflectance ") < 0.003);
    TEST(read_back(&smooth, make_scans(&smooth, 0.04, 0.5, 1, 1), -1, &said) < 0.01);
    TEST_RELATIVE(number_after(said.text, "\nf0 "), 0.04, 0.01);
    if (test_quick())
        return;
    TEST(read_back(&rough, make_scans(&rough, 0.6, 1, 1000, 0), 0.6, &said) < 0.01); /* F0 given, another scale */
    TEST_RELATIVE(number_after(said.text, "\nf0 "), 0.6, 1e-9);
    TEST(read_back(&rough, make_scans(&rough, 1, 1, 1000, 0), -1, &said) < 0.01);
    TEST_RELATIVE(number_after(said.text, "\nuncalibrated, f0 times a scale is "), 1000.0, 0.01);
}

/* ---- refusals ------------------------------------------------------------------------------------ */

static void refused(const char *csv, const char *message)
{
    gonio_points points;
    profile rows = {VNDF_ROWS_OVER_SLOPE, VNDF_ROWS_OF_P22, NULL, NULL, 0, NULL};
    refusal why = {""};
    notes said = {"", 0};
    int good = gonio_read(&points, "bad.csv", csv, strlen(csv), &why) &&
               gonio_law(&points, -1, "bad.csv", &rows, &said, &why);
    if (!(TEST(!good) & TEST(rows.x == NULL) & TEST_HAS(why.message, "bad.csv: ") &
          TEST_HAS(why.message, message)))
        fprintf(stderr, "  %s\n", why.message);
    gonio_free(&points);
}

static void test_refusals(void)
{
    refused("", "no header line; theta_i,theta_o,brdf is needed");
    refused("# none\n\n", "no header line");
    refused("theta_i,theta_o\n", "line 1: too few numbers or names; 3 are needed");
    refused("theta_i,theta_o,brdf,x\n", "line 1: too many");
    refused("\ntheta_i,theta_m,brdf\n", "line 2: a column is called 'theta_m'");
    refused("theta_i,theta_i,brdf\n", "line 1: a column is named twice");
    refused("theta_i,brdf,intensity\n", "line 1: a column is named twice");
    refused("theta_i,theta_o,brdf\n1,2\n", "line 2: too few");
    refused("theta_i,theta_o,brdf\n1,2,x3\n", "line 2: brdf is 'x3', which is no number");
    refused("theta_i,theta_o,brdf\n1,nan,3\n", "line 2: theta_o is 'nan', which is no number");
    refused("theta_i,theta_o,brdf\n#\n-1,2,3\n", "line 3: theta_i is -1; it must be from 0 to 90");
    refused("theta_i,theta_o,brdf\n1,91,3\n", "line 2: theta_o is 91; it must be from -90 to 90");
    refused("theta_i,theta_o,brdf\n1,2,1e31\n", "line 2: the value is too large");
    refused("theta_i,theta_o,brdf\n10,10,1\n10,12,1\n10,14,0.5\n10,16,-1\n",
            "3 half vectors with light; 4 are needed");
    char line[700] = "theta_i,theta_o,brdf\n1,2,3";
    memset(line + 26, ' ', 600);
    refused(line, "line 2: more than 512 characters");
}

int main(void)
{
    test_scans();
    test_refusals();
    return test_done();
}
