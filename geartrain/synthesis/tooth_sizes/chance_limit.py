"""The best design under a limit that costs too much to be asked of every one, such as a chance from trials."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.global_minimum import Point, distance
from geartrain.synthesis.tooth_sizes.size_design import ToothSizes
from geartrain.synthesis.tooth_sizes.size_search import SizeSearch

_ASKED = 30  # designs that a costly limit refuses before it is given up
_NEAR = 0.02  # of a range: designs this near to a refused one are not asked
_HALVINGS = 5  # between the best design that is let in and one that is not


@dataclass(frozen=True)
class ChanceLimit:
    """A limit that costs too much to be asked of every design: the chance that a pair cut with errors stops.

    Attributes
    ----------
    bound : float
        The greatest chance that is let in, 0 to 1.
    chance : callable
        The chance of a design, such as of `geartrain.uncertainty.PairTrials`.

    See Also
    --------
    find_tooth_sizes : asks it of few designs, the best first.
    """

    bound: float
    chance: Callable[[ToothSizes], float]


def best_within(search: SizeSearch, aim: str, limit: ChanceLimit) -> tuple[ToothSizes, float]:
    """The best design whose chance is let in, and that chance: asked of the best first, none near a refused one."""
    known = sorted((at for at, each in search.designs.items() if search.keeps(each)), key=search.value(aim))
    refused: list[Point] = []
    for at in known:
        if len(refused) == _ASKED:
            break
        if any(distance(at, other, search.bounds) < _NEAR for other in refused):
            continue
        if (chance := limit.chance(search.design(at))) <= limit.bound:
            return _narrowed(search, aim, limit, at, chance, refused)
        refused.append(at)
    what = f"of {len(refused)} designs none stops with a chance of {limit.bound:g} or less"
    raise QuestionError(Problem(what, "the errors are too great for such teeth", "allow more, or cut better"))


def _narrowed(
    search: SizeSearch, aim: str, limit: ChanceLimit, at: Point, chance: float, refused: Sequence[Point]
) -> tuple[ToothSizes, float]:
    """The limit itself, between what is let in and the refused design nearest to it: by halving."""
    if not refused:
        return search.design(at), chance
    value = search.value(aim)
    beyond = min(refused, key=lambda other: distance(at, other, search.bounds))
    for _ in range(_HALVINGS):
        middle = tuple((a + b) / 2 for a, b in zip(at, beyond, strict=True))
        better = value(middle) < value(at) and (found := limit.chance(search.design(middle))) <= limit.bound
        at, beyond, chance = (middle, beyond, found) if better else (at, middle, chance)
    return search.design(at), chance
