"""Damping in Exudyn: free decay as of the exact blade, and what takes energy or brings it."""

import math
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from scipy.optimize import least_squares

from analytic import (
    Beam,
    Blade,
    Damping,
    DistributedForce,
    Gravity,
    Rectangle,
    Section,
    SpeedRipple,
    SpinUp,
    SteadyRotation,
    TipForce,
    damping_ratios,
    forced_response,
    linear_modes,
    periodic_orbits,
)
from analytic.exact.linear.steady_state import stretched_state
from analytic.theory import Theory
from rotbeam_exu import kicked, simulate
from rotbeam_exu.fem.elements import Ancf3, Cable, Exact, SpaceCable, SpaceExact
from rotbeam_exu.fem.linearization import Linearization
from rotbeam_exu.fem.loading import Loading
from rotbeam_exu.fem.solver import exudyn_system, mass_matrix


def by_mass(beam, c):
    """Mass-proportional damping c, over the beam's frequency scale."""
    return Damping(external=c * beam.mass_per_length * beam.frequency_scale)


def fitted_decay(time, signal, ratio, frequency):
    """Damping ratio of a decaying tone, by least squares from a guess of it and its frequency."""
    signal = signal / np.abs(signal).max()

    def misfit(p):
        return p[0] * np.exp(-p[1] * time) * np.cos(p[2] * time + p[3]) + p[4] - signal

    found = least_squares(misfit, [1.0, ratio * frequency, frequency, 0.0, 0.0], x_scale="jac").x
    return found[1] / np.hypot(found[1], found[2])


VISCOUS = Damping(bending=0.01, axial=0.01)
THICK = Blade(
    length=1.0, section=Section(axial_stiffness=1e4, bending_stiffness=1.0, mass_per_length=1.0)
)
"""Not so slender that an element which shears wants a fine mesh in order to start bent."""


@pytest.mark.parametrize(
    ("omega", "element", "frame", "damping"),
    # Cables and exact elements in either frame and damping.
    [
        (6.0, "cable", "rotating", VISCOUS), (0.0, "cable", "inertial", "by mass"),
        (0.0, "exact", "rotating", VISCOUS), (6.0, "exact", "inertial", "by mass"),
    ],
)  # fmt: skip
def test_free_decay_is_that_of_the_exact_blade(beam, omega, element, frame, damping):
    """Mesh, step and shear leave 5e-4 of the ratio, as they do of frequencies."""
    blade = beam.with_damping(by_mass(beam, 0.04) if damping == "by mass" else damping)
    exact = damping_ratios(blade, omega, 1)[0]
    start = periodic_orbits(beam, omega, [0.005])
    run = simulate(
        blade, SteadyRotation(omega=omega), element=element, frame=frame, duration=5.0, step=4e-3,
        elements=16 if element == "exact" else 8, initial_state=lambda x: start.state(0, x),
    )  # fmt: skip
    frequency = linear_modes(beam, omega, 1).frequencies[0]
    found = fitted_decay(run["time"].to_numpy(), run["q"].to_numpy(), exact, frequency)
    assert found == pytest.approx(exact, rel=1e-3)


@pytest.mark.parametrize("element", ["space_cable", "space_exact"])
def test_flap_in_space_decays_as_that_of_the_exact_blade(element):
    """A tapered blade, which the air does not damp by its mass; flap is its lag set upright."""
    blade, omega = THICK.with_taper(0.4, 0.4).with_damping(Damping(external=0.4)), 1.0
    upright = blade.with_setting_angle(0.5 * math.pi)
    exact = damping_ratios(upright, omega, 1, theory=SpaceExact().theory)[0]
    blade = blade.with_section_out_of_plane(1.0, 0.8)
    run = simulate(
        blade, SteadyRotation(omega=omega), element=element, duration=4.0, step=0.01,
        elements=16 if element == "space_exact" else 8,
        initial_state=kicked(blade, 1e-3, partial(stretched_state, blade, omega), by_mode=True),
    )  # fmt: skip
    frequency = linear_modes(upright, omega, 1).frequencies[0]
    found = fitted_decay(run["time"].to_numpy(), run["w"].to_numpy(), exact, frequency)
    assert found == pytest.approx(exact, rel=3e-3)


@pytest.mark.parametrize(
    ("blade", "omega", "air", "force", "frequency", "meshes", "steps", "periods"),
    [
        # Near its lag frequency: flap and torsion change sign each period and grow by 7.6.
        (THICK.with_section_out_of_plane(0.3, 0.3), 1.0, 0.4, 0.3, 3.543, (12, 24), 9.0, 5.0),
        # The paper's beam as a strip, which sheared elements let start bent by small steps alone.
        pytest.param(
            Beam.reference().with_shape(Rectangle()), 2.0, 1.0, 0.6, 2.4, (48, 64), 43.0, 4.0,
            marks=pytest.mark.slow,
        ),
    ],
    ids=["thick", "strip"],
)  # fmt: skip
def test_growth_out_of_a_damped_response_is_that_of_theory(
    blade, omega, air, force, frequency, meshes, steps, periods
):
    """A driven blade swings in its plane and leaves it; one motion grows, all others decay.

    A period has as many steps as told for each element, so that both errors fall together.
    """
    blade = blade.with_damping(Damping(external=air * blade.mass_per_length))
    driven = forced_response(
        blade, omega, TipForce(amplitude=force), [0.999 * frequency, frequency], functions=12,
        theory=Theory(rotary_inertia=True, trapeze=False),
    )  # fmt: skip
    due = driven.out_of_plane(confirm=False).growth_rate[-1]
    period, rates = 2.0 * np.pi / frequency, []
    for elements in meshes:
        run = simulate(
            blade, SteadyRotation(omega=omega), element="space_exact", elements=elements,
            duration=periods * period, step=period / (steps * elements),
            loads=[TipForce(amplitude=force, frequency=frequency)],
            initial_state=kicked(blade, 1e-7, lambda x: driven.state(-1, x)),
        )  # fmt: skip
        at = run["w"].interp(time=period * (periods - np.array([2.0, 1.5, 1.0, 0.5, 0.0])))
        rates.append(np.log(np.abs(at[2:].to_numpy() / at[:-2].to_numpy())).mean() / period)
    assert rates == pytest.approx([due, due], rel=0.05)
    # Of second order: both meshes together tell the limit.
    weight = meshes[0] ** 2 / (meshes[1] ** 2 - meshes[0] ** 2)
    assert rates[1] + weight * (rates[1] - rates[0]) == pytest.approx(due, rel=5e-3)


@pytest.mark.parametrize("element", ["cable", "exact"])
def test_an_axial_vibration_decays_by_the_axial_damping(beam, element):
    """λ² + η_a ω² λ + ω² = 0, where bending damping has no part; ω is 1600 times bending's."""
    omega, length = beam.burst_speed, beam.length
    blade = beam.with_damping(Damping(bending=0.1, axial=0.02 / omega))
    wave = 0.5 * np.pi / length

    def stretched(x):
        rest, along = stretched_state(beam, 0.0, x), np.eye(3)[0]
        u, slope = 1e-4 * np.sin(wave * x), 1e-4 * wave * np.cos(wave * x)
        return replace(
            rest, place=rest.place + np.multiply.outer(u, along),
            slope=rest.slope + np.multiply.outer(slope, along),
        )  # fmt: skip

    # A load of no size, for samples as dense as its frequency wants them.
    run = simulate(
        blade, SteadyRotation(omega=0.0), element=element, elements=8, duration=0.04, step=2e-5,
        loads=[TipForce(amplitude=0.0, frequency=omega)], frame="rotating", initial_state=stretched,
    )  # fmt: skip
    moved = run["tip_x"].to_numpy() - length
    found = fitted_decay(run["time"].to_numpy(), moved, 0.01, omega)
    assert found == pytest.approx(0.01, rel=2e-3)


@pytest.mark.parametrize("model", [Cable(), Exact(), Exact(nodes=3)])
@pytest.mark.parametrize("damping", [Damping(bending=0.3), Damping(axial=0.2)])
def test_what_is_counted_as_taken_is_what_exudyn_takes(beam, elastic_force, model, damping):
    """At any state, on a taper; and nothing of it in a rotation, of the frame or of the blade."""
    blade = beam.with_taper(0.2, 0.3).with_damping(damping)
    elements, rng = 3, np.random.default_rng(3)
    with exudyn_system() as mbs:
        dissipation = model.lay(mbs, blade, elements).dissipation
    reference = elastic_force(model, blade, elements)[1]
    at = reference + 0.2 * rng.standard_normal(reference.shape)
    resting = elastic_force(model, blade, elements, at, 0.0 * at)[0]
    moving = rng.standard_normal(at.shape)
    force = elastic_force(model, blade, elements, at, moving)[0] - resting
    power = -force @ moving.ravel()
    assert power > 0.0
    assert dissipation(at[None], moving[None]) == pytest.approx([power], rel=1e-9)
    rotation = model.spun(at)
    force = elastic_force(model, blade, elements, at, rotation)[0] - resting
    assert np.abs(force).max() < 1e-9 * np.abs(resting).max()
    assert dissipation(at[None], rotation[None])[0] < 1e-12 * power


@pytest.mark.parametrize(
    "model", [Cable(), Exact(), Exact(nodes=3), Ancf3(), SpaceCable(), SpaceExact()]
)
def test_the_air_brakes_the_axis_and_no_section_or_mass(beam, model):
    """Along a straight blade that turns about the axis it takes w² d ((R + L)³ - R³)/3."""
    d, radius, rate, length = 0.03, 0.7, 2.0, beam.length
    blade = beam.with_hub_radius(radius).with_taper(0.1, 0.2).with_damping(Damping(external=d))
    if model.leaves_plane:
        blade = blade.with_section_out_of_plane(1.0, 0.8)
    else:
        blade = blade.with_tip_mass(0.1, 0.2)
    with exudyn_system() as mbs:
        nodes = model.lay(mbs, blade, 4).nodes
        at = np.array([mbs.GetNodeParameter(n, "referenceCoordinates") for n in nodes])
    loading = Loading(model, blade, 4, mass_matrix(model, blade, 4), [])
    taken = -loading.power(*np.zeros((2, 1)), at[None], rate * model.spun(at)[None])
    wanted = rate**2 * d * ((radius + length) ** 3 - radius**3) / 3.0
    # A braked section would add μ times 3 of it.
    assert taken == pytest.approx([wanted], rel=1e-9)


HUB = Beam.reference().with_section_out_of_plane(1.0, 0.8).with_hub_radius(0.5)
AIR = by_mass(HUB, 0.05)


@pytest.mark.parametrize(
    ("element", "frame", "blade", "loads"),
    [
        ("cable", "inertial", HUB.with_damping(replace(AIR, bending=0.01, axial=1e-4)), []),
        ("exact", "rotating", HUB.with_damping(replace(AIR, bending=0.01, axial=1e-4)), []),
        ("space_exact", "inertial", HUB.with_damping(AIR), []),
        # In flap and lag at once, with masses.
        (
            "cable", "rotating", HUB.with_tip_mass(0.1, 0.01).with_setting_angle(0.7),
            [
                Gravity(2.0), SpeedRipple(amplitude=0.1, frequency=5.0),
                TipForce(amplitude=0.3, frequency=2.0),
                DistributedForce(amplitude=0.1, frequency=3.0),
            ],
        ),
    ],
)  # fmt: skip
def test_the_energy_balance_closes_to_second_order_in_the_step(element, frame, blade, loads):
    errors = []
    for step in (8e-3, 4e-3):
        run = simulate(
            blade, SpinUp(omega=6.0, ramp_time=3.0), element=element, elements=2, duration=4.0,
            step=step, frame=frame, loads=loads,
        )  # fmt: skip
        balance = (run["jacobi_energy"] - run["supplied_energy"]).to_numpy()
        errors.append(np.abs(balance - balance[0]).max() / run["elastic_energy"].max().item())
    assert run["supplied_energy"][0] == 0.0
    # What was supplied is several times the elastic energy.
    assert np.abs(run["supplied_energy"]).max() > 3.0 * run["elastic_energy"].max()
    assert errors[1] < 1e-3
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.1)


def test_natural_frequencies_and_stretch_are_those_without_damping(beam):
    blade = beam.with_hub_radius(0.5).with_tip_mass(0.1)
    damped = blade.with_damping(Damping(bending=0.1, axial=0.1, external=0.1))
    for element in ("cable", "exact", "ancf3"):
        free, other = (
            Linearization.of(one, 6.0, element=element, elements=4) for one in (blade, damped)
        )
        assert np.array_equal(free.frequencies(3), other.frequencies(3))
        assert free.stretch == other.stretch
