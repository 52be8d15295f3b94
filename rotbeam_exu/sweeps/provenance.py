"""What code a number comes from: the source of every module that may have had a part in it."""

from __future__ import annotations

import ast
import dataclasses
import hashlib
import inspect
import site
import sys
import sysconfig
from functools import lru_cache
from importlib.machinery import ModuleSpec, PathFinder
from importlib.util import find_spec, resolve_name
from pathlib import Path
from types import FunctionType

_OURS = ("rotbeam_exu", "analytic")
_DOCUMENTED = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)


def code_of(cls: type, *modules: str) -> str | None:
    """Return a digest of the code of a class, its bases, `modules`, and all that they import.

    Followed are this project's modules, those of the package of the class, and whatever lies
    outside of the folders of installed libraries, for which their versions speak. Comments,
    docstrings, layout and what stands under ``if __name__ == "__main__":`` do not count.

    Returns
    -------
    str or None
        None if the source does not tell what the class does: it is not on file, as in an
        interactive session; made inside of a function, whose values it may use; or patched.
    """
    bases = [base for base in cls.__mro__ if base.__module__ not in sys.stdlib_module_names]
    if not all(map(_told_by_its_source, bases)):
        return None
    names = {base.__module__ for base in bases}
    packages = {name.partition(".")[0] for name in names} | set(_OURS)
    code: dict[str, str] = {}
    waiting = [*modules]
    for name in names:
        module = sys.modules[name]
        code[name], imported = _parsed(inspect.getsource(module), module.__package__ or "")
        waiting += imported
    while waiting:
        name = waiting.pop()
        if name in code or not (name.partition(".")[0] in packages or _own(name)):
            continue
        spec = _spec(name)
        if spec is None or not (spec.origin or "").endswith(".py"):
            continue
        package = name if spec.submodule_search_locations else name.rpartition(".")[0]
        source = Path(str(spec.origin)).read_text(encoding="utf-8")
        code[name], imported = _parsed(source, package)
        waiting += imported
    return hashlib.sha256(repr(sorted(code.items())).encode()).hexdigest()


def _told_by_its_source(cls: type) -> bool:
    if "<locals>" in cls.__qualname__:
        return False
    try:
        inspect.getsource(cls)
        inspect.getsource(sys.modules[cls.__module__])
    except (KeyError, OSError, TypeError):
        return False
    # A method from elsewhere was put there later; dataclass() makes some from a "<string>".
    here = {inspect.getsourcefile(cls), dataclasses.__file__, "<string>"}
    methods = [value for value in vars(cls).values() if isinstance(value, FunctionType)]
    return all(method.__code__.co_filename in here for method in methods)


@lru_cache(maxsize=256)
def _parsed(source: str, package: str) -> tuple[str, frozenset[str]]:
    """Return what importing a module runs, and the names of what it imports, at any place.

    Names imported from a module may be modules themselves: both are returned.
    """
    tree = ast.parse(source)
    tree.body = [
        node
        for node in tree.body
        if not (isinstance(node, ast.If) and ast.unparse(node.test) == "__name__ == '__main__'")
    ]
    found: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, _DOCUMENTED) and ast.get_docstring(node, clean=False) is not None:
            del node.body[0]
        if isinstance(node, ast.Import):
            found.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            name = "." * node.level + (node.module or "")
            base = resolve_name(name, package) if node.level else name
            found.update({base, *(f"{base}.{alias.name}" for alias in node.names)})
    return ast.dump(tree), frozenset(found)


def _spec(name: str) -> ModuleSpec | None:
    """Find a module without importing it or the packages around it, or return None."""
    top, *rest = name.split(".")
    try:
        spec = find_spec(top)
    except (ImportError, ValueError):
        return None
    for part in rest:
        if spec is None or not spec.submodule_search_locations:
            return None
        spec = PathFinder.find_spec(f"{spec.name}.{part}", spec.submodule_search_locations)
    return spec


@lru_cache
def _own(name: str) -> bool:
    """Whether a module is neither Python's nor an installed library's."""
    top = name.partition(".")[0]
    if top in sys.stdlib_module_names:
        return False
    spec = _spec(top)
    if spec is None or spec.origin is None:
        return False
    libraries = [sysconfig.get_path("purelib"), sysconfig.get_path("platlib")]
    libraries += [*site.getsitepackages(), site.getusersitepackages()]
    return not any(Path(spec.origin).is_relative_to(folder) for folder in libraries)
