"""How an arbor at which paths part shares out its dials: which it shows, and which each of its wheels leads to."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations, product

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


def shared_out(dials: Dials, ways: Mapping[str, tuple[str, ...]]) -> Iterator[tuple[Dials, tuple[Block, ...]]]:
    """Each way in which an arbor shows some of the dials and leads to the others; by added wheels to blocks of them."""
    for chosen in product(*(ways[dial] for dial in dials)):
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
