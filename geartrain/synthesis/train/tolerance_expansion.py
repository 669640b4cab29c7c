"""How far to look: a tolerance that holds the best assignments asked for, and not too many to list."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from math import ceil, prod, sqrt

from geartrain.numerics.exact import log10
from geartrain.synthesis.train.search_passes import PartSearch, PassResult, size_of
from geartrain.synthesis.train.train_findings import Assignment

_LISTED = 100_000
"""Assignments that are brought out to find the best few by error; more are narrowed down first."""
_TRIES = 40  # passes with one tolerance after the other
_LEAST = Fraction(1, 10**40)  # tolerances past these hold nothing, or all there is
_WIDEST = Fraction(10**6)


def solve(search: PartSearch) -> tuple[PassResult, tuple[Assignment, ...], bool]:
    """The pass that counts, the best assignments, and whether they are shown to be the best."""
    if any(asking.approached for asking in search.part.askings):
        passed = widened(search)
        return passed, passed.tally.best, passed.tally.listed and passed.complete
    by_error = search.order.by == "error" and not search.order.level
    passed = search.run(None, _most(search) if by_error else search.limit / 8)
    if passed.tally.listed or not passed.complete:
        return passed, passed.tally.best, passed.tally.listed and passed.complete
    top, some = _top(search), ceil(sqrt(search.order.best * _most(search)))
    guess = top * Fraction(some, passed.tally.count) if _powers(search) == 1 else top / 10
    narrowed = _fitting(search, guess, top, some)
    return passed, narrowed.tally.best, by_error and narrowed.tally.listed and narrowed.complete


def widened(search: PartSearch) -> PassResult:
    """A pass with a tolerance that holds as many assignments as are wanted, or all there are."""
    return _fitting(search, _first(search), None, 3 * search.order.best)


def _fitting(search: PartSearch, guess: Fraction, long: Fraction | None, some: int) -> PassResult:
    """A pass with a tolerance in which enough lie, all of them listed.

    long   a tolerance that holds too many to list; None if none is known
    some   how many it should hold, about
    Where no tolerance will do, because too many have one error, the pass lists what it can in its time.
    """
    short = Fraction(0)
    for _ in range(_TRIES):
        share = _rounded(guess)
        if share < _LEAST or share > _WIDEST or (long is not None and not short < share < long):
            break
        passed = search.run(share, _most(search))
        enough = passed.tally.count >= search.order.best
        if not passed.complete or (enough and passed.tally.listed):
            return passed
        if enough:
            long = share
            guess = long / 8
        else:
            short = share
            guess = share * _growth(search, passed.tally.count, some)
        if short and long is not None:
            # between too few and too many, halved in logarithms
            guess = Fraction(10 ** ((log10(short) + log10(long)) / 2))
    if long is None:
        return search.run(None, search.limit / 8)
    return search.run(long if short else Fraction(0), search.limit / 8)


def _most(search: PartSearch) -> int:
    """How many assignments are brought out at most to find the best by error."""
    return max(_LISTED, 4 * search.order.best)


def _powers(search: PartSearch) -> int:
    """How many outputs have an error to narrow."""
    return sum(not asking.exact for asking in search.part.askings)


def _first(search: PartSearch) -> Fraction:
    """The tolerance in which about as many lie as are wanted."""
    trial = Fraction(1, 1000)
    # hits grow as the tolerance to the power of the outputs that have an error
    hits = size_of(search.domains) * prod(search.chances(search.asked(trial)).values())
    # 1e-300: a forecast may be so small that it is 0 in float64
    guess = float(trial) * (3 * search.order.best / max(hits, 1e-300)) ** (1 / max(_powers(search), 1))
    return Fraction(min(max(guess, 1e-12), 1.0))


def _growth(search: PartSearch, count: int, some: int) -> Fraction:
    """By how much to widen when only `count` were found."""
    # nothing found: as wide a step as is taken
    missing = some / count if count else 1e9
    return Fraction(min(10.0, max(1.5, missing ** (1 / max(_powers(search), 1)))))


def _rounded(share: Fraction) -> Fraction:
    """To two digits, so that it can be said in words."""
    return Fraction(f"{float(share):.1e}")


def _top(search: PartSearch) -> Fraction:
    """No solution has a larger error than this."""
    largest = Fraction(0)
    for asking in search.part.askings:
        asked = asking.asked(None)
        for interval in asked.intervals if asked else ():
            for end in interval:
                errors = [abs(one.error(end)) for one in asking.demands if one.graded and end is not None]
                largest = max([largest, *errors])
    return largest or Fraction(1)


def relaxed_search(search: PartSearch) -> PartSearch:
    """The same search with every graded demand approached: what comes nearest."""
    askings = tuple(
        replace(asking, demands=tuple(one.loosened() if one.graded else one for one in asking.demands))
        for asking in search.part.askings
    )
    part = replace(search.part, askings=askings)
    order = replace(search.order, by="error", best=1, askings=askings)
    return PartSearch(part, order, search.runner, search.limit)
