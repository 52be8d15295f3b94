"""A rigid motion strains no formulation; what a deformation stores does not depend on the frame."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rotbeam_exu.fem.elements import FORMULATIONS, Ancf3, Exact, formulation

MODELS = [*(formulation(name) for name in FORMULATIONS), Exact(nodes=3), Ancf3(law="coupled")]


@pytest.mark.parametrize("model", MODELS, ids=str)
@settings(max_examples=10, deadline=None)
@given(angle=st.floats(-100.0, 100.0), x=st.floats(-50.0, 50.0), y=st.floats(-50.0, 50.0))
def test_rigid_motion_gives_no_force(beam, elastic_force, model, angle, x, y):
    _, reference = elastic_force(model, beam, 3)
    moved = model.turned(reference[None], np.array([angle]))[0] + angle * model.angles
    moved[:, :2] += x, y
    force, _ = elastic_force(model, beam, 3, moved)
    # Strains are differences of coordinates of up to 60 m over elements of 1 m or more.
    assert np.abs(force).max() < 1e-13 * beam.axial_stiffness


@pytest.mark.parametrize("model", MODELS, ids=str)
def test_forces_turn_with_the_beam(beam, elastic_force, model):
    rng = np.random.default_rng(7)
    _, reference = elastic_force(model, beam, 3)
    deformed = reference + 0.02 * rng.standard_normal(reference.shape)
    angle = np.array([2.3])
    force, _ = elastic_force(model, beam, 3, deformed)
    after, _ = elastic_force(
        model, beam, 3, model.turned(deformed[None], angle)[0] + angle * model.angles
    )
    before = model.turned(force.reshape(1, *reference.shape), angle).ravel()
    assert np.abs(after - before).max() < 1e-12 * np.abs(force).max()


@pytest.mark.parametrize("model", MODELS, ids=str)
def test_a_stretch_does_give_force(beam, elastic_force, model):
    """The zero above is not the zero of a body without stiffness."""
    _, reference = elastic_force(model, beam, 3)
    stretched = reference.copy()
    stretched[:, 0] *= 1.001
    force, _ = elastic_force(model, beam, 3, stretched)
    assert np.abs(force).max() > 1e-4 * beam.axial_stiffness
