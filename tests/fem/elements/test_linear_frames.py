"""Linear floating frames: one is right below ω0 and divergent above it; a row holds out longer."""

import numpy as np
import pytest

from analytic import SpinUp, linear_response
from analytic.input_checks import RotbeamWarning
from rotbeam_exu import SimulationError, natural_frequencies, simulate
from rotbeam_exu.fem.elements import Linear, Substructures
from rotbeam_exu.fem.linearization import Linearization


def test_at_rest_it_is_the_cable(beam):
    linear, cable = (natural_frequencies(beam, 0.0, element=name) for name in ("linear", "cable"))
    assert linear == pytest.approx(cable, rel=2e-7)  # round-off of the axial stiffness


@pytest.mark.parametrize("omega", [2.95, 4.0, 6.0, 8.0])
def test_growth_rate(beam, omega):
    """√(ω² - ω0²), Eq. 45 without stiffening; axial coupling lowers it by the order of μω²."""
    expected = np.sqrt(omega**2 - beam.omega_0**2)
    assert Linearization.of(beam, omega, element="linear").growth_rate == pytest.approx(
        expected, rel=1e-3
    )
    assert Linearization.of(beam, omega, element="linear").growth_rate < expected
    assert Linearization.of(beam, omega, element="cable").growth_rate == 0.0


def test_frequency_softens_to_zero_below_the_divergence_speed(beam):
    for omega in (1.0, 2.0, 2.9):
        expected = np.sqrt(beam.omega_0**2 - omega**2)
        found = natural_frequencies(beam, omega, element="linear")[0]
        assert found == pytest.approx(expected, rel=2e-5)
        assert Linearization.of(beam, omega, element="linear").growth_rate == 0.0
    # Of the mesh of 16 cubic elements, 2e-7 above the beam's.
    assert Linear().divergence_speed(beam, 16) == pytest.approx(beam.omega_0, rel=3e-7)


def test_bounded_below(beam):
    """As five modes of theory have it, without axial motion: over 9 s its phase hardly shows."""
    motion = SpinUp(omega=2.0, ramp_time=6.0)
    run = simulate(
        beam, motion, element="linear", elements=4, duration=9.0, step=1e-2, frame="rotating"
    )
    theory = linear_response(beam, motion, run["time"].to_numpy()).q
    assert np.abs(run["q"] - theory).max() < 1e-3 * np.abs(theory).max()


def test_divergent_above(beam, spin_up):
    """It is refused, and grows at its rate."""
    sentence = (
        r"distance from the clamp .* at t = 1\.0\d+ s, above 1.05: linear elastic frames diverge "
        r"above their divergence speed, 2\.909\d* rad/s here, and omega is 6 rad/s"
    )
    options = {"elements": 4, "duration": 6.5, "step": 2e-3, "frame": "rotating"}
    with pytest.raises(SimulationError, match=sentence) as failed:
        simulate(beam, spin_up, element="linear", **options)
    run = failed.value.part
    assert run.attrs["verdict"] == str(failed.value)
    late = run["q"].sel(time=slice(4.5, 6.5))
    slope = np.polyfit(late["time"], np.log(np.abs(late)), 1)[0]
    assert slope == pytest.approx(np.sqrt(36.0 - beam.omega_0**2), rel=1e-3)
    # The trapezoidal rule adds (σh)²/12 = 9e-6 to the rate of the mesh itself.
    assert slope == pytest.approx(
        Linearization.of(beam, 6.0, elements=4, element="linear").growth_rate, rel=2e-5
    )


def test_frequencies_of_an_unstable_state_and_a_row_of_no_elements_are_refused(beam):
    with pytest.raises(ValueError, match="elements must be at least 1, got 0"):
        Substructures().divergence_speed(beam, 0)
    with pytest.raises(SimulationError, match=r"unstable, it grows with 5\.247\d* 1/s"):
        natural_frequencies(beam, 6.0, element="linear")


def test_one_tangent_frame_is_the_linear_beam(beam):
    # Eight cubic cells are within 4e-6 of the beam.
    assert Substructures(cells=8).divergence_speed(beam, 1) == pytest.approx(beam.omega_0, rel=5e-6)


@pytest.mark.parametrize(
    ("n", "frame"), [(1, "tangent"), (2, "tangent"), (4, "tangent"), (1, "pinned"), (2, "pinned")]
)
def test_it_is_where_growth_sets_in(beam, frame, n):
    """All eigenvalues about the steady state, with Coriolis terms, through Exudyn."""
    model, speed = Substructures(frame=frame), Substructures(frame=frame).divergence_speed(beam, n)
    assert Linearization.of(beam, 0.999 * speed, element=model, elements=n).growth_rate == 0.0
    above = Linearization.of(beam, 1.0002 * speed, element=model, elements=n).growth_rate
    # Divergence sets in like a square root.
    assert Linearization.of(
        beam, 1.0008 * speed, element=model, elements=n
    ).growth_rate == pytest.approx(2.0 * above, rel=0.02)


def test_a_run_above_the_divergence_speed_that_stays_bounded_says_so(beam):
    noticed = r"above the divergence speed, 4\.45\d+ rad/s, of 2 'sub"
    with pytest.warns(RotbeamWarning, match=noticed):
        simulate(
            beam, SpinUp(omega=4.6, ramp_time=6.0), element=Substructures(cells=1), elements=2,
            duration=6.6, step=1.5e-2,
        )  # fmt: skip
