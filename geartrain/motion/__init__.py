"""Motion with real teeth and pins: errors composed through the whole train."""

from geartrain.motion.composition import Composition, DivergenceError, Source
from geartrain.motion.rippling import Motion, Moving, Ripple

__all__ = ["Composition", "DivergenceError", "Motion", "Moving", "Ripple", "Source"]
