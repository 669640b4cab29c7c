"""Wheels cut by hand: each tooth with its own place, height and flanks; their law, where they jam, and how often."""

from geartrain.uncertainty.cutting.batch import Verdicts, batch_verdicts
from geartrain.uncertainty.cutting.drawing import Cutting, Spread
from geartrain.uncertainty.cutting.events import Event, Events
from geartrain.uncertainty.cutting.law import CutLaw, cut_law
from geartrain.uncertainty.cutting.play import jam_bound, nominal_play
from geartrain.uncertainty.cutting.wheel import CutWheel

__all__ = [
    "CutLaw",
    "CutWheel",
    "Cutting",
    "Event",
    "Events",
    "Spread",
    "Verdicts",
    "batch_verdicts",
    "cut_law",
    "jam_bound",
    "nominal_play",
]
