"""Draw the README's pictures, two of the pages' and the drawings again: `make images`, two minutes.

Figure 14 is drawn from the golden data, which tests/comparison/golden/regenerate.py computes.
"""

from pathlib import Path

import drawings
import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.animation import FuncAnimation
from matplotlib.axes import Axes
from PIL import Image
from scipy.interpolate import CubicSpline

from analytic import Beam, SpinUp, linear_response, spin_up_response
from analytic.reduced.any_blade import blade_oscillator
from rotbeam_exu import comparison, dataset_of, figures, simulate

HERE = Path(__file__).parent
GOLDEN = HERE.parents[1] / "tests" / "comparison" / "golden"


def golden() -> xr.Dataset:
    """Return the data of Figure 14 as they are kept."""
    tables = [
        pd.read_csv(GOLDEN / f"figure_14-{name}.csv").rename(
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


def softening_by_plane() -> Axes:
    """Return λ_ω of FrM of lag alone and of flap alone, the blade set at a right angle."""
    w_bar = np.linspace(0.0, 10.0, 101)
    with mpl.rc_context(figures.STYLE):
        _, ax = plt.subplots(figsize=(3.5, 2.4))
        ax.axhline(0.0, color="0.6", lw=0.5)
        # Where each name of a zero is clear of both curves.
        for plane, angle, look, at, side in (
            ("lag", 0.0, "C0-", (4, -9), "left"), ("flap", 0.5 * np.pi, "C1--", (-4, 3), "right"),
        ):  # fmt: skip
            unit = Beam.reference().with_setting_angle(angle).unit
            found = [blade_oscillator(unit, w, coriolis=True) for w in w_bar.tolist()]
            curve = CubicSpline(w_bar, [one.oscillator.lambda_omega for one in found])
            (line,) = ax.plot(w_bar, curve(w_bar), look, label=plane)
            for zero in curve.roots(extrapolate=False):
                ax.plot(zero, 0.0, "o", color=line.get_color(), ms=3)
                ax.annotate(
                    f"{zero:.2f}", (zero, 0.0), xytext=at, textcoords="offset points",
                    fontsize=6.5, color=line.get_color(), ha=side,
                )  # fmt: skip
        ax.set(xlabel="speed ω̄ = ω/√(EI/ρAL⁴)", ylabel="$λ_ω$", xlim=(0.0, 10.0))
        ax.text(0.02, 0.93, "softening", transform=ax.transAxes, color="0.35")
        ax.text(0.98, 0.03, "hardening", transform=ax.transAxes, color="0.35", ha="right")
        ax.legend()
    return ax


def still(film: FuncAnimation, number: int) -> Axes:
    """Return the first axes of a film's picture."""
    film._draw_frame(number)
    film._draw_was_started = True
    return film._fig.axes[0]


def twisted() -> Axes:
    """Return the views of a twisted, coned blade on a hub, 2.2 s after the start of its spin-up."""
    blade = Beam.reference().with_section_out_of_plane(0.25, 0.2).with_twist(0.8)
    blade = blade.with_precone(0.15).with_hub_radius(0.8)
    times, points = np.linspace(0.0, 5.0, 51), np.linspace(0.0, blade.length, 25)
    motion = SpinUp(omega=4.0, ramp_time=3.0)
    found = spin_up_response(blade, motion, times, tolerance=1e-3, points=points)
    return still(figures.animate(dataset_of(found)), 22)


def lost() -> Axes:
    """Return the film's picture where a linear model has lost the beam, 2.75 s after its start."""
    times, points = 0.05 * np.arange(121), np.linspace(0.0, Beam.reference().length, 41)
    both = [
        dataset_of(
            response(Beam.reference(), SpinUp(omega=4.0, ramp_time=3.0), times, points=points)
        )
        for response in (spin_up_response, linear_response)
    ]
    return still(figures.animate(both[0], beside=both[1]), 55)


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
    write(softening_by_plane(), "softening_by_plane")
    write(twisted(), "shape")
    write(lost(), "film")
    drawings.write()
