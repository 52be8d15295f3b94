"""Random beams in random units: the theory answers the same, or says why not."""

import warnings

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from analytic import Beam, SpinUp, Theory, campbell, linear_modes, periodic_orbits, spin_up_response
from analytic.input_checks import RotbeamWarning

exponents = st.floats(min_value=-4.0, max_value=4.0)
slendernesses = st.floats(min_value=-12.0, max_value=-2.0).map(lambda e: 10.0**e)
# The burst is at w̄ = 15.7 where μ = 1e-2.
rates = st.floats(min_value=0.0, max_value=12.0)


def beam_in_units(slenderness, meter=1.0, kilogram=1.0, second=1.0):
    """The beam of EI = ρA = L = 1, in units that are so many of its own."""
    newton = kilogram * meter / second**2
    return Beam.from_stiffness(
        length=meter,
        axial_stiffness=newton / slenderness,
        bending_stiffness=newton * meter**2,
        mass_per_length=kilogram / meter,
    )


@pytest.fixture(autouse=True)
def quiet():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RotbeamWarning)
        yield


@settings(max_examples=10, deadline=None)
@given(slendernesses, rates, exponents, exponents, exponents)
def test_modes_and_orbits_in_any_units(slenderness, rate, meter, kilogram, second):
    units = (10.0**meter, 10.0**kilogram, 10.0**second)
    one, other = beam_in_units(slenderness), beam_in_units(slenderness, *units)
    omega = rate / units[2]
    modes, others = linear_modes(one, rate), linear_modes(other, omega)
    assert others.frequencies * units[2] == pytest.approx(modes.frequencies, rel=1e-9)
    x = np.linspace(0.0, 1.0, 5)
    assert others.shapes(x * units[0]) == pytest.approx(modes.shapes(x), abs=1e-6)
    orbit, same = periodic_orbits(one, rate, [0.1]), periodic_orbits(other, omega, [0.1])
    ratio = orbit.frequency / orbit.omega_n
    assert same.frequency / same.omega_n == pytest.approx(ratio, rel=1e-10)
    assert same.lambda_omega == pytest.approx(orbit.lambda_omega, abs=1e-7)
    here = orbit.state(0, x, 0.3).place[:, 1]
    assert same.state(0, x * units[0], 0.3).place[:, 1] / units[0] == pytest.approx(here, abs=1e-9)


@settings(max_examples=4, deadline=None)
@given(slendernesses, st.floats(min_value=0.5, max_value=5.0), exponents, exponents)
def test_spin_ups_in_any_units(slenderness, rate, meter, second):
    length, time = 10.0**meter, 10.0**second
    q = [
        spin_up_response(
            beam_in_units(slenderness, unit, 3.0, instant),
            SpinUp(omega=rate / instant, ramp_time=2.0 * instant),
            [1.0 * instant, 2.5 * instant],
            tolerance=1e-4,
        ).q
        / unit
        for unit, instant in ((1.0, 1.0), (length, time))
    ]
    assert q[1] == pytest.approx(q[0], rel=1e-9)


def attempted(function, *arguments, **options):
    """What the function returns, or None and its refusal."""
    try:
        return function(*arguments, **options), ""
    except (ValueError, RuntimeError) as refusal:
        return None, str(refusal)


@settings(max_examples=6, deadline=None)
@given(
    slendernesses,
    st.floats(min_value=-9.0, max_value=4.0).map(lambda e: 10.0**e),
    st.floats(min_value=-15.0, max_value=-0.4).map(lambda e: 10.0**e),
    st.booleans(),
)
def test_right_or_refused_in_a_sentence(slenderness, rate, amplitude, inextensible):
    """No division by zero, no warning of numpy; pytest makes errors of warnings."""
    beam = beam_in_units(slenderness)
    options = {"theory": Theory(extension=not inextensible)}
    modes, refusal = attempted(linear_modes, beam, rate, 1, **options)
    if modes is None:
        assert "rotate slower" in refusal
        return
    assert modes.frequencies[0] > 0.0
    if rate > 100.0:  # slow there, and tested by itself
        return
    found, refusal = attempted(periodic_orbits, beam, rate, [amplitude], **options)
    if found is None:
        assert "smaller amplitudes" in refusal or "take linear_modes" in refusal
        return
    assert found.omega_n == pytest.approx(modes.frequencies[0], rel=1e-6)
    assert abs(found.frequency[0] / found.omega_n - 1.0) < 0.2 * amplitude**2 + 1e-8


def test_campbell_diagram_from_rest_of_a_beam_almost_inextensible():
    diagram = campbell(beam_in_units(1e-12), [0.0, 1e-6, 4.0, 8.0], 2, orders=2)
    assert diagram.mac.min() > 0.9
    # At rest and almost at rest the cantilever's.
    assert diagram.frequencies[1] == pytest.approx(diagram.frequencies[0], rel=1e-12)
    assert diagram.frequencies[0, 0] == pytest.approx(3.516015269, rel=1e-9)
