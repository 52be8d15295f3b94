"""Write the class as an executed notebook, docs/class/stiffening.ipynb: part of `make images`.

Its text and its code are those of docs/class/index.md, for readers who have no built site.
"""

from __future__ import annotations

import base64
import io
import json
import re
import sys
from pathlib import Path
from typing import Any

import matplotlib as mpl
import matplotlib.pyplot as plt

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

from docs._ext.blocks import FENCE, printed, with_directives  # noqa: E402

PAGE = ROOT / "docs" / "class" / "index.md"
NOTEBOOK = PAGE.with_name("stiffening.ipynb")
HELPERS = """import re

import matplotlib.pyplot as plt
from IPython.display import Markdown, display


def show(text):
    display(Markdown(re.sub(r"\\{[\\w:]+\\}`~?([^`]*)`", r"`\\1`", text)))


def figure(ax, name, caption):
    plt.show()
    show(f"*{caption}*")
"""
"""The first cell: what the page's blocks take from the site."""
FILM = """import numpy as np

from analytic import Beam, SpinUp, linear_response, spin_up_response
from rotbeam_exu import dataset_of, figures

motion, frames = SpinUp(omega=4.0, ramp_time=3.0), np.linspace(0.0, 6.0, 121)
places = np.linspace(0.0, 8.0, 41)
both = [
    dataset_of(response(Beam.reference(), motion, frames, points=places))
    for response in (spin_up_response, linear_response)
]
film = figures.animate(both[0], beside=both[1])
film._draw_frame(55)  # to see it move: IPython.display.HTML(film.to_jshtml())
film._draw_was_started = True
plt.show()
"""


def _prose(text: str) -> str:
    """Return Markdown that any viewer shows: without roles, and links to other pages as words."""
    text = re.sub(r"\{[\w:]+\}`~?([^`<]*?)(?: <[^`]*)?`", r"`\1`", text)
    text = re.sub(r"\[([^]]+)\]\((?!https?:)[^)]*\)", r"\1", text)
    return text.strip()


def cells() -> list[tuple[str, str]]:
    """Return the notebook's cells as (kind, source)."""
    page, found = with_directives(PAGE.read_text(encoding="utf-8")), [("code", HELPERS)]
    last = 0
    for block in FENCE.finditer(page):
        if not block[1].startswith("{"):
            continue  # a block that is read, not run
        found.append(("markdown", _prose(page[last : block.start()])))
        last = block.end()
        if block[1] == "{computed}":
            code = (
                FILM if "film(" in block[2] else re.sub(r"^print\(", "show(", block[2], flags=re.M)
            )
            found.append(("code", code))
    found.append(("markdown", _prose(page[last:])))
    title, *rest = found[1:]
    return [(kind, source.strip()) for kind, source in (title, found[0], *rest) if source.strip()]


def _output(data: dict[str, str]) -> dict[str, Any]:
    return {"output_type": "display_data", "metadata": {}, "data": data}


def executed() -> list[dict[str, Any]]:
    """Return the cells with what they show, run one after the other as a kernel does."""
    shown: list[dict[str, Any]] = []

    def show(text: str) -> None:
        shown.append(_output({"text/markdown": _prose(text)}))

    def keep() -> None:
        for number in plt.get_fignums():
            file = io.BytesIO()
            plt.figure(number).savefig(file, dpi=110, format="png")
            picture = base64.b64encode(file.getvalue()).decode()
            shown.append(_output({"image/png": picture, "text/plain": "<Figure>"}))
        plt.close("all")

    def figure(ax: Any, name: str, caption: str) -> None:
        del ax, name
        keep()
        show(f"*{caption}*")

    names: dict[str, Any] = {"show": show, "figure": figure, "plt": plt, "__name__": "notebook"}
    made: list[dict[str, Any]] = []
    for number, (kind, source) in enumerate(cells()):
        cell = {"cell_type": kind, "id": f"cell-{number}", "metadata": {}, "source": source}
        if kind == "code":
            shown.clear()
            if source != HELPERS.strip():
                printed(source, names, f"cell {number}")
                keep()
            cell |= {"execution_count": number, "outputs": list(shown)}
        made.append(cell)
    return made


def notebook() -> str:
    """Return the executed notebook as text."""
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    document = {
        "cells": executed(),
        "metadata": {"kernelspec": kernel, "language_info": {"name": "python"}},
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    return json.dumps(document, indent=1, ensure_ascii=False) + "\n"


if __name__ == "__main__":
    mpl.use("agg")
    plt.show = lambda: None  # pictures are kept after each cell
    NOTEBOOK.write_text(notebook(), encoding="utf-8")
