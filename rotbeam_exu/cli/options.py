"""Options that several commands share."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

from cyclopts import Parameter, Token

from analytic import AnyBlade

from ..fem.case import Case
from ..fem.elements import formulation
from ..fem.solver import Frame
from .motion import Motion
from .targets import Force


def _whole(_: Any, tokens: Sequence[Token]) -> int:
    """Read a whole number in decimal digits: 2.5 is none, and neither are 1e3 and 0x10."""
    text = tokens[0].value
    if not re.fullmatch(r"[+-]?[0-9]+", text):
        raise ValueError(f"it must be a whole number in decimal digits, got {text!r}")
    if len(text) > 300:
        raise ValueError(f"it must be a number, got {len(text)} digits")
    return int(text)


Whole = Annotated[int, Parameter(converter=_whole)]
"""A whole number."""

Jobs = Annotated[int | None, Parameter(converter=_whole)]
"""A number of processes, or as many as there are cores."""


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class Discretization:
    """How a run is computed.

    Parameters
    ----------
    element
        Beam formulation.
    option
        Option of the formulation as name=value; may be given again for another.
    elements
        Number of elements.
    step
        Step size of the integrator [s].
    duration
        End of the run [s].
    frame
        Coordinates of the model.
    """

    element: str = "cable"
    option: list[str] | None = None
    elements: Whole = 16
    step: float | None = None
    duration: float | None = None
    frame: Frame = "inertial"

    @property
    def name(self) -> str:
        """Formulation, options and mesh as part of a file's name."""
        options = [text.replace("=", "-") for text in self.option or []]
        return "-".join([self.element, *options, str(self.elements)])

    @property
    def title(self) -> str:
        """Formulation and options for a reader."""
        return ", ".join([self.element, *(self.option or [])])

    def case(self, beam: AnyBlade, motion: Motion) -> Case:
        """Return the case of a motion, whose step and duration are chosen."""
        return Case(
            beam=beam,
            spin_up=motion.spin_up,
            element=formulation(self.element, dict(map(_name_and_value, self.option or []))),
            elements=self.elements,
            duration=motion.duration,
            step=motion.step,
            frame=self.frame,
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
    cache: Path = Path("results/cache")


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
