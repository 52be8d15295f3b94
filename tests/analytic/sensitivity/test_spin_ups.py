"""Derivatives of motions in time: laws of similarity, limits, and motions that are solved anew."""

import numpy as np
import pytest

from analytic import (
    Beam,
    Damping,
    Gravity,
    SpinUp,
    SteadyRotation,
    Theory,
    TipForce,
    design_ramp,
    residual_amplitude,
    spin_up_response,
    steady_state,
)
from analytic.sensitivity import parameters_of, sensitivity, spread
from tests.beams import irregular, unit_beam

STRIP = unit_beam(1e-3).with_section_out_of_plane(0.25, 0.2)
TIMES = np.linspace(0.25, 3.0, 7)
ELASTIC = Theory(trapeze="elastic")
NUMBERS = 10  # at each time


def over_time(found):
    """Return the derivatives over time, (times, numbers, parameters)."""
    return found.derivatives[-NUMBERS * TIMES.size :].reshape(TIMES.size, NUMBERS, -1)


def by_name(found):
    return dict(zip(found.names, np.moveaxis(over_time(found), -1, 0), strict=True))


MOTIONS = {
    "in its plane": (unit_beam(1e-3).with_hub_radius(0.3), "EA EI3", [Gravity(0.1)]),
    "in space": (STRIP.with_twist(0.4).with_precone(0.05), "EA EI3 EI2 GJ", [Gravity(0.1, 0.4)]),
    "a table": (irregular(3, 0.01, 4), "EA GJ EI2 EI3", [Gravity(0.1, 0.4)]),
}


@pytest.mark.parametrize("name", MOTIONS)
def test_laws_of_similarity(name):
    """Faster by k: stiffness and gravity times k², the speed times k, the ramp's time over k.

    And all stiffness and mass times k: the same motion, loads times k.
    """
    blade, stiff, loads = MOTIONS[name]
    motion = SpinUp(omega=1.5, ramp_time=2.0)
    response = spin_up_response(
        blade, motion, TIMES, loads=loads, tolerance=1e-6, start="steady", theory=ELASTIC
    )
    found = sensitivity(response)
    of = by_name(found)
    stiffer = sum(of[one] for one in stiff.split())
    faster = 2.0 * stiffer + motion.omega * of["omega"] - motion.ramp_time * of["ramp_time"]
    faster += 2.0 * of["loads[0]"]
    tip = found.values[-NUMBERS * TIMES.size :].reshape(TIMES.size, NUMBERS)
    size = np.abs(stiffer[:, 1]).max()
    np.testing.assert_allclose(faster[:, 1], TIMES * response.q_dot, atol=1e-6 * size)
    masses = [one for one in ("m", "j1", "j2", "j3") if one in of]
    same = stiffer + sum(of[one] for one in masses)
    np.testing.assert_allclose(same[:, :4], 0.0, atol=1e-6 * size)
    np.testing.assert_allclose(same[:, 4:], tip[:, 4:], atol=1e-6 * np.abs(stiffer[:, 4:]).max())


def test_against_motions_solved_anew():
    """What no similarity tells: the hub, and what damping of strains goes with."""
    damping = Damping(bending=2e-2, out_of_plane=1e-2, torsion=1e-3, external=0.1)
    blade = STRIP.with_precone(0.05).with_hub_radius(0.1).with_damping(damping)
    motion, names = SpinUp(omega=1.5, ramp_time=2.0), ["damping_bending", "hub_radius"]

    def solved(blade):
        return spin_up_response(blade, motion, TIMES, tolerance=1e-7)

    found = over_time(sensitivity(solved(blade), names))
    for k, name in enumerate(names):
        parameter = parameters_of(blade, Theory())[name]
        change = 2e-3 * parameter.size
        ahead, behind = (
            sensitivity(solved(parameter.changed(parameter.value + step)), []).values
            for step in (change, -change)
        )
        expected = (ahead - behind)[-found[..., 0].size :].reshape(found[..., k].shape)
        expected /= 2.0 * change
        # The square of the change is left, and the tolerance over it.
        np.testing.assert_allclose(
            found[..., k], expected, atol=1e-4 * np.abs(expected).max(), err_msg=name
        )


def test_a_start_in_the_steady_state_has_its_derivatives():
    blade, loads = STRIP.with_twist(0.4), [Gravity(0.3, 0.4)]
    motion, names = SpinUp(omega=1.0, ramp_time=2.0), ["EI2", "EI3", "m", "loads[0]"]
    response = spin_up_response(blade, motion, [0.0], loads=loads, start="steady", tolerance=1e-6)
    found = sensitivity(response, names)
    expected = sensitivity(steady_state(blade, 0.0, loads=loads), names)
    for now, then in (
        (found.values, expected.values), (found.derivatives, expected.derivatives),
    ):  # fmt: skip
        np.testing.assert_allclose(now[-NUMBERS:], then, atol=1e-6 * np.abs(then).max())


def test_the_swing_that_a_spin_up_leaves():
    """It is the residual amplitude, whose change with T is that of a longer ramp."""
    beam, names = Beam.reference(), ["ramp_time", "EI3", "m"]

    def left(motion, blade=beam):
        return beam.length * residual_amplitude(blade, motion, exact=True)

    motion = SpinUp(omega=2.0, ramp_time=3.0)
    found = sensitivity(spin_up_response(beam, motion, [5.4], tolerance=1e-6), names)
    row = found.outputs.index("swing after the ramp")
    assert found.values[row] == pytest.approx(left(motion), rel=1e-4)
    longer, shorter = (left(SpinUp(omega=2.0, ramp_time=T)) for T in (3.03, 2.97))
    assert found.of("swing after the ramp", "ramp_time") == pytest.approx(
        (longer - shorter) / 0.06, rel=3e-3
    )
    stiffer = parameters_of(beam, Theory())["EI3"].changed
    assert found.of("swing after the ramp", "EI3") == pytest.approx(
        (left(motion, stiffer(1.01)) - left(motion, stiffer(0.99))) / 0.02, rel=3e-3
    )
    assert (
        "swing after the ramp"
        not in sensitivity(spin_up_response(beam, motion, [3.5], tolerance=1e-6), []).outputs
    )


def test_the_largest_of_a_motion():
    """Between the times asked for, too: where the tip lags most it stands still in its frame."""
    beam, motion = Beam.reference(), SpinUp(omega=6.0, ramp_time=3.0)
    dense = spin_up_response(beam, motion, np.linspace(0.0, 5.0, 2001), tolerance=1e-6)
    found = sensitivity(spin_up_response(beam, motion, [5.0], tolerance=1e-6), [])
    row = found.outputs.index("largest tip y")
    assert found.units[row] == "m"
    farthest = dense.q[np.abs(dense.q).argmax()]
    assert found.values[row] == pytest.approx(farthest, rel=1e-5)
    assert found.values[row] < farthest < 0.0
    assert set(found.values[[found.outputs.index(f"largest {n}") for n in ("twist", "tip z")]]) == {
        0.0
    }


def test_numbers_of_stations_are_taken_by_name():
    """Each costs as much as that of the whole blade, so that they are left out unless named."""
    table = irregular(3, 0.01, 4)
    response = spin_up_response(
        table, SpinUp(omega=1.0, ramp_time=2.0), [1.0], tolerance=1e-4, theory=ELASTIC
    )
    names = [one.name for one in parameters_of(table, ELASTIC).values() if not one.family]
    assert "EI3[2]" not in names
    found = sensitivity(response, ["EI3", "EI3[0]", "EI3[1]", "EI3[2]", "EI3[3]"])
    values = [parameters_of(table, ELASTIC)[name].value for name in found.names]
    np.testing.assert_allclose(
        found.derivatives[:, 1:] @ values[1:], found.derivatives[:, 0],
        atol=1e-6 * np.abs(found.derivatives[:, 0]).max(),
    )  # fmt: skip
    with pytest.raises(ValueError, match=r"no parameter 'start'; it has .* omega, ramp_time"):
        sensitivity(response, ["start"])


def test_a_band_over_time():
    """By a load's factor alone: of small motions the band is as wide as they are."""
    beam, motion = Beam.reference(), SteadyRotation(omega=2.0)
    load = TipForce(amplitude=1e-4, frequency=1.0)
    response = spin_up_response(beam, motion, TIMES, loads=[load], start="steady")
    found = spread(sensitivity(response, ["loads[0]"]), {"loads[0]": 0.1})
    axes = found.plot_over_time("tip y")
    (line,), (band,) = axes.lines, axes.collections
    np.testing.assert_allclose(line.get_ydata(), response.lag)
    highest = band.get_paths()[0].vertices[:, 1].max()
    assert highest >= 1.2 * response.lag.max() * (1.0 - 1e-3)
    far = found.outputs.index(f"tip y at {TIMES[-1]:.12g} s")
    assert found.deviations[far] == pytest.approx(0.1 * abs(response.lag[-1]), rel=1e-3)
    with pytest.raises(ValueError, match="there is no 'lag 1' over time"):
        found.plot_over_time("lag 1")


def test_what_disturbs_a_quiet_ramp():
    """No swing has no derivative; that of the lag swings as a ramp does for another blade."""
    beam = Beam.reference()
    motion = design_ramp(beam, omega=2.0, duration=4.0)
    times = np.linspace(0.0, 6.2, 156)
    found = sensitivity(spin_up_response(beam, motion, times, tolerance=1e-6), ["EI3"])
    swing = np.ptp(found.over_time("tip y")[times >= 4.0, 0]) / 2.0 / beam.length
    stiffer = parameters_of(beam, Theory())["EI3"].changed(1.01)
    left, before = (residual_amplitude(one, motion, exact=True) for one in (stiffer, beam))
    assert before < 0.01 * left
    assert 0.01 * swing == pytest.approx(left, rel=0.03)
    with pytest.raises(ValueError, match="there is no 'lag' over time"):
        found.over_time("lag")
