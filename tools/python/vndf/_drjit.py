"""Visible normals of a table in Dr.Jit: what tools/export/kernel.glsl does above the horizon, in arrays of gathered
numbers. It runs wherever Mitsuba's variants run, one value at a time (scalar), on LLVM or CUDA, and is differentiable:
samples and densities are piecewise smooth functions of direction and roughness.

Sizes: a direction is (s, 0, c) at unit roughness, s + c = 1, turned so that wi has the azimuth 0. Slopes are (x, z) with
x + z = 1. Names are those of the kernel, which explains the formulas.
"""
from __future__ import annotations

import abc
from typing import Any, Callable, NamedTuple

import drjit as dr
import mitsuba as mi

from .distribution import Distribution


def _ratio(a: Any, b: Any) -> Any:
    """a/b, or 0 where b is not above 0; without NaN in derivatives."""
    good = b > 0.0
    return dr.select(good, a / dr.select(good, b, 1.0), 0.0)


def _root(x: Any) -> Any:
    """sqrt(x), whose derivative at 0 is 0."""
    return dr.sqrt(dr.maximum(x, 1e-36))


class _Cell(NamedTuple):
    """A cell of a piecewise rational density: densities at its ends, and its mass."""

    e0: Any
    e1: Any
    mass: Any

    def density(self, xi: Any, eta: Any) -> Any:
        w = xi * eta
        part = _ratio(self.mass, self.mass + (self.e0 + self.e1 - 2.0 * self.mass) * w)
        return (self.e1 * xi * xi + 2.0 * self.mass * w + self.e0 * eta * eta) * part * part

    def density_over_xi(self, xi: Any, eta: Any) -> Any:
        part = _ratio(self.mass, self.mass + (self.e1 - 2.0 * self.mass) * xi * eta)
        return (self.e1 * xi + 2.0 * self.mass * eta) * part * part

    def invert(self, before: Any) -> tuple[Any, Any]:
        e0, e1 = _ratio(self.e0, self.mass), _ratio(self.e1, self.mass)
        t = dr.clip(_ratio(before, self.mass), 0.0, 1.0)
        middle = e0 - t * (e0 + e1)
        b = middle + 2.0 * t
        total = abs(b) + _root(middle * middle + 4.0 * t * (1.0 - t))
        over = dr.select(b >= 0.0, 2.0 * t, total)
        under = dr.select(b >= 0.0, total, 2.0 * (1.0 - b))
        xi = dr.minimum(_ratio(over, under), 1.0)
        return xi, dr.select(under > 0.0, _ratio(dr.maximum(under - over, 0.0), under), 1.0)


class _Law(NamedTuple):
    """The law of the slope at one azimuth."""

    c: Any
    k: Any
    mass: Any
    part: Any
    cut: Any


class _Piece(NamedTuple):
    """A cell of the law as far as it is visible."""

    cell: _Cell
    v0: Any
    v1: Any
    size: Any
    weighted: Any


class View(NamedTuple):
    """A surface seen from a direction above the horizon."""

    wi: Any
    alpha_x: Any  # times the scale of the table
    alpha_y: Any
    cos_phi: Any
    sin_phi: Any
    s: Any
    c: Any
    size: Any
    front: Any
    wedge: Any
    area: Any  # projected area along wi


class Law(abc.ABC):
    """A law of normals, for the variant of Mitsuba that is set. Directions wi are unit with wi.z >= 0, roughness is
    above 0, u1 and u2 are in [0, 1]."""

    @abc.abstractmethod
    def view(self, alpha_x: Any, alpha_y: Any, wi: Any) -> View:
        """A surface seen from wi."""

    @abc.abstractmethod
    def sample(self, view: View, u1: Any, u2: Any) -> tuple[Any, Any]:
        """A visible normal and the density with which it is drawn."""

    @abc.abstractmethod
    def pdf(self, view: View, wm: Any) -> Any:
        """The density with which `sample` draws wm."""

    @abc.abstractmethod
    def ndf(self, alpha_x: Any, alpha_y: Any, wm: Any) -> Any:
        """D(wm), wm.z >= 0."""

    @staticmethod
    def _normal(view: View, x: Any, y: Any, z: Any, density: Any) -> tuple[Any, Any]:
        """From unit roughness, turned and of any length, to a normal that rounding does not turn away from wi."""
        n = mi.Vector3f(
            view.alpha_x * (view.cos_phi * x - view.sin_phi * y), view.alpha_y * (view.sin_phi * x + view.cos_phi * y), z
        )
        reach = dr.norm(n)
        n = n + dr.maximum(2e-7 * reach - dr.dot(view.wi, n), 0.0) * view.wi
        determinant = view.alpha_x * view.alpha_y
        return n / reach, dr.clip(density * reach * reach * (reach / determinant), 1.2e-38, 3.4e38)


class Ggx(Law):
    """GGX, by spherical caps (Dupuy & Benyoub 2023)."""

    def view(self, alpha_x: Any, alpha_y: Any, wi: Any) -> View:
        x, y, z = alpha_x * wi.x, alpha_y * wi.y, dr.maximum(wi.z, 0.0)
        size = _root(x * x + y * y + z * z)
        across = _root(x * x + y * y)
        turned = x * x + y * y > 0.0
        cos_phi, sin_phi = dr.select(turned, x / across, 1.0), dr.select(turned, y / across, 0.0)
        area = 0.5 * (size + z)
        return View(wi, alpha_x, alpha_y, cos_phi, sin_phi, across / size, z / size, size, 0.0, 0.0, area)

    def sample(self, view: View, u1: Any, u2: Any) -> tuple[Any, Any]:
        u2 = dr.minimum(u2, 0.99999994)
        cap, v, s = 1.0 + view.c, 1.0 - u2, view.s
        t = _root(u2 * (s * s + v * cap * cap))
        sine, cosine = dr.sincos(dr.pi * u1)
        x = _ratio(v * (s * s - u2 * cap * cap), s + t) + 2.0 * t * sine * sine
        y, z = -2.0 * t * sine * cosine, v * cap
        return self._normal(view, x, y, z, 0.5 * dr.inv_pi * view.size / (view.area * (x * x + y * y + z * z)))

    def pdf(self, view: View, wm: Any) -> Any:
        facing = dr.dot(view.wi, wm)
        density = self.ndf(view.alpha_x, view.alpha_y, wm) * facing / view.area
        return dr.select((facing > 0.0) & (wm.z >= 0.0), dr.clip(density, 1.2e-38, 3.4e38), 0.0)

    def ndf(self, alpha_x: Any, alpha_y: Any, wm: Any) -> Any:
        square = (wm.x / alpha_x) ** 2 + (wm.y / alpha_y) ** 2 + wm.z * wm.z
        return dr.select(wm.z >= 0.0, dr.inv_pi / (square * square * alpha_x * alpha_y), 0.0)


class Table(Law):
    """A table."""

    def __init__(self, distribution: Distribution) -> None:
        numbers = distribution.numbers()
        if numbers.size == 0:
            raise ValueError("a closed form has no table")
        self._jit = dr.is_jit_v(mi.Float)
        self._numbers = mi.Float(numbers) if self._jit else numbers.tolist()
        head = numbers[:20]
        self.cells, self.knot, self.cell = (int(number) for number in head[:3])
        self.f0, self.f1, self.scale = (float(number) for number in head[3:6])
        above = [int(number) for number in head[6:13]]
        self.row_cells, self.spans, self.pieces, self.q, self.span, self.row, self.piece = above

    # ---- numbers ----

    def _at(self, i: Any) -> Any:
        return dr.gather(mi.Float, self._numbers, mi.UInt32(i)) if self._jit else self._numbers[int(i)]

    def _search(self, count: Any, most: int, holds: Callable[[Any], Any]) -> Any:
        """The last index below `count` (at most `most`) up to which `holds` does; 0 if it never does."""
        low = mi.UInt32(0)
        step = 1 << max(most - 1, 1).bit_length()
        while step:
            middle = low + step
            inside = middle < count
            low = dr.select(inside & holds(dr.select(inside, middle, 0)), middle, low)
            step >>= 1
        return low

    def _find(self, first: int, stride: int, count: int, x: Any) -> Any:
        return self._search(count, count, lambda i: self._at(first + i * stride) <= x)

    # ---- the wedge ----

    def wedge_mass(self, y: Any) -> Any:
        at = self.piece + 8 * self._find(self.piece + 6, 8, self.pieces, y)
        t = dr.clip((y - self._at(at + 6)) * self._at(at + 7), 0.0, 1.0)
        u = 1.0 - t
        inner = u * u * self._at(at) + (u * t * self._at(at + 1) + t * t * self._at(at + 2))
        outer = u * u * self._at(at + 3) + (u * t * self._at(at + 4) + t * t * self._at(at + 5))
        return u * u * u * inner + t * t * t * outer

    def _row_of(self, y: Any) -> Callable[[Any], Any]:
        """A mix of three rows: a function of the index in it."""
        i = self._find(self.span, 2, self.spans, y)
        stride = 3 * self.row_cells + 3
        m = dr.clip((y - self._at(self.span + 2 * i)) * self._at(self.span + 2 * i + 1), 0.0, 1.0)
        rest = 1.0 - m
        first = self.row + 2 * i * stride

        def number(j: Any) -> Any:
            at = first + j
            outer = rest * rest * self._at(at) + m * m * self._at(at + 2 * stride)
            return outer + 2.0 * rest * m * self._at(at + stride)

        return number

    def _row_azimuth(self, row: Callable[[Any], Any], j: Any, xi: Any, eta: Any) -> tuple[Any, Any, Any]:
        """Cosine, sine and density per radian at a place of cell j."""
        begin, end = self._at(self.q + j), self._at(self.q + j + 1)
        width = end - begin
        q = begin + xi * width
        p, r = row(0), row(1)
        x = p * ((1.0 - end) + eta * width) * (1.0 + q)
        y = 2.0 * r * q
        square = x * x + y * y
        turned = 2.0 * p * r * (1.0 + q * q) * width
        density = self._row_cell(row, j, width).density(xi, eta) * _ratio(square, turned)
        return _ratio(x, _root(square)), _ratio(y, _root(square)), density

    def _row_cell(self, row: Callable[[Any], Any], j: Any, width: Any) -> _Cell:
        at = 2 + self.row_cells + 2 * j
        return _Cell(row(at) * width, row(at + 2) * width, row(at + 1))

    def _row_draw(self, row: Callable[[Any], Any], part: Any) -> tuple[Any, Any, Any]:
        j = self._search(self.row_cells, self.row_cells, lambda i: row(2 + i) <= part)
        width = self._at(self.q + j + 1) - self._at(self.q + j)
        return self._row_azimuth(row, j, *self._row_cell(row, j, width).invert(part - row(2 + j)))

    def _row_density(self, row: Callable[[Any], Any], cosine: Any, sine: Any) -> Any:
        along, aside = row(1) * cosine, row(0) * sine
        reach = _root(along * along + aside * aside)
        per = _ratio(1.0, (along + reach) * (reach + aside))
        q = aside * (reach + aside) * per
        rest = along * (reach + aside + along) * per
        j = self._find(self.q, 1, self.row_cells, q)
        begin, end = self._at(self.q + j), self._at(self.q + j + 1)
        xi = dr.clip((q - begin) / (end - begin), 0.0, 1.0)
        eta = dr.clip((rest - (1.0 - end)) / (end - begin), 0.0, 1.0)
        return self._row_azimuth(row, j, xi, eta)[2]

    # ---- the front ----

    @staticmethod
    def _front_draw(even: Any, odd: Any, rest: Any, whole: Any) -> tuple[Any, Any, Any]:
        whole2 = whole * whole
        k = (even + 1e-30) * (whole2 + 0.1107 * rest * rest)
        y = _ratio(rest * whole2, k + _root(k * k + 2.0 * odd * (rest * whole2 * whole2)))
        sine = 2.0 * y * _root(1.0 - y * y)
        cosine = 1.0 - 2.0 * y * y
        density = even + odd * sine + 1e-18
        y2 = y * y
        y4 = y2 * y2
        inner = 0.99999998 + 0.16667076 * y2 + y4 * (0.074840751 + 0.046982405 * y2)
        outer = 0.013773087 + 0.084478642 * y2 + y4 * (-0.10345663 + 0.11751909 * y2)
        miss = rest - 2.0 * (even * y * (inner + y4 * y4 * outer) + odd * y2)
        turn = miss * density / (density * density + miss * (0.5 * odd * cosine))
        toward = dr.maximum((sine + cosine * turn) - sine * (0.5 * turn * turn), 0.0)
        aside = dr.maximum((cosine - sine * turn) - cosine * (0.5 * turn * turn), 0.0)
        return toward, aside, even + odd * toward

    # ---- the slope at one azimuth ----

    def _weight(self, c: Any, k: Any, j: Any) -> Any:
        return c * self._at(self.knot + 8 * j + 1) + k * self._at(self.knot + 8 * j)

    def _sum(self, law: _Law, j: Any) -> Any:
        at = self.knot + 8 * j
        forward = law.c * self._at(at + 2) + law.k * self._at(at + 3)
        seen = dr.maximum(self._weight(law.c, law.k, j), 0.0)
        return dr.select(law.k < 0.0, law.c * self._at(at + 4) + seen * self._at(at + 5), forward)

    def _piece_at_cut(self, c: Any, k: Any, cut: Any) -> _Piece:
        at = self.cell + 7 * cut
        f0, f1, a, b = (self._at(at + i) for i in (0, 1, 5, 6))
        w = dr.maximum(self._weight(c, k, cut), 0.0)
        hidden = self._weight(c, k, cut + 1)
        h = dr.select(hidden < 0.0, _ratio(w, w - hidden), 1.0)
        least = 1e-3 * (0.5 * f0 + h * ((f1 - f0) / 6.0))
        cubic = 0.5 * f0 + h * ((f1 - f0 + a) / 6.0 + h * ((b - a) / 12.0 - h * (0.05 * b)))
        e0 = f0 * 0.5 * w * h
        e1 = dr.maximum(f0 * (1.0 - h) + f1 * h + h * (1.0 - h) * (a + b * h), 0.0) * 0.5 * w * h
        return _Piece(_Cell(e0, e1, w * h * dr.maximum(least, cubic)), w, mi.Float(0.0), h, mi.Bool(True))

    def _piece_of(self, law: _Law, j: Any) -> _Piece:
        at = self.cell + 7 * j
        f0, f1 = self._at(at), self._at(at + 1)
        w0 = dr.maximum(self._weight(law.c, law.k, j), 0.0)
        w1 = dr.maximum(self._weight(law.c, law.k, j + 1), 0.0)
        mass = w0 * self._at(at + 2) + w1 * self._at(at + 3)
        plain = j + 2 < law.cut
        v1 = w1 + dr.select(j + 2 == law.cut, dr.minimum(16.0 * law.part, 1.0) * (w0 - w1), 0.0)
        mean = 0.5 * (w0 + v1)
        e0 = f0 * dr.select(plain, w0, mean)
        e1 = f1 * dr.select(plain, w1, dr.select(v1 > 0.0, _ratio(w1, v1), 1.0) * mean)
        cut = self._piece_at_cut(law.c, law.k, dr.minimum(law.cut, self.cells - 1))
        at_cut = j == law.cut
        here = [dr.select(at_cut, a, b) for a, b in zip(cut.cell, (e0, e1, mass))]
        return _Piece(
            _Cell(*here), dr.select(at_cut, cut.v0, w0), dr.select(at_cut, cut.v1, v1),
            dr.select(at_cut, cut.size, 1.0), j + 2 >= law.cut,
        )  # fmt: skip

    def _law_of(self, c: Any, k: Any) -> _Law:
        whole = dr.maximum(c, 0.0) * self.f0 + dr.maximum(k, 0.0) * self.f1
        cut = self._search(self.cells, self.cells, lambda j: self._weight(c, k, j) > 0.0)
        piece = self._piece_at_cut(c, k, cut)
        open_ = (k >= 0.0) | (whole <= 0.0)
        law = _Law(c, k, whole, dr.select(open_, 0.0, piece.size), dr.select(open_, mi.UInt32(self.cells), cut))
        return law._replace(mass=dr.select(open_, whole, piece.cell.mass + self._sum(law, cut)))

    def _slope_at(self, j: Any, xi: Any, eta: Any) -> tuple[Any, Any]:
        at = self.knot + 8 * j
        return eta * self._at(at) + xi * self._at(at + 8), eta * self._at(at + 1) + xi * self._at(at + 9)

    def _slope_of(self, x: Any, z: Any) -> tuple[Any, Any, Any]:
        """Cell and place of a slope."""

        def begins(j: Any) -> Any:
            at = self.knot + 8 * j
            return x * self._at(at + 1) >= z * self._at(at)

        j = self._search(self.cells, self.cells, begins)
        at = self.knot + 8 * j
        inner = dr.maximum(x * self._at(at + 1) - z * self._at(at), 0.0)
        outer = dr.maximum(z * self._at(at + 8) - x * self._at(at + 9), 0.0)
        whole = inner + outer
        return j, _ratio(inner, whole), dr.select(whole > 0.0, _ratio(outer, whole), 1.0)

    def _draw_slope(self, law: _Law, u: Any) -> tuple[Any, Any, Any, _Piece]:
        """Cell and place of the slope with the part u of the mass before it."""
        goal = law.mass * u
        end = dr.minimum(law.cut + 1, self.cells)
        j = self._search(end, self.cells, lambda i: self._sum(law, i) <= goal)
        piece = self._piece_of(law, j)
        zeta, rest = piece.cell.invert(goal - self._sum(law, j))
        v = _root(piece.v0 * piece.v0 * rest + piece.v1 * piece.v1 * zeta)
        xi, eta = zeta * (piece.v1 + v), rest * (piece.v0 + v)
        usable = piece.weighted & (xi + eta > 0.0)
        xi, eta = dr.select(usable, xi, zeta), dr.select(usable, eta, rest)
        per = dr.select(piece.weighted, _ratio(piece.size, xi + eta), 1.0)
        return j, xi * per, (1.0 - piece.size) + eta * per, piece

    def _slope_density(self, law: _Law, j: Any, xi: Any, eta: Any, piece: _Piece, w: Any) -> Any:
        per = _ratio(_ratio(1.0, piece.size), law.mass)
        x, z = self._slope_at(j, xi, eta)
        cut = piece.size < 1.0
        xi = dr.select(cut, dr.minimum(_ratio(xi, piece.size), 1.0), xi)
        eta = dr.select(cut, 1.0 - xi, eta)
        both = _ratio(1.0, piece.v0 + piece.v1)
        v = piece.v0 * eta + piece.v1 * xi
        zeta_per_xi = dr.select(piece.weighted, (piece.v0 + v) * both, 1.0)
        eta = eta * dr.select(piece.weighted, (v + piece.v1) * both, 1.0)
        per = per * dr.select(piece.weighted, 2.0 * dr.select(cut, w, v) * both, 1.0)
        per = per * (x + z) ** 3 / self._at(self.cell + 7 * j + 4)
        first = (j == 0) & (piece.cell.e0 == 0.0)
        over_xi = zeta_per_xi * piece.cell.density_over_xi(xi * zeta_per_xi, eta)
        at_zero = per * over_xi / (piece.size * self._at(self.knot + 8))
        return dr.select(first, at_zero, _ratio(per * piece.cell.density(xi * zeta_per_xi, eta), x))

    # ---- what a BSDF asks ----

    def view(self, alpha_x: Any, alpha_y: Any, wi: Any) -> View:
        alpha_x, alpha_y = alpha_x * self.scale, alpha_y * self.scale
        x, y, z = alpha_x * wi.x, alpha_y * wi.y, dr.maximum(wi.z, 0.0)
        aside = _root(x * x + y * y)
        across = dr.maximum(aside, 1e-9 * z)
        size = across + z
        s, c = across / size, z / size
        front = c * (self.f0 * 0.5 * dr.pi) + s * self.f1
        wedge = self.wedge_mass(c)
        area = 2.0 * (front + wedge) * size
        turned = x * x + y * y > 0.0
        cos_phi = dr.select(turned, x / aside, 1.0)
        return View(wi, alpha_x, alpha_y, cos_phi, dr.select(turned, y / aside, 0.0), s, c, size, front, wedge, area)

    def sample(self, view: View, u1: Any, u2: Any) -> tuple[Any, Any]:
        side = 2.0 * u1 - 1.0
        total = view.front + view.wedge
        goal = abs(side) * total
        in_front = (goal < view.front) | (view.wedge <= 0.0)
        even, odd = view.c * self.f0, view.s * self.f1
        fore = self._front_draw(even, odd, dr.maximum(view.front - goal, 0.0), view.front)
        rest = dr.clip(1.0 - _ratio(goal - view.front, view.wedge), 0.0, 1.0)
        aft = self._row_draw(self._row_of(view.c), rest)
        cosine, sine = dr.select(in_front, fore[0], -aft[0]), dr.select(in_front, fore[1], aft[1])
        azimuth = dr.select(in_front, fore[2], aft[2] * view.wedge) * 0.5 / total
        k = view.s * cosine
        law = self._law_of(view.c, k)
        j, xi, eta, piece = self._draw_slope(law, u2)
        x, z = self._slope_at(j, xi, eta)
        w = dr.maximum(view.c * z + k * x, 1e-7 * (view.c * z + abs(k) * x))
        density = azimuth * self._slope_density(law, j, xi, eta, piece, w)
        y = x * dr.select(side < 0.0, -sine, sine)
        x = x * cosine
        return self._normal(view, x, y, z, density)

    @staticmethod
    def _unit_normal(alpha_x: Any, alpha_y: Any, wm: Any) -> tuple[Any, Any]:
        return wm.x / alpha_x, wm.y / alpha_y

    def pdf(self, view: View, wm: Any) -> Any:
        facing = dr.dot(view.wi, wm)
        a, b = self._unit_normal(view.alpha_x, view.alpha_y, wm)
        nx, ny = view.cos_phi * a + view.sin_phi * b, view.cos_phi * b - view.sin_phi * a
        nz = dr.maximum(wm.z, 0.0)
        square = nx * nx + ny * ny
        x = dr.select(square > 0.0, _root(square), 0.0)
        cosine = dr.select(x > 0.0, _ratio(nx, x), 1.0)
        sine = _ratio(abs(ny), x)
        fore = view.c * self.f0 + view.s * self.f1 * cosine
        aft = view.wedge * self._row_density(self._row_of(view.c), dr.maximum(-cosine, 0.0), sine)
        azimuth = dr.select(cosine >= 0.0, fore, aft) * 0.5 / (view.front + view.wedge)
        law = self._law_of(view.c, view.s * cosine)
        scale = 1.0 / (x + nz)
        j, xi, eta = self._slope_of(x * scale, nz * scale)
        beyond = (law.cut < self.cells) & (j > law.cut)
        j = dr.select(beyond, law.cut, j)
        xi, eta = dr.select(beyond, law.part, xi), dr.select(beyond, 1.0 - law.part, eta)
        w = facing * scale / view.size
        density = azimuth * self._slope_density(law, j, xi, eta, self._piece_of(law, j), w)
        density = density * scale * scale * (scale / (view.alpha_x * view.alpha_y))
        return dr.select((facing > 0.0) & (wm.z >= 0.0), dr.clip(density, 1.2e-38, 3.4e38), 0.0)

    def ndf(self, alpha_x: Any, alpha_y: Any, wm: Any) -> Any:
        alpha_x, alpha_y = alpha_x * self.scale, alpha_y * self.scale
        a, b = self._unit_normal(alpha_x, alpha_y, wm)
        nz = dr.maximum(wm.z, 0.0)
        square = a * a + b * b
        x = dr.select(square > 0.0, _root(square), 0.0)
        total = x + nz
        j, xi, eta = self._slope_of(x / total, nz / total)
        at = self.cell + 7 * j
        rise = self._at(at + 1) + eta * (self._at(at + 5) + self._at(at + 6) * xi)
        sx, sz = self._slope_at(j, xi, eta)
        first = j == 0
        f = dr.select(first, rise, self._at(at) * eta + xi * rise)
        sx_or_knot = dr.select(first, self._at(self.knot + 8), sx)
        p22 = dr.maximum(f, 0.0) * (sx + sz) ** 4 / (sx_or_knot * self._at(at + 4))
        return dr.select(wm.z >= 0.0, p22 / (total**4 * alpha_x * alpha_y), 0.0)
