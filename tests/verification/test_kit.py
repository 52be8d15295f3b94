"""The kit's files: whole, exact, and what the package itself computes with."""

import csv
import hashlib
import json
import math
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from analytic import Damping, FourierRamp, Gravity, TipForce
from rotbeam_exu.verification import kit as room
from rotbeam_exu.verification.case import Asked
from rotbeam_exu.verification.cases import CASES, VERSION
from rotbeam_exu.verification.judgement import THRESHOLDS
from rotbeam_exu.verification.kit import MESHES, row_of, write_kit
from rotbeam_exu.verification.references import reference

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
import problem

HISTORIES = [case for case in CASES.values() if case.asked is Asked.HISTORY]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return write_kit(tmp_path_factory.mktemp("new") / "kit")


def columns(path):
    with path.open(newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def test_all_files_are_there_and_are_what_their_sums_say(folder):
    sums = (folder / "SHA256SUMS").read_text().splitlines()
    listed = dict(reversed(line.split("  ", 1)) for line in sums)
    there = {p.relative_to(folder).as_posix() for p in folder.rglob("*") if p.is_file()}
    assert set(listed) == there - {"SHA256SUMS"}
    for name, digest in listed.items():
        assert hashlib.sha256((folder / name).read_bytes()).hexdigest() == digest
    wanted = {"PROBLEM.pdf", "README.md", "VERSION", "cases.csv", "cases.json", "reference_S1.csv"}
    wanted |= {f"drive_{case.name}.csv" for case in HISTORIES}
    # Each has twice the elements of the one before, so that orders can be told.
    assert [mesh * 2**-k for k, mesh in enumerate(MESHES)] == [8] * len(MESHES)
    wanted |= {f"start_O_{mesh}.csv" for mesh in MESHES}
    wanted |= {"sample/entry.toml", "sample/runs.csv", "sample/L.csv"}
    assert wanted <= there
    assert {name.partition("/")[2].partition("/")[0] for name in there if "starters" in name} == {
        "cpp", "fortran", "julia", "matlab", "python"
    }  # fmt: skip
    assert (folder / "VERSION").read_text() == f"{VERSION}\n"


def test_both_tables_have_the_cases(folder):
    document = json.loads((folder / "cases.json").read_text(encoding="utf-8"))
    assert document["benchmark"] == VERSION
    assert document["thresholds"] == THRESHOLDS
    rows = {row["id"]: row for row in document["cases"]}
    assert rows == {name: row_of(case) | {"title": case.title} for name, case in CASES.items()}
    with (folder / "cases.csv").open(newline="") as file:
        for row in csv.DictReader(file):
            for key, cell in row.items():
                value = rows[row["id"]][key]
                text = " ".join(map(str, value)) if isinstance(value, list) else str(value)
                assert cell == ("" if value is None else text)


S1 = CASES["S1"]


@pytest.mark.parametrize(
    ("part", "missing"),
    [
        ({"blade": S1.blade.with_point_mass(0.1, 4.0)}, "position=4.0, mass=0.1"),
        ({"blade": S1.blade.with_setting_angle(0.3)}, "setting_angle = 0.3"),
        ({"blade": S1.blade.with_damping(Damping(external=0.1))}, "external=0.1"),
        ({"blade": S1.blade.with_taper(0.2)}, "section = "),
        ({"loads": (Gravity(), TipForce(amplitude=0.5, frequency=3.0))}, "TipForce"),
        ({"motion": FourierRamp(omega=6.0, ramp_time=3.0, start=1.0)}, "FourierRamp"),
    ],
)
def test_a_case_that_is_more_than_its_row_is_refused(part, missing):
    with pytest.raises(ValueError, match=f"S1 has .*{missing}.*, of which cases.csv would have"):
        row_of(replace(S1, **part))


def test_drives_read_back_to_the_last_bit(folder):
    for case in HISTORIES:
        drive = columns(folder / f"drive_{case.name}.csv")
        assert drive["t"][-1] == case.duration
        for name, of in (("theta", "angle"), ("theta_dot", "rate"), ("theta_ddot", "acceleration")):
            assert np.array_equal(drive[name], getattr(case.motion, of)(drive["t"]))


def test_a_start_is_the_orbit_with_its_slopes_and_rates(folder):
    case = CASES["O"]
    orbit = case.orbit
    for mesh in MESHES:
        start = columns(folder / f"start_O_{mesh}.csv")
        assert start["x"] == pytest.approx(np.linspace(0.0, 8.0, mesh + 1), abs=1e-15)
        # A little later, by the orbit itself: central differences over 2e-4 of a period.
        at = [orbit.state(0, start["x"], phase) for phase in (-1e-4, 1e-4)]
        span = 2e-4 / orbit.frequency[0]
        slopes, angles = [one.slope for one in at], [np.arctan2(*one.slope.T[1::-1]) for one in at]
        for name, (before, after) in {
            "X_dot": [one.place[:, 0] for one in at], "Y_dot": [one.place[:, 1] for one in at],
            "angle_dot": angles, "X_slope_dot": [one[:, 0] for one in slopes],
            "Y_slope_dot": [one[:, 1] for one in slopes],
        }.items():  # fmt: skip
            assert start[name] == pytest.approx((after - before) / span, abs=1e-6)
    fine = columns(folder / "start_O_64.csv")
    assert np.abs(fine["Y"]).max() < 1e-12  # straight as it passes the axis
    assert fine["X"][-1] > 8.0  # and stretched
    slopes = np.gradient(fine["X"], fine["x"], edge_order=2)
    assert fine["X_slope"] == pytest.approx(slopes, abs=1e-6)


def test_starts_at_any_places_are_rows_of_the_files(folder):
    """Quadratic elements, uneven meshes, and every second row of twice the elements."""
    coarse, fine = (columns(folder / f"start_O_{mesh}.csv") for mesh in (8, 16))
    assert all(coarse[name] == pytest.approx(fine[name][::2], abs=1e-12) for name in coarse)
    rows = room.start_table(CASES["O"], [7.5, 0.5]).splitlines()[2:]
    for row, k in zip(rows, (15, 1), strict=True):
        found = [float(cell) for cell in row.split(",")]
        assert found == pytest.approx([fine[name][k] for name in fine], abs=1e-12)
    with pytest.raises(ValueError, match="x must lie on the beam"):
        room.start_table(CASES["O"], [8.5])


def test_the_tube_has_the_beam():
    """The problem's formulas give A and I; EI and ρA of the table are E I and ρ A."""
    beam, row = S1.blade, row_of(S1)
    squared = beam.second_moment / beam.area
    r = math.sqrt(squared + math.sqrt(squared**2 - (beam.area / math.pi) ** 2 / 16.0))
    t = beam.area / (2.0 * math.pi * r)
    outer, inner = r + 0.5 * t, r - 0.5 * t
    assert math.pi * (outer**2 - inner**2) == pytest.approx(beam.area, rel=1e-12)
    assert 0.25 * math.pi * (outer**4 - inner**4) == pytest.approx(beam.second_moment, rel=1e-12)
    told = json.loads(problem.problem_numbers())["material"]
    assert told["E"] * told["I"] == pytest.approx(row["EI"], rel=1e-14)
    assert told["rho"] * told["A"] == pytest.approx(row["rhoA"], rel=1e-14)


def test_the_ellipse_has_the_blade_in_space():
    """The problem's E, ρ and half axes give its stiffnesses, by the formulas of a full ellipse."""
    row, a, b, E = row_of(CASES["F"]), 0.16, 0.04, 1e9
    A, lag, flap = math.pi * a * b, 0.25 * math.pi * a**3 * b, 0.25 * math.pi * a * b**3
    torsion = math.pi * (a * b) ** 3 / (a**2 + b**2)
    told = row["EA"], row["rhoA"], row["EI"], row["EI_flap/EI"], row["GJ/EI"]
    due = E * A, 1200.0 * A, E * lag, flap / lag, torsion / 2.6 / lag
    assert told == pytest.approx(due, rel=1e-12)


def test_the_history_for_self_check_is_the_reference(folder):
    found = columns(folder / "reference_S1.csv")
    truth = reference(CASES["S1"])
    assert np.array_equal(found["q"], truth.history(found["time"]))
    # Samples of 10 ms: differences of the second order err by ω³a/6 of 1e-4.
    rate = np.gradient(found["q"], found["time"])
    assert found["q_dot"][1:-1] == pytest.approx(rate[1:-1], abs=0.02)


def test_the_paper_is_of_the_present_source():
    """If this fails: python tools/problem.py, and look at it."""
    assert problem.DIGEST.read_text().strip() == problem.problem_digest()
    assert problem.PDF.read_bytes().startswith(b"%PDF")


def test_the_paper_has_two_pages_and_two_for_space():
    pytest.importorskip("typst")
    pages = problem.typeset(format="png", ppi=20)
    assert len(pages) == 4


def test_an_empty_folder_is_taken_and_another_refused(call, tmp_path, monkeypatch):
    monkeypatch.setattr(room, "kit_files", lambda: {"README.md": b"read me"})
    folder = tmp_path / "kit"
    folder.mkdir()
    assert "1 files in" in call("kit", folder)[1]
    assert (folder / "README.md").read_bytes() == b"read me"
    for place, sentence in (
        (folder, "is not empty: name a folder that is new, or empty"),
        (folder / "README.md", "is a file: name a folder"),
    ):
        code, _, error = call("kit", place)
        assert (code, sentence in " ".join(error.split())) == (2, True)
    assert [path.name for path in folder.iterdir()] == ["README.md"]
