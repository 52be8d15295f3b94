"""The directive ``computed``: a page's numbers are computed when the page is built.

It runs Python and inserts the Markdown that is printed. With ``:show:`` the code is shown, and what
it prints appears beneath as it is. The blocks of a page share their names, in order. A draft
(`make docs-draft`) runs the reference alone, and shows the code in place of what others print.

In a page the directive is a comment, with what it printed below, for readers of the Markdown:
``<!-- computed`` code ``-->`` output ``<!-- until here -->``. `make pages` fills in the outputs.
The site computes them anew, and a page whose tables have another layout is an error.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import matplotlib as mpl
from blocks import continues, names, printed, refilled, with_directives
from docutils import nodes
from docutils.parsers.rst import directives
from sphinx.application import Sphinx
from sphinx.errors import ExtensionError
from sphinx.util import logging
from sphinx.util.docutils import SphinxDirective

from rotbeam_exu.figures import STYLE


class Computed(SphinxDirective):
    """Run a block; see the module."""

    has_content = True
    option_spec = {"show": directives.flag}  # noqa: RUF012  (as docutils has it)

    def run(self) -> list[nodes.Node]:
        """Return the nodes of what the block prints."""
        source, line = self.get_source_info()
        text, where = "\n".join(self.content), f"{source}:{line}"
        code = nodes.literal_block(text, text, language="python")
        # The reference only lists names, which links lead to.
        if not (self.config.computed_runs or self.env.docname.startswith("reference/")):
            return [code]
        namespace = self.env.temp_data.setdefault("computed", names(Path(self.env.srcdir)))
        try:
            with mpl.rc_context(STYLE):
                output = printed(text, namespace, where)
        except Exception as error:
            raise ExtensionError(f"{where}: {type(error).__name__}: {error}") from error
        if "show" not in self.options:
            self.env.temp_data.setdefault("printed", []).append(output)
            return self.parse_text_to_nodes(output, allow_section_headings=True)
        result = nodes.literal_block(output, output, language="text", classes=["output"])
        return [code, result] if output else [code]


def show_hidden_code(app: Sphinx, docname: str, source: list[str]) -> None:
    """Read a page with directives in place of its comments."""
    del app, docname
    source[0] = with_directives(source[0])


def compare_with_page(app: Sphinx, tree: nodes.document) -> None:
    """Warn of outputs that no longer look as the page has them, or fill them in."""
    del tree
    page = Path(app.env.doc2path(app.env.docname))
    outputs = app.env.temp_data.get("printed")
    if not outputs:
        return
    text = page.read_text("utf-8")
    filled = refilled(text, outputs)
    if app.config.fill_pages:
        page.write_text(filled, "utf-8")
    elif re.sub(r"[^|\n]", "", filled) != re.sub(r"[^|\n]", "", text):
        logging.getLogger(__name__).warning("%s: its tables have changed: make pages", page)


def mark_what_continues(app: Sphinx, tree: nodes.document) -> None:
    """Say above a block of Python that a reader needs the blocks before it, too."""
    docname = app.env.docname
    if docname.startswith(("reference/", "gallery/")):
        return
    for block in list(tree.findall(nodes.literal_block)):
        if block.get("language") == "python" and continues(block.astext()):
            note = nodes.paragraph("", "Continues the code above:", classes=["continues"])
            block.parent.insert(block.parent.index(block), note)


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the directive."""
    app.add_config_value("computed_runs", True, "env")  # whether the site computes anything
    app.add_directive("computed", Computed)
    app.add_config_value("fill_pages", False, "")
    app.connect("source-read", show_hidden_code)
    app.connect("doctree-read", compare_with_page)
    app.connect("doctree-read", mark_what_continues)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
