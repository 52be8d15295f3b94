"""The rotating cantilever beam in Exudyn: models, sweeps, comparison with the theory, figures.

Importing it is cheap: the public names, listed in the stub `__init__.pyi`, are loaded when they
are first used.
"""

import lazy_loader

__version__ = "0.1.0"

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
