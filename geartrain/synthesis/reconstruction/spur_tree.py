"""The part of a train that a reconstruction can find: a tree of arbors on the frame, joined by external spur meshes."""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass

from geartrain.errors import Problem, QuestionError
from geartrain.kinematics.circuits.joint_tree import Tree, find_tree
from geartrain.numerics.quantity import Figure
from geartrain.synthesis.reconstruction.reconstruction_problem import Arbor, PlacedWheel
from geartrain.train import Output, Train

_ALONG = (0, 0, 1)


@dataclass(frozen=True)
class DrivenArbor:
    """How an arbor is driven: by which wheel of which other arbor, and by which of its own."""

    parent: str
    driving: str
    driven: str


@dataclass(frozen=True)
class SpurTree:
    """Arbors of a train from its input to its pointers.

    source    the arbor of the input
    driven    how every other arbor is driven; parents come first
    pointers  name of an output -> its arbor
    counts    teeth of every wheel that meshes
    beside    arbors of the train that are not in the tree
    """

    train: Train
    source: str
    driven: Mapping[str, DrivenArbor]
    pointers: Mapping[str, str]
    counts: Mapping[str, int]
    beside: tuple[str, ...]

    @property
    def arbors(self) -> tuple[str, ...]:
        """Every arbor, the input first."""
        return self.source, *self.driven

    @property
    def has_idlers(self) -> bool:
        """Whether a driven wheel drives."""
        driving = {mesh.driving for mesh in self.driven.values()}
        return any(mesh.driven in driving for mesh in self.driven.values())

    def wheels_of(self, link: str) -> tuple[str, ...]:
        """The wheels of an arbor that mesh, as declared."""
        return tuple(name for name in self.train.links[link].wheels if name in self.counts)

    def arbor(self, lost: Collection[str] = (), link: str | None = None) -> Arbor:
        """The tree as a candidate.

        lost   arbors that did not survive, which have no names then
        link   the arbor at which it begins; default the input
        """
        link = self.source if link is None else link
        own = self.driven[link].driven if link in self.driven else None
        below: dict[str, list[Arbor]] = {name: [] for name in self.wheels_of(link)}
        for child, mesh in self.driven.items():
            if mesh.parent == link:
                below[mesh.driving].append(self.arbor(lost, child))

        def placed(wheel: str) -> PlacedWheel:
            return PlacedWheel(None if link in lost else wheel, self.counts[wheel])

        return Arbor(
            None if link in lost else link,
            None if own is None else placed(own),
            tuple(sorted(name for name, at in self.pointers.items() if at == link)),
            tuple((placed(wheel), tuple(children)) for wheel, children in below.items() if children and wheel != own),
            () if own is None else tuple(below[own]),
        )


def find_spur_tree(train: Train) -> SpurTree:
    """The tree from the input of a train to all pointers that it reaches.

    A pointer is an output whose speed is known (by `expect`, or a target with a tolerance) and that has a target; and
    where no such arbor follows, the last arbor whose speed is known. What leads to no pointer is not in the tree.

    Raises `QuestionError` where there is none: no single input, no pointer that it reaches, meshes that close a loop.
    """
    source = _source(train)
    driven = walk_meshes(train, source, {link: link for link in train.links})
    pointers = {
        name: link
        for name, link, output in _known_outputs(train)
        if link in driven and (output.targets and link != source)
    }
    _prune(train, driven, pointers)
    if not pointers:
        what = f"no pointer of '{train.name}' is reached from its input by external meshes of spur wheels on the frame"
        why = f"it has {_joined(_obstacles(train))}" if _obstacles(train) else "no output beyond the input has a speed"
        raise QuestionError(Problem(what, why, "only such trees are reconstructed yet"))
    counts = {name: train.wheels[name][1].count for mesh in driven.values() for name in (mesh.driving, mesh.driven)}
    known = {name: count for name, count in counts.items() if count is not None}
    if len(known) < len(counts):
        lost = next(name for name in counts if name not in known)
        what = f"the count of '{lost}' is still to be found"
        raise QuestionError(Problem(what, "", "give it a value", train.place("links")))
    beside = tuple(link for link in train.links if link not in (train.frame, source, *driven))
    return SpurTree(train, source, driven, pointers, known, beside)


def _source(train: Train) -> str:
    if train.states:
        what = f"'{train.name}' is driven otherwise in each of its states"
        raise QuestionError(Problem(what, "a reconstruction has one input", "ask of a train without states"))
    turning = [link for link, speed in train.case(None).inputs.items() if speed]
    if len(turning) != 1:
        what = f"'{train.name}' has {len(turning)} inputs that turn"
        raise QuestionError(Problem(what, "a reconstruction has one", "ask of a train with one", train.place("inputs")))
    return turning[0]


def walk_meshes(
    train: Train, source: str, arbors: Mapping[str, str], rings: Collection[str] = ()
) -> dict[str, DrivenArbor]:
    """How every arbor is driven that spur wheels on the frame reach from a source, breadth first.

    arbors  by link, the arbor that it is, or is a part of
    rings   wheels that may be internal

    Raises `QuestionError` where meshes close a loop.
    """
    meshes: dict[str, list[tuple[int, str, str]]] = {}
    tree = find_tree(train)
    for at, gear in enumerate(train.gears):
        if _is_taken(train, tree, gear.pair, rings):
            for own, other in (gear.pair, gear.pair[::-1]):
                meshes.setdefault(arbors[train.wheels[own][0]], []).append((at, own, other))
    driven: dict[str, DrivenArbor] = {}
    waiting, used = deque([source]), set[int]()
    while waiting:
        link = waiting.popleft()
        for at, own, other in meshes.get(link, ()):
            if at in used:
                continue
            used.add(at)
            child = arbors[train.wheels[other][0]]
            if child == source or child in driven:
                what = f"the meshes of '{train.name}' close a loop at '{train.gears[at].name}'"
                fix = "only trees are reconstructed yet"
                raise QuestionError(Problem(what, "an arbor is driven on two ways", fix, train.place("gears", at)))
            driven[child] = DrivenArbor(link, own, other)
            waiting.append(child)
    return driven


def _is_taken(train: Train, tree: Tree, pair: Iterable[str], rings: Collection[str]) -> bool:
    """Whether a mesh is of spur wheels on arbors that turn in the frame about parallel axes, no rings but some."""
    still = {*train.fixed, train.frame, *(link for lock in train.locks for link in lock)}
    directions = set()
    for name in pair:
        link, wheel = train.wheels[name]
        if (
            (wheel.internal and name not in rings)
            or wheel.kind != "spur"
            or link in still
            or not tree.bears(train.frame, link)
        ):
            return False
        axis = train.axes.get(tree.axis(link) or "")
        directions.add(_ALONG if axis is None else tuple(map(_value, axis.direction)))
    return len(directions) == 1


def _value(figure: Figure) -> object:
    return figure.value


def _known_outputs(train: Train) -> Iterator[tuple[str, str, Output]]:
    """Outputs seen from the frame whose speed is known, each with its link."""
    for name, output in train.case(None).outputs.items():
        known = output.expect is not None or any(target.tolerance is not None for target in output.targets)
        if known and output.relative_to in (None, train.frame):
            yield name, output.of or name, output


def _prune(train: Train, driven: dict[str, DrivenArbor], pointers: dict[str, str]) -> None:
    """Take away arbors that lead to no pointer, from the last ones on; their speeds, where known, are pointers."""
    named = {link: name for name, link, _ in reversed(list(_known_outputs(train)))}
    for link in reversed(list(driven)):
        if link in pointers.values() or any(mesh.parent == link for mesh in driven.values()):
            continue
        if link in named:
            pointers[named[link]] = link
        else:
            del driven[link]


def _obstacles(train: Train) -> list[str]:
    """What of a train no tree of spur wheels takes up."""
    tree = find_tree(train)
    wheels = [wheel for _, wheel in train.wheels.values()]
    moving = any(not tree.bears(train.frame, link) for link in tree.parent)
    found = {
        "arbors on a moving arbor": moving,
        "rings": any(wheel.internal for wheel in wheels),
        **{f"{kind} wheels": any(wheel.kind == kind for wheel in wheels) for kind in ("bevel", "contrate", "worm")},
        "pins in slots": bool(train.couplings),
        "arbors that are held": bool(train.fixed or train.locks),
    }
    return [what for what, there in found.items() if there]


def _joined(parts: list[str]) -> str:
    return ", ".join(parts[:-1]) + " and " + parts[-1] if len(parts) > 1 else "".join(parts)
