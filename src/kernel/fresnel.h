/* Fresnel's equations for unpolarised light, without differences of nearly equal numbers: at right angles, beside
 * total reflection, and for index ratios near 1. Text for one double (bsdf/bsdf.h, relative error below 1e-12, an
 * index ratio of 1 excluded, where F is 0) or one float (some 1e-6, but where reflection is nearly total). */
#ifndef VNDF_KERNEL_FRESNEL_H
#define VNDF_KERNEL_FRESNEL_H

/* Squared cosine of the refracted direction, eta the index beyond over the one before; <= 0 in total reflection.
 * Near grazing incidence 1 - sin^2/eta^2 keeps its digits, also where eta is 1 or near it. */
KERNEL real refracted_square(real cosine, real eta)
{
    return ((eta - 1.0f) * (eta + 1.0f) + cosine * cosine) / (eta * eta);
}

/* With c, t the cosines before and beyond, r_s = (c - eta t)/(c + eta t) and r_p = (eta c - t)/(eta c + t), and
 *
 *     eta^2 t^2 - c^2 = eta^2 - 1,    eta^2 (eta^2 c^2 - t^2) = (eta^2 - 1) ((eta^2 + 1) c^2 - 1). */
KERNEL real dielectric_at(real c, real t, real eta)
{
    real square = eta * eta, rise = (eta - 1.0f) * (eta + 1.0f), s = c + eta * t, p = eta * (eta * c + t);
    real rs = rise / (s * s), rp = rise * ((square + 1.0f) * (c * c) - 1.0f) / (p * p);
    return 0.5f * (rs * rs + rp * rp);
}

KERNEL real dielectric(real cosine, real eta)
{
    real c = min(cosine, set(1.0f)), square = refracted_square(c, eta);
    mask passes = lt(set(0.0f), square);
    return select(passes, dielectric_at(c, sqrt(select(passes, square, set(1.0f))), eta), set(1.0f));
}

/* (n + ik)^2 - sin^2 = (a + ib)^2, hence a^2 - b^2 = t = n^2 - k^2 - sin^2 and a b = n k (Born & Wolf, "Principles
 * of Optics", 14.2). The smaller of a^2 and b^2 comes from the larger, and a - c from a^2 - c^2 = n^2 - k^2 - 1 +
 * b^2, which is `apart`. Both polarisations share a division:
 *
 *     s = ((a - c)^2 + b^2)/((a + c)^2 + b^2),    p = s ((a c - sin^2)^2 + b^2 c^2)/((a c + sin^2)^2 + b^2
 * c^2). */
KERNEL real conductor(real cosine, real n, real k)
{
    real c = min(cosine, set(1.0f)), c2 = c * c, s2 = 1.0f - c2, nk = n * k;
    real t = (n * n - k * k) - s2, larger = 0.5f * (sqrt(t * t + 4.0f * nk * nk) + abs(t));
    real lesser = nk * nk / max(larger, set(1e-37f));
    mask turned = le(t, set(0.0f));
    real a2 = select(turned, lesser, larger), b2 = select(turned, larger, lesser), a = sqrt(a2), sum = a + c;
    real apart = (n - 1.0f) * (n + 1.0f) - k * k + b2, inner = a * c - s2, outer = a * c + s2;
    real square = sum * sum, over = inner * inner + b2 * c2, under = outer * outer + b2 * c2;
    real below = square * (square + b2) * under;
    real mean = 0.5f * (apart * apart + b2 * square) * (under + over);
    return select(lt(set(0.0f), below), min(mean / below, set(1.0f)), set(1.0f)); /* 0/0 at right angles */
}

/* f0 + (1 - f0) (1 - cos)^5, from rest = 1 - cos >= 0, which keeps its digits (lobes.h). */
KERNEL real schlick(real rest, real f0)
{
    real square = rest * rest;
    return f0 + (1.0f - f0) * (square * square * rest);
}

/* 1 - cos of the refracted direction, from cos = 1 - rest; 1 in total reflection: Schlick's term takes the cosine
 * in the thinner medium. */
KERNEL real refracted_rest(real rest, real eta)
{
    real square = refracted_square(1.0f - rest, eta);
    real sine2 = rest * (2.0f - rest) / (eta * eta);
    return select(lt(set(0.0f), square), sine2 / (1.0f + sqrt(max(square, set(0.0f)))), set(1.0f));
}

#endif
