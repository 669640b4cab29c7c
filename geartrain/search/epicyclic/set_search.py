"""Search for epicyclic sets with a requested ratio, by enumeration of all tooth counts within bounds, in every
operating mode.

The coaxial equations leave at most three independent tooth counts, so all sets are enumerated and the result is
complete. The ratio is computed in integers. Floats are used only to select the few candidates that are compared as
Fractions.

For one mode and 12 to 120 teeth, the exact join of `search.join` takes 2 to 30 times as long as the enumeration (22 to
110 times for Wolfrom sets). It is as fast only for two central wheels and about 200 teeth or more.

The ratio of a set is input speed / output speed, the convention of gear manufacturers. The ratio of a reduction is
above 1 in magnitude. It is negative if the output turns in the opposite sense to the input. `ratio_is` selects the
reciprocal.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import combinations, product
from math import isfinite, pi, prod, sin
from typing import TYPE_CHECKING, Any, get_args

import numpy as np

from geartrain.errors import Problem, QuestionError, RangeError
from geartrain.kinematics.buildability.equal_planets import neighbour_terms, passing_terms
from geartrain.numerics.exact import decimal
from geartrain.search.constraints.count_conditions import cosine, is_positive, sine
from geartrain.search.epicyclic.epicyclic_sets import (
    CentralWheel,
    EpicyclicKind,
    EpicyclicMode,
    EpicyclicSet,
    RatioIs,
    SetFindings,
    SetOrder,
    epicyclic_kind,
)
from geartrain.search.search_outcome import Shortfall
from geartrain.search.target_ratio import TargetRatio

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats, Ints
    from geartrain.search.tooth_count_ranges import Counts

    Columns = Mapping[str, Ints]

MOST_SETS = 4 * 10**8  # maximum number of sets that are enumerated
MOST_TEETH = 100_000
"""Maximum tooth count of a wheel. The numerators of ratios are cubic in the tooth counts, so this limit keeps them
below 2^53.
"""

SetBounds = Mapping[str, tuple[int, ...]]
"""Admissible tooth counts of each wheel, in ascending order."""

TIPS = 2.0
"""Tip diameter minus pitch diameter of every wheel, which is twice the addendum [modules]."""
_BEVEL = 1e-9  # [modules] float error of a clearance that equals the required one
_NEAR = 1e-6  # [modules] bound of the float error of a clearance
_MARGIN = 1e-12
"""Relative difference below which values are compared exactly instead of in floating point. Rounding errors are below
1e-15.
"""

_FARTHEST = Fraction(10**18)  # far beyond the ratios of all sets
_FINEST = 10**6
"""Maximum denominator of the required clearance [modules], so that clearances in units of 1/denominator of a module fit
in int64.
"""

NO_PLACE = "count out of bounds, planet that does not fit, or equal steps"
NO_SPACING = "planets that cannot be equally spaced"
NO_ROOM = "neighbouring planets that touch"
NO_MOTION = "mode that does not transmit motion"
NO_SENSE = "opposite sense of rotation"
NO_MATCH = "ratio outside the tolerance"


def find_sets(
    wanted: Fraction | TargetRatio,
    kind: str | EpicyclicKind,
    modes: str | Iterable[str | EpicyclicMode] = "all",
    counts: Counts | Mapping[str, Counts] = range(12, 121),
    planets: int = 3,
    tolerance: Fraction | None = None,
    best: int = 20,
    *,
    sense: int = 0,
    ratio_is: RatioIs = "input/output",
    by: SetOrder = "error",
    spaced: bool = True,
    clearance: Fraction | float = 0.0,
    slack: int = 0,
) -> SetFindings:
    """Find the best tooth counts of one type of epicyclic set for a ratio, by enumeration of all sets in all operating
    modes.

    The coaxial equations leave at most three independent tooth counts (Willis 1841; Mueller, Epicyclic Drive Trains,
    1982). All modules are equal.

    Parameters
    ----------
    wanted : Fraction or TargetRatio
        Magnitude of the ratio, above 0; or a parsed ratio, which may specify the sense of rotation.
    kind : str or EpicyclicKind
        "planetary", "stepped-suns", "stepped-sun-ring", "stepped-rings", "meshed-planets", "ravigneaux", "bevel",
        "wolfrom" or "3k-two-suns".
    modes : str or iterable of str or EpicyclicMode
        "all", or modes in the format `input:output:held`, such as "sun:carrier:ring".
    counts : sequence of int, or mapping of str to sequence of int
        Admissible tooth counts from 1 to 10^5, for all wheels including rings, or for each wheel.
    planets : int
        Number of equal planets, 1 or more.
    tolerance : Fraction, optional
        Maximum absolute relative error; by default unlimited.
    best : int
        Maximum number of sets to list, 1 or more.
    sense : {-1, 0, 1}
        Sense of rotation of the output: 1 for the sense of the input, -1 for the opposite sense, 0 for either.
    ratio_is : {"input/output", "output/input"}
        Definition of the ratio `wanted`: input speed divided by output speed, or the inverse.
    by : {"error", "total", "largest"}
        Primary criterion: minimum error, minimum sum of tooth counts, or minimum value of the largest tooth count.
    spaced : bool
        True to require that the planets can be equally spaced and do not overlap. If False, these properties are only
        reported.
    clearance : Fraction or float
        Minimum clearance between the tips of neighbouring planets [modules] if `spaced`.
    slack : int
        Maximum difference of centre distances [half modules], to be compensated by profile shift.

    Returns
    -------
    SetFindings
        Best sets, and numbers of rejected sets by reason.

    Raises
    ------
    QuestionError
        If an argument is invalid, such as an unknown type, mode or order, or a ratio that is not from 1e-18 to 1e18.
    RangeError
        If there are more than 4 10^8 sets.

    Examples
    --------
    A reduction of 7/2 with four planets; the ratio is 1 + r/s, and 4 must divide s + r:

    >>> found = find_sets(Fraction(7, 2), "planetary", "sun:carrier:ring", range(12, 61), planets=4, best=1)
    >>> dict(found.solutions[0].teeth), found.solutions[0].ratio
    ({'s': 16, 'p': 12, 'r': 40}, Fraction(7, 2))
    """
    kind = epicyclic_kind(kind) if isinstance(kind, str) else kind
    requested = wanted if isinstance(wanted, TargetRatio) else TargetRatio(Fraction(wanted))
    if tolerance is not None:
        tolerance = Fraction(tolerance)
    # an explicit sense takes precedence over the sign of a parsed ratio
    search = _Search(kind, requested.value, tolerance, best, ratio_is, by, planets, sense or requested.sense)
    search.check(clearance, slack)
    # a float clearance becomes a simple fraction
    minimum = Fraction(clearance).limit_denominator(_FINEST)
    bounds, chosen = read_bounds(kind, counts), kind.chosen(modes)
    for number, columns in blocks(kind, bounds, planets, minimum if spaced else None, slack):
        search.considered += number * len(chosen)
        search.charge(NO_PLACE, (number - _length(columns)) * len(chosen))
        if spaced:
            columns = search.assembled(columns, minimum, len(chosen))
        if _length(columns):
            for at, mode in enumerate(chosen):
                search.judge(columns, at, mode)
    return search.findings(chosen)


def _length(columns: Columns) -> int:
    return len(next(iter(columns.values())))


@dataclass
class _Search:
    """Enumeration of epicyclic sets: the best sets found so far, and the number of rejected epicyclic sets, keyed by
    the reason for the rejection. Each rejected epicyclic set is counted under the first reason that applies.
    """

    kind: EpicyclicKind
    wanted: Fraction
    tolerance: Fraction | None
    best: int
    ratio_is: RatioIs
    by: SetOrder
    planets: int
    sense: int
    considered: int = 0
    count: int = 0
    removed: dict[str, int] = field(default_factory=dict)
    found: list[tuple[tuple[Any, ...], EpicyclicSet]] = field(default_factory=list)
    nearest: EpicyclicSet | None = None

    def check(self, clearance: Fraction | float, slack: int) -> None:
        """Raise `QuestionError` if an argument of the search is invalid."""
        for valid, what, why, fix in (
            (
                1 / _FARTHEST < self.wanted < _FARTHEST,
                f"the ratio is {decimal(self.wanted, 6)}",
                "a ratio must be from 1e-18 to 1e18",
                "give a ratio in this range",
            ),
            (self.planets >= 1, f"planets is {self.planets}", "a set has at least one planet", "give planets >= 1"),
            (
                self.tolerance is None or self.tolerance >= 0,
                f"the tolerance is {self.tolerance}",
                "a tolerance must not be negative",
                "give 0 or more",
            ),
            (self.best >= 1, f"best is {self.best}", "a list has at least one solution", "give best >= 1"),
            (
                slack >= 0,
                f"slack is {slack}",
                "slack is the magnitude of a difference of centre distances",
                "give slack >= 0",
            ),
            (
                self.by in get_args(SetOrder),
                f"sets cannot be sorted by '{self.by}'",
                "a set has a ratio error, a sum of tooth counts (total) and a largest tooth count",
                "use error, total or largest",
            ),
            (
                self.ratio_is in get_args(RatioIs),
                f"'{self.ratio_is}' does not define a ratio",
                "a ratio is input speed divided by output speed, or its reciprocal",
                "use input/output or output/input",
            ),
            (
                isfinite(clearance),
                f"the clearance {clearance} is not finite",
                "the gap between the tooth tips of neighbouring planets must be a finite number of modules",
                "give a number of modules, such as 0.5",
            ),
        ):
            if not valid:
                raise QuestionError(Problem(what, why, fix))

    def charge(self, reason: str, number: int) -> None:
        if number:
            self.removed[reason] = self.removed.get(reason, 0) + number

    def assembled(self, columns: Columns, clearance: Fraction, modes: int) -> Columns:
        """Return the rows of `columns` for which the planets can be assembled with equal spacing and at least the given
        clearance [modules]. Candidates are combinations of an epicyclic set and an operating mode, so each rejected row
        is counted `modes` times.
        """
        even = places(self.kind, columns) % self.planets == 0
        self.charge(NO_SPACING, int((~even).sum()) * modes)
        columns = _select(columns, even)
        clear = clears(self.kind, columns, self.planets, clearance)
        self.charge(NO_ROOM, int((~clear).sum()) * modes)
        return _select(columns, clear)

    def judge(self, columns: Columns, at: int, mode: EpicyclicMode) -> None:
        """Compare the ratios of all epicyclic sets in `columns`, in one operating mode, with the requested ratio, and
        add the best of them to the results. `at` is the index of the mode among the requested modes.
        """
        top, beneath = ratio_terms(self.kind, mode, columns)
        runs = (top != 0) & (beneath != 0)
        right = runs if self.sense == 0 else runs & (np.sign(top) * np.sign(beneath) == self.sense)
        self.charge(NO_MOTION, int((~runs).sum()))
        self.charge(NO_SENSE, int((runs & ~right).sum()))
        if not right.any():
            return
        columns, top, beneath = _select(columns, right), np.abs(top[right]), np.abs(beneath[right])
        ratios = top / beneath if self.ratio_is == "input/output" else beneath / top
        errors = np.abs(ratios / float(self.wanted) - 1)
        self._look(columns, at, mode, errors)

    def _look(self, columns: Columns, at: int, mode: EpicyclicMode, errors: Floats) -> None:
        inside = self._inside(columns, mode, errors)
        self.count += int(inside.sum())
        self.charge(NO_MATCH, int((~inside).sum()))
        if not self.count:
            nearest = self._set(columns, int(errors.argmin()), mode)
            # only while nothing is within the tolerance, for the explanation
            if self.nearest is None or abs(nearest.error) < abs(self.nearest.error):
                self.nearest = nearest
        if not inside.any():
            return
        columns, errors = _select(columns, inside), errors[inside]
        stack = np.stack(list(columns.values()))
        first = {"error": errors, "total": stack.sum(axis=0), "largest": stack.max(axis=0)}[self.by]
        # the n-th best so far, and the n-th best of this block, are bounds of the n-th best of all
        bounds = [float(self.found[-1][0][0])] if len(self.found) == self.best else []
        if len(first) > self.best:
            bounds.append(float(np.partition(first, self.best - 1)[self.best - 1]))
        worst = min(bounds, default=np.inf)
        for row in np.flatnonzero(first <= worst + _MARGIN * (1 + worst)):
            found = self._set(columns, int(row), mode)
            criteria = {"error": abs(found.error), "total": found.total, "largest": found.largest}
            rank = (criteria[self.by], *criteria.values(), at, tuple(found.teeth.values()))
            self.found.append((rank, found))
        self.found = sorted(self.found, key=lambda item: item[0])[: self.best]

    def _inside(self, columns: Columns, mode: EpicyclicMode, errors: Floats) -> NDArray[np.bool_]:
        """Return whether the ratio error of each set is within the tolerance. Errors near the tolerance are compared as
        Fractions, all others as floats.
        """
        if self.tolerance is None:
            return np.ones(len(errors), dtype=bool)
        limit, margin = float(self.tolerance), _MARGIN * (1 + float(self.tolerance))
        inside = errors <= limit - margin
        for row in np.flatnonzero(np.abs(errors - limit) <= margin):
            inside[row] = abs(self._set(columns, int(row), mode).error) <= self.tolerance
        return inside

    def _set(self, columns: Columns, row: int, mode: EpicyclicMode) -> EpicyclicSet:
        """Return the result for the set in one row of the columns, with its exact ratio and its exact error."""
        one = {wheel: columns[wheel][row : row + 1] for wheel in self.kind.wheels}
        top, beneath = (int(term[0]) for term in ratio_terms(self.kind, mode, one))
        ratio = Fraction(top, beneath)
        requested = ratio if self.ratio_is == "input/output" else 1 / ratio
        return EpicyclicSet(
            self.kind.name,
            mode,
            {wheel: int(column[0]) for wheel, column in one.items()},
            ratio,
            abs(requested) / self.wanted - 1,
            self.planets,
            int(places(self.kind, one)[0]),
            float(room(self.kind, one, self.planets)[0]),
        )

    def findings(self, modes: tuple[EpicyclicMode, ...]) -> SetFindings:
        shortfall = Shortfall(self.considered, dict(self.removed), *self._miss())
        found = tuple(item for _, item in self.found)
        return SetFindings(
            self.kind.name, self.wanted, self.ratio_is, modes, self.tolerance, True, self.count, found, shortfall
        )

    def _miss(self) -> tuple[str, str]:
        """Return a description of the rejected set whose ratio is nearest to the requested ratio, and suggestions of
        changes to the search, as two texts. A text is empty if there is nothing to report.
        """
        if self.count:
            return "", ""
        if self.nearest is None and NO_SENSE in self.removed:
            return "", "all sets turn in the opposite sense: request the other sense, either sense, or other modes"
        if self.nearest is None:
            reason = max(self.removed, key=lambda name: self.removed[name])
            fix = "change the number of planets" if reason in (NO_SPACING, NO_ROOM) else "widen the range of counts"
            return "", f"all sets were rejected before their ratio was computed, most by: {reason}; {fix}"
        nearest = f"{self.nearest}, error {decimal(self.nearest.error, 3)}"
        if not Fraction(1, 2) < 1 + self.nearest.error < 2:
            fix = "search other modes or another kind of set"
            return nearest, f"this ratio is far from all ratios of these sets: {fix}, or request the reciprocal"
        error = decimal(abs(self.nearest.error), 3)
        return nearest, f"a tolerance of {error} includes it; a wider range of counts may give a nearer one"


# ------------------------------------------ all tooth sets of a kind within bounds, as columns, and their exact ratios


def read_bounds(kind: EpicyclicKind, counts: Counts | Mapping[str, Counts]) -> SetBounds:
    """Return the admissible tooth counts of every wheel. `counts` contains tooth counts common to all wheels, or the
    tooth counts of each wheel.

    `QuestionError` is raised if `counts` is invalid.
    """
    if isinstance(counts, Mapping):
        unknown = [wheel for wheel in counts if wheel not in kind.wheels]
        missing = [wheel for wheel in kind.wheels if wheel not in counts]
        if unknown or missing:
            what = f"unknown wheel '{unknown[0]}'" if unknown else f"wheel '{missing[0]}' has no counts"
            why = f"the wheels of the kind '{kind.name}' are {', '.join(kind.wheels)}"
            raise QuestionError(Problem(what, why, "give counts for each of these wheels"))
        return {wheel: _check_counts(f"of wheel '{wheel}' ", counts[wheel]) for wheel in kind.wheels}
    return dict.fromkeys(kind.wheels, _check_counts("", counts))


def _check_counts(whose: str, counts: Counts) -> tuple[int, ...]:
    found = tuple(sorted(set(counts))) if len(counts) <= MOST_TEETH else ()
    if found and found[0] >= 1 and found[-1] <= MOST_TEETH:
        return found
    why = f"at least one tooth count is needed, and all must be from 1 to {MOST_TEETH}"
    raise QuestionError(Problem(f"the tooth counts {whose}are not valid", why, "give a range such as 15:120"))


def blocks(
    kind: EpicyclicKind, bounds: SetBounds, planets: int, clearance: Fraction | None, slack: int
) -> Iterator[tuple[int, Columns]]:
    """Yield blocks of combinations of tooth counts: the number of combinations that were examined in the block, and the
    admissible combinations among them. The latter satisfy the coaxial equations, and their planets fit between the
    central wheels.

    planets     number of equal planets
    clearance   minimum clearance between planets [modules] in types with idle wheels; None if it is not required
    slack       maximum difference of centre distances [half modules], to be compensated by profile shift

    `RangeError` is raised if there are more than `MOST_SETS` combinations.
    """
    pairs = _coaxial_pairs(kind)
    total = prod(len(bounds[wheel]) for wheel in kind.free) * (2 * slack + 1) ** len(pairs)
    if total > MOST_SETS:
        raise RangeError(
            Problem(
                f"{total:.2g} combinations of tooth counts are too many",
                f"at most {MOST_SETS:.0e} combinations are enumerated",
                "narrow the ranges of tooth counts, or reduce the slack",
            )
        )
    first, *rest = (np.array(bounds[wheel], dtype=np.int64) for wheel in kind.free)
    inner = [column.ravel() for column in np.meshgrid(*rest, indexing="ij")]
    # about 20,000 sets fit the cache of a processor
    step = max(1, 20_000 // max(1, len(inner[0])))
    for at in range(0, len(first), step):
        head = first[at : at + step]
        # Cartesian product of the independent counts
        columns = [np.repeat(head, len(inner[0])), *(np.tile(column, len(head)) for column in inner)]
        chosen = dict(zip(kind.free, columns, strict=True))
        for extra in product(range(-slack, slack + 1), repeat=len(pairs)):
            found = _add_coaxial_counts(bounds, chosen, pairs, extra)
            if kind.idle:
                found = _with_idle(kind, bounds, found, planets, clearance)
            yield len(columns[0]), _select(found, fits(kind, found) & _is_stepped(kind, found))


def _coaxial_pairs(kind: EpicyclicKind) -> list[tuple[CentralWheel, CentralWheel]]:
    """Return pairs of central wheels that mesh with wheels of the same planet. The tooth count of the second wheel of a
    pair follows from that of the first by the equality of their centre distances.
    """
    if kind.bevel:
        return []
    found = []
    for link in kind.planets:
        first, *others = [member for member in kind.members if member.mesh in link]
        found += [(first, other) for other in others]
    return found


def _add_coaxial_counts(
    bounds: SetBounds,
    chosen: Columns,
    pairs: Sequence[tuple[CentralWheel, CentralWheel]],
    extra: Sequence[int],
) -> Columns:
    """Return the combinations `chosen` extended by the tooth count of the second wheel of each pair in `pairs`.
    Combinations in which such a tooth count is inadmissible are removed.

    extra   centre distance of the second wheel minus that of the first wheel [half modules], for each pair
    """
    columns = dict(chosen)
    for (first, other), more in zip(pairs, extra, strict=True):
        distance = columns[first.wheel] + (-1 if first.internal else 1) * columns[first.mesh] + more
        count = columns[other.wheel] = distance + (1 if other.internal else -1) * columns[other.mesh]
        allowed = bounds[other.wheel]
        within = (count >= allowed[0]) & (count <= allowed[-1])
        # `isin` is slow and needed only for a range with gaps
        columns = _select(columns, within if len(allowed) > allowed[-1] - allowed[0] else np.isin(count, allowed))
    return columns


def _is_stepped(kind: EpicyclicKind, columns: Columns) -> NDArray[np.bool_]:
    """Return, for each epicyclic set, False if one of its stepped planets has two equal steps and could be replaced by
    a planet with one wheel; True otherwise.
    """
    # equal steps differ from one wheel only if they mesh with two suns, or two rings, of different tooth counts
    stepped = np.ones(len(columns[kind.free[0]]), dtype=bool)
    for one, other in ((one, other) for link in kind.planets for one, other in combinations(link, 2)):
        differ = columns[one] != columns[other]
        for first, second in combinations(kind.members, 2):
            if {first.mesh, second.mesh} == {one, other} and first.internal == second.internal:
                differ |= columns[first.wheel] != columns[second.wheel]
        stepped &= differ
    return stepped


def _with_idle(
    kind: EpicyclicKind, bounds: SetBounds, columns: Columns, planets: int, clearance: Fraction | None
) -> dict[str, Ints]:
    """Return the epicyclic sets with tooth counts of the idle wheels added. Idle wheels affect no ratio; all of them
    have the same tooth count, the minimum with which the planets fit. Sets for which there is no such tooth count are
    removed.
    """
    # an idle wheel changes no ratio: the smallest count that fits represents all
    common = set[int].intersection(*(set(bounds[wheel]) for wheel in kind.idle))
    found: Ints = np.zeros_like(columns[kind.free[0]])
    for count in sorted(common):
        open_ = np.flatnonzero(found == 0)
        tried = {wheel: column[open_] for wheel, column in columns.items()}
        tried |= {wheel: np.full(len(open_), count, dtype=np.int64) for wheel in kind.idle}
        at = np.flatnonzero(fits(kind, tried))
        if clearance is not None:
            at = at[clears(kind, _select(tried, at), planets, clearance)]
        found[open_[at]] = count
    full = {**columns, **dict.fromkeys(kind.idle, found)}
    return _select(full, found > 0)


def _select(columns: Columns, good: NDArray[np.bool_] | Ints) -> dict[str, Ints]:
    return {wheel: column[good] for wheel, column in columns.items()}


def ratio_terms(kind: EpicyclicKind, mode: EpicyclicMode, columns: Columns) -> tuple[Ints, Ints]:
    """Return the exact numerator and denominator of the ratio of input speed to output speed, not reduced to lowest
    terms.

    The ratio is (f_in - f_held) / (f_out - f_held) by the Willis equation, where f is 0 for the carrier and sign P / z
    for a central wheel of z teeth that meshes with a planet wheel of P teeth. If the numerator or the denominator is 0,
    the mode does not transmit motion: the input is locked, or the output is at rest.
    """
    (n1, d1), (n2, d2), (n0, d0) = (
        _relative(kind.member(link), columns) for link in (mode.input, mode.output, mode.held)
    )
    return np.asarray((n1 * d0 - n0 * d1) * d2, dtype=np.int64), np.asarray((n2 * d0 - n0 * d2) * d1, dtype=np.int64)


def _relative(member: CentralWheel | None, columns: Columns) -> tuple[Ints | int, Ints | int]:
    if member is None:
        return 0, 1
    return member.sign * (columns[member.step] if member.step else 1), columns[member.wheel]


# -------------------------------------------- assembly of equal planets, and clearance between neighbours


def places(kind: EpicyclicKind, columns: Columns) -> Ints:
    """Return, for each set, the number of equally spaced positions at which identical planets can be assembled.

    A number n of equal planets can be equally spaced if and only if n divides this number. If this number is 0, every
    position is possible.

    Rotate the carrier by 1/n revolution with central wheel x fixed. Central wheel y then rotates by (1 - f_y/f_x)/n,
    where f is the speed of a wheel relative to the carrier, and its teeth must align where the next planet is inserted.
    Let z be the tooth count of a central wheel and P the tooth count of the planet wheel that it meshes with. If both
    central wheels mesh with the same planet wheel, (z_y + z_x)/n must be an integer if f_x and f_y have opposite signs,
    and (z_y - z_x)/n if they have equal signs. For a stepped planet, the condition is that (z_y P_x + z_x P_y)/(n
    gcd(P_x, P_y)), or the same expression with a minus sign, is an integer. Well-known cases are (s + r)/n for a sun
    and a ring, and (s1 p2 + r2 p1)/(n gcd(p1, p2)) for stepped planets.
    """
    number: Ints = np.zeros_like(columns[kind.members[0].wheel])
    for x, y in combinations(kind.members, 2):
        zx, zy = columns[x.wheel], columns[y.wheel]
        if x.step != y.step:
            common = np.gcd(columns[x.step], columns[y.step])
            zx, zy = zx * (columns[y.step] // common), zy * (columns[x.step] // common)
        number = np.gcd(number, np.abs(zy - x.sign * y.sign * zx))
    return number


def fits(kind: EpicyclicKind, columns: Columns) -> NDArray[np.bool_]:
    """Return, for each set, whether one planet (or one pair of planets) fits between the central wheels.

    Planets must be smaller than their ring. Planets that mesh with each other must extend from one central wheel to the
    other and have clearance from all wheels with which they do not mesh. Pitch cones of bevel wheels must open
    outwards. The addendum is one module. Interference of flanks is not tested here.
    """
    good = np.ones(columns[kind.members[0].wheel].shape, dtype=bool)
    for member in kind.members:
        if member.internal:
            good &= columns[member.wheel] > columns[member.mesh]
    if kind.name == "meshed-planets":
        gap = columns["r"] - columns["s"]
        good &= (2 * columns["p1"] + 2 * TIPS < gap) & (gap < 2 * (columns["p1"] + columns["p2"]))
    if kind.name == "ravigneaux":
        # the long planet clears the small sun, and the short one meshes with it
        good &= (columns["s2"] - columns["s1"] > 2 * TIPS) & (columns["s1"] + 2 * columns["ps"] > columns["s2"])
    if kind.bevel:
        good &= np.abs(columns["s1"] - columns["s2"]) < 2 * columns["p"]
        good &= _side_cosine(columns, "s1", "s2") >= 0
        good &= _side_cosine(columns, "s2", "s1") >= 0
    return good


def room(kind: EpicyclicKind, columns: Columns, planets: int) -> Floats:
    """Return, for each set, the clearance between the tips of equally spaced neighbouring planets [modules].

    The clearance is negative if planets overlap, and infinite for one planet. For n planets with p teeth on a sun with
    s teeth, it is (s + p) sin(pi/n) - p - 2. The positions of planets that mesh with each other follow from the law of
    cosines.
    """
    if planets == 1:
        return np.full(columns[kind.members[0].wheel].shape, np.inf)
    if kind.bevel:
        return _bevel_clearance(columns, planets)
    distances = [_distance(kind, columns, link).astype(np.float64) for link in kind.planets]
    tips = [np.maximum.reduce([columns[wheel] for wheel in link]) + TIPS for link in kind.planets]
    own: list[Floats] = [d * sin(pi / planets) - tip for d, tip in zip(distances, tips, strict=True)]
    if len(own) == 1:
        return own[0]
    (first, second), (a, b) = distances, kind.between[0]
    # avoids a division by 0 for a planet on the central axis, which does not fit anyway
    cosine = (first**2 + second**2 - (columns[a] + columns[b]) ** 2) / np.maximum(2 * first * second, 1)
    angle = np.arccos(np.clip(cosine, -1, 1))
    # planets of the second kind at all positions other than that of the own partner
    for turn in range(1, planets):
        cosine = np.cos(2 * pi * turn / planets - angle)
        apart = np.sqrt(np.maximum(first**2 + second**2 - 2 * first * second * cosine, 0))
        own.append((apart - tips[0] - tips[1]) / 2)
    return np.asarray(np.minimum.reduce(own), dtype=np.float64)


def clears(kind: EpicyclicKind, columns: Columns, planets: int, clearance: Fraction) -> NDArray[np.bool_]:
    """Return, for each set, whether the tips of neighbouring planets have at least the given clearance [modules].

    Clearances near the bound are compared exactly, in the same way as clearances of a declared train. Clearances of
    bevel wheels are computed from angles and compared as floats.
    """
    found, minimum = room(kind, columns, planets), float(clearance)
    # bevel sets are not decided exactly below, so a tie counts as sufficient clearance
    good = np.asarray(found >= minimum - _BEVEL)
    near = np.flatnonzero(np.abs(found - minimum) <= _NEAR)
    if kind.bevel or not len(near):
        return good
    columns = _select(columns, near)
    # all lengths are multiplied by the denominator, so that they are integers
    unit, required = clearance.denominator, clearance.numerator
    reaches = [unit * _distance(kind, columns, link) for link in kind.planets]
    tips = [unit * (np.maximum.reduce([columns[wheel] for wheel in link]) + int(TIPS)) for link in kind.planets]
    chord, exact = sine(Fraction(1, 2 * planets)), np.ones(len(near), dtype=bool)
    for reach, tip in zip(reaches, tips, strict=True):
        exact &= is_positive(neighbour_terms, [reach, tip + required], [chord], strictly=False)
    for a, b in kind.between:
        lengths = [*reaches, unit * (columns[a] + columns[b]), tips[0] + tips[1] + 2 * required]
        for turn in (Fraction(step, planets) for step in range(1, planets)):
            exact &= is_positive(passing_terms, lengths, [cosine(turn), sine(turn)], strictly=False)
    good[near] = exact
    return good


def _distance(kind: EpicyclicKind, columns: Columns, link: tuple[str, ...]) -> Ints:
    """Return, for each set, the distance between the central axis and the axis of a planet [half modules]."""
    member = next(member for member in kind.members if member.mesh in link)
    planet = columns[member.mesh]
    return columns[member.wheel] + (-planet if member.internal else planet)


def _side_cosine(columns: Columns, own: str, other: str) -> Floats:
    """Return, for each bevel set, the cosine of the pitch-cone angle of one of the two central wheels. `own` is the
    name of this wheel, and `other` the name of the second central wheel.
    """
    # the cone angles g of planet p and side wheels a, b have equal sin g / z and satisfy g_a + g_b + 2 g_p = pi, so
    # they are the angles of a triangle with the sides a, b and 2 p cos g_p, and cos^2 g_p = (a + b)^2 / 4(p^2 + ab)
    a, b, third = columns[own], columns[other], 2 * columns["p"] * _planet_cosine(columns)
    return np.asarray((b**2 + third**2 - a**2) / (2 * b * third), dtype=np.float64)


def _planet_cosine(columns: Columns) -> Floats:
    a, b, p = columns["s1"], columns["s2"], columns["p"]
    return np.asarray(np.sqrt(np.minimum(1, (a + b) ** 2 / (4 * (p**2 + a * b)))), dtype=np.float64)


def _bevel_clearance(columns: Columns, planets: int) -> Floats:
    """Return, for each set, the clearance between the tips of neighbouring bevel planets [modules]: c (b - 2 g) - 2,
    where c is the cone distance [modules], b is the angle between the axes of the planets [rad], and g is their
    pitch-cone angle [rad].
    """
    cone = np.arccos(_planet_cosine(columns))
    # a cone angle of 0 gives an infinite radius, which is replaced below
    with np.errstate(divide="ignore", invalid="ignore"):
        radius = columns["p"] / (2 * np.sin(cone))
        shaft = cone + np.arccos(np.clip(_side_cosine(columns, "s1", "s2"), -1, 1))
        # angle between the axes of neighbours on the cone of axes
        between = 2 * np.arcsin(np.clip(np.sin(shaft) * sin(pi / planets), 0, 1))
        found = radius * (between - 2 * cone) - TIPS
    return np.where(np.isfinite(found), found, -np.inf)
