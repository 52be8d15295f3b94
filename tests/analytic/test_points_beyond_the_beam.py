"""Material points that the beam does not have are refused, in every method that takes some."""

import numpy as np
import pytest

from analytic import SpinUp, linear_modes, periodic_orbits, spin_up_response


@pytest.fixture(scope="module")
def methods(beam):
    backbone = periodic_orbits(beam, 6.0, [0.1])
    modes = linear_modes(beam, 6.0)
    spin_up = SpinUp(omega=6.0, ramp_time=3.0)
    return {
        "state": lambda x: backbone.state(0, x),
        "axis": lambda x: backbone.axis(0, x, 0.3),
        "shapes": modes.shapes,
        "axial_shapes": modes.axial_shapes,
        "spin_up": lambda x: spin_up_response(beam, spin_up, [0.01], tolerance=1e-4, points=x),
    }


@pytest.mark.parametrize("method", ["state", "axis", "shapes", "axial_shapes", "spin_up"])
def test_beyond_the_ends_and_not_a_number(methods, method):
    for x in (-1.0, 9.0, [0.0, 8.001]):
        with pytest.raises(ValueError, match=r"on the beam, from 0 to its length of 8 m, got"):
            methods[method](x)
    if method != "spin_up":
        with pytest.raises(ValueError, match="x must be finite"):
            methods[method]([0.0, np.nan])


def test_the_ends_themselves(methods):
    assert methods["state"]([0.0, 8.0]).v[0] == 0.0
    round_off = np.nextafter(8.0, 9.0)
    assert methods["shapes"](round_off) == pytest.approx(1.0)
