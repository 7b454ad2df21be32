"""A quantity of one's own, with methods whose errors and failures are known."""

import numpy as np
from mpmath import mpf

from xsec_sym.study.method import Argument, Field, Method, Quantity, along

X = Argument("x", (0.0, 0.25, 0.5, 1.0))
A = Argument("a", (1.0, 10.0, 100.0), scale="log")


def square(x, a):
    return mpf(a) * mpf(x) ** 2


def near_half(rng, n):
    return 0.5 + rng.uniform(-1e-6, 1e-6, n), A.draw(rng, n)


QUANTITY = Quantity(
    "toy",
    "a times the square of x",
    (X,),
    (A,),
    square,
    {"near one half": near_half},
    typical=((2.0,),),
    per_cell=(2, 5),
)


def exact(x, a):
    return a * x * x


def off(size):
    return lambda x, a: a * x * x * (1 + size)


def broken(x, a):
    return np.where((x > 0.25) & (x < 0.5) & (a > 10), np.nan, a * x * x)


def folded(a):
    if a > 50:
        raise ValueError("too large")
    return lambda x: a * x * x


def scalar(x, a):
    if x > 0.5:
        raise ZeroDivisionError
    return a * x * x


METHODS = (
    Method("exact", "arithmetic", lambda: exact, ours=True, single=True),
    Method("off", "arithmetic", off, curve=along(size=(1e-3, 1e-6))),
    Method("broken", "arithmetic", lambda: broken),
    Method("folded", "arithmetic", folded, folds=True),
    Method("scalar", "arithmetic", lambda: scalar, serial=True, most=20),
    Method("absent", "arithmetic", lambda: exact, needs="a_package_that_is_not_there"),
)
FIELD = Field(QUANTITY, METHODS)
