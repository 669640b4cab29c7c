"""Why a search found little: where the assignments went, what comes nearest, and what to relax."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from math import ceil, floor

from geartrain.numerics.bounded_polynomials import WholeTerm
from geartrain.numerics.decimal_text import decimal
from geartrain.numerics.exact import log10
from geartrain.synthesis.join.wheel_monomials import Interval
from geartrain.synthesis.search_outcome import Shortfall
from geartrain.synthesis.train.output_requirements import OutputRequirement
from geartrain.synthesis.train.search_passes import PartSearch, PassResult, size_of
from geartrain.synthesis.train.tolerance_expansion import relaxed_search, widened
from geartrain.synthesis.train.train_findings import Assignment


def find_shortfall(search: PartSearch, passed: PassResult) -> Shortfall:
    """The tallies of a pass; where nothing was found, also the nearest miss and what would help."""
    found = tallied(search, passed)
    if passed.tally.count or not passed.complete:
        return found
    # an explanation must not cost more than the answer
    nearest, advice = _explained(PartSearch(search.part, search.order, search.runner, search.limit / 4))
    return found if search.runner.stopped else replace(found, nearest=nearest, advice=advice)


def tallied(search: PartSearch, passed: PassResult) -> Shortfall:
    """How many assignments each rule and demand refused, in the order in which they were decided."""
    removed = dict(search.alone)
    for reason, number in passed.removed.items():
        removed[reason] = removed.get(reason, 0) + number
    return Shortfall(search.part.considered, removed)


def _explained(search: PartSearch) -> tuple[str, str]:
    """The nearest miss in words, and what to relax."""
    wrong = [asking for asking in search.part.askings if _turns_wrong(asking)]
    if wrong:
        names = ", ".join(f"'{asking.name}'" for asking in wrong)
        return f"{names} turn in the other sense, whatever the counts", "change the sign asked for, or add an idler"
    best = _nearest(search)
    others = "; ".join(_without(search))
    if best is None:
        return "", others or "nothing asked is to blame alone: widen the ranges of the wheels"
    alone = "; ".join(_alone(search)) if len(search.part.askings) > 1 else ""
    nearest = f"{_teeth(best)}: {_errors(best)}" + (f" (alone, {alone})" if alone else "")
    advice = f"with a relative tolerance of {_up(best.error)} this one is in"
    return nearest, advice + (f"; {others}" if others else "")


def _turns_wrong(asking: OutputRequirement) -> bool:
    """True if a sense is asked for that no counts give."""
    asked = asking.asked(None)
    senses = [_sense(terms) for terms in (asking.function.numerator, asking.function.denominator)]
    if asked is None or not all(senses):
        return False
    lasting = senses[0] * senses[1]
    return bool(asked.intervals) and all(_against(interval, lasting) for interval in asked.intervals)


def _against(interval: Interval, sense: int) -> bool:
    """True if an interval has speeds of the other sense, and none of this one."""
    low, high = interval
    # an interval whose end is 0 is met by a standstill, so it is not of the other sense alone
    near, far = (high, low) if sense > 0 else (low, high)
    return near is not None and near * sense <= 0 and far != 0


def _sense(terms: Sequence[WholeTerm]) -> int:
    """1 or -1 where all terms have that sign, else 0."""
    signs = {term[0] > 0 for term in terms}
    return (1 if signs.pop() else -1) if len(signs) == 1 else 0


def _nearest(search: PartSearch) -> Assignment | None:
    """What comes nearest, with all rules kept; None if the rules leave nothing, or it cannot be found in time."""
    if not search.part.askings or not size_of(search.domains):
        return None
    best = widened(relaxed_search(search)).tally.best
    return search.order.assignment(best[0].teeth) if best else None


def _alone(search: PartSearch) -> Iterator[str]:
    """How near every output comes when the others are not asked."""
    for asking in search.part.askings:
        part = replace(search.part, askings=(asking,))
        order = replace(search.order, askings=(asking,))
        best = _nearest(PartSearch(part, order, search.runner, search.limit))
        if best is not None:
            yield f"{asking.name} comes to {decimal(best.error, 3)}"


def _without(search: PartSearch) -> Iterator[str]:
    """What there would be without one rule, or one output's demands, where there is more than one thing asked."""
    names = dict.fromkeys(rule.name for rule in search.part.rules)
    if len(names) + len(search.part.askings) < 2:
        return
    for name in names:
        passed = search.without(rule=name).run(None, 0)
        if passed.tally.count:
            yield f'without the rule "{name}" there {_are(passed)}'
    for asking in search.part.askings:
        passed = search.without(asking=asking).run(None, 0)
        if passed.tally.count:
            yield f"without what is asked of '{asking.name}' there {_are(passed)}"


def _are(passed: PassResult) -> str:
    count = passed.tally.count
    least = "" if passed.complete else "at least "
    return f"is {least}1" if count == 1 else f"are {least}{count}"


def _teeth(assignment: Assignment) -> str:
    return ", ".join(f"{wheel} {count}" for wheel, count in assignment.teeth.items())


def _errors(assignment: Assignment) -> str:
    return ", ".join(
        f"{name} {'meets' if reached.met else 'misses'} {reached.label} by {decimal(reached.error, 3)}"
        for name, reached in assignment.outputs.items()
    )


def _up(error: Fraction) -> str:
    """A size rounded up to two digits."""
    if not error:
        return "0"
    unit = Fraction(10) ** (floor(log10(error)) - 1)
    return decimal(ceil(error / unit) * unit, 2)
