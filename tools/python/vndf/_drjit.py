"""Visible normals in Dr.Jit: the library's kernel as `vndf_write_kernel` prints it (_kernel.py, which the build makes),
for directions above the horizon. It runs wherever Mitsuba's variants run, one value at a time (scalar), on LLVM or
CUDA, and is differentiable: samples and densities are piecewise smooth functions of direction and roughness."""
from __future__ import annotations

from typing import Any

import drjit as dr
import mitsuba as mi

from . import _kernel as kernel
from .distribution import Distribution, load


class Lobe:
    """A surface of the kernel: a law with a matrix. `turn`: sine and cosine of the angle of its axes, None for 0."""

    def __init__(self, law: Any, x: Any, y: Any, turn: Any) -> None:
        x, y = x * law.scale, y * law.scale
        s, c = turn or (0.0, 1.0)
        matrix = (x, 0.0, 0.0, y) if turn is None else (c * x, -s * y, s * x, c * y)
        self._law, self._map = law, kernel.vndf_affine_map(*matrix, 0.0, 0.0, int(turn is None), x * y)

    def place(self, w: Any) -> Any:
        """The kernel asks this of a surface."""
        return kernel.vndf_placed(self._law.kind, self._law, kernel.vndf_frame_of(self._map, w.x, w.y, mi.Float(w.z)))


def _raised(w: Any) -> Any:
    return mi.Vector3f(w.x, w.y, dr.maximum(w.z, 0.0))


class Microfacets:
    """The normals of a surface, of one lobe or several. Each is a law, its roughness along two axes that are turned by an
    angle, whose sine and cosine are `turn` (None: 0), and a weight; weights sum to 1."""

    def __init__(self, lobes: list[tuple[Any, Any, Any, Any]], turn: Any = None) -> None:
        self._lobes = [(Lobe(law, x, y, turn), weight) for law, x, y, weight in lobes]

    def view(self, wi: Any) -> tuple[Any, Any]:
        """The mixture as wi, wi.z >= 0, sees it, and its projected area."""
        views, weights = zip(*((kernel.vndf_view_from(lobe, _raised(wi)), weight) for lobe, weight in self._lobes))
        numbers = (kernel.vndf_lobe_numbers([*of]) for of in (weights, map(kernel.vndf_drawn_area, views)))
        seen = kernel.vndf_mixture_view(len(views), views, None, kernel.vndf_lobe_shares(*numbers, len(views)))
        return seen, sum(weight * kernel.vndf_area(view) for view, weight in zip(views, weights))

    def sample_from(self, seen: Any, u1: Any, u2: Any) -> tuple[Any, Any]:
        """A visible normal, and the density of all lobes together. Every lobe draws one: lanes want any of them."""
        if seen.count == 1:
            drawn = kernel.vndf_sample(seen.lobe[0], u1, u2)
            return drawn.wm, drawn.pdf
        before, wm = 0.0, mi.Vector3f(0.0, 0.0, 1.0)
        for i, (view, share) in enumerate(zip(seen.lobe, seen.share.lobe)):
            u = dr.clip((u1 - before) / dr.maximum(share, 1e-20), 0.0, 1.0)
            here = (u1 >= before) & ((u1 < before + share) | (i + 1 == seen.count))
            wm = dr.select(here, kernel.vndf_sample(view, u, u2).wm, wm)
            before = before + share
        return wm, self.pdf_from(seen, wm)

    def pdf_from(self, seen: Any, wm: Any) -> Any:
        return dr.select(wm.z >= 0.0, kernel.vndf_mixture_pdf(seen, _raised(wm)), 0.0)

    def eval(self, m: Any) -> Any:
        """D(m)."""
        return dr.select(
            m.z >= 0.0, sum(weight * kernel.vndf_ndf(lobe, _raised(m)) for lobe, weight in self._lobes), 0.0
        )


class MicrofacetDistribution(Microfacets):
    """What mitsuba.MicrofacetDistribution is, with any distribution: the same methods, names and shapes. Visible
    normals are sampled, so directions wi have wi.z >= 0. `distribution`: a vndf.Distribution, a table file, "ggx" or
    "beckmann"."""

    def __init__(self, distribution: Any, alpha_u: Any, alpha_v: Any = None) -> None:
        alphas = mi.Float(alpha_u), mi.Float(alpha_u if alpha_v is None else alpha_v)
        super().__init__([(law_of(distribution), *alphas, 1.0)])

    def pdf(self, wi: Any, m: Any) -> Any:
        """The density with which `sample` draws m."""
        return self.pdf_from(self.view(wi)[0], m)

    def sample(self, wi: Any, sample: Any) -> tuple[Any, Any]:
        """A visible normal and its density."""
        return self.sample_from(self.view(wi)[0], sample.x, sample.y)

    def smith_g1(self, v: Any, m: Any) -> Any:
        """Smith's masking, 0 where v sees the back of m."""
        up = abs(v.z)
        return dr.select(dr.dot(v, m) * v.z > 0.0, up / self.view(mi.Vector3f(v.x, v.y, up))[1], 0.0)

    def G(self, wi: Any, wo: Any, m: Any) -> Any:
        """The product of both ways, which Mitsuba's plugins use."""
        return self.smith_g1(wi, m) * self.smith_g1(wo, m)


# Laws of normals for the variant of Mitsuba that is set: what the kernel asks of a distribution.


def law_of(given: Any) -> Any:
    """Of a distribution, "ggx", "beckmann", or a table file."""
    if isinstance(given, str):
        return Closed(given) if given in ("ggx", "beckmann") else Table(load(given))
    return Closed(given.info.source.split()[-1]) if given.info.bytes == 0 else Table(given)


class Closed:
    """A closed form, "ggx" or "beckmann"."""

    scale = 1.0  # the slope of unit roughness

    def __init__(self, name: str) -> None:
        self.kind = {"ggx": kernel.VNDF_GGX, "beckmann": kernel.VNDF_BECKMANN}[name]


class Table:
    """A table; the kernel reads its rows by `load_row`."""

    kind = 0

    def __init__(self, distribution: Distribution) -> None:
        numbers = distribution.numbers()
        if numbers.size == 0:
            raise ValueError("a closed form has no table")
        self.cells, self.moments, self.squarings = (int(number) for number in numbers[:3])
        self.scale = float(numbers[3])
        self.steps = self.cells.bit_length()
        self.highest = 1 << (self.steps - 1)
        rows = numbers[kernel.VNDF_HEAD :]
        self._numbers = mi.Float(rows) if dr.is_jit_v(mi.Float) else rows.tolist()

    def load_row(self, group: int, i: Any) -> Any:
        """Row i of a group: four numbers."""
        row = kernel.VNDF_STRIDE * i + 4 * group
        if not dr.is_jit_v(mi.Float):
            return kernel.vndf_quad(*self._numbers[int(row) : int(row) + 4])
        at = mi.UInt32(row)
        return kernel.vndf_quad(*(dr.gather(mi.Float, self._numbers, at + j) for j in range(4)))
