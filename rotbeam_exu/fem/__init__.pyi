from .rotating_beam import RotatingBeam as RotatingBeam
from .rotating_beam import add_rotating_beam as add_rotating_beam
