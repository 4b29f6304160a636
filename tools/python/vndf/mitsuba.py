"""BSDFs for Mitsuba 3: a rough conductor and a rough dielectric with any distribution of normals.

    import mitsuba as mi
    mi.set_variant("llvm_ad_rgb")
    import vndf.mitsuba
    vndf.mitsuba.register()                                     # after each mi.set_variant
    mi.load_dict({"type": "vndf_conductor", "distribution": "rings.vndf", "alpha": 0.3, "material": "Au"})

Parameters of both:

distribution    a table file, "ggx" or "beckmann", or a file of a family of tables, which needs `parameter`
parameter       of the family: a number or a texture; every hit is a mixture of two neighbours. LLVM and CUDA variants
                evaluate all tables of the family at each hit
alpha           roughness, a number or a texture (0.1); or alpha_u and alpha_v, along the two tangents; what is below
                1e-4 counts as that
rotation        the angle from the first tangent to the axis of alpha_u, radians, a number or a texture
weight          of this lobe where there are several: a number or a texture (1); below 0 it counts as 0
distribution_2, alpha_2 (alpha_u_2, alpha_v_2), weight_2, and so on up to _8: more lobes of one surface
masking         "height-correlated" (default), or "separable", which Mitsuba's own plugins use: set it to compare with
                them. The default is brighter, by 2.6% at alpha 1

vndf_conductor: material, or eta and k; specular_reflectance: those of Mitsuba's `conductor`, which evaluates Fresnel.
vndf_dielectric: int_ior, ext_ior; specular_reflectance, specular_transmittance.

Samples are weighted with the true D over the density that the table has drawn with, so estimates are exact for a table
of any size. Everything is differentiable with respect to roughness, weights, rotation and optics. Polarised variants
are refused. Tested with Mitsuba 3.9, scalar and LLVM variants; CUDA runs the same code. Scalar variants run Python for
every sample, a hundred times slower than Mitsuba's own plugins, of which `register` warns: take llvm_ad_rgb.
"""
from __future__ import annotations

import math
import warnings
from typing import Any, Union

import drjit as dr
import mitsuba as mi

from ._drjit import Law, Table, law_of
from .distribution import Distribution
from .surface import Family

_MOST_LOBES = 8
_LEAST_ALPHA = 1e-4


class MicrofacetDistribution:
    """What mitsuba.MicrofacetDistribution is, with any distribution: the same methods, names and shapes. Visible normals
    are sampled, so directions wi have wi.z >= 0. `distribution`: a vndf.Distribution, a table file, "ggx" or "beckmann"."""

    def __init__(self, distribution: Union[Distribution, str], alpha_u: Any, alpha_v: Any = None) -> None:
        self._law = law_of(distribution)
        self._alphas = [mi.Float(alpha_u), mi.Float(alpha_u if alpha_v is None else alpha_v)]

    def eval(self, m: Any) -> Any:
        """D(m)."""
        return self._law.ndf(*self._alphas, m)

    def pdf(self, wi: Any, m: Any) -> Any:
        """The density with which `sample` draws m."""
        return self._law.pdf(self._law.view(*self._alphas, wi), m)

    def sample(self, wi: Any, sample: Any) -> tuple[Any, Any]:
        """A visible normal and its density."""
        return self._law.sample(self._law.view(*self._alphas, wi), sample.x, sample.y)

    def smith_g1(self, v: Any, m: Any) -> Any:
        """Smith's masking, 0 where v sees the back of m."""
        up = abs(v.z)
        g1 = up / self._law.view(*self._alphas, mi.Vector3f(v.x, v.y, up)).area
        return dr.select(dr.dot(v, m) * v.z > 0.0, g1, 0.0)

    def G(self, wi: Any, wo: Any, m: Any) -> Any:
        """The product of both ways, which Mitsuba's plugins use."""
        return self.smith_g1(wi, m) * self.smith_g1(wo, m)

    def alpha_u(self) -> Any:
        return self._alphas[0]

    def alpha_v(self) -> Any:
        return self._alphas[1]


class _Tails:
    """A family's tables, and the texture of its parameter."""

    def __init__(self, path: str, parameter: Any) -> None:
        family = Family.load(path)
        self.laws: list[Law] = [Table(distribution) for distribution in family.distributions]
        self.knots, self._reciprocal = family.axis
        self._ends = [float(end) for end in family.parameters[[0, -1]]]
        self._parameter = parameter

    def shares(self, si: Any, active: Any) -> list[Any]:
        """Of each table; all but two are 0."""
        p = dr.clip(self._parameter.eval_1(si, active), *self._ends)
        x, k = -1.0 / p if self._reciprocal else p, self.knots.tolist()
        up = [1.0, *((x - a) / (b - a) for a, b in zip(k, k[1:]))]
        down = [*((b - x) / (b - a) for a, b in zip(k, k[1:])), 1.0]
        return [dr.maximum(0.0, dr.minimum(u, d)) for u, d in zip(up, down)]


class _Lobe:
    """One distribution or family, and the textures of its roughness and weight."""

    def __init__(self, props: Any, suffix: str) -> None:
        name = str(props["distribution" + suffix])
        self.name = name
        path, parameter = str(mi.file_resolver().resolve(name)), "parameter" + suffix
        self.parameter = {parameter: props.get_texture(parameter, 1.0)} if parameter in props else {}
        self.tails = _Tails(path, self.parameter[parameter]) if self.parameter else None
        self.laws = self.tails.laws if self.tails else [law_of(name if name in ("ggx", "beckmann") else path)]
        both, along, across = ("alpha" + suffix, "alpha_u" + suffix, "alpha_v" + suffix)
        if both in props and (along in props or across in props):
            raise ValueError(f"{both} and {along} or {across}: one or the other")
        if (along in props) != (across in props):
            raise ValueError(f"{along} needs {across}, and the other way round")
        self.alphas = {n: props.get_texture(n, 0.1) for n in ([along, across] if along in props else [both])}
        self.weight = {"weight" + suffix: props.get_texture("weight" + suffix, 1.0)}

    def at(self, si: Any, active: Any) -> list[Any]:
        """Of a hit each law, with alpha_u, alpha_v and its weight."""
        alphas = [dr.maximum(texture.eval_1(si, active), _LEAST_ALPHA) for texture in self.alphas.values()]
        weight = dr.maximum(next(iter(self.weight.values())).eval_1(si, active), 0.0)
        shares = self.tails.shares(si, active) if self.tails else [1.0]
        parts = [(law, alphas[0], alphas[-1], weight * share) for law, share in zip(self.laws, shares)]
        return parts if dr.is_jit_v(mi.Float) else [part for part in parts if part[3] > 0.0] or parts[:1]


class _Microsurface:
    """The lobes of a surface."""

    def __init__(self, props: Any) -> None:
        self.lobes = [_Lobe(props, "")]
        for i in range(2, _MOST_LOBES + 1):
            if f"distribution_{i}" not in props:
                continue
            if len(self.lobes) != i - 1:
                raise ValueError(f"distribution_{i} without distribution_{i - 1}: lobes are numbered without a gap")
            self.lobes.append(_Lobe(props, f"_{i}"))
        self.rotation = props.get_texture("rotation", 0.0) if "rotation" in props else None
        masking = str(props.get("masking", "height-correlated"))
        if masking not in ("height-correlated", "separable"):
            raise ValueError(f'masking is "height-correlated" or "separable", not "{masking}"')
        self.is_separable = masking == "separable"

    def textures(self) -> dict[str, Any]:
        named = {} if self.rotation is None else {"rotation": self.rotation}
        for lobe in self.lobes:
            named.update({**lobe.alphas, **lobe.weight, **lobe.parameter})
        return named


class _Hit:
    """The microsurface at one hit. Directions are those of the local frame, with z >= 0."""

    def __init__(self, surface: _Microsurface, si: Any, active: Any) -> None:
        self._separable = surface.is_separable
        parts = [part for lobe in surface.lobes for part in lobe.at(si, active)]
        self._laws, self._shapes = [part[0] for part in parts], [part[1:] for part in parts]
        total = sum(weight for _, _, weight in self._shapes)
        self._weights = [dr.select(total > 0.0, weight / dr.select(total > 0.0, total, 1.0), 0.0)
                         for _, _, weight in self._shapes]  # fmt: skip
        self._turn = None if surface.rotation is None else dr.sincos(surface.rotation.eval_1(si, active))

    def turned(self, w: Any, sign: float = 1.0) -> Any:
        """In the frame of the axes of roughness; with sign -1 back from there."""
        if self._turn is None:
            return w
        sine, cosine = sign * self._turn[0], self._turn[1]
        return mi.Vector3f(cosine * w.x + sine * w.y, cosine * w.y - sine * w.x, w.z)

    def seen_from(self, w: Any) -> tuple[list[Any], Any]:
        """The lobes' views, and the projected area of all."""
        views = [law.view(x, y, w) for law, (x, y, _) in zip(self._laws, self._shapes)]
        return views, sum(weight * view.area for weight, view in zip(self._weights, views))

    def sample(self, views: list[Any], area: Any, u1: Any, u2: Any) -> tuple[Any, Any]:
        """A visible normal, and the density of all lobes together."""
        if len(views) == 1:
            return self._laws[0].sample(views[0], u1, u2)
        before: Any = 0.0
        wm = mi.Vector3f(0.0, 0.0, 1.0)
        for i, (law, view, weight) in enumerate(zip(self._laws, views, self._weights)):
            share = dr.select(area > 0.0, weight * view.area / area, 0.0)
            last = i + 1 == len(views)
            here = (u1 >= before) if last else (u1 >= before) & (u1 < before + share)
            u = dr.clip((u1 - before) / dr.maximum(share, 1e-20), 0.0, 1.0)
            wm = dr.select(here, law.sample(view, u, u2)[0], wm)
            before = before + share
        return wm, self.pdf(views, area, wm)

    def pdf(self, views: list[Any], area: Any, wm: Any) -> Any:
        parts = zip(self._laws, views, self._weights)
        return sum(weight * view.area * law.pdf(view, wm) for law, view, weight in parts) / area

    def ndf(self, wm: Any) -> Any:
        parts = zip(self._laws, self._shapes, self._weights)
        return sum(weight * law.ndf(x, y, wm) for law, (x, y, _), weight in parts)

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


def register() -> None:
    """Registers "vndf_conductor" and "vndf_dielectric" for the variant of Mitsuba that is set."""
    if mi.is_polarized:
        raise ValueError(f"vndf knows no polarisation, which {mi.variant()} has")
    if not dr.is_jit_v(mi.Float):
        warnings.warn(f"{mi.variant()} runs Python for every sample; llvm variants do not", stacklevel=2)

    class Rough(mi.BSDF):
        """What both have in common; `_look` gives value and density."""

        def __init__(self, props: Any) -> None:
            super().__init__(props)
            self._surface = _Microsurface(props)

        def eval(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
            return self._look(ctx, si, wo, active)[0]

        def pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
            return self._look(ctx, si, wo, active)[1]

        def eval_pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> tuple[Any, Any]:
            return self._look(ctx, si, wo, active)

        def traverse(self, callback: Any) -> None:
            for name, texture in self._surface.textures().items():
                callback.put(name, texture, mi.ParamFlags.Differentiable | mi.ParamFlags.Discontinuous)

    class Conductor(Rough):
        def __init__(self, props: Any) -> None:
            super().__init__(props)
            optics: dict[str, Any] = {"type": "conductor"}
            for name in ("eta", "k"):
                if name in props:
                    optics[name] = props.get_unbounded_texture(name)
            if "material" in props:
                optics["material"] = props["material"]
            if "specular_reflectance" in props:
                optics["specular_reflectance"] = props.get_texture("specular_reflectance", 1.0)
            self._optics = mi.load_dict(optics)
            flags = mi.BSDFFlags.GlossyReflection | mi.BSDFFlags.FrontSide | mi.BSDFFlags.Anisotropic
            self.m_components = [flags]
            self.m_flags = flags

        def _fresnel(self, ctx: Any, si: Any, cosine: Any, active: Any) -> Any:
            """By Mitsuba's smooth conductor, which knows materials and spectra."""
            facet = mi.SurfaceInteraction3f(si)
            facet.wi = mi.Vector3f(dr.safe_sqrt(1.0 - cosine * cosine), 0.0, cosine)
            return self._optics.sample(mi.BSDFContext(ctx.mode), facet, 0.0, mi.Point2f(0.0), active)[1]

        def sample(self, ctx: Any, si: Any, sample1: Any, sample2: Any, active: Any = True) -> tuple[Any, Any]:
            bs = dr.zeros(mi.BSDFSample3f)
            active = mi.Bool(active) & (si.wi.z > 0.0) & ctx.is_enabled(mi.BSDFFlags.GlossyReflection)
            hit = _Hit(self._surface, si, active)
            wi = hit.turned(si.wi)
            views, area = hit.seen_from(wi)
            wm, density = hit.sample(views, area, sample2.x, sample2.y)
            facing = dr.dot(wi, wm)
            wo = mi.Vector3f(2.0 * facing * wm - wi)
            bs.wo = hit.turned(wo, -1.0)
            bs.pdf = density / (4.0 * facing)
            bs.eta = 1.0
            bs.sampled_component = mi.UInt32(0)
            bs.sampled_type = mi.UInt32(+mi.BSDFFlags.GlossyReflection)
            active = active & (wo.z > 0.0) & (bs.pdf > 0.0)
            value = self._shape(hit, wi, wo, wm, area) / dr.select(bs.pdf > 0.0, bs.pdf, 1.0)
            weight = self._fresnel(ctx, si, facing, active) * value
            bs.pdf = dr.select(active, bs.pdf, 0.0)
            return bs, weight & active

        def _shape(self, hit: Any, wi: Any, wo: Any, wm: Any, area: Any) -> Any:
            """f cos_o without Fresnel."""
            g2 = hit.g2(area, wi.z, hit.seen_from(wo)[1], wo.z, True)
            return hit.ndf(wm) * g2 / (4.0 * wi.z)

        def _look(self, ctx: Any, si: Any, wo: Any, active: Any) -> tuple[Any, Any]:
            active = mi.Bool(active) & (si.wi.z > 0.0) & (wo.z > 0.0) & ctx.is_enabled(mi.BSDFFlags.GlossyReflection)
            hit = _Hit(self._surface, si, active)
            wi, wo = hit.turned(si.wi), hit.turned(wo)
            views, area = hit.seen_from(wi)
            wm = dr.normalize(wi + wo)
            facing = dr.dot(wi, wm)
            value = self._fresnel(ctx, si, facing, active) * self._shape(hit, wi, wo, wm, area)
            pdf = hit.pdf(views, area, wm) / (4.0 * facing)
            return value & active, dr.select(active, pdf, 0.0)

        def traverse(self, callback: Any) -> None:
            super().traverse(callback)
            self._optics.traverse(callback)  # under Mitsuba's names: eta, k, specular_reflectance

        def to_string(self) -> str:
            return f"vndf_conductor[{', '.join(lobe.name for lobe in self._surface.lobes)}]"

    class Dielectric(Rough):
        def __init__(self, props: Any) -> None:
            super().__init__(props)
            self._eta = mi.lookup_ior(props, "int_ior", "bk7") / mi.lookup_ior(props, "ext_ior", "air")
            if not self._eta > 0.0 or self._eta == 1.0:
                raise ValueError(f"int_ior over ext_ior is {self._eta}; it must be positive, and not 1")
            self._colours = {name: props.get_texture(name, 1.0) if name in props else None
                             for name in ("specular_reflectance", "specular_transmittance")}  # fmt: skip
            sides = mi.BSDFFlags.FrontSide | mi.BSDFFlags.BackSide | mi.BSDFFlags.Anisotropic
            reflection = mi.BSDFFlags.GlossyReflection | sides
            transmission = mi.BSDFFlags.GlossyTransmission | sides | mi.BSDFFlags.NonSymmetric
            self.m_components = [reflection, transmission]
            self.m_flags = reflection | transmission

        def _enabled(self, ctx: Any) -> tuple[bool, bool]:
            return (
                ctx.is_enabled(mi.BSDFFlags.GlossyReflection, 0),
                ctx.is_enabled(mi.BSDFFlags.GlossyTransmission, 1),
            )

        def _colour(self, si: Any, reflects: Any, active: Any) -> Any:
            one = mi.Spectrum(1.0)
            reflectance, transmittance = (one if t is None else t.eval(si, active) for t in self._colours.values())
            return dr.select(reflects, reflectance, transmittance)

        def sample(self, ctx: Any, si: Any, sample1: Any, sample2: Any, active: Any = True) -> tuple[Any, Any]:
            bs = dr.zeros(mi.BSDFSample3f)
            can_reflect, can_transmit = self._enabled(ctx)
            active = mi.Bool(active) & (si.wi.z != 0.0) & (can_reflect or can_transmit)
            hit = _Hit(self._surface, si, active)
            wi = hit.turned(si.wi)
            views, area = hit.seen_from(_up(wi))
            wm, density = hit.sample(views, area, sample2.x, sample2.y)
            wm = dr.mulsign(wm, wi.z)  # on the side of wi
            facing = dr.dot(wi, wm)
            r_i, cos_t, eta, eta_back = mi.fresnel(facing, dr.select(wi.z > 0.0, self._eta, 1.0 / self._eta))
            chance = r_i if can_reflect and can_transmit else mi.Float(1.0 if can_reflect else 0.0)
            reflects = (sample1 < chance) | (chance >= 1.0)
            wo = dr.select(reflects, 2.0 * facing * wm - wi, mi.refract(wi, mi.Normal3f(wm), cos_t, eta_back))
            active = active & (reflects | (r_i < 1.0)) & (dr.select(reflects, wi.z, -wi.z) * wo.z > 0.0)
            bs.wo = hit.turned(mi.Vector3f(wo), -1.0)
            bs.eta = dr.select(reflects, 1.0, eta)
            bs.sampled_component = dr.select(reflects, mi.UInt32(0), mi.UInt32(1))
            bs.sampled_type = dr.select(
                reflects, mi.UInt32(+mi.BSDFFlags.GlossyReflection), mi.UInt32(+mi.BSDFFlags.GlossyTransmission)
            )
            value, per_wm = self._shape(ctx, hit, wi, wo, wm, r_i, eta, area, reflects)
            bs.pdf = density * dr.select(reflects, chance, 1.0 - chance) * per_wm
            active = active & (bs.pdf > 0.0)
            weight = self._colour(si, reflects, active) * (value / dr.select(active, bs.pdf, 1.0))
            bs.pdf = dr.select(active, bs.pdf, 0.0)
            return bs, weight & active

        def _shape(self, ctx: Any, hit: Any, wi: Any, wo: Any, wm: Any, r_i: Any, eta: Any, area: Any,
                   reflects: Any) -> tuple[Any, Any]:  # fmt: skip
            """f |cos_o| without colours, and the density of wo per density of wm. `eta`: beyond over before."""
            facing, leaving = dr.dot(wi, wm), dr.dot(wo, wm)
            g2 = hit.g2(area, abs(wi.z), hit.seen_from(_up(wo))[1], abs(wo.z), reflects)
            common = hit.ndf(_up(wm)) * g2 / abs(wi.z)
            under = facing + eta * leaving
            bend = eta * eta * abs(leaving) / (under * under)
            scale = 1.0 / (eta * eta) if ctx.mode == mi.TransportMode.Radiance else 1.0
            value = dr.select(reflects, 0.25 * r_i, (1.0 - r_i) * facing * bend * scale) * common
            return value, dr.select(reflects, 0.25 / abs(leaving), bend)

        def _look(self, ctx: Any, si: Any, wo: Any, active: Any) -> tuple[Any, Any]:
            can_reflect, can_transmit = self._enabled(ctx)
            reflects = si.wi.z * wo.z > 0.0
            active = mi.Bool(active) & (si.wi.z * wo.z != 0.0)
            active = active & dr.select(reflects, mi.Bool(can_reflect), mi.Bool(can_transmit))
            hit = _Hit(self._surface, si, active)
            wi, wo = hit.turned(si.wi), hit.turned(wo)
            views, area = hit.seen_from(_up(wi))
            eta = dr.select(wi.z > 0.0, self._eta, 1.0 / self._eta)
            wm = dr.fma(wo, dr.select(reflects, 1.0, eta), wi)
            # As in C, a facet whose z the rounding of wo exceeds faces wi and has that z.
            rounding = (1.0 + eta) * 1.2e-7
            lost = (wi.z * wo.z < 0.0) & (abs(wm.z) < rounding)
            wm.z = dr.select(lost, dr.mulsign(rounding, wi.z * dr.dot(wi, wm)), wm.z)
            wm = dr.mulsign(dr.normalize(wm), wi.z * wm.z)  # on the side of wi
            facing = dr.dot(wi, wm)
            active = active & (facing > 0.0) & (dr.select(reflects, 1.0, -1.0) * dr.dot(wo, wm) > 0.0)
            r_i = mi.fresnel(facing, eta)[0]
            chance = r_i if can_reflect and can_transmit else 1.0
            value, per_wm = self._shape(ctx, hit, wi, wo, wm, r_i, eta, area, reflects)
            chance = dr.select(reflects, chance, 1.0 - r_i if can_reflect and can_transmit else 1.0)
            pdf = hit.pdf(views, area, _up(wm)) * chance * per_wm
            return (self._colour(si, reflects, active) * value) & active, dr.select(active, pdf, 0.0)

        def traverse(self, callback: Any) -> None:
            super().traverse(callback)
            for name, texture in self._colours.items():
                if texture is not None:
                    callback.put(name, texture, +mi.ParamFlags.Differentiable)

        def to_string(self) -> str:
            return f"vndf_dielectric[{', '.join(lobe.name for lobe in self._surface.lobes)}, eta = {self._eta}]"

    mi.register_bsdf("vndf_conductor", Conductor)
    mi.register_bsdf("vndf_dielectric", Dielectric)
