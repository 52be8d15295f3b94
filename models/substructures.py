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
from rotbeam_exu.fem.elements.linear_frames import divergence_speeds

beam = Beam.reference()
two = {
    frame: Substructures(frame=frame).divergence_speed(beam, 2) for frame in ("tangent", "pinned")
}
print(", ".join(f"two {frame} frames: {speed:.4f} rad/s" for frame, speed in two.items()))
figures.divergence_speed(divergence_speeds(beam, [1, 2, 3, 4, 6, 8, 12, 16]))
plt.show()
