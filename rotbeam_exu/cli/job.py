"""Job: the steps that every command which computes a result goes through, in the same order."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Generic, TypeVar

from ..files.results import save, save_tables, writable_folder
from ..lazily import xr
from .output import new_console, print_written
from .targets import free_name, listed, refuse_to_replace, telling_what_is_kept

R = TypeVar("R")
T = TypeVar("T")


class UnfinishedError(Exception):
    """End of a computation that leaves a part of its result.

    Its cause is the error, its arguments are the part and the word "computed" or "found".
    """


def drawn(draw: Callable[[Any, xr.Dataset], Any]) -> Callable[[xr.Dataset, Path], Iterable[Path]]:
    """Return a drawing of a Dataset into files; `draw` is given `figures`, imported late."""

    def files(data: xr.Dataset, path: Path) -> Iterable[Path]:
        from .. import figures

        return figures.save_figure(draw(figures, data), path)

    return files


def saved(data: xr.Dataset, path: Path, table: xr.Dataset | None = None) -> list[Path]:
    """Write all as netCDF, and the table, or all, as CSV; return the files."""
    # The endings are added, not replaced: a name may have a point in it.
    whole = save(data, Path(f"{path}.nc"))
    return [whole, *save_tables(data if table is None else table, Path(f"{path}.csv"))]


@dataclass(frozen=True, kw_only=True)
class Job(Generic[R, T]):
    """A result to compute, and what is done with it.

    Parameters
    ----------
    path
        The files to write, without their endings.
    inputs
        Inputs by name, or the result: files that hold those of another result are not replaced.
    force
        Replace them.
    compute
        Computation of the result; it may raise `UnfinishedError` from a `RuntimeError`.
    dataset
        The result as a Dataset, to save and to draw.
    table
        The part of the Dataset that its CSV holds; all of it, unless given.
    show
        Printing of the result; the Dataset is handed over with it.
    draw
        Drawing of the Dataset into files beside `path`, which it returns; none, unless given.
    """

    path: Path
    inputs: xr.Dataset | Mapping[str, object]
    force: bool
    compute: Callable[[], R]
    dataset: Callable[[R], xr.Dataset]
    table: Callable[[xr.Dataset], xr.Dataset] = lambda data: data
    show: Callable[[R, xr.Dataset], T]
    draw: Callable[[xr.Dataset, Path], Iterable[Path]] | None = None

    def run(self) -> T:
        """Check, compute, save, show, draw and list the files; return what `show` does."""
        writable_folder(self.path.parent)
        targets = Path(f"{self.path}.nc"), Path(f"{self.path}.csv")
        refuse_to_replace(self.inputs, *targets, force=self.force)
        try:
            result = self.compute()
        except UnfinishedError as end:
            raise RuntimeError(self._kept(end)) from end
        data = self.dataset(result)
        written = saved(data, self.path, self.table(data))
        with telling_what_is_kept(lambda: f"kept: {listed(written)}"):
            shown = self.show(result, data)
            if self.draw is not None:
                written += self.draw(data, self.path)
        print_written(new_console(), written)
        return shown

    def _kept(self, end: UnfinishedError) -> str:
        """Save the part of a result, marked failed, and return why it ended and where it is."""
        error, (found, word) = end.__cause__, end.args
        part = self.dataset(found).assign_attrs(verdict=f"failed: {error}")
        name = free_name(part, self.path.parent, f"{self.path.name}-failed")
        kept = saved(part, self.path.with_name(name), self.table(part))[0]
        return f"{error}; what was {word} is in {kept}, marked failed"
