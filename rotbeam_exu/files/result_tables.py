"""Tables of a result: one for each set of dimensions, and frequencies in a column per mode."""

from __future__ import annotations

from typing import Any

from ..lazily import xr


def tables_of(data: xr.Dataset) -> dict[str, Any]:
    """Return the DataFrames of a result by name, units in their titles.

    A frequency over speed and mode is there twice, the second time with a column per mode.
    """
    wide: Any
    tables = {}
    for name, part in parts(data).items():
        titles = {one: title(part[one]) for one in part.variables}
        tables[name] = frame(part).rename(columns=titles)
        if part[name].dims == ("omega", "mode") and len(part.data_vars) == 1:
            unit = titles[name].removeprefix(name)
            wide = part[name].to_pandas().rename(columns=lambda mode, unit=unit: f"{mode}{unit}")
            tables[f"{name}-wide"] = wide.reset_index().rename(columns=titles)
    return tables


def parts(data: xr.Dataset) -> dict[str, xr.Dataset]:
    """Return the part of each set of dimensions, by the name of its first variable."""
    groups: dict[tuple[str, ...], list[str]] = {}
    for name, variable in data.data_vars.items():
        groups.setdefault(tuple(map(str, variable.dims)), []).append(str(name))
    return {names[0]: data[names] for names in groups.values()}


def frame(part: xr.Dataset) -> Any:
    """Return the DataFrame of variables over the same dims, its first columns; or one row."""
    if part.sizes:
        return part.to_dataframe().reset_index()
    return part.expand_dims("row").to_dataframe().reset_index(drop=True)


def title(array: xr.DataArray) -> str:
    """Return the name of a variable with its unit, if it has one."""
    units = array.attrs.get("units", "")
    return str(array.name) if units in ("", "1") else f"{array.name} [{units}]"
