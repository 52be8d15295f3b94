"""A row of LaTeX for the author's paper."""

from __future__ import annotations

import math
import re

from ..verification.cases import VERSION
from ..verification.judgement import Judgement
from ..verification.outcomes import Finding, Outcome

_SYMBOLS = {
    "linear frequency": r"$\omega_n$", "history": "$q(t)$", "amplitude": "$a$",
    "nonlinear shift": r"$\omega_{NL}/\omega_n-1$", "backbone": r"$\omega_{NL}/\omega_n-1$",
}  # fmt: skip
_SPECIAL = {
    "\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}",
    **{letter: f"\\{letter}" for letter in "&%$#_{}"},
}  # fmt: skip
_MARKS = {Outcome.ANOTHER_LIMIT: r"$^\ast$", Outcome.NO_LIMIT: r"$^\dagger$"}


def latex_row(judgement: Judgement) -> str:
    """Return a row of a table: limit less reference of each quantity; its columns as a comment."""
    found = judgement.by_quantity
    titles = [f"{case} {_SYMBOLS[quantity]}" for case, quantity in found]
    declaration = judgement.declaration
    code = _escaped(f"{declaration.code} {declaration.version}".strip())
    cells = [code, _escaped(declaration.theory.name), *map(_cell, found.values())]
    return "\n".join(
        [
            f"% rotbeam benchmark {VERSION}, self-judged: limit less reference, relative;",
            r"% $^\ast$ converges to another limit, $^\dagger$ does not converge, ? no verdict",
            f"% {' & '.join(['code', 'theory', *titles])} \\\\",
            f"{' & '.join(cells)} \\\\",
        ]
    )


def _cell(found: Finding) -> str:
    if found.outcome is Outcome.NOT_SUBMITTED:
        return "--"
    mark = _MARKS.get(found.outcome, "")
    if found.outcome is Outcome.NO_VERDICT:
        return "?"
    value = found.model_difference
    return f"{_number(value)}{mark}" if math.isfinite(value) else f"--{mark}"


def _number(value: float) -> str:
    mantissa, power = f"{value:.0e}".split("e")
    return rf"${mantissa}\times 10^{{{int(power)}}}$"


def _escaped(text: str) -> str:
    return re.sub(r"[\\~^&%$#_{}]", lambda match: _SPECIAL[match[0]], text)
