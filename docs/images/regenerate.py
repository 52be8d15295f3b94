"""Draw the README's pictures and three of the pages' again: `make images`, two minutes.

Figure 14 is drawn from the golden data, which tests/comparison/golden/regenerate.py computes.
"""

from pathlib import Path

import matplotlib as mpl
import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from PIL import Image

from analytic import Beam, SpinUp, spin_up_response
from rotbeam_exu import comparison, dataset_of, figures, simulate

HERE = Path(__file__).parent
GOLDEN = HERE.parents[1] / "tests" / "comparison" / "golden"


def golden() -> xr.Dataset:
    """Return the data of Figure 14 as they are kept."""
    tables = [
        pd.read_csv(GOLDEN / f"figure_14-{name}.csv", comment="#").rename(
            columns=lambda column: column.split(" [")[0]
        )
        for name in ("amplitude", "backbone")
    ]
    keys = (["mesh", "omega", "ramp_time"], ["model", "omega", "a"])
    # In the tables' own order: a Dataset of a whole table would sort the models.
    data = xr.merge(
        table.set_index(key).to_xarray().reindex({key[0]: table[key[0]].unique()})
        for table, key in zip(tables, keys, strict=True)
    )
    named = comparison.backbones.backbones(Beam.reference(), [2.0], [0.1])
    for name, like in {"ratio": "backbone", "amplitude": "a", "a": "a"}.items():
        data[name].attrs = named[like].attrs
    return data


def twisted() -> Axes:
    """Return the views of a twisted, coned blade on a hub, 2.2 s after the start of its spin-up."""
    blade = Beam.reference().with_section_out_of_plane(0.25, 0.2).with_twist(0.8)
    blade = blade.with_precone(0.15).blade.with_hub_radius(0.8)
    times, points = np.linspace(0.0, 5.0, 51), np.linspace(0.0, blade.length, 25)
    motion = SpinUp(omega=4.0, ramp_time=3.0)
    found = spin_up_response(blade, motion, times, tolerance=1e-3, points=points)
    film = figures.animate(dataset_of(found))
    film._draw_frame(22)
    film._draw_was_started = True
    return film._fig.axes[0]


def write(ax: Axes, name: str) -> None:
    """Write a figure in full color: 8 bits each of red, green and blue, no palette."""
    path = HERE / f"{name}.png"
    figure = ax.get_figure(root=True)
    figure.savefig(path, dpi=200)
    with Image.open(path) as picture:
        picture.convert("RGB").save(path, optimize=True)


if __name__ == "__main__":
    mpl.use("agg")
    write(figures.figure_14(golden())[0], "figure_14")
    run = simulate(Beam.reference(), SpinUp(omega=6.0, ramp_time=3.0), elements=16)
    write(figures.spin_up(run)[0], "spin_up")
    peaks = golden()["amplitude"].sel(mesh="paper").to_series().dropna().groupby("omega")
    ends = peaks.apply(list).to_dict()
    growth = comparison.growth_out_of_plane()
    write(figures.growth_out_of_plane(growth, spin_ups=ends), "planar_map")
    write(figures.softening_by_plane(comparison.softening_by_plane()), "softening_by_plane")
    write(twisted(), "shape")
