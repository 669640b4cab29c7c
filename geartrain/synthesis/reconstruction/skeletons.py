"""A train whose added wheels have no counts yet, and whose arbors stand in any order between two branchings."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import factorial
from typing import Any, NamedTuple

from geartrain.synthesis.reconstruction.arbor_passes import ADDED, ArborPass
from geartrain.synthesis.reconstruction.reconstruction_problem import PlacedWheel

Dials = tuple[str, ...]
"""Names of dials, sorted."""


@dataclass(frozen=True)
class Joint:
    """An arbor at which paths to dials end or part.

    name      of the surviving arbor, None for an added one
    driven    the wheel that is driven, `ADDED` for one that is added, None on the input arbor
    here      dials that it shows
    drives    driving wheels, each with what hangs from it
    passes    what the driven wheel itself drives
    """

    name: str | None
    driven: PlacedWheel | None
    here: Dials
    drives: tuple[tuple[PlacedWheel, tuple[Limb, ...]], ...] = ()
    passes: tuple[Limb, ...] = ()

    @property
    def limbs(self) -> Iterator[Limb]:
        """All that hangs from it."""
        for _, limbs in self.drives:
            yield from limbs
        yield from self.passes


@dataclass(frozen=True)
class Limb:
    """Arbors that lead to some dials without branching, and where they end.

    dials               to which it leads
    through             surviving arbors by name, with the way through each
    compounds, idlers   number of added arbors with two wheels, and with one that is driven and drives
    end                 the arbor at which it ends, or what hangs from the last driving wheel
    """

    dials: Dials
    through: tuple[tuple[str, ArborPass], ...]
    compounds: int
    idlers: int
    end: Joint | tuple[Limb, ...]

    @property
    def arbors(self) -> int:
        """How many arbors stand in a row."""
        return len(self.through) + self.compounds + self.idlers

    @property
    def orders(self) -> int:
        """How many orders they have; added ones of one kind are told apart by their counts only."""
        return factorial(self.arbors) // (factorial(self.compounds) * factorial(self.idlers))

    @property
    def next_limbs(self) -> tuple[Limb, ...]:
        """What follows."""
        return tuple(self.end.limbs) if isinstance(self.end, Joint) else self.end


@dataclass(frozen=True)
class Skeleton:
    """A whole train without counts of added wheels, and how fast the surviving ones on each path are.

    root     the input arbor
    wanted   by dial, least and greatest quotient that the added wheels on its path must have
    """

    root: Joint
    wanted: tuple[tuple[str, Quotients], ...]

    @cached_property
    def limbs(self) -> tuple[Limb, ...]:
        """All of them, from the input on."""
        found: list[Limb] = []
        waiting = list(self.root.limbs)[::-1]
        while waiting:
            found.append(waiting.pop())
            waiting += found[-1].next_limbs[::-1]
        return tuple(found)

    @cached_property
    def joints(self) -> tuple[Joint, ...]:
        """All arbors at which paths end or part, from the input on."""
        return self.root, *(limb.end for limb in self.limbs if isinstance(limb.end, Joint))

    @cached_property
    def orders(self) -> int:
        """How many orders its arbors have if any of them may stand anywhere on its limb."""
        found = 1
        for limb in self.limbs:
            found *= limb.orders
        return found

    @cached_property
    def added(self) -> AddedWheels:
        """Its added wheels."""
        drivers, driven, idle = Counter[Dials](), Counter[Dials](), 0
        for limb in self.limbs:
            drivers[limb.dials] += limb.compounds + sum(each.added_drivers for _, each in limb.through)
            driven[limb.dials] += limb.compounds + sum(each.added_driven for _, each in limb.through)
            idle += limb.idlers + sum(each.idler and each.driven == ADDED for _, each in limb.through)
            if isinstance(limb.end, Joint):
                idle += _count_end(limb.end, limb.dials, drivers, driven)
        for wheel, limbs in self.root.drives:
            drivers[_led_to(limbs)] += wheel == ADDED
        groups = tuple((dials, drivers[dials], driven[dials]) for dials in sorted({*drivers, *driven}))
        return AddedWheels(tuple(group for group in groups if group[1] or group[2]), idle)

    @cached_property
    def used(self) -> tuple[PlacedWheel, ...]:
        """Surviving wheels that mesh, each with its count."""
        found = dict.fromkeys(wheel for limb in self.limbs for _, each in limb.through for wheel in _both(each))
        for joint in self.joints:
            found.update(dict.fromkeys([joint.driven, *(wheel for wheel, _ in joint.drives)]))
        return tuple(wheel for wheel in found if wheel is not None and wheel != ADDED)

    @cached_property
    def added_arbors(self) -> int:
        """How many arbors are added."""
        return sum(limb.compounds + limb.idlers for limb in self.limbs) + sum(
            joint.name is None for joint in self.joints
        )


Quotients = tuple[Fraction, Fraction]
"""Least and greatest quotient of products of counts, equal where it must be exact."""


class CountLimit(NamedTuple):
    """The most teeth that one added wheel may have.

    dials    whose speed it changes; none for a wheel that changes no speed
    drives   whether it drives on the way to them
    """

    dials: Dials
    drives: bool
    most: int


@dataclass(frozen=True)
class AddedWheels:
    """How many wheels are added, by the dials whose speed they change.

    groups   dials, number of wheels that drive on the way to them, and of those that are driven
    idle     number of wheels that change no speed
    """

    groups: tuple[tuple[Dials, int, int], ...]
    idle: int

    def without(self, limit: CountLimit) -> AddedWheels:
        """All but one of those of a limit."""
        if not limit.dials:
            return AddedWheels(self.groups, self.idle - 1)
        left = [
            (dials, drivers - limit.drives, driven - (not limit.drives)) if dials == limit.dials else group
            for group in self.groups
            for dials, drivers, driven in [group]
        ]
        return AddedWheels(tuple(group for group in left if group[1] or group[2]), self.idle)

    @property
    def number(self) -> int:
        """All of them."""
        return self.idle + sum(drivers + driven for _, drivers, driven in self.groups)


def _count_end(end: Joint, dials: Dials, drivers: Counter[Dials], driven: Counter[Dials]) -> int:
    """Add the added wheels of an arbor at which paths end or part; those that change no speed are returned."""
    for wheel, limbs in end.drives:
        drivers[_led_to(limbs)] += wheel == ADDED
    if end.driven != ADDED:
        return 0
    past = set(_led_to(end.passes))  # what an idler drives does not know its count
    turned = tuple(dial for dial in dials if dial not in past)
    driven[turned] += bool(turned)
    return not turned


def _led_to(limbs: tuple[Limb, ...]) -> Dials:
    return tuple(sorted(dial for limb in limbs for dial in limb.dials))


def _both(each: ArborPass) -> tuple[PlacedWheel | None, PlacedWheel | None]:
    return each.driven, each.driver


# as plain data, to cross between processes and to be kept


def plain_skeleton(skeleton: Skeleton) -> list[Any]:
    """A skeleton as lists, texts and numbers."""
    wanted = [[dial, str(low), str(high)] for dial, (low, high) in skeleton.wanted]
    return [_plain_joint(skeleton.root), wanted]


def skeleton_of(plain: list[Any]) -> Skeleton:
    """The skeleton again."""
    root, wanted = plain
    return Skeleton(_joint_of(root), tuple((dial, (Fraction(low), Fraction(high))) for dial, low, high in wanted))


def _plain_joint(joint: Joint) -> list[Any]:
    drives = [[_plain_wheel(wheel), [*map(_plain_limb, limbs)]] for wheel, limbs in joint.drives]
    return [joint.name, _plain_wheel(joint.driven), [*joint.here], drives, [*map(_plain_limb, joint.passes)]]


def _joint_of(plain: list[Any]) -> Joint:
    name, driven, here, drives, passes = plain
    driving = tuple((PlacedWheel(*wheel), tuple(map(_limb_of, limbs))) for wheel, limbs in drives)
    return Joint(name, _wheel_of(driven), tuple(here), driving, tuple(map(_limb_of, passes)))


def _plain_limb(limb: Limb) -> list[Any]:
    through = [[name, *map(_plain_wheel, _both(each)), each.idle, each.idler] for name, each in limb.through]
    end = [_plain_joint(limb.end)] if isinstance(limb.end, Joint) else [None, [*map(_plain_limb, limb.end)]]
    return [[*limb.dials], through, limb.compounds, limb.idlers, end]


def _limb_of(plain: list[Any]) -> Limb:
    dials, through, compounds, idlers, end = plain
    passes = tuple(
        (name, ArborPass(_wheel_of(driven), _wheel_of(driver), idle, idler))
        for name, driven, driver, idle, idler in through
    )
    ends = _joint_of(end[0]) if end[0] is not None else tuple(map(_limb_of, end[1]))
    return Limb(tuple(dials), passes, compounds, idlers, ends)


def _plain_wheel(wheel: PlacedWheel | None) -> list[Any] | None:
    return None if wheel is None else [wheel.name, wheel.teeth]


def _wheel_of(plain: list[Any] | None) -> PlacedWheel | None:
    return None if plain is None else PlacedWheel(*plain)
