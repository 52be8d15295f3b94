r"""The branch that leaves the plane
================================

Where planar orbits become unstable, orbits in space are born. On the left the paper's beam as a
strip, at rest: it stands bent to one side, and swings and twists about that place, ever slower. On
the right a section 1.36 times as high as wide, at 2 rad/s, whose flap is as fast as its lag: the
tip whirls. Black are the planar orbits; dashed is unstable.
"""

import matplotlib.pyplot as plt
import numpy as np

from analytic import Beam, Rectangle, backbone, planar_stability
from rotbeam_exu import figures

plt.style.use(figures.STYLE)
beam = Beam.reference()
strip = backbone(beam.with_shape(Rectangle()), omega=0.0, functions=12)
thick = backbone(beam.blade.with_shape(Rectangle(ratio=1.36)), omega=2.0, functions=8)
branches = [strip.leaving(0.0074, 0.0079, points=11), thick.leaving(0.2, 0.3, points=18)]
titles = ["strip, at rest", "h/b = 1.36, 2 rad/s"]

_, axes = plt.subplots(1, 2, figsize=(7.0, 3.2), layout="constrained")
for ax, branch, title in zip(axes, branches, titles, strict=True):
    print(branch)
    branch.plot(ax)
    top = 1.8 * branch.born.amplitude
    planar = planar_stability(branch.beam, branch.omega, np.linspace(0.0, top, 24)[1:])
    for part, look in ((planar.stable, "k-"), (~planar.stable, "k--")):
        ax.plot(np.where(part, planar.frequency, np.nan), planar.amplitude, look)
    ax.set_title(title, loc="left")
axes[0].plot([], [], "k-", label="planar orbits")
axes[0].legend()
axes[1].get_legend().remove()
plt.show()
