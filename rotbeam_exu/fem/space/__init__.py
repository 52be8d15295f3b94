"""The blade in space: Exudyn's elements in three dimensions, and what leaves the plane."""
