"""Rough surfaces: samples of visible normals, densities, masking.

Arguments are numbers or arrays; they broadcast, and are taken as float32 (arrays that are that, contiguous and of the
whole shape are not copied). Directions have shape (3, ...), pairs of numbers (2, ...), matrices (2, 2, ...): each
component along the first axis; transpose an array of shape (n, 3). Directions are unit and point away from the
surface; z is the geometric normal, x the axis of alpha_x. wi may be anywhere on the sphere. Results are float32, of
the shape that the arguments broadcast to; element i has the bits of the C call for it. The interpreter's lock is free
while C works, so threads may share the work.
"""
from __future__ import annotations

import abc
from ctypes import byref
from typing import Any, NamedTuple, Optional, Sequence, Union

import numpy as np

from . import _library
from ._arrays import Arguments, Floats, Numbers, addresses_of, as_float, components, matrix_components
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


_NO_DIRECTION = object()  # of calls that have no wi


def roughness(alpha: Any, alpha_y: Any) -> list[Floats]:
    """alpha along x and y. A single number that is no roughness is refused; in arrays it scatters nothing."""
    both = [as_float(alpha), as_float(alpha if alpha_y is None else alpha_y)]
    for array in both:
        if array.size == 1 and not 0 < array.item() < np.inf:
            raise ValueError(f"alpha is {array.item()}; it must be above 0")
    return both


class _Rough(abc.ABC):
    """What all surfaces answer."""

    _prefix: str  # of the C calls

    @abc.abstractmethod
    def _shape_groups(self) -> dict[str, list[Floats]]:
        """The arrays of the surface itself, in groups that may be shared."""

    @abc.abstractmethod
    def _batch(self, arguments: Arguments, wi: list[Any]) -> Any:
        """The C struct of a batch."""

    def _open(self, wi: Any, **inputs: list[Floats]) -> tuple[Arguments, Any]:
        groups = self._shape_groups()
        if wi is not _NO_DIRECTION:
            groups["wi"] = components(wi, 3, "wi")
        arguments = Arguments(**groups, **inputs)
        return arguments, self._batch(arguments, arguments.addresses("wi") if "wi" in groups else [None] * 3)

    def _shared(self, arguments: Arguments) -> int:
        names = {"shape": _library.SHARED_ALPHA, "wi": _library.SHARED_WI, "weight": _library.SHARED_WEIGHT}
        return sum(bit for name, bit in names.items() if name in arguments.names() and arguments.is_shared(name))

    def _call(self, name: str, *arguments: Any) -> None:
        getattr(library, f"{self._prefix}{name}_n")(*arguments)

    def _of_normal(self, name: str, wi: Any, wm: Any) -> Floats:
        arguments, batch = self._open(wi, wm=components(wm, 3, "wm"))
        result = arguments.result()
        normals = _library.vndf_normals(*arguments.whole_addresses("wm"))
        self._call(name, byref(batch), normals, result.ctypes.data)
        return result[()]  # type: ignore[no-any-return]

    def _of_direction(self, name: str, w: Any) -> Floats:
        arguments, batch = self._open(w)
        result = arguments.result()
        self._call(name, byref(batch), result.ctypes.data)
        return result[()]  # type: ignore[no-any-return]

    def _draw(self, name: str, wi: Any, u: Any, *, extra: Sequence[Any]) -> tuple[Floats, list[Any]]:
        arguments, batch = self._open(wi, u=components(u, 2, "u"))
        wm = arguments.result(3)
        results = [arguments.result(dtype=dtype) for dtype in extra]
        self._call(
            name, byref(batch), *arguments.whole_addresses("u"), _library.vndf_normals(*addresses_of(wm)),
            *[result.ctypes.data for result in results],
        )  # fmt: skip
        return wm, [result[()] for result in results]

    def pdf(self, wi: Any, wm: Any) -> Floats:
        """Density per steradian with which ``sample`` draws wm (3, ...), a unit normal."""
        return self._of_normal("pdf", wi, wm)

    def visible(self, wi: Any, wm: Any) -> Floats:
        """The true density of visible normals, max(0, wi.wm) D(wm)/A(wi), per steradian."""
        return self._of_normal("visible", wi, wm)

    def invert(self, wi: Any, wm: Any) -> Floats:
        """The numbers u, shape (2, ...), that ``sample`` turns into wm."""
        arguments, batch = self._open(wi, wm=components(wm, 3, "wm"))
        u = arguments.result(2)
        normals = _library.vndf_normals(*arguments.whole_addresses("wm"))
        self._call("invert", byref(batch), normals, *addresses_of(u))
        return u  # type: ignore[no-any-return]

    def ndf(self, wm: Any) -> Floats:
        """D(wm), per steradian; integral of D cos(theta) is 1."""
        return self._of_normal("ndf", _NO_DIRECTION, wm)

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
        one, other = np.float64(self.g1(wi)), np.float64(self.g1(wo))
        if model == "separable":
            return as_float(one * other)[()]
        if model != "height-correlated":
            raise ValueError(f'model is "height-correlated" or "separable", not {model!r}')
        product = one * other
        return as_float(np.divide(product, one + other - product, out=np.zeros_like(product), where=product > 0))[()]


class _OneLobe(_Rough):
    """Surfaces of one distribution."""

    def sample(self, wi: Any, u: Any) -> Sample:
        """Visible normals from wi (3, ...) and uniform numbers u (2, ...) in [0, 1]. An invalid direction or roughness
        gives the normal (0, 0, 1) and density 0."""
        wm, (pdf,) = self._draw("sample", wi, u, extra=[np.float32])
        return Sample(wm, pdf)


class Surface(_OneLobe):
    """A distribution stretched by roughness: ``alpha`` along x, ``alpha_y`` along y (None: the same), > 0, numbers or
    arrays. alpha = 1 is the distribution as it was built."""

    _prefix = ""

    def __init__(self, distribution: Distribution, alpha: Numbers = 1.0, alpha_y: Optional[Numbers] = None) -> None:
        want(distribution, Distribution)
        self.distribution = distribution
        self._alpha = roughness(alpha, alpha_y)

    def _shape_groups(self) -> dict[str, list[Floats]]:
        return {"shape": self._alpha}

    def _batch(self, arguments: Arguments, wi: list[Any]) -> Any:
        return _library.vndf_batch(
            self.distribution._pointer, arguments.count, self._shared(arguments), 0, *arguments.addresses("shape"), *wi
        )

    def sample_weight(self, wi: Any, u: Any) -> WeightedSample:
        """:meth:`sample` with the weight visible/pdf, for less than two calls cost."""
        wm, (pdf, weight) = self._draw("sample_weight", wi, u, extra=[np.float32, np.float32])
        return WeightedSample(wm, pdf, weight)


class Affine(_OneLobe):
    """A distribution whose slopes are stretched, turned and sheared by ``matrix``, shape (2, 2, ...), and moved by
    ``mean``, shape (2, ...): slopes s = M u + mean, as filtered normal maps have them (vndf.h)."""

    _prefix = "affine_"

    def __init__(self, distribution: Distribution, matrix: Any, mean: Any = (0.0, 0.0)) -> None:
        want(distribution, Distribution)
        self.distribution = distribution
        self._shape = matrix_components(matrix, "matrix") + components(mean, 2, "mean")

    @staticmethod
    def rotated(distribution: Distribution, alpha: Numbers, alpha_y: Numbers, angle: Numbers) -> Affine:
        """Roughness `alpha` along the direction at `angle` (radians) from x, `alpha_y` across it."""
        c, s = np.cos(angle), np.sin(angle)
        along, across = np.asarray(alpha), np.asarray(alpha_y)
        return Affine(distribution, ((c * along, -s * across), (s * along, c * across)))

    def _shape_groups(self) -> dict[str, list[Floats]]:
        return {"shape": self._shape}

    def _batch(self, arguments: Arguments, wi: list[Any]) -> Any:
        return _library.vndf_affine_batch(
            self.distribution._pointer, arguments.count, self._shared(arguments), 0, *arguments.addresses("shape"), *wi
        )


def _as_affine(surface: Union[Surface, Affine]) -> Affine:
    want(surface, (Surface, Affine))
    if isinstance(surface, Affine):
        return surface
    x, y = surface._alpha
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
        self.weights = [as_float(weight) for _, weight in lobes]

    def _shape_groups(self) -> dict[str, list[Floats]]:
        return {"shape": [part for lobe in self.lobes for part in lobe._shape], "weight": self.weights}

    def _batch(self, arguments: Arguments, wi: list[Any]) -> Any:
        shapes, weights = arguments.addresses("shape"), arguments.addresses("weight")
        batch = _library.vndf_mixture_batch(arguments.count, self._shared(arguments), 0, *wi, len(self.lobes))
        for i, lobe in enumerate(self.lobes):
            pointer = lobe.distribution._pointer
            batch.lobe[i] = _library.vndf_lobe_batch(pointer, *shapes[6 * i : 6 * i + 6], weights[i])
        return batch

    def sample(self, wi: Any, u: Any) -> MixtureSample:
        """As of other surfaces; u[0] chooses the lobe too, which is told."""
        wm, (pdf, lobe) = self._draw("sample", wi, u, extra=[np.float32, np.int32])
        return MixtureSample(wm, pdf, lobe)

    def invert(self, wi: Any, wm: Any) -> Floats:
        """The numbers u, shape (2, ...), that draw wm from the lobe that draws it most often."""
        arguments, batch = self._open(wi, wm=components(wm, 3, "wm"))
        u, lobe = arguments.result(2), arguments.result(dtype=np.int32)
        normals = _library.vndf_normals(*arguments.whole_addresses("wm"))
        self._call("invert", byref(batch), normals, None, *addresses_of(u), lobe.ctypes.data)
        return u  # type: ignore[no-any-return]


class Family(Owner):
    """Distributions along one parameter, a mixture of two neighbours between them. From ``Family.build``,
    ``Family.load`` or ``Family.of``."""

    _free = "family_free"

    def __init__(self, pointer: int, keep: Sequence[Distribution] = ()) -> None:
        """For the package itself. `keep`: what has to live as long."""
        super().__init__(pointer)
        self._keep = keep

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
        return reporter.run(lambda: Family(checked("build_family", name, low, high, byref(options))))

    @staticmethod
    def load(path: Path) -> Family:
        """Reads a file of ``vndf build --parameter``."""
        return Family(checked("family_load", path_bytes(path)))

    @staticmethod
    def of(distributions: Sequence[Distribution], parameters: Sequence[float]) -> Family:
        """Distributions of any kind at ascending parameters."""
        if len(distributions) != len(parameters):
            raise ValueError(f"{len(distributions)} distributions at {len(parameters)} parameters")
        pointers = np.array([d._pointer for d in distributions], np.uintp)
        at = np.array(parameters, np.float32)
        pointer = checked("family_of", pointers.ctypes.data, at.ctypes.data, len(pointers))
        return Family(pointer, list(distributions))

    def save(self, path: Path) -> None:
        """Writes the family to a file."""
        checked("family_save", self._pointer, path_bytes(path))

    @property
    def info(self) -> dict[str, Any]:
        """source, tool, bytes, memory, count, low, high, reciprocal, distance, grazing (vndf_family_facts)."""
        return members(library.family_info(self._pointer))

    @property
    def parameters(self) -> Floats:
        """Where its distributions stand, shape (count,)."""
        count = self.info["count"]
        return as_float([library.family_parameter(self._pointer, i) for i in range(count)])

    def at(self, parameter: float, alpha: Numbers = 1.0, alpha_y: Optional[Numbers] = None) -> Mixture:
        """The family at one parameter, which is clamped to its range, with this roughness."""
        mixture = _library.vndf_mixture()
        shape = _library.vndf_affine(None, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0)
        library.family_at(self._pointer, parameter, byref(shape), byref(mixture))
        if mixture.count == 0:
            raise ValueError(f"a family has no distribution at {parameter}")
        lobes = [mixture.lobe[i] for i in range(mixture.count)]
        owned = [Distribution(lobe.surface.distribution, owner=self) for lobe in lobes]
        return Mixture(*[(Surface(d, alpha, alpha_y), lobe.weight) for d, lobe in zip(owned, lobes)])
