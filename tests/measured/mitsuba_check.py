"""GGX in closed form against .bsdf files in Mitsuba 3: rough.bsdf, smooth.bsdf and spectral.bsdf in this folder.

Two numbers for each direction of incidence: the mean relative error of f cos, weighed by the light, and the largest
difference between the density of a sample and the density of its direction. A sample's weight is f cos over density."""
import sys

import mitsuba
import numpy

failures = 0


def expect(what, good):
    global failures
    failures += not good
    if not good:
        print("FAILED:", what)


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


def look(bsdf, degrees, alpha, f0, count, seed):
    numbers = numpy.random.default_rng(seed)
    theta, phi = numpy.radians(degrees), 0.7
    wi = numpy.array([numpy.sin(theta) * numpy.cos(phi), numpy.sin(theta) * numpy.sin(phi), numpy.cos(theta)])
    hit, context = mitsuba.SurfaceInteraction3f(), mitsuba.BSDFContext()
    hit.wi = mitsuba.Vector3f(*wi.tolist())
    worst = light = missed = off = 0
    for _ in range(count):
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
        off = max(off, abs(numpy.array(weight) * drawn.pdf / numpy.maximum(found, 1e-9) - 1).max())
    return missed / light, worst, off


def check(name, alpha, f0, count):
    bsdf = mitsuba.load_dict({"type": "measured", "filename": name})
    for degrees in (2, 40, 65, 80, 87):
        off, worst, weights = look(bsdf, degrees, alpha, numpy.array(f0), count, 1)
        print(f"{name} at {degrees} degrees: f cos off by {off:.4f}, densities by {worst:.1e}, weights by {weights:.1e}")
        expect(f"{name} at {degrees} degrees", off < 0.015 and worst < 1e-3 and weights < 2e-3)


def check_spectral():
    mitsuba.set_variant("scalar_spectral")
    bsdf = mitsuba.load_dict({"type": "measured", "filename": "spectral.bsdf"})
    context, hit = mitsuba.BSDFContext(), mitsuba.SurfaceInteraction3f()
    wi = numpy.array([0.6, 0, 0.8])
    hit.wi, hit.wavelengths = mitsuba.Vector3f(*wi.tolist()), [350, 500, 600, 750]
    f0 = numpy.array([0.25, 0.375, 0.5, 0.875])  # linear between wavelengths, the nearest outside
    for wo in ([-0.6, 0, 0.8], [-0.48, 0.36, 0.8], [-0.3, -0.1, numpy.sqrt(0.9)]):
        value, rise = reflected(wi, numpy.array(wo)[:, None], 0.3)
        found = numpy.array(bsdf.eval(context, hit, mitsuba.Vector3f(*wo)))
        want = value * (f0 + (1 - f0) * rise)
        print("spectra", found, "closed form", want)
        expect("spectra", numpy.all(abs(found / want - 1) < 0.01))


mitsuba.set_variant("scalar_rgb")
check("rough.bsdf", 0.5, [1, 0.5, 0.25], 1000)
check("smooth.bsdf", 0.05, [1, 1, 1], 1000)
check_spectral()
sys.exit(failures > 0)
