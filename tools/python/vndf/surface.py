"""Rough surfaces: samples of visible normals, densities, masking.

Arguments are numbers or arrays; they broadcast, and are taken as float32. Directions have shape (3, ...), pairs of
numbers (2, ...), matrices (2, 2, ...). Directions are unit and point away from the surface; z is the geometric normal,
x the axis of alpha; wi may be anywhere on the sphere. Element i of a result has the bits of the C call for it.
"""
from __future__ import annotations

import functools
from collections import namedtuple
from ctypes import byref
from typing import Any, Optional, Sequence

import numpy as np

from ._arrays import Batch, Floats, Numbers, addresses_of, components, stacked, uniform
from ._library import Stored, checked, constant, library, record, struct, text_bytes, values, want
from .build import Progress, _Call
from .distribution import Distribution


#: Visible normals, unit, shape (3, ...), and the density per steradian with which they were drawn, shape (...).
Sample = namedtuple("Sample", ["wm", "pdf"])
#: The same with the weight visible(wi, wm)/pdf(wi, wm), which makes an estimator exact.
WeightedSample = namedtuple("WeightedSample", ["wm", "pdf", "weight"])
#: The same with the index of the lobe that was drawn, int32; -1 of what is invalid.
MixtureSample = namedtuple("MixtureSample", ["wm", "pdf", "lobe"])


def batch_of(distribution: Distribution, shape: list[Any]) -> Any:
    """Surfaces as C takes many: by the addresses of alpha along x and y, or of a matrix and a mean slope."""
    six = shape if len(shape) == 6 else [shape[0], None, None, shape[1], None, None]
    return struct("vndf_surface_batch")(distribution._pointer, *six)


class Rough:
    """What all surfaces answer."""

    _groups: dict[str, Floats]  # "shape", and "weight" of mixtures

    def _struct(self, batch: Batch, wi: Sequence[Any]) -> Any:
        """The C struct of a batch."""
        raise NotImplementedError

    def _ask(self, name: str, rows: int, **given: Floats) -> Floats:
        """What C answers: `rows` numbers for each element; of drawn lobes the bits of their index are the last."""
        batch = Batch(**self._groups, **given)
        filled = self._struct(batch, batch.addresses("wi", share=True) if "wi" in given else [None] * 3)
        result = np.empty((rows, *batch.shape), np.float32)
        to: list[Any] = addresses_of(result)
        if "u" in given:
            to = [*batch.addresses("u"), struct("vndf_normals")(*to[:3]), *to[3:]]
        elif "wm" in given:
            to = [struct("vndf_normals")(*batch.addresses("wm")), *to]
        if name == "sample" and filled.lobes:
            filled.drawn = to.pop()
        getattr(library, f"{name}_n")(byref(filled), *to)
        return result

    def _draw(self, name: str, rows: int, wi: Any, u: Any) -> Floats:
        w = components(wi, 3, "wi")
        numbers = uniform(u, 2, lambda: Batch(**self._groups, wi=w).shape)
        return self._ask(name, rows, wi=w, u=numbers)

    def _look(self, name: str, **given: Any) -> Floats:
        number: Floats = self._ask(name, 1, **{key: components(w, 3, key) for key, w in given.items()})[0]
        return number

    def pdf(self, wi: Any, wm: Any) -> Floats:
        """Density per steradian with which ``sample`` draws wm (3, ...), a unit normal."""
        return self._look("pdf", wi=wi, wm=wm)

    def visible(self, wi: Any, wm: Any) -> Floats:
        """The true density of visible normals, max(0, wi.wm) D(wm)/A(wi), per steradian."""
        return self._look("visible", wi=wi, wm=wm)

    def invert(self, wi: Any, wm: Any) -> Floats:
        """The numbers u, shape (2, ...), that ``sample`` turns into wm; of a mixture from the lobe that draws it most
        often."""
        return self._ask("invert", 2, wi=components(wi, 3, "wi"), wm=components(wm, 3, "wm"))

    def ndf(self, wm: Any) -> Floats:
        """D(wm), per steradian; integral of D cos(theta) is 1."""
        return self._look("ndf", wm=wm)

    def projected_area(self, wi: Any) -> Floats:
        """A(wi) = integral max(0, wi.wm) D(wm) dwm, any wi on the sphere."""
        return self._look("projected_area", wi=wi)

    def lambda_(self, wi: Any) -> Floats:
        """Smith's Lambda(wi) = A(wi)/cos(theta) - 1."""
        return self._look("lambda", wi=wi)

    def g1(self, wi: Any) -> Floats:
        """Smith's masking, 0 to 1; 0 below the horizon. The factor for wi.wm <= 0 is the caller's."""
        return self._look("g1", wi=wi)

    def g2(self, wi: Any, wo: Any, model: str = "height-correlated") -> Floats:
        """Masking and shadowing of two directions, 0 to 1; 0 if one is below the horizon. "height-correlated" or
        "separable". From :meth:`g1` of both, in double."""
        if model not in ("height-correlated", "separable"):
            raise ValueError(f'model is "height-correlated" or "separable", not {model!r}')
        one, other = np.float64(self.g1(wi)), np.float64(self.g1(wo))
        product = one * other
        under = 1.0 if model == "separable" else one + other - product
        return stacked(np.divide(product, under, out=np.zeros_like(product), where=product > 0))[()]


class Surface(Rough):
    """A distribution, stretched: by ``alpha`` along x and ``alpha_y`` along y (None: the same), > 0, and turned by
    ``rotation``, the angle from x to the axis of alpha, radians; or by any ``matrix``, shape (2, 2, ...), and moved by
    a ``mean`` slope, shape (2, ...), as filtered normal maps have them: slopes are M u + mean. alpha = 1 is the
    distribution as it was built. Single numbers that are no surface are refused; in arrays they scatter nothing."""

    def __init__(
        self, distribution: Distribution, alpha: Numbers = 1.0, alpha_y: Optional[Numbers] = None, *,
        rotation: Optional[Numbers] = None, matrix: Any = None, mean: Any = None,
    ) -> None:  # fmt: skip
        want(distribution, Distribution)
        self.distribution = distribution
        if matrix is None:
            if mean is not None:
                raise TypeError("a mean slope needs a matrix")
            shape = stacked((alpha, alpha if alpha_y is None else alpha_y))
            if shape.ndim == 1 and not all(0 < a < np.inf for a in shape.tolist()):
                raise ValueError(f"alpha is {shape.tolist()}; it must be above 0")
            if not (shape > 0).all():
                shape = np.where(shape > 0, shape, np.float32(np.nan))
            if rotation is not None:
                x, y, c, s = *shape, np.cos(rotation), np.sin(rotation)
                shape = stacked((c * x, -s * y, s * x, c * y, 0.0, 0.0))
        else:
            rows = stacked(matrix)
            if rows.shape[:2] != (2, 2):
                raise ValueError(f"matrix: its shape is {rows.shape}, it must be (2, 2, ...)")
            moved = components((0.0, 0.0) if mean is None else mean, 2, "mean")
            shape = stacked([*rows.reshape(4, *rows.shape[2:]), *moved])
            if shape.ndim == 1 and not (np.isfinite(shape).all() and shape[0] * shape[3] != shape[1] * shape[2]):
                raise ValueError(f"matrix and mean are {shape.tolist()}; they must be finite, and not singular")
        self._is_moved = mean is not None
        self._groups = {"shape": shape}

    @property
    def _six(self) -> Any:
        """The matrix and the mean slope, row by row."""
        shape = self._groups["shape"]
        return shape if len(shape) == 6 else (shape[0], 0.0, 0.0, shape[1], 0.0, 0.0)

    def _struct(self, batch: Batch, wi: Sequence[Any]) -> Any:
        surfaces = batch_of(self.distribution, batch.addresses("shape", share=True))
        return struct("vndf_batch")(surfaces, batch.count, batch.shared(), 0, *wi)

    def sample(self, wi: Any, u: Any) -> Sample:
        """Visible normals from wi (3, ...) and uniform numbers u (2, ...) in [0, 1], or a `numpy.random.default_rng()`
        that draws them, one sample an element. An invalid direction or roughness gives (0, 0, 1) and density 0."""
        result = self._draw("sample", 4, wi, u)
        return Sample(result[:3], result[3])

    def sample_weight(self, wi: Any, u: Any) -> WeightedSample:
        """:meth:`sample` with the weight visible/pdf, for less than two calls cost."""
        result = self._draw("sample_weight", 5, wi, u)
        return WeightedSample(result[:3], result[3], result[4])

    def __repr__(self) -> str:
        shape = self._groups["shape"]
        numbers = [f"{row.item():.4g}" if row.size == 1 else f"array{row.shape}" for row in shape]
        what = "alpha" if len(shape) == 2 else "matrix and mean"
        return f"<vndf.Surface of {self.distribution!r}, {what} {', '.join(numbers)}>"


class Mixture(Rough):
    """Up to 8 lobes on one surface, D = sum of w_i D_i: pairs of a :class:`Surface` and a weight >= 0, which counts
    over the sum of all, and may be an array."""

    def __init__(self, *lobes: tuple[Surface, Numbers]) -> None:
        most = constant("VNDF_MIXTURE_LOBES")
        if not 1 <= len(lobes) <= most:
            raise ValueError(f"a mixture has 1 to {most} lobes, not {len(lobes)}")
        if not all(isinstance(lobe, tuple) and len(lobe) == 2 for lobe in lobes):
            raise TypeError("the lobes of a mixture are pairs (surface, weight), one argument each")
        for surface, _ in lobes:
            want(surface, Surface)
        self.lobes = [surface for surface, _ in lobes]
        self.weights = stacked([weight for _, weight in lobes])
        if self.weights.ndim == 1 and not (all(0 <= w < np.inf for w in self.weights) and any(self.weights)):
            raise ValueError(f"weights are {self.weights.tolist()}; they must be 0 or above, and not all 0")
        self._groups = {"shape": stacked([row for lobe in self.lobes for row in lobe._six]), "weight": self.weights}

    def _struct(self, batch: Batch, wi: Sequence[Any]) -> Any:
        shapes, weights = batch.addresses("shape", share=True), batch.addresses("weight", share=True)
        none = struct("vndf_surface_batch")()
        filled = struct("vndf_batch")(none, batch.count, batch.shared(), 0, *wi, lobes=len(self.lobes))
        for i, lobe in enumerate(self.lobes):
            surfaces = batch_of(lobe.distribution, shapes[6 * i : 6 * i + 6])
            filled.lobe[i] = struct("vndf_lobe_batch")(surfaces, weights[i])
        return filled

    def sample(self, wi: Any, u: Any) -> MixtureSample:
        """As of one surface; u[0] chooses the lobe too, which is told."""
        result = self._draw("sample", 5, wi, u)
        return MixtureSample(result[:3], result[3], result[4:].view(np.int32)[0])

    def __repr__(self) -> str:
        return f"<vndf.Mixture of {', '.join(repr(lobe) for lobe in self.lobes)}>"


#: What a family is (vndf_family_facts).
FamilyInfo = record("vndf_family_facts", "FamilyInfo")


class Family(Stored):
    """Distributions along one parameter, a mixture of two neighbours between them."""

    _free = "family_free"
    _kind = "family_"
    _makers = "vndf.Family.build or vndf.Family.load"

    @staticmethod
    def build(
        specification: str, low: float, high: float, *, max_distance: float = 0.0, knots: int = 0, max_bytes: int = 0,
        moments: int = 0, progress: Optional[Progress] = None,
    ) -> Family:  # fmt: skip
        """Tables of a family of :meth:`Source.family` along the number written {p}, from low to high: as few as reach
        `max_distance` (total variation of slopes; 0: 1e-3), or `knots` of them."""
        call, name = _Call(), text_bytes(specification)
        options = struct("vndf_family_options")(max_distance, knots, max_bytes, moments, call.progress(progress), None)
        return call.run(lambda: Family._of(checked("build_family", name, low, high, byref(options))))

    def __repr__(self) -> str:
        info = self.info
        return f"<vndf.Family {info.source}, {info.count} distributions from {info.low} to {info.high}>"

    @property
    def info(self) -> Any:
        """source, tool, bytes, memory, count, low, high, reciprocal, distance, grazing (vndf_family_facts)."""
        return FamilyInfo(*values(library.family_info(self._pointer)))

    @functools.cached_property
    def parameters(self) -> Floats:
        """Where its distributions stand, shape (count,)."""
        return stacked([library.family_parameter(self._pointer, i) for i in range(self.info.count)])

    @functools.cached_property
    def distributions(self) -> list[Distribution]:
        """Those at :attr:`parameters`."""
        pointers = [library.family_distribution(self._pointer, i) for i in range(self.info.count)]
        return [Distribution._of(pointer, _owner=self) for pointer in pointers]

    def at(self, parameter: float, *shape: Any, **stretched: Any) -> Mixture:
        """The family at a parameter, clamped to its range: a mixture of its neighbours, stretched as a :class:`Surface`
        is: ``family.at(p, alpha, alpha_y, rotation=0.3)``."""
        mixture = struct("vndf_mixture")()
        library.family_at(self._pointer, float(parameter), byref(struct("vndf_surface")()), byref(mixture))
        if not mixture.count:
            raise ValueError(f"a family has no distribution at {parameter!r}")
        known = {distribution._pointer: distribution for distribution in self.distributions}
        return Mixture(*((Surface(known[lobe.surface.distribution], *shape, **stretched), lobe.weight)
                         for lobe in mixture.lobe[: mixture.count]))  # fmt: skip
