"""Options that several commands share: workers, sections, loads and damping."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import MISSING, dataclass, fields, replace
from pathlib import Path
from typing import Annotated, Any, Literal

from cyclopts import Parameter, Token

from analytic import Blade, Damping
from analytic.description import kinds_of
from analytic.loads import Load
from analytic.section_shapes import SectionShape

from ..runs import Frame
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
NoFigure = Annotated[Flag, Parameter(name="--no-figure", help="Write data, but no figure.")]


def numbered(what: str, text: str, numbers: Sequence[int]) -> Sequence[int]:
    """Return the number in a text, or all that are known."""
    if text.lower() == "all":
        return numbers
    by_name = {str(number): number for number in numbers}
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
        Folder with one file per finished spin-up, mesh of converge or sample; a stopped command
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


def option_of(kind: type[Load]) -> str:
    """Return the name of a load without its article, as an option."""
    return kind.called.split(maxsplit=1)[-1].replace(" ", "-")


def _has_default(kind: Any) -> bool:
    """Return whether the size of a load may be left out."""
    return fields(kind)[0].default is not MISSING


KINDS: dict[str, Any] = {
    option_of(kind).replace("-", "_"): kind
    for kind in sorted(kinds_of(Load).values(), key=_has_default)
    if kind.varied and kind.size is Load.size
}
"""Loads of one number that have a response, by options; those that need no size come last."""


def _shapes() -> dict[str, Any]:
    """Return the kinds of section that are known by now, by the option's value."""
    return {name.lower(): kind for name, kind in kinds_of(SectionShape).items()}


def _option(kind: Any, text: str, **more: Any) -> Any:
    """Return the type of an option that may be left out, and its help."""
    return Annotated[kind | None, Parameter(help=text, **more)]


def _load(kind: Any) -> Any:
    """Return the option of a kind of load, whose size may be left out if it has a default."""
    about, size = (kind.__doc__ or "").partition("\n")[0].removesuffix("."), fields(kind)[0]
    about += f"; {kind.symbol} [{kind.unit}]"
    if not _has_default(kind):
        return _option(Number, f"{about}.")
    text = f"{about}, {size.default:g} unless given."
    more: Any = {"negative": (), "show_default": False, "metavar": "[FLOAT]"}
    return Annotated[bool | float, Parameter(help=text, **more)]  # None is no size


OPTIONS = {
    "omega": _option(
        Number, "Rotation speed [rad/s]; required unless [motion] of the file has it."
    ),
    "speed": _option(
        Number,
        "Steady angular velocity [rad/s]; by default the benchmark's, 6 for its beam and "
        "ω/ω_0 = 2.06 for any other, but 0.5 for a table of stations.",
        name="--omega",
    ),
    "ramp_time": _option(Number, "Time from rest to the steady angular velocity, T in Eq. 1 [s]."),
    "element": _option(
        str,
        "Beam formulation: cable (unless given), exact, ancf3, linear, substructures; in space "
        "space_cable, space_exact (of a table of stations unless given); or one's own, as "
        "module:Class.",
    ),
    "elements": _option(Whole, "Number of elements, 16 unless given."),
    "step": _option(Number, "Step size of the integrator [s]."),
    "duration": _option(Number, "End of the motion [s]."),
    "frame": _option(Frame, "Coordinates of the model, inertial unless given."),
    "tolerance": _option(
        Number,
        "Largest error of the exact blade: of frequencies, relative; of the tip's place over the "
        "largest q. Unless given 1e-9 and 1e-8, and 1e-6 for a table of stations.",
    ),
    "section": _option(
        Literal[tuple(_shapes())], "The section out of the plane; by default that of the file."
    ),
    "ratio": _option(
        Number,
        "Height in the plane over width, of a rectangle or an ellipse whose material and size "
        "follow the beam's EA, EI and mass; by default from the beam's A and I.",
    ),
    **{name: _load(kind) for name, kind in KINDS.items()},
    "load_frequency": _option(Number, "Frequency of the loads given as options [rad/s]."),
    "damping_ratio": _option(
        Number, "Damping ratio of mode 1 at rest, by damping of the bending."
    ),
    "external_damping": _option(
        Number,
        "Force per length against the velocity in the turning frame [kg/(m s)]; point masses have "
        "none.",
    ),
    "theory": _option(
        list[str],
        "Theory of the exact beam, pairs of extension, shear, engesser, rotary_inertia and "
        "trapeze, as trapeze=false shear=0.3; over [theory] of the file.",
        consume_multiple=True, metavar="KEY=VALUE",
    ),
}  # fmt: skip
"""Options over a file or over defaults, in the order of --help."""


def blade_of(blade: Blade, options: Mapping[str, Any]) -> Blade:
    """Return the blade of a file with section and damping of the options."""
    shape, ratio = _shapes().get(options.get("section", "")), options.get("ratio")
    if ratio is not None:
        if shape is None or "ratio" not in (field.name for field in fields(shape)):
            raise ValueError("--ratio is height over width: give it with a --section that has both")
        # Of another material than a beam's: what is set on a hub is a Blade, whose area is free.
        blade = blade.with_hub_radius(blade.hub_radius).with_shape(shape(ratio=ratio))
    elif shape is not None:
        blade = blade.with_shape(shape())
    ratio, external = options.get("damping_ratio"), options.get("external_damping")
    if ratio is not None and external is not None:
        raise ValueError("give --damping-ratio or --external-damping, not both")
    if ratio is not None:
        return blade.with_damping(Damping.from_ratio(blade, 1, ratio))
    return blade if external is None else blade.with_damping(Damping(external=external))


def loads_of(options: Mapping[str, Any]) -> list[Load]:
    """Return the loads of the options; one without a size has its default size."""
    loads: list[Load] = []
    for name in filter(options.__contains__, KINDS):
        kind, size = KINDS[name], options[name]
        load = kind() if size is True else kind(**{fields(kind)[0].name: size})
        if load.size == 0.0:
            raise ValueError(f"--{option_of(kind)} 0 is no load: give its amplitude")
        if load.varied == "frequency" and "load_frequency" in options:
            load = replace(load, frequency=options["load_frequency"])
        loads.append(load)
    return loads


def one_of(loads: Sequence[Load]) -> Load:
    """Return the load, where one is given."""
    if len(loads) != 1:
        *others, last = (f"--{option_of(kind)}" for kind in KINDS.values())
        got = " and ".join(f"--{option_of(type(one))}" for one in loads) or "none"
        raise ValueError(f"give one load, {', '.join(others)} or {last}, got {got}")
    return loads[0]


def deviations_of(option: str, pairs: Sequence[str]) -> dict[str, float]:
    """Return the standard deviations of an option by name, of pairs as EI3=0.05."""
    found: dict[str, float] = {}
    for pair in pairs:
        name, _, value = pair.partition("=")
        if name in found:
            raise ValueError(f"--{option} has {name} twice")
        try:
            found[name] = float(value)
        except ValueError:
            raise ValueError(
                f"--{option} takes name=deviation, as EI3=0.05, got {pair!r}"
            ) from None
    return found
