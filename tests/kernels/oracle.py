"""References of 50 digits and more, none of which shares a formula with the kernel that it judges unless it says so."""

import numpy as np
from mpmath import mpf

from xsec_sym.study.references.ring import cross_section_about_view as cross_section_about_view
from xsec_sym.study.references.ring import cross_section_over_rings as cross_section_over_rings
from xsec_sym.study.references.ring import ring as ring
from xsec_sym.study.references.ring import ring_from_definition as ring_from_definition


def ulps(value, reference):
    """|value - reference| in units of the last place of value's own type."""
    value = np.asarray(value)[()]
    if reference == 0:
        return 0.0 if value == 0 else float("inf")
    if not np.isfinite(value):
        return float("inf")
    place = np.spacing(np.abs(value.dtype.type(float(reference))))
    return float(abs(mpf(float(value)) - reference) / mpf(float(place)))


def worst_ulps(values, references):
    return max(ulps(value, reference) for value, reference in zip(values, references, strict=True))
