"""Every formulation that is right starts on an exact orbit and stays near it."""

import numpy as np
import pytest

from analytic import SteadyRotation, periodic_orbits
from rotbeam_exu import simulate
from rotbeam_exu.fem.elements import Ancf3, Exact, Substructures


@pytest.mark.parametrize(
    ("model", "close"),
    # Pinned frames of this number are off by their own order, the others by mesh and shear.
    [("cable", 3e-3), (Exact(nodes=3), 3e-3), (Ancf3(), 3e-3),
     (Substructures(frame="pinned"), 2e-2)],
    ids=str,
)  # fmt: skip
def test_a_quarter_of_a_period(beam, model, close):
    """Sections start without shear, which then rings fast: hence the short step."""
    orbit = periodic_orbits(beam, 6.0, [0.1])
    period = 2.0 * np.pi / orbit.frequency[0]
    run = simulate(
        beam, SteadyRotation(omega=6.0), element=model, elements=8, step=period / 4000,
        duration=period / 4, frame="rotating", initial_state=lambda x: orbit.state(0, x, phase=1.0),
    )  # fmt: skip
    time = run["time"].to_numpy()
    predicted = beam.length * orbit.response(time, 0, phase=1.0)
    assert np.abs(run["q"] - predicted).max() < close * 0.1 * beam.length
    velocity = np.gradient(predicted, time, edge_order=2)
    assert abs(run["q_dot"][0] - velocity[0]) < 1e-3 * np.abs(velocity).max()
