"""The code that a number comes from, as a digest of files."""

from __future__ import annotations

import dataclasses
import hashlib
import inspect
import sys
from modulefinder import ModuleFinder
from pathlib import Path
from types import FunctionType

_OURS = ("analytic", "rotbeam_exu")


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
