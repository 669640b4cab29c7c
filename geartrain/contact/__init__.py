"""Contact of two given outlines of any shape: driven angle, play, which teeth touch where, the law of a whole period.

It knows neither normals nor paths of contact: the driven wheel stands where the last point of the driver's outline lets
it. That makes it a judge of teeth that are derived in other ways, and gives a law to teeth that are worn, misplaced or
displaced.
"""

from geartrain.contact.outline import Curve, Outline, Tooth, polyline
from geartrain.contact.solving import Contact, Touch, contact, solve
from geartrain.contact.tabulating import tabulate

__all__ = ["Contact", "Curve", "Outline", "Tooth", "Touch", "contact", "polyline", "solve", "tabulate"]
