"""Histories of the tip against the reference: q(t), amplitude, nonlinear frequency."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from analytic.arrays import FloatArray
from analytic.lazily import interpolate
from analytic.threads import one_thread

from ..runs.oscillation import NoOscillationError, SteadyOscillation, oscillation_of
from .case import Case
from .convergence import Convergence, converged
from .outcomes import Finding, Outcome, finding_of
from .references import Reference
from .submission import Declaration, Row, Run

HISTORY_FLOOR = 1e-6
"""Changes of q(t), over max|q|, in which no order is looked for: a ten-thousandth of what passes,
and what Newton's tolerances may leave."""

LEAST_SHIFT = 5e-4
"""Least |ω_NL/ω_n - 1| that is judged: a twentieth of less is lost in the frequency's uncertainty
over ten cycles."""

COPY = 1e-7
"""Difference from the reference over max|q| below which q(t) is taken for a copy: no mesh reaches a
hundred-thousandth of what passes."""

FARTHEST_SWING = 0.9
"""Amplitude over L beyond which a run has no part in the shift: orbits are not known there."""

FREE_FOR = 20.0
"""Length of a free vibration [s]: nine turns or more of the first mode."""

FREE_SWING = 0.01
"""Largest |q|/L of a free vibration: its frequency is within 3e-6 of the linear one."""

FREE_UNCERTAINTY = 2e-5
"""Relative uncertainty of the frequency of a free vibration: a tenth of what passes."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Histories:
    """The submitted runs of one case, compared with the reference.

    Attributes
    ----------
    case : Case
    runs : tuple of Run
        Runs that are judged: they did not fail, and are neither copies of another run nor of the
        reference.
    reference : Reference
    declaration : Declaration
    """

    case: Case
    runs: tuple[Run, ...]
    reference: Reference
    declaration: Declaration

    @cached_property
    def finest(self) -> Run:
        """Run of the finest mesh, at its smallest step."""
        return max(self.runs, key=lambda run: run.fineness)

    @cached_property
    def scale(self) -> FloatArray:
        """The largest deflection of the reference, max|q| [m]; in space of each component."""
        return np.asarray(np.abs(self.reference.history(self.finest.time)).max(axis=0))

    @cached_property
    def differences(self) -> dict[Run, FloatArray]:
        """Differences of each run from the reference over max|q|, at the run's own times."""
        return {run: (run.q - self.reference.history(run.time)) / self.scale for run in self.runs}

    @cached_property
    def aligned(self) -> dict[Run, FloatArray]:
        """The differences of all runs at the finest one's times, as far as all of them go."""
        finest = self.finest
        time = finest.time[finest.time <= min(float(run.time[-1]) for run in self.runs)]
        return {
            run: d[: time.size] if run is finest else interpolate.CubicSpline(run.time, d)(time)
            for run, d in self.differences.items()
        }

    def deflection(self, tolerance: float) -> Finding:
        """Return the finding of q(t) itself, over max|q|."""
        # Amplitude and frequency have few digits in the estimator's own errors already.
        noise = [HISTORY_FLOOR + np.max(run.rounding / self.scale) for run in self.aligned]
        finding = self._finding(self.aligned, noise, tolerance, self.reference.bound)
        if len(self.case.columns) > 1 and not finding.outcome.passed:
            worst = np.abs(self.differences[self.finest]).max(axis=0).argmax()
            note = f"{finding.note}, most of all {self.case.columns[worst]}"
            finding = replace(finding, note=note)
        return finding

    @cached_property
    def oscillations(self) -> dict[Run, SteadyOscillation | str]:
        """The steady oscillation of each run, or why it has none."""
        return {run: self._oscillation(run.time, run.q) for run in self.runs}

    @cached_property
    def true_oscillation(self) -> SteadyOscillation | str:
        """The steady oscillation of the reference, measured alike."""
        time = self.finest.time
        return self._oscillation(time, self.reference.history(time))

    @property
    def losses(self) -> list[str]:
        """A sentence on how much the integrator damps, of the finest run in which it is seen."""
        for run in sorted(self.runs, key=lambda run: run.fineness, reverse=True):
            one = self.oscillations[run]
            if isinstance(one, str) or self.case.blade.damping:
                return []
            if one.decay * one.cycles > one.amplitude_error / one.amplitude:
                said = f"damps the first mode by {one.decay:.0e} of its amplitude per cycle"
                return [f"your integrator {said}: {_name(run)}"]
        return []

    def amplitude(self, tolerance: float) -> Finding:
        """Return the finding of the amplitude of the steady oscillation."""
        true = self.true_oscillation
        if isinstance(true, str):
            return Finding(outcome=Outcome.UNDECIDED, note=f"not measured: {true}")
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
            return Finding(outcome=Outcome.UNDECIDED, note=note)
        speed = self.case.rotation.omega
        # A limit that is known less well than it is off mends nothing.
        off, doubt = mending(linear)
        swings = {run: one for run, one in self.oscillations.items() if not isinstance(one, str)}
        # A coarse run may swing farther than any orbit is known: it says nothing of the shift.
        runs = [
            run
            for run in sorted(swings, key=lambda run: run.fineness)
            if swings[run].amplitude < FARTHEST_SWING
        ]
        if swings and not runs:
            note = f"all runs swing by more than {FARTHEST_SWING:g} L, where no orbit is known"
            return Finding(outcome=Outcome.UNDECIDED, note=note)
        try:
            true = self.reference.frequency_at([swings[run].amplitude for run in runs])
            first = self.reference.first_frequency(speed)
        except (RuntimeError, ValueError) as error:
            return Finding(outcome=Outcome.UNDECIDED, note=f"no reference: {error}")
        measured = {
            run: (swings[run].frequency / w - 1.0 - off, swings[run].frequency_error / w)
            for run, w in zip(runs, true.tolist(), strict=True)
        }
        shift = float(true[-1]) / first - 1.0 if runs else math.nan
        if abs(shift) < LEAST_SHIFT:
            return None
        of_what = (
            "the linear frequency of L.csv" if doubt > self.reference.bound else "the reference"
        )
        return self._of_numbers(measured, tolerance, self.reference.bound + doubt, shift, of_what)

    def _of_numbers(
        self,
        measured: Mapping[Run, tuple[float, float]],
        tolerance: float,
        bound: float,
        scale: float,
        of_what: str = "the reference",
    ) -> Finding:
        """Return the finding from the runs' numbers, over `scale`."""
        if not measured:
            note = str(self.oscillations[self.finest])
            return Finding(outcome=Outcome.DIFFERS, note=note, tolerance=tolerance)
        values = {run: np.array([value / scale]) for run, (value, _) in measured.items()}
        noise = [bar / abs(scale) for _, bar in measured.values()]
        return self._finding(values, noise, tolerance, bound / abs(scale), of_what)

    def _finding(
        self, of: Mapping[Run, FloatArray], noise: Sequence[float], tolerance: float, bound: float,
        of_what: str = "the reference",
    ) -> Finding:  # fmt: skip
        """Return the finding of a number or function of each run."""
        runs = converged(
            [run.elements for run in of], [run.refinement for run in of], list(of.values()),
            refined="tolerance" if self.finest.is_adaptive else "step", noise=noise,
            declared=(self.declaration.order, self.declaration.order_in_step),
        )  # fmt: skip
        where = f"in {self.case.name}"
        return finding_of(runs, tolerance=tolerance, bound=bound, where=where, of_what=of_what)

    def _oscillation(self, time: FloatArray, q: FloatArray) -> SteadyOscillation | str:
        case = self.case
        try:
            first = self.reference.first_frequency(case.rotation.omega)
            return oscillation_of(time, q / case.blade.length, case.ramp_time, first)
        except ValueError as error:
            return str(error)


@one_thread
def free_frequency(case: Case, elements: int, speed: float, time: FloatArray, q: FloatArray) -> Row:
    """Return the natural frequency that a small free vibration in steady rotation has.

    Parameters
    ----------
    case : Case
    elements : int
    speed : float
        Of the steady rotation [rad/s].
    time, q : ndarray (samples,)
        [s], and q of Eq. 16 [m].

    Raises
    ------
    ValueError
        If q swings too far, or its frequency is not known well enough, as where it is damped.
    """
    try:
        oscillation = oscillation_of(time, q / case.blade.length, 0.0, None)
    except NoOscillationError as error:
        begin = f"start in the first mode, at up to {FREE_SWING:g} L, and let go"
        raise ValueError(f"{str(error).partition(':')[0]}: {begin}") from error
    if -oscillation.decay * oscillation.cycles > FREE_UNCERTAINTY:
        raise ValueError(
            f"grows by {-oscillation.decay:.0e} per cycle, which no free vibration does: take a "
            "smaller step, or another integrator"
        )
    if oscillation.amplitude > FREE_SWING:
        raise ValueError(
            f"swings by {oscillation.amplitude:.2g} L, where the frequency is no longer the linear "
            f"one: start at {FREE_SWING:g} L or less"
        )
    uncertainty = oscillation.frequency_error / oscillation.frequency
    if uncertainty > FREE_UNCERTAINTY:
        raise ValueError(
            f"leaves the frequency known to {uncertainty:.0e} only, {FREE_UNCERTAINTY:.0e} are "
            "needed: take out all damping, and start in the first mode"
        )
    return Row(
        case=case.name, elements=elements, speed=speed, values=(oscillation.frequency,),
        rounding=(oscillation.frequency_error,),
    )  # fmt: skip


def mending(linear: Convergence | None) -> tuple[float, float]:
    """Return the error of a code's own ω_n and its uncertainty; nothing where it is not known."""
    if linear is None or not linear.bar < abs(linear.limit):
        return 0.0, 0.0
    return linear.limit, linear.bar


def judged_apart(runs: Sequence[Run], truth: Reference) -> tuple[list[Run], list[str]]:
    """Return the runs that are judged, and why the others are not, each reason once.

    Others failed, are the reference itself, or the same as a coarser run to the last digit: a
    script that ignores the mesh has run one only.
    """
    kept: list[Run] = []
    others: dict[str, list[str]] = {}
    for run in sorted(runs, key=lambda run: run.fineness):
        reason = _reason(run, kept, truth)
        if reason:
            others.setdefault(reason, []).append(_name(run))
        else:
            kept.append(run)
    return kept, [f"{reason}: {', '.join(names)}" for reason, names in others.items()]


def _reason(run: Run, kept: Sequence[Run], truth: Reference) -> str:
    """Return why a run is not judged with those kept; nothing of one that is."""
    if run.failure:
        return f"failed, {run.failure}"
    if any(one.fineness == run.fineness for one in kept):
        return "handed in twice"
    true = truth.history(run.time)
    off = float(np.max(np.abs(run.q - true).max(axis=0) / np.abs(true).max(axis=0)))
    if off < COPY:
        return f"the reference itself, to {off:.0e}: hand in what the code computed"
    same = [one for one in kept if np.array_equal(one.q, run.q)]
    if same:
        return f"the history of {_name(same[0])} to the last digit, mesh or step ignored"
    return ""


def _name(run: Run) -> str:
    return f"{run.elements} elements at {run.step_in_words}"
