"""Counts of two wheels together: how likely each two of them are once the outputs have spoken."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from geartrain.uncertainty.counts.result import CountSweep

Again = Callable[[Mapping[str, Sequence[int]]], CountSweep]
Pairs = dict[tuple[str, str], dict[tuple[int, int], float]]


def telling(found: CountSweep, most: int = 6) -> list[str]:
    """The wheels of which the outputs tell most, in the order declared; those with one count possible say nothing."""
    heard = [wheel for wheel, each in found.posteriors.items() if not each.idle and len(each.doubt.counts) > 1]
    kept = set(sorted(heard, key=lambda wheel: -found[wheel].bits)[:most])
    return [wheel for wheel in heard if wheel in kept]


def joint(found: CountSweep, wheels: Sequence[str], again: Again) -> Pairs:
    """The chance of every two counts of every two of some wheels.

    again   sweeps the same train for the same evidence, with some wheels held to the counts given

    Each is the chance of the one times that of the other where the one is held: one more sweep for each count that is
    possible, of every wheel but the last. As exact as the sweeps.
    """
    pairs: Pairs = {(a, b): {} for at, a in enumerate(wheels) for b in wheels[at + 1 :]}
    for at, wheel in enumerate(wheels[:-1]):
        for count, chance in zip(found[wheel].doubt.counts, found[wheel].chances, strict=False):
            if not float(chance):
                continue
            held = again({wheel: [count]})
            for other in wheels[at + 1 :]:
                after = held[other]
                for its, likely in zip(after.doubt.counts, after.chances, strict=False):
                    if float(likely):
                        pairs[wheel, other][count, its] = float(chance) * float(likely)
    return pairs
