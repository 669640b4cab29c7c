"""Teeth of gear pairs: tooth forms, pairs with real teeth, outlines of wheels, pins in slots.

Input: two tooth counts, a tooth form as a pair declares it, friction and sizes. Output: a `GearMesh`, whatever the
form, with its verdict, backlash, transmission functions of the drive and coast flanks, efficiency, and the outline to
cut. Each form is one file. Each has a method `transmission` that returns the transmission function of a pair without a
train.

tooth_form, any_tooth_form    base class of all forms; the forms by name
ideal                         the ratio of tooth counts at every instant
involute, cycloidal, lantern  conjugate forms in practical use
uniform_stress, uniform_temperature, least_friction
                              conjugate forms that are optimal (calculus of variations)
circular_arc, pin_ring        clock teeth of BS 978; cycloidal reducers
triangular                    triangular teeth of antiquity
table, given_transmission     transmission errors given by a table, by runout, or by an object of Python
eccentric_wheels              runout of involute wheels
standard_teeth                involutes for pairs that declare no form

meshing_wheels, gear_mesh     two wheels as declared; a pair of a train with its tooth geometry
transmission                  transmission function: driven angle, speed ratio and efficiency against the driver's angle
tooth_transmission            transmission function of toothed wheels: verdict, either driver, both directions
transmission_table            transmission functions as tables of polynomials; the compiled kernel that reads them
pair_results                  results, verdict and table rows of one pair
form_comparison               conjugate forms compared with the 20 degree involute
contact_coefficients          declared coefficients of Coulomb friction and restitution
friction_law                  friction that depends on speed (Stribeck, Buckingham, Dokos, a table)
rubbed_transmission           losses of a pair under such friction
coupling, couplings           base class and kinds of couplings other than gear pairs, such as pins in slots
cycloidal_disc                lobed disc in a ring of pins (shortened epitrochoid)

conjugate                     teeth from their path of contact, for spur and bevel wheels
contact                       contact of two outlines of any shape
outlines                      closed outlines of wheels to cut

Conjugate forms keep the ratio of tooth counts by the law of gearing: the common normal passes through the pitch point
(docs/shapes.md). Triangular teeth follow F. Sorge's equations (docs/teeth.md, with its errata). Teeth given only by
their outlines are solved as a contact problem, and pins by plane geometry.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import lazy_names
from geartrain.teeth.any_tooth_form import TOOTH_FORMS

if TYPE_CHECKING:
    from geartrain.teeth.circular_arc import CircularArc
    from geartrain.teeth.couplings.pin_transmission import PinToSlotTransmission, SlotToPinTransmission
    from geartrain.teeth.cycloidal import Cycloidal
    from geartrain.teeth.form_comparison import compare_forms
    from geartrain.teeth.friction_law import (
        BuckinghamFriction,
        DokosFriction,
        FrictionLaw,
        PairFriction,
        StribeckFriction,
        TabulatedFriction,
    )
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.given_transmission import TransmissionProtocol
    from geartrain.teeth.ideal import Ideal
    from geartrain.teeth.involute import Involute
    from geartrain.teeth.lantern import Lantern
    from geartrain.teeth.least_friction import LeastFriction
    from geartrain.teeth.outlines.wheel_outline import BlankSizes, WheelOutline
    from geartrain.teeth.pair_results import PairVerdict, SlidingEfficiency, SpeedRatio, TransmissionError
    from geartrain.teeth.pin_ring import PinRing
    from geartrain.teeth.rubbed_transmission import RubbedTransmission
    from geartrain.teeth.table import GivenError
    from geartrain.teeth.transmission import TransmissionFunction
    from geartrain.teeth.triangular import Triangular
    from geartrain.teeth.uniform_stress import UniformStress
    from geartrain.teeth.uniform_temperature import UniformTemperature

__all__ = [
    "BlankSizes",
    "BuckinghamFriction",
    "CircularArc",
    "Cycloidal",
    "DokosFriction",
    "FrictionLaw",
    "GearMesh",
    "GivenError",
    "Ideal",
    "Involute",
    "Lantern",
    "LeastFriction",
    "PairFriction",
    "PairVerdict",
    "PinRing",
    "PinToSlotTransmission",
    "RubbedTransmission",
    "SlidingEfficiency",
    "SlotToPinTransmission",
    "SpeedRatio",
    "StribeckFriction",
    "TabulatedFriction",
    "TransmissionError",
    "TransmissionFunction",
    "TransmissionProtocol",
    "Triangular",
    "UniformStress",
    "UniformTemperature",
    "WheelOutline",
    "compare_forms",
]

_PLACES = {
    **dict.fromkeys(("BlankSizes", "WheelOutline"), "outlines.wheel_outline"),
    **dict.fromkeys(
        ("BuckinghamFriction", "DokosFriction", "FrictionLaw", "PairFriction", "StribeckFriction", "TabulatedFriction"),
        "friction_law",
    ),
    "GearMesh": "gear_mesh",
    **dict.fromkeys(("PairVerdict", "SlidingEfficiency", "SpeedRatio", "TransmissionError"), "pair_results"),
    **dict.fromkeys(("PinToSlotTransmission", "SlotToPinTransmission"), "couplings.pin_transmission"),
    "RubbedTransmission": "rubbed_transmission",
    "TransmissionFunction": "transmission",
    "TransmissionProtocol": "given_transmission",
    "compare_forms": "form_comparison",
    **{kind: name for name, kind in TOOTH_FORMS.items()},
}

__getattr__ = lazy_names(__name__, _PLACES)
