"""The site: `make docs`. Nothing is fetched; pages compute their numbers, models/*.py run.

`make docs-draft` sets computed_runs to 0: text, links and formulas alone, nothing is computed.
"""

from __future__ import annotations

import importlib.util
import os
import re
import subprocess
import sys
import textwrap
from functools import partial
from pathlib import Path
from typing import Any

import matplotlib as mpl
from docutils import nodes
from fontTools.subset import Options, Subsetter, load_font, save_font
from matplotlib.animation import FFMpegWriter
from sphinx.util.fileutil import copy_asset

HERE = Path(__file__).parent
_HANDS = 8  # that pages are dealt to: more than there are chunks for each process
sys.path[:0] = [str(HERE / "_ext"), str(HERE.parent)]

from gallery_order import grouped, picture  # noqa: E402

import rotbeam_exu  # noqa: E402
from rotbeam_exu.paper import MODEL_NAMES  # noqa: E402

mpl.use("agg")

project = "rotbeam_exu"
author = "The rotbeam_exu developers"
project_copyright = author
version = release = rotbeam_exu.__version__

extensions = [
    "computed",
    "cyclopts.ext.sphinx",
    "myst_parser",
    "reference_pages",
    "sphinx.ext.autodoc",
    "sphinx.ext.mathjax",
    "sphinx.ext.napoleon",
    "sphinx.ext.viewcode",
    "sphinx_gallery.gen_gallery",
    "sphinx_reredirects",
    "sphinxcontrib.bibtex",
]
exclude_patterns = ["_build", "_ext", "_static", "gallery/*.py", "gallery/*.ipynb"]
suppress_warnings = [
    "config.cache",  # the gallery's sort keys do not pickle
    "ref.python",  # a name that several modules have is no broken link
]

# Links: all of ours have to resolve. Types of other projects do not, for nothing is fetched.
nitpicky = True
nitpick_ignore_regex = [
    ("py:class", r"(?!analytic\.|rotbeam_exu\.).*"),
    ("py:class", r".*\.(FloatArray|ComplexArray|Axial|Frame|OnError|Mesh|Profile)"),
    ("py:class", r".*\.(S|D|C|_.*)"),
    ("py:(obj|data|exc|meth|func|attr)", r"(?!analytic\.|rotbeam_exu\.).*"),
]

myst_enable_extensions = ["amsmath", "colon_fence", "deflist", "dollarmath", "substitution"]
# A line for pages whose tables have models by their letters.
myst_substitutions = {
    "models": "*Models:* " + "; ".join(f"**{k}** {v}" for k, v in MODEL_NAMES.items()) + "."
}
myst_heading_anchors = 3
mathjax_path = "mathjax/tex-chtml.js"  # in the site: formulas need no network
bibtex_bibfiles = ["references.bib"]
bibtex_default_style = "unsrt"

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_typehints_format = "short"
autodoc_type_aliases = {
    "ArrayLike": "numpy.typing.ArrayLike",
    **dict.fromkeys(("FloatArray", "ComplexArray"), "numpy.ndarray"),
}
autodoc_default_options = {"members": True, "ignore-module-all": True}
default_role = "literal"
smartquotes_action = "De"  # dashes and ellipses, not quotes: the primes of θ'' are none
napoleon_google_docstring = False
napoleon_use_rtype = False
napoleon_use_ivar = True
python_maximum_signature_line_length = 88
toc_object_entries_show_parents = "hide"

sphinx_gallery_conf = {
    "examples_dirs": "../models",
    "gallery_dirs": "gallery",
    "filename_pattern": r"\.py$",
    # The main job is the command line's, and takes its arguments.
    "ignore_pattern": r"rotating_beam\.py$",
    "within_subsection_order": "gallery_order.GalleryOrder",
    "copyfile_regex": r"GALLERY_HEADER\.rst",
    "download_all_examples": False,
    "remove_config_comments": True,
    "show_memory": False,
    "show_signature": False,
    "abort_on_example_error": True,
    "min_reported_time": 1000,
    "parallel": True,  # as sphinx -j says
    "write_computation_times": False,  # a page whose table another host sorts
    "image_scrapers": (picture,),
    "image_srcset": ["2x"],
    "reset_modules": ("matplotlib",),
}

# Old addresses lead on: pages that have become a part of another.
redirects = {
    "conventions": "scope.html#conventions",
    "faq": "gotchas.html#questions",
    "howto/fit": "sensitivity.html#which-blade-fits-a-measurement",
    "howto/index": "../index.html",
    "howto/judge_report": "judge.html#the-outcomes",
    "howto/paper_figures": "../theory/errata.html#draw-the-figures",
    "howto/quiet_spin_up": "../theory/spin_up.html",
    "howto/sweeps": "files.html#many-runs",
    "published": "codes.html#published-cases",
    "theory/backbone_curve": "harmonic_balance.html#the-curve-as-a-series",
    "theory/blade": "continuum.html#hub-taper-point-masses",
    "theory/comparison": "errata.html#figures-14-and-15",
    "theory/consistency": "reduced.html#consistent-foreshortening-frc",
    "theory/coriolis": "reduced.html#the-coriolis-coupling-frm",
    "theory/derivatives": "../howto/sensitivity.html#the-method",
    "theory/errata_proofs": "errata.html#proofs",
    "theory/extensible": "reduced.html#the-elongation-section-4",
    "theory/forced_response": "../howto/forced_response.html#the-method",
    "theory/index": "errata.html#from-the-paper-to-the-code",
    "theory/inextensible": "reduced.html#one-coordinate-section-3",
    "theory/out_of_plane": "planar.html",
    "theory/rotating_mode": "reduced.html#the-rotating-mode-section-5",
    "theory/space": "continuum.html#the-blade-in-space",
}

html_theme = "pydata_sphinx_theme"
html_title = "rotbeam_exu"
html_static_path = ["_static", "images/film.png"]
html_favicon = "_static/icon.svg"
html_baseurl = os.environ.get("SITE_URL", "")  # where it will be: previews of links need it
templates_path = ["_templates"]
html_css_files = ["site.css"]
html_show_sphinx = False
html_copy_source = False
html_sidebars = dict.fromkeys(("index", "start", "bibliography", "licenses", "theory/errata"), ())
html_theme_options = {
    "navigation_with_keys": True,
    "navbar_end": ["theme-switcher"],
    "show_toc_level": 2,
    "header_links_before_dropdown": 10,
    "navbar_persistent": ["search-button"],
    "footer_start": ["version"],
    "footer_end": [],
    "secondary_sidebar_items": ["page-toc"],
    "pygments_light_style": "a11y-high-contrast-light",
    "pygments_dark_style": "a11y-high-contrast-dark",
}


def plain(app: Any, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    """Let docstrings write formulas: no markup begins with | or **, and `w_bar`² is no error."""
    del app, name, obj, options
    if what in ("attribute", "data", "property"):
        lines.insert(0, "\\ ")  # or napoleon takes what is before a colon for a type
    doctest = False
    for i, line in enumerate(tuple(lines)):
        doctest = line.lstrip().startswith(">>>") or (doctest and bool(line.strip()))
        if not doctest:
            literal = re.sub(r"(?<!`)([|]|\*\*)", r"\\\1", line)
            lines[i] = re.sub(r"(?<!`)(`[^`]+`)(?=[\w²³⁴])", r"\1\\ ", literal)


def without_other_hosts(app: Any, page: str, source: list[str]) -> None:
    """Leave out the icons that matplotlib's player asks another host for: the theme has them."""
    del app
    if page.startswith("gallery/"):
        source[0] = re.sub(r'<link rel="stylesheet"\s+href="https://[^"]*">', "", source[0])
    if page == "gallery/index":
        source[0] = grouped(source[0])


def without_half_lists(app: Any, page: str, template: str, context: Any, tree: Any) -> None:
    """Call the parameters of a long signature no list: they are one without its terms."""
    del app, page, template, tree
    body = context.get("body", "")
    context["body"] = body.replace("<dl>\n<dd><em", '<dl role="presentation">\n<dd><em')


def without_broken_numbers(app: Any, page: str, template: str, context: Any, tree: Any) -> None:
    """Keep numbers such as 2e-06 in one line of a cell: they would break after the sign."""
    del app, page, template, tree

    def whole(cell: re.Match[str]) -> str:
        number = r"(?<=[\s>±(])([-+−]?\d[\d.]*e[-+]\d+)(?![^<]*>)"
        return re.sub(number, r'<span class="whole">\1</span>', cell[0])

    body = context.get("body", "")
    context["body"] = re.sub(r"<td\b.*?</td>", whole, body, flags=re.DOTALL)


def with_description(app: Any, page: str, template: str, context: Any, tree: Any) -> None:
    """Give a page its first paragraph and a picture, for searches and for previews of links."""
    del page, template
    text = ""
    if tree is not None:
        paragraphs = (one.astext() for one in tree.findall(nodes.paragraph))
        text = next((" ".join(one.split()) for one in paragraphs if len(one) > 40), "")
    text = re.sub(r" \[[\d, ]+\]", "", text)  # citations
    context["description"] = textwrap.shorten(text, 200, placeholder=" ...")
    context["preview"] = f"{app.config.html_baseurl}_static/film.png"


def spread(app: Any, env: Any, pages: list[str]) -> None:
    """Deal the pages out, the last first: neighbours, as all of theory, go to one process else."""
    del app, env
    pages.reverse()
    pages[:] = [page for first in range(_HANDS) for page in pages[first::_HANDS]]


def write_interactive(app: Any) -> None:
    """Write the explorer and the animations that the pages embed, by the command line itself."""
    if not app.config.computed_runs:
        return
    ending = "mp4" if FFMpegWriter.isAvailable() else "gif"
    rotbeam = [sys.executable, "-m", "rotbeam_exu.cli"]
    lines = (
        "explore --force --out _static/explorer.html",
        f"animate --omega 6 --ramp-time 3 --force --out _static/figures/spin_up.{ending}",
        "animate --omega 4 --ramp-time 3 --duration 6 --beside linear --force "
        f"--out _static/figures/linear.{ending}",
    )
    jobs = [
        subprocess.Popen([*rotbeam, *line.split()], cwd=HERE, stdout=subprocess.DEVNULL)
        for line in lines
    ]
    for job in jobs:
        if job.wait():
            raise subprocess.CalledProcessError(job.returncode, job.args)


def put_mathjax(app: Any, error: Exception | None) -> None:
    """Put what the pages need of MathJax into the site: a tenth of its variants."""
    found = importlib.util.find_spec("sphinx-mathjax-offline")
    if error is None:
        source = Path(found.origin).parent / "static" / "mathjax"
        for part in ("tex-chtml.js", "output/chtml", "input/tex", "a11y"):
            place = Path(app.outdir) / "_static" / "mathjax" / part
            copy_asset(source / part, place if (source / part).is_dir() else place.parent)


def cut_icons(app: Any, error: Exception | None) -> None:
    """Keep the icons that some page or the theme's style shows: 2000 weigh more than a page."""
    if error is None:
        static = Path(app.outdir) / "_static"
        (static / "scripts/fontawesome.js").write_text("")  # for icons that the font does not have
        sheet = static / "styles/pydata-sphinx-theme.css"
        pages = "".join(page.read_text("utf-8") for page in Path(app.outdir).rglob("*.html"))
        shown = set(re.findall(r"\bfa-[\w-]+", pages))
        style = re.sub(
            r"([^{}]*)\{--fa:[^}]*\}",
            lambda rule: rule[0] * bool(shown & set(re.findall(r"fa-[\w-]+", rule[1]))),
            sheet.read_text("utf-8"),
        )
        sheet.write_text(style, "utf-8")
        file = static / "vendor/fontawesome/webfonts/fa-solid-900.woff2"
        options = Options(flavor="woff2")
        font, cut = load_font(file, options), Subsetter(options)
        named = [int(code, 16) for code in re.findall(r"\\(f[0-9a-f]{3})", style)]
        cut.populate(unicodes=named, text="".join(c for c in style if c > "\ue000"))
        cut.subset(font)
        save_font(font, file, options)


def without_dead_ends(app: Any, error: Exception | None) -> None:
    """Leave out links from source code to names that have no place of their own on a page."""
    known: dict[Path, set[str]] = {}

    def kept(page: Path, link: re.Match[str]) -> str:
        target = (page.parent / link[1]).resolve()
        if target not in known:
            known[target] = set(re.findall(r'\bid="([^"]+)"', target.read_text("utf-8")))
        return link[0] if link[2] in known[target] else ""

    if error is None:
        for page in (Path(app.outdir) / "_modules").rglob("*.html"):
            text = page.read_text("utf-8")
            back = r'<a class="viewcode-back" href="([^"#]+)#([^"]+)">.*?</a>'
            page.write_text(re.sub(back, partial(kept, page), text), "utf-8")


def setup(app: Any) -> None:
    """Connect the above."""
    app.connect("build-finished", put_mathjax)
    app.connect("build-finished", cut_icons)
    app.connect("build-finished", without_dead_ends)
    app.connect("autodoc-process-docstring", plain, priority=400)
    app.connect("source-read", without_other_hosts)
    app.connect("html-page-context", without_half_lists)
    app.connect("html-page-context", without_broken_numbers)
    app.connect("html-page-context", with_description)
    app.connect("env-before-read-docs", spread)
    app.connect("builder-inited", write_interactive, priority=100)
