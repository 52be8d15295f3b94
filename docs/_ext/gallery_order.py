"""The gallery's order: from the benchmark itself to what is made of it."""

from __future__ import annotations

from typing import Any

import matplotlib as mpl

FIRST = (
    "spin_up", "quiet_spin_up", "backbone", "phase_space", "model_errors", "mesh_convergence",
    "thickness_locking", "linear_frame", "substructures", "campbell_diagram", "tapered_blade",
    "softening_map", "is_it_planar", "leaving_the_plane", "out_of_plane", "forced_response",
    "gravity", "internal_resonance", "blade_in_exudyn", "hub_with_blades", "backbone_formula",
)  # fmt: skip


class GalleryOrder:
    """Sort key for sphinx-gallery: those named above, then the rest by name."""

    def __init__(self, source_folder: str) -> None:
        del source_folder

    def __call__(self, file_name: str) -> tuple[int, str]:
        """Return the key of a script."""
        stem = file_name.removesuffix(".py")
        return (FIRST.index(stem) if stem in FIRST else len(FIRST), stem)


def same_resolution(gallery: dict[str, Any], file_name: str) -> None:
    """Save pictures at the resolution of the house, whether a script sets its style or not."""
    del gallery, file_name
    mpl.rcParams["savefig.dpi"] = 300
