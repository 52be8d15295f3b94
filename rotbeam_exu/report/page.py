"""The report: one HTML page that needs nothing else, to be read, printed, and sent with a paper.

It has a table for a paper in LaTeX, and what to cite.
"""

from __future__ import annotations

import json
import math
import re
from importlib import resources
from importlib.util import find_spec
from typing import Any

from jinja2 import Environment, StrictUndefined
from markupsafe import Markup

from ..verification.cases import CASES, VERSION
from ..verification.convergence import Order
from ..verification.judgement import THRESHOLDS
from ..verification.outcomes import Finding, Outcome
from .document import Record, document, versions

TITLE = "rotbeam judgement"
"""Beginning of each page's title, by which a page is known."""

_DRAWS = all(find_spec(name) for name in ("matplotlib", "xarray"))
"""Whether figures can be drawn: who judges only may do without."""

_PIXELS = 1.75
"""Pixels to a point of a figure: its letters are then as large as the text's."""

_MARKS = {
    Outcome.REFERENCE: ("right", "✓"), Outcome.AGREES: ("right", "≈"),
    Outcome.NOT_SUBMITTED: ("open", "–"), Outcome.UNDECIDED: ("open", "?"),
    Outcome.DIFFERS: ("wrong", "≠"),
}  # fmt: skip


BIBTEX = rf"""@misc{{rotbeam,
  author = {{{{The rotbeam\_exu developers}}}},
  title = {{rotbeam\_exu: the rotating cantilever beam benchmark}},
  note = {{Benchmark {VERSION}}},
}}
@misc{{gonzalezcarbajal,
  author = {{Gonz{{\'a}}lez-Carbajal, J. and Rinc{{\'o}}n-Casado, A. and
    Garc{{\'i}}a-Vallejo, D. and Dom{{\'i}}nguez, J.}},
  title = {{Nonlinear solutions for the steady state oscillations of a clamped-free rotating beam}},
}}
"""
"""Entries of the benchmark and of the paper that it follows."""

_SPECIAL = {"\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}"}


def report_page(record: Record) -> str:
    """Return the page as text."""
    judgement, stated = record.judgement, record.judgement.declaration
    orders = (stated.order, "mesh"), (stated.order_in_step, "step")
    figures: dict[str, list[tuple[str, str]]] = {}
    if _DRAWS:
        # matplotlib takes longer to import than a judgement without a report.
        from ..figures.judgement import judged_figures  # noqa: PLC0415

        figures = {name: list(judged_figures(name, judgement)) for name in judgement.findings}
    return rendered(
        "template.html",
        title=f"{TITLE}: {record.name}",
        record=record,
        versions=versions(),
        judgement=judgement,
        stated=stated,
        orders=", ".join(f"{order:g} in {part}" for order, part in orders if order),
        benchmark=VERSION,
        cases=CASES,
        thresholds=THRESHOLDS,
        reference=Outcome.REFERENCE,
        quantities=[
            name for name in THRESHOLDS if any(name in of for of in judgement.findings.values())
        ],
        draws=_DRAWS,
        figures=figures,
        runs=_runs(record),
        zip=zip,
        bibtex=BIBTEX,
        latex=latex_table(record),
        json=json.dumps(document(record), indent=1, ensure_ascii=False),
    )


def rendered(name: str, **content: Any) -> str:
    """Return a page from one of the templates here; its text is escaped."""
    environment = Environment(
        autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    environment.filters |= {"number": _number, "mark": _mark, "picture": _picture}
    environment.tests["finite"] = math.isfinite
    template, style = (
        resources.files(__package__).joinpath(one).read_text(encoding="utf-8")
        for one in (name, "style.css")
    )
    return environment.from_string(template).render(style=Markup(style), **content)


def _number(value: float, sign: str = "+") -> Markup:
    """Return a number of two digits, as 1.2·10⁻³; a dash where there is none."""
    if not math.isfinite(value):
        return Markup("–")
    mantissa, power = f"{value:{sign}.1e}".split("e")
    power = f"{int(power)}".replace("-", "−")
    return Markup("{}·10<sup>{}</sup>").format(mantissa.replace("-", "−"), power)


def _mark(outcome: Outcome | Finding, words: str = "") -> Markup:
    """Return the mark of an outcome in its color, with words if there are any."""
    kind, mark = _MARKS[outcome.outcome if isinstance(outcome, Finding) else outcome]
    return Markup('<span class="{}">{}</span>').format(kind, f"{mark} {words}".strip())


def _or_dash(value: float) -> str:
    return f"{value:.3g}" if math.isfinite(value) else "–"


def _picture(drawing: str, caption: str) -> Markup:
    """Return an SVG element with letters as large as the page's, named for who cannot see it."""
    points = re.search(r'width="([0-9.]+)pt" height="[0-9.]+pt"', drawing)
    if points is None:
        raise ValueError("a figure without width and height in points cannot be set in a page")
    shown = Markup('role="img" aria-label="{}" style="width: {:.0f}px"').format(
        caption, _PIXELS * float(points[1])
    )
    return Markup(drawing.replace(points[0], shown, 1))


def _runs(record: Record) -> dict[str, list[str]]:
    """Return the columns of the table of runs; one that no run fills is left out."""
    chosen = record.judgement.findings
    runs = [run for run in record.submission.runs if run.case in chosen]
    columns = {
        "file": [run.file for run in runs],
        "elements": [str(run.elements) for run in runs],
        "step [s]": [_or_dash(run.step) for run in runs],
        "tolerance": [_or_dash(run.tolerance) for run in runs],
        "unknowns": [str(run.dof or "–") for run in runs],
        "wall [s]": [_or_dash(run.wall) for run in runs],
        "CPU [s]": [_or_dash(run.cpu) for run in runs],
        "what happened": [f"failed: {run.failure}" if run.failure else run.remark for run in runs],
    }
    return {name: of for name, of in columns.items() if set(of) - {"", "–"}}


def latex_table(record: Record) -> str:
    """Return a table of one row a case, by booktabs, with uncertainties.

    A case shows its first quantity: q(t) of a history, a frequency, or a backbone.
    """
    judgement = record.judgement
    rows = []
    for name, findings in judgement.findings.items():
        first = next(iter(findings.values()))
        runs, limit = first.runs, "--"
        if runs and math.isfinite(runs.limit):
            limit = f"{_in_latex(runs.limit)} $\\pm$ {_in_latex(runs.bar)}"
        both = [runs.orders.get(part, Order()) if runs else Order() for part in ("mesh", "step")]
        orders = [
            f"${one.value:.1f} \\pm {one.bar:.1f}$"
            if math.isfinite(one.value)
            else (one.why if one.exponential else "--")
            for one in both
        ]
        outcome, finest = str(judgement.outcome_of(name)), _in_latex(abs(first.difference))
        cells = _escaped(name), outcome, finest, limit, *orders
        rows.append(f"    {' & '.join(cells)} \\\\\n")
    return (
        "\\begin{table}\n"
        f"  \\caption{{{_escaped(record.name)}, judged by the rotating beam benchmark {VERSION}: "
        f"{_escaped(judgement.outcome)}.}}\n"
        "  \\begin{tabular}{llrrrr}\n    \\toprule\n"
        "    Case & Outcome & Finest run & Limit $-$ reference & Order, mesh & Order, step \\\\\n"
        f"    \\midrule\n{''.join(rows)}    \\bottomrule\n  \\end{{tabular}}\n\\end{{table}}\n"
    )


def _in_latex(value: float) -> str:
    if not math.isfinite(value):
        return "--"
    mantissa, power = f"{value:.1e}".split("e")
    return f"${mantissa} \\cdot 10^{{{int(power)}}}$"


def _escaped(text: str) -> str:
    """Return text that LaTeX prints as it stands."""
    return re.sub(r"[\\~^&%$#_{}]", lambda one: _SPECIAL.get(one[0], "\\" + one[0]), text)
