"""Substructures
=============

Linear floating frames in a row: stable up to a divergence speed that grows with their number.

Valverde and García-Vallejo showed in 2009 that linear substructures give a rotating beam its
necessary nonlinearity, by the rotation between their frames. The effect of each substructure
depends on its frame: it follows the tangent at one end, or the line between the ends, on which it
is pinned. One tangent frame diverges at the first frequency at rest, ω_0.
"""

import matplotlib.pyplot as plt

from analytic import Beam
from rotbeam_exu import figures
from rotbeam_exu.fem.elements import Substructures

plt.style.use(figures.STYLE)
beam, counts = Beam.reference(), [1, 2, 3, 4, 6, 8, 12, 16]
speeds = {
    frame: [Substructures(frame=frame).divergence_speed(beam, n) for n in counts]
    for frame in ("tangent", "pinned")
}
two = {frame: found[1] for frame, found in speeds.items()}
print(", ".join(f"two {frame} frames: {speed:.4f} rad/s" for frame, speed in two.items()))

_, ax = plt.subplots()
ax.axhline(beam.omega_0, color="0.6", lw=0.5)
ax.annotate("$ω_0$", (16, beam.omega_0), xytext=(0, 3), textcoords="offset points", ha="right")
for (frame, found), look in zip(speeds.items(), ("C0o-", "C4s-"), strict=True):
    ax.loglog(counts, found, look, ms=3.0, label=f"{frame} frames")
ax.set(xlabel="number of substructures", ylabel="divergence speed [rad/s]")
ax.set_xticks(counts, counts)
ax.set_xticks([], minor=True)
ax.legend()
plt.show()
