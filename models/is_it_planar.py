r"""Is the motion planar?
=====================

How fast planar orbits leave the plane of rotation if the section of the paper's beam is a rectangle
with the paper's :math:`A` and :math:`I`; white is stable. Circles are the ends of the paper's
spin-ups. A thin tube with the same :math:`A` and :math:`I` stays in the plane.
"""

import matplotlib.pyplot as plt
import numpy as np

from analytic import Beam, Rectangle, Tube, planar_stability, stability_limit
from rotbeam_exu import comparison, figures

beam = Beam.reference()
strip, tube = beam.with_shape(Rectangle()), beam.with_shape(Tube())
data = comparison.growth_out_of_plane(
    strip, omegas=[0.0, 2.0, 4.0, 6.0], amplitudes=np.geomspace(0.02, 0.3, 8)
)
ends = {2.0: [0.098, 0.119, 0.166, 0.219, 0.276], 4.0: [0.156, 0.190, 0.268], 6.0: [0.196, 0.231]}
figures.growth_out_of_plane(data, spin_ups=ends)
plt.show()

# %%
# The amplitude above which all orbits leave the plane, and the tube at the ends of the spin-ups to
# 4 rad/s:
limit = stability_limit(strip, 4.0, largest=0.1)
round_one = planar_stability(tube, 4.0, ends[4.0])
print(limit, round_one, sep="\n")
