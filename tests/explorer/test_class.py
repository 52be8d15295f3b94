"""The ten steps of the class: each link opens the Explorer as the step says."""

import re
from pathlib import Path

import pytest

from analytic import linear_modes
from rotbeam_exu.explorer import AMPLITUDES, OMEGAS

PAGE = Path(__file__).parents[2] / "docs" / "class" / "ten_steps.md"
LINKS = re.findall(
    r'<a href="\.\./_static/explorer\.html#(\S+)" target="explorer">ω = (\S+), a = (\S+)</a>',
    PAGE.read_text(encoding="utf-8"),
)


def steps():
    return re.split(r"^## \d+\. ", PAGE.read_text(encoding="utf-8"), flags=re.MULTILINE)[1:]


def test_there_are_ten_steps_each_with_what_to_set_see_and_solve():
    assert len(steps()) == 10
    for text in steps():
        for part in ("**Set** <a href=", "**See**", "**Exercise.**", ":::{admonition} Answer"):
            assert part in text
        assert "```{computed}" in text


def test_each_link_says_where_it_leads_and_the_sliders_have_it():
    assert len(LINKS) == PAGE.read_text(encoding="utf-8").count("explorer.html#")
    for state, omega, a in LINKS:
        assert state == f"omega={omega}&amp;a={a}"
        assert min(abs(w - float(omega)) for w in OMEGAS) < 1e-9
        assert min(abs(b - float(a)) for b in AMPLITUDES) < 1e-9


def test_the_explorer_opens_there(page, beam, data):
    # ω = 3 lies between two speeds of the tests' coarser grid.
    there = [link for link in sorted(set(LINKS)) if float(link[1]) in data["omega"].to_numpy()]
    assert len(there) > 7
    for state, omega, a in there:
        # As a click does in the tab that is open already: only what is behind # changes.
        page.evaluate("state => { location.hash = state; }", state.replace("&amp;", "&"))
        page.wait_for_function(
            "([omega, a]) => document.getElementById('omega-value').textContent.startsWith(omega)"
            " && document.getElementById('amplitude-value').textContent.startsWith(a)",
            arg=[f"{float(omega):.2f}", f"{float(a):.2f}"],
        )
        first = page.locator("#rows tr").first
        assert "exact" in first.inner_text()
        shown = float(first.locator("td").first.inner_text())
        expected = linear_modes(beam, float(omega), 1).frequencies[0]
        assert shown == pytest.approx(expected, abs=6e-5)  # four decimals
