"""Visible normals of any microfacet distribution, for numpy: tools/python/README.md. Components come first: directions
have shape (3, ...). The C headers are the manual of every call."""
from ._library import VERSION as __version__
from ._library import Error, Status
from .bsdf import LOBE_NONE, LOBE_REFLECTION, LOBE_STRAIGHT, LOBE_TRANSMISSION, Material, Scattered
from .build import Source, build, family_help, materials
from .distribution import Certificate, Distribution, Info, beckmann, from_bytes, ggx, load
from .surface import Family, FamilyInfo, Mixture, MixtureSample, Sample, Surface, WeightedSample

__all__ = [
    "Certificate", "Distribution", "Error", "Family", "FamilyInfo", "Info", "LOBE_NONE", "LOBE_REFLECTION",
    "LOBE_STRAIGHT", "LOBE_TRANSMISSION", "Material", "Mixture", "MixtureSample", "Sample", "Scattered", "Source",
    "Status", "Surface", "WeightedSample", "__version__", "beckmann", "build", "family_help", "from_bytes", "ggx",
    "load", "materials",
]  # fmt: skip
