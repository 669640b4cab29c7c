"""Posteriors of tooth counts of random trains, against enumeration with dense elimination over the rationals."""

from __future__ import annotations

from collections import defaultdict
from copy import deepcopy
from dataclasses import dataclass
from fractions import Fraction
from itertools import compress, count, islice, product
from math import exp, fsum, prod
from random import Random
from typing import Any

import networkx as nx
import pytest
from random_trains import driven_train
from reference_solver import rank_of, solve_naively, willis_rows

from geartrain import GearTrain
from geartrain.search import infer_counts

Data = dict[str, Any]
Priors = dict[str, dict[int, Fraction]]


def with_counts(data: Data, counts: dict[str, Any]) -> Data:
    """The declaration with other tooth counts, or with counts in doubt."""
    found = deepcopy(data)
    for link in found["links"].values():
        for name, wheel in (link or {}).get("wheels", {}).items():
            if name in counts:
                own = wheel if isinstance(wheel, dict) else {}
                link["wheels"][name] = {**own, "teeth": counts[name]}
    return found


def loops_close(data: Data) -> bool:
    """Whether all loops of pairs close, seen from their carriers; the rows of one that does not are independent."""
    rows, carriers = willis_rows(data)
    own: dict[str, list[dict[str, Fraction]]] = defaultdict(list)
    for row, carrier in zip(rows, carriers.values(), strict=True):
        own[carrier].append(row)
    for carrier, some in own.items():
        joined = nx.Graph([tuple(link for link in row if link != carrier) for row in some])
        if rank_of(some, list(data["links"])) != len(joined) - nx.number_connected_components(joined):
            return False
    return True


def random_priors(data: Data, random: Random) -> Priors:
    """Two or three wheels of a train, or its only one, with two to four counts of unequal probability."""
    teeth = {
        name: wheel if isinstance(wheel, int) else wheel["teeth"]
        for link in data["links"].values()
        for name, wheel in ((link or {}).get("wheels") or {}).items()
    }
    priors: Priors = {}
    for name in random.sample(sorted(teeth), min(len(teeth), random.randint(2, 3))):
        near = [each for each in range(max(teeth[name] - 2, 3), teeth[name] + 5) if each != teeth[name]]
        counts = sorted([teeth[name], *random.sample(near, random.randint(1, 3))])
        weights = [random.randint(1, 5) for _ in counts]
        priors[name] = {z: Fraction(each, sum(weights)) for z, each in zip(counts, weights, strict=True)}
    return priors


@dataclass(frozen=True)
class Case:
    """A train with counts in doubt and targets, and every combination of its counts.

    rows   counts, prior, and (error / tolerance) of each target; None where the train does not turn
    """

    data: Data
    priors: Priors
    rows: list[tuple[dict[str, int], Fraction, list[Fraction] | None]]

    @classmethod
    def of(cls, seed: int) -> Case | None:
        """A random one; None where no speed depends on a count in doubt."""
        random = Random(seed)
        data = driven_train(seed, most=5, oblique=False).data
        priors = random_priors(data, random)
        solved = []
        for counts in product(*priors.values()):
            chosen = dict(zip(priors, counts, strict=True))
            train = with_counts(data, chosen)
            found = solve_naively(train)
            solved.append((chosen, found.speeds if found.kind == "determined" and loops_close(train) else None))
        turning = [speeds for _, speeds in solved if speeds is not None]
        moved = [link for link in data["links"] if len({speeds[link] for speeds in turning} - {0}) > 1]
        if not moved:
            return None
        meant = random.choice(turning)
        targets = {
            link: (meant[link] * Fraction(random.randint(97, 103), 100), Fraction(random.randint(1, 12), 100))
            for link in random.sample(moved, min(len(moved), 2))
            if meant[link]
        }
        if not targets:
            return None
        doubts = {
            name: {
                "value": next(iter(prior)),
                "choices": list(prior),
                "weights": [str(each) for each in prior.values()],
            }
            for name, prior in priors.items()
        }
        outputs = {
            link: {"targets": [{"speed": str(speed), "tolerance": f"{100 * share} %"}]}
            for link, (speed, share) in targets.items()
        }
        rows = [
            (
                chosen,
                prod((priors[name][z] for name, z in chosen.items()), start=Fraction(1)),
                speeds and [(speeds[link] / speed - 1) / share for link, (speed, share) in targets.items()],
            )
            for chosen, speeds in solved
        ]
        return cls(with_counts(data, doubts) | {"outputs": outputs}, priors, rows)


def test_posterior_shares_of_50_random_trains_are_those_of_enumeration() -> None:
    decided = 0
    for case in islice(filter(None, map(Case.of, count())), 50):
        train = GearTrain.declare(case.data).declaration
        found, soft = (infer_counts(train, method="exact", soft=soft) for soft in (False, True))
        hard = [prior if errors and max(map(abs, errors)) <= 1 else Fraction(0) for _, prior, errors in case.rows]
        agree = [
            float(prior) * exp(-float(sum(each**2 for each in errors)) / 2)
            if errors and max(map(abs, errors)) <= 5
            else 0.0
            for _, prior, errors in case.rows
        ]
        assert found.combinations == len(case.rows)
        assert found.turning.value == sum(prior for _, prior, errors in case.rows if errors is not None)
        assert found.evidence.value == sum(hard)
        assert float(soft.evidence) == pytest.approx(fsum(agree), rel=1e-12)
        for name, prior in case.priors.items():
            for teeth in prior:
                own = [chosen[name] == teeth for chosen, _, _ in case.rows]
                if sum(hard):
                    share = sum(compress(hard, own), start=Fraction(0)) / sum(hard)
                    assert found[name].probability(teeth).value == share
                    decided += share != prior[teeth]
                if sum(agree):
                    share_by_degree = fsum(compress(agree, own)) / fsum(agree)
                    assert float(soft[name].probability(teeth)) == pytest.approx(share_by_degree, rel=1e-11, abs=1e-15)
    assert decided > 100, "targets decide among counts"
