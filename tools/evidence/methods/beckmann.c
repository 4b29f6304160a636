/* Visible normals of Beckmann as renderers draw them: W. Jakob, "An Improved Visible Normal Sampling Routine for
 * the Beckmann Distribution", 2014. In the unit problem the slope along wi has the CDF
 *
 *     C(x) = (1 + b + tan(theta) exp(-x^2)/sqrt(pi)) / (1 + c + tan(theta) exp(-cot^2)/sqrt(pi)),
 *     b = erf(x), c = erf(cot(theta)), x <= cot(theta),
 *
 * Newton steps in a bracket solve it for b in (-1, c), from the report's fit; the slope across is the quantile
 * of the normal law. The inverse of erf is by M. Giles, "Approximating the erfinv Function", GPU Computing Gems,
 * 2012. The density takes erf and exp of the C library. It serves incident directions above the horizon only.
 *
 * Departure: the steps stop at 1e-6 in u1 (renderers: 1e-5) or after ten. */
#include "evidence/methods/vector.h"

static const float per_root_pi = 0.56418958f;

typedef struct beckmann_view {
    vndf_vec3 wi;
    method_turn turn;
    float alpha, tangent, edge; /* edge: erf(cot) */
    float start;                /* exponent of the fit */
    float per_total, per_area;
} beckmann_view;

static inline float ladder(const float *coefficient, int count, float w)
{
    float sum = coefficient[0];
    for (int i = 1; i < count; i++)
        sum = sum * w + coefficient[i];
    return sum;
}

static inline float erf_inverse(float x)
{
    static const float middle[] = {2.81022636e-08f,  3.43273939e-07f, -3.5233877e-06f,
                                   -4.39150654e-06f, 0.00021858087f,  -0.00125372503f,
                                   -0.00417768164f,  0.246640727f,    1.50140941f};
    static const float tail[] = {-0.000200214257f, 0.000100950558f, 0.00134934322f,
                                 -0.00367342844f,  0.00573950773f,  -0.0076224613f,
                                 0.00943887047f,   1.00167406f,     2.83297682f};
    float w = -logf((1.0f - x) * (1.0f + x));
    return x * (w < 5.0f ? ladder(middle, 9, w - 2.5f) : ladder(tail, 9, sqrtf(w) - 3.0f));
}

/* theta = 0 has no tangent to divide by, so it gets the least tangent that a float cosine can show. */
static inline beckmann_view view_from(vndf_vec3 wi, float alpha)
{
    beckmann_view v = {.wi = wi, .turn = method_turn_from(wi, alpha), .alpha = alpha};
    float s = fmaxf(v.turn.s, 1e-4f), c = v.turn.c, cot = c / s, theta = acosf(fminf(c, 1.0f));
    float e = per_root_pi * expf(-cot * cot);
    v.tangent = s / c;
    v.edge = erff(cot);
    v.start = 1.0f + theta * (-0.876f + theta * (0.4265f - 0.0594f * theta));
    v.per_total = 1.0f / (1.0f + v.edge + v.tangent * e);
    v.per_area = 2.0f / (v.turn.length * (c * (1.0f + v.edge) + s * e));
    return v;
}

static inline float slope_along(const beckmann_view *v, float u1)
{
    float low = -1.0f, high = v->edge, u = fmaxf(u1, 1e-6f);
    float b = v->edge - (1.0f + v->edge) * powf(1.0f - u, v->start), x = 0;
    for (int step = 0; step < 10; step++) {
        if (!(b > low && b < high))
            b = 0.5f * (low + high);
        x = erf_inverse(b);
        float error = v->per_total * (1.0f + b + v->tangent * per_root_pi * expf(-x * x)) - u;
        if (fabsf(error) < 1e-6f)
            break;
        *(error > 0 ? &high : &low) = b;
        b -= error / (v->per_total * (1.0f - x * v->tangent));
    }
    return x;
}

static inline vndf_vec3 one(const method *m, const method_input *in, float *pdf)
{
    (void)m;
    beckmann_view v = view_from(in->wi, in->alpha);
    float a = v.alpha, x = slope_along(&v, in->u[0]), y = erf_inverse(2.0f * fmaxf(in->u[1], 1e-6f) - 1.0f);
    vndf_vec3 wm = method_normal(&v.turn, a, x, y);
    float z2 = wm.z * wm.z;
    float ndf = expf((z2 - 1.0f) / (z2 * a * a)) / (method_pi * a * a * z2 * z2);
    *pdf = fmaxf(0.0f, method_dot(v.wi, wm)) * ndf * v.per_area;
    return wm;
}

static void each(const method *m, block *b, size_t first, size_t count)
{
    method_loop(one, m, b, first, count);
}

method method_beckmann_newton(void)
{
    return (method){.name = "Newton on erf (2014)", .instructions = "scalar", .kind = ROW_PUBLISHED, .each = each};
}
