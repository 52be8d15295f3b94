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
    """An error that ends a computation and leaves a part of its result.

    Parameters
    ----------
    part
        The part, in the form of a whole result.
    computed
        The word for what the part is: "computed" or "found".
    """

    def __init__(self, part: Any, computed: str) -> None:
        super().__init__(computed)
        self.part = part
        self.computed = computed


def data_file(path: Path) -> Path:
    """Return the netCDF file of a result; the ending is added, for a name may have a point."""
    return path.with_name(f"{path.name}.nc")


def _table_file(path: Path) -> Path:
    return path.with_name(f"{path.name}.csv")


def saved(data: xr.Dataset, path: Path, table: xr.Dataset | None = None) -> list[Path]:
    """Write all as netCDF, and the table, or all, as CSV; return the files."""
    whole = save(data, data_file(path))
    return [whole, *save_tables(data if table is None else table, _table_file(path))]


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
        targets = data_file(self.path), _table_file(self.path)
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
        error = end.__cause__
        part = self.dataset(end.part).assign_attrs(verdict=f"failed: {error}")
        name = free_name(part, self.path.parent, f"{self.path.name}-failed")
        kept = saved(part, self.path.with_name(name), self.table(part))[0]
        return f"{error}; what was {end.computed} is in {kept}, marked failed"
