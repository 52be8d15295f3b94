"""A person's own numbers on the page: read in their units, drawn, or refused in one sentence."""

import math

import numpy as np
import pytest

from analytic import SpinUp, periodic_orbits, spin_up_response
from rotbeam_exu.cli import main
from tests.explorer.conftest import turn_to

pytestmark = pytest.mark.filterwarnings("ignore::analytic.input_checks.RotbeamWarning")
DROP = """([name, text]) => {
    const files = new DataTransfer();
    files.items.add(new File([text], name));
    for (const kind of ["dragover", "drop"])
        window.dispatchEvent(new DragEvent(kind, {dataTransfer: files, cancelable: true}));
}"""


def choose(page, *files):
    page.set_input_files(
        "#file",
        [
            {"name": name, "mimeType": "text/csv", "buffer": text.encode() if text else b""}
            for name, text in files
        ],
    )
    page.wait_for_function("document.getElementById('refused').textContent || OWN.length")
    page.evaluate("new Promise(f => setTimeout(f, 50))")


def marks(page):
    """Centers of own points, in the units of the axes."""
    places = page.evaluate("ownPoints().map(([a, ratio]) => [a, ratio])")
    drawn = page.evaluate(
        """[...document.querySelectorAll("#backbone path.own")].map(p => {
            const box = p.getBBox();
            return [backbone.invertX(box.x + box.width / 2), box.y + box.height / 2];
        })"""
    )
    np.testing.assert_allclose([x for x, _ in drawn], [a for a, _ in places], atol=1e-3)
    np.testing.assert_allclose(
        [y for _, y in drawn], page.evaluate("ownPoints().map(p => backbone.y(p[1]))"), atol=0.1
    )
    return np.array(places)


def test_points_join_the_backbones_in_any_unit(page, at, beam):
    at(page, 6.0, 0.2)
    exact = periodic_orbits(beam, 6.0, [0.2, 0.5])
    ours = "a,omega_NL\n" + "".join(
        f"{a!r},{f!r}\n" for a, f in zip([0.2, 0.5], exact.frequency.tolist(), strict=True)
    )
    theirs = "# a note\nω_NL [Hz]; a [m]; remark\n" + "".join(
        f"{f / (2.0 * math.pi)!r}; {a * beam.length!r}; ours\n"
        for a, f in zip([0.2, 0.5], exact.frequency.tolist(), strict=True)
    )
    choose(page, ("ours.csv", ours), ("theirs.csv", theirs))
    wanted = np.column_stack(([0.2, 0.5], exact.frequency / exact.omega_n))
    # The page's own ω_n, whose last digits are another run's.
    np.testing.assert_allclose(marks(page), np.tile(wanted, (2, 1)), rtol=1e-9)
    listed = page.locator("#own-list li").all_inner_texts()
    assert "2 points at 6 rad/s, the slider's speed, over the exact" in listed[0]
    at(page, 4.0, 0.2)
    assert page.locator("#backbone path.own").count() == 0  # they are of 6 rad/s
    at(page, 6.0, 0.2)
    page.get_by_role("button", name="Remove ours.csv").click()
    assert page.locator("#backbone path.own").count() == 2
    assert "theirs.csv" in page.locator("#own-list").inner_text()


def test_points_of_many_speeds_go_each_to_its_own(page, at):
    turn_to(page, "scale=all")
    rows = "4,0.1,3.3,3.4\n8,0.9,3,4\n8,0.3,3.9,4\n"
    rows = f"omega [rad/s],a [-],omega_NL [rad/s],omega_n [rad/s]\n{rows}"
    page.evaluate(DROP, ["speeds.csv", rows])
    page.wait_for_selector("#own-list li")
    assert "3 points at 4, 8 rad/s; 1 beyond a = 0.6" in page.locator("#own-list").inner_text()
    at(page, 4.0, 0.1)
    np.testing.assert_allclose(marks(page), [[0.1, 3.3 / 3.4]], rtol=1e-12)
    at(page, 8.0, 0.1)
    np.testing.assert_allclose(page.evaluate("ownPoints().map(p => p[1])"), [0.75, 0.975])
    page.get_by_role("button", name="/ exact").click()
    at(page, 8.0, 0.1)
    linear = page.evaluate("linear('exact', state.w)")
    np.testing.assert_allclose(page.evaluate("ownPoints()[1][1]"), 3.9 / linear)


def test_histories_lie_on_the_exact_one_in_any_unit(page, at, drawn, beam):
    turn_to(page, "T=3")
    at(page, 6.0, 0.2)
    times = np.linspace(0.0, 12.0, 241)
    q = spin_up_response(beam, SpinUp(omega=6.0, ramp_time=3.0), times, tolerance=1e-5).q / 8.0
    for heading, over in (
        ("q [m]", 8.0), ("q", 8.0), ("q/L", 1.0), ("q [L]", 1.0), ("q [mm]", 8e3),
    ):  # fmt: skip
        both = zip(times.tolist(), (over * q).tolist(), strict=True)
        rows = "".join(f"{t!r},{x!r}\n" for t, x in both)
        choose(page, ("mine.csv", f"time [s],{heading}\n{rows}"))
        assert page.locator("#refused").text_content() == ""
        x, y = drawn(page, "spin-up", "path[data-model=own-0]")
        np.testing.assert_allclose(x, times, atol=0.02)
        np.testing.assert_allclose(y, q, atol=2e-3)
        listed = page.locator("#own-list").inner_text()
        assert f'241 samples of q(t) beside the spin-up, from "time [s]", "{heading}"' in listed
        page.get_by_role("button", name="Remove mine.csv").click()


def test_what_the_page_saves_it_reads(page, at):
    turn_to(page, "T=3&hide=FE.FrM5.FrM.FrC.FrE.FrI.CE.CI.P3.P4.P5")
    at(page, 6.0, 0.2)
    files = page.evaluate("['backbone', 'spin-up'].map(id => toCSV(COLUMNS[id](), 'saved'))")
    choose(page, ("backbone.csv", files[0]), ("history.csv", files[1]))
    assert page.locator("#refused").text_content() == ""
    assert page.locator("#own-list li").count() == 2
    page.locator("figure:has(#spin-up) summary").click()
    with page.expect_download() as download:
        page.get_by_role("button", name="Save Spin-up as CSV").click()
    heads = download.value.path().read_text(encoding="utf-8").splitlines()[1]
    assert heads == "t [s],q/L [-],t history.csv [s],q/L history.csv [-]"


BACKBONE = """variant,amplitude a/L,Eq. 63 [rad/s],Eq. 41 exactly [rad/s],Eq. 63 / ω_n,exact beam [rad/s]
FrM,0.1,3.7,3.71,0.999,3.73
FrM,0.2,nan,nan,nan,3.72
"""  # noqa: E501


def test_what_rotbeam_backbone_prints_is_read(page, at):
    at(page, 6.0, 0.2)
    choose(page, ("printed.csv", BACKBONE))
    listed = page.locator("#own-list").inner_text()
    # Of the model, at the peak that the page's a is; the row without an answer is no error.
    assert 'from "Eq. 41 exactly [rad/s]"; 1 row without a number left out' in listed
    assert page.evaluate("ownPoints().map(([a, , f]) => [a, f])") == [[0.1, 3.71]]
    mode = "amplitude a/L,exact beam [rad/s],exact/ω_n\n0.02,22.9,0.99\n"
    choose(page, ("mode2.csv", mode))  # far outside the axes
    assert page.evaluate("ownPoints().length") == 2
    said = page.locator("#about-backbone").inner_text()
    assert said.endswith("Outside these axes: 1 point of your own.")


def test_the_command_names_its_columns_as_the_page_knows_them(capsys):
    main(["backbone", "--omega", "6", "--variant", "FrM", "--exact", "--format", "csv"])
    heading = BACKBONE.splitlines()[0]
    assert capsys.readouterr().out.splitlines()[0] == heading


def test_a_history_is_drawn_whole_and_only_once_thinned(page):
    rows = "".join(f"{t / 10:.1f},{2.5 if t == 50 else 0}\n" for t in range(-10, 100001))
    choose(page, ("long.csv", f"t,q/L\n{rows}"))
    assert "; 99860 not within 0 to 15 s" in page.locator("#own-list").inner_text()
    assert page.evaluate("OWN[0].line.length") == 153  # and one on either side
    assert page.evaluate("spinUp.inside(2.5)")


BAD = {
    "": "is empty",
    "x,y\n1,2\n": 'its columns are "x", "y": name them a and omega_NL, or t and q',
    "a,omega_NL\n0.1,3.7\n0.2,abc\n": 'line 3 has "abc" under "omega_NL"',
    "# note\na;omega_NL\n0,1;3,7\n": '"0,1" under "a", which is no number: write it with a decimal',
    "a,omega_NL\n0.1\n": 'line 2 has "" under "omega_NL"',
    "a [ft],omega_NL\n0.1,3.7\n": 'column "a [ft]" is in "ft": give it in L or m or mm',
    "a,omega_NL [rpm]\n0.1,3.7\n": '"omega_NL [rpm]" is in "rpm": give it in rad/s or Hz',
    "a,omega_NL\n-0.1,3.7\n": "a = -0.1 is negative",
    "a,omega_NL\n0.1,0\n": "omega_NL = 0 rad/s is not positive",
    "a,omega_NL,omega_NL\n1,1,1\n": "more than one column is omega_NL",
    "t,q\n0,0\n": "one row of numbers: a line needs two",
    "a,omega_NL\n30,3.7\n": '"a" reaches 30 times the length of the beam',
    "a,omega_NL,omega\n0.1,3.7,60\n": "omega = 60 rad/s is beyond the slider",
    "t,q\n0,0\n0.1,1\n0.1,1\n": "line 4: the time goes from 0.1 to 0.1 s",
    "t,q/L\n0,0\n0.1,8\n": '"q/L" reaches 8 times the length of the beam',
    "PK\x03\x04\x00": "no text: export the table as CSV",
}  # fmt: skip


def test_a_bad_file_gets_one_sentence_also_beside_a_good_one(page):
    for text, wanted in BAD.items():
        page.evaluate("document.getElementById('refused').textContent = ''")
        choose(page, ("bad.csv", text))
        said = page.locator("#refused").inner_text()
        assert said.startswith("bad.csv: ")
        assert wanted in said, (text, said)
        assert said.endswith(".")
        assert said.count(". ") == 0
        assert page.locator("#own-list li").count() == 0
    page.evaluate("document.getElementById('refused').textContent = ''")
    choose(page, ("bad.csv", "x\n1\n"), ("good.csv", "a,omega_NL\n0.1,3.7\n"))
    assert page.locator("#refused").inner_text().startswith("bad.csv: ")
    assert page.locator("#own-list li").count() == 1
