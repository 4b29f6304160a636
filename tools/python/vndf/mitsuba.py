"""BSDFs for Mitsuba 3: a rough conductor and a rough dielectric with any distribution of normals.

    import mitsuba as mi
    mi.set_variant("llvm_ad_rgb")
    import vndf.mitsuba
    vndf.mitsuba.register()                                     # after each mi.set_variant
    mi.load_dict({"type": "vndf_conductor", "distribution": "rings.vndf", "alpha": 0.3, "material": "Au"})

Parameters of both; those with a number (the default is in parentheses) take a texture as well:

distribution    a table file, "ggx" or "beckmann", or a file of a family of tables, which needs `parameter`
parameter       number; every hit is a mixture of two neighbours. LLVM and CUDA variants evaluate all tables at each hit
alpha           number (0.1), at least 1e-4: roughness; or alpha_u and alpha_v, along the two tangents
rotation        number (0): the angle from the first tangent to the axis of alpha_u, radians
weight          number (1), at least 0: of this lobe where there are several
distribution_2, alpha_2 (alpha_u_2, alpha_v_2), weight_2, and so on up to _8: more lobes of one surface
masking         "height-correlated" (default), or "separable", which Mitsuba's own plugins use: set it to compare with
                them. The default is brighter, by 2.6% at alpha 1

vndf_conductor: material, or eta and k; specular_reflectance: those of Mitsuba's `conductor`, which evaluates Fresnel.
vndf_dielectric: int_ior, ext_ior; specular_reflectance, specular_transmittance.

Samples are weighted with the true D over the density that the table has drawn with, so estimates are exact for a table
of any size, and differentiable in roughness, weights, rotation and optics. Polarised variants are refused. Scalar
variants run Python for every sample, a hundred times slower than Mitsuba's own plugins: take llvm_ad_rgb.
"""
from __future__ import annotations

import functools
import math
import operator
import warnings
from typing import Any, NamedTuple

import drjit as dr
import mitsuba as mi

from ._drjit import MicrofacetDistribution, Microfacets, law_of  # noqa: F401
from ._library import constant
from .surface import Family


class _Lobe:
    """One distribution or family, and the textures of its roughness, weight and parameter, which `textures` gets."""

    def __init__(self, props: Any, suffix: str, textures: dict[str, Any]) -> None:
        def texture(name: str, otherwise: float) -> Any:
            return textures.setdefault(name + suffix, props.get_texture(name + suffix, otherwise))

        self.name = str(props["distribution" + suffix])
        path = str(mi.file_resolver().resolve(self.name))
        both, along, across = (name + suffix for name in ("alpha", "alpha_u", "alpha_v"))
        if both in props and (along in props or across in props):
            raise ValueError(f"{both} and {along} or {across}: one or the other")
        if (along in props) != (across in props):
            raise ValueError(f"{along} needs {across}, and the other way round")
        self.alphas = [texture(name, 0.1) for name in (("alpha_u", "alpha_v") if along in props else ("alpha",))]
        self.weight = texture("weight", 1.0)
        self.family = Family.load(path) if "parameter" + suffix in props else None
        if self.family:
            self.laws = [law_of(distribution) for distribution in self.family.distributions]
            self.parameter = texture("parameter", 1.0)
        else:
            self.laws = [law_of(self.name if self.name in ("ggx", "beckmann") else path)]

    def _shares(self, si: Any, active: Any) -> list[Any]:
        """Of each law; of a family all but two are 0."""
        if self.family is None:
            return [1.0]
        k = self.family.parameters.tolist()
        x = dr.clip(self.parameter.eval_1(si, active), k[0], k[-1])
        if self.family.info.reciprocal:  # neighbours are linear in 1/parameter
            x, k = -1.0 / x, [-1.0 / knot for knot in k]
        up = [1.0, *((x - a) / (b - a) for a, b in zip(k, k[1:]))]
        down = [*((b - x) / (b - a) for a, b in zip(k, k[1:])), 1.0]
        return [dr.maximum(0.0, dr.minimum(u, d)) for u, d in zip(up, down)]

    def at(self, si: Any, active: Any) -> list[Any]:
        """Of a hit each law, its roughness and its weight."""
        alphas = [dr.maximum(texture.eval_1(si, active), 1e-4) for texture in self.alphas]
        weight = dr.maximum(self.weight.eval_1(si, active), 0.0)
        parts = [(law, alphas[0], alphas[-1], weight * share) for law, share in zip(self.laws, self._shares(si, active))]
        return parts if dr.is_jit_v(mi.Float) else [part for part in parts if part[3] > 0.0] or parts[:1]


class _Microsurface:
    """The lobes of a surface."""

    def __init__(self, props: Any) -> None:
        numbers = [i for i in range(2, constant("VNDF_MIXTURE_LOBES") + 1) if f"distribution_{i}" in props]
        for i, number in enumerate(numbers):
            if number != i + 2:
                raise ValueError(f"distribution_{number} without distribution_{i + 2}: lobes have no gaps")
        self.textures: dict[str, Any] = {}
        self.lobes = [_Lobe(props, suffix, self.textures) for suffix in ("", *(f"_{number}" for number in numbers))]
        if "rotation" in props:
            self.textures["rotation"] = props.get_texture("rotation", 0.0)
        masking = str(props.get("masking", "height-correlated"))
        if masking not in ("height-correlated", "separable"):
            raise ValueError(f'masking is "height-correlated" or "separable", not "{masking}"')
        self._separable = masking == "separable"

    def at(self, si: Any, active: Any) -> Microfacets:
        """Its normals at a hit, for directions of the local frame with z >= 0."""
        parts = [part for lobe in self.lobes for part in lobe.at(si, active)]
        total = sum(weight for *_, weight in parts)
        rotation = self.textures.get("rotation")
        return Microfacets(
            [(*lobe, dr.select(total > 0.0, weight / dr.select(total > 0.0, total, 1.0), 0.0)) for *lobe, weight in parts],
            None if rotation is None else dr.sincos(rotation.eval_1(si, active)),
        )  # fmt: skip

    def g2(self, one: Any, other: Any, reflects: Any) -> Any:
        """Masking and shadowing of two directions, by their 1 + Lambda."""
        if self._separable:
            return 1.0 / (one * other)
        reflected = 1.0 / (one + other - 1.0)
        return reflected if reflects is True else dr.select(reflects, reflected, _beta(one, other))


def _beta(a: Any, b: Any) -> Any:
    """The Beta function, a and b >= 1."""
    if not dr.is_jit_v(mi.Float):
        return math.exp(math.lgamma(a) + math.lgamma(b) - math.lgamma(a + b))
    return dr.exp(dr.lgamma(a) + dr.lgamma(b) - dr.lgamma(a + b))


def _up(w: Any) -> Any:
    """w, turned to the upper side through the origin."""
    return dr.mulsign(w, w.z)


class _Optics(NamedTuple):
    """What a facet does with the light of one cosine."""

    reflected: Any  # a spectrum
    transmitted: Any = None  # another; None: nothing
    chance: Any = 1.0  # of a sample to be reflected
    fresnel: Any = 0.0  # its reflectance without colours
    refracted: Any = 0.0  # the other cosine
    eta: Any = 1.0  # index beyond over that before
    eta_back: Any = 1.0


def register() -> None:
    """Registers "vndf_conductor" and "vndf_dielectric" for the variant of Mitsuba that is set."""
    if mi.is_polarized:
        raise ValueError(f"vndf knows no polarisation, which {mi.variant()} has")
    if not dr.is_jit_v(mi.Float):
        warnings.warn(f"{mi.variant()} runs Python for every sample; llvm variants do not", stacklevel=2)

    class Rough(mi.BSDF):
        """One event at a facet. Subclasses say which lobes there are, and what facets do with the light."""

        def __init__(self, props: Any, *flags: Any) -> None:
            super().__init__(props)
            self._surface = _Microsurface(props)
            self.m_components = [flag | mi.BSDFFlags.Anisotropic for flag in flags]
            self.m_flags = functools.reduce(operator.or_, self.m_components)

        def _lobes(self, ctx: Any) -> list[bool]:
            """Whether reflection and transmission are there and asked for."""
            lobes = (mi.BSDFFlags.GlossyReflection, mi.BSDFFlags.GlossyTransmission)
            return [i < len(self.m_components) and ctx.is_enabled(lobe, i) for i, lobe in enumerate(lobes)]

        def _optics(self, ctx: Any, si: Any, facing: Any, active: Any) -> _Optics:
            raise NotImplementedError

        def _eta_from(self, wi: Any) -> Any:
            """The index on the side of -wi over that on the side of wi."""
            return mi.Float(1.0)

        def _seen(self, si: Any) -> Any:
            """Whether there is anything from the side of wi."""
            return si.wi.z != 0.0 if len(self.m_components) == 2 else si.wi.z > 0.0

        def sample(self, ctx: Any, si: Any, sample1: Any, sample2: Any, active: Any = True) -> tuple[Any, Any]:
            bs = dr.zeros(mi.BSDFSample3f)
            active = mi.Bool(active) & self._seen(si) & any(self._lobes(ctx))
            hit, wi = self._surface.at(si, active), si.wi
            views, area = hit.view(_up(wi))
            wm, density = hit.sample_from(views, sample2.x, sample2.y)
            wm = dr.mulsign(wm, wi.z)  # on the side of wi
            facing = dr.dot(wi, wm)
            optics = self._optics(ctx, si, facing, active)
            reflects = (sample1 < optics.chance) | (optics.chance >= mi.Float(1.0))
            wo = 2.0 * facing * wm - wi
            if optics.transmitted is not None:
                through = mi.refract(wi, mi.Normal3f(wm), optics.refracted, optics.eta_back)
                wo = dr.select(reflects, wo, through)
            active = active & (reflects | (optics.fresnel < 1.0)) & (dr.select(reflects, wi.z, -wi.z) * wo.z > 0.0)
            bs.wo = mi.Vector3f(wo)
            bs.eta = dr.select(reflects, 1.0, optics.eta)
            bs.sampled_component = dr.select(reflects, mi.UInt32(0), mi.UInt32(1))
            kinds = (mi.UInt32(+flag) for flag in (mi.BSDFFlags.GlossyReflection, mi.BSDFFlags.GlossyTransmission))
            bs.sampled_type = dr.select(reflects, *kinds)
            value, per_wm = self._shape(ctx, hit, wi, wo, wm, optics, area, reflects)
            pdf = density * per_wm
            active = active & (pdf > 0.0)
            bs.pdf = dr.select(active, pdf, 0.0)
            return bs, (value / dr.select(active, pdf, 1.0)) & active

        def _shape(self, ctx: Any, hit: Any, wi: Any, wo: Any, wm: Any, optics: _Optics, area: Any,
                   reflects: Any) -> tuple[Any, Any]:  # fmt: skip
            """f |cos_o|, and the density of wo per density of wm."""
            facing, leaving, eta = dr.dot(wi, wm), dr.dot(wo, wm), optics.eta
            g2 = self._surface.g2(area / abs(wi.z), hit.view(_up(wo))[1] / abs(wo.z), reflects)
            common = hit.eval(_up(wm)) * g2 / abs(wi.z)
            value, per_wm = optics.reflected * 0.25 * common, optics.chance * (0.25 / abs(leaving))
            if optics.transmitted is None:
                return value, per_wm
            under = facing + eta * leaving
            bend = eta * eta * abs(leaving) / (under * under)
            scale = 1.0 / (eta * eta) if ctx.mode == mi.TransportMode.Radiance else 1.0
            value = dr.select(reflects, value, optics.transmitted * (facing * bend * scale * common))
            return value, dr.select(reflects, per_wm, (1.0 - optics.chance) * bend)

        def eval_pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> tuple[Any, Any]:
            reflects = si.wi.z * wo.z > 0.0
            can_reflect, can_transmit = self._lobes(ctx)
            active = mi.Bool(active) & self._seen(si) & (wo.z != 0.0)
            active = active & dr.select(reflects, mi.Bool(can_reflect), mi.Bool(can_transmit))
            hit, wi = self._surface.at(si, active), si.wi
            views, area = hit.view(_up(wi))
            eta = self._eta_from(wi)
            wm = dr.fma(wo, dr.select(reflects, 1.0, eta), wi)
            # As in C, a facet whose z the rounding of wo exceeds faces wi and has that z.
            rounding = (1.0 + eta) * 1.2e-7
            lost = (wi.z * wo.z < 0.0) & (abs(wm.z) < rounding)
            wm.z = dr.select(lost, dr.mulsign(rounding, wi.z * dr.dot(wi, wm)), wm.z)
            wm = dr.mulsign(dr.normalize(wm), wi.z * wm.z)  # on the side of wi
            facing = dr.dot(wi, wm)
            active = active & (facing > 0.0) & (dr.select(reflects, 1.0, -1.0) * dr.dot(wo, wm) > 0.0)
            value, per_wm = self._shape(ctx, hit, wi, wo, wm, self._optics(ctx, si, facing, active), area, reflects)
            return value & active, dr.select(active, hit.pdf_from(views, _up(wm)) * per_wm, 0.0)

        def eval(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
            return self.eval_pdf(ctx, si, wo, active)[0]

        def pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
            return self.eval_pdf(ctx, si, wo, active)[1]

        def traverse(self, callback: Any) -> None:
            for name, texture in self._surface.textures.items():
                callback.put(name, texture, mi.ParamFlags.Differentiable | mi.ParamFlags.Discontinuous)

        def to_string(self) -> str:
            return f"{type(self).__name__}[{', '.join(lobe.name for lobe in self._surface.lobes)}]"

    class vndf_conductor(Rough):
        def __init__(self, props: Any) -> None:
            super().__init__(props, mi.BSDFFlags.GlossyReflection | mi.BSDFFlags.FrontSide)
            optics: dict[str, Any] = {"type": "conductor"}
            optics.update({name: props.get_unbounded_texture(name) for name in ("eta", "k") if name in props})
            optics.update({name: props[name] for name in ("material",) if name in props})
            if "specular_reflectance" in props:
                optics["specular_reflectance"] = props.get_texture("specular_reflectance", 1.0)
            self._smooth = mi.load_dict(optics)

        def _optics(self, ctx: Any, si: Any, facing: Any, active: Any) -> _Optics:
            """By Mitsuba's smooth conductor, which knows materials and spectra."""
            facet = mi.SurfaceInteraction3f(si)
            facet.wi = mi.Vector3f(dr.safe_sqrt(1.0 - facing * facing), 0.0, facing)
            return _Optics(self._smooth.sample(mi.BSDFContext(ctx.mode), facet, 0.0, mi.Point2f(0.0), active)[1])

        def traverse(self, callback: Any) -> None:
            super().traverse(callback)
            self._smooth.traverse(callback)  # under Mitsuba's names: eta, k, specular_reflectance

    class vndf_dielectric(Rough):
        def __init__(self, props: Any) -> None:
            sides = mi.BSDFFlags.FrontSide | mi.BSDFFlags.BackSide
            through = mi.BSDFFlags.GlossyTransmission | mi.BSDFFlags.NonSymmetric
            super().__init__(props, mi.BSDFFlags.GlossyReflection | sides, through | sides)
            self._eta = mi.lookup_ior(props, "int_ior", "bk7") / mi.lookup_ior(props, "ext_ior", "air")
            if not self._eta > 0.0 or self._eta == 1.0:
                raise ValueError(f"int_ior over ext_ior is {self._eta}; it must be positive, and not 1")
            names = ("specular_reflectance", "specular_transmittance")
            self._colours = {name: props.get_texture(name, 1.0) for name in names}

        def _eta_from(self, wi: Any) -> Any:
            return dr.select(wi.z > 0.0, self._eta, 1.0 / self._eta)

        def _optics(self, ctx: Any, si: Any, facing: Any, active: Any) -> _Optics:
            fresnel, refracted, eta, eta_back = mi.fresnel(facing, self._eta_from(si.wi))
            reflected, transmitted = (texture.eval(si, active) for texture in self._colours.values())
            lobes = self._lobes(ctx)
            chance = fresnel if all(lobes) else mi.Float(1.0 if lobes[0] else 0.0)
            parts = reflected * fresnel, transmitted * (1.0 - fresnel)
            return _Optics(*parts, chance, fresnel, refracted, eta, eta_back)

        def traverse(self, callback: Any) -> None:
            super().traverse(callback)
            for name, texture in self._colours.items():
                callback.put(name, texture, +mi.ParamFlags.Differentiable)

    for kind in (vndf_conductor, vndf_dielectric):
        mi.register_bsdf(kind.__name__, kind)
