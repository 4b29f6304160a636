"""Rough surfaces: samples of visible normals, densities, masking.

Arguments are numbers or arrays; they broadcast, and are taken as float32 (arrays that are that, contiguous and of the
whole shape are not copied). Directions have shape (3, ...), pairs of numbers (2, ...), matrices (2, 2, ...): each
component along the first axis; transpose an array of shape (n, 3). Directions are unit and point away from the
surface; z is the geometric normal, x the axis of alpha_x. wi may be anywhere on the sphere. Results are float32, of
the shape that the arguments broadcast to; element i has the bits of the C call for it. The interpreter's lock is free
while C works, so threads may share the work.
"""
from __future__ import annotations

import functools
from ctypes import byref
from typing import Any, NamedTuple, Optional, Sequence, Union

import numpy as np

from . import _library
from ._arrays import Batch, Floats, Generator, Numbers, Size, addresses_of, components, stacked, uniform
from ._library import Owner, checked, library, members, path_bytes, text_bytes, want
from .build import Progress, Reporter
from .distribution import Distribution, Path


class Sample(NamedTuple):
    """Visible normals and how they were drawn."""

    wm: Floats  #: unit normals, shape (3, ...)
    pdf: Floats  #: density per steradian with which wm was drawn, shape (...)


class WeightedSample(NamedTuple):
    """The same with the weight that makes an estimator exact."""

    wm: Floats
    pdf: Floats
    weight: Floats  #: visible(wi, wm)/pdf(wi, wm), shape (...)


class MixtureSample(NamedTuple):
    """The same with the lobe that was drawn."""

    wm: Floats
    pdf: Floats
    lobe: np.ndarray[Any, np.dtype[np.int32]]  #: its index, -1 of what is invalid, shape (...)


def roughness(alpha: Any, alpha_y: Any) -> Floats:
    """alpha along x and y. A single number that is no roughness is refused; in arrays it scatters nothing."""
    both = stacked((alpha, alpha if alpha_y is None else alpha_y))
    if both.size == 2:
        for a in both.ravel().tolist():
            if not 0 < a < np.inf:
                raise ValueError(f"alpha is {a}; it must be above 0")
    return both


def stretched(matrix: Any, mean: Any) -> Floats:
    """A matrix of slopes and a mean slope. Single numbers that are no surface are refused; in arrays they scatter
    nothing."""
    rows = stacked(matrix)
    if rows.shape[:2] != (2, 2):
        raise ValueError(f"matrix: its shape is {rows.shape}, it must be (2, 2, ...)")
    shape = stacked([*rows.reshape(4, *rows.shape[2:]), *components(mean, 2, "mean")])
    if shape.size == 6:
        xx, xy, yx, yy, *moved = shape.ravel().tolist()
        if not (xx * yy != xy * yx and np.isfinite([xx, xy, yx, yy]).all()):
            raise ValueError(f"matrix is (({xx}, {xy}), ({yx}, {yy})); it must be finite and not singular")
        if not np.isfinite(moved).all():
            raise ValueError(f"mean is {tuple(moved)}; it must be finite")
    return shape


class _Rough:
    """What all surfaces answer."""

    _prefix = ""  # of the C calls
    _groups: dict[str, Floats]  # "shape", and "weight" of mixtures

    def _struct(self, batch: Batch, wi: Sequence[Any]) -> Any:
        """The C struct of a batch."""
        raise NotImplementedError

    def _shared(self, batch: Batch) -> int:
        bits = {"shape": _library.SHARED_ALPHA, "wi": _library.SHARED_WI, "weight": _library.SHARED_WEIGHT}
        return sum(bit for name, bit in bits.items() if name in batch.groups and batch.is_shared(name))

    def _ask(self, name: str, rows: int, *, lobe: bool = False, **given: Floats) -> Floats:
        """What C answers: `rows` numbers for each element, and the bits of the lobe's index after them."""
        batch = Batch(**self._groups, **given)
        struct = self._struct(batch, batch.addresses("wi", share=True) if "wi" in given else [None] * 3)
        result = batch.result(rows + lobe)
        to: list[Any] = addresses_of(result)
        if "u" in given:
            to = [*batch.addresses("u"), _library.vndf_normals(*to[:3]), *to[3:]]
        elif "wm" in given:
            to = [_library.vndf_normals(*batch.addresses("wm")), *([None] if lobe else []), *to]
        getattr(library, f"{self._prefix}{name}_n")(byref(struct), *to)
        return result

    def _draw(self, name: str, rows: int, wi: Any, u: Any, rng: Generator, size: Size, lobe: bool = False) -> list[Any]:
        """Normals, then what else was asked for."""
        w = components(wi, 3, "wi")
        numbers = uniform(u, 2, rng, size, lambda: Batch(**self._groups, wi=w).shape)
        result = self._ask(name, rows, lobe=lobe, wi=w, u=numbers)
        return [result[:3], *result[3:rows], *(result[rows:].view(np.int32))]

    def _of_normal(self, name: str, wi: Any, wm: Any) -> Floats:
        return self._ask(name, 1, wi=components(wi, 3, "wi"), wm=components(wm, 3, "wm"))[0]  # type: ignore[no-any-return]

    def _of_direction(self, name: str, w: Any) -> Floats:
        return self._ask(name, 1, wi=components(w, 3, "wi"))[0]  # type: ignore[no-any-return]

    def pdf(self, wi: Any, wm: Any) -> Floats:
        """Density per steradian with which ``sample`` draws wm (3, ...), a unit normal."""
        return self._of_normal("pdf", wi, wm)

    def visible(self, wi: Any, wm: Any) -> Floats:
        """The true density of visible normals, max(0, wi.wm) D(wm)/A(wi), per steradian."""
        return self._of_normal("visible", wi, wm)

    def invert(self, wi: Any, wm: Any) -> Floats:
        """The numbers u, shape (2, ...), that ``sample`` turns into wm; of a mixture from the lobe that draws it most
        often."""
        lobe = self._prefix == "mixture_"
        return self._ask("invert", 2, lobe=lobe, wi=components(wi, 3, "wi"), wm=components(wm, 3, "wm"))[:2]

    def ndf(self, wm: Any) -> Floats:
        """D(wm), per steradian; integral of D cos(theta) is 1."""
        return self._ask("ndf", 1, wm=components(wm, 3, "wm"))[0]  # type: ignore[no-any-return]

    def projected_area(self, w: Any) -> Floats:
        """A(w) = integral max(0, w.wm) D(wm) dwm, any w on the sphere."""
        return self._of_direction("projected_area", w)

    def lambda_(self, w: Any) -> Floats:
        """Smith's Lambda(w) = A(w)/cos(theta) - 1."""
        return self._of_direction("lambda", w)

    def g1(self, w: Any) -> Floats:
        """Smith's masking, 0 to 1; 0 below the horizon. The factor for w.wm <= 0 is the caller's."""
        return self._of_direction("g1", w)

    def g2(self, wi: Any, wo: Any, model: str = "height-correlated") -> Floats:
        """Masking and shadowing of two directions, 0 to 1; 0 if one is below the horizon. "height-correlated" or
        "separable". From :meth:`g1` of both, in double."""
        if model not in ("height-correlated", "separable"):
            raise ValueError(f'model is "height-correlated" or "separable", not {model!r}')
        one, other = np.float64(self.g1(wi)), np.float64(self.g1(wo))
        product = one * other
        under = 1.0 if model == "separable" else one + other - product
        return stacked(np.divide(product, under, out=np.zeros_like(product), where=product > 0))[()]


class _OneLobe(_Rough):
    """Surfaces of one distribution."""

    _batch: Any  # the C struct

    def __init__(self, distribution: Distribution, shape: Floats) -> None:
        want(distribution, Distribution)
        self.distribution = distribution
        self._groups = {"shape": shape}

    def _struct(self, batch: Batch, wi: Sequence[Any]) -> Any:
        shape = batch.addresses("shape", share=True)
        return self._batch(self.distribution._pointer, batch.count, self._shared(batch), 0, *shape, *wi)

    def sample(self, wi: Any, u: Any = None, *, rng: Generator = None, size: Size = None) -> Sample:
        """Visible normals from wi (3, ...) and uniform numbers u (2, ...) in [0, 1]; in place of u an `rng`
        (``numpy.random.default_rng()``) draws them, of shape (2, *size), by default one sample an element. An invalid
        direction or roughness gives the normal (0, 0, 1) and density 0."""
        return Sample(*self._draw("sample", 4, wi, u, rng, size))

    def sample_weight(self, wi: Any, u: Any = None, *, rng: Generator = None, size: Size = None) -> WeightedSample:
        """:meth:`sample` with the weight visible/pdf, for less than two calls cost."""
        return WeightedSample(*self._draw("sample_weight", 5, wi, u, rng, size))

    def __repr__(self) -> str:
        shape = self._groups["shape"]
        numbers = [f"{row.item():.4g}" if row.size == 1 else f"array{row.shape}" for row in shape]
        what = "alpha" if len(shape) == 2 else "matrix and mean"
        return f"<vndf.{type(self).__name__} of {self.distribution!r}, {what} {', '.join(numbers)}>"


class Surface(_OneLobe):
    """A distribution stretched by roughness: ``alpha`` along x, ``alpha_y`` along y (None: the same), > 0, numbers or
    arrays. alpha = 1 is the distribution as it was built."""

    _batch = _library.vndf_batch

    def __init__(self, distribution: Distribution, alpha: Numbers = 1.0, alpha_y: Optional[Numbers] = None) -> None:
        super().__init__(distribution, roughness(alpha, alpha_y))


class Affine(_OneLobe):
    """A distribution whose slopes are stretched, turned and sheared by ``matrix``, shape (2, 2, ...), and moved by
    ``mean``, shape (2, ...): slopes s = M u + mean, as filtered normal maps have them (vndf.h)."""

    _prefix = "affine_"
    _batch = _library.vndf_affine_batch

    def __init__(self, distribution: Distribution, matrix: Any, mean: Any = (0.0, 0.0)) -> None:
        super().__init__(distribution, stretched(matrix, mean))

    @staticmethod
    def rotated(distribution: Distribution, alpha: Numbers, alpha_y: Numbers, angle: Numbers) -> Affine:
        """Roughness `alpha` along the direction at `angle` (radians) from x, `alpha_y` across it."""
        c, s = np.cos(angle), np.sin(angle)
        along, across = np.asarray(alpha), np.asarray(alpha_y)
        return Affine(distribution, ((c * along, -s * across), (s * along, c * across)))


def _as_affine(surface: Union[Surface, Affine]) -> Affine:
    want(surface, (Surface, Affine))
    if isinstance(surface, Affine):
        return surface
    x, y = surface._groups["shape"]
    return Affine(surface.distribution, ((x, 0.0), (0.0, y)))


class Mixture(_Rough):
    """Up to 8 lobes on one surface, D = sum of w_i D_i: pairs of a :class:`Surface` or :class:`Affine` and a weight
    >= 0. Weights, matrices and mean slopes may be arrays; weights count over their sum."""

    _prefix = "mixture_"

    def __init__(self, *lobes: tuple[Union[Surface, Affine], Numbers]) -> None:
        if not 1 <= len(lobes) <= _library.MIXTURE_LOBES:
            raise ValueError(f"a mixture has 1 to {_library.MIXTURE_LOBES} lobes, not {len(lobes)}")
        if not all(isinstance(lobe, tuple) and len(lobe) == 2 for lobe in lobes):
            raise TypeError("the lobes of a mixture are pairs (surface, weight), one argument each")
        self.lobes = [_as_affine(surface) for surface, _ in lobes]
        self.weights = stacked([weight for _, weight in lobes])
        shapes = stacked([part for lobe in self.lobes for part in lobe._groups["shape"]])
        self._groups = {"shape": shapes, "weight": self.weights}
        single = self.weights.ravel().tolist() if self.weights.size == len(lobes) else []
        if single and not (all(0 <= weight < np.inf for weight in single) and any(single)):
            raise ValueError(f"weights are {single}; they must be 0 or above, and not all 0")

    def _struct(self, batch: Batch, wi: Sequence[Any]) -> Any:
        shapes, weights = batch.addresses("shape", share=True), batch.addresses("weight", share=True)
        struct = _library.vndf_mixture_batch(batch.count, self._shared(batch), 0, *wi, len(self.lobes))
        for i, lobe in enumerate(self.lobes):
            parts = shapes[6 * i : 6 * i + 6]
            struct.lobe[i] = _library.vndf_lobe_batch(lobe.distribution._pointer, *parts, weights[i])
        return struct

    def sample(self, wi: Any, u: Any = None, *, rng: Generator = None, size: Size = None) -> MixtureSample:
        """As of other surfaces; u[0] chooses the lobe too, which is told."""
        return MixtureSample(*self._draw("sample", 4, wi, u, rng, size, lobe=True))

    def __repr__(self) -> str:
        return f"<vndf.Mixture of {', '.join(repr(lobe) for lobe in self.lobes)}>"


class Family(Owner):
    """Distributions along one parameter, a mixture of two neighbours between them. From ``Family.build``,
    ``Family.load`` or ``Family.of``."""

    _free = "family_free"
    _makers = "vndf.Family.build, vndf.Family.load or vndf.Family.of"
    _given: Sequence[Distribution] = ()  # what `of` was given

    @staticmethod
    def build(
        specification: str, low: float, high: float, *, max_distance: float = 0.0, knots: int = 0, max_bytes: int = 0,
        moments: int = 0, progress: Optional[Progress] = None,
    ) -> Family:  # fmt: skip
        """Tables of a family of :meth:`Source.family` along the number written {p}, from low to high: as few as reach
        `max_distance` (total variation of slopes; 0: 1e-3), or `knots` of them."""
        reporter = Reporter(progress)
        options = _library.vndf_family_options(max_distance, knots, max_bytes, moments, reporter.pointer, None)
        name = text_bytes(specification)
        return reporter.run(lambda: Family._of(checked("build_family", name, low, high, byref(options))))

    @staticmethod
    def load(path: Path) -> Family:
        """Reads a file of ``vndf build --parameter``."""
        return Family._of(checked("family_load", path_bytes(path)))

    @staticmethod
    def of(distributions: Sequence[Distribution], parameters: Sequence[float]) -> Family:
        """Distributions of any kind at ascending parameters."""
        if len(distributions) != len(parameters):
            raise ValueError(f"{len(distributions)} distributions at {len(parameters)} parameters")
        for distribution in distributions:
            want(distribution, Distribution)
        pointers = np.array([d._pointer for d in distributions], np.uintp)
        at = np.array(parameters, np.float32)
        pointer = checked("family_of", pointers.ctypes.data, at.ctypes.data, len(pointers))
        return Family._of(pointer, _given=list(distributions))

    @staticmethod
    def from_bytes(data: bytes) -> Family:
        """A family from the bytes of its file, ``bytes(family)``."""
        array = np.frombuffer(data, np.uint8)
        return Family._of(checked("family_load_memory", array.ctypes.data, array.size))

    def __bytes__(self) -> bytes:
        data = np.empty(self.info["bytes"], np.uint8)
        checked("family_save_memory", self._pointer, data.ctypes.data, data.size)
        return data.tobytes()

    def __reduce__(self) -> Any:
        return (Family.of, (self._given, self.parameters)) if self._given else (Family.from_bytes, (bytes(self),))

    def __repr__(self) -> str:
        facts = self.info
        return f"<vndf.Family {facts['source']}, {facts['count']} distributions from {facts['low']} to {facts['high']}>"

    def save(self, path: Path) -> None:
        """Writes the family to a file."""
        checked("family_save", self._pointer, path_bytes(path))

    @property
    def info(self) -> dict[str, Any]:
        """source, tool, bytes, memory, count, low, high, reciprocal, distance, grazing (vndf_family_facts)."""
        return members(library.family_info(self._pointer))

    @functools.cached_property
    def parameters(self) -> Floats:
        """Where its distributions stand, shape (count,)."""
        return stacked([library.family_parameter(self._pointer, i) for i in range(self.info["count"])])

    @functools.cached_property
    def distributions(self) -> list[Distribution]:
        """Those at :attr:`parameters`."""
        pointers = [library.family_distribution(self._pointer, i) for i in range(self.info["count"])]
        return [Distribution._of(pointer, _owner=self) for pointer in pointers]

    @functools.cached_property
    def axis(self) -> tuple[Any, bool]:
        """Knots where shares of neighbours are linear, ascending, and whether those are of 1/parameter."""
        reciprocal = bool(self.info["reciprocal"])
        return (-1.0 / np.float64(self.parameters) if reciprocal else np.float64(self.parameters)), reciprocal

    def places(self, parameter: Numbers) -> tuple[Any, Any]:
        """Of each parameter the index of the distribution below it, and the share of the next one."""
        knots, reciprocal = self.axis
        p = np.clip(stacked(parameter), self.parameters[0], self.parameters[-1]).astype(np.float64)
        x = -1.0 / p if reciprocal else p
        index = np.clip(np.searchsorted(knots, x, side="right") - 1, 0, max(len(knots) - 2, 0))
        beyond = np.minimum(index + 1, len(knots) - 1)
        width = knots[beyond] - knots[index]
        return index, np.where(width > 0, (x - knots[index]) / np.where(width > 0, width, 1), 0 * x)

    def at(self, parameter: Numbers, alpha: Numbers = 1.0, alpha_y: Optional[Numbers] = None) -> Union[Mixture, Blend]:
        """The family at a parameter, which is clamped to its range, with this roughness; at an array of them, as a
        texture has, a :class:`Blend`."""
        if np.ndim(parameter):
            return Blend(self, parameter, alpha, alpha_y)
        index, share = self.places(parameter)
        if np.isnan(share):
            raise ValueError(f"a family has no distribution at {parameter!r}")
        pair = self.distributions[index : index + 2]
        return Mixture(*((Surface(d, alpha, alpha_y), w) for d, w in zip(pair, (1 - share, share)) if w > 0))


class Blend(_Rough):
    """A family at an array of parameters: each element is a mixture of two neighbours. From :meth:`Family.at`. There is
    one call of C for each pair of neighbours that elements lie between."""

    _prefix = "mixture_"

    def __init__(
        self, family: Family, parameter: Numbers, alpha: Numbers = 1.0, alpha_y: Optional[Numbers] = None
    ) -> None:  # fmt: skip
        want(family, Family)
        self.family = family
        self._groups = {"shape": stacked([parameter, *roughness(alpha, alpha_y)])}

    def _ask(self, name: str, rows: int, *, lobe: bool = False, **given: Floats) -> Floats:
        batch = Batch(**self._groups, **given)
        flat = {group: batch.whole(group).reshape(len(array), -1) for group, array in batch.groups.items()}
        parameter, x, y = flat.pop("shape")
        index, share = self.family.places(parameter)
        result = batch.result(rows + lobe)
        for i in np.unique(index):
            here = np.flatnonzero(index == i)
            pair = zip(self.family.distributions[i : i + 2], (1 - share[here], share[here]))
            mixture = Mixture(*((Surface(d, x[here], y[here]), weight) for d, weight in pair))
            part = mixture._ask(name, rows, lobe=lobe, **{group: array[:, here] for group, array in flat.items()})
            result.reshape(rows + lobe, -1)[:, here] = part
        return result

    def sample(self, wi: Any, u: Any = None, *, rng: Generator = None, size: Size = None) -> MixtureSample:
        """As of other surfaces; the lobe is 0 or 1, the neighbour below or above."""
        return MixtureSample(*self._draw("sample", 4, wi, u, rng, size, lobe=True))

    def __repr__(self) -> str:
        return f"<vndf.Blend of {self.family!r} at parameters of shape {self._groups['shape'].shape[1:]}>"
