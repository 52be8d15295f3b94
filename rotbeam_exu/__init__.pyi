from .datasets import dataset_of as dataset_of
from .fem.linearization import flap_frequencies as flap_frequencies
from .fem.linearization import growth_rate as growth_rate
from .fem.linearization import natural_frequencies as natural_frequencies
from .fem.linearization import steady_stretch as steady_stretch
from .fem.out_of_plane import simulate_3d as simulate_3d
from .fem.picture import ray_traced as ray_traced
from .fem.simulation import simulate as simulate
from .fem.stability import divergence_speed as divergence_speed
from .files.results import load as load
from .files.results import save as save
from .runs.check import SimulationError as SimulationError
from .runs.growth import GrowthRate as GrowthRate
from .runs.growth import growth_rate_of as growth_rate_of
from .runs.oscillation import SteadyOscillation as SteadyOscillation
from .runs.oscillation import steady_oscillation as steady_oscillation
from .sweeps.grid import sweep as sweep

__version__: str
