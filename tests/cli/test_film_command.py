"""What `geartrain view` refuses of pictures and films, before a browser is asked."""

from __future__ import annotations

import sys
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import pytest
from commands import LOCKED, call

from geartrain import GearTrainError, load
from geartrain.errors import QuestionError
from geartrain.scene import make_scene
from geartrain.viewer import Shot, film
from geartrain.viewer.film_parts import film_parts


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def refusal(*arguments: object) -> str:
    done = call("view", *arguments)
    assert isinstance(done.exception, GearTrainError), done.output
    assert all(problem.what and problem.fix for problem in done.exception.problems)
    return str(done.exception)


def test_no_film_of_states_where_there_are_none_or_one_is_named(here: Path) -> None:
    assert "'worm' has no states" in refusal("worm", "--states", "--gif")
    for asked in ((), ("--png",), ("--gif", "--state", "sun fixed"), ("--gif", "--dynamics")):
        assert "no film of all states" in refusal("planetary", "--states", *asked)
    assert list(here.iterdir()) == []


def test_states_take_as_long_each_at_one_speed_of_the_lead() -> None:
    train = load("ravigneaux-set")
    scenes = [make_scene(train, state) for state in train.states]
    parts = film_parts(scenes, Shot(seconds=2, fps=10, turntable=1))
    assert [part.scene.state for part in parts] == list(train.states)
    assert {len(part.moments) for part in parts} == {20}
    (step,) = {after - before for part in parts for (before, _), (after, _) in pairwise(part.moments)}
    passed = (
        step * wheel.teeth * Fraction(each.bodies[wheel.body].speed or 0) for each in scenes for wheel in each.wheels
    )
    assert max(map(abs, passed)) < Fraction(1, 2), "teeth are seen to go the way they go, in every state"
    orbits = [orbit for part in parts for _, orbit in part.moments]
    assert orbits == pytest.approx([n / len(orbits) for n in range(len(orbits))]), "the camera goes on"
    closed = ", ".join(element.id for element in scenes[0].elements if element.closed)
    assert parts[0].words is not None
    assert parts[0].words[0] == f"state {train.states[0]}"
    assert f"closed: {closed};" in parts[0].words[1]


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        (("--gif", "--mp4"), ".gif and .mp4 at once"),
        (("--gif", "-o", "x.png"), ".gif and .png at once"),
        (("--gif", "--kiosk"), "--kiosk and .gif at once"),
        (("--embed", "--kiosk"), "--embed and --kiosk at once"),
        (("--look", "front"), "options of a film: --look"),
        (("--size", "100x100", "--fps", "9"), "options of a film: --size, --fps"),
        (("planetary", "--gif"), "two trains"),
        (("planetary", "--embed"), "two trains"),
        (("--png", "--size", "100"), "no size of a picture"),
        (("--png", "--size", "100x1"), "--size is out of range"),
        (("--png", "--size", "9999x9999"), "--size is out of range"),
        (("--png", "--size", "axb"), "no number of points"),
        (("--png", "--apart", "1.5"), "--apart is out of range"),
        (("--png", "--apart", "nan"), "--apart is out of range"),
        (("--gif", "--seconds", "0"), "--seconds is out of range"),
        (("--gif", "--seconds", "inf"), "--seconds is out of range"),
        (("--gif", "--fps", "0"), "--fps is out of range"),
        (("--gif", "--turntable", "nan"), "--turntable is out of range"),
        (("--png", "--at", "x"), "no number of turns"),
        (("--gif", "--turns", "x"), "no number of turns"),
        (("--mp4", "--size", "101x100"), "no MP4 has 101 by 100 points"),
        (("--gif", "--skip", "1"), "options of motion in time"),
    ],
)
def test_what_does_not_go_together_is_refused(here: Path, asked: tuple[str, ...], said: str) -> None:
    assert said in refusal("worm", *asked)
    assert list(here.iterdir()) == []


def test_a_browser_that_is_not_there_is_named_with_what_to_do(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GEARTRAIN_BROWSER", "no-such-browser")
    said = refusal("worm", "--png")
    assert "names 'no-such-browser', and there is no such program" in said
    assert "playwright install chromium" in said
    assert list(here.iterdir()) == []


@pytest.mark.parametrize(
    ("library", "form"), [("playwright.sync_api", "--png"), ("PIL", "--gif"), ("av", "--mp4"), ("playwright", "--mp4")]
)
def test_without_what_draws_or_packs_the_extra_is_named(
    here: Path, monkeypatch: pytest.MonkeyPatch, library: str, form: str
) -> None:
    monkeypatch.setitem(sys.modules, library, None)
    if library == "playwright":
        monkeypatch.setitem(sys.modules, "playwright.sync_api", None)
    assert "pip install 'av>=12' 'pillow>=10' 'playwright>=1.48'" in refusal("worm", form)
    assert list(here.iterdir()) == []


def test_what_cannot_turn_is_no_film_but_on_a_turntable(here: Path) -> None:
    (here / "locked.yaml").write_text(LOCKED, encoding="utf-8")
    scene = make_scene(load(here / "locked.yaml"))
    with pytest.raises(QuestionError, match=r"nothing moves in this film\n  why: .*does not close"):
        film(scene, ".gif")
    timed = Shot(turntable=1).timed(scene)
    assert (timed.turns, timed.seconds, timed.closes(scene)) == (0, 12, True)


def test_a_film_shows_a_whole_period_where_that_is_short_and_what_an_eye_can_follow() -> None:
    scene = make_scene(load("norton-planetary"))  # the arm turns the planet of 20 twice, the ring of 80 by 5/4
    timed = Shot().timed(scene)
    assert timed.turns == 4
    assert timed.seconds == 4 * 80 * Fraction(5, 4) / (Fraction(2, 5) * 25), "two fifths of a tooth in each picture"
    assert timed.frames == 25 * timed.seconds
    crossed = Shot().timed(make_scene(load("crossed-helical")))
    assert (crossed.turns, crossed.seconds) == (1, 4), "what turns fastest turns once in four seconds"
    turns = [turns for turns, _ in Shot(at=Fraction(1, 3), turns=Fraction(1), seconds=2, fps=2).timed(scene).moments()]
    assert turns == [Fraction(1, 3) + Fraction(n, 4) for n in range(4)]


def test_a_film_without_end_is_refused() -> None:
    with pytest.raises(QuestionError, match="it would have 9000 pictures"):
        Shot(seconds=300, fps=30).timed(make_scene(load("worm")))
