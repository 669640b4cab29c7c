"""Pictures and films of a page: those saved by its buttons and by scripts of the documentation, and their motion."""

from __future__ import annotations

import io
from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction
from itertools import pairwise
from math import tau
from pathlib import Path

import numpy as np
import pytest
import shipped
from conftest import Shown
from PIL import Image
from stills import gif, pace_of, stills, webp
from viewing import SIMPLE, Opening, picture

pytestmark = pytest.mark.usefixtures("program")

STILL = """(turns) => {
  geartrain.setTurns(turns);
  const [stage] = geartrain.stages;
  stage.render();
  return stage.canvas.toDataURL('image/png');
}"""


def taken(*turns: Fraction, background: str = "#f4f1ea", size: tuple[int, int] = (240, 160)) -> list[bytes]:
    """Return stills of a train, made in a thread without the event loop of the browser of other tests."""
    with ThreadPoolExecutor(1) as pool:
        return pool.submit(lambda: list(stills(shipped.scene(SIMPLE), size, turns, background))).result()


# ------------------------------------------------------------------------------------------------------- from the page


def test_a_picture_is_saved_from_the_page_as_it_stands(show: Opening, tmp_path: Path) -> None:
    shown = show(SIMPLE)
    with shown.page.expect_download() as download:
        shown.page.get_by_role("button", name="Save picture").click()
    assert download.value.suggested_filename == f"{SIMPLE}.png"
    download.value.save_as(tmp_path / "saved.png")
    saved = picture((tmp_path / "saved.png").read_bytes())
    assert list(saved.shape[1::-1]) == shown.run("(([{canvas}]) => [canvas.width, canvas.height])(geartrain.stages)")
    assert len(np.unique(saved.reshape(-1, 3), axis=0)) > 200
    assert shown.errors == shown.requests == []


def recorded(shown: Shown, to: Path) -> tuple[str, bytes]:
    """Return the name and content of a film of two moments."""
    button = shown.page.get_by_role("button", name="Record film")
    button.click()
    assert button.get_attribute("aria-pressed") == "true"
    for turns in ("1/8", "2/8", "3/8", "4/8"):
        shown.run("(turns) => geartrain.setTurns(turns)", turns)
        shown.page.wait_for_timeout(150)
    with shown.page.expect_download() as download:
        button.click()
    assert button.get_attribute("aria-pressed") == "false"
    download.value.save_as(to)
    return download.value.suggested_filename, to.read_bytes()


def test_a_film_is_recorded_from_the_page_while_the_train_turns(show: Opening, tmp_path: Path) -> None:
    av = pytest.importorskip("av", reason="PyAV is not installed: no film is decoded")
    shown = show(SIMPLE)
    name, data = recorded(shown, tmp_path / "film.webm")
    assert name == f"{SIMPLE}.webm"
    with av.open(io.BytesIO(data)) as file:
        assert "webm" in file.format.name
        decoded = [each.to_ndarray(format="rgb24").astype(int) for each in file.decode(video=0)]
    width, height = shown.run("(([{canvas}]) => [canvas.width, canvas.height])(geartrain.stages)")
    assert {each.shape for each in decoded} == {(height, width, 3)}
    changed = (np.abs(decoded[0] - decoded[-1]).sum(axis=2) > 60).mean()
    assert 0.005 < changed < 0.5, "the wheels turn, and what is behind them stays"
    assert shown.errors == shown.requests == []


def test_a_film_ends_when_another_state_is_shown(show: Opening, tmp_path: Path) -> None:
    shown = show("planetary")
    first, second, *_ = shipped.train("planetary").states
    shown.page.get_by_role("button", name="Record film").click()
    shown.page.wait_for_timeout(300)
    with shown.page.expect_download() as download:
        shown.page.get_by_label("State").select_option(label=second)
    assert download.value.suggested_filename == f"planetary-{first.replace(' ', '-')}.webm"
    assert shown.page.get_by_role("button", name="Record film").get_attribute("aria-pressed") == "false"
    assert shown.errors == []


def test_a_browser_that_records_nothing_has_no_button_for_it(show: Opening) -> None:
    there = show(SIMPLE).page.get_by_role("button", name="Record film")
    assert there.is_visible()
    absent = show(SIMPLE, before="delete globalThis.MediaRecorder").page
    assert absent.get_by_role("button", name="Save picture").is_visible()
    assert absent.locator("button.record").is_hidden()


# -------------------------------------------------------------------------------------------------- what pictures show


def knob(shown: np.ndarray) -> complex:
    """Return the centre of the blue area, with y upwards."""
    red, green, blue = np.moveaxis(shown, 2, 0)
    rows, columns = np.nonzero((blue > 100) & (blue > red + 60) & (blue > green + 30))
    assert len(rows) > 20, "the handle is seen"
    return complex(columns.mean(), -rows.mean())


def test_the_handle_seen_in_the_pictures_turns_as_the_input_does(show: Opening) -> None:
    shown = show(SIMPLE)
    shown.run("geartrain.stages[0].look('front')")
    count = 8
    stands = [shown.run(STILL, f"{n}/{count}") for n in range(count)]
    seen = [knob(picture(each)) for each in stands]
    middle = sum(seen) / count
    turned = [np.angle((after - middle) / (before - middle)) / tau for before, after in pairwise(seen)]
    assert min(abs(each - middle) for each in seen) > 15
    np.testing.assert_allclose(turned, 1 / count, atol=0.015)


# ------------------------------------------------------------------------------- stills and films of the documentation


def test_a_still_has_the_size_and_background_requested_for_and_the_train_in_its_middle() -> None:
    (data,) = taken(Fraction(0), background="#0ac81e", size=(300, 200))
    shown = picture(data)
    assert shown.shape == (200, 300, 3)
    assert (shown[0, 0] == [10, 200, 30]).all()
    seen = np.abs(shown - shown[0, 0]).sum(axis=2) > 40
    rows, columns = np.nonzero(seen)
    assert 0.1 < seen.mean() < 0.9
    assert rows.max() - rows.min() > 150, "the train fills the picture"
    assert abs((columns.max() + columns.min()) / 2 - 150) < 10
    assert len(np.unique(shown[seen], axis=0)) > 100, "metal has many shades"


def test_stills_are_the_same_each_time_and_after_a_whole_period() -> None:
    first, other, last = taken(Fraction(0), Fraction(1, 3), Fraction(21))
    assert first == last
    assert first != other
    assert taken(Fraction(1, 3)) == [other]


def test_a_film_holds_its_pictures_for_its_seconds_and_begins_again() -> None:
    pictures = taken(*(Fraction(n, 8) for n in range(6)))
    with Image.open(io.BytesIO(gif(pictures, 7))) as shown:
        assert (shown.size, shown.n_frames, shown.info["loop"]) == ((240, 160), 6, 0)
        held = []
        for n in range(6):
            shown.seek(n)
            held.append((shown.info["duration"], np.asarray(shown.convert("RGB"), dtype=int)))
    assert sum(time for time, _ in held) == 860, "6/7 s in hundredths"
    for (_, one), (_, other) in pairwise(held):
        changed = (np.abs(one - other).sum(axis=2) > 40).mean()
        assert 0.002 < changed < 0.5, "it moves, and what rests stays"
    with Image.open(io.BytesIO(webp(pictures, 4))) as shown:
        assert (shown.format, shown.size, shown.n_frames, shown.info["loop"]) == ("WEBP", (240, 160), 6, 0)


def test_a_film_shows_which_way_teeth_go() -> None:
    scene = shipped.scene("norton-planetary")  # the arm turns the planet of 20 twice, the ring of 80 by 5/4
    assert pace_of(scene, 25) == Fraction(2, 5) * 25 / (80 * Fraction(5, 4)), "two fifths of a tooth in each picture"
    assert pace_of(shipped.scene("crossed-helical"), 25) == Fraction(1, 4), "what turns fastest turns once in 4 s"
