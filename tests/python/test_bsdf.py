"""Materials do what vndf_bsdf.h says: estimators agree with integrals, for each effect that Python can choose."""
import os
import unittest

import numpy as np
import vndf

WI = np.array([0.6, 0.0, 0.8], np.float32)


def rings():
    return vndf.load(os.path.join(os.environ["VNDF_SOURCE"], "tables", "student-t-2.5.vndf"))


def sphere(count):
    """Midpoints over the sphere of directions, shape (3, n), and the solid angle of each."""
    z = np.repeat((np.arange(count) + 0.5) / count * 2 - 1, 2 * count)
    phi = np.tile((np.arange(2 * count) + 0.5) * np.pi / count, count)
    r = np.sqrt(1 - z * z)
    return np.stack([r * np.cos(phi), r * np.sin(phi), z]), 4 * np.pi / z.size


class Materials(unittest.TestCase):
    def test_samples_estimate_the_integral(self):
        """Weights have the mean of f cos, and densities the integral of what is not lost."""
        wo, solid_angle = sphere(400)
        for effects in (
            dict(fresnel="conductor", eta=(0.2, 0.9, 1.1), k=(3.9, 2.4, 2.2)),
            dict(fresnel="dielectric", lobes="both", eta=1.5),
            dict(fresnel="schlick", f0=(0.9, 0.5, 0.1, 0.3), normals="bounded"),
            dict(fresnel="schlick", f0=0.3, masking="separable", normals="all"),
            dict(reflection="retro", wavelengths=1, scattering="turquin"),
            dict(fresnel="dielectric", lobes="both", transport="importance", scattering="turquin"),
            dict(fresnel="schlick", f0=0.8, scattering="kulla-conty"),
        ):
            material = vndf.Material(vndf.Surface(rings(), 0.5, 0.3), **effects)
            value, pdf = material.eval_pdf(WI, wo)
            integral = (value * abs(wo[2])).sum(axis=1) * solid_angle
            self.assertEqual(value.shape[0], material.wavelengths)
            drawn = material.sample(WI, np.random.default_rng(2).random((3, 400000), dtype=np.float32))
            error = 5 * drawn.weight.std(axis=1) / np.sqrt(400000) + 1e-4
            estimate = drawn.weight.mean(axis=1)
            np.testing.assert_array_less(abs(estimate - integral), error + 2e-3 * integral, str(effects))
            self.assertAlmostEqual(pdf.sum() * solid_angle, (drawn.lobe != vndf.LOBE_NONE).mean(), 2, str(effects))

    def test_a_mixture_is_the_sum_of_its_lobes(self):
        lobes = [(vndf.Surface(rings(), 0.2), 0.7), (vndf.Surface(vndf.ggx(), 0.5, 0.3, rotation=0.4), 0.3)]
        mixture = vndf.Mixture(*lobes)
        wo, _ = sphere(20)
        wo = wo[:, wo[2] > 0.05]
        wm = WI[:, None] + wo
        wm /= np.linalg.norm(wm, axis=0)
        d = sum(weight * surface.ndf(wm) for surface, weight in lobes)
        area = [sum(weight * surface.projected_area(w) for surface, weight in lobes) for w in (WI, wo)]
        g2 = 1 / (area[0] / WI[2] + area[1] / wo[2] - 1)
        expected = d * g2 / (4 * WI[2] * wo[2])
        np.testing.assert_allclose(vndf.Material(mixture).eval(WI, wo)[0], expected, rtol=2e-4)
        np.testing.assert_allclose(mixture.ndf(wm), d, rtol=1e-4)

    def test_a_rotation_turns_to_the_left(self):
        """Roughness 0.5 along the direction at 0.4 from x: the surface answers for turned directions what the upright
        one does, and so does its material."""
        upright, turned = vndf.Surface(rings(), 0.5, 0.2), vndf.Surface(rings(), 0.5, 0.2, rotation=0.4)
        back = np.array([[np.cos(0.4), np.sin(0.4), 0], [-np.sin(0.4), np.cos(0.4), 0], [0, 0, 1]])
        wo, wm = np.array([-0.48, 0.64, 0.6]), np.array([0.1, 0.3, 0.9]) / 0.91**0.5
        np.testing.assert_allclose(turned.visible(WI, wm), upright.visible(back @ WI, back @ wm), rtol=1e-4)
        one, other = vndf.Material(turned), vndf.Material(upright)
        np.testing.assert_allclose(one.eval(WI, wo), other.eval(back @ WI, back @ wo), rtol=1e-4)

    def test_g2_is_that_of_the_heights(self):
        surface = vndf.Surface(rings(), 0.5)
        wo = np.array([[0.5, 0.0], [0.5, 0.0], [0.70710678, -1.0]])
        one, other = surface.lambda_(WI), surface.lambda_(wo[:, 0])
        self.assertAlmostEqual(surface.g2(WI, wo)[0], 1 / (1 + one + other), 6)
        self.assertAlmostEqual(surface.g2(WI, wo, "separable")[0], 1 / ((1 + one) * (1 + other)), 6)
        self.assertEqual(surface.g2(WI, wo)[1], 0)


if __name__ == "__main__":
    unittest.main()
