"""Simulated run in a browser: angles at any time, playback controls, impacts, and states of contacts."""

from __future__ import annotations

import numpy as np
import pytest
import shipped
from conftest import OpenPage, Shown
from viewing import MOVING, Opening, tab, wait

from geartrain import load
from geartrain.scene import Scene, build_scene
from geartrain.simulation import TimeRun
from geartrain.viewer import page

Played = tuple[TimeRun, Scene]


@pytest.fixture(scope="module")
def played() -> Played:
    """Half a turn of the heavy train to the Moon, with separations and impacts of teeth."""
    train = shipped.train("moon-triangular-inertia")
    run = train.dynamics(rate="1 turn/s", turns=0.25, skip=0.25, steps=3000, restitution=0.3, samples=10**6, fast=False)
    return run, build_scene(train, run=run)


@pytest.fixture
def shown(played: Played, show_html: OpenPage, request: pytest.FixtureRequest) -> Shown:
    return show_html(page([played[1]], teeth=False), **getattr(request, "param", {}))


def times(played: Played, count: int = 40) -> tuple[list[int], list[float]]:
    """Return indices of some samples of the run, and the positions of the crank there [turns]."""
    run, scene = played
    first = int(np.argmax(run.time > run.skip - run.step / 2))
    chosen = np.linspace(first, len(run.time) - 1, count).round().astype(int)
    return chosen.tolist(), ((run.time[chosen] - run.time[first]) / scene.run.period).tolist()


def test_bodies_and_pointers_stand_where_the_simulation_has_them(played: Played, shown: Shown) -> None:
    run, scene = played
    samples, turns = times(played)
    names = [body.id for body in scene.bodies]
    found = shown.run(
        """([turns, names]) => turns.map((each) => {
          geartrain.setTurns(each);
          const { bodies } = geartrain.scenes[0];
          return names.map((name, index) => bodies[index].sense * geartrain.angle(0, name));
        })""",
        [turns, names],
    )
    # both relative to their start: the page adds the pose in which all drive flanks are in contact
    start = shown.run("(names) => names.map((name, index) => geartrain.machines[0].initial[index])", names)
    expected = np.array([run.angles[name][samples] for name in names]).T
    off = np.array(found) - np.array(start) - expected
    assert np.abs(off).max() < 1.5 * scene.run.tolerance
    ahead = shown.run(
        """(turns) => turns.map((each) => { geartrain.setTurns(each); return geartrain.machines[0].aheadBy(1); })""",
        turns,
    )
    assert scene.pointers[1].output == "moon"
    assert np.abs(np.array(ahead) - run.ahead["moon"][samples]).max() < 3 * scene.run.tolerance
    assert max(ahead) > 0.01
    assert shown.errors == []


def glow(shown: Shown) -> float:
    """Return the current brightness of the brightest impact."""
    script = """() => {
      const { run } = geartrain.machines[0];
      return Math.max(...run.contacts.map((_, n) => run.flash(n, geartrain.machines[0].time())));
    }"""
    return float(shown.run(script))


def test_the_next_impact_is_found_and_seen(played: Played, shown: Shown) -> None:
    scene = played[1]
    first = min(each.impact_times[0] for each in scene.run.contacts if len(each.impact_times))
    assert glow(shown) == 0
    shown.page.get_by_label("next impact").click()
    assert shown.run("geartrain.machines[0].time()") == pytest.approx(float(first), abs=1e-6)
    assert glow(shown) >= 0.3
    shown.page.get_by_label("previous impact").click()
    assert shown.run("geartrain.machines[0].time()") == 0


def test_the_table_of_contacts_tells_what_each_does_now(played: Played, shown: Shown) -> None:
    run, _ = played
    tab(shown, "Contacts")
    samples, turns = times(played, 30)
    front, back = run.gaps["d2~e"][samples], run.coast_gaps["d2~e"][samples]
    apart = [at for at in range(30) if min(front[at], back[at]) > 1e-3]
    touching = [at for at in range(30) if front[at] < 1e-7]
    words = {}
    for name, at in (("separated", apart[0]), ("drive flank", touching[0])):
        shown.run("(turns) => geartrain.setTurns(turns)", turns[at])
        words[name] = shown.page.locator("[data-contact='d2~e'] .now").inner_text()
    assert words == {name: name for name in words}
    share = f"{100 * run['d2~e'].apart:.1f} %"  # type: ignore[union-attr]
    assert share in shown.page.locator("[data-contact='d2~e']").inner_text()


def test_the_same_train_stands_beside_with_all_drive_flanks_touching(played: Played, shown: Shown) -> None:
    run = played[0]
    samples, turns = times(played, 8)
    shown.page.get_by_label("Beside").select_option("drive flanks in contact")
    gaps = shown.run(
        """(turns) => turns.map((each) => {
          geartrain.setTurns(each);
          const [one, other] = [0, 1].map((scene) => geartrain.pointer(scene, "moon").angle);
          return Math.atan2(Math.sin(one - other), Math.cos(one - other));
        })""",
        turns,
    )
    expected = run.ahead["moon"][samples]
    assert np.abs(np.abs(gaps) - np.abs(expected)).max() < 3e-4
    assert np.abs(expected).max() > 0.01
    assert shown.errors == []


def test_a_contact_that_is_chosen_is_shown_in_the_picture(shown: Shown) -> None:
    tab(shown, "Contacts")
    shown.page.locator("[data-contact='d2~e'] button").click()
    lit = shown.run("[...geartrain.stages[0].world.looks.chosen.wheels].map((n) => geartrain.scenes[0].wheels[n].id)")
    assert sorted(lit) == ["d2", "e"]


def test_the_strip_goes_to_the_moment_that_is_tapped(shown: Shown) -> None:
    box = shown.page.locator(".strip").bounding_box()
    shown.page.mouse.click(box["x"] + box["width"] - 1, box["y"] + 5)
    later = shown.run("geartrain.machines[0].time()")
    assert later > 0
    shown.page.mouse.move(box["x"] + box["width"] / 2, box["y"] + 5)
    shown.page.mouse.down()
    shown.page.mouse.move(box["x"] + box["width"] / 2 - 60, box["y"] + 5, steps=3)
    shown.page.mouse.up()
    assert shown.run("geartrain.machines[0].time()") > later


@pytest.mark.parametrize("shown", [MOVING], indirect=True)
def test_a_run_plays_and_stops_at_its_end_or_begins_again(shown: Shown) -> None:
    shown.page.get_by_label("Repeat").uncheck()
    shown.page.get_by_role("slider", name="Speed").fill("1")
    shown.page.get_by_role("button", name="play", exact=True).click()
    wait(shown, "geartrain.machines[0].time() > 0.2499")
    shown.page.get_by_role("button", name="play", exact=True).wait_for()
    shown.page.get_by_label("Repeat").check()
    shown.page.get_by_role("button", name="play", exact=True).click()
    wait(shown, "geartrain.machines[0].time() > 0.15")
    wait(shown, "geartrain.machines[0].time() < 0.15")
    shown.page.get_by_role("button", name="pause", exact=True).click()
    assert shown.errors == []
    assert shown.requests == []


def test_a_page_without_a_run_has_its_crank_and_no_table_of_contacts(show: Opening) -> None:
    plain = show("planetary-24-18-60")
    assert plain.page.get_by_role("slider", name="crank").count() == 1
    assert plain.page.get_by_role("tab", name="Contacts").count() == 0


PLANETARY = """
extends: planetary-24-18-60
links: {sun: {inertia: 1e-6 kg m2}, planet: {inertia: 1e-6 kg m2}, carrier: {inertia: 1e-5 kg m2, bearing: 1 N mm}}
gears: [{pair: [s, p], efficiency: 0.98}, {pair: [p, ring], efficiency: 0.98}]
"""


def test_places_of_contacts_go_with_the_carrier_and_stay_on_both_pitch_circles(show_html: OpenPage) -> None:
    train = load(PLANETARY)
    run = train.dynamics(rate="1 turn/s", turns=1, skip=0, steps=1000, fast=False)
    shown = show_html(page([build_scene(train, run=run)], teeth=False))
    rows = shown.run(
        """() => {
          geartrain.setTurns(0.77);
          const { world } = geartrain.stages[0];
          world.turn();
          const { run, pairs, wheels } = geartrain.scenes[0];
          const { position } = world.sparks.geometry.attributes;
          const at = (node, point) => node.matrixWorld.elements.slice(12, 15).map((own, row) =>
            own + point.reduce((sum, value, column) => sum + value * node.matrixWorld.elements[row + 4 * column], 0));
          return run.contacts.flatMap(({ name }, n) => pairs.find(({ id }) => id === name).wheels.map((index) => {
            const { centre, body, radius } = wheels[index];
            const [x, y, z] = at(world.nodes[body], centre);
            return [Math.hypot(position.getX(n) - x, position.getY(n) - y, position.getZ(n) - z), radius];
          }));
        }"""
    )
    assert len(rows) == 4
    for found, radius in rows:
        assert found == pytest.approx(radius, rel=1e-5)
