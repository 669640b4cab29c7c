"""No train creates energy: whatever it loses, by whatever way that is declared, more goes in than comes out.

Powers are taken here from torques and speeds of links alone, and equilibrium link by link.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from fractions import Fraction
from itertools import product
from random import Random
from typing import Any

import pytest
import shipped as catalogue
from models import torque_figures
from random_trains import driven_train
from sampling import few_or_many

from geartrain import GearTrain, GearTrainError, load
from geartrain.dynamics import Torques, find_power_flow
from geartrain.numerics.exact import PI

Data = dict[str, Any]

SAMPLE = few_or_many(170, 400)  # random trains a law; `--slow` takes more


def speeds_along(train: GearTrain, found: Torques) -> dict[str, Fraction]:
    """Speeds about the direction of the parallels."""
    return {link: train.kinematics.signs.get(link, 1) * Fraction(speed) for link, speed in found.speeds.items()}


def bearings_of(train: GearTrain, found: Torques) -> dict[str, list[tuple[str, Fraction]]]:
    """By link that rubs, the torques of its bearing on itself and on its carrier, about the links' own axes."""
    along, taken = speeds_along(train, found), {}
    for link, part in train.declaration.links.items():
        if part.bearing is None or not found.bearing_loss or link == train.declaration.frame:
            continue
        carrier = train.kinematics.tree.parent[link][0]
        while carrier in train.declaration.sliding:  # a slide passes torques on to what bears it
            carrier = train.kinematics.tree.parent[carrier][0]
        relative = along[link] - along[carrier]
        size = part.bearing.sliding.base
        if part.bearing.coefficient is not None:  # tests/dynamics/test_loaded_bearings.py computes it from the forces
            size = abs(next(each.torque for each in found.bearings if each.link == link))
        torque = -size * ((relative > 0) - (relative < 0))
        own, other = train.kinematics.signs.get(link, 1), train.kinematics.signs.get(carrier, 1)
        taken[link] = [(link, own * torque), (carrier, -other * torque)]
    return taken


def require_no_energy(train: GearTrain, found: Torques) -> None:
    """Every link in balance; every pair, bearing and lock passes on no more than it takes; no more out than in."""
    if not found.verdict or found.open_speeds or any(link not in found.speeds for link in train.declaration.links):
        return
    # a force of 1 N does 1 mJ along a travel of 1 mm, and a torque of 1 N m does 2 pi J in a turn
    sizes = dict.fromkeys(train.declaration.sliding, 1 / (2000 * PI))
    speed = {link: Fraction(value) * sizes.get(link, 1) for link, value in found.speeds.items()}
    acting: dict[str, Fraction] = dict.fromkeys(train.declaration.links, Fraction(0))
    lost = Fraction(0)
    for name, pair in found.pairs.items():
        taken = -sum(torque * speed[link] for link, torque in zip(pair.links, pair.torques, strict=True))
        assert taken >= 0, f"{train.name}: pair {name} gives {-taken} more than it takes"
        assert taken == pair.loss, name
        lost += taken
        for link, torque in zip(pair.links, pair.torques, strict=True):
            acting[link] += torque
    for link, given in bearings_of(train, found).items():
        taken = -sum(torque * speed[end] for end, torque in given)
        assert taken >= 0, f"{train.name}: the bearing of {link} drives"
        lost += taken
        for end, torque in given:
            acting[end] += torque
    for held in found.held:
        if held.torques is None or any(pair.loose for pair in found.pairs.values()):
            continue
        assert sum(torque * speed[link] for link, torque in zip(held.links, held.torques, strict=True)) == 0
        if len(held.links) == 2:
            for link, torque in zip(held.links, held.torques, strict=True):
                acting[link] += torque
    loose = any(pair.loose for pair in found.pairs.values()) or any(held.torques is None for held in found.held)
    if not loose:
        for link, torque in acting.items():
            if link != train.declaration.frame:
                assert torque + found.external.get(link, 0) == 0, f"{train.name}: {link} is not in balance"
        assert sum(found.powers.values()) == lost
    if found.efficiency is not None:
        assert 0 <= found.efficiency <= 1
    assert all(loss > 0 for loss in find_power_flow(found).losses.values())


def requested(train: GearTrain) -> Iterator[Torques]:
    """Under the declared loads, and driven from each end to the other."""
    for state in train.states or (None,):
        figures = torque_figures(train, state)
        yield figures.torques
        yield from (each.way.torques for each in figures.drives or ())


def written(random: Random) -> object:
    """An efficiency in one of the ways to write it, above 0 and at most 1 one way round at least."""
    percent = random.randint(1, 100)
    ways: list[object] = [
        f"{percent} %", percent / 100, f"{percent}/100", 1, "99.99 %", "1e-3",
        {"forward": f"{percent} %", "backward": random.choice(["-1/2", 0, "0.3", "100 %"])},
        {"forward": random.choice([0, "-3"]), "backward": percent / 100},
    ]  # fmt: skip
    return random.choice(ways)


@pytest.mark.parametrize("name", catalogue.every_train())
def test_no_shipped_train_creates_energy(name: str) -> None:
    train = catalogue.train(name).unfolded
    for found in requested(train):
        require_no_energy(train, found)


@pytest.mark.parametrize("name", catalogue.every_train())
@pytest.mark.parametrize("seed", [0, *(pytest.param(seed, marks=pytest.mark.long) for seed in (1, 2))])
def test_no_shipped_train_creates_energy_with_other_losses(name: str, seed: int) -> None:
    """Efficiencies in every way they are written, bearings, friction on its teeth and pins, and a load or two."""
    random, plain = Random(f"{name} {seed}"), catalogue.train(name).declaration
    data: Data = {"extends": name, "name": name}
    data["gears"] = [
        {"id": gear.name, "pair": list(gear.pair), "efficiency": written(random)}
        for gear in plain.gears
        if random.random() < 0.7
    ]
    data["couplings"] = []
    for pin in plain.pin_couplings:
        rubs = pin.kind in ("pin_and_slot", "pin_follower")
        friction = {"friction": random.choice([0.01, 0.1, 0.3])} if rubs else {}
        data["couplings"].append({"id": pin.name, "kind": pin.kind, "pin": pin.pin, "slot": pin.slot, **friction})
    moving = [link for link in plain.links if link != plain.frame]
    turning = [link for link in moving if link not in plain.sliding]
    # loads are plain numbers here unless a link slides, and a friction that is declared has a unit
    unit = " N m" if plain.sliding else ""
    units = {**dict.fromkeys(turning, unit), **dict.fromkeys(plain.sliding, " N")}
    data["links"] = {link: {"bearing": None} for link in turning if plain.links[link].bearing}
    data["links"] |= {link: {"bearing": f"1/50{unit}"} for link in turning if random.random() < 0.3}
    loads = {link: f"{random.randint(-9, 9)}{units[link]}" for link in random.sample(moving, min(2, len(moving)))}
    data["loads"] = loads
    if plain.states:
        data["states"] = {state: {"loads": loads} for state in plain.states}
    if plain.tooth_form is not None:
        data["friction"] = random.choice([0.02, 0.1])
    train = load(data).unfolded
    for found in requested(train):
        require_no_energy(train, found)


def lossy(seed: int, oblique: bool) -> Data:
    """A driven random train in which pairs, pins and bearings lose, and some link that is not driven is loaded."""
    random, data = Random(seed), driven_train(seed, oblique=oblique).data
    data = json.loads(json.dumps(data))
    for gear in data["gears"]:
        if random.random() < 0.8:
            gear["efficiency"] = written(random)
    for coupling in data["couplings"]:
        r, e = ("10 mm", "3 mm") if coupling["kind"] == "pin_and_slot" else ("3 mm", "10 mm")
        coupling |= {"pin_radius": r, "offset": e, "friction": random.choice([0, 0.1, 0.4])}
    for link, part in data["links"].items():
        if link != "frame" and random.random() < 0.2:
            part["bearing"] = "1/7"
    free = [link for link in data["links"] if link != "frame" and link not in data["inputs"]]
    if free:
        data["loads"] = {link: str(random.randint(-9, 9)) for link in random.sample(free, min(2, len(free)))}
    return data


def test_no_random_train_creates_energy(seeds: range) -> None:
    answered = 0
    for seed in seeds[:: max(1, len(seeds) // SAMPLE)]:
        train = GearTrain.declare(lossy(seed, oblique=True))
        for found in requested(train):
            require_no_energy(train, found)
            answered += bool(found.verdict)
    assert answered > 50


def test_friction_of_any_teeth_creates_no_energy() -> None:
    """The laws' own means, with either wheel driving, at constant torque on either side, and in a train."""
    forms = ["triangular, half_angle: 30 deg, window: 0.5", "involute", "cycloidal", "uniform_stress", "least_friction"]
    for form, (z1, z2), friction in product(forms, [(24, 36), (41, 20)], [0.01, 0.1, 0.25]):
        text = f"""
links: {{frame: {{}}, a: {{wheels: {{p: {z1}}}}}, b: {{bearing: 0.1, wheels: {{w: {z2}}}}}}}
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}]
gears: [{{pair: [p, w], tooth_form: {{form: {form}}}, friction: {friction}}}]
inputs: {{a: 1}}
loads: {{b: 3}}
"""
        train = load(text)
        (mesh,) = train.meshes
        for transmission in (mesh.transmission, mesh.reversed):
            assert max(transmission.efficiency_mean(), transmission.efficiency_at_constant_load()) <= 1, transmission
        for found in requested(train):
            require_no_energy(train, found)


@pytest.mark.parametrize("second", ["[p, w]", "[w, p]"])
def test_two_pairs_side_by_side_lose_what_one_does(second: str) -> None:
    """How they share the load is open, but not that power flows from the crank to the load in both."""
    text = f"""
links: {{frame: {{}}, a: {{wheels: {{p: 20}}}}, b: {{wheels: {{w: 40}}}}}}
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}]
gears: [{{id: G, pair: [p, w], efficiency: 1/1000}}, {{id: H, pair: {second}, efficiency: 1/1000}}]
inputs: {{a: 1}}
loads: {{b: 1}}
"""
    found = load(text).torques()
    assert found.external["a"] == 500
    assert found.efficiency == Fraction(1, 1000)


PAIR: Data = {
    "links": {"frame": {}, "a": {"wheels": {"p": 20}}, "b": {"wheels": {"w": 40}}},
    "revolutes": [{"pair": ["frame", "a"], "axis": "A"}, {"pair": ["frame", "b"], "axis": "B"}],
    "gears": [{"id": "G", "pair": ["p", "w"]}],
    "inputs": {"a": 1},
    "loads": {"b": 3},
}


def test_nothing_built_past_the_declaration_lets_in_more_than_all() -> None:
    train = GearTrain.declare(PAIR)
    gear = train.declaration.gears[0]
    share = GearTrain.declare({**PAIR, "gears": [{**PAIR["gears"][0], "efficiency": "98 %"}]}).declaration.gears[0]
    too_high = type(share.efficiency.forward).parse("98", "fraction", plain=True)
    forged = share.efficiency.model_copy(update={"forward": too_high})
    copied = train.declaration.model_copy(update={"gears": (gear.model_copy(update={"efficiency": forged}),)})
    with pytest.raises(GearTrainError, match="create power"):
        GearTrain(copied).torques()
