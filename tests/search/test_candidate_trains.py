"""A candidate becomes a complete train: it loads, has one degree of freedom, and shows what the dials must show."""

from __future__ import annotations

import json
from fractions import Fraction
from typing import Any

import pytest
from concrete_trees import concrete, declared, exact_dial, explanations, package_arbor, random_problem, with_rings
from places import TRAINS
from sampling import all_but

from geartrain import GearTrain, load
from geartrain.search.reconstruct import Arbor, PlacedWheel, candidate_train, evidence_question, read_evidence
from geartrain.train import Train, declare

Path = list[tuple[str | None, PlacedWheel, PlacedWheel]]
"""Arbors that follow each other: name, driven wheel, driving wheel."""


def wheel(name: str, teeth: int) -> PlacedWheel:
    return PlacedWheel(name, teeth)


def added(teeth: int) -> PlacedWheel:
    return PlacedWheel(None, teeth)


def data_of(evidence: Train, arbor: Arbor) -> dict[str, Any]:
    """The candidate as plain data."""
    return candidate_train(evidence, arbor, "one").model_dump(mode="json", exclude_unset=True, by_alias=True)


def chain(arbors: Path, end: Arbor) -> Arbor:
    """Arbors in a row, the last of them driving `end`."""
    for name, driven, driving in reversed(arbors):
        end = Arbor(name, driven, (), ((driving, (end,)),))
    return end


L1, L2, M1, M2 = wheel("l1", 38), wheel("l2", 53), wheel("m1", 96), wheel("m2", 15)
E3, E4, F1, F2, G1 = wheel("e3", 223), wheel("e4", 188), wheel("f1", 53), wheel("f2", 30), wheel("g1", 54)
SAROS = Arbor("g", G1, ("saros",), ())


def from_b(first: Arbor) -> Arbor:
    return Arbor("b", None, (), ((wheel("b2", 64), (first,)),))


def through_m(after: Path) -> Arbor:
    """b2 > l > m, which drives the pointer of the Metonic dial and, with an added wheel of 27, what leads to Saros."""
    metonic = Arbor(None, added(53), ("metonic",), ())
    m = Arbor("m", M1, (), ((added(27), (chain(after, SAROS),)), (M2, (metonic,))))
    return from_b(Arbor("l", L1, (), ((L2, (m,)),)))


def through_f(after: Path) -> Arbor:
    """b2 > l > f, which drives the pointer of the Metonic dial and, with an added wheel of 54, what leads to Saros."""
    metonic = Arbor(None, added(192), ("metonic",), ())
    f = Arbor("f", F1, (), ((added(54), (chain(after, SAROS),)), (F2, (metonic,))))
    return from_b(Arbor("l", L1, (), ((L2, (f,)),)))


BACK = {
    "that of 2006": (through_m([("E", E3, E4), ("f", F1, F2)]), "e4~f1", {"m_new1": 27, "new_metonic1": 53}),
    "E and f exchanged": (through_m([("f", F1, F2), ("E", E3, E4)]), "f2~e3", {"m_new1": 27, "new_metonic1": 53}),
    "54 on f": (through_f([("E", E3, E4), ("m", M1, M2)]), "f_new1~e3", {"f_new1": 54, "new_metonic1": 192}),
    "E and m exchanged": (through_f([("m", M1, M2), ("E", E3, E4)]), "f_new1~m1", {"f_new1": 54, "new_metonic1": 192}),
}


@pytest.mark.parametrize("which", BACK)
def test_the_four_of_the_back_train(which: str) -> None:
    arbor, pair, counts = BACK[which]
    evidence = read_evidence("back-train")
    train = GearTrain(candidate_train(evidence, arbor, "rank-0001"))
    assert train.mobility.by_rank == 1
    assert train.solve().outputs["metonic"].speed == Fraction(-5, 19)
    assert train.solve().outputs["saros"].speed == Fraction(-940, 4237)
    assert train.solve(), "every expectation holds"
    wheels = train.declaration.wheels
    assert {name: part.count for name, (_, part) in wheels.items() if part.status == "hypothetical"} == counts
    assert all(part.note == "added by reconstruct" for _, part in wheels.values() if part.status == "hypothetical")
    assert wheels["e3"][1].status == "surviving"
    assert wheels["e3"][1].source == "F06"
    assert pair in {gear.name for gear in train.declaration.gears}


def test_added_parts_have_no_name_of_the_real_machine() -> None:
    """There m3 is a wheel of its own, and so is n1 on n."""
    real = load("freeth-2008").declaration
    for arbor, _, _ in BACK.values():
        found = GearTrain(candidate_train(read_evidence("back-train"), arbor, "one")).declaration
        wheels = {name for name, (_, part) in found.wheels.items() if part.status == "hypothetical"}
        links = {name for name, part in found.links.items() if part.note}
        assert len(wheels) == 2
        assert links == {"new_metonic"}
        assert not wheels & set(real.wheels)
        assert not links & {*real.links, *real.outputs}


@pytest.mark.parametrize(("first", "second"), [(12, 121), (121, 12)])
def test_huygens(first: int, second: int) -> None:
    driven, driving = (12, 121) if first == 12 else (17, 121)
    mercury = Arbor("mercury", wheel("me17", 17), ("mercury",), ())
    if first == 12:
        chosen = Arbor(None, added(12), (), ((added(second), (mercury,)),))
    else:  # 7 > 17, 121 > 12
        last = Arbor(None, added(12), ("mercury",), ())
        chosen = Arbor("mercury", wheel("me17", 17), (), ((added(121), (last,)),))
    venus, mars = Arbor("venus", wheel("ve32", 32), ("venus",), ()), Arbor("mars", wheel("ma158", 158), ("mars",), ())
    drives = ((wheel("a52", 52), (venus,)), (wheel("a7m", 7), (chosen,)), (wheel("a84", 84), (mars,)))
    train = GearTrain(
        candidate_train(read_evidence("huygens-without-mercury-arbor"), Arbor("annual", None, (), drives), "h")
    )
    assert train.mobility.by_rank == 1
    assert train.solve()
    assert (
        train.solve().outputs["mercury"].speed
        == Fraction(847, 204)
        == Fraction(7, driven) * Fraction(driving, 17 if first == 12 else 12)
    )
    names = {name for name, (_, part) in train.declaration.wheels.items() if part.note}
    assert names == ({"new1_1", "new1_2"} if first == 12 else {"mercury_new1", "new_mercury1"})


def test_the_text_does_not_depend_on_the_order_of_branches() -> None:
    evidence = read_evidence("back-train")
    arbor = BACK["that of 2006"][0]
    (b2, (first,)) = arbor.drives[0]
    l2, (m,) = first.drives[0]
    turned = Arbor(m.name, m.driven, m.dials, tuple(reversed(m.drives)))
    other = Arbor("b", None, (), ((b2, (Arbor(first.name, first.driven, (), ((l2, (turned,)),)),)),))
    assert other != arbor
    assert json.dumps(data_of(evidence, other)) == json.dumps(data_of(evidence, arbor))


def test_what_was_declared_of_the_evidence_stays() -> None:
    evidence = declare(
        {
            **read_evidence("back-train").model_dump(mode="json", exclude_unset=True, by_alias=True),
            "gears": [{"id": "seen", "pair": ["f1", "e4"], "source": "F06", "driver": "f1"}],
            "revolutes": [{"pair": ["frame", "m"], "axis": "M"}, {"pair": ["l", "frame"], "axis": "E"}],
            "axes": {"M": {"position": ["0 mm", "61 mm", "0 mm"]}},
        }
    )
    found = data_of(evidence, BACK["that of 2006"][0])
    assert {"id": "seen", "pair": ["f1", "e4"], "source": "F06"} in found["gears"]
    assert found["axes"] == {"M": {"position": ["0 mm", "61 mm", "0 mm"]}}
    joints = {frozenset(joint["pair"]): joint["axis"] for joint in found["revolutes"]}
    assert joints[frozenset(("frame", "m"))] == "M"
    assert joints[frozenset(("frame", "l"))] == "E"
    assert joints[frozenset(("frame", "E"))] == "E_axis"
    assert found["outputs"]["metonic"] == {"of": "new_metonic", "expect": {"value": "-5/19"}}


def test_a_count_in_doubt_keeps_its_range() -> None:
    evidence = read_evidence("back-train-doubt")
    found = candidate_train(evidence, BACK["that of 2006"][0], "one")
    teeth = found.wheels["e3"][1].teeth
    assert (teeth.value, teeth.range, teeth.source) == (223, (217, 235), "F06")


def test_an_arbor_that_is_not_used_is_told() -> None:
    pointer = Arbor(None, added(20), ("p",), ())
    evidence = declare(
        {
            "links": {"in": {"wheels": {"i": 10}}, "idle": {"wheels": {"x": 30}}},
            "inputs": {"in": 1},
            "outputs": {"p": {"expect": "0.5"}},
            "reconstruct": {"add": {"wheels": 1, "teeth": [10, 20]}, "use": "some", "sense": "free"},
        }
    )
    train = GearTrain(candidate_train(evidence, Arbor("in", None, (), ((wheel("i", 10), (pointer,)),)), "one"))
    assert "idle" not in train.declaration.links
    assert train.declaration.note == "Not used: idle."
    assert train.solve()["p"] == Fraction(-1, 2)
    assert train.declaration.outputs["p"].expect.value.text == "-1/2"


@pytest.mark.parametrize("rings", [False, True])
@pytest.mark.parametrize("seed", all_but({13}, range(30)))
def test_every_explanation_of_a_small_question_is_a_train(seed: int, rings: bool) -> None:
    problem = random_problem(seed, idlers=True)
    problem = with_rings(problem, seed) if rings else problem
    evidence = declared(problem)
    for found in explanations(problem):
        for tree in sorted(found.solutions)[:5]:
            train = GearTrain(candidate_train(evidence, package_arbor(tree), "one"))
            assert train.mobility.by_rank == 1
            assert train.solve()
            assert len([1 for _, part in train.declaration.wheels.values() if part.note]) == found.counts.added
            assert concrete(package_arbor(tree)) == tree


@pytest.mark.parametrize("seed", range(60))
def test_a_small_question_is_read_as_it_was_declared(seed: int) -> None:
    problem = with_rings(random_problem(seed, idlers=True), seed)
    found = evidence_question(declared(problem)).problem
    assert found.rings == problem.rings
    assert found.dials == problem.dials
    assert found.additions == problem.additions
    assert found.coaxial == problem.coaxial
    assert (found.meshes, found.apart, found.use) == (problem.meshes, problem.apart, problem.use)
    assert (found.input_speed, found.idlers) == (problem.input_speed, problem.idlers)
    mine = [[part.counts for part in arbor.wheels] for arbor in (problem.input, *problem.arbors)]
    read = [[part.counts for part in arbor.wheels] for arbor in (found.input, *found.arbors)]
    assert read == [
        [tuple((count, weight / sum(w for _, w in part)) for count, weight in part) for part in row] for row in mine
    ]


def test_all_shipped_evidence_is_a_question() -> None:
    for path in (TRAINS / "evidence").glob("*.yaml"):
        question = evidence_question(read_evidence(path.stem))
        assert question.unused == ()
        assert question.problem.dials
    dial = evidence_question(read_evidence("back-train")).problem.dials[0]
    assert dial == exact_dial("metonic", "-5/19", place="new")


SIZED = """\
links:
  frame: {}
  b: {wheels: {b2: {teeth: 64, module: 0.4 mm}}}
  c: {wheels: {c1: {teeth: 38, module: 0.9 mm, note: broken}, c2: {teeth: 48, module: 0.123456 mm}}}
  d: {wheels: {d1: 24, d2: 127}}
  e: {wheels: {e2: 32}}
inputs: {b: 1}
outputs: {moon: {of: e, expect: -254/19}}
reconstruct:
  geometry: {radii: {d2: 63.5 mm}}
"""
MOON = from_b(
    chain(
        [("c", wheel("c1", 38), wheel("c2", 48)), ("d", wheel("d1", 24), wheel("d2", 127))],
        Arbor("e", wheel("e2", 32), ("moon",), ()),
    )
)


def wheels_of(text: str) -> dict[str, dict[str, object]]:
    links = data_of(read_evidence(text), MOON)["links"]
    return {name: of for link in links.values() for name, of in link.get("wheels", {}).items()}


def test_wheels_that_mesh_get_one_module() -> None:
    """The geometric mean of 0.4 and 0.9 is 0.6; a radius of 63.5 mm is module 1 of 127 teeth; a lone module stays."""
    wheels = wheels_of(SIZED)
    assert (wheels["b2"]["module"], wheels["b2"]["note"]) == ("0.6 mm", "measured module 0.4 mm")
    assert "module" not in wheels["c1"]
    assert wheels["c1"]["note"] == "broken; measured module 0.9 mm"
    assert (wheels["c2"]["module"], "note" in wheels["c2"]) == ("0.123456 mm", False)
    assert (wheels["d2"]["module"], wheels["d2"]["note"]) == ("1 mm", "measured pitch radius 63.5 mm")
    assert "module" not in wheels["e2"]


def test_places_of_axes_decide_before_modules() -> None:
    placed = "axes: {B: {position: [0 mm, 0 mm, 0 mm]}, C: {position: [30 mm, 0 mm, 0 mm]}}\n"
    joints = "revolutes: [{pair: [frame, b], axis: B}, {pair: [frame, c], axis: C}]\n"
    wheels = wheels_of(SIZED + placed + joints)
    assert "module" not in wheels["b2"]
    assert "module" not in wheels["c1"]
    assert wheels["c2"]["module"] == "0.123456 mm"


def test_modules_that_are_not_weighed_stay() -> None:
    text = SIZED.replace("  geometry: {radii: {d2: 63.5 mm}}", "  add: {}")
    assert [of["module"] for of in wheels_of(text).values() if "module" in of] == ["0.4 mm", "0.9 mm", "0.123456 mm"]


# ---- names: the same for wheels with the same function, whatever their counts and order


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
