"""Torques of pairs and of differentials by plain statics: every body in balance, position by position."""

from __future__ import annotations

from fractions import Fraction
from math import cos, pi, sin
from random import Random
from typing import Any

import numpy as np
import pytest
from outline_touch import Outlines
from plane_statics import FRAME, Balance, Hinge, Mechanism, toothed

from geartrain import GearTrain, load


def only(found: list[Balance]) -> Balance:
    assert len(found) == 1
    return found[0]


def test_outlines_touch_where_the_transmission_functions_say() -> None:
    for mesh in load("moon-triangular").meshes:
        wheels = Outlines.of(mesh.transmission.sizes)
        t = np.linspace(-1.0, 1.0, 400)
        assert wheels.places(t).driven == pytest.approx(mesh.transmission.angle(t), abs=1e-14)
        assert wheels.moments(t, 0.2)[0] == pytest.approx(mesh.transmission.speed(t), rel=1e-12)


def test_triangular_pairs_at_a_constant_load() -> None:
    printed = [0.9585852, 0.9413106, 0.9027585, 0.9232000]
    found = []
    for mesh in load("moon-triangular").meshes:
        wheels = Outlines.of(mesh.transmission.sizes)
        pitch = 2 * pi / wheels.z1
        speed, torque = wheels.moments((np.arange(20_000) + 0.5) * pitch / 20_000, 0.2)
        assert mesh.transmission.efficiency(np.arange(100) * pitch / 97) == pytest.approx(
            np.divide(*wheels.moments(np.arange(100) * pitch / 97, 0.2)), rel=1e-12
        )
        assert speed.mean() == pytest.approx(wheels.z1 / wheels.z2, rel=2e-5)
        found.append(wheels.z1 / wheels.z2 / torque.mean())
    assert found == pytest.approx(printed, abs=1e-5)


def differential(random: Random) -> tuple[dict[str, Any], Mechanism]:
    """Sun and ring, both driven, two wheels of one planet and a loaded arm, with losses everywhere; bodies in balance.

    The second wheel of the planet meshes with a second sun instead of a ring in half of the cases.
    """
    z = [random.randint(12, 40) for _ in range(4)]
    inside = random.random() < 0.5
    if inside:
        z[3] += z[2] + 30
    eta = [[Fraction(random.randint(80, 99), 100) for _ in range(2)] for _ in range(2)]
    rubs = {name: Fraction(random.randint(0, 5), 10) for name in ("sun", "ring", "arm", "planet")}
    data = {
        "links": {
            "frame": {},
            "sun": {"wheels": {"s": z[0]}, "bearing": str(rubs["sun"])},
            "ring": {"wheels": {"r": {"teeth": z[3], "internal": inside}}, "bearing": str(rubs["ring"])},
            "arm": {"bearing": str(rubs["arm"])},
            "planet": {"wheels": {"p": z[1], "q": z[2]}, "bearing": str(rubs["planet"])},
        },
        "revolutes": [
            *({"pair": ["frame", name], "axis": "A"} for name in ("sun", "ring", "arm")),
            {"pair": ["arm", "planet"], "axis": "P"},
        ],
        "gears": [
            {"pair": pair, "efficiency": {"forward": str(eta[at][0]), "backward": str(eta[at][1])}}
            for at, pair in enumerate((["s", "p"], ["q", "r"]))
        ],
        "inputs": {"sun": str(random.randint(5, 9)), "ring": str(random.randint(-9, 4))},
        "loads": {"arm": str(random.choice([-1, 1]) * random.randint(5, 20))},
    }
    lean = random.uniform(0, 2 * pi)
    middle, planet = (0.0, 0.0), (7 * cos(lean), 7 * sin(lean))
    hinges = [Hinge(FRAME, name, middle, float(rubs[name])) for name in ("sun", "ring", "arm")]
    hinges.append(Hinge("arm", "planet", planet, float(rubs["planet"])))
    radii = ((z[0], z[1]), (z[2], -z[3] if inside else z[3]))
    losses = [(float(one), float(other)) for one, other in eta]
    teeth = [
        toothed("sun", "planet", (middle, planet), radii[0], losses[0], "arm"),
        toothed("planet", "ring", (planet, middle), radii[1], losses[1], "arm"),
    ]
    return data, Mechanism(hinges, teeth)


def test_a_differential_balances_body_by_body() -> None:
    seen = 0
    for seed in range(60):
        data, bodies = differential(Random(seed))
        speeds = {link: float(speed) for link, speed in data["inputs"].items()}
        train = GearTrain.declare(data)
        if not train.solve().verdict:
            continue
        motion = bodies.motion(speeds)
        assert {link: motion[link][2] for link in ("arm", "planet")} == pytest.approx(
            {link: float(train.solve()[link]) for link in ("arm", "planet")}, rel=1e-9, abs=1e-9
        )
        load_on_arm = {link: float(torque) for link, torque in data["loads"].items()}
        found = bodies.balances(speeds, load_on_arm, "sun", ("ring",))
        answer = train.torques()
        assert bool(found) == bool(answer.verdict), (seed, answer.verdict)
        if answer.verdict.kind == "ambiguous" or not found:
            continue
        assert only(found).torque == pytest.approx(float(answer.external["sun"]), rel=1e-9), seed
        powers = only(found).torque * speeds["sun"] + sum(load_on_arm.values()) * motion["arm"][2]
        assert sum(only(found).lost) == pytest.approx(powers + only(found).held[0] * speeds["ring"], rel=1e-9)
        seen += 1
    assert seen > 40
