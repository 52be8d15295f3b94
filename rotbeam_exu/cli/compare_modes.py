"""`rotbeam compare-modes`: the Campbell table of the exact beam, in the plane of rotation."""

from __future__ import annotations

import csv
import sys
from typing import Literal

import numpy as np
from rich.console import Console
from rich.table import Table

from analytic import Beam, Campbell, campbell


def compare_modes(
    *,
    omega_min: float = 0.0,
    omega_max: float = 12.0,
    points: int = 13,
    count: int = 3,
    orders: int = 10,
    format: Literal["table", "csv"] = "table",  # noqa: A002  the name of the option
) -> None:
    """Print in-plane frequencies against the speed, and where they cross the lines k omega.

    Exact, extensible beam of the paper about its steady rotation; modes are tracked by shape.

    Parameters
    ----------
    omega_min, omega_max
        Lowest and highest rotation speed [rad/s].
    points
        Number of speeds.
    count
        Number of modes.
    orders
        Lines k omega up to this k.
    format
        A table to read, or CSV.
    """
    if points < 2:
        raise ValueError(f"points must be at least 2, got {points}")
    diagram = campbell(Beam.reference(), np.linspace(omega_min, omega_max, points), count, orders)
    if format == "csv":
        _print_csv(diagram)
    else:
        _print_tables(diagram)


def _print_csv(diagram: Campbell) -> None:
    writer = csv.writer(sys.stdout, lineterminator="\n")
    modes = range(1, diagram.frequencies.shape[1] + 1)
    writer.writerow(["omega [rad/s]", *(f"mode {mode} [rad/s]" for mode in modes)])
    for omega, row in zip(diagram.omegas, diagram.frequencies, strict=True):
        writer.writerow([f"{omega:.10g}", *(f"{frequency:.10g}" for frequency in row)])
    writer.writerow([])
    writer.writerow(["mode", "k", "omega [rad/s]", "frequency [rad/s]"])
    for crossing in diagram.crossings:
        writer.writerow(
            [crossing.mode, crossing.order, f"{crossing.omega:.10g}", f"{crossing.frequency:.10g}"]
        )


def _print_tables(diagram: Campbell) -> None:
    console = Console()
    table = Table(title="In-plane frequencies [rad/s]")
    table.add_column("omega [rad/s]", justify="right")
    for mode in range(1, diagram.frequencies.shape[1] + 1):
        table.add_column(f"mode {mode}", justify="right")
    for omega, row in zip(diagram.omegas, diagram.frequencies, strict=True):
        table.add_row(f"{omega:.4g}", *(f"{frequency:.6f}" for frequency in row))
    console.print(table)
    crossings = Table(title="Crossings with the lines k omega")
    for name in ("mode", "k", "omega [rad/s]", "frequency [rad/s]"):
        crossings.add_column(name, justify="right")
    for crossing in diagram.crossings:
        crossings.add_row(
            str(crossing.mode),
            str(crossing.order),
            f"{crossing.omega:.6f}",
            f"{crossing.frequency:.6f}",
        )
    console.print(crossings)
