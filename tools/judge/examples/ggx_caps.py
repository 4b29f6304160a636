"""Visible normals of GGX by spherical caps (Dupuy & Benyoub 2023), for `vndf judge 'python3 ggx_caps.py AX AY'`."""
import sys
from math import cos, pi, sin, sqrt

ax = float(sys.argv[1]) if len(sys.argv) > 1 else 0.3
ay = float(sys.argv[2]) if len(sys.argv) > 2 else ax


def pdf(wi, wm):
    """D(wm) max(0, wi.wm)/A(wi), A = (cos(theta) + |(ax wi.x, ay wi.y, wi.z)|)/2."""
    facing = wi[0] * wm[0] + wi[1] * wm[1] + wi[2] * wm[2]
    if facing <= 0 or wm[2] <= 0:
        return 0.0
    q = (wm[0] / ax) ** 2 + (wm[1] / ay) ** 2 + wm[2] ** 2
    area = (wi[2] + sqrt((ax * wi[0]) ** 2 + (ay * wi[1]) ** 2 + wi[2] ** 2)) / 2
    return facing / (pi * ax * ay * q * q * area)


def sample(wi, u):
    """wi is stretched to the hemisphere; the normal is half way between it and a point of its cap."""
    x, y = ax * wi[0], ay * wi[1]
    length = sqrt(x * x + y * y + wi[2] ** 2)
    z = 1 - u[1] * (1 + wi[2] / length)
    s, phi = sqrt(max(0.0, 1 - z * z)), 2 * pi * u[0]
    m = ax * (s * cos(phi) + x / length), ay * (s * sin(phi) + y / length), z + wi[2] / length
    norm = sqrt(m[0] ** 2 + m[1] ** 2 + m[2] ** 2)
    return m[0] / norm, m[1] / norm, m[2] / norm


for line in sys.stdin:
    kind, *number = line.split()
    number = [float(word) for word in number]
    wi, x = number[:3], number[3:]
    if kind == "s":
        wm = sample(wi, x)
        print(*wm, pdf(wi, wm))
    else:
        print(pdf(wi, x))
