"""The built site: complete in its folder, formulas included, as `make check-site` asks."""

import re
import shutil
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import pytest

SITE = Path(__file__).parents[2] / "docs" / "_build" / "html"
CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser"))), None)
PAGES = (
    "index", "class/index", "theory/continuum", "theory/errata", "explorer", "search",
    "reference/api/analytic.exact.free.orbits.Orbits",
)  # fmt: skip
KINDS = (
    "index", "start", "class/index", "howto/judge", "gallery/index", "gallery/spin_up", "explorer",
    "theory/errata", "reference/index", "reference/api/analytic.periodic_orbits",
    "_static/explorer",
)  # fmt: skip
AXE = SITE.parents[2] / "node_modules" / "axe-core" / "axe.min.js"
pytestmark = [
    pytest.mark.site,
    pytest.mark.skipif(not (SITE / "index.html").exists(), reason="no site: make docs"),
]


class Asked(HTMLParser):
    """Collects what a page loads by itself: not its links."""

    def __init__(self, text):
        super().__init__()
        self.urls = []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        given = dict(attrs)
        if tag == "link" and given.get("rel") in ("canonical", "index", "search", "next", "prev"):
            return
        self.urls += [given[k] for k in ("src", "srcset", "data") if given.get(k)]
        self.urls += [given["href"]] if tag == "link" and given.get("href") else []


def test_nothing_that_only_the_next_build_reads_is_published():
    """If this fails: the folder is of an older build; remove docs/_build."""
    assert not (SITE / ".doctrees").exists()


def test_no_page_names_another_host_for_what_it_loads():
    pages = sorted(SITE.rglob("*.html"))
    assert len(pages) > 100
    for page in pages:
        outside = [
            url
            for url in Asked(page.read_text(encoding="utf-8")).urls
            if "//" in url and not url.startswith("data:")
        ]
        assert outside == [], page


def test_no_link_within_the_site_ends_nowhere():
    texts = {page: page.read_text(encoding="utf-8") for page in SITE.rglob("*.html")}
    places = {page: {*re.findall(r'\b(?:id|name)="([^"]+)"', t)} for page, t in texts.items()}
    dead = []
    for page, text in texts.items():
        for link in re.findall(r'href="([^"]+)"', text):
            path, _, place = link.partition("#")
            target = (page.parent / unquote(path)).resolve() if path else page
            state = target.stem == "explorer"  # its places are the state of its sliders
            if ":" in link or target.suffix not in (".html", "") or state:
                continue
            if not target.exists() or (place and unquote(place) not in places[target]):
                dead.append((page.relative_to(SITE).as_posix(), link))
    assert dead == []


def test_home_says_what_it_is_to_those_who_get_its_link():
    text = (SITE / "index.html").read_text(encoding="utf-8")
    described = re.search(r'<meta name="description" content="([^"]*)"/>', text)[1]
    assert described.startswith("A cantilever beam is spun up")
    assert "[1" not in described
    assert len(described) <= 200
    picture = re.search(r'<meta property="og:image" content="([^"]*)"/>', text)[1]
    assert (SITE / "_static" / picture.rpartition("/")[2]).exists()


def test_the_reference_has_its_pages_and_pictures():
    api = SITE / "reference" / "api"
    assert (api / "analytic.periodic_orbits.html").exists()
    drawn = {path.stem for path in (SITE / "_images").glob("analytic.*.svg")}
    exact = "analytic.exact."
    assert {
        f"{exact}free.orbits.Orbits", f"{exact}linear.campbell.Campbell",
        f"{exact}driven.forced_orbits.ForcedResponse",
    } <= drawn  # fmt: skip
    assert "warn_if_rpm" not in (SITE / "genindex.html").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def offline():
    """A browser that reaches no network."""
    if CHROMIUM is None:
        pytest.skip("no chromium: apt-get install chromium")
    playwright = pytest.importorskip("playwright.sync_api", reason="no playwright: pip install it")
    with playwright.sync_playwright() as driver:
        browser = driver.chromium.launch(
            executable_path=CHROMIUM, args=["--no-sandbox", "--disable-gpu"]
        )
        yield browser.new_context(offline=True)
        browser.close()


@pytest.mark.parametrize("name", PAGES)
def test_pages_are_whole_without_a_network(offline, name):
    """Nothing outside the folder is asked for, nothing in it misses, and formulas are set."""
    asked, missed, page = [], [], offline.new_page()
    page.on("request", lambda request: asked.append(request.url))
    page.on("requestfailed", lambda request: missed.append(request.url))
    page.on("pageerror", lambda error: missed.append(str(error)))
    page.goto((SITE / f"{name}.html").as_uri())
    if name.startswith("theory/"):
        page.wait_for_selector("mjx-container")
        page.evaluate("MathJax.startup.promise.then(() => document.fonts.ready)")
        sizes = page.evaluate(
            """[...document.querySelectorAll("mjx-container")].map(e => {
                const box = e.getBoundingClientRect(); return box.width * box.height; })"""
        )
        assert len(sizes) > 10
        assert min(sizes) > 0.0
        assert page.locator("mjx-merror").count() == 0
        fonts = "[...document.fonts].filter(f => f.status == 'loaded').map(f => f.family)"
        assert "MJXTEX-I" in page.evaluate(fonts)  # set in its own letters, not in any
    page.close()
    assert [url for url in asked if not url.startswith((SITE.as_uri(), "data:"))] == []
    assert missed == []
    if name == "index":  # before any compression
        files = {unquote(urlsplit(url).path) for url in asked if url.startswith("file:")}
        assert sum(Path(file).stat().st_size for file in files) < 0.7e6


@pytest.mark.skipif(not AXE.exists(), reason="no axe: npm install --no-save axe-core")
@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("name", KINDS)
def test_axe_finds_nothing(offline, name, theme):
    """Names of links and pictures, contrast, lists and heads of tables, by WCAG's own checks."""
    page = offline.new_page()
    page.emulate_media(color_scheme=theme)
    page.goto((SITE / f"{name}.html").as_uri())
    page.add_script_tag(path=AXE)
    found = page.evaluate("axe.run().then(r => r.violations.map(v => [v.id, v.nodes[0].html]))")
    page.close()
    assert found == []
