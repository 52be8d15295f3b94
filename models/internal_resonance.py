r"""Internal resonance
==================

The backbone of the paper's beam, inextensible, at 2 rad/s. The Coriolis force causes the sixth
harmonic, which meets the second mode at two thirds of the length. There the branch turns around
and the second mode dominates (dashed); the backbone continues on the other side. All other
crossings, the dots with harmonic:mode, are too weak to be visible.
"""

import matplotlib.pyplot as plt

from analytic import Beam, Theory, backbone
from rotbeam_exu import figures

plt.style.use(figures.STYLE)
branch = backbone(Beam.reference(), omega=2.0, theory=Theory(extension=False)).branch(up_to=0.8)
print(branch)

_, ax = plt.subplots(figsize=(3.5, 3.6))
(resonance,) = [one for one in branch.resonances if (one.harmonic, one.mode) == (6, "lag 2")]
for piece in range(branch.piece.max() + 1):
    here = branch.piece == piece
    lower = branch.amplitude < resonance.amplitude
    for part in (here & lower, here & ~lower) if piece == 0 else (here,):
        ax.plot(branch.frequency[part], branch.amplitude[part], "C1--" if piece else "k-")
ax.plot([], [], "k-", label="first mode dominates")
ax.plot([], [], "C1--", label="second mode dominates")
ax.plot([], [], "o", color="0.6", markersize=3, label="harmonic:mode")
for one in branch.resonances:
    if one is not resonance:
        ax.plot(one.frequency, one.amplitude, "o", color="0.6", markersize=3)
        left = one.mode == "lag 4"
        ax.annotate(f"{one.harmonic}:{one.mode}", (one.frequency, one.amplitude),
                    (-6 if left else 6, -3), textcoords="offset points", color="0.5", fontsize=6,
                    ha="right" if left else "left")  # fmt: skip
ax.set(xlabel="frequency [rad/s]", ylabel="peak |q|/L", ylim=(0.0, 0.85))
ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.18), ncols=2)
plt.show()
