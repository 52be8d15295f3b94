"""Code in the pages: found in Markdown, and run with what it prints kept."""

from __future__ import annotations

import ast
import builtins
import contextlib
import io
import re
import warnings
from collections.abc import Iterable, Iterator
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

FENCE = re.compile(r"^```(\S+)[^\n]*\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_HIDDEN = re.compile(
    r"^<!-- computed\n(.*?)^-->\n(.*?)^<!-- until here -->$", re.MULTILINE | re.DOTALL
)
"""Code that a reader of the Markdown does not see, and what it printed."""


class Block(NamedTuple):
    """A fenced block: its language, its text without options, and its first line in the page."""

    language: str
    text: str
    line: int


def with_directives(markdown: str) -> str:
    """Return a page with the directive ``computed`` for hidden code and what it printed."""

    def directive(match: re.Match[str]) -> str:
        block = f"```{{computed}}\n{match[1]}```"
        return block + "\n" * (match[0].count("\n") - block.count("\n"))

    return _HIDDEN.sub(directive, markdown)


def _viewable(output: str) -> str:
    """Return printed Markdown for viewers that know neither figures nor films of the site."""
    text = re.sub(
        r"^```\{figure\}.*?\n\n(.*?)\n```$", r"*Figure, on the site: \1*", output.strip(),
        flags=re.MULTILINE | re.DOTALL,
    )  # fmt: skip
    text = re.sub(r"<(?:video|img) .*", "*A film, on the site.*", text)
    return re.sub(r"^:::+.*\n?", "", text, flags=re.MULTILINE)


def refilled(markdown: str, outputs: Iterable[str]) -> str:
    """Return a page whose hidden code has printed these outputs."""
    each = iter(outputs)
    return _HIDDEN.sub(
        lambda match: (
            f"<!-- computed\n{match[1]}-->\n\n{_viewable(next(each))}\n\n<!-- until here -->"
        ),
        markdown,
    )


def fenced(markdown: str) -> Iterator[Block]:
    """Yield the fenced blocks of a page, ``{computed}`` ones and hidden code included."""
    for match in FENCE.finditer(with_directives(markdown)):
        text = re.sub(r"\A(:\w+:.*\n)+\n?", "", match[2])
        yield Block(match[1], text, markdown.count("\n", 0, match.start(2)) + 1)


def continues(text: str) -> bool:
    """Return whether a block takes names from the blocks above it."""
    parts = list(ast.walk(ast.parse(text)))
    names = [one for one in parts if isinstance(one, ast.Name)]
    own = {one.id for one in names if not isinstance(one.ctx, ast.Load)} | set(dir(builtins))
    for one in parts:
        if isinstance(one, ast.alias):
            own.add((one.asname or one.name).partition(".")[0])
        elif isinstance(one, ast.FunctionDef | ast.ClassDef):
            own.add(one.name)
        elif isinstance(one, ast.arg):
            own.add(one.arg)
    return not {one.id for one in names} <= own


def table(header: Iterable[object], rows: Iterable[Iterable[object]]) -> None:
    """Print a Markdown table; a pipe within a cell is escaped."""
    lines = [list(header), *map(list, rows)]
    lines.insert(1, ["---"] * len(lines[0]))
    for line in lines:
        print("| " + " | ".join(str(cell).replace("|", "\\|") for cell in line) + " |")  # noqa: T201


def save(folder: Path, axes: Any, name: str) -> int:
    """Save the figure of `axes` in `folder`, and return its width [px] on a page."""
    folder.mkdir(parents=True, exist_ok=True)
    root = axes.get_figure(root=True)
    root.savefig(folder / f"{name}.svg")
    width = round(115 * root.get_figwidth())  # the drawings' letters as large as the text's
    root.clear()
    return width


def figure(folder: Path, axes: Any, name: str, caption: str) -> None:
    """Save the figure of `axes` in `folder`, below the pages' _static, and print its Markdown."""
    width = save(folder, axes, name)
    text = " ".join(caption.split())
    source, brief = f"/_static/{folder.name}/{name}.svg", text.split(". ")[0]
    print(f"```{{figure}} {source}\n:alt: {brief}\n:width: {width}px\n\n{text}\n```")  # noqa: T201


def film(pages: Path, source: str, words: str, poster: str = "") -> None:
    """Print a film that can be stopped; where no ffmpeg made it, the moving picture.

    With a poster only that picture is loaded before the film is played.
    """
    if (pages / f"{source.lstrip('./')}.mp4").exists():
        still = f'preload="none" poster="{poster}" ' if poster else ""
        print(  # noqa: T201
            f'<video controls muted loop playsinline width="640" aria-label="{words}" '
            f'{still}src="{source}.mp4"></video>\n'
        )
    else:
        print(f'<img src="{source}.gif" alt="{words}">\n')  # noqa: T201


def names(pages: Path) -> dict[str, Any]:
    """Return what the blocks of a page in the folder `pages` start with."""
    return {
        "__name__": "page",
        "pages": pages,
        "table": table,
        "figure": partial(figure, pages / "_static" / "figures"),
        "film": partial(film, pages),
        "cache": pages / "_build" / "runs",
    }


def printed(text: str, namespace: dict[str, Any], where: str) -> str:
    """Run a block in `namespace` and return what it prints; a warning is an error."""
    out = io.StringIO()
    with contextlib.redirect_stdout(out), warnings.catch_warnings():
        warnings.simplefilter("error")
        # Not with this module's own __future__ imports: a reader's script has none.
        exec(compile(text, where, "exec", dont_inherit=True), namespace)
    return out.getvalue()
