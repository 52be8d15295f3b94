"""The report: one HTML page that needs nothing else, to be read, printed, and sent with a paper."""

from __future__ import annotations

import base64
import json
import math
import re
from collections.abc import Iterable, Sequence
from html import escape
from importlib import resources
from string import Template
from urllib.parse import quote

from ..verification.cases import CASES, VERSION
from ..verification.convergence import Order
from ..verification.judgement import THRESHOLDS
from ..verification.outcomes import Finding, Outcome
from ..verification.submission import Run
from .document import Record, document

TITLE = "rotbeam judgement"
"""Beginning of each page's title, by which a page is known."""

_PIXELS = 1.75
"""Pixels to a point of a figure: its letters are then as large as the text's."""

_MARKS = {
    Outcome.REFERENCE: ("right", "✓"), Outcome.AGREES: ("right", "≈"),
    Outcome.NOT_SUBMITTED: ("open", "–"), Outcome.UNDECIDED: ("open", "?"),
    Outcome.DIFFERS: ("wrong", "≠"),
}  # fmt: skip


def report_page(record: Record) -> str:
    """Return the page as text."""
    found = record.judgement
    template = resources.files(__package__).joinpath("template.html").read_text(encoding="utf-8")
    text = json.dumps(document(record), indent=1, ensure_ascii=False)
    return Template(template).substitute(
        title=escape(f"{TITLE}: {record.name}"),
        name=escape(record.name),
        benchmark=VERSION,
        date=f"{record.date:%d %B %Y, %H:%M} UTC",
        outcome=escape(found.outcome),
        mistakes=_mistakes(record) + _faults(record),
        about=_about(record),
        outcomes=_outcomes(record),
        cases="\n".join(_case(name, record) for name in found.findings),
        runs=_runs(record),
        files=_files(record),
        versions=escape(", ".join(f"{name} {one}" for name, one in record.versions.items())),
        json_link=f"data:application/json;charset=utf-8,{quote(text)}",
    )


def _table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table of cells that are HTML already."""
    head = "".join(f"<th>{cell}</th>" for cell in header)
    body = "\n".join(f"<tr>{''.join(map(_cell, row))}</tr>" for row in rows)
    table = f"<table><thead><tr>{head}</tr></thead>\n<tbody>{body}</tbody></table>"
    return f'<div class="wide">{table}</div>'


def _cell(html: str) -> str:
    """Return a cell; text may be broken, numbers with their bars not."""
    words = ' class="text"' if re.search("[a-z]{4}", re.sub("<.*?>", "", html)) else ""
    return f"<td{words}>{html}</td>"


def _mistakes(record: Record) -> str:
    if not record.mistakes:
        return ""
    items = "".join(
        f"<li><b>{escape(one.case)}</b>: {escape(str(one))}</li>" for one in record.mistakes
    )
    return f'<section class="mistakes"><h2>A usual mistake?</h2><ul>{items}</ul></section>'


def _faults(record: Record) -> str:
    if not record.faults:
        return ""
    rows = [
        [f"<code>{escape(one.file)}</code>", str(one.line or "–"), escape(one.said)]
        for one in record.faults
    ]
    return f"<h2>Not judged</h2>{_table(['file', 'line', 'fault'], rows)}"


def _about(record: Record) -> str:
    stated = record.judgement.declaration
    link = stated.url if stated.url.startswith(("https://", "http://")) else ""
    url = f'<a href="{escape(link)}">{escape(link)}</a>' if link else escape(stated.url)
    orders = [
        f"{value:g} in {what}"
        for value, what in ((stated.order, "mesh"), (stated.order_in_step, "step"))
        if value
    ]
    tells = {
        "Authors": escape(", ".join(stated.authors)),
        "Source": url,
        "Licence": escape(stated.licence),
        "Element": escape(stated.element),
        "Compared with": escape(f"the exact {stated.theory.name} beam"),
        "Declared orders": ", ".join(orders),
        "Machine": escape(stated.machine),
        "Remarks": escape(stated.remarks),
    }
    return "".join(f"<dt>{key}</dt><dd>{text}</dd>" for key, text in tells.items() if text)


def _outcomes(record: Record) -> str:
    header = [
        "case", "quantity", "outcome", "limit − reference", "at most", "run − limit",
        "order in mesh / step, of declared", "floor", "reference ±",
    ]  # fmt: skip
    rows = [
        _outcome_row(case, quantity, found)
        for (case, quantity), found in record.judgement.by_quantity.items()
    ]
    return _table(header, rows)


def _outcome_row(case: str, quantity: str, found: Finding) -> list[str]:
    kind, mark = _MARKS[found.outcome]
    runs = found.runs
    outcome = f'<span class="{kind}">{mark} {found.said}</span>'
    if found.note and found.outcome is not Outcome.REFERENCE:
        outcome += f"<br><small>{escape(found.note)}</small>"
    limit = order = finest = floor = "–"
    if runs is not None:
        finest, floor = _number(float(runs.errors[-1])), _number(float(runs.noise[-1]), "")
        order = " / ".join(map(_order, runs.orders.values()))
        if math.isfinite(runs.limit):
            limit = f"{_number(runs.limit)} ± {_number(runs.bar, '')}"
    return [
        escape(case), quantity, outcome, limit, f"{THRESHOLDS[quantity]:g}", finest, order, floor,
        _number(found.bound, ""),
    ]  # fmt: skip


def _number(value: float, sign: str = "+") -> str:
    """Return a number of two digits, as 1.2·10⁻³; a dash where there is none."""
    if not math.isfinite(value):
        return "–"
    mantissa, power = f"{value:{sign}.1e}".split("e")
    return f"{mantissa.replace('-', '−')}·10<sup>{int(power)}</sup>".replace("<sup>-", "<sup>−")


def _order(order: Order) -> str:
    """Return an order with its bar, observed of declared."""
    if math.isnan(order.value):
        return f"<small>{escape(order.why)}</small>"
    low = " <small>(less than declared)</small>" if order.low else ""
    return f"{order} ± {order.bar:.1f}{low}"


def _case(name: str, record: Record) -> str:
    # matplotlib takes longer to import than a judgement without a report.
    from ..figures.judgement import judged_figures  # noqa: PLC0415

    found = record.judgement
    title = f"{name}: {CASES[name].title}" if name in CASES else name
    figures = "".join(_figure(*one) for one in judged_figures(name, found))
    source = escape(found.sources.get(name, "none"))
    source = f"<p><small>Reference: {source}.</small></p>"
    remarks = "".join(f"<p>{escape(said)}</p>" for said in found.remarks.get(name, []))
    return f"<section><h3>{escape(title)}</h3>{remarks}{figures}{source}</section>"


def _figure(picture: str, caption: str) -> str:
    data = base64.b64encode(picture.encode()).decode()
    width = re.search(r'width="([0-9.]+)pt"', picture)
    size = f' style="width: {_PIXELS * float(width[1]):.0f}px"' if width else ""
    return (
        f'<figure><img{size} alt="{escape(caption)}" src="data:image/svg+xml;base64,{data}">'
        f"<figcaption>{escape(caption)}</figcaption></figure>"
    )


def _runs(record: Record) -> str:
    chosen = record.judgement.findings
    runs = [run for run in record.submission.runs if run.case in chosen]
    if not runs:
        return ""
    header = [
        "file", "elements", "step [s]", "tolerance", "unknowns", "wall [s]", "CPU [s]",
        "what happened",
    ]  # fmt: skip
    rows = [_run_row(run) for run in runs]
    # What the author told of no run is no column.
    told = [k for k in range(len(header)) if any(row[k] not in {"", "–"} for row in rows)]
    rows = [[row[k] for k in told] for row in rows]
    return f"<h2>Runs</h2>{_table([header[k] for k in told], rows)}"


def _run_row(run: Run) -> list[str]:
    def told(value: float) -> str:
        return f"{value:.3g}" if math.isfinite(value) else "–"

    happened = f"failed: {run.failure}" if run.failure else run.remark
    dof = str(run.dof) if run.dof else "–"
    return [
        f"<code>{escape(run.file)}</code>", str(run.elements), told(run.step), told(run.tolerance),
        dof, told(run.wall), told(run.cpu), escape(happened),
    ]  # fmt: skip


def _files(record: Record) -> str:
    if not record.digests:
        return ""
    rows = [
        [f"<code>{escape(file)}</code>", f'<code class="digest">{digest}</code>']
        for file, digest in record.digests.items()
    ]
    return f"<h2>Files</h2>{_table(['file', 'SHA-256'], rows)}"
