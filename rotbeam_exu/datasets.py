"""Results as labeled data: `dataset_of` makes the Dataset that is saved, printed and drawn.

A kind of result is a line of `result_columns`, or a function here: it names the result's numbers,
their dims and their labels.
"""

from __future__ import annotations

import json
from dataclasses import asdict
from functools import partial, singledispatch
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from analytic import AmplitudeNotReachedError, Blade
from analytic.arrays import FloatArray
from analytic.exact.continuum.state import SectionLoads
from analytic.exact.driven.forced_orbits import ForcedResponse
from analytic.exact.driven.response import SpinUpResponse
from analytic.exact.free.orbits import Orbits
from analytic.exact.linear.state_space import OUTPUTS, StateSpace
from analytic.input_checks import shown
from analytic.loads import Load, rippled
from analytic.reduced.linear_frame import LinearResponse

from .files.result_tables import frame, parts
from .labels import GROWTH, dataset
from .lazily import xr
from .result_columns import COLUMNS, SWINGS, of_columns
from .runs.attributes import (
    blade_attributes,
    loads_attributes,
    motion_attributes,
    start_attributes,
    theory_attributes,
    versions,
)
from .runs.shape import shape_of

_APART = "only what belongs together makes one Dataset, so call dataset_of for each"
_FORCES = {"x": "tension", "y": "shear force", "z": "shear force out of the plane"}
_MOMENTS = {"x": "torque", "y": "bending moment out of the plane", "z": "bending moment"}


def dataset_of(*results: object) -> xr.Dataset:
    """Return results as one Dataset, each variable with its unit and its long name.

    Parameters
    ----------
    *results
        Of any function of `analytic` that returns more than an array, or of this package; several
        that belong together, as a GrowthOutOfPlane and its StabilityLimit. A spin-up has its root
        loads, the names of a run by `simulate`, and of points asked for what
        `rotbeam_exu.runs.shape.shape_of` has; a forced response its stability and backbone.

    Returns
    -------
    Dataset
        The attributes hold beam, motion or load, and how well the numbers are known.

    Raises
    ------
    TypeError
        If a result is of another kind.
    ValueError
        If two results have a variable, a coordinate or an attribute of one name and other values.

    Warns
    -----
    RotbeamWarning
        If an internal resonance is near the backbone of a response.

    Examples
    --------
    >>> from analytic import Beam, SpinUp, spin_up_response
    >>> from rotbeam_exu import dataset_of
    >>> spin_up = SpinUp(omega=4.0, ramp_time=3.0)
    >>> data = dataset_of(spin_up_response(Beam.reference(), spin_up, [0.0, 1.5, 3.0]))
    >>> print(*data[["q", "tip_x", "tip_y", "root_force_x", "root_force_y", "root_moment_z"]])
    q tip_x tip_y root_force_x root_force_y root_moment_z
    >>> print(data.root_moment_z.long_name, data.root_moment_z.units)
    bending moment at the root N m
    """
    first, *more = map(_described, results)
    for other in more:
        _require_together(first, other)
        first = first.assign(other).assign_attrs(other.attrs)
    return first


def _require_together(first: xr.Dataset, other: xr.Dataset) -> None:
    """Refuse results that have something of one name and other values."""
    for name in (name for name in first.attrs if name in other.attrs):
        one, two = first.attrs[name], other.attrs[name]
        if not (np.array_equal(one, two) or str(one) == str(two)):  # nan is as nan
            raise ValueError(
                f"two results differ in {name}, {shown(one)} and {shown(two)}: {_APART}"
            )
    for name in (name for name in first.variables if name in other.variables):
        if not first[name].identical(other[name]):
            raise ValueError(f"two results differ in their numbers of {name}: {_APART}")


def frames_of(*results: object) -> dict[str, Any]:
    """Return results as tidy DataFrames of pandas, one for each set of dims, by its first column.

    Dims are columns, named next to the numbers; `DataFrame.attrs` has units. What has no dims is
    one row.

    Examples
    --------
    >>> from analytic import Beam, linear_modes
    >>> from rotbeam_exu.datasets import frames_of
    >>> modes = frames_of(linear_modes(Beam.reference(), omega=6.0, count=2))["frequency"]
    >>> print(modes[["mode", "frequency", "lag_share"]].round(4))
        mode  frequency  lag_share
    0  lag 1     3.7304        1.0
    1  lag 2    23.0101        1.0
    """
    frames = {}
    for name, part in parts(dataset_of(*results)).items():
        frames[name] = frame(part)
        frames[name].attrs = {str(k): one.attrs.get("units", "1") for k, one in part.items()}
    return frames


@singledispatch
def _described(result: object) -> xr.Dataset:
    if isinstance(result, xr.Dataset):
        return result
    raise TypeError(f"no Dataset is known of a {type(result).__name__}")


for _kind, _columns in COLUMNS.items():
    _described.register(_kind, partial(of_columns, *_columns))
_described.register(SectionLoads, shape_of)


@_described.register
def _(response: SpinUpResponse) -> xr.Dataset:
    """Over `time`, with the names of `simulate`; Eq. 16."""
    tip_x, tip_y, _ = response.from_axis.T
    tip = {
        "tip_x": (tip_x, "tip position x, inertial frame [m]"),
        "tip_y": (tip_y, "tip position y, inertial frame [m]"),
        "along": (response.tip[:, 0], "tip position along the clamp, turning frame [m]"),
        "flap": (response.flap, "tip position normal to clamp and lag, turning frame [m]"),
        "twist": (response.twist, "twist of the tip's section about its normal [rad]"),
    }
    motion = rippled(response.spin_up, response.loads)
    columns = {
        "q": (response.q, "tip displacement q, Eq. 16 [m]"),
        "q_dot": (response.q_dot, "tip velocity q̇, Eq. 16 [m/s]"),
        **tip,
        "angle": (motion.angle(response.time), "rotation angle θ [rad]"),
        **root_loads(response.section_loads([0.0])),
    }
    data = dataset(
        {name: ("time", *column) for name, column in columns.items()},
        {"time": (response.time, "time t [s]")},
        {
            **_inputs(response),
            **loads_attributes(response.loads),
            **start_attributes(response.start),
            **theory_attributes(response.theory),
            "duration": float(response.time[-1]),
            "samples": response.time.size,
            "error": response.error,
            "solution": json.dumps({"steps": response.steps, "functions": response.functions}),
            "versions": json.dumps(versions()),
        },
    )
    along = response.points
    return data.merge(shape_of(response.section_loads(along))) if along.size else data


@_described.register
def _(made: StateSpace) -> xr.Dataset:
    """Return A and B over `state`, C and D over `station` and `output`, by states and inputs."""
    states = np.arange(1, len(made.A) + 1)
    units = "m, rad, N, N m"
    return dataset(
        {
            "A": (("state", "by"), made.A, "rates of the states by states [1/s]"),
            "B": (("state", "input"), made.B, "rates of the states by inputs [1/s]"),
            "C": (("station", "output", "by"), made.C, f"outputs by states [{units}]"),
            "D": (("station", "output", "input"), made.D, f"outputs by inputs [{units}]"),
        },
        {
            "state": states,
            "by": states,
            "input": np.arange(1, len(made.inputs) + 1),
            "station": (made.x, "distance from the clamp [m]"),
            "output": list(OUTPUTS),
        },
        {
            **blade_attributes(made.blade),
            **theory_attributes(made.theory),
            **loads_attributes(made.loads),
            "inputs": loads_attributes(made.inputs)["loads"],
            "omega": made.omega,
            "error": made.error,
        },
    )


@_described.register
def _(response: LinearResponse) -> xr.Dataset:
    """Over `time`, and `place` over `station` of points asked for."""
    angle = response.spin_up.angle(response.time)
    return dataset(
        {
            "q": ("time", response.q, "tip displacement q, Eq. 16 [m]"),
            "angle": ("time", angle, "rotation angle θ [rad]"),
            "place": (
                ("time", "station", "direction"),
                response.axis,
                "place in the clamp's frame [m]",
            ),
        },
        {
            "time": (response.time, "time t [s]"),
            "station": (response.points, "distance from the clamp [m]"),
            "direction": ["x", "y", "z"],
        },
        {**_inputs(response), "foreshortening": int(response.foreshortening)},
    )


def _inputs(response: SpinUpResponse | LinearResponse) -> dict[str, object]:
    """Return beam and motion as attributes."""
    motion = response.spin_up
    return {
        **blade_attributes(response.blade),
        "omega": motion.omega,
        "ramp_time": motion.ramp_time,
        **motion_attributes(motion),
    }


def root_loads(root: SectionLoads) -> dict[str, tuple[FloatArray, str]]:
    """Return tension, shear forces and moments of the root's section with their labels.

    By the clamp's axes, as of a run, not by those of its section, which may be set.
    """
    kinds = ("force", "N", _FORCES, root.force), ("moment", "N m", _MOMENTS, root.moment)
    return {
        f"root_{kind}_{axis}": (column, f"{names[axis]} at the root [{unit}]")
        for kind, unit, names, loads in kinds
        for axis, column in zip(
            "xyz", np.einsum("tij,tj->it", root.section[:, 0], loads[:, 0]), strict=True
        )
    }


@_described.register
def _(response: ForcedResponse) -> xr.Dataset:
    """Return `_curve`, the directions of `stable`, and where known what grows out of the plane."""
    data = _curve(response)
    data = data.assign_attrs(stable_covers=response.covers)
    if (grown := response._growth) is None:
        section = response.blade.section
        unknown = section.out_of_plane is None and not section.knows_space
        if response._beyond is None or unknown:
            return data
        return data.assign_attrs(planar=f"Stability is about {response.covers}")
    growth: dict[str, tuple[str, ArrayLike, str]] = {
        "growth_rate": ("point", grown.growth_rate, GROWTH),
        "kind": ("point", list(grown.kind), "how it grows"),
    }
    return data.merge(dataset(growth, {})).assign_attrs(planar=str(grown))


def _curve(response: ForcedResponse) -> xr.Dataset:
    """Return it over the points of the curve in order; q/L = Σ cosine cos kφ + sine sin kφ.

    `mark` is "start", "end", "peak", "dip", "fold" or nothing. The backbone, but under gravity, is
    over its orbits.
    """
    weight = response.load.varied == "speed"
    swept = "rotation speed ω" if weight else "drive frequency ν"
    # The weight across the blade is greatest, and negative, at θ = 0.
    phase = f"lag of the first harmonic of q behind {'cos θ' if weight else 'the load'} [rad]"
    harmonics = ("point", "harmonic")
    variables: dict[str, tuple[str | tuple[str, ...], ArrayLike, str]] = {
        "frequency": ("point", response.frequency, f"{swept} [rad/s]"),
        "amplitude": ("point", response.amplitude, "amplitude |q|/L"),
        "phase": ("point", response.phase, phase),
        "stable": ("point", response.stable, "whether disturbances decay"),
        "mark": ("point", _marks(response), "what is special about the point"),
        "cosine": (harmonics, response.harmonics.real, "q/L over cos kφ"),
        "sine": (harmonics, -response.harmonics.imag, "q/L over sin kφ"),
        **{name: ("point", getattr(response, name), label) for name, label in SWINGS.items()},
    }
    backbone: Orbits | None = None
    if not weight:
        try:
            backbone = response.backbone.orbits(np.linspace(0.0, response.amplitude.max(), 13)[1:])
        except AmplitudeNotReachedError as error:
            backbone = error.part  # what of it is reached
    if backbone is not None:
        free = np.append(backbone.omega_n, backbone.frequency)
        label = "frequency of the free, undamped orbit [rad/s]"
        variables["backbone_frequency"] = ("orbit", free, label)
        peaks = np.append(0.0, backbone.amplitude)
        variables["backbone_amplitude"] = ("orbit", peaks, "amplitude |q|/L")
    inputs = response_inputs(
        response.blade, response.load, None if weight else float(response.omega[0])
    )
    quality = {
        "residual": float(response.residual.max()),
        "error": response.error,
        "versions": json.dumps(versions()),
    }
    return dataset(variables, {}, {**inputs, **theory_attributes(response.theory), **quality})


def response_inputs(blade: Blade, load: Load, omega: float | None) -> dict[str, object]:
    """Return beam, damping, load and, unless it is swept, ω [rad/s] as attributes of a response."""
    return {
        **blade_attributes(blade),
        **{f"damping_{k}": v for k, v in asdict(blade.damping).items() if v is not None},
        **loads_attributes([load]),
        "load": type(load).__name__,
        "load_size": load.size,
        "load_symbol": load.symbol,
        "load_unit": load.unit,
        **({} if omega is None else {"omega": omega}),
    }


def _marks(response: ForcedResponse) -> list[str]:
    marks = [mark if mark in ("fold", "peak") else "" for mark in response.marks]
    for i in np.flatnonzero(np.array(marks) == "peak").tolist():
        marks[i] = "dip" if response.amplitude[i] < response.amplitude[i - 1] else "peak"
    marks[0], marks[-1] = "start", "end"
    return marks
