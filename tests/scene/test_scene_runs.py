"""Simulated run in a scene: angles, contacts and impacts as stored in a page, compared with the run."""

from __future__ import annotations

from base64 import b64decode
from typing import Any

import numpy as np
import pytest
import shipped
from commands import HEAVY

import geartrain
from geartrain.errors import QuestionError
from geartrain.scene import Scene, make_scene
from geartrain.simulation import TimeRun

CLOCK = """
links: {frame: {}, barrel: {wheels: {g: 60}, inertia: 1e-5 kg m2},
  escape: {wheels: {p: 10, e: 30}, inertia: 1e-7 kg m2, bearing: 0.01 N mm}}
revolutes: [{pair: [frame, barrel], axis: A}, {pair: [frame, escape], axis: B}]
gears: [{pair: [g, p]}]
inputs: {barrel: 1}
outputs: {escape: {}}
drive: {torque: 10 N mm}
escapement: {link: escape, teeth: 30, beat: 0.1 s}
"""


@pytest.fixture(scope="module")
def pin() -> tuple[TimeRun, Scene]:
    """Pin with clearance in its slot, at a speed at which it separates and strikes."""
    train = geartrain.load(HEAVY.replace("offset: 8 mm", "offset: 8 mm, clearance: 0.5 mm"))
    run = train.dynamics(rate="1 turn/s", turns=1.5, skip=0.5, steps=2000, restitution=0.3, samples=10**6, fast=False)
    return run, make_scene(train, run=run)


def numbers(text: str, kind: str) -> Any:
    return np.frombuffer(b64decode(text), dtype=kind)


def turned(scene: Scene, body: int, time: Any) -> Any:
    """Return the angle of a body from the data of the page."""
    told = scene.to_dict()["run"]
    link = told["links"][body]
    kept = numbers(link["samples"], "<u4") * told["step"]
    return link["rate"] * time + np.interp(time, kept, numbers(link["angles"], "<f4"))


def test_angles_of_a_page_are_those_of_the_run_within_the_tolerance_told(pin: tuple[TimeRun, Scene]) -> None:
    run, scene = pin
    assert scene.run is not None
    shown = run.time > run.skip - run.step / 2
    since = run.time[shown] - run.time[shown][0]
    assert scene.run.duration == pytest.approx(run.duration, rel=1e-3)
    for body in scene.bodies:
        expected = run.angles[body.id][shown]
        assert np.abs(turned(scene, scene.bodies.index(body), since) - expected).max() < 1.01 * scene.run.tolerance
    kept = sum(len(link.samples) for link in scene.run.links)
    assert kept < 0.1 * run.angles.values.size


def test_what_a_contact_does_adds_up_to_the_shares_that_the_run_counted(pin: tuple[TimeRun, Scene]) -> None:
    run, scene = pin
    assert scene.run is not None
    (contact,) = scene.run.contacts
    lengths = np.diff([*contact.changes, round(scene.run.duration / scene.run.step) + 1]) * scene.run.step
    states = np.array(list(contact.states))
    assert lengths[states == "a"].sum() / lengths.sum() == pytest.approx(run.contacts[0].apart, abs=0.01)
    assert run.contacts[0].apart > 0.05
    assert (contact.kind, contact.body) == ("pin", scene.couplings[0].pin)
    assert contact.at == scene.couplings[0].pin_at


def test_every_impact_is_kept_or_lies_within_a_sample_of_a_harder_one(pin: tuple[TimeRun, Scene]) -> None:
    run, scene = pin
    assert scene.run is not None
    (contact,) = scene.run.contacts
    start = run.time[run.time > run.skip - run.step / 2][0]
    times = run.impacts.time - start
    assert len(times) == run.impacts.total > 3
    for time, speed in zip(times, run.impacts.speed, strict=True):
        near = np.abs(contact.impact_times - time) < scene.run.step
        assert contact.impact_speeds[near].max() >= speed
    assert contact.impact_speeds.max() == run.impacts.speed.max()


def test_teeth_meet_where_pitch_circles_touch() -> None:
    train = shipped.train("moon-triangular-inertia")
    run = train.dynamics(rate="0.2 turn/s", turns=0.05, skip=0, steps=2000, fast=False)
    scene = make_scene(train, run=run)
    assert scene.run is not None
    for contact in scene.run.contacts:
        pair = next(each for each in scene.pairs if each.id == contact.name)
        for wheel in (scene.wheels[each] for each in pair.wheels):
            away = np.linalg.norm(np.subtract(contact.at, wheel.centre)[:2])
            assert away == pytest.approx(wheel.radius, rel=1e-6)
    # without omitted turns the run starts in its initial pose
    assert all(link.samples[0] == 0 and link.angles[0] == 0 for link in scene.run.links)


@pytest.fixture(scope="module")
def clock() -> tuple[TimeRun, Scene]:
    train = geartrain.load(CLOCK)
    run = train.dynamics(turns=0.03, skip=0.0, steps=50_000, samples=10**6, fast=False)
    return run, make_scene(train, run=run)


def test_an_escapement_strikes_at_the_rim_of_its_wheel_once_a_beat(clock: tuple[TimeRun, Scene]) -> None:
    _, scene = clock
    assert scene.run is not None
    contact = next(each for each in scene.run.contacts if each.kind == "escapement")
    assert contact.states == ""
    gaps = np.diff(contact.impact_times[contact.impact_speeds > 0.5 * contact.hardest])
    assert np.allclose(gaps, 0.1, atol=0.01)
    wheel = next(each for each in scene.wheels if each.id == "e")
    assert np.linalg.norm(np.subtract(contact.at, wheel.centre)) == pytest.approx(wheel.radius)


def test_a_pair_without_backlash_is_on_its_drive_flank() -> None:
    train = geartrain.load(CLOCK.replace("[g, p]", "[g, p], efficiency: 0.9"))
    scene = make_scene(train, run=train.dynamics(turns=0.01, skip=0.0, steps=50_000, fast=False))
    assert scene.run is not None
    assert [each.states for each in scene.run.contacts if each.kind == "pair"] == ["d"]


def test_the_lead_is_kept_so_finely_that_the_fastest_link_follows_from_it(clock: tuple[TimeRun, Scene]) -> None:
    run, scene = clock
    off = np.abs(turned(scene, 1, run.time) - run.angles["barrel"]).max()
    assert off < 1.01e-4 / 6  # a pinion of 10 meshes with a wheel of 60


def test_a_run_of_another_train_is_refused(pin: tuple[TimeRun, Scene]) -> None:
    with pytest.raises(QuestionError, match="pass the run of the same train"):
        make_scene(shipped.train("planetary-24-18-60"), run=pin[0])


def test_teeth_that_yield_are_played_too() -> None:
    teeth = "[g, p], tooth_form: {form: involute}, stiffness: 0.01 N m/rad"
    train = geartrain.load(CLOCK.replace("[g, p]", teeth).partition("drive:")[0])
    run = train.dynamics(rate="1 turn/s", turns=0.02, skip=0.0, model="compliant", fast=False)
    scene = make_scene(train, run=run)
    assert scene.run is not None
    assert np.abs(turned(scene, 2, run.time) - run.angles["escape"]).max() < 1.01 * scene.run.tolerance


def test_a_scene_without_a_run_says_nothing_of_one() -> None:
    assert "run" not in shipped.scene("planetary-24-18-60").to_dict()


def test_equal_planets_all_move_as_the_one_that_was_simulated() -> None:
    train = geartrain.load("""
        links:
          frame: {wheels: {r: {teeth: 60, internal: true}}}
          sun: {wheels: {s: 24}, inertia: 1e-6 kg m2}
          planet: {wheels: {p: 18}, copies: 3, inertia: 1e-7 kg m2, mass: 10 g}
          carrier: {inertia: 1e-5 kg m2, bearing: 1 N mm}
        revolutes: {main: [frame, sun, carrier], P: [carrier, planet]}
        gears: [{pair: [s, p], tooth_form: involute}, {pair: [p, r], tooth_form: involute}]
        inputs: {sun: 1}
    """)
    run = train.dynamics(rate="1 turn/s", turns=1, steps=400)
    scene = make_scene(train, run=run)
    assert scene.run is not None
    names = [body.id for body in scene.bodies]
    courses = dict(zip(names, scene.run.links, strict=True))
    assert {"planet", "planet.2", "planet.3"} <= set(names)
    for other in ("planet.2", "planet.3"):
        assert courses[other].rate == courses["planet"].rate
        assert (courses[other].angles == courses["planet"].angles).all()
    places = [wheel.centre for wheel in scene.wheels if names[wheel.body].startswith("planet")]
    angles = sorted(np.degrees(np.arctan2(y, x)) % 360 for x, y, _ in places)
    assert np.diff(angles) == pytest.approx([120, 120])
