"""Codes made of the exact answer, with errors that are known."""

import math

import numpy as np
import pytest
import xarray as xr

from analytic import spin_up_response
from rotbeam_exu.verification.peers import Entry


def exact_history(beam, spin_up, duration):
    """Time and the exact answer, fifty samples a period of the paper's beam."""
    time = np.linspace(0.0, duration, math.ceil(duration / 0.02) + 1)
    return time, spin_up_response(beam, spin_up, time, tolerance=1e-6)


@pytest.fixture(scope="session")
def made_of_the_exact_answer():
    """Return an entry whose q(t) is the exact one times 1 + h² + C/nᵖ, changed further."""
    known = {}

    def make(change=None, *, power=2.0, size=1e-2, **options):
        def code(beam, spin_up, *, elements, duration, step):
            key = beam, spin_up, duration
            if key not in known:
                known[key] = exact_history(*key)
            time, exact = known[key]
            q = exact.q * (1.0 + step**2 + size / elements**power)
            q = q if change is None else change(time, q, elements)
            return xr.Dataset({"q": ("time", q), "q_dot": ("time", exact.q_dot)}, {"time": time})

        return Entry(name="mine", simulate=code, **{"order": power, **options})

    return make
