"""The exact blade in space: twist, precone, offsets; flap, lag and torsion together."""
