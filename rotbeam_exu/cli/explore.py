"""`rotbeam explore`: the Explorer as one page."""

from __future__ import annotations

from pathlib import Path

from rich.progress import Progress

from ..explorer import explorer_page
from ..files.results import whole_file, writable_folder
from .options import Jobs
from .output import new_console
from .targets import Force, refuse_to_replace_unread, telling_what_is_kept


def explore(
    *,
    out: Path = Path("explorer.html"),
    cache: Path | None = None,
    jobs: Jobs = None,
    force: Force = False,
) -> None:
    """Write the Explorer: all models and the exact beam on a page.

    The page needs no network. Sliders set speed and amplitude.

    Parameters
    ----------
    out
        The page.
    cache
        Folder that keeps the finite element runs, for the next time.
    jobs
        Number of processes; by default, all cores.
    force
        Replace a page that is not the Explorer.
    """
    if out.suffix not in (".html", ".htm"):
        raise ValueError(f"cannot write {out.name!r}: the ending must be .html")
    writable_folder(out.parent)
    # It has no inputs: an Explorer may be made again, but what else stands there is not ours.
    if not _is_explorer(out):
        refuse_to_replace_unread(out, force)
    console = new_console()
    kept = f"finished spin-ups are kept in the cache {cache}" if cache else ""
    with (
        telling_what_is_kept(lambda: kept),
        Progress(console=console, transient=True, disable=not console.is_terminal) as bar,
    ):
        task = bar.add_task("exact orbits and spin-ups", total=None)
        page = explorer_page(
            cache=cache,
            jobs=jobs,
            progress=lambda done, total: bar.update(task, completed=done, total=total),
        )
    with whole_file(out) as partial:
        partial.write_text(page, encoding="utf-8")
    console.print(f"{out}, {out.stat().st_size / 1e6:.1f} MB: open it in a browser")


def _is_explorer(page: Path) -> bool:
    return page.is_file() and b"<title>Rotating beam explorer" in page.read_bytes()[:4096]
