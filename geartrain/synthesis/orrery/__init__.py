"""Several periods from one arbor with few wheels."""

from geartrain.synthesis.orrery.orrery import Orrery
from geartrain.synthesis.orrery.sharing import share

__all__ = ["Orrery", "share"]
