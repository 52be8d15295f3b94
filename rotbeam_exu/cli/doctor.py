"""`rotbeam doctor` and `rotbeam schema`: whether the installation works, and what files hold."""

from __future__ import annotations

import json
import sys
import time

import analytic
from analytic import Beam, SpinUp

from ..fem.lazily import require_exudyn
from ..runs.attributes import versions
from .output import print_text


def doctor() -> None:
    """Print versions, draw a figure, run a short spin-up.

    Where Exudyn cannot be imported, say why instead.

    Examples
    --------
    $ rotbeam doctor
    """
    for name, version in versions().items():
        print_text(f"{name:<14}{version}")
    from .. import figures
    from ..figures.judgement import svg

    started = time.perf_counter()
    modes = analytic.campbell(Beam.reference(), (0.0, 4.0, 8.0), count=1, orders=1)
    svg(figures.campbell(modes))  # as all figures are drawn
    print_text(f"{'figure':<14}drawn in {time.perf_counter() - started:.2f} s")
    try:
        require_exudyn()
    except ImportError as error:
        print_text(f"{'spin-up':<14}not run: {error}")
        return
    from ..fem.simulation import simulate

    started = time.perf_counter()
    run = simulate(
        Beam.reference(), SpinUp(omega=2.0, ramp_time=0.5), elements=4, duration=1.0, step=5e-3
    )
    print_text(f"{'spin-up':<14}{run.attrs['verdict']} in {time.perf_counter() - started:.2f} s")


def schema() -> None:
    """Print the JSON schema of beam files.

    By it, an editor completes and checks a file whose first line is `#:schema beam.schema.json`.

    Examples
    --------
    $ rotbeam schema
    """
    from ..files.beam_tables import schema as of_files

    sys.stdout.write(f"{json.dumps(of_files(), indent=2)}\n")
