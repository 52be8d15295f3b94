"""Derivatives of steady states: closed forms, states solved anew, and the residual's own way."""

import math

import numpy as np
import pytest

from analytic import Beam, Gravity, PointLoad, Theory, linear_modes, steady_state
from analytic.sensitivity import parameters_of, sensitivity
from analytic.sensitivity.steady import SteadyDerivatives
from analytic.theory import BERNOULLI_EULER
from tests.beams import irregular, unit_beam

TABLE = irregular(3, 0.01, 5).with_hub_radius(0.1)
SAG = (PointLoad(force=(0.0, 0.05, 0.02)), Gravity(0.05, tilt=1.57))


def solved(blade, theory=BERNOULLI_EULER, loads=SAG):
    return steady_state(blade, 2.0, loads=loads, theory=theory, tolerance=1e-8)


def anew(state, name):
    """The same derivatives over the size of a number, by states of four other blades."""
    parameter = parameters_of(state.blade, state.theory)[name]
    change = 3e-3 * parameter.size
    several = [
        sensitivity(
            solved(parameter.changed(parameter.value + k * change), state.theory, state.loads), []
        ).values
        for k in (-2, -1, 1, 2)
    ]
    return np.tensordot([1.0, -8.0, 8.0, -1.0], several, 1) / (12.0 * 3e-3)


def test_closed_forms():
    """N = m ω² (R + L/2) L at the root; FL³/3EI of a small load at the tip, FL at the root."""
    beam = unit_beam(1e-6).with_section_out_of_plane(0.25, 0.2).with_hub_radius(0.5)
    found = sensitivity(steady_state(beam, 2.0))
    assert found.values[4] == pytest.approx(4.0, rel=1e-5)
    assert found.of("root force x", "m") == pytest.approx(4.0, rel=1e-5)
    assert found.of("root force x", "hub_radius") == pytest.approx(4.0, rel=1e-5)
    force = 1e-4
    bent = sensitivity(steady_state(beam, 0.0, force=(0.0, 0.0, force)))
    row = bent.outputs.index("tip z")
    assert bent.values[row] == pytest.approx(4.0 * force / 3.0, rel=1e-5)
    relative = dict(zip(bent.names, bent.relative[row], strict=True))
    assert relative["EI2"] == pytest.approx(-1.0, abs=1e-5)
    assert relative["EI3"] == pytest.approx(0.0, abs=1e-5)
    # A lever of which the shortening is of the second order.
    assert bent.values[bent.outputs.index("root moment y")] == pytest.approx(-force, rel=1e-5)
    assert bent.of("root moment y", "m") == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(
    ("name", "theory"),
    [
        ("EI2[2]", Theory()), ("m[4]", Theory()), ("center3[1]", Theory()),
        ("tension2", Theory()), ("precone", Theory()), ("twist[2]", Theory(trapeze="elastic")),
        ("GA2[1]", Theory(shear=True)),
    ],
)  # fmt: skip
def test_against_states_solved_anew(name, theory):
    """Of the largest output; GA moves them by a millionth, of which states have three digits."""
    state = solved(TABLE, theory)
    (found,) = sensitivity(state, [name]).derivatives.T
    expected = anew(state, name)
    found = found * parameters_of(TABLE, theory)[name].size
    noise = 2e-9 if name.startswith("GA") else 1e-10
    np.testing.assert_allclose(found, expected, atol=3e-6 * np.abs(expected).max() + noise)


def test_stations_whose_centers_jump():
    """Functions are made of the adjoints too: without them 2e-3 is left, or 1e-2 of 27 stations."""
    state = solved(irregular(208, 0.03, 8).with_hub_radius(0.1))
    found = sensitivity(state, ["GJ[3]"])
    (parameter,) = found.parameters
    change = 3e-3 * parameter.size
    tips = [solved(parameter.changed(parameter.value + step)).tip for step in (-change, change)]
    expected = np.diff(tips, axis=0)[0, 0] / (2.0 * change)
    assert found.of("tip x", "GJ[3]") == pytest.approx(expected, rel=2e-4)


@pytest.mark.parametrize("theory", [Theory(), Theory(shear=True, trapeze="elastic")])
def test_potential_and_residual_have_the_same_derivatives(theory):
    state = solved(TABLE.with_point_mass(0.6, 0.2, offset=(0.01, 0.02)), theory)
    bypotential, by_residual = SteadyDerivatives(state), SteadyDerivatives(state)
    assert bypotential.potential
    by_residual.potential = False
    for name in ("EA", "EI3[1]", "GJ", "m", "j1[2]", "center2", "tension3[2]", "twist[3]",
                 "point_mass[0]", "setting_angle"):  # fmt: skip
        one = bypotential.parameters[name]
        expected = by_residual.to(one)
        scale = np.abs(expected).max()
        np.testing.assert_allclose(bypotential.to(one), expected, atol=1e-6 * scale)


def test_a_load_that_follows_has_nopotential():
    loads = (PointLoad(force=(0.0, 0.05, 0.02), following=True),)
    state = solved(TABLE, loads=loads)
    assert not SteadyDerivatives(state).potential
    (found,) = sensitivity(state, ["EI3"]).derivatives.T
    expected = anew(state, "EI3")
    np.testing.assert_allclose(found, expected, atol=3e-6 * np.abs(expected).max())


def test_bad_input():
    with pytest.raises(TypeError, match="answer must be what linear_modes, steady_state, perio"):
        sensitivity(3.0)
    with pytest.raises(ValueError, match="the blade has no parameter 'EI4'; it has EA, GJ"):
        sensitivity(solved(TABLE), ["EI4"])
    found = sensitivity(linear_modes(Beam.reference(), 2.0, 1))
    with pytest.raises(ValueError, match="there is no 'tip x': known are lag 1"):
        found.of("tip x", "EI3")
    assert math.isfinite(found.of("lag 1", "m"))
