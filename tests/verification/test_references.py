"""The shipped truth against what is computed anew, and the truth of what is not shipped."""

import re
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from analytic import (
    Beam,
    Gravity,
    SpinUp,
    TipForce,
    linear_modes,
    periodic_orbits,
    spin_up_response,
)
from analytic.theory import Theory
from rotbeam_exu.verification import shipped as room
from rotbeam_exu.verification.cases import CASES, VERSION, spin_up_case
from rotbeam_exu.verification.references import reference, sampled_history
from rotbeam_exu.verification.shipped import DURATION, shipped

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
import references

BEAM = Beam.reference()


@pytest.mark.parametrize("name", ["S1", "V", "S1+h", "S1+d"])
def test_a_shipped_history_is_what_theory_says_between_its_samples(name):
    case = CASES[name]
    found = reference(case)
    assert found.source.startswith("shipped")
    times = np.sort(np.random.default_rng(1).uniform(0.0, 5.0, 200))
    exact = spin_up_response(case.blade, case.motion, times, tolerance=1e-8)
    size = np.abs(found.history(np.linspace(0.0, case.duration, 1000))).max()
    # 1e-8 is of the largest deflection until 5 s.
    assert np.abs(found.history(times) - exact.q).max() <= (found.bound + 1e-8) * size
    # A derivative of a quintic spline has one order less: the bound over the spacing of 5 ms.
    assert found.history(times, 1) == pytest.approx(exact.q_dot, abs=2e-6 * size)


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_no_case_is_computed_for_the_theories_that_it_names(name):
    """A change of a blade's fields must not lose the file's answers: histories take minutes."""
    case = CASES[name]
    for theory in case.theories:
        assert shipped().history(case, theory) or shipped().bound(case, theory)


@pytest.mark.parametrize("name", references.shipped_histories())
def test_every_shipped_history_is_what_another_computation_says(name):
    case, theory = references.shipped_histories()[name]
    case = replace(case, duration=DURATION)
    again = sampled_history(case, theory, tolerance=1e-5, spacing=7e-3)
    spline, bound = shipped().history(case, theory)
    within = again.time <= DURATION
    off = np.abs(spline(again.time) - again.q)[within].max(axis=0) / np.abs(again.q).max(axis=0)
    assert off.max() <= bound + again.error


def test_the_history_on_an_orbit_is_periodic_and_that_of_more_functions():
    case = CASES["O"]
    found = reference(case)
    orbit = periodic_orbits(BEAM, 2.0, case.amplitudes, functions=28)
    times = np.linspace(0.0, 20.0, 333)
    period = 2.0 * np.pi / orbit.frequency[0]
    size = 3.2
    assert np.abs(found.history(times) - 8.0 * orbit.response(times, 0)).max() < found.bound * size
    late = times[times < 20.0 - 3.0 * period]
    assert found.history(late + 3.0 * period) == pytest.approx(
        found.history(late), abs=2.0 * found.bound * size
    )
    assert np.abs(found.history(np.linspace(0.0, period, 2001))).max() == pytest.approx(size, 1e-6)


@pytest.mark.parametrize(("name", "amplitude"), [("S2", 0.413), ("S1", 0.333), ("S4", 0.333)])
def test_a_shipped_backbone_is_exact_between_its_points(name, amplitude):
    blade, speed = references.shipped_backbones()[name]
    exact = periodic_orbits(blade, speed, amplitude, functions=20).frequency[0]
    assert reference(CASES[name]).frequency_at(amplitude) == pytest.approx(
        exact, rel=shipped().frequency_bound
    )


def test_small_amplitudes_have_the_shift_of_the_limit():
    """ω_NL = ω_n (1 - λ a²), to terms in a⁴."""
    found, exact = reference(CASES["S4"]), periodic_orbits(BEAM, 8.0, 0.1)
    linear = found.first_frequency(8.0)
    shift = found.frequency_at(1e-3) / linear - 1.0
    assert shift == pytest.approx(-exact.lambda_omega * 1e-6, rel=1e-3)
    assert found.frequency_at(0.0) == pytest.approx(linear, rel=1e-10)


@pytest.mark.parametrize("speed", CASES["B"].speeds)
def test_the_points_of_the_case_of_backbones_are_shipped(speed):
    case = CASES["B"]
    for a in (case.amplitudes[0], case.amplitudes[-1]):
        assert shipped().frequency_at(case.blade, speed, a) is not None
    assert reference(case).bound < 1e-8


def test_what_is_not_in_the_tables_is_computed():
    exact = periodic_orbits(BEAM, 5.0, [0.2, 0.3]).frequency
    found = reference(CASES["S1"]).frequency_at([0.3, 0.2, 0.3], 5.0)
    assert found == pytest.approx(exact[[1, 0, 1]], rel=1e-12)
    assert shipped().frequency_at(BEAM, 5.0, 0.3) is None
    # There a resonance bends the backbone; the spline would go on, and err.
    assert shipped().frequency_at(BEAM, 2.0, 0.61) is None


@pytest.mark.parametrize("name", references.shipped_backbones())
def test_tables_reach_as_far_as_spin_ups_swing(name):
    """Orbits take seconds each, and every run has its own amplitude."""
    case = CASES[name]
    late = np.linspace(case.motion.ramp_time, case.duration, 2000)
    swing = np.ptp(reference(case).history(late)) / (2.0 * case.blade.length)
    assert shipped().frequency_at(case.blade, case.motion.omega, 1.01 * swing) is not None


def test_data_of_another_blade_are_not_taken(monkeypatch):
    """As after a change of a case, until the data are made anew."""
    heavier = replace(CASES["S1+m"], blade=BEAM.with_tip_mass(0.2))
    monkeypatch.setitem(CASES, "S1+m", heavier)
    found = replace(shipped())
    assert found.history(heavier) is None
    assert found.frequency_at(heavier.blade, 6.0, 0.1) is None
    assert found.history(CASES["S1+h"]) is not None


def test_a_blade_is_known_by_what_it_has():
    one, other = BEAM.with_hub_radius(0.5), BEAM.with_hub_radius(0.6)
    assert room.said((one, 6.0)) != room.said((other, 6.0))
    assert "hub_radius=0.5" in room.said(one)
    assert "setting_angle" not in room.said(one)  # nor what a blade may learn to have
    assert "line" not in room.said(one)  # whose offsets are pairs of zeros
    assert "mass_offset" in room.said(BEAM.with_offsets(mass=(0.01, 0.0)))


def test_shipped_frequencies_are_those_of_more_functions():
    found = reference(CASES["L"])
    for speed in CASES["L"].speeds:
        exact = linear_modes(BEAM, speed, 1, functions=40).frequencies[0]
        assert found.first_frequency(speed) == pytest.approx(exact, rel=1e-10)
    assert found.bound < 1e-8


def test_all_of_the_paper_is_shipped_and_starts_at_rest():
    spin_ups = [
        case.motion for case, _ in references.shipped_histories().values() if case.blade == BEAM
    ]
    assert len([one for one in spin_ups if isinstance(one, SpinUp)]) == 24 + 1  # under gravity
    assert all(shipped().history(*one) for one in references.shipped_histories().values())
    assert all(reference(case).source.startswith("shipped") for case in CASES.values())
    q, bounds = shipped().data["q"], shipped().data["bound"]
    # Real blades start from their sag, all others straight.
    real = np.array([name.startswith("W+") for name in shipped().data["history"].tolist()])
    assert np.abs(q[~real, 0]).max() == 0.0
    assert bounds[~real].max() < 1e-5
    assert bounds[real].max() < 2e-5
    assert bounds[shipped().data["history"] == "6-3"] < 2e-8


def test_what_is_judged_by_is_named():
    said = reference(CASES["S1"]).source
    assert f"benchmark {VERSION}: references.nc (SHA-256 " in said
    assert "Radau collocation" in said
    assert shipped().attrs["commit"] in said
    assert "dirty" not in said


def test_a_case_that_is_not_shipped_is_computed():
    case = spin_up_case(BEAM, SpinUp(omega=3.0, ramp_time=1.5), 4.0)
    found = reference(case)
    assert found.source == "computed from the exact beam, Bernoulli-Euler"
    times = np.linspace(0.0, 4.05, 99)  # the last step of a run may end later
    exact = spin_up_response(BEAM, case.motion, times, tolerance=1e-8).q
    assert found.history(times) == pytest.approx(exact, abs=found.bound * np.abs(exact).max())
    assert found.bound < 2e-6


def test_a_beam_with_rotary_inertia_has_a_truth_of_its_own():
    theory = Theory(rotary_inertia=True)
    beam = Beam.from_stiffness(
        length=10.0, axial_stiffness=2.8e5, bending_stiffness=1.4e4, mass_per_length=1.2
    )
    case = spin_up_case(beam, SpinUp(omega=2.0, ramp_time=2.0), 3.0)
    plain, rotary = reference(case), reference(case, theory)
    assert rotary.source == "computed from the exact beam, with rotary inertia"
    # Rayleigh: the frequency falls by half of I ∫φ'² / ∫φ², 4.65 EI/(EA L²), at rest.
    fall = 0.5 * 4.648 * 1.4e4 / (2.8e5 * 100.0)
    assert rotary.first_frequency(0.0) / plain.first_frequency(0.0) - 1.0 == pytest.approx(
        -fall, rel=0.01
    )
    assert rotary.frequency_at(0.1) / plain.frequency_at(0.1) - 1.0 == pytest.approx(-fall, rel=0.2)


def test_an_orbit_of_a_beam_that_shears_is_slower():
    """By about as much as small vibrations are: the orbit's curvature is bending's."""
    plain, sheared = reference(CASES["O"]), reference(CASES["O"], Theory(shear=0.1))
    assert sheared.source == "computed from the exact beam, Timoshenko"
    slower = sheared.frequency_at(0.4) / plain.frequency_at(0.4) - 1.0
    linear = sheared.first_frequency(2.0) / plain.first_frequency(2.0) - 1.0
    assert -1e-3 < slower < 0.0
    assert slower == pytest.approx(linear, rel=0.2)
    # Both start straight, as q rises; the one falls behind.
    time = np.linspace(0.0, 20.0, 500)
    lag = plain.history(time * (1.0 + slower))
    assert sheared.history(time) == pytest.approx(lag, abs=1e-3)
    assert np.abs(sheared.history(time) - plain.history(time)).max() > 2e-3


def test_what_is_not_asked_is_refused():
    with pytest.raises(ValueError, match="case L asks for no history, but for natural freq"):
        reference(CASES["L"]).history([0.0])
    with pytest.raises(ValueError, match=r"goes from 0 to 15 s, got 30 s: leave out"):
        reference(CASES["S1"]).history([1.0, 30.0])
    with pytest.raises(ValueError, match=r"goes from 0 to 15 s, got -1 s"):
        reference(CASES["S1"]).history(-1.0)
    with pytest.raises(ValueError, match="case B has several speeds: say which"):
        reference(CASES["B"]).frequency_at(0.1)


@pytest.mark.parametrize(
    ("name", "load", "sentence"),
    [
        ("L", Gravity(), "case L, natural frequencies .*, knows no Gravity.* take a spin-up"),
        ("B", Gravity(), "take a spin-up"),
        ("O", Gravity(), "take a spin-up"),
        ("P", Gravity(), "knows no Gravity.* weight along the axis of rotation alone"),
        ("P", TipForce(amplitude=5.0, frequency=0.0), "knows no TipForce"),
    ],
)
def test_loads_that_a_reference_would_leave_out_are_refused(name, load, sentence):
    with pytest.raises(ValueError, match=sentence):
        replace(CASES[name], loads=(load,))


def other_data(tmp_path, monkeypatch, content):
    """Let other bytes be the shipped file, or none, and return what is said of them."""
    path = tmp_path / "references.nc"
    if content:
        path.write_bytes(content)
    monkeypatch.setattr(room, "FILE", path)
    with pytest.raises(RuntimeError) as caught:
        shipped.__wrapped__()
    return str(caught.value)


def test_no_bit_of_the_data_is_another(tmp_path, monkeypatch):
    """HDF5 notices 368 of 400; of the others one moved a sample by 153 s."""
    raw = room.FILE.read_bytes()
    assert "cannot be read" in other_data(tmp_path, monkeypatch, b"")
    for place in np.linspace(0, len(raw) - 1, 60).astype(int).tolist():
        other = bytearray(raw)
        other[place] ^= 1 << (place % 8)
        said = other_data(tmp_path, monkeypatch, bytes(other))
        assert "references.nc were damaged or changed (SHA-256 " in said
        assert "install rotbeam-exu again, or make them by tools" in said
    assert "damaged or changed" in other_data(tmp_path, monkeypatch, raw[:-1])


def test_data_made_anew_are_taken_with_the_digest_that_is_written(tmp_path, monkeypatch):
    code, data = tmp_path / "shipped.py", xr.load_dataset(room.FILE)
    code.write_text(Path(room.__file__).read_text("utf-8"), "utf-8")
    monkeypatch.setattr(room, "__file__", str(code))
    monkeypatch.setattr(room, "FILE", tmp_path / "references.nc")
    references.write(data.assign_attrs(commit="another"))
    found = re.search(r'^DIGEST = "([0-9a-f]{64})"$', code.read_text("utf-8"), re.MULTILINE)[1]
    assert found != room.DIGEST
    monkeypatch.setattr(room, "DIGEST", found)
    assert shipped.__wrapped__().source.endswith("made at commit another")


def test_what_the_file_has_stays_to_the_last_bit(monkeypatch):
    """A case that is added costs its own time: nothing of the others is computed."""
    for name in ("history", "table", "backbone"):
        monkeypatch.setattr(references, name, None)  # not to be called
    data = xr.load_dataset(room.FILE)
    again = references.dataset("later", references.Kept(data))
    assert again.attrs["commit"] == f"{data.attrs['commit']}, later"
    assert again.assign_attrs(commit=data.attrs["commit"]).identical(data)


def test_only_what_is_new_is_computed(monkeypatch):
    data = xr.load_dataset(room.FILE)
    kept = references.Kept(data.drop_sel(table="G+N"))
    made = references.table(CASES["G+N"], Theory())
    calls = []
    monkeypatch.setattr(references, "table", lambda *one: calls.append(one[0].name) or made)
    for name, one in references.shipped_tables().items():
        rows, bound = kept.table(*one)
        assert rows.shape[0] == len(one[0].speeds), name
        assert bound < 1e-5
    assert calls == ["G+N"]
