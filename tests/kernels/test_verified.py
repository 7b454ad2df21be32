"""The hand-made kernels against the very expressions that the record holds as verified, at 50 digits."""

from __future__ import annotations

import numpy as np
import pytest
from mpmath import mp, mpf
from sympy import Integral, Symbol, lambdify, pi, symbols

from xsec_sym import kernels, ledger

u, u_i, alpha, b = symbols("u u_i alpha b", real=True)

# kernel -> (entry, factor that turns the entry's normalisation into the kernel's, names of its arguments)
VERIFIED = {
    "sigma_beckmann": ("deon2016:22", 1, "u", "alpha"),
    "sigma_ggx": ("deon2016:25", 1, "u", "alpha"),
    "sigma_ellipsoidal": ("deon2016:27.2", 1 / (2 * pi), "u", "b"),
    "sigma_spherical_gaussian": ("xsec:sg-integral", 1, "u", "alpha"),
    "lambda_beckmann": ("xsec:smith.beckmann.lambda", 1, "u", "alpha"),
    "lambda_ggx": ("xsec:smith.ggx.lambda", 1, "u", "alpha"),
}
ROUGH = {"alpha": (0.07, 0.3, 1.0, 2.5), "b": (0.05, 0.5, 0.95, 0.999)}


def verified(name):
    entry, factor, *arguments = VERIFIED[name]
    form = ledger[entry].form * factor
    found = {s.name.replace("_i", ""): s for s in form.free_symbols}
    return lambdify([found[a] for a in arguments], form, "mpmath"), arguments[1]


@pytest.mark.parametrize("name", VERIFIED)
def test_the_kernel_is_the_verified_expression(name):
    assert ledger[VERIFIED[name][0]].verdict in ("proved", "misprint")
    reference, roughness = verified(name)
    seen = (0.03, 0.4, 0.97) if name.startswith("lambda") else (-0.97, -0.4, -0.03, 0.03, 0.4, 0.97)
    integral = name.endswith("gaussian")  # dear at many digits, so at fewer points
    for rough in ROUGH[roughness][integral:]:
        for cosine in seen[:: 2 if integral else 1]:
            got = float(getattr(kernels, name)(cosine, rough))
            with mp.workdps(60 if integral else 400):
                want = reference(mpf(cosine), mpf(rough))
            if abs(want) > 1e-290:
                assert abs(mpf(got) / want - 1) < (16 if integral else 8) * mpf(2) ** -52, (cosine, rough)


SLOPES = ((-0.6, 0.3), (0.0, 0.8), (1e-3, -2e-3), (1e-9, 1e-8))


def lobe(entry, *arguments):
    """The entry's form as a function of these of its symbols."""
    form = ledger[f"tokuyoshi_harada:{entry}"].form
    found = {s.name.replace("v_", ""): s for s in form.free_symbols}
    assert sorted(found) == sorted(arguments)
    return lambdify([found[a] for a in arguments], form, "mpmath")


def near(got, want):
    return abs(mpf(float(got)) / want - 1) < 8 * mpf(2) ** -52


@pytest.mark.parametrize("entry", ["K.E", "K.U"])
def test_the_ellipsoidal_lobe_is_the_verified_expression(entry):
    assert ledger[f"tokuyoshi_harada:{entry}"].verdict == "proved"
    reference = lobe(entry, "x", "y", "z", "alpha_x", "alpha_y")
    for x, y in SLOPES:
        for z in (np.sqrt((1 - np.hypot(x, y)) * (1 + np.hypot(x, y))) * side for side in (1, -1)):
            for rough in ((1e-8, 1e-8), (1e-8, 0.5), (0.4, 0.03), (1.0, 1.0)):
                with mp.workdps(400):
                    assert near(kernels.sel(x, y, z, *rough), reference(*map(mpf, map(float, (x, y, z, *rough)))))


def test_the_spheroidal_lobe_is_the_verified_expression():
    assert ledger["tokuyoshi_harada:ssl"].verdict == "proved"
    reference = lobe("ssl", "theta", "alpha")
    for m in (-1.0, -0.4, 0.03, 0.97, 1 - 1e-9, 1.0):
        for rough in (1e-8, 1e-3, 0.3, 1.0):
            with mp.workdps(400):
                assert near(kernels.ssl(m, rough), reference(mp.acos(mpf(m)), mpf(rough)))


@pytest.mark.parametrize(("name", "entry"), [("smith_g1", "20.4"), ("smith_g2", "21.4"), ("smith_g2_given_g1", "22.3")])
def test_smith_is_the_verified_expression(name, entry):
    assert ledger[f"dupuy2016:{entry}"].verdict == "proved"
    form = ledger[f"dupuy2016:{entry}"].form
    names = sorted(form.free_symbols, key=lambda s: s.name)  # Lambda_i before Lambda_o
    reference = lambdify(names, form, "mpmath")
    for pair in ((0.0, 0.3), (1e-12, 1e-9), (0.7, 0.2), (3e5, 1e9), (1e200, 7.0)):
        lam = pair[: len(names)]
        with mp.workdps(400):
            assert near(getattr(kernels, name)(*lam), reference(*map(mpf, lam)))


def test_the_isotropic_half_space_is_the_verified_expression():
    """`dupuy2016:31` as it is printed, integrated anew; the kernel rests on another integral."""
    assert {ledger[f"dupuy2016:{label}"].verdict for label in ("30", "31")} == {"confirmed"}
    form = ledger["dupuy2016:31"].form
    a, cosine = sorted(form.free_symbols, key=lambda s: s.name)
    (integral,) = form.atoms(Integral)
    t, value = integral.limits[0][0], Symbol("value")
    integrand = lambdify([t, cosine, a], integral.function, "mpmath")
    whole = lambdify([cosine, a, value], form.xreplace({integral: value}), "mpmath")
    for mu in (0.05, 0.6, 1.0):
        for c in (0.2, 0.9):
            with mp.workdps(30):
                area = mp.quad(lambda at: integrand(at, mpf(mu), mpf(c)), [mpf(0), mp.pi / 4, mp.pi / 2])
                want = whole(mpf(mu), mpf(c), area)
                assert abs(mpf(float(kernels.h_isotropic(mu, c))) / want - 1) < mpf(10) ** -14


def test_the_table_of_kernels_is_complete():
    made = {n for n in kernels.__all__ if n.startswith(("sigma_", "lambda_"))}
    assert set(VERIFIED) <= made
    assert {f"{k}_{d}" for k, d in (("sigma", "beckmann"), ("sigma", "ggx"), ("sigma", "ellipsoidal"))} <= set(VERIFIED)


def test_single_precision_of_the_spherical_gaussian():
    """8 ulp are promised of what is computed in single precision."""
    generator = np.random.default_rng(5)
    cosine = generator.uniform(-1, 1, 400).astype(np.float32)
    rough = np.exp(generator.uniform(np.log(0.05), np.log(50), 400)).astype(np.float32)
    single = kernels.sigma_spherical_gaussian(cosine, rough)
    double = kernels.sigma_spherical_gaussian(cosine.astype(float), rough.astype(float))
    normal = double > np.finfo(np.float32).tiny
    assert single.dtype == np.float32
    assert np.all(np.abs(single[normal] - double[normal]) <= 8 * np.spacing(single[normal]))
