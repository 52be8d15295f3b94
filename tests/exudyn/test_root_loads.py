"""Root force, root moment and the clamp's torque of runs, beside the exact beam and the energy."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import cumulative_simpson

from analytic import (
    Damping,
    Gravity,
    SpinUp,
    SteadyRotation,
    TipForce,
    periodic_orbits,
    spin_up_response,
)
from rotbeam_exu import simulate

WITHOUT_HUB = ("linear", "substructures", "space_cable")
TIMES = np.linspace(0.0, 4.0, 101)
ROOT = ("root_force_x", "root_force_y", "root_moment_z")


@pytest.fixture(scope="module")
def exact(beam, spin_up):
    """Tension, shear force and moment at the root, (times, 3)."""
    found = spin_up_response(beam, spin_up, TIMES, tolerance=1e-8).section_loads([0.0])
    return np.column_stack((found.force[:, 0], found.moment))


def at_root(run):
    """Tension, shear force and moment of a run at the root, (times, 3)."""
    seen = run.sel(time=TIMES, method="nearest")
    np.testing.assert_allclose(seen["time"], TIMES, atol=1e-9)
    return np.stack([seen[name] for name in ROOT], axis=1)


def errors(found, exact):
    """Largest errors over the largest of the exact ones, (3,)."""
    return np.abs(found - exact).max(axis=0) / np.abs(exact).max(axis=0)


def test_they_go_to_the_exact_ones_with_the_fourth_power_of_the_mesh(
    beam, spin_up, exact, fitted_order
):
    """Steps of 2 ms leave 4e-6 in the rotating frame; 16 cables leave 1.5e-4."""
    meshes = [6, 8, 12]
    runs = [
        simulate(beam, spin_up, elements=n, duration=4.0, step=2e-3, frame="rotating")
        for n in meshes
    ]
    found = [errors(at_root(run), exact) for run in runs]
    for error in np.array(found).T:
        assert -fitted_order(meshes, error) == pytest.approx(4.0, abs=0.4)
    assert found[-1].max() < 1e-3


@pytest.mark.slow
@pytest.mark.parametrize(("frame", "step"), [("rotating", 1e-3), ("inertial", 5e-4)])
def test_64_cables_have_them_to_1e_4(beam, spin_up, exact, frame, step):
    """Measured 1e-5 and 3e-5 of the largest moment, of the step."""
    run = simulate(beam, spin_up, elements=64, duration=4.0, step=step, frame=frame)
    assert errors(at_root(run), exact).max() < 1e-4


def test_they_go_with_the_square_of_the_step(beam, spin_up, fitted_order):
    """To those of the finest step, one mesh; in the inertial frame, where steps count."""
    steps = [8e-3, 4e-3, 2e-3, 5e-4]
    *runs, finest = (
        at_root(simulate(beam, spin_up, elements=4, duration=4.0, step=h)) for h in steps
    )
    found = np.array([errors(run, finest) for run in runs])
    for error in found.T:
        assert fitted_order(steps[:3], error) == pytest.approx(2.0, abs=0.2)


@pytest.mark.parametrize(
    ("element", "frame"),
    [
        *(("cable", frame) for frame in ("inertial", "rotating")), ("set", "rotating"),
        ("exact", "inertial"), ("space_exact", "inertial"),
        *(
            pytest.param(element, frame, marks=pytest.mark.slow)  # each by the columns of all
            for element, frame in (
                ("ancf3", "inertial"), ("ancf3", "rotating"), ("linear", "inertial"),
                ("substructures", "rotating"), ("space_cable", "inertial"),
            )
        ),
    ],
)  # fmt: skip
def test_the_torque_supplies_the_energy(beam, element, frame):
    """∫ T θ' dt is all the energy, and T the moment of the root's loads, of each kind of node."""
    blade, motion = beam, SpinUp(omega=1.0, ramp_time=2.0)
    hub = 0.0 if element in WITHOUT_HUB else 0.5
    if hub:
        blade = beam.with_hub_radius(hub)
    if element == "set":
        blade, element = blade.with_setting_angle(0.8), "cable"
    if element == "space_exact":
        blade = blade.with_section_out_of_plane(0.25, 0.2).with_twist(0.5)
    if element == "space_cable":
        blade = blade.with_section_out_of_plane(1.0, 0.8)
    run = simulate(blade, motion, element=element, elements=4, duration=2.5, step=2e-3, frame=frame)
    time, energy = run["time"].to_numpy(), (run["kinetic_energy"] + run["elastic_energy"])
    work = cumulative_simpson(run["clamp_torque"] * motion.rate(time), x=time, initial=0.0)
    np.testing.assert_allclose(work, energy - energy[0], atol=1e-4 * energy.max().item())
    if blade.blade.setting_angle:
        return  # what holds it in its plane has a share
    moments = run["root_moment_z"] + hub * run["root_force_y"]
    np.testing.assert_allclose(run["clamp_torque"], -moments, atol=1e-9 * abs(moments).max().item())


def test_a_set_blade_takes_the_torque_of_its_energy_and_of_its_weight(beam):
    """∫ (T + Q) θ' dt; Q is the weight's moment about the axis, of its center of mass.

    A thousand times as stiff, the blade stays nearly straight.
    """
    blade = replace(beam, youngs_modulus=1e3 * beam.youngs_modulus).with_setting_angle(0.8)
    motion, g = SpinUp(omega=2.0, ramp_time=2.0), 0.5
    run = simulate(
        blade, motion, elements=2, duration=2.5, step=1e-3, frame="rotating", loads=[Gravity(g)]
    )
    time, energy = run["time"].to_numpy(), run["kinetic_energy"] + run["elastic_energy"]
    weight = -g * blade.mass * 0.5 * blade.length * np.cos(run["angle"])
    power = (run["clamp_torque"] + weight) * motion.rate(time)
    work = cumulative_simpson(power, x=time, initial=0.0)
    np.testing.assert_allclose(work, energy - energy[0], atol=3e-3 * energy.max().item())


@pytest.mark.parametrize("angle_set", [0.0, 0.8])
def test_under_a_load_the_torque_changes_the_angular_momentum(beam, angle_set):
    """∫ (T + Q) dt = L_z, Q being the moment of the load at the tip; the blade is viscous."""
    blade = beam.with_hub_radius(0.5).with_damping(Damping(bending=0.02))
    blade = blade.with_setting_angle(angle_set)
    load, motion = TipForce(amplitude=0.5, frequency=3.0), SpinUp(omega=2.0, ramp_time=2.0)
    run = simulate(
        blade, motion, elements=4, duration=3.0, step=2e-3, loads=[load], frame="rotating"
    )
    time, angle = run["time"].to_numpy(), run["angle"].to_numpy()
    energy = run["kinetic_energy"] + run["elastic_energy"]
    rate = motion.rate(time)
    momentum = np.zeros_like(time)
    momentum[1:] = (energy - run["jacobi_energy"])[1:] / rate[1:]
    # Across the blade in its plane of bending, of which the axis sees the cosine.
    force = np.cos(angle_set) * load.force(3.0 * time, angle, 1.0) * np.exp(1j * angle)
    moment = (np.conj(run["tip_x"] + 1j * run["tip_y"]) * force).to_numpy().imag
    gained = cumulative_simpson(run["clamp_torque"] + moment, x=time, initial=0.0)
    np.testing.assert_allclose(gained, momentum, atol=1e-3 * np.abs(momentum).max())


def test_an_orbit_has_those_of_the_orbit_from_its_first_sample_on(beam):
    orbit = periodic_orbits(beam, 4.0, [0.2])
    run = simulate(
        beam, SteadyRotation(omega=4.0), elements=12, duration=2.0, step=1e-3, frame="rotating",
        initial_state=lambda x: orbit.state(0, x),
    )  # fmt: skip
    exact = orbit.section_loads(0, [0.0], orbit.frequency[0] * run["time"].to_numpy())
    expected = np.column_stack((exact.force[:, 0], exact.moment))
    error = errors(np.stack([run[name] for name in ROOT], axis=1), expected)
    # By the mesh, and by the axial waves with which its coarser shape starts.
    assert (error < [5e-3, 2e-3, 3e-4]).all()
