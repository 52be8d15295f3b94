"""Options on loads and damping."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import MISSING, dataclass, field, fields, make_dataclass, replace
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from analytic import AnyBlade, Damping
from analytic.description import kinds_of
from analytic.loads import Load

from .motion import motion_of, refuse_rest

if TYPE_CHECKING:
    from ..fem.case import RunCase
    from ..files.beam_file import RunFile
    from .options import Discretization


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
        return name, Annotated[float | None, Parameter(help=f"{about}.")], None
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

    damping_ratio: float | None = None
    external_damping: float | None = None

    def on(self, beam: AnyBlade) -> AnyBlade:
        """Return the blade with this damping."""
        if self.damping_ratio is not None and self.external_damping is not None:
            raise ValueError("give --damping-ratio or --external-damping, not both")
        if self.damping_ratio is not None:
            return beam.with_damping(Damping.from_ratio(beam, 1, self.damping_ratio))
        if self.external_damping is not None:
            return beam.with_damping(Damping(external=self.external_damping))
        return beam

    def required_on(self, beam: AnyBlade) -> AnyBlade:
        """Return the same; refuse an undamped blade, unless a zero is given."""
        blade = self.on(beam)
        if blade is beam and not any(beam.unit.damping):
            raise ValueError(
                "the blade is undamped, and at resonance its response has no end: give "
                "--damping-ratio or --external-damping, 0 for none, or [blade.damping] in --config"
            )
        return blade


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
    load_frequency: float | None = None

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
            file, takes_loads=True, omega=omega, ramp_time=ramp_time, duration=numerics.duration,
            step=numerics.step,
        )  # fmt: skip
        refuse_rest(motion.spin_up.omega)
        beam = self.dampings.on(file.beam)
        return numerics.case(beam, motion, self.chosen(file.loads))
