"""L.csv and B.csv: frequencies by mesh and speed, and backbones by amplitude as well."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path

from ..cases import Case
from ..submission import BackbonePoint, Frequency
from .faults import Faults
from .histories import DIGITS
from .tables import digits, number_fault, records, sheet_of

_SAME = 1e-6
"""Relative distance within which a speed or an amplitude is one that is asked for."""


def frequencies_of(folder: Path, file: str, case: Case, faults: Faults) -> tuple[Frequency, ...]:
    """Return the rows of L.csv: elements, speed, frequency and, if the code failed, failure."""
    required = {"elements": "", "speed": "rad/s", "frequency": "rad/s"}
    rows = _rows(folder, file, required, {"speed": case.speeds}, faults)
    return tuple(
        Frequency(
            elements=int(row["elements"]),
            speed=row["speed"],
            frequency=row["frequency"],
            failure=failure,
        )
        for row, failure in rows
    )


def backbone_of(folder: Path, file: str, case: Case, faults: Faults) -> tuple[BackbonePoint, ...]:
    """Return the rows of B.csv: elements, speed, amplitude, frequency."""
    required = {"elements": "", "speed": "rad/s", "amplitude": "", "frequency": "rad/s"}
    asked = {"speed": case.speeds, "amplitude": case.amplitudes}
    rows = _rows(folder, file, required, asked, faults)
    return tuple(
        BackbonePoint(
            elements=int(row["elements"]),
            speed=row["speed"],
            amplitude=row["amplitude"],
            frequency=row["frequency"],
        )
        for row, failure in rows
        if not failure
    )


def _rows(
    folder: Path,
    file: str,
    required: Mapping[str, str],
    asked: Mapping[str, tuple[float, ...]],
    faults: Faults,
) -> list[tuple[dict[str, float], str]]:
    """Return the numbers of each row by column, and its failure; frequency NaN of a failed one."""
    sheet = sheet_of(folder, file, required, {"failure": ""}, faults)
    if sheet is None:
        return []
    found: dict[tuple[float, ...], tuple[dict[str, float], str]] = {}
    written = []
    for line, cells in records(sheet, faults):
        failure = cells.pop("failure", "")
        row, wrong = _numbers(cells, asked, bool(failure))
        key = tuple(value for name, value in row.items() if name != "frequency")
        if not wrong and key in found:
            wrong = ["the same row stands above: keep one"]
        for said in wrong:
            faults.add(file, said, line)
        if not wrong:
            found[key] = row, failure
            written += [] if failure else [digits(cells["frequency"])]
    if written and max(written) < DIGITS:
        said = f"frequencies are written to {max(written)} digits, {DIGITS} are needed: write %.10g"
        faults.add(file, said)
    return list(found.values())


def _numbers(
    cells: Mapping[str, str], asked: Mapping[str, tuple[float, ...]], failed: bool
) -> tuple[dict[str, float], list[str]]:
    """Return the numbers of a row, those asked for exactly so, and what is wrong with it."""
    row, wrong = {}, []
    for name, cell in cells.items():
        if failed and name == "frequency":
            row[name] = math.nan
            continue
        said = number_fault(cell)
        if said:
            wrong.append(f"{name}: {said}")
            continue
        row[name] = value = float(cell)
        if name in asked:
            near = min(asked[name], key=lambda known: abs(known - value))
            if abs(near - value) > _SAME * (abs(near) or 1.0):
                known = ", ".join(f"{one:g}" for one in asked[name])
                wrong.append(f"{name} {value:g} is not asked for: hand in {known}")
            row[name] = near
        elif name == "elements" and not (value >= 1.0 and value.is_integer()):
            wrong.append(f"elements must be a whole number of at least 1, got {cell}")
        elif name == "frequency" and value <= 0.0:
            wrong.append(f"frequency must be positive, got {cell}; it is in rad/s")
    return row, wrong
