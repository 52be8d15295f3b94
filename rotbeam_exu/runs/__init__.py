"""A run, whoever computed it: its checks, its steady oscillation. Knows no Exudyn."""
