"""One half angle for the pairs that share wheels: a wheel is cut with one, whatever it meshes with."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from math import inf

from scipy.optimize import minimize_scalar

from geartrain.errors import QuestionError
from geartrain.numerics.graphs import DisjointSets
from geartrain.synthesis.tooth_sizes.size_design import SizeLimit, ToothSizes, keeps
from geartrain.synthesis.tooth_sizes.size_search import Range

_SCAN = 7  # half angles that are tried first
_TRIES, _NEAR = 8, 1e-3  # of Brent's method between the neighbours of the best of them; its tolerance (rad)


def pairs_by_shared_wheels(wheels: Mapping[str, tuple[str, ...]]) -> tuple[tuple[str, ...], ...]:
    """The pairs of a train in groups that are connected by common wheels.

    wheels   of each pair, by its name

    >>> pairs_by_shared_wheels({"ab": ("a", "b"), "cd": ("c", "d"), "bd": ("b", "e")})
    (('ab', 'bd'), ('cd',))
    """
    joined: DisjointSets[str] = DisjointSets()
    for first, second in wheels.values():
        joined.join(first, second)
    groups: dict[str, list[str]] = {}
    for name, (first, _) in wheels.items():
        groups.setdefault(joined.find(first), []).append(name)
    return tuple(tuple(each) for each in groups.values())


def best_shared_angle(
    start: Mapping[str, ToothSizes],
    sized: Callable[[str, float], ToothSizes],
    bounds: Range,
    aim: str,
    limits: Sequence[SizeLimit],
) -> dict[str, ToothSizes]:
    """Pairs at the one half angle at which their figures together are best, never worse than at the start.

    start    the pairs with the half angles that they have
    sized    the best sizes of a pair at a half angle; raises `QuestionError` where none turns
    limits   that each pair has to keep
    """

    def figure(designs: Mapping[str, ToothSizes]) -> float:
        if not all(keeps(each, limits) for each in designs.values()):
            return inf
        each = [design.merit(aim) for design in designs.values()]
        return max(each) if aim == "jam" else sum(each)

    found = figure(start), dict(start)

    def value(angle: float) -> float:
        nonlocal found
        try:
            designs = {name: sized(name, angle) for name in start}
        except QuestionError:
            return 1e6
        least = figure(designs)
        found = min(found, (least, designs), key=lambda each: each[0])
        return min(least, 1e6)

    low, high = bounds
    step = (high - low) / (_SCAN - 1)
    best = min((low + step * each for each in range(_SCAN)), key=value)
    around = max(low, best - step), min(high, best + step)
    minimize_scalar(value, bounds=around, method="bounded", options={"maxiter": _TRIES, "xatol": _NEAR})
    return found[1]
