"""One case of a sweep: the unit of parallel work, a pure function of frozen values."""

from __future__ import annotations

import json
import math
from dataclasses import asdict, dataclass
from functools import lru_cache
from typing import Any

import xarray as xr

from analytic import Beam, SpinUp
from analytic.input_checks import positive, whole_number

from .elements import Formulation, formulation, options_of
from .linearization import mesh_frequencies
from .oscillation import steady_oscillation
from .provenance import code_of
from .resolution import checked_steps
from .simulation import simulate
from .solver import Frame
from .verdict import SimulationError

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


@dataclass(frozen=True, kw_only=True)
class Case:
    """One spin-up of a sweep: all that determines its result.

    Raises
    ------
    ValueError, TypeError
        If an input is refused; NumPy's numbers become Python's.
    """

    beam: Beam
    spin_up: SpinUp
    element: str | Formulation = "cable"
    elements: int = 16
    duration: float = 15.0
    step: float = 1e-3
    frame: Frame = "inertial"

    def __post_init__(self) -> None:
        object.__setattr__(self, "elements", whole_number("elements", self.elements))
        object.__setattr__(self, "duration", positive("duration", self.duration, "s"))
        object.__setattr__(self, "step", positive("step", self.step, "s"))
        if self.frame not in ("inertial", "rotating"):
            raise ValueError(f"unknown frame {self.frame!r}; known are 'inertial' and 'rotating'")
        checked_steps(
            self.beam,
            self.spin_up.omega,
            self.spin_up.ramp_time,
            self.elements,
            self.duration,
            self.step,
        )
        try:
            model = formulation(self.element)
            json.dumps([options_of(model), hash(model)])
        except TypeError as error:
            raise TypeError(
                "element must be the name of a formulation, or an instance of a frozen dataclass "
                f"whose options are numbers and text, got {self.element!r}"
            ) from error

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


def maker(element: str | Formulation) -> dict[str, str] | None:
    """Return what besides its inputs makes the result of a case: the element's class and the code.

    None if the source does not tell what the class does; see `provenance.code_of`.
    """
    cls = type(formulation(element))
    code = code_of(cls, __name__)
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
        run = simulate(
            case.beam,
            case.spin_up,
            element=case.element,
            elements=case.elements,
            duration=case.duration,
            step=case.step,
            frame=case.frame,
        )
        omega_n = _omega_n(case.beam, case.spin_up.omega, case.element, case.elements)
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
    except ValueError as error:
        raise SimulationError(str(error)) from error
    measured = {name: float(getattr(steady, name)) for name in MEASURED if name != "omega_n"}
    for name, value in measured.items():
        if not math.isfinite(value):
            raise SimulationError(f"the {MEASURED[name][1]} was measured as {value}")
    return measured


@lru_cache(maxsize=64)
def _omega_n(beam: Beam, omega: float, element: str | Formulation, elements: int) -> float:
    return float(mesh_frequencies(beam, omega, element, elements, 1)[0])
