"""The methods of a quantity, tried at chosen points against its reference."""

import numpy as np

from xsec_sym.study.errors import deviations, values
from xsec_sym.study.method import registered
from xsec_sym.study.points import right


def box(seed, n, *ranges):
    """n points, each argument between the two values given for it."""
    rng = np.random.default_rng(seed)
    return tuple(rng.uniform(low, high, n) for low, high in ranges)


def tried(name, method, columns, dtype="float64", **parameters):
    """What a method returns at these points, and its relative errors there."""
    field = registered(name)
    points = right(field.quantity, "", tuple(np.atleast_1d(np.asarray(c, float)) for c in columns), dtype)
    found = values(field.quantity, field[method], parameters, points.columns, dtype)
    return found, deviations(found, points, dtype)[1]


def worst(name, method, columns, dtype="float64", **parameters):
    """The largest relative error, infinite for NaN."""
    return tried(name, method, columns, dtype, **parameters)[1].max()


def last(method):
    """The last point of its curve, which should be its most accurate."""
    return method.curve[-1]
