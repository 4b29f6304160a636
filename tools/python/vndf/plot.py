"""Pictures with matplotlib, which is imported when the first one is asked for."""
from __future__ import annotations

from typing import Any, Optional, Sequence, Union

import numpy as np

from ._arrays import Numbers
from .distribution import Distribution
from .surface import Affine, Mixture, Surface


def _axes(axes: Any) -> Any:
    if axes is not None:
        return axes
    import matplotlib.pyplot as plt

    return plt.subplots()[1]


def ndf(distributions: Union[Distribution, Sequence[Distribution]], alpha: float = 1.0, *, axes: Any = None) -> Any:
    """D over the angle of the normal, 0 to 89 degrees, logarithmic, a curve for each distribution. Returns the axes of
    matplotlib; `axes`: where to draw."""
    axes = _axes(axes)
    theta = np.linspace(0.0, np.radians(89.0), 800)
    for distribution in [distributions] if isinstance(distributions, Distribution) else distributions:
        values = Surface(distribution, alpha).ndf((np.sin(theta), 0.0, np.cos(theta)))
        axes.semilogy(np.degrees(theta), np.maximum(values, 1e-30), label=distribution.info.source)
    low, high = axes.get_ylim()
    axes.set_ylim(max(low, high * 1e-8), high)
    axes.set_xlabel("angle of the normal, degrees")
    axes.set_ylabel("D, per steradian")
    axes.legend()
    return axes


def visible(
    surface: Union[Surface, Affine, Mixture], theta: float, *, samples: int = 400, rng: Optional[np.random.Generator] = None, axes: Any = None
) -> Any:
    """The density of visible normals from `theta` (degrees, 0 to 180) over the disc of normals, and some that were
    drawn. Each point of the disc is the normal seen from above, at sin(angle/2): areas are solid angles."""
    axes = _axes(axes)
    wi = _towards(np.radians(theta))
    side = np.linspace(-1.0, 1.0, 401)
    x, y = np.meshgrid(side, side)
    square = x * x + y * y
    wm = _from_disc(x, y)
    density = np.where(square <= 1.0, surface.visible(wi, wm), np.nan)
    image = axes.imshow(density, origin="lower", extent=(-1, 1, -1, 1), cmap="viridis")
    axes.figure.colorbar(image, ax=axes, label="visible normals, per steradian")
    u = (rng or np.random.default_rng(1)).random((2, samples), dtype=np.float32)
    drawn = surface.sample(wi, u).wm
    stretch = 1.0 / np.sqrt(1.0 + drawn[2])
    axes.plot(drawn[0] * stretch, drawn[1] * stretch, "w.", markersize=2)
    axes.set_title(f"from {theta:g} degrees")
    axes.set_axis_off()
    return axes


def _towards(theta: Numbers) -> tuple[Any, float, Any]:
    return np.sin(theta), 0.0, np.cos(theta)


def _from_disc(x: Any, y: Any) -> tuple[Any, Any, Any]:
    """Lambert's equal-area disc of the hemisphere, of radius 1."""
    square = np.minimum(x * x + y * y, 1.0)
    stretch = np.sqrt(2.0 - square)
    return x * stretch, y * stretch, 1.0 - square
