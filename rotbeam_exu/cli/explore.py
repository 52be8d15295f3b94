"""`rotbeam explore`: the Explorer as one page."""

from __future__ import annotations

from pathlib import Path

from rich.console import Console
from rich.progress import Progress

from ..explorer import explorer_page
from ..storage import whole_file, writable_folder


def explore(
    *, out: Path = Path("explorer.html"), cache: Path | None = None, jobs: int | None = None
) -> None:
    """Write the Explorer: one page with all models, the exact beam and finite element points.

    The page needs no network. Sliders set speed and amplitude.

    Parameters
    ----------
    out
        The page.
    cache
        Folder that keeps the finite element runs, for the next time.
    jobs
        Number of processes; by default, all cores.
    """
    if out.suffix not in (".html", ".htm"):
        raise ValueError(f"cannot write {out.name!r}: the ending must be .html")
    writable_folder(out.parent)
    console = Console(highlight=False, soft_wrap=True)
    with Progress(console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task("exact orbits and spin-ups", total=None)
        page = explorer_page(
            cache=cache,
            jobs=jobs,
            progress=lambda done, total: bar.update(task, completed=done, total=total),
        )
    with whole_file(out) as partial:
        partial.write_text(page, encoding="utf-8")
    console.print(f"{out}, {out.stat().st_size / 1e6:.1f} MB: open it in a browser")
