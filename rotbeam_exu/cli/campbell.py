"""`rotbeam campbell`: the Campbell table of the exact beam, in the plane of rotation."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

from analytic import Campbell
from analytic import campbell as campbell_diagram
from analytic.input_checks import rotation_speed, whole_number

from .configuration import configured
from .cost import require_affordable
from .motion import chosen_speeds
from .options import Whole
from .output import Format, print_columns

_HIGHEST = 12.0  # of the paper's beam [rad/s]
_SECONDS_PER_SPEED = 1e-3
_SECONDS_PER_LINE = 5e-3
"""And per mode squared: what finds the crossings; both from below."""


def campbell(
    *,
    omega_min: float = 0.0,
    omega_max: float | None = None,
    points: Whole = 13,
    count: Whole = 3,
    orders: Whole = 10,
    config: Path | None = None,
    format: Format = "table",  # noqa: A002  the name of the option
) -> None:
    """Print frequencies over the speed, and where they cross k ω.

    Exact, extensible beam about its steady rotation; modes are tracked by shape, and resolved until
    half as many functions again change no frequency by 1e-9.

    Parameters
    ----------
    omega_min
        Lowest rotation speed [rad/s].
    omega_max
        Highest rotation speed [rad/s], 12 for the paper's beam unless given.
    points
        Number of speeds.
    count
        Number of modes.
    orders
        Lines k omega up to this k.
    config
        TOML file with the beam; without it, the paper's beam.
    format
        A table to read, or CSV.

    Examples
    --------
    $ rotbeam campbell
    $ rotbeam campbell --omega-max 8 --points 5 --count 2 --format csv
    """
    if points < 2:
        raise ValueError(f"points must be at least 2, got {points}")
    whole_number("count", count)
    whole_number("orders", orders)
    if omega_max is not None:
        rotation_speed(omega_max, "omega_max")
    require_affordable(
        f"{points} speeds, {count} modes and {orders} lines",
        memory=8.0 * (points * (count + 20.0) * 40.0 + 16.0 * count**2),
        seconds=_SECONDS_PER_SPEED * points + _SECONDS_PER_LINE * orders * count**2,
        remedy="take fewer",
    )
    beam = configured(config).beam
    highest = chosen_speeds(beam, _HIGHEST)[0] if omega_max is None else omega_max
    speeds = np.linspace(rotation_speed(omega_min, "omega_min"), highest, points)
    _print(campbell_diagram(beam, speeds, count, orders), format)


def _print(diagram: Campbell, form: Format) -> None:
    """Print frequencies over speed, and the crossings; ten digits in CSV."""
    csv = form == "csv"
    speed, number = ("{:.10g}", "{:.10g}") if csv else ("{:.4g}", "{:.6f}")
    unit = " [rad/s]" if csv else ""
    print_columns(
        {
            "omega [rad/s]": [speed.format(omega) for omega in diagram.omegas],
            **{
                f"mode {mode}{unit}": [number.format(frequency) for frequency in column]
                for mode, column in enumerate(diagram.frequencies.T, start=1)
            },
        },
        form,
        title="In-plane frequencies [rad/s]",
    )
    if csv:
        sys.stdout.write("\n")
    print_columns(
        {
            "mode": [str(crossing.mode) for crossing in diagram.crossings],
            "k": [str(crossing.order) for crossing in diagram.crossings],
            "omega [rad/s]": [number.format(crossing.omega) for crossing in diagram.crossings],
            "frequency [rad/s]": [
                number.format(crossing.frequency) for crossing in diagram.crossings
            ],
        },
        form,
        title="Crossings with the lines k omega",
    )
