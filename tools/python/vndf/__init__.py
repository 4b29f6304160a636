"""Visible normals of any microfacet distribution, for numpy.

    import numpy as np, vndf

    metal = vndf.build(vndf.Source.slope("exp(-3*r)*(1+0.8*cos(6*r))"))     # or vndf.load("rings.vndf"), vndf.ggx()
    surface = vndf.Surface(metal, alpha=0.3, alpha_y=0.1)
    u = np.random.default_rng(1).random((2, 1000000), dtype=np.float32)
    wm, pdf, weight = surface.sample_weight((0.6, 0.0, 0.8), u)             # shapes (3, n), (n,), (n,)

Components come first: directions have shape (3, ...). The C headers are the manual of every call.
"""
from ._library import VERSION as __version__
from ._library import Error, Status
from .bsdf import LOBE_NONE, LOBE_REFLECTION, LOBE_STRAIGHT, LOBE_TRANSMISSION, Albedo, Material, Scattered
from .build import Source, build, certify, family_help, materials
from .distribution import Certificate, Distribution, Info, beckmann, from_bytes, ggx, load
from .surface import Blend, Family, FamilyInfo, Mixture, MixtureSample, Sample, Surface, WeightedSample

__all__ = [
    "Albedo", "Blend", "Certificate", "Distribution", "Error", "Family", "FamilyInfo", "Info", "LOBE_NONE",
    "LOBE_REFLECTION", "LOBE_STRAIGHT", "LOBE_TRANSMISSION", "Material", "Mixture", "MixtureSample", "Sample", "Scattered",
    "Source", "Status", "Surface", "WeightedSample", "__version__", "beckmann", "build", "certify", "family_help",
    "from_bytes", "ggx", "load", "materials",
]  # fmt: skip
