"""Distributions of normals: tables and closed forms."""
from __future__ import annotations

import dataclasses
import os
from typing import Any, Union

import numpy as np

from ._arrays import Floats
from ._library import Owner, checked, library, members, path_bytes

Path = Union[str, "os.PathLike[str]"]


@dataclasses.dataclass(frozen=True)
class Certificate:
    """What the builder measured: the table against quadrature of the given D (vndf.h says over what)."""

    tv: float  #: largest total variation distance between sampled and true visible normals, all directions
    tv_theta: float  #: the incident angle where it was found, degrees
    tv_above: float  #: the same over directions from 0 to 90 degrees
    tv_above_theta: float
    max_weight: float  #: largest true over sampled density, over all but 1e-6 of the mass
    weight_bounded: bool  #: that quotient is bounded on the whole hemisphere
    area_error: float  #: largest relative error of the projected area, hence of Lambda and G1
    consistency: float  #: largest |integral of the pdf - 1|
    ndf_error: float  #: largest relative error of ndf, over all but 1e-6 of the mass
    hidden: float  #: the part of the mass that may have escaped the builder, 0 to 1
    finest: float  #: relative width in slope of features that may have escaped; 0 if none
    horizon_power: float  #: p < 0 if D grows as cos(theta)^p towards the horizon; else 0


@dataclasses.dataclass(frozen=True)
class Info:
    """What a distribution is."""

    source: str  #: how it was made, as arguments of ``vndf build``
    tool: str  #: the version that made it
    bytes: int  #: size of the file; 0 for closed forms
    memory: int  #: bytes in memory; 0 for closed forms
    cells: int  #: intervals of the slope length before the tail; 0 for closed forms
    moments: int  #: 2, 3 or 4 (:func:`vndf.build`); 0 for closed forms
    normalization: float  #: the given D was multiplied by this
    scale: float  #: median slope under D cos(theta) at alpha = 1


def certificate_of(struct: Any) -> Certificate:
    values = members(struct)
    values.update(weight_bounded=bool(struct.weight_bounded))
    return Certificate(**values)


class Distribution(Owner):
    """A distribution of normals, immutable: threads may share it. From :func:`vndf.load`, :func:`vndf.build`,
    :func:`vndf.ggx` or :func:`vndf.beckmann`; pickles as the bytes of its table."""

    _free = "free"
    _makers = "vndf.load, vndf.build, vndf.ggx or vndf.beckmann"
    _owner: Any = None  # what frees the pointer; None: this object

    def __del__(self) -> None:
        if self._owner is None:
            super().__del__()

    @property
    def info(self) -> Info:
        """Where it comes from and how large it is."""
        values = members(library.distribution_info(self._pointer))
        del values["certificate"]
        return Info(**values)

    @property
    def certificate(self) -> Certificate:
        """What the builder measured; zeros for closed forms."""
        return certificate_of(library.distribution_info(self._pointer).certificate)

    def save(self, path: Path) -> None:
        """Writes the table to a file, which appears whole or not at all."""
        checked("save", self._pointer, path_bytes(path))

    def __bytes__(self) -> bytes:
        """The file as bytes, for :func:`vndf.from_bytes`."""
        data = np.empty(self.info.bytes, np.uint8)
        checked("save_memory", self._pointer, data.ctypes.data, data.size)
        return data.tobytes()

    def __reduce__(self) -> Any:
        closed = {_ggx._pointer: ggx, _beckmann._pointer: beckmann}.get(self._pointer)
        return (closed, ()) if closed else (from_bytes, (bytes(self),))

    def numbers(self) -> Floats:
        """The numbers that kernels of ``vndf export`` read of this table, shape (n,); empty for closed forms."""
        numbers = np.empty(library.numbers(self._pointer, None, 0), np.float32)
        library.numbers(self._pointer, numbers.ctypes.data, numbers.size)
        return numbers

    def __repr__(self) -> str:
        info = self.info
        return f"<vndf.Distribution {info.source}, {info.bytes} bytes>"


def load(path: Path) -> Distribution:
    """Reads a table file. Raises :class:`vndf.Error` if it cannot be read or is not a whole, consistent table."""
    return Distribution._of(checked("load", path_bytes(path)))


def from_bytes(data: bytes) -> Distribution:
    """The same from the bytes of a file, which are copied."""
    array = np.frombuffer(data, np.uint8)
    return Distribution._of(checked("load_memory", array.ctypes.data, array.size))


_ggx = Distribution._of(library.ggx(), _owner=library)
_beckmann = Distribution._of(library.beckmann(), _owner=library)


def ggx() -> Distribution:
    """GGX (Trowbridge-Reitz), a closed form."""
    return _ggx


def beckmann() -> Distribution:
    """Beckmann, a closed form."""
    return _beckmann
