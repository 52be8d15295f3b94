"""What a file must give back: two Datasets compared to the last bit, text and attributes too."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from ..lazily import xr


def plain(value: Any) -> Any:
    """Return Python's numbers, text and lists of them for NumPy's and xarray's."""
    if isinstance(value, (np.ndarray, np.generic, xr.DataArray)):
        return np.asarray(value).tolist()
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    return value


def same(one: Any, other: Any, *, exact: bool = False) -> bool:
    """Whether two plain values are equal, NaN to itself; if `exact`, 1 is neither 1.0 nor True."""
    if exact and type(one) is not type(other):
        return False
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(
            same(a, b, exact=exact) for a, b in zip(one, other, strict=True)
        )
    if isinstance(one, dict) and isinstance(other, dict):
        return one.keys() == other.keys() and all(
            same(one[key], other[key], exact=exact) for key in one
        )
    return bool(one == other or (one != one and other != other))  # noqa: PLR0124


def attributes(data: xr.Dataset) -> Iterator[tuple[str, Any]]:
    """Every attribute with its name in words, those of the variables after the Dataset's own."""
    for name, value in data.attrs.items():
        yield f"the attribute {name!r}", value
    for variable, array in data.variables.items():
        for name, value in array.attrs.items():
            yield f"the attribute {name!r} of {variable!r}", value


def difference(given: xr.Dataset, kept: xr.Dataset) -> str | None:
    """Return in words the first thing of `given` that `kept` does not hold exactly, or None.

    Text is text in whatever dtype, lists, tuples and arrays of one dimension are the same
    attribute, and byte order does not count.
    """
    mine, theirs = dict(attributes(given)), dict(attributes(kept))
    for name, value in mine.items():
        if name not in theirs:
            return f"{name} is lost: rename it"
        if not same(plain(value), plain(theirs[name]), exact=True):
            return f"{name} is {value!r} and would come back as {theirs[name]!r}"
    for variable, array in given.variables.items():
        if variable not in kept.variables or (variable in given.coords) != (
            variable in kept.coords
        ):
            return f"{variable!r} is lost: rename it"
        if not _same_array(array, kept.variables[variable]):
            return (
                f"{variable!r}, of type {array.dtype}, would come back different: "
                "give numbers, truth values or text, and no attributes that encode them"
            )
    if dict(given.sizes) != dict(kept.sizes):
        return f"sizes {dict(given.sizes)} would come back as {dict(kept.sizes)}"
    return None


def _is_text(values: np.ndarray[Any, Any]) -> bool:
    """Whether an array holds text and nothing else, in whatever dtype."""
    return values.dtype.kind in "UT" or (
        values.dtype == object and all(isinstance(value, str) for value in values.flat)
    )


def _same_array(one: xr.Variable, other: xr.Variable) -> bool:
    if one.dims != other.dims or one.shape != other.shape:
        return False
    a, b = one.to_numpy(), other.to_numpy()
    if _is_text(a):
        return _is_text(b) and a.tolist() == b.tolist()
    return a.dtype.newbyteorder("=") == b.dtype.newbyteorder("=") and np.array_equal(
        a, b, equal_nan=a.dtype.kind in "fc"
    )
