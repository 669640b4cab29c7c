"""The one class that users ask: final, of few members, in the order in which a user meets them."""

from __future__ import annotations

from dataclasses import FrozenInstanceError

import pytest

from geartrain import GearTrain, load

MEMBERS = ["declaration", *(name for name in vars(GearTrain) if not name.startswith("_"))]


def test_a_train_has_few_members_and_those_of_every_day_come_first() -> None:
    assert MEMBERS[1:7] == ["solve", "torques", "motion", "report", "draw", "view"]
    assert len(MEMBERS) <= 31
    assert GearTrain.__bases__ == (object,)
    assert GearTrain.__final__  # type: ignore[attr-defined]


def test_what_is_found_once_is_kept() -> None:
    train = load("pennestri-2002-teeth")
    for name in ("kinematics", "mechanics", "circuits", "mobility", "meshes", "graph", "build_findings"):
        assert getattr(train, name) is getattr(train, name), name
    assert train.mechanics.load_case() is train.mechanics.load_case()
    assert train.mechanics.drivers() is train.mechanics.drivers()
    assert train.mechanics.kinematics is train.kinematics


def test_a_train_cannot_be_changed() -> None:
    train = load("worm")
    with pytest.raises(FrozenInstanceError):
        train.declaration = load("planetary-24-18-60").declaration  # type: ignore[misc]


def test_equal_planets_are_unfolded_once_and_a_train_without_them_is_itself() -> None:
    train = load("worm")
    assert train.unfolded is train
    copies = load(
        """
extends: planetary-24-18-60
links: {planet: {copies: 3}}
"""
    )
    assert copies.unfolded is copies.unfolded
    assert copies.unfolded is not copies
    assert len(copies.unfolded.declaration.links) == len(copies.declaration.links) + 2


def test_a_report_is_text_of_the_answers() -> None:
    text = str(load("planetary-24-18-60").report())
    assert text.startswith("# ")
    assert "| carrier | 2/7 " in text
