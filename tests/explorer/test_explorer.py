"""The Explorer in a real browser: quiet, alone, and of one mind with the Python API."""

import re

import numpy as np
import pytest

from analytic import VARIANTS, linear_modes, periodic_orbits, reduced_model
from analytic.input_checks import RotbeamWarning
from rotbeam_exu.explorer import explorer_page
from tests.explorer.conftest import slide, turn_to

pytestmark = pytest.mark.filterwarnings("ignore::analytic.input_checks.RotbeamWarning")
STATES = [(0.0, 0.05), (4.0, 0.3), (12.0, 0.6)]


def shown(value, digits):
    text = f"{value:.{digits}f}"
    return text.replace("-", "" if float(text) == 0.0 else "−")


def cells(page, model):
    row = page.locator(f"tr[data-model={model}]")
    return [row.locator(f"td.{name}").inner_text() for name in ("linear", "lambda", "frequency")]


@pytest.mark.parametrize(
    ("phone", "dark"),
    [pytest.param(False, False, marks=pytest.mark.slow), (False, True), (True, False)],
)
def test_it_loads_quietly_and_alone_and_fits(open_page, url, phone, dark):
    page = open_page(url, phone=phone, dark=dark)  # the fixture listens for noise
    width = page.evaluate("[document.documentElement.scrollWidth, innerWidth]")
    assert width[0] <= width[1]
    background, ink = page.evaluate(
        "[getComputedStyle(document.body).backgroundColor, getComputedStyle(document.body).color]"
    )
    luminance = [sum(map(int, re.findall(r"\d+", color)[:3])) for color in (background, ink)]
    assert (luminance[0] < luminance[1]) == dark
    for text in page.locator("svg text.name").all():
        assert text.bounding_box()["x"] + text.bounding_box()["width"] <= width[1]


def test_it_refers_to_nothing_outside(data):
    found = set(re.findall(r"(?:https?:)?//[\w.-]+\.\w+[\w./-]*", explorer_page(data)))
    assert found <= {"http://www.w3.org/2000/svg"}  # a name, not an address


def test_numbers_are_those_of_the_api(page, at, beam):
    for omega, a in STATES:
        at(page, omega, a)
        exact = periodic_orbits(beam, omega, [a])
        assert cells(page, "exact") == [
            shown(exact.omega_n, 4), shown(exact.lambda_omega, 5), shown(exact.frequency[0], 4),
        ]  # fmt: skip
        for name in VARIANTS:
            model = reduced_model(beam, omega, name)
            frequency = model.frequency(model.first_harmonic(a))
            assert cells(page, name) == [
                shown(model.omega_n, 4), shown(model.lambda_omega, 5), shown(frequency, 4),
            ]  # fmt: skip
            linear = model.omega_n / exact.omega_n - 1.0
            shift = frequency / model.omega_n - exact.frequency[0] / exact.omega_n
            for cell, error in (("linear-error", linear), ("shift-error", shift)):
                found = page.locator(f"tr[data-model={name}] td.{cell}").inner_text()
                assert found.lstrip("+") == shown(100.0 * error, 3)
                assert found.startswith("+") == (error > 5e-6)


def test_curves_lie_where_the_axes_say(page, at, drawn, beam, data):
    turn_to(page, "scale=all")
    for omega, a in STATES:
        at(page, omega, a)
        amplitudes = data["a"].to_numpy()
        exact = periodic_orbits(beam, omega, amplitudes)
        # Paths are rounded to a tenth of a pixel, about a 3000th of an axis.
        for name in ("exact", "FrE", "CI"):
            x, y = drawn(page, "backbone", f"path[data-model={name}]")
            model = reduced_model(beam, omega, "FrE" if name == "exact" else name)
            ratio = (
                exact.frequency / exact.omega_n
                if name == "exact"
                else 1.0 - model.lambda_omega * model.first_harmonic(amplitudes) ** 2
            )
            np.testing.assert_allclose(x[1:], amplitudes, atol=3e-4)
            np.testing.assert_allclose(y[1:], ratio, atol=3e-4)
            x, y = drawn(page, "softening", f"path[data-model={name}]")
            at_omega = (
                reduced_model(beam, omega, name).lambda_omega
                if name != "exact"
                else (exact.lambda_omega)
            )
            assert y[np.argmin(np.abs(x - omega))] == pytest.approx(at_omega, abs=1e-3)


def test_orbits_are_those_of_the_api(page, at, drawn, beam):
    for omega, a in STATES:
        at(page, omega, a)
        orbit = periodic_orbits(beam, omega, [a]).orbit(0, 121)
        for wanted, found in zip(
            orbit, drawn(page, "orbit", "path[data-model=exact]"), strict=True
        ):
            np.testing.assert_allclose(found, wanted, atol=1e-3 * np.abs(wanted).max())
        model = reduced_model(beam, omega, "FrI")
        first = float(model.first_harmonic(a))
        time = np.linspace(0.0, 2.0 * np.pi / model.frequency(first), 121)
        x, rate = drawn(page, "orbit", "path[data-model=FrI]")
        time -= 0.25 * time[-1]  # straight at first, as the exact one
        np.testing.assert_allclose(x, model.response(time, first), atol=1e-3 * first)
        # dx/dτ against central differences of Eq. 65 in time.
        h = 1e-5
        slope = (model.response(time + h, first) - model.response(time - h, first)) / (2.0 * h)
        wanted = slope / beam.frequency_scale
        np.testing.assert_allclose(rate, wanted, atol=1e-3 * np.abs(wanted).max())
        said = re.search(r"FrI (\d\.\d+)", page.text_content("#about-orbit"))
        assert float(said[1]) == pytest.approx(np.abs(wanted).max(), abs=1e-3)


def test_the_beam_moves_as_the_exact_one(page, at, beam):
    for omega in (0.0, 6.0, 12.0):
        at(page, omega, 0.6)
        phases = np.linspace(0.0, 2.0 * np.pi, 7)
        found = np.array(
            page.evaluate(
                "phases => phases.map(p => beamAxis(state.w, state.a, p))", phases.tolist()
            )
        )
        points = np.linspace(0.0, beam.length, found.shape[1])
        places = periodic_orbits(beam, omega, [0.6]).axis(0, points, phases)
        x, y, _ = np.moveaxis(places, -1, 0)
        # Harmonics beyond the seventh are left out: a tenth of a pixel of 300.
        np.testing.assert_allclose(beam.length * found[..., 0], x, atol=3e-4 * beam.length)
        np.testing.assert_allclose(beam.length * found[..., 1], y, atol=3e-4 * beam.length)


def test_the_beam_is_drawn_to_scale(page, at, beam):
    at(page, 6.0, 0.4)
    slide(page, phase=90)
    root, scale, tip = page.evaluate(
        "[[beam.x0, beam.y0], beam.scale, ['cx', 'cy'].map(n => +beam.tip.getAttribute(n))]"
    )
    x, y, _ = periodic_orbits(beam, 6.0, [0.4]).tip(0, [0.5 * np.pi])[0]
    assert tip[0] - root[0] == pytest.approx(scale * x / beam.length, abs=0.2)
    assert root[1] - tip[1] == pytest.approx(scale * y / beam.length, abs=0.2)
    q = periodic_orbits(beam, 6.0, [0.4]).response(
        0.5 * np.pi / periodic_orbits(beam, 6.0, [0.4]).frequency, 0
    )
    assert page.locator("#deflection").text_content() == f"q = {q.item():.3f} L"


def test_finite_element_points_at_their_speed_only(page, at, drawn, data):
    turn_to(page, "scale=all")
    at(page, 6.0, 0.2)
    here = data.sel(fe_omega=6.0)
    circles = "g[clip-path] circle.point"
    inside = here["fe_amplitude"].to_numpy() <= 0.6
    assert inside.any()
    x, y = drawn(page, "backbone", circles)
    np.testing.assert_allclose(x, here["fe_amplitude"].to_numpy()[inside], atol=3e-4)
    ratio = (here["fe_frequency"] / here["fe_omega_n"]).to_numpy()[inside]
    np.testing.assert_allclose(y, ratio, atol=3e-4)
    at(page, 4.0, 0.2)
    assert page.locator(f"#backbone {circles}").count() == 0


def curve(page, chart, model="exact"):
    return page.locator(f"#{chart} path[data-model={model}]").get_attribute("d")


def test_what_is_not_found_is_a_gap(open_page, data, tmp_path):
    """An orbit, a model's oscillation, a spin-up."""
    gap = data.copy(deep=True)
    for name in ("exact_frequency", "harmonics", "axis_x", "axis_y"):
        gap[name].loc[{"omega": 6.0, "a": 0.6}] = np.nan
    for name in ("omega_n", "lambda_omega", "lambda_x", "kappa", "h2", "first_harmonic"):
        gap[name].loc[{"model": "CI"}] = np.nan
    for name in ("spin_up", "exact_left"):
        gap[name].loc[{"exact_ramp_time": 3.0}] = np.nan
    path = tmp_path / "gap.html"
    path.write_text(explorer_page(gap), encoding="utf-8")
    page = open_page(f"{path.as_uri()}#omega=6&a=0.6&T=3", motion=True)  # the fixture listens
    assert cells(page, "CI") == ["–"] * 3
    assert not curve(page, "backbone", "CI")
    assert "Too violent" in page.locator("#about-spin-up").inner_text()
    assert not page.locator("#spin-up path[data-model=exact]").get_attribute("d")
    assert "No exact orbit was found" in page.locator("#warning").inner_text()
    assert cells(page, "exact")[2] == "–"
    assert not page.locator("#beam circle").is_visible()
    page.locator("#amplitude").press("ArrowLeft")
    page.wait_for_function("document.querySelector('#beam .beam').getAttribute('d')")
    assert page.evaluate("Number.isFinite(state.phase)")
    assert page.locator("#beam circle").is_visible()


def test_the_link_keeps_the_state(open_page, page, at):
    at(page, 8.0, 0.45)
    page.get_by_role("button", name="all", exact=True).click()
    page.get_by_role("button", name="/ exact").click()
    page.locator("tr[data-model=CE] input").uncheck()
    link = page.locator("#link").get_attribute("href")
    page.wait_for_function("link => location.hash === link", arg=link)
    address = page.url
    other = open_page(address)
    for opened in (page, other):
        assert opened.locator("#omega-value").inner_text() == "8.00 rad/s"
        assert opened.locator("#amplitude-value").inner_text() == "0.45"
        assert opened.locator("#backbone path[data-model=CE]").count() == 0
        assert opened.locator("#backbone path[data-model=FrM]").count() == 1
    assert curve(other, "backbone") == curve(page, "backbone")
    assert curve(other, "softening", "FrE") == curve(page, "softening", "FrE")
    other.evaluate("location.hash = '#omega=4&a=0.1'")
    other.wait_for_function("document.getElementById('omega-value').textContent === '4.00 rad/s'")


def test_a_broken_link_still_opens(page):
    for fragment in ("omega=nan&a=&T=x&scale=7&hide=x", "%%%", "omega=1e9&a=-5&T=-1"):
        turn_to(page, fragment)
        assert page.locator("#backbone path[data-model=exact]").count() == 1


def test_motion_in_real_time_unless_unwanted(open_page, url, page, beam):
    assert page.locator("#play").inner_text() == "Play"
    page = open_page(url, motion=True)
    assert page.locator("#play").inner_text() == "Pause"
    seconds, turned = page.evaluate(
        """new Promise(done => requestAnimationFrame(start => {
            const from = state.phase;
            const step = now => now - start > 300
                ? done([(now - start) / 1000, state.phase - from]) : requestAnimationFrame(step);
            requestAnimationFrame(step);
        }))"""
    )
    rate = periodic_orbits(beam, 6.0, [0.3]).frequency[0]
    # A picture more or less; on a busy machine one may take a tenth of a second.
    assert turned % (2.0 * np.pi) == pytest.approx(rate * seconds, abs=0.1 * rate)
    page.locator("#play").click()
    at_rest = page.evaluate("state.phase")
    page.wait_for_timeout(100)
    assert page.evaluate("state.phase") == at_rest


def test_what_the_exact_orbits_warn_of_is_said(page, at, beam):
    at(page, 2.0, 0.6)
    with pytest.warns(RotbeamWarning, match="internal resonance") as caught:
        periodic_orbits(beam, 2.0, [0.25, 0.6])
    assert caught
    assert "internal resonance" in page.locator("#warning").inner_text()
    at(page, 12.0, 0.6)
    warning = page.locator("#warning").inner_text()
    first, _ = linear_modes(beam, 12.0, count=2).frequencies
    assert 2.0 * first < 12.0
    assert "twice the natural frequency" in warning
    at(page, 6.0, 0.2)
    assert page.locator("#warning").inner_text() == ""
