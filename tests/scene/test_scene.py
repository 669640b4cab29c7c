"""Scene: bodies, speeds, wheels, dials, pointers and verdict, compared with the declaration and exact arithmetic."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from math import cos, hypot, isclose, radians, sin
from typing import Any

import numpy as np
import pytest
import shapely
import shipped
from hypothesis import given, settings
from models import pair, planetary
from reference_solver import _dense as solve_rows
from reference_solver import rigid_rows, solve_naively, turning_graph, willis_rows
from sampling import few_or_many
from strategies import driven_trains, requested_trains, rerooted

from geartrain import GearTrain, load
from geartrain.scene import Scene, engrave, make_scene, scene_pose

SAMPLE = few_or_many(20, 40)  # `--slow` draws new trains, and twice as many
SHIPPED = [
    *(("gm-4t60", "R"), ("bevel-differential", "turn"), ("prius-power-split", "electric"), ("freeth-2021", None)),
    *(("freeth-2021-teeth", None), ("south-pointing-chariot", None), ("ferguson-paradox", None), ("worm", None)),
    *(("lantern-mill", None), ("longcase-clock-cycloidal", None), ("vitruvius-hodometer", None)),
]


@pytest.mark.parametrize(("name", "state"), SHIPPED)
def test_speeds_are_the_exact_ones_and_all_numbers_point_somewhere(name: str, state: str | None) -> None:
    train = shipped.train(name).unfolded
    scene = shipped.scene(name, state)
    answer = train.solve(state or (train.states[0] if train.states else None))
    assert scene.driving_link is not None
    lead = Fraction(answer[scene.bodies[scene.driving_link].id])
    for body in scene.bodies:
        assert Fraction(body.shown or "") == answer.speeds[body.id]
        assert Fraction(body.speed or "") * lead == answer.speeds[body.id]
    for pointer in scene.pointers:
        assert Fraction(pointer.shown or "") == answer[pointer.output]
    _check_numbers(scene)
    json.dumps(scene.to_dict(), allow_nan=False)


def _check_numbers(scene: Scene) -> None:
    bodies, pairs = range(len(scene.bodies)), {each.id for each in (*scene.pairs, *scene.couplings)}
    for body in scene.bodies:
        assert body.parent is None or body.parent in bodies
        assert isclose(hypot(*body.direction), 1)
    for wheel in scene.wheels:
        assert wheel.body in bodies
        assert wheel.profile in range(len(scene.profiles))
        assert abs(sum(a * b for a, b in zip(wheel.reference, wheel.direction, strict=True))) < 1e-9
        assert (wheel.tip < wheel.root) == (wheel.kind == "ring")
        assert set(wheel.circuits) <= pairs
    for pointer in scene.pointers:
        assert set(pointer.pairs) <= pairs
        assert pointer.dial is None or pointer.dial in range(len(scene.dials))


@settings(max_examples=SAMPLE)
@given(requested_trains())
def test_every_train_has_a_scene_whatever_its_verdict(data: dict[str, Any]) -> None:
    scene = make_scene(GearTrain.declare(data))
    truth = solve_naively(data)
    assert scene.verdict["kind"] == truth.kind
    moves = truth.kind == "determined" and any(data.get("inputs", {}).values())
    assert scene.movement.kind == ("exact" if moves else "still")
    for body in scene.bodies:
        if truth.kind == "determined":
            assert Fraction(body.shown or "") == truth.speeds[body.id]
    json.dumps(scene.to_dict(), allow_nan=False)


@settings(max_examples=SAMPLE)
@given(driven_trains(couplings=False).flatmap(lambda data: rerooted(data).map(lambda other: (data, other))))
def test_a_body_hangs_on_the_link_that_bears_its_axis_however_coaxial_joints_are_declared(
    both: tuple[dict[str, Any], dict[str, Any]],
) -> None:
    for data in both:
        graph, train = turning_graph(data), GearTrain.declare(data)
        bodies = make_scene(train).bodies
        for body in bodies:
            if body.parent is None:
                assert body.id == "frame"
                continue
            parent = bodies[body.parent]
            # the parent turns about another axis, or is the frame; all joints between them are on the body's axis
            assert parent.id == "frame" or parent.axis != body.axis
            labels = _labels(graph, body.id, parent.id)
            assert set(labels) == {body.axis}


def _labels(graph: Any, a: str, b: str) -> list[str]:
    import networkx as nx

    path = nx.shortest_path(graph, a, b)
    return [graph.edges[step]["axis"] for step in pairwise(path)]


@settings(max_examples=SAMPLE)
@given(driven_trains())
def test_an_output_hangs_on_the_pairs_whose_error_moves_it(data: dict[str, Any]) -> None:
    scene = make_scene(GearTrain.declare({**data, "outputs": dict.fromkeys(data["links"])}))
    rows, _ = willis_rows(data)
    names = [each.id for each in (*scene.pairs, *scene.couplings)]
    base = _speeds(data, rows, None)
    moved = {name: _speeds(data, rows, at) for at, name in enumerate(names)}
    if not all(moved.values()):
        return  # an error in a redundant pair has no solution
    swings = {
        each.id: {name for name in names if moved[name][pin] - moved[name][carrier] != base[pin] - base[carrier]}
        for each in scene.couplings
        if each.kind == "pin_follower"
        for pin, carrier in [(scene.bodies[each.pin].id, scene.bodies[each.carrier].id)]
    }
    for pointer in scene.pointers:
        wanted = {name for name in names if moved[name][pointer.output] != base[pointer.output]}
        for _ in swings:
            wanted |= {name for follower in wanted & set(swings) for name in swings[follower]}
        assert set(pointer.pairs) == wanted
        assert len(pointer.pairs) == len(wanted)


def _speeds(data: Mapping[str, Any], rows: list[dict[str, Fraction]], wrong: int | None) -> dict[str, Fraction]:
    """Return the speeds with an error of 1/7 in one circuit; empty without a unique solution."""
    frame = data.get("frame", "frame")
    links = [link for link in data["links"] if link != frame]
    one, zero = Fraction(1), Fraction(0)
    system = [(row, Fraction(1, 7) if at == wrong else zero) for at, row in enumerate(rows)]
    system += [(row, zero) for row in rigid_rows(data)]
    system += [({link: one}, Fraction(speed)) for link, speed in data.get("inputs", {}).items()]
    matrix, pivots, consistent = solve_rows(system, links)
    return (
        {}
        if not consistent or len(pivots) < len(links)
        else {frame: zero} | {links[column]: row[-1] for row, column in zip(matrix, pivots, strict=False)}
    )


def test_pairs_of_a_path_come_in_order_from_the_input() -> None:
    scene = shipped.scene("longcase-clock")
    for pointer in scene.pointers:
        wheels = {each.id: each.wheels for each in scene.pairs}
        known = {scene.bodies[scene.driving_link or 0].id}
        for name in pointer.pairs:
            links = {scene.bodies[scene.wheels[at].body].id for at in wheels[name]}
            assert links & known
            known |= links


def test_all_planets_in_parallel_are_on_the_path() -> None:
    scene = shipped.scene("three-planets")
    assert all(set(pointer.pairs) == {each.id for each in scene.pairs} for pointer in scene.pointers)


def test_a_loop_that_does_not_close_is_marked_pair_by_pair() -> None:
    three = {
        "links": {"frame": {}, **{link: {"wheels": {f"w{link}": 20}} for link in "abcd"}},
        "revolutes": [{"pair": ["frame", link], "axis": link} for link in "abcd"],
        "gears": [{"id": f"{i}{j}", "pair": [f"w{i}", f"w{j}"]} for i, j in ("ab", "bc", "ca", "cd")],
        "inputs": {"a": 1},
    }
    scene = make_scene(GearTrain.declare(three))
    assert scene.verdict["kind"] == "locked"
    assert [set(loop["pairs"]) for loop in scene.verdict["loops"]] == [{"ab", "bc", "ca"}]
    assert {each.id for each in scene.pairs if each.broken} == {"ab", "bc", "ca"}
    assert all(each.fault for each in scene.pairs if each.broken)
    assert scene.verdict["advice"]
    assert scene.movement.kind == "still"
    assert all(body.speed is None for body in scene.bodies if body.id in "abcd")


def test_a_train_that_is_free_or_stands_shows_no_speeds_that_it_does_not_have() -> None:
    free = make_scene(planetary("inputs: {}"))
    assert (free.verdict["kind"], free.driving_link, free.movement.kind) == ("free", None, "still")
    held = make_scene(pair("inputs: {a: 0}"))
    assert held.movement.kind == "still"


def test_the_circuit_reads_as_an_equation() -> None:
    scene = make_scene(planetary())
    assert [each.text for each in scene.pairs] == [
        "24 (sun - carrier) + 18 (planet - carrier) = 0",
        "18 (planet - carrier) - 60 (frame - carrier) = 0",
    ]
    assert [each.ratio for each in scene.pairs] == ["-3/4", "10/3"]


def test_the_circuit_in_words_holds_for_the_declared_speeds_of_opposed_axes() -> None:
    train = load(
        """
links: {frame: {}, a: {wheels: {p: 20}}, b: {wheels: {w: 60}}}
axes: {A: {}, B: {direction: [0, 0, -1]}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
gears: [{pair: [p, w]}]
inputs: {a: 1}
"""
    )
    scene = make_scene(train)
    assert scene.pairs[0].text == "20 (a - frame) + 60 (-b - frame) = 0"
    assert [(body.sense, body.direction) for body in scene.bodies][2] == (-1, (0.0, 0.0, 1.0))
    assert scene.bodies[2].shown == "1/3"


DIALS = """
view: {{from: front, positive: {positive}}}
links: {{frame: {{}}, a: {{wheels: {{p: 20}}}}, b: {{wheels: {{w: 60}}}}}}
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}]
gears: [{{pair: [p, w]}}]
inputs: {{a: 1}}
dials: {{near: {{face: front, turns: 4, divisions: 223}}, far: {{face: back}}}}
outputs: {{a: {{dial: near}}, b: {{dial: far}}, c: {{of: b, relative_to: a}}}}
"""


@pytest.mark.parametrize("positive", ["clockwise", "counter-clockwise"])
def test_dials_look_to_their_reader_and_stand_clear_of_the_wheels(positive: str) -> None:
    scene = make_scene(load(DIALS.format(positive=positive)))
    near, far = scene.dials
    assert near.normal == (0.0, 0.0, float(scene.front))
    assert far.normal == (0.0, 0.0, -float(scene.front))
    assert (near.scale.turns, near.scale.divisions) == (4, 223)
    assert 0 < near.scale.inner < near.scale.outer == 1
    for dial in (near, far):
        for wheel in scene.wheels:
            assert (dial.centre[2] - wheel.centre[2]) * dial.normal[2] > wheel.thickness / 2
    a, b, c = scene.pointers
    assert (a.dial, b.dial, c.dial) == (0, 1, None)
    # the declared sense is that for a viewer of the front
    assert a.sense == (1 if positive == "clockwise" else -1)
    assert b.sense == -a.sense
    assert a.text == f"{positive} as read"
    # b turns backwards, and is read from behind
    assert b.text == f"{positive} as read"
    assert (c.shown, scene.bodies[c.base].id) == ("-4/3", "a")


def test_a_dial_on_a_narrow_side_is_small() -> None:
    """The draconic dial faces along the crank's axis, on a side whose depth is a fifth of its height."""
    scene = shipped.scene("voulgaris-2022")
    dial = next(dial for dial in scene.dials if abs(dial.normal[0]) > 0.9)
    deep = [side * wheel.thickness / 2 + wheel.centre[2] for wheel in scene.wheels for side in (-1, 1)]
    high = [side * wheel.radius + wheel.centre[1] for wheel in scene.wheels for side in (-1, 1)]
    assert max(deep) - min(deep) < 0.2 * (max(high) - min(high))
    assert 0.05 < dial.radius / (max(high) - min(high)) < 0.15


def test_dials_of_one_face_do_not_cover_each_other() -> None:
    engraved: dict[tuple[float, ...], list[Any]] = {}
    for face in shipped.scene("freeth-2021").dials:
        if face.look == "scale":
            lines = [line for part in engrave(face.scale) for line in part.lines]
            # x is to the right of the reader: -x of the scene for readers who look along +z
            right = np.array([[face.normal[2], 0.0], [0.0, 1.0]])
            placed = [np.array(line) @ right * face.radius + np.array(face.centre[:2]) for line in lines]
            engraved.setdefault(face.normal, []).append(shapely.MultiLineString(placed))
    assert sorted(map(len, engraved.values())) == [1, 5]
    for faces in engraved.values():
        for at, one in enumerate(faces):
            assert all(shapely.distance(one, other) > 0.1 for other in faces[:at])


def test_sizes_stay_small_enough_for_a_page() -> None:
    assert len(json.dumps(shipped.scene("freeth-2021").to_dict())) < 480_000  # engraved dials are half of it
    assert len(json.dumps(shipped.scene("freeth-2021-teeth").to_dict())) < 800_000


def test_what_is_lost_at_wheels_sums_to_what_is_lost_between_teeth() -> None:
    torques = shipped.train("lantern-mill").torques()
    scene = shipped.scene("lantern-mill")
    lost = sum(float(each.loss) for each in torques.pairs.values()) / float(torques.power_in)
    assert lost > 0.01
    assert isclose(sum(wheel.loss or 0.0 for wheel in scene.wheels), lost, rel_tol=1e-12)


def test_a_follower_hangs_on_what_turns_its_pin() -> None:
    scene = shipped.scene("freeth-2021")
    paths = {pointer.output: set(pointer.pairs) for pointer in scene.pointers}
    assert paths["venus"] == {"x51~spC44", "spC34~ve26", "ve26~r1", "venus"}
    assert paths["mercury"] == {"x51~spA72", "spA89~me40", "me40~me20", "mercury"}


def test_bodies_carried_by_thousands_of_others_are_posed_in_any_order() -> None:
    """Chain of arms, the last declared first: each is turned by a degree relative to its parent."""
    scene = shipped.scene("planetary-24-18-60")
    carried = next(body for body in scene.bodies if body.parent is not None)
    count = 3000
    bodies = [
        replace(carried, parent=at + 1, start=radians(count - 1 - at), speed="0", point=(1.0, 0.0, 0.0), sense=1)
        for at in range(count - 1)
    ]
    ground = next(body for body in scene.bodies if body.parent is None)
    tower = replace(scene, bodies=(*bodies, replace(ground, start=0.0)), movement=replace(scene.movement, steps=()))
    found = scene_pose(tower)
    for at in (0, 1, 1500, 2998):
        angle = radians(count - 1 - at)
        assert found.turned[at][:2, 0] == pytest.approx([cos(angle), sin(angle)], abs=1e-9)


@pytest.mark.parametrize("make", [shipped.scene, shipped.built])
def test_the_ball_of_the_moons_phase_stands_in_the_moons_pointer(make: Callable[[str], Scene]) -> None:
    """It is at half the radius on the pointer in its initial position, with the pointer as its axis."""
    scene = make("freeth-2021")
    dials, moon = {dial.id: dial for dial in scene.dials}, next(p for p in scene.pointers if p.output == "moon")
    phase, zodiac = dials["phase"], dials["zodiac"]
    assert (phase.look, zodiac.look) == ("ball", "scale")
    assert scene.bodies[phase.body].id == "moon"
    way = np.subtract(phase.centre, zodiac.centre)
    assert way @ np.array(zodiac.zero) == pytest.approx(zodiac.radius / 2)
    assert np.linalg.norm(np.cross(phase.normal, zodiac.zero)) == pytest.approx(0, abs=1e-9)
    assert way @ np.array(zodiac.normal) == pytest.approx(moon.level)
    assert 0 < phase.radius < zodiac.radius / 10


def test_notices_name_the_file_and_no_folder() -> None:
    """A page is read on other machines, so notices must not contain folders."""
    places = [notice["place"] for notice in shipped.scene("prague-orloj").notices]
    assert "prague-orloj.yaml:16" in places
    assert not any("/" in place or "\\" in place for place in places)
