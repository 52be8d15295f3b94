"""What a sweep knows of one case: the measured numbers, or why there are none."""

from __future__ import annotations

import math
from functools import lru_cache

from analytic import AnyBlade

from ..fem.case import Case
from ..fem.elements import Formulation, formulation
from ..fem.linearization import Linearization
from ..fem.simulation import run_case
from ..lazily import xr
from ..runs.check import SimulationError
from ..runs.oscillation import NoOscillationError, steady_oscillation
from .provenance import code_of

MEASURED = {
    "amplitude": ("1", "amplitude a = q/L, half peak to peak"),
    "amplitude_error": ("1", "error bar of a, estimator"),
    "first_harmonic": ("1", "first harmonic over L"),
    "frequency": ("rad/s", "nonlinear frequency ω_NL"),
    "frequency_error": ("rad/s", "error bar of ω_NL, estimator"),
    "offset": ("1", "mean of q over L"),
    "residual": ("1", "second bending mode, rms over L"),
    "omega_n": ("rad/s", "natural frequency ω_n of the mesh"),
}
"""What is measured of a case: unit and long name."""


def maker(element: str | Formulation) -> dict[str, str] | None:
    """Return what besides its inputs makes the result of a case: the element's class and the code.

    None if the files do not tell what the class does; see `provenance.code_of`.
    """
    cls = type(formulation(element))
    code = code_of(cls)
    return None if code is None else {"class": f"{cls.__module__}.{cls.__qualname__}", "code": code}


def solve(case: Case) -> xr.Dataset:
    """Run one case and measure it: the unit of work, a pure function of the case.

    Returns
    -------
    Dataset
        q and q_dot over `time`; the measured numbers and the verdict as attributes. Of a case that
        fails, the attribute `failure` says why, nothing is measured, and q and q_dot are there as
        far as they were computed.
    """
    run = None
    try:
        run = run_case(case)
        omega_n = _omega_n(case.beam, case.omega, case.model, case.elements)
        measured = {**_steady(run), "omega_n": omega_n, "verdict": run.attrs["verdict"]}
    except SimulationError as error:
        computed = error.run if run is None else run
        result = xr.Dataset() if computed is None else computed[["q", "q_dot"]]
        result.attrs = {"verdict": "failed", "failure": str(error)}
        return result
    result = run[["q", "q_dot"]]
    result.attrs = {**measured, "failure": ""}
    return result


def _steady(run: xr.Dataset) -> dict[str, float]:
    """Measure the steady oscillation; what cannot be measured fails the case, not the sweep."""
    try:
        steady = steady_oscillation(run)
    except NoOscillationError as error:
        raise SimulationError(str(error)) from error
    measured = {name: float(getattr(steady, name)) for name in MEASURED if name != "omega_n"}
    for name, value in measured.items():
        if not math.isfinite(value):
            raise SimulationError(f"the {MEASURED[name][1]} was measured as {value}")
    return measured


@lru_cache(maxsize=64)
def _omega_n(beam: AnyBlade, omega: float, element: Formulation, elements: int) -> float:
    return float(Linearization.of(beam, omega, element, elements).frequencies(1)[0])
