"""Reflection and refraction: materials of any distribution, and albedos for energy compensation.

Shapes and directions are those of vndf.surface. wi is the known direction, wo the chosen one; here z < 0 is the other
side of the surface. vndf_bsdf.h has the model and what effects go together.
"""
from __future__ import annotations

import inspect
from ctypes import addressof, byref, c_void_p
from typing import Any, NamedTuple, Optional, Union

import numpy as np

from . import _library
from ._arrays import Batch, Floats, Generator, Numbers, Size, addresses_of, components, stacked, uniform
from ._library import Immutable, Owner, checked, library, want
from .distribution import Distribution
from .surface import Blend, Mixture, roughness, stretched

_CHOICES = {
    "lobes": ["reflection", "transmission", "both"],
    "fresnel": ["none", "schlick", "dielectric", "conductor"],
    "masking": ["height-correlated", "separable", "v-cavities", "none"],
    "normals": ["visible", "bounded", "all", "v-cavity"],
    "scattering": ["single", "multiple", "turquin", "kulla-conty"],
    "transport": ["radiance", "importance"],
    "shape": ["aligned", "rotated", "matrix", "affine", "mixture"],
    "reflection": ["specular", "retro"],
}

#: values of Scattered.lobe
LOBE_NONE, LOBE_REFLECTION, LOBE_TRANSMISSION, LOBE_STRAIGHT = range(4)


class Scattered(NamedTuple):
    """Directions that were drawn."""

    wo: Floats  #: unit, shape (3, ...)
    weight: Floats  #: f |cos_o| / density, shape (wavelengths, ...)
    density: Floats  #: per steradian, shape (...)
    lobe: np.ndarray[Any, np.dtype[np.uint8]]  #: LOBE_NONE (0: no sample), _REFLECTION, _TRANSMISSION or _STRAIGHT
    wm: Floats  #: the facet that was met, shape (3, ...); 0 where there is none or a walk met many


class Albedo(Owner):
    """How much light single scattering of a distribution sends on, over cosine and roughness (vndf_bsdf.h)."""

    _free = "albedo_free"
    _makers = "vndf.Albedo.build"

    @staticmethod
    def build(distribution: Distribution, *, eta: float = 0.0) -> Albedo:
        """Of a mirror (eta = 0) or a dielectric, by quadrature; a tenth of a second to two."""
        want(distribution, Distribution)
        return Albedo._of(checked("albedo_build", distribution._pointer, eta))

    def directional(self, cosine: Numbers, alpha: Numbers) -> Floats:
        """E of light from a direction with this cosine, 0 to 1. One C call for each element."""
        look = np.frompyfunc(lambda c, a: library.albedo_directional(self._pointer, c, a), 2, 1)
        return stacked(look(cosine, alpha))[()]

    def average(self, alpha: Numbers, side: int = 1) -> Floats:
        """2 integral E mu dmu; side >= 0: the side of z, < 0: the other one. One C call for each element."""
        look = np.frompyfunc(lambda a: library.albedo_average(self._pointer, a, side), 1, 1)
        return stacked(look(alpha))[()]


class Material(Immutable):
    """A rough material: a distribution, its shape, its optics and its effects. Numbers may be arrays where a texture
    brings one for each hit: alpha, alpha_y, rotation, matrix, mean, and all of a mixture.

    distribution: a :class:`Distribution`, or a :class:`Mixture` or a :class:`Blend` of a family, which have their own
    roughness.
    alpha, alpha_y: roughness, > 0. rotation: the angle from x to the axis of alpha, radians.
    matrix, mean: in their place a matrix of slopes, shape (2, 2, ...), and a mean slope, shape (2, ...).
    lobes: "reflection", "transmission", "both".
    fresnel: "none", "schlick" (f0), "dielectric" (eta), "conductor" (eta and k).
    masking: "height-correlated", "separable", "v-cavities", "none".
    normals: "visible", "bounded", "all", "v-cavity".
    scattering: "single", "multiple" (a random walk), "turquin", "kulla-conty" (these two need `albedo`).
    transport: "radiance", "importance". reflection: "specular", "retro".
    eta: index on the side of -z over that on the side of z; of a conductor the real part, one for each wavelength.
    k: imaginary part of a conductor's index. f0: reflectance at normal incidence. Each a number, or 1 to 4 of them.
    wavelengths: how many a call carries; None: as many as eta, k or f0 have, 3 for single numbers.

    Raises :class:`vndf.Error` for a set that makes no sense, with the reason."""

    def __init__(
        self, distribution: Union[Distribution, Mixture, Blend], alpha: Numbers = 1.0, alpha_y: Optional[Numbers] = None, *,
        rotation: Optional[Numbers] = None, matrix: Any = None, mean: Any = None, lobes: str = "reflection",
        fresnel: str = "none", masking: str = "height-correlated", normals: str = "visible",
        scattering: str = "single", transport: str = "radiance", reflection: str = "specular", eta: Numbers = 1.5,
        k: Numbers = 0.0, f0: Numbers = 0.04, wavelengths: Optional[int] = None, albedo: Optional[Albedo] = None,
        order_limit: int = 0,
    ) -> None:  # fmt: skip
        self._made = {name: value for name, value in locals().items() if name != "self"}
        want(distribution, (Distribution, Mixture, Blend))
        if albedo is not None:
            want(albedo, Albedo)
        if mean is not None and matrix is None:
            raise TypeError("a mean slope needs a matrix")
        if not isinstance(distribution, Distribution):
            shape = "mixture"
        elif matrix is not None:
            shape = "matrix" if mean is None else "affine"
        else:
            shape = "aligned" if rotation is None else "rotated"
        optics = {"f0": stacked(f0), "eta": stacked(eta), "k": stacked(k)}
        if wavelengths is None:
            wavelengths = max(array.size for array in optics.values())
            wavelengths = 3 if wavelengths == 1 else wavelengths
        if not 1 <= wavelengths <= _library.WAVELENGTHS:
            raise ValueError(f"{wavelengths} wavelengths; 1 to {_library.WAVELENGTHS} are possible")
        self.wavelengths = wavelengths
        description = _library.vndf_description(
            distribution=distribution._pointer if isinstance(distribution, Distribution) else None,
            alpha_x=1.0, alpha_y=1.0, wavelengths=wavelengths, albedo=albedo and albedo._pointer,
            eta=optics["eta"].flat[0], order_limit=order_limit,
        )  # fmt: skip
        description.affine.xx = description.affine.yy = 1.0
        for name, member in (("f0", "f0"), ("eta", "conductor_eta"), ("k", "conductor_k")):
            _fill(getattr(description, member), optics[name], wavelengths, name)
        chosen = dict(lobes=lobes, fresnel=fresnel, masking=masking, normals=normals, scattering=scattering,
                      transport=transport, shape=shape, reflection=reflection)  # fmt: skip
        for effect, word in chosen.items():
            if word not in _CHOICES[effect]:
                raise ValueError(f"{effect} is one of {', '.join(_CHOICES[effect])}, not {word!r}")
            setattr(description.effects, effect, _CHOICES[effect].index(word))
        self._material = _library.vndf_material()
        checked("material_resolve", byref(description), byref(self._material))
        self._groups = _shape_of_hits(distribution, alpha, alpha_y, rotation, matrix, mean)

    def __reduce__(self) -> Any:
        return _material_of, (self._made,)

    def __repr__(self) -> str:
        default = inspect.signature(Material).parameters
        said = [f"{n}={v!r}" for n, v in self._made.items() if n != "distribution" and v is not default[n].default]
        return f"<vndf.Material of {', '.join([repr(self._made['distribution']), *said])}>"

    def sample(self, wi: Any, u: Any = None, *, rng: Generator = None, size: Size = None) -> Scattered:
        """Directions from wi (3, ...) and uniform numbers u (3, ...) in [0, 1]: two for the normal, one for the lobe; in
        place of u an `rng` draws them, of shape (3, *size)."""
        w, count = components(wi, 3, "wi"), self.wavelengths
        numbers = uniform(u, 3, rng, size, lambda: Batch(**self._groups, wi=w).shape)
        batch, struct = self._open(wi=w, u=numbers)
        result, lobe = batch.result(7 + count), np.empty(batch.shape, np.uint8)
        at = addresses_of(result)
        wo, wm, weights = _library.vndf_normals(*at[:3]), _library.vndf_normals(*at[3:6]), _pointers(at[7:])
        results = _library.vndf_scattered_n(wo, weights, at[6], addresses_of(lobe[None])[0], wm)
        library.bsdf_sample_n(byref(struct), (c_void_p * 3)(*batch.addresses("u")), results)
        return Scattered(result[:3], result[7:], result[6], lobe[()], result[3:6])

    def eval(self, wi: Any, wo: Any, seed: Any = 0) -> Floats:
        """f, without the cosine, shape (wavelengths, ...). `seed`, whole numbers, is for random walks."""
        return self._look("bsdf_eval_n", wi, wo, seed, self.wavelengths, 0)

    def pdf(self, wi: Any, wo: Any) -> Floats:
        """Density per steradian with which :meth:`sample` draws wo, shape (...)."""
        return self._look("bsdf_pdf_n", wi, wo, None, 0, 1)[0]  # type: ignore[no-any-return]

    def eval_pdf(self, wi: Any, wo: Any, seed: Any = 0) -> tuple[Floats, Floats]:
        """Both at once."""
        result = self._look("bsdf_eval_pdf_n", wi, wo, seed, self.wavelengths, 1)
        return result[:-1], result[-1]

    def _open(self, **given: Any) -> tuple[Batch, Any]:
        batch = Batch(**self._groups, **given)
        bits = {"shape": _library.SHARED_ALPHA, "wi": _library.SHARED_WI}
        shared = sum(bit for name, bit in bits.items() if batch.is_shared(name))
        struct = _library.vndf_bsdf_batch(addressof(self._material), batch.count, shared, 0)
        struct.wi_x, struct.wi_y, struct.wi_z = batch.addresses("wi", share=True)
        shape = _CHOICES["shape"][getattr(self._material, "is").effects.shape]
        if shape in ("aligned", "rotated"):
            names = ["alpha_x", "alpha_y", "cos_rotation", "sin_rotation"]
            for name, address in zip(names, batch.addresses("shape", share=True)):
                setattr(struct, name, address)
            return batch, struct
        rows = batch.groups["shape"] if batch.is_shared("shape") else batch.whole("shape")
        rows = rows.reshape(len(rows), -1)
        structs = np.zeros(rows.shape[1], _MIXTURE if shape == "mixture" else _AFFINE)
        if shape == "mixture":
            lobes = _lobes_of(self._made["distribution"], rows)
            structs["count"] = len(lobes)
            for i, (pointer, parts, weight) in enumerate(lobes):
                _put_affine(structs["lobe"][:, i]["surface"], pointer, parts)
                structs["lobe"][:, i]["weight"] = weight
            (struct.mixture,) = batch.keep(structs[None])
        else:
            _put_affine(structs, 0, rows)
            (struct.affine,) = batch.keep(structs[None])
        return batch, struct

    def _look(self, name: str, wi: Any, wo: Any, seed: Any, values: int, pdf: int) -> Floats:
        """What C answers: so many values, and the density after them where that is asked for."""
        given: dict[str, Any] = {"wi": components(wi, 3, "wi"), "wo": components(wo, 3, "wo")}
        if seed is not None:
            given["seed"] = np.asarray(seed, np.uint64)[None]
        batch, struct = self._open(**given)
        result = batch.result(values + pdf)
        at: list[Any] = addresses_of(result)
        seeds = batch.addresses("seed") if seed is not None else []
        to = [*([_pointers(at[:values])] if values else []), *at[values:]]
        getattr(library, name)(byref(struct), _library.vndf_normals(*batch.addresses("wo")), *seeds, *to)
        return result


_AFFINE = np.dtype(_library.vndf_affine)
_MIXTURE = np.dtype(_library.vndf_mixture)


def _material_of(made: dict[str, Any]) -> Material:
    return Material(**made)


def _lobes_of(surface: Union[Mixture, Blend], rows: Floats) -> list[tuple[Any, Any, Any]]:
    """Of each lobe its distribution for all hits or for each, its matrix with its mean slope, and its weight."""
    if isinstance(surface, Mixture):
        count = len(surface.lobes)
        return [(lobe.distribution._pointer, rows[6 * i : 6 * i + 6], rows[6 * count + i])
                for i, lobe in enumerate(surface.lobes)]  # fmt: skip
    parameter, x, y = rows
    index, share = surface.family.places(parameter)
    pointers = np.array([d._pointer for d in surface.family.distributions], np.uintp)
    parts, beyond = (x, 0, 0, y, 0, 0), np.minimum(index + 1, len(pointers) - 1)
    return [(pointers[index], parts, 1 - share), (pointers[beyond], parts, share)]


def _put_affine(structs: Any, distribution: Any, parts: Any) -> None:
    structs["distribution"] = distribution
    for name, values in zip(["xx", "xy", "yx", "yy", "mean_x", "mean_y"], parts):
        structs[name] = values


def _pointers(addresses: list[int]) -> Any:
    return (c_void_p * _library.WAVELENGTHS)(*addresses)


def _fill(member: Any, values: Floats, count: int, name: str) -> None:
    if values.size not in (1, count):
        raise ValueError(f"{name} has {values.size} numbers for {count} wavelengths")
    for i, value in enumerate(np.broadcast_to(values.ravel(), (count,)).tolist()):
        member[i] = value


def _shape_of_hits(distribution: Any, alpha: Any, alpha_y: Any, rotation: Any, matrix: Any, mean: Any) -> dict[str, Floats]:
    """The arrays that hits bring, as one group, in the order of the C struct."""
    if isinstance(distribution, Mixture):
        return {"shape": stacked([*distribution._groups["shape"], *distribution.weights])}
    if isinstance(distribution, Blend):
        return dict(distribution._groups)
    if matrix is not None:
        return {"shape": stretched(matrix, (0.0, 0.0) if mean is None else mean)}
    shape = roughness(alpha, alpha_y)
    if rotation is not None:
        angle = np.asarray(rotation, np.float64)
        shape = stacked([*shape, np.cos(angle), np.sin(angle)])
    return {"shape": shape}
