"""`rotbeam explore`: the Explorer as one page."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

from cyclopts import Parameter

from analytic import Beam, Blade
from analytic.blade_checks import require_planar

from .. import paper
from ..fem.lazily import require_exudyn
from .job import Flag, require_writable, write_text
from .motion import chosen_speeds, chosen_times, grid_motion
from .options import Jobs, Workers
from .output import print_text
from .request import Request, uses


@uses()
def explore(
    request: Request,
    *,
    out: Annotated[Path | None, Parameter(alias="-o")] = None,
    cache: Path | None = None,
    jobs: Jobs = None,
    force: Flag = False,
) -> None:
    """Write the Explorer: all models and the exact beam on a page.

    The page needs no network. Sliders set speed, amplitude and ramp time. The page of the paper's
    beam is written at once; that of another beam takes three to six minutes of CPU, and its
    speeds follow its ω_0.

    Parameters
    ----------
    out
        HTML file to write; by default explorer.html, or explorer-NAME.html for NAME.toml.
    cache
        Folder that keeps the finite element runs of another beam for the next time.
    jobs
        Number of processes for another beam; by default, all cores.
    force
        Replace a page that is there.

    Examples
    --------
    $ rotbeam explore
    $ rotbeam explore --config beam.toml --cache results/cache -o mine.html
    """
    from ..explorer import explorer_data, explorer_page

    if out is None:
        out = Path(f"explorer-{request.config.stem}.html" if request.config else "explorer.html")
    require_writable(out, force=force, ending=".html")
    blade, data = request.blade, None
    if blade != Beam.reference():
        require_exudyn()
        require_planar(blade, "the Explorer is of", "rotbeam animate, which films it in space")
        print_text("three to six minutes of CPU: exact orbits, spin-ups and finite elements")
        with Workers(cache=cache, jobs=jobs).counted("exact orbits and spin-ups") as how:
            data = explorer_data(blade, **how, **_scaled(blade))
    write_text(explorer_page(data), out)
    print_text(f"written {out}, {out.stat().st_size / 1e6:.1f} MB: open it in a browser")


def _scaled(blade: Blade) -> dict[str, Any]:
    """Return the page's speeds, the points' grid, their end and step, scaled by ω_0."""
    from ..explorer import EXACT_RAMP_TIMES, OMEGAS

    (interval,) = chosen_speeds(blade, OMEGAS[1])
    # Points are seen where the slider stops: on its grid, not beside it.
    omegas = [interval * round(omega / OMEGAS[1]) for omega in paper.SPEEDS]
    ramp_times = chosen_times(blade, *paper.RAMP_TIMES, digits=4)
    motion = grid_motion(blade, omegas, ramp_times)
    return {
        "omegas": [interval * i for i in range(len(OMEGAS))],
        "finite_element_omegas": omegas,
        "ramp_times": ramp_times,
        "exact_ramp_times": chosen_times(blade, *EXACT_RAMP_TIMES, digits=4),
        "duration": motion.duration,
        "step": motion.step,
    }
