"""Visible normals in Dr.Jit: the library's kernel as `vndf_write_kernel` prints it (_kernel.py, which the build makes),
for directions above the horizon. It runs wherever Mitsuba's variants run, one value at a time (scalar), on LLVM or CUDA,
and is differentiable: samples and densities are piecewise smooth functions of direction and roughness.
"""
from __future__ import annotations

from typing import Any, Callable, NamedTuple, Union

import drjit as dr
import mitsuba as mi

from . import _kernel as kernel
from .distribution import Distribution, load


class View(NamedTuple):
    """A surface seen from a direction above the horizon."""

    wi: Any
    frame: Any  # the kernel's
    seen: Any  # what the law makes of it
    area: Any  # projected area along wi
    drawn: Any  # the same of what is drawn, by which mixtures share


class Law:
    """A law of normals, for the variant of Mitsuba that is set. Directions wi are unit with wi.z >= 0, roughness is
    above 0, u1 and u2 are in [0, 1]. Subclasses have it in the unit problem: `_see` makes what it needs of a direction,
    and both its areas; `_draw` a normal; `_density` is that with which a normal is drawn, `_p22` that of slopes over z^4."""

    scale = 1.0  # the slope of the law's unit roughness
    _see: Callable[[Any], tuple[Any, Any, Any]]
    _draw: Callable[[View, Any, Any], Any]
    _density: Callable[[View, Any], Any]
    _p22: Callable[[Any], Any]

    def _frame(self, alpha_x: Any, alpha_y: Any, wi: Any) -> Any:
        x, y = alpha_x * self.scale, alpha_y * self.scale
        return kernel.vndf_frame_of(
            kernel.vndf_affine_map(x, 0.0, 0.0, y, 0.0, 0.0, 1, x * y), wi.x, wi.y, dr.maximum(wi.z, 0.0)
        )

    def view(self, alpha_x: Any, alpha_y: Any, wi: Any) -> View:
        """A surface seen from wi."""
        frame = self._frame(alpha_x, alpha_y, wi)
        seen, area, drawn = self._see(frame)
        return View(wi, frame, seen, area * frame.size, drawn * frame.size)

    def sample(self, view: View, u1: Any, u2: Any) -> tuple[Any, Any]:
        """A visible normal and the density with which it is drawn."""
        drawn = kernel.vndf_frame_sampled(view.frame, self._draw(view, u1, u2))
        return mi.Vector3f(drawn.x, drawn.y, drawn.z), drawn.pdf

    def pdf(self, view: View, wm: Any) -> Any:
        """The density with which `sample` draws wm."""
        n = kernel.vndf_frame_normal(view.frame, wm.x, wm.y, dr.maximum(wm.z, 0.0))
        seen = (n.facing > 0.0) & (wm.z >= 0.0)
        n.facing = dr.select(seen, n.facing, 1.0)
        density = kernel.vndf_frame_density(view.frame, self._density(view, n) / view.frame.determinant)
        return dr.select(seen, density, 0.0)

    def ndf(self, alpha_x: Any, alpha_y: Any, wm: Any) -> Any:
        """D(wm), wm.z >= 0."""
        frame = self._frame(alpha_x, alpha_y, mi.Vector3f(0.0, 0.0, 1.0))
        n = kernel.vndf_frame_normal(frame, wm.x, wm.y, dr.maximum(wm.z, 0.0))
        return dr.select(wm.z >= 0.0, self._p22(n) / frame.determinant, 0.0)


class Closed(Law):
    """A closed form, "ggx" or "beckmann"."""

    def __init__(self, name: str) -> None:
        see, area, draw, density, p22 = (
            getattr(kernel, f"vndf_{name}_{call}") for call in ("see", "area", "draw", "density", "p22")
        )
        self._see = lambda f: (see(f.ux, f.uy, f.uz), *[area(f.ux, f.uy, f.uz)] * 2)
        self._draw = lambda view, u1, u2: draw(view.seen, u1, u2)
        self._density = lambda view, n: density(view.seen, n.x, n.y, n.z, n.facing)
        self._p22 = lambda n: p22(n.x, n.y, n.z)


class Table(Law):
    """A table; the kernel reads its rows by `look`."""

    def __init__(self, distribution: Distribution) -> None:
        numbers = distribution.numbers()
        if numbers.size == 0:
            raise ValueError("a closed form has no table")
        self.cells, self.moments, self.squarings = (int(number) for number in numbers[:3])
        self.scale = float(numbers[3])
        self.steps = self.cells.bit_length()
        self.highest = 1 << (self.steps - 1)
        rows = numbers[8:]  # after the head
        self._numbers = mi.Float(rows) if dr.is_jit_v(mi.Float) else rows.tolist()

    def look(self, group: int, i: Any) -> Any:
        """Row i of a group: four numbers."""
        row = 20 * i + 4 * group
        if not dr.is_jit_v(mi.Float):
            return kernel.vndf_quad(*self._numbers[int(row) : int(row) + 4])
        at = mi.UInt32(row)
        return kernel.vndf_quad(*(dr.gather(mi.Float, self._numbers, at + j) for j in range(4)))

    def _see(self, frame: Any) -> tuple[Any, Any, Any]:
        seen, reach = kernel.vndf_table_view_of(self, frame, 0), kernel.vndf_frame_reach(frame)
        return seen, kernel.vndf_law_area(self, seen.v, 0) * reach, kernel.vndf_law_drawn_area(seen.v, 0) * reach

    def _draw(self, view: View, u1: Any, u2: Any) -> Any:
        return kernel.vndf_table_draw(self, view.seen, u1, u2, 0)

    def _density(self, view: View, n: Any) -> Any:
        return kernel.vndf_table_pdf(self, view.seen, n, kernel.vndf_frame_reach(view.frame), 0)

    def _p22(self, n: Any) -> Any:
        return kernel.vndf_table_p22(self, kernel.vndf_table_given(self, n.x, n.y, n.z))


def law_of(distribution: Union[Distribution, str]) -> Law:
    """Of a distribution, "ggx", "beckmann", or a table file."""
    if isinstance(distribution, str):
        return Closed(distribution) if distribution in ("ggx", "beckmann") else Table(load(distribution))
    return Closed(distribution.info.source.split()[-1]) if distribution.info.bytes == 0 else Table(distribution)
