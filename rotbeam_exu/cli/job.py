"""Job: the steps that every command which computes a result goes through, in the same order."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Generic, TypeVar

from ..files.results import differing_inputs, save, save_tables, whole_file, writable_folder
from ..lazily import xr
from .output import print_written

R = TypeVar("R")
T = TypeVar("T")

_MOST_NAMED = 4
_LONGEST, _AHEAD = 60, 20  # letters of a value that are shown, and of what two have in common


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


def saved(data: xr.Dataset, path: Path, table: xr.Dataset | None = None) -> list[Path]:
    """Write all as netCDF, and the table, or all, as CSV; return the files."""
    # The endings are added, not replaced: a name may have a point in it.
    whole = save(data, Path(f"{path}.nc"))
    return [whole, *save_tables(data if table is None else table, Path(f"{path}.csv"))]


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
    aside
        Whether the list of files goes to standard error, as beside a CSV.
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
    aside: bool = False

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
        with telling_what_is_kept(lambda: f"kept: {', '.join(map(str, written))}"):
            shown = self.show(result, data)
            if self.draw is not None:
                from .. import figures

                written += figures.save_figure(self.draw(figures, data), self.path)
            if self.caption:
                written.append(Path(f"{self.path}.txt"))
                with whole_file(written[-1]) as partial:
                    partial.write_text(f"{self.caption}\n", encoding="utf-8")
        print_written(written, stderr=self.aside)
        return shown

    def _kept(self, end: UnfinishedError) -> str:
        """Save the part of a result, marked failed, and return why it ended and where it is."""
        error, (found, word) = end.__cause__, end.args
        part = self.dataset(found).assign_attrs(verdict=f"failed: {error}")
        stem = f"{self.path}-failed"
        names = (Path(stem if n == 1 else f"{stem}-{n}") for n in range(1, 10_000))
        free = next(name for name in names if not differing_inputs(part, f"{name}.nc"))
        kept = saved(part, free, self.table(part))[0]
        return f"{error}; the part that was {word} is in {kept}, marked failed"


def refuse_to_replace(
    inputs: xr.Dataset | Mapping[str, object], *targets: Path, force: bool = False
) -> None:
    """Refuse, unless forced, where a target holds results of other inputs.

    Parameters
    ----------
    inputs
        A result, or its inputs by name before it is computed.
    targets
        Files to write; the same inputs may write them again.
    force
        Refuse nothing.
    """
    if force:
        return
    for target in targets:
        differing = differing_inputs(inputs, target)
        if not differing:
            continue
        if "file" in differing:
            what = f"is not a result that can be compared ({differing['file'][1]})"
        else:
            named = [
                f"{name} {there} instead of {mine}"
                for name, pair in differing.items()
                for mine, there in [_short(*pair)]
            ]
            more = len(named) - _MOST_NAMED
            rest = [f"{more} more"] if more > 0 else []
            what = f"holds another result: {'; '.join([*named[:_MOST_NAMED], *rest])}"
        raise FileExistsError(f"{target} {what}; choose another folder with --out, or --force")


def require_writable(
    target: Path, *, force: bool | None = None, ours: str = "", ending: str = ""
) -> None:
    """Refuse another ending, and, unless forced, a file that does not hold `ours` early on.

    Such a file does not tell its inputs. Its folder is made, if it can be written.
    """
    if ending and target.suffix != ending:
        raise ValueError(f"cannot write {target.name!r}: the ending must be {ending}")
    writable_folder(target.parent)
    known = ours and target.is_file() and ours.encode() in target.read_bytes()[:4096]
    if target.exists() and not known and not force:
        remedy = "choose another name" + ("" if force is None else " with --out, or --force")
        raise FileExistsError(f"{target} is there, from unknown inputs: {remedy}")


def _short(*values: object) -> list[str]:
    """Return values as one would type them; of long ones, the part from where they differ."""
    texts = [_typed(value) for value in values]
    pairs = zip(*texts, strict=False)
    differ = next((i for i, (one, other) in enumerate(pairs) if one != other), 0)
    begin = max(0, differ - _AHEAD) if max(map(len, texts)) > _LONGEST else 0
    cut = [f"...{text[begin:]}" if begin else text for text in texts]
    return [text if len(text) <= _LONGEST else f"{text[: _LONGEST - 3]}..." for text in cut]


def _typed(value: object) -> str:
    if value is None:
        return "none"
    return f"{value:.12g}" if isinstance(value, float) else " ".join(str(value).split())
