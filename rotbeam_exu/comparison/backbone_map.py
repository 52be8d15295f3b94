"""The exact backbone over speed and amplitude as a Dataset, to be kept in a file."""

from __future__ import annotations

from analytic import BackboneMap

from ..lazily import xr
from ..verdict import beam_attributes, beam_of

_NONE, _SPEED = {"units": "1"}, {"units": "rad/s"}


def backbone_map_data(found: BackboneMap) -> xr.Dataset:
    """Return a map of exact backbones as a Dataset, which `save` writes.

    Parameters
    ----------
    found : BackboneMap
        As `analytic.backbone_map` makes it.

    Returns
    -------
    Dataset
        Over omega [rad/s]: omega_n [rad/s], reach; over (omega, power) the coefficients `ratio` and
        `first_harmonic` of a²ᵏ of ω_NL/ω_n and of the first harmonic over the peak a; over cell,
        between one speed and the next, cell_reach: the peaks |q|/L up to which the map holds there.
    """
    return xr.Dataset(
        {
            "omega_n": ("omega", found.omega_n, {**_SPEED, "long_name": "natural frequency ω_n"}),
            "reach": ("omega", found.reach, {**_NONE, "long_name": "largest a of the curve"}),
            "ratio": (("omega", "power"), found.series, {**_NONE, "long_name": "of ω_NL/ω_n"}),
            "first_harmonic": (
                ("omega", "power"),
                found.first,
                {**_NONE, "long_name": "of the first harmonic over a"},
            ),
            "cell_reach": ("cell", found.cell_reach, {**_NONE, "long_name": "largest a between"}),
        },
        coords={"omega": ("omega", found.speeds, {**_SPEED, "long_name": "angular velocity ω"})},
        attrs={
            **beam_attributes(found.beam),
            "mode": found.mode,
            "tolerance": found.tolerance,
            "up_to": found.up_to,
        },
    )


def backbone_map_of(data: xr.Dataset) -> BackboneMap:
    """Return the map that a Dataset of `backbone_map_data` holds, as `load` reads it.

    Raises
    ------
    ValueError
        If something is missing, which the sentence names.
    """
    wanted = {"omega", "omega_n", "reach", "ratio", "first_harmonic", "cell_reach"}
    missing = sorted(wanted - set(map(str, data.variables)))
    missing += sorted({"mode", "tolerance", "up_to"} - set(map(str, data.attrs)))
    if missing:
        raise ValueError(
            f"this is no map of backbones, it has no {', '.join(missing)}: make one by "
            f"backbone_map_data"
        )
    return BackboneMap(
        beam=beam_of(data.attrs),
        mode=int(data.attrs["mode"]),
        tolerance=float(data.attrs["tolerance"]),
        up_to=float(data.attrs["up_to"]),
        speeds=data["omega"].to_numpy(),
        omega_n=data["omega_n"].to_numpy(),
        reach=data["reach"].to_numpy(),
        series=data["ratio"].to_numpy(),
        first=data["first_harmonic"].to_numpy(),
        cell_reach=data["cell_reach"].to_numpy(),
    )
