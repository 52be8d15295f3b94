"""`rotbeam respond`: the forced response of the exact blade, over its frequency."""

from __future__ import annotations

from dataclasses import dataclass, make_dataclass
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from cyclopts import Parameter

import analytic
from analytic import AnyBlade, Damping, Gravity
from analytic.arrays import FloatArray
from analytic.description import kinds_of
from analytic.input_checks import positive, whole_number
from analytic.loads import HarmonicLoad, Load

from ..lazily import xr
from .configuration import configured, omega_of
from .job import Job, UnfinishedError, drawn
from .options import Flag, NoFigure, Results, Whole
from .output import print_columns


def _option(kind: type[Load]) -> str:
    """Return the name of a load without its article, as an option."""
    return kind.called.split(maxsplit=1)[-1].replace(" ", "-")


_HARMONIC = {_option(kind): kind for kind in kinds_of(HarmonicLoad).values()}
_Weight = Annotated[
    bool | float,
    Parameter(
        negative=(), show_default=False, metavar="[FLOAT]",
        help="Weight in a vertical plane of rotation, 9.81 unless given [m/s²].",
    ),
]  # fmt: skip


class _OneLoad:
    """What acts on the blade: one of these."""

    def one(self) -> HarmonicLoad | Gravity:
        """Return the load."""
        asked = {name: getattr(self, name.replace("-", "_")) for name in (*_HARMONIC, "gravity")}
        given: dict[str, HarmonicLoad | Gravity] = {
            f"--{name}": kind(amplitude=asked[name])
            for name, kind in _HARMONIC.items()
            if asked[name] is not None
        }
        if (weight := asked["gravity"]) is not False:
            given["--gravity"] = Gravity() if weight is True else Gravity(weight)
        if len(given) != 1:
            *others, last = [f"--{name}" for name in asked]
            raise ValueError(
                f"give one load, {', '.join(others)} or {last}, got "
                + (" and ".join(given) or "none")
            )
        (load,) = given.values()
        if load.size == 0.0:
            raise ValueError(f"{next(iter(given))} 0 is no load: give its amplitude")
        return load


def _amplitude(kind: type[HarmonicLoad]) -> tuple[str, Any, None]:
    first = (kind.__doc__ or "").partition("\n")[0].removesuffix(".")
    about = Parameter(help=f"{first}; {kind.symbol} [{kind.unit}].")
    return _option(kind).replace("-", "_"), Annotated[float | None, about], None


# An option for each kind of load that is known.
Loads: Any = Parameter(name="*")(
    make_dataclass(
        "Loads",
        [*map(_amplitude, _HARMONIC.values()), ("gravity", _Weight, False)],
        bases=(_OneLoad,), namespace={"__module__": __name__}, frozen=True, kw_only=True,
    )
)  # fmt: skip


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class Dampings:
    """What takes energy from the blade, in place of the damping in its file.

    Parameters
    ----------
    damping_ratio
        Of mode 1 at rest, by damping of the bending.
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
        if not any(beam.unit.damping):
            raise ValueError(
                "the blade is undamped, and at resonance its response has no end: give "
                "--damping-ratio or --external-damping, 0 for none, or [blade.damping] in --config"
            )
        return beam


_LOADS, _DAMPINGS, _RESULTS = Loads(), Dampings(), Results()


def respond(
    *,
    first: Annotated[float, Parameter(name="--from")],
    last: Annotated[float, Parameter(name="--to")],
    omega: float | None = None,
    loads: Loads = _LOADS,
    dampings: Dampings = _DAMPINGS,
    points: Whole = 41,
    inextensible: Flag = False,
    functions: Whole = 10,
    config: Path | None = None,
    no_figure: NoFigure = False,
    results: Results = _RESULTS,
) -> None:
    """Follow a damped, driven blade's response through its folds.

    Of the exact blade; writes netCDF, CSV and a figure.

    Printed are both ends and, in order along the curve, all folds and peaks.

    Parameters
    ----------
    first
        Drive frequency at which the curve begins [rad/s]; under gravity the rotation speed, for it
        goes around once a turn.
    last
        The one at which it ends [rad/s].
    omega
        Rotation speed [rad/s], unless [motion] of the file has it; not under gravity.
    points
        Frequencies, ends included, at which the curve has points wherever it passes them.
    inextensible
        Leave the axial motion out.
    functions
        Functions that resolve the beam along its length, at least.
    config
        TOML file with the beam or blade, and if it likes with [motion]; without it, the paper's
        beam.

    Examples
    --------
    $ rotbeam respond --omega 6 --ripple 0.003 --damping-ratio 0.001 --from 3.6 --to 4
    $ rotbeam respond --gravity --external-damping 0.3 --from 4 --to 6 --points 5
    """
    from ..datasets import dataset_of, response_inputs

    load = loads.one()
    file = configured(config)
    beam = dampings.on(file.beam)
    if isinstance(load, Gravity):
        if omega is not None:
            raise ValueError(
                "under --gravity the rotation speeds are those --from one --to another: leave "
                "--omega out"
            )
    else:
        omega = omega_of(file, omega)
    frequencies = _frequencies(first, last, points)
    inputs = {
        **response_inputs(beam, load, omega),
        "from": first, "to": last, "points": points, "inextensible": int(inextensible),
        "functions": functions,
    }  # fmt: skip

    def computed() -> analytic.ForcedResponse:
        try:
            return _response(
                beam, omega, load, frequencies,
                theory=analytic.Theory(extension=not inextensible), functions=functions,
            )  # fmt: skip
        except analytic.ResponseNotReachedError as error:
            if error.response is None:
                raise
            raise UnfinishedError(error.response, "found") from error

    Job(
        path=results.out / f"{_name(load, omega)}-from-{first:g}-to-{last:g}",
        inputs=inputs,
        force=results.force,
        compute=computed,
        dataset=lambda found: dataset_of(found).assign_attrs(inputs),
        table=lambda data: data.drop_dims(["harmonic", "orbit"], errors="ignore"),
        show=lambda found, data: _print(data, str(found)),
        draw=None if no_figure else drawn(lambda figures, data: figures.forced_response(data)),
    ).run()


def _response(
    beam: AnyBlade,
    omega: float | None,
    load: HarmonicLoad | Gravity,
    frequencies: FloatArray,
    **options: Any,
) -> analytic.ForcedResponse:
    if isinstance(load, Gravity):
        return analytic.forced_response(beam, frequencies, load, **options)
    assert omega is not None
    return analytic.forced_response(beam, omega, load, frequencies, **options)


def _frequencies(first: float, last: float, points: int) -> FloatArray:
    if positive("from", first, "rad/s") >= positive("to", last, "rad/s"):
        raise ValueError(f"--to must be above --from, got {last:g} and {first:g} rad/s")
    if whole_number("points", points) < 2:
        raise ValueError(f"points must be at least 2, got {points}")
    return np.linspace(first, last, points)


def _name(load: HarmonicLoad | Gravity, omega: float | None) -> str:
    turning = "" if omega is None else f"omega-{omega:g}-"
    return f"response-{turning}{_option(type(load))}-{load.size:g}"


def _print(data: xr.Dataset, title: str) -> None:
    marks = data["mark"].to_numpy()
    (shown,) = np.nonzero(marks)
    stable = np.where(data["stable"].to_numpy(), "yes", "no")
    print_columns(
        {
            "": marks[shown].tolist(),
            data["frequency"].attrs["long_name"].split()[-1] + " [rad/s]": [
                f"{nu:.6f}" for nu in data["frequency"].to_numpy()[shown]
            ],
            "|q|/L": [f"{a:.6g}" for a in data["amplitude"].to_numpy()[shown]],
            "lag [rad]": [f"{phase:.4f}" for phase in data["phase"].to_numpy()[shown]],
            # A fold is the limit of both.
            "stable": [
                f"{stable[i - 1]} | {stable[i + 1]}" if marks[i] == "fold" else stable[i]
                for i in shown
            ],
        },
        "table",
        title=title,
    )
