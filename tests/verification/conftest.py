"""Codes made of the exact answer, with errors that are known."""

import math

import numpy as np
import pytest
import xarray as xr

from analytic import SpinUp
from rotbeam_exu.verification.references import reference
from rotbeam_exu.verification.verify import Entry, verify


@pytest.fixture(scope="session")
def made_of_the_exact_answer():
    """Return an entry whose q(t) is the exact one times 1 + h² + 0.01/n², changed further."""

    def make(change=None, **options):
        def code(case, *, elements, step):
            # Fifty samples a period of the paper's beam.
            duration = case.whole_duration(step)
            time = np.linspace(0.0, duration, math.ceil(duration / 0.02) + 1)
            q = reference(case).history(time) * (1.0 + step**2 + 1e-2 / elements**2)
            q = q if change is None else change(time, q, elements)
            return xr.Dataset({"q": ("time", q)}, {"time": time})

        return Entry(name="mine", simulate=code, **{"order": 2.0, **options})

    return make


@pytest.fixture(scope="session")
def judged_right(made_of_the_exact_answer):
    """The judgement of a right code on one spin-up."""
    entry = made_of_the_exact_answer(elements=32)
    return verify(entry, spin_up=SpinUp(omega=6.0, ramp_time=3.0))
