"""Each script of the gallery runs, and its number is right: against theory, not against itself.

All slow: the site's build runs each script, too.
"""

import runpy
from functools import cache
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest

from analytic import (
    Beam,
    SpinUp,
    linear_modes,
    residual_amplitude,
    spin_up_response,
)

pytestmark = pytest.mark.slow

BEAM = Beam.reference()
MODELS = Path(__file__).parents[2] / "models"


@pytest.fixture(scope="module")
def run():
    """Run a script by name and return its variables; it has to leave a figure."""

    @cache
    def script(name):
        plt.close("all")
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(plt, "show", lambda: None)
            variables = runpy.run_path(str(MODELS / f"{name}.py"))
        assert plt.get_fignums(), f"{name} draws nothing"
        return variables

    return script


def impulse(found):
    into_blades = sum(np.trapezoid(torque, found["time"]) for torque in found["torques"])
    return found["inertia"] * found["speed"][-1] + into_blades


def residual_at(found, error):
    other = BEAM.in_units(length=1.0, mass=1.0, time=1.0 + error)
    return residual_amplitude(other, found["ramps"]["designed"], exact=True)


def drawn(found, name):
    (line,) = (line for line in found["axes"].lines if line.get_label() == name)
    return line.get_data()


def slope(found, name):
    """Power of the error in the residual of the figure's curve, between 0.4 and 1.6 %."""
    error, residual = (np.log(part[4:9]) for part in drawn(found, name))
    return np.polyfit(error, residual, 1)[0]


def by_closed_form(left):
    return left / residual_amplitude(BEAM, SpinUp(omega=6.0, ramp_time=4.0))


def ratio_at(data, hub_ratio, w_bar):
    return data["ratio"].sel(hub_ratio=hub_ratio).interp(w_bar=w_bar).item()


def at_speed(diagram):
    return diagram.frequencies[-1] / diagram.omegas[-1]


@pytest.mark.parametrize(
    ("name", "number", "wanted", "close"),
    [
        ("spin_up", lambda f: f["ratio"], 0.99789, 2e-5),
        # Cubic elements: energies, and with them frequencies, converge with the fourth power.
        ("mesh_convergence", lambda f: f["order"], 4.0, 0.2),
        # As FrM has it, which leaves the extensibility out, 1e-5 here.
        ("backbone", lambda f: f["exact"].lambda_omega, 0.019661, 2e-5),
        # Both as printed in the literature, the lag to the digits of a converged run.
        ("simo_vu_quoc", lambda f: 1e3 * f["stretch"], 0.51432, 5e-6),
        ("simo_vu_quoc", lambda f: f["lag"], -0.57375, 5e-5),
        # One floating frame feels ω² as a negative stiffness; axial motion takes 4e-5 off.
        ("linear_frame", lambda f: f["rate"], np.sqrt(16.0 - BEAM.omega_0**2), 3e-4),
        ("substructures", lambda f: f["two"]["tangent"], 4.4510, 1e-4),
        # Bending as if E were E/(1 - ν²), ν = 0.3.
        ("thickness_locking", lambda f: f["off"]["coupled"], 0.91**-0.5 - 1.0, 5e-5),
        ("thickness_locking", lambda f: f["off"]["uncoupled"], 0.0, 1e-6),
        # 16 elements leave 1e-6 themselves; the closed form of Eq. 1 is a few percent high.
        ("quiet_spin_up", lambda f: f["left"]["designed"], 0.0, 1e-5),
        ("quiet_spin_up", lambda f: by_closed_form(f["left"]["Eq. 1"]), 1.0, 0.05),
        # The figure's curves: the value at 0.1 %, and their slopes.
        ("quiet_spin_up", lambda f: drawn(f, "designed")[1][0] / residual_at(f, 1e-3), 1.0, 1e-6),
        ("quiet_spin_up", lambda f: slope(f, "designed"), 1.0, 0.05),
        ("quiet_spin_up", lambda f: slope(f, "robust"), 2.0, 0.1),
        # FrI softens far too much at 6 rad/s, so that its period is long.
        ("phase_space", lambda f: f["miss"].sel(model="exact").item(), 0.0, 2e-4),
        ("phase_space", lambda f: f["miss"].sel(model="FrI").item(), 0.071, 2e-3),
        # Inextensible, flap² - lag² is ω²; μ times squares of frequencies is left.
        ("tapered_blade", lambda f: f["gap"][1:] / f["omegas"][1:] ** 2, np.zeros(12), 5e-4),
        # The motor's impulse; 20 ms between the samples leave 5e-5 of it.
        ("hub_with_blades", lambda f: impulse(f) / f["impulse"], 1.0, 1e-4),
        # Another code's 3.59302.
        ("softening_map", lambda f: f["hardens"] < 3.59302 < f["softens"], True, 0.0),
        ("softening_map", lambda f: ratio_at(f["data"], 5.0, 4.0914), 3.0, 2e-3),
        ("campbell_diagram", lambda f: f["first"].omega, 1.490359, 1e-6),
        # A chain's, √(k (2k - 1)) ω; the little stiffness adds a few percent.
        ("campbell_diagram", lambda f: at_speed(f["flat"])[3:6], np.sqrt([1.0, 6.0, 15.0]), 0.05),
        ("model_errors", lambda f: f["total"]["FrM"], 0.0, 2e-4),
        # Fifth order is a tenth of third order's error at 0.3, 0.2 against 3.4 % of the shift.
        ("backbone_formula", lambda f: f["said"][25] / f["shift"][25], 1.0, 0.004),
    ],
)
def test_a_number_is_right(run, name, number, wanted, close):
    assert number(run(name)) == pytest.approx(wanted, abs=close)


def test_forced_response(run):
    least = {omega: curves[0] for omega, curves in run("forced_response")["curves"].items()}
    # Hardening at 2 rad/s, softening at 6, and jumps at either.
    for omega, way in ((2.0, 1.0), (6.0, -1.0)):
        (peak,), folds = least[omega].peaks, least[omega].folds
        free = least[omega].backbone.orbits(peak.amplitude)
        assert way * (peak.frequency - free.omega_n) > 0.0
        # On the backbone, to the square of the damping.
        assert peak.frequency == pytest.approx(free.frequency[0], rel=2e-5)
        assert len(folds) == 2


def test_gravity(run):
    found = run("gravity")
    response = found["response"]
    for crossing in found["crossings"]:
        greatest = np.argmax(np.abs(response.harmonics[:, crossing.order]))
        assert response.omega[greatest] == pytest.approx(crossing.omega, rel=0.05)
    assert sorted(crossing.order for crossing in found["crossings"]) == [1, 2, 3, 4]


def test_blade_in_exudyn(run):
    found = run("blade_in_exudyn")
    time, alone = found["alone"]
    exact = spin_up_response(found["blade"], found["spin_up"], time, tolerance=1e-5).q
    # Eight cable elements at 2 ms; see tests/fem for their order.
    assert alone == pytest.approx(exact, abs=1e-2 * np.abs(exact).max())
    # The weight, a sixteenth of the blade's mass but at its tip, makes the oscillation slower.
    half_periods = [
        np.diff(times[1:][np.diff(np.sign(q)) != 0])[-2:].mean()
        for times, q in (found["alone"], found["loaded"])
    ]
    assert half_periods[1] > 1.05 * half_periods[0]


@pytest.mark.filterwarnings("ignore:internal resonance:analytic.input_checks.RotbeamWarning")
def test_internal_resonance(run):
    found = run("internal_resonance")
    # The sixth harmonic changes its sign at the resonance, above the fold of the lower side.
    assert found["branch"].folds[0].amplitude < found["resonance"].amplitude < 0.65


@pytest.fixture(scope="module")
def planar(run):
    found = run("is_it_planar")
    # Map, branches, three codes, the buckled shape; the film is closed.
    assert len(plt.get_fignums()) == 4
    return found


def test_the_plane_is_left_above_the_limit(planar):
    limit = planar["limit"].amplitude
    # 0.0592 without damping.
    assert limit == pytest.approx(0.0594, abs=2e-4)
    assert planar["round_one"].stable.all()
    rate = planar["data"]["growth_rate"]
    # The tension holds the blade back, so that more stays in the plane as it turns faster; from
    # one speed to the next a tongue may take some of it.
    highest = [np.flatnonzero(row < 0.02).max(initial=-1) for row in rate.to_numpy()]
    assert np.all(np.diff(highest[::4]) >= 0)
    k = highest[int(np.flatnonzero(rate["omega"] == 4.0)[0])]
    assert rate["a"][k] < limit < rate["a"][k + 2]
    assert (rate.sel(a=0.3, method="nearest") > 10.0).all()


def test_branches_that_leave_the_plane(planar):
    strip, thick = planar["branches"]
    # Born stable; slower as they leave.
    assert strip.stable[:8].all()
    assert thick.stable.all()
    assert np.all(np.diff(strip.frequency) < 0.0)
    assert np.all(np.diff(thick.frequency) < 0.0)
    assert thick.born.amplitude == pytest.approx(0.2479, abs=1e-4)


def test_the_strip_buckles_and_turns_behind_its_clamp(planar):
    # 64 elements: 0.705 s, and 128: 0.710 s.
    assert planar["left"] == pytest.approx(0.707, abs=0.005)
    x, y, _ = planar["rectangle"]["axis"].isel(node=-1).to_numpy().T
    # Both have -0.6955 L, and a turn behind the clamp at 3 s, -1.023.
    assert x.min() / 8.0 == pytest.approx(-0.6955, abs=0.005)
    behind = np.interp(3.0, planar["rectangle"]["time"], np.unwrap(np.arctan2(y, x)))
    assert behind / (2.0 * np.pi) == pytest.approx(-1.02, abs=0.03)
    assert abs(planar["stays"]["axis"].sel(direction="z")).max() <= 1.001e-3 * 8.0
    assert "<img" in planar["animation"].to_jshtml()


def test_real_blade(run):
    found = run("real_blade")
    meeting = found["diagram"].crossings[0]
    modes = linear_modes(found["blade"], meeting.omega, 1, theory=found["without"])
    # The circles of the second code lie on the curves.
    for column, omega in enumerate(found["known"]):
        at = linear_modes(found["blade"], omega, 6, theory=found["without"]).frequencies
        assert at / (2.0 * np.pi) == pytest.approx(found["known"][omega], rel=8e-3), column
    assert meeting.omega == pytest.approx(1.5759, abs=1e-4)
    assert modes.frequencies[0] == pytest.approx(3.0 * meeting.omega, rel=1e-6)
    # It hardens, whatever the functions: 16 have -0.0898, too. Extension makes it -0.0877.
    assert found["orbits"].lambda_omega == pytest.approx(-0.0898, abs=1e-4)
    assert found["start"].error < 1e-4
    # The cone is pulled flat by 0.32 m, about which flap swings.
    late = found["start"].flap[found["times"] > 4.0]
    assert late.mean() == pytest.approx(0.319, abs=0.01)
