r"""Is the motion planar?
=====================

How fast planar orbits leave the plane of rotation if the section of the paper's beam is a rectangle
with the paper's :math:`A` and :math:`I`, whose flap and torsion have a damping ratio of 0.5 %;
white is stable. Circles are the ends of the paper's spin-ups. A thin tube with the same :math:`A`
and :math:`I` stays in the plane.
"""

import runpy
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import analytic
from analytic import Beam, Rectangle, Tube, planar_stability
from rotbeam_exu import comparison, figures

beam = Beam.reference()
strip, tube = beam.with_shape(Rectangle()), beam.with_shape(Tube())
data = comparison.growth_out_of_plane(
    strip, omegas=np.linspace(0.0, 6.0, 13), amplitudes=np.geomspace(0.01, 0.3, 28)
)
ends = {2.0: [0.098, 0.119, 0.166, 0.219, 0.276], 4.0: [0.156, 0.190, 0.268], 6.0: [0.196, 0.231]}
points = np.transpose([(omega, a) for omega, found in ends.items() for a in found])

# %%
# :func:`~analytic.stability_limit` finds the amplitude above which all orbits leave the plane. Here
# are two orbits of the strip, below and above it, and the tube's where the spin-ups to 4 rad/s end:
limit = planar_stability(strip, 4.0, [0.058, 0.060], damping=0.005)
round_one = planar_stability(tube, 4.0, ends[4.0])
ax = figures.growth_out_of_plane(data)
ax.plot(*points, "wo", ms=3.2, mec="black", mew=0.7, clip_on=False)
print(limit, round_one, sep="\n")

# %%
# How the strip buckles in the spin-up to 6 rad/s in 3 s, by three codes: :doc:`/theory/planar`.
tables = Path(analytic.__file__).parents[1] / "models" / "strip"
axes = runpy.run_path(f"{tables}/three_codes.py")["figure"]()
plt.show()
