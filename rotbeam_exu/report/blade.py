"""The report of a blade: what its sections, modes, speed and weight make of it, on one page.

A part that has no answer keeps its place, with the reason.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

import analytic
from analytic import Blade, Damping, Gravity, Theory
from analytic.arrays import FloatArray, evaluated, in_units
from analytic.exact.linear.campbell import Campbell
from analytic.station_section import STIFFNESSES

from ..datasets import dataset_of, root_loads
from ..labels import OMEGA, dataset
from ..lazily import xr
from ..runs.attributes import blade_attributes, theory_attributes
from .document import versions
from .page import rendered

if TYPE_CHECKING:
    pass

_MODES, _SPEEDS, _FASTEST = 6, 7, 1.2  # and up to which part of the speed
_ORDERS, _ANGLES = 6, 73
_WIDTH = 150.0  # of the Campbell diagram [mm]
_RATIO = 0.01  # of mode 1, where a blade has no damping of its own
_G = 9.81
_UNITS = {"E": "N m^2", "G": "N", "m": "kg/m"} | {"EA": "N", "GJ": "N m^2"}
_MEANT = {
    "EA": "axial stiffness", "GA2": "shear stiffness along the chord",
    "GA3": "shear stiffness along the thickness", "GJ": "stiffness in torsion",
    "EI": "bending stiffness in the plane", "EI2": "bending stiffness in flap",
    "EI3": "bending stiffness in lag", "m": "mass per length",
}  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class Part:
    """A part of the page.

    Attributes
    ----------
    title, text : str
        The title is given by `blade_parts`.
    tables : sequence of mappings
        Of columns of text by their heads.
    data : mapping
        Datasets by the name of their CSV.
    draw : callable, optional
        Draws by `rotbeam_exu.figures`, which is handed over.
    failure : str
        Why there is no answer.
    """

    title: str = ""
    text: str = ""
    tables: Sequence[Mapping[str, Sequence[str]]] = ()
    data: Mapping[str, xr.Dataset] = field(default_factory=dict)
    draw: Callable[[Any], Any] | None = None
    failure: str = ""


def blade_page(
    parts: Sequence[Part], title: str, omega: float, theory: Theory, files: Mapping[str, str]
) -> str:
    """Return the page of parts, with the names of their files by those of their data."""
    from .. import figures  # noqa: PLC0415  (matplotlib is slow to import)
    from ..figures.judgement import svg  # noqa: PLC0415

    shown = []
    for part in parts:
        axes = part.draw(figures) if part.draw else ()
        first = axes[0] if isinstance(axes, tuple) and axes else axes
        shown.append(
            {
                "title": part.title, "text": part.text, "tables": part.tables,
                "failure": part.failure, "files": [files[name] for name in part.data],
                "drawing": svg(first) if part.draw else "",
            }
        )  # fmt: skip
    return rendered(
        "blade.html", title=title, parts=shown, theory=theory, versions=versions(), zip=zip,
        speed=f"{omega:g} rad/s, {_rpm(omega)} rpm",
    )  # fmt: skip


def blade_parts(
    blade: Blade, omega: float, theory: Theory, tolerance: float | None
) -> Iterator[Part]:
    """Yield the parts of the report of a blade at ω [rad/s], one after the other."""
    about = {**blade_attributes(blade), **theory_attributes(theory)}
    parts: dict[str, Callable[[], Part]] = {
        "Sections and mass": lambda: _sections(blade),
        "Modes": lambda: _modes(blade, omega, theory, tolerance),
        "Campbell diagram": lambda: _campbell(blade, omega, theory, tolerance),
        "Steady state over the speed": lambda: _steady(blade, omega, theory, tolerance),
        "Root loads over a turn, under the weight": lambda: _turn(blade, omega, theory),
    }
    for title, made in parts.items():
        try:
            part = made()
        except (ValueError, RuntimeError) as error:
            part = Part(failure=str(error))
        data = {kind: one.assign_attrs(about) for kind, one in part.data.items()}
        yield replace(part, title=title, data=data)


def sections_of(blade: Blade) -> xr.Dataset:
    """Return stiffness and mass per length over `x` [m], at the stations of a table."""
    if table := blade.table:
        x = np.array(table.x)
        values = dict(zip(STIFFNESSES, table.stiffnesses.T, strict=True))
        values["m"] = np.array(table.mass_per_length)[:, 1]
    else:
        named = {"EA": "axial_stiffness", "EI": "bending_stiffness", "m": "mass_per_length"}
        profiles, over = blade.section.profiles(), np.linspace(0.0, 1.0, 257)
        x = blade.length * over
        values = {
            name: evaluated(in_units(profiles[long], blade.length, 1.0), over)
            for name, long in named.items()
        }
    return dataset(
        {
            name: ("x", of, f"{_MEANT[name]} [{_UNITS.get(name) or _UNITS[name[0]]}]")
            for name, of in values.items()
        },
        {"x": (x, "distance from the clamp [m]")},
    )


def _sections(blade: Blade) -> Part:
    data = sections_of(blade)
    place, mass = blade.unit.inertia(32)
    whole = blade.mass_per_length * blade.length
    first = float(place @ mass) * whole * blade.length
    from_axis = place * blade.length + blade.hub_radius
    second = float(from_axis**2 @ mass) * whole
    text = (
        f"Length {blade.length:g} m, on a hub of {blade.hub_radius:g} m. Mass {blade.mass:.6g} kg, "
        f"first moment {first:.6g} kg m about the clamp, second moment {second:.6g} kg m² about "
        f"the axis of rotation, center of mass {first / blade.mass:.5g} m from the clamp."
    )
    few = data.isel(x=np.unique(np.linspace(0, data.sizes["x"] - 1, 9).astype(int)))
    table = {"x [m]": _texts(few["x"], ".4g")} | {
        f"{name} [{one.attrs['units']}]": _texts(one, ".4g") for name, one in few.data_vars.items()
    }
    return Part(
        text=text, tables=[table], data={"sections": data},
        draw=lambda figures: figures.blade_sections(data),
    )  # fmt: skip


def _modes(blade: Blade, omega: float, theory: Theory, tolerance: float | None) -> Part:
    rest, turning = (
        analytic.linear_modes(blade, speed, _MODES, theory=theory, tolerance=tolerance)
        for speed in (0.0, omega)
    )
    there = dict(zip(turning.names, turning.frequencies.tolist(), strict=True))
    now = [there.get(name, math.nan) for name in rest.names]
    table = {
        "mode": list(rest.names),
        "at rest [Hz]": _texts(rest.frequencies / (2.0 * np.pi), ".5g"),
        "at rest [rad/s]": _texts(rest.frequencies, ".5g"),
        f"at {omega:g} rad/s [Hz]": _texts(np.array(now) / (2.0 * np.pi), ".5g"),
        "[rad/s]": _texts(now, ".5g"),
        "per turn": _texts(np.array(now) / omega, ".4g"),
    }
    text = f"Known to {max(rest.error, turning.error):.1e} of each frequency. Shapes at the speed."
    return Part(
        text=text, tables=[table], draw=lambda figures: figures.mode_shapes(turning),
        data={"modes-at-rest": dataset_of(rest), "modes": dataset_of(turning)},
    )  # fmt: skip


def _campbell(blade: Blade, omega: float, theory: Theory, tolerance: float | None) -> Part:
    diagram = analytic.campbell(
        blade, _speeds(omega), _MODES, _ORDERS, theory=theory, tolerance=tolerance
    )
    met = diagram.crossings
    table = {
        "mode": [one.mode for one in met],
        "line": [f"{one.order}ω" for one in met],
        "at [rpm]": [_rpm(one.omega) for one in met],
        "[rad/s]": _texts([one.omega for one in met], ".4g"),
        "frequency [Hz]": _texts([one.frequency / (2.0 * np.pi) for one in met], ".4g"),
    }
    text = "Where frequencies cross multiples of the speed." if met else "Nothing crosses a line."
    return Part(
        text=text, tables=[table] if met else [], data={"campbell": dataset_of(diagram)},
        draw=lambda figures: _wide(figures, diagram),
    )  # fmt: skip


def _steady(blade: Blade, omega: float, theory: Theory, tolerance: float | None) -> Part:
    speeds = _speeds(omega)
    states = [
        analytic.steady_state(blade, speed, theory=theory, tolerance=tolerance) for speed in speeds
    ]
    roots = [state.section_loads([0.0]) for state in states]
    moved = np.array([state.tip - states[0].tip for state in states])
    force, moment = (
        np.array([one.section[0] @ getattr(one, kind)[0] for one in roots])
        for kind in ("force", "moment")
    )
    columns = {
        "along": (moved[:, 0], "tip along the clamp, moved from rest [m]"),
        "lag": (moved[:, 1], "tip in the direction of rotation, moved from rest [m]"),
        "flap": (moved[:, 2], "tip normal to both, moved from rest [m]"),
        "tension": (force[:, 0], "tension at the root [N]"),
        "moment_y": (moment[:, 1], "moment out of the plane at the root [N m]"),
        "moment_z": (moment[:, 2], "moment in the plane at the root [N m]"),
    }
    data = dataset(
        {name: ("omega", of, label) for name, (of, label) in columns.items()},
        {"omega": (speeds, OMEGA)},
    )
    table = {"speed [rpm]": list(map(_rpm, speeds)), "[rad/s]": _texts(speeds, ".4g")} | {
        f"{str(name).replace('_', ' ')} [{one.attrs['units']}]": _texts(one, ".4g")
        for name, one in data.data_vars.items()
    }
    error = max(state.error for state in states)
    return Part(
        text=f"Without weight. The tip is known to {error:.1e} of the length.",
        tables=[table], data={"steady": data}, draw=lambda figures: figures.steady_tip(data),
    )  # fmt: skip


def _turn(blade: Blade, omega: float, theory: Theory) -> Part:
    damped, own = blade, bool(blade.damping)
    if not own:
        damped = blade.with_damping(Damping.from_ratio(blade, 1, _RATIO))
    found = analytic.forced_response(damped, [0.99 * omega, omega], Gravity(_G), theory=theory)
    angle = np.linspace(0.0, 2.0 * np.pi, _ANGLES)
    here = int(found.at(omega)[0])
    data = dataset(
        {
            str(name).removeprefix("root_"): ("angle", *of)
            for name, of in root_loads(found.section_loads(here, [0.0], angle)).items()
        },
        {"angle": (np.degrees(angle), "angle of the clamp from the horizontal [°]")},
    )
    table = {
        "at the root": [str(one.attrs["long_name"]) for one in data.data_vars.values()],
        "unit": [one.attrs["units"] for one in data.data_vars.values()],
        "mean": _texts([one[:-1].mean() for one in data.data_vars.values()], ".5g"),
        "least": _texts([one.min() for one in data.data_vars.values()], ".5g"),
        "greatest": _texts([one.max() for one in data.data_vars.values()], ".5g"),
    }
    place, mass = blade.unit.inertia(32)
    rigid = _G * float(place @ mass) * blade.mass_per_length * blade.length**2
    damping = "its own damping" if own else f"a damping ratio of {_RATIO:g} in the first mode"
    text = (
        f"The axis of rotation is level, g = {_G:g} m/s², with {damping}. A rigid blade without "
        f"cone and twist has a moment in the plane that goes between ±{rigid:.5g} N m."
    )
    return Part(
        text=text, tables=[table], data={"turn": data},
        draw=lambda figures: figures.root_over_turn(data),
    )  # fmt: skip


def _wide(figures: Any, diagram: Campbell) -> Any:
    with figures.style(_WIDTH):
        return figures.campbell(diagram)


def _speeds(omega: float) -> FloatArray:
    return np.linspace(0.0, _FASTEST * omega, _SPEEDS)


def _rpm(omega: float) -> str:
    return f"{30.0 * omega / math.pi:.4g}"


def _texts(values: Any, form: str) -> list[str]:
    """Return numbers as text; a dash where there is none."""
    return [f"{value:{form}}" if math.isfinite(value) else "–" for value in np.asarray(values)]
