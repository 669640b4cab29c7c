"""The joint posterior of two wheels at a time, for a picture of those of which the outputs tell most."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from geartrain.uncertainty.posterior.posterior_result import ToothCountPosterior

Again = Callable[[Mapping[str, Sequence[int]]], ToothCountPosterior]
Pairs = dict[tuple[str, str], dict[tuple[int, int], float]]


def most_informative_wheels(found: ToothCountPosterior, most: int = 6) -> list[str]:
    """The wheels of which the outputs tell most, in the order declared; those with one count possible say nothing."""
    heard = [wheel for wheel, each in found.posteriors.items() if not each.idle and len(each.doubt.counts) > 1]
    kept = set(sorted(heard, key=lambda wheel: -found[wheel].bits)[:most])
    return [wheel for wheel in heard if wheel in kept]


def joint_posterior(found: ToothCountPosterior, wheels: Sequence[str], again: Again) -> Pairs:
    """The joint posterior of every two of some wheels, by the chain rule p(a, b) = p(a) p(b | a).

    again   the posterior of the same train for the same evidence, with some wheels held to the counts given

    One more posterior for each count that is possible, of every wheel but the last; as exact as they are.
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
