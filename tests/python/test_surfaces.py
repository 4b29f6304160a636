"""What surfaces answer is what their slopes say: closed forms of GGX stretched by any matrix, identities between the
calls of every distribution, and the same bits for an element of an array as for that element alone."""
import os
import unittest

import numpy as np
import vndf

COUNT = 3001
TABLE = os.path.join(os.environ["VNDF_SOURCE"], "tables", "student-t-2.5.vndf")


def directions(rng, count=COUNT):
    w = rng.normal(size=(3, count))
    return (w / np.linalg.norm(w, axis=0)).astype(np.float32)


def shapes(rng):
    """An upright matrix, as roughness, and a general one with a mean slope, for every element."""
    x, y = np.exp(rng.uniform(-3, 0, (2, COUNT)))
    matrix = rng.uniform(-0.5, 0.5, (2, 2, COUNT)) + 0.6 * np.eye(2)[:, :, None]
    return ((x, 0 * x), (0 * x, y)), (0 * x, 0 * x), (matrix, 0.3 * rng.normal(size=(2, COUNT)))


def upright_and_general(distribution, rng):
    """Surfaces, with their matrices and mean slopes in double."""
    diagonal, none, general = shapes(rng)
    x, y = diagonal[0][0], diagonal[1][1]
    yield vndf.Surface(distribution, x, y), np.array(diagonal), np.array(none)
    yield vndf.Surface(distribution, matrix=general[0], mean=general[1]), *general


class Surfaces(unittest.TestCase):
    def test_ggx_is_its_closed_form(self):
        """D, area, Lambda, G1 and visible normals of slopes M u + mean, where u has the density 1/(pi (1 + u^2)^2): an
        argument in the wrong place would show."""
        rng = np.random.default_rng(1)
        for surface, m, mean in upright_and_general(vndf.ggx(), rng):
            w, wm = directions(rng), directions(rng)
            wm[2] = abs(wm[2]) + 0.05
            wm /= np.linalg.norm(wm, axis=0)
            slope = -wm[:2].astype(np.float64) / wm[2] - mean
            u = np.einsum("ijn,jn->in", np.linalg.inv(m.transpose(2, 0, 1)).transpose(1, 2, 0), slope)
            determinant = abs(m[0, 0] * m[1, 1] - m[0, 1] * m[1, 0])
            d = 1 / (np.pi * (1 + (u * u).sum(0)) ** 2 * determinant * wm[2].astype(np.float64) ** 4)
            along = np.einsum("ijn,in->jn", m, w[:2])
            cosine = w[2] - (w[:2] * mean).sum(0)
            reach = np.hypot(cosine, np.hypot(*along))
            area = np.where(cosine > 0, (reach + cosine) / 2, (along**2).sum(0) / (2 * (reach - cosine)))
            np.testing.assert_allclose(surface.ndf(wm), d, rtol=1e-3)
            np.testing.assert_allclose(surface.projected_area(w), area, rtol=1e-3)
            seen = np.maximum((w * wm).sum(0), 0) * d / area
            off = abs(surface.visible(w, wm) - seen) / (seen + 1e-3)
            self.assertLess(np.quantile(off, 0.99), 1e-4)
            np.testing.assert_allclose(surface.pdf(w, wm), surface.visible(w, wm), rtol=1e-3, atol=1e-3)
            u = rng.random((2, COUNT), dtype=np.float32)
            drawn, weighed = surface.sample(w, u), surface.sample_weight(w, u)
            again = surface.sample(w, surface.invert(w, drawn.wm)).wm
            self.assertLess(np.quantile(abs(again - drawn.wm), 0.98), 1e-3)
            self.assertLess(np.quantile(abs(surface.pdf(w, drawn.wm) / weighed.pdf - 1), 0.98), 1e-3)
            self.assertLess(abs(weighed.weight - 1).max(), 1e-5)
            up = (cosine > 0.1) & (w[2] > 0.1)
            np.testing.assert_allclose(surface.lambda_(w)[up], (area / cosine - 1)[up], rtol=1e-2, atol=1e-4)
            np.testing.assert_allclose(surface.g1(w)[up], (cosine / area)[up], rtol=1e-4)

    def test_mixtures_are_sums(self):
        """With one weight for each element; the lobe that is told is drawn as often as it is seen."""
        rng = np.random.default_rng(20)
        weights = rng.uniform(0.1, 1, (2, COUNT))
        one = next(upright_and_general(vndf.load(TABLE), rng))[0]
        other = list(upright_and_general(vndf.ggx(), rng))[1][0]
        mixture = vndf.Mixture((one, weights[0]), (other, weights[1]))
        wi, u = directions(rng), rng.random((2, COUNT), dtype=np.float32)
        wi[2] = abs(wi[2])
        wm, pdf, lobe = mixture.sample(wi, u)
        share = weights / weights.sum(0) * [one.projected_area(wi), other.projected_area(wi)]
        np.testing.assert_allclose(mixture.projected_area(wi), share.sum(0), rtol=1e-4)
        share /= share.sum(0)
        self.assertLess(abs((lobe == 1).sum() - share[1].sum()), 5 * np.sqrt((share[0] * share[1]).sum()))
        density = share[0] * one.pdf(wi, wm) + share[1] * other.pdf(wi, wm)
        for value in (pdf, mixture.pdf(wi, wm)):
            self.assertLess(np.quantile(abs(value / density - 1), 0.99), 1e-3)

    def same(self, a, b):
        self.assertEqual(np.asarray(a).tobytes(), np.ascontiguousarray(b).tobytes())

    def test_results_have_the_shape_of_all(self):
        surface = vndf.Surface(vndf.ggx(), np.linspace(0.1, 1, 7)[:, None], 0.2)
        wi = np.array([[0.6, 0.0], [0.0, 0.8], [0.8, -0.6]])[:, None, None]  # (3, 1, 1, 2), in double
        wm, pdf, _ = surface.sample_weight(wi, u := np.random.default_rng(5).random((2, 11, 1, 1)))
        self.assertEqual((wm.shape, pdf.shape), ((3, 11, 7, 2), (11, 7, 2)))
        one = vndf.Surface(vndf.ggx(), np.linspace(0.1, 1, 7)[4], 0.2)
        self.same(one.sample(wi[:, 0, 0, 1], u[:, 8, 0, 0]).wm, wm[:, 8, 4, 1])

    def test_a_hit_has_the_bits_of_itself_alone(self):
        rng = np.random.default_rng(6)
        (matrix, mean), wi, wo = shapes(rng)[2], directions(rng), directions(rng)
        alpha, angle, u = np.exp(rng.uniform(-3, 0, (2, COUNT))), rng.random(COUNT), rng.random((3, COUNT))
        glass = dict(fresnel="dielectric", lobes="both", eta=1.5)
        table = vndf.load(TABLE)
        for arrays, effects in (
            (dict(alpha=alpha[0], alpha_y=alpha[1]), glass),
            (dict(alpha=alpha[0], alpha_y=alpha[1], rotation=angle), dict(fresnel="schlick", f0=(0.9, 0.5, 0.1))),
            (dict(alpha=alpha[0]), dict(scattering="multiple")),
            (dict(matrix=matrix, mean=mean), dict(fresnel="schlick", f0=0.5)),
        ):
            material = vndf.Material(vndf.Surface(table, **arrays), **effects)
            drawn, (value, pdf) = material.sample(wi, u), material.eval_pdf(wi, wo, np.arange(COUNT))
            for i in range(0, COUNT, 500):
                alone = {name: array[..., i] for name, array in arrays.items()}
                one = vndf.Material(vndf.Surface(table, **alone), **effects)
                for whole, single in zip(drawn, one.sample(wi[:, i], u[:, i])):
                    self.same(single, whole[..., i])
                self.same(one.eval(wi[:, i], wo[:, i], i), value[:, i])
                self.same(one.pdf(wi[:, i], wo[:, i]), pdf[i])


if __name__ == "__main__":
    unittest.main()
