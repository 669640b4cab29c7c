"""How an arbor at which paths part shares out its dials: which it shows, and which each of its wheels leads to."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations, product
from typing import NamedTuple

from geartrain.synthesis.reconstruction.arbor_passes import ArborPass
from geartrain.synthesis.reconstruction.reconstruction_problem import PlacedWheel
from geartrain.synthesis.reconstruction.skeletons import Dials

HERE = "="
IDLER = "~"
BESIDE = "+"
"""Ways on from an arbor, beside the names of its surviving wheels: its own dial, its driven wheel, an added one."""


class JointPlace(NamedTuple):
    """An arbor at which paths part: its number, -1 for an added one, its name, and the wheel that is driven.

    ways   by dial and way on, the codes of the paths that take it
    """

    at: int
    name: str | None
    driven: PlacedWheel | None
    ways: dict[str, dict[str, list[int]]]


Block = tuple[str, Dials]
"""A way on from an arbor, and the dials to which it leads."""


def codes_by_way(passes: Sequence[ArborPass], codes: Sequence[int]) -> dict[str, list[int]]:
    """Codes of ways through an arbor by the way on that they take."""
    found: dict[str, list[int]] = {}
    for code in codes:
        each = passes[code - 1]
        if each.driver is None:
            way = HERE
        elif each.idler:
            way = IDLER
        else:
            way = BESIDE if each.driver.name is None else each.driver.name
        found.setdefault(way, []).append(code)
    return found


def shared_out(
    dials: Dials, ways: dict[str, dict[str, list[int]]], must: Sequence[str]
) -> Iterator[tuple[Dials, tuple[Block, ...]]]:
    """Each way in which an arbor shows some of the dials and leads to the others; by added wheels to blocks of them.

    must   surviving wheels each of which leads to some
    """
    for chosen in product(*(ways[dial] for dial in dials)):
        if not set(must) <= set(chosen):
            continue
        by_way: dict[str, list[str]] = {}
        for dial, way in zip(dials, chosen, strict=True):
            by_way.setdefault(way, []).append(dial)
        named = tuple((way, tuple(block)) for way, block in by_way.items() if way not in (HERE, BESIDE))
        for blocks in partitions(tuple(by_way.get(BESIDE, ()))):
            yield tuple(by_way.get(HERE, ())), (*named, *((BESIDE, block) for block in blocks))


def partitions(dials: Dials) -> Iterator[tuple[Dials, ...]]:
    """Each way to part dials into blocks, the first of them in the first block."""
    if not dials:
        yield ()
        return
    for size in range(len(dials)):
        for others in combinations(dials[1:], size):
            rest = tuple(dial for dial in dials[1:] if dial not in others)
            for blocks in partitions(rest):
                yield ((dials[0], *others), *blocks)
