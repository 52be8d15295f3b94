"""The option --config: a beam or blade, and where the file holds them, motion and numerics."""

from __future__ import annotations

from pathlib import Path

from analytic import Beam

from ..files.beam_file import RunFile, load_run_file
from .motion import Motion, chosen_motion
from .options import given


def configured(config: Path | None) -> RunFile:
    """Return what a TOML file says of a run; without one, the paper's beam and nothing else."""
    return RunFile(beam=Beam.reference()) if config is None else load_run_file(config)


def motion_of(
    file: RunFile,
    *,
    omega: float | None = None,
    ramp_time: float | None = None,
    duration: float | None = None,
    step: float | None = None,
) -> Motion:
    """Return `chosen_motion` of what is given, then of what the file's [motion] holds."""
    chosen = {**file.motion, **given(omega=omega, ramp_time=ramp_time)}
    return chosen_motion(file.beam, duration=duration, step=step, **chosen)


def omega_of(file: RunFile, omega: float | None) -> float:
    """Return the speed [rad/s] given, or that of the file's [motion]; refuse to guess one."""
    known: float | None = {**file.motion, **given(omega=omega)}.get("omega")
    if known is None:
        raise ValueError(
            "give the rotation speed in rad/s with --omega, or as omega in [motion] of --config"
        )
    return known
