"""`rotbeam compare-modes`: the Campbell table of the exact beam, in the plane of rotation."""

from __future__ import annotations

import csv
import sys
from typing import Literal

import numpy as np

from analytic import Beam, Campbell, campbell
from analytic.input_checks import rotation_speed, whole_number

from .cost import require_affordable
from .options import Whole
from .output import print_columns

_SECONDS_PER_SPEED = 1e-3
_SECONDS_PER_LINE = 5e-3
"""And per mode squared: what finds the crossings; both from below."""


def compare_modes(
    *,
    omega_min: float = 0.0,
    omega_max: float = 12.0,
    points: Whole = 13,
    count: Whole = 3,
    orders: Whole = 10,
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
    whole_number("count", count)
    whole_number("orders", orders)
    rotation_speed(omega_min, "omega_min")
    rotation_speed(omega_max, "omega_max")
    require_affordable(
        f"{points} speeds, {count} modes and {orders} lines",
        memory=8.0 * (points * (count + 20.0) * 40.0 + 16.0 * count**2),
        seconds=_SECONDS_PER_SPEED * points + _SECONDS_PER_LINE * orders * count**2,
        remedy="take fewer",
    )
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
    print_columns(
        {
            "omega [rad/s]": [f"{omega:.4g}" for omega in diagram.omegas],
            **{
                f"mode {mode}": [f"{frequency:.6f}" for frequency in column]
                for mode, column in enumerate(diagram.frequencies.T, start=1)
            },
        },
        "table",
        title="In-plane frequencies [rad/s]",
    )
    print_columns(
        {
            "mode": [str(crossing.mode) for crossing in diagram.crossings],
            "k": [str(crossing.order) for crossing in diagram.crossings],
            "omega [rad/s]": [f"{crossing.omega:.6f}" for crossing in diagram.crossings],
            "frequency [rad/s]": [f"{crossing.frequency:.6f}" for crossing in diagram.crossings],
        },
        "table",
        title="Crossings with the lines k omega",
    )
