"""`rotbeam figure N`: data and picture of a figure of the paper."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter
from rich.console import Console

from ..files.results import save, save_tables, whole_file, writable_folder
from .options import Results, Workers, spelled_as
from .output import new_console, print_written
from .progress import counter
from .targets import listed, refuse_to_replace, telling_what_is_kept

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
    from ..paper_figures import PAPER_FIGURES

    every = list(PAPER_FIGURES)
    wanted = every if number.lower() == "all" else [int(number)] if number.isdecimal() else []
    if not wanted or wanted[0] not in PAPER_FIGURES:
        raise ValueError(
            f"there is no data behind figure {number!r}; known are {', '.join(map(str, every))} "
            "and all"
        )
    folder = writable_folder(results.out)
    console = new_console()
    done: list[Path] = []
    spin_ups = f"finished spin-ups are kept in the cache {workers.cache}"
    kept = telling_what_is_kept(lambda: "; ".join([spin_ups, *([listed(done)] if done else [])]))
    with figures.style(style), kept:
        for n in wanted:
            done += _made(n, folder, console, workers, force=results.force)


def _made(n: int, folder: Path, console: Console, workers: Workers, *, force: bool) -> list[Path]:
    """Make one figure and return its files."""
    from .. import figures
    from ..paper_figures import PAPER_FIGURES

    made = PAPER_FIGURES[n]
    with counter(console, f"figure {n}") as progress:
        options = (
            {"jobs": workers.jobs, "cache": workers.cache, "progress": progress}
            if made.sweeps
            else {}
        )
        data = made.data(**options)
    name = folder / f"figure_{n}"
    refuse_to_replace(data, name.with_suffix(".nc"), force=force)
    written = [save(data, name.with_suffix(".nc"))]
    written += save_tables(data, name.with_suffix(".csv"))
    axes = made.draw(data)
    written += figures.save_figure(axes[0] if isinstance(axes, Sequence) else axes, name)
    words = name.with_suffix(".txt")
    with whole_file(words) as partial:
        partial.write_text(f"Figure {n}. {figures.caption(n, data)}\n", encoding="utf-8")
    written.append(words)
    print_written(console, written)
    return written
