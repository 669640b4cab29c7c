"""Train with inertia: input speed at which tooth contact is lost, and contact model for time integration
(docs/dynamics.md).

link_inertia        moments of inertia of links, declared or by Green's theorem from the outlines of wheels
inertial_contacts   torques that pairs carry due to inertia, loads and friction (d'Alembert's principle)
separation_rate     input speed at which teeth first separate (`find_separation`), and impacts of teeth
time_case           inertia, drag, restitution and drive of a train in one state
train_model         train as coordinates and contacts, with ideal pairs eliminated exactly
compliant_train     train model with stiffness and damping of teeth
contact_model       coordinates, contacts, bearings, stops and springs, and their arrays for the kernels
bearing_forces      forces of pairs on bearings whose friction grows with their load, as arrays
pair_tables         transmission functions as tables of polynomials between kinks
rubbing_arms        friction of teeth and pins as an addition to the lever arm of the driver
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.simulation.contacts.compliant_train import damping_ratio as damping_ratio
    from geartrain.simulation.contacts.contact_model import Bearing as Bearing
    from geartrain.simulation.contacts.contact_model import ContactModel as ContactModel
    from geartrain.simulation.contacts.contact_model import ContactPair as ContactPair
    from geartrain.simulation.contacts.contact_model import ToothCompliance as ToothCompliance
    from geartrain.simulation.contacts.inertial_contacts import InertialContacts as InertialContacts
    from geartrain.simulation.contacts.inertial_contacts import find_inertial_loads as find_inertial_loads
    from geartrain.simulation.contacts.inertial_contacts import minimum_rate as minimum_rate
    from geartrain.simulation.contacts.pair_tables import tabled_angle as tabled_angle
    from geartrain.simulation.contacts.rubbing_arms import separate_rubbing as separate_rubbing
    from geartrain.simulation.contacts.separation_rate import find_tooth_impacts as find_tooth_impacts
    from geartrain.simulation.contacts.train_model import SlackPin as SlackPin

__getattr__, __all__ = public_names(
    __name__,
    {
        "compliant_train": "damping_ratio",
        "contact_model": "Bearing ContactModel ContactPair ToothCompliance",
        "inertial_contacts": "InertialContacts find_inertial_loads minimum_rate",
        "pair_tables": "tabled_angle",
        "rubbing_arms": "separate_rubbing",
        "separation_rate": "find_tooth_impacts",
        "train_model": "SlackPin",
    },
)
