"""Regenerate the golden data of Figures 14 and 15: python tests/comparison/golden/regenerate.py.

Takes some minutes; look at the difference before committing it.
"""

from pathlib import Path

from rotbeam_exu import comparison
from rotbeam_exu.files.results import save_tables

if __name__ == "__main__":
    folder = Path(__file__).parent
    save_tables(
        comparison.figure_14(cache=folder.parents[2] / "results/cache"), folder / "figure_14.csv"
    )
    save_tables(comparison.figure_15(), folder / "figure_15.csv")
