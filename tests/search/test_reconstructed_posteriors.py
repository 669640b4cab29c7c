"""A question of `reconstruct` whose graph is fixed is one of `posterior`: both give the same fractions.

What one finds by quotients of added wheels, exact cover and inclusion and exclusion, the other finds by the exact join
of a declared train with counts in doubt. Neither knows the other.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from math import prod
from typing import Any

import pytest
from concrete_trees import concrete, declared, plain_prior, random_problem
from sampling import first_few

from geartrain import GearTrain
from geartrain.search import ToothCountPosterior, infer_counts
from geartrain.search.reconstruct import PriorFactors, ReconstructionProblem, candidate_train, find_reconstructions
from geartrain.train import Train, declare

NO_FACTORS = PriorFactors(Fraction(1), Fraction(1), Fraction(1))


def graphs(problem: ReconstructionProblem) -> Iterator[list[tuple[Train, Fraction]]]:
    """All candidates of one graph and order, and their weights: they differ in counts alone."""
    evidence, found = declared(problem), defaultdict(list)
    for one in find_reconstructions(problem, listed=20_000).candidates:
        train = candidate_train(evidence, one.arbor, "fixed")
        pairs = (*(gear.pair for gear in train.gears), *(output.of for output in train.outputs.values()))
        found[pairs].append((train, plain_prior(concrete(one.arbor), problem)))
    yield from found.values()


def with_doubts(problem: ReconstructionProblem, train: Train) -> Train:
    """A candidate in which every added count may be any that may be added, and every dial has a target."""
    data: dict[str, Any] = train.model_dump(mode="json", exclude_unset=True, by_alias=True)
    speeds = GearTrain(train).solve()
    meshing = {wheel for gear in train.gears for wheel in gear.pair}
    for link in data["links"].values():
        for name, wheel in link.get("wheels", {}).items():
            value = train.wheels[name][1].count
            if name not in meshing:
                wheel["teeth"] = value
            elif "note" in wheel:
                wheel["teeth"] = {"value": value, "range": [problem.additions.minimum, problem.additions.maximum]}
    for dial in problem.dials:
        target = _target(dial.minimum, dial.maximum, Fraction(speeds.outputs[dial.name].speed))
        data["outputs"][dial.name] = {"of": train.outputs[dial.name].of, "targets": [target]}
    return declare(data)


def _target(minimum: Fraction, maximum: Fraction, speed: Fraction) -> dict[str, str]:
    middle = abs(minimum + maximum) / 2
    share = (maximum - minimum) / 2 / middle
    return {"speed": str(middle if speed > 0 else -middle), "tolerance": str(share)}


def _chances(found: ToothCountPosterior, wheel: str) -> dict[int, Fraction | float]:
    pairs = zip(found[wheel].uncertainty.counts, found[wheel].probabilities, strict=True)
    return {count: chance.value for count, chance in pairs if chance.value}


@pytest.mark.parametrize("first", first_few(1, [430, 400]))
def test_both_commands_give_the_same_fractions(first: int) -> None:
    requested = compared = 0
    for seed in range(first, first + 30):
        problem = replace(random_problem(seed, idlers=True), factors=NO_FACTORS)
        readings = {wheel.name: wheel for arbor in (problem.input, *problem.arbors) for wheel in arbor.wheels}
        for _, trains in zip(range(6), graphs(problem), strict=False):
            train = trains[0][0]
            wheels = {wheel for gear in train.gears for wheel in gear.pair}
            doubtful = [name for name in wheels if name not in readings or not readings[name].is_sure]
            if not doubtful:
                continue
            found = infer_counts(with_doubts(problem, train), method="exact")
            assert (found.method, found.fits) == ("exact", len(trains))
            whole = prod(sum(weight for _, weight in readings[name].counts) for name in wheels & readings.keys())
            total = sum(weight for _, weight in trains)
            assert found.evidence.exact == total / whole
            for name in doubtful:
                shares: dict[int, Fraction] = defaultdict(Fraction)
                for one, weight in trains:
                    shares[one.wheels[name][1].count] += weight / total
                assert _chances(found, name) == shares
                compared += 1
            requested += 1
    assert requested > 40
    assert compared > 60
