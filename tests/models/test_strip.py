"""The strip's spin-up out of its plane by three codes: what the tables tell, and who agrees."""

import sys
from pathlib import Path

import numpy as np
import pytest

from analytic import spin_up_response

sys.path.insert(0, str(Path(__file__).parents[2] / "models" / "strip"))
import run
import three_codes

EXACT = three_codes.CODES["exact"]


def response(end, tolerance):
    """The exact blade, whose steps are equal and whose functions it refines by itself."""
    times = three_codes.history(EXACT)["time"]
    return spin_up_response(
        run.STRIP, run.MOTION, times[times < end + 1e-9], tolerance=tolerance, bent=run.KICK,
        theory=run.THEORY,
    )  # fmt: skip


@pytest.mark.parametrize(
    ("end", "tolerance"), [(0.5, 1e-6), pytest.param(0.66, 1e-5, marks=pytest.mark.slow)]
)
def test_the_table_is_what_spin_up_response_says(end, tolerance):
    """Up to 3e-8 rad of its own Newton's method in the twist."""
    found, table = response(end, tolerance), three_codes.history(EXACT)[: round(100 * end) + 1]
    places = np.column_stack([table[name] for name in ("along", "lag", "flap")])
    # The tolerance is over the largest deflection.
    within = tolerance * np.abs(table["lag"]).max()
    np.testing.assert_allclose(found.tip / 8.0, places, rtol=0.0, atol=within)
    np.testing.assert_allclose(found.twist, table["twist"], rtol=0.0, atol=within + 3.2e-8)


@pytest.mark.parametrize("case", ["", "small", "mildest"])
def test_the_script_writes_the_table_anew(monkeypatch, case):
    """Of 1160 unknowns a step, whose tangents lead nowhere from 0.2 s on in single precision."""
    made = {}
    ramp, kick, times = run.CASES[case]
    monkeypatch.setitem(run.CASES, case, (ramp, kick, times[:26]))
    monkeypatch.setattr(run, "write", lambda code, time, tip, twist: made.update({code: tip}))
    run.exact("40", "tight" if case == "mildest" else "loose", case)
    ((code, tip),) = made.items()
    table = three_codes.history(code)[:26]
    places = np.column_stack([table[name] for name in ("along", "lag", "flap")])
    np.testing.assert_allclose(tip, places, rtol=0.0, atol=1e-9)


def farthest(code, until=1.5):
    """Largest difference from the exact blade up to a time, over L."""
    return three_codes.apart(code, EXACT)[: round(100 * until) + 1].max()


def test_how_far_the_exact_tip_is_known():
    """By 40 functions, and by 48 with smaller steps and tighter tolerances."""
    assert farthest("exact_40", 0.7) < 2e-10
    assert farthest("exact_40") == pytest.approx(1.34e-5, rel=0.01)
    assert farthest("exact_48", 0.7) < 1e-9
    assert farthest("exact_48", 1.1) < 1e-6 < farthest("exact_48", 1.11)
    assert farthest("exact_48") < 2e-5


def test_three_codes_agree():
    """By meshes of 128 and 64 with the finer steps, and closer than by half of them."""
    for code, coarse, fine in (("exudyn", 64, 128), ("mujoco", 32, 64)):
        for until in (0.65, 1.0, 1.5):
            # Of order 2 before the buckling; after it their waves lag.
            closer = {0.65: 3.9, 1.0: 1.9, 1.5: 1.9}[until]
            assert farthest(f"{code}_{coarse}", until) > closer * farthest(f"{code}_{fine}", until)
    assert farthest("exudyn_128", 0.65) < 2e-7
    assert farthest("exudyn_128") < 1e-3
    assert farthest("mujoco_64") < 3e-3


def crossing(table):
    """Time at which the twist passes 0.1 [s] and lag of the tip over L, between the rows."""
    after = (np.abs(table["twist"]) > 0.1).argmax()
    rows = slice(after - 1, after + 1)
    twist = np.abs(table["twist"][rows])
    return [np.interp(0.1, twist, table[name][rows]) for name in ("time", "lag")]


def test_the_strip_buckles_at_once():
    table = three_codes.history(EXACT)
    first = (np.abs(table["twist"]) > 0.1).argmax()
    # Another code, a discrete rod that starts on an arc, has 0.710 s and 0.0838.
    assert table["time"][first] == pytest.approx(0.71, abs=0.006)
    assert table["lag"][first] == pytest.approx(-0.0838, abs=5e-4)
    # It starts at rest in the first flap mode, 8 mm out of the plane.
    assert table["flap"][0] == pytest.approx(1e-3, rel=1e-6)


def test_the_mildest_ramp_as_exactly_as_its_noise_allows():
    """The kick of 1e-6 L grows a hundred thousand times, and round-off with it."""
    one, other = "exact_mildest_32", "exact_mildest_40"
    difference = three_codes.apart(one, other)
    assert difference[:101].max() < 1e-8
    assert difference.max() == pytest.approx(4.55e-5, rel=0.01)
    for table in map(three_codes.history, (one, other)):
        assert crossing(table) == pytest.approx([1.164, -0.0988], abs=1e-4)
        assert table["time"][-1] == 1.4
        assert table["lag"][-1] == pytest.approx(-0.17229, abs=1e-5)


def test_the_figure_has_three_codes():
    *histories, differences = three_codes.figure()
    assert [len(ax.lines) for ax in histories] == [3, 3, 3]
    for line, code in zip(
        differences.lines, ("exudyn_128", "mujoco_64", *three_codes.COARSER), strict=True
    ):
        np.testing.assert_array_equal(line.get_ydata(), three_codes.apart(code, EXACT)[1:])
