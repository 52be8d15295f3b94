import shutil
import warnings
from concurrent.futures import Executor, Future
from contextlib import contextmanager, nullcontext
from functools import cache

import numpy as np
import pytest

from analytic.input_checks import RotbeamWarning
from rotbeam_exu.explorer import data as room
from rotbeam_exu.explorer import explorer_data, explorer_page

OMEGAS = tuple(np.arange(0.0, 12.5, 2.0).tolist())
AMPLITUDES = tuple((np.arange(1, 13) * 5 / 100).tolist())
RAMPS = (2.5, 3.0, 4.0, 6.5)
CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser"))), None)
ARGUMENTS = [
    "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-sync",
    "--disable-background-networking", "--disable-component-update", "--renderer-process-limit=1",
]  # fmt: skip


class AtOnce(Executor):
    """Computes in this process: one of its own would only import the same again."""

    def submit(self, function, /, *arguments, **options):
        future = Future()
        future.set_result(function(*arguments, **options))
        return future


@pytest.fixture(scope="session")
def data():
    """The Explorer's data on a coarser grid and mesh."""
    with pytest.MonkeyPatch.context() as patch, warnings.catch_warnings():
        patch.setattr(room, "worker_pool", lambda *_: nullcontext(AtOnce()))
        warnings.simplefilter("ignore", RotbeamWarning)
        return explorer_data(
            omegas=OMEGAS, amplitudes=AMPLITUDES, finite_element_omegas=(6.0,),
            ramp_times=(3.0, 2.5), exact_ramp_times=RAMPS, elements=4, step=4e-3,
        )  # fmt: skip


@pytest.fixture(scope="session")
def url(data, tmp_path_factory):
    path = tmp_path_factory.mktemp("explorer") / "explorer.html"
    path.write_text(explorer_page(data), encoding="utf-8")
    return path.as_uri() + "#view=expert"


@pytest.fixture(scope="session")
def browser():
    if CHROMIUM is None:
        pytest.skip("no chromium: apt-get install chromium")
    playwright = pytest.importorskip("playwright.sync_api", reason="no playwright: pip install it")
    with playwright.sync_playwright() as driver:
        started = driver.chromium.launch(executable_path=CHROMIUM, headless=True, args=ARGUMENTS)
        yield started
        started.close()


@pytest.fixture(scope="session")
def context(browser):
    """Return a function that gives the one context of each sort; a new one costs a process."""

    @cache
    def of(phone, dark, motion, width):
        return browser.new_context(
            viewport={"width": width or (390 if phone else 1280), "height": 844 if phone else 800},
            color_scheme="dark" if dark else "light",
            reduced_motion="no-preference" if motion else "reduce",
            is_mobile=phone,
            has_touch=phone,
        )

    return of


@contextmanager
def pages_of(context):
    """Give a function that opens a URL and refuses noise: messages, errors, the network."""
    noise, pages = [], []

    def opened(url, *, phone=False, dark=False, motion=False, width=None):
        page = context(phone, dark, motion, width).new_page()
        pages.append(page)
        page.on("console", lambda message: noise.append(message.text))
        page.on("pageerror", lambda error: noise.append(str(error)))
        page.on(
            "request",
            lambda request: (
                None
                if request.url.startswith((url.split("#")[0], "data:"))
                else noise.append(request.url)
            ),
        )
        page.goto(url)
        page.wait_for_selector("html[data-ready]")
        settle(page)
        return page

    yield opened
    for page in pages:
        page.close()
    assert noise == []


@pytest.fixture
def open_page(context):
    with pages_of(context) as opened:
        yield opened


@pytest.fixture(scope="session")
def wide_page(context, url):
    with pages_of(context) as opened:
        yield opened(url)


@pytest.fixture
def page(wide_page):
    """The page on a wide screen as it opens; tests share it, for a new one costs half a second."""
    wide_page.mouse.move(5, 5)
    wide_page.evaluate("scrollTo(0, 0); document.activeElement.blur(); OWN.length = 0; listOwn()")
    turn_to(wide_page, "")
    return wide_page


def turn_to(page, fragment):
    """Show what the page opened with this behind # shows."""
    page.evaluate(
        "hash => { history.replaceState(null, '', '#view=expert&' + hash); restore(); drawAll(); }",
        fragment,
    )
    settle(page)


def settle(page):
    """Wait for what the last input asked to be drawn."""
    page.evaluate("new Promise(f => requestAnimationFrame(() => requestAnimationFrame(f)))")


def slide(page, **places):
    """Move sliders by name."""
    for name, place in places.items():
        page.locator(f"#{name}").evaluate(
            "(e, v) => { e.value = v; e.dispatchEvent(new Event('input')); }", place
        )
    settle(page)


@pytest.fixture
def at():
    """Return a function that sets the sliders of a page to a speed and an amplitude."""

    def set_sliders(page, omega, a):
        nearest = [
            int(np.argmin(np.abs(np.subtract(grid, value))))
            for grid, value in ((OMEGAS, omega), (AMPLITUDES, a))
        ]
        slide(page, omega=nearest[0], amplitude=nearest[1])

    return set_sliders


@pytest.fixture
def drawn():
    """Return a function that reads a curve of a chart back in the units of its axes."""

    def read(page, chart, selector, closed=False):
        x, y, points = page.evaluate(
            """([chart, selector]) => {
                const svg = document.querySelector(`#${chart} > svg`);
                const number = text => parseFloat(text.replace("−", "-"));
                const isNumber = t => /^−?[\\d.]+$/.test(t.textContent);
                const ticks = [...svg.querySelectorAll("text")].filter(isNumber);
                const along = ticks.filter(t => t.getAttribute("text-anchor") === "middle");
                const up = ticks.filter(t => t.getAttribute("text-anchor") === "end");
                const curve = svg.querySelectorAll(selector);
                const points = curve[0].tagName === "path"
                    ? curve[0].getAttribute("d").slice(1).split("L").map(
                        p => p.split(",").map(Number))
                    : [...curve].map(c => [+c.getAttribute("cx"), +c.getAttribute("cy")]);
                return [along.map(t => [+t.getAttribute("x"), number(t.textContent)]),
                        up.map(t => [t.getAttribute("y") - 4, number(t.textContent)]), points];
            }""",
            [chart, selector],
        )
        return tuple(
            np.polyval(np.polyfit(*np.transpose(ticks), 1), np.array(points)[:, k])
            for k, ticks in enumerate((x, y))
        )

    return read
