"""The spin-up of a rectangle leaves its plane
===========================================

A rectangle with the paper's A and I, 37 mm high and 2 mm wide, without gravity. With the tip 8 mm
out of the plane at first, it buckles sideways by w. A tube stays in the plane. Sections are drawn
as strips 0.4 m high.
"""

import matplotlib.pyplot as plt
from matplotlib.animation import ArtistAnimation

from analytic import Beam, Rectangle, SpinUp, Tube
from rotbeam_exu import figures, kicked, simulate
from rotbeam_exu.fem.picture import ray_traced

plt.style.use([figures.STYLE, {"animation.html": "jshtml"}])
beam = Beam.reference()
spin_up = SpinUp(omega=6.0, ramp_time=3.0)
settings = {"element": "space_exact", "duration": 3.4, "initial_state": kicked(beam, 1e-3)}
rectangle = simulate(beam.with_shape(Rectangle()), spin_up, **settings, elements=32, step=2.5e-4)
tube = simulate(beam.with_shape(Tube(radius=0.015, wall=0.00077)), spin_up, **settings, step=5e-3)
_, (picture, axes) = plt.subplots(2, height_ratios=[2.0, 1.0], figsize=(6.0, 4.8))
picture.imshow(ray_traced(rectangle, [0.8, 1.4, 1.8, 2.2, 3.0]))
picture.set(title="rectangle, at t = 0.8, 1.4, 1.8, 2.2, 3.0 s", xticks=[], yticks=[])
for run in (rectangle, tube):
    axes.semilogy(run["time"], abs(run["axis"][..., 2]).max("node") / beam.length)
axes.set(xlabel="t [s]", ylabel="largest |w| / L")
axes.legend(["rectangle", "tube"])
plt.show()
left = rectangle["time"][(abs(rectangle["twist"]) > 0.1).argmax("time")].item()
print(f"twisted by 0.1 rad at t = {left:.3f} s, the tip at q = {rectangle.q.sel(time=left):.2f} m")

# %%
# As a film:
screen = plt.figure(figsize=(5.0, 2.9)).add_subplot(frame_on=False, xticks=[], yticks=[])
shots = (ray_traced(rectangle, [0.6 + 0.05 * k], size=(480, 280)) for k in range(57))
animation = ArtistAnimation(screen.figure, [[screen.imshow(shot)] for shot in shots], interval=100)
plt.close(screen.figure)
animation  # noqa: B018
