"""A small free vibration in steady rotation stands for a natural frequency."""

import numpy as np
import pytest

from analytic import linear_modes, periodic_orbits
from rotbeam_exu.verification.cases import CASES, VERSION
from rotbeam_exu.verification.history import FREE_SWING, FREE_UNCERTAINTY, free_frequency
from rotbeam_exu.verification.judgement import judged
from rotbeam_exu.verification.outcomes import Outcome
from rotbeam_exu.verification.references import reference
from rotbeam_exu.verification.submission import Declaration, Submission
from rotbeam_exu.verification.submission_files import digests, read_submission, write_submission
from rotbeam_exu.verification.submission_files.faults import MalformedSubmissionError

L = CASES["L"]
TIME = np.arange(1001) / 50.0
MODES = linear_modes(L.blade, 6.0, 2).frequencies


def vibration(swing=0.005, damping=0.0, off=0.0):
    """Two modes of the paper's beam at 6 rad/s [m], a tenth of it in the second."""
    shapes = np.cos(np.outer(TIME, MODES * (1.0 + off))) * np.exp(-damping * np.outer(TIME, MODES))
    return L.blade.length * swing * shapes @ (1.0, 0.1)


def test_an_exact_vibration_has_the_exact_frequency_within_its_uncertainty():
    found = free_frequency(L, 8, 6.0, TIME, vibration())
    assert abs(found.values[0] - MODES[0]) <= found.rounding[0] < 1e-9 * MODES[0]
    rough = vibration() + 1e-6 * np.random.default_rng(1).standard_normal(TIME.size)
    found = free_frequency(L, 8, 6.0, TIME, rough)
    assert abs(found.values[0] - MODES[0]) <= found.rounding[0] < FREE_UNCERTAINTY * MODES[0]


@pytest.mark.parametrize("speed", [L.speeds[0], L.speeds[-1]])
def test_the_largest_that_is_taken_is_as_good_as_linear(speed):
    """Of the beam's exact orbit; the difference is a fiftieth of what passes."""
    orbit = periodic_orbits(L.blade, speed, [0.99 * FREE_SWING])
    q = L.blade.length * orbit.response(TIME, 0)
    found = free_frequency(L, 8, speed, TIME, q)
    assert found.values[0] == pytest.approx(reference(L).first_frequency(speed), rel=4e-6)


@pytest.mark.parametrize("damping", [1e-5, 1e-3])
def test_what_the_integrator_damps_has_its_frequency(damping):
    """By the logarithm of the decay over 2π."""
    found = free_frequency(L, 8, 6.0, TIME, vibration(damping=damping))
    assert abs(found.values[0] - MODES[0]) <= found.rounding[0] < FREE_UNCERTAINTY * MODES[0]


REFUSED = {
    "far": (vibration(swing=0.02), "swings by 0.02"),
    "noisy": (
        vibration() + 3e-3 * np.random.default_rng(1).standard_normal(TIME.size),
        "known to .* only",
    ),
    "growing": (vibration(damping=-1e-3), "grows by 6e-03 per cycle"),
    "at rest": (0.0 * TIME, "the tip does not oscillate: start in the first mode"),
    "drifting": (1e-3 * TIME, "the tip does not oscillate"),
}


@pytest.mark.parametrize(("q", "said"), REFUSED.values(), ids=REFUSED)
def test_another_vibration_is_refused(q, said):
    with pytest.raises(ValueError, match=said):
        free_frequency(L, 8, 6.0, TIME, q)


def put(folder, name, q, time=TIME):
    (folder / "L").mkdir(parents=True, exist_ok=True)
    rows = np.column_stack([time, q])
    np.savetxt(folder / "L" / name, rows, "%.17g", ",", header="time,q", comments="")


@pytest.fixture
def mine(tmp_path):
    """A folder of three meshes of fourth order, and what they would be through Python."""
    named = {n: vibration(off=n**-4.0) for n in (8, 16, 32)}
    for n, q in named.items():
        put(tmp_path / "mine", f"m{n:03d}_w6.csv", q)
    (tmp_path / "mine/entry.toml").write_text(f'benchmark = "{VERSION}"\ncode = "mine"\n', "utf-8")
    rows = tuple(free_frequency(L, n, 6.0, TIME, q) for n, q in named.items())
    declared = Declaration(code="mine", benchmark=VERSION)
    return tmp_path / "mine", Submission(declaration=declared, rows=rows)


def test_files_and_python_agree_to_the_last_bit(mine, tmp_path):
    """And so do the table that is written of them, with a column of their uncertainty."""
    folder, ours = mine
    theirs = read_submission(folder)
    again = read_submission(write_submission(ours, tmp_path / "again"))
    one = judged(ours).findings["L"]["linear frequency"]
    assert one.outcome is Outcome.REFERENCE
    for other in (theirs, again):
        assert other.rows == ours.rows
        two = judged(other).findings["L"]["linear frequency"]
        assert (two.model_difference, two.runs.bar) == (one.model_difference, one.runs.bar)
    assert set(digests(folder, theirs)) == {
        "entry.toml", "L/m008_w6.csv", "L/m016_w6.csv", "L/m032_w6.csv"
    }  # fmt: skip


FAULTY = {
    "w6.csv": (vibration(), "is no name of a free vibration: write L/m032_w6.csv"),
    "m064_w5.csv": (vibration(), "speed 5 is not asked for: hand in 0, 2, 4, 6, 8"),
    "m8_w6.csv": (vibration(), "the same mesh and speed are handed in twice"),
    "m064_w6.csv": (vibration(swing=0.1), "swings by 0.1"),
    "m064_w4.csv": (vibration()[:-50], "ends at 19 s, case L lasts 20 s"),
}


@pytest.mark.parametrize("name", FAULTY)
def test_faulty_files_get_a_sentence_and_the_others_are_read(mine, name):
    folder, ours = mine
    q, said = FAULTY[name]
    put(folder, name, q, TIME[: q.size])
    with pytest.raises(MalformedSubmissionError) as caught:
        read_submission(folder)
    (fault,) = caught.value.faults
    assert fault.file == f"L/{name}"
    assert said in fault.said
    assert len(caught.value.rest.rows) == len(ours.rows)
