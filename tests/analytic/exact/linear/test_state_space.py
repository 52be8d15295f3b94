"""The linearized blade as A, B, C, D, against modes, statics and forced responses."""

import math

import numpy as np
import pytest

from analytic import (
    Beam,
    Damping,
    Gravity,
    LoadTable,
    PointLoad,
    SpeedRipple,
    Theory,
    TipForce,
    damping_ratios,
    forced_response,
    linear_modes,
    state_space,
    steady_state,
)

OMEGA = 4.0
BLADE = Beam.reference().with_section_out_of_plane(0.3, 0.3).with_twist(0.4).with_precone(0.05)
DAMPED = BLADE.with_damping(Damping(bending=0.002, torsion=0.001))
PUSH = PointLoad(force=(0.0, 1.0, 0.0))


def columns(of):
    """Places, turns, forces and moments, (4, points, 3, inputs)."""
    return np.moveaxis(of.reshape(len(of), 4, 3, -1), 1, 0)


def test_eigenvalues_are_frequencies_and_damping_ratios():
    free, damped = (state_space(blade, OMEGA, [PUSH]) for blade in (BLADE, DAMPED))
    modes = linear_modes(BLADE, OMEGA, 6)
    assert free.eigenvalues.imag == pytest.approx(modes.frequencies, rel=1e-8)
    # Without damping they stand on the imaginary axis, to the round-off of 1/λ.
    assert np.abs(free.eigenvalues.real).max() < 1e-9 * modes.frequencies[-1]
    ratios = -damped.eigenvalues.real / np.abs(damped.eigenvalues)
    assert ratios == pytest.approx(damping_ratios(DAMPED, OMEGA, 6), rel=1e-7)
    values = np.linalg.eigvals(damped.A)
    assert np.sort(values[values.imag > 0.0]) == pytest.approx(np.sort(damped.eigenvalues))


@pytest.mark.parametrize(
    "push",
    [
        PUSH,
        PointLoad(force=(0.0, 0.0, 1.0), moment=(0.5, 0.0, 0.0), position=5.0, following=True),
        LoadTable(x=[2.0, 6.0], force=[[0.0, 0.1, 0.2], [0.0, 0.0, 0.3]]),
    ],
    ids=["tip", "following", "table"],
)
def test_static_responses_are_differences_of_steady_states(push):
    """Central ones, with an error of the square of the load; some stand already."""
    small, x = 1e-4, [0.0, 4.5, BLADE.length]
    weight = (Gravity(9.81, tilt=0.5 * math.pi),)
    made = state_space(DAMPED, OMEGA, [push], x=x, loads=weight)
    ends = [
        steady_state(BLADE, OMEGA, loads=(*weight, push.times(sign * small)), tolerance=1e-11)
        for sign in (1.0, -1.0)
    ]
    one, other = (end.section_loads(x) for end in ends)
    place, turn, force, moment = columns(made.response(0.0).real)[..., 0]
    for found, name in ((place, "place"), (force, "force"), (moment, "moment")):
        known = (getattr(one, name) - getattr(other, name)) / (2.0 * small)
        np.testing.assert_allclose(found, known, atol=1e-6 * np.abs(known).max())
    middle = steady_state(BLADE, OMEGA, loads=weight).section_loads(x).section
    spin = (one.section - other.section) / (2.0 * small) @ np.swapaxes(middle, 1, 2)
    np.testing.assert_allclose(turn, spin[:, [2, 0, 1], [1, 2, 0]], atol=1e-6 * np.abs(spin).max())


@pytest.mark.parametrize("frequency", [2.0, 4.4])
def test_its_frequency_response_is_a_forced_response_of_small_amplitude(frequency):
    """Below and next to the second mode; the amplitude's square is 1e-8."""
    load = TipForce(amplitude=1e-3)
    curve = forced_response(DAMPED, OMEGA, load, [frequency, frequency + 0.01])
    made = state_space(DAMPED, OMEGA, [load], modes=12)
    lag = abs(made.response(frequency)[0, 1, 0]) / DAMPED.length
    assert lag == pytest.approx(curve.amplitude[0], rel=1e-5)


def test_loads_in_sections_are_those_of_a_driven_cantilever():
    """Between its first and second mode, by the closed form of Euler and Bernoulli."""
    beam = Beam.reference().with_section_out_of_plane(0.3, 0.3)
    length, bending = beam.length, beam.bending_stiffness
    nu = 12.0 * beam.frequency_scale
    beta = (beam.mass_per_length * nu**2 / bending) ** 0.25
    c, s, ch, sh = (of(beta * length) for of in (math.cos, math.sin, math.cosh, math.sinh))
    # v = a (cosh - cos) + b (sinh - sin): no moment at the tip, where the shear force is 1 N.
    a, b = np.linalg.solve([[ch + c, sh + s], [sh - s, ch + c]], [0.0, -1.0 / (bending * beta**3)])
    made = state_space(beam, 0.0, [PUSH], x=[0.0, length], modes=24)
    place, turn, force, moment = columns(made.response(nu).real)[..., 0]
    known = a * (ch - c) + b * (sh - s), beta * (a * (sh + s) + b * (ch - c))
    assert (place[1, 1], turn[1, 2]) == pytest.approx(known, rel=1e-5)
    assert force[0, 1] == pytest.approx(-2.0 * bending * beta**3 * b, rel=1e-4)
    assert moment[0, 2] == pytest.approx(2.0 * bending * beta**2 * a, rel=1e-4)


def test_modes_left_out_are_left_as_at_rest():
    """Undamped, their share falls with the square of the drive's frequency over theirs."""
    whole = state_space(BLADE, OMEGA, [PUSH], modes=16)
    few = state_space(BLADE, OMEGA, [PUSH], modes=4)
    off = [
        np.abs(few.response(nu) - whole.response(nu))[0, 1, 0] / np.abs(whole.response(nu)[0, 1, 0])
        for nu in (0.5, 1.0)
    ]
    assert off[1] < 1e-4
    assert off[1] / off[0] == pytest.approx(4.0, rel=0.5)


def test_at_rest_a_push_here_moves_there_what_a_push_there_moves_here():
    """Maxwell and Rayleigh: for force and moment, place and turn, at any frequency."""
    along, length = 5.0, BLADE.length
    pushes = [
        PointLoad(force=(0.0, 1.0, 0.0)),
        PointLoad(force=(0.0, 0.0, 1.0), position=along),
        PointLoad(moment=(1.0, 0.0, 0.0)),
    ]
    made = state_space(DAMPED, 0.0, pushes, x=[length, along], modes=8)
    seen = made.response(7.0)[[0, 1, 0], [1, 2, 3]]
    assert np.abs(seen - seen.T).max() < 1e-9 * np.abs(seen).max()


def test_theories_and_tables_have_it_too():
    axial, bending = 4e3, 1.0
    table = type(BLADE).from_stations(
        [0.0, 0.3, 1.0],
        [[axial, axial, axial, 0.08, 0.0625, bending]] * 3,
        [[1.0, 3e-3, 2e-3, 1e-3]] * 3,
        twist=[0.0, 0.2, 0.3],
        tension=[[0.0, 0.01], [0.0, -0.01], [0.0, 0.02]],
    )
    theory = Theory(shear=True)
    made = state_space(table, 2.0, [PUSH], theory=theory)
    modes = linear_modes(table, 2.0, 6, theory=theory)
    assert np.abs(made.eigenvalues) == pytest.approx(modes.frequencies, rel=2e-6)
    assert made.error < 1e-6


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"inputs": []}, "needs one input at least"),
        ({"inputs": PUSH}, "loads must be several"),
        ({"inputs": [3.0]}, "a load must be a"),
        ({"inputs": [SpeedRipple(amplitude=1.0)]}, "moves nothing at t = 0"),
        ({"x": 9.0}, "must lie on the beam"),
        ({"x": [math.nan]}, "x"),
        ({"modes": 0}, "modes must be at least 1"),
        ({"modes": 2.5}, "modes must be a whole number"),
        ({"omega": -1.0}, "omega must not be negative"),
        ({"tolerance": 0.1}, "tolerance must be from"),
        ({"blade": DAMPED.with_damping(Damping(bending=3.0))}, "do not swing: take less damping"),
    ],
)
def test_what_it_refuses(change, sentence):
    given = {"blade": DAMPED, "omega": OMEGA, "inputs": [PUSH], **change}
    with pytest.raises((ValueError, TypeError), match=sentence):
        state_space(**given)
