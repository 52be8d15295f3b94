"""The Explorer by keyboard, pointer, finger and ear."""

import re

import pytest

from analytic import periodic_orbits, reduced_model
from tests.explorer.conftest import settle, turn_to

pytestmark = pytest.mark.filterwarnings("ignore::analytic.input_checks.RotbeamWarning")


def test_keyboard(page, at):
    at(page, 6.0, 0.3)
    value = page.locator("#omega-value")
    page.get_by_label("Speed ω").focus()
    for key, wanted in (("ArrowRight", "8.00"), ("ArrowLeft", "6.00"), ("Home", "0.00")):
        page.keyboard.press(key)
        assert value.inner_text() == f"{wanted} rad/s"
    page.keyboard.press("End")
    assert page.locator("#omega").get_attribute("aria-valuetext") == "12.00 rad/s"
    page.get_by_label("Amplitude a").focus()
    page.keyboard.press("ArrowUp")
    assert page.locator("#amplitude-value").inner_text() == "0.35"
    # Everything that can be used is reached with Tab, in order.
    reached = set()
    for _ in range(40):
        page.keyboard.press("Tab")
        reached.add(page.evaluate("document.activeElement.id || document.activeElement.tagName"))
    assert {"play", "phase", "INPUT", "BUTTON", "link"} <= reached


def test_numbers_under_the_cursor(page, at, beam):
    at(page, 6.0, 0.2)
    box = page.locator("#softening > svg").bounding_box()
    x = page.evaluate("softening.x(4)")
    page.mouse.move(box["x"] + x, box["y"] + 100)
    readout = page.locator("#softening .readout")
    assert "ω = 4.00 rad/s" in readout.inner_text()
    for name in ("FrE", "FrM", "CI"):
        value = f"{reduced_model(beam, 4.0, name).lambda_omega:.5f}".replace("-", "−")
        assert re.search(rf"{name}\s*{value}", readout.inner_text())
    page.mouse.click(box["x"] + x, box["y"] + 100)
    assert page.locator("#omega-value").inner_text() == "4.00 rad/s"
    page.mouse.move(5, 5)
    assert not readout.is_visible()

    box = page.locator("#orbit > svg").bounding_box()
    place = page.evaluate("(([x, v]) => [orbit.x(x), orbit.y(v)])(exactState(state.w, state.a, 0))")
    page.mouse.move(box["x"] + place[0], box["y"] + place[1] + 1)
    assert page.locator("#orbit .readout").is_visible()


def test_touch(open_page, url):
    page = open_page(url, phone=True)
    box = page.locator("#backbone > svg").bounding_box()
    x = page.evaluate("backbone.x(0.5)")
    page.touchscreen.tap(box["x"] + x, box["y"] + 60)
    assert page.locator("#amplitude-value").inner_text() == "0.50"
    readout = page.locator("#backbone .readout")
    assert "a = 0.50" in readout.inner_text()  # and stays, once the finger is lifted
    page.touchscreen.tap(20, 20)
    assert not readout.is_visible()
    page.locator("#jumps button").tap()
    assert page.locator("#omega-value").inner_text() == "6.00 rad/s"


def test_a_chart_is_a_slider_whose_numbers_are_seen_and_said(page, at, beam):
    at(page, 6.0, 0.3)
    page.locator("#softening > svg").focus()
    page.keyboard.press("ArrowLeft")
    settle(page)
    assert page.locator("#omega-value").inner_text() == "4.00 rad/s"
    value = f"{reduced_model(beam, 4.0, 'FrE').lambda_omega:.5f}"
    assert re.search(rf"FrE\s*{value}", page.locator("#softening .readout").inner_text())
    said = page.locator("#softening > svg").get_attribute("aria-valuetext")
    assert said.startswith("ω = 4.00 rad/s, ")
    assert f"FrE {value}" in said
    page.locator("#backbone > svg").focus()
    assert not page.locator("#softening .readout").is_visible()
    page.keyboard.press("End")
    settle(page)
    assert page.locator("#amplitude-value").inner_text() == "0.60"
    assert "a = 0.60" in page.locator("#backbone .readout").inner_text()
    page.wait_for_function("document.getElementById('said').textContent.includes('a = 0.60')")
    exact = periodic_orbits(beam, 4.0, [0.6])
    assert f"{exact.frequency[0]:.4f} rad/s" in page.locator("#said").text_content()


def test_the_spin_up_is_read_without_a_mouse(page, at, data):
    turn_to(page, "T=3")
    at(page, 6.0, 0.3)
    page.locator("#spin-up > svg").focus()
    for key in ("Home", "PageUp", "PageUp", "ArrowRight"):
        page.keyboard.press(key)
    curve = data["spin_up"].sel(fe_omega=6.0, exact_ramp_time=3.0)
    time, q = data["time"].to_numpy()[21], curve.to_numpy()[21]
    value = f"{q:.4f}".replace("-", "−")
    assert f"t = {time:.2f} s" in page.locator("#spin-up .readout").inner_text()
    assert value in page.locator("#spin-up .readout").inner_text()
    said = page.locator("#spin-up > svg").get_attribute("aria-valuetext")
    assert said == f"t = {time:.2f} s, q/L {value}"
    assert page.locator("#ramp-value").inner_text() == "3 s"
