"""The strip's spin-up out of its plane by three codes, from the tables beside this script.

``python models/strip/three_codes.py`` writes results/strip.svg.
"""

from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from numpy.typing import NDArray

HERE = Path(__file__).parent
CODES = {"exact": "exact_112", "Exudyn": "exudyn_128", "MuJoCo": "mujoco_64"}
COARSER = {"exact_88": "k-", "exact_56": "k:"}
"""The exact blade with fewer functions, by other steps."""


def history(table: str) -> NDArray[np.void]:
    """Return time [s], along, lag and flap of the tip over L, and its twist [rad], by name."""
    return np.atleast_1d(np.genfromtxt(HERE / f"{table}.csv", delimiter=",", names=True))


def apart(one: str, other: str) -> NDArray[np.float64]:
    """Return the largest difference of a coordinate of the tip over L, at each time."""
    places = [
        np.stack([of[name] for name in ("along", "lag", "flap")])
        for of in map(history, (one, other))
    ]
    return np.asarray(np.abs(places[0] - places[1]).max(axis=0))


def figure() -> list[Axes]:
    """Draw lag, flap and twist by three codes, and their differences from the exact blade."""
    _, axes = plt.subplots(4, figsize=(4.4, 6.6), sharex=True, layout="constrained")
    for (name, table), look in zip(CODES.items(), ("k-", "C0--", "C1:"), strict=True):
        run = history(table)
        for ax, column in zip(axes, ("lag", "flap", "twist"), strict=False):
            ax.plot(run["time"], run[column], look, label=name)
        if name != "exact":
            axes[3].semilogy(run["time"][1:], apart(table, CODES["exact"])[1:], look)
    for table, look in COARSER.items():
        axes[3].semilogy(run["time"][1:], apart(table, CODES["exact"])[1:], look, lw=0.7)
    for ax, label in zip(axes, ("lag/L", "flap/L", "twist [rad]", "difference/L"), strict=True):
        ax.set(ylabel=label)
    axes[0].legend(frameon=False)
    axes[3].set(xlabel="time [s]", ylim=(1e-10, 1e-1), xlim=(0.0, run["time"][-1]))
    return list(axes)


if __name__ == "__main__":
    Path("results").mkdir(exist_ok=True)
    figure()[0].figure.savefig("results/strip.svg")
