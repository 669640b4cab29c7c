"""The rate of the input at which teeth first part, searched over all positions with their corners and jumps.

Between corners of laws what each pair must carry is smooth: every stretch is sampled, its ends on their own sides of
their corners, and the best stretches are searched ever finer. Where a speed jumps, the sign of the blow decides.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf, tau
from typing import TYPE_CHECKING, NamedTuple

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


_INSIDE = 1e-9  # of a stretch: its ends are asked so far within it, on its own side of a corner
_SAMPLES = 9  # positions of a stretch at first
_BEST = 12  # stretches of each pair that are searched further
_ZOOMS = 9  # of which each narrows what is searched to a quarter
_NARROW = 1e-12  # turns: a stretch between two corners at one place is none
_PLACES = 8  # of turns: positions on both sides of a corner are told as one
_MOST_KINKS = 80_000  # times pairs, searched by default: some seconds


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
    from geartrain.simulation.contacts.inertial_contacts import InertialContacts
    from geartrain.simulation.contacts.link_inertia import find_link_inertias
    from geartrain.simulation.contacts.rubbing_arms import separate_rubbing

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
    from geartrain.simulation.contacts.link_inertia import find_link_inertias

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
    from geartrain.simulation.contacts.link_inertia import find_link_inertias

    inertias = {each.link: each.value for each in find_link_inertias(train, state)}
    moving = find_motion_problem(train, state)
    if moving.contradictions():
        return {}
    every = {link: (link, moving.frame) for link in train.declaration.links}
    return find_impacts(Motion(moving, every), inertias, case.rate.si)


# ----------------------------------------------------------------------------------------------------------- the result


@dataclass(frozen=True)
class PairSeparation(Result):
    """From what rate of the input on the teeth of a pair, or a pin and its slot, part.

    See Also
    --------
    SeparationRates : holds one of each pair
    """

    KEYS = ("pair", "rate", "at", "leap")

    pair: str
    """The pair or coupling."""
    rate: float | None
    """Of the input [turn/s]; 0 where they part at any rate; None where they part at none."""
    at: float
    """Turns of the input at which they do so first."""
    leap: bool = False
    """True if a speed jumps there, so that the blow would have to pull."""


@dataclass(frozen=True)
class SeparationRates(Result):
    """At what rates of the input the flanks of a train first part: while it is slower, `motion` holds.

    See Also
    --------
    geartrain.simulation.find_separation : gives these.
    """

    PAGE = "simulation.contacts.separation_rate:separation_document"

    KEYS = ("state", "input", "rate", "pair", "turns", "complete", "pairs", "inertias", "uncounted")

    state: str | None
    """As it was named."""
    input: str
    """The link whose rate it is."""
    turns: float
    """Turns of it that were searched."""
    complete: bool
    """True if everything repeats after them."""
    pairs: tuple[PairSeparation, ...]
    """The pair that parts first before the others."""
    inertias: tuple[LinkInertia, ...]
    """What was counted with."""
    uncounted: tuple[str, ...] = ()
    """Pairs and pins whose friction is not counted: those that keep their ratio, and pins."""

    @property
    def first(self) -> PairSeparation | None:
        """The pair that parts first; None where none does."""
        return self.pairs[0] if self.pairs and self.pairs[0].rate is not None else None

    @property
    def rate(self) -> float | None:
        """Rate of the input [turn/s] up to which all flanks touch; None where they part at none."""
        return None if self.first is None else self.first.rate

    @property
    def pair(self) -> str | None:
        """The pair that parts first."""
        return None if self.first is None else self.first.pair

    @property
    def unknown(self) -> tuple[str, ...]:
        """Links that turn and have no inertia here."""
        return tuple(each.link for each in self.inertias if each.source == "unknown")

    def _summary(self) -> str:
        first = "never" if self.first is None else f"from {self.first.rate:.5g} turn/s of {self.input} at {self.pair}"
        return f"teeth part {first}, {len(self.pairs)} pairs"


def separation_document(found: SeparationRates) -> Document:
    """Return the rates of all pairs as a document."""
    from geartrain.report.document import Document

    return Document("Motion in time", (), (separation_section(found),))


def separation_section(found: SeparationRates) -> Section:
    """The rate of each pair."""
    from geartrain.report.document import Section, Table

    rows = [(each.pair, *separation_words(each)) for each in found.pairs]
    header = ("pair", f"parts from (turn/s of {found.input})", f"at (turns of {found.input})")
    return Section("Up to which rate it holds", tuple(separation_text(found)), (Table(header, rows),))


def separation_text(found: SeparationRates) -> Iterator[str]:
    """Which pair parts first and when, what was searched, and which inertias are not known."""
    yield _first_separation(found)
    if found.uncounted:
        yield f"Friction not counted: that of {', '.join(found.uncounted)}."
    if not found.complete:
        yield f"Searched were {found.turns:.6g} turns of '{found.input}', not all after which everything repeats."
    if found.unknown:
        yield f"Counted without inertia, for none is known: {', '.join(found.unknown)}."


def separation_words(pair: PairSeparation) -> tuple[str, str]:
    """From what rate on a pair parts, and at what position, in words."""
    if pair.rate is None:
        return "never", "-"
    return f"{pair.rate:.5g}" if pair.rate else "any rate", f"{round(pair.at, _PLACES):.6g}"


def _first_separation(found: SeparationRates) -> str:
    first = found.first
    if first is None:
        return f"No teeth part, at whatever rate '{found.input}' turns."
    where = f"after {separation_words(first)[1]} turns of '{found.input}'"
    if first.leap:
        return f"Teeth of {first.pair} part at any rate: {where} a speed falls at once, and nothing pulls."
    if not first.rate:
        return (
            f"Teeth of {first.pair} part at any rate, first {where}: neither load nor friction of bearings holds them "
            "together there."
        )
    return (
        f"Holds up to {first.rate:.5g} turn/s of '{found.input}': from there on the teeth of {first.pair} part, "
        f"{where}, for what they drive runs ahead."
    )


# ----------------------------------------------------------------------------------------------------------- the search


def find_separation_rates(
    contacts: InertialContacts, inertias: Sequence[LinkInertia], state: str | None, turns: float | None = None
) -> SeparationRates:
    """Rates over the train's period, or over fewer turns where that has too many corners to contacts."""
    period = contacts.motion.period
    whole = 1.0 if period is None else float(period)
    if turns is None:
        kinks = KinkSearch(contacts.motion._forward).rate
        most = max(1.0, _MOST_KINKS / max(1, len(contacts.pairs)))
        turns = whole if kinks * whole <= most else most / kinks
    found = tuple(PairSeparation(each.pair, _in_turns(each.rate), each.turns, each.leap)
                  for each in find_partings(contacts, turns))  # fmt: skip
    return SeparationRates(state, contacts.moving.driving_link, turns, turns >= whole, found, tuple(inertias))


class Parting(NamedTuple):
    """A pair parts from a rate (rad/s of the input) on, at a position (turns); `leap` where a speed jumps there."""

    pair: str
    rate: float
    turns: float
    leap: bool


def find_partings(contacts: InertialContacts, turns: float) -> tuple[Parting, ...]:
    """Of each pair the rate from which it parts somewhere in so many turns of the input, least first."""
    kinks = contacts.motion.kink_positions(0.0, turns).turns
    ends = np.unique(np.concatenate([[0.0], kinks, [turns]]))
    low, high = ends[:-1], ends[1:]
    wide = high - low > _NARROW * max(1.0, turns)
    low, high = low[wide], high[wide]
    shares = _INSIDE + (1 - 2 * _INSIDE) * (1 - np.cos(np.pi * np.arange(_SAMPLES) / (_SAMPLES - 1))) / 2
    at = low[:, None] + (high - low)[:, None] * shares
    rates = contacts.rates(at.ravel()).reshape(len(contacts.pairs), *at.shape)
    found = _minimum(contacts, at, rates)
    leaping = _leaps(contacts, kinks, float((high - low).min(initial=turns)))
    partings = [leaping.get(pair, each) for pair, each in enumerate(found)]
    return tuple(sorted(partings, key=lambda each: (each.rate, each.pair)))


def _minimum(contacts: InertialContacts, at: Floats, rates: Floats) -> list[Parting]:
    """The least rate of each pair: its best stretches searched further, by ever finer samples about the best.

    at      positions, (stretches, samples); `rates` of all pairs there
    """
    count = len(contacts.pairs)
    best = np.argsort(rates.min(axis=2), axis=1, kind="stable")[:, :_BEST]
    at, rates = at[best], np.take_along_axis(rates, best[:, :, None], axis=1)
    found = [Parting(name, inf, 0.0, False) for name in contacts.pairs]
    own, shares = np.arange(count), np.arange(_SAMPLES) / (_SAMPLES - 1)
    for zoom in range(_ZOOMS + 1):
        where = rates.argmin(axis=2)[:, :, None]
        minimum, place = (np.take_along_axis(each, where, axis=2)[:, :, 0] for each in (rates, at))
        for pair, row in enumerate(minimum.argmin(axis=1)):
            if minimum[pair, row] < found[pair].rate:
                found[pair] = found[pair]._replace(rate=float(minimum[pair, row]), turns=float(place[pair, row]))
        if zoom < _ZOOMS:
            left, right = (np.take_along_axis(at, np.clip(where + step, 0, _SAMPLES - 1), axis=2) for step in (-1, 1))
            at = left + (right - left) * shares
            # each pair at its own positions
            rates = contacts.rates(at.ravel()).reshape(count, *at.shape)[own, own]
    return found


def _leaps(contacts: InertialContacts, kinks: Floats, narrowest: float) -> dict[int, Parting]:
    """Pairs that part at any rate, because a speed jumps so that their blow would have to pull."""
    if not len(kinks):
        return {}
    impulses = contacts.impulses(kinks, _INSIDE * max(narrowest, 1e-6))
    tolerance = 1e-9 * np.abs(impulses).max(axis=1, keepdims=True, initial=0.0)
    found = {}
    for pair, row in enumerate(impulses < -tolerance):
        if row.any():
            found[pair] = Parting(contacts.pairs[pair], 0.0, float(kinks[row.argmax()]), True)
    return found


def _in_turns(rate: float) -> float | None:
    """Turns a second of a rate in rad/s; None where it is infinite."""
    return None if rate == inf else rate / tau
