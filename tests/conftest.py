import os
import sys

import numpy as np
import pytest
from hypothesis import settings

from analytic import Beam, SpinUp
from rotbeam_exu.cli import main

os.environ["MPLBACKEND"] = "agg"  # no display, neither here nor in child processes

# Random examples of a statement that names no number of its own; `make test-all` takes "all".
settings.register_profile("quick", max_examples=20, deadline=None)
settings.register_profile("all", max_examples=100, deadline=None)
settings.load_profile("quick")


@pytest.fixture(autouse=True)
def figures_are_closed():
    yield
    if "matplotlib.pyplot" in sys.modules:
        sys.modules["matplotlib.pyplot"].close("all")


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


@pytest.fixture
def call(capsys):
    """Call the command line: exit code, standard output and error."""

    def run(*arguments):
        code = 0
        try:
            main([str(argument) for argument in arguments])
        except SystemExit as stop:
            code = stop.code or 0
        return code, *capsys.readouterr()

    return run
