"""Loads in Exudyn: its motion settles on the exact blade's responses, in both frames."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from analytic import (
    Damping,
    DistributedForce,
    Gravity,
    SpeedRipple,
    SpinUp,
    SteadyRotation,
    TipForce,
    forced_response,
    spin_up_response,
)
from rotbeam_exu import SimulationError, load, save, simulate
from rotbeam_exu.fem.case import RunCase
from rotbeam_exu.runs.attributes import loads_of
from rotbeam_exu.runs.check import check_run, energy_drift, remedy

ALL = (
    Gravity(2.0), SpeedRipple(amplitude=0.1, frequency=5.0), TipForce(amplitude=0.3, frequency=2.0),
    DistributedForce(amplitude=0.1, frequency=3.0),
)  # fmt: skip


def by_mass(blade, c, **viscous):
    """The blade with mass-proportional damping c, over its frequency scale."""
    external = c * blade.mass_per_length * blade.frequency_scale
    return blade.with_damping(Damping(external=external, **viscous))


def test_under_its_weight_it_settles_on_the_exact_response(beam):
    """With c = 1.5 and w̄ = 2, hub, tip mass and setting angle."""
    blade = by_mass(beam, 1.5).with_hub_radius(0.8).with_tip_mass(0.2)
    blade = blade.with_setting_angle(0.25 * math.pi)
    omega = 2.0 * beam.frequency_scale
    exact = forced_response(blade, [0.9 * omega, omega, 1.05 * omega], Gravity())
    period = 2.0 * np.pi / omega
    run = simulate(
        blade, SpinUp(omega=omega, ramp_time=2.0), loads=[Gravity()], duration=7.0 * period,
        step=period / 500, elements=8, frame="rotating",
    )  # fmt: skip
    last = run.isel(time=run["time"].to_numpy() > 6.0 * period)
    angle, q = last["angle"].to_numpy(), last["q"].to_numpy() / blade.length
    (i,) = exact.at(omega)
    assert exact.amplitude[i] > 0.2
    # What is left of the start, and the step's share, are a third of it.
    assert np.abs(q - exact.response(angle, i)).max() < 1e-3 * exact.amplitude[i]


def test_both_frames_agree_to_second_order_in_the_step(beam):
    blade = by_mass(beam, 0.1, bending=0.01, axial=1e-4).with_hub_radius(1.0).with_tip_mass(0.3)

    def apart(step):
        inertial, rotating = (
            simulate(
                blade, SpinUp(omega=4.0, ramp_time=3.0), elements=4, duration=4.0, step=step,
                frame=frame, loads=ALL,
            )["q"]
            for frame in ("inertial", "rotating")
        )  # fmt: skip
        return float(abs(inertial - rotating).max())

    assert apart(8e-3) / apart(4e-3) == pytest.approx(4.0, rel=0.01)


def test_forces_on_the_length_know_the_nodes_of_a_mass_inside_the_span(beam):
    """Elements are uneven; as of even ones the forces changed the motion by 4e-2."""
    heavy = beam.with_point_mass(0.5, 2.3).with_damping(Damping(external=0.3))
    motion, loads = SpinUp(omega=4.0, ramp_time=3.0), [DistributedForce(amplitude=0.2, frequency=3)]
    run = simulate(heavy, motion, elements=8, duration=4.0, step=4e-3, loads=loads)
    exact = spin_up_response(heavy, motion, run["time"], loads=loads, tolerance=1e-5).q
    # Steps of 4 ms leave 2e-4.
    np.testing.assert_allclose(run["q"], exact, atol=4e-4 * np.abs(exact).max())


def test_everything_is_relative_to_the_clamp_with_its_ripple(beam):
    spin_up, ripple = SpinUp(omega=4.0, ramp_time=3.0), SpeedRipple(amplitude=0.5, frequency=4.0)
    run = simulate(beam, spin_up, elements=4, duration=4.0, step=4e-3, loads=[ripple])
    time = run["time"].to_numpy()
    turned = 0.5 / 4.0 * np.sin(4.0 * time)
    assert run["angle"].to_numpy() == pytest.approx(spin_up.angle(time) + turned)
    tip = (run["tip_x"] + 1j * run["tip_y"]).to_numpy() * np.exp(-1j * run["angle"].to_numpy())
    assert tip.imag == pytest.approx(run["q"].to_numpy(), abs=1e-12)
    # At t = 0 it turns with the clamp, as one: what it would not do if only the ramp turned it.
    assert run["q_dot"][0] == pytest.approx(0.0, abs=1e-12)
    swing = np.gradient(run["q"].to_numpy(), time, edge_order=2)
    assert np.abs(swing - run["q_dot"].to_numpy()).max() < 1e-3 * np.abs(run["q_dot"]).max()


def test_a_run_tells_its_loads(beam, tmp_path):
    options = {"spin_up": SpinUp(omega=4.0, ramp_time=3.0), "elements": 2, "step": 1e-2}
    run = simulate(beam, **options, duration=5.0, loads=ALL)
    assert loads_of(load(save(run, tmp_path / "run.nc")).attrs) == ALL
    assert json.loads(run.attrs["loads"])[0] == {"kind": "Gravity", "gravity": 2.0, "tilt": 0.0}
    # A cache is keyed by what a case says of itself.
    keys = [
        json.dumps(RunCase(blade=beam, **options, loads=loads).describe())
        for loads in ((), ALL[:1], ALL[1:2], (replace(ALL[1], frequency=6.0),))
    ]
    assert len(set(keys)) == len(keys)
    bare = simulate(beam, **options, duration=5.0)
    assert loads_of(bare.attrs) == ()
    assert "supplied_energy" not in bare


def settling(blade, response, i, nu, cycles, steps, elements):
    """Where a run settles that starts on a disturbed response, over that response.

    The first harmonic of q over each cycle is z* + A ρ^k + B ρ̄^k with the Floquet multipliers ρ of
    the exact response; returned are |z*| over the exact one, and the misfit over the first distance
    from it.
    """

    def disturbed(x):
        state = response.state(i, x)
        rates = ("velocity", "slope_rate", "spin")
        return replace(state, **{name: 1.03 * getattr(state, name) for name in rates})

    period = 2.0 * np.pi / nu
    run = simulate(
        blade, SteadyRotation(omega=6.0), elements=elements, duration=cycles * period,
        step=period / steps, frame="rotating", loads=[replace(response.load, frequency=nu)],
        initial_state=disturbed,
    )  # fmt: skip
    time, q = run["time"].to_numpy()[:-1], run["q"].to_numpy()[:-1] / blade.length
    z = 2.0 * (q * np.exp(-1j * nu * time)).reshape(cycles, -1).mean(axis=1)
    rho = response.multipliers[i, 0] ** np.arange(cycles)
    columns = np.stack([np.ones(cycles), rho, rho.conj()], axis=1)
    (limit, *parts), *_ = np.linalg.lstsq(columns, z, rcond=None)
    misfit = np.abs(columns @ [limit, *parts] - z).max()
    return abs(limit / response.harmonics[i, 1]), misfit / abs(z[0] - limit)


@pytest.mark.slow
@pytest.mark.parametrize(("branch", "amplitude"), [(0, 0.13454), (2, 0.38698)])
def test_between_the_folds_both_stable_responses_are_returned_to(beam, branch, amplitude):
    """Case D3 of the extensible beam, over a quarter of its decay time of 300 s.

    So near to a fold the step's 2e-6 of the frequency is 5e-4 of the amplitude. The axial damping
    moves that by 1e-5, and keeps the trapezoidal rule from giving up after ten seconds.
    """
    scale = 4.50886824 * beam.frequency_scale
    blade, nu = by_mass(beam, 0.008, axial=1e-4), 0.997 * scale
    ripple = SpeedRipple(amplitude=0.003 * beam.frequency_scale)
    exact = forced_response(blade, 6.0, ripple, [0.985 * scale, nu, 1.015 * scale])
    i = exact.at(nu)[branch]
    assert exact.amplitude[i] == pytest.approx(amplitude, abs=1e-5)
    size, misfit = settling(blade, exact, i, nu, cycles=40, steps=1800, elements=64)
    assert size == pytest.approx(1.0, abs=1e-3)
    assert misfit < 5e-3


def test_energy_that_nothing_supplied_or_took_fails(beam):
    run = simulate(
        by_mass(beam, 0.02, bending=0.02), SpinUp(omega=4.0, ramp_time=3.0), elements=4,
        duration=6.0, step=5e-3, loads=[TipForce(amplitude=1.0, frequency=3.0)],
    )  # fmt: skip
    assert energy_drift(run)[0] < 1e-3
    leak = np.linspace(0.0, 20.0, run.sizes["time"])
    sentence = "drift of the Jacobi energy E - ω L_z from the energy supplied over the largest"
    with pytest.raises(SimulationError, match=f"{sentence}.*: take a smaller step than 0.005 s"):
        check_run(run.assign(jacobi_energy=run["jacobi_energy"] - leak))
    # As long as it is driven and damped, the energy itself is none that stays.
    with pytest.raises(SimulationError, match="drift of the steady Jacobi energy"):
        check_run(run.drop_vars("supplied_energy"))
    # Swung too far by loads: no ramp helps against them.
    far = run.assign(q=run["q"] * 0.9 * beam.length / np.abs(run["q"]).max())
    assert "take smaller loads, more damping, or a duration below 5 s" in remedy(far, 5.0)
