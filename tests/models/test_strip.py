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
    found, table = response(end, tolerance), three_codes.history(EXACT)[: round(100 * end) + 1]
    places = np.column_stack([table[name] for name in ("along", "lag", "flap")])
    # The tolerance is over the largest deflection.
    within = tolerance * np.abs(table["lag"]).max()
    np.testing.assert_allclose(found.tip / 8.0, places, atol=within)
    np.testing.assert_allclose(found.twist, table["twist"], atol=within)
