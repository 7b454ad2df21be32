"""The exact definitions that claims talk about, unevaluated, each with its LaTeX form."""

from xsec_sym.exact.distributions import (
    SigmaBeckmann,
    SigmaEllipsoidal,
    SigmaGGX,
    SigmaSphericalGaussian,
    SpreadBeckmann,
    SpreadEllipsoidal,
    SpreadGGX,
    SpreadSphericalGaussian,
    beckmann,
    ellipsoidal,
    ggx,
    spherical_gaussian,
)
from xsec_sym.exact.lobes import LobeGGX, ggx_anisotropic
from xsec_sym.exact.normals import NormalsBeckmann, NormalsGGX, NormalsKagiwadaKalaba
from xsec_sym.exact.revolution import SpheroidFacets, SpheroidRadius, SpheroidRate, SpheroidSlope
from xsec_sym.exact.ring import AZIMUTH, RingCrossSection, RingMean, RingSpread, RingTilt, facing
from xsec_sym.exact.solved import (
    AlbedoLambertSphere,
    HLambertSphere,
    ModeConstant,
    ModeLambertSphere,
    ParticleAlbedo,
    SampledCosine,
)

__all__ = [
    "AZIMUTH",
    "AlbedoLambertSphere",
    "HLambertSphere",
    "LobeGGX",
    "ModeConstant",
    "ModeLambertSphere",
    "NormalsBeckmann",
    "NormalsGGX",
    "NormalsKagiwadaKalaba",
    "ParticleAlbedo",
    "RingCrossSection",
    "RingMean",
    "RingSpread",
    "RingTilt",
    "SampledCosine",
    "SigmaBeckmann",
    "SigmaEllipsoidal",
    "SigmaGGX",
    "SigmaSphericalGaussian",
    "SpheroidFacets",
    "SpheroidRadius",
    "SpheroidRate",
    "SpheroidSlope",
    "SpreadBeckmann",
    "SpreadEllipsoidal",
    "SpreadGGX",
    "SpreadSphericalGaussian",
    "beckmann",
    "ellipsoidal",
    "facing",
    "ggx",
    "ggx_anisotropic",
    "spherical_gaussian",
]
