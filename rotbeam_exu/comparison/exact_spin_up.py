"""The exact spin-up as a Dataset: what a simulation of the same motion is held against."""

from __future__ import annotations

import json

from analytic import SpinUpResponse
from analytic.loads import rippled

from ..lazily import xr
from ..verdict import beam_attributes, loads_attributes, motion_attributes
from ..versions import versions


def exact_spin_up(response: SpinUpResponse) -> xr.Dataset:
    """Return the exact response to a spin-up, named as `simulate` names what it returns.

    Parameters
    ----------
    response : SpinUpResponse
        As `analytic.spin_up_response` returns it.

    Returns
    -------
    Dataset
        Over `time` [s]: q [m] and q_dot [m/s] of the tip (Eq. 16), tip_x and tip_y [m] in the
        inertial frame, angle [rad]. The attributes hold beam, motion, loads, versions, and `error`:
        the estimated error of the tip's position over the largest |q|.
    """
    rotation = rippled(response.spin_up, response.loads)
    columns = {
        "q": (response.q, "m", "tip displacement q, Eq. 16"),
        "q_dot": (response.q_dot, "m/s", "tip velocity q̇, Eq. 16"),
        "tip_x": (response.tip[:, 0], "m", "tip position x, inertial frame"),
        "tip_y": (response.tip[:, 1], "m", "tip position y, inertial frame"),
        "angle": (rotation.angle(response.time), "rad", "rotation angle θ"),
    }
    theory = response.theory
    sections = {"rotary_inertia": int(theory.rotary_inertia), "shear": theory.shear}
    return xr.Dataset(
        {
            name: ("time", values, {"units": unit, "long_name": long_name})
            for name, (values, unit, long_name) in columns.items()
        },
        coords={"time": ("time", response.time, {"units": "s", "long_name": "time t"})},
        attrs={
            **beam_attributes(response.beam),
            "omega": response.spin_up.omega,
            "ramp_time": response.spin_up.ramp_time,
            **motion_attributes(response.spin_up),
            **loads_attributes(response.loads),
            **{name: value for name, value in sections.items() if value},
            "duration": float(response.time[-1]),
            "samples": response.time.size,
            "error": response.error,
            "solution": json.dumps({"steps": response.steps, "functions": response.functions}),
            "versions": json.dumps(versions()),
        },
    )
