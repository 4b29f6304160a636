"""Tables from whatever a distribution is given by: formulas, families, files, arrays, functions."""
from __future__ import annotations

import threading
from ctypes import byref
from typing import Any, Callable, Optional, Sequence, TypeVar, Union

import numpy as np

from ._arrays import Numbers
from ._library import Owner, checked, library, pointer, struct, text_bytes, want
from .distribution import Distribution, Path

_T = TypeVar("_T")

#: called with the part that is done, 0 to 1, and the name of the stage; a true result stops the build
Progress = Callable[[float, str], Any]


class Source(Owner):
    """A distribution of normals as it is given, at any scale, normalised or not."""

    _free = "source_free"
    _makers = "vndf.Source.slope, .ndf, .family, .csv or .rows"
    _called: Any = None  # what C calls back

    @staticmethod
    def slope(p22: Union[str, Callable[[float], float]], **parameters: float) -> Source:
        """P22 as a formula in r = tan(theta), with named numbers (vndf_build.h lists operators and functions), or as a
        Python function of r. A function can only be sampled: features narrower than 1e-3 may hide."""
        return _formula("slope", p22, parameters)

    @staticmethod
    def ndf(ndf: Union[str, Callable[[float], float]], **parameters: float) -> Source:
        """D as a formula in c = cos(theta), theta (radians) and t = tan(theta), or as a Python function of c; one of
        slopes is better for narrow distributions, as 1 - c loses digits."""
        return _formula("ndf", ndf, parameters)

    @staticmethod
    def family(specification: str) -> Source:
        """A family or a measured material by name, as ``vndf build --family`` takes it."""
        return Source._of(checked("source_family", text_bytes(specification)))

    @staticmethod
    def csv(path: Path) -> Source:
        """A CSV file with a header line that names its columns."""
        return Source._of(checked("source_csv_file", text_bytes(path)))

    @staticmethod
    def rows(
        *, theta: Optional[Numbers] = None, slope: Optional[Numbers] = None, ndf: Optional[Numbers] = None,
        p22: Optional[Numbers] = None, name: str = "rows",
    ) -> Source:  # fmt: skip
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

    def p22(self, r: float) -> float:
        """P22 at the slope length r >= 0, as it was given."""
        return _Call().run(lambda: float(library.source_p22(self._pointer, r)))

    def __repr__(self) -> str:
        return f"<vndf.Source {library.source_description(self._pointer).decode()}>"


def _formula(kind: str, given: Any, parameters: dict[str, float]) -> Source:
    if callable(given):
        if parameters:
            raise TypeError("parameters are for formulas")
        called = pointer("vndf_density_function")(lambda x, user: _here.call.guard(0.0, _number, given, x))
        name = text_bytes(getattr(given, "__name__", "Python function"))
        return Source._of(checked(f"source_{kind}_callback", called, None, name), _called=called)
    array = (struct("vndf_parameter") * max(len(parameters), 1))()
    for slot, (key, value) in zip(array, parameters.items()):
        slot.name, slot.value = text_bytes(key), value
    return Source._of(checked(f"source_{kind}_expression", text_bytes(given), array, len(parameters)))


def _number(function: Callable[[float], float], x: float) -> float:
    value: Any = function(x)
    if isinstance(value, str):
        raise TypeError(f"a function returned {value!r}, which is no number")
    return float(value)


class _Call:
    """A long call of C, in a thread, and what the Python functions that it calls have raised. Python delivers signals
    to the main thread alone, so Control-C arrives where this waits, never inside C, where it would be lost."""

    raised: Optional[BaseException] = None

    def guard(self, otherwise: _T, function: Callable[..., _T], *arguments: Any) -> _T:
        """What a function returns to C; `otherwise`, at once, after one has raised."""
        try:
            if self.raised is None:
                return function(*arguments)
        except BaseException as raised:
            self.raised = self.raised or raised
        return otherwise

    def progress(self, told: Optional[Progress]) -> Any:
        """C asks it whether to stop."""
        def asked(done: float, what: bytes, user: Any) -> int:
            return self.guard(1, lambda: int(told is not None and bool(told(done, what.decode()))))

        return pointer("vndf_progress")(asked)

    def run(self, call: Callable[[], _T]) -> _T:
        """The result of `call`. What a Python function raised comes before the error that it has caused."""
        results: list[_T] = []

        def work() -> None:
            _here.call = self
            self.guard(None, lambda: results.append(call()))

        thread = threading.Thread(target=work)
        thread.start()
        try:
            thread.join()
        except BaseException as raised:
            self.raised = raised  # the next report of progress ends the call
            thread.join()
        if self.raised is not None:
            raise self.raised
        return results[0]


_here = threading.local()  # .call: the _Call that this thread works for


def build(
    source: Source, *, max_bytes: int = 0, max_tv: float = 0.0, moments: int = 0,
    progress: Optional[Progress] = None,
) -> Distribution:  # fmt: skip
    """Builds a table.

    max_bytes: largest size of the file, 2048 to 1 MiB; 0: what TV 1e-3 above and 3e-2 below the horizon takes, to 8192.
    max_tv: the smallest table that reaches this total variation above, and 30 times it below; 0: the best that fits.
    moments: 2, 3 or 4, which bound the error of the density above the horizon by 6.5e-2, 4.7e-3, 7.2e-4; 0: 4.
    progress: called with the part that is done, 0 to 1, and the name of the stage; a true result stops the build.

    Raises :class:`vndf.Error` if the source cannot be the normals of a microsurface, with the reason, or if the
    target cannot be met, with what was reached. What `progress` or the function of the source raises comes through."""
    want(source, Source)
    if max_bytes < 0:
        raise ValueError(f"max_bytes is {max_bytes}; it must not be negative")
    call = _Call()
    options = struct("vndf_build_options")(
        max_bytes=max_bytes, max_tv=max_tv, progress=call.progress(progress), moments=moments,
    )  # fmt: skip
    return call.run(lambda: Distribution._of(checked("build", source._pointer, byref(options), None)))


def family_help() -> str:
    """The families of :meth:`Source.family`, a line each: parameters, ranges, formula, reference."""
    return str(library.family_help().decode())


def materials() -> Sequence[str]:
    """The names of the measured materials that are shipped, for :meth:`Source.family`."""
    names: list[str] = []
    while (name := library.family_material(len(names))) is not None:
        names.append(name.decode())
    return names
