"""The badge, an SVG of one line: which cases, what was found, and that the author judged."""

from __future__ import annotations

from html import escape

from ..verification.cases import VERSION
from ..verification.judgement import Judgement
from ..verification.outcomes import Outcome

_WORDS = {
    Outcome.REFERENCE: ("converges", "#1a7f37"),
    Outcome.NOT_SUBMITTED: ("not submitted", "#57606a"),
    Outcome.NO_VERDICT: ("no verdict", "#57606a"),
    Outcome.ANOTHER_LIMIT: ("converges to another limit", "#9a6700"),
    Outcome.NO_LIMIT: ("does not converge", "#b3261e"),
}
_LETTER = 6.4
"""Mean width of a letter [px]; the text is fitted to it."""


def badge(judgement: Judgement) -> str:
    """Return the badge, an SVG that needs no font and no network.

    It tells of the worst outcome, and of the cases where that was found.
    """
    outcomes = {case: judgement.outcome_of(case) for case in judgement.findings}
    worst = max(outcomes.values(), key=list(Outcome).index, default=Outcome.NOT_SUBMITTED)
    word, color = _WORDS[worst]
    cases = ", ".join(case for case, outcome in outcomes.items() if outcome is worst)
    left, right = f"rotbeam {VERSION} {cases}".strip(), f"{word} (self-judged)"
    widths = [round(_LETTER * len(text)) + 14 for text in (left, right)]
    title = escape(f"{left}: {right}")
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{sum(widths)}" height="20" role="img" '
        f'aria-label="{title}"><title>{title}</title>'
        f'<rect width="{sum(widths)}" height="20" rx="3" fill="#30363d"/>'
        f'<rect x="{widths[0]}" width="{widths[1]}" height="20" rx="3" fill="{color}"/>'
        f'<rect x="{widths[0]}" width="4" height="20" fill="{color}"/>'
        '<g fill="#fff" font-family="Verdana,DejaVu Sans,sans-serif" font-size="11">'
        f"{_text(7, widths[0] - 14, left)}{_text(widths[0] + 7, widths[1] - 14, right)}</g></svg>"
    )


def _text(x: int, width: int, text: str) -> str:
    return f'<text x="{x}" y="14" textLength="{width}">{escape(text)}</text>'
