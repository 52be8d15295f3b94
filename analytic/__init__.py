"""The rotating cantilever beam on paper: reduced models and the exact continuum solution.

`reduced` is the paper, one degree of freedom; `exact` the geometrically exact beam; `methods`
what knows of no beam, periodic solutions and integration in time. Needs numpy, scipy and sympy;
knows nothing of any multibody code. Importing it is cheap: the public names, listed in the stub
`__init__.pyi`, are loaded when they are first used.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
