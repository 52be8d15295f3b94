"""Kratos: the corotational beam of its structural mechanics, by this package's adapter."""

import sys
from importlib.metadata import version
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))
from common import called, take_part

from rotbeam_exu.verification.peers import peer
from rotbeam_exu.verification.submission import Declaration

history = called(peer("kratos"))

if __name__ == "__main__":
    told = Declaration(
        code="Kratos", version=version("KratosMultiphysics"), licence="BSD-4-Clause",
        url="https://github.com/KratosMultiphysics/Kratos", order=2.0, order_in_step=2.0,
        element="CrBeamElement2D2N, corotational; Bossak's scheme, alpha = 0",
    )  # fmt: skip
    runs = [(16, 1e-3), (32, 1e-3), (64, 1e-3), (32, 2e-3), (32, 5e-4)]
    take_part(__file__, told, history, {"S1": runs})
