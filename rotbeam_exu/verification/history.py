"""Histories of the tip against the reference: q(t), amplitude, nonlinear frequency, orders."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from analytic.arrays import FloatArray
from analytic.lazily import interpolate

from ..lazily import xr
from ..runs.attributes import beam_attributes
from ..runs.oscillation import SteadyOscillation, steady_oscillation
from .cases import Case
from .convergence import Convergence
from .outcomes import Finding, Order, Outcome, found_of
from .references import Reference
from .refinement import Refinement, limit_of_histories, limit_of_numbers, refinement
from .submission import Declaration, Run

HISTORY_FLOOR = 1e-6
"""Changes of q(t), over max|q|, in which no order is looked for: a ten-thousandth of what passes,
and what Newton's tolerances may leave."""

LEAST_SHIFT = 5e-4
"""Least |ω_NL/ω_n - 1| that is judged: a twentieth of less is lost in the frequency's uncertainty
over ten cycles."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Histories:
    """The submitted runs of one case, compared with the reference.

    Attributes
    ----------
    case : Case
    runs : tuple of Run
        Runs that did not fail.
    reference : Reference
    declaration : Declaration
    """

    case: Case
    runs: tuple[Run, ...]
    reference: Reference
    declaration: Declaration

    @cached_property
    def rows(self) -> Refinement:
        """The runs in the order of meshes and of steps."""
        return refinement(self.runs)

    @cached_property
    def scale(self) -> float:
        """The largest deflection of the reference, max|q| [m]."""
        return float(np.abs(self.reference.history(self.rows.finest.time)).max())

    @cached_property
    def differences(self) -> dict[Run, FloatArray]:
        """Differences of each run from the reference over max|q|, at the run's own times."""
        return {run: (run.q - self.reference.history(run.time)) / self.scale for run in self.runs}

    @cached_property
    def aligned(self) -> dict[Run, FloatArray]:
        """The differences of all runs at the finest one's times, as far as all of them go."""
        finest = self.rows.finest
        time = finest.time[finest.time <= min(float(run.time[-1]) for run in self.runs)]
        return {
            run: d[: time.size] if run is finest else interpolate.CubicSpline(run.time, d)(time)
            for run, d in self.differences.items()
        }

    def deflection(self, tolerance: float) -> tuple[Finding, dict[str, Order]]:
        """Return the finding of q(t) itself, over max|q|, and the orders in mesh and step."""
        runs, steps, _ = limit_of_histories(
            self.rows, self.aligned, HISTORY_FLOOR, self.declaration
        )
        declared = self.declaration.order, self.declaration.order_in_step
        orders = {"mesh": Order(value=runs.order, declared=declared[0], why=runs.why)}
        if steps is not None:
            orders["step"] = Order(value=steps.order, declared=declared[1], why=steps.why)
        return self._found(runs, tolerance, self.reference.bound), orders

    @cached_property
    def oscillations(self) -> dict[Run, SteadyOscillation | str]:
        """The steady oscillation of each run, or why it has none."""
        return {run: self._oscillation(run.time, run.q) for run in self.runs}

    @cached_property
    def true_oscillation(self) -> SteadyOscillation | str:
        """The steady oscillation of the reference, measured alike."""
        time = self.rows.finest.time
        return self._oscillation(time, self.reference.history(time))

    def amplitude(self, tolerance: float) -> Finding:
        """Return the finding of the amplitude of the steady oscillation."""
        true = self.true_oscillation
        if isinstance(true, str):
            return Finding(outcome=Outcome.NO_VERDICT, note=f"not measured: {true}")
        measured = {
            run: (one.amplitude / true.amplitude - 1.0, one.amplitude_error / true.amplitude)
            for run, one in self.oscillations.items()
            if not isinstance(one, str)
        }
        bound = self.reference.bound + true.amplitude_error / true.amplitude
        return self._of_numbers(measured, tolerance, bound, 1.0)

    def shift(self, tolerance: float, linear: Convergence | None) -> Finding | None:
        """Return the finding of ω_NL/ω_n - 1, the run's own amplitude taken.

        `linear` is the limit of the code's ω_n/ω_n,exact - 1; without it ω_n is the reference's.
        None of a shift that is less than LEAST_SHIFT.
        """
        if isinstance(self.true_oscillation, str):
            note = f"not measured: {self.true_oscillation}"
            return Finding(outcome=Outcome.NO_VERDICT, note=note)
        speed, off = self.case.rotation.omega, 0.0 if linear is None else linear.limit
        known = {run: one for run, one in self.oscillations.items() if not isinstance(one, str)}
        runs = sorted(known, key=lambda run: (run.elements, -run.step))
        try:
            true = self.reference.frequencies_at([known[run].amplitude for run in runs])
            first = self.reference.first_frequency(speed)
        except (RuntimeError, ValueError) as error:
            return Finding(outcome=Outcome.NO_VERDICT, note=f"no reference: {error}")
        measured = {
            run: (known[run].frequency / w - 1.0 - off, known[run].frequency_error / w)
            for run, w in zip(runs, true.tolist(), strict=True)
        }
        shift = float(true[-1]) / first - 1.0 if runs else math.nan
        if abs(shift) < LEAST_SHIFT:
            return None
        bound = self.reference.bound + (0.0 if linear is None else linear.bar)
        return self._of_numbers(measured, tolerance, bound, shift)

    def _of_numbers(
        self,
        measured: Mapping[Run, tuple[float, float]],
        tolerance: float,
        bound: float,
        scale: float,
    ) -> Finding:
        """Return the finding from the runs' numbers, over `scale`."""
        finest = self.oscillations[self.rows.finest]
        if isinstance(finest, str):
            return Finding(outcome=Outcome.NO_LIMIT, note=finest)
        scaled = {run: (value / scale, bar / abs(scale)) for run, (value, bar) in measured.items()}
        runs = limit_of_numbers(refinement(list(measured)), scaled, self.declaration)
        return self._found(runs, tolerance, bound / abs(scale), scaled[self.rows.finest][0])

    def _found(
        self, runs: Convergence, tolerance: float, bound: float, difference: float | None = None
    ) -> Finding:
        found = found_of(runs, tolerance=tolerance, bound=bound, where=f"in {self.case.name}")
        if difference is None:
            difference = float(np.abs(self.differences[self.rows.finest]).max())
        if found.outcome is Outcome.ANOTHER_LIMIT and not self.rows.steps_are_refined:
            note = f"with one step its error is in the difference of {runs.limit:+.1e}: refine it"
            return replace(found, outcome=Outcome.NO_VERDICT, note=note, difference=difference)
        return replace(found, difference=difference)

    def _oscillation(self, time: FloatArray, q: FloatArray) -> SteadyOscillation | str:
        driven = {"omega": self.case.rotation.omega, "ramp_time": self.case.ramp_time}
        attrs = beam_attributes(self.case.blade) | driven
        run = xr.Dataset({"q": ("time", q)}, {"time": time}, attrs)
        try:
            return steady_oscillation(run)
        except ValueError as error:
            return str(error)
