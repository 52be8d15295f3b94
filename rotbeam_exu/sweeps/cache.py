"""Finished cases on disk: one file each, named by its inputs and the code that made it."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Mapping
from typing import Any

from analytic.warning import warn

from ..files.results import read, save, whole_file, writable_folder
from ..files.round_trip import plain
from ..lazily import xr
from ..runs.versions import versions

_FORMAT = 2
_MARK = "rotbeam-cache.json"


class Cache:
    """A folder of results, each the pure function of a description.

    Parameters
    ----------
    folder : path
        Made if needed.
    made_by : mapping, optional
        What else than the description and the versions of libraries decides a result: its code.

    Raises
    ------
    ValueError
        If the folder was written by an incompatible version of this package.
    OSError
        If it cannot be written.
    """

    def __init__(
        self, folder: str | os.PathLike[str], *, made_by: Mapping[str, str] | None = None
    ) -> None:
        self._folder = writable_folder(folder)
        made_with = {k: v for k, v in versions().items() if k != "python"}
        self._made = {**made_with, **(made_by or {})}
        mark = self._folder / _MARK
        if mark.exists():
            try:
                found = json.loads(mark.read_text(encoding="utf-8"))["format"]
            except (ValueError, KeyError, TypeError):
                found = "unknown"
            if found != _FORMAT:
                raise ValueError(
                    f"the cache folder {self._folder} has format {found}, this version writes "
                    f"{_FORMAT}; choose another folder or remove that one"
                )
        else:
            with whole_file(mark) as partial:
                partial.write_text(json.dumps({"format": _FORMAT}), encoding="utf-8")

    def get(self, description: dict[str, Any]) -> xr.Dataset | None:
        """Return the result kept for a description, or None.

        A file that cannot be read is named in a warning and set aside, not used or lost.
        """
        name = self._name(description)
        path = self._folder / f"{name}.nc"
        if not path.exists():
            return None
        try:
            result, sealed = read(path)
            case, content = (result.attrs.pop(key, None) for key in ("case", "content"))
            if case != name:
                raise ValueError(f"{path} does not hold the case it is named after")
            if not sealed or content != _digest(result):
                raise ValueError(f"{path} was changed after it was written")
        except ValueError as error:
            aside = path.with_suffix(".damaged")
            path.replace(aside)
            warn(f"{error}; it is set aside as {aside.name} and computed again")
            return None
        return result

    def put(self, description: dict[str, Any], result: xr.Dataset) -> None:
        """Keep a result; the file is written whole or not at all."""
        name = self._name(description)
        path = self._folder / f"{name}.nc"
        try:
            save(result.assign_attrs(case=name, content=_digest(result)), path)
        except OSError as error:
            raise OSError(
                f"cannot keep a finished case in {self._folder}: {error.strerror or error}; "
                "those already there stay, make room and run again"
            ) from error

    def _name(self, description: dict[str, Any]) -> str:
        content = json.dumps({"case": description, "made": self._made}, sort_keys=True)
        return hashlib.sha256(content.encode()).hexdigest()[:32]


def _digest(result: xr.Dataset) -> str:
    """Digest of the content, apart from the file that holds it."""
    digest = hashlib.sha256(json.dumps(plain(result.attrs), sort_keys=True).encode())
    for name in sorted(map(str, result.variables)):
        variable = result[name].variable
        head = [name, variable.dims, variable.shape, variable.dtype.str, plain(variable.attrs)]
        digest.update(json.dumps(head, sort_keys=True).encode())
        digest.update(variable.to_numpy().tobytes())
    return digest.hexdigest()
