"""Data of Figures 3 and 4: coarse meshes spun up, and their steady orbits."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from analytic import Beam, SpinUp

from ..fem.simulation import simulate
from ..lazily import xr
from ..runs.attributes import beam_attributes, motion_attributes
from ..runs.oscillation import steady_oscillation


def reference_displacement(beam: Beam, spin_up: SpinUp) -> float:
    """Return q_0 = mωL⁴/(T(EI + mω²L³)) [m], Eq. 17.

    The text asks for the largest acceleration, which is 2ω/T; the print, kept here, has half of
    it. It is only a normalization.
    """
    omega, ramp_time, mass, length = spin_up.omega, spin_up.ramp_time, beam.mass, beam.length
    stiffness = beam.bending_stiffness + mass * omega**2 * length**3
    return mass * omega * length**4 / (ramp_time * stiffness)


def reference_velocity(beam: Beam, spin_up: SpinUp) -> float:
    """Return q̇_0 = q_0 √(EI/(mL³) + ω²) [m/s], Eq. 18.

    Corrected: the print divides, which has not the units of a velocity.
    """
    frequency = math.hypot(beam.frequency_scale, spin_up.omega)
    return reference_displacement(beam, spin_up) * frequency


def figure_3(
    beam: Beam | None = None,
    *,
    element: str = "cable",
    meshes: Sequence[int] = (1, 2, 3),
    spin_up: SpinUp | None = None,
    duration: float = 30.0,
) -> xr.Dataset:
    """Tip displacement with 1, 2 and 3 elements at ω = 4 rad/s, T = 15 s (Fig. 3).

    Returns
    -------
    Dataset
        `q` [m] over (elements, time).
    """
    beam, spin_up = beam or Beam.reference(), spin_up or SpinUp(omega=4.0, ramp_time=15.0)
    runs = [simulate(beam, spin_up, element=element, elements=n, duration=duration) for n in meshes]
    data = xr.concat([run["q"] for run in runs], dim="elements").to_dataset(name="q")
    data["elements"] = ("elements", list(meshes), {"units": "1", "long_name": "elements"})
    data.attrs = {
        **beam_attributes(beam),
        **{name: runs[0].attrs[name] for name in ("omega", "ramp_time")},
        **motion_attributes(spin_up),
        **{name: runs[0].attrs[name] for name in ("element", "element_options", "step", "frame")},
    }
    return data


def figure_4(beam: Beam | None = None, *, element: str = "cable", elements: int = 3) -> xr.Dataset:
    """Steady orbits in the normalization of Eqs. 15, 17 and 18, three elements (Fig. 4).

    Returns
    -------
    Dataset
        `q_bar` and `q_dot_bar` [-] over (case, sample): first ω = 4 rad/s with T = 1.5, 2 and
        3 s (a), then T = 3 s with ω = 4, 6 and 8 rad/s (b). `sample` counts from the end of the
        ramp, and what a shorter steady phase lacks is NaN. `smear` over case: the largest velocity
        that no harmonic of the orbit's frequency explains over the largest, what other modes do.
    """
    beam = beam or Beam.reference()
    panels = ["a", "a", "a", "b", "b", "b"]
    cases = [(4.0, 1.5), (4.0, 2.0), (4.0, 3.0), (4.0, 3.0), (6.0, 3.0), (8.0, 3.0)]
    orbits = []
    for omega, ramp_time in cases:
        spin_up = SpinUp(omega=omega, ramp_time=ramp_time)
        run = simulate(beam, spin_up, element=element, elements=elements)
        steady = run[["q", "q_dot"]].where(run["time"] >= ramp_time, drop=True)
        orbits.append(
            xr.Dataset(
                {
                    "q_bar": ("sample", steady["q"].data / reference_displacement(beam, spin_up)),
                    "q_dot_bar": (
                        "sample",
                        steady["q_dot"].data / reference_velocity(beam, spin_up),
                    ),
                    "smear": _unexplained(steady["q_dot"], steady_oscillation(run).frequency),
                },
                coords={"sample": np.arange(steady.sizes["time"])},
            )
        )
    data = xr.concat(orbits, dim="case", join="outer")
    data["q_bar"].attrs = {"units": "1", "long_name": "tip displacement q/q₀"}
    data["q_dot_bar"].attrs = {"units": "1", "long_name": "tip velocity q̇/q̇₀"}
    data["smear"].attrs = {"units": "1", "long_name": "share of other modes in the velocity"}
    data["panel"] = ("case", panels, {"units": "1", "long_name": "panel"})
    for index, (name, long_name, unit) in enumerate(
        (("omega", "angular velocity ω", "rad/s"), ("ramp_time", "ramp time T", "s"))
    ):
        values = [case[index] for case in cases]
        data[name] = ("case", values, {"units": unit, "long_name": long_name})
    data.attrs = {
        **beam_attributes(beam),
        **{
            name: run.attrs[name]
            for name in ("element", "element_options", "elements", "step", "frame")
        },
    }
    return data


def _unexplained(rate: xr.DataArray, frequency: float) -> float:
    """Return what twelve harmonics leave of a velocity, over its largest value."""
    psi = frequency * rate["time"].to_numpy()[:, None] * np.arange(1, 13)
    harmonics = np.hstack([np.ones((psi.shape[0], 1)), np.cos(psi), np.sin(psi)])
    velocity = rate.to_numpy()
    left = velocity - harmonics @ np.linalg.lstsq(harmonics, velocity)[0]
    return float(np.abs(left).max() / np.abs(velocity).max())
