"""The blade in space: Exudyn's three-dimensional elements, and what leaves the plane."""
