/* Each azimuth row may miss by `error`. All radial cells together may miss by half of it: they cost less than rows,
 * and a view from below the horizon sees several cells that are judged one at a time. Areas may miss by a sixtieth,
 * which costs a spline of fifth order few knots. Floats hold no area better than AREA_FINEST. A table of half the
 * default size or more keeps the promise for areas, 2e-6, whatever its error is.
 *
 * A smaller table than the default cannot serve the whole sphere well, and most views are above the horizon. So an
 * error below the horizon counts less: a 23rd at 2 KiB, an 8th at 4 KiB; and less where less is seen, a tenth of that
 * at 2 KiB where 1e-10 of the area is left. Rows above the horizon then miss by half of `error`, and all radial cells
 * together by all of it, since few of them are for views from below: no other split that was tried did better. Where no
 * promise for areas is kept, areas miss by a tenth of `error`, those below the horizon by half. */
#include "fit/budget.h"

#include <math.h>

enum { EVEN_BYTES = 16384, PROMISE_BYTES = 8192, SMALL_BYTES = 6000 };
static const double AREA_FINEST = 2e-7, AREA_PROMISED = 9e-7;

/* For the whole sphere. In a small table errors deep below the horizon count less, a third where 1e-10 of the area is
 * left. */
static vndf_budget budget_for_sphere(size_t max_bytes)
{
    vndf_budget budget = {
        .rows = 1, .radial = 2, .areas = 60, .areas_finest = AREA_FINEST, .below = 1, .below_areas = 1};
    double times = EVEN_BYTES / (double)max_bytes;
    budget.finest = fmax(1e-7, 2e-5 * (times > 1 ? times : pow(times, 2)));
    budget.promised = max_bytes < PROMISE_BYTES ? 1.0 : AREA_PROMISED;
    budget.row_cells = max_bytes < SMALL_BYTES ? 12 : 32;
    budget.fade = max_bytes < SMALL_BYTES ? 0.05 : 0.0;
    budget.even_rows = max_bytes < EVEN_BYTES;
    return budget;
}

vndf_budget vndf_budget_for(size_t max_bytes, int sphere)
{
    vndf_budget budget = budget_for_sphere(max_bytes);
    double part = (double)max_bytes / EVEN_BYTES;
    if (sphere || part >= 1)
        return budget;
    budget.rows = 2;
    budget.radial = 1;
    budget.below = pow(part, 1.5);
    budget.fade = log2(1 / part) / 30;
    if (max_bytes < PROMISE_BYTES) {
        budget.areas = 10;
        budget.below_areas = 0.2;
    }
    return budget;
}

double vndf_budget_areas(const vndf_budget *budget, double error)
{
    return fmin(fmax(error / budget->areas, budget->areas_finest), budget->promised);
}
