r"""Errors of the reduced models
============================

The error of each model's nonlinear frequency, by source, in units of 10⁻⁴ ω_n. One error after
another is removed until the exact beam remains, so a row adds up to the whole error. C and Fr have
the cantilever's and the rotating mode, I and E are inextensible and extensible, as in the paper;
FrC has a consistent foreshortening, and FrM all other bending modes as well. Darker cells are
larger errors.
"""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LogNorm

from rotbeam_exu import comparison, figures

plt.style.use(figures.STYLE)
budget = comparison.model_budget(omegas=[6.0], amplitudes=[0.1, 0.2]).sel(omega=6.0, a=0.2)
models = ["CI", "CE", "FrI", "FrE", "FrC", "FrM"]
parts = budget.sel(model=models)
cells = 1e4 * np.column_stack((parts["error"].transpose("model", "source"), parts["total"]))

_, ax = plt.subplots(figsize=(7.2, 2.9))
ax.pcolormesh(np.abs(cells), cmap="Oranges", norm=LogNorm(0.3, 2e4), edgecolors="w", lw=1.5)
for (row, column), value in np.ndenumerate(cells):
    weight = "bold" if column == cells.shape[1] - 1 else None
    text = "0" if abs(value) < 5e-3 else f"{value:+.3g}".replace("-", "−")
    ax.text(column + 0.5, row + 0.5, text, ha="center", va="center", weight=weight)
ax.axvline(cells.shape[1] - 1, color="k", lw=1.0)
sources = [str(name).replace(" and ", " and\n") for name in parts["source"].to_numpy()]
names = [name if "\n" in name else name.replace(" ", "\n") for name in sources]
ax.set_xticks(np.arange(cells.shape[1]) + 0.5, [*names, "total"], fontsize="small")
ax.set_yticks(np.arange(len(models)) + 0.5, models)
ax.invert_yaxis()
ax.xaxis.tick_top()
ax.tick_params(length=0)
ax.spines[:].set_visible(False)
ax.set_xlabel("error of $ω_{NL}$ at ω = 6 rad/s and a = 0.2, in $10^{-4}$ $ω_n$")
plt.show()

# %%
# The paper's best model, and FrM:
total = {str(name): budget["total"].sel(model=name).item() for name in budget["model"].to_numpy()}
print(f"FrE {total['FrE']:+.2e}, FrM {total['FrM']:+.2e}")
