"""Write the tables behind the derivatives of sigma: `python -m xsec_sym.export.spherical_gaussian_slopes`.

As in `xsec_sym.export.spherical_gaussian`, whose regions and cells these are, all comes from the side turned away. Its
integral, differentiated under the sign, gives with x = kappa s sqrt(1 - t^2), c = coth kappa - 1/kappa and N =
kappa/(2 sinh kappa)

    T = sigma'(-v)                 = kappa N int_0^1 t exp(-kappa v t) (t I0(x) + v/s sqrt(1 - t^2) I1(x)) dt
    K = -d sigma(-v)/d kappa       = N int_0^1 t exp(-kappa v t) ((c + v t) I0(x) - s sqrt(1 - t^2) I1(x)) dt

and the side that is lit has c - T and c' v - K. Instead of them, smooth functions:

- EVEN: (c/2 - T)/(kappa^2 v) and (c' v/2 - K)/kappa, even in v and in kappa, as the even part of sigma is;
- ROUND: exp(kappa v) T (1 - exp(-2 kappa))/kappa^2 and exp(kappa v) K (1 - exp(-2 kappa))/kappa;
- LAYER: the derivatives of exp(-w)/sqrt(kappa) [c/2 sqrt(1 + s) h(sqrt w) + C/kappa], in which the derivatives of h
  drop out but for erfcx, leave as unknown and smooth P and R in
  T = exp(-w) {c (1 + s)/(4 s) erfcx(sqrt w) + v/(s sqrt(kappa)) [P + c h/(4 sqrt(1 + s))]},
  K = exp(-w) kappa^(-3/2) {R - kappa c'/2 sqrt(1 + s) h};
- RIM and EDGE: with H(v, kappa) the integral of sigma up to infinity, exp(-kappa s) times -dH/dv and kappa^3 dH/dkappa,
  from which K follows as c sigma - N d(H - surplus)/dkappa: toward the edge times (kappa s)^(3/2) and (kappa s)^(-1/2).
"""

from __future__ import annotations

from collections.abc import Callable

from flint import arb
from mpmath import mp, mpf

from xsec_sym.export import spherical_gaussian as sigma
from xsec_sym.export import spherical_gaussian_functions as functions
from xsec_sym.export.polynomials import packed, polynomial
from xsec_sym.export.spherical_gaussian_functions import SHIFT, Cell, Region
from xsec_sym.proof.ball_compile import precision
from xsec_sym.record.files import writing

# What the terms left out may add up to, relative to the derivative, and the error that is allowed in the end.
LEFT_OUT, ALLOWED = mpf("4e-16"), mpf("2e-15")


def integrals(v: arb, s: arb, kappa: arb) -> tuple[arb, arb, arb]:
    """exp(w) N times the integrals of t I0, t^2 I0 and t sqrt(1 - t^2) I1, each times exp(-kappa v t)."""
    ks, kv = kappa * s, kappa * v
    room = 2 * functions.NEGLIGIBLE
    reach = room / (kv + (kv * kv + room * ks).sqrt())
    reach = reach.mid() if reach < 1.2 else arb.pi() / 2
    totals = [arb(0), arb(0), arb(0)]
    for node, weight in functions.rule(functions.POINTS):
        half_sine, half_cosine = (node * reach / 2).sin_cos()
        t = 2 * half_sine * half_cosine
        root = (half_cosine - half_sine) * (half_cosine + half_sine)
        common = weight * t * root * (-(2 * ks * half_sine * half_sine + kv * t)).exp()
        even, odd = (common * (ks * root).bessel_i(order, scaled=True) for order in (0, 1))
        for i, part in enumerate((even, t * even, root * odd)):
            totals[i] += part
    scale = reach * kappa / (1 - (-2 * kappa).exp())
    return scale * totals[0], scale * totals[1], scale * totals[2]


def fading(kappa: arb) -> arb:
    """c'."""
    return 1 / kappa**2 - 1 / kappa.sinh() ** 2


def slope_u(v: arb, s: arb, kappa: arb) -> arb:
    """exp(w) T."""
    _, second, odd = integrals(v, s, kappa)
    return kappa * (second + v * odd / s)


def slope_kappa(v: arb, s: arb, kappa: arb) -> arb:
    """exp(w) K."""
    first, second, odd = integrals(v, s, kappa)
    return functions.mean_cosine(kappa) * first + v * second - s * odd


Value = tuple[arb, arb]
Slope = Callable[[arb, arb, arb], arb]


def even(slope: Slope, square: arb, kappa_square: arb) -> Value:
    v, kappa, s = square.sqrt(), kappa_square.sqrt(), (1 - square).sqrt()
    dark = slope(v, s, kappa) * (-kappa * (1 - s)).exp()
    if slope is slope_u:
        return (functions.mean_cosine(kappa) / 2 - dark) / (kappa_square * v), dark / (kappa_square * v)
    return (fading(kappa) * v / 2 - dark) / kappa, dark / kappa


def round_(slope: Slope, v: arb, kappa: arb) -> Value:
    s = ((1 - v) * (1 + v)).sqrt()
    value = slope(v, s, kappa) * (kappa * (v - (1 - s))).exp() * (1 - (-2 * kappa).exp()) / kappa
    value = value / kappa if slope is slope_u else value
    return value, value


def scaled_erfc(z: arb) -> arb:
    with precision(3 * functions.BITS):
        value = (z * z).exp() * z.erfc()
    return value


def layer(slope: Slope, shifted: arb, alpha_square: arb) -> Value:
    s, kappa = 1 / shifted - SHIFT, 2 / alpha_square
    v, z = ((1 - s) * (1 + s)).sqrt(), (kappa * (1 - s)).sqrt()
    whole, half = slope(v, s, kappa), functions.half_layer(z) * (1 + s).sqrt()
    if slope is slope_u:
        c, unit = functions.mean_cosine(kappa), s * kappa.sqrt() / v
        return (whole - c * (1 + s) / (4 * s) * scaled_erfc(z)) * unit - c / (4 * (1 + s)) * half, whole * unit
    whole *= kappa * kappa.sqrt()
    return whole + kappa * fading(kappa) / 2 * half, whole


def rim(slope: Slope, s: arb, kappa: arb) -> Value:
    v, rest = ((1 - s) * (1 + s)).sqrt(), 1 - (-2 * kappa).exp()
    beyond = (-kappa * (1 + s)).exp() / kappa
    whole = slope(v, s, kappa)
    if slope is slope_u:
        return whole * rest / kappa - beyond * (1 + 1 / kappa), whole * rest / kappa
    first = functions.mean_cosine(kappa) * integrals(v, s, kappa)[0]
    value = (first - whole) * rest / kappa - v * beyond * (1 + 2 / kappa + 2 / kappa**2)
    return value * kappa**3, whole * rest * kappa**2


def near_rim(slope: Slope, ks: arb, alpha_fourth: arb) -> Value:
    kappa = 2 / alpha_fourth.sqrt()
    return rim(slope, ks / kappa, kappa)


def far_rim(slope: Slope, inverse: arb, s_square: arb) -> Value:
    s = s_square.sqrt()
    value, scale = rim(slope, s, 1 / (inverse * s))
    unit = 1 / (inverse * inverse.sqrt()) if slope is slope_u else inverse.sqrt()
    return value * unit, scale * unit


FUNCTIONS = {"EVEN": even, "ROUND": round_, "LAYER": layer, "RIM": near_rim, "EDGE": far_rim}
SLOPES = {"U_": slope_u, "KAPPA_": slope_kappa}


def region(prefix: str, name: str) -> Region:
    slope, function = SLOPES[prefix], FUNCTIONS[name]
    return functions.REGIONS[name]._replace(value=lambda x, y: function(slope, x, y))


def table(place: Region, cell: Cell) -> list[list[float]]:
    with precision(functions.BITS), mp.workdps(functions.DIGITS):
        values, scale = sigma.sampled(place, cell)
        return polynomial(values, LEFT_OUT * scale)


def lines() -> dict[str, list[float]]:
    """erfcx(z) (1 + z) in HALF/(HALF + z), and c' in kappa^2 where EVEN is."""

    def erfcx(t: arb) -> arb:
        z = functions.HALF / t - functions.HALF
        return scaled_erfc(z) * (1 + z)

    room = LEFT_OUT / 10
    return {
        "ERFCX": sigma.line(erfcx, 0, 1, 40, room),
        "FADING": sigma.line(lambda square: fading(square.sqrt()), 0, functions.REGIONS["EVEN"].y[-1], 20, room),
    }


def all_tables() -> dict[str, list[list[list[float]]]]:
    """Every table by its name, a list of cells each; ArithmeticError where one misses what is allowed."""
    found: dict[str, list[list[list[float]]]] = {}
    for prefix in SLOPES:
        for name in FUNCTIONS:
            place = region(prefix, name)
            found[prefix + name] = []
            for cell in place.cells():
                made = table(place, cell)
                off = sigma.error(place, cell, made, 24, 1)
                if off > ALLOWED:
                    raise ArithmeticError(f"{prefix}{name} is off by {mp.nstr(off, 3)} in {cell}")
                found[prefix + name].append(made)
    return found


def module() -> str:
    parts = [
        '"""The polynomials of `spherical_gaussian_slopes`, on the cells of `_spherical_gaussian_tables`.\n\n'
        "By powers of y those of x, lowest first, both variables scaled to [-1, 1]. Generated by\n"
        "`python -m xsec_sym.export.spherical_gaussian_slopes`, which explains them: do not edit.\n"
        '"""\n\n'
        "# fmt: off\n"
    ]
    for name, row in lines().items():
        parts.append(f"{name} = (\n{packed(row, 4)}]\n)\n")
    for name, cells in all_tables().items():
        text = "".join("    [\n" + "".join(f"{packed(row, 6)}],\n" for row in cell) + "    ],\n" for cell in cells)
        parts.append(f"{name} = [\n{text}]\n")
    return "\n".join(parts)


def main() -> None:
    with writing(sigma.ROOT / "kernels" / "_spherical_gaussian_slopes_tables.py") as out:
        out.write(module())


if __name__ == "__main__":
    main()
