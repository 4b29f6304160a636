/* A program of somebody else, in C and in C++17: at normal incidence and alpha = 1 the visible normals of GGX have the
 * density wm.z/pi; P22 of the formula exp(-r) at r = 0 is 1; a shipped table is in the folder of the argument. */
#include <math.h>
#include <stdio.h>

#ifdef __cplusplus
#  include <vndf.hpp>
#else
#  include <vndf.h>
#  include <vndf_bsdf.h>
#  include <vndf_build.h>
#endif

int main(int argc, char **argv)
{
    const vndf_surface surface = vndf_rough(vndf_ggx(), 1.0f, 1.0f);
    const vndf_vec3 up = {0.0f, 0.0f, 1.0f};
    const vndf_view view = vndf_view_from(&surface, up);
    float pdf = 0.0f;
    const vndf_vec3 wm = vndf_sample(&view, 0.25f, 0.5f, &pdf);
    vndf_source *source = vndf_source_slope_expression("exp(-r)", NULL, 0, NULL);
    const double p22 = vndf_source_p22(source, 0.0);
    char path[1024];
    snprintf(path, sizeof path, "%s/student-t-2.5.vndf", argc > 1 ? argv[1] : "");
    vndf_distribution *table = vndf_load(path, NULL);
    const int isRight =
        table && fabs((double)pdf - (double)wm.z / 3.14159265358979) < 1e-6 && fabs(p22 - 1) < 1e-6;
    vndf_source_free(source);
    vndf_free(table);
    printf("vndf %s: %.6f %.6f %.6f pdf %.6f\n", vndf_version(), (double)wm.x, (double)wm.y, (double)wm.z,
           (double)pdf);
    return !isRight;
}
