/* Gauss-Legendre rules on [0, 1]: integral_0^1 f ~ sum weight_i f(node_i), exact for polynomials of degree
 * 2n - 1. */
#ifndef VNDF_FIT_PROFILE_GAUSS_H
#define VNDF_FIT_PROFILE_GAUSS_H

enum { VNDF_GAUSS = 10 };

extern const double vndf_gauss_node[VNDF_GAUSS], vndf_gauss_weight[VNDF_GAUSS];
/* Barycentric weights w, up to a common factor: the polynomial through values f_i at the nodes is
 * sum w_i f_i/(x - x_i) over sum w_i/(x - x_i). */
extern const double vndf_gauss_barycentric[VNDF_GAUSS];

#endif
