"""Results as labeled data: `dataset_of` makes the Dataset that is saved, printed and drawn.

A kind of result is one function here: it names the result's numbers, their dims and their labels.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict
from functools import singledispatch
from typing import Any

import numpy as np

from analytic import AmplitudeNotReachedError, AnyBlade
from analytic.exact.beam.section_loads import set_at
from analytic.exact.driven.forced_orbits import ForcedResponse, SpaceForcedResponse
from analytic.exact.driven.response import SpinUpResponse
from analytic.exact.free.orbits import Orbits
from analytic.exact.linear.campbell import Campbell
from analytic.exact.plane.planarity import PlanarStability
from analytic.exact.plane.stability_limit import StabilityLimit
from analytic.loads import Load, rippled
from analytic.reduced.linear_frame import LinearResponse

from .lazily import xr
from .runs.attributes import beam_attributes, loads_attributes, motion_attributes
from .runs.shape import shape_of
from .runs.versions import versions

OMEGA = "angular velocity ω [rad/s]"
AMPLITUDE = "peak amplitude a = |q|/L"
ORBIT = "amplitude a = |q|/L of the planar orbit"
GROWTH = "growth rate out of the plane [1/s]"


def labeled(label: str) -> dict[str, str]:
    """Return a label, "angular velocity ω [rad/s]", as the attributes of a variable.

    Without a unit it is 1.
    """
    name, _, unit = label.partition(" [")
    attrs = {"units": unit.removesuffix("]") or "1"}
    return {**attrs, "long_name": name} if name else attrs


def dataset(
    variables: Mapping[str, tuple[Any, Any, str]],
    coords: Mapping[str, Any],
    attrs: Mapping[str, Any] | None = None,
) -> xr.Dataset:
    """Return a Dataset of labeled numbers.

    Parameters
    ----------
    variables : mapping
        Dims, values and label by name.
    coords : mapping
        Values and label by dimension, or values alone.
    attrs : mapping, optional
        All else that is known.
    """
    return xr.Dataset(
        {name: (dims, values, labeled(label)) for name, (dims, values, label) in variables.items()},
        {
            name: (name, found[0], labeled(found[1])) if isinstance(found, tuple) else found
            for name, found in coords.items()
        },
        attrs,
    )


def dataset_of(*results: Any) -> xr.Dataset:
    """Return results as one Dataset, each variable with its unit and its long name.

    Parameters
    ----------
    *results
        A SpinUpResponse, with the names of a run by `simulate`, in the plane its root loads too,
        and what `rotbeam_exu.runs.shape.shape_of` makes of points asked for; a LinearResponse; a
        ForcedResponse, with its stability and its backbone; a PlanarStability, or both it and its
        StabilityLimit, which becomes attributes; a Campbell diagram.

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


@singledispatch
def _described(result: Any) -> xr.Dataset:
    raise TypeError(f"no Dataset is known of a {type(result).__name__}")


@_described.register
def _(response: SpinUpResponse) -> xr.Dataset:
    """Over `time`, with the names of `simulate`; Eq. 16."""
    theory = response.theory
    sections = {"rotary_inertia": int(theory.rotary_inertia), "shear": theory.shear}
    angle = rippled(response.spin_up, response.loads).angle(response.time)
    at_root = {}
    if response.tip.shape[1] == 2:
        root = response.section_loads([0.0])
        at_root = {
            "root_force_x": ("time", root.force[:, 0, 0], "tension at the root [N]"),
            "root_force_y": ("time", root.force[:, 0, 1], "shear force at the root [N]"),
            "root_moment_z": ("time", root.moment[:, 0], "bending moment at the root [N m]"),
        }
    found = dataset(
        {
            "q": ("time", response.q, "tip displacement q, Eq. 16 [m]"),
            "q_dot": ("time", response.q_dot, "tip velocity q̇, Eq. 16 [m/s]"),
            "tip_x": ("time", response.tip[:, 0], "tip position x, inertial frame [m]"),
            "tip_y": ("time", response.tip[:, 1], "tip position y, inertial frame [m]"),
            "angle": ("time", angle, "rotation angle θ [rad]"),
            **at_root,
        },
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
    if not response.points.size:
        return found
    return found.merge(shape_of(response.section_loads(response.points)))


@_described.register
def _(response: LinearResponse) -> xr.Dataset:
    """Over `time`, and `place` over `station` if there are points."""
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
    """Attributes alone: the limit, infinite if there is none, and the tongues below it."""
    tongues = [f"{one.low:.4g} to {one.high:.4g}: {one.growth:.2g}" for one in found.tongues]
    return xr.Dataset(
        attrs={
            "limit": found.amplitude, "limit_converged": int(found.converged),
            "sentence": str(found), "growth": found.growth, "tongues": "; ".join(tongues),
        }
    )  # fmt: skip


@_described.register
def _of_response(response: ForcedResponse) -> xr.Dataset:
    """Over the points of the curve, in order; q/L = Σ cosine cos kφ + sine sin kφ in column k.

    `mark` is "start", "end", "peak", "dip", "fold" or nothing. The backbone, but under gravity, is
    over its orbits.
    """
    weight = response.load.varied == "speed"
    swept = "rotation speed ω" if weight else "drive frequency ν"
    # The weight across the blade is greatest, and negative, at θ = 0.
    phase = f"lag of the first harmonic of q behind {'cos θ' if weight else 'the load'} [rad]"
    harmonics = ("point", "harmonic")
    variables: dict[str, tuple[Any, Any, str]] = {
        "frequency": ("point", response.frequency, f"{swept} [rad/s]"),
        "amplitude": ("point", response.amplitude, "amplitude |q|/L"),
        "phase": ("point", response.phase, phase),
        "stable": ("point", response.stable, "whether disturbances in the plane decay"),
        "mark": ("point", _marks(response), "what is special about the point"),
        "cosine": (harmonics, response.harmonics.real, "q/L over cos kφ"),
        "sine": (harmonics, -response.harmonics.imag, "q/L over sin kφ"),
    }
    backbone: Orbits | None = None
    if not weight:
        try:
            backbone = response.backbone.orbits(np.linspace(0.0, response.amplitude.max(), 13)[1:])
        except AmplitudeNotReachedError as error:
            backbone = error.orbits  # what of it is reached
    if backbone is not None:
        free = np.append(backbone.omega_n, backbone.frequency)
        label = "frequency of the free, undamped orbit [rad/s]"
        variables["backbone_frequency"] = ("orbit", free, label)
        peaks = np.append(0.0, backbone.amplitude)
        variables["backbone_amplitude"] = ("orbit", peaks, "amplitude |q|/L")
    inputs = response_inputs(
        response.beam, response.load, None if weight else float(response.omega[0])
    )
    known = {"residual": float(response.residual.max()), "versions": json.dumps(versions())}
    return dataset(variables, {}, {**inputs, **known})


@_described.register
def _(response: SpaceForcedResponse) -> xr.Dataset:
    """As in the plane; q is the gauge, and `lag`, `flap` and `twist` are the tip's amplitudes."""
    data, half = _of_response(response), "half the way of the tip"
    data["stable"].attrs["long_name"] = "whether disturbances decay"
    return data.merge(
        dataset(
            {
                "lag": ("point", response.lag, f"{half} in lag over L"),
                "flap": ("point", response.flap, f"{half} in flap over L"),
                "twist": ("point", response.twist, "half the swing of the tip's section [rad]"),
            },
            {},
        )
    )


def response_inputs(beam: AnyBlade, load: Load, omega: float | None) -> dict[str, Any]:
    """Return beam, damping, load and, unless it is swept, ω [rad/s] as attributes of a response."""
    return {
        **beam_attributes(beam),
        **{f"damping_{name}": value for name, value in asdict(beam.damping).items()},
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
