"""Directions of axes: signs of bevels, contrates and worms follow from geometry."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from models import PAIR, pair, refusal
from random_trains import random_train

from geartrain import GearTrain, load, shipped

DIFFERENTIAL = """
links:
  frame: {{}}
  crown: {{}}
  left:  {{wheels: {{l: {{teeth: 16, kind: bevel, facing: {left}}}}}}}
  right: {{wheels: {{r: {{teeth: 16, kind: bevel, facing: {right}}}}}}}
  spider: {{wheels: {{p: {{teeth: 10, kind: bevel}}}}}}
axes:
  axle: {{direction: {axle}}}
  spider: {{direction: [0, 1, 0]}}
revolutes: {{axle: [frame, crown, left, right], spider: [crown, spider]}}
gears: [{{pair: [l, p]}}, {{pair: [r, p]}}]
inputs: {{crown: 10, left: 8}}
"""


@pytest.mark.parametrize(("left", "right", "speed"), [(1, -1, 12), (-1, 1, 12), (1, 1, 8)])
@pytest.mark.parametrize("axle", ["[1, 0, 0]", "[-2, 0, 0]"])
def test_the_shafts_of_a_differential_turn_at_the_crown_on_average(
    left: int, right: int, speed: int, axle: str
) -> None:
    train = load(DIFFERENTIAL.format(left=left, right=right, axle=axle))
    assert train.solve()["right"] == speed  # left + right = 2 crown, unless both bevels face the same way
    assert train.kinematics.joint_sums == {"spider"}


@pytest.mark.parametrize(("facing", "way", "sign"), [(1, 1, -1), (-1, 1, 1), (-1, -1, 1)])
def test_a_bevel_pair_turns_by_its_facings(facing: int, way: int, sign: int) -> None:
    # wheels on the positive side of their axes turn against each other: z_i f_i w_i + z_j f_j w_j = 0; reversing axis
    # and facing leaves the pair as it is, and its speed is read from the other side
    text = PAIR.format(rest=f"inputs: {{a: 1}}\naxes: {{A: {{direction: [1, 0, 0]}}, B: {{direction: [0, {way}, 0]}}}}")
    text = text.replace("p: 20", "p: {teeth: 20, kind: bevel}")
    text = text.replace("w: 60", f"w: {{teeth: 60, kind: bevel, facing: {facing}}}")
    assert load(text).solve()["b"] == Fraction(sign, 3)


def test_a_ring_on_an_axis_that_is_not_parallel_is_refused() -> None:
    text = PAIR.format(rest="inputs: {a: 1}\naxes: {A: {direction: [1, 0, 0]}}")
    assert "ring" in refusal(text.replace("w: 60", "w: {teeth: 60, internal: true}"))


def test_without_axes_all_axes_are_parallel_and_the_default_direction_is_z() -> None:
    plain, declared = pair(), pair("inputs: {a: 1}\naxes: {A: {}, B: {direction: [0, 0, 1]}}")
    assert dict(plain.solve().speeds) == dict(declared.solve().speeds)


@pytest.mark.parametrize(
    ("axes", "said"),
    [
        ("{C: {direction: [1, 0, 0]}}", "no turning pair with the axis 'C'"),
        ("{A: {direction: [0, 0, 0]}}", "zero vector"),
        ("{A: {direction: [1, 0]}}", "direction"),
        ("{A: {position: [0 mm, 1 mm, 0 kg]}}", "is a mass, but a length is required"),
        ("{A: {position: [0 mm, 1 mm, 0 parsec]}}", "unknown unit"),
        ("{A: {position: [1 mm, 0, 0]}, B: {position: [1, 0, 0]}}", "lengths with and without units"),
    ],
)
def test_axes_that_make_no_sense_are_refused(axes: str, said: str) -> None:
    assert said in refusal(PAIR.format(rest=f"inputs: {{a: 1}}\naxes: {axes}"))


def screw_pushes(hand: str, u: tuple[float, ...], worm: tuple[float, ...], v: tuple[float, ...]) -> float:
    """Sense of a wheel about v through the origin, when a worm at `worm` turns a little about u: +1 or -1.

    The worm's crest on the side of the wheel is followed as a point on a helix of one turn's pitch 1.
    """
    turn, pitch = 1e-3, 1.0 if hand == "right" else -1.0
    # the helix rises by `pitch` a turn; turned by `turn` radians, the crest at a fixed angle has sunk by that much
    slide = -pitch * turn / (2 * math.pi)
    return math.copysign(1.0, float(np.cross(worm, slide * np.array(u)) @ v))


@pytest.mark.parametrize("hand", ["right", "left"])
@pytest.mark.parametrize("reach", [35, -35])
@pytest.mark.parametrize("first", ["[w2, w60]", "[w60, w2]"])
@pytest.mark.parametrize("flip", [1, -1])
def test_a_worm_drives_its_wheel_the_way_its_thread_moves(hand: str, reach: int, first: str, flip: int) -> None:
    train = load(
        f"""
        frame: case
        axes:
          screw: {{direction: [{flip}, 0, 0], position: [0 mm, 0 mm, {reach} mm]}}
          wheel: {{direction: [0, 1, 0], position: [0 mm, 0 mm, 0 mm]}}
        links:
          case: {{}}
          screw: {{wheels: {{w2: {{teeth: 2, kind: worm, hand: {hand}}}}}}}
          wheel: {{wheels: {{w60: 60}}}}
        revolutes: [{{pair: [case, screw], axis: screw}}, {{pair: [case, wheel], axis: wheel}}]
        gears: [{{pair: {first}}}]
        inputs: {{screw: 1}}
        """
    )
    sense = screw_pushes(hand, (float(flip), 0.0, 0.0), (0.0, 0.0, float(reach)), (0.0, 1.0, 0.0))
    assert train.solve()["wheel"] == Fraction(int(sense), 30)
    assert train.circuits[0].note == ""


@pytest.mark.parametrize(("hand", "speed"), [("right", Fraction(-1, 30)), ("left", Fraction(1, 30))])
def test_a_worm_without_positions_has_a_conventional_sense_and_says_so(hand: str, speed: Fraction) -> None:
    text = PAIR.format(rest="inputs: {a: 1}").replace("p: 20", f"p: {{teeth: 2, kind: worm, hand: {hand}}}")
    train = load(text)
    assert train.solve()["b"] == speed
    assert "convention" in train.circuits[0].note


@pytest.mark.parametrize("mate", ["{teeth: 3, kind: worm}", "{teeth: 60, internal: true}"])
def test_a_worm_drives_an_external_wheel_only(mate: str) -> None:
    text = PAIR.format(rest="inputs: {a: 1}").replace("p: 20", "p: {teeth: 2, kind: worm}")
    assert "not a valid worm drive" in refusal(text.replace("w: 60", f"w: {mate}"))


def test_the_axis_seen_from_a_carrier_is_the_last_one_on_the_way_from_it() -> None:
    trains = [load(name) for name in shipped()]
    random = [GearTrain.declare(random_train(seed).data) for seed in range(100)]
    for train in [*trains, *random]:
        for circuit in train.circuits:
            for link in (circuit.i, circuit.j):
                _, labels = train.kinematics.tree.path(circuit.carrier, link)
                assert train.kinematics.tree.axis_seen_from(circuit.carrier, link) == labels[-1], circuit
