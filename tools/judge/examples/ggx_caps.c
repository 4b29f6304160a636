/* Visible normals of GGX by spherical caps (Dupuy & Benyoub 2023), for `vndf judge './ggx_caps ALPHA_X ALPHA_Y'`. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static double ax = 0.3, ay = 0.3;

/* D(wm) max(0, wi.wm)/A(wi), A = (cos(theta) + |(ax wi.x, ay wi.y, wi.z)|)/2. */
static double pdf(const double wi[3], const double wm[3])
{
    double facing = wi[0] * wm[0] + wi[1] * wm[1] + wi[2] * wm[2], x = wm[0] / ax, y = wm[1] / ay;
    double q = x * x + y * y + wm[2] * wm[2], d = 1 / (acos(-1) * ax * ay * q * q);
    double area = (wi[2] + sqrt(ax * wi[0] * ax * wi[0] + ay * wi[1] * ay * wi[1] + wi[2] * wi[2])) / 2;
    return facing > 0 && wm[2] > 0 ? d * facing / area : 0;
}

/* wi is stretched to the hemisphere; the normal is half way between it and a point of its cap. */
static void sample(const double wi[3], const double u[3], double wm[3])
{
    double x = ax * wi[0], y = ay * wi[1], length = sqrt(x * x + y * y + wi[2] * wi[2]);
    double phi = 2 * acos(-1) * u[0], z = 1 - u[1] * (1 + wi[2] / length), s = sqrt(fmax(0, 1 - z * z));
    double m[3] = {ax * (s * cos(phi) + x / length), ay * (s * sin(phi) + y / length), z + wi[2] / length};
    double norm = sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
    for (int i = 0; i < 3; i++)
        wm[i] = m[i] / norm;
}

int main(int argc, char **argv)
{
    char kind;
    double wi[3], x[3], wm[3];
    ax = argc > 1 ? atof(argv[1]) : ax;
    ay = argc > 2 ? atof(argv[2]) : ax;
    while (scanf(" %c %lf %lf %lf %lf %lf %lf", &kind, wi, wi + 1, wi + 2, x, x + 1, x + 2) == 7) {
        if (kind == 's') {
            sample(wi, x, wm);
            printf("%.9g %.9g %.9g %.9g\n", wm[0], wm[1], wm[2], pdf(wi, wm));
        } else
            printf("%.9g\n", pdf(wi, x));
    }
    return 0;
}
