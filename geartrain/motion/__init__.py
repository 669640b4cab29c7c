"""Motion with real teeth and pins: errors composed through the whole train."""

from geartrain.motion.composition import Composition, DivergenceError, Source
from geartrain.motion.rippling import Motion, Ripple, Train

__all__ = ["Composition", "DivergenceError", "Motion", "Ripple", "Source", "Train"]
