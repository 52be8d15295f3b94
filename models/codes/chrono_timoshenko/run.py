"""Project Chrono's tapered Timoshenko beams, by the script of its cables."""

import runpy
from pathlib import Path

chrono = runpy.run_path(str(Path(__file__).parents[1] / "chrono/run.py"))

if __name__ == "__main__":
    runs = [(32, 4e-3), (64, 4e-3), (128, 4e-3), (64, 2e-3), (64, 1e-3)]
    cases = dict.fromkeys(("S1", "V", "S2", "S3", "S1+h"), runs)
    chrono["take_part_as"](
        __file__, "timoshenko", "ChElementBeamTaperedTimoshenko, GA = EA", 2.0, cases
    )
