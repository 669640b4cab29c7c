"""The page of the house shows the rooms there are, and its arrows go down."""

from __future__ import annotations

from itertools import chain

import make_architecture
from places import ROOT


def test_the_picture_shows_every_room_of_the_contract_and_no_other() -> None:
    rooms = set(chain.from_iterable(make_architecture.layers()))
    drawn = (ROOT / "docs" / "images" / "architecture.svg").read_text(encoding="utf-8")
    assert drawn == "\n".join(make_architecture.elements()) + "\n"
    assert drawn.count('font-weight="bold"') == len(rooms)
    page = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    assert {room for room in rooms if f"`{room}`" in page} == rooms


def test_arrows_are_imports_that_go_down() -> None:
    level = {room: at for at, row in enumerate(make_architecture.layers()) for room in row}
    arrows = make_architecture.arrows(set(level))
    assert all(level[one] < level[other] for one, other in arrows.edges)
    assert set(arrows) == set(level)
    assert arrows.has_edge("cli", "report")
    assert not arrows.has_edge("cli", "errors"), "that follows from others"


def test_every_text_fits_into_its_box() -> None:
    for room in chain.from_iterable(make_architecture.layers()):
        text = make_architecture.purpose(room)
        assert 5 < len(text) <= 2 * make_architecture.LETTERS
