"""Names in a candidate: the same for wheels that play the same part, whatever their counts and order."""

from __future__ import annotations

from geartrain.search.reconstruct import Arbor, PlacedWheel, candidate_train
from geartrain.train import Train, declare


def added(teeth: int) -> PlacedWheel:
    return PlacedWheel(None, teeth)


def branch(first: int, second: int, dial: str, last: int = 30) -> Arbor:
    """An added arbor that drives the arbor of a dial."""
    return Arbor(None, added(first), (), ((added(second), (Arbor(None, added(last), (dial,), ()),)),))


def named(*drives: tuple[PlacedWheel, tuple[Arbor, ...]], dials: str = "sun moon", **links: dict[str, int]) -> Train:
    """A candidate of evidence in which `in` and `e` survive, with other wheels if these are given."""
    wheels = {"in": {"i": 12}, "e": {"e1": 30}} | links
    evidence = {
        "links": {link: {"wheels": own} for link, own in wheels.items()},
        "inputs": {"in": 1},
        "outputs": {dial: {"expect": "1"} for dial in dials.split()},
        "reconstruct": {"add": {"wheels": 6, "teeth": [8, 60]}, "use": "some"},
    }
    return candidate_train(declare(evidence), Arbor("in", None, (), drives), "one")


def told(train: Train) -> list[tuple[str, str, str]]:
    """Driving wheel, driven wheel and its link, mesh by mesh."""
    return [(driver, driven, train.wheels[driven][0]) for driver, driven in (gear.pair for gear in train.gears)]


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
    assert list(shared.wheels) == ["i", "in_new1", "new_sun1", "new_moon1"]
    assert [name for name, link in apart.links.items() if link.note] == ["new_sun", "new_moon"]


def test_a_driven_wheel_that_drives_is_one_wheel() -> None:
    sun = Arbor(None, added(20), ("sun",), ())
    idler = Arbor("e", PlacedWheel("e1", 30), (), (), (sun,))
    same = Arbor("e", PlacedWheel("e1", 30), (), ((PlacedWheel("e1", 30), (sun,)),))
    i = PlacedWheel("i", 12)
    for arbor in (idler, same):
        train = named((i, (arbor,)), dials="sun")
        assert told(train) == [("i", "e1", "e"), ("e1", "new_sun1", "new_sun")]
        assert list(train.wheels) == ["i", "e1", "new_sun1"]


def test_names_that_are_taken_are_left_alone() -> None:
    taken = {"in": {"i": 12, "in_new1": 9}, "new_sun": {"new_sun_arbor1": 30}}
    train = named((added(9), (Arbor(None, added(20), ("sun",), ()),)), dials="sun", **taken)
    assert told(train) == [("in_new2", "new_sun_arbor2", "new_sun_arbor")]
