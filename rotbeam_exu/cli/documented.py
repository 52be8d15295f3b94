"""What --help says of a command, read from its docstring without importing it."""

from __future__ import annotations

import inspect
import re
from pathlib import Path


def documented(command: str) -> tuple[str, tuple[str, ...]]:
    """Return what a command's docstring says ahead of its parameters, and its examples.

    The examples are the lines of the numpydoc section that begin with "$": command lines,
    each of which `tests/cli/test_examples.py` runs.
    """
    source = Path(__file__).with_name(f"{command}.py").read_text(encoding="utf-8")
    # Not by a parser: all commands' are read at each call of any, and --help is to be quick.
    (text,) = re.findall(rf'^def {command}\(.*?^    """(.*?)"""$', source, re.DOTALL | re.MULTILINE)
    said, _, rest = inspect.cleandoc(text).partition("Examples\n---")
    lines = (line.removeprefix("$ ") for line in rest.splitlines() if line.startswith("$ "))
    return said.partition("Parameters\n---")[0].strip(), tuple(lines)


def epilogue(examples: tuple[str, ...]) -> str:
    """Return examples as Markdown, each in a line of its own: two spaces break one."""
    return "Examples:\n\n" + "  \n".join(examples) if examples else ""
