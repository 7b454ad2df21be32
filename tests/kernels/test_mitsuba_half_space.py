"""Mitsuba 3 traces paths through a deep slab of Lambertian spheres, as an independent judge of the half-space's BRDF.

It gets the phase function as a table, a sun and a camera, and nothing else of ours: it samples the table, the flights
and the paths by itself. Skipped where it is not installed: the extra `mitsuba`.
"""

import functools

import numpy as np
import pytest
from scipy import stats

from xsec_sym import kernels
from xsec_sym.kernels import HalfSpace, lambert_sphere_coefficients

mitsuba = pytest.importorskip("mitsuba")
MU_I = 0.6
# Cosine and azimuth of what leaves, phi = 0 toward the sun. Exactly there Mitsuba's table ends, and rounding leaves it.
LEAVING = [(1.0, 0.0), (0.6, 0.3), (0.6, np.pi), (0.25, 2.0), (0.8, 1.0), (0.1, np.pi)]
# Mitsuba adds samples up in singles, which loses a thousandth of 2^18 of them: few to a batch.
SAMPLES, BATCHES = 4096, 112
# 30 free paths in a diffusion length of 2.2, there and back: nothing returns from the lower end, nor from the sides.
HALF_DEPTH, HALF_WIDTH = 30.0, 3000.0
# A table's chords leave the phase function by 1e-6 of its largest value.
TABLE = 1025


@pytest.fixture(scope="module", autouse=True)
def scalar_variant():
    mitsuba.set_variant("scalar_rgb")


def described(c, depth):
    """The scene: light that enters the slab's top, and is seen there, without refraction."""
    phase = kernels.phase_lambert_sphere(np.linspace(-1, 1, TABLE))
    scene = {
        "type": "scene",
        "integrator": {"type": "volpath", "max_depth": depth},
        "slab": {
            "type": "cube",
            "to_world": mitsuba.ScalarTransform4f()
            .translate([0, 0, -HALF_DEPTH])
            .scale([HALF_WIDTH, HALF_WIDTH, HALF_DEPTH]),
            "bsdf": {"type": "null"},
            "interior": {
                "type": "homogeneous",
                "albedo": c,
                "sigma_t": 1.0,
                "phase": {"type": "tabphase", "values": ", ".join(f"{value:.9g}" for value in phase)},
            },
        },
        "sun": {"type": "directional", "direction": [-np.sqrt(1 - MU_I**2), 0.0, -MU_I], "irradiance": 1.0},
    }
    for number, (mu, phi) in enumerate(LEAVING):
        seen = np.array([np.sqrt(1 - mu * mu) * np.cos(phi), np.sqrt(1 - mu * mu) * np.sin(phi), mu])
        scene[f"camera {number}"] = {
            "type": "radiancemeter",
            # clear of the edge between the two triangles of the top
            "origin": (3 * seen + [1.7, 0.3, 0.0]).tolist(),
            "direction": (-seen).tolist(),
            "film": {"type": "hdrfilm", "width": 1, "height": 1, "rfilter": {"type": "box"}},
        }
    return mitsuba.load_dict(scene)


@functools.cache
def traced(c, depth=-1):
    """The BRDF in each direction by so many scatterings less one, and its standard error."""
    scene = described(c, depth)
    seeds = np.random.default_rng(12).integers(1, 2**31, (BATCHES, len(LEAVING)))
    batches = np.array(
        [
            [
                np.array(mitsuba.render(scene, sensor=k, spp=SAMPLES, seed=int(seed))).flat[0]
                for k, seed in enumerate(row)
            ]
            for row in seeds
        ]
    )
    return batches.mean(0) / MU_I, batches.std(0, ddof=1) / np.sqrt(BATCHES) / MU_I


def verdict(model, runs):
    """Whether no direction is off by 4 standard errors, nor all together by more than one time in 10^4; and the z."""
    mu, phi = np.array(LEAVING).T
    z = []
    for c, depth in runs:
        mean, error = traced(c, depth)
        z.extend((model(MU_I, mu, phi, c) - mean) / error)
    return bool(np.abs(z).max() < 4 and stats.chi2.sf(np.sum(np.square(z)), len(z)) > 1e-4), np.array(z)


def single(sign):
    def model(mu_i, mu_o, phi, c):
        cosine = mu_i * mu_o + np.sqrt((1 - mu_i**2) * (1 - mu_o**2)) * np.cos(phi)
        return c * kernels.phase_lambert_sphere(sign * cosine) / (mu_i + mu_o)

    return model


def turned(mu_i, mu_o, phi, c):
    """Of spheres that scatter ahead as ours do back."""
    order = np.arange(60)
    half = HalfSpace(lambert_sphere_coefficients(59) * (-1.0) ** order, c)
    many = half.multiple(np.full(mu_o.size, mu_i), mu_o, phi)
    return single(1)(mu_i, mu_o, phi, c) + many


WHOLE = [(0.6, -1), (0.95, -1)]


def test_errors_are_small_enough_to_judge_by():
    for run in [(1.0, 2), *WHOLE]:
        mean, error = traced(*run)
        assert np.all(error < 2.5e-3 * mean)


def test_light_scattered_once_tells_which_way_the_table_runs():
    """From straight back to straight on: the other way round is off by hundreds of standard errors."""
    assert verdict(single(-1), [(1.0, 2)])[0]
    accepted, z = verdict(single(1), [(1.0, 2)])
    assert not accepted and np.abs(z).max() > 100


def test_brdf():
    assert verdict(kernels.brdf_lambert_sphere, WHOLE)[0]


def test_fit():
    """Its error of 4e-5 is beyond what these paths resolve."""
    assert verdict(kernels.brdf_lambert_sphere_fit, WHOLE)[0]


@pytest.mark.parametrize(
    "model",
    [
        lambda mu_i, mu_o, phi, c: kernels.brdf_isotropic(mu_i, mu_o, c),
        kernels.brdf_lambert_sphere_hapke,
        kernels.brdf_lambert_sphere_printed,
        kernels.brdf_lambert_sphere_fast_paper,
        turned,
        lambda mu_i, mu_o, phi, c: kernels.brdf_lambert_sphere(mu_i, mu_o, phi, 0.99 * c),
        lambda mu_i, mu_o, phi, c: kernels.brdf_lambert_sphere(mu_i, mu_o, np.pi - phi, c),
    ],
    ids=["isotropic", "Hapke", "as printed", "fast, of the paper", "turned spheres", "1 % darker", "turned azimuth"],
)
def test_others_are_rejected(model):
    accepted, z = verdict(model, WHOLE)
    assert not accepted and np.abs(z).max() > 6
