"""What can be exported by name: the entries of the record that it rests on, and where its source comes from."""

from __future__ import annotations

from dataclasses import dataclass

INTEGRAL = "sigma(u) is the integral over x in [-1, 1] of D(x) sigma_dirac_ring(u, x), with rings of area 2 pi."


@dataclass(frozen=True)
class Recipe:
    """A function of ``module`` (under xsec_sym.kernels), hand-made or, with a ``cell``, generated.

    ``ids`` must all be verified for the function to be exported. ``cell`` is the entry whose form is printed.
    """

    name: str
    summary: str
    ids: tuple[str, ...]
    module: str
    cell: str = ""
    title: str = ""
    about: str = ""
    example: str = ""


def _row(name: str, row: str, distribution: str, about: str, example: str, split: bool = True) -> Recipe:
    cell = f"deon2016:T1.{row}.s"
    return Recipe(
        name,
        f"cross-section of D(x) = {distribution} (Table 1)",
        tuple(f"{cell}.{side}" for side in ("neg", "zero", "pos")) if split else (cell,),
        "table1",
        cell,
        f"Cross-section of D(x) = {distribution}, x = cos theta, a density per steradian, for a viewer at cosine `u`.",
        f"{INTEGRAL} {about}",
        example,
    )


RECIPES = {
    r.name: r
    for r in (
        Recipe(
            "sigma_dirac_ring",
            "cross-section of a Dirac ring of normals",
            tuple(f"deon2016:{n}" for n in ("8.piecewise", "8.piecewise.rest", "9", "10", "11", "12")),
            "dirac_ring",
        ),
        Recipe(
            "sigma_power",
            "cross-section of D(x) = x^p, p = 0 to 200 (Table 1)",
            ("deon2016:T1.even.s", "deon2016:T1.odd.s"),
            "power",
        ),
        _row("sigma_inv1p", "inv1p", "1/(1 + x)",
             "It is infinite for u < 0, where the pole x = -1 of D is in view, and 2 pi at u = 0.",
             "sigma_inv1p([-0.5, 0, 1])"),
        _row("sigma_inv1m", "inv1m", "1/(1 - x)",
             "It is infinite for u > 0, where the pole x = 1 of D is in view, and 2 pi at u = 0.",
             "sigma_inv1m([-1, 0, 0.5])"),
        _row("sigma_inv1m2", "inv1m2", "1/(1 - x)^2",
             "It is infinite for u >= 0, and grows like pi/|u| below.",
             "sigma_inv1m2([-1, -0.5, 0])"),
        _row("sigma_inv1pu2", "inv1pu2", "1/(1 + x^2)",
             "It is finite and even in u.",
             "sigma_inv1pu2([-1, 0, 1])", split=False),
    )
}  # fmt: skip
GENERATED = {"table1": "Cross-sections of the rational distributions of Table 1."}
