/* Functions of the kernel from + - * /, roots and bits alone: angles, exponentials, the error function, differences of
 * products. Errors are those before rounding, which adds some 1e-7, unless "measured" stands beside them. Each
 * polynomial was fitted for the least largest relative error of the whole function, unless said otherwise;
 * tools/evidence/fits.py makes it again. */
#ifndef VNDF_KERNEL_MATH_H
#define VNDF_KERNEL_MATH_H

/* A normal of the unit problem, of any length, in the frame of the stretched direction, z >= 0; and the factor K of the
 * density with which it is drawn: K len^3/|det M| per steradian, where len is the length of (M (x, y), z). */
typedef struct normal_sample {
    real x, y, z, density;
} normal_sample;

typedef struct pair {
    real a, b;
} pair;

typedef struct turn {
    real sine, cosine;
} turn;

/* Of a number in [0, 1]; NaN becomes 0. */
KERNEL real unit_number(real u)
{
    return min(max(u, set(0.0f)), set(1.0f));
}

/* ---- products ---- */

/* The first half of the digits of a. */
KERNEL real head(real a)
{
    real t = 4097.0f * a;
    return t - (t - a);
}

/* What the product p = a b lost where it was rounded (Dekker, "A floating-point technique for extending the available
 * precision", 1971). */
KERNEL real product_rest(real a, real b, real p)
{
    real c = head(a), d = head(b);
    return ((c * d - p) + (c * (b - d) + (a - c) * d)) + (a - c) * (b - d);
}

/* a b - c d, measured within 0.5 units of its last digit where no part is denormal. */
KERNEL real difference_of_products(real a, real b, real c, real d)
{
    real p = a * b, q = c * d;
    return (p - q) + (product_rest(a, b, p) - product_rest(c, d, q));
}

/* The power of two that brings |x| into [1, 2); 2^127 for less than 2^-126, and 2^-126 for more than 2^126. */
KERNEL real inverse_scale(real x)
{
    return of_bits(2130706432 - (bits(min(abs(x), set(8.5e37f))) & 2139095040));
}

/* ---- angles ---- */

/* sin(pi f), f in [0, 1/2]: 5.3e-9. */
KERNEL real sine_quarter(real f)
{
    real q = f * f;
    return f * (3.14159263696f +
                q * (-5.1677096882f + q * (2.55006977348f + q * (-0.598242370689f + q * 0.0775608117772f))));
}

/* Sine and cosine of pi u, u in [0, 1], each with its digits next to its zeros; measured: 2.0e-7 absolute. */
KERNEL turn half_turn(real u)
{
    real rest = 0.5f - u;
    const turn t = {sine_quarter(min(u, 1.0f - u)), with_sign(sine_quarter(abs(rest)), rest)};
    return t;
}

/* G of atan q = q (1 - q^2 G(q^2)), q in [0, 1]: the angle is within 1.7e-8 of itself. */
KERNEL real arc_rest(real t)
{
    real t2 = t * t;
    real low = (0.333331527f - 0.199937728f * t) + t2 * (0.142110553f - 0.106660045f * t);
    real high = (0.0755221405f - 0.0432118582f * t) + t2 * (0.0163679265f - 0.00292069187f * t);
    return low + t2 * t2 * high;
}

/* The angle of (x, y) in [0, pi], y >= 0; of (0, 0): 0. Measured: 2e-7 relative. */
KERNEL real angle_of(real y, real x)
{
    real across = abs(x), larger = max(across, y), smaller = min(across, y);
    real q = smaller / max(larger, set(1e-37f)), t = q * q, angle = q - q * t * arc_rest(t);
    angle = select(lt(across, y), 1.57079633f - angle, angle);
    return select(lt(x, set(0.0f)), 3.14159265f - angle, angle);
}

/* ---- exponentials ---- */

/* exp(x), |x| <= 87: 3.1e-9. Measured: 1e-7. k is the nearest whole number to x/log 2; log 2 is split so that k times
 * its first part is exact. */
KERNEL real exp_near(real x)
{
    integer n = to_int(x * 1.44269504f + 127.5f);
    real k = to_real(n - 127), r = (x - k * 0.693145752f) - k * 1.42860677e-6f, r2 = r * r;
    real more =
        (0.499999934f + 0.166665201f * r) + r2 * ((0.0416683938f + 0.00836877631f * r) + r2 * 0.00138144754f);
    real power = of_bits(n * 8388608);
    return power + power * (r + r2 * more);
}

/* The same for x <= 87, 0 below -87. */
KERNEL real exp_of(real x)
{
    return select(lt(x, set(-87.0f)), set(0.0f), exp_near(max(x, set(-87.0f))));
}

/* log(1 + f) for 1/sqrt(2) <= 1 + f <= sqrt(2): 3.2e-8. */
KERNEL real log_near(real f)
{
    real f2 = f * f;
    real low = (0.333339107f - 0.25001337f * f) + f2 * (0.199630638f - 0.165775847f * f);
    real high = (0.149147679f - 0.14267487f * f) + f2 * 0.0870043591f;
    return f - f2 * (0.5f - f * (low + f2 * f2 * high));
}

/* log(x), x > 0 and not denormal. Measured: 1e-7 relative. */
KERNEL real log_of(real x)
{
    integer k = (bits(x) - 1060439283) & -8388608;
    real n = to_real(k) * 1.1920929e-7f; /* x = 2^n m, m from 1/sqrt(2) to sqrt(2) */
    return n * 0.693145752f + (log_near(of_bits(bits(x) - k) - 1.0f) + n * 1.42860677e-6f);
}

/* ---- the error function ---- */

/* N(z) = above/below, z >= 0: sqrt(pi) exp(z^2) erfc(z) = 1/(z + N(z)). N is the remainder of the continued fraction,
 * (1/2)/(z + 1/(z + ...)), 1/sqrt(pi) at 0 and 1/(2 z) for large z; sums of positive terms only: of N, 3.1e-9 for z <
 * 9.4, 9e-9 beyond. */
typedef struct erfc_quotient {
    real above, below;
} erfc_quotient;

KERNEL erfc_quotient erfc_rest(real z)
{
    real z2 = z * z;
    real above = (0.564189582f + z2 * (0.434423688f + z2 * 0.0355887364f)) +
                 z * (0.699703836f + z2 * (0.161049457f + z2 * 0.00390720608f));
    real below = (1.0f + z2 * (1.71036832f + z2 * (0.329914265f + z2 * 0.00781441212f))) +
                 z * (1.88426723f + z2 * (0.939992107f + z2 * 0.0711774627f));
    const erfc_quotient n = {above, below};
    return n;
}

/* erfc(x)/2. Measured: 2.1e-7 absolute, 4e-6 relative down to 1e-30. */
KERNEL real half_erfc(real x)
{
    real z = min(abs(x), set(1e4f));
    erfc_quotient n = erfc_rest(z);
    real tail = 0.282094792f * exp_of(-(z * z)) * n.below / (z * n.below + n.above);
    return select(lt(x, set(0.0f)), 1.0f - tail, tail);
}

/* 4 u (1 - u), where u and 1 - u are at least 2^-64 and 2^-26. */
KERNEL real erf_middle(real u)
{
    return 4.0f * max(u, set(5.42101086e-20f)) * max(1.0f - u, set(1.49011612e-8f));
}

/* y with (1 + erf y)/2 = u, from w = -log(4 u (1 - u)) (Giles, "Approximating the erfinv function", GPU Computing Gems
 * 2, 2011): 9e-8 for w < 8, 1.1e-7 up to w = 50, where y/((2 u - 1) sqrt(w)) is a polynomial in 1/sqrt(w). */
KERNEL real erf_quantile(real u)
{
    real w = -log_of(erf_middle(u)), q = min(w, set(8.0f)) - 4.0f, q2 = q * q, q4 = q2 * q2;
    real low = (1.85877906f + 0.22835425f * q) + q2 * (-0.00722088791f - 0.000203399073f * q);
    real middle = (0.000118794057f - 1.57276808e-5f * q) + q2 * (5.0177458e-7f + 2.10143173e-7f * q);
    real high = (-3.48735493e-8f - 5.01036624e-10f * q) + q2 * 3.88030775e-10f,
         ratio = low + q4 * (middle + q4 * high);
    mask far = lt(set(8.0f), w);
    if (any(far)) {
        real root_w = sqrt(w), r = 1.0f / root_w, r2 = r * r;
        real even = 1.00250887f + r2 * (-0.347504458f + r2 * (10.3058436f + r2 * 20.1312207f));
        real odd = -0.0954507242f + r2 * (-1.21607528f - r2 * 23.7076448f);
        ratio = select(far, root_w * (even + r * odd), ratio);
    }
    return (u - (1.0f - u)) * ratio;
}
#endif
