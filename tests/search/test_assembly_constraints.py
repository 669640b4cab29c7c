"""A fitter's rules: known sets, equations against brute force, equal planets against teeth put in one by one."""

from __future__ import annotations

import json
import pickle
from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import product
from math import gcd
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from commands import call
from fitters import SIMPLE, box, columns, epicyclic, passed, rules_of
from hypothesis import given, settings
from hypothesis import strategies as st
from sampling import few_or_many
from teeth3d import best, in_space

from geartrain import GearTrain, load
from geartrain.errors import QuestionError
from geartrain.numerics import Quantity
from geartrain.search import ConstraintOptions, search_train

Data = dict[str, Any]


def is_equation(rule: object) -> bool:
    return hasattr(rule, "coefficients")


def equations(rules: Sequence[Any]) -> list[Any]:
    return list(filter(is_equation, rules))


def length(text: str) -> Quantity:
    return Quantity.parse(text, "length", plain=True)


def ordinary(wheels: Mapping[str, tuple[str, Any]], meshes: Sequence[tuple[str, str]]) -> Data:
    """Wheels on arbors, each arbor on the axis that has its first letter."""
    links: Data = {"frame": {}}
    for name, (link, teeth) in wheels.items():
        links.setdefault(link, {"wheels": {}})["wheels"][name] = teeth
    revolutes = [{"pair": ["frame", link], "axis": link[0]} for link in links if link != "frame"]
    return {"links": links, "revolutes": revolutes, "gears": [{"pair": list(pair)} for pair in meshes]}


def reverted(modules: Sequence[str | None]) -> Data:
    """Two pairs between the same two axes: z1 on A1 drives z2 on B, z3 on B drives z4 on A2."""
    teeth = dict(zip(("z1", "z2", "z3", "z4"), (20, 40, 24, 36), strict=True))
    arbors = dict(zip(teeth, ("A1", "B1", "B1", "A2"), strict=True))
    wheels = {}
    for (name, z), module in zip(teeth.items(), modules, strict=True):
        wheels[name] = (arbors[name], {"teeth": z} | ({} if module is None else {"module": module}))
    return ordinary(wheels, [("z1", "z2"), ("z3", "z4")])


# ------------------------------------------------------------------------------------------------------------- coaxial


def test_a_planetary_has_a_ring_of_the_sun_and_two_planets() -> None:
    rules = rules_of(epicyclic(*SIMPLE))
    assert [rule.name for rule in rules] == ["coaxial closure: s + 2 p = r"]
    # a module belongs to all wheels that mesh on from one
    data = epicyclic(*SIMPLE)
    data["links"]["Ls"]["wheels"]["s"]["module"] = "2 mm"
    assert [rule.name for rule in rules_of(data)] == ["coaxial closure: s + 2 p = r"]
    assert passed(rules, s=24, p=18, r=60)
    assert not passed(rules, s=30, p=23, r=78)
    assert not passed(rules, s=21, p=43, r=108)
    assert passed(rules_of(epicyclic(*SIMPLE), shift=2), s=30, p=23, r=78)
    assert not passed(rules_of(epicyclic(*SIMPLE), shift=1), s=30, p=23, r=78)


def test_fixed_counts_are_folded_into_the_equation() -> None:
    (rule,) = equations(rules_of(epicyclic(*SIMPLE), ["p", "r"]))
    assert rule.name == "coaxial closure: 24 + 2 p = r"
    assert dict(rule.coefficients) == {"p": 2, "r": -1}
    assert rule.constant == 24
    (alone,) = equations(rules_of(epicyclic(*SIMPLE), ["p"]))
    assert (alone.name, alone.wheels) == ("coaxial closure: p = 18", ("p",))
    assert rules_of(epicyclic(*SIMPLE), []) == ()


def test_a_reverted_train_has_two_equal_sums() -> None:
    (rule,) = equations(rules_of(reverted([None] * 4)))
    assert rule.name == "coaxial closure: z1 + z2 = z3 + z4"
    grid = box(z1=range(8, 14), z2=range(30, 34), z3=range(10, 14), z4=range(28, 33))
    wanted = [a + b == c + d for a, b, c, d in zip(*(grid[name].tolist() for name in grid), strict=True)]
    assert rule.holds(grid).tolist() == wanted


def test_declared_modules_weigh_the_counts_and_one_of_a_pair_speaks_for_both() -> None:
    (rule,) = equations(rules_of(reverted(["1.25 mm", None, None, "1.5 mm"]), coaxial=True))
    assert dict(rule.coefficients) == {"z1": 5, "z2": 5, "z3": -6, "z4": -6}
    assert rule.name == "coaxial closure: 5 z1 + 5 z2 = 6 z3 + 6 z4"
    assert rules_of(reverted(["1.25 mm", None, None, None]), coaxial=True) == ()
    assert rules_of(reverted(["1.25 mm", None, None, "1.5"]), coaxial=True) == ()
    assert rules_of(reverted(["1 mm", "2 mm", "1 mm", "1 mm"]), coaxial=True) == ()


def test_shift_is_counted_in_half_modules_of_the_finer_pair() -> None:
    data = reverted(["2 mm", None, "3 mm", None])
    (rule,) = rules_of(data, coaxial=True, shift=1)
    grid = box(z1=[20], z2=range(40, 80), z3=[20], z4=range(15, 40))
    wanted = [abs(2 * (20 + b) - 3 * (20 + d)) <= 2 for b, d in zip(grid["z2"], grid["z4"], strict=True)]
    assert rule.holds(grid).tolist() == wanted


def test_a_stepped_planet_of_two_rings_has_two_equations() -> None:
    names = [rule.name for rule in rules_of(load("wolfrom-175").declaration)]
    assert names == ["coaxial closure: s12 + 2 p30 = r72", "coaxial closure: s12 + p30 + p28 = r70"]


def test_equations_that_the_declared_counts_break_are_requested_for_only_on_demand() -> None:
    # with one module for all, as for wheels of which nothing is known
    one = "extends: freeth-2021\nname: one\nlinks: {frame: {wheels: {x49: {module: null}}}}"
    train = load(one).declaration
    assert rules_of(train) == ()
    assert rules_of(load("freeth-2021").declaration, coaxial=True) == ()
    (rule,) = rules_of(train, coaxial=True)
    assert rule.name == "coaxial closure: x49 + spB62 = spB64 + no48"
    # where it holds within the shift, it is asked for
    assert [rule.name for rule in rules_of(train, shift=1)] == [
        "coaxial closure within 1 half modules: x49 + spB62 = spB64 + no48"
    ]
    assert rules_of(train, coaxial=False) == ()


def test_a_value_beside_a_search_is_no_evidence() -> None:
    data = epicyclic(*SIMPLE)
    data["links"]["P0"]["wheels"]["p"] = 19
    assert rules_of(data) == ()
    data["links"]["P0"]["wheels"]["p"] = {"teeth": {"value": 19, "range": [17, 20]}}
    assert rules_of(data) == ()
    data["links"]["P0"]["wheels"]["p"] = {"teeth": {"value": 19, "search": [12, 80]}}
    assert [rule.name for rule in rules_of(data)] == ["coaxial closure: s + 2 p = r"]


SHIPPED = ("ferguson-paradox", "huygens-planetarium-1682", "longcase-clock", "prague-orloj", "prius-power-split")


@pytest.mark.parametrize("name", [*SHIPPED, "planetary", "simpson-set", "zf-8hp70", "ravigneaux-set", "freeth-2008"])
def test_shipped_trains_keep_the_rules_that_hold_without_being_requested_for(name: str) -> None:
    train = load(name).declaration
    counts = {wheel: declared.count or 0 for wheel, (_, declared) in train.wheels.items()}
    assert passed(rules_of(train), **counts)
    requested = rules_of(train, coaxial=True)
    assert passed(requested, **counts) == (name not in SHIPPED)


def test_two_wheels_of_one_axis_on_one_mate_cannot_differ() -> None:
    wheels = {"a": ("A1", 24), "b": ("A2", 30), "c": ("B", 40)}
    data = ordinary(wheels, [("a", "c"), ("b", "c")])
    with pytest.raises(QuestionError, match="cannot have equal centre distances"):
        rules_of(data, ["c"], coaxial=True)
    assert rules_of(data, ["c"]) == ()
    (rule,) = rules_of(data, ["a", "c"], coaxial=True)
    assert rule.name == "coaxial closure: a = 30"


# ------------------------------------------------------------------------------------------------------- equal planets


def planet_rule(data: Data, number: int) -> Any:
    """The condition that so many equal planets can be put in."""
    (rule,) = [rule for rule in rules_of(data, planets=number, coaxial=False) if "equal planets" in rule.name]
    assert not is_equation(rule)
    return rule


def put_in(meshes: Sequence[tuple[int, int]], number: int) -> bool:
    """A planet with wheels on one arbor, tried in every engagement with the first central wheel.

    meshes   (teeth of the planet's wheel, teeth of the central one, negative for a ring): the first planet has a tooth
             of each wheel in a gap; moved on by a turn over `number`, each central wheel is so many pitches farther on
    """
    off = [Fraction(central, number) for _, central in meshes]
    first = meshes[0][0]
    for tooth in range(abs(first)):
        turn = (tooth - off[0]) / first
        if all((own * turn + part).denominator == 1 for (own, _), part in zip(meshes, off, strict=True)):
            return True
    return False


def stepped(s: int, p: int, q: int, r: int, first_ring: bool = False) -> tuple[Any, ...]:
    return {"s": (s, first_ring), "r": (r, True)}, [{"p": p, "q": q}], [("s", "p"), ("q", "r")]


SUNS: Any = ({"s": (20, False), "r": (22, False)}, [{"p": 15, "q": 12}], [("s", "p"), ("q", "r")])


@pytest.mark.parametrize(
    ("parts", "signs", "number", "formula"),
    [
        *((stepped(20, 15, 12, 60), (1, -1), number, "r p + s q") for number in (2, 3, 4, 5)),
        (SUNS, (1, 1), 3, "r p - s q"),
        (stepped(60, 15, 12, 62, True), (-1, -1), 3, "r p - s q"),
    ],
)
def test_stepped_planets_fit_as_in_every_engagement_tried(
    parts: Any, signs: tuple[int, int], number: int, formula: str
) -> None:
    rule = planet_rule(epicyclic(*parts), number)
    assert rule.name == f"{number} equal planets on 'arm': {number} gcd(q, p) divides {formula}"
    grid = box(s=range(30, 36), p=range(9, 17), q=range(8, 15), r=range(36, 44))
    rows = zip(*(grid[name].tolist() for name in "spqr"), strict=True)
    first, second = signs
    assert rule.holds(grid).tolist() == [put_in([(first * p, s), (second * q, r)], number) for s, p, q, r in rows]


SETS: dict[str, tuple[Any, ...]] = {
    "simple": (*SIMPLE, [(42.0, 0.0)]),
    "stepped": (*stepped(20, 15, 12, 60), [(40.0, 0.0)]),
    "wolfrom": (
        {"s": (12, False), "r": (72, True), "t": (70, True)},
        [{"p": 30, "q": 28}],
        [("s", "p"), ("p", "r"), ("q", "t")],
        [(42.0, 0.0)],
    ),
    "two after each other": (
        {"s": (24, False), "r": (72, True)},
        [{"p": 15}, {"q": 14}],
        [("s", "p"), ("p", "q"), ("q", "r")],
        [(39.0, 0.0), (58.0, 0.0731)],
    ),
    "ravigneaux": (
        {"a": (30, False), "b": (36, False), "r": (72, True)},
        [{"ps": 18}, {"pl": 18}],
        [("a", "ps"), ("ps", "pl"), ("b", "pl"), ("pl", "r")],
        [(48.0, 0.0), (54.0, 0.0577)],
    ),
    "stepped after stepped": (
        {"s": (20, False), "r": (60, True)},
        [{"p": 10, "q": 15}, {"u": 12, "v": 9}],
        [("s", "p"), ("q", "u"), ("v", "r")],
        [(30.0, 0.0), (48.0, 0.0917)],
    ),
}


@given(st.sampled_from(sorted(SETS)), st.integers(2, 6), st.data())
@settings(max_examples=few_or_many(70, 150))
def test_equal_planets_can_be_put_in_if_and_only_if_all_loops_close(
    name: str, number: int, data: st.DataObject
) -> None:
    central, planets, meshes, places = SETS[name]
    drawn = {wheel: data.draw(st.integers(8, 40), label=wheel) for planet in [central, *planets] for wheel in planet}
    central = {wheel: (drawn[wheel], ring) for wheel, (_, ring) in central.items()}
    planets = [{wheel: drawn[wheel] for wheel in planet} for planet in planets]
    rule = planet_rule(epicyclic(central, planets, meshes), number)
    closure = GearTrain.declare(epicyclic(central, planets, meshes, number, places)).closure
    assert closure.kind in ("closes", "misses")
    assert bool(rule.holds(columns(**drawn))[0]) == (closure.kind == "closes")


@pytest.mark.parametrize(
    ("name", "counts"),
    [
        ("stepped", {"s": 9, "p": 4, "q": 2, "r": 12}),
        ("stepped", {"s": 8, "p": 3, "q": 2, "r": 11}),
        ("stepped", {"s": 7, "p": 3, "q": 2, "r": 11}),
        ("two after each other", {"s": 9, "p": 7, "q": 5, "r": 30}),
        ("two after each other", {"s": 9, "p": 7, "q": 5, "r": 31}),
    ],
)
def test_teeth_in_space_agree_about_equal_planets(name: str, counts: dict[str, int]) -> None:
    central, planets, meshes, places = SETS[name]
    central = {wheel: (counts[wheel], ring) for wheel, (_, ring) in central.items()}
    planets = [{wheel: counts[wheel] for wheel in planet} for planet in planets]
    held = planet_rule(epicyclic(central, planets, meshes), 3).holds(columns(**counts))[0]
    wheels, pairs = in_space(GearTrain.declare(epicyclic(central, planets, meshes, 3, places)))
    assert (best(wheels, pairs) < 1e-6) == held


@pytest.mark.parametrize("number", [2, 4])
def test_bevel_planets_fit_as_their_loops_close(number: int) -> None:
    ways = [(0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)][:number]
    for left, right, pinion in [(16, 16, 10), (15, 16, 10), (15, 17, 9), (14, 16, 9), (18, 14, 11), (13, 14, 11)]:
        data: Data = load("bevel-differential").declaration.model_dump(exclude_unset=True, mode="json")
        data["links"]["left"]["wheels"]["l16"]["teeth"] = left
        data["links"]["right"]["wheels"]["r16"]["teeth"] = right
        del data["links"]["spider"], data["axes"]["spider"]
        data["gears"] = [gear for gear in data["gears"] if "p10" not in gear["pair"]]
        data["revolutes"] = [joint for joint in data["revolutes"] if "spider" not in joint["pair"]]
        del data["outputs"], data["states"]
        for at, way in enumerate(ways):
            data["links"][f"spider{at}"] = {"wheels": {f"p{at}": {"teeth": pinion, "kind": "bevel"}}}
            data["axes"][f"S{at}"] = {"direction": list(way)}
            data["revolutes"].append({"pair": ["crown", f"spider{at}"], "axis": f"S{at}"})
            data["gears"] += [{"pair": ["l16", f"p{at}"]}, {"pair": ["r16", f"p{at}"]}]
        train = GearTrain.declare(data)
        # bevel wheels have no sums
        rules = rules_of(train.declaration, ["l16", "r16"], planets=number, coaxial=True)
        assert [rule.name for rule in rules] == [f"{number} equal planets on 'crown': {number} divides l16 + r16"]
        assert passed(rules, l16=left, r16=right) == bool(train.closure)
        assert train.closure.loops


def test_planets_declared_one_by_one_are_equal_and_counted_once() -> None:
    data = epicyclic(*stepped(20, 15, 12, 60), copies=3)
    # another order of pairs does not hide that planets are alike
    data["gears"] = data["gears"][::-1]
    rules = rules_of(data, planets=3, coaxial=False)
    names = {rule.name for rule in equations(rules)}
    assert len(names) == 4
    for wheel in "pq":
        alike = {wheel, f"{wheel}-1", f"{wheel}-2"}
        assert {w for rule in equations(rules) for w in rule.wheels if w[0] == wheel} == alike
    assert sum("gcd" in rule.name for rule in rules) == 1
    some = rules_of(data, ["p", "q-1"], planets=3, coaxial=False)
    assert {rule.name for rule in equations(some)} >= {"equal planets: p = 15", "equal planets: q-1 = 12"}
    with pytest.raises(QuestionError, match="3 equal sets are declared"):
        rules_of(data, planets=4)


def test_planets_are_requested_for_by_carrier_and_unknown_carriers_are_refused() -> None:
    train = load("zf-8hp70").declaration
    rules = rules_of(train, planets={"OUT": 4, "IN": 3}, coaxial=False)
    assert {rule.name for rule in rules} == {
        "4 equal planets on 'OUT': 4 divides r4 + s4",
        "3 equal planets on 'IN': 3 divides r2 + s2",
    }
    with pytest.raises(QuestionError, match="'S12' carries no planets"):
        rules_of(train, planets={"S12": 3})
    with pytest.raises(QuestionError, match="no link carries planets"):
        rules_of(reverted([None] * 4), planets=3)
    with pytest.raises(QuestionError, match="at least one planet"):
        rules_of(epicyclic(*SIMPLE), planets=0)


def test_planets_that_mesh_in_a_loop_are_not_judged() -> None:
    data = epicyclic(
        {"s": (24, False)},
        [{"p": 15}, {"q": 14}, {"u": 13}],
        [("s", "p"), ("p", "q"), ("q", "u"), ("u", "p")],
    )
    with pytest.raises(QuestionError, match="in a loop"):
        rules_of(data, planets=2)
    assert rules_of(data) == ()


# -------------------------------------------------------------------------------------------------------------- limits


def test_limits_hold_for_every_free_wheel_alone() -> None:
    rules = rules_of(
        epicyclic(*SIMPLE), ["s", "p"], coaxial=False, minimum=12, maximum_teeth=40, largest_radius=length("18")
    )
    assert all(len(rule.wheels) == 1 for rule in rules)
    for s, p in product(range(8, 45, 4), repeat=2):
        assert passed(rules, s=s, p=p) == (12 <= s <= 36 and 12 <= p <= 36)


def test_a_radius_is_a_length_where_modules_are() -> None:
    data = reverted(["0.8 mm", None, None, "1.5 mm"])
    rules = rules_of(data, coaxial=False, largest_radius=length("30 mm"))
    assert "'z1' has a radius of at most 30 mm" in [rule.name for rule in rules]
    assert passed(rules, z1=75, z2=75, z3=40, z4=40)
    assert not passed(rules, z1=76, z2=75, z3=40, z4=40)
    assert not passed(rules, z1=75, z2=75, z3=41, z4=40)
    with pytest.raises(QuestionError, match="cannot be compared with 30"):
        rules_of(data, largest_radius=length("30"))
    with pytest.raises(QuestionError, match="the module of the wheel is not declared"):
        rules_of(reverted([None] * 4), largest_radius=length("30 mm"))


def test_a_worm_is_requested_for_no_teeth() -> None:
    train = load("worm").declaration
    worm = next(name for name, (_, wheel) in train.wheels.items() if wheel.kind == "worm")
    rules = rules_of(train, minimum=12)
    assert rules
    assert all(worm not in rule.wheels for rule in rules)


def test_hunting_teeth_have_no_common_divisor() -> None:
    rules = rules_of(epicyclic(*SIMPLE), hunting=True, coaxial=False)
    for s, p, r in product(range(20, 26), range(15, 19), range(58, 62)):
        assert passed(rules, s=s, p=p, r=r) == (gcd(s, p) == gcd(p, r) == 1)
    assert rules_of(epicyclic(*SIMPLE), [], hunting=True) == ()


def test_different_counts_are_requested_of_all_wheels_but_equal_planets() -> None:
    data = epicyclic(*SIMPLE, copies=3)
    rules = rules_of(data, ["s", "p", "p-1"], different=True, coaxial=False)
    assert passed(rules, **{"s": 24, "p": 18, "p-1": 18})
    assert not passed(rules, **{"s": 18, "p": 17, "p-1": 17})
    assert not passed(rules, **{"s": 60, "p": 17, "p-1": 17})
    assert len({rule.name for rule in rules}) == 1


# -------------------------------------------------------------------------------------------------------------- asking


def test_wheels_without_a_count_get_rules_too() -> None:
    data = epicyclic(*SIMPLE)
    for link, wheel in (("Ls", "s"), ("Lr", "r"), ("P0", "p")):
        own = data["links"][link]["wheels"]
        own[wheel] = {"teeth": {"search": [12, 80]}} | ({"internal": True} if wheel == "r" else {})
    rules = rules_of(data, planets=3, clearance=Fraction(0))
    assert len(rules) == 3
    grid = box(s=range(12, 30), p=range(12, 30), r=range(40, 80))
    kept = np.logical_and.reduce([rule.holds(grid) for rule in rules])
    rows = zip(*(grid[name].tolist() for name in "spr"), strict=True)
    wanted = [s + 2 * p == r and (s + r) % 3 == 0 and (s + p) * 3**0.5 / 2 > p + 2 for s, p, r in rows]
    assert kept.tolist() == wanted


def test_rules_can_be_sent_to_other_processes_and_come_cheapest_first() -> None:
    train = load("planets-in-place").declaration
    rules = rules_of(train, planets=3, clearance=Fraction(1, 2), minimum=12, hunting=True, different=True)
    some = columns(**{wheel: [20, 24, 18] for wheel in train.wheels})
    for rule in rules:
        again = pickle.loads(pickle.dumps(rule))
        assert again.name == rule.name
        assert again.holds(some).tolist() == rule.holds(some).tolist()
    kinds = [(not is_equation(rule), len(rule.wheels)) for rule in rules]
    first = next(at for at, (condition, _) in enumerate(kinds) if not condition)
    last = max(at for at, (condition, _) in enumerate(kinds) if not condition)
    assert all(count == 1 for _, count in kinds[:first])
    assert all(not condition for condition, _ in kinds[first : last + 1])


PLANETS = """
extends: planetary-24-18-60
links:
  sun: {wheels: {s: {teeth: {value: 24, search: [20, 28]}}}}
  planet: {wheels: {p: {teeth: {value: 18, search: [15, 20]}}}}
outputs: {carrier: {targets: [{speed: 2/7, tolerance: 5 %}]}}
"""


@pytest.mark.parametrize("planets", [3, {"carrier": 3}])
def test_the_command_reads_what_is_requested_from_texts(planets: Any, tmp_path: Path) -> None:
    (tmp_path / "set.yaml").write_text(PLANETS)
    texts = ("3" if planets == 3 else "carrier=3", "1/2", "60")
    named = ("planets", "clearance", "max-radius")
    given = (f"--{name}={text}" for name, text in zip(named, texts, strict=True))
    found = call("teeth", "train", tmp_path / "set.yaml", "--json", *given)
    options = ConstraintOptions(planets=planets, clearance=Fraction(1, 2), largest_radius=length("60"))
    rules = [[*part.rules] for part in search_train(load(PLANETS).declaration, rules=options).parts]
    assert sum(map(len, rules)) > 4
    assert [part["rules"] for part in json.loads(found.stdout)["parts"]] == rules
