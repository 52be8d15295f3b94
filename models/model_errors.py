r"""
What each reduced model gets wrong
==================================

The error of each model's nonlinear frequency, source by source. One fault after another is taken
away until the exact beam is left, so that the pieces of a bar add up to the whole error.
"""

import matplotlib.pyplot as plt
import numpy as np

from rotbeam_exu import comparison

budget = comparison.model_budget(omegas=[6.0], amplitudes=[0.1, 0.2]).sel(omega=6.0, a=0.2)

_, ax = plt.subplots(figsize=(7, 4), layout="constrained")
names = budget["model"].to_numpy()
up, down = np.zeros(names.size), np.zeros(names.size)
for source in budget["source"].to_numpy():
    piece = 100.0 * budget["error"].sel(source=source).to_numpy()
    start = np.where(piece > 0.0, up, down)
    ax.bar(names, piece, bottom=start, label=source, width=0.7)
    up, down = up + np.maximum(piece, 0.0), down + np.minimum(piece, 0.0)
ax.plot(names, 100.0 * budget["total"], "kD", ms=5, label="total")
ax.axhline(0.0, color="0.5", lw=0.6)
ax.set(ylabel="error of $ω_{NL}$ [% of $ω_n$]", title="ω = 6 rad/s, a = 0.2")
ax.legend(loc="lower right")
plt.show()

# %%
# The paper's best model, and ours:
total = {str(name): budget["total"].sel(model=name).item() for name in names}
print(f"FrE {total['FrE']:+.2e}, FrM {total['FrM']:+.2e}")
