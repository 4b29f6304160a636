"""Arrays that C can read in place are not copied; shapes are those of numpy; the interpreter's lock is free."""
import os
import threading
import time
import unittest

import numpy as np
import vndf
from vndf._arrays import Batch, components


class Places(unittest.TestCase):
    def test_a_copy_of_all_but_what_is_contiguous(self):
        wi = np.zeros((3, 4, 5), np.float32)
        self.assertEqual(Batch(wi=components(wi, 3, "wi")).addresses("wi"), [wi[i].ctypes.data for i in range(3)])
        for wi in (np.zeros((5, 3), np.float32).T, np.zeros((3, 5)), np.zeros((3, 10), np.float32)[:, ::2]):
            self.assertNotEqual(Batch(wi=components(wi, 3, "wi")).addresses("wi")[0], wi.ctypes.data)

    def test_one_number_for_all_is_not_repeated(self):
        batch = Batch(wi=components((0.0, 0.6, 0.8), 3, "wi"), u=components(np.zeros((2, 9)), 2, "u"))
        self.assertTrue(batch.is_shared("wi") and not batch.is_shared("u"))
        self.assertEqual(np.diff(batch.addresses("wi", share=True)).tolist(), [4, 4])
        self.assertEqual(np.diff(batch.addresses("wi")).tolist(), [36, 36])

    def test_results_of_a_number_and_of_nothing(self):
        surface = vndf.Surface(vndf.ggx(), 0.5)
        for shape in ((), (0,), (2, 1)):
            wm, pdf = surface.sample(np.ones((3, *shape)), np.zeros((2, *shape)))
            self.assertEqual((wm.shape, np.shape(pdf)), ((3, *shape), shape))
            drawn = vndf.Material(surface).sample(np.ones((3, *shape)), np.zeros((3, *shape)))
            self.assertEqual((drawn.weight.shape, np.shape(drawn.lobe)), ((3, *shape), shape))

    def test_a_generator_draws_the_numbers(self):
        """In place of u, for one sample an element, the same as by hand."""
        surface = vndf.Surface(vndf.ggx(), np.array([0.2, 0.5]))
        for of, count in ((surface, 2), (vndf.Material(surface), 3)):
            drawn = of.sample((0.0, 0.6, 0.8), np.random.default_rng(7))[0]
            u = np.random.default_rng(7).random((count, 2), dtype=np.float32)
            np.testing.assert_array_equal(drawn, of.sample((0.0, 0.6, 0.8), u)[0])

    def test_each_shape_says_what_it_is(self):
        sheared = vndf.Surface(vndf.ggx(), matrix=np.ones((2, 2, 9)))
        lobes = vndf.Mixture((vndf.Surface(vndf.ggx(), 0.3), 1), (sheared, 2))
        for word in ("ggx", "0.3", "array(9,)", "vndf.Mixture"):
            self.assertIn(word, repr(lobes))
        said = repr(vndf.Material(vndf.Surface(vndf.ggx(), 0.4), scattering="multiple"))
        self.assertIn("alpha 0.4, 0.4>, scattering='multiple'", said)

    def test_wrong_shapes_are_named(self):
        surface = vndf.Surface(vndf.ggx(), 0.5)
        for wi, u, words in (
            (np.zeros((4, 3)), np.zeros((2, 4)), "wi: its first axis has length 4, it must have 3"),
            ((0, 0, 1), 0.5, "u: its first axis has length 0"),
            ((0, 0, 1), (0.5, 1.5), r"u: its numbers must lie in \[0, 1\]"),
            (np.zeros((3, 4)), np.zeros((2, 5)), "do not broadcast"),
        ):
            with self.assertRaisesRegex(ValueError, words):
                surface.sample(wi, u)
        with self.assertRaisesRegex(ValueError, "matrix"):
            vndf.Surface(vndf.ggx(), matrix=0.5)


class Lock(unittest.TestCase):
    def test_other_threads_run_while_c_works(self):
        """Otherwise this one would wait for all of the 2 million samples."""
        surface = vndf.Surface(vndf.load(os.path.join(os.environ["VNDF_SOURCE"], "tables", "student-t-2.5.vndf")), 0.3)
        u = np.random.default_rng(1).random((2, 2000000), dtype=np.float32)
        worker = threading.Thread(target=lambda: surface.sample((0.6, 0.0, -0.8), u))
        worker.start()
        rounds = 0
        while worker.is_alive():
            time.sleep(1e-3)
            rounds += 1
        self.assertGreater(rounds, 10)


if __name__ == "__main__":
    unittest.main()
