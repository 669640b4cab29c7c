"""Whether the search comes to a given train, which is followed along its own paths.

All trains of a question may be too many to count, and one of them is still told to be among them: lists of paths are
made with the ways alone that the train takes, and paths chosen and put together by the search itself, with all that it
rules out. What it looks for beyond these ways is not looked for, and counts are not counted.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import NamedTuple

from geartrain.search.reconstruct import Arbor, PlacedWheel, ReconstructionProblem
from geartrain.search.reconstruct.added_counts import QuotientTables
from geartrain.search.reconstruct.candidate_rules import broken_rules
from geartrain.search.reconstruct.path_lists import PathList, WayThrough
from geartrain.search.reconstruct.path_trees import PathTrees
from geartrain.search.reconstruct.search_tasks import PathChoice
from geartrain.search.reconstruct.train_topology import ADDED, ArborPass, Branching, Chain, Topology

Shape = tuple[object, ...]
"""A topology in whatever order its parts were found, arbors between two branchings in no order."""


def is_reached(candidate: Arbor, problem: ReconstructionProblem) -> bool:
    """Whether a candidate is among the trains that lists of paths give.

    Parameters
    ----------
    candidate : Arbor
        From its input on, in the names of the question.
    problem : ReconstructionProblem
    """
    added = candidate.added_wheels
    if added > problem.additions.wheels or broken_rules(candidate, problem):
        return False
    own = {path.dial: path for path in _paths(candidate, (), Fraction(1))}
    tables = QuotientTables(problem.additions.minimum, problem.additions.maximum)
    dials = sorted(problem.dials, key=lambda dial: dial.name)
    lists = {dial.name: PathList(dial, problem, tables, own[dial.name].ways) for dial in dials}
    shape, trees = _shape(_branching_of(candidate)), PathTrees(problem, lists)
    return any(
        _shape(topology.root) == shape and _holds(topology, own)
        for chosen in PathChoice(problem, lists, tables).choices(added)
        for topology in trees.topologies(chosen, added)
    )


# the paths of a train


class _TrainPath(NamedTuple):
    """A path to a dial: by surviving arbor the way through it, and the quotient of the added wheels on it."""

    dial: str
    ways: dict[str, WayThrough]
    quotient: Fraction


def _paths(arbor: Arbor, before: tuple[tuple[str, WayThrough], ...], quotient: Fraction) -> Iterator[_TrainPath]:
    """The paths to all dials from an arbor on.

    quotient   of the added wheels on the way to it, its driven one included
    """

    def with_way(driver: PlacedWheel | None) -> tuple[tuple[str, WayThrough], ...]:
        way = (_open(arbor.driven), driver if driver is None else _open(driver))
        return before if arbor.name is None else (*before, (arbor.name, way))

    for dial in arbor.dials:
        yield _TrainPath(dial, dict(with_way(None)), quotient)
    for wheel, child in arbor.driven_arbors():
        assert child.driven is not None
        yield from _paths(child, with_way(wheel), quotient * _added(wheel) / _added(child.driven))


def _open(wheel: PlacedWheel | None) -> PlacedWheel | None:
    """A wheel without its count, where it is added."""
    return ADDED if wheel is not None and wheel.name is None else wheel


def _added(wheel: PlacedWheel) -> int:
    return wheel.teeth if wheel.name is None else 1


def _holds(topology: Topology, own: dict[str, _TrainPath]) -> bool:
    """Whether the counts of the train are among those that are wanted."""
    return all(minimum <= own[dial].quotient <= maximum for dial, (minimum, maximum) in topology.wanted)


# trains as topologies, and when two are the same


def _branching_of(arbor: Arbor) -> Branching:
    """An arbor at which paths end or part, with all below it."""
    drives = tuple((_open(wheel) or ADDED, tuple(map(_chain_of, below))) for wheel, below in arbor.drives)
    return Branching(arbor.name, _open(arbor.driven), arbor.dials, drives, tuple(map(_chain_of, arbor.passes)))


def _chain_of(arbor: Arbor) -> Chain:
    """Arbors from one on, to where they end."""
    through: list[tuple[str, ArborPass]] = []
    compounds = idlers = 0
    while True:
        ways = [*arbor.drives, *([(arbor.driven, arbor.passes)] if arbor.passes else [])]
        if arbor.dials or len(ways) != 1:
            return Chain((), tuple(through), compounds, idlers, _branching_of(arbor))
        ((driver, below),) = ways
        idler = bool(arbor.passes)
        if arbor.name is not None:
            through.append((arbor.name, ArborPass(_open(arbor.driven), _open(driver), 0, idler)))
        else:
            compounds, idlers = compounds + (not idler), idlers + idler
        if len(below) > 1:
            return Chain((), tuple(through), compounds, idlers, tuple(map(_chain_of, below)))
        (arbor,) = below


def _shape(branching: Branching) -> Shape:
    drives = tuple(
        sorted((_wheel(wheel), tuple(sorted(map(_chain_shape, chains)))) for wheel, chains in branching.drives)
    )
    passes = tuple(sorted(map(_chain_shape, branching.passes)))
    return branching.name or "", _wheel(branching.driven), tuple(sorted(branching.here)), drives, passes


def _chain_shape(chain: Chain) -> Shape:
    through = sorted((name, _wheel(each.driven), _wheel(each.driver), each.idler) for name, each in chain.through)
    branching = (_shape(chain.end),) if isinstance(chain.end, Branching) else ()
    forks = () if isinstance(chain.end, Branching) else tuple(sorted(map(_chain_shape, chain.end)))
    return tuple(through), chain.compounds, chain.idlers, branching, forks


def _wheel(wheel: PlacedWheel | None) -> tuple[str, int]:
    return ("", -1) if wheel is None else (wheel.name or "", wheel.teeth)
