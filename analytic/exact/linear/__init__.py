"""Linear modes about the steady state, with damping and over the speed."""
