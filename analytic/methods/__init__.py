"""Periodic solutions and integration in time of M q̈ + f(q, q̇, t) = 0; no beam is known here."""
