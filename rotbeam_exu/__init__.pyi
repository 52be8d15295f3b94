from .datasets import dataset_of as dataset_of
from .fem.linearization import growth_rate as growth_rate
from .fem.linearization import natural_frequencies as natural_frequencies
from .fem.linearization import steady_stretch as steady_stretch
from .fem.simulation import simulate as simulate
from .fem.space.linearization import flap_frequencies as flap_frequencies
from .fem.space.picture import ray_traced as ray_traced
from .fem.space.simulation import simulate_3d as simulate_3d
from .fem.stability import critical_speed as critical_speed
from .fem.stability import divergence_speed as divergence_speed
from .files.results import load as load
from .files.results import save as save
from .growth import GrowthRate as GrowthRate
from .growth import growth_rate_of as growth_rate_of
from .oscillation import SteadyOscillation as SteadyOscillation
from .oscillation import steady_oscillation as steady_oscillation
from .sweeps.grid import sweep as sweep
from .verdict import SimulationError as SimulationError

__version__: str
