"""Results of a search for the tooth counts of a train, part by part, and the ranks of given assignments."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from heapq import heappop, heappush
from math import prod
from typing import Any, ClassVar, Literal

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.exact import as_float
from geartrain.numerics.results import Key, Result, Tabular
from geartrain.search.search_outcome import CountSizes, Shortfall

By = Literal["error", "total", "largest", "distinct", "change"]
ORDERS: tuple[By, ...] = ("error", "total", "largest", "distinct", "change")


@dataclass(frozen=True, slots=True)
class ReachedSpeed(Result):
    """Speed and error of an output with an assignment."""

    KEYS = (
        "speed",
        Key("value", "speed", as_float),
        Key("target", "label"),
        Key("error", to=float),
        Key("exact_error", "error"),
        "met",
    )

    speed: Fraction
    """Exact speed in the unit of the train."""
    label: str
    """Requirement with the maximum error, such as "period 583.92 d"."""
    error: Fraction
    """Relative error of that requirement: |speed| / requested - 1 for a target, speed / expected - 1 for an `expect`
    (the speed itself if 0 is expected).
    """
    met: bool
    """True if the output satisfies all its requirements."""


@dataclass(frozen=True, slots=True)
class Assignment(CountSizes, Result):
    """Tooth counts of the free wheels, and the resulting speeds of the outputs.

    See Also
    --------
    search_train : finds them.
    """

    KEYS = ("teeth", "outputs", Key("error", to=float), "total", "largest", "distinct", "changed")

    teeth: Mapping[str, int]
    """Wheel -> tooth count, in the order of declaration."""
    outputs: Mapping[str, ReachedSpeed]
    """Output -> its speed and error; in a train with several states the names are "state: output"."""
    changed: tuple[str, ...] = ()
    """Wheels whose count differs from the declared value."""

    @property
    def counts(self) -> Collection[int]:
        """Tooth counts of all wheels."""
        return self.teeth.values()

    @property
    def error(self) -> Fraction:
        """Maximum absolute error over the outputs; 0 if there are none."""
        return max((abs(reached.error) for reached in self.outputs.values()), default=Fraction(0))

    def measure(self, by: By) -> tuple[Fraction | int, ...]:
        """Return the sort key, best first: the requested criterion, then error, total and largest count.

        Parameters
        ----------
        by : {"error", "total", "largest", "distinct", "change"}
            Primary criterion.
        """
        total, largest = self.total, self.largest
        first: dict[By, Fraction | int] = {
            "error": self.error,
            "total": total,
            "largest": largest,
            "distinct": self.distinct,
            "change": len(self.changed),
        }
        return first[by], self.error, total, largest


@dataclass(frozen=True, slots=True)
class PartFindings(Result):
    """Free wheels connected by outputs or constraints, and all their solutions."""

    KEYS = (
        "wheels",
        "outputs",
        "demands",
        "rules",
        "complete",
        "ranked",
        "reason",
        "considered",
        "count",
        Key("tolerance", to=float),
        "solutions",
        "shortfall",
    )

    wheels: tuple[str, ...]
    """Wheels in the order of declaration; no wheel is in two parts."""
    outputs: tuple[str, ...]
    """Outputs that they influence; empty for wheels without outputs and constraints."""
    demands: tuple[str, ...]
    """Descriptions of the requirements on the outputs."""
    rules: tuple[str, ...]
    """Names of the constraints on counts."""
    considered: int
    """Number of assignments."""
    count: int
    """Number of assignments that satisfy all requirements, and are within `tolerance` if that is not None."""
    tolerance: Fraction | None
    """Tolerance for outputs without their own, chosen so that it includes enough assignments; None if not used."""
    complete: bool
    """True if every assignment was considered, so that `count` is exact."""
    ranked: bool
    """True if it is proved that `solutions` are the best."""
    reason: str
    """Reason for which the search is not complete, or the solutions are not ranked."""
    solutions: tuple[Assignment, ...]
    """Best assignments, best first."""
    shortfall: Shortfall
    """Numbers of rejected assignments. Each is counted under the constraint at which the search rejected it; the
    constraints are listed in the order of evaluation.
    """


@dataclass(frozen=True, slots=True)
class Standing(Result):
    """Rank of one assignment of the wheels of a part."""

    wheels: tuple[str, ...]
    """Wheels of the part."""
    assignment: Assignment | None
    """Counts, outputs and errors of the assignment; None if its counts lock the train or leave it free."""
    rank: int | None
    """Rank by error, 1 for the best; None if the assignment is rejected or if counting would take too long."""
    refused: tuple[str, ...]
    """Descriptions of all constraints that reject it; empty for a solution."""


@dataclass(frozen=True, slots=True)
class TrainFindings(Tabular, Result):
    """Results of a search in a train.

    See Also
    --------
    search_train : returns it.
    """

    ROWS = "search.tooth_numbers_report:assignment_rows"
    MEANINGS: ClassVar = {
        "error of *": "Speed of the output over the requested speed, minus 1 [1].",
        "*": "Tooth count of the wheel.",
    }

    PAGE = "search.tooth_numbers_report:describe_assignments"

    KEYS = (
        *(Key("train", "name"), "by", "complete", "ranked", "considered", "count", "remarks", "parts", "solutions"),
        *("where", "ended"),
    )

    name: str
    """Name of the train."""
    by: By
    """Order of the solutions."""
    best: int
    """Requested number of solutions."""
    parts: tuple[PartFindings, ...]
    """Independent parts; their solutions can be combined freely."""
    links: Mapping[str, str]
    """Free wheel -> its link."""
    remarks: tuple[str, ...] = ()
    """Remarks, such as on outputs that no free wheel influences and that violate their requirements."""
    where: tuple[Standing, ...] = ()
    """Ranks of the queried assignments."""
    _stand: Callable[[int, Mapping[str, int]], Standing] | None = field(default=None, repr=False, compare=False)

    def _summary(self) -> str:
        return f"{self.name}: {len(self.parts)} parts, " + ", ".join(
            f"{len(part.solutions)} solutions" for part in self.parts[:4]
        )

    @property
    def wheels(self) -> tuple[str, ...]:
        """All free wheels, part by part."""
        return tuple(wheel for part in self.parts for wheel in part.wheels)

    @property
    def complete(self) -> bool:
        """True if every part is complete."""
        return all(part.complete for part in self.parts)

    @property
    def ended(self) -> Literal["whole", "interrupted"]:
        """ "interrupted" if the search was interrupted, otherwise "whole", even if only a sample was searched."""
        return "interrupted" if any(part.reason.startswith("interrupted") for part in self.parts) else "whole"

    @property
    def ranked(self) -> bool:
        """True if it is proved that the solutions of every part are its best."""
        return all(part.ranked for part in self.parts)

    @property
    def count(self) -> int:
        """Number of assignments of all free wheels that satisfy all requirements: the product over the parts."""
        return prod(part.count for part in self.parts)

    @property
    def considered(self) -> int:
        """Number of assignments of all free wheels."""
        return prod(part.considered for part in self.parts)

    @property
    def solutions(self) -> tuple[Assignment, ...]:
        """Best assignments of all free wheels, combined from the solutions of the parts, in the requested order."""
        return tuple(_together([part.solutions for part in self.parts], self.by, self.best))

    def standing(self, teeth: Mapping[str, int]) -> tuple[Standing, ...]:
        """Return the rank, errors and violated constraints of an assignment in each part whose wheels it includes.

        Parameters
        ----------
        teeth : mapping of str to int
            Free wheel -> tooth count. `QuestionError` is raised for wheels that are not free, and if no part is
            complete.
        """
        self._check(teeth)
        whole = [at for at, part in enumerate(self.parts) if all(wheel in teeth for wheel in part.wheels)]
        if not whole or self._stand is None:
            why = f"the parts of the train are {'; '.join(', '.join(part.wheels) for part in self.parts)}"
            raise QuestionError(Problem("the assignment includes no complete part", why, "give the missing counts"))
        return tuple(self._stand(at, teeth) for at in whole)

    def declaration(self, solution: Assignment | Mapping[str, int], parent: str, name: str = "") -> dict[str, Any]:
        """Return a declaration of a solution as plain data that extends the original train.

        Parameters
        ----------
        solution : Assignment or mapping of str to int
            Solution of the whole train or of one part. `QuestionError` is raised for wheels that are not free.
        parent : str
            Train to extend: a shipped train, or a path relative to the file to be written.
        name : str
            Name of the new train; by default the name of the train with "-found".
        """
        teeth = solution.teeth if isinstance(solution, Assignment) else solution
        self._check(teeth)
        links: dict[str, Any] = {}
        for wheel, count in teeth.items():
            links.setdefault(self.links[wheel], {"wheels": {}})["wheels"][wheel] = {"teeth": count}
        return {"name": name or f"{self.name}-found", "extends": parent, "links": links}

    def _check(self, teeth: Mapping[str, int]) -> None:
        for wheel in teeth:
            if wheel not in self.links:
                fix = f"the free wheels are {', '.join(self.links)}"
                raise QuestionError(Problem(f"wheel '{wheel}' is not free", "the search did not vary it", fix))


def _together(parts: Sequence[Sequence[Assignment]], by: By, best: int) -> Iterator[Assignment]:
    """Yield the best combinations of one solution of each part, best first, by a search with a priority queue.

    The solutions of every part are sorted, so the next best combination is one step in one part from a combination that
    was already visited. (Numbers of distinct counts do not add over parts; that order is therefore only approximate.)
    """
    if not parts or not all(parts):
        return
    start = (0,) * len(parts)
    heap = [(_joined(parts, start).measure(by), start)]
    seen = {start}
    for _ in range(best):
        if not heap:
            return
        _, at = heappop(heap)
        yield _joined(parts, at)
        for part in range(len(parts)):
            step = (*at[:part], at[part] + 1, *at[part + 1 :])
            if step[part] < len(parts[part]) and step not in seen:
                seen.add(step)
                heappush(heap, (_joined(parts, step).measure(by), step))


def _joined(parts: Sequence[Sequence[Assignment]], at: Sequence[int]) -> Assignment:
    chosen = [solutions[number] for solutions, number in zip(parts, at, strict=True)]
    return Assignment(
        {wheel: count for one in chosen for wheel, count in one.teeth.items()},
        {name: reached for one in chosen for name, reached in one.outputs.items()},
        tuple(wheel for one in chosen for wheel in one.changed),
    )
