"""Each chart as a picture and as numbers, made by the page itself."""

import csv
import io
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from PIL import Image

from analytic import periodic_orbits

pytestmark = pytest.mark.filterwarnings("ignore::analytic.input_checks.RotbeamWarning")
SVG = "{http://www.w3.org/2000/svg}"


def saved(page, chart, kind):
    """Return the name and the bytes of what a button saves."""
    figure = page.locator(f"figure:has(#{chart})")
    figure.locator("summary").click()
    with page.expect_download() as download:
        figure.get_by_role("button", name=f"as {kind}").click()
    return download.value.suggested_filename, download.value.path().read_bytes()


def table(content):
    """Return the columns by name, without the rows that they lack."""
    about, *rows = content.decode("utf-8").splitlines()
    assert about.startswith("# Rotating beam explorer, ")
    names, *cells = csv.reader(io.StringIO("\n".join(rows)))
    assert len(set(names)) == len(names)
    assert all(name.endswith("]") for name in names)  # each has a unit
    columns = zip(*cells, strict=True)
    return {
        name: np.array([float(x) for x in column if x])
        for name, column in zip(names, columns, strict=True)
    }


def test_tables_are_the_data(page, at, beam, data):
    at(page, 6.0, 0.2)
    name, content = saved(page, "backbone", "CSV")
    assert name == "backbone-omega6-a0.2.csv"
    columns = table(content)
    amplitudes = data["a"].to_numpy()
    np.testing.assert_array_equal(columns["a [-]"], [0.0, *amplitudes])
    exact = periodic_orbits(beam, 6.0, amplitudes)
    # A series through sixteen orbits.
    np.testing.assert_allclose(columns["omega_NL exact [rad/s]"][1:], exact.frequency, rtol=1e-6)
    here = data.sel(fe_omega=6.0)
    for column, variable in (("a", "fe_amplitude"), ("omega_NL", "fe_frequency")):
        unit = "-" if column == "a" else "rad/s"
        found = columns[f"{column} finite elements [{unit}]"]
        np.testing.assert_array_equal(found, here[variable].to_numpy())

    columns = table(saved(page, "softening", "CSV")[1])
    np.testing.assert_array_equal(columns["omega [rad/s]"], data["omega"].to_numpy())
    wanted = data["lambda_omega"].sel(model="CI").to_numpy()
    np.testing.assert_array_equal(columns["lambda_omega CI [-]"], wanted)

    columns = table(saved(page, "orbit", "CSV")[1])
    x, rate = periodic_orbits(beam, 6.0, [0.2]).orbit(0, 121)
    np.testing.assert_allclose(columns["x exact [-]"], x, atol=5e-6)
    np.testing.assert_allclose(columns["dx/dtau exact [-]"], rate, atol=5e-6)
    # Of the models as well phase 0 is where the beam is straight and q rises.
    np.testing.assert_allclose(columns["x FrM [-]"][0], 0.0, atol=1e-12)
    assert columns["dx/dtau FrM [-]"][0] == pytest.approx(rate[0], rel=0.01)

    columns = table(saved(page, "beam", "CSV")[1])
    assert columns["x/L [-]"][0] == columns["y/L [-]"][0] == 0.0
    # As long as the beam: the polygon through thirteen points is shorter by 2e-4.
    length = np.hypot(*np.diff([columns["x/L [-]"], columns["y/L [-]"]])).sum()
    assert length == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize("dark", [pytest.param(False, marks=pytest.mark.slow), True])
def test_a_drawing_carries_its_styles_and_stands_alone(open_page, url, dark):
    page = open_page(url, dark=dark)
    for chart in ("backbone", "orbit", "beam", "spin-up", "left"):
        name, content = saved(page, chart, "SVG")
        assert name.endswith(".svg")
        root = ET.fromstring(content)
        assert root.tag == SVG + "svg"
        assert b"var(" not in content
        assert b"class=" not in content
        ground, *_ = root.iter(SVG + "rect")
        assert "fill:rgb(255, 255, 255)" in ground.get("style")  # on white in the dark as well
        for text in root.iter(SVG + "text"):
            assert "fill:rgb(" in text.get("style")
        words = ["".join(text.itertext()).replace("\u200b", "") for text in root.iter(SVG + "text")]
        spun = chart in ("spin-up", "left")
        assert words[0].endswith("ω = 6 rad/s, T = 3 s" if spun else "ω = 6 rad/s, a = 0.3")
        # Each curve is named.
        named = {"beam": set(), "spin-up": {"exact"}, "left": {"closed form"}}
        assert named.get(chart, {"exact", "FrM", "CE"}) <= set(words)
        assert page.evaluate("document.documentElement.className") == ""


def test_a_picture_is_three_times_as_sharp(page):
    name, content = saved(page, "backbone", "PNG")
    assert name == "backbone-omega6-a0.3.png"
    picture = Image.open(io.BytesIO(content), formats=["PNG"])
    box = page.locator("#backbone > svg").bounding_box()
    # Over the drawing its title, below it what is said of it.
    assert picture.width == pytest.approx(3.0 * box["width"], abs=1.0)
    assert 26.0 + 15.0 < picture.height / 3.0 - box["height"] < 26.0 + 60.0
    assert len(set(picture.convert("L").tobytes())) > 50  # not an empty sheet


def test_a_saved_chart_says_what_its_marks_are(open_page, page):
    long = "a-run-with-a-name-that-is-longer-than-a-column.csv"
    for name, text in ((long, "t,q\n0,0\n9,1\n"), ("points.csv", "a,omega_NL\n0.1,3.72\n")):
        file = {"name": name, "mimeType": "text/csv", "buffer": text.encode()}
        page.set_input_files("#file", [file])
    page.wait_for_function("OWN.length === 2")
    for chart, wanted in (
        ("left", "● exact transient, – closed form, ○ finite elements."),
        ("backbone", "points.csv"),
        ("spin-up", "After the ramp (shaded) the tip swings by"),
    ):
        _, content = saved(page, chart, "SVG")
        root = ET.fromstring(content)
        words = ["".join(text.itertext()) for text in root.iter(SVG + "text")]
        assert wanted in " ".join(words)
        alone = open_page("data:text/html,<html data-ready>")
        alone.set_content(content.decode())
        # Letters of neighbors keep apart, and within the sheet.
        boxes = alone.evaluate(
            """[...document.querySelectorAll("svg > text")].map(t => t.getBBox())
                .map(b => [b.x, b.x + b.width, b.y, b.y + b.height])"""
        )
        width, height = float(root.get("width")), float(root.get("height"))
        for i, (x, end, y, low) in enumerate(boxes):
            assert x >= 0.0
            assert end <= width
            assert low <= height + 1.0
            for x2, end2, y2, low2 in boxes[i + 1 :]:
                assert min(end, end2) <= max(x, x2) or min(low, low2) - max(y, y2) <= 2.0


def test_the_menu_opens_by_keyboard_and_closes_again(page):
    menu = page.locator("figure:has(#orbit) details")
    menu.locator("summary").focus()
    page.keyboard.press("Enter")
    button = page.get_by_role("button", name="Save Orbit of the tip as CSV")
    assert button.is_visible()
    page.keyboard.press("Tab")
    page.keyboard.press("Escape")
    assert not button.is_visible()
    assert menu.locator("summary").evaluate("e => e === document.activeElement")
