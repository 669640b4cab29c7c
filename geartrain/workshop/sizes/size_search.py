"""The best sizes of a pair with triangular teeth: least loss, error or impact, or the widest margin, within limits.

The figures are continuous in the sizes, but have kinks wherever the structure of the real path changes, and several
local minima: `numerics.global_minimum` finds the least. A front between two aims holds what no design is better than in
both: the least of the one under bounds on the other (the method of epsilon constraints), and every design on the way.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import pi

from geartrain.errors import Problem, QuestionError
from geartrain.workshop.sizes.global_minimum import Point, SampledFunction, distance, minimise, polish
from geartrain.workshop.sizes.size_design import PARAMETERS, SizeLimit, ToothSizes, keeps

Range = tuple[float, float]
USUAL_RANGES: Mapping[str, Range] = {
    "radii": (0.8, 1.25),
    "window": (0.1, 0.9),
    "half_angle": (pi / 12, pi / 4),
}
"""Where a free parameter is looked for if no bounds are given."""
_BEYOND = 1e3  # above every figure: designs that turn but miss a limit
_NOTHING = 1e6  # designs that do not turn
_FRONT = 9  # bounds on the second aim
_WORTH = 0.005  # of a front in its second aim: how far apart its designs are
_CLEARANCES = ("clearance", "excess", "backlash", "centre_distance")  # as declarations may give it
_WIDEST = {"radii": (0.1, 10.0), "window": (0.0, 1.0), "half_angle": (0.0, pi / 2)}


class SizeSearch:
    """Designs of one pair as points of the free parameters; each is made once, whatever is asked of it."""

    def __init__(
        self,
        start: ToothSizes,
        free: Mapping[str, Range],
        limits: Sequence[SizeLimit] = (),
        on_design: Callable[[], None] = lambda: None,
    ) -> None:
        self.start, self.free, self.limits = start, dict(free), tuple(limits)
        self._on_design = on_design
        self.designs: dict[Point, ToothSizes] = {}

    def design(self, at: Point) -> ToothSizes:
        """The design at one point."""
        if at not in self.designs:
            self.designs[at] = self.start.at(dict(zip(self.free, at, strict=True)))
            self._on_design()
        return self.designs[at]

    def place(self, design: ToothSizes) -> Point:
        """The point of a design, which may lie outside the bounds."""
        return tuple(map(design.parameter, self.free))

    @property
    def bounds(self) -> tuple[Range, ...]:
        """Of the free parameters, in their order."""
        return tuple(self.free.values())

    def keeps(self, design: ToothSizes, more: Sequence[SizeLimit] = ()) -> bool:
        """Whether a design turns and keeps all limits."""
        return keeps(design, (*self.limits, *more))

    def value(self, aim: str, more: Sequence[SizeLimit] = ()) -> Callable[[Point], float]:
        """The figure to be made small; beyond all figures where a pair does not turn or misses a limit."""

        def figure(at: Point) -> float:
            design = self.design(at)
            if not design.runs:
                return _NOTHING
            missed = sum(max(limit.excess(design), 0.0) for limit in (*self.limits, *more))
            return _BEYOND + missed if missed > 0 else min(design.merit(aim), _NOTHING)

        return figure

    def least(self, aim: str, starts: Sequence[ToothSizes] = ()) -> ToothSizes:
        """The best design in one aim. Raises `QuestionError` where none turns and keeps the limits."""
        sampled = minimise(self.value(aim), self.bounds, [self.place(each) for each in starts])
        best = self.design(sampled.best)
        if self.keeps(best):
            return best
        turns = any(design.runs for design in self.designs.values())
        names = ", ".join(self.free)
        why = "every one that turns misses a limit" if turns else "none of them turns"
        z1, z2 = self.start.teeth
        what = f"no {names} in the ranges asked for makes a pair of {z1} and {z2} teeth that turns"
        raise QuestionError(Problem(what, why, "widen the ranges, free more, or loosen the limits"))

    def front(self, first: str, second: str) -> tuple[ToothSizes, ...]:
        """What none is better than in both aims, from the best in the first on."""
        ends = self.least(first), self.least(second)
        low, high = (each.merit(second) for each in ends[::-1])
        for step in range(1, _FRONT + 1):
            bound = _limit(second, high + (low - high) * step / (_FRONT + 1))
            known = SampledFunction(self.value(first, [bound]), self.bounds)
            inside = [at for at, each in self.designs.items() if self.keeps(each, [bound])]
            if inside:
                polish(known, min(inside, key=lambda at: self.designs[at].merit(first)), rounds=1)
        return _spread(undominated([each for each in self.designs.values() if self.keeps(each)], first, second), second)


def undominated(designs: Sequence[ToothSizes], first: str, second: str) -> tuple[ToothSizes, ...]:
    """The Pareto front of designs in two aims, from the best in the first to the best in the second."""
    found: list[ToothSizes] = []
    for each in sorted(designs, key=lambda design: (design.merit(first), design.merit(second))):
        if not found or each.merit(second) < found[-1].merit(second):
            found.append(each)
    return tuple(found)


def _spread(front: Sequence[ToothSizes], aim: str) -> tuple[ToothSizes, ...]:
    """A front without the designs that differ by nothing worth telling from the one before; both ends are kept."""
    worth = _WORTH * (front[0].merit(aim) - front[-1].merit(aim))
    found = [front[0]]
    for each in front[1:-1]:
        if min(found[-1].merit(aim) - each.merit(aim), each.merit(aim) - front[-1].merit(aim)) >= worth:
            found.append(each)
    return (*found, *front[1:][-1:])


def _limit(aim: str, merit: float) -> SizeLimit:
    return SizeLimit(aim, -merit if aim == "jam" else merit)


def checked_ranges(free: Mapping[str, Range | None]) -> dict[str, Range]:
    """Bounds of what is free, the usual ones where none are given. Raises `QuestionError` for what cannot be."""
    found = {}
    for name, given in free.items():
        if name not in PARAMETERS:
            what = f"'{name}' is no size of triangular teeth that can be free"
            why = "the clearance is searched as its place in the window, which moves with the radii"
            fix = f"free some of {', '.join(PARAMETERS)}"
            raise QuestionError(Problem(what, why if name in _CLEARANCES else "", fix))
        low, high = USUAL_RANGES[name] if given is None else given
        least, most = _WIDEST[name]
        if not least <= low < high <= most or (name == "half_angle" and not low > 0):
            what = f"'{name}' cannot lie from {low:g} to {high:g}"
            raise QuestionError(Problem(what, "", f"give two bounds within {least:g} to {most:g}, the lower first"))
        found[name] = (float(low), float(high))
    if not found:
        raise QuestionError(Problem("nothing is free", "", f"free some of {', '.join(PARAMETERS)}"))
    return found


# The best design under a limit that costs too much to be asked of every one, such as a chance from trials.


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
        The chance of a design, such as of `geartrain.workshop.PairTrials`.

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
