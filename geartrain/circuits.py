"""One fundamental circuit per gear pair and coupling: its carrier and its signed exact ratio.

Turning pairs form a tree. A gear pair (i, j) closes one circuit through it, and its carrier k is the link on the
tree path where the axis label changes (the transfer vertex). Hanging every link of one axis on the link of that
axis nearest the frame gives the same answer for every equivalent tree of coaxial joints, in constant time a pair.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, NamedTuple

from geartrain.bulk import collector_paused
from geartrain.errors import DeclarationError, Problem
from geartrain.pins import winding_number
from geartrain.quantity import Figure
from geartrain.train import Train, Wheel

Vector = tuple[Fraction, Fraction, Fraction]
_Z: Vector = (Fraction(0), Fraction(0), Fraction(1))


class Circuit(NamedTuple):
    """A fundamental circuit: `a (w_i - w_k) + b (w_j - w_k) = 0` with integers a and b.

    For an external gear pair a = z_i and b = z_j, for an internal one b = -z_j; for a coupling i is the slot
    with a = 1 and j the pin with b = -m, m the winding number.
    """

    id: str
    kind: str
    i: str
    j: str
    carrier: str
    a: int
    b: int
    wheels: tuple[str, str]
    note: str = ""

    @property
    def ratio(self) -> Fraction:
        """tau = (w_i - w_k) / (w_j - w_k), signed and exact."""
        return Fraction(-self.b, self.a)


@dataclass(frozen=True, slots=True)
class Tree:
    """The turning pairs as a tree rooted at the frame.

    parent  link -> (link nearer the frame, axis label), as declared
    top     link -> the link of the same axis nearest the frame, which bears it
    """

    frame: str
    parent: Mapping[str, tuple[str, str]]
    top: Mapping[str, str]

    def axis(self, link: str) -> str | None:
        """The label of the joint nearest the frame; None for the frame itself."""
        return self.parent[link][1] if link in self.parent else None

    def chain(self, link: str) -> list[str]:
        """The links from `link` to the frame, as declared."""
        chain = [link]
        while link in self.parent:
            link = self.parent[link][0]
            chain.append(link)
        return chain

    def path(self, i: str, j: str) -> tuple[list[str], list[str]]:
        """The tree path from i to j: its links, and the axis labels between them."""
        up, down = self.chain(i), self.chain(j)
        while len(up) > 1 and len(down) > 1 and up[-2] == down[-2]:
            up.pop()
            down.pop()
        down.pop()
        labels = [self.parent[link][1] for link in up[:-1]] + [self.parent[link][1] for link in reversed(down)]
        return up + down[::-1], labels


@collector_paused()
def find_tree(train: Train) -> Tree:
    """Root the turning pairs at the frame. Raises `DeclarationError` where they form no tree."""
    joints: dict[str, list[tuple[str, str, int]]] = {link: [] for link in train.links}
    for at, joint in enumerate(train.revolutes):
        first, second = joint.pair
        joints[first].append((second, joint.axis, at))
        joints[second].append((first, joint.axis, at))
    parent: dict[str, tuple[str, str]] = {}
    top: dict[str, str] = {}
    bearer: dict[str, tuple[str, int]] = {}
    used: set[int] = set()
    problems: list[Problem] = []
    queue = deque([train.frame])
    while queue:
        link = queue.popleft()
        for other, axis, at in joints[link]:
            if at in used:
                continue
            used.add(at)
            if other == train.frame or other in parent:
                problems.append(_cycle(train, Tree(train.frame, parent, top), link, other, at))
                continue
            parent[other] = (link, axis)
            top[other] = top[link] if link in parent and parent[link][1] == axis else link
            first_top, first_at = bearer.setdefault(axis, (top[other], at))
            if first_top != top[other]:
                problems.append(_two_axes(train, axis, first_top, top[other], first_at, at))
            queue.append(other)
    problems += [_loose(train, link) for link in train.links if link != train.frame and link not in parent]
    if problems:
        raise DeclarationError(problems)
    return Tree(train.frame, parent, top)


def _cycle(train: Train, tree: Tree, link: str, other: str, at: int) -> Problem:
    links, _ = tree.path(link, other)
    return Problem(
        f"the turning pairs form a cycle: {' - '.join([*links, link])}",
        "turning pairs must form a tree; links on one axis are joined by one pair fewer than there are links",
        f"remove one of these turning pairs, such as [{link}, {other}]",
        train.place("revolutes", at),
    )


def _two_axes(train: Train, axis: str, first: str, second: str, first_at: int, at: int) -> Problem:
    return Problem(
        f"axis label '{axis}' names two axes",
        f"one is borne by '{first}' ({train.place('revolutes', first_at)}), one by '{second}'; "
        "joints of one label are coaxial",
        "give the second axis a label of its own",
        train.place("revolutes", at),
    )


def _loose(train: Train, link: str) -> Problem:
    return Problem(
        f"link '{link}' is not joined to the frame",
        f"no chain of turning pairs leads from it to '{train.frame}'",
        f"add a turning pair for '{link}' to `revolutes`",
        train.place("links", link),
    )


@collector_paused()
def find_circuits(train: Train, tree: Tree) -> tuple[Circuit, ...]:
    """The circuits of all gear pairs, then of all couplings, in the order declared."""
    problems: list[Problem] = []
    axes = _Axes(train, tree)
    circuits = []
    wheels = train.wheels
    for at, gear in enumerate(train.gears):
        (i, wheel_i), (j, wheel_j) = wheels[gear.pair[0]], wheels[gear.pair[1]]
        carrier = _carrier(tree, i, j)
        if carrier is None:
            problems.append(_no_carrier(train, tree, gear.name, i, j, ("gears", at)))
            continue
        if wheel_i.count is None or wheel_j.count is None:
            problems.append(_no_count(train, gear.pair, (wheel_i, wheel_j)))
            continue
        if axes.plain and wheel_i.kind == wheel_j.kind == "spur":
            sign = -1 if wheel_i.internal or wheel_j.internal else 1
            circuits.append(Circuit(gear.name, "gear", i, j, carrier, wheel_i.count, sign * wheel_j.count, gear.pair))
            continue
        try:
            a, b, note = axes.coefficients(i, j, carrier, wheel_i, wheel_j)
        except ValueError as error:
            problems.append(
                Problem(
                    f"gear pair '{gear.name}': {error}",
                    "a ring meshes about a parallel axis",
                    "use a bevel pair",
                    train.place("gears", at),
                )
            )
            continue
        circuits.append(Circuit(gear.name, "gear", i, j, carrier, a, b, gear.pair, note))
    for at, coupling in enumerate(train.couplings):
        carrier = _carrier(tree, coupling.slot, coupling.pin)
        if carrier is None:
            problems.append(_no_carrier(train, tree, coupling.name, coupling.slot, coupling.pin, ("couplings", at)))
            continue
        winding = winding_number(coupling.kind)
        circuits.append(
            Circuit(
                coupling.name,
                coupling.kind,
                coupling.slot,
                coupling.pin,
                carrier,
                1,
                -winding,
                (coupling.slot, coupling.pin),
            )
        )
    if problems:
        raise DeclarationError(problems)
    return tuple(circuits)


def _carrier(tree: Tree, i: str, j: str) -> str | None:
    """The transfer vertex of the path i..j, or None where the axis does not change exactly once.

    With every link hung on the top of its own axis, the path changes axis once in three cases: both tops are the
    carrier; or the carrier is one link's top and shares the other's axis; or it hangs on the other link.
    """
    parent, top = tree.parent, tree.top
    axis_i = parent[i][1] if i in parent else None
    axis_j = parent[j][1] if j in parent else None
    top_i, top_j = top.get(i), top.get(j)
    if axis_i == axis_j:
        return None
    if top_i is not None and top_i == top_j:
        return top_i
    for carrier, other, axis_other in ((top_i, j, axis_j), (top_j, i, axis_i)):
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
        why = f"the turning pairs {steps} have one axis label, so '{i}' and '{j}' are coaxial"
        fix = "a gear pair needs two distinct axes: correct the axis labels or the wheels"
    else:
        where = " and at ".join(changes)
        why = f"on the turning pairs {steps} the axis changes at {where}, so the centre distance is not fixed"
        fix = f"a gear pair needs exactly one carrier: join '{i}' and '{j}' to one of {', '.join(changes)}"
    return Problem(f"'{name}' has no carrier", why, fix, train.place(*loc))


def _no_count(train: Train, pair: Sequence[str], wheels: Iterable[Wheel]) -> Problem:
    name = next(name for name, wheel in zip(pair, wheels, strict=True) if wheel.count is None)
    return Problem(
        f"wheel '{name}' has no tooth count yet",
        "it is declared with `search` bounds only, and a train is solved with numbers",
        "add a `value` beside `search`",
        train.place("links", train.wheels[name][0], "wheels", name),
    )


class _Axes:
    """Directions of the axes of a train, and the signs that follow from them.

    Speeds of parallel axes are summed as they are; over non-parallel joints the sum of joint speeds is kept,
    which the scalar equation needs (Freudenstein, Longman and Chen 1984).
    """

    def __init__(self, train: Train, tree: Tree) -> None:
        self.tree = tree
        self.positions = {label: axis.position for label, axis in train.axes.items() if axis.position}
        self.directions = {label: _vector(axis.direction) for label, axis in train.axes.items()}
        self.plain = all(direction == _Z for direction in self.directions.values())

    def direction(self, label: str | None) -> Vector:
        return self.directions.get(label or "", _Z)

    def sign(self, label: str | None) -> int:
        """-1 if the axis points against the first declared direction parallel to it."""
        own = self.direction(label)
        first = next((d for d in (_Z, *self.directions.values()) if _parallel(d, own)), own)
        return 1 if _dot(first, own) > 0 else -1

    def coefficients(self, i: str, j: str, carrier: str, wheel_i: Wheel, wheel_j: Wheel) -> tuple[int, int, str]:
        """a and b of the circuit, and a note where a sign is a convention."""
        z_i, z_j = wheel_i.count or 0, wheel_j.count or 0
        if "worm" in (wheel_i.kind, wheel_j.kind):
            return self._worm(i, j, carrier, wheel_i, wheel_j)
        labels = self._labels(i, j, carrier)
        parallel = _parallel(self.direction(labels[0]), self.direction(labels[1]))
        if parallel and not {"bevel", "contrate"} & {wheel_i.kind, wheel_j.kind}:
            return z_i, -z_j if wheel_i.internal or wheel_j.internal else z_j, ""
        if not parallel and (wheel_i.internal or wheel_j.internal):
            raise ValueError("a ring on an axis that is not parallel to its mate's")
        side_i = wheel_i.facing * self.sign(labels[0])
        side_j = wheel_j.facing * self.sign(labels[1])
        if wheel_i.internal or wheel_j.internal:
            side_j = -side_j
        return z_i, z_j * side_i * side_j, ""

    def _labels(self, i: str, j: str, carrier: str) -> tuple[str | None, str | None]:
        """The axis labels on which i and j turn in the carrier."""
        _, first = self.tree.path(i, carrier)
        _, last = self.tree.path(carrier, j)
        return (first[0] if first else None), (last[-1] if last else None)

    def _worm(self, i: str, j: str, carrier: str, wheel_i: Wheel, wheel_j: Wheel) -> tuple[int, int, str]:
        """Starts of the worm over teeth of the wheel; the sense follows from hand and positions."""
        z_i, z_j = wheel_i.count or 0, wheel_j.count or 0
        worm_first = wheel_i.kind == "worm"
        hand = 1 if (wheel_i if worm_first else wheel_j).hand == "right" else -1
        label_i, label_j = self._labels(i, j, carrier)
        worm, wheel = (label_i, label_j) if worm_first else (label_j, label_i)
        here, there = self.positions.get(worm or ""), self.positions.get(wheel or "")
        turn = Fraction(0)
        if here is not None and there is not None:
            arm, centre = _vector(here), _vector(there)
            reach: Vector = (arm[0] - centre[0], arm[1] - centre[1], arm[2] - centre[2])
            # the worm's thread drives the wheel's teeth against the direction in which it would screw itself
            turn = -hand * _dot(self.direction(worm), _cross(self.direction(wheel), reach))
        flip = self.sign(worm) * self.sign(wheel)
        if turn:
            return z_i, (-1 if turn > 0 else 1) * flip * z_j, ""
        note = "sense by convention (a right-hand worm reverses): axes and positions of worm and wheel do not fix it"
        return z_i, hand * flip * z_j, note


def _vector(figures: Iterable[Any]) -> Vector:
    """Three figures as numbers, or three lengths in metres."""
    x, y, z = (figure.value if isinstance(figure, Figure) else figure.base for figure in figures)
    return x, y, z


def _dot(u: Vector, v: Vector) -> Fraction:
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def _cross(u: Vector, v: Vector) -> Vector:
    return u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]


def _parallel(u: Vector, v: Vector) -> bool:
    return not any(_cross(u, v))


def link_signs(train: Train, tree: Tree) -> dict[str, int]:
    """Links whose own axis points against the reference direction of its parallels: their speeds change sign."""
    axes = _Axes(train, tree)
    if axes.plain:
        return {}
    return {link: -1 for link in train.links if axes.sign(tree.axis(link)) < 0}


def bookkeeping_links(train: Train, tree: Tree) -> frozenset[str]:
    """Links several non-parallel joints from the frame: their speed is a sum of joint speeds, not a rotation."""
    axes = _Axes(train, tree)
    if axes.plain:
        return frozenset()
    return frozenset(
        link
        for link in tree.parent
        if not all(
            _parallel(axes.direction(tree.axis(link)), axes.direction(tree.axis(up))) for up in tree.chain(link)[1:-1]
        )
    )
