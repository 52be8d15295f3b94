r"""Campbell diagram
================

Frequencies of the exact beam in the plane of rotation over the speed, and the lines
:math:`k\omega`. A force that is fixed in space excites a mode at the intersections, the dots.
"""

import matplotlib.pyplot as plt
import numpy as np

from analytic import Beam, Rectangle, campbell
from rotbeam_exu import figures

plt.style.use(figures.STYLE)
diagram = campbell(Beam.reference(), np.linspace(0.0, 12.0, 25), count=3)

_, ax = plt.subplots(figsize=(6, 4.5))
diagram.plot(ax)
plt.show()

# %%
# The line :math:`2\omega` meets the first lag mode here:
first = next(c for c in diagram.crossings if (c.mode, c.order) == ("lag 1", 2))
print(f"lag 1 meets 2ω at ω = {first.omega:.6f} rad/s")

# %%
# If the section is known, the diagram includes flap, out of the plane, and torsion. The example is
# a rectangle with the paper's A and I. It is so thin that it flaps like a chain, at ω, √6 ω and
# √15 ω, and torsion is as slow as its third lag mode.
strip = Beam.reference().with_shape(Rectangle())
_, ax = plt.subplots(figsize=(6, 4.5))
diagram.plot(ax, highest=80.0)
for family, look, count in (("flap", "C1--", 3), ("torsion", "C2-.", 1)):
    found = campbell(strip, diagram.omegas[::2], count, only=family)
    ax.plot(found.omegas, found.frequencies, look)
    ax.plot(*np.transpose([(met.omega, met.frequency) for met in found.crossings]), "k.", ms=4)
    for name, end in zip(found.names, found.frequencies[-1], strict=True):
        ax.annotate(name, (12.0, end), (4, -3), textcoords="offset points", color=look[:2])
plt.show()
