"""Files that a command writes: nothing of other inputs is lost, and what is kept is said."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from ..files.results import differing_inputs
from ..lazily import xr

Force = Annotated[bool, Parameter(negative=(), show_default=False)]
"""Replace files even if they hold what other inputs gave."""

_MOST_NAMED = 4


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
                f"{name} {_short(there)} instead of {_short(mine)}"
                for name, (mine, there) in differing.items()
            ]
            more = len(named) - _MOST_NAMED
            rest = [f"{more} more"] if more > 0 else []
            what = f"holds another result: {'; '.join([*named[:_MOST_NAMED], *rest])}"
        raise FileExistsError(f"{target} {what}; choose another folder with --out, or --force")


def refuse_to_replace_unread(target: Path, force: bool) -> None:
    """Refuse, unless forced, a target that is there and does not tell what it was made of."""
    if target.exists() and not force:
        raise FileExistsError(
            f"{target} is there, and does not tell what it was made from; choose another name "
            "with --out, or --force"
        )


def free_name(inputs: xr.Dataset, folder: Path, stem: str) -> str:
    """Return `stem`, or with a number where a netCDF file of that name holds other inputs."""
    names = (stem if n == 1 else f"{stem}-{n}" for n in range(1, 10_000))
    return next(name for name in names if not differing_inputs(inputs, folder / f"{name}.nc"))


@contextmanager
def telling_what_is_kept(kept: Callable[[], str]) -> Iterator[None]:
    """Let Ctrl-C say what it leaves behind: `kept` is asked then, and empty for nothing."""
    try:
        yield
    except KeyboardInterrupt as interrupt:
        told = [str(interrupt)] if interrupt.args else []  # by a part of the work inside this one
        raise KeyboardInterrupt("; ".join(filter(None, [kept(), *told]))) from None


def listed(paths: list[Path]) -> str:
    """Return paths in one line."""
    return ", ".join(map(str, paths))


def _short(value: object) -> str:
    """Return a value as one would type it; of a long one, its beginning."""
    if value is None:
        return "none"
    text = f"{value:.12g}" if isinstance(value, float) else " ".join(str(value).split())
    return text if len(text) <= 60 else f"{text[:57]}..."
