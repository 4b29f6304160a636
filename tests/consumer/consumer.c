/* A program of somebody else in C. At normal incidence and alpha = 1 the visible normals of GGX have the
 * density wm.z/pi; P22 of the formula exp(-r) at r = 0 is 1; a shipped table is in the folder of the
 * argument. */
#include <stdio.h>

#include <vndf.h>
#include <vndf_build.h>

int main(int argc, char **argv)
{
    const vndf_surface surface = {vndf_ggx(), 1.0f, 1.0f};
    const vndf_vec3 up = {0.0f, 0.0f, 1.0f};
    const vndf_view view = vndf_view_from(&surface, up);
    float pdf = 0.0f;
    const vndf_vec3 wm = vndf_sample(&view, 0.25f, 0.5f, &pdf);
    const double difference = (double)pdf - (double)wm.z / 3.14159265358979;
    vndf_source *source = vndf_source_slope_expression("exp(-r)", NULL, 0, NULL);
    const double p22 = source ? vndf_source_p22(source, 0.0) : 0.0;
    char path[1024];
    snprintf(path, sizeof path, "%s/student-t-2.5.vndf", argc > 1 ? argv[1] : "");
    vndf_distribution *table = vndf_load(path, NULL);
    const int found = table != NULL;

    vndf_source_free(source);
    vndf_free(table);
    printf("vndf %s: %.6f %.6f %.6f pdf %.6f\n", VNDF_VERSION, (double)wm.x, (double)wm.y, (double)wm.z,
           (double)pdf);
    return !(found && difference > -1e-6 && difference < 1e-6 && p22 > 0.999999 && p22 < 1.000001);
}
