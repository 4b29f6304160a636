/* A goniometer table of a known surface gives its D back, with F0 from its scale or with another scale; columns may
 * stand in any order; what is no such table, or has its angles in radians, is refused. Noticed: theta_o counted towards
 * the wrong side, masking or F left out. */
#include "measured/measured_case.h"

#include "measured/brdf.h"
#include "measured/model.h"

/* Scans at four angles of incidence, every `step` degrees; scaled; angles times `unit`. */
static data_file make_scans(const vndf_surface *surface, double f0, double step, double scale, int is_intensity,
                            double unit)
{
    static const double incident[4] = {5, 20, 40, 60};
    static char text[1 << 18];
    size_t used = (size_t)sprintf(text, "\xEF\xBB\xBF# scans\r\n\n %s ,theta_o, theta_i\r\n",
                                  is_intensity ? "intensity" : "brdf");
    for (int i = 0; i < 4; i++)
        for (double o = -88; o <= 88; o += step) {
            double theta_i = incident[i] * PI / 180, theta_o = o * PI / 180, half = (theta_o - theta_i) / 2;
            double area_i = model_area(surface, theta_i), area_o = model_area(surface, fabs(theta_o));
            double rise = model_schlick(cos((theta_i + theta_o) / 2));
            double f_cos = model_ndf(surface, fabs(half)) / (4 * area_i) *
                           model_masked(area_i, cos(theta_i), area_o, cos(theta_o)) * (f0 + (1 - f0) * rise) *
                           scale;
            used += (size_t)sprintf(text + used, "%.9g,%g,%g%s\n", is_intensity ? f_cos : f_cos / cos(theta_o),
                                    o * unit, incident[i] * unit, i % 2 ? "\r" : "");
        }
    return case_file(text, used);
}

/* The largest difference of D from that of the surface up to 40 degrees, relative, D normalised. */
static double read_back(const vndf_surface *surface, data_file *file, double f0)
{
    profile rows;
    double worst = 0;
    law *found = malloc(sizeof *found);
    if (!case_read(gonio_read(file, f0, &rows), file))
        exit(1);
    vndf_source *source = profile_source(&rows, file);
    law_of_source(found, source);
    for (double theta = 0.02; theta < 40 * PI / 180; theta += 0.01)
        worst = fmax(worst, fabs(law_ndf(found, theta) / model_ndf(surface, theta) - 1));
    printf("D off by %.4f; %s", worst, file->notes);
    vndf_source_free(source);
    free(found);
    profile_free(&rows);
    case_free(file);
    return worst;
}

static void test_scans(void)
{
    const vndf_surface rough = {vndf_ggx(), 0.4f, 0.4f}, smooth = {vndf_beckmann(), 0.2f, 0.2f};
    data_file file = make_scans(&rough, 0.6, 1, 1, 0, 1);
    TEST(read_back(&rough, &file, -1) < 0.01);
    TEST_RELATIVE(case_number(&file, "\nf0 "), 0.6, 0.01);
    TEST(case_number(&file, "residual_reflectance ") < 0.003);
    file = make_scans(&smooth, 0.04, 0.5, 1, 1, 1);
    TEST(read_back(&smooth, &file, -1) < 0.01);
    TEST_RELATIVE(case_number(&file, "\nf0 "), 0.04, 0.01);
    file = make_scans(&rough, 0.6, 1, 1000, 0, 1); /* F0 given, another scale */
    TEST(read_back(&rough, &file, 0.6) < 0.01);
    TEST_RELATIVE(case_number(&file, "\nf0 "), 0.6, 1e-9);
    file = make_scans(&rough, 1, 1, 1000, 0, 1);
    TEST(read_back(&rough, &file, -1) < 0.01);
    TEST_RELATIVE(case_number(&file, "\nuncalibrated, f0 times a scale is "), 1000.0, 0.01);
}

static void test_refusals(void)
{
    static const char *const cases[][2] = {
        {"", "no header line; theta_i,theta_o,brdf is needed"},
        {"# none\n\n", "no header line"},
        {"theta_i,theta_o\n", "line 1: too few numbers or names; 3 are needed"},
        {"theta_i,theta_o,brdf,x\n", "line 1: too many"},
        {"\ntheta_i,theta_m,brdf\n", "line 2: a column is called 'theta_m'"},
        {"theta_i,theta_i,brdf\n", "line 1: a column is named twice"},
        {"theta_i,brdf,intensity\n", "line 1: a column is named twice"},
        {"theta_i,theta_o,brdf\n1,2\n", "line 2: too few"},
        {"theta_i,theta_o,brdf\n1,2,x3\n", "line 2: brdf is 'x3', which is no number"},
        {"theta_i,theta_o,brdf\n1,nan,3\n", "line 2: theta_o is 'nan', which is no number"},
        {"theta_i,theta_o,brdf\n#\n-1,2,3\n", "line 3: theta_i is -1; it must be from 0 to 90"},
        {"theta_i,theta_o,brdf\n1,91,3\n", "line 2: theta_o is 91; it must be from -90 to 90"},
        {"theta_i,theta_o,brdf\n1,2,1e31\n", "line 2: the value is too large"},
        {"theta_i,theta_o,brdf\n10,10,1\n10,12,1\n10,14,0.5\n10,16,-1\n",
         "3 half vectors with light; 4 are needed"},
    };
    const vndf_surface rough = {vndf_ggx(), 0.4f, 0.4f};
    profile rows;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        data_file file = case_file(cases[i][0], strlen(cases[i][0]));
        case_refused(gonio_read(&file, -1, &rows), &file, cases[i][1]);
        TEST(rows.x == NULL);
    }
    data_file radians = make_scans(&rough, 0.6, 1, 1, 0, PI / 180);
    case_refused(gonio_read(&radians, -1, &rows), &radians, "no angle is above 1.54 degrees: are these radians?");
}

int main(void)
{
    test_scans();
    test_refusals();
    return test_done();
}
