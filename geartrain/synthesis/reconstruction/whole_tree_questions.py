"""Which questions are answered by a search of whole trees."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from geartrain.synthesis.reconstruction.prime_shares import MOST_POWER
from geartrain.synthesis.reconstruction.quotient_keys import prime_powers
from geartrain.synthesis.reconstruction.reconstruction_problem import ReconstructionProblem

_MOST_DIALS = 6
"""Dials whose sets are bits of a whole number."""


def are_whole_trees_asked(problem: ReconstructionProblem) -> bool:
    """Whether a question may be answered so: nothing of `whole_tree_obstacles` is there."""
    return not any(whole_tree_obstacles(problem))


def whole_tree_obstacles(problem: ReconstructionProblem) -> Iterator[str]:
    """Why a question is answered by lists of paths instead.

    Where meshes of most arbors were seen, few paths are left to each dial.
    """
    if not all(dial.is_exact and dial.least for dial in problem.dials):
        yield "tolerances"
    if not 0 < len(problem.dials) <= _MOST_DIALS:
        yield f"{len(problem.dials)} dials"
    if problem.idlers:
        yield "idlers"
    if problem.rings:
        yield "rings"
    if not all(arbor.wheels for arbor in (problem.input, *problem.arbors)):
        yield "arbors without wheels"
    if 2 * len(problem.meshes) > len(problem.arbors):
        yield "meshes that were seen"
    # with a tolerance there is no one speed of which to take primes
    if all(dial.is_exact for dial in problem.dials) and _most_powers(problem) > MOST_POWER:
        yield "high powers of primes"


def _most_powers(problem: ReconstructionProblem) -> int:
    """The greatest power of a large prime that there might be in what is to be added."""
    found = Counter[int]()
    limit = problem.additions.greatest
    for arbor in (problem.input, *problem.arbors):
        for wheel in arbor.wheels:
            found += _most({count for count, _ in wheel.counts}, limit)
    speeds = {part for dial in problem.dials for part in (dial.least / problem.input_speed).as_integer_ratio()}
    found += _most({abs(part) for part in speeds}, limit)
    return max(found.values(), default=0)


def _most(numbers: set[int], limit: int) -> Counter[int]:
    """The greatest power of each large prime in one of some numbers."""
    found = Counter[int]()
    for number in numbers:
        found |= Counter({prime: power for prime, power in prime_powers(number) if prime * prime > limit})
    return found
