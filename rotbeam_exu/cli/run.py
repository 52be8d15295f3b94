"""`rotbeam run`: the main job, one spin-up."""

from __future__ import annotations

import warnings
from pathlib import Path

import xarray as xr
from rich.console import Console
from rich.progress import Progress

from analytic import Beam
from analytic.input_checks import RotbeamWarning

from ..fem.case import Case
from ..fem.linearization import natural_frequencies
from ..fem.simulation import run_case
from ..files.beam_file import load_beam
from ..files.results import save, writable_folder
from ..oscillation import SteadyOscillation, steady_oscillation
from ..verdict import SimulationError, energy_drift
from .assessment import Assessment, assess
from .motion import chosen_motion, refuse_rest
from .options import Discretization, Results
from .output import new_console
from .targets import free_name, listed, refuse_to_replace, telling_what_is_kept

_DISCRETIZATION, _RESULTS = Discretization(), Results()


def run(
    *,
    omega: float | None = None,
    ramp_time: float | None = None,
    discretization: Discretization = _DISCRETIZATION,
    config: Path | None = None,
    results: Results = _RESULTS,
) -> None:
    """Spin a beam up in Exudyn, measure its steady oscillation, write data and figure.

    Parameters
    ----------
    omega
        Steady angular velocity [rad/s].
    ramp_time
        Time from rest to the steady angular velocity, T in Eq. 1 [s].
    config
        TOML file with the beam; without it, the paper's beam.
    """
    beam = Beam.reference() if config is None else load_beam(config)
    motion = chosen_motion(
        beam,
        omega=omega,
        ramp_time=ramp_time,
        duration=discretization.duration,
        step=discretization.step,
    )
    refuse_rest(motion.spin_up.omega)
    case = discretization.case(beam, motion)
    path = writable_folder(results.out) / (
        f"{discretization.name}-omega-{case.omega:g}-ramp-{case.ramp_time:g}"
    )
    refuse_to_replace(case.describe(), *_data_files(path), force=results.force)
    console = new_console()
    if config is not None:
        _line(console, "motion", f"{motion} (where not given, the paper's, scaled by ω_0)")
    written: list[Path] = []
    with telling_what_is_kept(lambda: f"kept: {listed(written)}" if written else ""):
        data, steady = _measured(case, path, written, console)

        from .. import figures  # noqa: PLC0415  (matplotlib is the slowest import)

        written += figures.save_figure(figures.spin_up(data)[0], path)
        omega_n = natural_frequencies(
            beam, case.omega, element=case.element, elements=case.elements, count=1
        )[0]
        assessment = assess(beam, case.omega, float(omega_n), steady)
    _print_inputs(console, case, discretization.title)
    _print_results(console, data, steady, assessment)
    _line(console, "written", listed(written))
    for sentence in assessment.warnings(case.elements, case.step):
        warnings.warn(sentence, RotbeamWarning, stacklevel=2)


def _measured(
    case: Case, path: Path, written: list[Path], console: Console
) -> tuple[xr.Dataset, SteadyOscillation]:
    """Compute, save, then measure: what was computed is safe before anything else is tried."""
    try:
        data = _computed(case, console)
    except SimulationError as error:
        if error.run is None:
            raise
        failed = error.run.assign_attrs(verdict=f"failed: {error}")
        name = free_name(failed, path.parent, f"{path.name}-failed")
        written += [save(failed, file) for file in _data_files(path.with_name(name))]
        raise RuntimeError(
            f"{error}; what was computed is in {written[0]}, marked failed"
        ) from error
    written += [save(data, file) for file in _data_files(path)]
    try:
        return data, steady_oscillation(data)
    except ValueError as error:
        raise RuntimeError(f"{error}; the run itself is in {written[0]}") from error


def _data_files(path: Path) -> tuple[Path, Path]:
    # Appended, not replaced: a name may have a point in it.
    return path.with_name(f"{path.name}.nc"), path.with_name(f"{path.name}.csv")


def _computed(case: Case, console: Console) -> xr.Dataset:
    with Progress(console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task("spinning up", total=1.0)
        return run_case(case, progress=lambda done: bar.update(task, completed=done))


def _line(console: Console, title: str, text: str) -> None:
    console.print(f"{title:<22}{text}")


def _print_inputs(console: Console, case: Case, element: str) -> None:
    beam = case.beam
    _line(
        console,
        "beam",
        f"L = {beam.length:g} m, EI = {beam.bending_stiffness:.6g} N m², "
        f"EA = {beam.axial_stiffness:.6g} N, m = {beam.mass:.6g} kg, "
        f"ω_0 = {beam.omega_0:.6g} rad/s",
    )
    _line(
        console,
        "spin-up",
        f"ω = {case.omega:g} rad/s in T = {case.ramp_time:g} s "
        f"(Ω = {case.omega / beam.omega_0:.4f})",
    )
    _line(
        console,
        "discretization",
        f"{case.elements} × {element}; {case.frame} frame, "
        f"step {case.step:g} s, {case.duration:g} s",
    )


def _print_results(
    console: Console, data: xr.Dataset, steady: SteadyOscillation, found: Assessment
) -> None:
    _line(console, "natural frequency", f"ω_n = {found.omega_n:.6f} rad/s (mesh, steady rotation)")
    _line(
        console,
        "steady amplitude",
        f"{steady.amplitude:.5f} L half peak to peak, first harmonic {steady.first_harmonic:.5f} L",
    )
    _line(
        console,
        "steady frequency",
        f"ω_NL = {steady.frequency:.6f} rad/s over {steady.cycles} cycles, "
        f"ω_NL/ω_n = {steady.frequency / found.omega_n:.6f}; "
        f"± {steady.frequency_error:.1g} rad/s, the estimator's, without mesh and step",
    )
    for title, text in found.lines():
        _line(console, title, text)
    worst = max(
        float(abs(data["direction_residual"]).max()),
        float(data["clamp_residual"].max()) / data.attrs["beam_length"],
    )
    _line(console, "constraint residual", f"{worst:.2g} (worst)")
    drift, ripple = energy_drift(data)
    _line(
        console,
        "energy drift",
        f"{drift:.2g}, ripple {ripple:.2g} of the largest elastic energy",
    )
    _line(console, "wall time", f"{data.attrs['wall_time']:.2f} s")
    if "out_of_plane" in data.attrs:
        _line(console, "plane", data.attrs["out_of_plane"])
    _line(console, "verdict", f"checks {data.attrs['verdict']}")
