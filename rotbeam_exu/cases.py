"""One case of a sweep: the unit of parallel work, a pure function of frozen values."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, fields
from functools import lru_cache
from typing import Any

import xarray as xr

from analytic import Beam, SpinUp

from .elements import Formulation, formulation, options_of
from .linearization import natural_frequencies
from .oscillation import steady_oscillation
from .simulation import simulate
from .solver import Frame
from .verdict import SimulationError

MEASURED = {
    "amplitude": ("1", "amplitude a = q/L, half peak to peak"),
    "first_harmonic": ("1", "first harmonic over L"),
    "frequency": ("rad/s", "nonlinear frequency ω_NL"),
    "frequency_error": ("rad/s", "error bar of ω_NL, estimator"),
    "offset": ("1", "mean of q over L"),
    "residual": ("1", "second bending mode, rms over L"),
    "omega_n": ("rad/s", "natural frequency ω_n of the mesh"),
}
"""What is measured of a case: unit and long name."""


@dataclass(frozen=True, kw_only=True)
class Case:
    """One spin-up of a sweep: all that determines its result."""

    beam: Beam
    spin_up: SpinUp
    element: str | Formulation = "cable"
    elements: int = 16
    duration: float = 15.0
    step: float = 1e-3
    frame: Frame = "inertial"

    def describe(self) -> dict[str, Any]:
        """Return every input as plain values, for keys and records."""
        model = formulation(self.element)
        return {
            **{f"beam_{name}": value for name, value in asdict(self.beam).items()},
            **asdict(self.spin_up),
            "element": model.name,
            "element_options": json.dumps(options_of(model)),
            "elements": self.elements,
            "duration": self.duration,
            "step": self.step,
            "frame": self.frame,
        }


def solve(case: Case) -> xr.Dataset:
    """Run one case and measure it: the unit of work, a pure function of the case.

    Returns
    -------
    Dataset
        q and q_dot over `time`; the measured numbers and the verdict as attributes. A run that
        fails its checks has no variables, and the attribute `failure` says why.
    """
    try:
        run = simulate(
            case.beam,
            case.spin_up,
            element=case.element,
            elements=case.elements,
            duration=case.duration,
            step=case.step,
            frame=case.frame,
        )
        steady = steady_oscillation(run)
        omega_n = _omega_n(case.beam, case.spin_up.omega, case.element, case.elements)
    except (SimulationError, ValueError) as error:
        return xr.Dataset(attrs={"verdict": "failed", "failure": str(error)})
    result = run[["q", "q_dot"]]
    measured = {
        field.name: getattr(steady, field.name)
        for field in fields(steady)
        if field.name in MEASURED
    }
    result.attrs = {**measured, "omega_n": omega_n, "verdict": run.attrs["verdict"], "failure": ""}
    return result


@lru_cache(maxsize=64)
def _omega_n(beam: Beam, omega: float, element: str | Formulation, elements: int) -> float:
    return float(natural_frequencies(beam, omega, element=element, elements=elements, count=1)[0])
