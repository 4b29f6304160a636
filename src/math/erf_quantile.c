/* With t = 2u - 1 = erf y, the ratio y/t is a smooth even function of t, best written in
 * w = -log(1 - t^2) = -log(4 u (1 - u)) (Giles, "Approximating the erfinv function", GPU Computing Gems 2, 2011);
 * w comes from u, so nothing is lost in the tails. w < 6 (99.9% of the mass): a polynomial of degree 10,
 * relative error 5.1e-9. Beyond: y/(t sqrt(w)) is a polynomial in 1/sqrt(w) with error 1.6e-6, and one Newton
 * step on erfc|y| = 2 min(u, 1 - u) squares it. Both fitted for the least largest relative error against 40
 * digits. */
#include "math/erf_quantile.h"

#include <math.h>

#include "math/elementary.h"

/* Even and odd powers are summed apart, here and in erfc_remainder.h: two short chains instead of a long one. */
static double middle(double w)
{
    double q = w - 3.0, q2 = q * q;
    double even =
        1.6235420148894659 +
        q2 * (-0.0057381933618706358 +
              q2 * (0.0001951273482003702 +
                    q2 * (-1.7757322387028804e-6 + q2 * (-1.8348946029483168e-8 + q2 * 6.2614091162552273e-10))));
    double odd = 0.24163040760277827 +
                 q2 * (-0.00083619287441364661 +
                       q2 * (-1.2708794827431433e-5 + q2 * (4.4841984425414187e-7 - q2 * 5.4735482230986389e-9)));
    return even + q * odd;
}

static double tail(double u, double w)
{
    double v = u < 0.5 ? u : 1.0 - u, root = sqrt(w), r = 1.0 / root;
    double y = (1.0 - 2.0 * v) * root *
               (0.99833064623976067 +
                r * (0.013777668166622379 +
                     r * (-1.5085582602534115 +
                          r * (5.2107202392865749 + r * (-9.2505828000150393 + r * 7.3469906542702241)))));
    /* Newton on erfc(y) - 2v, whose derivative is -2 exp(-y^2)/sqrt(pi); both are divided by it at once. */
    y += 0.5 / (y + vndf_erfc_remainder(y)) - 1.7724538509055160 * v * vndf_exp(y * y);
    return u < 0.5 ? -y : y;
}

double vndf_erf_quantile(double u)
{
    double rest = 1.0 - u;
    double w = -vndf_log(4.0 * u * rest);
    return w < 6.0 ? (u - rest) * middle(w) : tail(u, w);
}
