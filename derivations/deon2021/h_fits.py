"""Sections 3.3 and 3.4: the H functions of orders 0 and 1, and the constants of both modes, as fits in c and mu.

The truth of each is what two solvers agree on (`xsec_sym/exact/solved.py`). Errors are the largest ones found.
"""

from sympy import Float, Mul, Pow, Rational, exp, log, sqrt, symbols

from xsec_sym.exact.solved import HLambertSphere, ModeConstant
from xsec_sym.proof import Source, interval
from xsec_sym.proof.accuracy import T

paper = Source("deon2021", section="3.3")
zeroth = Source("deon2021", section="3.4")

mu, c = symbols("mu c", real=True)
COSINE, ALBEDO = interval(mu, 0, 1), interval(c, 0, 1)
# H varies like mu log mu at mu = 0, and like the root of 1 - c at c = 1
CROWDED = {mu: T**4, c: 1 - T**2}
THREE_TERMS = "for the three-term phase function of (5)"
HALF_PERCENT, PERCENT = Rational(1, 200), Rational(1, 100)


def d(digits):
    """A number as it is printed."""
    return Float(digits)


def share(factor, of):
    """A number times a difference, as it is printed: SymPy would multiply it out."""
    return Mul(factor, of, evaluate=False)


# --- H of order 1 ---------------------------------------------------------------------------------------

H = HLambertSphere
spreading = d("-1.12831") * mu**3 + d("1.85728") * mu**2 - d("1.07879") * mu + d("0.459442")

paper.measured(
    "28",
    "H of order 1 in parts that depend on c and on mu alone",
    left=H(1, mu, c),
    printed=H(1, 1, c) * H(1, mu, 1),
    corrected=Pow(H(1, mu, 1), log(H(1, 1, c)) / log(H(1, 1, 1))),
    edit="a power for the product: what separates is the logarithm of H, as H is 1 at mu = 0 for every c",
    where=[COSINE, ALBEDO],
    within=HALF_PERCENT,
    relative=True,
    along=CROWDED,
    reading="H^(1) alone stands for H^(1)(1), which (30) gives; the accuracy is the one that is stated with (30); "
    + THREE_TERMS,
)


def without_absorption(constant):
    """(29)."""
    return exp(-constant * mu**spreading)


paper.measured(
    "29",
    "H of order 1 without absorption",
    left=H(1, mu, 1),
    printed=without_absorption(d("0.0894878")),
    corrected=without_absorption(d("0.120894878")),
    edit="0.120894878 for 0.0894878: two digits are lost behind the point",
    where=[COSINE],
    within=HALF_PERCENT,
    relative=True,
    along={mu: T**4},
    reading="the constant is - log H(1), which is 0.120888; no other number in place of one digit is within 1.2 "
    "percent; " + THREE_TERMS,
)


def at_one(square):
    """(30)."""
    return exp(square * c**2 - d("0.144839") * c)


paper.measured(
    "30",
    "H of order 1 at mu = 1",
    left=H(1, 1, c),
    printed=at_one(d("0.242851")),
    corrected=at_one(d("0.0242851")),
    edit="0.0242851 for 0.242851: a zero is lost behind the point",
    where=[ALBEDO],
    within=HALF_PERCENT,
    relative=True,
    along={c: 1 - T**2},
    reading=THREE_TERMS,
)

paper.measured(
    "claim.h1-accuracy",
    "(28)-(30) give H of order 1 with a relative error below 0.5 percent",
    left=H(1, mu, c),
    printed=exp(log(at_one(d("0.0242851"))) * mu**spreading),
    where=[COSINE, ALBEDO],
    within=HALF_PERCENT,
    relative=True,
    along=CROWDED,
    statement=True,
    reading="(28) and (30) as mended; the constant of (29) cancels; " + THREE_TERMS,
)

# --- constants of order 1 -------------------------------------------------------------------------------

for label, index, name, printed in (
    ("31", 0, "l", -d("0.00473696") * c**2 - d("0.0589037") * c),
    ("32", 1, "m", d("0.44038") * c + 1),
):
    paper.measured(
        label,
        f"the constant {name} of the mode of order 1",
        left=ModeConstant(1, index, c),
        printed=printed,
        where=[ALBEDO],
        along={c: 1 - T**2},
        reading=THREE_TERMS + ("; printed as a second (31)" if label == "32" else ""),
    )

# --- H of order 0 ---------------------------------------------------------------------------------------

s = sqrt(1 - c)


def a_of(s):
    return (d("1.50112") * s ** d("6.05435") + d("8.21644")) / (d("4.17593") - d("1.21222") * s)


def d_of(s):
    return (d("7.7731") - d("0.565811") * s ** d("0.961546")) / (d("8.65912") - d("0.159974") * s**7)


a, exponent = a_of(s), d_of(s)
over_infinity = sqrt((c - 16) * (c - 1) * (4 * c + 9)) / 12
hapke = (1 + a * mu**exponent) / (1 + a * mu**exponent * over_infinity)

zeroth.measured(
    "37",
    "H of order 0",
    left=H(0, mu, c),
    printed=hapke,
    where=[COSINE, ALBEDO],
    within=PERCENT,
    relative=True,
    along=CROWDED,
    reading="with the constants a and d that are fitted for it, and with H at infinity as its reciprocal, which is 0 "
    "at c = 1; " + THREE_TERMS,
)
zeroth.measured(
    "claim.h0-accuracy",
    "(37) has a relative error below 1 percent for all mu and c from 0 to 1",
    left=H(0, mu, c),
    printed=hapke,
    where=[COSINE, ALBEDO],
    within=PERCENT,
    relative=True,
    along=CROWDED,
    statement=True,
    reading=THREE_TERMS,
)

root = symbols("s", real=True)
for label, name, form in (("fit.a", "a", a_of), ("fit.d", "d", d_of)):
    zeroth.whole(
        label,
        f"the constant {name} of (37)",
        ["37"],
        left=symbols(name, real=True),
        printed=form(root),
        reading="a fitted number has no truth of its own: it is judged by the H function that it gives; s is the root "
        "of 1 - c",
    )

# --- constants of order 0 -------------------------------------------------------------------------------

for name, index, printed in (
    ("A", 0, 69 * c / 128),
    ("E", 4, Rational(15, 128) * (1 - c) * c * (4 * c / 3 + 3)),
):
    zeroth.measured(
        f"38.{name}",
        f"the constant {name} of the mode of order 0",
        left=ModeConstant(0, index, c),
        printed=printed,
        where=[ALBEDO],
        exact=True,
        along={c: 1 - T**2},
        reading=THREE_TERMS + "; it follows as xsec:lambert-sphere.relation-0 does",
    )

zeroth.whole("38", "the constants A and E of the mode of order 0", ["38.A", "38.E"], left=symbols("A E")[0],
             printed=69 * c / 128)  # fmt: skip

w = 1 - c
B_BELOW = share(d("0.182602"), w) - d("0.665502") * s + d("0.964893")
B_ABOVE = d("0.346689") * w ** Rational(3, 2) - share(d("0.777574"), w)


def c_of(root):
    """(40)."""
    above = -d("5602.45") * w ** Rational(3, 2) + share(d("7487.99"), w) - root * s + d("682.848")
    return above / (share(d("1480.025"), w) - d("4008.33") * s + d("5850.6"))


FITS = {
    "39": ("B", 1, (B_ABOVE + share(d("0.515357"), d("0.084463") * s)) / B_BELOW,
           (B_ABOVE + d("0.515357") * s - d("0.084463")) / B_BELOW, "a minus before 0.084463"),
    "40": ("C", 2, c_of(d("24567.74")), c_of(d("2567.74")), "2567.74 for 24567.74: there is a digit too many"),
    "41": ("D", 3, (d("166.883") * w ** Rational(3, 2) - share(d("327.48"), w) + d("160.397") * s + d("0.285529"))
           / (share(d("596.423"), w) - d("412.984") * s + d("674.191")), None, ""),
    "42": ("F", 5, (d("266.063") * w ** Rational(3, 2) - share(d("21.9141"), w) - d("242.16") * s - d("1.9209"))
           / (share(d("215.773"), w) + d("457.42") * s + d("1499.9")), None, ""),
}  # fmt: skip

for label, (name, index, printed, corrected, edit) in FITS.items():
    zeroth.measured(
        label,
        f"the constant {name} of the mode of order 0",
        left=ModeConstant(0, index, c),
        printed=printed,
        corrected=corrected,
        edit=edit,
        where=[ALBEDO],
        along={c: 1 - T**2},
        reading=THREE_TERMS,
    )

if __name__ == "__main__":
    paper.tell()
    zeroth.tell()
