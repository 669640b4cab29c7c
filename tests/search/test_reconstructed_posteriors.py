"""A question of `reconstruct` whose graph is fixed is one of `posterior`: both give the same fractions.

What one finds by quotients of added wheels, exact cover and inclusion and exclusion, the other finds by the exact join
of a declared train with counts in doubt. Neither knows the other.
"""

from __future__ import annotations

import re
from collections import defaultdict
from dataclasses import replace
from fractions import Fraction
from math import prod
from random import Random
from typing import Any

import pytest
from concrete_trees import random_problem
from sampling import first_few

from geartrain.search import ToothCountPosterior, infer_counts
from geartrain.search.reconstruct import PriorFactors, ReconstructionProblem, find_reconstructions
from geartrain.search.reconstruct.candidate_names import NamedArbor, NamedWheel, name_train
from geartrain.search.reconstruct.explained_facts import Fact, FactTally, sum_facts
from geartrain.search.reconstruct.reconstruction_search import topology_prior
from geartrain.search.reconstruct.search_tasks import CountedTopology, TopologyTrains
from geartrain.train import Train, declare

NO_FACTORS = PriorFactors(Fraction(1), Fraction(1), Fraction(1))


def graphs(problem: ReconstructionProblem) -> list[list[CountedTopology]]:
    """The topologies of each graph: one for each way to read the counts of its surviving wheels that fits."""
    found: dict[str, list[CountedTopology]] = defaultdict(list)
    for each in find_reconstructions(problem, listed=0).topologies:
        found[re.sub(r"teeth=\d+", "", repr(each.topology.root))].append(each)
    return list(found.values())


def declared(problem: ReconstructionProblem, root: NamedArbor) -> Train:
    """A train with the graph of a candidate, and every count as far as it was read, or may be added."""
    readings = {wheel.name: wheel.counts for arbor in (problem.input, *problem.arbors) for wheel in arbor.wheels}

    def teeth(wheel: NamedWheel) -> dict[str, Any]:
        if wheel.added:
            return {"value": wheel.teeth, "range": [problem.additions.minimum, problem.additions.maximum]}
        counts, weights = zip(*readings[wheel.name], strict=True)
        return {"value": wheel.teeth, "choices": list(counts), "weights": [str(weight) for weight in weights]}

    arbors, speeds = list(root.arbors()), {root.name: problem.input_speed}
    for driving, wheel, arbor in root.meshes():
        assert arbor.driven is not None
        speeds[arbor.name] = -speeds[driving.name] * Fraction(wheel.teeth, arbor.driven.teeth)
    shown = {dial: arbor.name for arbor in arbors for dial in arbor.dials}
    return declare(
        {
            "name": "fixed",
            "links": {
                "frame": {},
                **{one.name: {"wheels": {w.name: {"teeth": teeth(w)} for w in one.wheels()}} for one in arbors},
            },
            "revolutes": [{"pair": ["frame", one.name], "axis": one.name} for one in arbors],
            "gears": [{"pair": [wheel.name, one.driven.name]} for _, wheel, one in root.meshes() if one.driven],
            "inputs": {root.name: str(problem.input_speed)},
            "outputs": {
                dial.name: {"of": shown[dial.name], "targets": [_target(dial.minimum, dial.maximum, speed)]}
                for dial in problem.dials
                for speed in [speeds[shown[dial.name]]]
            },
        }
    )


def _target(minimum: Fraction, maximum: Fraction, speed: Fraction) -> dict[str, str]:
    middle = abs(minimum + maximum) / 2
    share = (maximum - minimum) / 2 / middle
    return {"speed": str(middle if speed > 0 else -middle), "tolerance": str(share)}


def _shares(tally: FactTally, fact: Fact) -> dict[str, Fraction]:
    return {one.answer: one.share for one in tally.marginal(fact).answers}


def _chances(found: ToothCountPosterior, wheel: str) -> dict[str, Fraction | float]:
    pairs = zip(found[wheel].uncertainty.counts, found[wheel].probabilities, strict=True)
    return {str(count): chance.value for count, chance in pairs if chance.value}


@pytest.mark.parametrize("first", first_few(2, [400, 430, 460, 490]))
def test_both_commands_give_the_same_fractions(first: int) -> None:
    requested = compared = 0
    for seed in range(first, first + 30):
        problem = replace(random_problem(seed, idlers=True), factors=NO_FACTORS)
        dials, survivors = [dial.name for dial in problem.dials], (problem.input, *problem.arbors)
        links, wheels = {arbor.name for arbor in survivors}, [wheel for arbor in survivors for wheel in arbor.wheels]
        for topologies in graphs(problem)[:6]:
            some = topologies[0]
            drawn = TopologyTrains(problem, dials).draw(some.topology, Random(seed))
            root = name_train(drawn, dials, links, {wheel.name for wheel in wheels})
            own = {wheel.name: wheel for arbor in root.arbors() for wheel in arbor.wheels()}
            used = [wheel for wheel in wheels if wheel.name in own]
            if all(wheel.is_sure for wheel in used) and not any(wheel.added for wheel in own.values()):
                continue  # nothing is in doubt
            found = infer_counts(declared(problem, root), method="exact")
            weighed = [(one.topology, topology_prior(one.topology, problem)) for one in topologies]
            tally = sum_facts(weighed, problem, dials)
            orders = some.solutions // some.choices
            assert (found.method, found.fits) == ("exact", sum(one.choices for one in topologies))
            assert tally.trains == orders * found.fits
            whole = prod(sum(weight for _, weight in wheel.counts) for wheel in used)
            weights = zip(weighed, topologies, strict=True)
            assert found.evidence.exact == sum(weight * one.choices for (_, weight), one in weights) / whole
            for wheel in used:
                if not wheel.is_sure:
                    assert _chances(found, wheel.name) == _shares(tally, Fact("count", wheel.name))
                    compared += 1
            # in other orders an added wheel of the same name may play another part
            for name in (wheel.name for wheel in own.values() if wheel.added and orders == 1):
                assert _chances(found, name) == _shares(tally, Fact("added", name))
                compared += 1
            requested += 1
    assert requested > 40
    assert compared > 60
