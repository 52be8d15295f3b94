"""A solver that reports success is not believed: what a run must satisfy to be returned."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray

STRAIN_LIMIT = 0.05
"""Axial strain beyond which a linear elastic law means nothing."""

RESIDUAL_LIMIT = 1e-8
"""Constraint residual, position over L or direction [-]; a converged Newton step leaves 1e-12."""

DRIFT_LIMIT = 1e-2
"""Drift of the steady Jacobi energy over the largest elastic energy; 1e-6 at the default step."""


class SimulationError(RuntimeError):
    """A run that the solver finished, or gave up, and that does not pass its checks.

    Attributes
    ----------
    run : Dataset or None
        What was computed, where the solver finished: to look at, not to use.
    """

    run: xr.Dataset | None = None


@dataclass(frozen=True, kw_only=True)
class _Check:
    name: str
    size: NDArray[np.float64]
    limit: float
    remedy: str

    def failure(self, time: NDArray[np.float64]) -> tuple[float, str] | None:
        """When the limit is first passed [s], and the sentence that says so."""
        # Written so that NaN fails.
        bad = ~(self.size <= self.limit)
        if not bad.any():
            return None
        first = int(np.argmax(bad))
        return float(time[first]), (
            f"{self.name} reaches {self.size[first]:.3g} at t = {time[first]:.6g} s, "
            f"above {self.limit:.3g}: {self.remedy}"
        )


def remedy(step: float, omega: float, critical_speed: float) -> str:
    """Return what to try after a run that went wrong: no step cures a linear model's reach."""
    if math.isinf(critical_speed):
        return f"take a smaller step than {step:g} s"
    if omega <= critical_speed:
        return (
            "linear elastic frames are for small deflection: take a longer ramp_time, more "
            f"substructures or another element, or a smaller step than {step:g} s"
        )
    return (
        f"linear elastic frames diverge above their critical speed, {critical_speed:.6g} rad/s "
        f"here, and omega is {omega:g} rad/s: take more substructures or another element"
    )


def judge(run: xr.Dataset) -> str:
    """Return "passed", or raise with the first bad time, the number and the remedy.

    Parameters
    ----------
    run : Dataset
        As made by `simulate`.

    Raises
    ------
    SimulationError
        If the run did not reach its end, holds a number that is not finite, leaves the reach of
        the beam, strains it beyond the linear law, violates the clamp, or does not conserve the
        Jacobi energy E - ω L_z once the rotation is steady.
    """
    time = np.asarray(run["time"], dtype=np.float64)
    attrs = run.attrs
    step, length = float(attrs["step"]), float(attrs["beam_length"])
    smaller = remedy(step, float(attrs["omega"]), float(attrs["critical_speed"]))
    for name, variable in run.data_vars.items():
        bad = ~np.isfinite(variable.to_numpy())
        if bad.any():
            raise SimulationError(
                f"{name} is not finite at t = {time[int(np.argmax(bad))]:.6g} s: {smaller}"
            )
    # A beam that hardly vibrates has no elastic energy to speak of.
    scale = max(run["elastic_energy"].max().item(), 1e-4 * run["kinetic_energy"].max().item())
    steady = time >= float(attrs["ramp_time"])
    jacobi = run["jacobi_energy"].to_numpy()
    drift = np.where(steady, np.abs(jacobi - jacobi[int(np.argmax(steady))]), 0.0)
    checks = (
        _Check(
            name="the tip's distance from the clamp over the length",
            size=np.hypot(run["tip_x"].to_numpy(), run["tip_y"].to_numpy()) / length,
            limit=1.0 + STRAIN_LIMIT,
            remedy=smaller,
        ),
        _Check(
            name="the axial strain",
            size=run["axial_strain"].to_numpy(),
            limit=STRAIN_LIMIT,
            remedy=f"{smaller}, or check the axial stiffness EA and the speed",
        ),
        _Check(
            name="the clamp's position error over the length",
            size=run["clamp_residual"].to_numpy() / length,
            limit=RESIDUAL_LIMIT,
            remedy=smaller,
        ),
        _Check(
            name="the root's direction error",
            size=np.abs(run["direction_residual"].to_numpy()),
            limit=RESIDUAL_LIMIT,
            remedy=smaller,
        ),
        _Check(
            name="the drift of the Jacobi energy E - ω L_z over the largest elastic energy",
            size=drift / max(scale, np.finfo(float).tiny),
            limit=DRIFT_LIMIT,
            remedy=f"energy should not change once the rotation is steady; {smaller}",
        ),
    )
    failures = [failure for check in checks if (failure := check.failure(time)) is not None]
    if failures:
        raise SimulationError(min(failures, key=lambda failure: failure[0])[1])
    if time[-1] < float(attrs["duration"]) - 0.5 * step:
        raise SimulationError(
            f"the solver stopped at t = {time[-1]:.6g} s of {attrs['duration']:g} s: {smaller}"
        )
    return "passed"


def energy_drift(run: xr.Dataset) -> tuple[float, float]:
    """Return drift and ripple of the steady Jacobi energy E - ω L_z over the largest elastic one.

    The drift is the change of its trend, a straight line, over the steady phase: what the
    integrator gains or loses for good. The ripple is the largest deviation from that line: the
    truncation error that comes and goes with the oscillation, of second order in the step.
    """
    steady = run["jacobi_energy"].where(run["time"] >= run.attrs["ramp_time"], drop=True)
    time, energy = steady["time"].to_numpy(), steady.to_numpy()
    trend = np.polynomial.Polynomial.fit(time, energy, 1)
    scale = max(float(run["elastic_energy"].max()), float(np.finfo(float).tiny))
    return (
        abs(float(trend(time[-1]) - trend(time[0]))) / scale,
        float(np.abs(energy - trend(time)).max()) / scale,
    )
