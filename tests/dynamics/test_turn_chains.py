"""Random chains of pairs, triangular teeth, pins and planets: their bodies balance, and turn as `motion` says."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
from outline_touch import Outlines
from turning_chains import Chain, random_chain

from geartrain import GearTrain

SEEDS = range(24)


def outlines_of(train: GearTrain) -> dict[str, Outlines]:
    return {mesh.name: Outlines.of(mesh.transmission.sizes) for mesh in train.meshes}


def loads_of(chain: Chain) -> dict[str, float]:
    return {link: float(torque.split()[0]) for link, torque in chain.data["loads"].items()}


@pytest.mark.parametrize("seed", SEEDS)
def test_bodies_turn_as_motion_says(seed: int) -> None:
    chain = random_chain(seed)
    train = GearTrain.declare(chain.data)
    last, x = chain.stages[-1].driven, 1.234
    bodies, angles = chain.bodies(x, outlines_of(train), dict.fromkeys(range(len(chain.stages)), 0))
    mean = float(train.solve()[last])
    samples = train.motion(outputs=[last]).at(np.array([x / (2 * pi)]))
    assert mean * x + samples.error[0, 0] == pytest.approx(chain.forward()[-1] * angles[-1], abs=1e-12)
    assert mean + samples.rate[0, 0] == pytest.approx(bodies.motion({"L0": 1.0})[last][2], rel=1e-11)


@pytest.mark.parametrize("seed", SEEDS)
def test_bodies_balance_in_one_way_and_lose_what_is_put_in(seed: int) -> None:
    chain = random_chain(seed)
    train = GearTrain.declare(chain.data)
    (found,) = chain.balances(1.234, outlines_of(train), loads_of(chain))
    if not any(stage.kind in ("pin", "triangular") for stage in chain.stages):
        assert found.torque == pytest.approx(float(train.torques().external["L0"]), rel=1e-11)
    assert min(found.lost) >= -1e-12
    assert sum(found.lost) == pytest.approx(found.put_in, rel=1e-10, abs=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_torques_at_single_positions_are_those_of_bodies_in_balance(seed: int) -> None:
    chain = random_chain(seed)
    train, loads = GearTrain.declare(chain.data), loads_of(chain)
    cycle = train.torques(turns=1, samples=20)
    assert cycle.turns is not None
    assert cycle.torque is not None
    assert cycle.losses is not None
    # not where the laws have two sides
    apart = np.diff(cycle.turns) > 1e-6
    smooth = 1 + np.flatnonzero(apart[:-1] & apart[1:])
    for at in smooth[:: max(1, len(smooth) // 5)]:
        (found,) = chain.balances(2 * pi * float(cycle.turns[at]), outlines_of(train), loads)
        assert cycle.torque[at] == pytest.approx(found.torque, rel=1e-8, abs=1e-9)
        assert cycle.losses.values[:, at].sum() == pytest.approx(sum(found.lost), rel=1e-8, abs=1e-9)
