"""BeamDyn as the input files of its users set it up: low degree, trapezoidal rule, rhoinf 0."""

import runpy
from pathlib import Path

beamdyn = runpy.run_path(str(Path(__file__).parents[1] / "beamdyn/run.py"))

if __name__ == "__main__":
    runs = [(5, 4e-3), (6, 4e-3), (7, 4e-3), (8, 4e-3), (6, 8e-3), (6, 2e-3)]
    how = f"trapezoidal rule over {beamdyn['STATIONS']} stations, spectral radius 0"
    beamdyn["take_part_as"](__file__, "BeamDyn, as used", how, {"S1": runs}, used=True)
