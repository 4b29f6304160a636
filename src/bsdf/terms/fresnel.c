#include "bsdf/terms/fresnel.h"

static void set_all(double f[VNDF_WAVELENGTHS], double value)
{
    for (int i = 0; i < VNDF_WAVELENGTHS; i++) /* all: no count is waited for */
        f[i] = value;
}

static void reflect_schlick(const vndf_description *is, double cosine, double eta, double f[VNDF_WAVELENGTHS])
{
    (void)eta;
    for (int i = 0; i < is->wavelengths; i++)
        f[i] = vndf_schlick(cosine, is->f0[i]);
}

/* The cosine in the thinner medium: reflection is total where that has none. */
static void reflect_schlick_thin(const vndf_description *is, double cosine, double eta, double f[VNDF_WAVELENGTHS])
{
    double square = eta < 1.0 ? vndf_refracted_square(cosine, eta) : cosine * cosine;
    for (int i = 0; i < is->wavelengths; i++)
        f[i] = square > 0.0 ? vndf_schlick(sqrt(square), is->f0[i]) : 1.0;
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
        f[i] = vndf_conductor(cosine, is->conductor_eta[i], is->conductor_k[i]);
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
    return (float)vndf_conductor(cosine_of(cosine), eta, k);
}

float vndf_fresnel_schlick(float cosine, float f0)
{
    return (float)vndf_schlick(cosine_of(cosine), f0);
}
