"""A thousand random trains against the oracle in joint rates; more with `--trains 100000`, others with `--first-train`.

A failure names the seed: `pytest tests/kinematics/test_random_trains.py --trains 1 --first-train SEED`.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from typing import Any

from joint_rates import TURNS_A_SECOND, Motion, move
from random_trains import RandomTrain, driven_train, random_train

from geartrain import GearTrain, GearTrainError
from geartrain.kinematics import Answer
from geartrain.kinematics.speeds import exact_verdict


@lru_cache(maxsize=1000)
def moving(seed: int) -> tuple[RandomTrain, dict[str | None, Motion]]:
    """A random train and how it moves in each of its states, by the oracle: once for all laws."""
    train = random_train(seed)
    return train, motions_of(train)


def motions_of(train: RandomTrain) -> dict[str | None, Motion]:
    return {state: move(train, state) for state in train.states}


def told(train: RandomTrain, motion: Motion, answer: Answer) -> str:
    """What an answer says of its links that is not so; empty where all is well."""
    if answer.verdict.kind != motion.kind:
        return f"seed {train.seed} {answer.state}: {answer.verdict} is {motion.kind}"
    if motion.kind not in ("determined", "free"):
        return ""
    scale = TURNS_A_SECOND[answer.unit] if answer.unit else 1
    for link in filter(motion.is_rotation, train.data["links"]):
        speed, right = answer.speeds.get(link), motion.speed(link)
        if (None if speed is None else speed * scale) != right:
            return f"seed {train.seed} {answer.state}: {link} turns {right} and is said to turn {speed} {answer.unit}"
    return ""


def unlike(train: RandomTrain, motion: Motion, requested: GearTrain, full: Answer) -> Iterator[str]:
    """Outputs and links that are told one way when all is solved, and another when they alone are asked for."""
    for name in [*train.data["outputs"], *train.data["links"]]:
        one = requested.solve(full.state, output=name)
        speed, alone = (told_speed(answer, name) for answer in (full, one))
        kind = full.verdict.kind if full.verdict.kind != "free" or speed is None else "determined"
        if (speed, kind) != (alone, one.verdict.kind):
            yield f"seed {train.seed} {full.state}: '{name}' is {speed}, {kind}, and alone {alone}, {one.verdict}"
        output = full.outputs.get(name)
        if output is None or not motion.is_rotation(output.of, output.relative_to):
            continue
        scale = TURNS_A_SECOND[full.unit] if full.unit else 1
        right = motion.speed(output.of, output.relative_to) if motion.space.consistent else None
        if (None if speed is None else speed * scale) != right:
            yield f"seed {train.seed} {full.state}: '{name}' turns {right} and is said to turn {speed} {full.unit}"


def told_speed(answer: Answer, name: str) -> Any:
    return answer.outputs[name].speed if name in answer.outputs else answer.speeds.get(name)


def judged(train: RandomTrain, motions: dict[str | None, Motion]) -> list[str]:
    """What is wrong about one train in its states; a state with a linkage must be refused, and no other."""
    refused = all(motion.kind == "refused" for motion in motions.values())
    try:
        answers = list(GearTrain.declare(train.data).answers())
    except GearTrainError as error:
        return [] if refused and "linkage" in str(error) else [f"seed {train.seed} is refused: {error}"]
    if refused:
        return [f"seed {train.seed} has a linkage, and is answered"]
    return [said for answer in answers if (said := told(train, motions[answer.state], answer))]


def test_random_trains_do_what_their_joints_do(seeds: range) -> None:
    assert not [said for seed in seeds for said in judged(*moving(seed))]


def test_an_output_requested_for_alone_is_what_it_is_among_all(seeds: range) -> None:
    wrong = []
    for seed in seeds[:: max(1, len(seeds) // 700)]:
        train, motions = moving(seed)
        if any(motion.kind == "refused" for motion in motions.values()):
            continue
        requested = GearTrain.declare(train.data)
        for full in requested.answers():
            wrong += unlike(train, motions[full.state], requested, full)
    assert not wrong


def test_floats_know_what_fractions_know() -> None:
    for seed in range(150):
        train, motions = moving(seed)
        if any(motion.kind == "refused" for motion in motions.values()):
            continue
        requested = GearTrain.declare(train.data)
        for exact in requested.answers():
            floats = requested.solve(exact.state, method="floats")
            assert (floats.verdict.kind, set(floats.speeds)) == (exact.verdict.kind, set(exact.speeds)), seed
            for name, result in exact.outputs.items():
                near = floats.outputs[name].speed
                assert (near is None) == (result.speed is None), (seed, name)
                assert near is None or abs(near - result.speed) <= 1e-9 * max(1, abs(result.speed)), (seed, name)


def test_the_verdict_modulo_a_prime_is_that_of_fractions() -> None:
    for seed in range(400):
        train, motions = moving(seed)
        if any(motion.kind == "refused" for motion in motions.values()):
            continue
        requested = GearTrain.declare(train.data)
        reduced = requested.kinematics.whole.reduced
        for answer in requested.answers():
            verdict = exact_verdict(reduced, requested.kinematics.cases[answer.state], requested.kinematics.signs)
            assert verdict.kind == answer.verdict.kind, (seed, answer.state)


def test_the_random_trains_are_of_every_kind() -> None:
    moved = [moving(seed) for seed in range(400)]
    kinds = [motion.kind for _, motions in moved for motion in motions.values()]
    trains = [train for train, _ in moved]
    assert min(kinds.count(kind) for kind in ("determined", "free", "locked")) > 50
    assert min(kinds.count(kind) for kind in ("contradictory", "refused")) > 0
    data = [train.data for train in trains]
    assert any(any("bevel" in str(part) for part in each["links"].values()) for each in data)
    assert any(len({text.split(" ")[-1] for text in each["inputs"].values()}) > 1 for each in data)
    assert all(any(each.get(key) for each in data) for key in ("axes", "couplings", "clutches", "fixed", "locks"))


def test_driven_trains_turn_as_their_joints_do(seeds: range) -> None:
    trains = map(driven_train, seeds[:: max(1, len(seeds) // 300)])
    assert not [said for train in trains for said in judged(train, motions_of(train))]
