"""The example makes its picture of a sphere of gold."""
import os
import subprocess
import sys

try:
    import matplotlib.pyplot as plt
except ImportError:
    print("SKIPPED: no matplotlib")
    sys.exit(0)

example = os.path.join(os.environ["VNDF_SOURCE"], "tools", "python", "examples", "picture.py")
subprocess.run([sys.executable, example, "sphere.png", "48", "8"], check=True, env={**os.environ, "MPLBACKEND": "Agg"})
picture = plt.imread("sphere.png")
middle = picture[18:30, 18:30, :3].mean(axis=(0, 1))  # gold: less blue than red
assert picture.shape[:2] == (48, 48) and middle[0] > 1.2 * middle[2] > 0.02, middle
