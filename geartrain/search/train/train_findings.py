"""Results of a search for the tooth counts of a train for each independent part, and the ranks of given assignments."""

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


@dataclass(frozen=True, slots=True)
class ReachedSpeed(Result):
    """Speed and error of an output for an assignment of tooth counts."""

    KEYS = (
        "speed",
        Key("value", "speed", as_float),
        Key("target", "label"),
        Key("error", to=float),
        Key("exact_error", "error"),
        "met",
    )

    speed: Fraction
    """Exact speed of the output [the train's unit of speed]."""
    label: str
    """Description of the requirement with the maximum error, such as "period 583.92 d"."""
    error: Fraction
    """Relative error with respect to the requirement `label`: |speed| / requested speed - 1 for a target, or speed /
    expected speed - 1 for an `expect` value. If the expected speed is 0, the value is the speed itself.
    """
    met: bool
    """True if the output satisfies all its requirements."""


@dataclass(frozen=True, slots=True)
class Assignment(CountSizes, Result):
    """Tooth counts of the varied wheels, with the resulting speeds of the outputs."""

    KEYS = ("teeth", "outputs", Key("error", to=float), "total", "largest", "distinct", "changed")

    teeth: Mapping[str, int]
    """Tooth count of each wheel, in the order of declaration."""
    outputs: Mapping[str, ReachedSpeed]
    """Speed and error of each output, keyed by name. If the train has several states, the names have the format "state:
    output".
    """
    changed: tuple[str, ...] = ()
    """Names of the wheels whose tooth count differs from the declared tooth count."""

    @property
    def counts(self) -> Collection[int]:
        """Tooth counts of all wheels."""
        return self.teeth.values()

    @property
    def error(self) -> Fraction:
        """Maximum absolute relative error of the outputs; 0 if there are no outputs."""
        return max((abs(reached.error) for reached in self.outputs.values()), default=Fraction(0))

    def measure(self, by: By) -> tuple[Fraction | int, ...]:
        """Return the sort key of the assignment: primary criterion, error, sum of tooth counts, and largest tooth
        count.

        by   primary criterion: "error", "total", "largest", "distinct" or "change"
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
    """Solutions for one part of a train. A part consists of varied wheels that are connected by outputs or
    constraints.
    """

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
    """Names of the wheels in the order of declaration. No wheel belongs to two parts."""
    outputs: tuple[str, ...]
    """Names of the outputs with requirements that depend on the wheels; empty if there are none."""
    demands: tuple[str, ...]
    """Descriptions of the requirements on the outputs."""
    rules: tuple[str, ...]
    """Names of the constraints on tooth counts."""
    considered: int
    """Number of all assignments of admissible tooth counts to the wheels."""
    count: int
    """Number of assignments that satisfy all requirements and, if `tolerance` is not None, this tolerance."""
    tolerance: Fraction | None
    """Relative tolerance of outputs without a declared tolerance. It is chosen so that enough assignments are included.
    None if it is not used.
    """
    complete: bool
    """True if every assignment was examined, so that `count` is exact."""
    ranked: bool
    """True if the assignments in `solutions` are proved to be the best."""
    reason: str
    """Reason why the search is not complete or the solutions are not ranked; empty if the search is complete and the
    solutions are ranked.
    """
    solutions: tuple[Assignment, ...]
    """Best assignments in the order of the search criterion."""
    shortfall: Shortfall
    """Number of assignments rejected by each constraint, in the order of evaluation.

    Each assignment is counted under the first constraint that rejected it.
    """


@dataclass(frozen=True, slots=True)
class Standing(Result):
    """Rank of one assignment of tooth counts among all assignments, for one part of a train. The varied wheels of a
    part are independent of all other varied wheels.
    """

    wheels: tuple[str, ...]
    """Names of the wheels of the part."""
    assignment: Assignment | None
    """Tooth counts, output speeds and errors of the assignment; None if the train is locked or if output speeds are
    undetermined.
    """
    rank: int | None
    """Rank of the assignment by error, where 1 is the best. None if the assignment is rejected, or if the number of
    better assignments is not completely known.
    """
    refused: tuple[str, ...]
    """Descriptions of all constraints that the assignment violates; empty for a solution."""


@dataclass(frozen=True, slots=True)
class TrainFindings(Tabular, Result):
    """Results of a search for the tooth counts of a train: the best solutions and the number of solutions for each
    independent part.

    See Also
    --------
    search_train : Search for tooth counts of a train.
    """

    ROWS = "search.tooth_numbers_report:assignment_rows"
    MEANINGS: ClassVar = {
        "error of *": "Speed of the output divided by the requested speed, minus 1 [1].",
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
    """Criterion by which the solutions are sorted."""
    best: int
    """Requested maximum number of solutions."""
    parts: tuple[PartFindings, ...]
    """Results of the independent parts, whose solutions can be combined freely."""
    links: Mapping[str, str]
    """Name of the link that carries each varied wheel, keyed by wheel."""
    remarks: tuple[str, ...] = ()
    """Remarks on the search, for example on outputs that depend on no varied wheel and violate their requirements."""
    where: tuple[Standing, ...] = ()
    """Ranks of the assignments for which a rank was requested."""
    _stand: Callable[[int, Mapping[str, int]], Standing] | None = field(default=None, repr=False, compare=False)

    def _summary(self) -> str:
        return f"{self.name}: {len(self.parts)} parts, " + ", ".join(
            f"{len(part.solutions)} solutions" for part in self.parts[:4]
        )

    @property
    def wheels(self) -> tuple[str, ...]:
        """Names of all varied wheels, listed part by part."""
        return tuple(wheel for part in self.parts for wheel in part.wheels)

    @property
    def complete(self) -> bool:
        """True if the search of every part is complete."""
        return all(part.complete for part in self.parts)

    @property
    def ended(self) -> Literal["whole", "interrupted"]:
        """Outcome of the search: "interrupted" or "whole". A search of a random sample that was completed is also
        "whole".
        """
        return "interrupted" if any(part.reason.startswith("interrupted") for part in self.parts) else "whole"

    @property
    def ranked(self) -> bool:
        """True if the listed solutions of every part are proved to be the best."""
        return all(part.ranked for part in self.parts)

    @property
    def count(self) -> int:
        """Number of assignments of all varied wheels that satisfy all requirements. It is the product of the numbers
        for the independent parts.
        """
        return prod(part.count for part in self.parts)  # parts are independent

    @property
    def considered(self) -> int:
        """Number of all assignments of admissible tooth counts to the varied wheels."""
        return prod(part.considered for part in self.parts)

    @property
    def solutions(self) -> tuple[Assignment, ...]:
        """Best assignments of all varied wheels in the requested order, combined from the solutions of the parts."""
        return tuple(_together([part.solutions for part in self.parts], self.by, self.best))

    def standing(self, teeth: Mapping[str, int]) -> tuple[Standing, ...]:
        """Return the rank, errors and violated constraints of an assignment, for each part whose wheels are all in the
        assignment.

        Parameters
        ----------
        teeth : mapping of str to int
            Tooth count of each wheel. `QuestionError` is raised if a wheel was not varied, or if the tooth counts of
            every part are incomplete.
        """
        self._check(teeth)
        whole = [at for at, part in enumerate(self.parts) if all(wheel in teeth for wheel in part.wheels)]
        if not whole:
            what = "the assignment does not contain all wheels of any part"
            why = f"the parts of the train are {'; '.join(', '.join(part.wheels) for part in self.parts)}"
            raise QuestionError(Problem(what, why, "give the counts of all wheels of at least one part"))
        if self._stand is None:
            what = "the rank of an assignment cannot be determined"
            why = "these results were not returned by `search_train`, so they do not contain the search"
            raise QuestionError(Problem(what, why, "repeat the search with `search_train`"))
        return tuple(self._stand(at, teeth) for at in whole)

    def declaration(self, solution: Assignment | Mapping[str, int], parent: str, name: str = "") -> dict[str, Any]:
        """Return a declaration with the tooth counts of a solution, as plain data that extends the original train.

        Parameters
        ----------
        solution : Assignment or mapping of str to int
            Solution of the whole train or of one part. `QuestionError` is raised if a wheel was not varied.
        parent : str
            Train to extend: the name of a bundled example, or a path relative to the file to be written.
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
                fix = f"use only wheels among {', '.join(self.links)}"
                raise QuestionError(
                    Problem(f"wheel '{wheel}' is not in the solutions", "the search did not vary its tooth count", fix)
                )


def _together(parts: Sequence[Sequence[Assignment]], by: By, best: int) -> Iterator[Assignment]:
    """Yield the best combinations of one solution from each part in the order `by`, with the best combination first, by
    a search with a priority queue. For the order "distinct", better combinations may be missing.
    """
    if not parts or not all(parts):
        return
    # the solutions of every part are sorted, so that the next best combination differs from a visited combination by
    # one step in the list of one part; the number of distinct tooth counts is not a sum over the parts
    start = (0,) * len(parts)  # the best solution of every part
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
