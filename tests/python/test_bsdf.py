"""Materials have the effects, numbers and surfaces that they are given. (What those do: bsdf_values, albedo.)"""
import os
import unittest

import numpy as np
import vndf

WI, WO = np.array([0.6, 0.0, 0.8], np.float32), np.array([-0.48, 0.64, 0.6], np.float32)


def rings():
    return vndf.load(os.path.join(os.environ["VNDF_SOURCE"], "tables", "student-t-2.5.vndf"))


class Materials(unittest.TestCase):
    def test_each_term_of_fresnel_is_the_one_named(self):
        """By the half vector's cosine, over the value of a white mirror."""
        c = 0.5**0.5 * np.sqrt(1 + WI @ WO)

        def books(m):
            t = np.sqrt(1 - (1 - c * c) / (m * m))
            return (abs((c - m * t) / (c + m * t)) ** 2 + abs((m * c - t) / (m * c + t)) ** 2) / 2

        white = vndf.Material(vndf.Surface(rings(), 0.5, 0.3)).eval(WI, WO)[0]
        for effects, terms in (
            (dict(fresnel="schlick", f0=(0.9, 0.5)), [f + (1 - f) * (1 - c) ** 5 for f in (0.9, 0.5)]),
            (dict(fresnel="dielectric", eta=1.5), [books(1.5)]),
            (dict(fresnel="conductor", eta=(0.2, 0.9), k=(3.9, 2.4)), [books(0.2 + 3.9j), books(0.9 + 2.4j)]),
        ):
            value = vndf.Material(vndf.Surface(rings(), 0.5, 0.3), **effects).eval(WI, WO)
            np.testing.assert_allclose(value[: len(terms)] / white, terms, rtol=1e-4, err_msg=str(effects))

    def test_compensation_keeps_all_light(self):
        u = np.random.default_rng(2).random((3, 100000), dtype=np.float32)
        for way, kept in (("single", 0.35), ("turquin", 1), ("kulla-conty", 1)):
            drawn = vndf.Material(vndf.Surface(vndf.ggx(), 1), scattering=way).sample(WI, u)
            self.assertAlmostEqual(drawn.weight[0].mean(), kept, msg=way, delta=0.01)

    def test_a_mixture_is_the_sum_of_its_lobes(self):
        lobes = [(vndf.Surface(rings(), 0.2), 0.7), (vndf.Surface(vndf.ggx(), 0.5, 0.3, rotation=0.4), 0.3)]
        mixture = vndf.Mixture(*lobes)
        wm = (WI + WO) / np.linalg.norm(WI + WO)
        d = sum(weight * surface.ndf(wm) for surface, weight in lobes)
        area = [sum(weight * surface.projected_area(w) for surface, weight in lobes) for w in (WI, WO)]
        g2 = 1 / (area[0] / WI[2] + area[1] / WO[2] - 1)
        expected = d * g2 / (4 * WI[2] * WO[2])
        np.testing.assert_allclose(vndf.Material(mixture).eval(WI, WO)[0], expected, rtol=2e-4)
        np.testing.assert_allclose(mixture.ndf(wm), d, rtol=1e-4)

    def test_a_rotation_turns_to_the_left(self):
        """Roughness 0.5 along the direction at 0.4 from x: the surface answers for turned directions what the upright
        one does, and so does its material."""
        upright, turned = vndf.Surface(rings(), 0.5, 0.2), vndf.Surface(rings(), 0.5, 0.2, rotation=0.4)
        back = np.array([[np.cos(0.4), np.sin(0.4), 0], [-np.sin(0.4), np.cos(0.4), 0], [0, 0, 1]])
        wm = np.array([0.1, 0.3, 0.9]) / 0.91**0.5
        np.testing.assert_allclose(turned.visible(WI, wm), upright.visible(back @ WI, back @ wm), rtol=1e-4)
        one, other = vndf.Material(turned), vndf.Material(upright)
        np.testing.assert_allclose(one.eval(WI, WO), other.eval(back @ WI, back @ WO), rtol=1e-4)

    def test_g2_is_that_of_the_heights(self):
        surface = vndf.Surface(rings(), 0.5)
        wo = np.array([[0.5, 0.0], [0.5, 0.0], [0.70710678, -1.0]])
        one, other = surface.lambda_(WI), surface.lambda_(wo[:, 0])
        self.assertAlmostEqual(surface.g2(WI, wo)[0], 1 / (1 + one + other), 6)
        self.assertAlmostEqual(surface.g2(WI, wo, "separable")[0], 1 / ((1 + one) * (1 + other)), 6)
        self.assertEqual(surface.g2(WI, wo)[1], 0)


if __name__ == "__main__":
    unittest.main()
