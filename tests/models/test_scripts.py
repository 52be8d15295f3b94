"""The scripts of the gallery are short, and each has a test."""

import re
from pathlib import Path

MODELS = Path(__file__).parents[2] / "models"


def test_scripts_are_short_and_all_tested():
    scripts = {path.stem: path.read_text(encoding="utf-8") for path in MODELS.glob("*.py")}
    long = [name for name, text in scripts.items() if len(text.splitlines()) >= 55]
    assert long == ["is_it_planar"]  # four pictures
    tests = Path(__file__).with_name("test_gallery.py").read_text(encoding="utf-8")
    untested = [name for name in scripts if not re.search(rf'"{name}(\.py)?"', tests)]
    # The main job is the command line's, and tested there.
    assert untested == ["rotating_beam"]
