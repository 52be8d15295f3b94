r"""Errors of the reduced models
============================

The error of each model's nonlinear frequency, by source. One error after another is removed until
the exact beam remains, so the parts of a column add up to the whole error. C and Fr have the
cantilever's and the rotating mode, I and E are inextensible and extensible, as in the paper; FrC
has a consistent foreshortening, and FrM all other bending modes as well. Right: the better models,
magnified.
"""

import matplotlib.pyplot as plt
import numpy as np

from rotbeam_exu import comparison, figures

plt.style.use(figures.STYLE)
budget = comparison.model_budget(omegas=[6.0], amplitudes=[0.1, 0.2]).sel(omega=6.0, a=0.2)

_, axes = plt.subplots(1, 2, figsize=(7.2, 3.2), width_ratios=(3, 4))
shades = plt.colormaps["cividis"](np.linspace(0.0, 1.0, budget.sizes["source"]))
for ax, names in zip(axes, (["CI", "CE", "FrI"], ["FrE", "FrC", "FrM"]), strict=True):
    up, down = np.zeros(3), np.zeros(3)
    for source, color in zip(budget["source"].to_numpy(), shades, strict=True):
        piece = 1e4 * budget["error"].sel(source=source, model=names).to_numpy()
        ax.bar(names, piece, 0.7, np.where(piece > 0.0, up, down), label=source, color=color)
        up, down = up + np.maximum(piece, 0.0), down + np.minimum(piece, 0.0)
    ax.plot(names, 1e4 * budget["total"].sel(model=names), "kD", ms=5, label="total")
    ax.axhline(0.0, color="0.5", lw=0.6)
axes[0].set(ylabel="error of $ω_{NL}$ [$10^{-4}$ $ω_n$]", title="ω = 6 rad/s, a = 0.2")
axes[1].legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
plt.show()

# %%
# The paper's best model, and FrM:
total = {str(name): budget["total"].sel(model=name).item() for name in budget["model"].to_numpy()}
print(f"FrE {total['FrE']:+.2e}, FrM {total['FrM']:+.2e}")
