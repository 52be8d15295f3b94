r"""Is the motion planar?
=====================

The paper's :math:`A` and :math:`I` may be those of a rectangle or of a thin tube. The tube stays in
the plane of rotation; the rectangle, 37 mm by 2 mm, leaves it. These are the four pictures of
:doc:`/theory/planar`. The first one shows which planar orbits of the rectangle leave the plane, if
flap and torsion have a damping ratio of 0.5 %.
"""

import runpy
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.animation import FFMpegWriter

import analytic
from analytic import Beam, Rectangle, SpinUp, Tube, backbone, periodic_orbits, stability_limit
from rotbeam_exu import comparison, figures, kicked, simulate

FILM = "html5" if FFMpegWriter.isAvailable() else "jshtml"
plt.style.use([figures.STYLE, {"animation.html": FILM}])
beam = Beam.reference()
strip, tube = beam.with_shape(Rectangle()), beam.with_shape(Tube(radius=0.015, wall=0.00077))
data = comparison.growth_out_of_plane(
    strip, omegas=np.linspace(0.0, 7.0, 36), amplitudes=np.geomspace(0.01, 0.3, 56)
)
ends = {2.0: [0.098, 0.119, 0.166, 0.219, 0.276], 4.0: [0.156, 0.190, 0.268], 6.0: [0.196, 0.231]}
points = np.transpose([(omega, a) for omega, found in ends.items() for a in found])
ax = figures.growth_out_of_plane(data)
ax.plot(*points, "wo", ms=3.2, mec="black", mew=0.7, label="ends of the paper's spin-ups")
_ = ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2)

# %%
# The limit at a speed, and the tube where the spin-ups to 4 rad/s end:
limit = stability_limit(strip, 4.0, damping=0.005, largest=0.1)
round_one = periodic_orbits(tube, 4.0, ends[4.0]).out_of_plane()
print(limit, round_one, sep="\n")

# %%
# Where planar orbits become unstable, orbits in space are born. On the left the strip at rest: it
# stands bent to one side, and swings and twists about that place, ever slower. On the right a
# section 1.36 times as high as wide, at 2 rad/s, whose flap is as fast as its lag: the tip whirls.
# Black are the planar orbits; dashed is unstable.
at_rest = backbone(strip, omega=0.0, functions=12)
plank = beam.with_hub_radius(0.0).with_shape(Rectangle(ratio=1.36))  # of another material
thick = backbone(plank, omega=2.0, functions=8)
branches = [at_rest.leaving(0.0074, 0.0079, points=11), thick.leaving(0.2, 0.3, points=18)]

_, axes = plt.subplots(1, 2, figsize=(7.0, 3.2), layout="constrained")
titles = ["strip, at rest", "h/b = 1.36, 2 rad/s"]
for ax, branch, title in zip(axes, branches, titles, strict=True):
    print(branch)
    branch.plot(ax)
    top = 1.8 * branch.born.amplitude
    planar = periodic_orbits(
        branch.blade, branch.omega, np.linspace(0.0, top, 24)[1:]
    ).out_of_plane()
    ax.plot(planar.frequency, planar.amplitude, "k--", lw=1.0)
    ax.plot(np.where(planar.stable, planar.frequency, np.nan), planar.amplitude, "k-", lw=1.6)
    ax.set_title(title, loc="left")
    ax.get_legend().remove()
colors = {"lag": "C0", "flap": "C1", "twist": "C2", "planar orbits": "k"}
places = (
    {"lag": (0.72, 0.84), "flap": (0.3, 0.4), "twist": (0.58, 0.57), "planar orbits": (0.63, 0.92)},
    {
        "lag": (0.47, 0.76),
        "flap": (0.36, 0.55),
        "twist": (0.3, 0.36),
        "planar orbits": (0.62, 0.72),
    },
)
for ax, words in zip(axes, places, strict=True):
    for word, place in words.items():
        ax.text(*place, word, color=colors[word], transform=ax.transAxes)

# %%
# The strip buckles in the spin-up to 6 rad/s in 3 s. Three codes have the same motion up to 1.5 s;
# their tables were made once, in hours, by ``models/strip/run.py``.
tables = Path(analytic.__file__).parents[1] / "models" / "strip"
codes = runpy.run_path(f"{tables}/three_codes.py")["figure"]()

# %%
# The same spin-up by Exudyn, and the tube's. Both start 8 mm out of the plane. Seen in the plane
# and edgewise, magnified, from the turning clamp.
spin_up = SpinUp(omega=6.0, ramp_time=3.0)
settings = {"element": "space_exact", "duration": 3.1, "initial_state": kicked(beam, 1e-3)}
rectangle = simulate(
    strip, spin_up, **settings, elements=32, step=4e-4,
    stations=np.linspace(0.0, beam.length, 33),
)  # fmt: skip
stays = simulate(tube, spin_up, **settings, step=5e-3)
_, (above, edgewise, largest) = plt.subplots(
    3, figsize=(3.5, 5.6), height_ratios=[1.8, 1.0, 1.0], layout="constrained"
)
for t, look in ((0.2, "-"), (0.8, "--"), (1.0, "-."), (1.4, ":")):
    x, y, z = rectangle["axis"].sel(time=t, method="nearest").to_numpy().T / beam.length
    (line,) = above.plot(x, y, look)
    above.text(x[-1] + 0.02, y[-1] - 0.02, f"{t} s", color=line.get_color())
    edgewise.plot(x, z, look)
above.set(aspect="equal", xlim=(0.0, 1.15), ylim=(-0.85, 0.05), xlabel="x/L", ylabel="y/L")
edgewise.set(xlim=(0.0, 1.15), xlabel="x/L", ylabel="z/L")
for run, look, name in ((rectangle, "k-", "rectangle"), (stays, "k--", "tube")):
    out = abs(run["axis"][..., 2]).max("node") / beam.length
    largest.semilogy(run["time"], out, look, label=name)
largest.set(xlabel="time [s]", ylabel="largest |w|/L", xlim=(0.0, 3.1))
largest.legend(loc="upper left")
plt.show()
left = rectangle["time"][(abs(rectangle["twist"]) > 0.1).argmax("time")].item()

# %%
shown = [np.abs(rectangle["time"].to_numpy() - 0.05 * k).argmin() for k in range(63)]
animation = figures.animate(rectangle.isel(time=shown), rate=10)
plt.close(animation._fig)
animation  # noqa: B018
