"""Random walks that confirm the central claim of `dupuy2016`: a homogeneous medium scatters as Smith's surface does.

`homogeneous` and `heights` simulate the two media, and share neither transport nor the sampling of normals; `compare`
judges them. `python -m xsec_sym.walks` does it all.
"""

from xsec_sym.walks.compare import Check, first_order, holds, same_directions, same_orders, visibility
from xsec_sym.walks.heights import HEIGHTS, SmithMedium
from xsec_sym.walks.homogeneous import HomogeneousMedium, TwoSidedMedium
from xsec_sym.walks.paths import Emerged, Paths

__all__ = [
    "HEIGHTS",
    "Check",
    "Emerged",
    "HomogeneousMedium",
    "Paths",
    "SmithMedium",
    "TwoSidedMedium",
    "first_order",
    "holds",
    "same_directions",
    "same_orders",
    "visibility",
]
