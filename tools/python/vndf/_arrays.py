"""From arrays of numpy to the structures of arrays that batches take.

A direction, a pair of numbers, a matrix has its components along its first axes, so that each component is one
contiguous array: directions have shape (3, ...). What follows broadcasts.
"""
from __future__ import annotations

import math
from typing import Any, Callable, Iterable, Optional, Sequence

import numpy as np
import numpy.typing as npt

#: what results are
Floats = npt.NDArray[np.float32]
#: what arguments may be: numbers, sequences, arrays
Numbers = npt.ArrayLike


def as_float(value: Numbers) -> Floats:
    """`value` in float32: itself where it is that."""
    return np.asarray(value, dtype=np.float32)


def _length(value: Any) -> int:
    try:
        return len(value)
    except TypeError:  # a number, or an array of no axes
        return 0


def components(value: Any, count: int, name: str) -> list[Floats]:
    """The `count` components of `value`: an array of shape (count, ...), or a tuple of arrays that broadcast."""
    length = _length(value)
    if length != count:
        raise ValueError(f"{name}: its first axis has length {length}, it must have {count}")
    return [as_float(value[i]) for i in range(count)]


def matrix_components(value: Any, name: str) -> list[Floats]:
    """The components xx, xy, yx, yy of `value`, whose shape is (2, 2, ...)."""
    if _length(value) != 2:
        raise ValueError(f"{name}: it must have shape (2, 2, ...)")
    return components(value[0], 2, name) + components(value[1], 2, name)


def uniform(
    u: Any, count: int, rng: Optional[np.random.Generator], size: Any, shape: Callable[[], Any]
) -> list[Floats]:  # fmt: skip
    """`count` uniform numbers for each element: those of u, in [0, 1], or drawn from `rng` for an array of this size
    (a number or a tuple; None: of `shape()`)."""
    if (u is None) == (rng is None) or (u is not None and size is not None):
        raise TypeError("a sample takes u, or rng=numpy.random.default_rng() and size=")
    if u is None:
        assert rng is not None
        axes = shape() if size is None else tuple(np.atleast_1d(size))
        return list(rng.random((count, *axes), dtype=np.float32))
    rows = components(u, count, "u")
    for row in rows:
        if not (0 <= row.item() <= 1 if row.size == 1 else bool(((row >= 0) & (row <= 1)).all())):
            raise ValueError("u: its numbers must lie in [0, 1]")
    return rows


class Arguments:
    """The arrays of one batch, in groups by name, broadcast to one shape. They live as long as this does."""

    def __init__(self, **groups: Sequence[Floats]) -> None:
        self._groups = groups
        shapes_of_all = {array.shape for group in groups.values() for array in group}
        try:
            self.shape = shapes_of_all.pop() if len(shapes_of_all) == 1 else np.broadcast_shapes(*shapes_of_all)
        except ValueError:
            shapes = ", ".join(f"{name} {tuple(a.shape for a in group)}" for name, group in groups.items())
            raise ValueError(f"shapes of components do not broadcast: {shapes}") from None
        self.count = math.prod(self.shape)
        self._kept: list[Any] = []

    def names(self) -> Iterable[str]:
        return self._groups.keys()

    def is_shared(self, name: str) -> bool:
        """One number for each component serves all elements."""
        return all(array.size == 1 for array in self._groups[name])

    def addresses(self, name: str) -> list[int]:
        """Where the components lie: in place where they are contiguous and of the whole shape, else copied."""
        whole = not self.is_shared(name)
        return [self._address(array, whole) for array in self._groups[name]]

    def whole_addresses(self, name: str) -> list[int]:
        """The same of arrays that cannot be shared."""
        return [self._address(array, True) for array in self._groups[name]]

    def arrays(self, name: str) -> list[Any]:
        """The arrays of a group, of size 1 where it is shared, else of the whole shape."""
        whole = not self.is_shared(name)
        return [np.broadcast_to(array, self.shape) if whole else array for array in self._groups[name]]

    def keep(self, array: Any) -> int:
        """Keeps an array as long as this; returns where it lies."""
        self._kept.append(array)
        return address(array)

    def _address(self, array: Any, whole: bool) -> int:
        if whole and array.shape != self.shape:
            array = np.broadcast_to(array, self.shape)
        return self.keep(array if array.flags.c_contiguous else np.ascontiguousarray(array))

    def result(self, *leading: int, dtype: Any = np.float32) -> Any:
        """An array for results: `leading` axes and those of the batch."""
        return np.empty(leading + self.shape, dtype)


def address(array: Any) -> int:
    """Where an array lies; array.ctypes.data takes five times as long."""
    return int(array.__array_interface__["data"][0])


def addresses_of(array: Any) -> list[int]:
    """Where the components of a result lie."""
    first = address(array)
    return [first + i * array.strides[0] for i in range(array.shape[0])]
