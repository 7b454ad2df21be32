"""Write the tables behind `h_isotropic`: `python -m xsec_sym.export.isotropic`.

Chandrasekhar's H is the exponential of a Cauchy integral along its cut -1 < mu < 0, times one factor of its pole -1/k,

    H(mu) = (1 + mu)/(1 + k mu) exp((mu/pi) int_0^1 a(v)/(v (v + mu)) dv),
    a(v) = arg(1 - c v artanh v + i pi c v/2),  c artanh k = k.

Four polynomials in two variables take the place of the integral:
- near mu = 0 it is analytic but for -(a(mu)/pi) log mu, which the kernel adds in closed form;
- from there to infinity it is analytic in 1/(mu + SHIFT), since the cut stays at a distance;
- for c near 1 it is analytic in c, while k and H itself are in sqrt(1 - c) only;
- for c near 0 it is not (1 - k is of the order of exp(-2/c)), but log H is; it is wanted there as a whole.
"""

from __future__ import annotations

from pathlib import Path

from mpmath import mp, mpf

import xsec_sym
from xsec_sym.export.polynomials import Matrix, chebyshev_nodes, coefficients, polynomial, powers, shortened, written
from xsec_sym.record.files import writing

ROOT = Path(xsec_sym.__file__).parent
# Doubles in the kernel too, where mu and c are compared with them.
NEAR, PALE = 0.4, 0.55
DIGITS = 36
NODES = 28
# The step and the reach of the tanh-sinh rule: half the step changes no digit of what is written.
STEP, REACH = mpf(1) / 32, 138
# What the terms left out of a polynomial may add up to, where log H is an absolute 1e-16 from right.
LEFT_OUT = mpf("7e-17")


def rule() -> list[tuple[mpf, mpf, mpf]]:
    """Nodes v in (0, 1), their weights, and artanh v, without a difference of nearly equal numbers."""
    nodes = []
    for j in range(-REACH, REACH + 1):
        s, slope = mp.pi / 2 * mp.sinh(j * STEP), mp.pi / 2 * mp.cosh(j * STEP)
        v, rest = 1 / (1 + mp.exp(-2 * s)), 1 / (1 + mp.exp(2 * s))
        nodes.append((v, STEP * slope * 2 * v * rest, (mp.log1p(v) - mp.log(rest)) / 2))
    return nodes


def wavenumber(c: mpf) -> mpf:
    """k in [0, 1) with c artanh k = k, from tanh x = c x; 0 for c = 1."""
    if c == 1:
        return mpf(0)
    # For c near 1 the root is a small difference of much larger terms.
    with mp.workdps(2 * DIGITS):
        x = mp.sqrt(3 * (1 - c)) if c > mpf("0.9") else 1 / c
        for _ in range(200):
            tangent = mp.tanh(x)
            step = (tangent - c * x) / (1 - tangent**2 - c)
            x -= step
            if abs(step) < x * mpf(10) ** (-DIGITS):
                return mp.tanh(x)
    raise ArithmeticError(f"no wavenumber for c = {mp.nstr(c, 20)}")


def angle(v: mpf, artanh: mpf, c: mpf) -> mpf:
    return mp.atan2(mp.pi * c * v / 2, 1 - c * v * artanh)


def shift() -> mpf:
    """Puts the two ends of the cut, mu = -1 and mu = 0, at opposite values of the variable of the far tables."""
    near = mpf(NEAR)
    return mp.sqrt(near * near + near) - near


def tables() -> dict[str, list[list[float]]]:
    """The wavenumber k/sqrt(1 - c) for c above PALE, and the four tables of the integral."""
    x = chebyshev_nodes(NODES)
    near, pale, d = mpf(NEAR), mpf(PALE), mpf(float(shift()))
    mus = {
        "NEAR": [near * (1 + node) / 2 for node in x],
        "FAR": [2 * (near + d) / (1 + node) - d for node in x],
    }
    root = mp.sqrt(1 - pale)
    cs = {
        "PALE": [1 - (root + (1 - root) * (1 + node) / 2) ** 2 for node in x],
        "BRIGHT": [pale + (1 - pale) * (1 + node) / 2 for node in x],
    }
    nodes = rule()
    kernels = {
        name: [(mu, [mu * weight / (mp.pi * v * (v + mu)) for v, weight, _ in nodes]) for mu in those]
        for name, those in mus.items()
    }
    found: dict[str, list[list[float]]] = {}
    for shade, those in cs.items():
        values: dict[str, Matrix] = {"NEAR": [], "FAR": []}
        for c in those:
            k = wavenumber(c)
            angles = [angle(v, artanh, c) for v, _, artanh in nodes]
            for name, rows in kernels.items():
                line = []
                for mu, weights in rows:
                    value = mp.fdot(weights, angles)
                    if shade == "PALE":
                        value += mp.log((1 + mu) / (1 + k * mu))
                    if name == "NEAR":
                        value += angle(mu, mp.atanh(mu), c) * mp.log(mu) / mp.pi
                        value /= mu
                    line.append(value / c if shade == "PALE" else value)
                values[name].append(line)
        for name, matrix in values.items():
            room = LEFT_OUT / (near if name == "NEAR" else 1) / (pale if shade == "PALE" else 1)
            found[f"{name}_{shade}"] = polynomial(matrix, room)
    ratio = shortened([coefficients([wavenumber(c) / mp.sqrt(1 - c) for c in cs["BRIGHT"]])], LEFT_OUT)[0]
    while not ratio[-1]:
        ratio.pop()
    return {"WAVENUMBER": [[float(entry) for entry in powers(ratio)]], **found}


def module() -> str:
    with mp.workdps(DIGITS):
        rows = tables()
        d = float(shift())
    parts = [
        '"""The polynomials of `isotropic`: a list by powers of the variable of mu, of lists by those of c.\n\n'
        "Lowest powers first. Generated by `python -m xsec_sym.export.isotropic`, which explains them: do not edit.\n"
        '"""\n\n'
        f"# fmt: off\n\nNEAR = {NEAR!r}\nPALE = {PALE!r}\nSHIFT = {d!r}\n"
    ]
    for name, table in rows.items():
        parts.append(f"{name} = [\n" + "".join(f"    [\n{written(row)}    ],\n" for row in table) + "]\n")
    return "\n".join(parts)


def main() -> None:
    with writing(ROOT / "kernels" / "_isotropic_tables.py") as out:
        out.write(module())


if __name__ == "__main__":
    main()
