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


@pytest.mark.parametrize(
    ("functions", "case", "rows", "near"),
    [
        ("56", "", 26, 1e-9),
        ("56", "small", 26, 1e-9),
        ("40", "mildest", 26, 1e-9),
        # Into the buckling, by other steps and tolerances than the table's.
        pytest.param("56", "", 76, 2e-9, marks=pytest.mark.slow),
    ],
)
def test_the_script_writes_the_table_anew(monkeypatch, functions, case, rows, near):
    """Steps have 1624 unknowns, whose tangents lead nowhere from 0.2 s on in single precision."""
    made = {}
    ramp, kick, times, few = run.CASES[case]
    monkeypatch.setitem(run.CASES, case, (ramp, kick, times[:rows], few))
    monkeypatch.setattr(run, "write", lambda code, time, tip, twist: made.update({code: tip}))
    run.exact(functions, "5e-3" if rows == 26 else "1.25e-3", case)
    ((code, tip),) = made.items()
    # Up to 0.6 s, that of 88 functions has 56.
    table = three_codes.history(code.replace("small_56", "small_88"))[:rows]
    places = np.column_stack([table[name] for name in ("along", "lag", "flap")])
    np.testing.assert_allclose(tip, places, rtol=0.0, atol=near)


def farthest(code, until=1.5):
    """Largest difference from the exact blade up to a time, over L."""
    return three_codes.apart(code, EXACT)[: round(100 * until) + 1].max()


def test_how_far_the_exact_tip_is_known():
    """By 88 and 72 functions, and by 56 with steps up to 5 ms and looser tolerances."""
    assert farthest("exact_56", 0.7) < 1e-9
    # The page's table, to its two digits.
    for code, differences in {
        "exact_88": (2.2e-10, 2.1e-8, 6.8e-7, 6.8e-7),
        "exact_72": (1.9e-9, 6.2e-8, 5.5e-7, 1.8e-6),
        "exact_56": (7.1e-8, 5.6e-7, 1.3e-6, 4.8e-6),
    }.items():
        found = [farthest(code, until) for until in (1.0, 1.1, 1.3, 1.5)]
        assert found == pytest.approx(differences, rel=0.05)
    twists = [three_codes.history(code)["twist"] for code in (EXACT, "exact_88")]
    assert np.abs(twists[0] - twists[1]).max() < 6e-5
    # Sixteen functions more leave half of the error at most.
    for until in (1.0, 1.1, 1.25, 1.5):
        assert farthest("exact_56", until) > 2.0 * farthest("exact_72", until)


def test_three_codes_agree():
    """By meshes of 128 and 64 with the finer steps, and closer than by half of them."""
    for code, coarse, fine in (("exudyn", 64, 128), ("mujoco", 32, 64)):
        for until in (0.65, 1.0, 1.5):
            # Of order 2 before the buckling; after it their waves lag.
            closer = {0.65: 3.9, 1.0: 1.9, 1.5: 1.9}[until]
            assert farthest(f"{code}_{coarse}", until) > closer * farthest(f"{code}_{fine}", until)
    # The page's table, to its two digits.
    for code, differences in {
        "exudyn_64": (1.2e-6, 1.5e-3, 3.4e-3), "exudyn_128": (1.5e-7, 3.9e-4, 9.0e-4),
        "mujoco_32": (4.1e-6, 2.6e-3, 5.4e-3), "mujoco_64": (1.0e-6, 1.3e-3, 2.8e-3),
    }.items():  # fmt: skip
        found = [farthest(code, until) for until in (0.65, 1.0, 1.5)]
        assert found == pytest.approx(differences, rel=0.05)


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


@pytest.mark.parametrize(
    ("tables", "same", "most", "first", "last"),
    [
        (["small_88", "small_112"], 1.21, [1.25e-5, 1.63e-3], [0.807, -0.1297], [1.5, -0.8533]),
        (["small_112", "small_136"], 1.25, [1.17e-5, 3.18e-3], [0.807, -0.1297], [1.5, -0.8533]),
        (["mildest_32", "mildest_40"], 1.1, [4.55e-5, 1.2e-3], [1.164, -0.0988], [1.4, -0.1723]),
    ],
)
def test_a_kick_as_small_as_1e_6(tables, same, most, first, last):
    """Both buckle into waves that are short for so few functions."""
    tables = [f"exact_{table}" for table in tables]
    difference = three_codes.apart(*tables)
    until = round(100 * same)
    assert difference[: until + 1].max() < 1e-6
    assert (difference[until + 1 : until + 2] > 1e-6).all()
    histories = [three_codes.history(table) for table in tables]
    twists = np.abs(histories[0]["twist"] - histories[1]["twist"])
    assert [difference.max(), twists.max()] == pytest.approx(most, rel=0.01)
    for table in histories:
        assert crossing(table) == pytest.approx(first, abs=6e-4)
        assert [table["time"][-1], table["lag"][-1]] == pytest.approx(last, abs=1.1e-4)
        assert table["flap"][0] == pytest.approx(1e-6, rel=1e-6)


def test_the_figure_has_three_codes():
    *histories, differences = three_codes.figure()
    assert [len(ax.lines) for ax in histories] == [3, 3, 3]
    for line, code in zip(
        differences.lines, ("exudyn_128", "mujoco_64", *three_codes.COARSER), strict=True
    ):
        np.testing.assert_array_equal(line.get_ydata(), three_codes.apart(code, EXACT)[1:])
