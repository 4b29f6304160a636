"""Distributions of normals: tables and closed forms."""
from __future__ import annotations

import os
from typing import Any, Union

import numpy as np

from ._arrays import Floats
from ._library import Stored, library, record, values

Path = Union[str, "os.PathLike[str]"]

#: What the builder measured; vndf.h says of each member over what (vndf_certificate).
Certificate = record("vndf_certificate", "Certificate")
#: What a distribution is (vndf_info).
Info = record("vndf_info", "Info")


class Distribution(Stored):
    """A distribution of normals, immutable: threads may share it. From :func:`vndf.load`, :func:`vndf.build`,
    :func:`vndf.ggx` or :func:`vndf.beckmann`; pickles as the bytes of its table."""

    _free = "free"
    _makers = "vndf.load, vndf.build, vndf.ggx or vndf.beckmann"
    _owner: Any = None  # what frees the pointer; None: this object

    def __del__(self) -> None:
        if self._owner is None:
            super().__del__()

    @property
    def info(self) -> Any:
        """source, tool, notes, bytes, memory, cells, moments, normalization, scale, certificate (vndf_info)."""
        return Info(*values(library.distribution_info(self._pointer))[:-1], self.certificate)

    @property
    def certificate(self) -> Any:
        """What the builder measured: tv, tv_above, max_weight and so on; zeros for closed forms."""
        return Certificate(*values(library.distribution_info(self._pointer).certificate))

    def __reduce__(self) -> Any:
        closed = {_ggx._pointer: ggx, _beckmann._pointer: beckmann}.get(self._pointer)
        return (closed, ()) if closed else super().__reduce__()

    def numbers(self) -> Floats:
        """The numbers that kernels of ``vndf export`` read of this table, shape (n,); empty for closed forms."""
        numbers = np.empty(library.numbers(self._pointer, None, 0), np.float32)
        library.numbers(self._pointer, numbers.ctypes.data, numbers.size)
        return numbers

    def __repr__(self) -> str:
        return f"<vndf.Distribution {self.info.source}, {self.info.bytes} bytes>"


load = Distribution.load
from_bytes = Distribution.from_bytes
_ggx = Distribution._of(library.ggx(), _owner=library)
_beckmann = Distribution._of(library.beckmann(), _owner=library)


def ggx() -> Distribution:
    """GGX (Trowbridge-Reitz), a closed form."""
    return _ggx


def beckmann() -> Distribution:
    """Beckmann, a closed form."""
    return _beckmann
