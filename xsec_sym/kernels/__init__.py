"""Importable NumPy kernels: the quantities of the papers as functions of arrays, without SymPy or mpmath."""

from xsec_sym.kernels.beckmann import lambda_beckmann, ndf_beckmann, sigma_beckmann
from xsec_sym.kernels.dirac_ring import sigma_dirac_ring
from xsec_sym.kernels.ellipsoidal import ndf_ellipsoidal, sigma_ellipsoidal
from xsec_sym.kernels.ggx import lambda_ggx, ndf_ggx, sigma_ggx
from xsec_sym.kernels.isotropic import brdf_isotropic, h_isotropic
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
from xsec_sym.kernels.table1 import sigma_inv1m, sigma_inv1m2, sigma_inv1p, sigma_inv1pu2

__all__ = [
    "CrossSection",
    "FixedSphericalGaussian",
    "brdf_isotropic",
    "cross_section",
    "h_isotropic",
    "lambda_beckmann",
    "lambda_ggx",
    "log_sigma_spherical_gaussian",
    "ndf_beckmann",
    "ndf_ellipsoidal",
    "ndf_ggx",
    "ndf_spherical_gaussian",
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
    "smith_g1",
    "smith_g2",
    "smith_g2_given_g1",
    "specialize_spherical_gaussian",
    "ssl",
]
