#include "export/exported_bins.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli/subject.h"
#include "measure/pearson.h"

const exported_view exported_views[EXPORTED_VIEWS] = {{1, 1, 0, 0},          {0.05f, 0.4f, 30, 55},
                                                      {0.05f, 0.4f, 60, 0},  {0.3f, 0.3f, 80, 20},
                                                      {0.05f, 0.4f, 89, 55}, {0.4f, 1, 130, 55}};

vndf_vec3 exported_view_direction(const exported_view *view)
{
    return direction_from(view->theta, view->phi);
}

int exported_bins_begin(exported_bins *bins, const vndf_distribution *distribution, const exported_view *view)
{
    vndf_surface surface = {distribution, view->alpha_x, view->alpha_y};
    vndf_vec3 wi = exported_view_direction(view);
    *bins = (exported_bins){.probability = calloc(2 * BINS_COUNT, sizeof(double))};
    if (!bins->probability)
        return 0;
    bins->observed = bins->probability + BINS_COUNT;
    bins->map = bins_for(&surface, wi, 20260731);
    bins_integrate(&bins->map, &surface, wi, bins->probability);
    return 1;
}

void exported_bins_add(exported_bins *bins, const float (*drawn)[4], size_t count)
{
    for (size_t i = 0; i < count; i++) {
        vndf_vec3 wm = {drawn[i][0], drawn[i][1], drawn[i][2]};
        if (!(drawn[i][3] > 0 && drawn[i][3] <= 3.4e38f) || !isfinite(wm.x + wm.y + wm.z))
            bins->unclaimed++;
        else
            bins->observed[bins_place(&bins->map, wm)] += 1;
    }
    bins->samples += count;
}

double exported_bins_end(exported_bins *bins, const char *name, const exported_view *view)
{
    for (size_t i = 0; i < BINS_COUNT; i++)
        bins->probability[i] *= (double)bins->samples;
    pearson found = pearson_of(bins->probability, bins->observed, NULL, BINS_COUNT, 5);
    double p = bins->unclaimed || bins->samples == 0 ? 0 : found.p;
    printf("%-24s alpha %g %g, theta %g, phi %g: %zu samples, %zu without density, %zu classes, p %.3g\n", name,
           (double)view->alpha_x, (double)view->alpha_y, view->theta, view->phi, bins->samples, bins->unclaimed,
           found.classes, p);
    free(bins->probability);
    return p;
}
