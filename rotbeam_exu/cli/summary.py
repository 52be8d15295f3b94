"""What `rotbeam run` prints of a run."""

from __future__ import annotations

from rich.console import Console

from ..fem.case import Case
from ..lazily import xr
from ..runs.check import energy_drift
from ..runs.oscillation import SteadyOscillation
from .assessment import Assessment
from .output import print_line


def print_inputs(console: Console, case: Case, element: str) -> None:
    """Print what is run, before its results."""
    beam = case.beam
    print_line(
        console,
        "beam",
        f"L = {beam.length:g} m, EI = {beam.bending_stiffness:.6g} N m², "
        f"EA = {beam.axial_stiffness:.6g} N, m = {beam.mass:.6g} kg, "
        f"ω_0 = {beam.omega_0:.6g} rad/s",
    )
    print_line(
        console,
        "spin-up",
        f"ω = {case.omega:g} rad/s in T = {case.ramp_time:g} s "
        f"(Ω = {case.omega / beam.omega_0:.4f})",
    )
    print_line(
        console,
        "discretization",
        f"{case.elements} × {element}; {case.frame} frame, "
        f"step {case.step:g} s, {case.duration:g} s",
    )


def print_results(
    console: Console, data: xr.Dataset, steady: SteadyOscillation, found: Assessment
) -> None:
    """Print what was measured, beside the exact beam, and what the checks found."""
    print_line(
        console, "natural frequency", f"ω_n = {found.omega_n:.6f} rad/s (mesh, steady rotation)"
    )
    print_line(
        console,
        "steady amplitude",
        f"{steady.amplitude:.5f} L half peak to peak, first harmonic {steady.first_harmonic:.5f} L",
    )
    print_line(
        console,
        "steady frequency",
        f"ω_NL = {steady.frequency:.6f} rad/s over {steady.cycles} cycles, "
        f"ω_NL/ω_n = {steady.frequency / found.omega_n:.6f}; "
        f"± {steady.frequency_error:.1g} rad/s, the estimator's, without mesh and step",
    )
    for title, text in found.lines():
        print_line(console, title, text)
    worst = max(
        float(abs(data["direction_residual"]).max()),
        float(data["clamp_residual"].max()) / data.attrs["beam_length"],
    )
    print_line(console, "constraint residual", f"{worst:.2g} (worst)")
    drift, ripple = energy_drift(data)
    print_line(
        console,
        "energy drift",
        f"{drift:.2g}, ripple {ripple:.2g} of the largest elastic energy",
    )
    if "out_of_plane" in data.attrs:
        print_line(console, "plane", data.attrs["out_of_plane"])
    print_line(console, "wall time", f"{data.attrs['wall_time']:.2f} s")
    print_line(console, "verdict", f"checks {data.attrs['verdict']}")
