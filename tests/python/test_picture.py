"""The example makes its picture, and the plots theirs; what is drawn is what the library says."""
import os
import subprocess
import sys
import unittest

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
except ImportError:
    print("SKIPPED: no matplotlib")
    sys.exit(0)

import numpy as np
import vndf


class Pictures(unittest.TestCase):
    def test_the_example(self):
        example = os.path.join(os.environ["VNDF_SOURCE"], "tools", "python", "examples", "picture.py")
        subprocess.run([sys.executable, example, "sphere.png", "48", "8"], check=True, env={**os.environ, "MPLBACKEND": "Agg"})
        picture = plt.imread("sphere.png")
        self.assertEqual(picture.shape[:2], (48, 48))
        middle = picture[18:30, 18:30, :3].mean(axis=(0, 1))  # gold: less blue than red
        self.assertGreater(middle[0], 1.2 * middle[2])
        self.assertGreater(middle[2], 0.02)

    def test_a_plot_of_densities(self):
        axes = vndf.plot.ndf([vndf.ggx(), vndf.beckmann()], 0.3)
        theta, values = axes.lines[0].get_data()
        expected = vndf.Surface(vndf.ggx(), 0.3).ndf((0, np.sin(np.radians(theta[100])), np.cos(np.radians(theta[100]))))
        self.assertAlmostEqual(values[100] / expected, 1, 4)
        plt.close(axes.figure)

    def test_a_plot_of_visible_normals(self):
        for theta in (0, 60, 120):
            axes = vndf.plot.visible(vndf.Surface(vndf.ggx(), 0.5), theta, samples=50)
            image = axes.images[0].get_array()
            pixel = 2 / 400  # the disc of radius 1 has the area of half a turn: sin(angle/2) times root 2
            self.assertAlmostEqual(np.nansum(image) * 2 * pixel * pixel, 1, 1)
            self.assertEqual(len(axes.lines[0].get_xdata()), 50)
            plt.close(axes.figure)


if __name__ == "__main__":
    unittest.main()
