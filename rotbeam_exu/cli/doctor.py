"""`rotbeam doctor`: whether this installation works."""

from __future__ import annotations

import time

from analytic import Beam, SpinUp

from ..fem.lazily import require_exudyn
from ..versions import versions
from .output import new_console, print_text


def doctor() -> None:
    """Print versions and run one short spin-up with all its checks.

    Where Exudyn cannot be imported, say why instead.

    Examples
    --------
    $ rotbeam doctor
    """
    console = new_console()
    for name, version in versions().items():
        console.print(f"{name:<14}{version}")
    try:
        require_exudyn()
    except ImportError as error:
        print_text(console, f"{'spin-up':<14}not run: {error}")
        return
    from ..fem.simulation import simulate

    started = time.perf_counter()
    run = simulate(
        Beam.reference(), SpinUp(omega=2.0, ramp_time=0.5), elements=4, duration=1.0, step=5e-3
    )
    console.print(f"{'spin-up':<14}{run.attrs['verdict']} in {time.perf_counter() - started:.2f} s")
