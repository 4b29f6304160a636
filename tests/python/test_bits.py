"""Every element of an array has the bits of the C call for that element alone."""
import ctypes
import os
import unittest

import numpy as np
import vndf
from common import COUNT, OTHER, TABLES, addresses, loop, random_inputs, single_calls


def distributions():
    return [vndf.ggx(), vndf.beckmann(), vndf.load(os.path.join(TABLES, "student-t-2.5.vndf"))]


class Bits(unittest.TestCase):
    def same(self, a, b, what):
        self.assertEqual(np.shape(a), np.shape(b), what)
        different = np.asarray(a).view(np.uint32) != np.asarray(b).view(np.uint32)
        self.assertEqual(different.sum(), 0, what)

    def compare(self, surface, inputs, results):
        for i, name in enumerate(OTHER):
            arguments = dict(ndf=[inputs["wm"]]).get(name, [inputs["wi"], inputs["wm"]] if i < 2 else [inputs["wi"]])
            self.same(getattr(surface, name)(*arguments), results["other"][i], name)
        drawn = surface.sample(inputs["wi"], inputs["u"][:2])
        self.same(drawn.wm, results["drawn"], "normals")
        self.same(drawn.pdf, results["pdf"], "their densities")
        self.same(surface.invert(inputs["wi"], inputs["wm"]), results["inverse"], "inverses")
        return drawn

    def test_surfaces(self):
        for seed, distribution in enumerate(distributions()):
            inputs = random_inputs(seed)
            struct, results = single_calls(inputs)
            loop("singles_surface", ctypes.c_void_p(distribution._pointer), ctypes.byref(struct))
            surface = vndf.Surface(distribution, *inputs["alpha"])
            self.compare(surface, inputs, results)
            weighted = surface.sample_weight(inputs["wi"], inputs["u"][:2])
            self.same(weighted.wm, results["drawn"], "normals")
            self.same(weighted.weight, results["weight"], "weights")

    def test_affine_surfaces(self):
        for seed, distribution in enumerate(distributions()):
            inputs = random_inputs(10 + seed)
            struct, results = single_calls(inputs)
            loop("singles_affine", ctypes.c_void_p(distribution._pointer), ctypes.byref(struct))
            surface = vndf.Affine(distribution, inputs["matrix"].reshape(2, 2, COUNT), inputs["mean"])
            self.compare(surface, inputs, results)

    def test_mixtures(self):
        for seed, distribution in enumerate(distributions()):
            inputs = random_inputs(20 + seed)
            weights = np.random.default_rng(seed).random((2, COUNT), dtype=np.float32)
            struct, results = single_calls(inputs)
            lobe = np.empty(COUNT, np.int32)
            loop(
                "singles_mixture", ctypes.c_void_p(distribution._pointer), ctypes.c_void_p(vndf.ggx()._pointer),
                addresses(weights), ctypes.byref(struct), ctypes.c_void_p(lobe.ctypes.data),
            )  # fmt: skip
            second = vndf.Affine(vndf.ggx(), inputs["matrix"].reshape(2, 2, COUNT), inputs["mean"])
            mixture = vndf.Mixture((vndf.Surface(distribution, *inputs["alpha"]), weights[0]), (second, weights[1]))
            self.same(self.compare(mixture, inputs, results).lobe, lobe, "lobes")

    def test_materials(self):
        sets = [
            dict(fresnel="conductor", eta=(0.2, 0.9, 1.1), k=(3.9, 2.4, 2.2)),
            dict(fresnel="dielectric", lobes="both", eta=1.5),
            dict(fresnel="schlick", f0=(0.9, 0.5, 0.1), rotation=0.0),
            dict(scattering="multiple"),
            dict(fresnel="schlick", f0=0.5, matrix=0),
        ]
        for seed, (distribution, effects) in enumerate((d, e) for d in distributions() for e in sets):
            inputs = random_inputs(30 + seed)
            angle = np.arctan2(inputs["mean"][1].astype(np.float64), inputs["mean"][0])
            if "rotation" in effects:
                effects = {**effects, "rotation": angle}
                inputs["mean"] = np.stack([np.cos(angle), np.sin(angle)]).astype(np.float32)
            if "matrix" in effects:
                effects = {**effects, "matrix": inputs["matrix"].reshape(2, 2, COUNT), "mean": inputs["mean"]}
            material = vndf.Material(distribution, *inputs["alpha"], **effects)
            struct, results = single_calls(inputs)
            wo, weight, value = (np.empty((3, COUNT), np.float32) for _ in range(3))
            density = np.empty(COUNT, np.float32)
            loop(
                "singles_bsdf", ctypes.byref(material._material), ctypes.byref(struct), addresses(wo),
                addresses(weight), ctypes.c_void_p(density.ctypes.data), addresses(value),
            )  # fmt: skip
            drawn = material.sample(inputs["wi"], inputs["u"])
            self.same(drawn.wo, wo, f"{effects}: directions")
            self.same(drawn.weight, weight, f"{effects}: weights")
            self.same(drawn.density, density, f"{effects}: densities of samples")
            values, pdf = material.eval_pdf(inputs["wi"], inputs["wm"], np.arange(COUNT))
            self.same(values, value, f"{effects}: values")
            self.same(pdf, results["pdf"], f"{effects}: densities")
            self.same(material.eval(inputs["wi"], inputs["wm"], np.arange(COUNT)), value, "values alone")
            self.same(material.pdf(inputs["wi"], inputs["wm"]), results["pdf"], "densities alone")

    def test_broadcasting(self):
        surface = vndf.Surface(distributions()[2], np.linspace(0.1, 1, 7)[:, None], 0.2)
        wi = np.array([[0.6, 0.0], [0.0, 0.8], [0.8, -0.6]])[:, None, None]  # (3, 1, 1, 2), in double
        u = np.random.default_rng(5).random((2, 11, 1, 1))
        wm, pdf, weight = surface.sample_weight(wi, u)
        self.assertEqual(wm.shape, (3, 11, 7, 2))
        for i, j, k in np.ndindex(11, 7, 2):
            one = vndf.Surface(surface.distribution, np.linspace(0.1, 1, 7)[j], 0.2)
            single = one.sample_weight(wi[:, 0, 0, k], u[:, i, 0, 0])
            self.same(single.wm, np.ascontiguousarray(wm[:, i, j, k]), "normal")
            self.assertEqual((single.pdf, single.weight), (pdf[i, j, k], weight[i, j, k]))


if __name__ == "__main__":
    unittest.main()
