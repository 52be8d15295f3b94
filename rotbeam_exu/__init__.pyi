from .datasets import dataset_of as dataset_of
from .fem.linearization import natural_frequencies as natural_frequencies
from .fem.simulation import kicked as kicked
from .fem.simulation import simulate as simulate
from .files.results import load as load
from .files.results import save as save
from .runs.check import SimulationError as SimulationError
from .runs.oscillation import steady_oscillation as steady_oscillation
from .sweeps.grid import sweep as sweep

__version__: str
