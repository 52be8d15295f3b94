"""`rotbeam run`: the main job, one spin-up."""

from __future__ import annotations

from pathlib import Path

from rich.console import Console
from rich.progress import Progress

from analytic import Beam, SpinUp

from ..config import load_beam
from ..linearization import natural_frequencies
from ..oscillation import steady_oscillation
from ..simulation import simulate
from ..solver import Frame
from ..storage import save, writable_folder
from ..verdict import energy_drift
from .options import chosen_formulation


def run(
    *,
    omega: float = 6.0,
    ramp_time: float = 3.0,
    elements: int = 16,
    step: float = 1e-3,
    duration: float = 15.0,
    element: str = "cable",
    option: list[str] | None = None,
    frame: Frame = "inertial",
    config: Path | None = None,
    out: Path = Path("results"),
) -> None:
    """Spin a beam up in Exudyn, measure its steady oscillation, write data and figure.

    Parameters
    ----------
    omega
        Steady angular velocity [rad/s].
    ramp_time
        Time from rest to the steady angular velocity, T in Eq. 1 [s].
    elements
        Number of elements.
    step
        Step size of the integrator [s].
    duration
        End of the run [s].
    element
        Beam formulation.
    option
        Option of the formulation as name=value; may be given again for another.
    frame
        Coordinates of the model.
    config
        TOML file with the beam; without it, the paper's beam.
    out
        Folder for the results.
    """
    beam = Beam.reference() if config is None else load_beam(config)
    spin_up = SpinUp(omega=omega, ramp_time=ramp_time)
    model = chosen_formulation(element, option)
    folder = writable_folder(out)
    console = Console(highlight=False, soft_wrap=True)
    with Progress(console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task("spinning up", total=1.0)
        data = simulate(
            beam,
            spin_up,
            element=model,
            elements=elements,
            duration=duration,
            step=step,
            frame=frame,
            progress=lambda done: bar.update(task, completed=done),
        )
    omega_n = natural_frequencies(beam, omega, element=model, elements=elements, count=1)[0]
    steady = steady_oscillation(data)
    label = "-".join([element, *(text.replace("=", "-") for text in option or [])])
    name = f"{label}-{elements}-omega-{omega:g}-ramp-{ramp_time:g}"
    written = [save(data, folder / f"{name}.nc"), save(data, folder / f"{name}.csv")]

    from .. import figures  # noqa: PLC0415  (matplotlib is the slowest import)

    written += figures.save_figure(figures.spin_up(data)[0], folder / name)

    def line(title: str, text: str) -> None:
        console.print(f"{title:<22}{text}")

    worst = max(
        float(abs(data["direction_residual"]).max()),
        float(data["clamp_residual"].max()) / beam.length,
    )
    line(
        "beam",
        f"L = {beam.length:g} m, EI = {beam.bending_stiffness:.6g} N m², "
        f"EA = {beam.axial_stiffness:.6g} N, m = {beam.mass:.6g} kg",
    )
    line("spin-up", f"ω = {omega:g} rad/s in T = {ramp_time:g} s (Ω = {omega / beam.omega_0:.4f})")
    line(
        "discretization",
        f"{elements} × {', '.join([element, *(option or [])])}; {frame} frame, "
        f"step {step:g} s, {duration:g} s",
    )
    line("natural frequency", f"ω_n = {omega_n:.6f} rad/s (mesh, steady rotation)")
    line(
        "steady amplitude",
        f"{steady.amplitude:.5f} L half peak to peak, first harmonic {steady.first_harmonic:.5f} L",
    )
    line(
        "steady frequency",
        f"ω_NL = {steady.frequency:.6f} ± {steady.frequency_error:.1g} rad/s, "
        f"ω_NL/ω_n = {steady.frequency / omega_n:.6f} over {steady.cycles} cycles",
    )
    line("constraint residual", f"{worst:.2g} (worst)")
    drift, ripple = energy_drift(data)
    line("energy drift", f"{drift:.2g}, ripple {ripple:.2g} of the largest elastic energy")
    line("wall time", f"{data.attrs['wall_time']:.2f} s")
    line("verdict", data.attrs["verdict"])
    line("written", ", ".join(str(path) for path in written))
