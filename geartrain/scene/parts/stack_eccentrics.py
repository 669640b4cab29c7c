"""Which wheels of a stack turn on eccentrics, of which arbors, and which pins of round holes stand in plates."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import atan2, dist, inf
from typing import TYPE_CHECKING, Protocol

from geartrain.kinematics.buildability.equal_planets import ON_ECCENTRIC
from geartrain.numerics.vectors import size
from geartrain.scene.joints import coupling_sizes, pin_and_hole
from geartrain.scene.parts.eccentrics import USUAL_ARBOR, WALL, Eccentric, Wave, eccentric_radius
from geartrain.scene.parts.flexible_cups import FlexibleCup
from geartrain.scene.parts.pin_circles import PinCircle
from geartrain.scene.parts.stack_discs import Point, StackDisc, slabs
from geartrain.scene.strain_waves import BentWheel, bent_wheels
from geartrain.teeth.outlines.wave_tooth import CUP, wall
from geartrain.teeth.pin_coupling import Parallel, PinsInHoles

if TYPE_CHECKING:
    from collections.abc import Mapping

    from geartrain.analysis.gear_train import GearTrain
    from geartrain.numerics.vectors import Vector
    from geartrain.scene.layout import AxisPlace, Layout
    from geartrain.scene.solids.wheel_blanks import Blank

_BESIDE = 1.0  # mm in the middle of a wheel between its hole and an arbor that passes


class UprightTrain(Protocol):
    """What matters here of a stack: its train as placed, its wheels as discs, and the pins of round holes in plates."""

    @property
    def train(self) -> GearTrain:
        """With all that it declares."""

    @property
    def layout(self) -> Layout:
        """Where it stands."""

    @property
    def blanks(self) -> Mapping[str, Blank]:
        """Flat shapes of its wheels."""

    @property
    def core(self) -> float | None:
        """Diameter of all arbors (mm), if it is given."""

    @property
    def wheel_discs(self) -> tuple[StackDisc, ...]:
        """Wheels on upright axes."""

    @property
    def pin_circles(self) -> Mapping[str, PinCircle]:
        """By coupling."""

    def flat(self, point: Vector) -> Point:
        """A point seen from above."""

    def is_upright(self, axis: AxisPlace) -> bool:
        """True for an axis at right angles to the plates."""

    def carrier_axis(self, axis: AxisPlace) -> str | None:
        """The axis of the frame about which an upright axis is carried round."""


@dataclass(frozen=True)
class StackEccentrics:
    """Of one stack.

    A wheel whose axis a link carries round close to its own turns on an eccentric of that link. Where the link is only
    what cranks side by side bear together, each crank has one.
    """

    stack: UprightTrain

    def found(self) -> Iterator[Eccentric]:
        """All of them; those of one arbor are numbered from the second on."""
        count: Counter[str] = Counter()
        for each in self._each():
            count[each.name] += 1
            number = count[each.name]
            yield each if number == 1 else replace(each, name=f"{each.name} {number}")

    def _each(self) -> Iterator[Eccentric]:
        waves = {each.wheel: each for each in bent_wheels(self.stack.train, self.stack.layout)}
        for label, axis in self.stack.layout.axes.items():
            own = self.stack.carrier_axis(axis)
            discs = [disc for disc in self.stack.wheel_discs if disc.axis == label]
            if own is None or len(slabs(discs)) != 1:  # wheels apart are one body by their pipe alone
                continue
            at = self._place(own)
            if dist(at, discs[0].at) < ON_ECCENTRIC * min(disc.root for disc in discs):
                if bent := next((waves[disc.name] for disc in discs if disc.name in waves), None):
                    yield self._wave(bent, label, at)
                elif cranks := list(self._cranks(axis.carrier, own)):
                    yield from self._on_cranks(cranks, at, label, discs)
                else:
                    yield from self._on_arbor(axis.carrier, own, label, discs)

    def _wave(self, bent: BentWheel, label: str, at: Point) -> Eccentric:
        """What bends a thin wheel."""
        (x, y), blank = self._place(label), self.stack.blanks[bent.wheel]
        thin = wall(blank.pitch_radius)
        wave = Wave(size(bent.offset), bent.lobes, thin, atan2(y - at[1], x - at[0]), CUP * 2 * blank.pitch_radius)
        name, radius = f"{bent.link} wave", blank.root_radius - thin
        return Eccentric(name, bent.link, bent.axis, at, at, radius, (bent.wheel,), label, wave=wave)

    def _place(self, label: str) -> Point:
        return self.stack.flat(self.stack.layout.axes[label].point)

    def _on_arbor(self, link: str, own: str, label: str, discs: Sequence[StackDisc]) -> Iterator[Eccentric]:
        at, centre, links = self._place(own), discs[0].at, {disc.link for disc in discs}
        free = min((circle.free for circle in self.stack.pin_circles.values() if circle.slot in links), default=inf)
        free = min([free, *(disc.root for disc in discs)])
        radius = eccentric_radius(dist(at, centre), self._arbor(link), free)
        yield Eccentric(f"{link} eccentric", link, own, at, centre, radius, tuple(d.name for d in discs), label)

    def _arbor(self, link: str) -> float | None:
        """Diameter of the arbor of a link (mm), if it is given."""
        declared = self.stack.train.declaration.links[link].arbor
        return self.stack.core if self.stack.core is not None or declared is None else 1000 * declared.diameter.si

    # ---------------------------------------------------------------------------------------------- cranks side by side

    def _cranks(self, link: str, own: str) -> Iterator[tuple[str, str, str]]:
        """Links that bear together what one stands for, on axes that are carried about its own: axes, couplings."""
        tree = self.stack.train.kinematics.tree
        for coupling in self.stack.train.declaration.couplings:
            pair = coupling.pin, coupling.slot
            if isinstance(coupling, Parallel) and link in pair:
                crank = pair[1 - pair.index(link)]
                label = tree.axis(crank) or ""
                place = self.stack.layout.axes.get(label)
                if place is not None and self.stack.carrier_axis(place) == own:
                    yield crank, label, coupling.name

    def _on_cranks(
        self, cranks: Sequence[tuple[str, str, str]], at: Point, label: str, discs: Sequence[StackDisc]
    ) -> Iterator[Eccentric]:
        centre = discs[0].at
        offset, places = dist(at, centre), [self._place(own) for _, own, _ in cranks]
        middle = round(offset + (USUAL_ARBOR if self.stack.core is None else self.stack.core) / 2 + _BESIDE, 2)
        wheels, root = tuple(disc.name for disc in discs), min(disc.root for disc in discs)
        for (link, own, name), place in zip(cranks, places, strict=True):
            away = dist(place, at)
            free = min([root - away, away - middle, *(dist(place, other) / 2 for other in places if other != place)])
            moved = place[0] + centre[0] - at[0], place[1] + centre[1] - at[1]
            radius = eccentric_radius(offset, self._arbor(link), free)
            yield Eccentric(f"{link} eccentric", link, own, place, moved, radius, wheels, label, middle, name)


def find_cups(stack: UprightTrain) -> Iterator[FlexibleCup]:
    """Walls between thin wheels and links on axes of the frame."""
    declared, tree = stack.train.declaration, stack.train.kinematics.tree
    for coupling in (each for each in declared.couplings if isinstance(each, Parallel)):
        for cup, thin in ((coupling.pin, coupling.slot), (coupling.slot, coupling.pin)):
            own = [disc for disc in stack.wheel_discs if disc.link == thin and declared.wheels[disc.name][1].flexible]
            place = stack.layout.axes.get(tree.axis(cup) or "")
            if own and place is not None and place.carrier == declared.frame and stack.is_upright(place):
                blank, at = stack.blanks[own[0].name], stack.flat(place.point)
                yield FlexibleCup(
                    coupling.name, cup, thin, own[0].name, at, blank.root_radius, wall(blank.pitch_radius)
                )


def find_pin_circles(stack: UprightTrain) -> Iterator[PinCircle]:
    """Pins in round holes that no wheel of their own link is wide enough to bear."""
    for declared in stack.train.declaration.couplings:
        places = [
            stack.layout.axes.get(stack.train.kinematics.tree.axis(link) or "")
            for link in (declared.pin, declared.slot)
        ]
        if not isinstance(declared, PinsInHoles) or not all(each and stack.is_upright(each) for each in places):
            continue
        first, second = (stack.flat(each.point) for each in places if each)
        radius, offset = coupling_sizes(declared, dist(first, second))
        pin, hole = pin_and_hole(declared, radius, offset)
        wide = radius + pin / 2 + WALL
        if not any(disc.link == declared.pin and disc.hub and disc.root > wide for disc in stack.wheel_discs):
            yield PinCircle(declared.name, declared.pin, declared.slot, radius, pin, hole)
