"""The spin-up of Simo and Vu-Quoc, J. Appl. Mech. 53 (1986) 855-863, the classic of its kind."""

import pytest

from analytic import Beam, SpinUp
from rotbeam_exu import simulate
from rotbeam_exu.fem.linearization import steady_stretch


@pytest.fixture(scope="module")
def classic():
    return Beam.from_stiffness(
        length=10.0, axial_stiffness=2.8e7, bending_stiffness=1.4e4, mass_per_length=1.2
    )


def test_steady_stretch(classic):
    # Printed in the literature as 5.14e-4; five digits from tan(kL)/k - L.
    assert steady_stretch(classic, 6.0) == pytest.approx(5.1432e-4, abs=5e-9)


def test_largest_lag_of_the_tip(classic):
    run = simulate(
        classic,
        SpinUp(omega=6.0, ramp_time=15.0),
        elements=16,
        duration=15.5,
        step=2e-3,
        frame="rotating",
    )
    lowest = int(run["q"].argmin("time"))
    assert run["q"][lowest].item() == pytest.approx(-0.57375, abs=5e-5)
    # Samples are 5 ms apart, and the minimum is flat.
    assert run["time"][lowest].item() == pytest.approx(6.763, abs=1e-2)
