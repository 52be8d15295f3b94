"""The strip's spin-up out of its plane by three codes: what the tables tell, and who agrees."""

import sys
from pathlib import Path

import numpy as np
import pytest

from analytic import Beam, Rectangle, SpinUp, Theory, spin_up_response

sys.path.insert(0, str(Path(__file__).parents[2] / "models" / "strip"))
import three_codes

EXACT, COARSER = three_codes.CODES["exact"], three_codes.COARSER


def response(end, tolerance):
    """The exact blade, whose steps are equal and whose functions it refines by itself."""
    times = three_codes.history(EXACT)["time"]
    return spin_up_response(
        Beam.reference().with_shape(Rectangle()), SpinUp(omega=6.0, ramp_time=3.0),
        times[times < end + 1e-9], tolerance=tolerance, bent=1e-3,
        theory=Theory(trapeze=False, rotary_inertia=True),
    )  # fmt: skip


@pytest.mark.parametrize(
    ("end", "tolerance"), [(0.5, 1e-6), pytest.param(0.72, 1e-5, marks=pytest.mark.slow)]
)
def test_the_table_is_what_spin_up_response_says(end, tolerance):
    """Up to 3e-8 rad of its own Newton's method in the twist."""
    found, table = response(end, tolerance), three_codes.history(EXACT)[: round(100 * end) + 1]
    places = np.column_stack([table[name] for name in ("along", "lag", "flap")])
    # The tolerance is over the largest deflection.
    within = tolerance * np.abs(table["lag"]).max()
    np.testing.assert_allclose(found.tip / 8.0, places, rtol=0.0, atol=within)
    np.testing.assert_allclose(found.twist, table["twist"], rtol=0.0, atol=within + 3.2e-8)


def farthest(code, until=1.5):
    """Largest difference from the exact blade up to a time, over L."""
    return three_codes.apart(code, EXACT)[: round(100 * until) + 1].max()


def test_fewer_functions_move_the_exact_tip_little():
    assert farthest(COARSER, 0.7) < 2e-10
    assert farthest(COARSER, 0.78) < 1e-6 < farthest(COARSER, 0.8)
    assert farthest(COARSER) == pytest.approx(1.34e-5, rel=0.01)


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


def test_the_strip_buckles_at_once():
    table = three_codes.history(EXACT)
    first = (np.abs(table["twist"]) > 0.1).argmax()
    # Another code, a discrete rod that starts on an arc, has 0.710 s and 0.0838.
    assert table["time"][first] == pytest.approx(0.71, abs=0.006)
    assert table["lag"][first] == pytest.approx(-0.0838, abs=5e-4)
    # It starts at rest in the first flap mode, 8 mm out of the plane.
    assert table["flap"][0] == pytest.approx(1e-3, rel=1e-6)


def test_the_figure_has_three_codes():
    *histories, differences = three_codes.figure()
    assert [len(ax.lines) for ax in histories] == [3, 3, 3]
    for line, code in zip(differences.lines, ("exudyn_128", "mujoco_64", COARSER), strict=True):
        np.testing.assert_array_equal(line.get_ydata(), three_codes.apart(code, EXACT)[1:])
