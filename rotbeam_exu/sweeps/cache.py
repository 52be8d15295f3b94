"""Finished cases on disk: one file each, named by its inputs and the code that made it."""

from __future__ import annotations

import dataclasses
import hashlib
import inspect
import json
import os
import sys
from collections.abc import Mapping
from modulefinder import ModuleFinder
from pathlib import Path
from types import FunctionType
from typing import Any

from analytic.warning import warn

from ..fem.elements import Formulation, formulation
from ..files.results import read, save, writable_folder
from ..lazily import xr
from ..runs.versions import versions

_OURS = ("analytic", "rotbeam_exu")


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
    OSError
        If it cannot be written.
    """

    def __init__(
        self, folder: str | os.PathLike[str], *, made_by: Mapping[str, str] | None = None
    ) -> None:
        self._folder = writable_folder(folder)
        made_with = {k: v for k, v in versions().items() if k != "python"}
        self._made = {**made_with, **(made_by or {})}

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
            if result.attrs.pop("case", None) != name:
                raise ValueError(f"{path} does not hold the case it is named after")
            if not sealed:
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
            save(result.assign_attrs(case=name), path)
        except OSError as error:
            raise OSError(
                f"cannot keep a finished case in {self._folder}: {error.strerror or error}; "
                "those already there stay, make room and run again"
            ) from error

    def _name(self, description: dict[str, Any]) -> str:
        content = json.dumps({"case": description, "made": self._made}, sort_keys=True)
        return hashlib.sha256(content.encode()).hexdigest()[:32]


def maker(element: str | Formulation) -> dict[str, str] | None:
    """Return what besides its inputs makes the result of a case: the element's class and the code.

    None if the files do not tell what the class does; see `code_of`.
    """
    cls = type(formulation(element))
    code = code_of(cls)
    return None if code is None else {"class": f"{cls.__module__}.{cls.__qualname__}", "code": code}


def code_of(cls: type) -> str | None:
    """Return a digest of both packages' files, and of those of a class and its bases.

    The files of a class are those of its package; or its module, and what that imports from the
    same folder. Any change of a file counts, that of a docstring too.

    Returns
    -------
    str or None
        None if the files do not tell what the class does: it is not on file, as in an interactive
        session; made inside of a function, whose values it may use; or patched.
    """
    names = {base: base.__module__.partition(".")[0] for base in cls.__mro__}
    bases = [base for base, name in names.items() if name not in sys.stdlib_module_names]
    if not all(map(_told_by_its_files, bases)):
        return None
    files: dict[str, bytes] = {}
    for name in {*_OURS, *(names[base] for base in bases)}:
        files |= _files(name)
    return hashlib.sha256(repr(sorted(files.items())).encode()).hexdigest()


def _told_by_its_files(cls: type) -> bool:
    if "<locals>" in cls.__qualname__:
        return False
    try:
        inspect.getsource(cls)
    except (OSError, TypeError):
        return False
    # A method from elsewhere was put there later; dataclass() makes some from a "<string>".
    here = {inspect.getsourcefile(cls), dataclasses.__file__, "<string>"}
    methods = [value for value in vars(cls).values() if isinstance(value, FunctionType)]
    return all(method.__code__.co_filename in here for method in methods)


def _files(name: str) -> dict[str, bytes]:
    """Return the files of a package; or a module, and what it imports from its folder."""
    module = sys.modules[name]
    if hasattr(module, "__path__"):
        folders = [Path(folder) for folder in module.__path__]
        files = [file for folder in folders for file in folder.rglob("*.py")]
        above = len(folders[0].parts) - 1
    else:
        own = Path(str(module.__file__))
        finder = ModuleFinder([str(own.parent)], excludes=_OURS)
        finder.run_script(str(own))
        found = [vars(part)["__file__"] for part in finder.modules.values()]
        files = [Path(file) for file in found if file]
        above = len(own.parts) - 1
    return {"/".join(file.parts[above:]): file.read_bytes() for file in files}
