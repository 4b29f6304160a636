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

from ._drjit import MicrofacetDistribution, law_of
from ._library import constant
from .surface import Family


class _Lobe:
    """One distribution or family, and the textures of its roughness, weight and parameter."""

    def __init__(self, props: Any, suffix: str) -> None:
        self.name = str(props["distribution" + suffix])
        path = str(mi.file_resolver().resolve(self.name))
        both, along, across, weight, parameter = (
            name + suffix for name in ("alpha", "alpha_u", "alpha_v", "weight", "parameter")
        )
        if both in props and (along in props or across in props):
            raise ValueError(f"{both} and {along} or {across}: one or the other")
        if (along in props) != (across in props):
            raise ValueError(f"{along} needs {across}, and the other way round")
        self.alphas = {name: props.get_texture(name, 0.1) for name in ([along, across] if along in props else [both])}
        self.weight = props.get_texture(weight, 1.0)
        self.textures = {**self.alphas, weight: self.weight}
        self.family = Family.load(path) if parameter in props else None
        if self.family:
            self.laws = [law_of(distribution) for distribution in self.family.distributions]
            self.parameter = self.textures[parameter] = props.get_texture(parameter, 1.0)
        else:
            self.laws = [law_of(self.name if self.name in ("ggx", "beckmann") else path)]

    def _shares(self, si: Any, active: Any) -> list[Any]:
        """Of each law; of a family all but two are 0."""
        if self.family is None:
            return [1.0]
        p = dr.clip(self.parameter.eval_1(si, active), *self.family.parameters[[0, -1]].tolist())
        knots, is_reciprocal = self.family.axis
        x, k = -1.0 / p if is_reciprocal else p, knots.tolist()
        up = [1.0, *((x - a) / (b - a) for a, b in zip(k, k[1:]))]
        down = [*((b - x) / (b - a) for a, b in zip(k, k[1:])), 1.0]
        return [dr.maximum(0.0, dr.minimum(u, d)) for u, d in zip(up, down)]

    def at(self, si: Any, active: Any) -> list[Any]:
        """Of a hit each distribution and its weight."""
        alphas = [dr.maximum(texture.eval_1(si, active), 1e-4) for texture in self.alphas.values()]
        weight = dr.maximum(self.weight.eval_1(si, active), 0.0)
        parts = [(MicrofacetDistribution(law, alphas[0], alphas[-1]), weight * share)
                 for law, share in zip(self.laws, self._shares(si, active))]  # fmt: skip
        return parts if dr.is_jit_v(mi.Float) else [part for part in parts if part[1] > 0.0] or parts[:1]


class _Microsurface:
    """The lobes of a surface."""

    def __init__(self, props: Any) -> None:
        numbers = [i for i in range(2, constant("VNDF_MIXTURE_LOBES") + 1) if f"distribution_{i}" in props]
        for i, number in enumerate(numbers):
            if number != i + 2:
                raise ValueError(f"distribution_{number} without distribution_{i + 2}: lobes have no gaps")
        self.lobes = [_Lobe(props, suffix) for suffix in ("", *(f"_{number}" for number in numbers))]
        self.textures = {name: texture for lobe in self.lobes for name, texture in lobe.textures.items()}
        self.rotation = props.get_texture("rotation", 0.0) if "rotation" in props else None
        if self.rotation is not None:
            self.textures["rotation"] = self.rotation
        masking = str(props.get("masking", "height-correlated"))
        if masking not in ("height-correlated", "separable"):
            raise ValueError(f'masking is "height-correlated" or "separable", not "{masking}"')
        self.is_separable = masking == "separable"


class _Hit:
    """The microsurface at one hit. Directions are those of the local frame, with z >= 0."""

    def __init__(self, surface: _Microsurface, si: Any, active: Any) -> None:
        self._separable = surface.is_separable
        parts = [part for lobe in surface.lobes for part in lobe.at(si, active)]
        total = sum(weight for _, weight in parts)
        self._lobes = [(normals, dr.select(total > 0.0, weight / dr.select(total > 0.0, total, 1.0), 0.0))
                       for normals, weight in parts]  # fmt: skip
        self._turn = None if surface.rotation is None else dr.sincos(surface.rotation.eval_1(si, active))

    def turned(self, w: Any, sign: float = 1.0) -> Any:
        """In the frame of the axes of roughness; with sign -1 back from there."""
        if self._turn is None:
            return w
        sine, cosine = sign * self._turn[0], self._turn[1]
        return mi.Vector3f(cosine * w.x + sine * w.y, cosine * w.y - sine * w.x, w.z)

    def seen_from(self, w: Any) -> tuple[list[Any], Any]:
        """Of each lobe its normals, its view and its share of what is drawn; the projected area of all."""
        views = [(normals, normals.view(w), weight) for normals, weight in self._lobes]
        drawn = sum(weight * view.drawn for _, view, weight in views)
        seen = [(normals, view, dr.select(drawn > 0.0, weight * view.drawn / drawn, 0.0))
                for normals, view, weight in views]  # fmt: skip
        return seen, sum(weight * view.area for _, view, weight in views)

    @staticmethod
    def sample(seen: list[Any], u1: Any, u2: Any) -> tuple[Any, Any]:
        """A visible normal, and the density of all lobes together."""
        if len(seen) == 1:
            return seen[0][0].sample_from(seen[0][1], u1, u2)
        before: Any = 0.0
        wm = mi.Vector3f(0.0, 0.0, 1.0)
        for i, (normals, view, share) in enumerate(seen):
            last = i + 1 == len(seen)
            here = (u1 >= before) if last else (u1 >= before) & (u1 < before + share)
            u = dr.clip((u1 - before) / dr.maximum(share, 1e-20), 0.0, 1.0)
            wm = dr.select(here, normals.sample_from(view, u, u2)[0], wm)
            before = before + share
        return wm, _Hit.pdf(seen, wm)

    @staticmethod
    def pdf(seen: list[Any], wm: Any) -> Any:
        return sum(share * normals.pdf_from(view, wm) for normals, view, share in seen)

    def ndf(self, wm: Any) -> Any:
        return sum(weight * normals.eval(wm) for normals, weight in self._lobes)

    def g2(self, area_i: Any, cos_i: Any, area_o: Any, cos_o: Any, reflects: Any) -> Any:
        """Masking and shadowing of directions with these projected areas and cosines, both > 0."""
        one, other = area_i / cos_i, area_o / cos_o  # 1 + Lambda
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
            hit = _Hit(self._surface, si, active)
            wi = hit.turned(si.wi)
            views, area = hit.seen_from(_up(wi))
            wm, density = hit.sample(views, sample2.x, sample2.y)
            wm = dr.mulsign(wm, wi.z)  # on the side of wi
            facing = dr.dot(wi, wm)
            optics = self._optics(ctx, si, facing, active)
            reflects = (sample1 < optics.chance) | (optics.chance >= mi.Float(1.0))
            wo = 2.0 * facing * wm - wi
            if optics.transmitted is not None:
                through = mi.refract(wi, mi.Normal3f(wm), optics.refracted, optics.eta_back)
                wo = dr.select(reflects, wo, through)
            active = active & (reflects | (optics.fresnel < 1.0)) & (dr.select(reflects, wi.z, -wi.z) * wo.z > 0.0)
            bs.wo = hit.turned(mi.Vector3f(wo), -1.0)
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
            g2 = hit.g2(area, abs(wi.z), hit.seen_from(_up(wo))[1], abs(wo.z), reflects)
            common = hit.ndf(_up(wm)) * g2 / abs(wi.z)
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
            hit = _Hit(self._surface, si, active)
            wi, wo = hit.turned(si.wi), hit.turned(wo)
            views, area = hit.seen_from(_up(wi))
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
            return value & active, dr.select(active, hit.pdf(views, _up(wm)) * per_wm, 0.0)

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
