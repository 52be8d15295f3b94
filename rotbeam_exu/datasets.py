"""Results as labeled data: `dataset_of` makes the Dataset that is saved, printed and drawn.

A kind of result is a line of `result_columns`, or a function here: it names the result's numbers,
their dims and their labels.
"""

from __future__ import annotations

import json
from functools import partial, singledispatch
from typing import Any

import numpy as np

from analytic.exact.beam.kinematics import set_at
from analytic.exact.beam.state import SectionLoads
from analytic.exact.driven.forced_orbits import ForcedResponse, SpaceForcedResponse
from analytic.exact.driven.response import SpaceResponse, SpinUpResponse
from analytic.exact.linear.campbell import Campbell
from analytic.exact.plane.planarity import PlanarStability
from analytic.exact.plane.stability_limit import StabilityLimit
from analytic.loads import rippled
from analytic.reduced.linear_frame import LinearResponse

from .files.results import parts
from .forced_columns import of_forced, of_forced_in_space
from .lazily import xr
from .result_columns import COLUMNS, GROWTH, OMEGA, ORBIT, dataset, of_columns
from .runs.attributes import beam_attributes, loads_attributes, motion_attributes
from .runs.shape import shape_of
from .runs.versions import versions

_FORCES = {"x": "tension", "y": "shear force", "z": "shear force out of the plane"}
_MOMENTS = {"x": "torque", "y": "bending moment out of the plane", "z": "bending moment"}


def dataset_of(*results: Any) -> xr.Dataset:
    """Return results as one Dataset, each variable with its unit and its long name.

    Parameters
    ----------
    *results
        Of any function of `analytic` that returns more than an array, or of this package; several
        that belong together, as a PlanarStability and its StabilityLimit. A spin-up has its root
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
    >>> print(*data)
    q q_dot tip_x tip_y angle root_force_x root_force_y root_moment_z
    >>> print(data.root_moment_z.long_name, data.root_moment_z.units)
    bending moment at the root N m
    """
    first, *more = map(_described, results)
    for other in more:
        first = first.assign(other).assign_attrs(other.attrs)
    return first


def frames_of(*results: Any) -> dict[str, Any]:
    """Return results as tidy DataFrames of pandas, one for each set of dims, by its first column.

    Dims are columns, named beside the numbers; `DataFrame.attrs` has units. What has no dims is one
    row.

    Examples
    --------
    >>> from analytic import Beam, linear_modes
    >>> from rotbeam_exu.datasets import frames_of
    >>> print(frames_of(linear_modes(Beam.reference(), omega=6.0, count=2))["frequency"].round(4))
       mode  frequency
    0     1     3.7304
    1     2    23.0101
    """
    frames = {}
    for name, part in parts(dataset_of(*results)).items():
        rows = part if part.dims else part.expand_dims("row")
        frames[name] = rows.to_dataframe().reset_index()
        frames[name].attrs = {str(k): one.attrs.get("units", "1") for k, one in part.items()}
    return frames


@singledispatch
def _described(result: Any) -> xr.Dataset:
    if isinstance(result, xr.Dataset):
        return result
    raise TypeError(f"no Dataset is known of a {type(result).__name__}")


for _kind, _columns in COLUMNS.items():
    _described.register(_kind, partial(of_columns, *_columns))
_described.register(ForcedResponse, of_forced)
_described.register(SectionLoads, shape_of)
_described.register(SpaceForcedResponse, of_forced_in_space)


@_described.register
def _(response: SpinUpResponse) -> xr.Dataset:
    """Over `time`, with the names of `simulate`; Eq. 16."""
    return _of_spin_up(
        response,
        {
            "tip_x": (response.tip[:, 0], "tip position x, inertial frame [m]"),
            "tip_y": (response.tip[:, 1], "tip position y, inertial frame [m]"),
        },
    )


@_described.register
def _(response: SpaceResponse) -> xr.Dataset:
    """Over `time`; the tip's places from the clamp, in the frame that turns with it. q is lag."""
    return _of_spin_up(
        response,
        {
            "along": (response.tip[:, 0], "tip position along the clamp, turning frame [m]"),
            "flap": (response.flap, "tip position normal to clamp and lag, turning frame [m]"),
            "twist": (response.twist, "twist of the tip's section about its normal [rad]"),
        },
    )


def _of_spin_up(response: SpinUpResponse, tip: dict[str, tuple[Any, str]]) -> xr.Dataset:
    theory = response.theory
    sections = {"rotary_inertia": int(theory.rotary_inertia), "shear": theory.shear}
    motion = rippled(response.spin_up, response.loads)
    columns = {
        "q": (response.q, "tip displacement q, Eq. 16 [m]"),
        "q_dot": (response.q_dot, "tip velocity q̇, Eq. 16 [m/s]"),
        **tip,
        "angle": (motion.angle(response.time), "rotation angle θ [rad]"),
        **{
            f"root_{name}": (of[:, 0], label)
            for name, (of, label) in _loads(response.section_loads([0.0])).items()
        },
    }
    found = dataset(
        {name: ("time", *column) for name, column in columns.items()},
        {"time": (response.time, "time t [s]")},
        {
            **_inputs(response),
            **loads_attributes(response.loads),
            **{name: value for name, value in sections.items() if value},
            "duration": float(response.time[-1]),
            "samples": response.time.size,
            "error": response.error,
            "solution": json.dumps({"steps": response.steps, "functions": response.functions}),
            "versions": json.dumps(versions()),
        },
    )
    along = response.points
    return found.merge(shape_of(response.section_loads(along))) if along.size else found


@_described.register
def _(response: LinearResponse) -> xr.Dataset:
    """Over `time`, and `place` over `station` of points asked for."""
    place = response.axis @ set_at(response.beam.setting_angle)[:, :2].T
    angle = response.spin_up.angle(response.time)
    return dataset(
        {
            "q": ("time", response.q, "tip displacement q, Eq. 16 [m]"),
            "angle": ("time", angle, "rotation angle θ [rad]"),
            "place": (("time", "station", "direction"), place, "place in the clamp's frame [m]"),
        },
        {
            "time": (response.time, "time t [s]"),
            "station": (response.points, "distance from the clamp [m]"),
            "direction": ["x", "y", "z"],
        },
        {**_inputs(response), "foreshortening": int(response.foreshortening)},
    )


def _inputs(response: SpinUpResponse | LinearResponse) -> dict[str, Any]:
    """Return beam and motion as attributes."""
    motion = response.spin_up
    return {
        **beam_attributes(response.beam),
        "omega": motion.omega,
        "ramp_time": motion.ramp_time,
        **motion_attributes(motion),
    }


@_described.register
def _(found: PlanarStability) -> xr.Dataset:
    """Over the amplitude `a`; multipliers by their real and imaginary parts."""
    both = np.stack((found.multipliers.real, found.multipliers.imag), axis=-1)
    return dataset(
        {
            "growth_rate": ("a", found.growth_rate, GROWTH),
            "kind": ("a", list(found.kind), "how it grows"),
            "modes": ("a", [" and ".join(modes) for modes in found.modes], "what grows"),
            "converged": ("a", found.converged, "converged"),
            "frequency": ("a", found.frequency, "frequency of the planar orbit [rad/s]"),
            "multipliers": (
                ("a", "multiplier", "part"), both, "Floquet multiplier out of the plane"
            ),
        },
        {
            "a": (found.amplitude, ORBIT),
            "part": ["real", "imaginary"],
        },
        {**beam_attributes(found.blade), "omega": found.omega, "mode": found.mode},
    )  # fmt: skip


@_described.register
def _(diagram: Campbell) -> xr.Dataset:
    """Over `omega` and `mode`, and of each crossing its mode, k, speed and frequency."""
    met = diagram.crossings
    names = [diagram.name_of(one) for one in met]
    return dataset(
        {
            "frequency": (("omega", "mode"), diagram.frequencies, "frequency [rad/s]"),
            "crossing_mode": ("crossing", np.array(names, dtype=str), "mode that crosses k ω"),
            "crossing_order": ("crossing", np.array([one.order for one in met], int), "order k"),
            "crossing_omega": ("crossing", np.array([one.omega for one in met], float), OMEGA),
            "crossing_frequency": (
                "crossing", np.array([one.frequency for one in met], float), "frequency [rad/s]"
            ),
        },
        {"omega": (diagram.omegas, OMEGA), "mode": (diagram.names, "mode")},
        beam_attributes(diagram.beam),
    )  # fmt: skip


@_described.register
def _(found: StabilityLimit) -> xr.Dataset:
    """Over `tongue` the tongues below the limit, which is infinite if there is none."""
    tongues = found.tongues
    return dataset(
        {
            "limit": ((), found.amplitude, "amplitude |q|/L above which planar orbits leave"),
            "limit_converged": ((), found.converged, "whether the limit is settled"),
            "tongue_low": ("tongue", [one.low for one in tongues], "amplitude |q|/L, from"),
            "tongue_high": ("tongue", [one.high for one in tongues], "amplitude |q|/L, to"),
            "tongue_growth": ("tongue", [one.growth for one in tongues], "growth exponent [1/rad]"),
        },
        {},
        {**beam_attributes(found.blade), "omega": found.omega, "mode": found.mode}
        | {"sentence": str(found), "growth": found.growth},
    )


def _loads(found: SectionLoads) -> dict[str, tuple[Any, str]]:
    """Return tension, shear forces and moments with their labels, those of the plane or all."""
    force = np.moveaxis(found.force, -1, 0)
    moment = np.moveaxis(found.moment, -1, 0) if len(force) > 2 else found.moment[None]
    axes = "xyz"[-len(moment) :]
    return {
        **{
            f"force_{k}": (f, f"{_FORCES[k]} at the root [N]")
            for k, f in zip("xyz", force, strict=False)
        },
        **{
            f"moment_{k}": (m, f"{_MOMENTS[k]} at the root [N m]")
            for k, m in zip(axes, moment, strict=True)
        },
    }
