r"""Phase space
===========

One period of the tip's orbit, Fig. 15 of the paper: finite elements, the reduced models, and the
exact beam at the same peak. The orbit of a model with a wrong frequency does not close. C and Fr
have the cantilever's and the rotating mode, I and E are inextensible and extensible; FrC has a
consistent foreshortening, and FrM all other bending modes as well.
"""

import matplotlib.pyplot as plt

from rotbeam_exu import comparison, figures

data = comparison.figure_15(omega=6.0, ramp_time=3.0)
figures.figure_15(data)
plt.show()

# %%
# The difference of each model's period from that of the finite element run:
period = data["period"]
miss = period / period.sel(model="finite element") - 1.0
for name in data["model"].to_numpy():
    print(f"{name:15s} {100.0 * miss.sel(model=name).item():+.3f} %")
