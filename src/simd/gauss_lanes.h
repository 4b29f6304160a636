/* exp, log and relatives of the error function in float, for one or for lanes. Samples of a Gaussian distribution
 * of slopes use them where no number is extreme. The errors below are before rounding, which adds some 1e-7. Each
 * polynomial was fitted for the least largest error of its kind, by weighted least squares.
 *
 *   exp       |x| <= 80. 2^(k + r): k + 127 appears in the low bits of a sum that is too large for fractions, and
 *             goes from there to the exponent. Relative error 4e-9, and 6e-8 x from the product with log2(e).
 *   log       x = 2^k m, 1/sqrt(2) <= m < sqrt(2); log(m)/(m - 1) a polynomial: absolute error 2.1e-7.
 *   quantile  y with (1 + erf y)/2 = u is (2u - 1) P(w), w = -log(4 u (1 - u)) (Giles, "Approximating the erfinv
 *             function", GPU Computing Gems 2, 2011), P of degree 10 for w < 8: relative error 9e-8.
 *   E         sqrt(pi) exp(z^2) erfc(z), a ratio of polynomials for 0 <= z <= 4: relative error 5.1e-8. */
#ifndef VNDF_SIMD_GAUSS_LANES_H
#define VNDF_SIMD_GAUSS_LANES_H

#include "simd/lanes.h"

/* exp(x) = scale (1 + more). */
typedef struct vndf_exp_parts {
    lanes_f more, scale;
} vndf_exp_parts;

VNDF_INLINE vndf_exp_parts vndf_exp_parts_lanes(lanes_f x)
{
    lanes_f t = x * 1.44269504f, shifted = t + 12583039.0f, r = t - (shifted - 12583039.0f), r2 = r * r;
    lanes_f high = (0.00961802162f + r * 0.00133907425f) + r2 * 0.000154722028f;
    vndf_exp_parts e = {r * 0.693147181f + r2 * ((0.240226507f + r * 0.0555036112f) + r2 * high),
                        lanes_of_bits(lanes_bits(shifted) << 23)};
    return e;
}

VNDF_INLINE lanes_f vndf_exp_lanes(lanes_f x)
{
    vndf_exp_parts e = vndf_exp_parts_lanes(x);
    return e.scale + e.scale * e.more;
}

/* exp(x) - 1 with all digits, however small it is. */
VNDF_INLINE lanes_f vndf_exp_less_one_lanes(lanes_f x)
{
    vndf_exp_parts e = vndf_exp_parts_lanes(x);
    return (e.scale - 1.0f) + e.scale * e.more;
}

/* x > 0, not denormal. */
VNDF_INLINE lanes_f vndf_log_lanes(lanes_f x)
{
    lanes_u bits = lanes_bits(x), k = (bits - 0x3f3504f3u) & 0xff800000u;
    lanes_f f = lanes_of_bits(bits - k) - 1.0f, f2 = f * f;
    lanes_f low = (1.00000325f - 0.500019641f * f) + f2 * (0.333032689f - 0.248813861f * f);
    lanes_f high = (0.206051833f - 0.189015866f * f) + f2 * 0.118249059f;
    return lanes_float(k) * 8.26295823e-8f + f * (low + f2 * f2 * high);
}

VNDF_INLINE lanes_f vndf_quantile_lanes(lanes_f u, lanes_f w)
{
    lanes_f q = w - 4.0f, q2 = q * q, q4 = q2 * q2;
    lanes_f low = (1.85877906f + 0.22835425f * q) + q2 * (-0.00722088791f - 0.000203399073f * q);
    lanes_f middle = (0.000118794057f - 1.57276808e-5f * q) + q2 * (5.0177458e-7f + 2.10143173e-7f * q);
    lanes_f high = (-3.48735493e-8f - 5.01036624e-10f * q) + q2 * 3.88030775e-10f;
    return (u - (1.0f - u)) * (low + q4 * (middle + q4 * high));
}

/* E = above/below. */
typedef struct vndf_erfc_ratio {
    lanes_f above, below;
} vndf_erfc_ratio;

VNDF_INLINE vndf_erfc_ratio vndf_erfc_lanes(lanes_f z)
{
    lanes_f z2 = z * z;
    vndf_erfc_ratio e = {(1.77245376f + 1.66637503f * z) + z2 * (0.732580278f + 0.134191112f * z),
                         (1.0f + 2.06852626f * z) + z2 * ((1.74745559f + 0.73090625f * z) + z2 * 0.134281672f)};
    return e;
}

#endif
