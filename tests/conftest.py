import numpy as np
import pytest

from analytic import Beam, SpinUp


@pytest.fixture(scope="session")
def beam():
    """The paper's beam."""
    return Beam.reference()


@pytest.fixture(scope="session")
def spin_up():
    """The spin-up of the main job."""
    return SpinUp(omega=6.0, ramp_time=3.0)


def observed_order(sizes, errors):
    """Slope of log error over log size, by least squares."""
    return np.polyfit(np.log(sizes), np.log(errors), 1)[0]


@pytest.fixture(scope="session")
def fitted_order():
    return observed_order
