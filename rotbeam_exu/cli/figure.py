"""`rotbeam figure N`: data and picture of a figure of the paper."""

from __future__ import annotations

from ..files.results import writable_folder
from .job import Job
from .options import RESULTS, WORKERS, Results, Workers, numbered


def figure(
    number: str,
    /,
    *,
    workers: Workers = WORKERS,
    results: Results = RESULTS,
    style: str = "house",
) -> None:
    """Make a figure of the paper: data, pictures and caption.

    Figures show the paper's beam. For your own beam take run, respond, compare or explore.

    Parameters
    ----------
    number
        3, 4, 5, 8 to 15, or all. Figures 1, 2, 6 and 7 are drawings.
    style
        house: PNG and PDF; journal: a journal's column width, PDF and SVG; grey: that in greys.

    Examples
    --------
    $ rotbeam figure 9
    $ rotbeam figure 14 --jobs 2 -o paper
    """
    from .. import figures

    with figures.style(style):
        for n in numbered("figure", number, sorted(figures.PAPER_FIGURES)):
            _made(n, workers, results)


def _made(n: int, workers: Workers, results: Results) -> None:
    """Make one figure."""
    from .. import figures

    made = figures.PAPER_FIGURES[n]
    writable_folder(results.out)
    with workers.counted(f"figure {n}") as progress:
        options = {"jobs": workers.jobs, "cache": workers.cache, "progress": progress}
        data = made.data(**options if made.sweeps else {})

    # Data has its inputs, so files are compared with it after it is computed.
    Job(
        path=results.out / f"figure_{n}", inputs=data, force=results.force, compute=lambda: data,
        show=lambda *_: None, draw=lambda _, data: made.draw(data),
        caption=f"Figure {n}. {made.caption(data)}",
    ).run()  # fmt: skip
