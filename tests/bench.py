"""Time and print the project's figures: `python -m tests.bench`. Each section is a function that returns its rows."""

import statistics
import subprocess
import sys
import time
from collections.abc import Callable

import numpy as np

VALUES = 10**6
REPEATS = 15
Row = tuple[str, str, str]


def median_seconds(run: Callable[[], object], repeats: int = REPEATS) -> float:
    """The median time of a call after one that warms caches and tables."""
    run()
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        run()
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def import_rows() -> list[Row]:
    code = (
        "import time; start = time.perf_counter(); import xsec_sym.kernels; "
        "import sys; print(time.perf_counter() - start, 'sympy' in sys.modules or 'mpmath' in sys.modules)"
    )
    runs = [subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True) for _ in range(5)]
    fields = [run.stdout.split() for run in runs]
    symbolic = "with" if any(symbolic == "True" for _, symbolic in fields) else "without"
    seconds = statistics.median(float(duration) for duration, _ in fields)
    return [("import xsec_sym.kernels", f"{1e3 * seconds:.0f} ms", f"{symbolic} SymPy or mpmath")]


def kernel_rows() -> list[Row]:
    from xsec_sym import kernels

    rng = np.random.default_rng(1)
    u, x = rng.uniform(-1, 1, (2, VALUES))
    positive, u32, x32 = np.abs(u), u.astype(np.float32), x.astype(np.float32)
    yardsticks = {
        "copy": median_seconds(u.copy),
        "np.sqrt": median_seconds(lambda: np.sqrt(positive)),
        "np.exp": median_seconds(lambda: np.exp(u)),
        "np.arccos": median_seconds(lambda: np.arccos(u)),
    }
    yardsticks["np.arccos + np.sqrt"] = median_seconds(lambda: np.arccos(u) + np.sqrt(positive))
    runs: dict[str, Callable[[], object]] = {
        "sigma_dirac_ring": lambda: kernels.sigma_dirac_ring(u, x),
        "sigma_dirac_ring, float32": lambda: kernels.sigma_dirac_ring(u32, x32),
        "sigma_power, p = 2": lambda: kernels.sigma_power(u, 2),
        "sigma_power, p = 20": lambda: kernels.sigma_power(u, 20),
        "sigma_power, p = 200": lambda: kernels.sigma_power(u, 200),
    }
    rows = [(name, f"{1e9 * seconds / VALUES:.2f} ns/value", "") for name, seconds in yardsticks.items()]
    for name, run in runs.items():
        seconds = median_seconds(run)
        ratios = ", ".join(f"{seconds / yardsticks[key]:.1f} x {key}" for key in ("np.exp", "np.arccos + np.sqrt"))
        rows.append((name, f"{1e9 * seconds / VALUES:.2f} ns/value", ratios))
    return rows


def lobe_rows() -> list[Row]:
    """The four distributions, with an array of roughnesses as long as that of cosines, and with a single one."""
    from xsec_sym import kernels

    rng = np.random.default_rng(2)
    u, shape = rng.uniform(-1, 1, VALUES), rng.uniform(0.1, 1, VALUES)
    exp, copy = median_seconds(lambda: np.exp(u)), median_seconds(u.copy)
    rows = [(name, f"{1e9 * seconds / VALUES:.2f} ns/value", "") for name, seconds in (("np.exp", exp), ("copy", copy))]
    names = [f"{quantity}_{name}" for name in ("beckmann", "ggx") for quantity in ("sigma", "lambda", "ndf")]
    names += ["sigma_ellipsoidal", "ndf_ellipsoidal", "ndf_spherical_gaussian"]
    for name in names:
        kernel: Callable[..., object] = getattr(kernels, name)
        cosine = np.abs(u) if name.startswith("lambda") else u
        arguments = {
            "": (cosine, shape),
            ", one roughness": (cosine, 0.3),
            ", float32": (cosine.astype(np.float32), shape.astype(np.float32)),
        }
        for remark, pair in arguments.items():
            seconds = median_seconds(lambda kernel=kernel, pair=pair: kernel(*pair))
            ratios = f"{seconds / exp:.1f} x np.exp, {seconds / copy:.1f} x copy"
            rows.append((name + remark, f"{1e9 * seconds / VALUES:.2f} ns/value", ratios))
    return rows


def spherical_gaussian_rows() -> list[Row]:
    """Its cross-section: roughnesses of [1e-4, 1e4] by their logarithm, of (0.1, 1), and few values.

    Each figure is the median of ratios to scipy.special.i0e, timed in turn with it, times the median of that.
    """
    from scipy import special

    from xsec_sym import kernels

    rng = np.random.default_rng(6)
    u, alpha, usual = rng.uniform(-1, 1, VALUES), 10 ** rng.uniform(-4, 4, VALUES), rng.uniform(0.1, 1, VALUES)
    single = u.astype(np.float32), alpha.astype(np.float32)
    runs: dict[str, Callable[[], object]] = {
        "copy": u.copy,
        "np.exp": lambda: np.exp(u),
        "special.erf": lambda: special.erf(u),
        "special.i0e": lambda: special.i0e(u),
        "sigma_spherical_gaussian": lambda: kernels.sigma_spherical_gaussian(u, alpha),
        "log_sigma_spherical_gaussian": lambda: kernels.log_sigma_spherical_gaussian(u, alpha),
        "scaled_sigma_spherical_gaussian": lambda: kernels.scaled_sigma_spherical_gaussian(u, alpha),
        "sigma_spherical_gaussian, fast": lambda: kernels.sigma_spherical_gaussian(u, alpha, "fast"),
        "sigma_spherical_gaussian, float32": lambda: kernels.sigma_spherical_gaussian(*single),
        "the same, alpha in (0.1, 1)": lambda: kernels.sigma_spherical_gaussian(u, usual),
        "the same, alpha in (0.1, 1), fast": lambda: kernels.sigma_spherical_gaussian(u, usual, "fast"),
    }
    for tol in (5e-16, None, 1e-7):
        sigma = kernels.specialize_spherical_gaussian(0.3, tol)
        runs[f"specialize_spherical_gaussian(0.3, {tol})"] = lambda sigma=sigma: sigma(u)
    times: dict[str, list[float]] = {name: [] for name in runs}
    for turn in range(REPEATS + 1):
        for name, run in runs.items():
            start = time.perf_counter()
            run()
            if turn:
                times[name].append(time.perf_counter() - start)
    rows = []
    for name, seconds in times.items():
        ratio = statistics.median(a / b for a, b in zip(seconds, times["special.i0e"], strict=True))
        figure = 1e9 * statistics.median(seconds) / VALUES
        rows.append((name, f"{figure:.2f} ns/value", f"{ratio:.2f} x special.i0e"))
    for n in (1, 1000):
        few = (-0.3, 0.3) if n == 1 else (u[:n], alpha[:n])
        seconds = median_seconds(lambda few=few: kernels.sigma_spherical_gaussian(*few), 200)
        rows.append((f"sigma_spherical_gaussian, {n} values a call", f"{1e6 * seconds:.0f} us/call", ""))
    return rows


def half_space_rows() -> list[Row]:
    """H and the BRDF of isotropic scattering, with an array of albedos as long as that of cosines, and with one."""
    from xsec_sym import kernels

    rng = np.random.default_rng(3)
    mu, other, c = rng.uniform(0, 1, (3, VALUES))
    exp = median_seconds(lambda: np.exp(mu))
    rows = [("np.exp", f"{1e9 * exp / VALUES:.2f} ns/value", "")]
    runs: dict[str, Callable[[], object]] = {
        "h_isotropic": lambda: kernels.h_isotropic(mu, c),
        "h_isotropic, one albedo": lambda: kernels.h_isotropic(mu, 0.9),
        "brdf_isotropic": lambda: kernels.brdf_isotropic(mu, other, c),
        "brdf_isotropic, one albedo": lambda: kernels.brdf_isotropic(mu, other, 0.9),
    }
    for name, run in runs.items():
        seconds = median_seconds(run, 5)
        rows.append((name, f"{1e9 * seconds / VALUES:.2f} ns/value", f"{seconds / exp:.1f} x np.exp"))
    return rows


def _priced(runs: dict[str, Callable[[], object]], values: int, repeats: int = REPEATS) -> list[Row]:
    """A row for each run of so many values, beside np.exp of as many and their copy."""
    numbers = np.random.default_rng(4).uniform(0, 1, values)
    yardsticks: dict[str, Callable[[], object]] = {"np.exp": lambda: np.exp(numbers), "copy": numbers.copy}
    costs = {name: median_seconds(run) for name, run in yardsticks.items()}
    rows = [(f"{name}, {values:,} values", f"{1e9 * cost / values:.2f} ns/value", "") for name, cost in costs.items()]
    for name, run in runs.items():
        seconds = median_seconds(run, repeats)
        ratios = ", ".join(f"{seconds / cost:.1f} x {yardstick}" for yardstick, cost in costs.items())
        rows.append((name, f"{1e9 * seconds / values:.2f} ns/value", ratios))
    return rows


def lambert_sphere_rows() -> list[Row]:
    """Spheres and their half-space, with an array of albedos as long as that of cosines unless one is mentioned."""
    from xsec_sym import kernels
    from xsec_sym.kernels._support import elementwise

    def paper_albedo(c: np.ndarray) -> np.ndarray:
        s = np.sqrt(1.0 - c)
        return (1.0 - 0.453029 * (1.0 - c) - 0.544162 * s) / (1.42931 * s + 1.0)

    rng = np.random.default_rng(7)
    mu, other, c = rng.uniform(0, 1, (3, VALUES))
    u, phi = rng.uniform(-1, 1, VALUES), rng.uniform(-np.pi, np.pi, VALUES)
    runs: dict[str, Callable[[], object]] = {
        "phase_lambert_sphere": lambda: kernels.phase_lambert_sphere(u),
        "sample_lambert_sphere": lambda: kernels.sample_lambert_sphere(mu),
        "h_lambert_sphere, one albedo": lambda: kernels.h_lambert_sphere(mu, 0.9, 0),
        "h_lambert_sphere_fit": lambda: kernels.h_lambert_sphere_fit(mu, c, 0),
        "albedo_lambert_sphere": lambda: kernels.albedo_lambert_sphere(c),
        "albedo_lambert_sphere_fit": lambda: kernels.albedo_lambert_sphere_fit(c),
        "deon2021:47, in the same blocks": lambda: elementwise(paper_albedo, c=c),
        "albedo_lambert_sphere_inverse": lambda: kernels.albedo_lambert_sphere_inverse(c),
        "albedo_lambert_sphere_inverse_fit": lambda: kernels.albedo_lambert_sphere_inverse_fit(c),
    }
    for name in ("fit", "fast", "paper", "fast_paper", "hapke"):
        brdf: Callable[..., object] = getattr(kernels, f"brdf_lambert_sphere_{name}")
        runs[f"brdf_lambert_sphere_{name}"] = lambda brdf=brdf: brdf(mu, other, phi, c)
        runs[f"brdf_lambert_sphere_{name}, one albedo"] = lambda brdf=brdf: brdf(mu, other, phi, 0.9)
    rows = _priced(runs, VALUES, 5)

    def exact(albedo: float, values: int) -> Callable[[], object]:
        return lambda: kernels.brdf_lambert_sphere(mu[:values], other[:values], phi[:values], albedo)

    # Few values are given without tables.
    for what, values in {"solved": 1, "with tables": VALUES // 100}.items():
        times = []
        for albedo in (0.21, 0.52, 0.83):
            start = time.perf_counter()
            exact(albedo + 0.001 * (values == 1), values)()
            times.append(time.perf_counter() - start)
        rows.append((f"brdf_lambert_sphere, a new albedo {what}", f"{1e3 * statistics.median(times):.0f} ms", ""))
    for values in (VALUES, VALUES // 1000):
        rows += _priced({f"brdf_lambert_sphere, {values:,} of one albedo": exact(0.83, values)}, values, 3)
    several = VALUES // 100
    return rows + _priced({"h_lambert_sphere": lambda: kernels.h_lambert_sphere(mu[:several], c[:several], 0)}, several)


def sampler_rows() -> list[Row]:
    """Visible normals: each with a viewer and a roughness of its own, and many for one pair; set-up is part of it."""
    from xsec_sym import kernels

    rng = np.random.default_rng(8)
    n = VALUES // 10
    u, alpha, x, y = rng.uniform(0, 1, (4, n))
    normals = kernels.sample_visible_ggx(u, alpha, x, y)
    runs: dict[str, Callable[[], object]] = {
        "visible_ggx": lambda: kernels.visible_ggx(*normals, u, alpha),
        "visible_spherical_gaussian": lambda: kernels.visible_spherical_gaussian(*normals, u, alpha),
        "sample_visible_ggx": lambda: kernels.sample_visible_ggx(u, alpha, x, y),
        "sample_visible_ggx, one pair": lambda: kernels.sample_visible_ggx(0.3, 0.5, x, y),
        "sample_visible_spherical_gaussian": lambda: kernels.sample_visible_spherical_gaussian(u, alpha, rng),
        "sample_visible_spherical_gaussian, one pair": lambda: kernels.sample_visible_spherical_gaussian(
            0.3, 0.5, rng, n
        ),
    }
    return _priced(runs, n, 3)


def vector_rows() -> list[Row]:
    """The squared lobes, with arrays of roughnesses and with single ones, and Smith's functions of Lambda."""
    from xsec_sym import kernels

    rng = np.random.default_rng(3)
    vectors = rng.normal(size=(3, VALUES))
    x, y, z = vectors / np.sqrt((vectors * vectors).sum(axis=0))
    a, b, lam_i, lam_o = rng.uniform(0.01, 1, (4, VALUES))
    exp, copy = median_seconds(lambda: np.exp(z)), median_seconds(z.copy)
    rows = [(name, f"{1e9 * seconds / VALUES:.2f} ns/value", "") for name, seconds in (("np.exp", exp), ("copy", copy))]
    runs: dict[str, tuple[object, ...]] = {
        "ssl": (z, a),
        "ssl, one roughness": (z, 0.3),
        "sel": (x, y, z, a, b),
        "sel, one pair of roughnesses": (x, y, z, 0.3, 0.1),
        "smith_g1": (lam_i,),
        "smith_g2": (lam_i, lam_o),
        "smith_g2_given_g1": (lam_i, lam_o),
    }
    for name, arguments in runs.items():
        kernel: Callable[..., object] = getattr(kernels, name.partition(",")[0])
        single = [np.float32(part) if isinstance(part, float) else part.astype(np.float32) for part in arguments]
        for remark, values in {"": arguments, ", float32": single}.items():
            seconds = median_seconds(lambda kernel=kernel, values=values: kernel(*values))
            ratios = f"{seconds / exp:.1f} x np.exp, {seconds / copy:.1f} x copy"
            rows.append((name + remark, f"{1e9 * seconds / VALUES:.2f} ns/value", ratios))
    return rows


def cross_section_rows() -> list[Row]:
    from xsec_sym.kernels import cross_section

    u = np.linspace(-1, 1, 2001)
    rows = []
    for name, ndf in {
        "exp": np.exp,
        "a narrow lobe": lambda x: np.exp(5000 * (x - 1)),
        "a step": lambda x: x > 0.3,
    }.items():
        seconds = median_seconds(lambda ndf=ndf: cross_section(ndf)(u), 3)
        rows.append((f"cross_section of {name}", f"{1e6 * seconds / u.size:.0f} us/value", f"{u.size} directions"))
    return rows


def command_rows() -> list[Row]:
    """Whole commands, on all processors: everything derived anew, and the recorded proofs replayed.

    The second is a replay only while the record is that of the code at hand: see that it says "as recorded".
    """
    rows = []
    for words in (["verify", "--fresh"], ["verify"]):
        start = time.perf_counter()
        done = subprocess.run([sys.executable, "-m", "xsec_sym.cli", *words], capture_output=True, text=True)
        seconds = time.perf_counter() - start
        said = "as recorded" if done.returncode == 0 else f"exit {done.returncode}"
        rows.append((f"xsec {' '.join(words)}", f"{seconds:.1f} s", said))
    return rows


SECTIONS: list[Callable[[], list[Row]]] = [
    import_rows,
    kernel_rows,
    lobe_rows,
    spherical_gaussian_rows,
    half_space_rows,
    lambert_sphere_rows,
    sampler_rows,
    vector_rows,
    cross_section_rows,
    command_rows,
]


def main() -> None:
    for section in SECTIONS:
        for name, figure, remark in section():
            print(f"{name:46}{figure:>18}   {remark}".rstrip(), flush=True)


if __name__ == "__main__":
    main()
