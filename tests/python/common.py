"""What tests of the package share: inputs, and the loops over single calls of singles.c."""
import ctypes
import os

import numpy as np

COUNT = 3001
TABLES = os.path.join(os.environ["VNDF_SOURCE"], "tables")


def arrays(count):
    return [(name, ctypes.c_void_p * n) for name, n in count.items()]


class Singles(ctypes.Structure):
    """struct singles of singles.c."""

    _fields_ = [
        ("n", ctypes.c_int),
        *arrays(dict(alpha=2, matrix=4, mean=2, wi=3, wm=3, u=3, drawn=3)),
        ("pdf", ctypes.c_void_p),
        ("weight", ctypes.c_void_p),
        *arrays(dict(other=6, inverse=2)),
    ]


OTHER = ["pdf", "visible", "ndf", "projected_area", "lambda_", "g1"]


def addresses(rows):
    return (ctypes.c_void_p * len(rows))(*[row.ctypes.data for row in rows])


def single_calls(inputs):
    """A struct with these inputs, arrays of shape (k, COUNT), and its results by name."""
    struct = Singles(n=COUNT)
    results = {name: np.empty((k, COUNT), np.float32) for name, k in dict(drawn=3, other=6, inverse=2).items()}
    for name, rows in {**inputs, **results}.items():
        setattr(struct, name, addresses(rows))
    for name in ("pdf", "weight"):
        results[name] = np.empty(COUNT, np.float32)
        setattr(struct, name, results[name].ctypes.data)
    return struct, results


def loop(name, *arguments):
    getattr(ctypes.CDLL(os.environ["VNDF_SINGLES"]), name)(*arguments)


def directions(rng, count=COUNT, below=True):
    w = rng.normal(size=(3, count))
    w[2] = w[2] if below else abs(w[2])
    return (w / np.linalg.norm(w, axis=0)).astype(np.float32)


def random_inputs(seed):
    rng = np.random.default_rng(seed)
    return dict(
        alpha=np.exp(rng.uniform(-4, 1, (2, COUNT))).astype(np.float32),
        matrix=rng.normal(size=(4, COUNT)).astype(np.float32),
        mean=(0.3 * rng.normal(size=(2, COUNT))).astype(np.float32),
        wi=directions(rng),
        wm=directions(rng, below=False),
        u=rng.random((3, COUNT), dtype=np.float32),
    )
