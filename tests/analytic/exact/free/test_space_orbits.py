"""Free periodic orbits of blades in space: known numbers, the plane, conservation, refusals."""

import math

import numpy as np
import pytest

from analytic import (
    AmplitudeNotReachedError,
    Theory,
    TipForce,
    backbone,
    forced_response,
    linear_modes,
    periodic_orbits,
    steady_state,
)
from analytic.exact.continuum.discretization import space_continuum
from analytic.exact.continuum.rotation import rotating_blade
from analytic.exact.linear.families import modes_of, orbit_shapes
from tests.beams import told, unit_beam

SOLID = Theory(extension=False, trapeze=False, rotary_inertia=True)
BLADE = unit_beam(1e-4).with_section_out_of_plane(1.0 / 16.0, 0.08)


def twisted(degrees):
    return BLADE.with_twist(math.radians(degrees)) if degrees else BLADE


@pytest.mark.parametrize(
    ("twist", "omega", "linear", "softening"),
    [
        (30.0, 1.0, 1.394601723, 0.438884),
        (30.0, 2.0, 2.308588441, -0.253500),
        (0.0, 1.0, 1.396221420, 0.371572),
        (0.0, 2.0, 2.314159324, -0.313112),
    ],
)
def test_the_softening_of_flap_in_space(twist, omega, linear, softening):
    """By another code; between the two speeds is the pole where lag is twice flap."""
    found = periodic_orbits(twisted(twist), omega, [0.05], mode="flap 1", theory=SOLID)
    assert found.omega_n == pytest.approx(linear, abs=6e-10)
    # Half of the sixth decimal, and a bound of 1e-7.
    assert found.lambda_omega == pytest.approx(softening, abs=6e-7)
    assert found.lambda_omega_error < 1e-5
    assert found.frequency_error.max() < 1e-9


@pytest.mark.parametrize(
    ("blade", "gauge", "reversible"),
    [
        (twisted(30.0), "flap", True),
        (BLADE.with_precone(0.1), "lag", True),
        (BLADE.with_precone(0.1), "flap", False),
        (twisted(30.0).with_precone(0.1), "lag", False),
    ],
)
def test_orbits_grow_out_of_free_vibration_with_the_tip_in_the_sine(blade, gauge, reversible):
    """K + iΩC - Ω²M of each shape, and its gauge sin φ; as far as modes are resolved, all."""
    steady = rotating_blade(blade, 1.5, space_continuum(blade, SOLID, 6), gauge)
    modes = modes_of(blade, 1.5, SOLID, steady)
    frequencies, shapes = modes.frequencies / blade.frequency_scale, orbit_shapes(modes)
    assert modes.names[:2] == ("flap 1", "lag 1")
    assert (steady.odd is not None) == reversible
    if reversible:
        shapes = np.where(steady.odd, -1j, 1.0) * shapes
    _, K, C, M = (part[0] for part in steady.linearized)
    gradient = steady.gauge_gradient(steady.equilibrium[None])[0]
    for w, shape in zip(frequencies[:4], shapes[:4], strict=True):
        work = (K + 1j * w * C - w**2 * M) @ shape
        assert np.linalg.norm(work) < 1e-7 * np.linalg.norm(shape)
        assert gradient @ shape == pytest.approx(-1j, abs=1e-9)


def test_the_softening_of_a_coned_blade_by_half_of_the_swing():
    """Its orbits have no symmetry in flap: full Fourier series, one side larger."""
    blade = BLADE.with_precone(math.radians(5.0))
    found = periodic_orbits(blade, 1.0, [0.05], mode="flap 1", theory=SOLID)
    assert found.omega_n == pytest.approx(1.394894932, abs=6e-10)
    assert found.lambda_omega == pytest.approx(0.371589, abs=6e-7)
    assert found.jacobi_drift.max() < 1e-10


def test_frequencies_of_a_twisted_and_coned_blade():
    """Known over the peak to one side; nothing reverses time, and a full series is needed."""
    blade = BLADE.with_twist(math.radians(30.0)).with_precone(math.radians(2.5))
    known = {0.1: 0.99551456}
    of = backbone(blade, 1.0, theory=SOLID, mode="flap 1")
    peaks, asked = np.array(list(known)), np.array(list(known))
    for _ in range(3):
        orbits = of.orbits(asked)
        sides = [one.gauge(np.array([one.peak_phase]))[0] for one in orbits.nondimensional]
        asked = asked * peaks / sides
    assert orbits.omega_n == pytest.approx(1.394261507, abs=6e-10)
    ratio = of.orbits(asked).frequency / orbits.omega_n
    assert ratio == pytest.approx(np.array(list(known.values())), abs=1e-8)
    tip = orbits.tip(0, np.linspace(0.0, 2.0 * np.pi, 400))
    assert np.ptp(tip[:, 2]) / 2.0 == pytest.approx(orbits.amplitude[0], rel=1e-4)


@pytest.mark.filterwarnings("ignore:internal resonance")
def test_frequencies_over_the_amplitude():
    """The known ones have the gauge a quarter of a period after zero, just below the peak."""
    known = {0.05: 1.00062592, 0.15: 1.00512648}
    of, asked = backbone(twisted(30.0), 2.0, theory=SOLID, mode="flap 1"), np.array(list(known))
    for _ in range(2):
        orbits = of.orbits(asked)
        quarter = [one.gauge(np.array([0.5 * np.pi]))[0] for one in orbits.nondimensional]
        asked = asked * np.array(list(known)) / quarter
    ratio = of.orbits(asked).frequency / orbits.omega_n
    assert ratio == pytest.approx(np.array(list(known.values())), abs=1e-8)


def test_an_orbit_keeps_its_integral_and_is_followed_by_its_own_tip():
    orbits = periodic_orbits(twisted(30.0), 1.0, [0.1], mode="flap 1", theory=SOLID)
    assert orbits.jacobi_drift.max() < 1e-10
    phase = np.linspace(0.0, 2.0 * np.pi, 400)
    tip = orbits.tip(0, phase)
    assert np.ptp(tip[:, 2]) / 2.0 == pytest.approx(0.1, rel=1e-4)  # flap is the larger share
    assert orbits.axis(0, [1.0], phase)[:, 0] == pytest.approx(tip, abs=1e-12)
    # A half turn about the blade and reversed time: bending odd.
    assert tip[::-1, 1:] == pytest.approx(-tip[:, 1:], abs=1e-12)


def test_twist_without_inertia_makes_no_orbit_unstable():
    """Its frequency, infinite as the blade gets straight, is beyond the steps of any method."""
    flat = Theory(extension=False, trapeze=False)
    found = periodic_orbits(twisted(30.0), 2.0, [0.1], mode="flap 1", theory=flat)
    assert found.stable.all()
    assert np.abs(found.multipliers[0, :6]) == pytest.approx(np.ones(6), abs=1e-6)


def test_a_blade_that_is_hardly_twisted_has_the_orbits_of_the_plane():
    flat = Theory(trapeze=False)
    planar = periodic_orbits(BLADE, 2.0, [0.1, 0.2], theory=flat)
    space = periodic_orbits(BLADE.with_twist(1e-9), 2.0, [0.1, 0.2], theory=flat)
    assert space.frequency == pytest.approx(planar.frequency, rel=1e-9)
    assert space.lambda_omega == pytest.approx(planar.lambda_omega, abs=1e-8)


def test_at_rest_a_quarter_turn_of_the_blade_turns_flap_into_lag():
    """Nothing but the rotation tells one direction from another; both meet round-off."""
    flat = periodic_orbits(twisted(20.0), 0.0, [0.2], mode="flap 1", theory=SOLID)
    upright = BLADE.with_setting_angle(math.pi / 2.0).with_twist(math.radians(20.0))
    turned = periodic_orbits(upright, 0.0, [0.2], mode="lag 1", theory=SOLID)
    assert turned.frequency == pytest.approx(flat.frequency, rel=1e-10)
    assert turned.lag == pytest.approx(flat.flap, rel=1e-9)
    assert turned.flap == pytest.approx(flat.lag, rel=1e-6)


@pytest.mark.parametrize("away", [1e-3, pytest.param(0.03, marks=pytest.mark.slow)])
def test_a_family_that_an_internal_resonance_ends_is_refused(away, monkeypatch):
    """Lag has twice the frequency of flap at w̄ = 1.3587: no orbit of a = 0.02 is flap's alone."""
    monkeypatch.setattr("analytic.exact.free.path.MOST_FUNCTIONS", 12)  # more end it alike
    at = 1.35867 + away
    flap, lag = linear_modes(twisted(30.0), at, 2, theory=SOLID).frequencies
    assert lag / flap == pytest.approx(2.0, abs=1.5 * away)
    with pytest.raises(AmplitudeNotReachedError, match="2 or 3 times its frequency may be that of"):
        periodic_orbits(twisted(30.0), at, [0.05], mode="flap 1", theory=SOLID)


@pytest.mark.parametrize(
    "verb",
    [
        lambda blade: steady_state(blade, 1.0),
        lambda blade: linear_modes(blade, 1.0, 2),
        lambda blade: periodic_orbits(blade, 1.0, [0.05]),
        lambda blade: forced_response(blade, 1.0, TipForce(amplitude=0.01), [0.1, 0.2]),
    ],
)
def test_a_state_with_others_beside_it_is_refused(verb):
    """A section on edge turns over at w̄ = 0.65, to either side: beyond are three states."""
    blade = told(BLADE, 0.02, 4.0, 0.01).with_precone(0.05)
    assert steady_state(blade, 0.6).tip[1] == pytest.approx(0.0, abs=1e-12)
    with pytest.raises(ValueError, match="ends or becomes unstable at w_bar = 0.64.*rotate slower"):
        verb(blade)


@pytest.mark.parametrize(
    ("omega", "multiplier"),
    [(1.36171, None), (1.36211, -1.0193), (2.04909, -1.0188), (2.04949, None)],
)
def test_orbits_of_a_blade_that_neither_twists_nor_stretches(omega, multiplier):
    """All coordinates are odd. Another code gives the edges where the period of lag doubles."""
    thin = unit_beam(1e-4).with_section_out_of_plane(0.01, math.inf).with_twist(1e-7)
    theory = Theory(extension=False, trapeze=False)
    found = periodic_orbits(thin, omega, [0.2], mode="lag 1", theory=theory)
    assert found.stable[0] == (multiplier is None)
    if multiplier is not None:  # near the edge it goes with the root of the distance
        assert found.multipliers[0].real.min() == pytest.approx(multiplier, abs=3e-3)
