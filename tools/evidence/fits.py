"""Makes every fitted coefficient of the library again: exit status 1 where the source errs more than it has to.

    python3 tools/evidence/fits.py [NAME...]         a line a fit: error of what is found, of the source, their ratio
    python3 tools/evidence/fits.py --print NAME...   the statements of the source with what is found

A fit reads a function of the C source and runs it with its constants of five digits or more as unknowns. Least largest
errors are found by Lawson's reweighting (Rice & Usow, "The Lawson Algorithm and Extensions", Mathematics of Computation
22, 1968), those of quotients from P - f Q over the Q of the step before. Constants by hand are held to the error that
the source states."""
import argparse
import math
import re
import sys
from decimal import Decimal, getcontext
from pathlib import Path
from types import SimpleNamespace as Struct
from typing import Any, Callable, NamedTuple, Optional

import numpy as np

SOURCE = Path(__file__).resolve().parents[2] / "src"
NUMBER = re.compile(r"(?<![\w.])(\d+\.\d*(?:e[-+]?\d+)?|\d+e[-+]?\d+)(f?)(?![\w.])")
PI, ROOT_PI, ROOT_2 = math.pi, math.sqrt(math.pi), math.sqrt(2)
erfc, gamma, log_gamma = (np.vectorize(f, otypes=[float]) for f in (math.erfc, math.gamma, math.lgamma))
getcontext().prec = 40


class Fit(NamedTuple):
    name: str  # the function's, and a word
    file: str
    what: str  # whose largest relative error, and where
    low: float
    high: float
    problem: Callable  # of points: what the function is given, and its error from (value, value of the step before)
    nodes: int = 0  # of Chebyshev, where it interpolates
    points: int = 300
    compared: Optional[float] = None  # up to where, if not to `high`
    free: slice = slice(None)  # the unknowns, of the constants that matter
    total: Optional[float] = None  # their sum
    rounds: int = 1
    number: Any = float
    by_hand: Optional[float] = None  # the error that the source states
    most: float = 1.1  # ratio
    why: str = ""


# ---- the source ----


class Braced(tuple):
    """What C has in braces: values of a struct or an array."""

    def __getattr__(self, name):
        return self["xd".index(name)]


def bits(x):
    return np.asarray(x, np.float32).view(np.int32).astype(float)


def of_bits(n):
    """Halves are rounded up, since what C rounds down is subtracted."""
    return np.ceil(n).astype(np.int32).view(np.float32).astype(float)


WORDS = {"bits": bits, "of_bits": of_bits, "Braced": Braced, "Struct": Struct, "with_sign": np.copysign}
WORDS |= {"set": lambda x: x, "min": np.minimum, "max": np.maximum, "abs": np.abs, "sqrt": np.sqrt, "any": np.any}
WORDS |= {"select": np.where, "lt": np.less, "le": np.less_equal, "both": np.logical_and, "to_int": np.trunc}
WORDS |= {"exp_of": np.exp, "log_of": np.log, "to_real": lambda n: n}


def is_fitted(number):
    return len(re.sub(r"e.*|\D", "", number).strip("0")) > 4


class Function:
    """A C function without its types, less the statements that assign to what is given."""

    def __init__(self, fit, given):
        name = fit.name.split()[0]
        pattern = rf"\b{name}(?:\([^;{{]*?\)\n{{\n(.*?)\n}}|\[\d+\] = ({{.*?}});)"
        found = re.search(pattern, (SOURCE / fit.file).read_text(encoding="utf-8"), re.S)
        if not found:
            sys.exit(f"src/{fit.file} has no {name}")
        text = " ".join(re.sub(r"/\*.*?\*/", "", found[1] or f"all = {found[2]}; return all;", flags=re.S).split())
        self.lines, self.constants, depth = [], [], 1
        for part in re.findall(r"[^;{}]+|[{}]", re.sub(r"= {([^{}]*)}", r"= Braced((\1))", text)):
            part = re.sub(r"^(const )?\w+ (?=\w+ = )", "", part.strip())
            depth += {"{": 1, "}": -1}.get(part, 0)
            statements = [s for s in re.split(r", (?=[\w.]+ = )", part) if re.match(r"[\w.]+ = ", s)]
            if part.startswith(("if ", "return ")):
                statements = [part + ":" * part.startswith("if ")]
            elif re.fullmatch(r"\w+ \w+", part):
                statements = [part.split()[1] + " = Struct()"]
            self.lines += ["    " * depth + s for s in statements if s.split(" = ")[0] not in given]
        names = {**WORDS, **given, "N": fit.number}
        exec("def value(constant):\n" + "\n".join(NUMBER.sub(self._unknown, line) for line in self.lines), names)
        self.value = names["value"]
        self.source = np.array([fit.number(c) for c in self.constants], object if fit.number is Decimal else float)

    def _unknown(self, number):
        if not is_fitted(number[1]):
            return f"N('{number[1]}')"
        self.constants.append(number[1])
        return f"constant[{len(self.constants) - 1}]"

    def printed(self, constants):
        digits = 18 if self.source.dtype == object else 12
        texts = iter(t if c == s else f"{c:.{digits}g}" for t, s, c in zip(self.constants, self.source, constants))
        swap = lambda number: next(texts) + number[2] if is_fitted(number[1]) else number[0]
        new = [NUMBER.sub(swap, line) for line in self.lines]
        text = "\n".join(line.strip() + ";" for line, old in zip(new, self.lines) if line != old)
        return re.sub(r"Braced\(\((.*)\)\)", r"{\1}", text)


# ---- fits ----


def between(a, b, count):
    """Chebyshev's nodes."""
    return (a + b) / 2 - (b - a) / 2 * np.cos(PI * (np.arange(count) + 0.5) / count)


def least_largest(a, r, steps):
    """The d with the least largest |r + A d|."""
    weight, best, least = np.full(len(r), 1 / len(r)), None, np.inf
    for _ in range(steps):
        root = np.sqrt(weight)
        q, triangle = np.linalg.qr(a * root[:, None])
        d = np.linalg.solve(triangle, -(r * root) @ q)
        error = np.abs(r + a @ d)
        if error.max() < least:
            best, least = d, error.max()
        weight = np.maximum(weight * error / max(error.max(), 1e-300), 1e-30)
        weight /= weight.sum()
    return best


def found(fit):
    """The function of a fit, its constants, and which of them are unknown."""
    given, error = fit.problem(between(fit.low, fit.high, fit.nodes or fit.points))
    function = Function(fit, given)

    def columns(c, before, at):
        units = np.eye(len(c), dtype=int)
        return np.array([error(function.value(c + unit), before) - at for unit in units]).T.astype(float)

    c, before = function.source.copy(), function.value(function.source)
    free = np.flatnonzero(np.abs(columns(c, before, error(before, before))).max(0) > 0)[fit.free]
    c[free] *= 0
    c[free[-1]] += fit.total or 0
    for _ in range(fit.rounds):
        before = function.value(c)
        at = error(before, before)
        a = columns(c, before, at)[:, free]
        a = a if fit.total is None else a[:, :-1] - a[:, -1:]
        scale = np.abs(a).max(0)
        d = least_largest(a / scale, at.astype(float), 1 if fit.nodes else 200) / scale
        c[free] += [fit.number(x) for x in (d if fit.total is None else [*d, -d.sum()])]
    return function, c, free


def is_as_good(fit):
    given, error = fit.problem(between(fit.low, fit.compared or fit.high, fit.points))
    function = Function(fit, given)
    largest = lambda c: float(np.abs(error(function.value(c), None)).max())
    source, best, is_right = largest(function.source), fit.by_hand, True
    if not best:
        _, c, free = found(fit)
        best, is_right = largest(c), not fit.total or abs(function.source[free].sum() - fit.total) < 2e-9
    how = "by hand" if fit.by_hand else "interpolates" if fit.nodes else "least"
    why = f" (at most {fit.most}: {fit.why})" if fit.why else ""
    print(f"{fit.name:27} {best:8.2g} {source:8.2g} {source / best:6.3f}  {how}: {fit.what}; {fit.file}{why}")
    return is_right and source <= fit.most * best


# ---- what is exact ----


def relative(exact, **given):
    return given, lambda value, _: value / exact - 1


def linear(exact, name, **given):
    return lambda x: relative(exact(x), **{name: x}, **given)


def quotient(exact, **given):
    """Of P/Q, where Q was `before`."""
    return given, lambda value, before: (value[0] / exact - value[1]) / (value if before is None else before)[1]


def product(*axes):
    return np.stack([axis.ravel() for axis in np.meshgrid(*axes)])


def solved(rising, low, high, value):
    for _ in range(60):
        half = (low + high) / 2
        low, high = np.where(rising(half) < value, (half, high), (low, half))
    return half


def remainder(z):
    """N of math.h."""
    n, low = 0 * z, np.minimum(z, 2)
    for j in range(300, 0, -1):
        n = j / 2 / (z + n)
    return np.where(z < 2, 1 / (ROOT_PI * np.exp(low * low) * erfc(low)) - low, n)


def quantile(w):
    """y > 0 with 1 - erf(y)^2 = exp(-w), by Newton's steps for log erfc."""
    y, goal = np.sqrt(w), -w - np.log1p(np.sqrt(-np.expm1(-w)))
    for _ in range(20):
        n = remainder(y)
        y = y + (-y * y - np.log(ROOT_PI * (y + n)) - goal) / (2 * (y + n))
    return y


def erf_quantile(w):
    return relative(quantile(w), w=w, u=0.5 + 0.5 * np.sqrt(-np.expm1(-w)))


def arc_rest(q):
    return {"t": q * q}, lambda rest, _: (q - q**3 * rest) / np.arctan(q) - 1


def arc_start(t, below):
    """Kepler's equation of arc.h from p, or t = q^2; the inverse of (d/v)^2 is linear in the coefficients."""
    v, none = np.concatenate([np.geomspace(0.004, 0.1, 12), np.linspace(0.12, 1, 16)]), np.zeros(1)
    v, p, t = product(v, none, t) if below else np.hstack([product(v, t, none), product(v, none, t)])
    sign = -1 if below else 1
    q, r, cc, length = np.sqrt(t), sign * (1 - p - t) / 2, sign * (1 + p - t) / 2, 2 * np.arctan(np.sqrt(t))
    length, unit = (length, 2 * q * v) if below else (PI - length, v)
    kepler = lambda d: p * d + 2 * q * np.sin(d / 2) ** 2 + r * (d - np.sin(d))
    d = solved(kepler, 0 * v, length, v * (cc * length + q))
    words = {"arc_inverse_root": lambda x: x, "arc_two_thirds": lambda x: x ** (2 / 3), "max": lambda a, b: a}
    return relative(unit * (unit / d) ** 2, k=Struct(p=p, q=q, q2=t), v=v, below=below, **words)


def law_terms(x, row):
    k = np.arccos(-x) + np.sqrt(1 / (x * x) - 1)
    powers = PI / k * np.array([1 / x, x**0, x, x**4])
    return {}, lambda value, _: np.dot(value[4 * row : 4 * row + 4], powers) - 1


def gamma_factor(per):
    """By Stirling's series where x = 1/per is above 20."""
    x = np.minimum(1 / per, 20)
    low = log_gamma(x) - (x - 0.5) * np.log(x) + x - 0.5 * math.log(2 * PI)
    high = per / 12 - per**3 / 360 + per**5 / 1260 - per**7 / 1680
    return quotient(np.exp(np.where(per < 0.05, high, low)), per=per)


def profile_kernel(v):
    """sin a - a cos a by its series, cos a = 1 - v."""
    a = 2 * np.arcsin(np.sqrt(v / 2))
    exact = -sum((-1) ** k * 2 * k * a ** (2 * k + 1) / math.factorial(2 * k + 1) for k in range(1, 14))
    return relative(exact, r=1, way=v, v=v)


def exp_double(x):
    r = np.array([Decimal(v) for v in x], object)
    return relative(np.array([v.exp() for v in r], object), r=r, shifted=0, whole=0, bits=0, power=1)


def log_double(s):
    """Of s = f^2."""
    f = np.array([Decimal(v).sqrt() for v in s], object)
    given = {"least": 0, "bits": 0, "k": 0, "VNDF_LOG2_HIGH": 0, "VNDF_LOG2_LOW": 0}
    return relative(np.array([((1 + v) / (1 - v)).ln() for v in f], object), f=f, **given)


def middle(u):
    return 4 * np.maximum(u, 5.4e-20) * np.maximum(1 - u, 1.5e-8)


def beckmann_first(w):
    """z, as a function of w = -log(4 u (1 - u)): u, and its quantile, on both sides."""
    u = np.exp(-w) / (2 + 2 * np.sqrt(-np.expm1(-w)))
    u = np.concatenate([u, 1 - u[::-1]])
    view = Struct(p0=0, p1=0, p2=0, p3=0, p4=0, near=0, law=Struct(bound=0))
    given = {"u": u, "l": 127 - bits(middle(u)) / 2**23, "v": view}
    return given, lambda z, _: z[0] / np.concatenate([-quantile(w), quantile(w)[::-1]]) - 1


def beckmann_law(bound):
    """F, K > 0, but for a factor, and F(K)."""
    area = lambda x: ROOT_PI * bound * erfc(-x) + np.exp(-x * x)
    return area, area(bound)


def beckmann_see(x, near):
    """What is left after a step of order four; its fourth root is nearly linear in the start, hence in p."""
    given = beckmann_first(between(0, 8, 40))[0]
    first = Function(Fit("beckmann_first", BECKMANN, "", 0, 8, beckmann_first), given)
    (bound, u), z = product(x if near else 4 / x, given["u"]), np.repeat(first.value(first.source)[0], len(x))
    area, whole = beckmann_law(bound)
    exact = solved(area, -6 + 0 * u, np.minimum(bound, 6), u * whole)

    def after(x):
        d = bound - x
        h, second, third = (area(x) - u * whole) * np.exp(x * x) / (2 * d), 1 / d + 2 * x, x / d + x * x - 0.5
        return area(x - h * (1 + h * second / 2) / (1 + h * (h * third * 2 / 3 + second))) / whole - u

    def error(v, before):
        p = (v.p0 + z * v.p1) + z * z * ((v.p2 + z * v.p3) + z * z * v.p4)
        if before is None:
            return after(bound - p * p if near else z - p)
        return weight * (2 * root * (root - p) if near else z - p - exact)

    root = np.sqrt(bound - exact)
    reach = 0.01 * np.minimum(1, root * root)
    weight = ((np.abs(after(exact + reach)) + np.abs(after(exact - reach))) / 2) ** 0.25 / reach
    return {"law": Struct(bound=bound)}, error


def beckmann_anywhere(bound):
    bound, u = product(bound, np.concatenate([np.geomspace(6e-20, 0.4, 60), 1 - np.geomspace(6e-8, 0.5, 40)]))
    area, whole = beckmann_law(bound)
    if bound.max() < 0:  # (1) of beckmann.h over exp(-K^2)
        part = lambda x: (remainder(-x) + bound - x) / (remainder(-x) - x)
        area, whole = lambda x: part(x) * np.exp((bound - x) * (bound + x)), part(bound)
    fall = np.where(bound < 1.25, np.exp(np.clip(bound, 0, 1.25) ** 2), 1)
    law = Struct(bound=bound, whole=whole * fall, line=2 * ROOT_PI * bound * fall)
    inverse = lambda u: np.sign(u - 0.5) * quantile(-np.log(np.minimum(middle(u), 1 - 1e-12)))
    return {"u": u, "v": law, "erf_quantile": inverse}, lambda start, _: area(start.x) / whole - u


MATH, ARC, LAW, BECKMANN = "kernel/math.h", "kernel/arc.h", "kernel/law.h", "kernel/beckmann.h"
LOBES, PROFILE, EXP_LOG = "kernel/lobes.h", "fit/profile/profile.h", "math/exp_log.h"
EXP, LOG = math.log(2) / 2, ((ROOT_2 - 1) / (ROOT_2 + 1)) ** 2
ANYWHERE, ROUNDED = "beckmann_first_anywhere", "the source has nine digits"
POWER = "1.2 to the power of four"
FITS = [
    Fit("sine_quarter", MATH, "f in [0, 1/2]", 0, 0.5, linear(lambda f: np.sin(PI * f), "f")),
    Fit("arc_rest", MATH, "of the angle, q in [0, 1]", 0, 1, arc_rest),
    Fit("exp_near", MATH, "|r| <= log(2)/2", -EXP, EXP, linear(np.exp, "r", n=0, k=0, power=1)),
    Fit("log_near", MATH, "1/sqrt(2) <= 1 + f <= sqrt(2)", ROOT_2 / 2 - 1, ROOT_2 - 1, linear(np.log1p, "f")),
    Fit("erfc_rest", MATH, "of N, z >= 0", 0, 1, lambda x: quotient(remainder(x / (1 - x)), z=x / (1 - x)), rounds=10,
        compared=0.903, most=1.5, why=ROUNDED + "; compared for z < 9.4, where exp(-z^2) is a float"),
    Fit("erf_quantile low", MATH, "w in [0, 8]", 0, 8, erf_quantile),
    Fit("erf_quantile far", MATH, "w in [8, 50]", 8, 50, erf_quantile),
    Fit("arc_inverse_root", ARC, "any x", 1, 4, linear(lambda x: x**-0.5, "x"), points=3000, by_hand=0.0018),
    Fit("arc_two_thirds", ARC, "any x", 1e-6, 1, linear(lambda x: x ** (2 / 3), "x"), points=3000, by_hand=0.048),
    Fit("arc_start above", ARC, "of v^2/d^2, v >= 0.004", 0, 1, lambda t: arc_start(t, False), points=30),
    Fit("arc_start below", ARC, "of v^2/d^2, v >= 0.004", 0, 1, lambda t: arc_start(t, True), points=30),
    Fit("arc_sine", ARC, "d in [0, pi]", 0, PI, lambda d: relative(ROOT_2 * np.sin(d / 2) / d, d2=d * d), most=1.3,
        why=ROUNDED),
    *(Fit(f"law_terms {row + 2}", LAW, "of k~, y >= 1, of sum 1", 0, 1, lambda x, row=row: law_terms(x, row),
          points=1000, total=1) for row in range(3)),
    Fit("beckmann_first", BECKMANN, "of z", 0, 8, beckmann_first, most=2.5, why="p makes up for it"),
    Fit("beckmann_view_of near", BECKMANN, "absolute, of u after a step, K < 2", 0, 2, lambda x: beckmann_see(x, True),
        points=20, free=slice(1, None, 2), most=2.1, why=POWER),
    Fit("beckmann_view_of far", BECKMANN, "absolute, of u after a step, K > 2", 0, 2, lambda x: beckmann_see(x, False),
        points=20, most=2.1, why=POWER),
    Fit(ANYWHERE + " low", BECKMANN, "absolute, of u, K < 0", -30, 0, beckmann_anywhere, points=20, by_hand=0.0035),
    Fit(ANYWHERE + " up", BECKMANN, "absolute, of u, K < 5/4", 0, 1.25, beckmann_anywhere, points=20, by_hand=0.035),
    Fit(ANYWHERE + " far", BECKMANN, "absolute, of u", 1.25, 20, beckmann_anywhere, points=60, by_hand=0.023),
    Fit("per_gamma_low", LOBES, "|v| <= 1", -1, 1, linear(lambda v: 1 / gamma(2 + v), "v"), nodes=12),
    Fit("per_gamma_high", LOBES, "|v| <= 2", -2, 2, linear(lambda v: 1 / gamma(4 + v), "v"), nodes=17),
    Fit("gamma_factor_at", LOBES, "1/x in [0, 1]", 0, 1, gamma_factor, nodes=6),
    Fit("vndf_profile_kernel", PROFILE, "v in [0, 1]", 0, 1, profile_kernel, nodes=9),
    Fit("vndf_exp_near", EXP_LOG, "|r| <= log(2)/2", -EXP, EXP, exp_double, 10, 100, rounds=4, number=Decimal),
    Fit("vndf_log", EXP_LOG, "|f| < 0.1716", 0, LOG, log_double, 7, 100, rounds=4, number=Decimal),
]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("names", metavar="NAME", nargs="*", help="as the first column has it; all without")
    parser.add_argument("--print", action="store_true", help="the statements of the source with what is found")
    options = parser.parse_args()
    unknown = set(options.names) - {fit.name for fit in FITS}
    if unknown:
        parser.error(f"no such fit: {', '.join(sorted(unknown))}")
    fits = [fit for fit in FITS if fit.name in options.names or not options.names]
    if options.print:
        for fit in (fit for fit in fits if not fit.by_hand):
            function, constants, _ = found(fit)
            print(f"{fit.name}:\n{function.printed(constants)}")
        return
    print("fit                            found   source  ratio  largest relative error")
    sys.exit(not all([is_as_good(fit) for fit in fits]))


if __name__ == "__main__":
    main()
