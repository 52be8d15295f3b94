"""The spin-up of a rectangle leaves its plane
===========================================

A rectangle with the paper's A and I, 37 mm by 2 mm, buckles sideways by w; a tube does not. Both
start 8 mm out of the plane. Seen in the plane and edgewise, magnified, from the turning clamp.
"""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.animation import FFMpegWriter

from analytic import Beam, Rectangle, SpinUp, Tube
from rotbeam_exu import figures, kicked, simulate

FILM = "html5" if FFMpegWriter.isAvailable() else "jshtml"
plt.style.use([figures.STYLE, {"animation.html": FILM}])
beam, spin_up = Beam.reference(), SpinUp(omega=6.0, ramp_time=3.0)
settings = {"element": "space_exact", "duration": 3.1, "initial_state": kicked(beam, 1e-3)}
rectangle = simulate(
    beam.with_shape(Rectangle()), spin_up, **settings, elements=32, step=4e-4,
    stations=np.linspace(0.0, beam.length, 33),
)  # fmt: skip
tube = simulate(beam.with_shape(Tube(radius=0.015, wall=0.00077)), spin_up, **settings, step=5e-3)
_, (above, edgewise, axes) = plt.subplots(3, figsize=(3.5, 5.6), height_ratios=[1.8, 1.0, 1.0])
for t, look in ((0.2, "-"), (0.8, "--"), (1.0, "-."), (1.4, ":")):
    x, y, z = rectangle["axis"].sel(time=t, method="nearest").to_numpy().T / beam.length
    (line,) = above.plot(x, y, look)
    above.text(x[-1] + 0.02, y[-1] - 0.02, f"{t} s", color=line.get_color())
    edgewise.plot(x, z, look)
above.set(aspect="equal", xlim=(0.0, 1.15), ylim=(-0.85, 0.05), xlabel="x/L", ylabel="y/L")
edgewise.set(xlim=(0.0, 1.15), xlabel="x/L", ylabel="z/L")
for run, look, name in ((rectangle, "k-", "rectangle"), (tube, "k--", "tube")):
    axes.semilogy(run["time"], abs(run["axis"][..., 2]).max("node") / beam.length, look, label=name)
axes.set(xlabel="time [s]", ylabel="largest |w|/L", xlim=(0.0, 3.1))
axes.legend(loc="upper left")
plt.show()
left = rectangle["time"][(abs(rectangle["twist"]) > 0.1).argmax("time")].item()
# %%
shown = [np.abs(rectangle["time"].to_numpy() - 0.05 * k).argmin() for k in range(63)]
animation = figures.animate(rectangle.isel(time=shown), rate=10)
plt.close(animation._fig)
animation  # noqa: B018
