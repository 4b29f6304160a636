"""The C library: its structs, functions and words, as its headers declare them; and its errors. The rest of the package
knows no types of C. Pointers are plain addresses, the quickest way to hand over an array of numpy."""
from __future__ import annotations

import collections
import ctypes
import enum
import functools
import os
import pathlib
import re
import sys
from ctypes import byref
from typing import TYPE_CHECKING, Any, Callable

if TYPE_CHECKING:
    from typing_extensions import Self


#: Why a call failed (vndf_status).
Status = enum.IntEnum("Status", "ARGUMENT MEMORY IO TABLE SYNTAX DISTRIBUTION TARGET")


class Error(Exception):
    """What the library refused, in its own words; ``status`` says which kind of error it is."""

    def __init__(self, message: str, status: Status) -> None:
        super().__init__(message)
        self.status = status

    def __reduce__(self) -> Any:
        return Error, (str(self), self.status)


# ---- the headers ------------------------------------------------------------------------------------------------

_HERE = pathlib.Path(__file__).resolve().parent
_PLAIN = {
    "void": None, "char": ctypes.c_char, "int": ctypes.c_int, "unsigned": ctypes.c_uint, "float": ctypes.c_float,
    "double": ctypes.c_double, "size_t": ctypes.c_size_t,
}  # fmt: skip


def _declarations() -> str:
    """The headers without comments: those of the installed package, or of the checkout around this folder."""
    folder = next((f for f in (_HERE / "include", _HERE.parents[2] / "include") if f.is_dir()), _HERE)
    names = ("vndf.h", "vndf_build.h", "vndf_bsdf.h")
    return re.sub(r"/\*.*?\*/", " ", "".join((folder / name).read_text() for name in names), flags=re.S)


_text = _declarations()
VERSION: str = re.findall(r'define VNDF_VERSION "(.*)"', _text)[0]


@functools.lru_cache(None)
def constant(name: str) -> int:
    """A number of an enum."""
    return int(re.findall(rf"\b{name} = (\d+)", _text)[0])


def words(name: str) -> list[str]:
    """Those of an enum, without what all of them begin with: "v-cavities" of VNDF_MASKING_V_CAVITIES."""
    body = re.findall(rf"typedef enum {name} {{([^}}]*)}}", _text)[0]
    return [word.split("_", 2)[2].lower().replace("_", "-") for word in re.findall(r"\w+", body)]


def _declared(text: str, argument: bool = False) -> list[tuple[str, Any]]:
    """Name and type of each of `const float *x, *y` or `float weight[4]`; as an argument an array is an address."""
    inner = re.fullmatch(r"\s*struct {(.*)} (\w+)\s*", text, re.S)
    if inner:
        return [(inner[2], _structure(inner[2], inner[1]))]
    base, rest = re.findall(r"^\s*(?:const |struct )*(\w+)(.*)", text, re.S)[0]
    found = []
    for one in rest.replace("const", "").split(","):
        stars, name, count = re.findall(r"([\s*]*)(\w*)(?:\[(\w+)\])?", one)[0]
        kind = pointer(base) if "*" in stars or (argument and count) else struct(base)
        if count and not argument:
            kind = kind * (int(count) if count.isdigit() else constant(count))
        found.append((name, kind))
    return found


def _arguments(text: str) -> list[Any]:
    return [] if text == "void" else [_declared(one, argument=True)[0][1] for one in text.split(",")]


def _structure(name: str, body: str) -> Any:
    parts = re.findall(r"((?:struct {.*?}|[^;{])+);", body, re.S)
    return type(name, (ctypes.Structure,), {"_fields_": [one for part in parts for one in _declared(part)]})


def pointer(base: str) -> Any:
    """The type of what points to a text, to a function that C calls, or to anything else: a plain address."""
    called = re.findall(rf"typedef (\w+) {base}\((.*?)\);", _text, re.S)
    if called:
        return ctypes.CFUNCTYPE(struct(called[0][0]), *_arguments(called[0][1]))
    return ctypes.c_char_p if base == "char" else ctypes.c_void_p


@functools.lru_cache(None)
def struct(name: str) -> Any:
    """The type of a number, an enum, or a struct, which members by name or in their order fill."""
    if name in _PLAIN:
        return _PLAIN[name]
    if f"typedef enum {name} " in _text:
        return ctypes.c_int
    return _structure(name, re.findall(rf"typedef struct {name} {{(.*?)}} {name};", _text, re.S)[0])


def record(name: str, called: str) -> Any:
    """A class of tuples that have the members of a struct; :func:`values` fills them."""
    return collections.namedtuple(called, [member for member, _ in struct(name)._fields_], module="vndf")


def values(filled: Any) -> list[Any]:
    """The members of a struct as Python values."""
    members = [getattr(filled, member) for member, _ in filled._fields_]
    return [member.decode() if isinstance(member, bytes) else member for member in members]


# ---- the library ------------------------------------------------------------------------------------------------


def _path() -> str:
    """VNDF_LIBRARY, or the library that was installed with the package."""
    path = _HERE / {"win32": "vndf.dll", "darwin": "libvndf.dylib"}.get(sys.platform, "libvndf.so")
    named = os.environ.get("VNDF_LIBRARY")
    if not named and not path.exists():
        raise ImportError(f"{path} is not there: install the package with pip, or name a library in VNDF_LIBRARY")
    return named or str(path)


class _Library:
    """The functions by their names in C, without "vndf_"."""

    def __init__(self) -> None:
        self._dll = ctypes.CDLL(_path())
        is_version = self.version().decode()
        if is_version != VERSION:
            raise ImportError(f"{_path()} is version {is_version}, but this package is for version {VERSION}")

    def __getattr__(self, name: str) -> Any:  # once for each
        declared = re.findall(rf"VNDF_API ([^;(]*?)\bvndf_{name}\(([^;]*)\);", _text)
        if not declared:
            raise AttributeError(name)
        function = self._dll["vndf_" + name]
        function.restype, function.argtypes = _declared(declared[0][0])[0][1], _arguments(declared[0][1])
        setattr(self, name, function)
        return function


library = _Library()


def checked(name: str, *arguments: Any) -> Any:
    """Calls vndf_NAME with these arguments and an error; raises what it says."""
    error = struct("vndf_error")()
    result = getattr(library, name)(*arguments, byref(error))
    if error.status:
        raise Error(error.message.decode(errors="replace"), Status(error.status))
    return result


def text_bytes(text: Any) -> bytes:
    """A text, or a path, as the C library takes it."""
    data = os.fsencode(text)
    if b"\0" in data:
        raise ValueError(f"{data!r} holds a zero byte, which would end it")
    return data


def want(value: Any, *kinds: type) -> None:
    """Refuses what is not of one of these classes."""
    if not isinstance(value, kinds):
        raise TypeError(f"a {' or a '.join(f'vndf.{kind.__name__}' for kind in kinds)} is wanted, not {value!r}")


class Owner:
    """Owns a pointer, and frees it by the C call named `_free`. `_makers`: the calls that make one. A copy is the
    object itself, and what has no bytes cannot be pickled."""

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

    def __copy__(self) -> Self:
        return self

    def __deepcopy__(self, memo: Any) -> Self:
        return self

    def __reduce__(self) -> Any:
        raise TypeError(f"a vndf.{type(self).__name__} cannot be pickled: save it to a file, or make it again")


class Stored(Owner):
    """What has a file; its bytes are what pickles."""

    _kind = ""  # of the C calls
    info: Any

    @classmethod
    def load(cls, path: Any) -> Self:
        """Reads a file. Raises :class:`vndf.Error` if it cannot be read, or is not whole and consistent."""
        return cls._of(checked(f"{cls._kind}load", text_bytes(path)))

    @classmethod
    def from_bytes(cls, data: bytes) -> Self:
        """The same from the bytes of a file, which are copied."""
        return cls._of(checked(f"{cls._kind}load_memory", bytes(data), len(data)))

    def save(self, path: Any) -> None:
        """Writes the file, which appears whole or not at all."""
        checked(f"{self._kind}save", self._pointer, text_bytes(path))

    def __bytes__(self) -> bytes:
        data = ctypes.create_string_buffer(self.info.bytes)
        checked(f"{self._kind}save_memory", self._pointer, data, len(data))
        return data.raw

    def __reduce__(self) -> Any:
        return type(self).from_bytes, (bytes(self),)
