/* The inverse of the error function as a quantile, so that both tails keep their relative precision. */
#ifndef VNDF_MATH_ERF_QUANTILE_H
#define VNDF_MATH_ERF_QUANTILE_H

/* y with (1 + erf y)/2 = u, that is erfinv(2u - 1), for u in [2^-64, 1 - 2^-53]; relative error below 6e-9. */
double vndf_erf_quantile(double u);

#endif
