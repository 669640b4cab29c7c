"""Fundamental circuits of gear pairs and couplings, with their carriers and signed exact ratios, and shaft angles.

The turning pairs form a tree. A gear pair (i, j) closes one circuit through it, and its carrier k is the link on the
tree path where the axis label changes (the transfer vertex). Every link on an axis is attached to the link on that axis
that is nearest to the frame. The result is then the same for every equivalent tree of coaxial joints, and each pair
takes constant time.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import combinations
from math import degrees, pi
from typing import NamedTuple

from geartrain.errors import DeclarationError, GearTrainError, Problem, RangeError
from geartrain.kinematics.circuits.joint_tree import Axes, Tree
from geartrain.numerics.containers import collector_paused
from geartrain.numerics.vectors import cross, dot, size
from geartrain.teeth.coupling import COUPLINGS, Coupling, CouplingRow
from geartrain.train import Train


class Circuit(NamedTuple):
    """Fundamental circuit with its Willis equation a (w_i - w_k) + b (w_j - w_k) = 0, equation (4) of docs/theory.md.

    For an external gear pair a = z_i and b = z_j; for an internal gear pair b = -z_j. For a coupling, j is the driving
    link, i the driven link, and b = -m a with the mean ratio m. For a pin and slot, m is the winding number, equations
    (13) to (15).

    Examples
    --------
    >>> import geartrain
    >>> circuit = geartrain.load("planetary-24-18-60").circuits[1]
    >>> circuit.wheels, circuit.carrier, circuit.terms, circuit.ratio
    (('p', 'ring'), 'carrier', (('planet', 18), ('frame', -60), ('carrier', 42)), Fraction(10, 3))
    """

    id: str
    """Name of the pair or coupling."""
    kind: str
    """Kind of the circuit: "gear", or a key of `geartrain.teeth.coupling.COUPLINGS`."""
    i: str
    """Link of the first wheel, or driven link of a coupling, such as the link with the slot."""
    j: str
    """Link of the second wheel, or driving link of a coupling, such as the link with the pin."""
    carrier: str
    """Carrier k, which is the link that carries both axes (transfer vertex; Freudenstein and Yang 1972)."""
    a: int
    """Coefficient a of the speed of link i relative to the carrier in the Willis equation; it is positive."""
    b: int
    """Coefficient b of the speed of link j relative to the carrier in the Willis equation."""
    wheels: tuple[str, str]
    """Names of the two wheels; for a coupling without teeth, names of links i and j."""
    note: str = ""
    """Remark on the circuit: its sense of rotation is only a convention, or its links turn as one body. It is empty if
    neither applies.
    """
    by_teeth: bool = True
    """True if a and b are, up to their signs, the tooth counts of `wheels`; False for couplings without teeth."""
    bases: tuple[str, ...] = ()
    """Links whose speeds are subtracted from the speeds of i and j; empty if the carrier is subtracted from both.

    The motion of a link is compared with that of the carrier, or with the nearest link above it that has the same kind
    of motion: turning, or sliding in the same direction.
    """

    @property
    def travels(self) -> bool:
        """True if link j turns and link i slides, so that the ratio is a travel per turn."""
        return self.kind != "gear" and COUPLINGS[self.kind].travels

    @property
    def subtracted(self) -> tuple[str, str]:
        """Links whose speeds are subtracted from the speeds of links i and j."""
        return (self.bases[0], self.bases[1]) if self.bases else (self.carrier, self.carrier)

    @property
    def swings(self) -> bool:
        """True for a coupling whose instantaneous ratio varies about its mean value `ratio`."""
        return self.kind != "gear" and COUPLINGS[self.kind].varies

    @property
    def ratio(self) -> Fraction:
        """Signed exact speed ratio tau = (w_i - w_k) / (w_j - w_k)."""
        return Fraction(-self.b, self.a)

    @property
    def gain(self) -> Fraction:
        """Signed exact inverse ratio 1 / tau = (w_j - w_k) / (w_i - w_k); undefined if b = 0."""
        return Fraction(-self.a, self.b)

    @property
    def terms(self) -> tuple[tuple[str, int], ...]:
        """Links and their non-zero coefficients in the Willis equation a w_i + b w_j - (a + b) w_k = 0.

        Speeds are positive about the reference direction of parallel axes. The transposed row gives the torques of a
        pair without losses. Applied to the link angles, the row gives the phase of the mesh, modulo one pitch. If
        `bases` contains two links, they replace the carrier: their coefficients are -a and -b.
        """
        if self.bases:
            row: dict[str, int] = {}
            for link, factor in zip((self.i, self.j, *self.bases), (self.a, self.b, -self.a, -self.b), strict=True):
                row[link] = row.get(link, 0) + factor
            return tuple((link, factor) for link, factor in row.items() if factor)
        c = -self.a - self.b
        terms = (self.i, self.a), (self.j, self.b), (self.carrier, c)
        # b = 0 for a follower, and a + b = 0 for a pin in a slot: one link then drops out
        return terms if self.b and c else tuple(term for term in terms if term[1])

    def with_counts(self, counts: Mapping[str, int]) -> Circuit:
        """Return the circuit of the same pair with other tooth counts; the senses of rotation are unchanged.

        Parameters
        ----------
        counts : mapping of str to int
            Tooth counts of wheels, 1 or more, by wheel. Other wheels keep their tooth counts.
        """
        if not self.by_teeth or counts.keys().isdisjoint(self.wheels):
            return self
        a, b = (counts.get(wheel, abs(old)) for wheel, old in zip(self.wheels, (self.a, self.b), strict=True))
        return self._replace(a=a if self.a > 0 else -a, b=b if self.b > 0 else -b)


_SOLID = "with a ratio of 1, these coaxial links turn as one body, whatever the carrier: that is a lock"


class WillisEquation(NamedTuple):
    """Equation of a Willis system: the sum of coefficient times speed over all `terms` equals `right`.

    See Also
    --------
    WillisSystem : all rows of a train
    """

    label: str
    """Name of the pair, or of the prescribed speed, such as `input sun`."""
    kind: str
    """Kind of the equation: frame, input, fixed, lock, gear, or the kind of a coupling."""
    terms: tuple[tuple[str, int], ...]
    """Terms of the left-hand side, as pairs of a link and its non-zero coefficient."""
    right: Fraction = Fraction(0)
    """Right-hand side of the equation [the train's unit of speed]."""


@collector_paused()
def find_circuits(train: Train, tree: Tree) -> tuple[Circuit, ...]:
    """Return the circuits of all gear pairs, followed by the circuits of all couplings, in the order of declaration."""
    problems: list[Problem] = []
    axes = Axes(train, tree)
    circuits = []
    wheels = train.wheels
    for at, gear in enumerate(train.gears):
        (i, wheel_i), (j, wheel_j) = wheels[gear.pair[0]], wheels[gear.pair[1]]
        carrier = _carrier(tree, i, j)
        if carrier is None:
            problems.append(_no_carrier(train, tree, gear.name, i, j, ("gears", at)))
            continue
        if wheel_i.count is None or wheel_j.count is None:
            problems += _no_count(train, gear.pair)
            continue
        straight = wheel_i.helix_angle is None and wheel_j.helix_angle is None
        if axes.plain and straight and wheel_i.kind == wheel_j.kind == "spur":
            # fast path for nearly all pairs, without directions
            sign = -1 if wheel_i.internal or wheel_j.internal else 1
            a, b, note = wheel_i.count, sign * wheel_j.count, ""
        else:
            try:
                a, b, note = axes.coefficients(i, j, carrier, wheel_i, wheel_j)
            except GearTrainError as error:
                place = train.place("gears", at)
                problems += [
                    replace(each, what=f"gear pair '{gear.name}': {each.what}", place=place) for each in error.problems
                ]
                continue
        circuit = Circuit(gear.name, "gear", i, j, carrier, a, b, gear.pair, note)
        circuits.append(_turning(tree, circuit))
    for at, coupling in enumerate(train.couplings):
        found = _DeclaredCoupling(train, axes, coupling, at).circuits()
        problems += [each for each in found if isinstance(each, Problem)]
        circuits += [each for each in found if isinstance(each, Circuit)]
    if problems:
        raise DeclarationError(problems)
    return tuple(circuits)


class _DeclaredCoupling(NamedTuple):
    """Coupling of a train and its position in the declared list of couplings."""

    train: Train
    axes: Axes
    coupling: Coupling
    at: int

    def circuits(self) -> Sequence[Circuit | Problem]:
        """Return the circuits of the coupling, which have a common carrier, or the problems of its declaration."""
        train, tree, name = self.train, self.axes.tree, self.coupling.name
        wheels = [name for kind, name, _ in self.coupling.references() if kind == "wheel"]
        if missing := _no_count(train, wheels):
            return missing
        found = [self._circuit(row) for row in self.coupling.rows(train.wheels)]
        circuits = [each for each in found if isinstance(each, Circuit)]
        if len(circuits) < len(found):
            return [each for each in found if isinstance(each, Problem)]
        first = circuits[0]
        for one, other in combinations(circuits, 2):
            if other.carrier != first.carrier:
                kind = self.coupling.kind
                what = (
                    f"coupling '{name}': '{first.carrier}' carries the axes of '{first.j}' and '{first.i}', but "
                    f"'{other.carrier}' carries the axes of '{other.j}' and '{other.i}'"
                )
                why = f"the distance between '{first.i}' and '{other.i}' changes, and a {kind} keeps its length"
                fix = f"connect all its links to one carrier, or declare a {kind} for each carrier"
                return (self._problem(what, why, fix),)
            if tree.axis(one.i) == tree.axis(other.i):
                return (_no_carrier(train, tree, name, one.i, other.i, ("couplings", self.at)),)
        return circuits

    def _circuit(self, row: CouplingRow) -> Circuit | Problem:
        tree, coupling, ends = self.axes.tree, self.coupling, (row.driven, row.driver)
        carrier = _carrier(tree, *ends)
        if carrier is None and not coupling.NEEDS_DISTANCE:
            carrier = _coaxial_carrier(tree, *ends, row.carrier)
        elif row.carrier not in (None, carrier) and carrier is not None:
            what = f"'{row.carrier}' is not the carrier of coupling '{row.id}'"
            why = f"'{row.driver}' and '{row.driven}' turn about two axes at a fixed distance on '{carrier}'"
            return self._problem(what, why, f"omit `carrier`, or write `carrier: {carrier}`", "carrier")
        coaxial = _shared_axis(tree, *ends) is not None
        if carrier is None and row.carrier is not None and coaxial:
            what = f"'{row.carrier}' is not coaxial with '{row.driver}' and '{row.driven}'"
            why = "the carrier of a coaxial pair turns on the axis of the pair, or carries this axis"
            fix = "name a link on this axis as `carrier`, or omit it to use the link that carries the axis"
            return self._problem(what, why, fix, "carrier")
        if carrier is None:
            return _no_carrier(self.train, tree, row.id, *ends, ("couplings", self.at))
        note, by_teeth = _SOLID if row.a + row.b == 0 and coaxial else "", row.wheels is not None
        circuit = Circuit(row.id, coupling.kind, *ends, carrier, row.a, row.b, row.wheels or ends, note, by_teeth)
        return self._travelling(circuit) if circuit.travels else self._rotating(circuit)

    def _rotating(self, circuit: Circuit) -> Circuit | Problem:
        """Return the circuit of two turning links, with the sense that follows from their axes, or a problem."""
        axes, coupling = self.axes, self.coupling
        labels = _labels(axes.tree, circuit.carrier, circuit.i, circuit.j)
        sign = 1
        if coupling.OBLIQUE:
            if problem := self._wrong_angle(labels):
                return problem
            # both sides turn in the same sense about directions less than 90 degrees apart
            sign = axes.sense(labels)
        elif not coupling.PARALLEL:
            # the ratio is that of the speeds about each link's own axis
            sign = axes.sign(labels[0]) * axes.sign(labels[1])
        elif not axes.are_parallel(labels):
            driven, driver = coupling.SIDES
            names = (f"its {driven}", f"its {driver}") if driven != driver else (f"'{circuit.i}'", f"'{circuit.j}'")
            sides = [f"'{label}' of {name}" for label, name in zip(labels, names, strict=True)]
            what = f"coupling '{coupling.name}': the axes {sides[1]} and {sides[0]} are not parallel"
            fix = "declare parallel directions in `axes`, or connect the links by a universal joint or bevel wheels"
            return self._problem(what, coupling.PARALLEL, fix)
        return _turning(axes.tree, circuit._replace(b=sign * circuit.b))

    def _travelling(self, circuit: Circuit) -> Circuit | Problem:
        """Return the circuit of a turning link j and a sliding link i, or a problem of their axes."""
        axes, coupling, carrier, tree = self.axes, self.coupling, circuit.carrier, self.axes.tree
        along, about = _labels(tree, carrier, circuit.i, circuit.j)
        slides = {label: tree.lines[link] for link, (_, label) in tree.parent.items() if link in tree.lines}
        if along not in slides or about in slides:
            link, does, joints, key = circuit.j, "slides", "revolutes", "turns"
            if along not in slides:
                link, does, joints, key = circuit.i, "turns", "slides", "slides"
            what = f"coupling '{coupling.name}': '{link}' {does} on '{carrier}'"
            fix = f"declare '{link}' under `{joints}`, or name another link as `{key}`"
            return self._problem(what, f"a {coupling.kind} connects a link that turns with a link that slides", fix)
        b = circuit.b
        if coupling.kind != "screw":
            # the sense of a screw is that of its thread; other couplings are declared about and along their own axes
            b *= axes.sign(along) * axes.sign(about)
        elif {along, about} <= axes.directions.keys() and not axes.are_parallel((along, about)):
            what = f"coupling '{coupling.name}': the slide '{along}' is not parallel to the axis '{about}' of the screw"
            fix = f"give both the same direction in `axes`, such as `{along}: {{direction: [1, 0, 0]}}`"
            return self._problem(what, "a nut moves along the axis of its screw", fix)
        line = slides[along]
        i, j = tree.moving(circuit.i, line), tree.moving(circuit.j, None)
        return circuit._replace(i=i, j=j, b=b, bases=(tree.moving(carrier, line), tree.moving(carrier, None)))

    def _wrong_angle(self, labels: tuple[str, str]) -> Problem | None:
        """Return a problem if two axes are perpendicular or their angle differs from the declared angle; None if
        neither is the case.
        """
        between, declared = self.axes.angle(labels), getattr(self.coupling, "angle", None)
        what = f"coupling '{self.coupling.name}': "
        if between is not None and between > pi / 2 - _SAME_ANGLE:
            what += f"the axes '{labels[1]}' and '{labels[0]}' are perpendicular"
            return self._problem(what, "a joint at 90 deg does not turn", "declare directions less than 90 deg apart")
        if between is not None and declared is not None and abs(declared.si - between) > _SAME_ANGLE:
            what += f"its angle is {declared.text}, but its axes are at {degrees(between):.6g} deg"
            fix = "omit `angle`, which follows from `axes`, or correct a direction"
            return self._problem(what, "`angle` and `axes` both declare the same angle", fix)
        return None

    def _problem(self, what: str, why: str, fix: str, *key: str) -> Problem:
        return Problem(what, why, fix, self.train.place("couplings", self.at, *key))


def _turning(tree: Tree, circuit: Circuit) -> Circuit:
    """Return a circuit in which each sliding link is replaced by the nearest turning link that carries it."""
    if not tree.lines:
        return circuit
    i, j, base = (tree.moving(link, None) for link in (circuit.i, circuit.j, circuit.carrier))
    if (i, j, base) == (circuit.i, circuit.j, circuit.carrier):
        return circuit
    return circuit._replace(i=i, j=j, bases=(base, base))


def _shared_axis(tree: Tree, i: str, j: str) -> str | None:
    """Return the label of the axis about which both links turn, or about which one turns and which the other carries;
    None if there is no such axis.
    """
    for link, other in ((i, j), (j, i)):
        axis = tree.axis(link)
        if axis is not None and (tree.axis(other) == axis or tree.top[link] == other):
            return axis
    return None


def _coaxial_carrier(tree: Tree, i: str, j: str, declared: str | None) -> str | None:
    """Return the carrier of a coaxial pair: the declared carrier, or by default the link that carries the axis of the
    pair. Return None if the pair is not coaxial, or if the carrier is a member of the pair or is not on its axis.
    """
    axis = _shared_axis(tree, i, j)
    if axis is None:
        return None
    bearer = next(tree.top[link] for link in (i, j) if tree.axis(link) == axis)
    carrier = declared or bearer
    return carrier if carrier not in (i, j) and (carrier == bearer or tree.axis(carrier) == axis) else None


def couplings_on_axes(train: Train, tree: Tree) -> tuple[Coupling, ...]:
    """Return the couplings of a train, with the angles between their axes that follow from the declared `axes`."""
    if not any(coupling.OBLIQUE for coupling in train.couplings):
        return tuple(train.couplings)
    axes, found = Axes(train, tree), []
    for coupling in train.couplings:
        if coupling.OBLIQUE:
            driver, driven = coupling.links(train.wheels)
            carrier = _carrier(tree, driven, driver)
            if carrier is not None and (angle := axes.angle(_labels(tree, carrier, driven, driver))) is not None:
                coupling = coupling.on_axes(angle)
        found.append(coupling)
    return tuple(found)


def _labels(tree: Tree, carrier: str, i: str, j: str) -> tuple[str, str]:
    return tree.axis_seen_from(carrier, i), tree.axis_seen_from(carrier, j)


def _carrier(tree: Tree, i: str, j: str) -> str | None:
    """Return the carrier of the pair i, j: the link on the tree path from i to j at which the label of the joint axis
    changes; None if the label does not change exactly once. If several links are on one axis, their joints count as
    joints to the link that carries the axis.
    """
    parent, top = tree.parent, tree.top
    axis_i = parent[i][1] if i in parent else None
    axis_j = parent[j][1] if j in parent else None
    top_i, top_j = top.get(i), top.get(j)
    # coaxial links have no centre distance, and so no carrier
    if axis_i == axis_j:
        return None
    if top_i is not None and top_i == top_j:
        return top_i
    for carrier, other, axis_other in ((top_i, j, axis_j), (top_j, i, axis_i)):
        # the frame has no axis, and a link does not carry itself
        if carrier is None or carrier == other or carrier not in parent:
            continue
        if parent[carrier][1] == axis_other or top[carrier] == other:
            return carrier
    return None


def _no_carrier(train: Train, tree: Tree, name: str, i: str, j: str, loc: tuple[str | int, ...]) -> Problem:
    links, labels = tree.path(i, j)
    steps = links[0] + "".join(f" -({label})- {link}" for label, link in zip(labels, links[1:], strict=True))
    changes = [links[at + 1] for at in range(len(labels) - 1) if labels[at] != labels[at + 1]]
    if not changes:
        why = (
            f"the turning pairs {steps} have one axis label, so '{i}' and '{j}' are coaxial, but a pair needs two axes"
        )
        fix = "correct the axis labels, or the wheels of the pair"
    else:
        where = " and at ".join(changes)
        why = f"on the turning pairs {steps} the axis changes at {where}, so the centre distance is not fixed"
        fix = f"connect '{i}' and '{j}' to one carrier: {' or '.join(changes)}"
    return Problem(f"'{name}' has no carrier", why, fix, train.place(*loc))


def _no_count(train: Train, wheels: Sequence[str]) -> list[Problem]:
    """Return a problem for the first wheel without a tooth count, as a list; empty if all wheels have a tooth count."""
    what, why = "wheel '{}' has no tooth count yet", "only `search` is declared, and speeds need a definite count"
    missing = [name for name in wheels if train.wheels[name][1].count is None][:1]
    places = (train.place("links", train.wheels[name][0], "wheels", name) for name in missing)
    return [Problem(what.format(*missing), why, "add a `value` next to `search`", place) for place in places]


_SAME_ANGLE = 1e-3  # rad: tolerance of the angle of a joint, because written directions are rounded
_MEET = 1e-3  # relative to the distance between two declared points: closer axes intersect, as positions are rounded


def shaft_angle(train: Train, tree: Tree, circuit: Circuit) -> float | None:
    """Return the shaft angle of a gear pair, in (0, pi) [rad]; None if its axes are parallel.

    It is the sum of the half angles of both pitch cones, which is the angle between the directions from the apex to the
    two wheels. These directions follow from the axes and `facing`. Raises `RangeError` if axes with declared positions
    do not intersect.
    """
    axes, labels = Axes(train, tree), _labels(tree, circuit.carrier, circuit.i, circuit.j)
    if axes.are_parallel(labels):
        return None
    if passing_distance(axes, labels):
        what, why = "the axes of the pair do not intersect", "axes of bevel and contrate wheels must intersect"
        raise RangeError(Problem(what, why, "correct the positions of the axes"))
    angle, _ = axes.crossing(*labels)
    facing = train.wheels[circuit.wheels[0]][1].facing * train.wheels[circuit.wheels[1]][1].facing
    return angle if facing > 0 else pi - angle


def bevels_on_one_side(
    train: Train, circuits: Iterable[Circuit], is_rotation: Callable[[str, str], bool]
) -> Iterator[tuple[str, str, str]]:
    """Yield the names (one, other, third) of two bevel wheels on one axis that mesh with a third bevel wheel from the
    same side.

    The pitch cones of all three wheels have the same apex, so the first two wheels would occupy the same space. The
    sides follow from `facing` and from the senses of rotation of the two circuits.

    is_rotation   function that returns whether all axes between two links are parallel
    """
    mates: dict[str, list[tuple[str, str, bool]]] = {}
    for circuit in circuits:
        if circuit.kind != "gear" or any(train.wheels[wheel][1].kind != "bevel" for wheel in circuit.wheels):
            continue
        # only pairs on axes that are not parallel have an apex
        if not is_rotation(circuit.i, circuit.j):
            first, second = circuit.wheels
            mates.setdefault(second, []).append((first, circuit.i, circuit.b > 0))
            mates.setdefault(first, []).append((second, circuit.j, circuit.b > 0))
    for shared, sides in mates.items():
        for (one, link, side), (other, its, its_side) in combinations(sides, 2):
            if side == its_side and is_rotation(link, its):
                yield one, other, shared


def passing_distance(axes: Axes, labels: Sequence[str]) -> float | None:
    """Return the distance between two non-parallel axes [m], 0 if they intersect; None if a position is missing."""
    here, there = (axes.positions.get(label) for label in labels)
    if here is None or there is None:
        return None
    upright = cross(*(axes.direction(label) for label in labels))
    across = float(upright[0]), float(upright[1]), float(upright[2])
    apart = there[0].si - here[0].si, there[1].si - here[1].si, there[2].si - here[2].si
    offset = abs(dot(apart, across)) / size(across)
    return offset if offset > _MEET * size(apart) else 0.0
