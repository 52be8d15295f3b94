"""One page for each public name, written when the site is built, with the picture it draws.

The picture of a name is what the example in its docstring draws. Names without a page, of the
project's inside, lead to their source.
"""

from __future__ import annotations

import contextlib
import doctest
import io
import pkgutil
import re
from collections.abc import Iterator
from functools import cache, partial
from pathlib import Path
from typing import Any

import matplotlib as mpl
from blocks import save
from derivation import modules
from docutils import nodes
from reference_groups import DATA, page_of, public_names, role_of
from sphinx.application import Sphinx
from sphinx.pycode import ModuleAnalyzer
from sphinx.util.nodes import make_refnode

from rotbeam_exu.figures import STYLE

FOLDER = "reference/api"
"""Of the pages, below the site's root; written anew at each build."""
PACKAGES = ("analytic", "rotbeam_exu")


def page(name: str) -> str:
    """Return the text of the page of a name."""
    value, (module, _, short) = pkgutil.resolve_name(name), name.rpartition(".")
    kind = {"func": "function", "exc": "exception"}.get(role_of(name), role_of(name))
    lines = [f".. currentmodule:: {module}", f".. auto{kind}:: {short}"]
    if name in ("analytic.Beam", "analytic.Blade"):  # whose data stand in a base of their own
        lines.append("   :inherited-members:")
    text = DATA.get(name, "")
    if getattr(value, "__name__", short) != short:
        text = f"Another name of :func:`{module}.{value.__name__}`."
    if text:
        lines = [f".. py:{kind}:: {name}", "", f"   {text}"]
    return "# {}\n\n```{{eval-rst}}\n{}\n```\n".format(short, "\n".join(lines))


def write_pages(app: Sphinx) -> None:
    """Write the pages that changed, and remove those of names that are gone."""
    folder = Path(app.srcdir) / FOLDER
    folder.mkdir(exist_ok=True)
    texts = {folder / f"{page_of(name)}.md": page(name) for name in public_names()}
    for path in set(folder.glob("*.md")) - set(texts):
        path.unlink()
    for path, text in texts.items():
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")


def drawing(name: str) -> Any:
    """Return the axes that the example of a name draws, None if it draws none."""
    tests = doctest.DocTestFinder(recurse=False).find(pkgutil.resolve_name(name), name)
    source = "".join(example.source for test in tests for example in test.examples)
    if ".plot(" not in source:
        return None
    names: dict[str, Any] = {}
    with contextlib.redirect_stdout(io.StringIO()), mpl.rc_context(STYLE):
        exec(compile(source, name, "exec"), names)
    return next(value for value in names.values() if hasattr(value, "get_figure"))


def add_picture(app: Any, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    """Put what the example of a name draws beneath it."""
    del what, obj, options
    if name not in set(public_names()) or not app.config.computed_runs:
        return
    axes = drawing(name)
    if axes is not None:
        folder = Path(app.srcdir) / "_static" / "figures"
        width = save(folder, axes, name)
        lines += [
            *("", f".. image:: /_static/{folder.name}/{name}.svg"),
            *("   :alt: What the example draws", f"   :width: {width}px", ""),
        ]


def link_names(app: Any, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    """Make links of the public names that a docstring speaks of."""
    del app, what, options
    if not set(public_names()) & set(_prefixes(name)):
        return  # elsewhere the same word may name a variable
    own = getattr(obj, "__name__", "")
    for i, line in enumerate(lines):
        if not line.lstrip().startswith((">>>", "...")):
            lines[i] = re.sub(r"(?<![:`~])`(\w+)`(?!`)", partial(_link, own), line)


def _link(own: str, match: re.Match[str]) -> str:
    name = _by_short_name().get(match[1])
    return f":py:{role_of(name)}:`~{name}`" if name and match[1] != own else match[0]


@cache
def _by_short_name() -> dict[str, str]:
    # Of two with one name the first, the theory's.
    return {name.rpartition(".")[2]: name for name in reversed(list(public_names()))}


def brief_signature(
    app: Any, what: str, name: str, obj: Any, options: Any, signature: str | None, returned: Any
) -> tuple[str, str] | None:
    """Write arrays as such, and leave out how a result is made: not by its reader."""
    del app, name, options
    if what == "class" and "Parameters\n" not in (obj.__doc__ or ""):
        return "", ""
    if not signature:
        return None
    forward, array = r"TypeAliasForwardRef\('numpy\.([\w.]+)'\)", r"ndarray\[tuple.*?dtype\[\w+\]\]"
    signature, returned = (re.sub(forward, r"\1", text or "") for text in (signature, returned))
    return re.sub(array, "ndarray", signature), re.sub(array, "ndarray", returned)


@cache
def _known() -> dict[str, Path]:
    return modules(*PACKAGES)


def to_source(app: Any, env: Any, node: Any, contnode: nodes.Element) -> nodes.Node | None:
    """Link a name that has no page to its source, and the source to the page that speaks of it."""
    target = node.get("reftarget", "")
    if node.get("refdomain") != "py" or app.builder.format != "html":
        return None
    module = next((m for m in _prefixes(target) if m in _known()), None)
    if module is None:
        return None
    name = target[len(module) + 1 :]
    analyzer = ModuleAnalyzer.for_file(_known()[module], module)
    tags = analyzer.find_tags()
    if ("", name) in analyzer.find_attr_docs():
        name = ""  # of a constant no place is known, but its module
    if name and name not in tags:
        return None
    sources = vars(env).setdefault("_viewcode_modules", {})
    code = sources.setdefault(module, (analyzer.code, tags, {}, module))
    if name:
        code[2].setdefault(name, node["refdoc"])
    there = "_modules/" + module.replace(".", "/")
    return make_refnode(app.builder, node["refdoc"], there, name or None, contnode, target)


def _prefixes(name: str) -> Iterator[str]:
    while name:
        yield name
        name = name.rpartition(".")[0]


def setup(app: Sphinx) -> dict[str, Any]:
    """Connect the above."""
    app.setup_extension("sphinx.ext.autodoc")
    app.connect("builder-inited", write_pages)
    app.connect("autodoc-process-docstring", add_picture, priority=900)  # after napoleon
    app.connect("autodoc-process-docstring", link_names, priority=300)  # before all else
    app.connect("autodoc-process-signature", brief_signature)
    app.connect("missing-reference", to_source)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
