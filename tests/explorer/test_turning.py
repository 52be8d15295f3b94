"""The simple view: a beam that turns, exact and linear, and the challenge of the quiet ramp."""

import math

import numpy as np
import pytest

from analytic import periodic_orbits
from rotbeam_exu.explorer import explorer_page
from tests.explorer.conftest import settle

SIMPLE = "#view=simple&omega={}"


@pytest.fixture
def simple(open_page, url):
    return lambda omega=4, **how: open_page(url.split("#")[0] + SIMPLE.format(omega), **how)


def test_it_opens_first_and_a_link_to_charts_opens_the_charts(open_page, url):
    address = url.split("#")[0]
    page = open_page(address)
    assert page.locator("#turning").is_visible()
    assert not page.locator("#backbone").is_visible()
    assert page.locator("#omega-value").inner_text() == "2.00 rad/s"
    page.locator("#omega").press("ArrowRight")
    page.get_by_role("button", name="expert").click()
    page.wait_for_selector("#backbone", state="visible")
    settle(page)
    # Hidden charts were not drawn, and now are those of the slider.
    drawn = "[...document.querySelectorAll('.plot path')].map(path => path.getAttribute('d'))"
    once = page.evaluate(drawn)
    assert any(once)
    assert page.evaluate(f"(drawAll(), {drawn})") == once
    assert not page.locator("#turning").is_visible()
    assert "view=expert" in page.locator("#link").get_attribute("href")
    charts = open_page(address + "#omega=6&a=0.3")
    assert charts.locator("#backbone").is_visible()


@pytest.mark.parametrize("omega", [2.0, 4.0])
def test_the_linear_beam_lacks_the_tension(simple, data, beam, omega):
    """Without tension the centrifugal force alone is left: q̈ = -(ω_0² - ω²) q."""
    page = simple(omega)
    times = np.linspace(0.0, 1.0, 101)
    run = "times => times.map(t => linearTip(state.w, state.a, t))"
    q = np.array(page.evaluate(run, times.tolist()))
    second = (q[2:] - 2.0 * q[1:-1] + q[:-2]) / 0.01**2
    stiffness = beam.omega_0**2 - omega**2
    assert second == pytest.approx(-stiffness * q[1:-1], rel=1e-3)
    a = page.evaluate("D.a[state.a]")
    assert (q[0], q[1] - q[0]) == pytest.approx((a, -0.5 * stiffness * a * 0.01**2), rel=1e-3)
    lost = page.evaluate("lostAfter(state.w, state.a)")
    if stiffness > 0.0:
        assert lost is None or math.isinf(lost)
        return
    assert page.evaluate("t => linearTip(state.w, state.a, t)", lost) == pytest.approx(1.2)


def test_the_exact_beam_turns_with_the_clamp_and_swings_with_its_frequency(simple, data, beam):
    page = simple(4)
    where = """t => { turning.time = t; moveTurning();
        const last = turning.exact.getAttribute("d").split(/[C,]/).slice(-2).map(Number);
        const {x0, y0, scale} = turning;
        return [(last[0] - x0) / scale, (y0 - last[1]) / scale]; }"""
    a = page.evaluate("D.a[state.a]")
    orbit = periodic_orbits(beam, 4.0, [a])
    period = 2.0 * math.pi / orbit.frequency[0]
    for share in (0.0, 0.5, 1.0):
        x, y = page.evaluate(where, share * period)
        turned = complex(x, y) * np.exp(-4j * share * period)
        assert turned.imag == pytest.approx(a * (1.0 if share != 0.5 else -1.0), abs=5e-3)


def test_the_quiet_ramp_leaves_the_least(simple, data):
    page = simple(6)
    left = data["exact_left"].to_numpy()[0]
    assert "Challenge" in page.locator("#challenge").inner_text()
    page.locator("#quiet").click()
    least = data["exact_ramp_time"].to_numpy()[np.nanargmin(left)]
    page.wait_for_function("document.getElementById('challenge').textContent.startsWith('Quiet')")
    assert page.locator("#ramp-value").inner_text() == f"{least:g} s"
    assert f"{np.nanmin(left):.4f} L" in page.locator("#challenge").inner_text()


def test_a_blade_of_ones_own_has_no_linear_beam(open_page, data, tmp_path):
    path = tmp_path / "own.html"
    path.write_text(explorer_page(data.assign_attrs(blade="on a hub of 4 m")), encoding="utf-8")
    page = open_page(path.as_uri())
    assert not page.evaluate("turning.linear.getAttribute('d')")
    assert not page.locator("#legend-linear").is_visible()
    own = page.evaluate("exactFrequency(state.w, state.a)")
    assert page.locator("#about-turning").inner_text() == f"It swings with {own:.2f} rad/s."


@pytest.mark.parametrize("phone", [False, True])
def test_nothing_is_cut_off(simple, phone):
    page = simple(4, phone=phone)
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    for name in ("#omega", "#ramp", "#quiet", "#again", "#about-turning", "#challenge"):
        box = page.locator(name).bounding_box()
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= page.viewport_size["width"]


def test_it_moves_until_the_linear_beam_is_lost_and_again(simple):
    page = simple(4, motion=True)
    said = page.locator("#about-turning")
    page.wait_for_function(
        "document.getElementById('about-turning').textContent.includes('is lost')", timeout=8000
    )
    assert not page.evaluate("turning.linear.getAttribute('d')")
    page.locator("#again").click()
    assert "let go" in said.inner_text()
    assert page.evaluate("turning.time") < 2.0
