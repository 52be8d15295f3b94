"""Changes of the speed that leave nothing: the residual in closed form, and what makes it small."""
