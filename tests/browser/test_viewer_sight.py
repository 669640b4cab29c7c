"""Parts that hide wheels are transparent, and initial views show all wheels, measured in pictures."""

from __future__ import annotations

from itertools import pairwise
from math import hypot
from typing import TYPE_CHECKING

import pytest
from viewing import Opening, picture, unfold

if TYPE_CHECKING:
    from conftest import Shown

USUAL, INTO = [0.36, 0.3, 0.88], [0.62, 0.46, 0.64]
# a picture from a direction (null: initial view) in which only some wheels are blue
PICTURE = """([towards, wheels, pillars, covers]) => {
  const [stage] = geartrain.stages, [scene] = geartrain.scenes, {world} = stage;
  if (towards) stage.fit(stage.camera.position.clone().set(...towards).normalize());
  else stage.look('free');
  stage.paint('speed', {wheels: scene.wheels.map((_, n) => (wheels && !wheels.includes(n) ? '#777777' : '#0000ff'))});
  const isShown = ({body, cover}) => body !== scene.crank && (covers || !cover);
  for (const part of world.parts) world.palette.paint(part.slot, {shown: isShown(part)});
  const show = (shown) => world.parts.filter(({bar}) => bar).forEach(({slot}) => world.palette.paint(slot, {shown}));
  show(pillars);
  stage.render();
  const picture = stage.canvas.toDataURL('image/png');
  show(true);
  return picture;
}"""
PILLARS = """() => {
  const {parts, looks} = geartrain.stages[0].world;
  const pillars = parts.filter(({bar}) => bar);
  return [pillars.filter((part) => looks.isGlass(part)).length, pillars.length];
}"""
TOWARDS = """() => {
  const {camera, controls} = geartrain.stages[0];
  return camera.position.clone().sub(controls.target).normalize().toArray();
}"""


def blue(
    shown: Shown, towards: list[float] | None, wheels: list[int] | None, pillars: bool = True, covers: bool = False
) -> int:
    """Return the number of points of a picture in which wheels are visible."""
    red, _, strong = picture(shown.run(PICTURE, [towards, wheels, pillars, covers])).transpose(2, 0, 1)
    return int((strong > red + 40).sum())


@pytest.mark.parametrize("name", ["worm", "bevel-differential", "south-pointing-chariot"])
def test_pillars_before_wheels_hide_next_to_nothing_of_them(show: Opening, name: str) -> None:
    shown = show(name)
    for towards in (USUAL, [-0.36, 0.3, 0.88], [0.1, -0.2, -0.97]):
        whole = blue(shown, towards, None, pillars=False)
        assert whole > 2000
        assert blue(shown, towards, None) > 0.93 * whole, towards


@pytest.mark.parametrize("name", ["bevel-differential", "huygens-planetarium-1682"])
def test_no_plate_hides_a_wheel(show: Opening, name: str) -> None:
    """The pinion of a differential, and a wheel of a planetarium, were behind an opaque plate."""
    shown = show(name)
    for wheel in range(shown.run("geartrain.scenes[0].wheels.length")):
        alone = blue(shown, None, [wheel])
        assert blue(shown, None, [wheel], covers=True) >= 0.7 * alone - 5, wheel  # edges of teeth


def test_pillars_that_hide_nothing_are_no_glass(show: Opening) -> None:
    for name, towards, hiding in (("planetary-24-18-60", [0.0, 0.0, 1.0], False), ("worm", USUAL, True)):
        blue(shown := show(name), towards, None)
        glass, pillars = shown.run(PILLARS)
        assert 0 < glass < pillars if hiding else glass == 0 < pillars


@pytest.mark.parametrize(("name", "times"), [("worm", 2), ("humpage", 1.4)])
def test_a_train_opens_where_the_worst_seen_of_its_wheels_is_seen_better(
    show: Opening, name: str, times: float
) -> None:
    """A worm wheel was seen edge-on, and a large planet hid the small wheels."""
    shown = show(name)

    def shares(towards: list[float] | None) -> list[float]:
        """Return the number of visible points of each wheel, at equal distance and size."""
        radii: list[float] = shown.run("geartrain.scenes[0].wheels.map(({radius}) => radius)")
        seen = [blue(shown, towards, [wheel], pillars=False) for wheel in range(len(radii))]
        away: float = shown.run("geartrain.stages[0].controls.getDistance()")
        return [points * (away / radius) ** 2 for points, radius in zip(seen, radii, strict=True)]

    assert min(shares(None)) > times * min(shares(USUAL))


@pytest.mark.parametrize("name", ["two-k-h-10000", "ferguson-paradox"])
def test_an_orbit_is_looked_at_from_where_it_leaves_more_of_the_picture_to_wheels(show: Opening, name: str) -> None:
    shown = show(name)
    assert blue(shown, None, None) > 1.1 * blue(shown, USUAL, None)


@pytest.mark.parametrize("name", ["planetary-24-18-60", "longcase-clock", "norton-compound", "wolfrom-175"])
def test_others_open_slantwise_from_the_front(show: Opening, name: str) -> None:
    shown = show(name)
    shown.run("() => geartrain.stages[0].look('free')")
    side = INTO if name == "wolfrom-175" else USUAL  # the camera looks into a train that is cut open
    x, y, z = (each / hypot(*side) for each in side)
    front = shown.run("geartrain.scenes[0].front")
    assert shown.run(TOWARDS) == pytest.approx([front * x, y, front * z], abs=1e-6)


def test_a_train_is_looked_into_from_behind_where_its_wheels_are_seen_better(show: Opening) -> None:
    """The camera looked into the cup of a strain wave gear, whose teeth are at its far end."""
    shown = show("strain-wave")
    wheels = range(shown.run("geartrain.scenes[0].wheels.length"))
    behind, before = (
        sum(blue(shown, towards, [wheel], pillars=False) ** 0.5 for wheel in wheels) for towards in (None, INTO)
    )
    assert behind > 1.35 * before


def test_a_phone_shows_the_picture_above_its_open_panels_and_a_row_of_numbers_on_one_line(show: Opening) -> None:
    shown = show("prague-orloj", viewport={"width": 390, "height": 844})
    shown.page.get_by_role("button", name="Open panels").click()
    unfold(shown, "Comparison")
    top, bottom = shown.run(
        "(({top, bottom}) => [top, bottom])(document.querySelector('canvas').getBoundingClientRect())"
    )
    panel = shown.run("document.querySelector('.panel').getBoundingClientRect().top")
    assert -2 <= top <= 2
    assert panel > 200
    assert bottom < panel + 2
    # extent of the text of each cell of a row: [top, bottom], and left and right
    cells = shown.run("""[...document.querySelectorAll('.sky tbody tr')].map((row) => [...row.cells].map((cell) => {
      const range = document.createRange();
      range.selectNodeContents(document.createTreeWalker(cell, NodeFilter.SHOW_TEXT).nextNode());
      const {top, left, right} = range.getClientRects()[0];
      return [top, left, right];
    }))""")
    assert len(cells) == 4
    for row in cells:
        assert max(top for top, _, _ in row) - min(top for top, _, _ in row) < 1.5
        assert all(after[1] - before[2] > 2 for before, after in pairwise(row[1:]))
