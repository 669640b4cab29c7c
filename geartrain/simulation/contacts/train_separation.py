"""What inertia does to the teeth of a train: the rates at which they part, and what their impacts cost."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from geartrain.errors import check_numbers
from geartrain.simulation.inertia.inertial_loads import find_inertial_loads, torques_have_units

if TYPE_CHECKING:
    from geartrain.dynamics.motion.pair_impacts import ToothImpact
    from geartrain.dynamics.train_mechanics import TrainMechanics
    from geartrain.simulation.inertia.separation_rate import SeparationRates


def find_separation(
    train: TrainMechanics, state: str | None = None, without: Sequence[str] = (), turns: float | None = None
) -> SeparationRates:
    """The rates of the input at which flanks first part, by pair: `motion` does not apply above the lowest.

    Inertia, loads, a weight or a torque that drives, friction of bearings and of teeth that do not keep their ratio,
    viscous drag, and impacts where speeds jump are included (docs/dynamics.md, section 3).

    Parameters
    ----------
    train : TrainMechanics
        `GearTrain.mechanics`.
    state : str, optional
        A declared state; None only of a train that has none.
    without : sequence of str
        Pairs left out, as of `motion`.
    turns : float, optional
        Turns of the input that are searched [turn]; by default all after which everything repeats, or fewer where
        these are very many.

    Returns
    -------
    SeparationRates
        With the pair that parts first.

    Raises
    ------
    QuestionError
        If the train does not move, no inertia is declared, or a torque has no unit.

    Examples
    --------
    A slot whose axis is 8 mm from that of a pin at 10 mm, with 100 g cm^2 and a drag of 1 N mm behind it:

    >>> import geartrain
    >>> train = geartrain.load('''
    ... links: {frame: {}, a: {}, b: {inertia: 100 g cm2, bearing: 1 N mm}}
    ... revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
    ... couplings: [{kind: pin_and_slot, pin: a, slot: b, pin_radius: 10 mm, offset: 8 mm}]
    ... inputs: {a: 1}
    ... ''')
    >>> found = find_separation(train.mechanics)
    >>> found.pair, round(found.rate, 6)
    ('a~b', 0.440669)
    """
    from geartrain.dynamics.motion.motion_problem import find_motion_problem
    from geartrain.simulation.contacts.rubbing_arms import separate_rubbing
    from geartrain.simulation.inertia.inertial_contacts import InertialContacts
    from geartrain.simulation.inertia.link_inertia import find_link_inertias
    from geartrain.simulation.inertia.separation_rate import find_separation_rates

    check_numbers(turns=turns)
    train = train.planets_as_one
    inertias, moving = find_link_inertias(train, state), find_motion_problem(train, state, without)
    declared, case = train.declaration, train.kinematics.case(state)
    acting = find_inertial_loads(declared, case, train.tree, inertias, moving.speeds)
    rubbing, uncounted = separate_rubbing(moving, declared.gears)
    contacts = InertialContacts(moving, acting, rubbing=rubbing)
    return replace(find_separation_rates(contacts, inertias, state, turns), uncounted=uncounted)


def has_separation(train: TrainMechanics, state: str | None = None) -> bool:
    """True if `find_separation` has an answer: a link behind the input has an inertia, and torques have units."""
    declared = train.declaration
    if not declared.has_inertia or not torques_have_units(declared, train.kinematics.case(state)):
        return False
    from geartrain.simulation.inertia.link_inertia import find_link_inertias

    return any(each.value for each in find_link_inertias(train, state))


def find_tooth_impacts(train: TrainMechanics, state: str | None = None) -> Mapping[str, ToothImpact]:
    """Power lost in collisions of triangular teeth by pair (docs/motion.md, equation 7).

    Empty unless inertias and a rate are declared.

    Parameters
    ----------
    train : TrainMechanics
        `GearTrain.mechanics`.
    state : str, optional
        A declared state; None only of a train that has none.

    Returns
    -------
    mapping of str to ToothImpact
        By pair.

    Examples
    --------
    >>> import geartrain
    >>> found = find_tooth_impacts(geartrain.load("moon-triangular-inertia").mechanics)
    >>> list(found)
    []
    """
    train = train.planets_as_one
    case = train.kinematics.case(state)
    if case.rate is None or case.rate.unit is None or not train.undriven or not train.declaration.has_inertia:
        return {}
    from geartrain.dynamics.motion.motion_model import Motion
    from geartrain.dynamics.motion.motion_problem import find_motion_problem
    from geartrain.dynamics.motion.pair_impacts import find_impacts
    from geartrain.simulation.inertia.link_inertia import find_link_inertias

    inertias = {each.link: each.value for each in find_link_inertias(train, state)}
    moving = find_motion_problem(train, state)
    if moving.contradictions():
        return {}
    every = {link: (link, moving.frame) for link in train.declaration.links}
    return find_impacts(Motion(moving, every), inertias, case.rate.si)
