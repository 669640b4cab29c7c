"""Parts of a train that a reconstruction can find: trees of arbors on the frame or on one carrier.

Spur wheels and rings join its arbors; those that a pin in a slot joins are one arbor of it. A part without some of its
arbors is evidence of which the answer is known: a test of what evidence is worth.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from typing import Any, NamedTuple

from geartrain.analysis import GearTrain
from geartrain.errors import Problem, QuestionError, suggest
from geartrain.kinematics.circuits.joint_tree import Tree, find_tree
from geartrain.numerics.graphs import joined_groups
from geartrain.numerics.quantity import Figure
from geartrain.search.reconstruct.link_roles import BaseLink, Joined
from geartrain.search.reconstruct.reconstruction_problem import Arbor, PlacedWheel
from geartrain.train import Train, declare
from geartrain.train.reconstruction import NEW_ARBOR

# From the arbor that drives along meshes of spur wheels: how every other arbor is driven.


_ALONG = (0, 0, 1)
_KEPT = ("title", "sources", "unit", "view")
_OF_WHEELS = ("internal", "status", "source", "note")


@dataclass(frozen=True)
class DrivenArbor:
    """How an arbor is driven: by which wheel of which other arbor, and by which of its own."""

    parent: str
    driving: str
    driven: str


class ArborMesh(NamedTuple):
    """A mesh as an arbor has it: the number of the gear pair, its own wheel, and the other one."""

    gear: int
    own: str
    other: str


def walk_arbors(
    train: Train, source: str, meshes: Mapping[str, Sequence[ArborMesh]], arbor_of: Callable[[str], str]
) -> dict[str, DrivenArbor]:
    """How every arbor is driven that meshes reach from a source, breadth first.

    meshes    by arbor
    arbor_of  the arbor of a wheel

    Raises `QuestionError` where meshes close a loop.
    """
    driven: dict[str, DrivenArbor] = {}
    waiting, used = deque([source]), set[int]()
    while waiting:
        arbor = waiting.popleft()
        for gear, own, other in meshes.get(arbor, ()):
            if gear in used:
                continue
            used.add(gear)
            child = arbor_of(other)
            if child == source or child in driven:
                what = f"the meshes of '{train.name}' close a loop at '{train.gears[gear].name}'"
                fix = "only trees are reconstructed yet"
                raise QuestionError(Problem(what, "an arbor is driven on two ways", fix, train.place("gears", gear)))
            driven[child] = DrivenArbor(arbor, own, other)
            waiting.append(child)
    return driven


def walk_meshes(
    train: Train, source: str, arbors: Mapping[str, str], rings: Collection[str] = ()
) -> dict[str, DrivenArbor]:
    """The same of all arbors that turn in the frame.

    arbors  by link, the arbor that it is, or is a part of
    rings   wheels that may be internal
    """
    tree = find_tree(train)
    meshes: dict[str, list[ArborMesh]] = {}
    for at, gear in enumerate(train.gears):
        internal = {name for name in gear.pair if train.wheels[name][1].internal}
        borne = all(tree.bears(train.frame, train.wheels[name][0]) for name in gear.pair)
        if borne and internal <= {*rings} and are_spur_mates(train, tree, gear.pair, train.frame):
            for own, other in (gear.pair, gear.pair[::-1]):
                meshes.setdefault(arbors[train.wheels[own][0]], []).append(ArborMesh(at, own, other))
    return walk_arbors(train, source, meshes, lambda wheel: arbors[train.wheels[wheel][0]])


def are_spur_mates(train: Train, tree: Tree, pair: Iterable[str], carrier: str) -> bool:
    """Whether two wheels are spur wheels or rings that turn on a carrier about parallel axes.

    carrier   what bears the axes; on another than the frame a wheel may stand still
    """
    still = {train.frame, *train.fixed}
    directions = set()
    for name in pair:
        link, wheel = train.wheels[name]
        stands = link in still
        if wheel.kind != "spur" or any(link in lock for lock in train.locks) or (stands and carrier in still):
            return False
        axis = train.axes.get(tree.axis(carrier if stands else link) or "")
        directions.add(_ALONG if axis is None else tuple(map(_value, axis.direction)))
    return len(directions) == 1


def _value(figure: Figure) -> object:
    return figure.value


@dataclass(frozen=True)
class SpurTree:
    """Arbors of a train from the one at which a part of it begins to its pointers."""

    train: Train
    base: BaseLink
    """What bears the arbors, and at what speed the first of them turns."""
    driven: Mapping[str, DrivenArbor]
    """How every other arbor is driven; parents come first."""
    joined: Joined
    """By arbor that stands for several links, all of them, itself first."""
    pointers: Mapping[str, str]
    """Name of an output, or of a link whose speed is given, -> its arbor."""
    counts: Mapping[str, int]
    """Teeth of every wheel that meshes."""
    teeth: tuple[int, int]
    """The fewest and the most that an added wheel may have."""

    @property
    def source(self) -> str:
        """The arbor at which it begins."""
        return self.base.source

    @property
    def arbors(self) -> tuple[str, ...]:
        """Every arbor, the first one first."""
        return self.source, *self.driven

    @property
    def has_idlers(self) -> bool:
        """Whether a driven wheel drives."""
        driving = {mesh.driving for mesh in self.driven.values()}
        return any(mesh.driven in driving for mesh in self.driven.values())

    @cached_property
    def able(self) -> tuple[str, ...]:
        """Arbors that can be lost: all driven ones but those with a ring, for no ring is added."""
        wheels = self.train.wheels
        return tuple(link for link in self.driven if not any(wheels[name][1].internal for name in self.wheels_of(link)))

    @property
    def name(self) -> str:
        """What part of the train it is; nothing for that which begins at the input, on the frame."""
        if self.base.is_carrier:
            return f"on {self.base.name}, from {self.source}"
        return "" if self.source in self.train.case(None).inputs else f"from {self.source}"

    def links_of(self, arbor: str) -> tuple[str, ...]:
        """The links that an arbor stands for; those that stand still all are the frame."""
        if arbor == self.train.frame:
            return arbor, *self.train.fixed
        return self.joined.get(arbor, (arbor,))

    def arbor_of(self, link: str) -> str:
        """The arbor that stands for a link: mostly itself."""
        return next((arbor for arbor, links in self.joined.items() if link in links), link)

    def link_of(self, pointer: str) -> str:
        """The link whose speed a pointer shows."""
        output = self.train.case(None).outputs.get(pointer)
        return pointer if output is None else output.of or pointer

    def wheels_of(self, arbor: str) -> tuple[str, ...]:
        """The wheels of an arbor that mesh, as declared."""
        links = self.links_of(arbor)
        return tuple(name for link in links for name in self.train.links[link].wheels if name in self.counts)

    def meshes(self, lost: Collection[str] = ()) -> tuple[tuple[str, str], ...]:
        """Pairs of wheels that mesh, the driving one first, but for those of arbors that are lost."""
        return tuple(
            (mesh.driving, mesh.driven)
            for arbor, mesh in self.driven.items()
            if arbor not in lost and mesh.parent not in lost
        )

    def arbor(self, lost: Collection[str] = (), link: str | None = None) -> Arbor:
        """The tree as a candidate.

        lost   arbors that did not survive, which have no names then
        link   the arbor at which it begins; default the first
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


# The parts of a train that a reconstruction can find, each a tree of arbors on the frame or on one carrier. The
# first part begins at the input, on the frame. Where what bears the arbors changes, another begins: on a carrier at
# the wheels of the frame, or at an arbor of an earlier part, whose speed is then known. So on the frame behind a
# carrier.


def find_spur_trees(train: Train) -> tuple[SpurTree, ...]:
    """All parts of a train that lead to pointers, that from the input first if there is one.

    A pointer is an output whose speed is known (by `expect`, or a target with a tolerance) and that has a target; and
    where no such arbor follows, the last arbor whose speed is known. What leads to no pointer is in no part.

    Raises `QuestionError` where there is none: no single input, no pointer that is reached, meshes that close a loop.
    """
    _check_input(train)
    parts = _Parts(train)
    found = tuple(parts.trees())
    every = [teeth for tree in found for teeth in tree.counts.values()]
    if found:
        # few wheels of a small part would say too much of those that are lost
        return found[0], *(replace(tree, teeth=(min(every), max(every))) for tree in found[1:])
    what = f"no pointer of '{train.name}' is reached by spur wheels on the frame or on a carrier"
    obstacles = _joined(list(_obstacles(train)))
    why = parts.loop or (f"it has {obstacles}" if obstacles else "no output beyond the input has a speed")
    raise QuestionError(Problem(what, why, "only such trees are reconstructed yet"))


def find_spur_tree(train: Train, arbors: Iterable[str] = (), source: str | None = None) -> SpurTree:
    """The part of a train in which some arbors are driven, of several the first.

    source   the arbor at which it begins; default any

    Raises `QuestionError` where there is none, also where they are in different parts.
    """
    trees = find_spur_trees(train)
    if source is not None:
        trees = tuple(tree for tree in trees if tree.source == source)
        if not trees:
            begin = ", ".join(tree.source for tree in find_spur_trees(train))
            fix = f"name one of: {begin}"
            raise QuestionError(Problem(f"no part of '{train.name}' begins at '{source}'", "", fix))
    wanted = list(arbors)
    held = [[tree for tree in trees if tree.arbor_of(link) in tree.driven] for link in wanted]
    both = [tree for tree in trees if all(tree in some for some in held)]
    if both or not all(held):
        return (both or trees)[0]
    said = " and ".join(f"'{link}'" for link in wanted)
    why = f"arbors of this train are borne or driven in {len(trees)} parts, and each is a question of its own"
    raise QuestionError(Problem(f"{said} cannot be left out together", why, "leave out those of one part"))


def _check_input(train: Train) -> None:
    if train.states:
        what = f"'{train.name}' is driven otherwise in each of its states"
        raise QuestionError(Problem(what, "a reconstruction has one input", "ask of a train without states"))
    turning = [link for link, speed in train.case(None).inputs.items() if speed]
    if len(turning) != 1:
        what = f"'{train.name}' has {len(turning)} inputs that turn"
        raise QuestionError(Problem(what, "a reconstruction has one", "ask of a train with one", train.place("inputs")))


@dataclass
class _Base:
    """What turns on the frame or on a carrier."""

    joined: dict[str, tuple[str, ...]] = field(default_factory=dict)
    """Link -> the links that couplings join to it, itself among them, in the order of the train."""
    meshes: dict[str, list[ArborMesh]] = field(default_factory=dict)
    """Arbor -> its meshes."""


class _Parts:
    def __init__(self, train: Train) -> None:
        self.train, self.loop = train, ""
        self._solved = GearTrain(train)
        self._inputs = {link: speed for link, speed in train.case(None).inputs.items() if speed}

    def trees(self) -> Iterator[SpurTree]:
        """Each part once an arbor is known at which it begins."""
        waiting = [(base, arbors) for base in self._bases for arbors in self._connected(base)]
        waiting.sort(key=lambda part: not (part[0] == self.train.frame and part[1] & {*self._inputs}))
        known = dict.fromkeys(self._inputs)
        while waiting:
            parts = ((part, self._begun(*part, tuple(known))) for part in waiting)
            part, begun = next((each for each in parts if each[1] is not None), (None, None))
            if part is None or begun is None:
                return
            waiting.remove(part)
            tree = self._tree(begun)
            if tree is not None:
                known |= dict.fromkeys([begun.name, *(link for one in tree.arbors for link in tree.links_of(one))])
                yield tree

    # what meshes on what

    @cached_property
    def _bases(self) -> dict[str, _Base]:
        found = {link: _Base() for link in self.train.links}
        for each in self._solved.circuits:
            if each.kind == "pin_and_slot" and each.carrier not in (each.i, each.j):
                joined = found[each.carrier].joined
                both = {*joined.get(each.i, (each.i,)), *joined.get(each.j, (each.j,))}
                group = tuple(link for link in self.train.links if link in both)
                joined.update(dict.fromkeys(group, group))
        gears = (each for each in self._solved.circuits if each.kind == "gear")
        for at, each in enumerate(gears):
            if each.carrier not in (each.i, each.j) and are_spur_mates(
                self.train, self._solved.kinematics.tree, each.wheels, each.carrier
            ):
                for own, other in (each.wheels, each.wheels[::-1]):
                    meshes = found[each.carrier].meshes
                    meshes.setdefault(self._arbor(each.carrier, own, found), []).append(ArborMesh(at, own, other))
        return {base: own for base, own in found.items() if own.meshes}

    def _arbor(self, base: str, wheel: str, bases: dict[str, _Base] | None = None) -> str:
        """The arbor of a wheel: the frame for all that stands still, the first one for links that are joined."""
        return self._stands_for(base, self.train.wheels[wheel][0], bases)

    def _stands_for(self, base: str, link: str, bases: dict[str, _Base] | None = None) -> str:
        if link in self.train.fixed:
            return self.train.frame
        return (bases or self._bases)[base].joined.get(link, (link,))[0]

    def _connected(self, base: str) -> Iterator[set[str]]:
        """Arbors that meshes hold together."""
        meshes = self._bases[base].meshes
        mates = ((arbor, *(self._arbor(base, each.other) for each in own)) for arbor, own in meshes.items())
        yield from map(set, joined_groups(meshes, mates))

    # where a part begins

    def _begun(self, base: str, arbors: set[str], known: tuple[str, ...]) -> BaseLink | None:
        """Its base and its first arbor, whose speeds are known; None where no such arbor is."""
        frame, speed = self.train.frame, self._speed(base)
        if speed is None or (not speed and base != frame):
            return None
        first = [frame] if base != frame and frame in arbors else [self._stands_for(base, link) for link in known]
        for source in first:
            turns = self._speed(source)
            if source in arbors and turns is not None and turns != speed:
                return BaseLink(base, speed, source, turns - speed)
        return None

    def _speed(self, link: str) -> Fraction | None:
        """The exact speed of a link, None where there is none."""
        if link == self.train.frame or link in self.train.fixed:
            return Fraction(0)
        if link in self._inputs:
            return self._inputs[link] if self.train.case(None).exact else None
        speed = self._solved.solve().speeds.get(link)
        return speed if isinstance(speed, Fraction) else None

    # the tree

    def _tree(self, begun: BaseLink) -> SpurTree | None:
        base, train = begun.name, self.train
        meshes = self._bases[base].meshes
        try:
            driven = walk_arbors(train, begun.source, meshes, lambda wheel: self._arbor(base, wheel))
        except QuestionError as error:
            self.loop = error.problems[0].what
            return None
        outputs = [(name, self._stands_for(base, link), wanted) for name, link, wanted in self._known_outputs(base)]
        pointers = {name: arbor for name, arbor, wanted in outputs if arbor in driven and wanted}
        named = {arbor: name for name, arbor, _ in reversed(outputs)}
        for arbor in reversed(list(driven)):  # what leads to no pointer is left out; a known speed makes one
            if arbor in pointers.values() or any(mesh.parent == arbor for mesh in driven.values()):
                continue
            if arbor in named:
                pointers[named[arbor]] = arbor
            else:
                del driven[arbor]
        counts = {
            name: train.wheels[name][1].count or 0 for mesh in driven.values() for name in (mesh.driving, mesh.driven)
        }
        joined = {arbor: links for arbor, links in self._bases[base].joined.items() if links[0] == arbor}
        if not pointers:
            return None
        teeth = min(counts.values()), max(counts.values())
        return _renamed(SpurTree(train, begun, driven, joined, pointers, counts, teeth))

    def _known_outputs(self, base: str) -> Iterator[tuple[str, str, bool]]:
        """Outputs whose speed is known, seen from the frame or the base; with the link, and whether it has a target.

        On a carrier also the links that are driven.
        """
        train = self.train
        for name, output in train.case(None).outputs.items():
            known = output.expect is not None or any(target.tolerance is not None for target in output.targets)
            if known and output.relative_to in (None, train.frame, base):
                yield name, output.of or name, bool(output.targets)
        if base != train.frame:
            yield from ((link, link, False) for link in self._inputs if link not in train.case(None).outputs)


def _renamed(tree: SpurTree) -> SpurTree:
    """The same with joined arbors called as in a question: after the first of their links that has wheels there."""
    names = {}
    for arbor, links in tree.joined.items():
        names[arbor] = min(
            links, key=lambda link: not any(name in tree.counts for name in tree.train.links[link].wheels)
        )
    driven = {
        names.get(arbor, arbor): replace(mesh, parent=names.get(mesh.parent, mesh.parent))
        for arbor, mesh in tree.driven.items()
    }
    own = {names.get(arbor, arbor) for arbor in tree.arbors}
    joined = {
        name: (name, *(link for link in tree.joined[arbor] if link != name))
        for arbor, name in names.items()
        if name in own
    }
    base = replace(tree.base, source=names.get(tree.source, tree.source))
    pointers = {pointer: names.get(arbor, arbor) for pointer, arbor in tree.pointers.items()}
    return replace(tree, base=base, driven=driven, joined=joined, pointers=pointers)


# what is in no part


def why_not(train: Train, link: str) -> str:
    """Why a link is in none of the parts."""
    wheels = train.links[link].wheels
    if link == train.frame or link in train.fixed:
        return "it stands still"
    if any(link in lock for lock in train.locks):
        return "it is held to another link"
    followers = [one for one in train.couplings if link == one.slot and one.kind != "pin_and_slot"]
    if followers:
        return "a pin and follower moves it, whose mean ratio is 0"
    kinds = sorted({wheel.kind for wheel in wheels.values() if wheel.kind != "spur"})
    if kinds:
        return f"it has {_joined(kinds)} wheels"
    if not wheels:
        return "it has no wheel"
    mates = {name for gear in train.gears for name in gear.pair if {*gear.pair} & {*wheels}} - {*wheels}
    others = sorted({train.wheels[name][1].kind for name in mates} - {"spur"})
    if others:
        return f"it meshes with {_joined(others)} wheels"
    return "it leads to no pointer of known speed" if mates else "its wheels mesh with none"


def _obstacles(train: Train) -> Iterator[str]:
    """What of a train no part takes up."""
    kinds = {wheel.kind for _, wheel in train.wheels.values()} - {"spur"}
    yield from (f"{kind} wheels" for kind in sorted(kinds))
    if any(one.kind != "pin_and_slot" for one in train.couplings):
        yield "couplings that are no pins in slots"
    if train.locks:
        yield "arbors that are held to others"


def _joined(parts: Sequence[str]) -> str:
    return ", ".join(parts[:-1]) + " and " + parts[-1] if len(parts) > 1 else "".join(parts)


# ------------------------------------------------------------------ evidence of such a part without some of its arbors


def lost_evidence(tree: SpurTree, lost: Sequence[str], seen: bool = False) -> Train:
    """Evidence of a tree of which some arbors are lost.

    What survives are the other arbors with the wheels that mesh in the train, counts as they are used there, and the
    couplings of two of them; every pointer with its speed, on its arbor or on one that does not survive. As many wheels
    may be added as are lost, with as many teeth as any wheel of the part has; of a later part, as any of all parts.

    lost   links; `QuestionError` for the first arbor, and for what is no arbor of the tree, or has a ring
    seen   the meshes of wheels that survive were seen, and no more arbors may be added than are lost; else it is not
           known who meshes with whom
    """
    return declare(lost_evidence_data(tree, lost, seen))


def lost_evidence_data(tree: SpurTree, lost: Sequence[str], seen: bool = False) -> dict[str, Any]:
    """The same with the keys of a declaration."""
    _check(tree, lost)
    train = tree.train
    arbors = lost_arbors(tree, lost)
    given = train.model_dump(mode="json", exclude_unset=True, by_alias=True)
    words = "-".join(lost).replace(" ", "-")
    kept = {key: given[key] for key in _KEPT if given.get(key)}
    if "title" in kept:
        kept["title"] += f", without {', '.join(lost)}"
    surviving = [arbor for arbor in tree.arbors if arbor not in arbors]
    standing = {link for arbor in surviving for link in tree.links_of(arbor)}
    links: dict[str, Any] = {train.frame: {}, **({tree.base.name: {}} if tree.base.is_carrier else {})}
    for link in train.links:
        if link in standing:
            own = train.frame if link in train.fixed else link
            links[own] = {"wheels": {**links.get(own, {}).get("wheels", {}), **_wheels(tree, given, link)}}
    meshes = tree.meshes(arbors) if seen else ()
    return {
        "name": f"{train.name}-without-{words}",
        **kept,
        "frame": train.frame,
        "links": {link: one if one.get("wheels") else {} for link, one in links.items()},
        **({"gears": [{"pair": list(pair)} for pair in meshes]} if meshes else {}),
        "inputs": _inputs(tree, given),
        "outputs": {
            name: {"of": NEW_ARBOR if arbor in arbors else tree.link_of(name)} | _shown(tree, given, name)
            for name, arbor in tree.pointers.items()
        },
        "reconstruct": _requested(tree, arbors, seen),
    }


def lost_arbors(tree: SpurTree, links: Sequence[str]) -> tuple[str, ...]:
    """The arbors of the tree that some links stand for."""
    return tuple(dict.fromkeys(map(tree.arbor_of, links)))


def lost_wheels(tree: SpurTree, lost: Sequence[str]) -> int:
    """How many wheels are lost with some links."""
    return sum(len(tree.wheels_of(arbor)) for arbor in lost_arbors(tree, lost))


def _requested(tree: SpurTree, lost: Sequence[str], seen: bool) -> dict[str, Any]:
    pairs = [[links[0], other] for arbor, links in tree.joined.items() if arbor not in lost for other in links[1:]]
    return {
        **({"carrier": tree.base.name} if tree.base.is_carrier else {}),
        "add": {
            "wheels": lost_wheels(tree, lost),
            "teeth": list(tree.teeth),
            **({"arbors": len(lost)} if seen else {}),
        },
        **({"idlers": True} if tree.has_idlers else {}),
        **({"given": [{"pair": pair} for pair in pairs]} if pairs else {}),
    }


def _inputs(tree: SpurTree, given: dict[str, Any]) -> dict[str, Any]:
    """The speeds of what bears the arbors and of the first of them."""
    base, frame = tree.base, tree.train.frame
    speeds = {base.name: base.speed, base.source: base.driven + base.speed}
    return {link: given["inputs"].get(link, str(speed)) for link, speed in speeds.items() if link != frame}


def _check(tree: SpurTree, lost: Sequence[str]) -> None:
    arbors = [tree.arbor_of(link) for link in lost]
    able = [link for arbor in tree.able if arbor not in arbors for link in tree.links_of(arbor)]
    for link, arbor in zip(lost, arbors, strict=True):
        if arbor == tree.source:
            what, why = f"'{link}' carries the input", "a reconstruction begins there"
        elif arbor not in tree.driven:
            what = f"'{link}' cannot be left out"
            why = why_not(tree.train, link) if link in tree.train.links else "there is no such link"
        elif arbor not in tree.able:
            what, why = f"'{link}' cannot be left out", "it has a ring, and no ring is added"
        elif arbors.count(arbor) > 1:
            what, why = f"'{link}' is left out twice", "an arbor is lost once, with all that is joined to it"
        else:
            continue
        raise QuestionError(Problem(what, why, suggest(link, able)))


def _wheels(tree: SpurTree, given: dict[str, Any], link: str) -> dict[str, Any]:
    """Wheels of a surviving arbor with their counts, and what is told of them."""
    found: dict[str, Any] = {}
    for name in (name for name in tree.train.links[link].wheels if name in tree.counts):
        wheel = given["links"][link]["wheels"][name]
        about = {key: wheel[key] for key in _OF_WHEELS if key in wheel} if isinstance(wheel, dict) else {}
        found[name] = {"teeth": tree.counts[name], **about} if about else tree.counts[name]
    return found


def _shown(tree: SpurTree, given: dict[str, Any], pointer: str) -> dict[str, Any]:
    """How fast a pointer turns: what is expected of it, else its targets that have a tolerance; and seen from what."""
    output = given["outputs"].get(pointer)
    if output is None:
        return {"expect": given["inputs"][pointer]}
    base = tree.train.case(None).outputs[pointer].relative_to
    seen = {} if base in (None, tree.train.frame) else {"relative_to": base}
    if output.get("expect") is not None:
        return seen | {"expect": output["expect"]}
    return seen | {"targets": [target for target in output["targets"] if target.get("tolerance") is not None]}
