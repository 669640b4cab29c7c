"""Levels on which the axes of a skeleton lie, so that little crosses and nothing hides another thing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from geartrain.plot.arranging import neighbours

_NEAREST = 9  # levels tried for an axis


@dataclass(slots=True)
class Shaft:
    """A link on its axis: height, ends and whether the frame bears it; the frame itself has none."""

    link: str
    axis: str
    y: float = 0.0
    xs: list[float] = field(default_factory=list)


def find_levels(
    order: Sequence[str], shafts: dict[str, Shaft], spans: Sequence[tuple[str, str, float]]
) -> list[list[str]]:
    """Axes on common levels, from below, where they leave each other room.

    spans   uprights between two axes, at their column. One axis after the other takes the level nearest to those it
            is joined to, at which least is crossed.
    """
    ends = {axis: _ends(axis, shafts) for axis in order}
    level: dict[str, int] = {}
    for axis in _walk(order, [(one, other) for one, other, _ in spans]):
        near = [level[mate] for one, other, _ in spans for mate in _mate(axis, one, other) if mate in level]
        middle = round(sum(near) / len(near)) if near else 0
        trials = [
            middle + step for step in sorted(range(-len(order), len(order) + 1), key=lambda step: (abs(step), step))
        ]
        free = [each for each in trials if each not in near and _fits(axis, each, level, ends)]
        level[axis] = min(free[:_NEAREST], key=lambda each: _cost(axis, each, level, ends, spans))
    levels = sorted(set(level.values()))
    return [[axis for axis in order if level[axis] == each] for each in levels]


def _mate(axis: str, one: str, other: str) -> list[str]:
    return [other] if axis == one else [one] if axis == other else []


def _ends(axis: str, shafts: dict[str, Shaft]) -> tuple[float, float]:
    """What an axis takes of its level, with the names before and after it."""
    own = [shaft for shaft in shafts.values() if shaft.axis == axis]
    left = min(min(shaft.xs) - 0.25 - 0.085 * len(shaft.link) for shaft in own)
    return left, max(max(shaft.xs) for shaft in own) + 0.35 + 0.065 * len(axis)


def _fits(axis: str, here: int, level: dict[str, int], ends: dict[str, tuple[float, float]]) -> bool:
    left, right = ends[axis]
    return all(right < ends[other][0] or ends[other][1] < left for other, each in level.items() if each == here)


def _cost(
    axis: str,
    here: int,
    level: dict[str, int],
    ends: dict[str, tuple[float, float]],
    spans: Sequence[tuple[str, str, float]],
) -> float:
    """Lengths of the axis' own uprights, and what crosses what; uprights on each other are worst."""
    cost = 0.3 * abs(here)
    placed = {**level, axis: here}
    known = [(*sorted((placed[one], placed[other])), x, axis in (one, other)) for one, other, x in spans
             if one in placed and other in placed]  # fmt: skip
    for low, high, x, own in known:
        if own:
            cost += high - low
            cost += 2 * sum(low < each < high and ends[other][0] < x < ends[other][1] for other, each in level.items())
            cost += 20 * sum(x == at and low < top and bottom < high for bottom, top, at, mine in known if not mine)
        else:
            cost += 2 * (low < here < high and ends[axis][0] < x < ends[axis][1])
    return cost


def _walk(order: Sequence[str], pairs: Sequence[tuple[str, str]]) -> list[str]:
    """The axes from the one with most mates on, each after one it is joined to."""
    mates = neighbours(order, pairs)
    seen: dict[str, None] = {}
    for start in sorted(order, key=lambda axis: -len(set(mates[axis]))):
        queue = [start]
        while queue:
            here = queue.pop(0)
            if here not in seen:
                seen[here] = None
                queue += [mate for mate in mates[here] if mate not in seen]
    return list(seen)
