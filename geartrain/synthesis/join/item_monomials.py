"""Through which monomials of items some constraints see them: settings that agree in all of these are one.

Once x and y are set, an output that sees x y alone cannot tell 2 x 6 from 3 x 4; nor can all that is set below. The
rows of a join are merged so as soon as they may be (bucket elimination, Dechter 1999).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from geartrain.kinematics.formulas.monomial_groups import proportional_classes
from geartrain.synthesis.constraints.count_conditions import CountConstraint
from geartrain.synthesis.join.partial_assignments import ItemMonomial
from geartrain.synthesis.join.polynomial_constraints import PolynomialConstraint
from geartrain.synthesis.join.product_lists import Item

_LARGEST = 1 << 62  # products below this are exact in int64


def find_item_monomials(
    items: Sequence[int], constraints: Sequence[CountConstraint | PolynomialConstraint], lists: Sequence[Item]
) -> Iterator[ItemMonomial]:
    """The fewest monomials of some items that decide the constraints, each exact in int64; one that none sees is in
    none of them.

    Items belong together if their powers, counted from the first term of each polynomial and listed over all terms of
    all polynomials, are multiples of one list. Wheels of rules on counts stand by themselves.

    items   all that are set of the constraints' items
    lists   of every item
    """
    alone = {
        item
        for rule in constraints
        if not isinstance(rule, PolynomialConstraint)
        for item in items
        if not set(lists[item].recipe.wheels).isdisjoint(rule.wheels)
    }
    polynomials = [one for one in constraints if isinstance(one, PolynomialConstraint)]
    yield from (((item, 1),) for item in items if item in alone)
    steps = ((item, [step for one in polynomials for step in one.steps(item)]) for item in items if item not in alone)
    for group in proportional_classes(steps).values():
        yield from _cut(tuple(group.items()), lists)


def _cut(group: Sequence[tuple[int, int]], lists: Sequence[Item]) -> Iterator[ItemMonomial]:
    """A monomial cut where its values would not fit int64."""
    # cut greedily: what fits 2^62 above and below stays one monomial
    held: list[tuple[int, int]] = []
    largest = [1, 1]
    for item, power in group:
        own = lists[item]
        ends = int(own.tops.max()), 1 if own.bottoms is None else int(own.bottoms.max())
        sizes = [end ** abs(power) for end in (ends if power > 0 else ends[::-1])]
        grown = [one * size for one, size in zip(largest, sizes, strict=True)]
        if held and max(grown) >= _LARGEST:
            yield tuple(held)
            held, grown = [], sizes
        held.append((item, power))
        largest = grown
    if held:
        yield tuple(held)
