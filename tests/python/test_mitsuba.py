"""Our BSDFs agree with the library, and with Mitsuba where both have GGX.

    python test_mitsuba.py [VARIANT]        llvm_ad_rgb, or scalar_rgb where LLVM is absent
"""
import functools
import math
import os
import subprocess
import sys
import unittest

try:
    import drjit as dr
    import mitsuba as mi
    import numpy as np
except ImportError:
    print("SKIPPED: no Mitsuba")
    sys.exit(0)

TABLE = os.path.join(os.environ["VNDF_SOURCE"], "tables", "student-t-2.5.vndf")
VARIANT = sys.argv.pop(1) if len(sys.argv) > 1 else "llvm_ad_rgb"
# A library of LLVM that is too old ends the process: ask in another one.
TRY = f"import drjit as dr, mitsuba as mi; mi.set_variant('{VARIANT}'); dr.eval(dr.maximum(mi.Float(1), mi.Float(2)))"
if subprocess.run([sys.executable, "-c", TRY], capture_output=True).returncode:
    print(f"SKIPPED: {VARIANT} does not run here; it needs LLVM, which DRJIT_LIBLLVM_PATH names: 19 works, 16 aborts")
    sys.exit(0)
mi.set_variant(VARIANT)

import vndf
import vndf.mitsuba

vndf.mitsuba.register()
SCALAR = not dr.is_jit_v(mi.Float)
COUNT = 100 if SCALAR else 200000
GOLD = dict(eta=(0.143, 0.375, 1.442), k=(3.983, 2.386, 1.603))


def rgb(values):
    return {"type": "rgb", "value": list(values)}


def conductor(**more):
    optics = {name: rgb(values) for name, values in GOLD.items()}
    return {"type": "vndf_conductor", "distribution": TABLE, **optics, **more}


def directions(rng, count, low):
    w = rng.normal(size=(3, count))
    w /= np.linalg.norm(w, axis=0)
    w[2] = np.where(w[2] < low, -w[2], w[2])
    return w.astype(np.float32)


def each(function, *arrays):
    """`function` of arrays of Mitsuba, as arrays of numpy; in scalar variants of one column after the other."""

    def of(array):
        return np.asarray(array, np.float64)

    if not SCALAR:
        return [of(result) for result in function(*arrays)]
    columns = [function(*(row[..., i] for row in arrays)) for i in range(arrays[0].shape[-1])]
    return [np.stack([of(result) for result in results], axis=-1) for results in zip(*columns)]


def interaction(wi):
    si = dr.zeros(mi.SurfaceInteraction3f, 1) if SCALAR else dr.zeros(mi.SurfaceInteraction3f, dr.width(wi))
    si.wi = wi
    return si


class AgainstTheLibrary(unittest.TestCase):
    def close(self, a, b, most, usual, what, floor=0.0):
        apart = np.sort(abs(a - b) / (b + floor))
        self.assertLess(apart[-1], most, f"{what}: the farthest of {apart.size}")
        self.assertLess(apart[apart.size * 999 // 1000 - 1], usual, f"{what}: 99.9%")

    def test_distributions(self):
        """The calls of mitsuba.MicrofacetDistribution answer what the library does, and for GGX what Mitsuba's own do,
        behind a facet and below the horizon too."""
        for distribution in (vndf.ggx(), vndf.beckmann(), vndf.load(TABLE)):
            rng = np.random.default_rng(1)
            wi, alpha = directions(rng, COUNT, 0), np.exp(rng.uniform(math.log(0.02), 0, (2, COUNT))).astype(np.float32)
            u = rng.random((2, COUNT), dtype=np.float32)
            wo, m = directions(rng, COUNT, -1), directions(rng, COUNT, 0)

            def ask(make, wi, wo, m, alpha, u):
                of, (wi, wo, m) = make(*(mi.Float(a) for a in alpha)), (mi.Vector3f(w) for w in (wi, wo, m))
                wm, pdf = of.sample(wi, mi.Point2f(u))
                at_m = of.eval(m), of.pdf(wi, m), of.smith_g1(wo, m), of.G(wi, wo, m)
                return (*at_m, wm, pdf, of.pdf(wi, wm), of.eval(wm))

            ours = functools.partial(ask, functools.partial(vndf.mitsuba.MicrofacetDistribution, distribution))
            *at_m, wm, pdf, again, ndf = each(ours, wi, wo, m, alpha, u)
            surface = vndf.Surface(distribution, *alpha)
            wm = wm.astype(np.float32)
            self.assertLess(np.quantile(abs(wm - surface.sample(wi, u).wm), 0.999), 1e-5)
            self.close(pdf, surface.pdf(wi, wm), 3e-5, 1e-5, "densities of samples")
            self.close(again, surface.pdf(wi, wm), 3e-5, 1e-5, "densities")
            self.close(ndf, surface.ndf(wm), 3e-5, 1e-5, "D")
            g1 = surface.g1(wo * np.sign(wo[2])) * ((wo * m).sum(0) * wo[2] > 0)
            sure = abs((wo * m).sum(0)) > 1e-5
            np.testing.assert_allclose(at_m[2][sure], g1[sure], rtol=3e-5)
            np.testing.assert_allclose(at_m[3], at_m[2] * surface.g1(wi) * ((wi * m).sum(0) > 0), rtol=3e-5, atol=1e-6)
            if distribution is vndf.ggx():
                make = functools.partial(mi.MicrofacetDistribution, mi.MicrofacetType.GGX)
                theirs = each(functools.partial(ask, lambda x, y: make(x, y, True)), wi, wo, m, alpha, u)
                for one, other in zip(at_m, theirs):
                    np.testing.assert_allclose(one, other, rtol=2e-4, atol=1e-6)

    def compare(self, description, material, both_sides, usual=3e-5, floor=0.0):
        bsdf = mi.load_dict(description)
        rng = np.random.default_rng(2)
        wi, wo = directions(rng, COUNT, 0.02), directions(rng, COUNT, -1 if both_sides else 0.02)
        if both_sides:
            wi *= rng.choice([-1, 1], COUNT).astype(np.float32)
            wo[2] = np.where(abs(wo[2]) < 0.02, 0.5, wo[2])
            wo /= np.linalg.norm(wo, axis=0)
        ctx = mi.BSDFContext()

        def ask(wi, wo):
            return bsdf.eval_pdf(ctx, interaction(mi.Vector3f(wi)), mi.Vector3f(wo), True)

        value, pdf = each(ask, wi, wo)
        expected, density = material.eval_pdf(wi, wo)
        expected = expected.astype(np.float64) * abs(wo[2])
        ours, theirs = (value > 0).all(axis=0), (expected > 0).all(axis=0)
        self.assertLess((ours != theirs).mean(), 1e-4)  # at the edge of what is seen the last bit decides
        seen = ours & theirs
        self.assertGreater(seen.mean(), 0.2)
        self.close(value[:, seen].ravel(), expected[:, seen].ravel(), 2e-3, usual, "values", floor)
        self.close(pdf[seen], density[seen], 2e-3, usual, "densities", floor)
        self.compare_samples(bsdf, material, wi, rng.random((3, COUNT), dtype=np.float32))

    def compare_samples(self, bsdf, material, wi, u):
        """The same numbers draw the same directions, whose law is a matter of bsdf_chi_square, with the same weights and
        densities."""

        def ask(wi, u):
            si = interaction(mi.Vector3f(wi))
            bs, weight = bsdf.sample(mi.BSDFContext(), si, mi.Float(u[2]), mi.Point2f(u[:2]), True)
            return bs.wo, weight, bs.pdf

        wo, weight, pdf = each(ask, wi, u)
        drawn = material.sample(wi, u)
        kept, same = pdf > 0, (abs(wo - drawn.wo) < 1e-3).all(axis=0)
        self.assertLess((kept & ~same | (kept != (drawn.density > 0))).mean(), 1e-3)
        kept &= same
        self.assertGreater(kept.mean(), 0.6)
        self.assertLess(np.quantile(abs(wo - drawn.wo)[:, kept], 0.999), 1e-5)
        for one, other in ((weight, drawn.weight), (pdf[None], drawn.density[None])):
            self.assertLess(np.quantile(abs(one[:, kept] / other[:, kept] - 1), 0.999), 1e-3)

    def test_conductors(self):
        table = vndf.load(TABLE)
        optics = dict(fresnel="conductor", **GOLD)
        self.compare(conductor(alpha_u=0.5, alpha_v=0.2), vndf.Material(vndf.Surface(table, 0.5, 0.2), **optics), False)
        turned = conductor(alpha_u=0.5, alpha_v=0.2, rotation=0.7, masking="separable")
        material = vndf.Material(vndf.Surface(table, 0.5, 0.2, rotation=0.7), masking="separable", **optics)
        self.compare(turned, material, False)

    def test_several_lobes(self):
        lobes = conductor(alpha=0.2, weight=0.7, distribution_2="ggx", alpha_u_2=0.6, alpha_v_2=0.3, weight_2=0.3)
        mixture = vndf.Mixture((vndf.Surface(vndf.load(TABLE), 0.2), 0.7), (vndf.Surface(vndf.ggx(), 0.6, 0.3), 0.3))
        self.compare(lobes, vndf.Material(mixture, fresnel="conductor", **GOLD), False)

    def test_dielectrics(self):
        glass = {"type": "vndf_dielectric", "distribution": TABLE, "int_ior": 1.5, "ext_ior": 1.0}
        glass.update(alpha_u=0.5, alpha_v=0.2)
        material = vndf.Material(vndf.Surface(vndf.load(TABLE), 0.5, 0.2), lobes="both", fresnel="dielectric", eta=1.5)
        # At the critical angle 1 - F has few digits in float.
        self.compare(glass, material, True, usual=3e-4, floor=1e-3)

    def test_textured_tails(self):
        """A family with a parameter at each hit is the library's mixture there."""
        family = vndf.Family.build("student-t", 2, 4, knots=3, max_bytes=2048)
        family.save("tails.vndfs")
        for p in (2.0, 2.3, 3.7):
            description = {**conductor(alpha=0.3, parameter=p), "distribution": "tails.vndfs"}
            self.compare(description, vndf.Material(family.at(p, 0.3), fresnel="conductor", **GOLD), False)
        texture = mi.Bitmap(np.float32([[[2.0], [2.6], [3.7]]]))
        bitmap = {"type": "bitmap", "bitmap": texture, "raw": True, "filter_type": "nearest"}
        bsdf = mi.load_dict({**conductor(alpha=0.3, parameter=bitmap), "distribution": "tails.vndfs"})
        wi, wo = np.float32([0.6, 0, 0.8]), np.float32([-0.36, 0.48, 0.8])
        for x, p in ((0.1, 2.0), (0.5, 2.6), (0.9, 3.7)):
            si = interaction(mi.Vector3f(wi))
            si.uv = mi.Point2f(x, 0.5)
            value = np.ravel(bsdf.eval(mi.BSDFContext(), si, mi.Vector3f(wo), True))
            expected = vndf.Material(family.at(p, 0.3), fresnel="conductor", **GOLD).eval(wi, wo) * wo[2]
            np.testing.assert_allclose(value, expected, rtol=1e-4)


class Mitsubas(unittest.TestCase):
    def test_parameters_have_mitsubas_names(self):
        """An optimiser that sets eta.value of `roughconductor` sets it here, and the value follows."""
        optics = {name: rgb(values) for name, values in GOLD.items()}
        theirs = mi.load_dict({"type": "roughconductor", "specular_reflectance": 0.9, **optics})
        ours = mi.load_dict(conductor(specular_reflectance=0.9))
        parameters = mi.traverse(ours)
        self.assertLessEqual(set(mi.traverse(theirs).keys()), set(parameters.keys()))
        wi, wo = mi.Vector3f(0.6, 0, 0.8), mi.Vector3f(-0.5, 0, 0.866)

        def value():
            return np.max(np.array(ours.eval(mi.BSDFContext(), interaction(wi), wo, True)))

        before = value()
        parameters["eta.value"] = mi.Color3f(1.5)
        parameters["k.value"] = mi.Color3f(0.1)
        parameters.update()
        self.assertLess(value(), 0.9 * before)

    def test_bad_parameters_are_named(self):
        for wrong, words in (
            (dict(distribution="nowhere.vndf"), "nowhere.vndf"),
            (dict(alpha=0.1, alpha_u=0.1, alpha_v=0.1), "one or the other"),
            (dict(alpha_u=0.1), "alpha_u needs alpha_v"),
            (dict(distribution_3="ggx"), "distribution_3 without distribution_2"),
            (dict(masking="cavities"), "height-correlated"),
        ):
            with self.assertRaisesRegex(Exception, words):
                mi.load_dict(conductor(**wrong))


@unittest.skipIf(SCALAR, "no derivatives")
class Derivatives(unittest.TestCase):
    def test_roughness(self):
        """d value / d alpha, for a thousand pairs of directions, is what differences say."""
        bsdf = mi.load_dict(conductor(alpha=0.35))
        rng = np.random.default_rng(4)
        wi, wo = (mi.Vector3f(directions(rng, 1000, 0.1)) for _ in range(2))
        parameters = mi.traverse(bsdf)

        def value(alpha):
            parameters["alpha.value"] = alpha
            parameters.update()
            return bsdf.eval(mi.BSDFContext(), interaction(wi), wo, True).x

        alpha = mi.Float(0.35)
        dr.enable_grad(alpha)
        answer = value(alpha)
        dr.set_grad(alpha, 1.0)
        dr.forward_to(answer)
        derivative, h = np.array(dr.grad(answer)), 0.01
        difference = (np.array(value(mi.Float(0.35 + h))) - np.array(value(mi.Float(0.35 - h)))) / (2 * h)
        scale = abs(difference).max()
        self.assertLess(np.quantile(abs(derivative - difference), 0.99), 0.01 * scale)
        self.assertGreater(np.corrcoef(derivative, difference)[0, 1], 0.9999)


if __name__ == "__main__":
    unittest.main()
