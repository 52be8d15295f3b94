"""Results: the steps that every command which computes one goes through, in the same order."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from textwrap import shorten
from typing import Annotated, Any, TypeVar

from cyclopts import Parameter

from analytic.warning import PartialError

from ..files.results import differing_inputs, save, save_tables, whole_file, writable_folder
from ..lazily import xr
from .output import print_written

R = TypeVar("R")

Flag = Annotated[bool, Parameter(negative=(), show_default=False)]
"""A switch, off unless it is given."""


@contextmanager
def telling_what_is_kept(kept: Callable[[], str]) -> Iterator[None]:
    """Let Ctrl-C name the files that stay: `kept` returns them, or an empty text."""
    try:
        yield
    except KeyboardInterrupt as interrupt:
        inner = [str(interrupt)] if interrupt.args else []  # of a part of the work inside
        raise KeyboardInterrupt("; ".join(filter(None, [kept(), *inner]))) from None


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class Results:
    """Options on the folder of the results.

    Parameters
    ----------
    out
        Folder for the results.
    force
        Replace a result of other inputs that has the same name.
    """

    out: Annotated[Path, Parameter(alias="-o")] = Path("results")
    force: Flag = False

    def job(
        self,
        name: str,
        inputs: xr.Dataset | Mapping[str, Any],
        compute: Callable[[], R] | None = None,
        show: Callable[[R, xr.Dataset], Any] | None = None,
        *,
        table: Callable[[xr.Dataset], xr.Dataset] | None = None,
        draw: Callable[[Any, xr.Dataset], Any] | None = None,
        caption: str = "",
    ) -> Any:
        """Check, compute, save, show, draw and list the files; return what `show` does.

        Parameters
        ----------
        name
            The files to write, without folder and endings.
        inputs
            Inputs by name, or a Dataset that is the result: files with other inputs are not
            replaced. The result has them as attributes.
        compute
            Computation of the result. Where it fails with a part of the result, this is kept.
        show
            Printing of the result; its Dataset is handed over with it.
        table
            The part of the Dataset that its CSV holds; all of it, unless given.
        draw
            Drawing of the Dataset by `figures`, which is handed over.
        caption
            Words about the figure, for a file of text next to it.
        """
        from ..datasets import dataset_of

        more = {} if isinstance(inputs, xr.Dataset) else inputs

        def described(result: Any) -> xr.Dataset:
            data = dataset_of(*result) if isinstance(result, tuple) else dataset_of(result)
            return data.assign_attrs({k: more[k] for k in more if k not in data.coords})

        def saved(data: xr.Dataset, end: str = "") -> list[Path]:
            # Endings are added, not replaced: a name may have a point in it.
            whole = save(data, Path(f"{path}{end}.nc"))
            return [whole, *save_tables(table(data) if table else data, Path(f"{path}{end}.csv"))]

        path = self.out / name
        writable_folder(self.out)
        for end in (".nc", ".json"):
            refuse_to_replace(inputs, Path(f"{path}{end}"), force=self.force)
        try:
            result: Any = compute() if compute else inputs
        except PartialError as error:
            if error.part is None:
                raise
            data = described(error.part).assign_attrs(verdict=f"failed: {error}")
            kept = saved(data, "-failed")[0]
            where = f"the part that was computed is in {kept}, marked failed"
            raise RuntimeError(f"{error}; {where}") from error
        data = described(result)
        written = saved(data)
        with telling_what_is_kept(lambda: f"kept: {', '.join(map(str, written))}"):
            shown = show(result, data) if show else None
            if draw:
                from .. import figures

                written += figures.save_figure(draw(figures, data), path)
            if caption:
                written.append(Path(f"{path}.txt"))
                write_text(f"{caption}\n", written[-1])
        print_written(written)
        return shown

    def tables(self, name: str, data: xr.Dataset) -> list[Path]:
        """Write a result as CSV alone, next to a page that shows it; return the files."""
        target = Path(f"{self.out / name}.csv")
        refuse_to_replace(data, target.with_suffix(".json"), force=self.force)
        return save_tables(data, target)


def refuse_to_replace(
    inputs: xr.Dataset | Mapping[str, object], target: Path, *, force: bool
) -> None:
    """Refuse, unless forced, where a file holds a result of other inputs: netCDF or JSON."""
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


def write_text(text: str, target: Path) -> None:
    """Write a text whole or not at all."""
    with whole_file(target) as partial:
        partial.write_text(text, encoding="utf-8")


def _typed(value: object) -> str:
    """Return a value as one would type it, the begin of a long one."""
    text = f"{value:.12g}" if isinstance(value, float) else str(value)
    return shorten(text, 60, placeholder=" ...")
