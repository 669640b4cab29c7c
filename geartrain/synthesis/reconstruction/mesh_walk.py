"""From the arbor that drives along meshes of spur wheels: how every other arbor is driven."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from geartrain.errors import Problem, QuestionError
from geartrain.kinematics.circuits.joint_tree import Tree, find_tree
from geartrain.numerics.quantity import Figure
from geartrain.train import Train

_ALONG = (0, 0, 1)


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
