#include "bsdf/terms/fresnel.h"

static double schlick(double cosine, double f0)
{
    double rest = cosine < 1.0 ? 1.0 - cosine : 0.0, square = rest * rest;
    return f0 + (1.0 - f0) * (square * square * rest);
}

/* (n + ik)^2 - sin^2 = (a + ib)^2, hence a^2 - b^2 = t = n^2 - k^2 - sin^2 and a b = n k (Born & Wolf,
 * "Principles of Optics", 14.2). The smaller of a^2 and b^2 comes from the larger, and a - c from a^2 - c^2 = n^2
 * - k^2 - 1 + b^2, which is `apart`. Both polarisations share a division:
 *
 *     s = ((a - c)^2 + b^2)/((a + c)^2 + b^2),    p = s ((a c - sin^2)^2 + b^2 c^2)/((a c + sin^2)^2 + b^2 c^2). */
static double conductor(double cosine, double n, double k)
{
    double c = cosine < 1.0 ? cosine : 1.0, c2 = c * c, s2 = 1.0 - c2, nk = n * k;
    double t = (n * n - k * k) - s2, larger = 0.5 * (sqrt(t * t + 4.0 * nk * nk) + fabs(t));
    double smaller = larger > 0.0 ? nk * nk / larger : 0.0;
    double a2 = t > 0.0 ? larger : smaller, b2 = t > 0.0 ? smaller : larger, a = sqrt(a2), sum = a + c;
    double apart = (n - 1.0) * (n + 1.0) - k * k + b2, less = a * c - s2, more = a * c + s2;
    double square = sum * sum, over = less * less + b2 * c2, under = more * more + b2 * c2;
    double below = square * (square + b2) * under;
    double mean = 0.5 * (apart * apart + b2 * square) * (under + over) / below;
    return below > 0.0 && mean < 1.0 ? mean : 1.0; /* at right angles to the normal it is 0/0 */
}

static void set_all(double f[VNDF_WAVELENGTHS], double value)
{
    for (int i = 0; i < VNDF_WAVELENGTHS; i++) /* all, so that the count is a constant */
        f[i] = value;
}

static void reflect_schlick(const vndf_description *is, double cosine, double eta, double f[VNDF_WAVELENGTHS])
{
    (void)eta;
    for (int i = 0; i < is->wavelengths; i++)
        f[i] = schlick(cosine, is->f0[i]);
}

/* The cosine in the thinner medium: reflection is total where that has none. */
static void reflect_schlick_thin(const vndf_description *is, double cosine, double eta, double f[VNDF_WAVELENGTHS])
{
    double square = eta < 1.0 ? vndf_refracted_square(cosine, eta) : cosine * cosine;
    for (int i = 0; i < is->wavelengths; i++)
        f[i] = square > 0.0 ? schlick(sqrt(square), is->f0[i]) : 1.0;
}

static void reflect_dielectric(const vndf_description *is, double cosine, double eta, double f[VNDF_WAVELENGTHS])
{
    (void)is;
    set_all(f, vndf_dielectric(cosine, eta));
}

/* From outside alone. */
static void reflect_conductor(const vndf_description *is, double cosine, double eta, double f[VNDF_WAVELENGTHS])
{
    (void)eta;
    for (int i = 0; i < is->wavelengths; i++)
        f[i] = conductor(cosine, is->conductor_eta[i], is->conductor_k[i]);
}

static void reflect_all(const vndf_description *is, double cosine, double eta, double f[VNDF_WAVELENGTHS])
{
    (void)is;
    (void)cosine;
    (void)eta;
    set_all(f, 1.0);
}

static void reflect_nothing(const vndf_description *is, double cosine, double eta, double f[VNDF_WAVELENGTHS])
{
    (void)is;
    set_all(f, vndf_refracted_square(cosine, eta) > 0.0 ? 0.0 : 1.0);
}

const vndf_fresnel_routine vndf_fresnel_of_schlick = {reflect_schlick};
const vndf_fresnel_routine vndf_fresnel_of_schlick_thin = {reflect_schlick_thin};
const vndf_fresnel_routine vndf_fresnel_of_dielectric = {reflect_dielectric};
const vndf_fresnel_routine vndf_fresnel_of_conductor = {reflect_conductor};
const vndf_fresnel_routine vndf_fresnel_of_total = {reflect_all};
const vndf_fresnel_routine vndf_fresnel_of_nothing = {reflect_nothing};

/* ---- public ---- */

static double cosine_of(float cosine)
{
    double c = fabs((double)cosine);
    return c < 1.0 ? c : 1.0;
}

float vndf_fresnel_dielectric(float cosine, float eta)
{
    return eta > 0.0f ? (float)vndf_dielectric(cosine_of(cosine), eta) : 1.0f;
}

float vndf_fresnel_conductor(float cosine, float eta, float k)
{
    return (float)conductor(cosine_of(cosine), eta, k);
}

float vndf_fresnel_schlick(float cosine, float f0)
{
    return (float)schlick(cosine_of(cosine), f0);
}
