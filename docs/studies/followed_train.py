"""Whether the search comes to a given train, which is followed along its own paths.

All trains of a question may be too many to count, and one of them is still told to be among them: lists of paths are
made with the ways alone that the train takes, and paths chosen and put together by the search itself, with all that it
rules out. What it looks for beyond these ways is not looked for, and counts are not counted.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import NamedTuple

from geartrain.synthesis.reconstruction.arbor_passes import ADDED, ArborPass
from geartrain.synthesis.reconstruction.candidate_rules import broken_rules
from geartrain.synthesis.reconstruction.path_choice import PathChoice
from geartrain.synthesis.reconstruction.path_lists import PathList, WayThrough
from geartrain.synthesis.reconstruction.path_trees import PathTrees
from geartrain.synthesis.reconstruction.quotient_keys import QuotientKeys
from geartrain.synthesis.reconstruction.reconstruction_problem import Arbor, PlacedWheel, ReconstructionProblem
from geartrain.synthesis.reconstruction.skeletons import Joint, Limb, Skeleton

Shape = tuple[object, ...]
"""A skeleton in whatever order its parts were found, arbors between two branchings in no order."""


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
    keys = QuotientKeys(problem.additions.least, problem.additions.greatest)
    dials = sorted(problem.dials, key=lambda dial: dial.name)
    lists = {dial.name: PathList(dial, problem, keys, own[dial.name].ways) for dial in dials}
    shape, trees = _shape(_joint_of(candidate)), PathTrees(problem, lists)
    return any(
        _shape(skeleton.root) == shape and _holds(skeleton, own)
        for chosen in PathChoice(problem, lists, keys).choices(added)
        for skeleton in trees.skeletons(chosen, added)
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


def _holds(skeleton: Skeleton, own: dict[str, _TrainPath]) -> bool:
    """Whether the counts of the train are among those that are wanted."""
    return all(least <= own[dial].quotient <= greatest for dial, (least, greatest) in skeleton.wanted)


# trains as skeletons, and when two are the same


def _joint_of(arbor: Arbor) -> Joint:
    """An arbor at which paths end or part, with all below it."""
    drives = tuple((_open(wheel) or ADDED, tuple(map(_limb_of, below))) for wheel, below in arbor.drives)
    return Joint(arbor.name, _open(arbor.driven), arbor.dials, drives, tuple(map(_limb_of, arbor.passes)))


def _limb_of(arbor: Arbor) -> Limb:
    """Arbors from one on, to where they end."""
    through: list[tuple[str, ArborPass]] = []
    compounds = idlers = 0
    while True:
        ways = [*arbor.drives, *([(arbor.driven, arbor.passes)] if arbor.passes else [])]
        if arbor.dials or len(ways) != 1:
            return Limb((), tuple(through), compounds, idlers, _joint_of(arbor))
        ((driver, below),) = ways
        idler = bool(arbor.passes)
        if arbor.name is not None:
            through.append((arbor.name, ArborPass(_open(arbor.driven), _open(driver), 0, idler)))
        else:
            compounds, idlers = compounds + (not idler), idlers + idler
        if len(below) > 1:
            return Limb((), tuple(through), compounds, idlers, tuple(map(_limb_of, below)))
        (arbor,) = below


def _shape(joint: Joint) -> Shape:
    drives = tuple(sorted((_wheel(wheel), tuple(sorted(map(_limb_shape, limbs)))) for wheel, limbs in joint.drives))
    passes = tuple(sorted(map(_limb_shape, joint.passes)))
    return joint.name or "", _wheel(joint.driven), tuple(sorted(joint.here)), drives, passes


def _limb_shape(limb: Limb) -> Shape:
    through = sorted((name, _wheel(each.driven), _wheel(each.driver), each.idler) for name, each in limb.through)
    joint = (_shape(limb.end),) if isinstance(limb.end, Joint) else ()
    forks = () if isinstance(limb.end, Joint) else tuple(sorted(map(_limb_shape, limb.end)))
    return tuple(through), limb.compounds, limb.idlers, joint, forks


def _wheel(wheel: PlacedWheel | None) -> tuple[str, int]:
    return ("", -1) if wheel is None else (wheel.name or "", wheel.teeth)
