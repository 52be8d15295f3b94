"""Options that several commands share."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, fields, replace
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, Self

from cyclopts import Parameter, Token

from analytic import AnyBlade
from analytic.description import kinds_of
from analytic.loads import Load
from analytic.section_shapes import SectionShape

from ..runs import Frame
from .job import telling_what_is_kept
from .motion import ChosenMotion
from .output import counter

if TYPE_CHECKING:
    from ..fem.case import RunCase
    from ..fem.elements import Formulation


def whole(_: Any, tokens: Sequence[Token]) -> int:
    """Read a whole number: 2.5 is none, which cyclopts would round."""
    text = tokens[0].value
    try:
        return int(text)
    except ValueError:
        raise ValueError(f"it must be a whole number, got {text!r}") from None


Whole = Annotated[int, Parameter(converter=whole)]
"""A whole number."""

Jobs = Annotated[int | None, Parameter(converter=whole)]
"""A number of processes, or as many as there are cores."""

Flag = Annotated[bool, Parameter(negative=(), show_default=False)]
"""A switch, off unless it is given."""

Amplitudes = Annotated[
    list[float],
    Parameter(consume_multiple=True, show_default=lambda given: " ".join(f"{a:g}" for a in given)),
]
"""One or several, shown as they are typed."""

NoFigure = Annotated[Flag, Parameter(name="--no-figure", help="Write data, but no figure.")]
"""A switch of the commands that write a figure beside their data."""


def numbered(what: str, text: str, known: Sequence[int]) -> Sequence[int]:
    """Return the number in a text, or all that are known."""
    if text.lower() == "all":
        return known
    by_name = {str(number): number for number in known}
    if text in by_name:
        return [by_name[text]]
    raise ValueError(f"there is no {what} {text!r}: it must be {', '.join(by_name)} or all")


def element_of(name: str) -> Formulation:
    """Return the formulation of a name, or of one's own class as module:Class."""
    from ..fem.elements import formulation

    module, colon, kind = name.partition(":")
    if not colon:
        return formulation(name)
    sys.path.insert(0, str(Path.cwd()))  # as of `python -m`; a sweep's workers need it too
    try:
        return formulation(getattr(import_module(module), kind)())
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
    step: float | None = None
    duration: float | None = None
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

    def case(self, beam: AnyBlade, motion: ChosenMotion, loads: Sequence[Load] = ()) -> RunCase:
        """Return the case of a motion, whose step and duration are chosen."""
        from ..fem.case import RunCase

        mesh: dict[str, Any] = {"elements": self.elements, "frame": self.frame}
        return RunCase(
            beam=beam, spin_up=motion.spin_up, duration=motion.duration, step=motion.step,
            element=element_of(f"{self.element}"), loads=loads, **mesh,
        )  # fmt: skip


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class Results:
    """Options on the folder of the results.

    Parameters
    ----------
    out
        Folder for the results.
    force
        Replace a result of other inputs that has the same name.
    """

    out: Annotated[Path, Parameter(alias="-o")] = Path("results")
    force: Flag = False


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class Workers:
    """Options on the workers.

    Parameters
    ----------
    jobs
        Number of processes; by default one per core.
    cache
        Folder with one file per finished spin-up; a stopped command continues from it.
    """

    jobs: Jobs = None
    cache: Path | None = Path("results/cache")

    @contextmanager
    def counted(self, title: str) -> Iterator[Callable[[int, int], None]]:
        """Give what counts the pieces done; Ctrl-C says where finished spin-ups are."""
        kept = f"finished spin-ups are kept in the cache {self.cache}" if self.cache else ""
        with telling_what_is_kept(lambda: kept), counter(title) as progress:
            yield progress


def _shapes() -> dict[str, Any]:
    """Return the kinds of section that are known, by the option's value."""
    return {name.lower(): kind for name, kind in kinds_of(SectionShape).items()}


_Section: Any = Literal[tuple(_shapes())] | None


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class SectionOptions:
    """The section out of the plane.

    Parameters
    ----------
    section
        The section out of the plane; by default that of the file.
    ratio
        Height in the plane over width, of a rectangle or an ellipse whose material and size follow
        the beam's EA, EI and mass; by default from the beam's A and I.
    """

    section: _Section = None
    ratio: float | None = None

    @property
    def name(self) -> str:
        """The shape as part of a file's name."""
        shape = self.section or "given"
        return shape if self.ratio is None else f"{shape}-{self.ratio:g}"

    def of(self, beam: AnyBlade) -> AnyBlade:
        """Return the beam with the section asked for, by default its own."""
        kind = _shapes().get(self.section)
        if self.ratio is None:
            return beam if kind is None else beam.with_shape(kind())
        if kind is None or "ratio" not in (field.name for field in fields(kind)):
            raise ValueError("--ratio is height over width: give it with a --section that has both")
        # With another material than the beam's, of which the blade knows none.
        return beam.blade.with_shape(kind(ratio=self.ratio))

    def required_of(self, beam: AnyBlade) -> AnyBlade:
        """Return the same; refuse a beam whose section out of the plane is unknown."""
        blade = self.of(beam)
        if blade.section.out_of_plane is None:
            raise ValueError(
                "the section out of the plane is unknown: give --section rectangle or "
                "--section tube, or [blade.section.out_of_plane] in --config"
            )
        return blade


DISCRETIZATION, RESULTS = Discretization(), Results()
SECTION, WORKERS = SectionOptions(), Workers()
"""Nothing given."""
