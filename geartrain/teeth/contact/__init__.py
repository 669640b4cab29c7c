"""Contact of two given outlines of any shape: driven angle, play, which teeth touch where, the law of a whole period.

It knows neither normals nor paths of contact: the driven wheel stands where the last point of the driver's outline lets
it. That makes it a judge of teeth that are derived in other ways, and gives a law to teeth that are worn, misplaced or
displaced.
"""

from geartrain.teeth.contact.gear_outline import GearOutline, ToothFlanks
from geartrain.teeth.contact.outline_contact import FlankContact, TwoFlankContact, contact, solve
from geartrain.teeth.contact.outline_curve import OutlineCurve, polyline
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
