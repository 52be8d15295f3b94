"""The order of derivation: what is built on comes before what is built, by the code's imports."""

from __future__ import annotations

import ast
import graphlib
from collections.abc import Iterable, Iterator
from pathlib import Path

ROOT = Path(__file__).parents[2]


def modules(*packages: str) -> dict[str, Path]:
    """Return the files of all modules of the packages by their dotted names.

    A folder without __init__.py holds none: what it has is data.
    """
    return {
        _named(path): path
        for package in packages
        for path in sorted((ROOT / package.replace(".", "/")).rglob("*.py"))
        if path.with_name("__init__.py").exists()
    }


def _named(path: Path) -> str:
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def imports_of(name: str, known: dict[str, Path]) -> Iterator[str]:
    """Yield what a module imports, by absolute names, functions' own imports included."""
    path = known[name]
    package = name if path.name == "__init__.py" else name.rpartition(".")[0]
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = package.split(".")[: len(package.split(".")) - node.level + 1]
            start = ".".join([*base, *filter(None, [node.module])])
            start = start if node.level else str(node.module)
            for alias in node.names:
                whole = f"{start}.{alias.name}"
                yield whole if whole in known else start


def in_order(*packages: str, without: Iterable[str] = ()) -> list[str]:
    """Return the modules of the packages, package by package, each after those it imports."""
    known = modules(*packages)
    left_out = tuple(without)

    def group(name: str) -> str:
        depth = max(package.count(".") for package in packages if name.startswith(package)) + 2
        return ".".join(name.split(".")[:depth])

    arrows = {
        # A package that only lists what it holds is not built on by what it holds.
        name: {
            target
            for target in imports_of(name, known)
            if target in known and not f"{name}.".startswith(f"{target}.")
        }
        for name in known
    }
    groups: dict[str, set[str]] = {}
    for name, targets in arrows.items():
        groups.setdefault(group(name), set()).update(group(t) for t in targets)
    return [
        name
        for place in _sorted({r: below - {r} for r, below in groups.items()})
        for name in _sorted(
            {n: {t for t in arrows[n] if group(t) == place} for n in known if group(n) == place}
        )
        if not name.startswith(left_out or "\0")
    ]


def _sorted(graph: dict[str, set[str]]) -> list[str]:
    """Sort topologically; where imports do not say, what stands on less comes first."""
    sorter = graphlib.TopologicalSorter(graph)
    sorter.prepare()
    found: list[str] = []
    while sorter.is_active():
        ready = sorted(sorter.get_ready(), key=lambda name: (len(graph[name]), name))
        found += ready
        sorter.done(*ready)
    return found
