#include "measured/brdf.h"

#include <math.h>
#include <string.h>

vec3 direction_at(double theta, double phi)
{
    return vec(sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta));
}

vec3 direction_mirrored(vec3 w, vec3 m)
{
    return along(scale(w, -1), 2 * dot(w, m), m);
}

double model_masked(double area_i, double cos_i, double area_o, double cos_o)
{
    return cos_o > 0 ? area_i * cos_o / (area_i * cos_o + area_o * cos_i - cos_i * cos_o) : 0;
}

double model_schlick(double cosine)
{
    const double away = 1 - cosine, square = away * away;
    return square * square * away;
}

double model_ndf(const vndf_surface *surface, double theta)
{
    return (double)vndf_ndf(surface, (vndf_vec3){(float)sin(theta), 0.0f, (float)fmax(cos(theta), 0)});
}

double model_area(const vndf_surface *surface, double theta)
{
    return (double)vndf_projected_area(surface, (vndf_vec3){(float)sin(theta), 0.0f, (float)cos(theta)});
}

/* ---- D that was measured ------------------------------------------------------------------------- */

/* The integral over phi of |a + b cos(phi)|, b >= 0. */
static double around(double a, double b)
{
    return fabs(a) >= b ? 2 * PI * fabs(a) : 4 * (a * asin(a / b) + sqrt(b * b - a * a));
}

void law_even(law *made, int count)
{
    memset(made, 0, sizeof *made);
    made->count = count;
    for (int i = 0; i < count; i++) {
        double at = (i + 0.5) / count, from = (double)i / count, to = (i + 1.0) / count, bin = PI / 2 * at * at;
        made->theta[i] = bin;
        made->share[i] = cos(PI / 2 * from * from) - cos(PI / 2 * to * to);
        for (int k = 0; k < LAW_AREAS; k++) {
            double theta = PI / 2 * k / (LAW_AREAS - 1);
            made->both_sides[k][i] = made->share[i] * around(cos(theta) * cos(bin), sin(theta) * sin(bin));
        }
    }
}

double law_normalise(law *l)
{
    double whole = 0;
    for (int i = 0; i < l->count; i++)
        whole += 2 * PI * l->share[i] * cos(l->theta[i]) * l->ndf[i];
    for (int i = 0; i < l->count && whole > 0; i++)
        l->ndf[i] /= whole;
    for (int k = 0; k < LAW_AREAS; k++) {
        double both = 0;
        for (int i = 0; i < l->count; i++)
            both += l->both_sides[k][i] * l->ndf[i];
        l->area[k] = (both + cos(PI / 2 * k / (LAW_AREAS - 1))) / 2;
    }
    return whole;
}

double law_of_source(law *made, const vndf_source *source)
{
    law_even(made, LAW_ANGLES);
    for (int i = 0; i < made->count; i++)
        made->ndf[i] = vndf_source_p22(source, tan(made->theta[i])) / pow(cos(made->theta[i]), 4);
    return law_normalise(made);
}

double law_ndf(const law *of, double theta)
{
    double place = fmin(fmax(sqrt(theta / (PI / 2)) * of->count - 0.5, 0), of->count - 1);
    int at = place < of->count - 2 ? (int)place : of->count - 2;
    double low = of->ndf[at], high = of->ndf[at + 1], part = place - at;
    return low > 0 && high > 0 ? exp((1 - part) * log(low) + part * log(high)) : (1 - part) * low + part * high;
}

double law_area(const law *of, double theta)
{
    double place = fmin(theta / (PI / 2), 1) * (LAW_AREAS - 1);
    int at = place < LAW_AREAS - 2 ? (int)place : LAW_AREAS - 2;
    return of->area[at] + (place - at) * (of->area[at + 1] - of->area[at]);
}

/* ---- F that was measured ------------------------------------------------------------------------- */

int model_reflectance(const probe *probes, size_t count, reflectance *found)
{
    double aa = 0, ab = 0, bb = 0, fa = 0, fb = 0, off = 0, whole = 0;
    for (size_t i = 0; i < count; i++) {
        const probe *p = &probes[i];
        aa += p->weight * p->low * p->low;
        ab += p->weight * p->low * p->high;
        bb += p->weight * p->high * p->high;
        fa += p->weight * p->found * p->low;
        fb += p->weight * p->found * p->high;
    }
    double det = aa * bb - ab * ab;
    *found = (reflectance){(fa * bb - fb * ab) / det, (fb * aa - fa * ab) / det, 0};
    for (size_t i = 0; i < count; i++) {
        const probe *p = &probes[i];
        off += p->light * fabs(p->found - found->f0 * p->low - found->f90 * p->high) / 2;
        whole += p->light * p->found;
    }
    found->residual = off / whole;
    return det > 0 && whole > 0 && isfinite(found->residual) && isfinite(found->f0) && isfinite(found->f90);
}
