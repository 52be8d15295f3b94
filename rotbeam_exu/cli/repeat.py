"""`rotbeam run --from`: the case of a run on file, and whether it came out the same."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..fem.case import Case
from ..fem.elements import options_of
from ..files.results import load
from ..lazily import xr
from .options import Numerics


def recorded_case(path: Path) -> tuple[Case, xr.Dataset]:
    """Return the case of a run on file, and the run itself.

    Raises
    ------
    ValueError
        If the file holds no run, or one that did not start at rest, whose start it does not tell.
    """
    run = load(path)
    try:
        case = Case.described(run.attrs)
        moving = bool(run["q"][0] or run["q_dot"][0])
    except (KeyError, IndexError) as error:
        raise ValueError(f"{path} is not of a run: it has no {error.args[0]!r}") from error
    if case.model.leaves_plane:
        raise ValueError(f"{path} is of a run in space, which only simulate_3d repeats")
    if moving:
        raise ValueError(
            f"{path} cannot be repeated: its beam did not start at rest, and from which state the "
            "file does not tell"
        )
    return case, run


def recorded_title(case: Case) -> str:
    """Return formulation and options of a case for a reader."""
    return Numerics(element=case.model.name, option=options_of(case.model)).title


def likeness(run: xr.Dataset, recorded: xr.Dataset) -> str:
    """Return how far a run is from the one it repeats, in words."""
    if run["time"].shape != recorded["time"].shape:
        return f"{run['time'].size} samples, {recorded['time'].size} on file"
    if all(run[name].equals(recorded[name]) for name in recorded.data_vars):
        return "the same to the last bit"
    gap = float(np.abs(run["q"].to_numpy() - recorded["q"].to_numpy()).max())
    versions = "the same" if _versions(run) == _versions(recorded) else "other"
    return f"q differs by up to {gap:.1e} m, with {versions} versions"


def _versions(run: xr.Dataset) -> str:
    return str(run.attrs.get("versions", ""))
