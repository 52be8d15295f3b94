r"""
Is it planar?
=============

How fast the planar orbits of the paper's beam leave the plane of rotation if its section is
a rectangle with the paper's :math:`A` and :math:`I`; what is white stays. Circles are where its
spin-ups would end. A thin tube with the same :math:`A` and :math:`I` stays.
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
# From where on all orbits leave the plane, and the tube where spin-ups to 4 rad/s end:
limit = stability_limit(strip, 4.0, largest=0.1)
round_one = planar_stability(tube, 4.0, ends[4.0])
print(limit, round_one, sep="\n")
