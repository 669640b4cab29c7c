"""Motion with real teeth and pins: errors composed through the whole train."""

from geartrain.motion.composition import Composition, Passage, Source
from geartrain.motion.estimates import Estimates, Superposition, find_estimates
from geartrain.motion.impacts import Impact, find_impacts
from geartrain.motion.moving import Moving, find_moving
from geartrain.motion.rippling import Motion, Ripple
from geartrain.motion.run import Run
from geartrain.motion.spectrum import Line, find_spectrum
from geartrain.motion.tally import Tally

__all__ = [
    "Composition",
    "Estimates",
    "Impact",
    "Line",
    "Motion",
    "Moving",
    "Passage",
    "Ripple",
    "Run",
    "Source",
    "Superposition",
    "Tally",
    "find_estimates",
    "find_impacts",
    "find_moving",
    "find_spectrum",
]
