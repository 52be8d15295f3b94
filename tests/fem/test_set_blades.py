"""Blades set at an angle, from lag to flap, in Exudyn: against the exact blade and its orbits."""

import math

import numpy as np
import pytest

from analytic import SpinUp, SteadyRotation, periodic_orbits, spin_up_response
from analytic.exact.continuum.planar_kinematics import set_at
from analytic.quadrature import gauss_points
from rotbeam_exu import natural_frequencies, simulate
from rotbeam_exu.fem import add_rotating_beam
from rotbeam_exu.fem.elements import FORMULATIONS, formulation
from rotbeam_exu.fem.linearization import Linearization
from rotbeam_exu.fem.solver import mass_matrix
from rotbeam_exu.runs.check import _reach

FLAP = 0.5 * math.pi
GAUSS = np.append(gauss_points(40)[0], 1.0)


@pytest.fixture(scope="module")
def heavy(beam):
    return beam.with_hub_radius(0.8).with_tip_mass(0.5)


@pytest.mark.parametrize("element", ["cable", "exact", "ancf3"])
def test_flap_squared_is_lag_squared_and_the_speed_squared(heavy, element):
    """So it is of an inextensible blade; the Coriolis force along a blade that gives is of μ w̄²."""
    omega = 6.0
    lag, flap = (
        natural_frequencies(blade, omega, element=element, elements=8, count=2)
        for blade in (heavy, heavy.with_setting_angle(FLAP))
    )
    w_bar = omega / heavy.frequency_scale
    allowed = 4.0 * heavy.slenderness * w_bar**2
    assert flap**2 == pytest.approx(lag**2 + omega**2, rel=allowed)


def test_all_of_the_rotation_stretches_the_blade_at_any_angle(heavy):
    blades = (heavy, heavy.with_setting_angle(FLAP))
    lag, flap = (Linearization.of(blade, 6.0, elements=8) for blade in blades)
    assert flap.stretch == pytest.approx(lag.stretch, rel=1e-12)
    assert flap.growth_rate == 0.0


@pytest.mark.parametrize("name", [n for n, c in FORMULATIONS.items() if not c.leaves_plane])
def test_mass_couples_what_is_along_the_blade_with_nothing_across(beam, name):
    """By this M P e and M J² e are gradients, those of ½w²∫((R + x)² + c²y²) dm."""
    model = formulation(name)
    mass = mass_matrix(model, beam, 3).toarray()
    nodes = mass.shape[0] // model.angles.size
    across = np.tile((model.quarter_turn > 0.0).any(axis=1), nodes)
    along = np.tile((model.quarter_turn > 0.0).any(axis=0), nodes)
    assert np.abs(mass[np.ix_(along, across)]).max() == 0.0
    assert mass[np.ix_(along, along)] == pytest.approx(mass[np.ix_(across, across)], abs=1e-15)


def kinetics(blade, w, state):
    """T and L_z of blade.md's integrals over dm, the tip mass's point last."""
    own = blade.mass - blade.point_masses[0].mass
    dm = np.append(own * gauss_points(40)[1], blade.point_masses[0].mass)
    c, (x, y, _), (x_dot, y_dot, _) = math.cos(blade.setting_angle), state.place.T, state.velocity.T
    x = blade.hub_radius + x
    across = x * y_dot - y * x_dot
    relative = x_dot**2 + y_dot**2
    around = x**2 + c**2 * y**2
    kinetic = 0.5 * dm @ (relative + 2.0 * w * c * across + w**2 * around)
    return kinetic, dm @ (c * across + w * around)


def test_a_blade_with_all_there_is_follows_the_exact_one(beam):
    """Hub, taper, masses with inertia and a setting angle; the paper's element sees the taper."""
    m0, length = beam.mass_per_length, beam.length
    blade = beam.with_hub_radius(0.5).with_taper(0.2, 0.3).with_setting_angle(0.25 * math.pi)
    blade = blade.with_point_mass(0.1 * m0 * length, 0.5 * length)
    blade = blade.with_tip_mass(0.1 * m0 * length, 0.02 * m0 * length**3)
    spin_up = SpinUp(omega=3.0, ramp_time=3.0)
    run = simulate(
        blade, spin_up, element="ancf3", elements=8, duration=5.0, step=4e-3, frame="rotating"
    )
    exact = spin_up_response(blade, spin_up, run["time"].to_numpy(), tolerance=1e-5)
    size = np.abs(exact.q).max()
    assert run.attrs["verdict"] == "passed"
    # Mesh and step leave 2e-4, the shear and the sections' inertia less.
    assert np.abs(run["q"] - exact.q).max() < 4e-4 * size
    assert np.abs(run["q_dot"] - exact.q_dot).max() < 4e-4 * np.abs(exact.q_dot).max()
    for k, name in enumerate(("tip_x", "tip_y")):
        assert np.abs(run[name] - exact.from_axis[:, k]).max() < 4e-4 * size
    # From above the tip seems nearer to the clamp than it is, by 4e-2 of the largest deflection.
    away = np.hypot(exact.tip[:, 0], exact.q)
    assert np.abs(_reach(run) - away).max() < 4e-4 * size


def test_an_orbit_stays_the_orbit_and_keeps_its_jacobi_energy(beam):
    """The Euler force bends a blade near flap hardly: an orbit is what sets it in motion."""
    blade, omega = beam.with_hub_radius(0.8).with_tip_mass(0.5).with_setting_angle(1.2), 3.0
    orbit = periodic_orbits(blade, omega, [0.2], mode="flap 1")
    run = simulate(
        blade, SteadyRotation(omega=omega), elements=16, duration=3.0, step=1e-3, frame="rotating",
        initial_state=lambda x: orbit.state(0, x),
    )  # fmt: skip
    seen = run.isel(time=slice(None, None, 10))
    phase = orbit.frequency[0] * seen["time"].to_numpy()
    plane = set_at(blade.setting_angle)
    exact = [orbit.state(0, [blade.length], p).seen_from(plane).place[0, 1] for p in phase]
    assert np.abs(seen["q"] - exact).max() < 1e-3 * np.abs(exact).max()
    jacobi = run["jacobi_energy"].to_numpy()
    # Of second order in the step; a wrong energy would vary by the elastic one.
    assert np.ptp(jacobi) < 1e-5 * run["elastic_energy"].max()
    kinetic, momentum = kinetics(
        blade, omega, orbit.state(0, GAUSS * blade.length).seen_from(plane)
    )
    assert run["kinetic_energy"][0] == pytest.approx(kinetic, rel=1e-6)
    elastic = run["elastic_energy"][0].item()
    assert jacobi[0] - elastic == pytest.approx(kinetic - omega * momentum, rel=1e-6)


def test_in_an_exudyn_system_of_ones_own_it_is_refused(beam):
    blade = beam.with_setting_angle(0.3)
    with pytest.raises(ValueError, match="setting angle with the cosine 0.9553: take frame='r"):
        add_rotating_beam(None, blade, SpinUp(omega=4.0, ramp_time=3.0))
