"""How an arbor at which paths part shares out its dials: which it shows, and which each of its wheels leads to."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import reduce
from itertools import combinations, product
from operator import or_

from geartrain.synthesis.reconstruction.arbor_passes import ArborPass
from geartrain.synthesis.reconstruction.skeletons import Dials

HERE = "="
IDLER = "~"
BESIDE = "+"
"""Ways on from an arbor, beside the names of its surviving wheels: its own dial, its driven wheel, an added one."""

Block = tuple[str, Dials]
"""A way on from an arbor, and the dials to which it leads."""


def way_on(each: ArborPass) -> str:
    """The way on that a path takes from an arbor."""
    if each.driver is None:
        return HERE
    if each.idler:
        return IDLER
    return BESIDE if each.driver.name is None else each.driver.name


def shared_out(
    dials: Dials, ways: Mapping[str, tuple[str, ...]], arbors: Mapping[str, int]
) -> Iterator[tuple[Dials, tuple[Block, ...]]]:
    """Each way in which an arbor shows some of the dials and leads to the others; by added wheels to blocks of them.

    arbors   by dial bits of the surviving arbors on its path: dials with one in common stay together
    """
    for chosen in product(*(ways[dial] for dial in dials)):
        by_way: dict[str, list[str]] = {}
        for dial, way in zip(dials, chosen, strict=True):
            by_way.setdefault(way, []).append(dial)
        named = tuple((way, tuple(block)) for way, block in by_way.items() if way not in (HERE, BESIDE))
        for blocks in partitions(tuple(by_way.get(BESIDE, ())), arbors):
            yield tuple(by_way.get(HERE, ())), (*named, *((BESIDE, block) for block in blocks))


def partitions(dials: Dials, arbors: Mapping[str, int]) -> Iterator[tuple[Dials, ...]]:
    """Each way to part dials into blocks with no surviving arbor in common, the first of them in the first block."""
    place = {dial: at for at, dial in enumerate(dials)}
    for blocks in _parted(_together(dials, arbors)):
        yield tuple(
            tuple(sorted((dial for group in block for dial in group), key=place.__getitem__)) for block in blocks
        )


def _together(dials: Dials, arbors: Mapping[str, int]) -> tuple[Dials, ...]:
    """Dials in groups, by what they and others between them have in common."""
    groups: list[tuple[int, Dials]] = []
    for dial in dials:
        joined = [group for group in groups if group[0] & arbors[dial]]
        groups = [group for group in groups if not group[0] & arbors[dial]]
        bits = reduce(or_, (own for own, _ in joined), arbors[dial])
        groups.append((bits, (*(one for _, group in joined for one in group), dial)))
    first = dials.index
    return tuple(sorted((group for _, group in groups), key=lambda group: min(map(first, group))))


def _parted(groups: tuple[Dials, ...]) -> Iterator[tuple[tuple[Dials, ...], ...]]:
    if not groups:
        yield ()
        return
    for size in range(len(groups)):
        for others in combinations(groups[1:], size):
            rest = tuple(group for group in groups[1:] if group not in others)
            for blocks in _parted(rest):
                yield ((groups[0], *others), *blocks)
