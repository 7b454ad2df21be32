"""Importable NumPy kernels: the quantities of the papers as functions of arrays, without SymPy or mpmath."""

from xsec_sym.kernels.dirac_ring import sigma_dirac_ring
from xsec_sym.kernels.power import sigma_power
from xsec_sym.kernels.ring_lemma import CrossSection, cross_section

__all__ = ["CrossSection", "cross_section", "sigma_dirac_ring", "sigma_power"]
