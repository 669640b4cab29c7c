"""Input speed at which teeth first separate, searched over all positions of the input, including kinks and jumps.

Between kinks of the transmission functions, the torque that each pair must transmit is smooth. Every interval is
sampled up to the one-sided limits at its ends, and the intervals with the lowest speeds are refined. Where a speed
jumps, the teeth separate if the impulse is negative.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import inf, tau
from typing import TYPE_CHECKING

import numpy as np

from geartrain.dynamics.motion.kink_positions import KinkSearch
from geartrain.errors import check_numbers
from geartrain.numerics.results import Result
from geartrain.simulation.contacts.inertial_contacts import find_inertial_loads, torques_have_units

if TYPE_CHECKING:
    from collections.abc import Iterator

    from geartrain.dynamics.motion.pair_impacts import ToothImpact
    from geartrain.dynamics.train_mechanics import TrainMechanics
    from geartrain.numerics.arrays import Floats
    from geartrain.report.document import Document, Section
    from geartrain.simulation.contacts.inertial_contacts import InertialContacts
    from geartrain.simulation.contacts.link_inertia import LinkInertia


_INSIDE = 1e-9  # fraction of an interval: its ends are evaluated this far inside, on its own side of a kink
_SAMPLES = 9  # initial number of positions in an interval
_BEST = 12  # intervals of each pair that are refined
_ZOOMS = 9  # refinements; each one reduces the searched width to a quarter
_NARROW = 1e-12  # revolutions: a shorter interval lies between two kinks at one position and is skipped
_PLACES = 8  # decimals of reported positions, so that both sides of a kink are printed alike
_MOST_KINKS = 80_000  # maximum product of kinks and pairs by default; takes some seconds


def find_separation(
    train: TrainMechanics, state: str | None = None, without: Sequence[str] = (), turns: float | None = None
) -> SeparationRates:
    """Return the input speed at which the flanks of each pair first separate. `GearTrain.motion` is valid below the
    lowest of these speeds.

    The computation includes inertia, loads, a driving weight or torque, friction of bearings and of teeth with a
    variable ratio, viscous drag, and impacts at speed jumps (docs/dynamics.md, section 3).

    Parameters
    ----------
    train : TrainMechanics
        Mechanics of the train, from `GearTrain.mechanics`.
    state : str, optional
        Name of a declared state; None only for a train that has no states.
    without : sequence of str
        Names of pairs to ignore, as for `motion`.
    turns : float, optional
        Searched range of the input [turn]; by default one full period of the train, or a part of it if the period is
        very long.

    Returns
    -------
    SeparationRates
        Input speed of each pair, in ascending order.

    Raises
    ------
    QuestionError
        If the train does not move, no inertia is declared, or a torque has no unit.

    Examples
    --------
    A pin at a radius of 10 mm drives a slot whose link has inertia and bearing friction; the axes are 8 mm apart:

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
    from geartrain.simulation.contacts.inertial_contacts import InertialContacts
    from geartrain.simulation.contacts.link_inertia import find_link_inertias
    from geartrain.simulation.contacts.rubbing_arms import separate_rubbing

    check_numbers(turns=turns)
    train = train.planets_as_one
    inertias, moving = find_link_inertias(train, state), find_motion_problem(train, state, without)
    declared, case = train.declaration, train.kinematics.case(state)
    acting = find_inertial_loads(declared, case, train.tree, inertias, moving.speeds)
    rubbing, uncounted = separate_rubbing(moving, (*declared.gears, *declared.couplings))
    uncounted += tuple(f"bearing {link}" for link, part in declared.links.items() if part.friction_radius)
    contacts = InertialContacts(moving, acting, rubbing=rubbing)
    period = contacts.motion.period
    # without a common period one revolution is searched
    whole = 1.0 if period is None else float(period)
    if turns is None:
        frequency = KinkSearch(contacts.motion._forward).rate
        most = max(1.0, _MOST_KINKS / max(1, len(contacts.pairs)))
        turns = whole if frequency * whole <= most else most / frequency
    kinks = contacts.motion.kink_positions(0.0, turns).turns
    rates, places, narrowest = _minimum_rates(contacts, kinks, turns)
    leaping = _jump_positions(contacts, kinks, narrowest)
    found = []
    held = {name for each in declared.couplings if each.HOLDS for name in each.row_names}
    for pair, name in enumerate(contacts.pairs):
        if name in held:
            continue
        rate, at = (0.0, leaping[pair]) if pair in leaping else (float(rates[pair]), float(places[pair]))
        found.append(PairSeparation(name, None if rate == inf else rate / tau, at, pair in leaping))
    found.sort(key=lambda each: (inf if each.rate is None else each.rate, each.pair))
    return SeparationRates(state, moving.driving_link, turns, turns >= whole, tuple(found), inertias, uncounted)


def has_separation(train: TrainMechanics, state: str | None = None) -> bool:
    """Return True if `find_separation` has a result. This requires that all torques have units, a link that can move
    has inertia, no coupling moves instantaneously, and one-way clutches do not drive any link in steps.
    """
    declared, case = train.declaration, train.kinematics.case(state)
    if any(each.transmission.at_once for each in train.couplings) or case.stepped is not None:
        return False
    if not declared.has_inertia or not torques_have_units(declared, case):
        return False
    from geartrain.simulation.contacts.link_inertia import find_link_inertias

    return any(each.value for each in find_link_inertias(train, state))


def find_tooth_impacts(train: TrainMechanics, state: str | None = None) -> Mapping[str, ToothImpact]:
    """Return the impacts of triangular teeth, keyed by pair, with the power that the impacts dissipate (docs/motion.md,
    equation 7).

    The mapping is empty unless inertias and a `rate` are declared.
    """
    train = train.planets_as_one
    case = train.kinematics.case(state)
    if case.rate is None or case.rate.unit is None or not train.undriven or not train.declaration.has_inertia:
        return {}
    from geartrain.dynamics.motion.motion_model import Motion
    from geartrain.dynamics.motion.motion_problem import find_motion_problem
    from geartrain.dynamics.motion.pair_impacts import find_impacts
    from geartrain.simulation.contacts.link_inertia import find_link_inertias

    inertias = {each.link: each.value for each in find_link_inertias(train, state)}
    moving = find_motion_problem(train, state)
    # the tooth forms lock such a train, so that it has no motion
    if moving.contradictions():
        return {}
    every = {link: (link, moving.frame) for link in train.declaration.links}
    return find_impacts(Motion(moving, every), inertias, case.rate.si)


# --------------------------------------------------------------------------------------------------------------- result


@dataclass(frozen=True)
class PairSeparation(Result):
    """Input speed above which the flanks of a pair, or a pin and its slot, separate."""

    pair: str
    """Name of the pair or coupling."""
    rate: float | None
    """Input speed [turn/s]; 0 if the flanks separate at any speed; None if they never separate."""
    at: float
    """Position of the input at which the flanks first separate [turn]."""
    leap: bool = False
    """True if, at the position `at`, the contact would need a tensile impulse to follow a jump of the speed ratio."""


@dataclass(frozen=True)
class SeparationRates(Result):
    """Input speeds at which the flanks of each pair in a train first separate. `GearTrain.motion` is valid below the
    lowest of these speeds.

    See Also
    --------
    geartrain.simulation.find_separation : Returns such an object.
    """

    PAGE = "simulation.contacts.separation_rate:separation_document"

    KEYS = ("state", "input", "rate", "pair", "turns", "complete", "pairs", "inertias", "uncounted")

    state: str | None
    """Name of the declared state for which the speeds were computed."""
    input: str
    """Name of the input link, to which the speeds refer."""
    turns: float
    """Searched range of the input [turn]."""
    complete: bool
    """True if the searched range is a full period of the train."""
    pairs: tuple[PairSeparation, ...]
    """Pairs and couplings, each with the input speed at which its flanks separate, in ascending order of this speed."""
    inertias: tuple[LinkInertia, ...]
    """Moments of inertia of the links, as used in the computation."""
    uncounted: tuple[str, ...] = ()
    """Names of the pairs and bearings whose friction is neglected: pairs with a constant ratio, pins, and (as `bearing
    LINK`) bearings whose friction increases with the load.
    """

    @property
    def first(self) -> PairSeparation | None:
        """Pair that separates first, with the input speed at which it separates; None if no pair separates."""
        return self.pairs[0] if self.pairs and self.pairs[0].rate is not None else None

    @property
    def rate(self) -> float | None:
        """Input speed up to which all flanks remain in contact [turn/s]; None if the flanks never separate."""
        return None if self.first is None else self.first.rate

    @property
    def pair(self) -> str | None:
        """Name of the pair that separates first; None if no pair separates."""
        return None if self.first is None else self.first.pair

    @property
    def unknown(self) -> tuple[str, ...]:
        """Names of moving links whose inertia is unknown."""
        return tuple(each.link for each in self.inertias if each.source == "unknown")

    def _summary(self) -> str:
        first = "never" if self.first is None else f"from {self.first.rate:.5g} turn/s of {self.input} at {self.pair}"
        return f"teeth separate {first}, {len(self.pairs)} pairs"


def separation_document(found: SeparationRates) -> Document:
    """Return a document that lists the input speed above which each pair separates."""
    from geartrain.report.document import Document

    return Document("Motion in time", (), (separation_section(found),))


def separation_section(found: SeparationRates) -> Section:
    """Return a report section that lists the input speed above which each pair separates."""
    from geartrain.report.document import Section, Table

    rows = [(each.pair, *separation_words(each)) for each in found.pairs]
    header = ("pair", f"separates from (turn/s of {found.input})", f"at (turns of {found.input})")
    return Section("Separation rate", tuple(separation_text(found)), (Table(header, rows),))


def separation_text(found: SeparationRates) -> Iterator[str]:
    """Yield sentences on the first pair that separates, the searched range, and links of unknown inertia."""
    if found.first is None:
        yield f"No teeth separate at any speed of '{found.input}'."
    else:
        pair, rate = found.first.pair, found.first.rate
        where = f"after {separation_words(found.first)[1]} turns of '{found.input}'"
        if found.first.leap:
            yield f"Teeth of {pair} separate at any speed: {where} a speed drops abruptly, and flanks cannot pull."
        elif not rate:
            yield (
                f"Teeth of {pair} separate at any speed, first {where}: neither load nor bearing friction keeps them "
                "in contact."
            )
        else:
            yield (
                f"The motion is valid up to {rate:.5g} turn/s of '{found.input}': above this rate the teeth of "
                f"{pair} separate, first {where}, because the driven side runs ahead."
            )
    if found.uncounted:
        yield f"Parts whose friction is not included: {', '.join(found.uncounted)}."
    if not found.complete:
        yield f"The search covered {found.turns:.6g} turns of '{found.input}', which is not a full period."
    if found.unknown:
        yield f"Links of unknown inertia, taken as 0: {', '.join(found.unknown)}."


def separation_words(pair: PairSeparation) -> tuple[str, str]:
    """Return the input speed above which a pair separates [turn/s], and the position of the input [turn], as texts."""
    if pair.rate is None:
        return "never", "-"
    return f"{pair.rate:.5g}" if pair.rate else "any rate", f"{round(pair.at, _PLACES):.6g}"


# --------------------------------------------------------------------------------------------------------------- search


def _minimum_rates(contacts: InertialContacts, kinks: Floats, turns: float) -> tuple[Floats, Floats, float]:
    """Return the minimum input speed at which each pair separates between kinks [rad/s], the input position of each
    minimum [revolutions], and the width of the narrowest interval between kinks [revolutions].
    """
    ends = np.unique(np.concatenate([[0.0], kinks, [turns]]))
    low, high = ends[:-1], ends[1:]
    wide = high - low > _NARROW * max(1.0, turns)
    low, high = low[wide], high[wide]
    # Chebyshev nodes: denser at the ends, where the rate is often lowest
    shares = _INSIDE + (1 - 2 * _INSIDE) * (1 - np.cos(np.pi * np.arange(_SAMPLES) / (_SAMPLES - 1))) / 2
    at = low[:, None] + (high - low)[:, None] * shares
    count = len(contacts.pairs)
    rates = contacts.rates(at.ravel()).reshape(count, *at.shape)
    best = np.argsort(rates.min(axis=2), axis=1, kind="stable")[:, :_BEST]
    at, rates = at[best], np.take_along_axis(rates, best[:, :, None], axis=1)
    found, places = np.full(count, inf), np.zeros(count)
    own, shares = np.arange(count), np.arange(_SAMPLES) / (_SAMPLES - 1)
    for zoom in range(_ZOOMS + 1):
        where = rates.argmin(axis=2)[:, :, None]
        minimum, place = (np.take_along_axis(each, where, axis=2)[:, :, 0] for each in (rates, at))
        row = minimum.argmin(axis=1)
        better = minimum[own, row] < found
        found, places = np.where(better, minimum[own, row], found), np.where(better, place[own, row], places)
        if zoom < _ZOOMS:
            # the interval between the neighbours of the best sample
            left, right = (np.take_along_axis(at, np.clip(where + step, 0, _SAMPLES - 1), axis=2) for step in (-1, 1))
            at = left + (right - left) * shares
            # each pair at its own positions
            rates = contacts.rates(at.ravel()).reshape(count, *at.shape)[own, own]
    return found, places, float((high - low).min(initial=turns))


def _jump_positions(contacts: InertialContacts, kinks: Floats, narrowest: float) -> dict[int, float]:
    """Return the first input position [revolutions] at which a jump of speed would require the flanks of a pair to
    pull, by index of the pair.
    """
    if not len(kinks):
        return {}
    # so close to a kink that rates are those on its two sides, but not so close that rounding dominates
    impulses = contacts.impulses(kinks, _INSIDE * max(narrowest, 1e-6))
    # rounding must not make an impulse negative
    tolerance = 1e-9 * np.abs(impulses).max(axis=1, keepdims=True, initial=0.0)
    return {pair: float(kinks[row.argmax()]) for pair, row in enumerate(impulses < -tolerance) if row.any()}
