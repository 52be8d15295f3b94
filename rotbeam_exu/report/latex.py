"""A judgement as a table for a paper, with what to cite."""

from __future__ import annotations

import math
import re

from ..verification.cases import VERSION
from ..verification.convergence import Order
from ..verification.outcomes import Finding
from .document import Record

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


def latex_table(record: Record) -> str:
    """Return a table of one row a case, by booktabs, with uncertainties.

    A case shows its first quantity: q(t) of a history, a frequency, or a backbone.
    """
    found = record.judgement
    rows = []
    for name, findings in found.findings.items():
        first = next(iter(findings.values()))
        orders = first.runs.orders if first.runs else {}
        cells = (
            _escaped(name), str(found.outcome_of(name)), _number(abs(first.difference)),
            _limit(first), _order(orders.get("mesh")), _order(orders.get("step")),
        )  # fmt: skip
        rows.append(f"    {' & '.join(cells)} \\\\\n")
    return (
        "\\begin{table}\n"
        f"  \\caption{{{_escaped(record.name)}, judged by the rotating beam benchmark {VERSION}: "
        f"{_escaped(found.outcome)}.}}\n"
        "  \\begin{tabular}{llrrrr}\n    \\toprule\n"
        "    Case & Outcome & Finest run & Limit $-$ reference & Order, mesh & Order, step \\\\\n"
        f"    \\midrule\n{''.join(rows)}    \\bottomrule\n  \\end{{tabular}}\n\\end{{table}}\n"
    )


def _limit(found: Finding) -> str:
    if found.runs is None or not math.isfinite(found.runs.limit):
        return "--"
    return f"{_number(found.runs.limit)} $\\pm$ {_number(found.runs.bar)}"


def _order(order: Order | None) -> str:
    if order is None or math.isnan(order.value):
        return "--"
    return f"${order.value:.1f} \\pm {order.bar:.1f}$"


def _number(value: float) -> str:
    if not math.isfinite(value):
        return "--"
    mantissa, power = f"{value:.1e}".split("e")
    return f"${mantissa} \\cdot 10^{{{int(power)}}}$"


def _escaped(text: str) -> str:
    """Return text that LaTeX prints as it stands."""
    return re.sub(r"[\\~^&%$#_{}]", lambda one: _SPECIAL.get(one[0], "\\" + one[0]), text)
