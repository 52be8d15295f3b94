"""Nothing overprints anything, all words can be read: by boxes and colors, not by eye."""

import re

import pytest

from rotbeam_exu.explorer import explorer_page

# Pages in a browser cost most of the Explorer's tests; what it shows is tested by default.
pytestmark = pytest.mark.slow

STATES = [
    "", "omega=0&a=0.05&hide=", "omega=12&a=0.6&scale=all&norm=exact&hide=",
    "omega=4&a=0.2&scale=close&norm=exact&hide=exact.FrM5.FE", "omega=6&a=0.45&scale=all&hide=",
]  # fmt: skip
# Boxes of letters reach above and below what is drawn: two pixels may be shared.
OVERLAPS = """() => {
    const seen = e => e.checkVisibility({visibilityProperty: true, opacityProperty: true});
    const things = [...document.querySelectorAll(
        ".plot svg text, button, input, summary, output, h1, h2, p.about, td, thead th, label, " +
        "li span, #refused, .notes p, .hint span:not(.group)")]
        .filter(e => seen(e) && e.textContent + e.value)
        .map(e => [e, e.getBoundingClientRect()]).filter(([, b]) => b.width && b.height);
    const named = e => `${e.closest("figure")?.querySelector("h2").textContent ?? ""} ` +
        `${e.tagName} ${e.id} "${e.textContent}"`;
    const found = [];
    things.forEach(([e, p], i) => {
        const svg = e.closest(".plot svg")?.getBoundingClientRect();
        if (svg && (p.left < svg.left - 1 || p.right > svg.right + 1 || p.top < svg.top - 1
                || p.bottom > svg.bottom + 1)) found.push(named(e) + " leaves its chart");
        for (const [f, q] of things.slice(i + 1)) {
            const wide = Math.min(p.right, q.right) - Math.max(p.left, q.left);
            const high = Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top);
            if (wide > 1 && high > 2 && !e.contains(f) && !f.contains(e))
                found.push(named(e) + " over " + named(f));
        }
    });
    return found;
}"""
WRAPPED = """() => [...document.querySelectorAll(".group, .hint, figcaption")].filter(row => {
    const tops = [...row.children].filter(e => e.checkVisibility())
        .map(e => e.getBoundingClientRect()).map(b => (b.top + b.bottom) / 2);
    return Math.max(...tops) - Math.min(...tops) > 6;
}).map(row => row.textContent)"""

BEYOND = """() => [...document.querySelectorAll("table, .hint, .slider, figcaption, .motion")]
    .filter(e => e.getBoundingClientRect().right > e.parentElement.getBoundingClientRect().right + 1
        || [...e.querySelectorAll("*")].some(c => c.checkVisibility()
            && c.getBoundingClientRect().right > e.getBoundingClientRect().right + 1))
    .map(e => e.textContent)"""


def at_state(page, state):
    page.evaluate("hash => { location.hash = hash; }", state)
    page.evaluate("new Promise(f => setTimeout(() => requestAnimationFrame(f), 30))")


TICKS = """() => [...document.querySelectorAll(".plot > svg")].map(svg =>
    ["middle", "end"].map(anchor => [...svg.querySelectorAll(`text[text-anchor=${anchor}]`)]
        .filter(t => /^−?[\\d.]+$/.test(t.textContent)).length)).filter(([x]) => x)"""
OWN = [("mine.csv", "a,omega_NL\n0.1,3\n"), ("a-longer-name-of-a-file.csv", "t,q\n0,0\n9,1\n")]


@pytest.mark.parametrize("width", [1400, 1024, 800, 390])
def test_nothing_overprints(open_page, url, width):
    page = open_page(url, phone=width == 390, width=width)
    found = {}
    for state in STATES:
        at_state(page, state)
        found[state] = page.evaluate(OVERLAPS)
        counts = page.evaluate(TICKS)
        assert len(counts) == 5
        assert min(map(min, counts)) >= 3, (state, counts)
    page.set_input_files(
        "#file", [{"name": n, "mimeType": "text/csv", "buffer": t.encode()} for n, t in OWN]
    )
    page.wait_for_function("document.querySelectorAll('#own-list li').length === 2")
    found["own"] = page.evaluate(OVERLAPS)
    assert not any(found.values()), found
    assert page.evaluate(WRAPPED) == []
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    assert page.evaluate(BEYOND) == []


def test_on_a_phone_the_charts_begin_early_and_the_table_is_folded_above_them(open_page, url):
    page = open_page(url, phone=True)
    header, controls = (
        page.locator(one).bounding_box()["height"] for one in ("header", ".controls")
    )
    assert header + controls < 0.2 * 844
    table, charts = page.locator("#rows"), page.locator(".charts")
    assert not table.is_visible()
    fold = page.locator(".numbers > summary")
    assert fold.bounding_box()["y"] < charts.bounding_box()["y"] < 0.35 * 844
    fold.tap()
    assert table.is_visible()
    page.locator(".letters > summary").press("Enter")
    words = dict(zip(page.locator("dt").all_inner_texts(), page.locator("dd").all_inner_texts(),
                     strict=True))  # fmt: skip
    assert words["FrI"] == "rotating mode, inextensible (paper)"
    assert page.evaluate(OVERLAPS) == []
    page.evaluate("scrollTo(0, 1000)")
    assert page.locator(".controls").bounding_box()["y"] == pytest.approx(0.0, abs=1.0)
    assert controls < 0.15 * 844  # what stays while the page is scrolled


def test_it_fits_a_phone_within_the_frame_of_the_site(open_page, url):
    page = open_page(url, phone=True, width=356)
    page.evaluate("""for (const v of [2, 4, 8]) {
        const more = document.querySelector("#jumps button").cloneNode();
        more.textContent = v;
        document.getElementById("jumps").append(more);
    }""")  # the page of the site has four
    assert page.evaluate(OVERLAPS) == []
    assert page.evaluate(WRAPPED) == []
    assert page.evaluate(BEYOND) == []


FRAME = """html => new Promise(done => {
    document.documentElement.dataset.theme = "dark";
    const frame = document.createElement("iframe");
    frame.addEventListener("load", () => done());
    frame.srcdoc = html;
    document.body.append(frame);
})"""


def test_in_a_frame_it_follows_the_switch_of_the_site(open_page, url, data):
    page = open_page(url)
    frames = len(page.frames)
    page.evaluate(FRAME, explorer_page(data))
    assert len(page.frames) == frames + 1
    ground = "getComputedStyle(document.body).backgroundColor"
    assert page.frames[-1].evaluate(ground) == "rgb(16, 20, 24)"
    page.evaluate("document.documentElement.dataset.theme = 'light'")
    page.frames[-1].wait_for_function(f"{ground} === 'rgb(255, 255, 255)'")


def test_a_page_that_is_hidden_draws_without_complaint(open_page, url):
    page = open_page(url)  # the fixture listens
    page.evaluate("document.querySelector('main').style.display = 'none'; drawAll()")
    page.evaluate("document.querySelector('main').style.display = ''; drawAll()")
    assert page.evaluate(OVERLAPS) == []


COLORS = """() => {
    const found = [];
    for (const e of document.querySelectorAll("body *")) {
        const words = [...e.childNodes].filter(n => n.nodeType === 3).map(n => n.data).join("");
        if (!words.trim() || ["SCRIPT", "STYLE"].includes(e.tagName) || !e.checkVisibility())
            continue;
        const style = getComputedStyle(e), drawn = e instanceof SVGElement;
        let opacity = 1, behind = null;
        for (let p = e; p; p = p.parentElement) {
            const {opacity: own, backgroundColor} = getComputedStyle(p);
            opacity *= own;
            if (behind === null && !/, 0\\)|^transparent/.test(backgroundColor))
                behind = backgroundColor;
        }
        const on = [behind];
        const wash = e.closest(".plot")?.querySelector(".wash");
        if (drawn && wash) on.push(getComputedStyle(wash).fill);
        for (const back of on)
            found.push([words.trim(), drawn ? style.fill : style.color, back, opacity]);
    }
    return found;
}"""


def rgb(color):
    numbers = [float(x) for x in re.findall(r"-?[\d.]+(?:e-?\d+)?", color.split("(")[1])][:3]
    return numbers if color.startswith("color(") else [x / 255.0 for x in numbers]


def luminance(color):
    linear = [x / 12.92 if x <= 0.04045 else ((x + 0.055) / 1.055) ** 2.4 for x in color]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(words, ink, back, opacity):
    """WCAG's ratio of the words as they appear."""
    behind = rgb(back)
    seen = [opacity * a + (1.0 - opacity) * b for a, b in zip(rgb(ink), behind, strict=True)]
    low, high = sorted((luminance(seen), luminance(behind)))
    return (high + 0.05) / (low + 0.05), words, ink, back, opacity


@pytest.mark.parametrize("dark", [False, True])
def test_all_words_can_be_read(open_page, url, dark):
    page = open_page(f"{url}#a=0.45&hide=", dark=dark)
    page.locator("tr[data-model=CE] input").uncheck()
    box = page.locator("#softening > svg").bounding_box()
    page.mouse.move(box["x"] + 150, box["y"] + 100)
    found = [contrast(*one) for one in page.evaluate(COLORS)]
    assert len(found) > 100
    assert min(found)[0] >= 4.5, sorted(found)[:5]


def test_on_paper_charts_are_whole_and_letters_are_words(open_page, url):
    page = open_page(url, width=1400)
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    page.emulate_media(media="print")
    page.set_viewport_size({"width": 703, "height": 1000})  # A4 within its margins
    assert [one for one in page.evaluate(OVERLAPS) if "leaves its chart" in one] == []
    assert page.evaluate("document.documentElement.scrollWidth") == 703
    assert page.locator("#letters dd").first.is_visible()
    page.emulate_media(media="screen")
    page.evaluate("dispatchEvent(new Event('afterprint'))")
    assert not page.locator("#letters dd").first.is_visible()
    assert page.locator(".plot > svg[viewBox]").count() == 0
