"""The example makes its picture."""
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


class Pictures(unittest.TestCase):
    def test_the_example(self):
        example = os.path.join(os.environ["VNDF_SOURCE"], "tools", "python", "examples", "picture.py")
        subprocess.run([sys.executable, example, "sphere.png", "48", "8"], check=True, env={**os.environ, "MPLBACKEND": "Agg"})
        picture = plt.imread("sphere.png")
        self.assertEqual(picture.shape[:2], (48, 48))
        middle = picture[18:30, 18:30, :3].mean(axis=(0, 1))  # gold: less blue than red
        self.assertGreater(middle[0], 1.2 * middle[2])
        self.assertGreater(middle[2], 0.02)


if __name__ == "__main__":
    unittest.main()
