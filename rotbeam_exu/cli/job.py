"""Job: the steps that every command which computes a result goes through, in the same order."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from textwrap import shorten
from typing import Any, Generic, TypeVar

from ..files.results import differing_inputs, save, save_tables, whole_file, writable_folder
from ..lazily import xr
from .output import print_written

R = TypeVar("R")
T = TypeVar("T")

_LONGEST = 60
"""Letters of a value that are shown."""


class UnfinishedError(Exception):
    """End of a computation that leaves a part of its result.

    Its cause is the error, its arguments are the part and the word "computed" or "found".
    """


@contextmanager
def telling_what_is_kept(kept: Callable[[], str]) -> Iterator[None]:
    """Let Ctrl-C name the files that stay: `kept` returns them, or an empty text."""
    try:
        yield
    except KeyboardInterrupt as interrupt:
        told = [str(interrupt)] if interrupt.args else []  # by a part of the work inside this one
        raise KeyboardInterrupt("; ".join(filter(None, [kept(), *told]))) from None


def _itself(data: Any) -> Any:
    return data


def _saved(data: xr.Dataset, path: Path, table: xr.Dataset) -> list[Path]:
    """Write all as netCDF, and the table as CSV; return the files."""
    # The endings are added, not replaced: a name may have a point in it.
    whole = save(data, Path(f"{path}.nc"))
    return [whole, *save_tables(table, Path(f"{path}.csv"))]


@dataclass(frozen=True, kw_only=True)
class Job(Generic[R, T]):
    """A result to compute, save, print and draw.

    Parameters
    ----------
    path
        The files to write, without their endings.
    inputs
        Inputs by name, or the result: files with other inputs are not replaced.
    force
        Replace them.
    compute
        Computation of the result; it may raise `UnfinishedError` from a `RuntimeError`.
    dataset
        The result as a Dataset, to save and to draw; itself, unless given.
    table
        The part of the Dataset that its CSV holds; all of it, unless given.
    show
        Printing of the result; the Dataset is handed over with it.
    draw
        Drawing of the Dataset by `figures`, which is handed over; none, unless given.
    caption
        Words about the figure, for a file of text beside it.
    """

    path: Path
    inputs: xr.Dataset | Mapping[str, object]
    force: bool
    compute: Callable[[], R]
    dataset: Callable[[R], xr.Dataset] = _itself
    table: Callable[[xr.Dataset], xr.Dataset] = _itself
    show: Callable[[R, xr.Dataset], T]
    draw: Callable[[Any, xr.Dataset], Any] | None = None
    caption: str = ""

    def run(self) -> T:
        """Check, compute, save, show, draw and list the files; return what `show` does."""
        writable_folder(self.path.parent)
        refuse_to_replace(self.inputs, Path(f"{self.path}.nc"), force=self.force)
        try:
            result = self.compute()
        except UnfinishedError as end:
            raise RuntimeError(self._kept(end)) from end
        data = self.dataset(result)
        written = _saved(data, self.path, self.table(data))
        with telling_what_is_kept(lambda: f"kept: {', '.join(map(str, written))}"):
            shown = self.show(result, data)
            if self.draw is not None:
                from .. import figures

                written += figures.save_figure(self.draw(figures, data), self.path)
            if self.caption:
                written.append(Path(f"{self.path}.txt"))
                with whole_file(written[-1]) as partial:
                    partial.write_text(f"{self.caption}\n", encoding="utf-8")
        print_written(written)
        return shown

    def _kept(self, end: UnfinishedError) -> str:
        """Save the part of a result, marked failed, and return why it ended and where it is."""
        error, (found, word) = end.__cause__, end.args
        part = self.dataset(found).assign_attrs(verdict=f"failed: {error}")
        kept = _saved(part, Path(f"{self.path}-failed"), self.table(part))[0]
        return f"{error}; the part that was {word} is in {kept}, marked failed"


def refuse_to_replace(
    inputs: xr.Dataset | Mapping[str, object], target: Path, *, force: bool
) -> None:
    """Refuse, unless forced, where a netCDF file holds a result of other inputs."""
    differing = {} if force else differing_inputs(inputs, target)
    if not differing:
        return
    if "file" in differing:
        what = f"is not a result that can be compared ({differing['file'][1]})"
    else:
        named = [
            f"{name} {_typed(there)} instead of {_typed(mine)}"
            for name, (mine, there) in differing.items()
        ]
        what = f"holds another result: {'; '.join(named)}"
    raise FileExistsError(f"{target} {what}; choose another folder with --out, or --force")


def require_writable(target: Path, *, force: bool, ending: str = "") -> None:
    """Refuse another ending, a folder that cannot be written, and, unless forced, a file there."""
    if ending and target.suffix != ending:
        raise ValueError(f"cannot write {target.name!r}: the ending must be {ending}")
    writable_folder(target.parent)
    if target.exists() and not force:
        raise FileExistsError(f"{target} is there: choose another name with --out, or --force")


def _typed(value: object) -> str:
    """Return a value as one would type it, the begin of a long one."""
    text = f"{value:.12g}" if isinstance(value, float) else str(value)
    return shorten(text, _LONGEST, placeholder=" ...")
