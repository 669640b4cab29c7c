"""Teeth of gear pairs: tooth forms, pairs with real teeth, outlines of wheels, pins in slots.

The input is two tooth counts, the tooth form that a pair declares, friction and sizes. The output is a `GearMesh` with
its verdict, backlash, transmission functions of the drive and coast flanks, efficiency, and the outline to cut, for all
forms. Each form is one file and has a method `transmission` that returns the transmission function of a pair without a
train.

tooth_form, any_tooth_form    base class of all forms; the forms by name
ideal                         the ratio of tooth counts at every instant
involute, cycloidal, lantern  conjugate forms in practical use
uniform_stress, uniform_temperature, least_friction
                              conjugate forms that are optimal (calculus of variations)
circular_arc, pin_ring        clock teeth of BS 978; cycloidal reducers
triangular                    triangular teeth of antiquity
table, given_transmission     transmission errors given by a table, by runout, or by a Python object
eccentric_wheels              runout of involute wheels
standard_teeth                involutes for pairs that declare no form

meshing_wheels, gear_mesh     two wheels as declared; a pair of a train with its tooth geometry
transmission                  transmission function: driven angle, speed ratio and efficiency against the driver's angle
tooth_transmission            transmission function of toothed wheels: verdict, either driver, both directions
transmission_table            transmission functions as tables of polynomials
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

from geartrain.numerics.lazy_names import public_names
from geartrain.teeth.any_tooth_form import TOOTH_FORMS

if TYPE_CHECKING:
    from geartrain.teeth.circular_arc import CircularArc as CircularArc
    from geartrain.teeth.couplings.pin_transmission import PinToSlotTransmission as PinToSlotTransmission
    from geartrain.teeth.couplings.pin_transmission import SlotToPinTransmission as SlotToPinTransmission
    from geartrain.teeth.cycloidal import Cycloidal as Cycloidal
    from geartrain.teeth.form_comparison import compare_forms as compare_forms
    from geartrain.teeth.friction_law import BuckinghamFriction as BuckinghamFriction
    from geartrain.teeth.friction_law import DokosFriction as DokosFriction
    from geartrain.teeth.friction_law import FrictionLaw as FrictionLaw
    from geartrain.teeth.friction_law import PairFriction as PairFriction
    from geartrain.teeth.friction_law import StribeckFriction as StribeckFriction
    from geartrain.teeth.friction_law import TabulatedFriction as TabulatedFriction
    from geartrain.teeth.gear_mesh import GearMesh as GearMesh
    from geartrain.teeth.given_transmission import TransmissionProtocol as TransmissionProtocol
    from geartrain.teeth.ideal import Ideal as Ideal
    from geartrain.teeth.involute import Involute as Involute
    from geartrain.teeth.lantern import Lantern as Lantern
    from geartrain.teeth.least_friction import LeastFriction as LeastFriction
    from geartrain.teeth.outlines.wheel_outline import BlankSizes as BlankSizes
    from geartrain.teeth.outlines.wheel_outline import WheelOutline as WheelOutline
    from geartrain.teeth.pin_ring import PinRing as PinRing
    from geartrain.teeth.table import GivenError as GivenError
    from geartrain.teeth.transmission import TransmissionFunction as TransmissionFunction
    from geartrain.teeth.triangular import Triangular as Triangular
    from geartrain.teeth.uniform_stress import UniformStress as UniformStress
    from geartrain.teeth.uniform_temperature import UniformTemperature as UniformTemperature

__getattr__, __all__ = public_names(
    __name__,
    {
        "couplings.pin_transmission": "PinToSlotTransmission SlotToPinTransmission",
        "form_comparison": "compare_forms",
        "friction_law": "BuckinghamFriction DokosFriction FrictionLaw PairFriction StribeckFriction TabulatedFriction",
        "gear_mesh": "GearMesh",
        "given_transmission": "TransmissionProtocol",
        "outlines.wheel_outline": "BlankSizes WheelOutline",
        "transmission": "TransmissionFunction",
        **TOOTH_FORMS,
    },
)
