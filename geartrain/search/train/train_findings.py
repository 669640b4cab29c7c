"""What a search for the tooth numbers of a train found: part by part, with where any other assignment stands."""

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
    """What an output does under an assignment."""

    KEYS = (
        "speed",
        Key("value", "speed", as_float),
        Key("target", "label"),
        Key("error", to=float),
        Key("exact_error", "error"),
        "met",
    )

    speed: Fraction
    """Exact, in the train's unit [turns of the unit]."""
    label: str
    """The requirement it misses by most, such as "period 583.92 d"."""
    error: Fraction
    """Its relative error: |speed| / wanted - 1 against a target, speed / expected - 1 against an `expect` (the speed
    itself where 0 is expected)."""
    met: bool
    """True if the output meets all that is required of it."""


@dataclass(frozen=True, slots=True)
class Assignment(CountSizes, Result):
    """Tooth counts of the free wheels, and what the outputs do with them.

    See Also
    --------
    search_train : finds them.
    """

    KEYS = ("teeth", "outputs", Key("error", to=float), "total", "largest", "distinct", "changed")

    teeth: Mapping[str, int]
    """Wheel -> count, in the order declared."""
    outputs: Mapping[str, ReachedSpeed]
    """Output -> what it reaches; in a train with states the outputs are named "state: output"."""
    changed: tuple[str, ...] = ()
    """Wheels whose count is not the declared value."""

    @property
    def counts(self) -> Collection[int]:
        """The counts of all wheels."""
        return self.teeth.values()

    @property
    def error(self) -> Fraction:
        """The largest |error| over the outputs; 0 without any."""
        return max((abs(reached.error) for reached in self.outputs.values()), default=Fraction(0))

    def measure(self, by: By) -> tuple[Fraction | int, ...]:
        """What it is ordered by: the order asked for, then error, total and largest; least is best.

        Parameters
        ----------
        by : {"error", "total", "largest", "distinct", "change"}
            What comes first.
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
    """Free wheels that belong together, because outputs or constraints join them, and all that meets them."""

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
    """In the order declared; parts share none."""
    outputs: tuple[str, ...]
    """The outputs they move; none for wheels that no output and no constraint asks for."""
    demands: tuple[str, ...]
    """What is required of the outputs, in words."""
    rules: tuple[str, ...]
    """Names of the constraints on counts."""
    considered: int
    """Assignments there are."""
    count: int
    """Assignments that meet everything; where `tolerance` is not None, those within it."""
    tolerance: Fraction | None
    """For outputs without a tolerance of their own: the one that was found to hold enough."""
    complete: bool
    """True if every assignment was considered, so that `count` is exact."""
    ranked: bool
    """True if no assignment that is not in `solutions` comes before one that is."""
    reason: str
    """Why it is not complete, or not ranked."""
    solutions: tuple[Assignment, ...]
    """The best, best first."""
    shortfall: Shortfall
    """Where the others went: each is charged to the constraint at which the search gave it up; these stand in the
    order in which they are decided."""


@dataclass(frozen=True, slots=True)
class Standing(Result):
    """Where one assignment of a part's wheels stands."""

    wheels: tuple[str, ...]
    """The part's wheels."""
    assignment: Assignment | None
    """Its counts, outputs and errors; None where a wheel's count locks the train or leaves it free."""
    rank: int | None
    """1 for the best: one more than the number of assignments before it in error; None where it is refused or where
    counting would take too long."""
    refused: tuple[str, ...]
    """What refuses it, each in words; empty for a solution."""


@dataclass(frozen=True, slots=True)
class TrainFindings(Tabular, Result):
    """All that a search in a train found.

    See Also
    --------
    search_train : gives it.
    """

    ROWS = "search.tooth_numbers_report:assignment_rows"
    MEANINGS: ClassVar = {
        "error of *": "Speed of the output over the wanted speed, less 1 [1].",
        "*": "Tooth count of the wheel.",
    }

    PAGE = "search.tooth_numbers_report:describe_assignments"

    KEYS = (
        *(Key("train", "name"), "by", "complete", "ranked", "considered", "count", "remarks", "parts", "solutions"),
        *("where", "ended"),
    )

    name: str
    """Of the train."""
    by: By
    """The order of the solutions."""
    best: int
    """How many were asked for."""
    parts: tuple[PartFindings, ...]
    """Independent parts; any solution of one goes with any solution of another."""
    links: Mapping[str, str]
    """Free wheel -> its link."""
    remarks: tuple[str, ...] = ()
    """What the reader should know: outputs that no free wheel moves, and whether they are right."""
    where: tuple[Standing, ...] = ()
    """Where the assignments stand that were asked about."""
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
        """Whether the search was whole, though it may have been of a sample."""
        return "interrupted" if any(part.reason.startswith("interrupted") for part in self.parts) else "whole"

    @property
    def ranked(self) -> bool:
        """True if the solutions of every part are shown to be its best."""
        return all(part.ranked for part in self.parts)

    @property
    def count(self) -> int:
        """Assignments of all free wheels that meet everything: the product over the parts."""
        return prod(part.count for part in self.parts)

    @property
    def considered(self) -> int:
        """Assignments of all free wheels that there are."""
        return prod(part.considered for part in self.parts)

    @property
    def solutions(self) -> tuple[Assignment, ...]:
        """The best assignments of all free wheels, made of the solutions of the parts, in the order asked for."""
        return tuple(_together([part.solutions for part in self.parts], self.by, self.best))

    def standing(self, teeth: Mapping[str, int]) -> tuple[Standing, ...]:
        """Where an assignment stands in each part all of whose wheels it names: its errors, its rank, what refuses it.

        Parameters
        ----------
        teeth : mapping of str to int
            Free wheel -> count. `QuestionError` for wheels that are not free, and if they make up no part as a whole.
        """
        self._check(teeth)
        whole = [at for at, part in enumerate(self.parts) if all(wheel in teeth for wheel in part.wheels)]
        if not whole or self._stand is None:
            why = f"its parts are {'; '.join(', '.join(part.wheels) for part in self.parts)}"
            raise QuestionError(Problem("the assignment names no part as a whole", why, "give the missing counts"))
        return tuple(self._stand(at, teeth) for at in whole)

    def declaration(self, solution: Assignment | Mapping[str, int], parent: str, name: str = "") -> dict[str, Any]:
        """The plain declaration that writes a solution down, as a change of the train it was found for.

        Parameters
        ----------
        solution : Assignment or mapping of str to int
            Of the whole or of one part. `QuestionError` for wheels that are not free.
        parent : str
            What it extends: a shipped train, or a path relative to where it will be written.
        name : str
            Of the new train; default that of the train with "-found".
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
                raise QuestionError(Problem(f"wheel '{wheel}' is not free", "the search did not look for it", fix))


def _together(parts: Sequence[Sequence[Assignment]], by: By, best: int) -> Iterator[Assignment]:
    """The best combinations of one solution of each part, best first.

    Every part's solutions are in order, so the next best combination is one step further in one part than one that has
    come already. (Distinct counts do not add up over parts; there the order is as good as the steps.)
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
