"""Loads of runs at the root and at stations, and their shape, beside the exact beam and energy."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import cumulative_simpson

from analytic import (
    Damping,
    DistributedForce,
    Gravity,
    PointMass,
    SpeedRipple,
    SpinUp,
    SteadyRotation,
    Theory,
    TipForce,
    linear_modes,
    periodic_orbits,
    spin_up_response,
)
from rotbeam_exu import simulate
from rotbeam_exu.figures import strain_along
from rotbeam_exu.runs.shape import outer_strain, shape_of, strain_at, vibration_of
from tests.beams import unit_beam

TIMES = np.linspace(0.0, 4.0, 101)
ROOT = ("root_force_x", "root_force_y", "root_moment_z")
STATIONS = [0.0, 1.3, 4.0, 7.7, 8.0]  # of the meshes below two are at nodes
MESHES = [6, 8, 12]


@pytest.fixture(scope="module")
def along(beam, spin_up):
    """The exact answer at the stations."""
    return spin_up_response(beam, spin_up, TIMES, tolerance=1e-8).section_loads(STATIONS)


@pytest.fixture(scope="module")
def refined(beam, spin_up):
    """Runs on finer and finer meshes; steps of 2 ms leave 4e-6 in the rotating frame."""
    settings = {"duration": 4.0, "step": 2e-3, "frame": "rotating", "stations": STATIONS}
    return [simulate(beam, spin_up, elements=n, **settings) for n in MESHES]


def at_root(run):
    """Tension, shear force and moment of a run at the root, (times, 3)."""
    seen = run.sel(time=TIMES, method="nearest")
    np.testing.assert_allclose(seen["time"], TIMES, atol=1e-9)
    return np.stack([seen[name] for name in ROOT], axis=1)


def off(run, along):
    """Largest errors of a run's shape and loads at all stations over the largest, by name."""
    exact = shape_of(along)
    seen = run.sel(time=TIMES, method="nearest").assign_coords(time=exact["time"])
    return {
        name: float(abs(seen[name] - one).max() / abs(one).max())
        for name, one in exact.data_vars.items()
    }


def errors(found, exact):
    """Largest errors over the largest of the exact ones, (3,)."""
    return np.abs(found - exact).max(axis=0) / np.abs(exact).max(axis=0)


def test_they_go_to_the_exact_ones_with_the_fourth_power_of_the_mesh(refined, along, fitted_order):
    """Shape and loads: 12 cables leave 2e-4 to 5e-4 of the largest, between nodes as at nodes."""
    found = [off(run, along) for run in refined]
    for name in found[0]:
        error = [one[name] for one in found]
        assert -fitted_order(MESHES, error) == pytest.approx(4.0, abs=0.4), name
        assert error[-1] < 6e-4, name


def test_they_go_with_the_square_of_the_step(beam, spin_up, fitted_order):
    """To those of the finest step, one mesh; in the inertial frame, where steps count."""
    steps = [8e-3, 4e-3, 2e-3, 5e-4]
    *runs, finest = (
        at_root(simulate(beam, spin_up, elements=4, duration=4.0, step=h)) for h in steps
    )
    found = np.array([errors(run, finest) for run in runs])
    for error in found.T:
        assert fitted_order(steps[:3], error) == pytest.approx(2.0, abs=0.2)


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
    expected = np.column_stack((exact.force[:, 0, :2], exact.moment[:, 0, 2]))
    error = errors(np.stack([run[name] for name in ROOT], axis=1), expected)
    # By the mesh, and by the axial waves with which its coarser shape starts.
    assert (error < [5e-3, 2e-3, 3e-4]).all()


BODIES = (PointMass(position=4.0, mass=0.3, inertia=0.1), PointMass(position=8.0, mass=0.2))
IN_SPACE = {"bending_ratio": 0.25, "torsion_ratio": 0.2}


@pytest.mark.parametrize(
    ("element", "frame", "changed"),
    [
        ("cable", "rotating", "driven"), ("cable", "inertial", "driven"),
        ("cable", "rotating", "set"), ("cable", "inertial", "bodies"),
        ("exact", "rotating", "thick"), ("exact", "inertial", "hub"),
        ("ancf3", "inertial", "hub"), ("space_cable", "rotating", "round"),
        ("space_exact", "inertial", "twisted"),
    ],
)  # fmt: skip
def test_the_station_at_the_root_has_the_forces_of_the_constraints(beam, element, frame, changed):
    """Two ways to one number: all inertia and loads, and what holds the root. Measured 3e-8.

    The place of the last station is that of the tip, and sections are orthonormal. The torque is
    the moment of what holds the root, and supplies the energy.
    """
    hub = beam.with_hub_radius(0.5)
    blade = {
        "hub": hub,
        "driven": hub.with_damping(Damping(bending=0.02, external=0.05)),
        "set": hub.with_setting_angle(0.8),
        "thick": replace(
            beam, second_moment=3e3 * beam.second_moment, youngs_modulus=beam.youngs_modulus / 3e3
        )
        .with_hub_radius(0.5)
        .with_setting_angle(0.8),
        "bodies": replace(hub, point_masses=BODIES),
        "twisted": hub.with_section_out_of_plane(**IN_SPACE)
        .with_twist(0.5)
        .with_precone(0.1)
        .with_setting_angle(0.3),
        "round": beam.with_section_out_of_plane(1.0, 0.8),
    }[changed]
    driven = [
        TipForce(amplitude=0.5, frequency=3.0), DistributedForce(amplitude=0.1, frequency=2.0),
        Gravity(0.5), SpeedRipple(amplitude=0.1, frequency=2.0),
    ]  # fmt: skip
    loads = {"driven": driven, "twisted": [Gravity(0.5, tilt=0.6)]}.get(changed, [])
    motion = SpinUp(omega=1.0, ramp_time=2.0)
    run = simulate(
        blade, motion, element=element, frame=frame, elements=4, duration=2.5, step=2e-3,
        stations=[0.0, 3.0, 8.0], loads=loads,
    )  # fmt: skip
    # What acts at the tip is outboard of it: the force, but no moment of a blade without a body.
    at_end = {"driven": 0.5, "bodies": None}.get(changed, 0.0)
    if at_end is not None:
        assert float(abs(run["force"][:, -1]).max()) == pytest.approx(at_end, rel=1e-3)
        assert float(abs(run["moment"][:, -1]).max()) == 0.0
    space = "axis" in run
    section, place = run["section"].to_numpy(), run["place"].to_numpy()
    np.testing.assert_allclose(
        np.swapaxes(section, -1, -2) @ section,
        np.broadcast_to(np.eye(3), section.shape),
        atol=1e-14,
    )
    for kind in ("force", "moment"):
        # By the axes of the clamp, as the columns.
        at_root = (section[:, 0] @ run[kind].to_numpy()[:, 0, :, None])[..., 0]
        by_clamp = np.column_stack([run[f"root_{kind}_{axis}"] for axis in "xyz"])
        np.testing.assert_allclose(at_root, by_clamp, atol=1e-6 * np.abs(by_clamp).max())
    if space or not blade.setting_angle:  # else what holds it in its plane has a share
        cone, hub = blade.line.precone, blade.hub_radius
        moment = np.cos(cone) * run["root_moment_z"] + hub * run["root_force_y"]
        if space:
            moment += np.sin(cone) * run["root_moment_x"]
        np.testing.assert_allclose(run["clamp_torque"], -moment, atol=1e-9 * abs(moment).max())
    if not loads:
        time, energy = run["time"].to_numpy(), run["kinetic_energy"] + run["elastic_energy"]
        work = cumulative_simpson(run["clamp_torque"] * motion.rate(time), x=time, initial=0.0)
        np.testing.assert_allclose(work, energy - energy[0], atol=1e-4 * energy.max().item())
    if space:
        tip = run["axis"].to_numpy()[:, -1] - run["axis"].to_numpy()[:, 0]
        np.testing.assert_allclose(place[:, -1], tip, atol=1e-7)
    else:
        lag, flap = (run["q"] * f(blade.setting_angle) for f in (np.cos, np.sin))
        np.testing.assert_allclose(place[:, -1, 1:], np.transpose([lag, flap]), atol=1e-12)


def test_the_largest_strain_is_that_of_the_fiber_farthest_from_the_axis(beam, refined):
    """Of the exact section's law: ε and κ of the cable's own shape are near N/EA and M/EI."""
    run = refined[-1]
    height = np.sqrt(12.0 * beam.second_moment / beam.area)
    strain = outer_strain(run, height)
    by_hand = (
        abs(run["force"].sel(section_axis="normal")) / beam.axial_stiffness
        + 0.5 * height * abs(run["moment"].sel(section_axis="thickness")) / beam.bending_stiffness
    )
    np.testing.assert_allclose(strain, by_hand, rtol=1e-12)
    # By the shape: κ = dφ/dx between two near stations, EI of the paper's beam being uniform.
    near = simulate(
        beam, SpinUp(omega=6.0, ramp_time=3.0), elements=12, duration=4.0, step=4e-3,
        frame="rotating", stations=[3.99, 4.0, 4.01],
    )  # fmt: skip
    angle = np.arctan2(*(near["section"].sel(section_axis="normal", direction=d) for d in "yx"))
    bent = np.diff(np.asarray(angle)[:, [0, 2]], axis=1)[:, 0] / 0.02
    curvature = near["curvature"].sel(section_axis="thickness").isel(station=1)
    np.testing.assert_allclose(curvature, bent, atol=2e-2 * np.abs(bent).max())


def test_stress_is_drawn_along_the_span(along):
    """The band of each point, in MPa."""
    found = strain_at(shape_of(along), [(0.018, 0.0), (-0.018, 0.0)], 7e10)
    axes = strain_along(found)
    assert axes.get_ylabel() == "stress at the point [MPa]"
    least, greatest = (np.asarray(line.get_ydata()) for line in axes.lines[:2])
    np.testing.assert_allclose(least, found["stress"][..., 0].min("time"))
    np.testing.assert_allclose(greatest, found["stress"][..., 0].max("time"))
    (line,) = strain_along(found["strain"].isel(time=3, point=[1]).to_dataset()).lines[:1]
    np.testing.assert_allclose(line.get_ydata(), found["strain"][3, :, 1])
    with pytest.raises(ValueError, match="draws what runs.shape.strain_at returns"):
        strain_along(shape_of(along))


def test_a_mode_vibrates_about_the_steady_state():
    """At rest as the cantilever's closed form, by the cosine of its own frequency."""
    blade = unit_beam(1e-6).with_section_out_of_plane(0.25, 0.2)
    modes, x = linear_modes(blade, 0.0, 4, theory=Theory(extension=False)), np.linspace(0.0, 1.0, 5)
    root = 4.694091132974175  # of 1 + cos β cosh β
    ratio = (np.cosh(root) + np.cos(root)) / (np.sinh(root) + np.sin(root))
    bent = np.cosh(root * x) - np.cos(root * x) - ratio * (np.sinh(root * x) - np.sin(root * x))
    data = vibration_of(modes, "lag 2", x, amplitude=0.05, pictures=20)
    assert data["time"][20] == pytest.approx(2.0 * np.pi / root**2, rel=1e-6)
    swing = np.outer(np.cos(root**2 * data["time"]), 0.05 * bent / bent[-1])
    np.testing.assert_allclose(data["place"][..., 1], swing, atol=1e-6)
    np.testing.assert_allclose(data["place"][..., 0], np.tile(x, (40, 1)), atol=1e-9)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"mode": "flap 9"}, "mode must be one of lag 1, .*got 'flap 9'"),
        ({"mode": 1}, "mode must be one of lag 1"),
        ({"amplitude": -0.1}, "amplitude must be positive"),
        ({"pictures": 0}, "pictures must be"),
        ({"points": [0.0, 2.0]}, "points"),
    ],
)
def test_what_is_no_vibration_is_refused(change, sentence):
    modes = linear_modes(unit_beam(1e-3), 0.0, 2)
    with pytest.raises(ValueError, match=sentence):
        vibration_of(modes, **{"mode": "lag 1", "points": [0.0, 1.0], **change})
