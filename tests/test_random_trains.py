"""A thousand random trains against the oracle in joint rates; more with `--trains 100000`, others with `--first-train`.

A failure names the seed: `pytest tests/test_random_trains.py --trains 1 --first-train SEED`.
"""

from __future__ import annotations

from joint_rates import TURNS_A_SECOND, Motion, move
from random_trains import RandomTrain, driven_train, random_train

from geartrain import GearTrain, GearTrainError
from geartrain.answer import Answer


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


def judged(train: RandomTrain) -> list[str]:
    """What is wrong about one train in its states; a linkage in any of them must be refused."""
    motions = {state: move(train, state) for state in train.states}
    refused = any(motion.kind == "refused" for motion in motions.values())
    try:
        answers = list(GearTrain.declare(train.data).answers())
    except GearTrainError as error:
        return [] if refused and "linkage" in str(error) else [f"seed {train.seed} is refused: {error}"]
    if refused:
        return [f"seed {train.seed} has a linkage, and is answered"]
    return [said for answer in answers if (said := told(train, motions[answer.state], answer))]


def test_random_trains_do_what_their_joints_do(seeds: range) -> None:
    assert not [said for seed in seeds for said in judged(random_train(seed))]


def test_the_random_trains_are_of_every_kind() -> None:
    trains = [random_train(seed) for seed in range(400)]
    kinds = [move(train, state).kind for train in trains for state in train.states]
    assert min(kinds.count(kind) for kind in ("determined", "free", "locked")) > 50
    assert min(kinds.count(kind) for kind in ("contradictory", "refused")) > 0
    data = [train.data for train in trains]
    assert any(any("bevel" in str(part) for part in each["links"].values()) for each in data)
    assert any(len({text.split(" ")[-1] for text in each["inputs"].values()}) > 1 for each in data)
    assert all(any(each.get(key) for each in data) for key in ("axes", "couplings", "clutches", "fixed", "locks"))


def test_driven_trains_turn_as_their_joints_do(seeds: range) -> None:
    trains = map(driven_train, seeds[:: max(1, len(seeds) // 300)])
    assert not [said for train in trains for said in judged(train)]
