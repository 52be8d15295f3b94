"""What a figure of the paper shows, said from its data: models, speeds, mesh, step and beam."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np
import xarray as xr

from ..paper import MODEL_NAMES, MODELS
from ..runs.attributes import beam_of
from .captions import CAPTIONS

_COEFFICIENTS = "λ_ω of ω_NL = ω_n (1 - λ_ω a²) and λ_x of Eq. 65, a → 0,"
_RATIO = "Ω = ω/ω₀, ω₀ the first frequency at rest"
_EXACT = "black: the geometrically exact beam, by harmonic balance"


def caption(number: int, data: xr.Dataset) -> str:
    """Return a figure's caption: what it shows, of which beam, what the paper says, what is true.

    Parameters
    ----------
    number : int
        3, 4, 5, or 8 to 15.
    data : Dataset
        What is drawn, as made by the function `figure_...` of `rotbeam_exu.comparison`.
    """
    parts = [_DESCRIPTIONS[number](data), _beam(data), CAPTIONS[number]]
    parts.append(str(data.attrs.get("out_of_plane", "")))
    return " ".join(" ".join(parts).split())


def _figure_3(data: xr.Dataset) -> str:
    attrs = data.attrs
    steady = data["q"].where(data["time"] >= attrs["ramp_time"], drop=True)
    size, period = np.ptp(steady.to_numpy(), axis=1) / 2.0, [_period(row) for row in steady]
    last = int(data["elements"][-1])
    off = [
        f"{int(n)} element{'s' if n > 1 else ''}: {100.0 * (a / size[-1] - 1.0):+.1f} and "
        f"{100.0 * (p / period[-1] - 1.0):+.1f} %"
        for n, a, p in zip(data["elements"].to_numpy()[:-1], size, period, strict=False)
    ]
    return (
        f"Tip displacement with {_listed(data['elements'])} elements, brought to "
        f"ω = {attrs['omega']:g} rad/s in T = {attrs['ramp_time']:g} s; shaded: steady rotation; "
        "inset: its last quarter. "
        f"Amplitude and period of the steady oscillation against those of {last} elements: "
        f"{'; '.join(off)}. {_numerics(data)}"
    )


def _figure_4(data: xr.Dataset) -> str:
    smeared = data.isel(case=int(np.argmax(data["smear"].to_numpy())))
    return (
        f"Steady orbits of the tip with {data.attrs['elements']} elements, a) by ramp time, b) by "
        "speed, in one scale; what both have is black. Lines are the first turn, all turns lie "
        "behind it, pale. The normalization is that of Eqs. 17 and 18, m the mass ρAL: "
        "q₀ = mωL⁴/(T(EI + mω²L³)) and, corrected, q̇₀ = q₀√(EI/mL³ + ω²). "
        f"{_numerics(data)} The orbit of ω = {float(smeared['omega']):g} "
        f"rad/s, T = {float(smeared['ramp_time']):g} s is smeared: "
        f"{100.0 * float(smeared['smear']):.1f} % of its velocity is no harmonic of its frequency "
        "but the second mode, which so short a ramp excites too."
    )


def _figure_5(data: xr.Dataset) -> str:
    return (
        f"Frequency against amplitude of the finite element model, {_spin_ups(data)}; a is half "
        "peak to peak of q/L. ω_n is that of the same mesh; bars of step, mesh and estimator are "
        "smaller than the symbols. The curves are 1 - λ_ω a² - κ a⁴, fitted for "
        f"a < {float(data['a'].max()):g}. {_meshes(data)}"
    )


def _figure_8(data: xr.Dataset) -> str:
    return (
        f"Backbones of the model CI ({MODEL_NAMES['CI']}), Eq. 63, at Ω = 0, 1 and → ∞, shaded "
        f"between; {_EXACT}, at Ω = {_listed(data['exact_speed_ratio'])}; {_RATIO}. Left: the "
        "marked strip, as high. The model's a is the first harmonic of q/L, the exact beam's half "
        "peak to peak."
    )


def _figure_9(data: xr.Dataset) -> str:
    return f"{_COEFFICIENTS} against {_RATIO}: the model CI ({MODEL_NAMES['CI']}); {_EXACT}."


def _figure_10(data: xr.Dataset) -> str:
    return (
        f"{_COEFFICIENTS} against ω, inextensible, by the cantilever's mode and by polynomials of "
        f"degree 3, 4 and 5; {_EXACT}."
    )


def _figure_11(data: xr.Dataset) -> str:
    return (
        f"{_COEFFICIENTS} against ω by the model CE ({MODEL_NAMES['CE']}) for several "
        f"slendernesses μ = I/(AL²); {data.attrs['held']}; {_EXACT}, "
        f"of μ = {beam_of(data.attrs).slenderness:.4g}."
    )


def _figure_12(data: xr.Dataset) -> str:
    first = [int(data["degree"][np.isfinite(row.to_numpy())][0]) for row in data["omega_n"]]
    return (
        "Distance of the natural frequency by Frobenius' series from its limit, over the degree N "
        f"of the polynomial, even ones, at ω = {_listed(data['omega'])} rad/s. "
        f"Before N = {_listed(first)} there is no point, for Eq. 86 has no root near the first "
        "frequency; below 1e-13 rad/s there is none, for that is round-off."
    )


def _figure_13(data: xr.Dataset) -> str:
    rise = data["shape"][1:] - data["shape"][0]
    highest = [f"{float(row.max()):.3f}" for row in rise]
    return (
        "First mode shape, 1 at the tip, at rest and by Frobenius' series at "
        f"ω = {_listed(data['omega'][1:])} rad/s. It lies above the cantilever's by up to "
        f"{', '.join(highest[:-1])} and {highest[-1]}, there at η/L = "
        f"{float(data['eta'][np.argmax(rise[-1].to_numpy())]):.2g}."
    )


def _figure_14(data: xr.Dataset) -> str:
    return (
        f"Backbones of {_models(data)} and of the geometrically exact beam, black, with finite "
        f"element points, {_spin_ups(data)}. {_meshes(data)}"
    )


def _figure_15(data: xr.Dataset) -> str:
    attrs = data.attrs
    return (
        f"One period of the tip's orbit at ω = {attrs['omega']:g} rad/s, T = {attrs['ramp_time']:g}"
        f" s: finite elements, {_models(data)} and the exact beam at the same peak |q|/L = "
        f"{attrs['amplitude']:.4f}; dots mark where each ends, and the inset those that end near "
        f"the start. {_numerics(data)}"
    )


_DESCRIPTIONS: dict[int, Callable[[xr.Dataset], str]] = {
    3: _figure_3, 4: _figure_4, 5: _figure_5, 8: _figure_8, 9: _figure_9, 10: _figure_10,
    11: _figure_11, 12: _figure_12, 13: _figure_13, 14: _figure_14, 15: _figure_15,
}  # fmt: skip


def _beam(data: xr.Dataset) -> str:
    if not {"beam_length", "blade"} & set(data.attrs):
        return ""
    beam = beam_of(data.attrs)
    return (
        f"Beam: L = {beam.length:g} m, EI = {beam.bending_stiffness:.5g} N m², "
        f"EA = {beam.axial_stiffness:.4g} N, ρA = {beam.mass_per_length:.5g} kg/m, "
        f"μ = {beam.slenderness:.4g}."
    )


def _numerics(data: xr.Dataset) -> str:
    attrs = data.attrs
    elements = f"{attrs['elements']} " if "elements" in attrs else ""
    return (
        f"Exudyn: {elements}{attrs['element']} elements, step {1e3 * attrs['step']:g} ms, "
        f"{attrs['frame']} frame."
        if "step" in attrs
        else ""
    )


def _models(data: xr.Dataset) -> str:
    """Return the reduced models, spelled out."""
    names = [name for name in data["model"].values.tolist() if name in MODELS]
    return ", ".join(f"{name} ({MODEL_NAMES[name]})" for name in names)


def _spin_ups(data: xr.Dataset) -> str:
    return f"spin-ups to ω = {_listed(data['omega'])} rad/s in T = {_listed(data['ramp_time'])} s"


def _meshes(data: xr.Dataset) -> str:
    return f"Exudyn: {data.attrs['meshes']}." if "meshes" in data.attrs else ""


def _listed(values: Iterable[float]) -> str:
    *most, last = [f"{float(value):g}" for value in values]
    return f"{', '.join(most)} and {last}" if most else last


def _period(q: xr.DataArray) -> float:
    """Return the mean distance of upward zero crossings."""
    time, x = q["time"].to_numpy(), q.to_numpy()
    before = np.flatnonzero((x[:-1] < 0.0) & (x[1:] >= 0.0))
    crossed = time[before] - x[before] * np.diff(time)[before] / np.diff(x)[before]
    return float(np.diff(crossed).mean())
