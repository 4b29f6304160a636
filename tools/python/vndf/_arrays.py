"""From arrays of numpy to the structures of arrays that batches take.

A direction, a pair of numbers, a matrix has its components along its first axis, so that each component is one
contiguous array: directions have shape (3, ...). What follows broadcasts.
"""
from __future__ import annotations

import math
from typing import Any, Callable

import numpy as np
import numpy.typing as npt

from ._library import constant

#: what results are
Floats = npt.NDArray[np.float32]
#: what arguments may be: numbers, sequences, arrays
Numbers = npt.ArrayLike


def stacked(values: Any) -> Floats:
    """One array, float32, of numbers or arrays that broadcast; itself where it is one."""
    try:
        return np.asarray(values, dtype=np.float32)
    except ValueError:  # of several shapes
        if not isinstance(values, (tuple, list)):
            raise
        return np.stack(np.broadcast_arrays(*(stacked(value) for value in values)))


def components(values: Any, count: int, name: str) -> Floats:
    """The same of shape (count, ...)."""
    array = stacked(values)
    length = len(array) if array.ndim else 0
    if length != count:
        raise ValueError(f"{name}: its first axis has length {length}, it must have {count}")
    return array


def uniform(u: Any, count: int, shape: Callable[[], Any]) -> Floats:
    """`count` uniform numbers for each element: those of u, in [0, 1], or of shape() where u is a generator."""
    if isinstance(u, np.random.Generator):
        return u.random((count, *shape()), dtype=np.float32)
    numbers = components(u, count, "u")
    few = numbers.ravel().tolist() if numbers.size < 10 else [numbers.min(), numbers.max()]  # quick for one element
    if not all(0 <= number <= 1 for number in few):  # false for NaN, which min() keeps
        raise ValueError("u: its numbers must lie in [0, 1]")
    return numbers


class Batch:
    """The arguments of one call by name, each an array (components, ...), broadcast to one shape. What C reads lives as
    long as this does."""

    def __init__(self, **groups: Floats) -> None:
        self.groups = groups
        shapes = {array.shape[1:] for array in groups.values()}
        try:
            self.shape = shapes.pop() if len(shapes) == 1 else np.broadcast_shapes(*shapes)
        except ValueError:
            given = ", ".join(f"{name} {array.shape}" for name, array in groups.items())
            raise ValueError(f"shapes of components do not broadcast: {given}") from None
        self.count = math.prod(self.shape)
        self._kept: list[Any] = []

    def is_shared(self, name: str) -> bool:
        """One number for each component serves all elements."""
        array = self.groups[name]
        return bool(array.size == len(array))

    def shared(self) -> int:
        """The same of all groups, as C takes it."""
        bits = {"shape": "VNDF_SHARED_SURFACE", "wi": "VNDF_SHARED_WI", "weight": "VNDF_SHARED_WEIGHT"}
        return sum(constant(bit) for name, bit in bits.items() if name in self.groups and self.is_shared(name))

    def whole(self, name: str) -> Floats:
        """A group of the whole shape."""
        array = self.groups[name]
        if array.shape[1:] == self.shape:
            return array
        axes = (1,) * (len(self.shape) - array.ndim + 1)
        return np.broadcast_to(array.reshape(array.shape[0], *axes, *array.shape[1:]), (array.shape[0], *self.shape))

    def addresses(self, name: str, share: bool = False) -> list[int]:
        """Where the components of a group lie: in place where they are contiguous and of the whole shape, else copied;
        `share`: one number for all elements is not repeated."""
        array = self.groups[name] if share and self.is_shared(name) else self.whole(name)
        return self.keep(array if array.flags.c_contiguous else np.ascontiguousarray(array))

    def keep(self, array: Any) -> list[int]:
        """Keeps an array as long as this; where its components lie."""
        self._kept.append(array)
        return addresses_of(array)


def addresses_of(array: Any) -> list[int]:
    """Where the components of a contiguous array lie. array.ctypes.data takes five times as long."""
    first, step = array.__array_interface__["data"][0], array.nbytes // (len(array) or 1)
    return list(range(first, first + step * len(array), step)) if step else [first] * len(array)
