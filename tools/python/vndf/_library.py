"""The C library: its structs, its functions and its errors. The rest of the package knows no ctypes type but these.

The structs repeat vndf.h, vndf_build.h and vndf_bsdf.h; tests/python/layout.py has a C compiler compare
size and members. Pointers are plain addresses (c_void_p), which is the quickest way to hand over an array of numpy.
"""
from __future__ import annotations

import ctypes
import enum
import os
import pathlib
import sys
from ctypes import POINTER, byref, c_char, c_char_p, c_double, c_float, c_int, c_size_t, c_uint, c_void_p
from typing import TYPE_CHECKING, Any

from ._version import __version__

if TYPE_CHECKING:
    from typing_extensions import Self


class Status(enum.IntEnum):
    """Why a call failed (vndf_status)."""

    ARGUMENT = 1  #: an argument is outside its stated range, or the call was interrupted
    MEMORY = 2  #: no memory
    IO = 3  #: a file cannot be opened, read or written
    TABLE = 4  #: the bytes are not a table that this version reads
    SYNTAX = 5  #: an expression, CSV or family name cannot be read
    DISTRIBUTION = 6  #: the input cannot be the normals of a microsurface
    TARGET = 7  #: no table meets the accuracy or size asked for


class Error(Exception):
    """What the library refused, in its own words; ``status`` says which kind of error it is."""

    def __init__(self, message: str, status: Status) -> None:
        super().__init__(message)
        self.status = status

    def __reduce__(self) -> Any:
        return Error, (str(self), self.status)


# ---- structs ----------------------------------------------------------------------------------------------------


def _struct(name: str, *members: Any) -> Any:
    """A ctypes structure with these (name, type) members, called `name` in C."""
    return type(name, (ctypes.Structure,), {"_fields_": list(members)})


def _floats(*names: str) -> list[Any]:
    return [(name, c_float) for name in names]


def _arrays(*names: str) -> list[Any]:
    return [(name, c_void_p) for name in names]


MIXTURE_LOBES = 8
WAVELENGTHS = 4
SHARED_ALPHA, SHARED_WI, SHARED_WEIGHT = 1, 2, 4

vndf_error = _struct("vndf_error", ("status", c_int), ("message", c_char * 512))
vndf_certificate = _struct(
    "vndf_certificate",
    *_floats("tv", "tv_theta", "tv_above", "tv_above_theta", "max_weight", "weight_bounded", "area_error"),
    *_floats("consistency", "ndf_error", "hidden", "finest", "horizon_power"),
)
vndf_info = _struct(
    "vndf_info",
    ("source", c_char_p), ("tool", c_char_p), ("bytes", c_size_t), ("memory", c_size_t), ("cells", c_size_t),
    ("moments", c_int), ("normalization", c_double), ("scale", c_double), ("certificate", vndf_certificate),
)  # fmt: skip
vndf_normals = _struct("vndf_normals", *_arrays("x", "y", "z"))
_batch_begin = [("count", c_size_t), ("shared", c_uint), ("limit", c_int)]
vndf_batch = _struct(
    "vndf_batch",
    ("distribution", c_void_p), *_batch_begin, *_arrays("alpha_x", "alpha_y", "wi_x", "wi_y", "wi_z"),
)  # fmt: skip
_shape_arrays = ["xx", "xy", "yx", "yy", "mean_x", "mean_y"]
vndf_affine_batch = _struct(
    "vndf_affine_batch",
    ("distribution", c_void_p), *_batch_begin, *_arrays(*_shape_arrays, "wi_x", "wi_y", "wi_z"),
)  # fmt: skip
vndf_lobe_batch = _struct("vndf_lobe_batch", ("distribution", c_void_p), *_arrays(*_shape_arrays, "weight"))
vndf_mixture_batch = _struct(
    "vndf_mixture_batch",
    *_batch_begin, *_arrays("wi_x", "wi_y", "wi_z"), ("lobes", c_int), ("lobe", vndf_lobe_batch * MIXTURE_LOBES),
)  # fmt: skip
vndf_affine = _struct("vndf_affine", ("distribution", c_void_p), *_floats(*_shape_arrays))
vndf_mixture_lobe = _struct("vndf_mixture_lobe", ("surface", vndf_affine), ("weight", c_float))
vndf_mixture = _struct("vndf_mixture", ("count", c_int), ("lobe", vndf_mixture_lobe * MIXTURE_LOBES))
vndf_family_facts = _struct(
    "vndf_family_facts",
    ("source", c_char_p), ("tool", c_char_p), ("bytes", c_size_t), ("memory", c_size_t), ("count", c_size_t),
    *_floats("low", "high"), ("reciprocal", c_int), *_floats("distance", "grazing"),
)  # fmt: skip

progress_function = ctypes.CFUNCTYPE(c_int, c_double, c_char_p, c_void_p)
density_function = ctypes.CFUNCTYPE(c_double, c_double, c_void_p)

vndf_parameter = _struct("vndf_parameter", ("name", c_char_p), ("value", c_double))
vndf_build_options = _struct(
    "vndf_build_options",
    ("max_bytes", c_size_t), ("max_tv", c_double), ("progress", progress_function), ("progress_user", c_void_p),
    ("breaks", c_void_p), ("break_count", c_size_t), ("finest", c_double), ("moments", c_int),
)  # fmt: skip
vndf_family_options = _struct(
    "vndf_family_options",
    ("max_distance", c_double), ("knots", c_size_t), ("max_bytes", c_size_t), ("moments", c_int),
    ("progress", progress_function), ("progress_user", c_void_p),
)  # fmt: skip

EFFECTS = ["lobes", "fresnel", "masking", "normals", "scattering", "transport", "shape", "reflection"]
vndf_effects = _struct("vndf_effects", *[(name, c_int) for name in EFFECTS])
vndf_description = _struct(
    "vndf_description",
    ("distribution", c_void_p), ("effects", vndf_effects), *_floats("alpha_x", "alpha_y", "rotation"),
    ("affine", vndf_affine), ("mixture", c_void_p), ("wavelengths", c_int), ("albedo", c_void_p), ("eta", c_float),
    ("f0", c_float * WAVELENGTHS), ("conductor_eta", c_float * WAVELENGTHS), ("conductor_k", c_float * WAVELENGTHS),
    ("order_limit", c_uint),
)  # fmt: skip
vndf_roughness = _struct("vndf_roughness", *_floats("alpha_x", "alpha_y", "cos_rotation", "sin_rotation"))
vndf_material = _struct(
    "vndf_material",
    ("is", vndf_description), *_arrays("routines", "specular", "single", "normals", "fresnel", "masking"),
    ("surface", vndf_affine), *_floats("cos_rotation", "sin_rotation"), ("per_wavelength", c_double),
    ("reflectance0", c_float * WAVELENGTHS), ("reflectance", c_float * WAVELENGTHS), ("two_sided", c_int),
)  # fmt: skip
vndf_bsdf_batch = _struct(
    "vndf_bsdf_batch",
    ("material", c_void_p), *_batch_begin, *_arrays("alpha_x", "alpha_y", "cos_rotation", "sin_rotation"),
    *_arrays("affine", "mixture", "wi_x", "wi_y", "wi_z"),
)  # fmt: skip
vndf_scattered_n = _struct(
    "vndf_scattered_n",
    ("wo", vndf_normals), ("weight", c_void_p * WAVELENGTHS), ("density", c_void_p), ("lobe", c_void_p),
    ("wm", vndf_normals),
)  # fmt: skip

# ---- functions --------------------------------------------------------------------------------------------------

_error = POINTER(vndf_error)
_p, _f, _d, _s, _i, _n = c_void_p, c_float, c_double, c_char_p, c_int, vndf_normals

#: name in C without "vndf_": (result, arguments)
_FUNCTIONS: dict[str, tuple[Any, list[Any]]] = {
    "version": (_s, []),
    "load": (_p, [_s, _error]),
    "load_memory": (_p, [_p, c_size_t, _error]),
    "free": (None, [_p]),
    "ggx": (_p, []),
    "beckmann": (_p, []),
    "distribution_info": (vndf_info, [_p]),
    "numbers": (c_size_t, [_p, _p, c_size_t]),
    "sample_weight_n": (None, [_p, _p, _p, _n, _p, _p]),
    "affine_sample_weight_n": (None, [_p, _p, _p, _n, _p, _p]),
    "instructions_used": (_i, [_i]),
    "family_load": (_p, [_s, _error]),
    "family_load_memory": (_p, [_p, c_size_t, _error]),
    "family_of": (_p, [_p, _p, c_size_t, _error]),
    "family_free": (None, [_p]),
    "family_info": (vndf_family_facts, [_p]),
    "family_parameter": (_f, [_p, c_size_t]),
    "family_distribution": (_p, [_p, c_size_t]),
    "family_distance": (_f, [_p, c_size_t]),
    "family_at": (_i, [_p, _f, _p, _p]),
    # vndf_build.h
    "source_ndf_expression": (_p, [_s, _p, c_size_t, _error]),
    "source_slope_expression": (_p, [_s, _p, c_size_t, _error]),
    "source_csv_file": (_p, [_s, _error]),
    "source_rows": (_p, [_i, _i, _p, _p, c_size_t, _s, _error]),
    "source_family": (_p, [_s, _error]),
    "source_ndf_callback": (_p, [density_function, _p, _s, _error]),
    "source_slope_callback": (_p, [density_function, _p, _s, _error]),
    "source_of": (_p, [_p, _error]),
    "source_p22": (_d, [_p, _d]),
    "source_description": (_s, [_p]),
    "source_free": (None, [_p]),
    "family_help": (_s, []),
    "family_material": (_s, [c_size_t]),
    "build": (_p, [_p, _p, _p, _error]),
    "certify": (_i, [_p, _p, _p, _error]),
    "save": (_i, [_p, _s, _error]),
    "save_memory": (_i, [_p, _p, c_size_t, _error]),
    "build_family": (_p, [_s, _d, _d, _p, _error]),
    "family_save": (_i, [_p, _s, _error]),
    "family_save_memory": (_i, [_p, _p, c_size_t, _error]),
    "albedo_build": (_p, [_p, _f, _error]),
    "albedo_free": (None, [_p]),
    "albedo_directional": (_f, [_p, _f, _f]),
    "albedo_average": (_f, [_p, _f, _i]),
    # vndf_bsdf.h
    "material_resolve": (_i, [_p, _p, _error]),
    "bsdf_sample_n": (None, [_p, _p, vndf_scattered_n]),
    "bsdf_eval_n": (None, [_p, _n, _p, _p]),
    "bsdf_pdf_n": (None, [_p, _n, _p]),
    "bsdf_eval_pdf_n": (None, [_p, _n, _p, _p, _p]),
}
for _prefix in ("", "affine_", "mixture_"):
    _lobe = [_p] if _prefix == "mixture_" else []
    _FUNCTIONS[_prefix + "sample_n"] = (None, [_p, _p, _p, _n, _p, *_lobe])
    _FUNCTIONS[_prefix + "invert_n"] = (None, [_p, _n, *_lobe, _p, _p, *_lobe])
    for _name in ("pdf", "visible", "ndf"):
        _FUNCTIONS[f"{_prefix}{_name}_n"] = (None, [_p, _n, _p])
    for _name in ("projected_area", "lambda", "g1"):
        _FUNCTIONS[f"{_prefix}{_name}_n"] = (None, [_p, _p])


def _path() -> str:
    """VNDF_LIBRARY, or the library that was installed with the package."""
    named = os.environ.get("VNDF_LIBRARY")
    if named:
        return named
    name = {"win32": "vndf.dll", "darwin": "libvndf.dylib"}.get(sys.platform, "libvndf.so")
    path = pathlib.Path(__file__).with_name(name)
    if not path.exists():
        raise ImportError(
            f"{path} is not there: install the package with pip, which builds the C library, "
            "or name a library in the environment variable VNDF_LIBRARY"
        )
    return str(path)


class _Library:
    """The functions by their names in C, without "vndf_"."""

    def __init__(self) -> None:
        path = _path()
        dll = ctypes.CDLL(path)
        dll.vndf_version.restype = c_char_p
        version = dll.vndf_version().decode()
        if version != __version__:
            raise ImportError(f"{path} is version {version}, but this package is for version {__version__}")
        for name, (result, arguments) in _FUNCTIONS.items():
            function = dll["vndf_" + name]
            function.restype, function.argtypes = result, arguments
            setattr(self, name, function)

    def __getattr__(self, name: str) -> Any:  # for type checkers: all functions are set above
        raise AttributeError(name)


library = _Library()


def checked(name: str, *arguments: Any) -> Any:
    """Calls vndf_NAME with these arguments and an error; raises what it says."""
    error = vndf_error()
    result = getattr(library, name)(*arguments, byref(error))
    if error.status:
        raise Error(error.message.decode(errors="replace"), Status(error.status))
    return result


def path_bytes(path: Any) -> bytes:
    """A path as the C library takes it."""
    return _without_zero(os.fsencode(path))


def text_bytes(text: str) -> bytes:
    """A text as the C library takes it."""
    if not isinstance(text, str):
        raise TypeError(f"a text is wanted, not {text!r}")
    return _without_zero(text.encode())


def _without_zero(data: bytes) -> bytes:
    if b"\0" in data:
        raise ValueError(f"{data!r} holds a zero byte, which would end it")
    return data


def want(value: Any, kind: Any) -> None:
    """Refuses what is not of this class, or of one of these."""
    if not isinstance(value, kind):
        names = " or a ".join(f"vndf.{k.__name__}" for k in (kind if isinstance(kind, tuple) else (kind,)))
        raise TypeError(f"a {names} is wanted, not {value!r}")


class Immutable:
    """What stands for memory of C: a copy is the object itself, and only some classes can be pickled."""

    def __copy__(self) -> Immutable:
        return self

    def __deepcopy__(self, memo: Any) -> Immutable:
        return self

    def __reduce__(self) -> Any:
        raise TypeError(f"a vndf.{type(self).__name__} cannot be pickled: save it to a file, or make it again")


class Owner(Immutable):
    """Owns a pointer, and frees it by the C call named `_free`. `_makers`: the calls that make one."""

    _free = ""
    _makers = ""
    _pointer = 0

    def __init__(self, *_: Any, **__: Any) -> None:
        raise TypeError(f"a vndf.{type(self).__name__} comes from {self._makers}, not from its class")

    @classmethod
    def _of(cls, pointer: int, **kept: Any) -> Self:
        """Of a pointer that C gave. `kept`: members that have to live as long."""
        self = cls.__new__(cls)
        self.__dict__.update(kept, _pointer=pointer)
        return self

    def __del__(self) -> None:
        if self._pointer:
            getattr(library, self._free)(self._pointer)
            self._pointer = 0


def members(struct: Any) -> dict[str, Any]:
    """The members of a struct as Python values."""
    values = {name: getattr(struct, name) for name, *_ in struct._fields_}
    return {name: value.decode() if isinstance(value, bytes) else value for name, value in values.items()}
