"""Parts of a train that a reconstruction can find. Each part is a tree of arbors on the frame or on one carrier.

The arbors are connected by spur wheels and rings. Links that are joined by a pin and a slot form one arbor. If some
arbors of a part are treated as lost, the remaining arbors are evidence for which the correct train is known. The
reconstruction then shows to what extent such evidence determines the train.
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
from geartrain.search.reconstruct.link_roles import BaseLink, Joined
from geartrain.search.reconstruct.reconstruction_problem import Arbor, PlacedWheel
from geartrain.train import Train, declare
from geartrain.train.reconstruction import NEW_ARBOR

# Driving mesh of every arbor, along meshes of spur wheels from the input.


_Z_AXIS = (0, 0, 1)  # default direction of an axis
_KEPT_KEYS = ("title", "sources", "unit", "view")
_WHEEL_KEYS = ("internal", "status", "source", "note")


@dataclass(frozen=True)
class DrivenArbor:
    """Mesh that drives an arbor: parent arbor, driving wheel and driven wheel."""

    parent: str
    driving: str
    driven: str


class ArborMesh(NamedTuple):
    """Mesh as seen from one arbor: number of the gear pair, wheel on this arbor, and mating wheel."""

    gear: int
    own: str
    other: str


def walk_arbors(
    train: Train, source: str, meshes: Mapping[str, Sequence[ArborMesh]], arbor_of: Callable[[str], str]
) -> dict[str, DrivenArbor]:
    """Return the mesh that drives each arbor, keyed by arbor, for all arbors reached from the arbor `source` by
    breadth-first search.

    meshes    meshes of each arbor
    arbor_of  function that returns the arbor that carries a wheel

    `QuestionError` is raised if meshes close a loop.
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
                why = "two wheels drive the same arbor, and only trees of arbors are reconstructed"
                place = train.place("gears", gear)
                raise QuestionError(Problem(what, why, "remove a mesh of the loop", place))
            driven[child] = DrivenArbor(arbor, own, other)
            waiting.append(child)
    return driven


def walk_meshes(
    train: Train, source: str, arbors: Mapping[str, str], rings: Collection[str] = ()
) -> dict[str, DrivenArbor]:
    """Return the mesh that drives each arbor on the frame, keyed by arbor, for all arbors reached from the arbor
    `source` by breadth-first search.

    arbors  arbor to which each link belongs
    rings   wheels that may have internal teeth
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
    """Return whether two wheels are spur wheels or rings that turn about parallel axes carried by the link `carrier`.

    carrier   the frame or a carrier; if it is a carrier, one of the wheels may be fixed to the frame
    """
    still = {train.frame, *train.fixed}
    directions = set()
    for name in pair:
        link, wheel = train.wheels[name]
        is_still = link in still
        if wheel.kind != "spur" or any(link in lock for lock in train.locks) or (is_still and carrier in still):
            return False
        axis = train.axes.get(tree.axis(carrier if is_still else link) or "")
        directions.add(_Z_AXIS if axis is None else tuple(figure.value for figure in axis.direction))
    return len(directions) == 1


@dataclass(frozen=True)
class SpurTree:
    """Tree of arbors that a reconstruction can find in a train, on the frame or on one carrier, from its first arbor to
    the arbors that carry pointers. Such a tree is called a part of the train.
    """

    train: Train
    base: BaseLink
    """Base of the part: the link that carries the arbors, and the speed of the first arbor."""
    driven: Mapping[str, DrivenArbor]
    """Mesh that drives each arbor, keyed by arbor in topological order."""
    joined: Joined
    """Links that form each arbor, keyed by arbor; the link with the name of the arbor comes first. Arbors with a single
    link are omitted.
    """
    pointers: Mapping[str, str]
    """Arbor that carries the pointer of each output, keyed by output. A link without output is included under its own
    name if it serves as a pointer because its speed is known.
    """
    counts: Mapping[str, int]
    """Tooth count of each meshing wheel, keyed by wheel."""
    teeth: tuple[int, int]
    """Minimum and maximum tooth count of an added wheel."""

    @property
    def source(self) -> str:
        """Name of the first arbor of the part. It drives all other arbors."""
        return self.base.source

    @property
    def arbors(self) -> tuple[str, ...]:
        """Names of all arbors, beginning with the first arbor of the part."""
        return self.source, *self.driven

    @cached_property
    def able(self) -> tuple[str, ...]:
        """Names of the arbors that can be treated as lost: all driven arbors that carry no ring, because rings are
        never added.
        """
        wheels = self.train.wheels
        return tuple(link for link in self.driven if not any(wheels[name][1].internal for name in self.wheels_of(link)))

    @property
    def name(self) -> str:
        """Label of the part of the train; empty for the part on the frame that begins at the input."""
        if self.base.is_carrier:
            return f"on {self.base.name}, from {self.source}"
        return "" if self.source in self.train.case(None).inputs else f"from {self.source}"

    def links_of(self, arbor: str) -> tuple[str, ...]:
        """Return the links that form an arbor. All fixed links belong to the frame."""
        if arbor == self.train.frame:
            return arbor, *self.train.fixed
        return self.joined.get(arbor, (arbor,))

    def arbor_of(self, link: str) -> str:
        """Return the name of the arbor to which a link belongs. It is the name of the link itself unless couplings join
        the link to other links.
        """
        return next((arbor for arbor, links in self.joined.items() if link in links), link)

    def link_of(self, pointer: str) -> str:
        """Return the link whose speed is indicated by a pointer."""
        output = self.train.case(None).outputs.get(pointer)
        return pointer if output is None else output.of or pointer

    def wheels_of(self, arbor: str) -> tuple[str, ...]:
        """Return the meshing wheels on an arbor in the order of declaration."""
        links = self.links_of(arbor)
        return tuple(name for link in links for name in self.train.links[link].wheels if name in self.counts)

    def meshes(self, lost: Collection[str] = ()) -> tuple[tuple[str, str], ...]:
        """Return the meshes as pairs (driving wheel, driven wheel). Meshes of the arbors in `lost` are omitted."""
        return tuple(
            (mesh.driving, mesh.driven)
            for arbor, mesh in self.driven.items()
            if arbor not in lost and mesh.parent not in lost
        )

    def arbor(self, lost: Collection[str] = ()) -> Arbor:
        """Return the tree as a candidate. The arbors in `lost` do not survive, so they have no names in the
        candidate.
        """
        owner = {wheel: arbor for arbor in self.arbors for wheel in self.wheels_of(arbor)}

        def placed(wheel: str) -> PlacedWheel:
            return PlacedWheel(None if owner[wheel] in lost else wheel, self.counts[wheel])

        names = {arbor: None if arbor in lost else arbor for arbor in self.arbors}
        return candidate_arbor(self.source, self.driven, names, self.pointers, placed)


def candidate_arbor(
    link: str,
    driven: Mapping[str, DrivenArbor],
    names: Mapping[str, str | None],
    pointers: Mapping[str, str],
    placed: Callable[[str], PlacedWheel],
) -> Arbor:
    """Return the candidate that consists of an arbor of a train and of all arbors that it drives.

    driven    mesh that drives each arbor
    names     name of each surviving arbor in the candidate; None or no entry for an added arbor
    pointers  arbor of each dial
    placed    function that converts a wheel of the train to a wheel of the candidate
    """
    own = driven[link].driven if link in driven else None
    below: dict[str, list[Arbor]] = {}
    for child, mesh in driven.items():
        if mesh.parent == link:
            below.setdefault(mesh.driving, []).append(candidate_arbor(child, driven, names, pointers, placed))
    return Arbor(
        names.get(link),
        None if own is None else placed(own),
        tuple(sorted(name for name, at in pointers.items() if at == link)),
        tuple((placed(wheel), tuple(children)) for wheel, children in below.items() if wheel != own),
        () if own is None else tuple(below.get(own, ())),
    )


# Parts of a train that a reconstruction can find, each a tree of arbors on the frame or on one carrier. The first part
# begins at the input, on the frame. Another part begins where the link that carries the arbors changes: on a carrier at
# the wheels of the frame, or at an arbor of an earlier part, whose speed is then known. The same applies on the frame
# behind a carrier.


def find_spur_trees(train: Train) -> tuple[SpurTree, ...]:
    """Return all parts of a train that lead to pointers, beginning with the part that starts at the input.

    A pointer is an output with a target, if its speed is known from `expect` or from a target with a tolerance. An
    arbor of known speed that leads to no pointer is also treated as a pointer. Arbors that lead to no pointer belong to
    no part.

    Parameters
    ----------
    train : Train
        Complete train with one input and without states.

    Returns
    -------
    tuple of SpurTree

    Raises
    ------
    QuestionError
        If the train does not have exactly one input, if no pointer is reached, or if meshes close a loop.

    Examples
    --------
    >>> import geartrain
    >>> [tree.able for tree in find_spur_trees(geartrain.load("longcase-clock").declaration)]
    [('great', 'third', 'minute', 'escape', 'hour')]
    """
    _check_input(train)
    parts = _Parts(train)
    found = tuple(parts.trees())
    every = [teeth for tree in found for teeth in tree.counts.values()]
    if found:
        # the range of the few wheels of a small part would restrict the lost counts too much
        return found[0], *(replace(tree, teeth=(min(every), max(every))) for tree in found[1:])
    what = f"'{train.name}' has no pointer with a known speed that spur wheels on the frame or on a carrier drive"
    kinds = {wheel.kind for _, wheel in train.wheels.values()} - {"spur"}
    unsupported = [f"{kind} wheels" for kind in sorted(kinds)]
    if any(one.kind != "pin_and_slot" for one in train.pin_couplings):
        unsupported.append("couplings other than pin and slot")
    if train.locks:
        unsupported.append("locked arbors")
    obstacles = _joined(unsupported)
    why = parts.loop or (f"it has {obstacles}" if obstacles else "no output except the input has a known speed")
    fix = "give `expect` to an output that spur wheels drive on the frame or on a carrier"
    raise QuestionError(Problem(what, why, fix))


def find_spur_tree(train: Train, arbors: Iterable[str] = (), source: str | None = None) -> SpurTree:
    """Return the first part of a train in which all given arbors are driven.

    Parameters
    ----------
    train : Train
        Complete train with one input and without states.
    arbors : iterable of str
        Names of links whose arbors must be driven in the part.
    source : str, optional
        Arbor at which the part begins; by default it may begin at any arbor.

    Returns
    -------
    SpurTree

    Raises
    ------
    QuestionError
        If no part has all of these arbors, or if the train has no part; see `find_spur_trees`.

    Examples
    --------
    >>> import geartrain
    >>> find_spur_tree(geartrain.load("freeth-2008").declaration, ["k1"]).source
    'e_pipe'
    """
    trees = find_spur_trees(train)
    if source is not None:
        trees = tuple(tree for tree in trees if tree.source == source)
        if not trees:
            begin = ", ".join(tree.source for tree in find_spur_trees(train))
            fix = f"give one of these arbors: {begin}"
            why = "a part begins at the input, or at an arbor of known speed"
            raise QuestionError(Problem(f"no part of '{train.name}' begins at '{source}'", why, fix))
    wanted = list(arbors)
    held = [[tree for tree in trees if tree.arbor_of(link) in tree.driven] for link in wanted]
    both = [tree for tree in trees if all(tree in some for some in held)]
    if both or not all(held):
        return (both or trees)[0]
    said = " and ".join(f"'{link}'" for link in wanted)
    why = f"the train has {len(trees)} parts, and each is reconstructed separately"
    raise QuestionError(Problem(f"{said} belong to different parts", why, "name only arbors of the same part"))


def _check_input(train: Train) -> None:
    if train.states:
        what = f"'{train.name}' has several states"
        raise QuestionError(Problem(what, "a reconstruction supports only one state", "use a train without `states`"))
    turning = [link for link, speed in train.case(None).inputs.items() if speed]
    if len(turning) != 1:
        what = f"'{train.name}' has {len(turning)} inputs that turn"
        why = "a reconstruction supports only one input"
        raise QuestionError(Problem(what, why, "use a train with one input", train.place("inputs")))


@dataclass
class _Base:
    """Arbors that turn on the frame or on one carrier: groups of links that form one arbor, and meshes of the
    arbors.
    """

    joined: dict[str, tuple[str, ...]] = field(default_factory=dict)
    """Group of links that couplings connect to each link, keyed by link. The group includes this link and is in the
    order of declaration.
    """
    meshes: dict[str, list[ArborMesh]] = field(default_factory=dict)
    """Meshes of each arbor with other arbors on the same base."""


class _Parts:
    """Search for the parts of a train, which are trees of arbors. A part whose meshes close a loop is excluded; `loop`
    describes the last such loop.
    """

    def __init__(self, train: Train) -> None:
        self.train, self.loop = train, ""
        self._solved = GearTrain(train)
        self._inputs = {link: speed for link, speed in train.case(None).inputs.items() if speed}

    def trees(self) -> Iterator[SpurTree]:
        """Yield the parts of the train. If the speed of the first arbor of a part follows from another part, the other
        part comes first.
        """
        waiting = [(name, arbors) for name, base in self._bases.items() for arbors in self._connected(base)]
        # the part at the input begins; it determines the speeds at which others begin
        waiting.sort(key=lambda part: not (part[0] == self.train.frame and part[1] & {*self._inputs}))
        known = dict.fromkeys(self._inputs)
        while waiting:
            parts = ((part, self._start_of(*part, tuple(known))) for part in waiting)
            part, start = next((each for each in parts if each[1] is not None), (None, None))
            if part is None or start is None:
                return
            waiting.remove(part)
            tree = self._tree(start)
            if tree is not None:
                known |= dict.fromkeys([start.name, *(link for one in tree.arbors for link in tree.links_of(one))])
                yield tree

    # meshes on each base

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
                base = found[each.carrier]
                for own, other in (each.wheels, each.wheels[::-1]):
                    base.meshes.setdefault(self._arbor_of_wheel(base, own), []).append(ArborMesh(at, own, other))
        return {name: base for name, base in found.items() if base.meshes}

    def _arbor(self, base: _Base, link: str) -> str:
        """Return the arbor of a link on a base. The arbor of a fixed link is the frame. If couplings join several
        links, their arbor has the name of the first of these links.
        """
        return self.train.frame if link in self.train.fixed else base.joined.get(link, (link,))[0]

    def _arbor_of_wheel(self, base: _Base, wheel: str) -> str:
        return self._arbor(base, self.train.wheels[wheel][0])

    def _connected(self, base: _Base) -> Iterator[set[str]]:
        """Yield the arbors of each connected component that the meshes on a base form."""
        mates = (
            (arbor, *(self._arbor_of_wheel(base, each.other) for each in own)) for arbor, own in base.meshes.items()
        )
        yield from map(set, joined_groups(base.meshes, mates))

    # first arbor of a part

    def _start_of(self, base: str, arbors: set[str], known: tuple[str, ...]) -> BaseLink | None:
        """Return the base of a part and its first arbor, which has a known speed; None if no arbor of the part has a
        known speed.
        """
        frame, speed = self.train.frame, self._speed(base)
        if speed is None or (not speed and base != frame):
            return None
        first = (
            [frame] if base != frame and frame in arbors else [self._arbor(self._bases[base], link) for link in known]
        )
        for source in first:
            turns = self._speed(source)
            if source in arbors and turns is not None and turns != speed:
                return BaseLink(base, speed, source, turns - speed)
        return None

    def _speed(self, link: str) -> Fraction | None:
        """Return the exact speed of a link [turns per unit of time]; None if the speed is not determined."""
        if link == self.train.frame or link in self.train.fixed:
            return Fraction(0)
        if link in self._inputs:
            return self._inputs[link] if self.train.case(None).exact else None
        speed = self._solved.solve().speeds.get(link)
        return speed if isinstance(speed, Fraction) else None

    # the tree

    def _tree(self, start: BaseLink) -> SpurTree | None:
        base, train = self._bases[start.name], self.train
        try:
            driven = walk_arbors(train, start.source, base.meshes, lambda wheel: self._arbor_of_wheel(base, wheel))
        except QuestionError as error:
            self.loop = error.problems[0].what
            return None
        outputs = [(name, self._arbor(base, link), wanted) for name, link, wanted in self._known_outputs(start.name)]
        pointers = {name: arbor for name, arbor, wanted in outputs if arbor in driven and wanted}
        # reversed: the first output of an arbor names it
        named = {arbor: name for name, arbor, _ in reversed(outputs)}
        # arbors without a pointer below are dropped; a known speed makes a pointer
        for arbor in reversed(list(driven)):
            if arbor in pointers.values() or any(mesh.parent == arbor for mesh in driven.values()):
                continue
            if arbor in named:
                pointers[named[arbor]] = arbor
            else:
                del driven[arbor]
        if not pointers:
            return None
        counts = {
            name: train.wheels[name][1].count or 0 for mesh in driven.values() for name in (mesh.driving, mesh.driven)
        }
        joined = {arbor: links for arbor, links in base.joined.items() if links[0] == arbor}
        teeth = min(counts.values()), max(counts.values())
        return _renamed(SpurTree(train, start, driven, joined, pointers, counts, teeth))

    def _known_outputs(self, base: str) -> Iterator[tuple[str, str, bool]]:
        """Yield, for each output whose speed relative to the frame or the base is declared: its name, its link, and
        whether it has a target. If the base is a carrier, the inputs of the train are also treated as outputs.
        """
        train = self.train
        for name, output in train.case(None).outputs.items():
            known = output.expect is not None or any(target.tolerance is not None for target in output.targets)
            if known and output.relative_to in (None, train.frame, base):
                yield name, output.of or name, bool(output.targets)
        if base != train.frame:
            yield from ((link, link, False) for link in self._inputs if link not in train.case(None).outputs)


def _renamed(tree: SpurTree) -> SpurTree:
    """Return the tree with joined arbors named as in a reconstruction problem, that is, after their first link with
    meshing wheels.
    """
    names = {
        arbor: min(links, key=lambda link: not any(name in tree.counts for name in tree.train.links[link].wheels))
        for arbor, links in tree.joined.items()
    }
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


# links that belong to no part


def why_not(train: Train, link: str) -> str:
    """Return the reason why a link belongs to none of the parts of a train that a reconstruction can find."""
    wheels = train.links[link].wheels
    if link == train.frame or link in train.fixed:
        return "the link does not turn"
    if any(link in lock for lock in train.locks):
        return "the link is locked to another link"
    followers = [one for one in train.pin_couplings if link == one.slot and one.kind != "pin_and_slot"]
    if followers:
        return "a pin and follower, whose mean ratio is 0, move the link"
    kinds = sorted({wheel.kind for wheel in wheels.values() if wheel.kind != "spur"})
    if kinds:
        return f"the link has {_joined(kinds)} wheels"
    if not wheels:
        return "the link has no wheel"
    mates = {name for gear in train.gears for name in gear.pair if {*gear.pair} & {*wheels}} - {*wheels}
    others = sorted({train.wheels[name][1].kind for name in mates} - {"spur"})
    if others:
        return f"the link meshes with {_joined(others)} wheels"
    return "the link leads to no pointer of known speed" if mates else "the wheels of the link mesh with no other wheel"


def _joined(parts: Sequence[str]) -> str:
    return ", ".join(parts[:-1]) + " and " + parts[-1] if len(parts) > 1 else "".join(parts)


# ------------------------------------------------------------------------ evidence of a part without some of its arbors


def lost_evidence(tree: SpurTree, lost: Sequence[str], seen: bool = False) -> Train:
    """Return the evidence that remains of a tree after the loss of some arbors.

    The other arbors survive with their meshing wheels, whose tooth counts are certain, and with the couplings between
    them. The speed of every pointer is known, and its arbor is known unless it is lost. As many wheels may be added as
    are lost. Their tooth counts must be within the range of tooth counts in the first part or, for a later part, in all
    parts.

    Parameters
    ----------
    tree : SpurTree
        Part of a train.
    lost : sequence of str
        Names of lost links.
    seen : bool
        True if the meshes of surviving wheels are known and no more arbors may be added than are lost; False if the
        meshes are unknown.

    Returns
    -------
    Train

    Raises
    ------
    QuestionError
        If the lost links include the first arbor, a link that is not in the tree, or an arbor with a ring.

    Examples
    --------
    >>> import geartrain
    >>> tree = find_spur_tree(geartrain.load("longcase-clock").declaration)
    >>> lost_evidence(tree, ["great"]).reconstruct.add.wheels
    1
    """
    _check(tree, lost)
    train = tree.train
    arbors = lost_arbors(tree, lost)
    given = train.model_dump(mode="json", exclude_unset=True, by_alias=True)
    words = "-".join(lost).replace(" ", "-")
    kept = {key: given[key] for key in _KEPT_KEYS if given.get(key)}
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
    base = tree.base
    speeds = {base.name: base.speed, base.source: base.driven + base.speed}
    data = {
        "name": f"{train.name}-without-{words}",
        **kept,
        "frame": train.frame,
        "links": {link: one if one.get("wheels") else {} for link, one in links.items()},
        **({"gears": [{"pair": list(pair)} for pair in meshes]} if meshes else {}),
        "inputs": {
            link: given["inputs"].get(link, str(speed)) for link, speed in speeds.items() if link != train.frame
        },
        "outputs": {
            name: {"of": NEW_ARBOR if arbor in arbors else tree.link_of(name)} | _shown(tree, given, name)
            for name, arbor in tree.pointers.items()
        },
        "reconstruct": _requested(tree, arbors, seen),
    }
    return declare(data)


def lost_arbors(tree: SpurTree, links: Sequence[str]) -> tuple[str, ...]:
    """Return the arbors of the tree to which the given links belong, without duplicates."""
    return tuple(dict.fromkeys(map(tree.arbor_of, links)))


def lost_wheels(tree: SpurTree, lost: Sequence[str]) -> int:
    """Return the number of meshing wheels that are lost with the given links."""
    return sum(len(tree.wheels_of(arbor)) for arbor in lost_arbors(tree, lost))


def _requested(tree: SpurTree, lost: Sequence[str], seen: bool) -> dict[str, Any]:
    has_idlers = {mesh.driving for mesh in tree.driven.values()} & {mesh.driven for mesh in tree.driven.values()}
    pairs = [[links[0], other] for arbor, links in tree.joined.items() if arbor not in lost for other in links[1:]]
    return {
        **({"carrier": tree.base.name} if tree.base.is_carrier else {}),
        "add": {
            "wheels": lost_wheels(tree, lost),
            "teeth": list(tree.teeth),
            **({"arbors": len(lost)} if seen else {}),
        },
        **({"idlers": True} if has_idlers else {}),
        **({"given": [{"pair": pair} for pair in pairs]} if pairs else {}),
    }


def _check(tree: SpurTree, lost: Sequence[str]) -> None:
    arbors = [tree.arbor_of(link) for link in lost]
    able = [link for arbor in tree.able if arbor not in arbors for link in tree.links_of(arbor)]
    for link, arbor in zip(lost, arbors, strict=True):
        what = f"'{link}' cannot be lost"
        if arbor == tree.source:
            why = "it carries the input, and a reconstruction begins at the input"
        elif arbor not in tree.driven:
            why = why_not(tree.train, link) if link in tree.train.links else "the train has no such link"
        elif arbor not in tree.able:
            why = "the arbor has a ring, and rings are never added"
        elif arbors.count(arbor) > 1:
            what = f"'{link}' is lost twice"
            why = "an arbor is lost together with all links that are connected to it, so it is given only once"
        else:
            continue
        raise QuestionError(Problem(what, why, suggest(link, able)))


def _wheels(tree: SpurTree, given: dict[str, Any], link: str) -> dict[str, Any]:
    """Return the meshing wheels on a surviving link as plain data, each with its tooth count, kind, status and
    source.
    """
    found: dict[str, Any] = {}
    for name in (name for name in tree.train.links[link].wheels if name in tree.counts):
        wheel = given["links"][link]["wheels"][name]
        about = {key: wheel[key] for key in _WHEEL_KEYS if key in wheel} if isinstance(wheel, dict) else {}
        found[name] = {"teeth": tree.counts[name], **about} if about else tree.counts[name]
    return found


def _shown(tree: SpurTree, given: dict[str, Any], pointer: str) -> dict[str, Any]:
    """Return the speed of a pointer as plain data: its `expect` or, if it has none, its targets with a tolerance."""
    output = given["outputs"].get(pointer)
    if output is None:
        return {"expect": given["inputs"][pointer]}
    base = tree.train.case(None).outputs[pointer].relative_to
    seen = {} if base in (None, tree.train.frame) else {"relative_to": base}
    if output.get("expect") is not None:
        return seen | {"expect": output["expect"]}
    return seen | {"targets": [target for target in output["targets"] if target.get("tolerance") is not None]}
