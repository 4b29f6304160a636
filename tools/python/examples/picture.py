"""From an array to a picture: numbers of a D, its table, and a sphere of gold with that roughness under a sky.

    python picture.py sphere.png [WIDTH [SAMPLES]]
"""
import sys

import matplotlib.pyplot as plt
import numpy as np

import vndf

if len(sys.argv) < 2:
    sys.exit(__doc__)
path = sys.argv[1]
width = int(sys.argv[2]) if len(sys.argv) > 2 else 400
samples = int(sys.argv[3]) if len(sys.argv) > 3 else 64

# Any numbers will do: here 200 slopes, and a density of slopes with rings.
slope = np.linspace(0.0, 6.0, 200)
table = vndf.build(vndf.Source.rows(slope=slope, p22=np.exp(-3 * slope) * (1 + 0.8 * np.cos(6 * slope))))
print(table, "total variation", table.certificate.tv)
gold = vndf.Material(vndf.Surface(table, 0.3), fresnel="conductor", eta=(0.14, 0.37, 1.44), k=(3.98, 2.39, 1.60))


def sky(w):
    """Radiance from the direction w (3, n): blue above, brown below, a sun and a window; shape (3, n)."""
    up = np.clip(0.5 + 4 * w[1], 0, 1)
    ground, blue = np.array([[0.12], [0.09], [0.07]]), np.array([[0.4], [0.45], [0.55]])
    sun = 12 * (w[0] * 0.5 + w[1] * 0.7 + w[2] * 0.5 > 0.97)
    window = 4 * ((abs(w[0] + 0.7 * w[2]) < 0.25) & (abs(w[1] - 0.2 * w[2]) < 0.3) & (w[2] > 0.5))
    return ground * (1 - up) + blue * up + sun + window


# The camera looks along -z; n is the normal of the sphere where a pixel sees it, t and b complete a frame.
x, y = np.meshgrid(np.linspace(-1.1, 1.1, width), np.linspace(1.1, -1.1, width))
inside = x * x + y * y < 0.999
n = np.stack([x[inside], y[inside], np.sqrt(1 - x[inside] ** 2 - y[inside] ** 2)])
t = np.stack([n[2], 0 * n[2], -n[0]]) / np.hypot(n[0], n[2])
b = np.cross(n, t, axis=0)
wi = np.stack([t[2], b[2], n[2]]).astype(np.float32)  # the direction to the camera, in the local frame

rng = np.random.default_rng(1)
light = np.zeros_like(n)
for _ in range(samples):
    s = gold.sample(wi, rng.random(wi.shape, dtype=np.float32))
    light += s.weight * sky(t * s.wo[0] + b * s.wo[1] + n * s.wo[2])

picture = sky(np.stack([x, y, -np.ones_like(x)]).reshape(3, -1) / np.sqrt(x * x + y * y + 1).ravel())
picture[:, inside.ravel()] = light / samples
plt.imsave(path, np.clip(picture.T.reshape(width, width, 3), 0, 1) ** (1 / 2.2))
