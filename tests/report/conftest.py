"""A submission of made-up errors on the exact answer."""

import numpy as np
import pytest

from analytic.theory import BERNOULLI_EULER
from rotbeam_exu.verification.cases import CASES
from rotbeam_exu.verification.references import reference
from rotbeam_exu.verification.submission import Declaration, Frequency, Run, Submission


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
        frequencies = tuple(
            Frequency(
                elements=n, speed=speed,
                frequency=truth["L"].first_frequency(speed) * (1.0 + 1e-2 / n**2),
            )
            for n in (8, 16, 32)
            for speed in (0.0, 6.0)
        )  # fmt: skip
        declaration = Declaration(
            benchmark="1.0", order=2.0, order_in_step=2.0, **{"code": "Mine", **declared}
        )
        return Submission(declaration=declaration, frequencies=frequencies, runs=runs)

    return make
