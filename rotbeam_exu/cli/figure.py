"""`rotbeam figure N`: data and picture of a figure of the paper."""

from __future__ import annotations

from ..files.results import writable_folder
from .job import Job
from .options import RESULTS, WORKERS, Results, Workers, numbered

_SWEPT = (5, 14)  # whose data come from sweeps


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
    from .. import comparison, figures

    name = f"figure_{n}"
    writable_folder(results.out)
    with workers.counted(f"figure {n}") as progress:
        options = {"jobs": workers.jobs, "cache": workers.cache, "progress": progress}
        data = getattr(comparison, name)(**options if n in _SWEPT else {})

    # Data has its inputs, so files are compared with it after it is computed.
    Job(
        path=results.out / name, inputs=data, force=results.force, compute=lambda: data,
        show=lambda *_: None, draw=lambda figures, data: getattr(figures, name)(data),
        caption=f"Figure {n}. {figures.caption(n, data)}",
    ).run()  # fmt: skip
