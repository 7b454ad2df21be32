"""Importable NumPy kernels: the quantities of the papers as functions of arrays, without SymPy or mpmath."""

from xsec_sym.kernels.dirac_ring import sigma_dirac_ring
from xsec_sym.kernels.power import sigma_power
from xsec_sym.kernels.ring_lemma import CrossSection, cross_section
from xsec_sym.kernels.table1 import sigma_inv1m, sigma_inv1m2, sigma_inv1p, sigma_inv1pu2

__all__ = [
    "CrossSection",
    "cross_section",
    "sigma_dirac_ring",
    "sigma_inv1m",
    "sigma_inv1m2",
    "sigma_inv1p",
    "sigma_inv1pu2",
    "sigma_power",
]
