"""Project Chrono's isogeometric beams, cubic, by the script of its cables."""

import runpy
from pathlib import Path

chrono = runpy.run_path(str(Path(__file__).parents[1] / "chrono/run.py"))

if __name__ == "__main__":
    runs = [(16, 4e-3), (32, 4e-3), (64, 4e-3), (32, 2e-3), (64, 2e-3)]
    cases = dict.fromkeys(("S1", "S2", "S3"), runs)
    chrono["take_part_as"](__file__, "iga", "ChElementBeamIGA, cubic, GA = EA", None, cases)
