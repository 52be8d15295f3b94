"""The pages' own machinery: blocks are found, run in order, and become Markdown."""

import re
from pathlib import Path

import pytest

from docs._ext import blocks

EXT = Path(__file__).parents[2] / "docs" / "_ext"


def test_fenced_blocks_are_found_with_their_line():
    page = (
        "text\n\n```python\na = 1\n```\n\n"
        "```{computed}\n:show:\nprint(a)\n```\n\n```text\nno\n```\n"
    )
    assert list(blocks.fenced(page)) == [
        ("python", "a = 1\n", 4), ("{computed}", "print(a)\n", 8), ("text", "no\n", 13),
    ]  # fmt: skip


def test_blocks_share_their_names_and_print_tables(tmp_path):
    names = blocks.names(tmp_path)
    assert blocks.printed("a = 2", names, "here") == ""
    table = blocks.printed("table(['x', '|y|'], [[a, a**2]])", names, "here")
    assert table == "| x | \\|y\\| |\n| --- | --- |\n| 2 | 4 |\n"


HIDDEN = "<!-- computed\nprint('| a | b |')\n-->\n\n| a | 1 |\n\n<!-- until here -->"


def test_hidden_code_is_a_directive_for_the_site_and_a_table_for_readers_of_the_page():
    page = f"Text.\n\n{HIDDEN}\n\nMore.\n"
    directive = blocks.with_directives(page)
    assert directive.startswith("Text.\n\n```{computed}\nprint('| a | b |')\n```\n")
    assert directive.count("\n") == page.count("\n")
    (block,) = blocks.fenced(page)
    assert block == ("{computed}", "print('| a | b |')\n", 4)
    again = blocks.refilled(page, ["| a | b |\n"])
    assert again == page.replace("| a | 1 |", "| a | b |")
    drawn = "```{figure} /_static/figures/x.svg\n:alt: x\n\nA line.\n```\n<video src='x'></video>\n"
    assert "\n*Figure, on the site: A line.*\n*A film, on the site.*\n" in blocks.refilled(
        page, [drawn]
    )


def test_pages_hide_their_code_and_have_what_it_printed():
    pages = [
        one for one in (EXT.parent).rglob("*.md") if not {"_build", "reference"} & {*one.parts}
    ]
    texts = [one.read_text(encoding="utf-8") for one in pages]
    assert sum(text.count("<!-- computed\n") for text in texts) > 90
    for page, text in zip(pages, texts, strict=True):
        assert not re.search(r"^```\{computed\}\n(?!:show:)", text, re.MULTILINE), page
        assert "-->\n\n\n\n<!-- until" not in text, page


def test_a_block_that_takes_names_from_others_continues_them():
    alone = "import numpy as np\nfrom a.b import c as d\n\n\ndef f(x):\n    return np.sin(x) + d\n"
    assert not blocks.continues(alone + "print([f(y) for y in range(3)])\n")
    assert blocks.continues(alone + "print(f(beam))\n")
    assert blocks.continues("beam = beam.with_twist(0.1)\nprint(beams)\n")


def test_a_warning_in_a_block_is_an_error(tmp_path):
    with pytest.raises(UserWarning, match="careful"):
        blocks.printed("import warnings; warnings.warn('careful')", blocks.names(tmp_path), "here")


def test_the_directive_inserts_what_is_printed_and_names_a_block_that_fails(tmp_path):
    pytest.importorskip("sphinx", reason="the group `docs` is not installed")
    pytest.importorskip("myst_parser", reason="the group `docs` is not installed")
    from sphinx.errors import ExtensionError
    from sphinx.testing.util import SphinxTestApp

    (tmp_path / "conf.py").write_text(
        f"import sys\nsys.path.insert(0, {str(EXT)!r})\nextensions = ['computed', 'myst_parser']\n"
    )
    page = tmp_path / "index.md"
    page.write_text(
        "# Page\n\n```{computed}\nn = 6\nprint(f'**{n * 7}**')\n```\n\n"
        "```{computed}\n:show:\nprint(n + 1)\n```\n"
    )
    app = SphinxTestApp(srcdir=tmp_path, warningiserror=True)
    try:
        app.build()
        html = (tmp_path / "_build" / "html" / "index.html").read_text()
        assert "<strong>42</strong>" in html
        assert '<span class="mi">1</span>' in html
        assert ">7\n" in html
        assert html.count("Continues the code above:") == 1
        page.write_text("# Page\n\n```{computed}\n1 / 0\n```\n")
        app.config.computed_runs = False
        app.build()
        drafted = (tmp_path / "_build" / "html" / "index.html").read_text()
        assert '<span class="mi">1</span> <span class="o">/</span>' in drafted, "not run but shown"
        app.config.computed_runs = True
        page.write_text("# Page\n\n" + HIDDEN.replace("| a | 1 |", "| a |") + "\n")
        app.build()
        assert "its tables have changed: make pages" in app.warning.getvalue()
        app.config.fill_pages = True
        page.write_text("# A page\n\n" + HIDDEN + "\n")
        app.build()
        assert "| a | b |\n\n<!-- until" in page.read_text()
        page.write_text("# Page\n\n```{computed}\n2 / 0\n```\n")
        with pytest.raises(ExtensionError, match=r"index\.md:.*ZeroDivisionError"):
            app.build()
    finally:
        app.cleanup()
