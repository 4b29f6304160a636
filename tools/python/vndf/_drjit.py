"""Visible normals in Dr.Jit: the library's kernel as `vndf_write_kernel` prints it (_kernel.py, which the build makes),
for directions above the horizon. It runs wherever Mitsuba's variants run, one value at a time (scalar), on LLVM or
CUDA, and is differentiable: samples and densities are piecewise smooth functions of direction and roughness."""
from __future__ import annotations

from typing import Any, NamedTuple

import drjit as dr
import mitsuba as mi

from . import _kernel as kernel
from .distribution import Distribution, load


class Part(NamedTuple):
    """A lobe seen from a direction above the horizon."""

    law: Any
    frame: Any  # the kernel's
    seen: Any  # what the law makes of it
    share: Any  # of all that is drawn


class Microfacets:
    """The normals of a surface, of one lobe or several. Each is a law, its roughness along two axes that are turned by an
    angle, whose sine and cosine are `turn` (None: 0), and a weight; weights sum to 1."""

    def __init__(self, lobes: list[tuple[Any, Any, Any, Any]], turn: Any = None) -> None:
        self._lobes = []
        for law, x, y, weight in lobes:
            x, y = x * law.scale, y * law.scale
            s, c = turn or (0.0, 1.0)
            matrix = (x, 0.0, 0.0, y) if turn is None else (c * x, -s * y, s * x, c * y)
            self._lobes.append((law, kernel.vndf_affine_map(*matrix, 0.0, 0.0, int(turn is None), x * y), weight))

    def view(self, wi: Any) -> tuple[list[Part], Any]:
        """The lobes as wi, wi.z >= 0, sees them, and the projected area of all."""
        parts, area, drawn = [], 0.0, 0.0
        for law, shape, weight in self._lobes:
            frame = kernel.vndf_frame_of(shape, wi.x, wi.y, dr.maximum(wi.z, 0.0))
            seen, one, share = law.see(frame)
            parts.append(Part(law, frame, seen, weight * frame.size * share))
            area += weight * frame.size * one
            drawn += parts[-1].share
        return [p._replace(share=dr.select(drawn > 0.0, p.share / drawn, 0.0)) for p in parts], area

    def sample_from(self, parts: list[Part], u1: Any, u2: Any) -> tuple[Any, Any]:
        """A visible normal, and the density of all lobes together."""
        before, wm = 0.0, mi.Vector3f(0.0, 0.0, 1.0)
        for i, part in enumerate(parts):
            u, here = u1, True
            if len(parts) > 1:
                u = dr.clip((u1 - before) / dr.maximum(part.share, 1e-20), 0.0, 1.0)
                here = (u1 >= before) & ((u1 < before + part.share) | (i + 1 == len(parts)))
            drawn = kernel.vndf_frame_sampled(part.frame, part.law.draw(part, u, u2))
            wm = dr.select(here, mi.Vector3f(drawn.x, drawn.y, drawn.z), wm)
            before = before + part.share
        return wm, drawn.pdf if len(parts) == 1 else self.pdf_from(parts, wm)

    def pdf_from(self, parts: list[Part], wm: Any) -> Any:
        density = 0.0
        for part in parts:
            n = kernel.vndf_frame_normal(part.frame, wm.x, wm.y, dr.maximum(wm.z, 0.0))
            seen = (n.facing > 0.0) & (wm.z >= 0.0)
            n.facing = dr.select(seen, n.facing, 1.0)
            one = kernel.vndf_frame_density(part.frame, part.law.density(part, n) / part.frame.determinant)
            density += dr.select(seen, part.share * one, 0.0)
        return density

    def eval(self, m: Any) -> Any:
        """D(m)."""
        density = 0.0
        for law, shape, weight in self._lobes:
            frame = kernel.vndf_frame_of(shape, 0.0, 0.0, mi.Float(1.0))
            n = kernel.vndf_frame_normal(frame, m.x, m.y, dr.maximum(m.z, 0.0))
            density += weight * law.p22(n) / frame.determinant
        return dr.select(m.z >= 0.0, density, 0.0)


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


# Laws of normals for the variant of Mitsuba that is set, in the unit problem: `see` makes what they need of a
# direction, and both its areas; `draw` a normal; `density` is that of the draw, `p22` that of slopes over z^4.


def law_of(given: Any) -> Any:
    """Of a distribution, "ggx", "beckmann", or a table file."""
    if isinstance(given, str):
        return Closed(given) if given in ("ggx", "beckmann") else Table(load(given))
    return Closed(given.info.source.split()[-1]) if given.info.bytes == 0 else Table(given)


class Closed:
    """A closed form, "ggx" or "beckmann"."""

    scale = 1.0  # the slope of unit roughness

    def __init__(self, name: str) -> None:
        calls = ("see", "area", "draw", "density", "p22")
        see, area, draw, density, p22 = (getattr(kernel, f"vndf_{name}_{call}") for call in calls)
        self.see = lambda f: (see(f.ux, f.uy, f.uz), *[area(f.ux, f.uy, f.uz)] * 2)
        self.draw = lambda part, u1, u2: draw(part.seen, u1, u2)
        self.density = lambda part, n: density(part.seen, n.x, n.y, n.z, n.facing)
        self.p22 = lambda n: p22(n.x, n.y, n.z)


class Table:
    """A table; the kernel reads its rows by `look`."""

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

    def see(self, frame: Any) -> tuple[Any, Any, Any]:
        seen, reach = kernel.vndf_table_view_of(self, frame, 0), kernel.vndf_frame_reach(frame)
        return seen, kernel.vndf_law_area(self, seen.v, 0) * reach, kernel.vndf_law_drawn_area(seen.v, 0) * reach

    def draw(self, part: Part, u1: Any, u2: Any) -> Any:
        return kernel.vndf_table_draw(self, part.seen, u1, u2, 0)

    def density(self, part: Part, n: Any) -> Any:
        return kernel.vndf_table_pdf(self, part.seen, n, kernel.vndf_frame_reach(part.frame), 0)

    def p22(self, n: Any) -> Any:
        return kernel.vndf_table_p22(self, kernel.vndf_table_given(self, n.x, n.y, n.z))
