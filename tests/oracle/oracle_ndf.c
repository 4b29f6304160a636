/* D and the projected areas of the distributions of oracle_bsdf.h. GGX: Walter et al. 2007, equation 33, stretched;
 * Lambda = (sqrt(1 + 1/a^2) - 1)/2, a = 1/(alpha tan). Beckmann: equation 25, Lambda = (erf(a) - 1)/2 +
 * exp(-a^2)/(2 a sqrt(pi)) (both from Heitz 2014). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/constants.h"
#include "oracle/oracle_bsdf.h"

int oracle_ndf_open(oracle_ndf *ndf, const char *name)
{
    char path[512];
    vndf_error error = {VNDF_OK, ""};
    memset(ndf, 0, sizeof *ndf);
    ndf->name = name;
    ndf->kind = strcmp(name, "ggx") == 0 ? ORACLE_NDF_GGX : ORACLE_NDF_BECKMANN;
    ndf->distribution = ndf->kind == ORACLE_NDF_GGX ? vndf_ggx() : vndf_beckmann();
    if (ndf->kind == ORACLE_NDF_GGX || strcmp(name, "beckmann") == 0)
        return 1;
    snprintf(path, sizeof path, "%s/tables/%s.vndf", VNDF_SOURCE_DIR, name);
    ndf->kind = ORACLE_NDF_TABLE;
    ndf->distribution = ndf->owned = vndf_load(path, &error);
    if (ndf->owned && oracle_table_read(&ndf->table, path))
        return 1;
    fprintf(stderr, "%s: %s\n", path, error.message);
    vndf_free(ndf->owned);
    return 0;
}

void oracle_ndf_close(oracle_ndf *ndf)
{
    if (ndf->kind != ORACLE_NDF_TABLE)
        return;
    vndf_free(ndf->owned);
    oracle_table_free(&ndf->table);
}

static oracle_query query_of(const double alpha[2], const double wi[3], const double wm[3])
{
    oracle_query q;
    memcpy(q.alpha, alpha, sizeof q.alpha);
    memcpy(q.wi, wi, sizeof q.wi);
    memcpy(q.wm, wm, sizeof q.wm);
    return q;
}

double oracle_ndf_density(const oracle_ndf *ndf, const double alpha[2], const double wm[3])
{
    double length2 = wm[0] * wm[0] + wm[1] * wm[1] + wm[2] * wm[2], cosine = wm[2] / sqrt(length2);
    double x = wm[0] / (alpha[0] * wm[2]), y = wm[1] / (alpha[1] * wm[2]), slope2 = x * x + y * y;
    double scale = PI * alpha[0] * alpha[1] * pow(cosine, 4);
    if (!(wm[2] > 0))
        return 0;
    if (ndf->kind == ORACLE_NDF_GGX)
        return 1 / (scale * (1 + slope2) * (1 + slope2));
    if (ndf->kind == ORACLE_NDF_BECKMANN)
        return exp(-slope2) / scale;
    double value[ORACLE_SIDES], up[3] = {0, 0, 1};
    oracle_query q = query_of(alpha, up, wm);
    return oracle_table_ndfs(&ndf->table, &q, value) ? value[0] : 0;
}

double oracle_ndf_area(const oracle_ndf *ndf, const double alpha[2], const double w[3])
{
    double length = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    double across = hypot(alpha[0] * w[0], alpha[1] * w[1]) / length, z = w[2] / length;
    if (ndf->kind == ORACLE_NDF_GGX)
        return (z + hypot(across, z)) / 2;
    if (ndf->kind == ORACLE_NDF_BECKMANN) {
        double a = z / across;
        return across > 0 ? z * (1 + erf(a)) / 2 + across * exp(-a * a) / (2 * sqrt(PI)) : fmax(z, 0);
    }
    double up[3] = {0, 0, 1};
    oracle_query q = query_of(alpha, w, up);
    return oracle_table_area(&ndf->table, &q);
}

double oracle_ndf_visible(const oracle_ndf *ndf, const double alpha[2], const double wi[3], const double wm[3])
{
    double value[ORACLE_SIDES];
    oracle_query q = query_of(alpha, wi, wm);
    if (ndf->kind == ORACLE_NDF_TABLE)
        return oracle_table_densities(&ndf->table, &q, value) ? value[0] : 0;
    double facing = wi[0] * wm[0] + wi[1] * wm[1] + wi[2] * wm[2];
    return fmax(facing, 0) * oracle_ndf_density(ndf, alpha, wm) / oracle_ndf_area(ndf, alpha, wi);
}

/* A table draws the slopes of visible normals straight from above, with an even azimuth in place of its own,
 * which is even too where it is towards wi: total0 of what the front and the wedge hold. */
double oracle_ndf_all(const oracle_ndf *ndf, const double alpha[2], const double wm[3])
{
    const oracle_table *t = &ndf->table;
    double length = sqrt(wm[0] * wm[0] + wm[1] * wm[1] + wm[2] * wm[2]), above[3] = {1e-30, 0, 1};
    double toward[3] = {fabs(wm[0]), wm[1], wm[2]};
    if (ndf->kind != ORACLE_NDF_TABLE)
        return oracle_ndf_density(ndf, alpha, wm) * wm[2] / length;
    double per_radian = t->total0 / (t->total0 * PI + 2 * oracle_wedge_mass(&t->above, 1));
    return oracle_ndf_visible(ndf, alpha, above, toward) / (2 * PI * per_radian);
}
