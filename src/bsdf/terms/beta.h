#ifndef VNDF_BSDF_TERMS_BETA_H
#define VNDF_BSDF_TERMS_BETA_H

/* Euler's Beta(a, b), a and b from 1 to infinity; relative error below 2e-8 where it exceeds 1e-300. */
double vndf_beta(double a, double b);

#endif
