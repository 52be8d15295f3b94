"""`rotbeam figure N`: data and picture of a figure of the paper."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from ..files.results import whole_file, writable_folder
from ..lazily import xr
from .job import Job
from .options import Results, Workers, spelled_as
from .output import new_console
from .progress import counter
from .targets import telling_what_is_kept

_WORKERS, _RESULTS = Workers(), Results()


def _styles() -> Iterable[str]:
    from ..figures import STYLES

    return STYLES


StyleName = Annotated[str, Parameter(converter=spelled_as(_styles))]
"""Name of a style; what is none is refused by `figures.style`."""


def figure(
    number: str,
    *,
    workers: Workers = _WORKERS,
    results: Results = _RESULTS,
    style: StyleName = "house",
) -> None:
    """Make a figure of the paper: data, pictures and caption.

    It is of the paper's beam by definition, and takes no other: for one's own there are run,
    respond, compare and explore.

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

    every = list(figures.PAPER_FIGURES)
    wanted = every if number.lower() == "all" else [int(number)] if number.isdecimal() else []
    if not wanted or wanted[0] not in every:
        raise ValueError(
            f"there is no data behind figure {number!r}; known are {', '.join(map(str, every))} "
            "and all"
        )
    folder = writable_folder(results.out)
    kept = f"finished spin-ups are kept in the cache {workers.cache}"
    with figures.style(style), telling_what_is_kept(lambda: kept):
        for n in wanted:
            _made(n, folder, workers, force=results.force)


def _made(n: int, folder: Path, workers: Workers, *, force: bool) -> None:
    """Make one figure."""
    from .. import figures

    made = figures.PAPER_FIGURES[n]
    with counter(new_console(), f"figure {n}") as progress:
        options = (
            {"jobs": workers.jobs, "cache": workers.cache, "progress": progress}
            if made.sweeps
            else {}
        )
        data = made.data(**options)

    def drawn(data: xr.Dataset, path: Path) -> Iterable[Path]:
        axes = made.draw(data)
        words = path.with_name(f"{path.name}.txt")
        with whole_file(words) as partial:
            partial.write_text(f"Figure {n}. {made.caption(data)}\n", encoding="utf-8")
        return *figures.save_figure(axes[0] if isinstance(axes, Sequence) else axes, path), words

    # The data tells its inputs, so files are compared with it after it is computed.
    Job(
        path=folder / f"figure_{n}", inputs=data, force=force, compute=lambda: data,
        dataset=lambda data: data, show=lambda *_: None, draw=drawn,
    ).run()  # fmt: skip
