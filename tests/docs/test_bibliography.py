"""What is cited is in the bibliography, and the pages name those who came before."""

import re
from pathlib import Path

DOCS = Path(__file__).parents[2] / "docs"
ENTRIES = re.findall(
    r"^@\w+\{(\w+),", (DOCS / "references.bib").read_text(encoding="utf-8"), re.MULTILINE
)


def cited(page):
    found = re.findall(r"\{cite:[pt]\}`([\w,]+)`", page.read_text(encoding="utf-8"))
    return {key for keys in found for key in keys.split(",")}


def test_each_citation_has_one_entry():
    assert len(ENTRIES) == len(set(ENTRIES))
    missing = {page.name: cited(page) - set(ENTRIES) for page in DOCS.rglob("*.md")}
    assert {name: keys for name, keys in missing.items() if keys} == {}
