"""Pictures and films: their size, that they show the train, and that the motion seen in them is the declared one."""

from __future__ import annotations

import asyncio
import io
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction
from functools import cache
from itertools import pairwise
from math import tau
from pathlib import Path

import numpy as np
import pytest
import shipped
from commands import call
from conftest import OpenPage
from PIL import Image
from viewing import SIMPLE

from geartrain.errors import GearTrainError, QuestionError
from geartrain.scene import Scene
from geartrain.viewer import Shot, film, page
from geartrain.viewer.film_frames import frames
from geartrain.viewer.film_parts import FilmPart

av = pytest.importorskip("av", reason="PyAV is not installed: no MP4 is packed")

pytestmark = pytest.mark.usefixtures("program")
SMALL = {"size": (240, 160), "teeth": False}


def picture(data: bytes) -> np.ndarray:
    return np.asarray(Image.open(io.BytesIO(data)).convert("RGB"), dtype=int)


def stills(scene: Scene, shot: Shot, moments: Iterable[tuple[Fraction, float]]) -> list[bytes]:
    """A PNG of each moment; in a thread of its own, for the browser of other tests waits in this one."""
    with ThreadPoolExecutor(1) as pool:
        return pool.submit(lambda: list(frames([FilmPart(scene, list(moments))], shot))).result(timeout=300)


@cache
def some_gif() -> bytes:
    return film(shipped.scene(SIMPLE), ".gif", Shot(**SMALL, seconds=1.2, fps=5))


def test_a_picture_has_the_size_and_background_asked_for_and_the_train_in_its_middle() -> None:
    shown = picture(
        film(shipped.scene(SIMPLE), ".png", Shot(size=(300, 200), background="rgb(10 200 30)", teeth=False))
    )
    assert shown.shape == (200, 300, 3)
    assert (shown[0, 0] == [10, 200, 30]).all()
    seen = np.abs(shown - shown[0, 0]).sum(axis=2) > 40
    rows, columns = np.nonzero(seen)
    assert 0.1 < seen.mean() < 0.9
    assert rows.max() - rows.min() > 150, "the train fills the picture"
    assert abs((columns.max() + columns.min()) / 2 - 150) < 10
    assert len(np.unique(shown[seen], axis=0)) > 100, "metal has many shades"


def test_a_gif_holds_its_pictures_for_its_seconds_and_begins_again() -> None:
    with Image.open(io.BytesIO(some_gif())) as shown:
        assert (shown.size, shown.n_frames, shown.info["loop"]) == ((240, 160), 6, 0)
        held = []
        for n in range(6):
            shown.seek(n)
            held.append((shown.info["duration"], np.asarray(shown.convert("RGB"), dtype=int)))
    assert sum(time for time, _ in held) == 1200
    for (_, one), (_, other) in pairwise(held):
        changed = (np.abs(one - other).sum(axis=2) > 40).mean()
        assert 0.002 < changed < 0.5, "it moves, and what rests stays"


def test_the_same_question_gives_the_same_film() -> None:
    assert film(shipped.scene(SIMPLE), ".gif", Shot(**SMALL, seconds=1.2, fps=5)) == some_gif()


def knob(shown: np.ndarray) -> complex:
    """Middle of what is blue, with y upwards."""
    red, green, blue = np.moveaxis(shown, 2, 0)
    rows, columns = np.nonzero((blue > 100) & (blue > red + 60) & (blue > green + 30))
    assert len(rows) > 20, "the handle is seen"
    return complex(columns.mean(), -rows.mean())


def test_the_handle_seen_in_the_pictures_turns_as_the_input_does() -> None:
    shot = Shot(size=(420, 420), look="front", teeth=False)
    count = 8
    seen = [
        knob(picture(each))
        for each in stills(shipped.scene(SIMPLE), shot, [(Fraction(n, count), 0.0) for n in range(count)])
    ]
    middle = sum(seen) / count
    turned = [np.angle((after - middle) / (before - middle)) / tau for before, after in pairwise(seen)]
    assert min(abs(each - middle) for each in seen) > 15
    np.testing.assert_allclose(turned, 1 / count, atol=0.015)


def test_links_stand_in_a_still_where_their_exact_speeds_say(open_page: OpenPage, tmp_path: Path) -> None:
    path = tmp_path / "film.html"
    path.write_text(page([shipped.scene(SIMPLE)], teeth=False, shown="film"), encoding="utf-8")
    shown = open_page(path, viewport={"width": 240, "height": 160})
    shown.run("geartrain.film.set({look: 'front', background: 'white', apart: 0, turntable: false})")
    for turns in (Fraction(7, 3), Fraction(-5, 4)):
        assert shown.run(f"geartrain.film.still('{turns}').startsWith('data:image/png;base64,')")
        for link, speed in (("sun", Fraction(1)), ("carrier", Fraction(2, 7)), ("planet", Fraction(-2, 3))):
            angle = shown.run(f"geartrain.angle(0, '{link}')")
            off = (angle - float(speed * turns) * tau) / tau
            assert abs(off - round(off)) < 1e-9, link
    assert shown.errors == shown.requests == []


@pytest.mark.parametrize(("name", "period"), [("norton-planetary", 4), ("crossed-helical", 1)])
def test_a_film_of_a_whole_period_ends_as_it_begins(name: str, period: int) -> None:
    scene = shipped.scene(name)
    shot = Shot(**SMALL).timed(scene)
    assert (shot.turns, shot.closes(scene)) == (period, True)
    moments = list(shot.moments())
    assert moments[0][0] == 0
    assert moments[-1][0] + Fraction(period, shot.frames) == period, "the last picture is one before the first"
    first, last, other = stills(scene, shot, [(Fraction(0), 0.0), (Fraction(period), 0.0), (Fraction(period, 3), 0.0)])
    assert first == last
    assert first != other


def test_a_longer_period_is_not_said_to_close() -> None:
    scene = shipped.scene("worm")
    assert not Shot().timed(scene).closes(scene)
    assert Shot(turns=Fraction(60)).timed(scene).closes(scene), "twice thirty turns of the screw"
    assert not Shot(turns=Fraction(60), turntable=0.5).timed(scene).closes(scene)


def test_an_mp4_is_read_by_a_decoder_and_moves() -> None:
    data = film(shipped.scene(SIMPLE), ".mp4", Shot(**SMALL, seconds=2, fps=4))
    assert data[4:8] == b"ftyp"
    assert data.index(b"moov") < data.index(b"mdat"), "it can begin before it is whole"
    with av.open(io.BytesIO(data)) as file:
        (stream,) = file.streams.video
        assert (stream.codec_context.name, stream.average_rate) == ("h264", 4)
        decoded = [each.to_ndarray(format="rgb24").astype(int) for each in file.decode(video=0)]
    assert len(decoded) == 8
    assert decoded[0].shape == (160, 240, 3)
    assert all(np.abs(one - other).max() > 60 for one, other in pairwise(decoded))


def test_a_webp_holds_all_pictures() -> None:
    with Image.open(io.BytesIO(film(shipped.scene(SIMPLE), ".webp", Shot(**SMALL, seconds=1, fps=4)))) as shown:
        assert (shown.format, shown.size, shown.n_frames, shown.info["loop"]) == ("WEBP", (240, 160), 4, 0)


def test_on_a_turntable_the_camera_goes_round_and_the_train_stays_in_the_picture() -> None:
    scene = shipped.scene("bevel-differential", "straight")
    shot = Shot(size=(200, 200), turns=Fraction(0), turntable=1, seconds=2, fps=3, teeth=False).timed(scene)
    shown = [picture(each) for each in stills(scene, shot, shot.moments())]
    assert len(shown) == 6
    for each in shown:
        share = each / np.maximum(each[0, 0], 1.0)  # of the background's light: the shadow takes of all colours alike
        seen = (np.ptp(share, axis=2) > 0.08) | (share.min(axis=2) < 0.6)
        assert seen.mean() > 0.05
        edges = (seen[0], seen[-1], seen[:, 0], seen[:, -1])
        assert not any(edge.any() for edge in edges)
    assert all(np.abs(one - other).max() > 100 for one, other in pairwise(shown))


def test_a_film_can_be_made_where_a_loop_runs_as_in_notebooks() -> None:
    async def cell() -> bytes:
        return film(shipped.scene(SIMPLE), ".png", Shot(**SMALL))

    with ThreadPoolExecutor(1) as pool:
        assert pool.submit(asyncio.run, cell()).result(timeout=300).startswith(b"\x89PNG")


def test_a_colour_that_is_none_is_refused() -> None:
    with pytest.raises(QuestionError, match="'yellowish' is no background") as refused:
        film(shipped.scene(SIMPLE), ".png", Shot(**SMALL, background="yellowish"))
    assert all(problem.why and problem.fix for problem in refused.value.problems)


def test_the_command_writes_a_film_and_says_how_long_its_period_is(tmp_path: Path) -> None:
    to = tmp_path / "worm.gif"
    done = call("view", "worm", "-o", to, "--size", "120x80", "--seconds", "0.5", "--fps", "4", "--no-teeth")
    assert done.exit_code == 0, done.output
    with Image.open(to) as shown:
        assert (shown.size, shown.n_frames) == ((120, 80), 2)
    assert "2 pictures in 0.5 s" in done.output
    assert "a whole period is 30 turns of the lead" in done.output
    assert isinstance(call("view", "worm", "-o", to).exception, GearTrainError), "it is there"
    assert [path.name for path in tmp_path.iterdir()] == ["worm.gif"]


def test_a_film_of_states_shows_each_by_its_name(tmp_path: Path) -> None:
    to, asked = tmp_path / "states.webp", ("--seconds", "1", "--fps", "2", "--size", "240x160", "--no-teeth")
    done = call("view", "planetary", "--states", "-o", to, *asked)
    assert done.exit_code == 0, done.output
    states = shipped.train("planetary").states
    assert f"{2 * len(states)} pictures in {len(states)} s" in done.output
    corners = []
    with Image.open(to) as shown:
        assert shown.n_frames == 2 * len(states)
        for n in range(shown.n_frames):
            shown.seek(n)
            corners.append(np.asarray(shown.convert("L"), dtype=int)[4:26, 4:110])
    assert all((corner < 90).mean() > 0.03 for corner in corners), "words stand there"
    for one, other in zip(corners[::2], corners[1::2], strict=True):
        assert np.abs(one - other).mean() < 6, "and are the same within a state"
    assert all(np.abs(one - other).max() > 100 for one, other in pairwise(corners[::2])), "and others in the next"


def test_one_state_fades_into_the_next(tmp_path: Path) -> None:
    """0.4 s: four pictures lie between the last one of a state and the fifth of the next."""
    to, asked = tmp_path / "fading.webp", ("--seconds", "2", "--fps", "10", "--size", "120x80", "--no-teeth")
    done = call("view", "planetary", "--states", "-o", to, *asked)
    assert done.exit_code == 0, done.output
    words = []
    with Image.open(to) as shown:
        for n in range(19, 26):
            shown.seek(n)
            words.append(np.asarray(shown.convert("L"), dtype=float)[4:26, 4:110])
    old, *between, _, new = words
    parts = [float(((each - old) * (new - old)).sum() / ((new - old) ** 2).sum()) for each in between]
    assert parts == pytest.approx([0.2, 0.4, 0.6, 0.8], abs=0.05)


def test_a_motion_in_time_is_filmed_for_as_long_as_it_lasts(tmp_path: Path) -> None:
    to = tmp_path / "blows.webp"
    asked = ("--dynamics", "--rate", "1", "--turns", "2", "--skip", "0", "--steps", "100", "--no-fast")
    done = call("view", "moon-triangular-inertia", "-o", to, *asked, "--size", "120x80", "--fps", "2", "--no-teeth")
    assert done.exit_code == 0, done.output
    with Image.open(to) as shown:
        assert shown.n_frames == 4, "two turns at one a second"


def test_a_picture_is_saved_from_the_page_as_it_stands(open_page: OpenPage, tmp_path: Path) -> None:
    path = tmp_path / "page.html"
    path.write_text(page([shipped.scene(SIMPLE)], teeth=False), encoding="utf-8")
    shown = open_page(path, viewport={"width": 1000, "height": 640})
    with shown.page.expect_download() as download:
        shown.page.get_by_role("button", name="Save picture").click()
    assert download.value.suggested_filename == f"{SIMPLE}.png"
    download.value.save_as(tmp_path / "saved.png")
    saved = picture((tmp_path / "saved.png").read_bytes())
    assert list(saved.shape[1::-1]) == shown.run("(([{canvas}]) => [canvas.width, canvas.height])(geartrain.stages)")
    assert len(np.unique(saved.reshape(-1, 3), axis=0)) > 200
    assert shown.errors == shown.requests == []
