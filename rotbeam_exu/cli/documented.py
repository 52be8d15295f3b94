"""What --help says of a command, read from its docstring without importing it."""

from __future__ import annotations

import ast
from pathlib import Path


def documented(command: str) -> tuple[str, tuple[str, ...]]:
    """Return what a command's docstring says ahead of its parameters, and its examples.

    The examples are the lines of the numpydoc section that begin with "$": command lines,
    each of which `tests/cli/test_examples.py` runs.
    """
    tree = ast.parse(Path(__file__).with_name(f"{command}.py").read_text(encoding="utf-8"))
    functions = (node for node in tree.body if isinstance(node, ast.FunctionDef))
    (text,) = (ast.get_docstring(node) for node in functions if node.name == command)
    said, _, rest = (text or "").partition("Examples\n---")
    lines = (line.removeprefix("$ ") for line in rest.splitlines() if line.startswith("$ "))
    return said.partition("Parameters\n---")[0].strip(), tuple(lines)


def epilogue(examples: tuple[str, ...]) -> str:
    """Return examples as Markdown, each in a line of its own: two spaces break one."""
    return "Examples:\n\n" + "  \n".join(examples) if examples else ""
