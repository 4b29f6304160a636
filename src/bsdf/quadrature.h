/* Directional albedo by quadrature: the part of the light from wi that single scattering with height-correlated Smith
 * masking sends on. With slopes r = a R of azimuth phi, counted from wi, and w = wi.wm/wm.z = cos_i + sin_i r
 * cos(phi), it is the integral over the normals whose wo leaves the surface of P22(R) R dR dphi times
 *
 *     reflected      w F cos_o/(cos_o A(wi) + cos_i A(-wo))
 *     transmitted    w (1 - F) Beta(1 + Lambda_i, 1 + Lambda_o)/cos_i.
 *
 * At cos_i = 0 the first is the integral of visible normals times F, and the second 0.
 *
 * The radius runs over panels of x = R/(1 + R), even ones and the quantiles of R, so that no lobe of D is missed,
 * cut where the range of azimuths begins to be limited or stops. The azimuth runs between the places where wo comes
 * to the horizon and reflection becomes total; all of these are arccosines of numbers that the formulas give. So the
 * integrand is smooth in each panel, and Gauss's rule serves. Nodes crowd by a square towards the end of a panel,
 * where a root may vanish or a layer as thin as the roughness may lie. An azimuth is given by the tangent of half of
 * it, or of half its complement to a half turn: there is no sine and no cosine, and the bits are the same
 * everywhere. */
#ifndef VNDF_BSDF_QUADRATURE_H
#define VNDF_BSDF_QUADRATURE_H

#include "math/gauss_rule.h"
#include "vndf.h"

enum {
    VNDF_QUADRATURE_EVEN = 24,      /* panels up to R/(1 + R) = 15/16, */
    VNDF_QUADRATURE_TAIL = 20,      /* then by halves of the rest, */
    VNDF_QUADRATURE_QUANTILES = 24, /* between quantiles of a table */
    VNDF_QUADRATURE_BORDERS = VNDF_QUADRATURE_EVEN + VNDF_QUADRATURE_TAIL + VNDF_QUADRATURE_QUANTILES + 1
};

/* Rules for one distribution. */
typedef struct vndf_quadrature {
    const vndf_distribution *distribution;
    double scale;                           /* of the distribution: R = 1 is its median slope */
    double border[VNDF_QUADRATURE_BORDERS]; /* of panels, ascending */
    int borders;
    vndf_gauss_rule radial, azimuth;
} vndf_quadrature;

void vndf_quadrature_of(vndf_quadrature *q, const vndf_distribution *distribution);

/* cos_i in [0, 1], alpha > 0; eta is the index beyond over that on the side of wi, 0 for a mirror. Within 5e-6. */
double vndf_quadrature_albedo(const vndf_quadrature *q, double cosine, double alpha, double eta);

#endif
