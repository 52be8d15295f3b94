"""Options that several commands share."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, cast, get_args

from cyclopts import Parameter, Token

import analytic
from analytic import AnyBlade, Beam

from ..fem.frame import Frame
from ..files.beam_file import RunFile, load_run_file
from .job import telling_what_is_kept
from .motion import Motion
from .output import choice, counter, new_console

if TYPE_CHECKING:
    from ..fem.case import Case


def whole(_: Any, tokens: Sequence[Token]) -> int:
    """Read a whole number in decimal digits: 2.5 is none, and neither are 1e3 and 0x10."""
    text = tokens[0].value
    if not re.fullmatch(r"[+-]?[0-9]+", text):
        raise ValueError(f"it must be a whole number in decimal digits, got {text!r}")
    if len(text) > 300:
        raise ValueError(f"it must be a number, got {len(text)} digits")
    return int(text)


Whole = Annotated[int, Parameter(converter=whole)]
"""A whole number."""

Jobs = Annotated[int | None, Parameter(converter=whole)]
"""A number of processes, or as many as there are cores."""


Flag = Annotated[bool, Parameter(negative=(), show_default=False)]
"""A switch, off unless it is given."""

Force = Annotated[bool, Parameter(negative=(), show_default=False)]
"""Replace files even if they hold what other inputs gave."""

Amplitudes = Annotated[
    list[float],
    Parameter(consume_multiple=True, show_default=lambda given: " ".join(f"{a:g}" for a in given)),
]
"""One or several, shown as they are typed."""

NoFigure = Annotated[
    bool,
    Parameter(
        name="--no-figure", negative=(), show_default=False, help="Write no figure, data only."
    ),
]
"""A switch of the commands that write a figure beside their data."""


def configured(config: Path | None) -> RunFile:
    """Return a run from a TOML file; without one, the paper's beam and nothing else."""
    return RunFile(beam=Beam.reference()) if config is None else load_run_file(config)


def omega_of(file: RunFile, omega: float | None) -> float:
    """Return the speed [rad/s] given, or that of the file's [motion]; refuse to guess one."""
    known = file.motion.get("omega") if omega is None else omega
    if known is None:
        raise ValueError(
            "give the rotation speed in rad/s with --omega, or as omega in [motion] of --config"
        )
    return known


def spelled_as(known: Callable[[], Iterable[str]]) -> Callable[[Any, Sequence[Token]], str]:
    """Return a converter to the known name that differs in upper and lower case only, if any.

    The names are asked for when the option is given, for --help needs no more than its own.
    """
    return lambda _, tokens: _spelled(tokens[0].value, known())


def _spelled(text: str, known: Iterable[str]) -> str:
    return {name.lower(): name for name in known}.get(text.lower(), text)


def element_names() -> tuple[str, ...]:
    """Return the names of the formulations."""
    from ..fem.elements import ALIASES, FORMULATIONS

    return *FORMULATIONS, *ALIASES


Element = Annotated[str, Parameter(converter=spelled_as(element_names))]
"""Name of a formulation; what is none is refused by `formulation`."""

VariantName = Annotated[str, Parameter(converter=spelled_as(lambda: analytic.VARIANTS))]
"""Name of a variant; what is none is refused by `reduced_model`."""


@dataclass(frozen=True, kw_only=True)
class Numerics:
    """How a run is computed; step and duration may be left to `chosen_motion`."""

    element: str = "cable"
    option: Mapping[str, object] = field(default_factory=dict)
    elements: int = 16
    step: float | None = None
    duration: float | None = None
    frame: Frame = "inertial"

    @property
    def name(self) -> str:
        """Formulation, options and mesh as part of a file's name."""
        options = [f"{name}-{value}" for name, value in self.option.items()]
        return "-".join([self.element, *options, str(self.elements)])

    @property
    def title(self) -> str:
        """Formulation and options for a reader."""
        return ", ".join([self.element, *(f"{k}={v}" for k, v in self.option.items())])

    def case(self, beam: AnyBlade, motion: Motion) -> Case:
        """Return the case of a motion, whose step and duration are chosen."""
        from ..fem.case import Case
        from ..fem.elements import formulation

        return Case(
            beam=beam,
            spin_up=motion.spin_up,
            element=formulation(self.element, self.option),
            elements=self.elements,
            duration=motion.duration,
            step=motion.step,
            frame=self.frame,
        )


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class Discretization:
    """How a run is computed, as far as it is given.

    Parameters
    ----------
    element
        Beam formulation: cable (unless given), exact or reissner, ancf3, linear, substructures.
    option
        Option of the formulation as name=value; may be given again for another.
    elements
        Number of elements, 16 unless given.
    step
        Step size of the integrator [s].
    duration
        End of the run [s].
    frame
        Coordinates of the model, inertial unless given.
    """

    element: Element | None = None
    option: list[str] | None = None
    elements: Whole | None = None
    step: float | None = None
    duration: float | None = None
    frame: Annotated[Frame | None, Parameter(converter=choice)] = None

    def over(self, numerics: Mapping[str, Any]) -> Numerics:
        """Return what is given here, over what is given in a file, over the paper's."""
        mine = {name: value for name, value in vars(self).items() if value is not None}
        mine["option"] = dict(map(_name_and_value, self.option or []))
        chosen = Numerics(**{**numerics, **mine})
        return replace(
            chosen,
            element=_spelled(chosen.element, element_names()),
            frame=cast(Frame, _spelled(chosen.frame, get_args(Frame))),
        )


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class Results:
    """Where results go.

    Parameters
    ----------
    out
        Folder for the results.
    force
        Replace a result of other inputs that has the same name.
    """

    out: Annotated[Path, Parameter(alias="-o")] = Path("results")
    force: Force = False


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class Workers:
    """Who does the work.

    Parameters
    ----------
    jobs
        Processes at a time; by default the cores.
    cache
        Folder with one file per finished spin-up, from which a stopped command goes on.
    """

    jobs: Jobs = None
    cache: Path | None = Path("results/cache")

    @contextmanager
    def counted(self, title: str) -> Iterator[Callable[[int, int], None]]:
        """Give what counts the pieces done; Ctrl-C says where finished spin-ups are."""
        kept = f"finished spin-ups are kept in the cache {self.cache}" if self.cache else ""
        with telling_what_is_kept(lambda: kept), counter(new_console(), title) as progress:
            yield progress


DISCRETIZATION, RESULTS, WORKERS = Discretization(), Results(), Workers()
"""Nothing given."""


def _name_and_value(text: str) -> tuple[str, object]:
    """Split name=value; what reads as a number is one."""
    name, equals, value = text.partition("=")
    if not (name and equals and value):
        raise ValueError(f"an option is given as name=value, got {text!r}")
    for number in (int, float):
        try:
            return name, number(value)
        except ValueError:
            continue
    return name, value
