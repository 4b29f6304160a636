/* The tail of the error function without cancellation, underflow or a second division.
 *
 * For z >= 0 write  sqrt(pi) exp(z^2) erfc(z) = 1/(z + N(z)). N is the remainder of the continued fraction,
 * N = (1/2)/(z + 1/(z + (3/2)/(z + ...))): positive, 1/sqrt(pi) at 0, 1/(2z) for large z. A Gaussian
 * slope distribution then needs sums of positive terms only; above all  1 - z sqrt(pi) exp(z^2) erfc(z) =
 * N/(z + N),  which is about 1/(2 z^2): a difference of erfc would lose all its digits.
 *
 * N is one ratio of polynomials, relative error below 2.3e-9 for all z in [0, inf) (fitted for the least largest
 * relative error against 90 digits; its limit z N -> 1/2 holds to 1e-9). z up to 1e40 overflows nothing. */
#ifndef VNDF_MATH_ERFC_REMAINDER_H
#define VNDF_MATH_ERFC_REMAINDER_H

#include "simd/doubles.h"

/* N = above/below, for callers that divide by another number too. */
typedef struct vndf_erfc_quotient {
    doubles above, below;
} vndf_erfc_quotient;

VNDF_INLINE vndf_erfc_quotient vndf_erfc_remainder_parts(doubles z)
{
    doubles z2 = z * z;
    doubles above = 0.56418958229060461 + z2 * (0.43442368789452211 + z2 * 0.035588736448437589) +
                    z * (0.69970383607076316 + z2 * (0.16104945658031852 + z2 * 0.0039072060817670431));
    doubles below = 1.0 + z2 * (1.7103683206539098 + z2 * (0.32991426458870597 + z2 * 0.0078144121811194945)) +
                    z * (1.8842672339634624 + z2 * (0.93999210664236087 + z2 * 0.071177462680180894));
    vndf_erfc_quotient n = {above, below};
    return n;
}

VNDF_INLINE doubles vndf_erfc_remainder(doubles z)
{
    vndf_erfc_quotient n = vndf_erfc_remainder_parts(z);
    return n.above / n.below;
}

#endif
