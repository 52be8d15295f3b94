r"""A ramp without residual vibration
=================================

To 6 rad/s in 4 s: the ramp of the paper, Eq. 1, and one whose acceleration has a few more
harmonics, designed so that the first two modes are at rest when it ends. Both are computed by
finite elements, which are independent of the design.
"""

import matplotlib.pyplot as plt
import numpy as np

from analytic import Beam, SpinUp, design_ramp
from rotbeam_exu import figures, simulate

plt.style.use(figures.STYLE)
beam, T = Beam.reference(), 4.0
ramps = {
    "Eq. 1": SpinUp(omega=6.0, ramp_time=T),
    "designed": design_ramp(beam, omega=6.0, duration=T),
}

_, (above, below) = plt.subplots(nrows=2, sharex=True, figsize=(6, 5))
left = {}
for name, ramp in ramps.items():
    run = simulate(beam, ramp, duration=10.0)
    left[name] = 0.5 * np.ptp(run["q"].sel(time=slice(T, None)).to_numpy()) / beam.length
    above.plot(run["time"], ramp.acceleration(run["time"].to_numpy()), label=name)
    below.plot(run["time"], run["q"] / beam.length)
above.set(ylabel="acceleration [rad/s²]")
above.legend()
below.set(xlabel="time [s]", ylabel="tip displacement q/L", xlim=(0.0, 10.0))
plt.show()

# %%
# Half peak to peak after the ramp, over the length:
print({name: f"{size:.1e}" for name, size in left.items()})
