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
from xsec_sym.exact.h_lambert_sphere import DispersionLambertSphere, HLambertTransform
from xsec_sym.exact.half_space import HIsotropic, HMoment, HTransform, wiener_hopf
from xsec_sym.exact.lambert_sphere import CharacteristicTrial, DispersionTrial, HTrial, PhaseLambertSphere
from xsec_sym.exact.lobes import LobeGGX, ggx_anisotropic
from xsec_sym.exact.normals import NormalsBeckmann, NormalsGGX, NormalsKagiwadaKalaba
from xsec_sym.exact.revolution import SpheroidFacets, SpheroidRadius, SpheroidRate, SpheroidSlope
from xsec_sym.exact.ring import AZIMUTH, RingCrossSection, RingMean, RingSpread, RingTilt, facing
from xsec_sym.exact.smith import BelowExponential, BelowGaussian, BelowLogistic, BelowUniform, ahead, behind
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
    "BelowExponential",
    "BelowGaussian",
    "BelowLogistic",
    "BelowUniform",
    "CharacteristicTrial",
    "DispersionLambertSphere",
    "DispersionTrial",
    "HIsotropic",
    "HLambertSphere",
    "HLambertTransform",
    "HMoment",
    "HTransform",
    "HTrial",
    "LobeGGX",
    "ModeConstant",
    "ModeLambertSphere",
    "NormalsBeckmann",
    "NormalsGGX",
    "NormalsKagiwadaKalaba",
    "ParticleAlbedo",
    "PhaseLambertSphere",
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
    "ahead",
    "beckmann",
    "behind",
    "ellipsoidal",
    "facing",
    "ggx",
    "ggx_anisotropic",
    "spherical_gaussian",
    "wiener_hopf",
]
