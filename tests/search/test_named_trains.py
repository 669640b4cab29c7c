"""Names in a candidate: the same for wheels that play the same part, whatever their counts and order."""

from __future__ import annotations

from geartrain.search.reconstruct import Arbor, PlacedWheel
from geartrain.search.reconstruct.candidate_names import NamedArbor, name_train


def added(teeth: int) -> PlacedWheel:
    return PlacedWheel(None, teeth)


def branch(first: int, second: int, dial: str, last: int = 30) -> Arbor:
    """An added arbor that drives the arbor of a dial."""
    return Arbor(None, added(first), (), ((added(second), (Arbor(None, added(last), (dial,), ()),)),))


def named(*drives: tuple[PlacedWheel, tuple[Arbor, ...]]) -> NamedArbor:
    return name_train(Arbor("in", None, (), drives), ("sun", "moon"), {"in", "frame"}, {"i"})


def told(train: NamedArbor) -> list[tuple[str, str, str]]:
    return [(wheel.name, arbor.driven.name, arbor.name) for _, wheel, arbor in train.meshes() if arbor.driven]


def test_names_do_not_depend_on_counts_or_order() -> None:
    right = [
        ("i", "new1_1", "new1"),
        ("new1_2", "new_sun1", "new_sun"),
        ("i", "new2_1", "new2"),
        ("new2_2", "new_moon1", "new_moon"),
    ]
    sun, moon = branch(20, 25, "sun"), branch(10, 15, "moon")
    i = PlacedWheel("i", 12)
    assert told(named((i, (sun, moon)))) == told(named((i, (moon, sun)))) == right
    assert told(named((i, (branch(8, 9, "sun"), branch(40, 50, "moon"))))) == right


def test_a_wheel_that_drives_two_arbors_is_one_and_two_wheels_of_one_count_are_two() -> None:
    sun, moon = Arbor(None, added(20), ("sun",), ()), Arbor(None, added(20), ("moon",), ())
    shared = named((added(15), (sun, moon)))
    apart = named((added(15), (sun,)), (added(15), (moon,)))
    assert told(shared) == [("in_new1", "new_sun1", "new_sun"), ("in_new1", "new_moon1", "new_moon")]
    assert told(apart) == [("in_new1", "new_sun1", "new_sun"), ("in_new2", "new_moon1", "new_moon")]
    assert [wheel.name for wheel in shared.wheels()] == ["in_new1"]
    assert [(arbor.name, arbor.added) for arbor in apart.arbors()] == [
        ("in", False),
        ("new_sun", True),
        ("new_moon", True),
    ]


def test_a_driven_wheel_that_drives_is_one_wheel() -> None:
    sun = Arbor(None, added(20), ("sun",), ())
    idler = Arbor("e", PlacedWheel("e1", 30), (), (), (sun,))
    same = Arbor("e", PlacedWheel("e1", 30), (), ((PlacedWheel("e1", 30), (sun,)),))
    i = PlacedWheel("i", 12)
    for arbor in (idler, same):
        train = named((i, (arbor,)))
        assert told(train) == [("i", "e1", "e"), ("e1", "new_sun1", "new_sun")]
        assert [wheel.name for each in train.arbors() for wheel in each.wheels()] == ["i", "e1", "new_sun1"]


def test_names_that_are_taken_are_left_alone() -> None:
    sun = Arbor(None, added(20), ("sun",), ())
    train = name_train(
        Arbor("in", None, (), ((added(9), (sun,)),)), ("sun",), {"in", "new_sun"}, {"in_new1", "new_sun_arbor1"}
    )
    assert told(train) == [("in_new2", "new_sun_arbor2", "new_sun_arbor")]
