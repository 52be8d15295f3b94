"""Pages, docstrings and messages are plain English: short sentences, and the words of the field."""

import ast
import re
from itertools import chain

import pytest

from docs.sentences import MOST_WORDS, PAGES, ROOT, long_sentences, most_words, prose, words

# One's own word: what the field says.
OWN_WORDS = {
    r"bars?": "uncertainty", r"beside": "compared with, next to, near",
    r"held against": "compared with", r"tells?|told": "shows, determines, reports",
    r"truths?": "reference solution", r"what is left": "residual vibration", r"the pull": "tension",
    r"ours (?:is|are)": "we, this package",
    r"leaves? (?:nothing|almost nothing|least|less)": "the residual amplitude is ...",
    r"fl(?:y|ies) apart": "diverges",
    r"colour\w*|fibres?|licence|behaviour|centre\w*|grey|\w*metres?": "American spelling",
    r"judgement\w*|neighbour\w*|modelled|labelled": "American spelling",
}  # fmt: skip


def own_words(text):
    return [
        f"{found[0]} (say: {better}): {found.string[max(0, found.start() - 40) : found.end() + 40]}"
        for paragraph in prose(text)
        for pattern, better in OWN_WORDS.items()
        for found in re.finditer(rf"\b(?:{pattern})\b", paragraph, re.IGNORECASE)
    ]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_sentences_are_short_and_in_the_words_of_the_field(page):
    text = page.read_text(encoding="utf-8")
    assert long_sentences(text, most_words(page)) == []
    assert own_words(text) == []


CODE = sorted(
    chain.from_iterable((ROOT / room).rglob("*.py") for room in ("analytic", "rotbeam_exu"))
)
SAID = {"warn", "print_text"}
# Names of the interface, and bars that are drawn.
NAMES = {
    r"bars?": 7,
    r"colour\w*|fibres?|licence|behaviour|centre\w*|grey|\w*metres?": 4,
}


def docstrings(tree):
    kinds = ast.Module | ast.ClassDef | ast.FunctionDef
    return filter(
        None, (ast.get_docstring(one) for one in ast.walk(tree) if isinstance(one, kinds))
    )


def messages(tree):
    """Return the words of errors, warnings and prints: all their constant strings."""
    for one in ast.walk(tree):
        called = one.func if isinstance(one, ast.Call) else None
        name = getattr(called, "attr", getattr(called, "id", ""))
        if name.endswith(("Error", "Warning")) or name in SAID:
            parts = (part.value for part in ast.walk(one) if isinstance(part, ast.Constant))
            yield " ".join(part for part in parts if isinstance(part, str))


def spoken(text):
    """Return a docstring without examples, code, options and the names of parameters."""
    lines = [
        line
        for line in text.splitlines()
        if not re.match(r"\s*(>>>|\.\.\. |\$ |\w[\w, ]* : |\w+(, \w+)*$)", line)
    ]
    return re.sub(r"`[^`]*`|--\w+", "X", " ".join(lines))


@pytest.fixture(scope="module")
def said():
    trees = [ast.parse(file.read_text(encoding="utf-8")) for file in CODE]
    return [spoken(text) for tree in trees for text in chain(docstrings(tree), messages(tree))]


@pytest.mark.parametrize("pattern", OWN_WORDS)
def test_docstrings_and_messages_have_the_words_of_the_field(said, pattern):
    found = [
        text[max(0, hit.start() - 40) : hit.end() + 40]
        for text in said
        for hit in re.finditer(rf"\b(?:{pattern})\b", text, re.IGNORECASE)
    ]
    assert len(found) <= NAMES.get(pattern, 0), found


# Verbs that do the work of ten, and nouns that are saved: counts that may only fall.
HABITS = {
    r"that of|those of": 128, r"has|have": 420, r"takes?|took|taken": 165,
    r"leaves?|left": 154, r"holds?|held": 56, r"refuses?|refused": 106,
}  # fmt: skip


@pytest.mark.parametrize("pattern", HABITS)
def test_habits_in_docstrings_and_messages_only_fall(said, pattern):
    found = sum(len(re.findall(rf"\b(?:{pattern})\b", text, re.IGNORECASE)) for text in said)
    assert found <= HABITS[pattern]


def test_both_can_fail():
    code = "```text\n" + "word " * 36 + "\n```\n"
    formula = "$$\n" + "x + " * 36 + "y\n$$\n"
    allowed = "Word " + "word " * 34 + "end"
    assert len(words(allowed)) == MOST_WORDS + 1
    assert long_sentences(f"{code}\n{formula}\n| {'cell ' * 36} |\n\nShort. Also short.") == []
    assert long_sentences(f"- item\n- {allowed}.") == [f"- {allowed}."]
    assert most_words(ROOT / "README.md") < most_words(ROOT / "docs" / "gotchas.md")
    assert own_words("The `bar` of $bar$ and barely.") == []
    assert len(own_words("The bars are held\nagainst the truth, in metres.")) == 4


def cited(page):
    found = re.findall(r"\{cite:[pt]\}`([\w,]+)`", page.read_text(encoding="utf-8"))
    return {key for keys in found for key in keys.split(",")}


def test_each_citation_has_one_entry_and_each_entry_its_source():
    bibliography = (ROOT / "docs" / "references.bib").read_text(encoding="utf-8")
    entries = re.findall(r"^@\w+\{(\w+),\n(.*?)^\}$", bibliography, re.MULTILINE | re.DOTALL)
    keys = {key for key, _ in entries}
    assert len(entries) == len(keys)
    pages = [page for page in (ROOT / "docs").rglob("*.md") if "_build" not in page.parts]
    missing = {page.name: cited(page) - keys for page in pages}
    assert {name: one for name, one in missing.items() if one} == {}
    paper = (ROOT / "paper" / "paper.md").read_text(encoding="utf-8")
    in_paper = set(re.findall(r"(?<=@)\w+", paper))
    assert keys == in_paper.union(*map(cited, pages)) & keys
    assert in_paper <= keys
    for key, fields in entries:
        assert re.search(r"^ +(doi|seen) = \{\S", fields, re.MULTILINE), key
        # A field that was not seen is left out, and not excused.
        assert not re.search(r"^ +seen = .*\bnot\b", fields, re.MULTILINE), key
        # What is shown to a reader is known.
        shown = re.sub(r"^ +seen = .*$", "", fields, flags=re.MULTILINE)
        assert not re.search(r"from memory|not (seen|known)", shown), key
        assert not re.search(r"doi = \{(?!10\.)", fields), key
