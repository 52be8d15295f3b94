"""Changes of the speed without residual vibration: closed form, and ramps that make it small."""
