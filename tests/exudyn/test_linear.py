"""Linear floating frames: one is right below ω0 and divergent above it; a row holds out longer."""

import re
from functools import cache

import numpy as np
import pytest

from analytic import SpinUp, linear_response
from analytic.input_checks import RotbeamWarning
from rotbeam_exu import SimulationError, natural_frequencies, simulate
from rotbeam_exu import steady_oscillation as steady
from rotbeam_exu.fem.elements import Linear, Substructures, formulation
from rotbeam_exu.fem.linearization import Linearization
from rotbeam_exu.fem.solver import mass_matrix


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


@pytest.mark.slow  # frequencies below the divergence speed, and what diverges above it, are here
@pytest.mark.parametrize("frame", ["inertial", "rotating"])
def test_bounded_below(beam, frame):
    run = simulate(
        beam, SpinUp(omega=2.0, ramp_time=6.0), element="linear", elements=4, step=6e-3, frame=frame
    )
    half = 0.5 * run["time"][-1]
    late, early = (abs(run["q"].where(part)).max() for part in (run.time > half, run.time <= half))
    assert late <= early
    # Linear bending: no dependence on the amplitude, but for the inertia of axial motion.
    expected = natural_frequencies(beam, 2.0, element="linear", elements=4)[0]
    assert steady(run).frequency == pytest.approx(expected, rel=5e-5)
    # The same on five modes, without axial motion: over 15 s what that does to the phase shows.
    theory = linear_response(beam, SpinUp(omega=2.0, ramp_time=6.0), run["time"].to_numpy()).q
    assert np.abs(run["q"] - theory).max() < 1e-3 * np.abs(theory).max()


@pytest.fixture(scope="module")
def divergent(beam, spin_up):
    """What is raised of the linear beam above its divergence speed, by the frame."""

    @cache
    def of(frame):
        # In the rotating frame far enough for its rate.
        duration, step = (3.5, 1e-2) if frame == "inertial" else (6.5, 2e-3)
        options = {"elements": 4, "duration": duration, "step": step}
        with pytest.raises(SimulationError) as failed:
            simulate(beam, spin_up, element="linear", frame=frame, **options)
        return failed.value

    return of


@pytest.mark.parametrize("frame", ["inertial", "rotating"])
def test_divergent_above(divergent, frame):
    sentence = (
        r"distance from the clamp .* at t = 1\.0\d+ s, above 1.05: linear elastic frames diverge "
        r"above their divergence speed, 2\.909\d* rad/s here, and omega is 6 rad/s"
    )
    error = divergent(frame)
    assert re.search(sentence, str(error))
    assert error.run.attrs["verdict"] == str(error)


def test_a_run_grows_at_that_rate(beam, divergent):
    late = divergent("rotating").run["q"].sel(time=slice(4.5, 6.5))
    slope = np.polyfit(late["time"], np.log(np.abs(late)), 1)[0]
    assert slope == pytest.approx(np.sqrt(36.0 - beam.omega_0**2), rel=1e-3)
    # The trapezoidal rule adds (σh)²/12 = 9e-6 to the rate of the mesh itself.
    assert slope == pytest.approx(
        Linearization.of(beam, 6.0, elements=4, element="linear").growth_rate, rel=2e-5
    )


def test_frequencies_of_an_unstable_state_are_refused(beam):
    with pytest.raises(SimulationError, match=r"unstable, it grows with 5\.247\d* 1/s"):
        natural_frequencies(beam, 6.0, element="linear")


def test_cells_have_the_mass_of_the_cable(beam):
    """Both interpolate r cubically between the same coordinates."""
    linear, cable = (mass_matrix(formulation(n), beam, 3).toarray() for n in ("linear", "cable"))
    assert np.abs(linear - cable).max() < 1e-14 * np.abs(cable).max()


@pytest.mark.parametrize("frame", ["tangent", "pinned"])
def test_divergence_speed_grows_with_the_number(beam, frame):
    speeds = [Substructures(frame=frame).divergence_speed(beam, n) for n in (1, 2, 3, 4, 6, 8)]
    assert np.all(np.diff(speeds) > 0.0)


def test_the_divergence_speed_depends_on_the_frame(beam):
    """Pinned frames see half the rotation from chord to tangent, and hold out longer."""
    for n in (1, 2, 4):
        pinned, tangent = (
            Substructures(frame=f).divergence_speed(beam, n) for f in ("pinned", "tangent")
        )
        assert pinned > 2.0 * tangent


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


def test_refuses_a_row_of_no_elements(beam):
    with pytest.raises(ValueError, match="elements must be at least 1, got 0"):
        Substructures().divergence_speed(beam, 0)
