"""Who drives: the flow of power in the carrier's frame, whatever the order of declaration; and where pointers stand."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from fractions import Fraction
from math import degrees
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
import shipped
from commands import call
from joint_rates import Row, Skeleton, Space, inputs_of, move, rigid, sides
from random_trains import RandomTrain, driven_train
from sampling import few_or_many

from geartrain import GearTrain, load
from geartrain.dynamics import Motion

TOOTHED = ["pennestri-2002-teeth", "moon-triangular", "freeth-2021-teeth", "planetary-24-18-60-involute"]
TOOTHED += ["bevel-differential-involute", "lantern-mill", "sorge-pairs", "longcase-clock-cycloidal"]

SAMPLE = few_or_many(60, 100)  # random trains; `--slow` takes more


BEHIND = """
links:
  frame: {{wheels: {{ring: {{teeth: 60, internal: true}}}}}}
  sun: {{wheels: {{s: 24}}}}
  planet: {{wheels: {{p: 18}}}}
  carrier: {{wheels: {{o: 48}}}}
  out: {{wheels: {{c: 16}}}}
revolutes: {{main: [frame, sun, carrier], P: [carrier, planet], O: [frame, out]}}
gears:
  - {{pair: [s, p]}}
  - {{pair: [p, ring]}}
  - {{id: behind, pair: [{pair}], friction: 0.2,
     tooth_form: {{form: triangular, half_angle: 30 deg, window: {window}}}}}
inputs: {{sun: 1}}
outputs: {{out: {{}}}}
{rest}
"""


def behind(pair: str, window: str = "0.5", rest: str = "") -> GearTrain:
    return load(BEHIND.format(pair=pair, window=window, rest=rest))


@pytest.mark.parametrize("pair", ["o, c", "c, o"])
def test_behind_a_carrier_power_decides_and_not_the_wheel_written_first(pair: str) -> None:
    (mesh,) = behind(pair).meshes
    assert (mesh.driver, mesh.who.why) == ("o", "power flow sun -> out")
    # 48 teeth driving 16: the reverse would be 0.908
    assert mesh.transmission.efficiency_mean() == pytest.approx(0.8821535, abs=1e-7)
    assert behind(pair, "1").meshes[0].verdict.kind == behind("o, c", "1").meshes[0].verdict.kind
    loaded = behind(pair, rest="loads: {out: 1 N m}").torques()
    assert float(loaded.efficiency or 0) == pytest.approx(
        float(behind("o, c", rest="loads: {out: 1 N m}").torques().efficiency or 0), rel=1e-14
    )


def test_a_load_that_drives_turns_the_flow_and_a_declared_driver_wins() -> None:
    resisting, driving = (behind("o, c", rest=f"loads: {{out: {load} N m}}") for load in (1, -1))
    speed = resisting.solve()["out"]
    first, other = (driving, resisting) if speed > 0 else (resisting, driving)
    assert (first.meshes[0].driver, other.meshes[0].driver) == ("o", "c")
    assert first.meshes[0].who.why == "power flow under the loads"
    declared = load(BEHIND.format(pair="o, c", window="0.5", rest="").replace("id: behind", "id: behind, driver: c"))
    assert (declared.meshes[0].driver, declared.meshes[0].who.why) == ("c", "declared")


def flows(train: RandomTrain, outputs: list[str]) -> dict[frozenset[str], set[str]]:
    """Who drives each pair under a unit of torque that resists one output or another, by virtual work on the joints.

    Every constraint on the joint rates has one unknown force; with the forces of the loads and of the inputs they do no
    work in any motion. Pairs whose force is not determined are left out.
    """
    data, skeleton = train.data, Skeleton(train)
    motion = move(train)
    rates = [motion.space.value([Fraction(int(at == j)) for at in range(skeleton.count)] + [Fraction(0)])
             for j in range(skeleton.count)]  # fmt: skip
    meetings = list(sides(data, skeleton))
    held: list[Row] = [[a - b for a, b in zip(one, other, strict=True)] for _, (one, other) in meetings]
    held += rigid(train, skeleton, [(skeleton.frame, link) for link in data.get("fixed", ())])
    held += [skeleton.spin(skeleton.frame, link) or [] for link in inputs_of(data, None)]
    found: dict[frozenset[str], set[str]] = {frozenset(names): set() for names, _ in meetings}
    for output in outputs:
        spin = skeleton.spin(skeleton.frame, output)
        speed = _along(spin, rates)
        forces = Space(len(held))
        for joint in range(skeleton.count):
            forces.add([*(row[joint] for row in held), -spin[joint] * ((speed > 0) - (speed < 0))])
        assert forces.consistent
        for at, (names, (one, _)) in enumerate(meetings):
            force = forces.value([Fraction(int(at == other)) for other in range(len(held))] + [Fraction(0)])
            if force is None:
                found.pop(frozenset(names), None)
            elif frozenset(names) in found and (into := force * _along(one, rates)):
                found[frozenset(names)].add(names[0] if into < 0 else names[1])
    return found


def _along(row: Row, rates: list[Fraction | None]) -> Fraction:
    return sum((a * (rate or 0) for a, rate in zip(row, rates, strict=False)), Fraction(0))


def requested(seed: int) -> tuple[RandomTrain, list[str]]:
    """A random train that moves, and some of its shafts."""
    train, random = driven_train(seed), Random(seed)
    motion = move(train)
    frame = {link for joint in train.data["revolutes"] for link in joint["pair"] if "frame" in joint["pair"]} - {
        "frame"
    }
    able = [link for link in train.data["links"] if link in frame and motion.speed(link)]
    return train, random.sample(able, min(len(able), random.randint(1, 5)))


FAILED = (575,)  # the frame was taken for a planet like an idle wheel


def test_the_driver_is_he_whose_power_overcomes_what_resists(seeds: range) -> None:
    counted = {"one way": 0, "both": 0}
    for seed in (*FAILED, *seeds[:: max(1, len(seeds) // (5 * SAMPLE))]):
        train, outputs = requested(seed)
        if not outputs:
            continue
        loaded = GearTrain.declare({**train.data, "outputs": {f"out {link}": {"of": link} for link in outputs}})
        wheels = {frozenset(circuit.wheels): circuit.id for circuit in loaded.circuits}
        drivers = loaded.mechanics.drivers()
        for names, ways in flows(train, outputs).items():
            driver = drivers[wheels[names]]
            if len(ways) == 1:
                assert driver.known, (seed, names, driver)
                assert {driver.wheel} == ways, (seed, names, driver)
                counted["one way"] += 1
            elif ways:
                assert not driver.known, (seed, names, driver)
                counted["both"] += 1
    assert len(seeds) < 1000 or (counted["one way"] > 100 and counted["both"] > 0)


def tells_its_wheels_apart(form: Any) -> bool:
    """True for teeth that are another pair where the wheels change places."""
    given = [getattr(form, name) for name in type(form).model_fields] if form is not None else []
    uneven = any(isinstance(value, tuple) and value[0] != value[1] for value in given)
    return uneven or (form is not None and form.form == "lantern")


def shuffled(train: GearTrain, random: Random) -> GearTrain:
    """The same train, declared in another order: links, joints, pairs, their wheels, couplings, outputs."""
    declared = train.declaration

    def mixed(given: Mapping[str, Any]) -> dict[str, Any]:
        keys = list(given)
        random.shuffle(keys)
        return {key: given[key] for key in keys}

    gears = []
    for gear in random.sample(declared.gears, len(declared.gears)):
        update: dict[str, Any] = {"id": gear.name}
        form = gear.tooth_form or declared.tooth_form
        if random.random() < 0.5 and not tells_its_wheels_apart(form):
            update["pair"] = gear.pair[::-1]
            if gear.efficiency is not None:
                swapped = {"forward": gear.efficiency.backward, "backward": gear.efficiency.forward}
                update["efficiency"] = gear.efficiency.model_copy(update=swapped)
        gears.append(gear.model_copy(update=update))
    states = declared.states.items()
    changed = {
        "links": mixed(declared.links),
        "revolutes": tuple(random.sample(declared.revolutes, len(declared.revolutes))),
        "gears": tuple(gears),
        "couplings": tuple(random.sample(declared.couplings, len(declared.couplings))),
        "outputs": mixed(declared.outputs),
        "states": {name: state.model_copy(update={"outputs": mixed(state.outputs)}) for name, state in states},
    }
    return GearTrain(declared.model_copy(update=changed))


@pytest.mark.parametrize("name", [*TOOTHED, "freeth-2021", "prague-orloj", "simpson-set", "zf-8hp70", "humpage"])
def test_no_order_of_declaration_changes_who_drives_nor_what_is_lost(name: str) -> None:
    train = shipped.train(name)
    for seed in range(3):
        other = shuffled(train, Random(seed))
        for state in train.states or (None,):
            assert dict(other.mechanics.drivers(state)) == dict(train.mechanics.drivers(state))
            mine, yours = (each.torques(state) for each in (train, other))
            assert mine.verdict.kind == yours.verdict.kind
            assert float(yours.efficiency or 0) == pytest.approx(float(mine.efficiency or 0), rel=1e-12)
            for pair in mine.pairs.values():
                assert float(yours.pairs[pair.id].loss) == pytest.approx(float(pair.loss), rel=1e-9, abs=1e-12)
        found = {mesh.name: mesh for mesh in other.meshes}
        for mesh in train.meshes:
            mate = found[mesh.name]
            assert (mate.driver, mate.verdict.kind) == (mesh.driver, mesh.verdict.kind)
            assert mate.transmission.efficiency_mean() == pytest.approx(mesh.transmission.efficiency_mean(), rel=1e-12)
            assert mate.transmission.error_range() == pytest.approx(mesh.transmission.error_range(), abs=1e-12)


def test_no_order_of_declaration_changes_who_drives_in_random_trains(seeds: range) -> None:
    for seed in seeds[:: max(1, len(seeds) // SAMPLE)]:
        train, outputs = requested(seed)
        plain = GearTrain.declare({**train.data, "outputs": {f"out {link}": {"of": link} for link in outputs}})
        assert dict(shuffled(plain, Random(seed)).mechanics.drivers()) == dict(plain.mechanics.drivers()), seed


def test_drivers_found_one_by_one_follow_the_torques_under_all_efficiencies() -> None:
    """In shipped trains: the power flows under the loads where the torques say so, and nowhere else."""
    found = 0
    for name in shipped.trains():
        for state in shipped.train(name).states or (None,):
            if not shipped.train(name).declaration.is_loaded(state):
                continue
            torques, train = shipped.train(name).torques(state), load(name)
            flows = {each.id: each.driver for each in torques.pairs.values() if each.driver and not each.loose}
            flows = flows if torques.verdict else {}
            # the last first: no order of reading has a part in it
            own = train.mechanics.drivers(state)
            drivers = {pair: own[pair] for pair in reversed(list(own))}
            said = {pair: who.wheel for pair, who in drivers.items() if who.why.startswith("power flow under the")}
            declared = {pair for pair, who in drivers.items() if who.why == "declared"}
            told = {pair: flows[pair] for pair in flows if pair in drivers and pair not in declared}
            assert said == told, (name, state)
            assert drivers == dict(shipped.train(name).mechanics.drivers(state))
            found += len(said)
    assert found > 13


@pytest.mark.parametrize("name", TOOTHED)
def test_an_output_moves_alone_as_it_does_with_all_others(name: str) -> None:
    """To the last bit, both ways, though only the pairs that it depends on are in its solved order."""
    train = shipped.train(name)
    state = next(iter(train.states), None)
    together = train.motion(state)
    for turns in (1.7, -1.3):
        (every,) = together._stretches(turns, 101)
        for at, output in enumerate(together.outputs):
            (own,) = train.motion(state, outputs=[output])._stretches(turns, 101)
            assert (own.error[0] == every.error[at]).all(), output
            assert (own.rate[0] == every.rate[at]).all(), output


@pytest.mark.parametrize("name", ["pennestri-2002-teeth", "moon-triangular"])
def test_a_pair_written_the_other_way_round_moves_alike_from_the_same_phase(name: str) -> None:
    train = shipped.train(name)
    motion = train.motion()
    meshes = {mesh.name: mesh for mesh in train.meshes}
    swapped = []
    for source in motion._forward.sources:
        mesh, transmission = meshes[source.id], source.transmission
        first, second = mesh.gear.pair
        # where a tooth of the wheel that is now written first stands
        phase = source.phase / transmission.period
        if second != mesh.driver:
            phase = float(transmission.angle(source.phase)) / (float(transmission.ratio) * transmission.period)
        swapped.append(f"  - {{id: {source.id}, pair: [{second}, {first}], phase: {phase!r}}}")
    other = load(f"extends: {name}\nname: swapped\ngears:\n" + "\n".join(swapped)).motion()
    turns = np.linspace(0, 2, 201)
    assert np.abs(other.at(turns).error - motion.at(turns).error).max() < 1e-9


@pytest.mark.parametrize("pair", ["o, c", "c, o"])
def test_a_phase_that_vanishes_is_none(pair: str) -> None:
    turns = np.linspace(0, 3, 301)

    def moved(phase: str) -> np.ndarray:
        text = BEHIND.format(pair=pair, window="0.5", rest="").replace("id: behind", f"id: behind, phase: {phase}")
        return load(text).motion(outputs=["out"])._unset.at(turns).error[0]

    assert np.abs(moved("1e-9") - moved("0")).max() < 1e-8
    assert np.abs(moved("0.3") - moved("0")).max() > 1e-4


def test_the_moon_of_a_train_with_driven_first_wheels_starts_with_their_teeth_on_the_line() -> None:
    """By hand: the four pairs to the Moon, each a law of the wheel before; of the last the first wheel is driven."""
    train = shipped.train("pennestri-2002-teeth")
    transmissions = {mesh.name: mesh.transmission for mesh in train.meshes}
    motion = train.motion(outputs=["moon"])
    turns = np.linspace(0, 5, 5001)
    S: Any = 2 * np.pi * turns
    for name in ("G2", "G3", "G11"):
        S = transmissions[name].angle(S) - transmissions[name].angle(0.0)
    last = transmissions["G6"]
    # the driver's angle that has a tooth of the driven wheel on the line of centres: its front flank touches there
    guesses = np.linspace(-2, 2, 400_001) * last.period
    start = guesses[np.argmin(np.abs(last.angle(guesses)))]
    q = last.angle(start + S) - last.angle(start)
    error = motion.at(turns).error[0]
    mean = float(train.solve()["5"] / 5)
    sign = 1 if mean > 0 else -1
    assert np.abs(sign * q - mean * 2 * np.pi * turns - error).max() < 1e-5


@pytest.mark.parametrize("name", ["freeth-2021-teeth", "pennestri-2002-teeth", "moon-triangular", "freeth-2021"])
def test_pointers_are_set(name: str) -> None:
    """At turn 0 all stands as with ideal teeth, in motion, tables, scenes and pictures."""
    train = shipped.train(name)
    motion = train.motion()
    assert np.abs(motion.at(np.zeros(1)).error).max() < 1e-12
    row = call("motion", name, "--turns", 1, "--samples", 3, "-o", "-.csv").stdout.splitlines()[1]
    assert max(abs(float(cell)) for at, cell in enumerate(row.split(",")[1:]) if at % 3 < 2) < 1e-12


def test_pins_keep_what_they_show_at_the_start() -> None:
    """A pin that starts aside turns its slot aside, and setting the pointers does not take that away."""
    angle = "links: {k1: {angle: 40 deg}}\n"
    real, ideal = (
        load(f"extends: {name}\nname: turned\n{angle}").motion() for name in ("freeth-2021-teeth", "freeth-2021")
    )
    shown, right = (motion.at(np.zeros(1)).error[:, 0] for motion in (real, ideal))
    assert np.abs(right).max() > 0.01
    assert np.abs(shown - right).max() < 1e-12


def lag_of(motion: Motion) -> float:
    return max(abs(each) for each in motion.pointer_offsets.values())


def test_what_is_set_away_is_the_lag_of_the_teeth() -> None:
    assert degrees(lag_of(shipped.train("freeth-2021-teeth").motion(outputs=["moon"]))) > 40
    assert lag_of(shipped.train("freeth-2021").motion()) == 0


UNLOADED = "extends: pennestri-2002-teeth\nname: unloaded\nloads: null\n"


@pytest.mark.slow
def test_where_power_leaves_it_open_both_ways_are_given(train_file: Callable[[str], Path]) -> None:
    found = json.loads(call("report", str(train_file(UNLOADED)), "--json").stdout)
    (found,) = found if isinstance(found, list) else (found,)
    ways = [each for each in found["teeth"] if each["pair"] == "G5"]
    assert {each["driver"] for each in ways} == {"Zb4", "Z15"}
    assert not any(each["determined"] for each in ways)
    assert all(
        each["driver_is"].startswith("undetermined: power flows from Z15 to Zb4 for 16, 17, 18 and 2 more")
        for each in ways
    )
    certain = [each for each in found["teeth"] if each["pair"] != "G5"]
    assert len(certain) == 17
    assert all(each["determined"] for each in certain)


def test_each_state_has_its_own_driver() -> None:
    ways = shipped.train("bevel-differential-involute").mechanics.driven_ways["pinion~c41"]
    assert {mesh.driver for mesh, _ in ways} == {"pinion", "c41"}
    assert sorted(state for _, states in ways for state in states).count("one wheel held") == 1
