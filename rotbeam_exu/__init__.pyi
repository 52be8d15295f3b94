from .linearization import growth_rate as growth_rate
from .linearization import natural_frequencies as natural_frequencies
from .linearization import steady_stretch as steady_stretch
from .oscillation import SteadyOscillation as SteadyOscillation
from .oscillation import steady_oscillation as steady_oscillation
from .simulation import simulate as simulate
from .stability import critical_speed as critical_speed
from .storage import load as load
from .storage import save as save
from .sweeps import sweep as sweep
from .verdict import SimulationError as SimulationError

__version__: str
