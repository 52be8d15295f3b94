"""What every formulation keeps: rigid motion, frames, the potential of its forces, its order."""

from functools import partial

import numpy as np
import pytest
from exudyn import OutputVariableType
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import sparse

from analytic import Beam, Rectangle, Theory, linear_modes
from rotbeam_exu import natural_frequencies
from rotbeam_exu.fem.elements import (
    FORMULATIONS,
    Ancf3,
    Cable,
    Exact,
    Linear,
    SpaceCable,
    SpaceExact,
    Substructures,
)
from rotbeam_exu.fem.elements.ancf3 import _Row
from rotbeam_exu.fem.elements.linear_frames import FrameRow
from rotbeam_exu.fem.mesh import Mesh
from rotbeam_exu.fem.solver import exudyn_system
from rotbeam_exu.fem.units import Units
from tests.beams import THICK

BEAM = Beam.reference()
CURVED = (
    BEAM.with_section_out_of_plane(0.25, 0.2).with_twist(0.5).with_prebend(0.02).with_sweep(0.01)
)
MODELS = [cls() for cls in FORMULATIONS.values() if not cls.leaves_plane]
MODELS += [Exact(nodes=3), Ancf3(law="coupled"), Substructures(frame="pinned")]
CASES = [(model, BEAM) for model in MODELS]
CASES += [(Exact(nodes=3), BEAM.with_taper(0.2, 0.3))]
CASES += [(SpaceCable(), BEAM.with_section_out_of_plane(bending_ratio=1.0))]
CASES += [(SpaceExact(), BEAM.with_shape(Rectangle()))]
CASES += [(SpaceExact(), CURVED)]
of_all = pytest.mark.parametrize(("model", "blade"), CASES, ids=[str(one) for one, _ in CASES])


def unit_of(blade):
    return Units.of(blade).blade(blade)


def deformed(model, reference, size):
    return rigid(
        model, reference + size * np.random.default_rng(7).standard_normal(reference.shape)
    )


def rigid(model, coordinates):
    """The same with Euler parameters of norm one."""
    if type(model) is SpaceExact:
        coordinates[..., 3:] /= np.linalg.norm(coordinates[..., 3:], axis=-1, keepdims=True)
    return coordinates


def test_all_are_here():
    assert {type(model) for model, _ in CASES} == {*FORMULATIONS.values()}


@of_all
@settings(max_examples=10, deadline=None)
@given(angle=st.floats(-100.0, 100.0), x=st.floats(-50.0, 50.0), y=st.floats(-50.0, 50.0))
def test_rigid_motion_gives_no_force(elastic_force, model, blade, angle, x, y):
    _, reference = elastic_force(model, blade, 3)
    moved = model.turned(reference[None], np.array([angle]))[0] + angle * model.angles
    moved[:, :2] += x, y
    force, _ = elastic_force(model, blade, 3, moved)
    # Strains are differences of coordinates of up to 60 m over elements of 1 m or more.
    assert np.abs(force).max() < 1e-13 * blade.axial_stiffness


@of_all
def test_forces_turn_with_the_blade(elastic_force, model, blade):
    unit = unit_of(blade)
    _, reference = elastic_force(model, unit, 3)
    at, angle = deformed(model, reference, 0.02), np.array([2.3])
    force, _ = elastic_force(model, unit, 3, at)
    turned = model.turned(at[None], angle)[0] + angle * model.angles
    after, _ = elastic_force(model, unit, 3, turned)
    before = model.turned(force.reshape(1, *reference.shape), angle).ravel()
    assert np.abs(after - before).max() < 1e-12 * np.abs(force).max()
    # The rate of turning is the generator's.
    step = np.array([1e-6])
    later, earlier = (model.turned(at[None], s) + s * model.angles for s in (step, -step))
    np.testing.assert_allclose((later - earlier) / 2e-6, model.spun(at[None]), atol=1e-9)


@of_all
def test_elastic_energy_is_the_potential_of_the_forces(elastic_force, model, blade):
    unit = unit_of(blade)
    _, reference = elastic_force(model, unit, 2)
    at = deformed(model, reference, 0.05)
    force, _ = elastic_force(model, unit, 2, at)
    steps = 1e-6 * np.eye(force.size).reshape(-1, *at.shape)
    with exudyn_system() as mbs:
        chain = model.lay(mbs, unit, 2)
        mbs.Assemble()

        def energy(states):
            if chain.elastic_energy:
                return chain.elastic_energy(states)
            found = []
            for moved in rigid(model, states) - reference:
                mbs.systemData.SetODE2Coordinates(moved.ravel())
                kind = OutputVariableType.PotentialEnergy
                found.append(sum(mbs.GetObjectOutputBody(one, kind) for one in chain.bodies))
            return np.array(found)

        slope = (energy(at + steps) - energy(at - steps)) / 2e-6
    # Central differences leave (1e-6)² and round-off 1e-16/1e-6.
    assert np.abs(np.abs(slope) - np.abs(force)).max() < 1e-8 * np.abs(force).max()


@pytest.mark.parametrize(
    ("row", "reference"),
    [
        *(
            (
                _Row(
                    Ancf3(law=law, poisson_ratio=0.2),
                    Mesh(blade=BEAM.with_taper(0.3, 0.5), elements=3),
                ),
                np.stack([np.linspace(0.0, 8.0, 7), *np.zeros((2, 7)), np.ones(7)], axis=1).ravel(),
            )
            for law in ("uncoupled", "coupled")
        ),
        *((row, row.reference) for row in (FrameRow(BEAM, 3, 2, f) for f in ("tangent", "pinned"))),
    ],
    ids=["uncoupled", "coupled", "tangent", "pinned"],
)
def test_tangent_and_force_are_derivatives(row, reference):
    e = reference + 0.05 * np.random.default_rng(1).standard_normal(reference.size)
    step, size = 1e-6, e.size
    ends = [e + s * step * np.eye(size) for s in (1.0, -1.0)]
    slope = np.subtract(*(row.energy(x.reshape(size, -1, 4)) for x in ends)) / (2 * step)
    force, (rows, columns, values) = row.force(e), row.tangent(e).T
    # Central differences: 1e-12 of truncation, 1e-10 of round-off.
    assert np.abs(slope - force).max() < 1e-8 * np.abs(force).max()
    places = (rows.astype(int), columns.astype(int))
    tangent = sparse.coo_array((values, places), shape=(size, size)).toarray()
    slopes = np.stack([row.force(a) - row.force(b) for a, b in zip(*ends, strict=True)])
    assert np.abs(slopes / (2 * step) - tangent).max() < 1e-8 * np.abs(tangent).max()
    assert np.abs(tangent - tangent.T).max() < 1e-14 * np.abs(tangent).max()


SOFT = Ancf3(shear_correction=0.1)
"""Soft in shear, for which round-off stays below the error of the finest mesh."""


@pytest.mark.parametrize(
    ("model", "blade", "omega", "limit"),
    [
        (Cable(), BEAM, 0.0, Cable()),
        (Cable(), BEAM, 6.0, Cable()),
        (Exact(), THICK, 5.0, Exact(nodes=3)),
        # Its section is that of each Gauss point.
        (SOFT, BEAM.with_hub_radius(0.8).with_taper(0.3, 0.5).with_tip_mass(0.1), 6.0, SOFT),
        (Linear(), BEAM, 2.0, Linear()),
        (Substructures(cells=1), BEAM, 4.0, Cable()),
        (Substructures(frame="pinned", cells=1), BEAM, 4.0, Cable()),
    ],
    ids=lambda value: type(value).__name__,
)
def test_the_order_is_the_declared_one(model, blade, omega, limit, fitted_order):
    """Of quadratic elements with two points that of cubic ones, which are of fourth order."""
    meshes = [4, 8, 16]
    *found, exact = (
        natural_frequencies(blade, omega, element=element, elements=n, count=1)[0]
        for element, n in [*((model, n) for n in meshes), (limit, 32)]
    )
    errors = np.abs(np.array(found) / exact - 1.0)
    assert -fitted_order(meshes, errors) == pytest.approx(model.order, abs=0.15)


@pytest.mark.parametrize(
    ("model", "blade", "omega", "stiffness", "elements"),
    [
        (partial(Exact, nodes=3), THICK, 5.0, (1.0, 10.0, 100.0), 24),
        (Ancf3, BEAM, 0.0, (0.01, 0.1, 1.0), 16),
    ],
    ids=["exact", "ancf3"],
)
def test_stiff_shear_leaves_the_exact_beam_with_rotary_inertia(
    model, blade, omega, stiffness, elements, fitted_order
):
    """The gap is shear compliance, 1/k_s; the limit comes from another theory and another code."""
    limit = linear_modes(blade, omega, 1, theory=Theory(rotary_inertia=True)).frequencies[0]
    found = [
        natural_frequencies(blade, omega, element=model(shear_correction=k), elements=elements)[0]
        for k in stiffness
    ]
    gaps = 1.0 - np.array(found) / limit
    assert fitted_order(stiffness, gaps) == pytest.approx(-1.0, abs=0.02)


@pytest.mark.parametrize(
    ("element", "options", "sentence"),
    [
        ("exact", {"nodes": 4}, "nodes must be 2 or 3, got 4"),
        ("exact", {"poisson_ratio": 0.5}, r"must lie between -1 and 0\.5, got 0\.5"),
        ("exact", {"shear_correction": 0.0}, "shear_correction must be positive"),
        ("ancf3", {"law": "linear"}, "unknown law 'linear'; known are 'uncoupled' and 'coupled'"),
        ("substructures", {"frame": "chord"}, "unknown frame 'chord'; known are 'tangent' and"),
        ("substructures", {"cells": 0}, "cells must be at least 1, got 0"),
    ],
)
def test_bad_options_of_an_element_are_refused(element, options, sentence):
    with pytest.raises(ValueError, match=sentence):
        FORMULATIONS[element](**options)
