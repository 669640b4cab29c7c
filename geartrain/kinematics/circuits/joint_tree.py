"""Turning and sliding pairs as a tree rooted at the frame; directions and positions of axes, and signs of meshes.

The module also checks that helical wheels in mesh have compatible teeth, and determines their senses of rotation.

Two links form a rigid body if their relative twist vanishes. The twist is the sum, over all joints between the links,
of the joint rate times the screw of the joint axis. Screws of two or three different lines are independent, so every
joint on the path is locked, not only the sum of their rates (docs/theory.md, section 4). Four or more axes may form a
linkage with a variable ratio. Such a lock is rejected unless declared positions show that the linkage cannot move.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import combinations
from math import atan2, degrees, pi, remainder
from typing import Any

from geartrain.errors import DeclarationError, GearTrainError, Loc, Problem
from geartrain.numerics.containers import FrozenFields, collector_paused
from geartrain.numerics.elimination import eliminate
from geartrain.numerics.graphs import DisjointSets, ways_to_common_ancestor
from geartrain.numerics.quantity import Figure
from geartrain.numerics.vectors import ExactVector, cross, dot, minus, parallel, size
from geartrain.train import StateCase, Train, Wheel
from geartrain.train.mechanism import Revolute, Slide
from geartrain.train.states import Escapement


@dataclass(frozen=True, slots=True)
class Tree(FrozenFields):
    """Turning and sliding pairs of a train as a spanning tree rooted at the frame, which determines the carriers."""

    frame: str
    parent: Mapping[str, tuple[str, str]]
    """Parent of each link (its neighbour towards the frame), and the label of the axis between the two links."""
    top: Mapping[str, str]
    """Link that carries the axis of each link: the first link on the path to the frame that is not on that axis."""
    lines: Mapping[str, str] = field(default_factory=dict)
    """Direction of travel of each sliding link, as the label of the first declared axis that is parallel to it."""

    def reference(self, link: str, base: str) -> str:
        """Return the first link on the path from `base` to the frame whose motion is of the same kind as the motion of
        `link`; the frame if there is none.

        For a turning link, it is the nearest link that turns, because a sliding link does not turn relative to the link
        that carries it. For a sliding link, it is the nearest link that slides in the same direction.
        """
        return self.moving(base, self.lines.get(link)) if self.lines else base

    def moving(self, link: str, line: str | None) -> str:
        """Return the first link on the path from `link` to the frame, including `link`, that slides along the axis
        label `line`, or that turns if `line` is None; the frame if there is none.
        """
        while link != self.frame and self.lines.get(link) != line:
            link = self.parent[link][0]
        return link

    def borne_by(self, link: str) -> str:
        """Return the link relative to which `link` moves in its joint: `reference` of its parent."""
        return self.reference(link, self.parent[link][0])

    def bearer(self, link: str) -> str:
        """Return the link relative to which `link` moves on its axis: `reference` of the link that carries the axis."""
        return self.reference(link, self.top[link])

    def axis(self, link: str) -> str | None:
        """Return the axis label of the joint between a link and its parent; None for the frame."""
        return self.parent[link][1] if link in self.parent else None

    def above(self, link: str) -> str | None:
        """Return the parent of a link, which is its neighbour towards the frame; None for the frame."""
        return self.parent[link][0] if link in self.parent else None

    def bears(self, carrier: str, link: str) -> bool:
        """Return True if `carrier` carries the axis of `link`."""
        return self.top.get(link) == carrier

    def axis_seen_from(self, carrier: str, link: str) -> str:
        """Return the label of the axis about which a link of a circuit turns relative to the circuit's carrier.

        This is the axis of the link if the carrier carries it, and the axis of the carrier if not, because the link is
        then coaxial with the carrier or carries the carrier's axis.
        """
        return self.parent[link if self.bears(carrier, link) else carrier][1]

    def path(self, i: str, j: str) -> tuple[list[str], list[str]]:
        """Return the links of the tree path from i to j, including both, and the axis labels between them."""
        up, down = ways_to_common_ancestor(i, j, self.above)
        labels = [self.parent[link][1] for link in [*up[:-1], *down[-2::-1]]]
        return up + down[-2::-1], labels


def pallet_link(escapement: Escapement, tree: Tree) -> str:
    """Return the link on which the pallets of an escapement are mounted."""
    return escapement.on or tree.top[escapement.link]


def check_pallets(train: Train, tree: Tree) -> None:
    """Raise `DeclarationError` if the pallets of the escapement can move away from the escape wheel."""
    escapement = train.escapement
    if escapement is None or escapement.on is None:
        return
    link, on, bearer = escapement.link, escapement.on, tree.top[escapement.link]
    # a link on the same axis of the same carrier turns about the escape wheel
    coaxial = on != link and tree.bears(bearer, on) and tree.axis(on) == tree.axis(link)
    if on != bearer and not coaxial:
        what = f"pallets on '{on}' do not stay beside the escape wheel '{link}'"
        fix = f"write `on: {bearer}`, or a link that turns about the axis of '{link}'"
        place = train.place("escapement", "on")
        why = f"the pallets must keep their distance from the axis of the escape wheel, which '{bearer}' carries"
        raise DeclarationError([Problem(what, why, fix, place)])


@collector_paused()
def find_tree(train: Train) -> Tree:
    """Return the tree of joints with the frame as root. Raises `DeclarationError` if the joints do not form a tree."""
    declared: list[tuple[Revolute | Slide, Loc]] = [
        *((joint, ("revolutes", at)) for at, joint in enumerate(train.revolutes)),
        *((joint, ("slides", at)) for at, joint in enumerate(train.slides)),
    ]
    if not declared and len(train.links) > 1:
        raise DeclarationError(_no_joints(train))
    joints: dict[str, list[tuple[str, str, int]]] = {link: [] for link in train.links}
    for at, (joint, _) in enumerate(declared):
        first, second = joint.pair
        joints[first].append((second, joint.axis, at))
        joints[second].append((first, joint.axis, at))
    parent: dict[str, tuple[str, str]] = {}
    top: dict[str, str] = {}
    bearer: dict[str, tuple[str, int]] = {}
    used: set[int] = set()
    sliding: dict[str, str] = {}
    problems = list(_labels_of_both(train))
    queue = deque([train.frame])
    while queue:
        link = queue.popleft()
        for other, axis, at in joints[link]:
            # compare pairs, not links, because two pairs between the same links close a cycle
            if at in used:
                continue
            used.add(at)
            if other == train.frame or other in parent:
                problems.append(_cycle(train, Tree(train.frame, parent, top), link, other, declared[at][1]))
                continue
            parent[other] = (link, axis)
            if isinstance(declared[at][0], Slide):
                sliding[other] = axis
            # a link on the axis of its parent has the carrier of its parent
            top[other] = top[link] if link in parent and parent[link][1] == axis else link
            first_top, first_at = bearer.setdefault(axis, (top[other], at))
            if first_top != top[other]:
                places = declared[first_at][1], declared[at][1]
                problems.append(_two_axes(train, axis, first_top, top[other], *places))
            queue.append(other)
    problems += [_unconnected(train, link) for link in train.links if link != train.frame and link not in parent]
    if problems:
        raise DeclarationError(problems)
    return Tree(train.frame, parent, top, _lines(train, parent, sliding) if sliding else {})


def _lines(train: Train, parent: Mapping[str, tuple[str, str]], sliding: Mapping[str, str]) -> dict[str, str]:
    """Return the direction in which each sliding link travels, as the label of the first axis with this direction. Two
    axes have the same direction if they remain parallel, because every link between them turns about an axis parallel
    to them.
    """
    labels = dict.fromkeys(sliding.values())
    lines = {label: label for label in labels}
    declared = {label for label in labels if label in train.axes and "direction" in train.axes[label].model_fields_set}
    known = {label: _line(_vector(train.axes[label].direction)) for label in declared}
    for link, label in sliding.items():
        above = parent[link][0]
        while label in known and above in parent:
            other = parent[above][1]
            if above in sliding and known.get(other) == known[label]:
                lines[label] = lines[other]
                break
            turns = train.axes[other].direction if other in train.axes else _Z
            if above not in sliding and _line(_vector(turns)) != known[label]:
                break
            above = parent[above][0]
    return {link: lines[label] for link, label in sliding.items()}


def _labels_of_both(train: Train) -> Iterator[Problem]:
    """Yield a problem for each axis label that is used for both turning and sliding pairs."""
    turning = {joint.axis for joint in train.revolutes}
    for at, joint in enumerate(train.slides):
        if joint.axis in turning:
            yield Problem(
                f"axis label '{joint.axis}' is used by turning pairs and by sliding pairs",
                "a label names one axis, about which links turn or along which they slide",
                f"give the slide another label: `{{pair: [{', '.join(joint.pair)}], axis: {joint.axis} slide}}`",
                train.place("slides", at),
            )


def _cycle(train: Train, tree: Tree, link: str, other: str, loc: Loc) -> Problem:
    links, _ = tree.path(link, other)
    if other in tree.parent and any(other in joint.pair for joint in train.slides):
        return Problem(
            f"link '{other}' has two joints: to '{tree.parent[other][0]}' and to '{link}'",
            "a link can turn or slide on only one other link",
            f"remove one of the two joints, or declare an additional link between '{link}' and '{other}'",
            train.place(*loc),
        )
    return Problem(
        f"the turning pairs form a cycle: {' - '.join([*links, link])}",
        "turning pairs must form a tree: n links on one axis are connected by n - 1 turning pairs",
        f"remove one of these turning pairs, such as [{link}, {other}]",
        train.place(*loc),
    )


def _two_axes(train: Train, axis: str, first: str, second: str, first_loc: Loc, loc: Loc) -> Problem:
    return Problem(
        f"axis label '{axis}' names two axes",
        f"one axis is carried by '{first}' ({train.place(*first_loc)}), the other by '{second}'; "
        "joints with the same label must be coaxial",
        "give the second axis a different label",
        train.place(*loc),
    )


def _no_joints(train: Train) -> Problem:
    link = next(link for link in train.links if link != train.frame)
    return Problem(
        "no turning pair is declared",
        f"every link but '{train.frame}' turns on an axis that another link carries",
        f"for example, add `revolutes: {{A: [{train.frame}, {link}]}}`, with an entry for each axis",
        train.place("revolutes") if "revolutes" in train.model_fields_set else train.place("links"),
    )


def _unconnected(train: Train, link: str) -> Problem:
    return Problem(
        f"link '{link}' is not connected to the frame",
        f"no chain of turning pairs leads from it to '{train.frame}'",
        f"add it to an axis of `revolutes`, or declare an axis of its own: `{link}: [{train.frame}, {link}]`",
        train.place("links", link),
    )


# -------------------------------------------------------------------------------------------------------- helical pairs


_SAME = 1e-6  # rad: tolerance of angles, because written angles are rounded


def check_parallel(first: Wheel, second: Wheel) -> None:
    """Raise `GearTrainError` for wheels on parallel axes whose helix angles or hands do not match.

    Teeth in contact have the same direction, so the wheels of an external pair have opposite hands, and a ring and its
    mate have the same hand. An undeclared hand is assumed to match.
    """
    angles = tuple(0.0 if wheel.helix_angle is None else wheel.helix_angle.si for wheel in (first, second))
    if abs(angles[0] - angles[1]) > _SAME:
        angles_text = " and ".join(f"{degrees(angle):.6g}" for angle in angles)
        what = f"helix angles of {angles_text} deg on parallel axes do not match"
        fix = "give both wheels the same `helix_angle`, or declare `axes` that are not parallel"
        raise GearTrainError(Problem(what, "the teeth would touch only at their corners", fix))
    ring = first.internal or second.internal
    if first.hand and second.hand and (first.hand == second.hand) != ring:
        what = f"a {first.hand}-hand wheel meshes with a {second.hand}-hand wheel"
        why = "a ring and its mate have the same hand" if ring else "wheels on parallel axes have opposite hands"
        raise GearTrainError(
            Problem(what, why, f"declare `hand: {'right' if first.hand == 'left' else 'left'}` for one of them")
        )


def crossed_sense(wheels: tuple[Wheel, Wheel], angle: float, side: int) -> tuple[int, str]:
    """Return the sense of two helical wheels on skew axes, and a note. The sense is 1 if they turn in opposite senses,
    as spur wheels do, and -1 if not. The note is empty unless the sense is only a convention.

    Let b1 and b2 be the helix angles (positive for right-hand helices), and S the angle from the first axis to the
    second, about the direction from the second to the first. Teeth are aligned if b1 + b2 = S, and then z1 w1 = -z2 w2;
    or if b1 + b2 = S plus half a turn, and then z1 w1 = z2 w2 (equations (12a) and (12b) of docs/theory.md).

    angle   angle between the directions of the axes [rad], 0 to pi
    side    1 if the angle is about the direction from the second axis to the first, -1 if it is about the opposite
            direction, 0 if unknown

    Raises `GearTrainError` if the teeth are not aligned.
    """
    lean = wheels[0].helix + wheels[1].helix
    # both sides are tried if the positions do not determine the sense of the angle
    fits = [
        (sense, way)
        for way in ((side,) if side else (1, -1))
        for sense, turned in ((1, 0.0), (-1, pi))
        if abs(remainder(lean - way * angle - turned, 2 * pi)) <= _SAME
    ]
    if not fits:
        raise GearTrainError(_not_aligned(wheels, angle, side))
    # both sides may give the same sense of rotation
    if len({sense for sense, _ in fits}) == 1:
        return fits[0][0], ""
    note = (
        "sense of rotation by convention (as if the second axis passed over the first): "
        "positions of the axes do not determine it"
    )
    return fits[0][0], note


def crossed_helix_angles(wheels: tuple[Wheel, Wheel], angle: float, side: int) -> tuple[float, float] | None:
    """Return the helix angles of two wheels on skew axes [rad], positive for right-hand helices; None if they are
    unknown.

    The helix angle of a worm and the shaft angle determine the helix angle of its wheel by equation (12a); the helix
    angle of the wheel may also be declared. If the helix angle of a worm is not declared, both helix angles are
    unknown. The parameters are the same as in `crossed_sense`. Raises `GearTrainError` if the wheel of a worm declares
    another helix angle or hand than the worm requires.
    """
    kinds = [wheel.kind for wheel in wheels]
    if "worm" not in kinds:
        return None if all(wheel.helix_angle is None for wheel in wheels) else (wheels[0].helix, wheels[1].helix)
    at = kinds.index("worm")
    worm, wheel = wheels[at], wheels[1 - at]
    if worm.helix_angle is None:
        return None
    # b1 + b2 = S, or S plus half a turn: both sides if the positions do not determine the sign
    leans = [remainder(way * angle - worm.helix, pi) for way in ((side,) if side else (1, -1))]
    if wheel.helix_angle is not None:
        # without a hand both signs of the declared angle are possible
        declared = {wheel.helix} if wheel.hand else {wheel.helix, -wheel.helix}
        leans = [lean for lean in leans if any(abs(lean - each) <= _SAME for each in declared)]
    if not leans:
        raise GearTrainError(_not_aligned(wheels, angle, side))
    return (leans[0], worm.helix) if at else (worm.helix, leans[0])


def _not_aligned(wheels: tuple[Wheel, Wheel], angle: float, side: int) -> Problem:
    hands = [f"{degrees(abs(wheel.helix)):.6g} deg ({wheel.hand or 'right'} hand)" for wheel in wheels]
    seen = ", measured about the line from the second axis to the first" if side else ""
    return Problem(
        f"teeth with helix angles of {hands[0]} and {hands[1]} are not aligned in mesh",
        f"the sum of the helix angles, positive for right-hand helices, must be the shaft angle of "
        f"{degrees(angle) * (side or 1):.6g} deg{seen}",
        "change a `helix_angle` or a `hand`, or the axes",
    )


# ----------------------------------------------------------------------------------------------------------------- axes


_Z: ExactVector = (Fraction(0), Fraction(0), Fraction(1))


class Axes:
    """Directions of the axes of a train, and the signs of speeds and meshes that follow from them.

    Speeds about parallel axes are added with their signs. Speeds about non-parallel axes are also added, because the
    Willis equation of a pair is scalar (Freudenstein, Longman and Chen 1984).
    """

    def __init__(self, train: Train, tree: Tree) -> None:
        self.tree, self.links = tree, tuple(train.links)
        self.positions = {label: axis.position for label, axis in train.axes.items() if axis.position}
        self.directions = {label: _vector(axis.direction) for label, axis in train.axes.items()}
        self.plain = all(direction == _Z for direction in self.directions.values())
        first: dict[ExactVector, tuple[int, ExactVector]] = {}
        lines = {label: _line(direction) for label, direction in {"": _Z, **self.directions}.items()}
        for label, line in lines.items():
            first.setdefault(line, (len(first), self.direction(label)))
        # for each axis the number of its direction class, and its sense relative to the first axis of the class
        self._lines = {label: first[line][0] for label, line in lines.items()}
        self._senses = {
            label: 1 if dot(first[line][1], self.direction(label)) > 0 else -1 for label, line in lines.items()
        }

    def direction(self, label: str | None) -> ExactVector:
        """Return the declared direction of an axis as a vector of any length; z if no direction is declared."""
        return self.directions.get(label or "", _Z)

    def sign(self, label: str | None) -> int:
        """Return -1 if an axis points against the reference direction of the axes parallel to it, and 1 if it does not.
        The reference direction is z, or, for other directions, the direction of the axis that is declared first.
        """
        return self._senses.get(label or "", 1)

    @property
    def link_signs(self) -> Mapping[str, int]:
        """Sign of each link's axis, by link: -1 if it points against the reference direction of the axes parallel to
        it. Links with the sign 1 are omitted.
        """
        if self.plain:
            return {}
        return {link: -1 for link in self.links if self.sign(self.tree.axis(link)) < 0}

    @property
    def joint_sums(self) -> frozenset[str]:
        """Links with non-parallel joints up to the frame, whose speed is a sum of joint speeds and not a rotation."""
        if self.plain:
            return frozenset()
        sums: set[str] = set()
        parent, moving = self.tree.parent, self.tree.moving
        for link, (above, label) in parent.items():  # from the frame outwards
            # a sliding link has its own coordinate, and does not turn
            up = moving(above, None)
            turns = link not in self.tree.lines
            if turns and (up in sums or (up in parent and not self.are_parallel((label, self.tree.axis(up))))):
                sums.add(link)
        return frozenset(sums)

    def is_rotation(self, of: str, base: str) -> bool:
        """Return True if all joint axes between two links are parallel, so that their relative motion is a rotation."""
        if self.plain or of in self.tree.lines:
            return True
        slides = {self.tree.axis(link) for link in self.tree.lines}
        return self.are_parallel(label for label in self.tree.path(of, base)[1] if label not in slides)

    def are_parallel(self, labels: Iterable[str | None]) -> bool:
        """Return True if all axes in `labels` are parallel in the pose in which all angles are 0."""
        return self.plain or len({self._lines.get(label or "", 0) for label in labels}) < 2

    def angle(self, labels: tuple[str, str]) -> float | None:
        """Return the angle between two axes as lines, 0 to pi/2 [rad]; None if neither direction is declared."""
        if self.directions.keys().isdisjoint(labels):
            return None
        angle, _ = self.crossing(*labels)
        return min(angle, pi - angle)

    def sense(self, labels: tuple[str, str]) -> int:
        """Return 1 if the angle between the reference directions of two axes is less than 90 degrees; otherwise -1."""
        first, second = (self.direction(label) for label in labels)
        return self.sign(labels[0]) * self.sign(labels[1]) * (-1 if dot(first, second) < 0 else 1)

    def are_one_line(self, one: str, other: str) -> bool:
        """Return True if two labels name one axis, or two axes whose declared positions are collinear."""
        if one == other:
            return True
        here, there = self.positions.get(one), self.positions.get(other)
        if here is None or there is None or not self.are_parallel((one, other)):
            return False
        return parallel(self.direction(one), minus(_vector(there), _vector(here)))

    def screw(self, label: str) -> dict[int, Fraction] | None:
        """Return the non-zero components of the screw of an axis, by index 0 to 5: the direction of the axis, and the
        velocity of the origin in a rotation about the axis at a speed of 1. Return None if no position is declared.
        """
        here = self.positions.get(label)
        if here is None:
            return None
        direction = self.direction(label)
        parts = (*direction, *cross(_vector(here), direction))
        if label in {self.tree.axis(link) for link in self.tree.lines}:
            parts = (Fraction(0),) * 3 + direction
        return {at: part for at, part in enumerate(parts) if part}

    def crossing(self, one: str, other: str) -> tuple[float, int]:
        """Return the angle between two axes, 0 to pi [rad], and its sign about the direction from `other` to `one`,
        which is 0 if the positions do not determine it.
        """
        first, second = self.direction(one), self.direction(other)
        upright = cross(first, second)
        here, there = self.positions.get(one), self.positions.get(other)
        side = 0 if here is None or there is None else dot(upright, minus(_vector(here), _vector(there)))
        far = size((float(upright[0]), float(upright[1]), float(upright[2])))
        return atan2(far, float(dot(first, second))), (side > 0) - (side < 0)

    def helix_angles(self, labels: tuple[str, str], wheels: tuple[Wheel, Wheel]) -> tuple[float, float] | None:
        """Return the helix angles of two wheels on skew axes [rad]; None for parallel axes or unknown angles."""
        return None if self.are_parallel(labels) else crossed_helix_angles(wheels, *self.crossing(*labels))

    def coefficients(self, i: str, j: str, carrier: str, wheel_i: Wheel, wheel_j: Wheel) -> tuple[int, int, str]:
        """Return the coefficients a and b of the Willis equation, and a note if the sense of rotation is only a
        convention (else ""). Raises `GearTrainError` for wheels that cannot mesh on their axes.
        """
        z_i, z_j = wheel_i.count or 0, wheel_j.count or 0
        if "worm" in (wheel_i.kind, wheel_j.kind):
            return self._worm(i, j, carrier, wheel_i, wheel_j)
        labels = self.tree.axis_seen_from(carrier, i), self.tree.axis_seen_from(carrier, j)
        side_by_side = self.are_parallel(labels)
        if wheel_i.is_helical or wheel_j.is_helical:
            if not side_by_side:
                sense, note = crossed_sense((wheel_i, wheel_j), *self.crossing(*labels))
                return z_i, sense * self.sign(labels[0]) * self.sign(labels[1]) * z_j, note
            check_parallel(wheel_i, wheel_j)
        # plane wheels: an external pair reverses the sense of rotation, an internal one does not
        ring = wheel_i.internal or wheel_j.internal
        if side_by_side and not {"bevel", "contrate"} & {wheel_i.kind, wheel_j.kind}:
            return z_i, -z_j if ring else z_j, ""
        if not side_by_side and ring:
            what = "the axes of a ring and its mate are not parallel"
            raise GearTrainError(
                Problem(what, "an internal pair needs parallel axes", "correct the axes, or use a bevel pair")
            )
        # bevel and crown wheels: the sense depends on the sides on which their cones open
        side_i = wheel_i.facing * self.sign(labels[0])
        side_j = wheel_j.facing * self.sign(labels[1])
        return z_i, (-1 if ring else 1) * z_j * side_i * side_j, ""

    def _worm(self, i: str, j: str, carrier: str, wheel_i: Wheel, wheel_j: Wheel) -> tuple[int, int, str]:
        """Return a, b and the note for a worm drive; its sense follows from the worm's hand and the axis positions."""
        z_i, z_j = wheel_i.count or 0, wheel_j.count or 0
        worm_first = wheel_i.kind == "worm"
        # a worm without a declared hand is right-handed
        hand = -1 if (wheel_i if worm_first else wheel_j).hand == "left" else 1
        labels = self.tree.axis_seen_from(carrier, i), self.tree.axis_seen_from(carrier, j)
        worm, wheel = labels if worm_first else labels[::-1]
        self.helix_angles(labels, (wheel_i, wheel_j))  # raises if the teeth are not aligned with the thread
        here, there = self.positions.get(worm), self.positions.get(wheel)
        turn = Fraction(0)
        if here is not None and there is not None:
            reach = minus(_vector(here), _vector(there))
            # the thread drives the wheel's teeth opposite to the direction in which the worm would advance
            turn = -hand * dot(self.direction(worm), cross(self.direction(wheel), reach))
        flip = self.sign(worm) * self.sign(wheel)
        if turn:
            return z_i, (-1 if turn > 0 else 1) * flip * z_j, ""
        note = (
            "sense of rotation by convention (a right-hand worm is assumed to reverse it): "
            "axes and positions of worm and wheel do not determine it"
        )
        return z_i, hand * flip * z_j, note


def _vector(figures: Iterable[Any]) -> ExactVector:
    """Return three numbers as a vector, or three lengths as a vector [m]."""
    x, y, z = (figure.value if isinstance(figure, Figure) else figure.base for figure in figures)
    return x, y, z


def _line(direction: ExactVector) -> ExactVector:
    """Return a direction scaled so that its first non-zero component is 1; it is equal for all parallel directions."""
    scale = next(part for part in direction if part)
    x, y, z = direction
    return x / scale, y / scale, z / scale


JointOnLine = tuple[str, str, tuple[str, ...]]
"""Joint: the names of its two links, and the labels of its axis, or of several collinear axes."""


@dataclass(frozen=True, slots=True)
class Rigid:
    """Brake or lock that makes two links one rigid body by locking the joints on the path between them."""

    links: tuple[str, ...]
    """Name of one braked link, or names of two links that are locked together."""
    joints: tuple[JointOnLine, ...]

    @property
    def labels(self) -> list[str]:
        """Labels of the axes of all joints on the path between the links."""
        return [label for _, _, labels in self.joints for label in labels]


def close_joints(train: Train, tree: Tree, cases: Sequence[StateCase]) -> list[StateCase]:
    """Return the case of each state, in which every brake and lock is expressed by brakes on links that turn on the
    frame and by locks between coaxial links.

    A brake or lock across several axes is replaced by locks of the joints on the path between its links. The `problems`
    of a case are set if the joints of a lock form a movable linkage, or if an input link has no fixed axis in the
    frame. Raises `DeclarationError` if every case has problems.
    """
    axes = Axes(train, tree)
    sums = axes.joint_sums
    closed = [_closed_case(train, axes, sums, case) for case in cases]
    if all(case.problems for case in closed):
        raise DeclarationError({str(problem): problem for case in closed for problem in case.problems}.values())
    return closed


def _closed_case(train: Train, axes: Axes, sums: frozenset[str], case: StateCase) -> StateCase:
    problems = [
        Problem(
            f"the input '{link}' does not turn about a single axis",
            "the joints between it and the frame have axes that are not parallel, so its axis of rotation moves",
            "drive a link whose joints up to the frame have parallel axes",
            train.place(*case.loc, link),
        )
        for link in sums.intersection(case.inputs)
    ]
    bodies = _Bodies(axes, case)
    across = [rigid for rigid in bodies.connections if len(rigid.joints) > 1]
    if across:
        stops, linkages = bodies.close(across)
        problems += [_linkage(train, case, rigid) for rigid in linkages]
        case = _joint_by_joint(train.frame, case, across, stops)
    if axes.tree.lines:
        case = _in_coordinates(axes.tree, case)
    return replace(case, problems=tuple(problems)) if problems else case


def _in_coordinates(tree: Tree, case: StateCase) -> StateCase:
    """Return the case in which each lock of a link to the link that carries it refers to `Tree.reference`, relative to
    which the speed of the locked link is measured. A lock to the frame becomes a brake.
    """
    fixed, locks, causes = list(case.fixed), [], dict(case.causes)
    for a, b in case.locks:
        link, base = (a, b) if tree.bears(b, a) else (b, a)
        own = tree.reference(link, base) if tree.bears(base, link) else base
        new = (a, b) if own == base else (link,) if own == tree.frame else (link, own)
        if new != (a, b):
            causes[new] = causes.get((a, b), (a, b))
        if len(new) == 1:
            fixed.append(link)
        else:
            locks.append((new[0], new[1]))
    return replace(case, fixed=tuple(dict.fromkeys(fixed)), locks=tuple(locks), causes=causes)


def rigid_across_axes(train: Train, tree: Tree, case: StateCase) -> Iterator[Rigid]:
    """Yield the brakes and locks that lock two or more joints, which no device on one axis can do. Joints that are
    locked by other brakes and locks are not counted.
    """
    bodies = _Bodies(Axes(train, tree), case)
    return (rigid for rigid in bodies.connections if len(bodies.open(rigid)) > 1)


class _Bodies:
    """Rigid bodies of a train in one state, as disjoint sets of links. Locking a joint merges two bodies, and collinear
    axes are treated as one axis.
    """

    def __init__(self, axes: Axes, case: StateCase) -> None:
        self._axes, self._tree = axes, axes.tree
        ends = [(link, self._tree.frame) for link in case.fixed] + list(case.locks)
        names = [(link,) for link in case.fixed] + list(case.locks)
        self.connections = [Rigid(links, self._joints(*pair)) for links, pair in zip(names, ends, strict=True)]
        self._bodies: DisjointSets[str] = DisjointSets()
        for rigid in self.connections:
            if len(rigid.joints) == 1:
                self._bodies.join(*rigid.joints[0][:2])

    def close(self, across: Sequence[Rigid]) -> tuple[list[tuple[Rigid, JointOnLine]], list[Rigid]]:
        """Lock the joints of those brakes and locks across several axes that cannot move. Return each locked joint with
        the brake or lock that causes the lock, and the other brakes and locks, whose joints form movable linkages.
        """
        closed: list[tuple[Rigid, JointOnLine]] = []
        waiting = list(across)
        # closing a joint may leave fewer open joints in other chains, so it is repeated
        while rigid := next((each for each in waiting if self._is_immobile(self.open(each))), None):
            waiting.remove(rigid)
            for joint in self.open(rigid):
                self._bodies.join(*joint[:2])
                closed.append((rigid, joint))
        return closed, waiting

    def open(self, rigid: Rigid) -> list[JointOnLine]:
        """Return the joints on the path of a brake or lock that are not yet locked."""
        return [joint for joint in rigid.joints if self._bodies.are_apart(joint[0], joint[1])]

    def _joints(self, a: str, b: str) -> tuple[JointOnLine, ...]:
        """Return the joints on the path between two links; consecutive joints on collinear axes are merged."""
        parent, top = self._tree.parent, self._tree.top
        up, down = ways_to_common_ancestor(a, b, top.get)
        steps = [(link, top[link], parent[link][1]) for link in up[:-1]]
        steps += [(top[link], link, parent[link][1]) for link in down[-2::-1]]
        found: list[JointOnLine] = []
        for start, end, label in steps:
            if found and self._axes.are_one_line(found[-1][2][-1], label):
                before = found.pop()
                found.append((before[0], end, tuple(dict.fromkeys((*before[2], label)))))
            else:
                found.append((start, end, (label,)))
        return tuple(found)

    def _is_immobile(self, joints: Sequence[JointOnLine]) -> bool:
        """Return True if a closed chain of the given joints certainly cannot move; False if it may be movable."""
        labels = [labels[0] for _, _, labels in joints]
        # up to three different lines have independent screws in every pose; for more, the rank in this pose decides
        if len(labels) <= 3 and not any(self._axes.are_one_line(*two) for two in combinations(labels, 2)):
            return True
        screws = [screw for label in labels if (screw := self._axes.screw(label)) is not None]
        return len(screws) == len(labels) and eliminate(screws).rank == len(labels)


def _joint_by_joint(
    frame: str, case: StateCase, across: Sequence[Rigid], stops: Sequence[tuple[Rigid, JointOnLine]]
) -> StateCase:
    """Return the case in which brakes and locks across several axes are replaced by locks of single joints."""
    spread = {rigid.links for rigid in across}
    fixed = [link for link in case.fixed if (link,) not in spread]
    locks = [lock for lock in case.locks if lock not in spread]
    causes: dict[tuple[str, ...], tuple[str, ...]] = {}
    for rigid, (start, end, _) in stops:
        # a joint of the frame is closed by a brake, other joints by a lock
        if frame in (start, end):
            link = end if start == frame else start
            fixed.append(link)
            causes[(link,)] = rigid.links
        else:
            locks.append((start, end))
            causes[(start, end)] = rigid.links
    return replace(case, fixed=tuple(dict.fromkeys(fixed)), locks=tuple(locks), causes=causes)


def _linkage(train: Train, case: StateCase, rigid: Rigid) -> Problem:
    links = [inner for _, inner, _ in rigid.joints[:-1] if inner != train.frame]
    return Problem(
        f"{case.says(*rigid.links)} across the axes {', '.join(rigid.labels)}, which would form a linkage",
        f"a closed chain of {len(rigid.joints)} turning pairs may move with a varying ratio, which a gear train "
        "cannot have",
        f"fix or lock a link in between ({', '.join(links)}), or lock coaxial links",
        train.place(*rigid_place(train, case, rigid.links)),
    )


def rigid_place(train: Train, case: StateCase, links: tuple[str, ...]) -> Loc:
    """Return the path of keys in the declaration at which a brake or lock is declared."""
    if links in case.clutches:
        return ("clutches", case.clutches[links])
    key = "fixed" if len(links) == 1 else "locks"
    state = train.states[case.state] if case.state is not None else None
    own = getattr(state, key) if state is not None else None
    listed = list(getattr(train, key) if own is None else own)
    at = listed.index(links[0] if len(links) == 1 else links)
    return (key, at) if own is None or case.state is None else ("states", case.state, key, at)
