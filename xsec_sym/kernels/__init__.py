"""Importable NumPy kernels: the quantities of the papers as functions of arrays, without SymPy or mpmath.

>>> from xsec_sym import kernels
>>> kernels.sigma_ggx([-1, 0, 1], 0.3)
array([0.  , 0.15, 1.  ])

Arguments broadcast, float32 in gives float32 out, and what is out of the domain is NaN. `help(kernels.sigma_ggx)` tells
the domain, the normalisation, the error and an example of one; `kernels.compiled` has the spherical Gaussian as loops
of Numba.

Cross-sections of distributions of normals, seen from the direction of cosine u:
    sigma_beckmann(u, alpha): Beckmann's
    sigma_ggx(u, alpha): GGX
    sigma_ellipsoidal(u, b): the ellipsoidal one
    sigma_spherical_gaussian(u, alpha): the spherical Gaussian
    log_sigma_spherical_gaussian(u, alpha): its logarithm, finite where it underflows
    scaled_sigma_spherical_gaussian(u, alpha): it without its exponential factor
    sigma_spherical_gaussian_du(u, alpha): its derivative by u
    sigma_spherical_gaussian_dalpha(u, alpha): its derivative by alpha
    specialize_spherical_gaussian(alpha): a faster function of u alone
    FixedSphericalGaussian(alpha, tol): what that returns
    sigma_dirac_ring(u, u_n): a ring of normals
    sigma_power(u, p): x^p
    sigma_inv1p(u): 1/(1 + x)
    sigma_inv1m(u): 1/(1 - x)
    sigma_inv1m2(u): 1/(1 - x)^2
    sigma_inv1pu2(u): 1/(1 + x^2)
    cross_section(ndf): any density of x = cos(theta), with an estimate of the error
    CrossSection(ndf, rtol, breakpoints): what that returns

Distributions of normals at the cosine u:
    ndf_beckmann(u, alpha): Beckmann's
    ndf_ggx(u, alpha): GGX
    ndf_ellipsoidal(u, b): the ellipsoidal one
    ndf_spherical_gaussian(u, alpha): the spherical Gaussian

Normals as a viewer sees them:
    visible_ggx(x, y, z, u, alpha): their density for GGX
    visible_spherical_gaussian(x, y, z, u, alpha): their density for the spherical Gaussian
    sample_visible_ggx(u, alpha, xi_1, xi_2): one of them from two random numbers
    sample_visible_spherical_gaussian(u, alpha, rng): some of them from a generator of random numbers

Masking and shadowing after Smith:
    lambda_beckmann(u, alpha): Smith's Lambda of Beckmann's distribution
    lambda_ggx(u, alpha): Smith's Lambda of GGX
    smith_g1(lam): what is visible from one direction
    smith_g2(lam_i, lam_o): what is visible from both
    smith_g2_given_g1(lam_i, lam_o): from the second, of what is visible from the first

Lobes:
    ssl(cos_theta, alpha): the squared spheroidal lobe
    sel(x, y, z, alpha_x, alpha_y): the squared ellipsoidal lobe

Lambertian spheres: the phase function and the albedo of a half-space:
    phase_lambert_sphere(mu): the phase function of a sphere
    sample_lambert_sphere(xi): a cosine of deviation from a random number
    lambert_sphere_coefficients(order): the Legendre coefficients of the phase function
    h_lambert_sphere(mu, c, mode): the H function of an azimuthal order
    h_lambert_sphere_fit(mu, c, mode): a fast fit of it
    albedo_lambert_sphere(c): the diffuse colour of a half-space
    albedo_lambert_sphere_fit(c): a fast fit of it
    albedo_lambert_sphere_inverse(k_d): the albedo of the spheres that give this colour
    albedo_lambert_sphere_inverse_fit(k_d): a fast fit of it

BRDFs of half-spaces:
    brdf_lambert_sphere(mu_i, mu_o, phi, c): Lambertian spheres, exact in every order
    brdf_lambert_sphere_fit(mu_i, mu_o, phi, c): the same, fitted: many albedos at once
    brdf_lambert_sphere_fast(mu_i, mu_o, phi, c): exact single scattering and one short formula
    brdf_lambert_sphere_paper(mu_i, mu_o, phi, c): the model of deon2021, its misprints mended
    brdf_lambert_sphere_fast_paper(mu_i, mu_o, phi, c): the fast variant of deon2021
    brdf_lambert_sphere_printed(mu_i, mu_o, phi, c): the model of deon2021 with every number as printed
    brdf_lambert_sphere_hapke(mu_i, mu_o, phi, c): Hapke's approximation
    brdf_isotropic(mu_i, mu_o, c): isotropic scattering
    h_isotropic(mu, c): Chandrasekhar's H function
    HalfSpace(coefficients, albedo): any phase function of a few Legendre terms
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
