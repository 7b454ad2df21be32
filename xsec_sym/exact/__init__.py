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
from xsec_sym.exact.lambert_sphere import CharacteristicTrial, DispersionTrial, HTrial, PhaseLambertSphere
from xsec_sym.exact.lobes import LobeGGX, ggx_anisotropic
from xsec_sym.exact.normals import NormalsBeckmann, NormalsGGX, NormalsKagiwadaKalaba
from xsec_sym.exact.revolution import SpheroidFacets, SpheroidRadius, SpheroidRate, SpheroidSlope
from xsec_sym.exact.ring import AZIMUTH, RingCrossSection, RingMean, RingSpread, RingTilt, facing

__all__ = [
    "AZIMUTH",
    "CharacteristicTrial",
    "DispersionTrial",
    "HTrial",
    "LobeGGX",
    "NormalsBeckmann",
    "NormalsGGX",
    "NormalsKagiwadaKalaba",
    "PhaseLambertSphere",
    "RingCrossSection",
    "RingMean",
    "RingSpread",
    "RingTilt",
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
