"""A reference solver in joint rates: one unknown for every turning pair, vectors for axes, and its own elimination.

Nothing is imported from the package under test, and the Willis equation is not used. The angular velocity of a link is
the sum of the rates of the joints on its path from the frame, each times the unit vector of its axis. At a gear pair,
the two pitch surfaces have the same velocity at the pitch point, relative to the carrier. Two links are one body if the
relative twist vanishes in all six components, with every axis at its own position.

Speeds are in turns per second if inputs have units.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from math import isqrt
from typing import Any

from random_trains import Data, RandomTrain, cross

Unit = tuple[Fraction, Fraction, Fraction]
Row = list[Fraction]

TURNS_A_SECOND = {
    "rpm": Fraction(1, 60),
    "deg/s": Fraction(1, 360),
    "turn/d": Fraction(1, 86400),
    "turn/s": Fraction(1),
    "turn/h": Fraction(1, 3600),
}


class LinkageError(Exception):
    """A rigid connection closes a chain of turning pairs that may move with a variable ratio."""


class Space:
    """Rows in reduced echelon form, the known relations of the joint rates; the last column is the right side."""

    def __init__(self, width: int) -> None:
        self.width = width
        self.rows: dict[int, Row] = {}
        self.consistent = True

    def copy(self) -> Space:
        other = Space(self.width)
        other.rows, other.consistent = dict(self.rows), self.consistent
        return other

    def reduce(self, row: Sequence[Fraction]) -> Row:
        """Return the remainder of a row after substitution of all known relations."""
        left = list(row)
        for column, known in self.rows.items():
            factor = left[column]
            if factor:
                left = [value - factor * other if other else value for value, other in zip(left, known, strict=True)]
        return left

    def add(self, row: Sequence[Fraction]) -> None:
        left = self.reduce(row)
        lead = next((column for column in range(self.width) if left[column]), None)
        if lead is None:
            self.consistent = self.consistent and not left[-1]
            return
        fresh = [value / left[lead] if value else value for value in left]
        for column, known in self.rows.items():
            if factor := known[lead]:
                self.rows[column] = [
                    value - factor * other if other else value for value, other in zip(known, fresh, strict=True)
                ]
        self.rows[lead] = fresh

    @property
    def rank(self) -> int:
        return len(self.rows)

    def value(self, row: Sequence[Fraction]) -> Fraction | None:
        """Return the value of a linear form of the rates, or None if it is not determined."""
        left = self.reduce(row)
        return None if any(left[:-1]) else left[-1]


class Skeleton:
    """The joints of a train as vectors: numbering, paths, carriers."""

    def __init__(self, train: RandomTrain) -> None:
        data: Data = train.data
        self.frame = data.get("frame", "frame")
        self.axis = [joint["axis"] for joint in data["revolutes"]]
        units: dict[Unit, Unit] = {}  # equal ones are one object
        self.unit = {
            label: units.setdefault(unit := _unit(train.directions.get(label, (0, 0, 1))), unit) for label in self.axis
        }
        self.point = train.positions
        self.count = len(self.axis)
        self._up: dict[str, tuple[str, int]] = {}
        todo = [self.frame]
        while todo:
            near = todo.pop()
            for at, joint in enumerate(data["revolutes"]):
                if near in joint["pair"]:
                    far = joint["pair"][1 - joint["pair"].index(near)]
                    if far != self.frame and far not in self._up:
                        self._up[far] = (near, at)
                        todo.append(far)

    def path(self, base: str, of: str) -> list[tuple[int, int, str]]:
        """Return, from `base` to `of`, each joint, its sense (1 outwards), and the link behind it."""
        down, up = self._chain(of), self._chain(base)
        while down and up and down[-1] == up[-1]:
            down.pop()
            up.pop()
        back = [(at, -1, self._up[link][0]) for link, at in up]
        return back + [(at, 1, link) for link, at in reversed(down)]

    def _chain(self, link: str) -> list[tuple[str, int]]:
        found = []
        while link in self._up:
            near, at = self._up[link]
            found.append((link, at))
            link = near
        return found

    def own(self, link: str) -> Unit:
        """Return the unit vector about which a link's speed is given: that of its joint towards the frame."""
        return self.unit[self.axis[self._up[link][1]]] if link in self._up else (Fraction(0), Fraction(0), Fraction(1))

    def spin(self, base: str, of: str, about: Unit | None = None) -> Row | None:
        """Return the speed of a link relative to another about a direction; None if an axis on the path is not parallel
        to it.

        Such a sum would not be a rotation.
        """
        row = [Fraction(0)] * (self.count + 1)
        about = about or self.own(of)
        for at, sense, _ in self.path(base, of):
            unit = self.unit[self.axis[at]]
            if unit is about:  # its length is 1
                row[at] += sense
                continue
            if any(cross(unit, about)):
                return None
            row[at] += sense * _dot(unit, about)
        return row

    def carrier(self, i: str, j: str) -> str:
        """Return the link at which the axis changes on the path from i to j."""
        path = self.path(i, j)
        (found,) = [here[2] for here, there in itertools.pairwise(path) if self.axis[here[0]] != self.axis[there[0]]]
        return found


@dataclass
class Motion:
    """Motion of a train in one state.

    kind   determined, free, locked, contradictory; or refused, for a linkage
    """

    kind: str
    skeleton: Skeleton
    space: Space
    links: Sequence[str] = field(default_factory=tuple)

    def speed(self, of: str, base: str | None = None) -> Fraction | None:
        """Return the speed of a link about its own axis, absolute or relative to another link; None if undetermined."""
        row = self.skeleton.spin(base or self.skeleton.frame, of)
        assert row is not None, "no rotation: ask `is_rotation` first"
        return self.space.value(row)

    def is_rotation(self, of: str, base: str | None = None) -> bool:
        """Return True if the speed is about one axis, and not a sum over axes with several directions."""
        return self.skeleton.spin(base or self.skeleton.frame, of) is not None

    def is_free(self, link: str) -> bool:
        """Return True if a link that turns about one axis in the frame has an undetermined speed."""
        return self.is_rotation(link) and self.speed(link) is None


@dataclass
class Resting:
    """A train in one state without inputs: the freedom that its pairs and rigid connections leave to the joint rates.

    refused   True if some connections form a linkage
    """

    skeleton: Skeleton
    held: Space
    links: Sequence[str]
    refused: bool = False


def rest(train: RandomTrain, state: str | None = None) -> Resting:
    """Return the relations that are independent of the inputs."""
    data, skeleton = train.data, Skeleton(train)
    bodies = list(_bodies(data, state))
    found = Resting(skeleton, Space(skeleton.count), list(data["links"]))
    for row in circuits(data, skeleton):
        found.held.add(row)
    try:
        for row in rigid(train, skeleton, bodies):
            found.held.add(row)
    except LinkageError:
        found.refused = True
    return found


def move(train: RandomTrain, state: str | None = None) -> Motion:
    """Solve a train in one state."""
    resting = rest(train, state)
    return drive(resting, {} if resting.refused else inputs_of(train.data, state))


def drive(resting: Resting, inputs: Mapping[str, Fraction]) -> Motion:
    """Solve a train with some speeds of links."""
    skeleton, held, links = resting.skeleton, resting.held, resting.links
    if resting.refused:
        return Motion("refused", skeleton, held, links)
    space = held.copy()
    for link, speed in inputs.items():
        row = skeleton.spin(skeleton.frame, link)
        assert row is not None, "inputs turn about axes in the frame"
        space.add([*row[:-1], -speed])
    if not space.consistent:
        stuck = any(speed and _spin_value(held, skeleton, link) is not None for link, speed in inputs.items())
        kind = "locked" if stuck else "contradictory"
    elif held.rank == skeleton.count and not any(inputs.values()):
        kind = "locked"
    else:
        kind = "determined" if space.rank == skeleton.count else "free"
    return Motion(kind, skeleton, space, links)


def _spin_value(space: Space, skeleton: Skeleton, link: str) -> Fraction | None:
    row = skeleton.spin(skeleton.frame, link)
    return None if row is None else space.value(row)


def circuits(data: Data, skeleton: Skeleton) -> Iterable[Row]:
    """Return one row for each gear pair and coupling."""
    for _, (one, other) in sides(data, skeleton):
        yield [a - b if b else a for a, b in zip(one, other, strict=True)]


def sides(data: Data, skeleton: Skeleton) -> Iterable[tuple[tuple[str, str], tuple[Row, Row]]]:
    """Return the links of each gear pair and coupling, and the velocity at the contact for both sides: equal rows."""
    wheels = {
        name: (link, {"teeth": wheel} if isinstance(wheel, int) else wheel)
        for link, part in data["links"].items()
        for name, wheel in ((part or {}).get("wheels") or {}).items()
    }
    for gear in data.get("gears", ()):
        (i, first), (j, second) = (wheels[name] for name in gear["pair"])
        yield tuple(gear["pair"]), _pitch_point(skeleton, i, j, first, second)
    for coupling in data.get("couplings", ()):
        pin, slot = coupling["pin"], coupling["slot"]
        winding = 1 if coupling["kind"] == "pin_and_slot" else 0
        carrier = skeleton.carrier(pin, slot)
        about = skeleton.unit[skeleton.axis[skeleton.path(carrier, slot)[-1][0]]]
        slots, pins = skeleton.spin(carrier, slot, about), skeleton.spin(carrier, pin, about)
        assert slots is not None
        assert pins is not None
        yield (slot, pin), (slots, [winding * b for b in pins])


def _pitch_point(
    skeleton: Skeleton, i: str, j: str, first: Mapping[str, Any], second: Mapping[str, Any]
) -> tuple[Row, Row]:
    """Return the velocities of the pitch point as a point of either wheel, relative to the carrier; they are equal."""
    carrier = skeleton.carrier(i, j)
    u = skeleton.unit[skeleton.axis[skeleton.path(carrier, i)[-1][0]]]
    v = skeleton.unit[skeleton.axis[skeleton.path(carrier, j)[-1][0]]]
    spin_i, spin_j = skeleton.spin(carrier, i, u), skeleton.spin(carrier, j, v)
    assert spin_i is not None
    assert spin_j is not None
    z_i, z_j = Fraction(first["teeth"]), Fraction(second["teeth"])
    if u is not v and any(cross(u, v)):
        # cones with one apex: c along their common line, at the distances z_i and z_j from the axes
        f_i, f_j = first.get("facing", 1), second.get("facing", 1)
        c = tuple(f_i * z_j * a + f_j * z_i * b for a, b in zip(u, v, strict=True))
        of_i, of_j = cross(u, c), cross(v, c)
    else:
        # cylinders: from the one centre to the other along d, the pitch point r_i from the first
        d = next(cross(u, axis) for axis in ((1, 0, 0), (0, 1, 0)) if any(cross(u, axis)))
        inside_i, inside_j = first.get("internal", False), second.get("internal", False)
        # a ring reaches over its mate to the same side
        arm_i = tuple(z_i * part for part in d)
        arm_j = tuple((z_j if inside_i or inside_j else -z_j) * part for part in d)
        of_i, of_j = cross(u, arm_i), cross(v, arm_j)
    at = next(at for at in range(3) if of_i[at] or of_j[at])
    assert all(of_i[at] * of_j[b] == of_i[b] * of_j[at] for b in range(3)), "both velocities lie along one line"
    return [a * of_i[at] if a else a for a in spin_i], [b * of_j[at] if b else b for b in spin_j]


def rigid(train: RandomTrain, skeleton: Skeleton, bodies: Sequence[tuple[str, str]]) -> Iterable[Row]:
    """Return the rows of all rigid connections: twists that vanish.

    Three axes or fewer lock each other if they are different lines. Four or more axes do if their screws are
    independent at their declared positions; otherwise they may be a linkage. Axes that others have already stopped do
    not count.
    """
    known, found = Space(skeleton.count), []
    waiting = [(skeleton.path(a, b)) for a, b in bodies]
    while waiting:
        for path in waiting:
            live = {skeleton.axis[at] for at, _, _ in path if _moves(known, skeleton, path, skeleton.axis[at])}
            rows = _twist(skeleton, path)
            if len(live) <= 3 or (train.placed and _rank([_screw(skeleton, label) for label in live]) == len(live)):
                for row in rows:
                    known.add(row)
                    found.append(row)
                waiting.remove(path)
                break
        else:
            raise LinkageError
    return found


def _moves(known: Space, skeleton: Skeleton, path: Sequence[tuple[int, int, str]], label: str) -> bool:
    """Return True if the known relations still permit the path to turn about an axis."""
    row = [Fraction(0)] * (skeleton.count + 1)
    for at, sense, _ in path:
        if skeleton.axis[at] == label:
            row[at] += sense
    return known.value(row) is None


def _twist(skeleton: Skeleton, path: Sequence[tuple[int, int, str]]) -> list[Row]:
    rows = [[Fraction(0)] * (skeleton.count + 1) for _ in range(6)]
    for at, sense, _ in path:
        for row, part in zip(rows, _screw(skeleton, skeleton.axis[at]), strict=True):
            row[at] += sense * part
    return rows


def _screw(skeleton: Skeleton, label: str) -> tuple[Fraction, ...]:
    """Return the angular velocity of a unit rate and the velocity of the point at the origin."""
    unit = skeleton.unit[label]
    return (*unit, *cross(skeleton.point[label], unit))


def _rank(vectors: Sequence[Sequence[Fraction]]) -> int:
    space = Space(6)
    for vector in vectors:
        space.add([*vector, Fraction(0)])
    return space.rank


def _bodies(data: Data, state: str | None) -> Iterable[tuple[str, str]]:
    """Return the pairs of links that are one body in a state."""
    own = data["states"][state] if state is not None else {}
    frame = data.get("frame", "frame")
    yield from ((frame, link) for link in own.get("fixed", data.get("fixed", ())))
    yield from ((a, b) for a, b in own.get("locks", data.get("locks", ())))
    for name in own.get("engaged", ()):
        clutch = data["clutches"][name]
        yield (frame, clutch["fixes"]) if "fixes" in clutch else tuple(clutch["locks"])


def inputs_of(data: Data, state: str | None) -> dict[str, Fraction]:
    """Return the input speeds in turns per second, or unchanged if no unit is written."""
    own = data["states"][state] if state is not None else {}
    return {link: _in_turns(str(text)) for link, text in own.get("inputs", data.get("inputs", {})).items()}


def _in_turns(text: str) -> Fraction:
    number, _, unit = text.partition(" ")
    return Fraction(number) * (TURNS_A_SECOND[unit] if unit else 1)


def _unit(direction: Sequence[int]) -> Unit:
    square = sum(part * part for part in direction)
    length = isqrt(square)
    assert length * length == square, "a direction of rational length"
    x, y, z = (Fraction(part, length) for part in direction)
    return x, y, z


def _dot(u: Unit, v: Unit) -> Fraction:
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
