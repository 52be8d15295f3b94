"""Blades that are not smooth: stations, masses inside the span, steps; and real ones."""

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq

from analytic import (
    Blade,
    Damping,
    Gravity,
    Section,
    SpinUp,
    Theory,
    TipForce,
    damping_ratios,
    forced_response,
    linear_modes,
    periodic_orbits,
    reduced_model,
    residual_amplitude,
    spin_up_response,
)
from analytic.exact.continuum.planar_rotation import resolved_model
from analytic.exact.continuum.rotation import rotating_blade
from analytic.shape_functions import shape_functions
from rotbeam_exu.files.beam_file import load_beam
from tests.beams import UNIT

NREL = Path(__file__).parents[2] / "models" / "blades" / "nrel_5mw_edgewise.toml"


@pytest.fixture(scope="module")
def nrel():
    return load_beam(NREL)


def blade_of(mass, bending, axial):
    section = Section(axial_stiffness=axial, bending_stiffness=bending, mass_per_length=mass)
    return Blade(length=1.0, section=section, hub_radius=0.3).with_point_mass(0.1, 0.6)


def answers(blade):
    """Numbers of as many public functions as take a blade, by name."""
    w, time = 1.5 * blade.frequency_scale, np.linspace(0.0, 2.0, 5)
    damped = blade.with_damping(Damping(external=0.5))
    motion = SpinUp(omega=w, ramp_time=1.5)
    yield "at rest", blade.frequencies_at_rest[:8]
    yield "burst", blade.burst_speed
    yield "mass", blade.mass
    yield "modes", linear_modes(blade, w).frequencies
    yield "inextensible modes", linear_modes(blade, w, theory=Theory(extension=False)).frequencies
    yield "ratio", Damping.from_ratio(blade, 3, 0.01).bending
    yield "ratios", damping_ratios(damped, w, 2)
    for name in ("FrM", "FrC"):
        yield name, [reduced_model(blade, w, name).omega_n, reduced_model(blade, w, name).g2]
    orbits = periodic_orbits(blade, w, [0.1, 0.3])
    yield "orbits", orbits.frequency
    yield "λ", 1.0 + orbits.lambda_omega
    yield "inextensible", periodic_orbits(blade, w, [0.2], theory=Theory(extension=False)).frequency
    yield "forced", forced_response(damped, w, TipForce(amplitude=0.05), [2.0, 2.5]).amplitude[0]
    yield "gravity", forced_response(damped, [0.5 * w, 0.6 * w], Gravity(0.1)).amplitude[0]
    yield "spin-up", spin_up_response(blade, motion, time, tolerance=1e-6).q[-1]
    yield "left", residual_amplitude(blade, motion, [1.5, 2.5])


@pytest.mark.filterwarnings("ignore::analytic.input_checks.RotbeamWarning")
@pytest.mark.parametrize("count", [30, pytest.param(200, marks=pytest.mark.slow)])
def test_no_answer_depends_on_where_the_section_is_cut(count):
    """A random straight taper, and the same with mass, EI and EA at random stations.

    Frequencies were once 1e-3 off with 21 stations, at any number of functions.
    """
    random = np.random.default_rng(count)
    tapers = random.uniform(0.4, 1.6, (3, 2)) * [[1.0], [1.0], [1e6]]
    x = np.concatenate(([0.0], np.sort(random.uniform(0.0, 1.0, count - 2)), [1.0]))
    whole = blade_of(*((root, tip - root) for root, tip in tapers.tolist()))
    cut = blade_of(*(
        tuple(zip(x.tolist(), (root + (tip - root) * x).tolist(), strict=True))
        for root, tip in tapers.tolist()
    ))  # fmt: skip
    for (name, one), (_, other) in zip(answers(whole), answers(cut), strict=True):
        assert other == pytest.approx(one, rel=1e-9), name


def test_a_real_blade_needs_no_more_functions_than_a_uniform_one(nrel):
    exact = linear_modes(nrel, 1.267, 1, theory=Theory(extension=False), functions=60).frequencies
    six = resolved_model(nrel, 1, Theory(extension=False), 6)
    found = rotating_blade(nrel, 1.267, six).vibration[0][:1] * nrel.frequency_scale
    # As docs/theory/continuum.md says.
    assert found == pytest.approx(exact, rel=2e-8)
    # Half of 24 functions' frequencies, as the docstring promises.
    uniform = linear_modes(nrel, 0.0, 12, theory=Theory(extension=False), functions=60).frequencies
    assert nrel.frequencies_at_rest[:12] == pytest.approx(uniform, rel=2e-3)
    assert nrel.omega_0 == pytest.approx(uniform[0], rel=1e-9)


@pytest.mark.filterwarnings("ignore:FrM is inextensible:analytic.input_checks.RotbeamWarning")
def test_a_real_blade_answers_to_every_kind_of_question(nrel):
    """Respond asked for more damping in vain; an orbit took a minute."""
    damped = nrel.with_damping(Damping(external=5.0))
    sag = forced_response(damped, [0.6, 1.0, 1.6], Gravity())
    # Slow against 6.9 rad/s: nearly the static deflection, and stiffened the more by rotation.
    assert 0.005 < sag.amplitude[0] < 0.008
    assert forced_response(damped, 1.267, TipForce(amplitude=1000.0), [6.0, 8.0]).peaks
    orbits = periodic_orbits(nrel, 1.267, [0.1, 0.2])
    assert orbits.frequency_error.max() < 1e-9
    frm = reduced_model(nrel, 1.267, "FrM")
    inextensible = periodic_orbits(nrel, 1.267, [0.02], theory=Theory(extension=False))
    assert frm.lambda_omega == pytest.approx(inextensible.lambda_omega, abs=1e-6)
    motion = SpinUp(omega=1.267, ramp_time=3.0)
    end = spin_up_response(nrel, motion, [2.0, 4.0], tolerance=1e-6)
    assert end.error < 1e-6


def test_functions_are_orthonormal_and_begin_with_the_smaller_set(nrel):
    for stiffness in ("bending", "axial"):
        small, large = (shape_functions(nrel.unit, n, stiffness) for n in (8, 13))
        x, weights = nrel.unit.quadrature(40)
        profile = np.interp(x, *np.array(getattr(nrel.unit, stiffness)).T)
        strains = large.strain(x)
        gram = strains.T @ ((weights * profile)[:, None] * strains)
        assert gram == pytest.approx(np.eye(13), abs=1e-9)
        assert small.strain(x) == pytest.approx(strains[:, :8], abs=1e-9)
        # Integrals are those of the strains, and strains have the slopes that are told.
        h = 1e-5
        at = np.array([0.111, 0.43, 0.77, 0.97])
        rate = (large.once(at + h) - large.once(at - h)) / (2.0 * h)
        assert rate == pytest.approx(large.strain(at), rel=1e-4, abs=1e-4)
        twice = (large.twice(at + h) - large.twice(at - h)) / (2.0 * h)
        assert twice == pytest.approx(large.once(at), rel=1e-4, abs=1e-5)
    slope = (large.strain(at + h) - large.strain(at - h)) / (2.0 * h)
    assert large.elongation_slope(at) == pytest.approx(slope, rel=1e-4, abs=1e-3)


def test_refinement_adds_functions_on_every_panel():
    """With a mass in each twentieth refinement once added nothing, and so confirmed itself."""
    blade = blade_of(1.0, 1.0, 1e9)
    for k in range(1, 20):
        blade = blade.with_point_mass(0.05, k / 20.0)
    coarse, fine = (
        linear_modes(blade, 1.0, theory=Theory(extension=False), functions=n) for n in (6, 120)
    )
    assert coarse.frequencies == pytest.approx(fine.frequencies, rel=1e-8)
    at_rest = linear_modes(blade, 0.0, 1, theory=Theory(extension=False)).frequencies[0]
    assert blade.omega_0 == pytest.approx(at_rest, rel=1e-7)


def shot(pieces, jumps):
    """First frequencies at rest of pieces (length, EI), with a mass and inertia at their ends.

    By transfer matrices of the exact solutions, cos and cosh, which share nothing with polynomials.
    """

    def determinant(w):
        state = np.eye(4)[:, 2:]  # v, v', moment and shear: the last two are free at the clamp
        for (length, EI), (mass, inertia) in zip(pieces, jumps, strict=True):
            b = (w**2 / EI) ** 0.25
            s, c, sh, ch = (
                f(b * length) for f in (math.sin, math.cos, math.sinh, math.cosh)
            )  # fmt: skip
            even, odd = 0.5 * (ch + c), 0.5 * (sh + s)
            curve, twist = 0.5 * (ch - c), 0.5 * (sh - s)
            piece = np.array(
                [
                    [even, odd / b, curve / (EI * b**2), twist / (EI * b**3)],
                    [b * twist, even, odd / (EI * b), curve / (EI * b**2)],
                    [EI * b**2 * curve, EI * b * twist, even, odd / b],
                    [EI * b**3 * odd, EI * b**2 * curve, b * twist, even],
                ]
            )
            jump = np.eye(4)
            jump[3, 0], jump[2, 1] = mass * w**2, -inertia * w**2
            state = jump @ piece @ state
        return np.linalg.det(state[2:])

    grid = np.arange(0.2, 70.0, 0.05)
    signs = np.sign([determinant(w) for w in grid])
    roots = np.flatnonzero(signs[1:] != signs[:-1])
    return [brentq(determinant, grid[i], grid[i + 1], xtol=1e-13) for i in roots]


@pytest.mark.parametrize(("mass", "inertia"), [(0.1, 0.0), (0.3, 0.02), (2.0, 0.0)])
def test_a_mass_inside_the_span_is_met_to_all_digits(mass, inertia):
    exact = shot([(0.37, 1.0), (0.63, 1.0)], [(mass, inertia), (0.0, 0.0)])
    blade = UNIT.with_point_mass(mass, 0.37, inertia)
    found = linear_modes(blade, 0.0, len(exact), theory=Theory(extension=False)).frequencies
    assert found == pytest.approx(exact, rel=1e-9)
    assert blade.omega_0 == pytest.approx(exact[0], rel=1e-12)
    assert reduced_model(blade, 0.0, "FrM").omega_n == pytest.approx(exact[0], rel=1e-10)


def test_a_step_of_the_section_is_the_limit_of_a_steep_slope():
    exact = shot([(0.5, 1.0), (0.5, 0.4)], [(0.0, 0.0)] * 2)
    errors = []
    for width in (2e-3, 1e-3):
        ends = ((0.0, 1.0), (0.5 - 0.5 * width, 1.0), (0.5 + 0.5 * width, 0.4), (1.0, 0.4))
        section = Section(axial_stiffness=1e9, mass_per_length=1.0, bending_stiffness=ends)
        stepped = Blade(length=1.0, section=section)
        found = linear_modes(stepped, 0.0, 3, theory=Theory(extension=False)).frequencies
        errors.append(np.abs(found / exact[:3] - 1.0).max())
    # The slope's compliance is off by the order of its width.
    assert errors[0] < 2e-3
    assert errors[0] / errors[1] == pytest.approx(2.0, abs=0.05)


@pytest.mark.parametrize("at", [0.5, 0.37])
def test_two_stations_at_one_place_are_a_step(at):
    exact = shot([(at, 1.0), (1.0 - at, 0.4)], [(0.0, 0.0)] * 2)[:3]
    ends, EI = [0.0, at, at, 1.0], np.array([1.0, 1.0, 0.4, 0.4])
    section = Section(
        axial_stiffness=1e9, mass_per_length=1.0, bending_stiffness=list(zip(ends, EI, strict=True))
    )
    planar = Blade(length=1.0, section=section)
    found = linear_modes(planar, 0.0, 3, theory=Theory(extension=False)).frequencies
    assert found == pytest.approx(exact, rel=2e-8)  # the step is 1e-9 wide, where EI is less

    # In space the round section has each of these frequencies twice, but for its stretch.
    stiffness = np.stack([np.full(4, 1e9)] * 3 + [EI] * 3, axis=1)
    blade = Blade.from_stations(ends, stiffness, [[1.0, 1e-9, 5e-10, 5e-10]] * 4)
    pairs = linear_modes(blade, 0.0, 6, tolerance=1e-8).frequencies
    assert pairs == pytest.approx(np.repeat(exact, 2), rel=1e-7)


def test_softening_with_a_mass_inside_is_that_of_the_orbits():
    blade = UNIT.with_point_mass(0.3, 0.6).with_hub_radius(0.5)
    frm = reduced_model(blade, 3.0, "FrM")
    exact = periodic_orbits(blade, 3.0, [0.02], theory=Theory(extension=False))
    assert frm.lambda_omega == pytest.approx(exact.lambda_omega, abs=1e-6)
