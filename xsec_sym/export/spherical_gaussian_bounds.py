"""How far the tables of `sigma_spherical_gaussian` are off: a bound that is proved, cell by cell.

`python -m xsec_sym.export.spherical_gaussian_bounds` proves the tables that are there anew, and `proved` does one cell.
The method is that of `remainders`; balls around the values are `enclosed`, whose docstring bounds the rule's error.
What is left to know is how large each region's function is for complex variables, by |I0(z)| <= exp |Re z|, and
|exp(-z) I0(z)| <= 1 for Re z >= 0. With tau = sqrt(1 - t^2) throughout,

- EVEN is kappa/(2 sinh kappa) int_0^1 t cosh(kappa u t) I0(kappa s tau) dt: cosh and I0 together grow like
  exp(|kappa| sqrt(|u|^2 + |s|^2)) by Cauchy's and Schwarz's inequality, and |kappa/sinh kappa| <= r/sin r if |kappa| <=
  r < pi, by Euler's product;
- ROUND is exp(kappa (v - 1)) int_0^1 t exp(-kappa v t) I0(kappa s tau) dt, and the same holds;
- LAYER is kappa (W - c/2 sqrt(1 + s) h(z)), z^2 = w, v sqrt(kappa) = z sqrt(1 + s), and even under a change of the sign
  of v and z together, since the odd part of W is -c/2 sqrt(kappa) v exp(w), that of h(z) is -z exp(z^2), and what is
  left is entire in v^2 and w. Hence it is analytic about s = 1 too, and at each place that sign may be taken for which
  Re(kappa v) >= 0. Then |W| <= |kappa|^(3/2)/|1 - exp(-2 kappa)| int t exp(-Re(kappa s) t^2/2) dt, from 1 - tau >=
  t^2/2. If Re z >= 0, h(z) = 2/sqrt(pi) int_0^inf t exp(-t^2 - 2 z t) dt is 1/sqrt(pi) at most; else it is h(-z) -
  2 z exp(z^2), where |arg z| <= pi/2 + |arg kappa|/2 + |arg(1 + s)|/2 makes Re z^2 <= 0 as long as |arg kappa| +
  |arg s| <= pi/2, and this is asked for;
- RIM and EDGE come from q = exp(-P) int_0^inf T exp(-v T) I0(sqrt(P^2 - s^2 T^2)) dT, P = kappa s, of which Lipschitz's
  integral, differentiated, gives the part beyond T = kappa. The real part of that root is sqrt((Re P)^2 + (b T)^2) at
  most, b = |Im s|, so that |q| <= exp(2 max(0, -Re P))/(Re v - b)^2: it is analytic in P and in s^2 where Re v > b.
  Re v is harmonic in s^2 and b subharmonic, so that Re v - b is least on a boundary.

Errors count relative to sigma(-v), as a region's function gives it: EVEN less c v/2, LAYER with kappa times its layer,
RIM and EDGE less what lies beyond T = kappa, ROUND as it is. A table has no values below its polynomial's, less the
bound itself.

What is proved is proved for all arguments in a cell, with two exceptions: LAYER's first row reaches alpha^2 = 0 and
EDGE's first column 1/(kappa s) = 0, where both are smooth but singular, and h its t = 0, which is z = inf. They are cut
at START, which leaves nothing out for alpha >= 1e-4; what is beyond is only seen at points, by the generator's `error`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from math import ceil, floor, inf, log10

from flint import acb, arb

from xsec_sym.export.remainders import (
    Known,
    Majorant,
    Span,
    Table,
    boxes,
    decades,
    greatest,
    half_turn,
    least,
    missed,
    missed_on_line,
    planned,
    table_at,
)
from xsec_sym.export.spherical_gaussian_functions import (
    BITS,
    HALF,
    REGIONS,
    SHIFT,
    Cell,
    enclosed,
    far_half_layer,
    half_layer,
    mean_cosine,
    pale_cosine,
)
from xsec_sym.proof.ball_compile import precision

# Where the tables that are singular at 0 are cut: alpha^2, 1/(kappa s), and t = HALF/(HALF + z).
START = {"LAYER": 1e-8, "EDGE": 1e-8, "HALF_LAYER": 1e-4}
# What remainders may contribute, relative to sigma(-v).
REMAINDER = arb("1e-19")
# Boxes of either variable, in which errors and their scale are compared.
BOXES = 128
PREFIXES = ("", "FAST_")


def _even_x(arcs: list[acb]) -> Known:
    return (greatest([abs(square) + abs(1 - square) for square in arcs]).sqrt(),)


def _even_y(arcs: list[acb]) -> Known | None:
    size = greatest([abs(square) for square in arcs]).sqrt()
    return (size,) if size < 3 else None


def _even(x: Known, y: Known) -> arb:
    (length,), (kappa,) = x, y
    return kappa / kappa.sin() * (kappa * length).exp() / 4


def _round_x(arcs: list[acb]) -> Known:
    return (greatest([abs(v) + (abs(v * v) + abs(1 - v * v)).sqrt() for v in arcs]),)


def _round_y(arcs: list[acb]) -> Known:
    return greatest([abs(kappa) for kappa in arcs]), least([kappa.real for kappa in arcs])


def _round(x: Known, y: Known) -> arb:
    (length,), (kappa, real) = x, y
    return (kappa * length - real).exp() / 2


def _layer_x(arcs: list[acb]) -> Known | None:
    if not all(x.real > 0 for x in arcs):
        return None
    sines = [1 / x - SHIFT for x in arcs]
    if not all(s.real > 0 for s in sines):
        return None
    return (
        least([abs(s) for s in sines]),
        greatest([abs(s.arg()) for s in sines]),
        greatest([abs(1 + s) for s in sines]),
        greatest([abs(1 - s) for s in sines]),
    )


def _layer_y(arcs: list[acb]) -> Known | None:
    if not all(y.real > 0 for y in arcs):
        return None
    kappas = [2 / y for y in arcs]
    return (
        greatest([abs(kappa) for kappa in kappas]),
        greatest([abs(kappa.arg()) for kappa in kappas]),
        least([kappa.real for kappa in kappas]),
    )


def _layer(x: Known, y: Known) -> arb | None:
    (s, turn, more, less), (kappa, turned, real) = x, y
    angle = turn + turned
    if not angle < arb.pi() / 2:
        return None
    gone = (-2 * real).exp()
    whole = kappa.sqrt() / (s * angle.cos() * (1 - gone))
    cosine = (1 + gone) / (1 - gone) + 1 / real
    flat = cosine / 2 * more.sqrt() * (1 / arb.pi().sqrt() + 2 * (kappa * less).sqrt())
    return kappa * (whole + flat)


def _rim_x(arcs: list[acb]) -> Known:
    return greatest([abs(ks) for ks in arcs]), -least([arb(0), *(ks.real for ks in arcs)])


def _rim_y(arcs: list[acb]) -> Known:
    return (greatest([abs(fourth) for fourth in arcs]),)


def _rim(x: Known, y: Known) -> arb | None:
    (ks, behind), (fourth,) = x, y
    radius = (ks * ks * fourth / 4).upper()
    if not radius < 0.97:
        return None
    room = _decay([acb(radius * turn.cos_pi(), radius * turn.sin_pi()) for turn in half_turn(32)])
    return None if room is None else (2 * behind).exp() / (room * room)


def _decay(squares: list[acb]) -> arb | None:
    """How fast the half-line's integral falls off, at least: Re v - |Im s|."""
    if not all((1 - square).real > 0 for square in squares):
        return None
    room = least([(1 - q).sqrt().real - ((abs(q) - q.real) / 2).upper().max(arb(0)).sqrt() for q in squares])
    return room if room > 0 else None


def _edge_x(arcs: list[acb]) -> Known | None:
    if not all(p.real > 0 for p in arcs):
        return None
    return (1 / least([abs(p) for p in arcs]).sqrt(),)


def _edge_y(arcs: list[acb]) -> Known | None:
    room = _decay(arcs)
    return None if room is None else (room,)


def _edge(x: Known, y: Known) -> arb:
    (root,), (room,) = x, y
    return root / (room * room)


MAJORANTS = {
    "EVEN": Majorant(_even_x, _even_y, _even),
    "ROUND": Majorant(_round_x, _round_y, _round),
    "LAYER": Majorant(_layer_x, _layer_y, _layer),
    "RIM": Majorant(_rim_x, _rim_y, _rim),
    "EDGE": Majorant(_edge_x, _edge_y, _edge),
}


def _half_layer_size(arcs: list[acb]) -> arb | None:
    if not all(t.real > 0 for t in arcs):
        return None
    return greatest([_half_layer(HALF / t - HALF) * abs(1 + HALF / t - HALF) ** 2 for t in arcs])


def _half_layer(z: acb) -> arb:
    flat = 1 / arb.pi().sqrt()
    return flat if z.real >= 0 else flat + 2 * abs(z) * (z * z).real.exp()


def _pale_size(arcs: list[acb]) -> arb | None:
    """c/kappa is the sum of 2/(kappa^2 + (pi k)^2), so largest at -r^2 if |kappa^2| <= r^2."""
    r = greatest([abs(square) for square in arcs]).sqrt()
    return (1 / r - r.cot()) / r if r < 3 else None


# --- the scale of errors -----------------------------------------------------------------------------------


def _scales(name: str, table: Table, x: Span, y: Span) -> list[list[arb]]:
    """sigma(-v) in units of the table's function, box by box; it may be less by what the table misses."""
    across, along = ([span.place(box) for box in boxes(BOXES)] for span in (x, y))
    found = table_at(table, [x.unit(box) for box in across], [y.unit(box) for box in along])
    more = MORE.get(name, lambda x, y: arb(0))
    return [[found[i, j] + more(box, there) for j, there in enumerate(along)] for i, box in enumerate(across)]


def _relative(off: list[list[arb]], least_off: list[list[arb]], scales: list[list[arb]]) -> arb:
    """The largest of the ratios off/(scale - least_off)."""
    ratios = []
    for row in zip(off, least_off, scales, strict=True):
        for here, less, scale in zip(*row, strict=True):
            ratios.append(here / (scale - less) if scale > less else arb("inf"))
    return greatest(ratios)


def _less_odd(square: arb, kappa_square: arb) -> arb:
    """-c u/2, at least: c grows with kappa."""
    return -mean_cosine(kappa_square.upper().sqrt()) * square.upper().sqrt() / 2


def _flat(shifted: arb, alpha_square: arb) -> arb:
    """kappa c/2 sqrt(1 + s) h(z), at least: h falls as z grows, and c > 1 - 1/kappa."""
    s, kappa = 1 / shifted - SHIFT, 2 / alpha_square
    z = (kappa.upper() * (1 - s.lower()).max(arb(0))).sqrt()
    return (kappa.lower() - 1) / 2 * (1 + s.lower()).sqrt() * half_layer(z)


def _surplus(kappa: arb) -> arb:
    """-kappa v (1 + 1/kappa) exp(-kappa (1 + s)), at least, which is subtracted from q."""
    return -(kappa + 1) * (-kappa).exp()


def _less_surplus_near(ks: arb, alpha_fourth: arb) -> arb:
    return _surplus((2 / alpha_fourth.upper().sqrt()).lower())


def _less_surplus_far(inverse: arb, s_square: arb) -> arb:
    ks = 1 / inverse.lower()
    return _surplus((1 / inverse.upper() / s_square.upper().sqrt()).lower()) * ks.sqrt()


MORE: dict[str, Callable[[arb, arb], arb]] = {
    "EVEN": _less_odd,
    "LAYER": _flat,
    "RIM": _less_surplus_near,
    "EDGE": _less_surplus_far,
}


# --- the tables --------------------------------------------------------------------------------------------


def spans(name: str, cell: Cell) -> list[tuple[Span, Span]]:
    """The parts of a cell on which its tables are looked at."""
    x, y = cell[:2], cell[2:]
    if name == "EDGE" and not x[0]:
        return [(Span(*part, x, True), Span(*y, y)) for part in decades(START[name], x[1])]
    if name == "LAYER":
        return [(Span(*x, x), Span(*part, y, True)) for part in decades(y[0] or START[name], y[1])]
    return [(Span(*x, x), Span(*y, y))]


def proved(name: str, x: Span, y: Span, made: Mapping[str, Table]) -> dict[str, arb]:
    """What the tables of a cell, one by prefix, are off by on a part of it, relative to sigma(-v).

    The first of them must be positive where sigma is, if the bound is to be finite.
    """
    with precision(BITS):
        first, *_ = rows = list(made.values())
        scales = _scales(name, first, x, y)
        lowest = least([scale for row in scales for scale in row])
        if not lowest > 0:
            return dict.fromkeys(made, arb("inf"))
        plan = planned(x, y, MAJORANTS[name], rows, REMAINDER * lowest)
        value = REGIONS[name].value
        found = missed(x, y, plan, lambda here, there: value(here, there, enclosed)[0], rows)
        off = [one.on(BOXES, BOXES) for one in found]
        return {prefix: _relative(one, off[0], scales) for prefix, one in zip(made, off, strict=True)}


def cell_bounds(name: str, cell: Cell, made: Mapping[str, Table]) -> dict[str, float]:
    """The same for the whole cell, from START on, rounded up."""
    found = [proved(name, x, y, made) for x, y in spans(name, cell)]
    return {prefix: rounded_up(greatest([part[prefix] for part in found])) for prefix in made}


def line_bound(name: str, row: Sequence[float]) -> float:
    """What HALF_LAYER or MEAN_COSINE is off by, relative to its function."""
    with precision(BITS):
        if name == "HALF_LAYER":
            span = Span(START[name], 1.0, (0.0, 1.0), True)
            off = missed_on_line(span, _half_layer_size, far_half_layer, row, REMAINDER).on(BOXES, 1)
        else:
            end = REGIONS["EVEN"].y[-1]
            span = Span(0.0, end, (0.0, end))
            off = missed_on_line(span, _pale_size, pale_cosine, row, REMAINDER).on(BOXES, 1)
        values = table_at([row], [span.unit(span.place(box)) for box in boxes(BOXES)], [arb(0)])
        return rounded_up(_relative(off, off, [[value] for value in values.entries()]))


def rounded_up(bound: arb) -> float:
    """To three digits."""
    if not bound.is_finite():
        return inf
    value = float(bound) * (1 + 1e-12)
    unit = 10.0 ** (floor(log10(value)) - 2)
    return float(f"{ceil(value / unit) * unit:.2e}")


def main() -> None:
    """Prove the kernel's tables anew, and print the largest bound of each."""
    # The generator needs this module before there are any tables.
    tables = import_module("xsec_sym.kernels._spherical_gaussian_tables")
    for bare in ("HALF_LAYER", "MEAN_COSINE"):
        for name in (bare, f"FAST_{bare}"):
            print(f"{name:17}{line_bound(bare, getattr(tables, name)[0]):.2e}", flush=True)
    for name, region in REGIONS.items():
        made = [{prefix: getattr(tables, prefix + name)[i] for prefix in PREFIXES} for i in range(len(region.cells()))]
        found = [cell_bounds(name, cell, here) for cell, here in zip(region.cells(), made, strict=True)]
        for prefix in PREFIXES:
            print(f"{prefix + name:17}{max(here[prefix] for here in found):.2e}", flush=True)


if __name__ == "__main__":
    main()
