"""A .bsdf of `vndf export --rgl` in Mitsuba 3's plugin `measured`, unmodified: its values are those of GGX in closed
form, its samples follow its own density, and their weights are value over density; also in spectra.

Numbers for each direction of incidence: the mean relative error of f cos, weighed by the light, the largest difference
between the density of a sample and the density of its direction, and of a sample's weight from f cos over density; and
the spread of weights, which are nearly equal."""
import os
import subprocess
import sys

import numpy

try:
    import mitsuba
except ImportError:
    print("SKIPPED: no Mitsuba")
    sys.exit(0)


def area(w, alpha):
    return (w[2] + numpy.sqrt(w[2] ** 2 + alpha**2 * (w[0] ** 2 + w[1] ** 2))) / 2


def reflected(wi, wo, alpha):
    """D R/(4 A_i) and (1 - wi.m)^5: arrays over wo."""
    m = wi[:, None] + wo
    m /= numpy.sqrt((m * m).sum(0))
    square = (m[0] ** 2 + m[1] ** 2) / alpha**2 + m[2] ** 2
    ndf = 1 / (numpy.pi * alpha**2 * square**2)
    a_i, a_o = area(wi, alpha), area(wo, alpha)
    masked = a_i * wo[2] / (a_i * wo[2] + a_o * wi[2] - wi[2] * wo[2])
    return numpy.where(wo[2] > 0, ndf * masked / (4 * a_i), 0), (1 - (wi[:, None] * m).sum(0)) ** 5


def look(bsdf, degrees, alpha, f0, wavelengths):
    numbers = numpy.random.default_rng(1)
    theta, phi = numpy.radians(degrees), 0.7
    wi = numpy.array([numpy.sin(theta) * numpy.cos(phi), numpy.sin(theta) * numpy.sin(phi), numpy.cos(theta)])
    hit, context = mitsuba.SurfaceInteraction3f(), mitsuba.BSDFContext()
    hit.wi, hit.wavelengths = mitsuba.Vector3f(*wi.tolist()), wavelengths
    worst = light = missed = off = 0
    weights = []
    for _ in range(1000):
        drawn, weight = bsdf.sample(context, hit, 0.5, mitsuba.Point2f(numbers.random(), numbers.random()))
        wo = numpy.array([float(x) for x in drawn.wo])
        if not wo[2] > 0:
            continue
        found, density = numpy.array(bsdf.eval(context, hit, drawn.wo)), bsdf.pdf(context, hit, drawn.wo)
        worst = max(worst, abs(density / drawn.pdf - 1))
        value, rise = reflected(wi, wo[:, None], alpha)
        want = value * (f0 + (1 - f0) * rise)
        missed += abs(found - want).mean() / drawn.pdf
        light += want.mean() / drawn.pdf
        weights.append(numpy.array(weight).mean())
        off = max(off, abs(numpy.array(weight) * drawn.pdf / numpy.maximum(found, 1e-9) - 1).max())
    return missed / light, worst, off, numpy.std(weights) / numpy.mean(weights)


def check(name, alpha, f0, wavelengths=(), words=()):
    """Whether all is as it should be."""
    program = [os.environ["VNDF_PROGRAM"], "export", "ggx", "--rgl", "--alpha", str(alpha), *words, "-o", name]
    subprocess.run(program, check=True)
    bsdf, good = mitsuba.load_dict({"type": "measured", "filename": name}), True
    for degrees in (2, 40, 65, 80, 87):
        off, worst, weights, spread = look(bsdf, degrees, alpha, numpy.array(f0), wavelengths)
        print(f"{name} at {degrees} degrees: f cos off by {off:.4f}, densities by {worst:.1e}, weights by {weights:.1e}",
              f"and spread {spread:.3f}")
        good = good and off < 0.015 and worst < 1e-3 and weights < 2e-3 and spread < 0.1
    return good


mitsuba.set_variant("scalar_rgb")
good = check("rough.bsdf", 0.5, [1, 0.5, 0.25], words=["--f0", "1,0.5,0.25"]) & check("smooth.bsdf", 0.05, [1, 1, 1])
mitsuba.set_variant("scalar_spectral")
# linear between the wavelengths of the file, beyond them the nearest
written = ["--wavelengths", "400,600,800", "--f0", "0.25,0.5,1"]
good &= check("spectral.bsdf", 0.3, [0.25, 0.375, 0.5, 0.875], [350, 500, 600, 750], written)
sys.exit(not good)
