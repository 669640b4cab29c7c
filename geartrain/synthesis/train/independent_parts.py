"""The free wheels of a train and their requirements, in parts that share neither output nor constraint."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import chain
from math import prod

from geartrain.errors import Problem, QuestionError, RangeError, suggest
from geartrain.kinematics.formulas.output_formulas import find_formulas
from geartrain.numerics.decimal_text import decimal
from geartrain.numerics.graphs import joined_groups
from geartrain.synthesis.constraints.count_conditions import CountConstraint
from geartrain.synthesis.join.product_lists import Domains
from geartrain.synthesis.join.wheel_monomials import IntervalConstraint
from geartrain.synthesis.train.output_requirements import (
    OutputRequirement,
    find_output_requirements,
    find_turning_conditions,
)
from geartrain.train import Teeth, Train

_MOST_COUNTS = 10**6


@dataclass(frozen=True, slots=True)
class SearchPart:
    """Wheels that outputs or constraints join, and their requirements.

    domains      wheel -> its counts, ascending, in the order declared
    askings      outputs that they move
    conditions   loops and locks that must close for the train to turn
    rules        constraints on counts
    """

    domains: Domains
    askings: tuple[OutputRequirement, ...]
    conditions: tuple[IntervalConstraint, ...]
    rules: tuple[CountConstraint, ...]

    @property
    def considered(self) -> int:
        """Assignments there are."""
        return prod(len(counts) for counts in self.domains.values())


@dataclass(frozen=True, slots=True)
class TrainRequirements:
    """The requirements of a train in one or several states.

    remarks   outputs that no free wheel moves and that are not as asked, and outputs that nothing determines
    """

    askings: tuple[OutputRequirement, ...]
    conditions: tuple[IntervalConstraint, ...]
    remarks: tuple[str, ...]


def find_domains(train: Train, free: str | Sequence[str]) -> dict[str, tuple[int, ...]]:
    """The counts of each free wheel, ascending, in the order declared; see `search_train` for `free`.

    Raises `QuestionError` where there is none, or where one has no counts to choose from.
    """
    if isinstance(free, str) and free not in ("search", "uncertain"):
        free = [free]
    if not isinstance(free, str):
        unknown = [name for name in free if name not in train.wheels]
        if unknown:
            fix = suggest(unknown[0], train.wheels)
            raise QuestionError(Problem(f"'{train.name}' has no wheel '{unknown[0]}'", "it is not declared", fix))
    found = {}
    for wheel, (link, declared) in train.wheels.items():
        teeth = declared.teeth if isinstance(declared.teeth, Teeth) else Teeth(value=declared.teeth)
        chosen = wheel in free if not isinstance(free, str) else teeth.search is not None or free == "uncertain"
        counts = tuple(_counts(train, wheel, link, teeth)) if chosen or teeth.value is None else ()
        if counts:
            found[wheel] = counts
        elif chosen and not isinstance(free, str):
            why = f"its count is {teeth.value}, with no search, range or choices"
            fix = "declare it as {search: [15, 80]}"
            raise QuestionError(
                Problem(f"wheel '{wheel}' is not free", why, fix, train.place("links", link, "wheels", wheel))
            )
    if not found:
        fix = "write `teeth: {search: [15, 80]}` at the wheels to be found"
        if free == "search" and any(train.uncertain_wheels()):
            fix += ", or ask for the uncertain ones"
        raise QuestionError(Problem(f"'{train.name}' has no wheel to be found", "none has `search`", fix))
    return found


def _counts(train: Train, wheel: str, link: str, teeth: Teeth) -> Iterable[int]:
    """The counts a wheel may have: those of `search`, else what its evidence allows."""
    counts = teeth.searched or sorted(set(teeth.choices or ()))
    if not counts and teeth.range is not None:
        counts = range(teeth.range[0], teeth.range[1] + 1)
    if len(counts) > _MOST_COUNTS:
        why = f"{counts[0]} to {counts[-1]} are more than {_MOST_COUNTS} counts"
        place = train.place("links", link, "wheels", wheel)
        raise RangeError(Problem(f"the range of wheel '{wheel}' is too wide", why, "narrow it", place))
    return counts


def find_requirements(
    train: Train, state: str | None, domains: Domains, tolerance: Fraction | None
) -> TrainRequirements:
    """All requirements on the outputs, in one state or in all of them."""
    train.check_state(state)
    states: Sequence[str | None] = tuple(train.states) or (None,) if state is None else (state,)
    askings: list[OutputRequirement] = []
    conditions: dict[IntervalConstraint, None] = {}
    remarks: list[str] = []
    for one in states:
        prefix = f"{one}: " if len(states) > 1 else ""
        case, formulas = train.case(one), find_formulas(train, one, domains)
        conditions |= dict.fromkeys(find_turning_conditions(train, formulas))
        for asking in find_output_requirements(train, case, formulas.outputs, tolerance):
            asking = OutputRequirement(prefix + asking.name, asking.function, asking.demands)
            if asking.function.wheels:
                askings.append(asking)
            else:
                remarks.extend(_idle(asking))
        remarks.extend(f"the inputs do not determine '{prefix}{name}'" for name in formulas.undetermined)
    return TrainRequirements(tuple(askings), tuple(conditions), tuple(remarks))


def _idle(asking: OutputRequirement) -> Iterator[str]:
    """A remark on an output that no free wheel moves, if it is not as it should be."""
    speed = asking.function.value({})
    if speed is not None:
        reached = asking.reached(speed)
        if not reached.met:
            said = f"its speed is {speed}, {decimal(reached.error, 3)} off ({reached.label})"
            yield f"no free wheel moves '{asking.name}', which is not as asked: {said}"


def find_parts(demands: TrainRequirements, domains: Domains, rules: Sequence[CountConstraint]) -> Iterator[SearchPart]:
    """The wheels parted by what joins them, in the order declared; idle wheels are parts by themselves."""
    scopes = chain(
        (asking.function.wheels for asking in demands.askings),
        (condition.function.wheels for condition in demands.conditions),
        (rule.wheels for rule in rules),
    )
    for wheels in joined_groups(domains, scopes):
        group = set(wheels)
        yield SearchPart(
            {wheel: domains[wheel] for wheel in wheels},
            tuple(asking for asking in demands.askings if not group.isdisjoint(asking.function.wheels)),
            tuple(one for one in demands.conditions if not group.isdisjoint(one.function.wheels)),
            tuple(rule for rule in rules if not group.isdisjoint(rule.wheels)),
        )
