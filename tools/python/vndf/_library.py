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
from ctypes import byref
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


# ---- structs and functions --------------------------------------------------------------------------------------

_TYPES: dict[str, Any] = {
    "none": None, "pointer": ctypes.c_void_p, "text": ctypes.c_char_p, "size": ctypes.c_size_t, "int": ctypes.c_int,
    "unsigned": ctypes.c_uint, "float": ctypes.c_float, "double": ctypes.c_double,
}  # fmt: skip


def _struct(name: str, members: str) -> Any:
    """A ctypes structure, called `name` in C. `members` is "type name name[count] ...; type name ..."."""
    fields: list[Any] = []
    for line in members.split(";"):
        kind, *names = line.split()
        for member in names:
            plain, _, count = member.rstrip("]").partition("[")
            fields.append((plain, _TYPES[kind] * int(count) if count else _TYPES[kind]))
    _TYPES[name] = type(name, (ctypes.Structure,), {"_fields_": fields})
    return _TYPES[name]


MIXTURE_LOBES = 8
WAVELENGTHS = 4
SHARED_ALPHA, SHARED_WI, SHARED_WEIGHT = 1, 2, 4

progress_function = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_double, ctypes.c_char_p, ctypes.c_void_p)
density_function = ctypes.CFUNCTYPE(ctypes.c_double, ctypes.c_double, ctypes.c_void_p)
_TYPES.update(progress=progress_function, density=density_function, char=ctypes.c_char)

vndf_error = _struct("vndf_error", "int status; char message[512]")
vndf_certificate = _struct(
    "vndf_certificate",
    "float tv tv_theta tv_above tv_above_theta max_weight weight_bounded area_error consistency ndf_error hidden finest "
    "horizon_power",
)
vndf_info = _struct(
    "vndf_info",
    "text source tool; size bytes memory cells; int moments; double normalization scale; vndf_certificate certificate",
)
vndf_normals = _struct("vndf_normals", "pointer x y z")
vndf_batch = _struct(
    "vndf_batch", "pointer distribution; size count; unsigned shared; int limit; pointer alpha_x alpha_y wi_x wi_y wi_z"
)
vndf_affine_batch = _struct(
    "vndf_affine_batch",
    "pointer distribution; size count; unsigned shared; int limit; "
    "pointer xx xy yx yy mean_x mean_y wi_x wi_y wi_z",
)
vndf_lobe_batch = _struct("vndf_lobe_batch", "pointer distribution xx xy yx yy mean_x mean_y weight")
vndf_mixture_batch = _struct(
    "vndf_mixture_batch",
    "size count; unsigned shared; int limit; pointer wi_x wi_y wi_z; int lobes; vndf_lobe_batch lobe[8]",
)
vndf_affine = _struct("vndf_affine", "pointer distribution; float xx xy yx yy mean_x mean_y")
vndf_mixture_lobe = _struct("vndf_mixture_lobe", "vndf_affine surface; float weight")
vndf_mixture = _struct("vndf_mixture", "int count; vndf_mixture_lobe lobe[8]")
vndf_family_facts = _struct(
    "vndf_family_facts",
    "text source tool; size bytes memory count; float low high; int reciprocal; float distance grazing",
)
vndf_parameter = _struct("vndf_parameter", "text name; double value")
vndf_build_options = _struct(
    "vndf_build_options",
    "size max_bytes; double max_tv; progress progress; pointer progress_user breaks; size break_count; double finest; "
    "int moments",
)
vndf_family_options = _struct(
    "vndf_family_options",
    "double max_distance; size knots max_bytes; int moments; progress progress; pointer progress_user",
)
vndf_effects = _struct("vndf_effects", "int lobes fresnel masking normals scattering transport shape reflection")
vndf_description = _struct(
    "vndf_description",
    "pointer distribution; vndf_effects effects; float alpha_x alpha_y rotation; vndf_affine affine; pointer mixture; "
    "int wavelengths; pointer albedo; float eta f0[4] conductor_eta[4] conductor_k[4]; unsigned order_limit",
)
vndf_material = _struct("vndf_material", "vndf_description is; double own[14]")  # own: private
vndf_bsdf_batch = _struct(
    "vndf_bsdf_batch",
    "pointer material; size count; unsigned shared; int limit; "
    "pointer alpha_x alpha_y cos_rotation sin_rotation affine mixture wi_x wi_y wi_z",
)
vndf_scattered_n = _struct(
    "vndf_scattered_n", "vndf_normals wo; pointer weight[4] density lobe; vndf_normals wm"
)

#: names in C without "vndf_", by their types: the result, then arguments; an error comes last
_FUNCTIONS = {
    "pointer": "ggx beckmann",
    "text": "version family_help",
    "none pointer": "free family_free source_free albedo_free",
    "vndf_info pointer": "distribution_info",
    "vndf_family_facts pointer": "family_info",
    "text pointer": "source_description",
    "text size": "family_material",
    "float pointer size": "family_parameter",
    "pointer pointer size": "family_distribution",
    "float pointer float float": "albedo_directional",
    "float pointer float int": "albedo_average",
    "double pointer double": "source_p22",
    "size pointer pointer size": "numbers",
    "int pointer float pointer pointer": "family_at",
    "pointer text error": "load family_load source_csv_file source_family",
    "pointer pointer size error": "load_memory family_load_memory",
    "pointer pointer pointer size error": "family_of",
    "pointer pointer error": "source_of",
    "pointer pointer float error": "albedo_build",
    "pointer text pointer size error": "source_ndf_expression source_slope_expression",
    "pointer density pointer text error": "source_ndf_callback source_slope_callback",
    "pointer int int pointer pointer size text error": "source_rows",
    "pointer pointer pointer pointer error": "build",
    "pointer text double double pointer error": "build_family",
    "int pointer pointer error": "material_resolve",
    "int pointer pointer pointer error": "certify",
    "int pointer text error": "save family_save",
    "int pointer pointer size error": "save_memory family_save_memory",
    "none pointer pointer": "{}projected_area_n {}lambda_n {}g1_n",
    "none pointer vndf_normals pointer": "{}pdf_n {}visible_n {}ndf_n bsdf_pdf_n",
    "none pointer pointer pointer vndf_normals pointer": "sample_n affine_sample_n",
    "none pointer pointer pointer vndf_normals pointer pointer": "sample_weight_n affine_sample_weight_n mixture_sample_n",
    "none pointer vndf_normals pointer pointer": "invert_n affine_invert_n bsdf_eval_n",
    "none pointer vndf_normals pointer pointer pointer": "bsdf_eval_pdf_n",
    "none pointer vndf_normals pointer pointer pointer pointer": "mixture_invert_n",
    "none pointer pointer vndf_scattered_n": "bsdf_sample_n",
}
_TYPES["error"] = ctypes.POINTER(vndf_error)


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
        dll.vndf_version.restype = ctypes.c_char_p
        version = dll.vndf_version().decode()
        if version != __version__:
            raise ImportError(f"{path} is version {version}, but this package is for version {__version__}")
        for types, names in _FUNCTIONS.items():
            result, *arguments = (_TYPES[kind] for kind in types.split())
            of_all = {name.format(prefix) for name in names.split() for prefix in ("", "affine_", "mixture_")}
            for name in of_all:
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
