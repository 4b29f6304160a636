"""Reflection and refraction: materials of any surface.

Shapes and directions are those of vndf.surface. wi is the known direction, wo the chosen one; here z < 0 is the other
side of the surface. vndf_bsdf.h has the model and what effects go together.
"""
from __future__ import annotations

import functools
import inspect
from ctypes import addressof, byref, c_void_p
from typing import Any, NamedTuple, Optional

import numpy as np

from ._arrays import Batch, Floats, Numbers, addresses_of, components, stacked, uniform
from ._library import Owner, checked, constant, library, struct, want, words
from .distribution import Distribution
from .surface import Rough, Surface, batch_of

#: values of Scattered.lobe
LOBE_NONE, LOBE_REFLECTION, LOBE_TRANSMISSION, LOBE_STRAIGHT = range(4)

_WAVELENGTHS = constant("VNDF_WAVELENGTHS")
_ENUMS = {"normals": "vndf_normals_drawn"}  # of the others the name is that of the effect


class Scattered(NamedTuple):
    """Directions that were drawn."""

    wo: Floats  #: unit, shape (3, ...)
    weight: Floats  #: f |cos_o| / density, shape (wavelengths, ...)
    density: Floats  #: per steradian, shape (...)
    lobe: np.ndarray[Any, np.dtype[np.uint8]]  #: LOBE_NONE (0: no sample), _REFLECTION, _TRANSMISSION or _STRAIGHT
    wm: Floats  #: the facet that was met, shape (3, ...); 0 where there is none or a walk met many


class _Albedo(Owner):
    """What single scattering keeps of the light, for compensation (vndf_bsdf.h)."""

    _free = "albedo_free"


@functools.lru_cache(64)
def _albedo(distribution: Distribution, eta: float) -> _Albedo:
    """Of a mirror (eta = 0) or a dielectric; a tenth of a second to two."""
    return _Albedo._of(checked("albedo_build", distribution._pointer, eta))


class Material:
    """A rough material: a surface (:class:`Surface` or :class:`Mixture`), whose numbers may be
    arrays where a texture brings one for each hit, its optics and its effects.

    lobes: "reflection", "transmission", "both".
    fresnel: "none", "schlick" (f0), "dielectric" (eta), "conductor" (eta and k).
    masking: "height-correlated", "separable", "v-cavities", "none".
    normals: "visible", "bounded", "all", "v-cavity".
    scattering: "single", "multiple" (a random walk), "turquin", "kulla-conty" (of reflection alone; these two take
        up to 2 seconds to make).
    transport: "radiance", "importance". reflection: "specular", "retro".
    eta: index on the side of -z over that on the side of z; of a conductor the real part, one for each wavelength.
    k: imaginary part of a conductor's index. f0: reflectance at normal incidence. Each a number, or 1 to 4 of them.
    wavelengths: how many a call carries; None: as many as eta, k or f0 have, 3 for single numbers.

    Raises :class:`vndf.Error` for a set that makes no sense, with the reason."""

    def __init__(
        self, surface: Rough, *, lobes: str = "reflection", fresnel: str = "none", masking: str = "height-correlated",
        normals: str = "visible", scattering: str = "single", transport: str = "radiance", reflection: str = "specular",
        eta: Numbers = 1.5, k: Numbers = 0.0, f0: Numbers = 0.04, wavelengths: Optional[int] = None,
        order_limit: int = 0,
    ) -> None:  # fmt: skip
        self._made = {name: value for name, value in locals().items() if name != "self"}
        want(surface, Rough)
        optics = {"f0": stacked(f0), "conductor_eta": stacked(eta), "conductor_k": stacked(k)}
        most = max(array.size for array in optics.values())
        count = self.wavelengths = wavelengths or (3 if most == 1 else most)
        if not 1 <= count <= _WAVELENGTHS:
            raise ValueError(f"{count} wavelengths; 1 to {_WAVELENGTHS} are possible")
        index = optics["conductor_eta"].flat[0]
        description = struct("vndf_description")(wavelengths=count, eta=index, order_limit=order_limit)
        description.surface.xx = description.surface.yy = 1.0
        if isinstance(surface, Surface):
            description.surface.distribution = surface.distribution._pointer
            if scattering in ("turquin", "kulla-conty"):
                self._albedo = _albedo(surface.distribution, 0.0 if lobes == "reflection" else float(index))
                description.albedo = self._albedo._pointer
            self._shape = "tilted" if surface._is_moved else "level"
        else:
            self._shape = "mixture"
        for name, array in optics.items():
            if array.size not in (1, count):
                raise ValueError(f"{name.split('_')[-1]} has {array.size} numbers for {count} wavelengths")
            getattr(description, name)[:count] = np.broadcast_to(array.ravel(), (count,)).tolist()
        for effect, _ in struct("vndf_effects")._fields_:
            word = self._shape if effect == "shape" else self._made[effect]
            possible = words(_ENUMS.get(effect, f"vndf_{effect}"))
            if word not in possible:
                raise ValueError(f"{effect} is one of {', '.join(possible)}, not {word!r}")
            setattr(description.effects, effect, possible.index(word))
        self._material = struct("vndf_material")()
        checked("material_resolve", byref(description), byref(self._material))

    def __reduce__(self) -> Any:
        return functools.partial(Material, **self._made), ()

    def __repr__(self) -> str:
        default = inspect.signature(Material).parameters
        said = [f"{n}={v!r}" for n, v in self._made.items() if n != "surface" and v is not default[n].default]
        return f"<vndf.Material of {', '.join([repr(self._made['surface']), *said])}>"

    def sample(self, wi: Any, u: Any) -> Scattered:
        """Directions from wi (3, ...) and uniform numbers u (3, ...) in [0, 1], two for the normal, one for the lobe,
        or a ``numpy.random.default_rng()`` that draws them, one sample an element."""
        w, groups = components(wi, 3, "wi"), self._made["surface"]._groups
        numbers = uniform(u, 3, lambda: Batch(**groups, wi=w).shape)
        batch, hits = self._open(wi=w, u=numbers)
        result, lobe = np.empty((7 + self.wavelengths, *batch.shape), np.float32), np.empty(batch.shape, np.uint8)
        at = addresses_of(result)
        wo, wm = struct("vndf_normals")(*at[:3]), struct("vndf_normals")(*at[3:6])
        results = struct("vndf_scattered_n")(wo, _pointers(at[7:]), at[6], addresses_of(lobe[None])[0], wm)
        library.bsdf_sample_n(byref(hits), _pointers(batch.addresses("u")), results)
        return Scattered(result[:3], result[7:], result[6], lobe[()], result[3:6])

    def eval(self, wi: Any, wo: Any, seed: Any = 0) -> Floats:
        """f, without the cosine, shape (wavelengths, ...). `seed`, whole numbers, is for random walks."""
        return self._look(wi, wo, seed, self.wavelengths, 0)

    def pdf(self, wi: Any, wo: Any) -> Floats:
        """Density per steradian with which :meth:`sample` draws wo, shape (...)."""
        return self._look(wi, wo, None, 0, 1)[0]  # type: ignore[no-any-return]

    def eval_pdf(self, wi: Any, wo: Any, seed: Any = 0) -> tuple[Floats, Floats]:
        """Both at once."""
        result = self._look(wi, wo, seed, self.wavelengths, 1)
        return result[:-1], result[-1]

    def _look(self, wi: Any, wo: Any, seed: Any, wavelengths: int, pdf: int) -> Floats:
        """What C answers: a value for each wavelength, and the density after them where that is asked for."""
        given: dict[str, Any] = {"wi": components(wi, 3, "wi"), "wo": components(wo, 3, "wo")}
        if seed is not None:
            given["seed"] = np.asarray(seed, np.uint64)[None]
        batch, hits = self._open(**given)
        result = np.empty((wavelengths + pdf, *batch.shape), np.float32)
        at: list[Any] = addresses_of(result)
        seeds = batch.addresses("seed")[0] if seed is not None else None
        values, density = _pointers(at) if wavelengths else None, at[wavelengths] if pdf else None
        library.bsdf_eval_pdf_n(byref(hits), struct("vndf_normals")(*batch.addresses("wo")), seeds, values, density)
        return result

    def _open(self, **given: Any) -> tuple[Batch, Any]:
        """The arguments of one call, and the C struct of its hits."""
        surface = self._made["surface"]
        batch = Batch(**surface._groups, **given)
        textured = not all(batch.is_shared(name) for name in surface._groups)
        shared = batch.shared() & constant("VNDF_SHARED_WI") | (0 if textured else constant("VNDF_SHARED_SURFACE"))
        hits = struct("vndf_bsdf_batch")(addressof(self._material), batch.count, shared, 0)
        hits.wi_x, hits.wi_y, hits.wi_z = batch.addresses("wi", share=True)
        if self._shape != "mixture":
            hits.surface = batch_of(surface.distribution, batch.addresses("shape", share=True))
            return batch, hits
        arrays = {name: batch.whole(name) if textured else array for name, array in surface._groups.items()}
        groups = {name: array.reshape(len(array), -1) for name, array in arrays.items()}
        mixtures = np.zeros(groups["shape"].shape[1], np.dtype(struct("vndf_mixture")))
        mixtures["count"] = len(surface.lobes)
        for i, lobe in enumerate(surface.lobes):
            to = mixtures["lobe"][:, i]
            to["weight"] = groups["weight"][i]
            to["surface"]["distribution"] = lobe.distribution._pointer
            for name, values in zip(["xx", "xy", "yx", "yy", "mean_x", "mean_y"], groups["shape"][6 * i :]):
                to["surface"][name] = values
        (hits.mixture,) = batch.keep(mixtures[None])
        return batch, hits


def _pointers(addresses: list[int]) -> Any:
    return (c_void_p * _WAVELENGTHS)(*addresses[:_WAVELENGTHS])
