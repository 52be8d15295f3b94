"""What is shown of a judgement: whole, self-contained, and nothing that an author wrote runs."""

import json
import math
import re
from dataclasses import replace
from datetime import UTC, datetime
from html.parser import HTMLParser
from pathlib import Path

import pytest

from rotbeam_exu.report import page as page_room
from rotbeam_exu.report.document import SCHEMA, Record, document
from rotbeam_exu.report.page import TITLE, latex_table, report_page
from rotbeam_exu.verification.judgement import judged
from rotbeam_exu.verification.mistakes import mistakes_in
from rotbeam_exu.verification.outcomes import Outcome

HOSTILE = "<script>alert('ω & \"x\"')</script> $d {e}"
VOID = {"meta", "img", "br"}


def recorded(submission, **options):
    found = judged(submission)
    return Record(
        submission=submission, judgement=found, mistakes=tuple(mistakes_in(submission, found)),
        digests={"S1/m008_h1e-3.csv": "0" * 64}, date=datetime(2026, 11, 21, 12, 0, tzinfo=UTC),
        **options,
    )  # fmt: skip


@pytest.fixture(scope="module")
def right(submitted):
    return recorded(submitted(machine="one core", url="https://example.org", authors=("A", "B")))


@pytest.fixture(scope="module")
def wrong(submitted):
    return recorded(submitted(lambda q: -q, code=HOSTILE, remarks=HOSTILE, machine=HOSTILE))


@pytest.fixture(scope="module")
def pages(right, wrong):
    return {"right": report_page(right), "wrong": report_page(wrong)}


def test_tolerances_stand_where_steps_do(right, pages, monkeypatch):
    """A column that no run has is left out."""
    monkeypatch.setattr(page_room, "_DRAWS", False)
    fixed = right.submission
    runs = [replace(run, step=math.nan, tolerance=run.step) for run in fixed.runs]
    record = recorded(replace(fixed, runs=tuple(runs)))
    page, data = report_page(record), document(record)
    assert "<th>tolerance</th>" in page
    assert "<th>step [s]</th>" in pages["right"]
    assert "<th>step [s]</th>" not in page
    assert {one["step"] for one in data["cases"]["S1"]["runs"]} == {None}
    told = {one["tolerance"] for one in data["cases"]["S1"]["runs"]}
    assert told == {one.step for one in fixed.runs}
    assert runs[0].step_in_words == f"tol {fixed.runs[0].step:g}"


class Page(HTMLParser):
    """Tags that are open, and everything that a page names."""

    def __init__(self, text):
        super().__init__()
        self.open, self.seen, self.named, self.text = [], [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.seen.append(tag)
        self.named += [value for name, value in attrs if name in ("src", "href")]
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text.append(data)


@pytest.mark.parametrize("which", ["right", "wrong"])
def test_the_page_needs_nothing_else_and_is_whole(pages, which):
    page = Page(pages[which])
    assert page.open == []
    assert not {"script", "link", "iframe"} & set(page.seen)
    assert all(link.startswith(("data:", "https://example.org")) for link in page.named)
    assert page.seen.count("figure") == 3  # L, the history of S1, its errors
    assert re.findall('download="(.*?)"', pages[which]) == ["judgement.json"]


def test_the_page_tells_what_was_found(pages):
    text = " ".join(Page(pages["right"]).text)
    for said in (
        TITLE, "Mine", "2 of 26 agree, 24 not submitted", "self-judged", "21 November 2026",
        "one core", "A, B", "S1/m016_h5e-4.csv", "0" * 64, "went on", "rotbeam_exu 0.1.0",
        "linear frequency", "nonlinear shift", "2.0 of 2", "the exact Bernoulli-Euler beam",
    ):  # fmt: skip
        assert said in text, said
    assert "A usual mistake?" not in text
    assert "<dt>Declared orders</dt><dd>2 in mesh, 2 in step</dd>" in pages["right"]


def test_what_an_author_writes_is_text(pages, wrong):
    text = "".join(Page(pages["wrong"]).text)
    assert HOSTILE in text
    assert "A usual mistake?" in text
    assert "q has the wrong sign" in text
    assert "differs" in text


def test_the_matrix_has_what_was_submitted_and_a_line_names_the_rest(pages, right):
    outcomes = pages["right"].split("<h2>Outcomes</h2>")[1].split("<h2>")[0]
    rows = re.findall(r"<tr><td>.*?</td><td>(.*?)</td>", outcomes)
    assert rows == ["L", "S1"]
    (missing,) = re.findall("Not submitted, and without effect: (.*?)\\.<", outcomes)
    assert missing.split(", ") == [one for one in right.judgement.asked if one not in rows]


def test_the_table_for_a_paper_has_a_row_for_each_case(right, wrong):
    rows = [line for line in latex_table(right).splitlines() if line.endswith("\\\\")]
    assert [row.split("&")[0].strip() for row in rows] == ["Case", "L", "S1"]
    limit = right.judgement.findings["S1"]["history"].runs
    mantissa, power = f"{limit.bar:.1e}".split("e")
    assert f"$\\pm$ ${mantissa} \\cdot 10^{{{int(power)}}}$" in rows[2]
    assert "2.0 \\pm" in rows[2]
    assert r"""<script>alert('ω \& "x"')</script> \$d \{e\}""" in latex_table(wrong)


def test_the_document_is_json_and_says_all(right):
    made = document(right)
    text = json.dumps(made, allow_nan=False)
    again = json.loads(text)
    assert again["schema"] == SCHEMA
    assert again["passed"] is True
    assert again["self_judged"] is True
    assert again["date"] == "2026-11-21T12:00:00+00:00"
    history = again["cases"]["S1"]["quantities"]["history"]
    found = right.judgement.findings["S1"]["history"]
    assert history["model_difference"] == found.runs.limit
    assert history["errors"] == found.runs.errors.tolist()
    assert history["outcome"] == "converges to the reference"
    assert len(again["cases"]["S1"]["runs"]) == 5
    assert again["cases"]["S1"]["runs"][0]["difference"] == pytest.approx(0.1 / 64 + 1e-4, rel=1e-2)
    theory = {"extension": True, "shear": None, "engesser": False, "rotary_inertia": False}
    assert again["declaration"]["theory"] == {**theory, "trapeze": True}


def test_every_key_of_the_document_is_documented(right):
    text = (Path(__file__).parents[2] / "docs" / "howto" / "judge.md").read_text("utf-8")
    documented = set(re.findall(r"`(\w+)`", text))

    def keys(value):
        if isinstance(value, dict):
            for key, one in value.items():
                yield key
                yield from keys(one)
        elif isinstance(value, list):
            for one in value:
                yield from keys(one)

    free = {"L", "S1", "S1/m008_h1e-3.csv", "linear frequency", "nonlinear shift", "python",
            "numpy", "scipy", "xarray", "rotbeam_exu"}  # fmt: skip
    assert set(keys(document(right))) - free <= documented


def test_what_was_not_measured_is_shown_all_the_same(submitted):
    """A single run, no declared order, no times: no limit, and no figure of one."""
    whole = submitted()
    run = replace(whole.runs[0], wall=math.nan, cpu=math.nan, dof=None)
    alone = replace(
        whole, rows=(), runs=(run,),
        declaration=replace(whole.declaration, order=None, order_in_step=None),
    )  # fmt: skip
    record = recorded(alone)
    assert record.judgement.outcome_of("S1") is Outcome.UNDECIDED
    page = Page(report_page(record))
    assert page.seen.count("figure") == 1
    assert "undecided" in "".join(page.text)
    assert document(record)["cases"]["S1"]["quantities"]["history"]["bar"] is None
