"""The residual amplitude of a real blade: closed form, exact transient and finite elements."""

from pathlib import Path

import numpy as np
import pytest

from rotbeam_exu import comparison
from rotbeam_exu.files.beam_file import load_beam

SHIPPED = Path(__file__).parents[2] / "models" / "blades"


@pytest.mark.slow
def test_a_ramp_of_nrel_by_modes_by_the_exact_transient_and_by_elements():
    """From 0.18 to 4e-4 of its length: the page of spin-ups has these bounds."""
    blade, names = load_beam(SHIPPED / "nrel_5mw.toml"), ("all_modes", "exact", "finite_element")
    data = comparison.residual(
        blade, 1.267, longest=4.3, points=9, finite_element_points=5, element="space_exact"
    )
    modes, exact, elements = (data[name] for name in names)
    modes = np.interp(data["exact_ramp_time"], data["ramp_time"], modes)
    assert exact[0] > 0.17
    assert exact.min() < 5e-4
    np.testing.assert_allclose(modes, exact, rtol=0.04)
    np.testing.assert_allclose(elements, exact[::2], rtol=0.02)
