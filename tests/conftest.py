import gc
import os
import sys

import numpy as np
import pytest
from hypothesis import settings

from analytic import Beam, Damping, SpeedRipple, SpinUp, forced_response
from analytic.theory import BERNOULLI_EULER
from rotbeam_exu.cli import main
from rotbeam_exu.verification.cases import CASES, VERSION
from rotbeam_exu.verification.references import reference
from rotbeam_exu.verification.submission import Declaration, Row, Run, Submission

os.environ["MPLBACKEND"] = "agg"  # no display, neither here nor in child processes

# Random examples of a statement that names no number of its own; `make test-all` takes "all".
settings.register_profile("quick", max_examples=20, deadline=None)
settings.register_profile("all", max_examples=100, deadline=None)
settings.load_profile("quick")

# Nothing that is imported and collected is garbage: to look for it took a third of that time.
gc.disable()


def pytest_collection_finish():
    gc.freeze()
    gc.enable()


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


@pytest.fixture(scope="session")
def folded():
    """The beam's response to a ripple of the speed at 6 rad/s, from fold to fold and beyond."""
    beam = Beam.reference()
    damped = beam.with_damping(Damping.from_ratio(beam, ratio=8e-4))
    return forced_response(damped, 6.0, SpeedRipple(amplitude=0.002), [3.7, 3.76], functions=8)


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


@pytest.fixture
def reached(call, monkeypatch):
    """Return a function: what a command hands to a function that would take long."""

    def arguments(room, name, *command):
        seen = []

        def stopped(*given, **options):
            seen.append((given, options))
            raise KeyboardInterrupt

        with monkeypatch.context() as patch:
            patch.setattr(room, name, stopped)
            assert call(*command)[0] == 130
        return seen[0]

    return arguments


@pytest.fixture(scope="session")
def submitted():
    """Return a function that makes a submission of L and S1, its q(t) changed by a function."""
    truth = {name: reference(CASES[name], BERNOULLI_EULER) for name in ("L", "S1")}
    time = np.arange(0.0, 15.005, 0.02)[:751]
    q = truth["S1"].history(time)

    def make(change=None, **declared):
        runs = tuple(
            Run(
                case="S1", elements=n, step=h, time=time, dof=4 * n, wall=0.1 * n * 1e-3 / h,
                cpu=0.1 * n, file=f"S1/m{n:03d}_h{h:.0e}.csv".replace("e-0", "e-"),
                q=(q if change is None else change(q)) * (1.0 + 0.1 / n**2 + 100.0 * h**2),
                remark="went on" if n == 8 else "",
            )
            for n, h in ((8, 1e-3), (16, 1e-3), (32, 1e-3), (16, 5e-4), (16, 2e-3))
        )  # fmt: skip
        rows = tuple(
            Row(
                elements=n, speed=speed,
                values=(truth["L"].first_frequency(speed) * (1.0 + 1e-2 / n**2),),
            )
            for n in (8, 16, 32)
            for speed in (0.0, 6.0)
        )  # fmt: skip
        own = {"benchmark": VERSION, "order": 2.0, "order_in_step": 2.0, "code": "Mine"}
        return Submission(declaration=Declaration(**own | declared), rows=rows, runs=runs)

    return make
