"""The ten steps of the class: each link opens the Explorer as the step says."""

import re
from pathlib import Path

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
        assert "<!-- computed" in text


def test_each_link_says_where_it_leads_and_the_sliders_have_it():
    assert len(LINKS) == PAGE.read_text(encoding="utf-8").count("explorer.html#")
    for state, omega, a in LINKS:
        assert state == f"omega={omega}&amp;a={a}"
        assert min(abs(w - float(omega)) for w in OMEGAS) < 1e-9
        assert min(abs(b - float(a)) for b in AMPLITUDES) < 1e-9
