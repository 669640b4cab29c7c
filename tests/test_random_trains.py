"""A thousand random trains against the oracle in joint rates; more with `--trains 100000`, others with `--first-train`.

A failure names the seed: `pytest tests/test_random_trains.py --trains 1 --first-train SEED`.
"""

from __future__ import annotations

from joint_rates import TURNS_A_SECOND, Motion, move
from random_trains import RandomTrain, driven_train

from geartrain import GearTrain
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


def test_driven_trains_turn_as_their_joints_do(seeds: range) -> None:
    trains = map(driven_train, seeds[:: max(1, len(seeds) // 300)])
    wrong = [told(train, move(train), GearTrain.declare(train.data).solve()) for train in trains]
    assert not list(filter(None, wrong))
