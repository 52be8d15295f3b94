"""Codes made of the exact answer, with errors that are known."""

import math
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from analytic import spin_up_response
from rotbeam_exu.verification.verify import Entry


def exact_history(case):
    """Time and the exact answer, fifty samples a period of the paper's beam."""
    time = np.linspace(0.0, case.duration, math.ceil(case.duration / 0.02) + 1)
    return time, spin_up_response(case.blade, case.motion, time, tolerance=1e-6)


@pytest.fixture(scope="session")
def made_of_the_exact_answer():
    """Return an entry whose q(t) is the exact one times 1 + h² + C/nᵖ, changed further."""
    known = {}

    def make(change=None, *, power=2.0, size=1e-2, **options):
        def code(case, *, elements, step):
            case = replace(case, duration=case.whole_duration(step))
            key = case.blade, case.motion, case.duration
            if key not in known:
                known[key] = exact_history(case)
            time, exact = known[key]
            q = exact.q * (1.0 + step**2 + size / elements**power)
            q = q if change is None else change(time, q, elements)
            return xr.Dataset({"q": ("time", q), "q_dot": ("time", exact.q_dot)}, {"time": time})

        return Entry(name="mine", simulate=code, **{"order": power, **options})

    return make
