"""Options that several commands share: workers, sections, loads and damping."""

from __future__ import annotations

import math
import re
import tomllib
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import MISSING, dataclass, fields, make_dataclass, replace
from pathlib import Path
from typing import Annotated, Any, Literal

from cyclopts import Parameter, Token

from analytic import Blade, Damping, Theory
from analytic.description import kinds_of
from analytic.loads import Load
from analytic.section_shapes import SectionShape

from ..files.beam_file import RunFile
from ..files.beam_tables import THEORY, require_keys
from .job import Flag, telling_what_is_kept
from .output import counter


def whole(_: Any, tokens: Sequence[Token]) -> int:
    """Read a whole number: 2.5 is none, which cyclopts would round."""
    text = tokens[0].value
    try:
        return int(text)
    except ValueError:
        raise ValueError(f"it must be a whole number, got {text!r}") from None


SPEED_UNITS = {"rpm": math.pi / 30.0, "hz": 2.0 * math.pi, "rps": 2.0 * math.pi}
"""Units of speeds that no option takes, in rad/s."""

_WITH_UNIT = re.compile(rf"([-+.\de]*)({'|'.join(SPEED_UNITS)})", re.IGNORECASE)


def number(_: Any, tokens: Sequence[Token]) -> float:
    """Read a number: None is none, for which cyclopts would take the default."""
    text = tokens[0].value
    try:
        return float(text)
    except ValueError:
        unit = _WITH_UNIT.fullmatch(text)
        hint = f"; {in_rad_per_second(unit[2])}" if unit else ""
        raise ValueError(f"it must be a number, got {text!r}{hint}") from None


def numbers(kind: Any, tokens: Sequence[Token]) -> list[float]:
    """Read numbers."""
    return [number(kind, [token]) for token in tokens]


def in_rad_per_second(unit: str) -> str:
    """Return a sentence on the unit of speeds."""
    return f"speeds are in rad/s, as --omega, and 1 {unit} is {SPEED_UNITS[unit.lower()]:.6g} rad/s"


Number = Annotated[float, Parameter(converter=number)]
Numbers = Annotated[list[float] | None, Parameter(converter=numbers, consume_multiple=True)]
Whole = Annotated[int, Parameter(converter=whole)]
Jobs = Annotated[int | None, Parameter(converter=whole)]
Amplitudes = Annotated[
    list[Number],
    Parameter(consume_multiple=True, show_default=lambda given: " ".join(f"{a:g}" for a in given)),
]
Config = Annotated[
    Path | None,
    Parameter(
        help="TOML file with [beam] or [blade], and optionally [motion], [numerics], [theory] and "
        "[[loads]]; options given here replace its values. Without a file: the paper's beam."
    ),
]
Omega = Annotated[
    Number | None,
    Parameter(help="Rotation speed [rad/s]; required unless [motion] of the file has it."),
]
TheoryPairs = Annotated[
    list[str] | None,
    Parameter(
        name="--theory", consume_multiple=True, metavar="KEY=VALUE",
        help="Theory of the exact beam, pairs of extension, shear, engesser, rotary_inertia and "
        "trapeze, as trapeze=false shear=0.3; over [theory] of the file.",
    ),
]  # fmt: skip
SteadySpeed = Annotated[
    Number | None,
    Parameter(
        help="Steady angular velocity [rad/s]; by default the benchmark's, 6 for its beam and "
        "ω/ω_0 = 2.06 for any other."
    ),
]
RampTime = Annotated[
    Number | None,
    Parameter(help="Time from rest to the steady angular velocity, T in Eq. 1 [s]."),
]
NoFigure = Annotated[Flag, Parameter(name="--no-figure", help="Write data, but no figure.")]


def theory_of(file: RunFile, given: Sequence[str] | None) -> Theory:
    """Return the theory of --theory, whose pairs are lines of TOML, over [theory] of the file."""
    pairs = given or ()
    try:
        told = tomllib.loads("\n".join(pairs))
    except tomllib.TOMLDecodeError as error:
        raise ValueError(
            f"--theory takes key=value as in a file, as trapeze=false shear=0.3, got "
            f"{' '.join(pairs)!r}: {error}"
        ) from error
    require_keys(told, THEORY, "--theory")
    return Theory(**{**file.theory, **told})


def numbered(what: str, text: str, known: Sequence[int]) -> Sequence[int]:
    """Return the number in a text, or all that are known."""
    if text.lower() == "all":
        return known
    by_name = {str(number): number for number in known}
    if text in by_name:
        return [by_name[text]]
    raise ValueError(f"there is no {what} {text!r}: it must be {', '.join(by_name)} or all")


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class Workers:
    """Options on the workers.

    Parameters
    ----------
    jobs
        Number of processes; by default one per core.
    cache
        Folder with one file per finished spin-up, and of converge per mesh; a stopped command
        continues from it.
    """

    jobs: Jobs = None
    cache: Path | None = Path("results/cache")

    @contextmanager
    def counted(self, title: str, kind: str = "spin-ups") -> Iterator[dict[str, Any]]:
        """Give the options of what counts its pieces; Ctrl-C says where those of a kind are."""
        kept = f"finished {kind} are kept in the cache {self.cache}" if self.cache else ""
        with telling_what_is_kept(lambda: kept), counter(title) as progress:
            yield {"jobs": self.jobs, "cache": self.cache, "progress": progress}


def _shapes() -> dict[str, Any]:
    """Return the kinds of section that are known by now, by the option's value."""
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
    ratio: Number | None = None

    @property
    def name(self) -> str:
        """The shape as part of a file's name."""
        shape = self.section or "given"
        return shape if self.ratio is None else f"{shape}-{self.ratio:g}"

    def of(self, blade: Blade) -> Blade:
        """Return the beam with the section asked for, by default its own."""
        kind = _shapes().get(self.section)
        if self.ratio is None:
            return blade if kind is None else blade.with_shape(kind())
        if kind is None or "ratio" not in (field.name for field in fields(kind)):
            raise ValueError("--ratio is height over width: give it with a --section that has both")
        # Of another material than a beam's: what is set on a hub is a Blade, whose area is free.
        return blade.with_hub_radius(blade.hub_radius).with_shape(kind(ratio=self.ratio))


def option_of(kind: type[Load]) -> str:
    """Return the name of a load without its article, as an option."""
    return kind.called.split(maxsplit=1)[-1].replace(" ", "-")


def _has_default(kind: Any) -> bool:
    """Return whether the size of a load may be left out."""
    return fields(kind)[0].default is not MISSING


_KINDS = {
    option_of(kind).replace("-", "_"): kind
    for kind in sorted(kinds_of(Load).values(), key=_has_default)
    if kind.varied
}
"""Loads that have a response, by their fields; loads that need no size come last."""


class _Given:
    """Options, the loads' sizes; without one, a load has its default size."""

    def one(self) -> Load:
        """Return the load, where one is given."""
        given = self.all(None)
        if len(given) != 1:
            *others, last = (f"--{option_of(kind)}" for kind in _KINDS.values())
            got = " and ".join(f"--{option_of(type(one))}" for one in given) or "none"
            raise ValueError(f"give one load, {', '.join(others)} or {last}, got {got}")
        return given[0]

    def all(self, frequency: float | None) -> list[Load]:
        """Return the loads, harmonic ones at a frequency [rad/s]."""
        loads = []
        for name, size in vars(self).items():
            if size is None or size is False:
                continue
            kind: Any = _KINDS[name]
            load: Any = kind() if size is True else kind(**{fields(kind)[0].name: size})
            if load.size == 0.0:
                raise ValueError(f"--{option_of(kind)} 0 is no load: give its amplitude")
            harmonic = load.varied == "frequency" and frequency is not None
            loads.append(replace(load, frequency=frequency) if harmonic else load)
        return loads


def _field(name: str, kind: Any) -> tuple[str, Any, bool | None]:
    """Return the option of a kind of load, whose size may be left out if it has a default."""
    about, size = (kind.__doc__ or "").partition("\n")[0].removesuffix("."), fields(kind)[0]
    about += f"; {kind.symbol} [{kind.unit}]"
    if not _has_default(kind):
        return name, Annotated[Number | None, Parameter(help=f"{about}.")], None
    option = Parameter(
        help=f"{about}, {size.default:g} unless given.",
        negative=(), show_default=False, metavar="[FLOAT]",
    )  # fmt: skip
    return name, Annotated[bool | float, option], False


# An option for each kind of load that is known.
Loads: Any = Parameter(name="*")(
    make_dataclass(
        "Loads", [_field(*one) for one in _KINDS.items()],
        bases=(_Given,), namespace={"__module__": __name__}, frozen=True, kw_only=True,
    )
)  # fmt: skip


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class Dampings:
    """Damping of the blade, in place of the damping in its file.

    Parameters
    ----------
    damping_ratio
        Damping ratio of mode 1 at rest, by damping of the bending.
    external_damping
        Force per length against the velocity in the turning frame [kg/(m s)]; point masses have
        none.
    """

    damping_ratio: Number | None = None
    external_damping: Number | None = None

    def on(self, blade: Blade) -> Blade:
        """Return the blade with this damping."""
        if self.damping_ratio is not None and self.external_damping is not None:
            raise ValueError("give --damping-ratio or --external-damping, not both")
        if self.damping_ratio is not None:
            return blade.with_damping(Damping.from_ratio(blade, 1, self.damping_ratio))
        if self.external_damping is not None:
            return blade.with_damping(Damping(external=self.external_damping))
        return blade
