"""Exudyn on tables of stations, whose matrices couple all: beside the exact blade."""

from pathlib import Path

import numpy as np
import pytest

from analytic import (
    Blade,
    Damping,
    DistributedForce,
    Gravity,
    Section,
    SpinUp,
    TipForce,
    linear_modes,
    spin_up_response,
    steady_state,
)
from rotbeam_exu import natural_frequencies, simulate
from rotbeam_exu.fem.elements import SpaceExact
from rotbeam_exu.fem.elements.reissner_in_space import _Row
from rotbeam_exu.fem.linearization import Linearization
from rotbeam_exu.files.beam_file import load_beam

ELEMENT = SpaceExact()
SHIPPED = Path(__file__).parents[3] / "models" / "blades"
RNG = np.random.default_rng(3)


def table():
    """Return a blade of length 1 with a taper, twist, centers apart and all couplings."""
    x, shrink = np.array([0.0, 0.3, 1.0]), np.array([1.0, 0.7, 0.3])
    columns = np.array([4e3, 8e2, 6e2, 0.3, 0.5, 2.0])
    bare = Blade.from_stations(
        x, np.outer(shrink, columns), np.outer(shrink, [1.0, 1.5e-3, 3e-4, 1.2e-3]),
        tension=[(0.02, 0.0), (0.01, 0.004), (0.0, 0.0)], shear=[(-0.01, 0.002)] * 3,
        center=[(-0.02, 0.01), (0.01, 0.01), (0.03, 0.0)],
    )  # fmt: skip
    size = np.sqrt(columns)
    off = 0.08 * RNG.uniform(-1.0, 1.0, (6, 6))
    extra = shrink[:, None, None] * (off + off.T) * np.outer(size, size) * (1.0 - np.eye(6))
    return Blade.from_stations(
        x, np.array(bare.section.stiffness) + extra, bare.section.mass, twist=[0.4, 0.2, 0.0]
    ).with_precone(0.05)


COUPLED = table()


def test_the_force_of_couplings_is_the_gradient_of_their_energy():
    row = _Row(ELEMENT, COUPLED, 4)
    at = row.reference + 0.1 * RNG.normal(size=row.reference.shape)
    at[:, 3:] /= np.linalg.norm(at[:, 3:], axis=1, keepdims=True)
    steps = 1e-6 * np.eye(at.size).reshape(-1, *at.shape)
    slope = (row.coupled_energy(at + steps) - row.coupled_energy(at - steps)) / 2e-6
    slope, force = (
        one.reshape(at.shape)
        for one in (slope, row.add.vector(row.own_force(row.add.gather(at.ravel()))))
    )
    for one in (slope, force):  # along p nothing turns: |p| = 1 holds it
        one[:, 3:] -= np.sum(one[:, 3:] * at[:, 3:], axis=1, keepdims=True) * at[:, 3:]
    # Central differences leave (1e-6)² and round-off 1e-16/1e-6.
    assert np.abs(slope - force).max() < 1e-8 * np.abs(force).max()


def coarse_and_fine(blade, omega, meshes, count):
    """Return errors (meshes, count) of frequencies, and (meshes,) of the tip over the length."""
    theory = ELEMENT.theory_of(blade)
    exact = linear_modes(blade, omega, count, theory=theory).frequencies
    tip = steady_state(blade, omega, theory=theory).tip
    start = steady_state(blade, 0.0, theory=theory).tip
    found = [Linearization.of(blade, omega, ELEMENT, n) for n in meshes]
    places = [one.tip * blade.length - (tip - start) for one in found]
    errors = np.array([one.frequencies(count) for one in found]) / exact - 1.0
    return np.abs(errors), np.linalg.norm(places, axis=1) / blade.length


HEAVY = (
    Blade(
        length=1.0,
        section=Section(axial_stiffness=1e4, bending_stiffness=1.0, mass_per_length=1.0),
    )
    .with_section_out_of_plane(0.25, 0.2)
    .with_offsets(mass=(0.03, 0.01))
    .with_twist(0.4)
    .with_point_mass(0.2, 0.55, offset=(0.03, 0.01))
    .with_tip_mass(0.2, offset=(0.03, 0.01))
)
"""With masses at the centers of mass of its sections."""


@pytest.mark.parametrize(
    "blade",
    [
        HEAVY,
        COUPLED,
        Blade(
            length=1.0,
            section=Section(axial_stiffness=1e4, bending_stiffness=1.0, mass_per_length=1.0),
        )
        .with_section_out_of_plane(0.0625, 0.08)
        .with_offsets(mass=(0.03, 0.01), tension=(-0.02, 0.0))
        .with_twist(0.4),
    ],
    ids=["masses", "table", "offsets"],
)
def test_couplings_and_offsets_converge_to_the_exact_blade(blade, fitted_order):
    """Of second order: errors of 1e-4 to 5e-3 with 32 elements."""
    meshes = [8, 16, 32]
    errors, places = coarse_and_fine(blade, 2.0, meshes, 3)
    assert errors[-1].max() < 5e-3
    assert places[-1] < 1e-4
    for error in (*errors.T, places):
        assert -fitted_order(meshes, error) == pytest.approx(2.0, abs=0.3)


@pytest.mark.filterwarnings("ignore::analytic.input_checks.RotbeamWarning")
@pytest.mark.parametrize(("name", "omega"), [("nrel_5mw", 1.267), ("iea_15mw", 0.7917)])
def test_a_shipped_blade_is_exact_to_1e_3_with_32_elements(name, omega):
    """In its first flap and lag and its tip, which go as 2e-4 and less; flap 3 is 1e-2 off."""
    errors, places = coarse_and_fine(load_beam(SHIPPED / f"{name}.toml"), omega, [32], 2)
    assert errors.max() < 4e-4
    assert places[0] < 1e-4


@pytest.mark.parametrize(
    ("blade", "supplied"), [(HEAVY, 0.1), (COUPLED, 0.2)], ids=["masses", "table"]
)
def test_loads_beside_the_nodes_reach_the_root_and_bring_their_energy(blade, supplied):
    """On mass, length and tip, with damping from outside; nodes are at the centers of mass.

    The constraints hold by the equations of motion what the sections carry by d'Alembert's
    principle: steps of 5 ms leave 1e-5 of 2. Jacobi's energy grows by what is supplied.
    """
    blade = blade.with_hub_radius(0.1).with_damping(Damping(external=0.05))
    loads = [
        Gravity(0.3, tilt=0.5), TipForce(amplitude=0.02, frequency=2.0),
        DistributedForce(amplitude=0.05, frequency=1.5),
    ]  # fmt: skip
    run = simulate(
        blade, SpinUp(omega=2.0, ramp_time=1.0), element=ELEMENT, elements=8, duration=1.25,
        step=5e-3, loads=loads, stations=[0.0, 1.0],
    )  # fmt: skip
    turn = run["section"][0, 0].to_numpy()
    for name in ("force", "moment"):
        root = np.stack([run[f"root_{name}_{axis}"] for axis in "xyz"], axis=1)
        np.testing.assert_allclose(root, run[name][:, 0].to_numpy() @ turn.T, atol=1e-4)
    gained = run["jacobi_energy"] - run["jacobi_energy"][0]
    np.testing.assert_allclose(gained, run["supplied_energy"], atol=1e-4)
    assert abs(run["supplied_energy"]).max() > supplied


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::analytic.input_checks.RotbeamWarning")
def test_a_run_of_nrel_has_the_places_and_loads_of_the_exact_blade():
    """16 elements and 5 ms leave 2e-3 of lag and of the root's moments."""
    blade = load_beam(SHIPPED / "nrel_5mw.toml")
    motion, time, at = SpinUp(omega=1.267, ramp_time=4.0), np.linspace(0.0, 6.0, 61), [0.0, 30.0]
    run = simulate(
        blade, motion, element=ELEMENT, elements=16, duration=6.0, step=5e-3, stations=[*at, 61.5]
    )
    theory = ELEMENT.theory_of(blade)
    exact = spin_up_response(blade, motion, time, theory=theory, tolerance=1e-3)
    kept, wanted = run.interp(time=time), exact.section_loads([*at, 61.5])
    for name in ("place", "force", "moment"):
        right = getattr(wanted, name)
        size = 1.3 if name == "place" else np.abs(right).max()
        np.testing.assert_allclose(kept[name], right, atol=4e-3 * size)


def test_viscosity_of_all_strains_is_that_of_the_exact_blade():
    """20 elements leave 1e-4 of a tip that each part of the damping moves by 2e-4 to 2e-2."""
    blade = COUPLED.with_damping(
        Damping(bending=0.1, out_of_plane=0.05, torsion=1.0, axial=10.0, shear=2.0, external=0.2)
    )
    motion, time = SpinUp(omega=2.0, ramp_time=2.0), np.linspace(0.5, 4.0, 8)
    theory = ELEMENT.theory_of(blade)
    run = simulate(blade, motion, element=ELEMENT, elements=20, duration=4.0, step=0.01)
    exact = spin_up_response(blade, motion, time, theory=theory, tolerance=1e-6).tip
    np.testing.assert_allclose(run["q"].interp(time=time), exact[:, 1], atol=1.3e-4)
    assert run.attrs["verdict"] == "passed"  # it supplies what the viscosity takes


def test_equal_stations_are_the_blade_of_ratios():
    """The limit of a table: one section all along, whose nodes and numbers are the same."""
    section = Section(axial_stiffness=1e3, bending_stiffness=1.0, mass_per_length=1.0)
    ratios = Blade(length=1.0, section=section).with_section_out_of_plane(0.25, 0.2)
    share = ELEMENT.shear_share
    columns = [1e3, 1e3 * share, 1e3 * share, 0.2, 0.25, 1.0]
    same = Blade.from_stations([0.0, 0.5, 1.0], [columns] * 3, [[1.0, 1.25e-3, 0.25e-3, 1e-3]] * 3)
    found = [
        natural_frequencies(one.with_twist(0.3) if one is ratios else twisted(one), 2.0,
                            element=ELEMENT, elements=8)
        for one in (ratios, same)
    ]  # fmt: skip
    np.testing.assert_allclose(*found, rtol=1e-9)


def twisted(blade):
    """Return the table with the twist of the blade of ratios, at its stations."""
    return blade.with_twist(((0.0, 0.0), (0.5, 0.15), (1.0, 0.3)))
