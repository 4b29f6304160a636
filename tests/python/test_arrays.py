"""Arrays that C can read in place are not copied; shapes are those of numpy; the interpreter's lock is free."""
import os
import threading
import time
import unittest

import numpy as np
import vndf
from vndf._arrays import Batch, components, stacked


class Places(unittest.TestCase):
    def test_no_copy_of_what_is_contiguous(self):
        wi = np.zeros((3, 4, 5), np.float32)
        self.assertEqual(Batch(wi=components(wi, 3, "wi")).addresses("wi"), [wi[i].ctypes.data for i in range(3)])

    def test_a_copy_of_everything_else(self):
        for wi in (np.zeros((5, 3), np.float32).T, np.zeros((3, 5)), np.zeros((3, 10), np.float32)[:, ::2]):
            batch = Batch(wi=components(wi, 3, "wi"))
            self.assertNotEqual(batch.addresses("wi")[0], wi.ctypes.data)

    def test_one_number_for_all_is_not_repeated(self):
        batch = Batch(wi=components((0.0, 0.6, 0.8), 3, "wi"), u=components(np.zeros((2, 9)), 2, "u"))
        self.assertTrue(batch.is_shared("wi") and not batch.is_shared("u"))
        self.assertEqual(np.diff(batch.addresses("wi", share=True)).tolist(), [4, 4])
        self.assertEqual(np.diff(batch.addresses("wi")).tolist(), [36, 36])

    def test_components_of_several_shapes(self):
        x = np.arange(4.0)
        np.testing.assert_array_equal(components((x, 0.0, x[:1]), 3, "wi"), [x, 0 * x, 0 * x])
        with self.assertRaises(ValueError):
            stacked("ggx")

    def test_results_of_a_number_are_numbers(self):
        self.assertEqual(np.shape(vndf.Surface(vndf.ggx(), 0.5).g1((0.0, 0.6, 0.8))), ())
        self.assertEqual(vndf.Surface(vndf.ggx(), 0.5).sample((0.0, 0.6, 0.8), (0.5, 0.5)).wm.shape, (3,))

    def test_empty_arrays(self):
        wm, pdf = vndf.Surface(vndf.ggx(), 0.5).sample(np.zeros((3, 0)), np.zeros((2, 0)))
        self.assertEqual((wm.shape, pdf.shape), ((3, 0), (0,)))
        drawn = vndf.Material(vndf.Surface(vndf.ggx(), 0.5)).sample(np.zeros((3, 0)), np.zeros((3, 0)))
        self.assertEqual(drawn.weight.shape, (3, 0))

    def test_a_generator_draws_the_numbers(self):
        """In place of u, for one sample an element, the same as by hand."""
        surface = vndf.Surface(vndf.ggx(), np.array([0.2, 0.5]))
        for of, count in ((surface, 2), (vndf.Material(surface), 3)):
            drawn = of.sample((0.0, 0.6, 0.8), np.random.default_rng(7))[0]
            u = np.random.default_rng(7).random((count, 2), dtype=np.float32)
            np.testing.assert_array_equal(drawn, of.sample((0.0, 0.6, 0.8), u)[0])

    def test_each_shape_says_what_it_is(self):
        lobes = vndf.Mixture((vndf.Surface(vndf.ggx(), 0.3), 1), (vndf.Surface(vndf.ggx(), matrix=np.ones((2, 2, 9))), 2))
        for word in ("ggx", "0.3", "array(9,)", "vndf.Mixture"):
            self.assertIn(word, repr(lobes))
        said = repr(vndf.Material(vndf.Surface(vndf.ggx(), 0.4), scattering="multiple"))
        self.assertIn("alpha 0.4, 0.4>, scattering='multiple'", said)

    def test_wrong_shapes_are_named(self):
        surface = vndf.Surface(vndf.ggx(), 0.5)
        for wi, u, words in (
            (np.zeros((4, 3)), np.zeros((2, 4)), "wi: its first axis has length 4, it must have 3"),
            ((0, 0, 1), 0.5, "u: its first axis has length 0"),
            (np.zeros((3, 4)), np.zeros((2, 5)), "do not broadcast"),
        ):
            with self.assertRaisesRegex(ValueError, words):
                surface.sample(wi, u)
        with self.assertRaisesRegex(ValueError, "matrix"):
            vndf.Surface(vndf.ggx(), matrix=0.5)

    def test_numbers_of_float64_are_rounded(self):
        self.assertEqual(stacked(0.1), np.float32(0.1))

    def test_memory_of_a_shape_lives_as_long_as_the_call(self):
        surface = vndf.Surface(vndf.ggx(), np.full(1000, 0.5), np.full(1000, 0.25))
        first = surface.ndf(np.array([0, 0, 1.0])[:, None])
        self.assertTrue((first == first[0]).all())


class Lock(unittest.TestCase):
    def test_other_threads_run_while_c_works(self):
        surface = vndf.Surface(vndf.load(os.path.join(os.environ["VNDF_SOURCE"], "tables", "student-t-2.5.vndf")), 0.3)
        wi = np.array([0.6, 0.0, -0.8], np.float32)  # below the horizon: one after the other, for long
        u = np.random.default_rng(1).random((2, 2000000), dtype=np.float32)
        for attempt in range(5):  # on a busy machine this thread may have to wait for a processor
            took = []

            def work():
                begin = time.perf_counter()
                surface.sample(wi, u)
                took.append(time.perf_counter() - begin)

            worker = threading.Thread(target=work)
            worker.start()
            longest, last = 0.0, time.perf_counter()
            while worker.is_alive():
                now = time.perf_counter()
                longest, last = max(longest, now - last), now
            if longest < 0.5 * took[0]:
                return
        self.fail(f"nothing ran for {longest:.3f} s of {took[0]:.3f} s in C")


if __name__ == "__main__":
    unittest.main()
