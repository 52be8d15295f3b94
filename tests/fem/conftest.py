import exudyn
import numpy as np
import pytest

from rotbeam_exu.fem.solver import exudyn_system


@pytest.fixture(scope="session")
def elastic_force():
    """Forces inside a free chain as Exudyn adds them up, flat, and the chain's reference."""

    def evaluate(model, beam, elements, coordinates=None, velocities=None):
        with exudyn_system() as mbs:
            chain = model.lay(mbs, beam, elements)
            mbs.Assemble()
            reference = np.array(
                [mbs.GetNodeParameter(n, "referenceCoordinates") for n in chain.nodes]
            )
            force = np.zeros(reference.size)
            if coordinates is not None:
                displacement = (coordinates - reference).ravel()
                mbs.systemData.SetODE2Coordinates(displacement)
                settings = exudyn.SimulationSettings()
                settings.solution.file.write = False
                solver = exudyn.MainSolverStatic()
                solver.InitializeSolver(mbs, settings)
                mbs.systemData.SetODE2Coordinates(displacement)
                if velocities is not None:
                    mbs.systemData.SetODE2Coordinates_t(velocities.ravel())
                solver.ComputeODE2RHS(mbs)
                force = np.array(solver.GetSystemResidual())[: reference.size]
                solver.FinalizeSolver(mbs, settings)
        return force, reference

    return evaluate
