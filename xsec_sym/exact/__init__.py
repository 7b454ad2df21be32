"""The exact definitions that claims talk about, unevaluated, each with its LaTeX form."""

from xsec_sym.exact.ring import AZIMUTH, RingCrossSection, RingMean, RingSpread, RingTilt, facing

__all__ = ["AZIMUTH", "RingCrossSection", "RingMean", "RingSpread", "RingTilt", "facing"]
