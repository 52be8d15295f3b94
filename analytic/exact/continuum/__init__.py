"""The beam itself: its shapes, its equations in the plane and out of it, its steady state."""
