"""Contact of two outlines of any shape: driven angle, backlash, teeth in contact, transmission function over a
period.

Neither normals nor paths of contact are used: the driven angle is the maximum that any point of the driver's outline
requires. This provides an independent check of teeth that are derived in other ways, and the transmission function of
worn, misplaced or displaced teeth.

gear_outline              curves, teeth made of them, a wheel
first_touch               first point of the driver's side to touch (false position on each smooth segment)
outline_contact           driven angle, backlash and teeth in contact at given angles: `contact`, `solve`
transmission_fit          the periodic transmission function as polynomials (Chebyshev nodes): `tabulate`
outline_transmission      the transmission function with friction and verdict
outline_mesh              a pair of a train with such teeth
displaced_outlines        displaced flanks of such teeth
"""

from geartrain.teeth.contact.gear_outline import GearOutline, OutlineCurve, ToothFlanks, polyline
from geartrain.teeth.contact.outline_contact import FlankContact, TwoFlankContact, contact, solve
from geartrain.teeth.contact.transmission_fit import tabulate

__all__ = [
    "FlankContact",
    "GearOutline",
    "OutlineCurve",
    "ToothFlanks",
    "TwoFlankContact",
    "contact",
    "polyline",
    "solve",
    "tabulate",
]
