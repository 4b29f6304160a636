/* The help text about families. Its ranges are the ranges of family_forms.c; a test compares them. */
#include "vndf_build.h"

const char *vndf_family_help(void)
{
    return "ggx                       P22 ~ (1+r^2)^-2 (Walter et al. 2007)\n"
           "beckmann                  P22 ~ exp(-r^2) (Beckmann & Spizzichino 1963)\n"
           "student-t:GAMMA           1.5 < GAMMA <= 1e9; P22 ~ (1 + r^2/(GAMMA-1))^-GAMMA (Ribardiere et al. 2017)\n"
           "gtr:GAMMA[,ALPHA]         0 < GAMMA <= 1000, 1e-9 <= ALPHA <= 1 (0.1 if not given); "
           "D ~ (ALPHA^2 cos^2 + sin^2)^-GAMMA (Burley 2012)\n"
           "epd:P                     0.05 <= P <= 1000; P22 ~ exp(-(r^2)^P) (Holzschuch & Pacanowski 2017)\n"
           "abc:B,C                   0 < B <= 1e15, 0 < C <= 1000; D ~ (1 + B (1-cos))^-C (Low et al. 2012)\n"
           "abc:MATERIAL              a fit of a measured material, as in abc:two-layer-gold (Low et al. 2012)\n"
           "sgd:ALPHA,P               1e-9 <= ALPHA <= 1e6, 0 <= P <= 1000; P22 ~ exp(-x)/x^P, "
           "x = ALPHA + r^2/ALPHA (Bagher et al. 2012)\n"
           "sgd:MATERIAL/CHANNEL      a fit of a measured material, as in sgd:alum-bronze/r (Bagher et al. 2012)\n"
           "hyper-cauchy:Q[,SIGMA]    1.5 < Q <= 1e9, 1e-9 <= SIGMA <= 1e9 (1 if not given); "
           "P22 ~ (2 + r^2/SIGMA^2)^-Q (Wellems et al. 2006)\n"
           "phong:N                   0 <= N <= 1e9; D ~ cos^N (Blinn 1977)\n"
           "mix:(W,S,FAMILY)+(W,S,FAMILY)  two of the above, each normalised, its slopes scaled by S "
           "(1e-9 <= S <= 1e9), weighted by W (0 < W <= 1e12)\n";
}
