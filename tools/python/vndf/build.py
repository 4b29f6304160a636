"""Tables from whatever a distribution is given by: formulas, families, files, arrays, functions."""
from __future__ import annotations

import threading
from ctypes import byref
from typing import Any, Callable, Iterable, Optional, Sequence, TypeVar

import numpy as np

from . import _library
from ._arrays import Numbers
from ._library import Owner, checked, library, path_bytes, text_bytes, want
from .distribution import Certificate, Distribution, Path, certificate_of

_T = TypeVar("_T")

#: called with the part that is done, 0 to 1, and the name of the stage; a true result stops the build
Progress = Callable[[float, str], Any]


class Source(Owner):
    """A distribution of normals as it is given, at any scale, normalised or not: a formula, a name, a file, arrays, a
    function, or what a table was built from."""

    _free = "source_free"
    _makers = "vndf.Source.slope, .ndf, .family, .csv, .rows, .slope_function, .ndf_function or .of"
    _function: Optional[_Function] = None  # what C calls back

    @staticmethod
    def slope(formula: str, **parameters: float) -> Source:
        """P22 as a formula in r = tan(theta), with named numbers. vndf_build.h lists operators and functions."""
        return _expression("source_slope_expression", formula, parameters)

    @staticmethod
    def ndf(formula: str, **parameters: float) -> Source:
        """D as a formula in c = cos(theta), theta (radians) and t = tan(theta)."""
        return _expression("source_ndf_expression", formula, parameters)

    @staticmethod
    def family(specification: str) -> Source:
        """A family or a measured material by name, as ``vndf build --family`` takes it."""
        return Source._of(checked("source_family", text_bytes(specification)))

    @staticmethod
    def csv(path: Path) -> Source:
        """A CSV file with a header line that names its columns."""
        return Source._of(checked("source_csv_file", path_bytes(path)))

    @staticmethod
    def rows(
        *,
        theta: Optional[Numbers] = None,
        slope: Optional[Numbers] = None,
        ndf: Optional[Numbers] = None,
        p22: Optional[Numbers] = None,
        name: str = "rows",
    ) -> Source:
        """Arrays of shape (n,): ascending angles `theta` (radians) or slopes, and D (`ndf`) or P22 there, >= 0.
        Shape-preserving interpolation joins the rows; beyond the last one P22 falls on as vndf_build.h says: end with 0
        where the support ends. `name` stands in the table as its origin."""
        if (theta is None) == (slope is None) or (ndf is None) == (p22 is None):
            raise TypeError("rows need one of theta and slope, and one of ndf and p22")
        at = np.ascontiguousarray(slope if theta is None else theta, np.float64)
        value = np.ascontiguousarray(p22 if ndf is None else ndf, np.float64)
        if at.ndim != 1 or at.shape != value.shape:
            raise ValueError(f"rows are two arrays of one shape (n,), not {at.shape} and {value.shape}")
        addresses = at.ctypes.data, value.ctypes.data
        return Source._of(checked("source_rows", theta is None, ndf is None, *addresses, at.size, text_bytes(name)))

    @staticmethod
    def slope_function(function: Callable[[float], float], name: str = "Python function") -> Source:
        """P22(r) as a function. It can only be sampled: narrow features may hide (`finest`, `breaks` of build)."""
        return _function("source_slope_callback", function, name)

    @staticmethod
    def ndf_function(function: Callable[[float], float], name: str = "Python function") -> Source:
        """D(cos(theta)) as a function. slope_function is better for narrow distributions: 1 - cos loses digits."""
        return _function("source_ndf_callback", function, name)

    @staticmethod
    def of(distribution: Distribution) -> Source:
        """What a table was built from, for formulas and families; anything else raises :class:`vndf.Error`."""
        want(distribution, Distribution)
        return Source._of(checked("source_of", distribution._pointer))

    def p22(self, r: float) -> float:
        """P22 at the slope length r >= 0, as it was given."""
        value = float(library.source_p22(self._pointer, r))
        self._raise_what_failed()
        return value

    def _raise_what_failed(self) -> None:
        if self._function is not None:
            self._function.raise_what_failed()

    def __repr__(self) -> str:
        return f"<vndf.Source {library.source_description(self._pointer).decode()}>"


def _expression(name: str, formula: str, parameters: dict[str, float]) -> Source:
    array = (_library.vndf_parameter * max(len(parameters), 1))()
    for slot, (key, value) in zip(array, parameters.items()):
        slot.name, slot.value = text_bytes(key), value
    return Source._of(checked(name, text_bytes(formula), array, len(parameters)))


class _Failure:
    """What a Python function raised while C called it: kept, and raised again when C has returned."""

    def __init__(self) -> None:
        self._raised: Optional[BaseException] = None

    def keep(self, raised: BaseException) -> None:
        self._raised = self._raised or raised

    def failed(self) -> bool:
        return self._raised is not None

    def raise_what_failed(self) -> None:
        raised, self._raised = self._raised, None
        if raised is not None:
            raise raised


def _number(value: Any) -> float:
    if isinstance(value, str):
        raise TypeError(f"a function returned {value!r}, which is no number")
    return float(value)


class _Function(_Failure):
    def __init__(self, function: Callable[[float], float]) -> None:
        super().__init__()

        def call(x: float, user: Any) -> float:
            try:
                return 0.0 if self.failed() else _number(function(x))
            except BaseException as raised:
                self.keep(raised)
                return 0.0

        self.pointer = _library.density_function(call)


def _function(name: str, function: Callable[[float], float], origin: str) -> Source:
    if not callable(function):
        raise TypeError(f"a function is wanted, not {function!r}")
    called = _Function(function)
    return Source._of(checked(name, called.pointer, None, text_bytes(origin)), _function=called)


class Reporter(_Failure):
    """Runs a long call of C in a thread, with a progress function. Python delivers signals to the main thread alone, so
    Control-C arrives where this waits, never inside C, where it would be lost; the next report of progress then ends
    the call, and the function of the source returns at once."""

    def __init__(self, progress: Optional[Progress], source: Optional[Source] = None) -> None:
        super().__init__()
        self._stop = False
        self._function = function = source._function if source is not None else None

        def call(done: float, what: bytes, user: Any) -> int:
            if self._stop or (function is not None and function.failed()):
                return 1
            try:
                return int(progress is not None and bool(progress(done, what.decode())))
            except BaseException as raised:
                self.keep(raised)
                return 1

        self.pointer = _library.progress_function(call)

    def run(self, call: Callable[[], _T]) -> _T:
        """The result of `call`. What the progress function raised comes before the error that it has caused."""
        results: list[_T] = []
        errors: list[BaseException] = []

        def work() -> None:
            try:
                results.append(call())
            except BaseException as raised:
                errors.append(raised)

        thread = threading.Thread(target=work)
        thread.start()
        try:
            thread.join()
        except BaseException as raised:
            self._stop = True
            if self._function is not None:
                self._function.keep(raised)
            thread.join()
            raise
        self.raise_what_failed()
        if errors:
            raise errors[0]
        return results[0]


def build(
    source: Source,
    *,
    max_bytes: int = 0,
    max_tv: float = 0.0,
    moments: int = 0,
    breaks: Iterable[float] = (),
    finest: float = 0.0,
    progress: Optional[Progress] = None,
) -> Distribution:
    """Builds a table.

    max_bytes: largest size of the file, 2048 to 1 MiB; 0: what TV 1e-3 above and 3e-2 below the horizon takes, up to 8192.
    max_tv: build the smallest table that reaches this total variation above, and 30 times it below; 0: the best that fits.
    moments: 2, 3 or 4, which bound the error of the density above the horizon by 6.5e-2, 4.7e-3, 7.2e-4; 0: 4.
    breaks: slopes where a feature begins, ends or has its peak.
    finest: relative width in slope of the features that samples of a function have to find, 1e-9 to 1; 0: 1e-3.
    progress: called with the part that is done, 0 to 1, and the name of the stage; a true result stops the build.

    Raises :class:`vndf.Error` if the source cannot be the normals of a microsurface, with the reason, or if the
    target cannot be met, with what was reached. What `progress` or the function of the source raises comes through."""
    want(source, Source)
    if max_bytes < 0:
        raise ValueError(f"max_bytes is {max_bytes}; it must not be negative")
    reporter = Reporter(progress, source)
    marks = np.ascontiguousarray(list(breaks), np.float64)
    options = _library.vndf_build_options(
        max_bytes=max_bytes, max_tv=max_tv, progress=reporter.pointer, breaks=marks.ctypes.data,
        break_count=marks.size, finest=finest, moments=moments,
    )  # fmt: skip
    try:
        return reporter.run(lambda: Distribution._of(checked("build", source._pointer, byref(options), None)))
    finally:
        source._raise_what_failed()


def certify(distribution: Distribution, source: Source) -> Certificate:
    """Measures the certificate of a table against a source."""
    want(distribution, Distribution)
    want(source, Source)
    struct = _library.vndf_certificate()
    try:
        Reporter(None, source).run(lambda: checked("certify", distribution._pointer, source._pointer, byref(struct)))
    finally:
        source._raise_what_failed()
    return certificate_of(struct)


def family_help() -> str:
    """The families of :meth:`Source.family`, a line each: parameters, ranges, formula, reference."""
    return str(library.family_help().decode())


def materials() -> Sequence[str]:
    """The names of the measured materials that are shipped, for :meth:`Source.family`."""
    names: list[str] = []
    while (name := library.family_material(len(names))) is not None:
        names.append(name.decode())
    return names
