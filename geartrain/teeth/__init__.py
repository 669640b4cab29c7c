"""Teeth of gear pairs: forms, what a pair with real teeth does, the outlines of its wheels, pins in slots.

In: two tooth numbers, a form as a pair declares it (`tooth_form`), friction, sizes. Out: a `GearMesh`, whatever the
form: verdict and play, transmission function on drive and coast flanks, efficiency, the outline to cut. Each form is
one file, and each has a method `law` for a pair without a train.

Conjugate forms keep the ratio of tooth numbers by the law of gearing: the common normal passes the pitch point
(docs/shapes.md). Triangular teeth follow F. Sorge's equations (docs/teeth.md, with its errata), teeth that are given by
outlines alone the contact of these (`geartrain.teeth.contact`), pins plane geometry.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from geartrain.numerics.lazy_names import lazy_names

if TYPE_CHECKING:
    from geartrain.teeth import any_tooth_form
    from geartrain.teeth.any_tooth_form import *  # noqa: F403
    from geartrain.teeth.friction_law import BuckinghamFriction as BuckinghamFriction
    from geartrain.teeth.friction_law import DokosFriction as DokosFriction
    from geartrain.teeth.friction_law import FrictionLaw as FrictionLaw
    from geartrain.teeth.friction_law import PairFriction as PairFriction
    from geartrain.teeth.friction_law import StribeckFriction as StribeckFriction
    from geartrain.teeth.friction_law import TabulatedFriction as TabulatedFriction
    from geartrain.teeth.gear_mesh import GearMesh as GearMesh
    from geartrain.teeth.outlines.cut_wheel import BlankSizes as BlankSizes
    from geartrain.teeth.outlines.cut_wheel import WheelOutline as WheelOutline
    from geartrain.teeth.pair_verdict import PairVerdict as PairVerdict
    from geartrain.teeth.pin_transmission import PinToSlotTransmission as PinToSlotTransmission
    from geartrain.teeth.pin_transmission import SlotToPinTransmission as SlotToPinTransmission
    from geartrain.teeth.rubbed_transmission import RubbedTransmission as RubbedTransmission
    from geartrain.teeth.transmission import TransmissionFunction as TransmissionFunction
    from geartrain.teeth.transmission_figures import SlidingEfficiency as SlidingEfficiency
    from geartrain.teeth.transmission_figures import SpeedRatio as SpeedRatio
    from geartrain.teeth.transmission_figures import TransmissionError as TransmissionError

    __all__ = [
        "BlankSizes",
        "BuckinghamFriction",
        "DokosFriction",
        "FrictionLaw",
        "GearMesh",
        "PairFriction",
        "PairVerdict",
        "PinToSlotTransmission",
        "RubbedTransmission",
        "SlidingEfficiency",
        "SlotToPinTransmission",
        "SpeedRatio",
        "StribeckFriction",
        "TabulatedFriction",
        "TransmissionError",
        "TransmissionFunction",
        "WheelOutline",
    ]
    __all__ += any_tooth_form.__all__

_PLACES = {
    "BlankSizes": "outlines.cut_wheel",
    "BuckinghamFriction": "friction_law",
    "DokosFriction": "friction_law",
    "FrictionLaw": "friction_law",
    "GearMesh": "gear_mesh",
    "PairFriction": "friction_law",
    "PairVerdict": "pair_verdict",
    "PinToSlotTransmission": "pin_transmission",
    "RubbedTransmission": "rubbed_transmission",
    "SlidingEfficiency": "transmission_figures",
    "SlotToPinTransmission": "pin_transmission",
    "SpeedRatio": "transmission_figures",
    "StribeckFriction": "friction_law",
    "TabulatedFriction": "friction_law",
    "TransmissionError": "transmission_figures",
    "TransmissionFunction": "transmission",
    "WheelOutline": "outlines.cut_wheel",
}

_find = lazy_names(__name__, _PLACES)


def __getattr__(name: str) -> Any:
    """A public name; the forms are those of the union, which is imported for one of them and not before."""
    if name in _PLACES:
        return _find(name)
    if not name.startswith("_") or name == "__all__":
        union = import_module("geartrain.teeth.any_tooth_form")
        if name == "__all__":
            return sorted([*_PLACES, *union.__all__])
        if name in union.__all__:
            return getattr(union, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
