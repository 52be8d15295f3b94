"""The gallery's groups and order: from the benchmark itself to what is made of it."""

from __future__ import annotations

import re
from typing import Any

from sphinx_gallery.scrapers import matplotlib_scraper

GROUPS = {
    "Benchmark": (
        "spin_up", "backbone", "phase_space", "model_errors", "backbone_formula", "quiet_spin_up",
        "simo_vu_quoc",
    ),
    "Blades": (
        "campbell_diagram", "tapered_blade", "softening_map", "real_blade", "blade_in_exudyn",
        "hub_with_blades", "forced_response", "gravity",
    ),
    "Stability": ("is_it_planar", "internal_resonance"),
    "Numerics": ("mesh_convergence", "thickness_locking", "linear_frame", "substructures"),
}  # fmt: skip
FIRST = tuple(stem for stems in GROUPS.values() for stem in stems)
_CARD = re.compile(r'(?=\.\. raw:: html\n\n +<div class="sphx-glr-thumbcontainer" tooltip=".*?">)')
_HEADING = """.. raw:: html

    </div>

{title}
---------

.. raw:: html

    <div class="sphx-glr-thumbnails">

"""


class GalleryOrder:
    """Sort key for sphinx-gallery: those named above, then the rest by name."""

    def __init__(self, source_folder: str) -> None:
        del source_folder

    def __call__(self, file_name: str) -> tuple[int, str]:
        """Return the key of a script."""
        stem = file_name.removesuffix(".py")
        return (FIRST.index(stem) if stem in FIRST else len(FIRST), stem)


def grouped(index: str) -> str:
    """Return the gallery's index page with headings of groups and texts of pictures."""
    head, *cards = _CARD.split(index)
    titles = {stems[0]: title for title, stems in GROUPS.items()}
    for card in cards:
        stem = re.search(r"sphx_glr_(\w+)_thumb", card)[1]
        if stem in titles:
            head += _HEADING.format(title=titles[stem])
        title = re.search(r'thumbnail-title">(.*?)</div>', card)[1]
        head += card.replace(":alt:", f":alt: Picture of: {title}")
    return head


def picture(block: Any, names: dict[str, Any], gallery: dict[str, Any]) -> str:
    """Save a script's figures at 150 dpi, letters as large as the page's, and at twice that."""
    return str(matplotlib_scraper(block, names, gallery, dpi=150))
