"""Forced response of blades in space: the plane, the linear limit, power, time, stability."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy import linalg

from analytic import (
    Beam,
    Damping,
    DistributedForce,
    Gravity,
    ResponseNotReachedError,
    SpeedRipple,
    Theory,
    TipForce,
    forced_response,
)
from analytic.exact.driven.transient import integrated
from analytic.motion import SteadyRotation
from tests.beams import unit_beam

THIN = Theory(extension=False)
BLADE = (
    unit_beam(1e-4)
    .with_section_out_of_plane(1.0 / 16.0, 0.08)
    .with_damping(Damping(bending=0.02, external=0.2))
)
TWISTED = BLADE.with_twist(math.radians(30.0))


@pytest.mark.parametrize(
    ("load", "omega", "frequencies"),
    [
        (TipForce(amplitude=0.05), 2.0, [3.4, 3.5]),
        pytest.param(SpeedRipple(amplitude=0.05), 2.0, [3.4, 3.5], marks=pytest.mark.slow),
        pytest.param(Gravity(0.5), [1.5, 1.7], None, marks=pytest.mark.slow),
    ],
)
def test_a_blade_that_is_hardly_twisted_responds_as_in_the_plane(load, omega, frequencies):
    """The same functions of the same curvature, so to round-off; it does not leave the plane."""
    theory = Theory(trapeze=False)
    planar = forced_response(BLADE, omega, load, frequencies, theory=theory, functions=8)
    hardly = BLADE.with_twist(1e-13)
    space = forced_response(hardly, omega, load, frequencies, theory=theory, functions=16)
    assert space.frequency == pytest.approx(planar.frequency, rel=1e-12)
    assert space.amplitude == pytest.approx(planar.amplitude, abs=1e-12)
    assert space.harmonics == pytest.approx(planar.harmonics, abs=1e-12)
    assert space.amplitude.max() > 0.03
    assert max(space.flap.max(), space.twist.max()) < 1e-12
    assert space.gauge == "lag"


@pytest.fixture(scope="module")
def coned():
    """Twist and precone, with a small force: nothing reverses time."""
    return forced_response(
        TWISTED.with_precone(0.1), 2.0, TipForce(amplitude=1e-5), [2.2, 2.4], theory=THIN,
        functions=8, gauge="flap",
    )  # fmt: skip


def matrices(orbit):
    """Mass, damping and stiffness at the steady state, and what they are about."""
    steady = orbit.system.unloaded(orbit.frequency)
    _, K, C, M = (part[0] for part in steady.linearized)
    return M, C, K, steady


@pytest.mark.parametrize("i", [0, -1])
def test_a_small_force_gives_the_transfer_function_of_the_linearization(coned, i):
    """K + iνC - ν²M onto the force's work; what is left out is of second order, 1e-5."""
    M, C, K, steady = matrices(coned.nondimensional[i])
    nu, at = coned.frequency[i], steady.equilibrium[None]
    along = steady.model.tip_gradient(at)[0]
    q = np.linalg.solve(K + 1j * nu * C - nu**2 * M, 1e-5 * along[1])
    lag, flap = np.abs(along[1:] @ q)
    steps = 1e-5 * np.eye(len(q))
    turns = [steady.model.tip_turn(at + sign * steps) for sign in (1.0, -1.0)]
    wanted = [lag, flap, abs((turns[0] - turns[1]) @ q) / 2e-5]
    assert [coned.lag[i], coned.flap[i], coned.twist[i]] == pytest.approx(wanted, rel=2e-5)
    assert coned.amplitude[i] == pytest.approx(flap, rel=1e-4)  # to one side
    assert coned.phase[i] == pytest.approx(-np.angle(along[2] @ q), abs=1e-5)


def test_its_multipliers_are_those_of_the_linearization(coned):
    """exp(λT) of the lowest four modes; the integration over a period has an error of 1e-8."""
    M, C, K, _ = matrices(coned.nondimensional[0])
    n = len(K)
    state = np.block([[np.zeros((n, n)), np.eye(n)], [-K, -C]])
    values = linalg.eig(state, linalg.block_diag(np.eye(n), M), right=False)
    values = values[np.isfinite(values)]
    # The slowest, by where they are without damping.
    slow = values[np.argsort(np.abs(values))][:8]
    wanted = np.exp(slow * 2.0 * np.pi / coned.frequency[0])
    (found,) = replace(coned, nondimensional=coned.nondimensional[:1]).multipliers
    assert np.abs(found[:, None] - wanted).min(axis=1).max() < 1e-6
    assert np.abs(found).max() > 0.5  # flap, whose ratio is 0.05


@pytest.mark.parametrize("trapeze", [True, False])
def test_motion_too_fast_for_the_steps_makes_no_response_unstable(trapeze):
    """Air decays all flap and lag alike; twist has hardly any inertia, or none, and no damping."""
    blade, push = TWISTED.with_damping(Damping(external=0.2)), TipForce(amplitude=0.05)
    theory = Theory(extension=False, trapeze=trapeze)
    found = forced_response(blade, 2.0, push, [2.39, 2.4], theory=theory, functions=8)
    last = replace(found, nondimensional=found.nondimensional[-1:])
    assert last.stable.all()
    # The deflection, 0.03 L, changes it by 5e-4.
    sizes = np.abs(last.multipliers[0, :6])
    assert sizes == pytest.approx(np.full(6, np.exp(-0.2 * np.pi / 2.4)), rel=1e-3)


@pytest.fixture(scope="module")
def bent():
    """A blade that swings by a third of its length, under damping that settles soon."""
    damping = Damping(bending=0.2, external=2.0)
    blade = BLADE.with_section_out_of_plane(0.25, 0.3).with_twist(1.0).with_damping(damping)
    push = TipForce(amplitude=1.0, frequency=3.0)
    found = forced_response(
        blade, 2.0, TipForce(amplitude=1.0), [2.99, 3.0], theory=THIN, functions=16, harmonics=12
    )
    (i,) = found.at(3.0)
    return blade, push, found, i


def test_damping_takes_what_the_force_gives(bent):
    """Over a period, by the places of the axis in time and the rates of the strains."""
    blade, push, found, i = bent
    count = 96
    phase = 2.0 * np.pi * np.arange(count) / count
    x, weights = np.polynomial.legendre.leggauss(24)
    places = found.axis(i, np.append(0.5 * (x + 1.0), 1.0), phase)
    waves = np.fft.fftfreq(count, 1.0 / count)[:, None, None]
    nu = found.frequency[i]
    rates = np.fft.ifft(1j * nu * waves * np.fft.fft(places, axis=0), axis=0).real
    given = (push.amplitude * np.cos(phase) * rates[:, -1, 1]).mean()
    air = blade.damping.external * (0.5 * weights @ np.sum(rates[:, :-1] ** 2, axis=2).T).mean()
    _, strains, _ = found.nondimensional[i].coordinates(phase)
    bending = blade.damping.bending * np.sum(strains**2, axis=1).mean()
    assert given == pytest.approx(air + bending, rel=1e-6)
    assert min(air, bending) > 0.02 * given
    assert found.lag[i] > 0.3
    assert found.flap[i] > 0.06


def test_a_motion_in_time_settles_on_it(bent):
    """Radau's steps of the spin-up from rest; after 11 periods 1e-7 of the start is left."""
    blade, push, found, i = bent
    model, period = found.nondimensional[i].system.model, 2.0 * np.pi / 3.0
    periods = 11
    grid = np.array([0.0, periods * period])
    phase = np.linspace(0.0, 2.0 * np.pi, 9)
    time = (periods - 1) * period + phase / 3.0
    still = found.nondimensional[i].system.equilibrium
    motion = integrated(
        blade, SteadyRotation(omega=2.0), [push], model, grid, time, np.empty(0), still,
        tolerance=1e-7,
    )  # fmt: skip
    assert motion.tip == pytest.approx(found.tip(i, phase), abs=1e-6)
    tip = found.tip(i, np.linspace(0.0, 2.0 * np.pi, 721))
    assert found.lag[i] == pytest.approx(0.5 * np.ptp(tip[:, 1]), rel=1e-4)
    assert found.flap[i] == pytest.approx(0.5 * np.ptp(tip[:, 2]), rel=1e-4)


def test_a_load_that_is_too_large_at_once_is_raised_in_steps():
    """Newton's method from the blade at rest fails here; the curve from afar leads to the same."""
    blade, push = BLADE.with_damping(Damping(bending=0.01, external=0.2)), TipForce(amplitude=1.0)
    at_once = forced_response(blade, 2.0, push, [3.4, 3.5], theory=THIN, functions=8)
    from_afar = forced_response(blade, 2.0, push, [0.5, 3.4, 3.5], theory=THIN, functions=8)
    assert at_once.amplitude[0] > 0.7
    assert from_afar.amplitude[from_afar.at(3.4)] == pytest.approx(at_once.amplitude[:1], rel=1e-6)


def test_what_stays_in_the_plane_has_no_flap():
    """Centers of mass ahead of the line couple lag to nothing out of the plane."""
    blade = BLADE.with_offsets(mass=(0.05, 0.0))
    push = DistributedForce(amplitude=0.05)
    found = forced_response(blade, 2.0, push, [3.4, 3.6], theory=THIN, functions=8, gauge="flap")
    assert found.amplitude.max() < 1e-12
    assert not found.peaks
    assert found.lag.max() > 0.02


def test_the_backbone_is_that_of_the_gauge(coned, bent):
    assert coned.backbone.mode == "flap 1"
    assert bent[2].backbone.mode == "lag 1"


@pytest.mark.parametrize(
    ("blade", "more", "sentence"),
    [
        (BLADE, {"gauge": "flap"}, "stays in its plane under the load, and gauge is 'flap'"),
        (TWISTED, {"gauge": "up"}, "gauge must be 'lag' or 'flap', got 'up'"),
        (TWISTED.with_damping(Damping()), {}, "lag 1 is at 3.51.* rad/s: take"),
        (Beam.reference().with_twist(0.1), {}, "give its stiffness there"),
    ],
)
def test_bad_input_is_one_sentence(blade, more, sentence):
    with pytest.raises(ValueError, match=sentence):
        forced_response(blade, 2.0, TipForce(amplitude=0.01), [3.4, 3.6], **more)


def test_torsion_that_nothing_damps_is_told():
    """External damping acts on the line; harmonics that meet torsion then have no end."""
    blade, push = TWISTED.with_damping(Damping(external=0.05)), TipForce(amplitude=0.1)
    with pytest.raises(ResponseNotReachedError, match="take damping of the bending, without"):
        forced_response(blade, 2.0, push, [3.3, 3.37], theory=THIN, functions=8)
