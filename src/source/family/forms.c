/* The formulas of the families, as P22(r) = D cos^4(theta) at r = tan(theta), with P22(0) near 1 so that no
 * parameter overflows, and their masses 2 pi integral P22 r dr, closed wherever there is a closed form.
 *
 *   ggx           (1 + r^2)^-2 / pi                          Walter et al., EGSR 2007
 *   beckmann      exp(-r^2) / pi                             Beckmann & Spizzichino 1963
 *   student-t     (1 + r^2/(gamma-1))^-gamma / pi            Ribardiere et al., CGF 36(2), 2017, unit roughness
 *   gtr           D ~ (alpha^2 cos^2 + sin^2)^-gamma         Burley, SIGGRAPH course 2012; not a family of
 *                 stretched slopes: at alpha = 1 it is constant, so alpha is 0.1 if it is not given
 *   epd           exp(-(r^2)^p)                              Holzschuch & Pacanowski, ACM TOG 36(4), 2017
 *   abc           D ~ (1 + B (1 - cos))^-C                   Low et al., ACM TOG 31(1), 2012
 *   sgd           exp(-x)/x^p, x = alpha + r^2/alpha         Bagher et al., CGF 31(4), 2012
 *   hyper-cauchy  (2 + r^2/sigma^2)^-q                       Wellems et al., J. Opt. A 8, 2006
 *   phong         D ~ cos^N                                  Blinn 1977, from Phong 1975
 *   charlie       D ~ sin^(1/a)                              Estevez & Kulla, SIGGRAPH course 2017
 *
 * Powers are formed as exp(-n log1p(x)), which keeps its digits for large n and small x. sgd is divided by its value
 * at r = 0, exp(-alpha)/alpha^p, which would underflow; gtr is multiplied by alpha^(2 gamma); 1 - cos is
 * r^2/(q + sqrt q), q = 1 + r^2, without cancellation. hyper-cauchy is published with a factor for which its mass is 1.
 * charlie is 0 at r = 0. Its paper fits a Lambda of its own; ours is Smith's of D, as of all families. */
#include "source/family/family.h"
#include "vndf_build.h"

/* clang-format off */
const vndf_family_form vndf_family_forms[VNDF_FAMILY_FORMS] = {
    { "ggx", "ggx", 0, 0, { { NULL, 0, 0, 0, 0 } }, "",
      "1/(pi*(1+r*r)*(1+r*r))", "1" },
    { "beckmann", "beckmann", 0, 0, { { NULL, 0, 0, 0, 0 } }, "",
      "exp(-r*r)/pi", "1" },
    { "student-t", "student-t:GAMMA", 1, 1, { { "GAMMA", 1.5, 1e9, 1, 0 } },
      "P22 falls as r^(-2 GAMMA), which has to be faster than r^-3",
      "exp(-a*log1p(r*r/(a-1)))/pi", "(a-1)/(a-1)" },
    { "gtr", "gtr:GAMMA[,ALPHA]", 1, 2, { { "GAMMA", 0, 1000, 1, 0 }, { "ALPHA", 1e-9, 1, 0, 0.1 } },
      "GAMMA = 2 is ggx of roughness ALPHA, larger GAMMA has shorter tails",
      "pow(b*b*(1+r*r)/(b*b+r*r),a)/((1+r*r)*(1+r*r))", NULL },
    { "epd", "epd:P", 1, 1, { { "P", 0.05, 1000, 0, 0 } },
      "P = 1 is beckmann, smaller P has longer tails, large P is a disc",
      "exp(-pow(r,2*a))", "pi*gamma(1+1/a)" },
    { "abc", "abc:B,C or abc:MATERIAL", 2, 2, { { "B", 0, 1e15, 1, 0 }, { "C", 0, 1000, 1, 0 } },
      "both grow with the sharpness of the peak",
      "exp(-b*log1p(a*(r*r/(1+r*r+sqrt(1+r*r)))))/((1+r*r)*(1+r*r))", NULL },
    { "sgd", "sgd:ALPHA,P or sgd:MATERIAL/CHANNEL", 2, 2, { { "ALPHA", 1e-9, 1e6, 0, 0 }, { "P", 0, 1000, 0, 0 } },
      "ALPHA is the width of the peak, P the strength of its core",
      "exp(-r*r/a-b*log1p(r/a*(r/a)))", NULL },
    { "hyper-cauchy", "hyper-cauchy:Q[,SIGMA]", 1, 2, { { "Q", 1.5, 1e9, 1, 0 }, { "SIGMA", 1e-9, 1e9, 0, 1 } },
      "P22 falls as r^(-2 Q), which has to be faster than r^-3",
      "exp(-a*log1p(r/b*(r/b)/2))", "2*pi*b*b/(a-1)" },
    { "phong", "phong:N", 1, 1, { { "N", 0, 1e9, 0, 0 } }, "N = 0 is a constant D",
      "exp(-(a+4)/2*log1p(r*r))", "2*pi/(a+2)" },
    { "charlie", "charlie:A", 1, 1, { { "A", 0.05, 1, 0, 0 } }, "the smaller, the narrower the rim of sheen",
      "pow(r/sqrt(1+r*r),1/a)/((1+r*r)*(1+r*r))", "2*pi*a/(1+2*a)" },
};
/* clang-format on */

/* The ranges are those above; a test compares them. */
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
           "charlie:A                 0.05 <= A <= 1; D ~ sin^(1/A) (Estevez & Kulla 2017), masked by Smith's Lambda "
           "of this D, not by the fit of that paper\n"
           "mix:(W,S,FAMILY)+(W,S,FAMILY)  two of the above, each normalised, its slopes scaled by S "
           "(1e-9 <= S <= 1e9), weighted by W (0 < W <= 1e12)\n";
}
