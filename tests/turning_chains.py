"""Random plane trains, as declarations and as bodies at one position: pairs, pins and planets in series.

Each stage drives the next link: a pair with declared efficiencies, a pair of triangular teeth with friction, a pin in a
slot, or sun and planet in a fixed ring whose arm is the next link. Every link has a bearing; loads may help or resist.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass, field
from fractions import Fraction
from math import atan2, cos, hypot, pi, sin
from random import Random
from typing import Any

from outline_touch import Outlines
from plane_statics import FRAME, Balance, Hinge, Mechanism, Touch, Vector, flanks, toothed

KINDS = ("pair", "triangular", "pin", "planet")


@dataclass
class Stage:
    """One stage; `numbers` are the sizes of its kind, `place` is the direction from axis to axis [rad]."""

    kind: str
    driver: str
    driven: str
    numbers: dict[str, Any]
    place: float


@dataclass
class Chain:
    """A declaration, its stages in order, and the friction of its bearings."""

    data: dict[str, Any]
    stages: list[Stage] = field(default_factory=list)
    bearings: dict[str, float] = field(default_factory=dict)

    def forward(self) -> list[int]:
        """Return the sense in which each link of the chain turns."""
        senses = [1]
        for stage in self.stages:
            keeps = stage.kind in ("pin", "planet") or stage.numbers.get("internal")
            senses.append(senses[-1] if keeps else -senses[-1])
        return senses

    def balances(self, turned: float, outlines: dict[str, Outlines], loads: dict[str, float]) -> list[Balance]:
        """Return all equilibria of the bodies with the crank at an angle [rad], turning forwards."""
        toothed_stages = [at for at, stage in enumerate(self.stages) if stage.kind == "triangular"]
        found = []
        for chosen in itertools.product((0, 1), repeat=len(toothed_stages)):
            bodies, _ = self.bodies(turned, outlines, dict(zip(toothed_stages, chosen, strict=True)))
            found += bodies.balances({"L0": 1.0}, loads, "L0")
        return found

    def bodies(
        self, turned: float, outlines: dict[str, Outlines], chosen: dict[int, int]
    ) -> tuple[Mechanism, list[float]]:
        """Return the bodies for the chosen flanks in contact, and the forward angle of each link of the chain.

        At the start, each driver has a tooth, or its pin, on the line of centres, and all links are at 0.
        """
        centre: Vector = (0.0, 0.0)
        hinges = [Hinge(FRAME, "L0", centre, self.bearings["L0"])]
        joints: list[tuple[Touch, ...]] = []
        angles = [turned]
        for at, (stage, sense) in enumerate(zip(self.stages, self.forward(), strict=False)):
            names, numbers, S = (stage.driver, stage.driven), stage.numbers, angles[-1]
            unit = (cos(stage.place), sin(stage.place))
            axis = (centre[0] + 9 * unit[0], centre[1] + 9 * unit[1])
            if stage.kind == "pair":
                z, y = numbers["teeth"]
                radii = (z, -y if numbers["internal"] else y)
                joints.append(toothed(*names, (centre, axis), radii, numbers["efficiencies"]))
                angles.append(S * z / y)
            elif stage.kind == "triangular":
                wheels, flank = outlines[numbers["id"]], chosen[at]
                touch = wheels.touch(S, names, (centre, axis), numbers["friction"], flank, sense < 0)
                joints.append((touch,))
                angles.append(wheels.driven(S, flank) - wheels.driven(0.0))
            elif stage.kind == "pin":
                r, e = numbers["r"], numbers["e"]
                axis = (centre[0] + e * unit[0], centre[1] + e * unit[1])
                lean = stage.place + sense * S
                pin = (centre[0] + r * cos(lean), centre[1] + r * sin(lean))
                away = hypot(pin[0] - axis[0], pin[1] - axis[1])
                normal = (-(pin[1] - axis[1]) / away, (pin[0] - axis[0]) / away)
                joints.append(flanks(*names, pin, normal, numbers["friction"]))
                angles.append(S + atan2(e * sin(S), r - e * cos(S)))
            else:
                planet, (s, p, q, ring) = numbers["planet"], numbers["teeth"]
                first, second = numbers["efficiencies"]
                hinges.append(Hinge(stage.driven, planet, axis, self.bearings[planet]))
                joints.append(toothed(stage.driver, planet, (centre, axis), (s, p), first, stage.driven))
                joints.append(toothed(planet, FRAME, (axis, centre), (q, -ring), second, stage.driven))
                slower = float(1 + Fraction(ring * p, q * s))
                angles.append(S / slower)
                axis = centre
            hinges.append(Hinge(FRAME, stage.driven, axis, self.bearings[stage.driven]))
            centre = axis
        return Mechanism(hinges, joints), angles


def random_chain(seed: int, kinds: tuple[str, ...] = KINDS, most: int = 3) -> Chain:
    """Return a chain from a seed."""
    random = Random(seed)
    data: dict[str, Any] = {
        "links": {"frame": {"wheels": {}}, "L0": {"wheels": {}}},
        "revolutes": [{"pair": ["frame", "L0"], "axis": "A0"}],
        "gears": [],
        "couplings": [],
        "inputs": {"L0": "1"},
        "tooth_form": {"form": "ideal"},
    }
    chain = Chain(data)
    axis = "A0"
    for at in range(random.randint(1, most)):
        driver, driven = f"L{at}", f"L{at + 1}"
        data["links"][driven] = {"wheels": {}}
        stage = Stage(random.choice(kinds), driver, driven, {}, random.uniform(0, 2 * pi))
        axis = _declare(random, data, stage, at, axis)
        chain.stages.append(stage)
    for link, declared in data["links"].items():
        if link != "frame":
            rubs = Fraction(random.randint(0, 4), 20)
            chain.bearings[link] = float(rubs)
            declared["bearing"] = f"{float(rubs)} N m"
    last = chain.stages[-1].driven
    data["loads"] = {last: f"{random.choice([-1, 1]) * random.randint(1, 9)} N m"}
    if len(chain.stages) > 1 and random.random() < 0.3:
        data["loads"]["L1"] = f"{random.choice([-1, 1]) * random.randint(1, 9)} N m"
    data["outputs"] = {last: {}}
    return chain


def _declare(random: Random, data: dict[str, Any], stage: Stage, at: int, axis: str) -> str:
    """Add one stage to the declaration; return the axis about which the driven link turns."""
    driver, driven, name = stage.driver, stage.driven, f"G{at}"

    def wheel(link: str, label: str, teeth: int, internal: bool = False) -> str:
        data["links"][link]["wheels"][f"{label}{at}"] = {"teeth": teeth, **({"internal": True} if internal else {})}
        return f"{label}{at}"

    def efficiencies() -> tuple[float, float]:
        return random.randint(80, 99) / 100, random.randint(80, 99) / 100

    def losing(both: tuple[float, float]) -> dict[str, str]:
        return {"forward": str(both[0]), "backward": str(both[1])}

    following = f"A{at + 1}"
    if stage.kind == "pair":
        internal = random.random() < 0.3
        z = random.randint(12, 30)
        y = random.randint(12, 30) + (z + 20 if internal else 0)
        stage.numbers = {"teeth": (z, y), "internal": internal, "efficiencies": efficiencies()}
        pair = [wheel(driver, "p", z), wheel(driven, "w", y, internal)]
        data["gears"].append({"id": name, "pair": pair, "efficiency": losing(stage.numbers["efficiencies"])})
    elif stage.kind == "triangular":
        z, y = random.randint(16, 40), random.randint(16, 40)
        friction = random.randint(0, 25) / 100
        form = {"form": "triangular", "half_angle": "30 deg", "window": "0.5"}
        stage.numbers = {"id": name, "friction": friction}
        pair = [wheel(driver, "p", z), wheel(driven, "w", y)]
        data["gears"].append({"id": name, "pair": pair, "tooth_form": form, "friction": friction, "driver": pair[0]})
    elif stage.kind == "pin":
        e = random.randint(1, 6)
        stage.numbers = {"r": 10.0, "e": float(e), "friction": random.randint(0, 25) / 100}
        data["couplings"].append(
            {"id": name, "kind": "pin_and_slot", "pin": driver, "slot": driven, "pin_radius": "10 mm",
             "offset": f"{e} mm", "friction": stage.numbers["friction"]}
        )  # fmt: skip
    else:
        s, p, q = (random.randint(12, 30) for _ in range(3))
        ring = q + random.randint(30, 60)
        planet = f"P{at}"
        data["links"][planet] = {"wheels": {}}
        stage.numbers = {"planet": planet, "teeth": (s, p, q, ring), "efficiencies": (efficiencies(), efficiencies())}
        pairs = [
            [wheel(driver, "s", s), wheel(planet, "p", p)],
            [wheel(planet, "q", q), wheel("frame", "r", ring, True)],
        ]
        for label, pair, both in zip("st", pairs, stage.numbers["efficiencies"], strict=True):
            data["gears"].append({"id": f"{name}{label}", "pair": pair, "efficiency": losing(both)})
        data["revolutes"].append({"pair": [driven, planet], "axis": f"P{at}"})
        following = axis
    data["revolutes"].append({"pair": ["frame", driven], "axis": following})
    return following
