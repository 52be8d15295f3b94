"""Beam, motion, mesh and loads of a run: given, in the file, or chosen by the beam's own ω_0."""

from __future__ import annotations

import math
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

from cyclopts import Parameter

from analytic import Beam, Blade, SpinUp
from analytic.input_checks import positive
from analytic.loads import Load
from analytic.warning import warn

from ..files.beam_file import RunFile, load_run_file
from ..runs import Frame
from .options import Dampings, Loads, Number, Whole

if TYPE_CHECKING:
    from ..fem.case import RunCase
    from ..fem.elements import Formulation

_OMEGA, _RAMP_TIME, _DURATION, _STEP = 6.0, 3.0, 15.0, 1e-3
"""The paper's choices for its beam [rad/s, s, s, s]; other beams keep their ratios to ω_0."""

_STEPS_PER_RAMP = 30
"""Steps that a chosen step leaves at least in a ramp; `simulate` refuses fewer than 20."""

_STEADY_PERIODS = 5.0
"""Periods 2π/ω_0 that a chosen duration leaves at least after the ramp; two are measured."""


@dataclass(frozen=True, kw_only=True)
class ChosenMotion:
    """A spin-up, its end and the integrator's step [s]."""

    spin_up: SpinUp
    duration: float
    step: float


def chosen_speeds(blade: Blade, *of_paper: float) -> list[float]:
    """Return speeds [rad/s] of the paper's beam, scaled to the same ω/ω_0, to two digits."""
    return [_rounded(omega / slower_than_paper(blade), 2) for omega in of_paper]


def chosen_times(blade: Blade, *of_paper: float, digits: int = 2) -> list[float]:
    """Return times [s] of the paper's beam, scaled to the same ω_0 t, to two digits or more."""
    return [_rounded(time * slower_than_paper(blade), digits) for time in of_paper]


def refuse_rest(*speeds: float) -> None:
    """Refuse a speed [rad/s] of zero, at which nothing will oscillate."""
    if not all(speeds):
        raise ValueError(
            "at omega = 0 rad/s the beam stays at rest and nothing oscillates: take a speed above "
            f"zero, as {_OMEGA:g} rad/s in the paper"
        )


def chosen_motion(
    blade: Blade,
    *,
    omega: float | None = None,
    ramp_time: float | None = None,
    duration: float | None = None,
    step: float | None = None,
) -> ChosenMotion:
    """Return the motion given, completed with the paper's values scaled by ω_0.

    Speeds go with ω_0 and times with 1/ω_0, to two digits. The step is the next of 1, 2, 5 times a
    power of ten below, and at most a thirtieth of the ramp: the duration is a whole number of
    steps. A given duration or step is kept and the other fitted to it; a chosen duration leaves
    five periods after the ramp.
    """
    omega = chosen_speeds(blade, _OMEGA)[0] if omega is None else omega
    ramp_time = chosen_times(blade, _RAMP_TIME)[0] if ramp_time is None else ramp_time
    spin_up = SpinUp(omega=omega, ramp_time=ramp_time)
    step = None if step is None else positive("step", step, "s")
    fine = _one_two_five(min(_STEP * slower_than_paper(blade), spin_up.ramp_time / _STEPS_PER_RAMP))
    if duration is None:
        enough = spin_up.ramp_time + _STEADY_PERIODS * 2.0 * math.pi / blade.omega_0
        duration = chosen_times(blade, _DURATION)[0]
        if duration < enough:
            duration = _rounded(enough, 2, up=True)
        if step is not None:
            duration = _whole_steps(duration, step) * step
    else:
        duration = positive("duration", duration, "s")
    if step is None:
        fitted = duration / _whole_steps(duration, fine)
        # The number as printed, where round-off is all that sets them apart.
        step = fine if math.isclose(fitted, fine, rel_tol=1e-12) else fitted
    return ChosenMotion(spin_up=spin_up, duration=duration, step=step)


def configured(config: Path | None, *uses: str) -> RunFile:
    """Return what a command uses of a TOML file; without one, the paper's beam and nothing else.

    `uses` names tables, as "loads", or keys of a table, as "motion.omega". A table of which the
    command uses nothing is refused; a warning names the other keys of a table that it uses.
    """
    file = RunFile(blade=Beam.reference()) if config is None else load_run_file(config)
    kept: dict[str, Any] = {}
    for name in (one.name for one in fields(file) if one.name not in ("blade", *uses)):
        given = getattr(file, name)
        keys = [use.removeprefix(f"{name}.") for use in uses if use.startswith(f"{name}.")]
        if given and not keys:
            title = f"[{name}]" if isinstance(given, Mapping) else f"[[{name}]]"
            raise ValueError(
                f"{config} has {title}, of which this command uses nothing: leave it out"
            )
        if spare := [key for key in given if key not in keys]:
            warn(f"{config}: this command does not use {', '.join(spare)} of [{name}]")
            kept[name] = {key: given[key] for key in keys if key in given}
    return replace(file, **kept)


def omega_of(file: RunFile, omega: float | None) -> float:
    """Return the speed [rad/s] given, or from the file's [motion]; refuse to guess one."""
    known = file.motion.get("omega") if omega is None else omega
    if known is None:
        raise ValueError(
            "give the rotation speed in rad/s with --omega, or as omega in [motion] of --config"
        )
    return known


def motion_of(file: RunFile, **options: float | None) -> ChosenMotion:
    """Return `chosen_motion` of the options given, then of the file's [motion]."""
    given = {name: value for name, value in options.items() if value is not None}
    return chosen_motion(file.blade, **{**file.motion, **given})


def grid_motion(
    blade: Blade,
    omegas: Sequence[float],
    ramp_times: Sequence[float],
    *,
    duration: float | None = None,
    step: float | None = None,
) -> ChosenMotion:
    """Return duration and step for a whole grid: of the longest ramp and of the shortest."""
    for omega in omegas:
        SpinUp(omega=omega, ramp_time=1.0)
    checked = [positive("ramp_time", time, "s") for time in ramp_times]
    longest, shortest = max(checked, default=None), min(checked, default=None)
    if step is None:
        step = chosen_motion(blade, ramp_time=shortest, duration=duration).step
    return chosen_motion(blade, ramp_time=longest, duration=duration, step=step)


def slower_than_paper(blade: Blade) -> float:
    """Ratio of the paper's natural frequency to the beam's."""
    return Beam.reference().omega_0 / blade.omega_0


def _whole_steps(duration: float, step: float) -> int:
    """Return the number of steps that cover a duration, rounded up but for round-off."""
    return max(1, math.ceil(duration / step * (1.0 - 1e-12)))


def _rounded(value: float, digits: int, *, up: bool = False) -> float:
    unit = digits - 1 - math.floor(math.log10(value))
    if up:
        # Through the decimal text, for a power of ten times a number is not the number printed.
        return float(f"{math.ceil(value * 10.0**unit * (1.0 - 1e-12))}e{-unit}")
    return float(f"{value:.{digits - 1}e}")


def _one_two_five(value: float) -> float:
    """Return the next of 1, 2, 5 times a power of ten that is not above, but for round-off."""
    exponent = math.floor(math.log10(value * (1.0 + 1e-9)))
    first = max(n for n in (1, 2, 5) if n <= value * (1.0 + 1e-9) / 10.0**exponent)
    return float(f"{first}e{exponent}")


def element_of(name: str) -> Formulation:
    """Return the formulation of a name, or of one's own class as module:Class.

    Only for names of the command line, whose user may run any code.
    """
    from ..fem.elements import Formulation, formulation

    module, colon, kind = name.partition(":")
    if not colon:
        return formulation(name)
    if (here := str(Path.cwd())) not in sys.path:
        sys.path.append(here)  # where a sweep's workers find it, too
    try:
        cls = getattr(import_module(module), kind)
        if not (isinstance(cls, type) and issubclass(cls, Formulation)):
            raise TypeError("it is no class that inherits from Formulation")
        return formulation(cls())
    except (AttributeError, ImportError, TypeError) as error:
        raise ValueError(
            f"no element can be made of {name}: {error}; give module:Class, the module in this "
            "folder or installed"
        ) from error


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class Discretization:
    """Discretization and integration of a run, as far as given.

    Parameters
    ----------
    element
        Beam formulation: cable (unless given), exact, ancf3, linear, substructures; in
        space space_cable, space_exact; or one's own, as module:Class.
    elements
        Number of elements, 16 unless given.
    step
        Step size of the integrator [s].
    duration
        End of the run [s].
    frame
        Coordinates of the model, inertial unless given.
    """

    element: str | None = None
    elements: Whole | None = None
    step: Number | None = None
    duration: Number | None = None
    frame: Frame | None = None

    def over(self, numerics: Mapping[str, Any]) -> Self:
        """Return the values given here, over those in a file, over the paper's.

        Step and duration may be left to `chosen_motion`.
        """
        mine = {name: value for name, value in vars(self).items() if value is not None}
        usual = {"element": "cable", "elements": 16, "frame": "inertial"}
        return replace(self, **{**usual, **numerics, **mine})

    @property
    def name(self) -> str:
        """Formulation and mesh as part of a file's name."""
        return f"{self.element}".rpartition(":")[2] + f"-{self.elements}"

    def case(self, blade: Blade, motion: ChosenMotion, loads: Sequence[Load] = ()) -> RunCase:
        """Return the case of a motion, whose step and duration are chosen."""
        from ..fem.case import RunCase

        mesh: dict[str, Any] = {"elements": self.elements, "frame": self.frame}
        return RunCase(
            blade=blade, spin_up=motion.spin_up, duration=motion.duration, step=motion.step,
            element=element_of(f"{self.element}"), loads=loads, **mesh,
        )  # fmt: skip


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class Driving:
    """Loads and damping of a run, in place of those in its file.

    Parameters
    ----------
    load_frequency
        Frequency of the loads given as options [rad/s].
    """

    loads: Loads = field(default_factory=Loads)
    dampings: Dampings = Dampings()
    load_frequency: Number | None = None

    def chosen(self, in_file: Sequence[Load]) -> Sequence[Load]:
        """Return the loads given as options, or else those of the file."""
        loads = self.loads.all(self.load_frequency)
        if self.load_frequency is None and any(one.varied == "frequency" for one in loads):
            raise ValueError("give the frequency of the load in rad/s with --load-frequency")
        return loads or in_file

    def spin_up_case(
        self, file: RunFile, numerics: Discretization, omega: float | None, ramp_time: float | None
    ) -> RunCase:
        """Return the case of a spin-up, by the options given, then by the file."""
        motion = motion_of(
            file, omega=omega, ramp_time=ramp_time, duration=numerics.duration,
            step=numerics.step,
        )  # fmt: skip
        refuse_rest(motion.spin_up.omega)
        blade = self.dampings.on(file.blade)
        return numerics.case(blade, motion, self.chosen(file.loads))
