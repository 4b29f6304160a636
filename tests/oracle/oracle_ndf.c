/* D and the projected areas of the distributions of oracle_bsdf.h, which are those of oracle_surface.h. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "oracle/oracle_bsdf.h"

int oracle_ndf_open(oracle_ndf *ndf, const char *name)
{
    memset(ndf, 0, sizeof *ndf);
    ndf->name = name;
    ndf->kind = strcmp(name, "ggx") == 0 ? ORACLE_KIND_GGX : ORACLE_KIND_BECKMANN;
    ndf->distribution = ndf->kind == ORACLE_KIND_GGX ? vndf_ggx() : vndf_beckmann();
    if (ndf->kind == ORACLE_KIND_GGX || strcmp(name, "beckmann") == 0)
        return 1;
    ndf->kind = ORACLE_KIND_TABLE;
    ndf->distribution = ndf->owned = oracle_shipped(name);
    if (ndf->owned && oracle_table_of(&ndf->table, ndf->owned))
        return 1;
    vndf_free(ndf->owned);
    return 0;
}

void oracle_ndf_close(oracle_ndf *ndf)
{
    if (ndf->kind != ORACLE_KIND_TABLE)
        return;
    vndf_free(ndf->owned);
    oracle_table_free(&ndf->table);
}

static oracle_surface surface_of(const oracle_ndf *ndf, const double alpha[2])
{
    const oracle_slopes of = {ndf->kind, &ndf->table, NULL};
    const vndf_affine none = {NULL, 1, 0, 0, 1, 0, 0};
    oracle_surface surface = oracle_surface_from(of, &none);
    surface.xx *= alpha[0];
    surface.yy *= alpha[1];
    return surface;
}

double oracle_ndf_density(const oracle_ndf *ndf, const double alpha[2], const double wm[3])
{
    oracle_surface surface = surface_of(ndf, alpha);
    return oracle_surface_ndf(&surface, wm);
}

double oracle_ndf_area(const oracle_ndf *ndf, const double alpha[2], const double w[3])
{
    oracle_surface surface = surface_of(ndf, alpha);
    return oracle_surface_area(&surface, w);
}

double oracle_ndf_visible(const oracle_ndf *ndf, const double alpha[2], const double wi[3], const double wm[3])
{
    oracle_surface surface = surface_of(ndf, alpha);
    return oracle_surface_drawn(&surface, wi, wm);
}

/* All normals are drawn with D itself. */
double oracle_ndf_all(const oracle_ndf *ndf, const double alpha[2], const double wm[3])
{
    return oracle_ndf_density(ndf, alpha, wm) * wm[2];
}
