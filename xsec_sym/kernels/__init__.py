"""Importable NumPy kernels: the quantities of the papers as functions of arrays, without SymPy or mpmath.

>>> from xsec_sym import kernels
>>> kernels.sigma_ggx([-1, 0, 1], 0.3)
array([0.  , 0.15, 1.  ])
"""

from xsec_sym.kernels.beckmann import lambda_beckmann, ndf_beckmann, sigma_beckmann
from xsec_sym.kernels.dirac_ring import sigma_dirac_ring
from xsec_sym.kernels.ellipsoidal import ndf_ellipsoidal, sigma_ellipsoidal
from xsec_sym.kernels.ggx import lambda_ggx, ndf_ggx, sigma_ggx
from xsec_sym.kernels.h_lambert_sphere import h_lambert_sphere
from xsec_sym.kernels.half_space import HalfSpace
from xsec_sym.kernels.isotropic import brdf_isotropic, h_isotropic
from xsec_sym.kernels.lambert_sphere import (
    albedo_lambert_sphere,
    albedo_lambert_sphere_inverse,
    brdf_lambert_sphere,
    lambert_sphere_coefficients,
    phase_lambert_sphere,
    sample_lambert_sphere,
)
from xsec_sym.kernels.lambert_sphere_fits import (
    albedo_lambert_sphere_fit,
    albedo_lambert_sphere_inverse_fit,
    brdf_lambert_sphere_fast,
    brdf_lambert_sphere_fit,
    h_lambert_sphere_fit,
)
from xsec_sym.kernels.lambert_sphere_models import (
    brdf_lambert_sphere_fast_paper,
    brdf_lambert_sphere_hapke,
    brdf_lambert_sphere_paper,
    brdf_lambert_sphere_printed,
)
from xsec_sym.kernels.lobes import sel, ssl
from xsec_sym.kernels.power import sigma_power
from xsec_sym.kernels.ring_lemma import CrossSection, cross_section
from xsec_sym.kernels.smith import smith_g1, smith_g2, smith_g2_given_g1
from xsec_sym.kernels.spherical_gaussian import (
    log_sigma_spherical_gaussian,
    ndf_spherical_gaussian,
    scaled_sigma_spherical_gaussian,
    sigma_spherical_gaussian,
)
from xsec_sym.kernels.spherical_gaussian_fixed import FixedSphericalGaussian, specialize_spherical_gaussian
from xsec_sym.kernels.spherical_gaussian_slopes import sigma_spherical_gaussian_dalpha, sigma_spherical_gaussian_du
from xsec_sym.kernels.table1 import sigma_inv1m, sigma_inv1m2, sigma_inv1p, sigma_inv1pu2
from xsec_sym.kernels.visible_normals import (
    sample_visible_ggx,
    sample_visible_spherical_gaussian,
    visible_ggx,
    visible_spherical_gaussian,
)

__all__ = [
    "CrossSection",
    "FixedSphericalGaussian",
    "HalfSpace",
    "albedo_lambert_sphere",
    "albedo_lambert_sphere_fit",
    "albedo_lambert_sphere_inverse",
    "albedo_lambert_sphere_inverse_fit",
    "brdf_isotropic",
    "brdf_lambert_sphere",
    "brdf_lambert_sphere_fast",
    "brdf_lambert_sphere_fast_paper",
    "brdf_lambert_sphere_fit",
    "brdf_lambert_sphere_hapke",
    "brdf_lambert_sphere_paper",
    "brdf_lambert_sphere_printed",
    "cross_section",
    "h_isotropic",
    "h_lambert_sphere",
    "h_lambert_sphere_fit",
    "lambda_beckmann",
    "lambda_ggx",
    "lambert_sphere_coefficients",
    "log_sigma_spherical_gaussian",
    "ndf_beckmann",
    "ndf_ellipsoidal",
    "ndf_ggx",
    "ndf_spherical_gaussian",
    "phase_lambert_sphere",
    "sample_lambert_sphere",
    "sample_visible_ggx",
    "sample_visible_spherical_gaussian",
    "scaled_sigma_spherical_gaussian",
    "sel",
    "sigma_beckmann",
    "sigma_dirac_ring",
    "sigma_ellipsoidal",
    "sigma_ggx",
    "sigma_inv1m",
    "sigma_inv1m2",
    "sigma_inv1p",
    "sigma_inv1pu2",
    "sigma_power",
    "sigma_spherical_gaussian",
    "sigma_spherical_gaussian_dalpha",
    "sigma_spherical_gaussian_du",
    "smith_g1",
    "smith_g2",
    "smith_g2_given_g1",
    "specialize_spherical_gaussian",
    "ssl",
    "visible_ggx",
    "visible_spherical_gaussian",
]
