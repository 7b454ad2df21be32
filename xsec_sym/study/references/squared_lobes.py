"""The two squared lobes from their definitions."""

from mpmath import mp

from xsec_sym.study.references.surfaces import exactly, ndf_ggx


@exactly
def distance(x, y, z, alpha_x, alpha_y):
    """The t > 0 for which t (x, y, z) lies on the ellipsoid: it is a t^2 + 2 b t + c = 0, with c < 0."""
    squared = max(alpha_x, alpha_y) ** 2
    centre, along = (1 - squared) / 2, (1 + squared) / 2
    a = (x / alpha_x) ** 2 + (y / alpha_y) ** 2 + (z / along) ** 2
    b = -z * centre / along**2
    c = (centre / along) ** 2 - 1
    return (mp.sqrt(b * b - a * c) - b) / a


def sel(*arguments):
    return distance(*arguments) ** 2


@exactly
def ssl(m, alpha):
    """GGX at half the angle over its value at 0, which is its limit at the horizon: m = -1."""
    if m == -1:
        return alpha**4
    return mp.pi * alpha**2 * ndf_ggx.__wrapped__(mp.sqrt((1 + m) / 2), alpha)
