"""A pass of a search cut into tasks that have nothing to do with each other."""

from __future__ import annotations

import random
from collections.abc import Sequence
from math import ceil, prod
from typing import Any

from geartrain.synthesis.trains.bundles import quotients
from geartrain.synthesis.trains.plans import Node, Question

Task = dict[str, Any]
"""As `merging.do_task` takes it."""

_SMALL = 3e6
"""Steps below which a pass is one task: about a second."""
_MOST_TASKS = 100_000
_SAMPLED = 16
"""Tasks of a sample."""


def cut(question: Question, limit: float) -> tuple[list[Task], float]:
    """A pass cut into tasks, and the part of it they are: less than 1 where all would pass the limit.

    Tasks are runs of the values of the first item, and of the next one below where the first has few. A sample is
    drawn always alike.
    """
    if question.steps <= _SMALL <= limit:
        return [{"parts": [[question.plan.item, 0, 1]], "budget": limit, "pieces": 1}], 1.0
    sampled = question.steps > limit
    wanted = question.steps * _SAMPLED / limit if sampled else question.steps / _SMALL
    chain = _chain(question, min(wanted, _MOST_TASKS))
    number = prod(of for _, of in chain)
    budget = 2 * limit / _SAMPLED if sampled else limit
    chosen: Sequence[int] = range(number)
    if sampled and number > _SAMPLED:
        chosen = sorted(random.Random(0).sample(range(number), _SAMPLED))
    tasks = [{"parts": _digits(at, chain), "budget": budget, "pieces": 16} for at in chosen]
    return tasks, len(tasks) / number if sampled else 1.0


def _chain(question: Question, wanted: float) -> list[tuple[int, int]]:
    """Items from the root down, each with the number of runs its values are cut into; about `wanted` together."""
    node: Node | None = question.plan
    found: list[tuple[int, int]] = []
    while node is not None and (wanted > 1 or not found):
        recipe = question.recipes[node.item]
        runs = int(min(max(ceil(wanted), 1), quotients(recipe.top, recipe.bottom, question.domains)))
        found.append((node.item, runs))
        wanted /= runs
        node = node.children[0] if len(node.children) == 1 and len(found) < 2 else None
    return found


def _digits(number: int, chain: Sequence[tuple[int, int]]) -> list[list[int]]:
    parts = []
    for item, of in chain:
        number, at = divmod(number, of)
        parts.append([item, at, of])
    return parts
