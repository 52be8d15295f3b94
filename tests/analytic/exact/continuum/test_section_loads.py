"""Loads in the sections of exact answers: closed forms, constitutive law, energy, symmetry."""

import math

import numpy as np
import pytest

from analytic import (
    Blade,
    Damping,
    Gravity,
    Section,
    SpinUp,
    Theory,
    TipForce,
    forced_response,
    periodic_orbits,
    spin_up_response,
    steady_state,
)
from analytic.exact.continuum.loading import pushes, unit_load
from analytic.exact.continuum.planar_rotation import blade_continuum
from analytic.exact.continuum.rotation import SteadyBlade
from analytic.exact.continuum.state import Driven
from analytic.quadrature import gauss_points
from analytic.theory import BERNOULLI_EULER
from rotbeam_exu.runs.shape import shape_of

RIGID = Theory(extension=False)
SECTION = Section(axial_stiffness=1e4, bending_stiffness=1.0, mass_per_length=1.0)
STRAIGHT = Blade(length=1.0, section=SECTION).with_section_out_of_plane(0.25, 0.2)
X = np.array([0.0, 0.3, 0.6, 1.0])


@pytest.mark.parametrize("taper", [0.0, 0.5])
def test_at_rest_under_gravity_the_moment_is_the_weight_times_its_lever(beam, taper):
    """The weight hangs along the blade and across it; mass from 1 to 1 - t along it, a tip mass."""
    g, angle, tip = 9.81, 0.7, 0.3
    blade = beam.with_taper(taper, 0.0) if taper else beam
    blade = blade.with_tip_mass(tip)
    m0, length = blade.mass_per_length, blade.length
    model = blade_continuum(blade, BERNOULLI_EULER, 8, 4)
    load = unit_load(blade, Gravity(g))
    at_angle = np.array([angle])
    push, _ = pushes(model, [(load, at_angle)], at_angle)
    still = np.zeros((1, model.size))
    x = np.array([0.0, 0.3, 0.7, 1.0])
    force, moment = model.section_loads(x, still, still, still, Driven(0.0, push=push))
    mass = m0 * length * ((1.0 - x) - 0.5 * taper * (1.0 - x**2)) + tip
    first = 0.5 * (1.0 - x**2) - taper * (1.0 - x**3) / 3.0  # ∫ m x beyond
    lever = m0 * length**2 * (first - x * ((1.0 - x) - 0.5 * taper * (1.0 - x**2)))
    lever += tip * length * (1.0 - x)
    unit = blade.bending_stiffness / length
    weight = Gravity(g).force(0.0, angle, 1.0)
    assert unit / length * force[0, :, 0] == pytest.approx(weight.real * mass, rel=1e-12)
    assert unit / length * force[0, :, 1] == pytest.approx(weight.imag * mass, rel=1e-12)
    # Round-off of the largest.
    bending = weight.imag * lever
    assert unit * moment[0, :, 2] == pytest.approx(bending, abs=1e-12 * g * lever[0])


@pytest.mark.parametrize("hub", [0.0, 0.3])
def test_the_tension_of_steady_rotation_is_that_of_the_mass_beyond(hub):
    """N = ω² ∫ m r dm: m(L - x)(R + (L + x)/2) and the mass at 0.6, from which it jumps."""
    w, lumped = 2.0, 0.5
    blade = STRAIGHT.with_hub_radius(hub).with_point_mass(lumped, 0.6)
    found = steady_state(blade, w, theory=RIGID).section_loads([*X, 0.6 - 1e-12])
    x = found.stations
    closed = w**2 * ((1.0 - x) * (hub + 0.5 * (1.0 + x)) + lumped * (hub + 0.6) * (x < 0.6))
    assert found.tension == pytest.approx(closed, rel=1e-11, abs=1e-11)
    jump = found.tension[-1] - found.tension[2]
    assert jump == pytest.approx(lumped * w**2 * (hub + 0.6), rel=1e-9)
    assert np.abs(found.force[:, 1:]).max() < 1e-11
    assert np.abs(found.moment).max() < 1e-11


def test_the_tension_of_a_stretched_blade_is_that_of_its_elongation():
    """N = EA (cos kx/cos k - 1) with k = ω √(m/EA) L; the planar system and that of space."""
    w, blade = 20.0, STRAIGHT
    model = blade_continuum(blade, BERNOULLI_EULER, 8, 8)
    steady = SteadyBlade(model, w)
    q = steady.equilibrium[None]
    planar, moment = steady.section_loads(X, q, 0.0 * q, 0.0 * q)
    k = w / 100.0
    closed = 1e4 * (np.cos(k * X) / math.cos(k) - 1.0)
    assert planar[0, :, 0] == pytest.approx(closed, rel=1e-11, abs=1e-8)
    assert np.abs(moment).max() < 1e-10
    assert steady_state(blade, w).section_loads(X).tension == pytest.approx(closed, abs=1e-7)


def test_a_load_at_the_tip_bends_by_its_lever_whatever_the_shape():
    """At rest, bent, twisted and turned by half its length: r × F + M of the deflected axis."""
    force, moment = np.array([0.3, 1.0, 0.5]), np.array([0.1, 0.2, -0.3])
    blade = STRAIGHT.with_twist(0.6).with_prebend(0.2).with_setting_angle(0.3)
    found = steady_state(blade, 0.0, force=force, moment=moment)
    loads, axis = found.section_loads(X), found.axis(X)
    closed = moment + np.cross(found.tip - axis, force)
    # In the section's axes only their sizes are known without its frames; at the clamp all.
    assert np.linalg.norm(loads.force, axis=1) == pytest.approx(np.linalg.norm(force), rel=1e-10)
    expected = np.linalg.norm(closed, axis=1)
    assert np.linalg.norm(loads.moment, axis=1) == pytest.approx(expected, rel=1e-9)
    c, s = math.cos(0.3), math.sin(0.3)
    turn = np.array([[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c]])
    assert loads.force[0] == pytest.approx(turn @ force, rel=1e-10)
    assert loads.moment[0] == pytest.approx(turn @ closed[0], rel=1e-9)


def test_damped_thick_and_loaded_the_moment_is_that_of_the_section_too(beam):
    """M = EI (κ + η κ̇), with shear, rotary inertia, a tip mass with inertia, drag and a load."""
    eta = 0.02
    blade = beam.with_hub_radius(0.5).with_tip_mass(0.3, 2.0).with_point_mass(0.4, 3.0, 1.0)
    blade = blade.with_damping(Damping(bending=eta, external=0.05))
    theory = Theory(shear=0.3, rotary_inertia=True)
    x = [0.0, 3.0, 7.0]
    loads = [Gravity(1.0), TipForce(amplitude=0.5, frequency=2.0)]
    found = spin_up_response(
        blade, SpinUp(omega=4.0, ramp_time=2.0), np.linspace(0.5, 3.0, 6), tolerance=1e-7,
        theory=theory, loads=loads,
    )  # fmt: skip
    model, per_second = found.model, blade.frequency_scale
    q, q_dot, _ = found._state[:, :, : model.bending]
    bent = (q + eta * per_second * q_dot) @ model._across.strain(np.array(x) / blade.length).T
    law = blade.bending_stiffness / blade.length * bent
    by_dalembert = found.section_loads(x).moment[..., 2]
    assert by_dalembert == pytest.approx(law, abs=1e-5 * np.abs(law).max())
    # Inertia against rotation at the tip leaves a moment there, which no other part does.
    assert np.abs(found.section_loads([blade.length]).moment).max() > 1e-3 * np.abs(law).max()


@pytest.mark.parametrize("hub", [0.0, 0.6])
def test_the_power_of_the_root_loads_is_the_rate_of_the_energy(beam, spin_up, hub):
    """∫ T θ' dt of T = -(M + R Q) is all the energy at the end of the spin-up.

    Without extension, whose short waves the Gauss points of time do not see.
    """
    blade = beam.with_hub_radius(hub)
    nodes, weights = gauss_points(150)
    times = np.append(3.0 * nodes, 3.0)
    found = spin_up_response(blade, spin_up, times, tolerance=1e-8, theory=RIGID)
    root = found.section_loads([0.0])
    torque = -(root.moment[:, 0, 2] + hub * root.force[:, 0, 1])
    work = 3.0 * weights @ (torque * spin_up.rate(times))[:-1]
    x, dx = gauss_points(40)
    model, length, per_second = found.model, blade.length, blade.frequency_scale
    q, q_dot, _ = found._state[:, -1:]
    z = hub + length * model.integrated(model.slope(q), x)
    z_dot = length * per_second * model.integrated(model.slope_rate(q, q_dot), x)
    speed = np.abs(z_dot + 1j * spin_up.omega * z) ** 2
    kinetic = 0.5 * blade.mass_per_length * length * (speed @ dx)[0]
    elastic = 0.5 * blade.bending_stiffness / length * np.sum(q**2)
    assert work == pytest.approx(kinetic + elastic, rel=1e-9)


def test_an_orbit_has_them_mirrored_in_reversed_time(beam):
    """N is even about the straight shape, Q and M are odd; M of the curvature at every phase."""
    orbits = periodic_orbits(beam, 6.0, [0.3])
    phase, x = np.linspace(0.1, 3.0, 7), [0.0, 2.0, 6.0]
    there, back = orbits.section_loads(0, x, phase), orbits.section_loads(0, x, -phase)
    scale = np.abs(there.moment).max()
    assert back.moment == pytest.approx(-there.moment, abs=1e-12 * scale)
    assert back.force[..., 0] == pytest.approx(there.tension, abs=1e-12 * np.abs(there.force).max())
    assert back.force[..., 1] == pytest.approx(
        -there.force[..., 1], abs=1e-12 * np.abs(there.force).max()
    )
    orbit = orbits.nondimensional[0]
    q = orbit.coordinates(phase)[0][:, : orbit.system.model.bending]
    bent = q @ orbit.system.model._across.strain(np.array(x) / beam.length).T
    law = beam.bending_stiffness / beam.length * bent
    assert there.moment[..., 2] == pytest.approx(law, abs=1e-6 * scale)


def test_under_gravity_a_forced_response_carries_its_weight(beam):
    """Averaged over a turn, in space: the root's force is the weight less the drag."""
    drag, turns = 0.05, np.arange(64) / 64
    blade = beam.with_damping(Damping(external=drag))
    found = forced_response(blade, [1.0, 1.1], Gravity(0.5), functions=8)
    i, phase = int(found.at(1.0)[0]), 2.0 * math.pi * turns
    root = found.section_loads(i, [0.0], phase).force[:, 0] @ [1.0, 1j, 0.0]
    model, (q, q_dot, _) = (
        found.nondimensional[i].system.model,
        (found.nondimensional[i].coordinates(phase)),
    )
    x, dx = gauss_points(30)
    rate = blade.length * blade.frequency_scale
    slowed = drag * blade.length * rate * model.integrated(model.slope_rate(q, q_dot), x) @ dx
    weight = blade.mass * Gravity(0.5).force(phase, phase, 1.0)
    in_space = np.exp(1j * phase)
    expected = ((weight - slowed) * in_space).mean()
    assert (root * in_space).mean() == pytest.approx(expected, rel=1e-9)
    assert abs(expected) > 0.9 * 0.5 * blade.mass


def test_stations_off_the_blade_are_refused(beam):
    found = spin_up_response(beam, SpinUp(omega=2.0, ramp_time=1.0), [0.5], tolerance=1e-3)
    with pytest.raises(ValueError, match="x must lie"):
        found.section_loads([9.0])


@pytest.mark.parametrize("w", [0.0, 3.0])
def test_sections_stand_across_the_axis_and_are_orthonormal(w):
    """Without shear r' is along the normal; at rest the chord has setting and twist.

    Twist shortens the axis by 3e-7: the trapeze effect.
    """
    blade = STRAIGHT.with_twist(0.5).with_precone(0.1).with_setting_angle(0.3)
    x, dx = np.array([0.2, 0.5, 0.9]), 1e-4
    at = steady_state(blade, w, theory=RIGID).section_loads([*x, *(x - dx), *(x + dx)])
    _, before, after = np.split(at.place, 3)
    section = at.section[:3]
    np.testing.assert_allclose(section[..., 0], (after - before) / (2.0 * dx), atol=1e-6)
    unit = np.broadcast_to(np.eye(3), section.shape)
    np.testing.assert_allclose(np.swapaxes(section, 1, 2) @ section, unit, atol=1e-14)
    angle = np.arctan2(section[:, 2, 1], section[:, 1, 1])
    assert np.allclose(angle, 0.3 + 0.5 * x, atol=1e-12) is (w == 0.0)


def test_a_blade_set_in_its_plane_and_the_same_in_space_stand_alike():
    """A thousand times as stiff across its plane, one in space hardly leaves it: by 1/1000."""
    motion = SpinUp(omega=1.0, ramp_time=1.0)
    planar = Blade(length=1.0, section=SECTION).with_setting_angle(0.7)
    stiff = STRAIGHT.with_section_out_of_plane(1e3, 1e3).with_setting_angle(0.7)
    one, other = (
        spin_up_response(blade, motion, [0.5, 1.0], theory=RIGID, tolerance=1e-4).section_loads(X)
        for blade in (planar, stiff)
    )
    size = np.abs(one.place[..., 1:]).max()
    assert size > 0.1
    np.testing.assert_allclose(one.place, other.place, atol=5e-3 * size)
    np.testing.assert_allclose(one.section, other.section, atol=1e-2 * size)
    # As the tip is seen from above, and as far out of that plane as the setting angle has it.
    _, lag, flap = one.place[:, -1].T
    np.testing.assert_allclose(flap, math.tan(0.7) * lag, rtol=1e-12)


@pytest.mark.parametrize("trapeze", [False, "elastic", True])
def test_the_strains_of_a_section_are_those_by_which_it_stands(trapeze):
    """With the trapeze effect tension untwists a section, which carries no torque for that."""
    blade = STRAIGHT.with_twist(0.8).with_precone(0.1).with_offsets(tension=(0.01, 0.005))
    theory = Theory(trapeze=trapeze, rotary_inertia=True)
    h = 1e-4
    loads = steady_state(blade, 4.0, theory=theory).section_loads([0.3 - h, 0.3, 0.3 + h])
    before, here, after = loads.section
    turn = here.T @ (after - before) / (2.0 * h)
    moved = here.T @ (loads.place[2] - loads.place[0]) / (2.0 * h)
    found = shape_of(loads).isel(station=1)
    elastic = np.array([turn[2, 1] - 0.8, turn[0, 2], turn[1, 0]])
    np.testing.assert_allclose(found["curvature"], elastic, rtol=1e-6)
    assert found["strain"].item() == pytest.approx(moved[0] - 1.0, rel=1e-4)
