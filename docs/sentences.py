"""Count the words of the pages, and list sentences that are too long: python docs/sentences.py."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]
_MADE = {"_build", "gallery"}  # by Sphinx
PAGES = [
    ROOT / "README.md",
    *sorted(
        page
        for page in (ROOT / "docs").rglob("*.md")
        if not _MADE & set(page.relative_to(ROOT).parts)
    ),
]
MOST_WORDS = 35
MOST_AT_THE_DOOR = 30
"""Words in a sentence of README, Home, Learn, Blades and Benchmark."""
_DOOR = (
    *("README.md", "docs/index.md", "docs/start.md", "docs/findings.md", "docs/explorer.md"),
    *("docs/class/index.md", "docs/class/ten_steps.md", "docs/codes.md", "docs/howto/own_beam.md"),
    *("docs/howto/real_blade.md", "docs/howto/section_loads.md"),
    *("docs/howto/kit.md", "docs/howto/judge.md", "docs/howto/own_element.md"),
)


def prose(text: str) -> list[str]:
    """Return the paragraphs of a page, without code, tables, headings and formulas."""
    text = re.sub(r"^<!-- computed\n.*?^<!-- until here -->$", "", text, flags=re.M | re.S)
    text = re.sub(r"^( *)(```+|~~~+).*?^\1\2 *$", "\n", text, flags=re.MULTILINE | re.DOTALL)
    text = re.sub(r"\$\$.*?\$\$", "\n\n", text, flags=re.DOTALL)
    text = re.sub(r"<!--.*?-->", "", text, flags=re.DOTALL)
    text = re.sub(r"^\s*(\||#|:{3,}|:\w+:|\(\S+\)=).*$", "\n", text, flags=re.MULTILINE)
    text = re.sub(r"^(?= *(?:[-*]|\d+\.) )", "\n", text, flags=re.MULTILINE)
    text = re.sub(r"(?:\{[\w:]+\})?`+[^`]+`+|\$[^$]+\$", "X", text)
    text = re.sub(r"!?\[([^]]*)\](?:\([^)]*\))?", r"\1", text)
    text = re.sub(r"\b(Eqs?|Figs?|Secs?|al)\.", r"\1", text)  # no end of a sentence
    parts = re.split(r"\n(?:[ \t]*\n)+", text)
    return [" ".join(part.split()) for part in parts if part.strip() and part[:4] != " " * 4]


def sentences(text: str) -> Iterator[str]:
    """Split each paragraph where a full stop is followed by something that is no small letter."""
    for paragraph in prose(text):
        yield from re.split(r"(?<=[.!?])[*)\"]*\s+(?=[^a-z\s])", paragraph)


def words(sentence: str) -> list[str]:
    """Return the parts of a sentence that have a letter or a digit."""
    return [part for part in sentence.split() if re.search(r"\w", part)]


def most_words(page: Path) -> int:
    """Return how many words a sentence of a page may have."""
    return MOST_AT_THE_DOOR if page.relative_to(ROOT).as_posix() in _DOOR else MOST_WORDS


def long_sentences(text: str, most: int = MOST_WORDS) -> list[str]:
    """Return the sentences of more than so many words."""
    return [one for one in sentences(text) if len(words(one)) > most]


if __name__ == "__main__":
    for page in PAGES:
        whole = page.read_text(encoding="utf-8")
        long = long_sentences(whole, most_words(page))
        print(f"{len(whole.split()):6d} words, {len(long)} long: {page.relative_to(ROOT)}")  # noqa: T201
        for one in long:
            print(f"    {one}")  # noqa: T201
