"""L.csv and B.csv: frequencies by mesh and speed, and backbones by amplitude as well."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ..cases import Asked, Case
from .faults import Faults
from .tables import DIGITS, FAILURE, Column, asked, bounded, digits, rows_of, sheet_of, whole

_positive = bounded(lambda value: value > 0.0, "must be positive, got {}; it is in rad/s")


def tables_of(cases: Mapping[str, Case]) -> dict[str, Case]:
    """Return the cases that are handed in as one table, by its file."""
    return {f"{name}.csv": case for name, case in cases.items() if case.asked is not Asked.HISTORY}


def columns_of(case: Case) -> tuple[Column, ...]:
    """Return the columns of a case's table."""
    places = [Column("elements", whole), Column("speed", asked(case.speeds), "rad/s")]
    if case.amplitudes:
        places.append(Column("amplitude", asked(case.amplitudes)))
    return (*places, Column("frequency", _positive, "rad/s", measured=True), FAILURE)


def points_of(folder: Path, file: str, case: Case, faults: Faults) -> list[dict[str, Any]]:
    """Return the rows by field, those with a failure without a frequency."""
    sheet = sheet_of(folder, file, columns_of(case), faults)
    if sheet is None:
        return []
    found: dict[tuple[float, ...], dict[str, Any]] = {}
    written = []
    for line, cells, row in rows_of(sheet, faults):
        place = row["elements"], row["speed"], row.get("amplitude", 0.0)
        if place in found:
            faults.add(file, "the same row stands above: keep one", line)
            continue
        found[place] = row
        written += [digits(cells["frequency"])] if "frequency" in row else []
    if written and max(written) < DIGITS:
        said = f"frequencies are written to {max(written)} digits, {DIGITS} are needed: write %.10g"
        faults.add(file, said)
    return list(found.values())
