"""A sense asked for is a sense found: both signs told apart, and a magnitude the union of the two, by brute force.

The carrier of a stepped set over a held sun turns with its other sun or against it as the counts have it:
speed = 1 / (1 - held q / (p s)), written out here by hand.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from itertools import product
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shipped import every_train

import geartrain
from geartrain import GearTrain
from geartrain.kinematics.formulas import with_counts
from geartrain.report import to_markdown
from geartrain.report.reconstruction_comparison import describe_comparison
from geartrain.search import infer_counts, search_train

Counts = tuple[int, int]
HELD, SUN = 20, 21
BOX = tuple(product(range(17, 26), range(17, 26)))  # of p and q


def carrier(p: int, q: int) -> Fraction | None:
    below = 1 - Fraction(HELD * q, p * SUN)
    return 1 / below if below else None


def stepped(output: Mapping[str, Any], kind: str = "search") -> GearTrain:
    def wheel(value: int) -> dict[str, Any]:
        return {"teeth": {"value": value, kind: [17, 25]}}

    return GearTrain.declare(
        {
            "name": "stepped",
            "unit": {"per": "1 d"},
            "links": {
                "frame": {"wheels": {"held": HELD}},
                "sun": {"wheels": {"s": SUN}},
                "planet": {"wheels": {"p": wheel(18), "q": wheel(19)}},
                "carrier": {},
            },
            "revolutes": [
                {"pair": ["frame", "sun"], "axis": "main"},
                {"pair": ["frame", "carrier"], "axis": "main"},
                {"pair": ["carrier", "planet"], "axis": "planet"},
            ],
            "gears": [{"pair": ["held", "p"]}, {"pair": ["q", "s"]}],
            "inputs": {"sun": 1},
            "outputs": {"carrier": dict(output)},
        }
    )


def targets(size: Fraction, tolerance: str | None) -> dict[str, dict[str, Any]]:
    """One magnitude asked for in five ways."""
    more = {} if tolerance is None else {"tolerance": tolerance}
    period = {"period": f"{1 / size} d", **more}
    return {
        "+": {"speed": str(size), **more},
        "-": {"speed": str(-size), **more},
        "direct": {**period, "sense": "direct"},
        "retrograde": {**period, "sense": "retrograde"},
        "either": period,
    }


def met(size: Fraction, tolerance: Fraction, sense: int) -> set[Counts]:
    """Counts whose carrier is within a share of a speed; of either sense for 0."""
    found = set()
    for counts in BOX:
        speed = carrier(*counts)
        if speed is not None:
            error = (abs(speed) if sense == 0 else speed * sense) / size - 1
            if abs(error) <= tolerance:
                found.add(counts)
    return found


SIGNS = {"+": 1, "direct": 1, "-": -1, "retrograde": -1, "either": 0}
SIZES = [Fraction(21), Fraction(8), Fraction(25, 2)]


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("tolerance", ["0", "2 %", "30 %"])
def test_a_search_tells_both_senses_apart_and_a_period_takes_both(size: Fraction, tolerance: str) -> None:
    share = Fraction(tolerance.split()[0]) / 100
    found = {}
    for way, target in targets(size, tolerance).items():
        result = search_train(stepped({"targets": [target]}).declaration, rules=(), best=1000)
        found[way] = {(one.teeth["p"], one.teeth["q"]) for one in result.solutions}
        assert found[way] == met(size, share, SIGNS[way])
        assert result.count == len(found[way])
    assert found["+"] == found["direct"]
    assert found["-"] == found["retrograde"]
    assert not found["+"] & found["-"]
    assert found["either"] == found["+"] | found["-"]


@pytest.mark.parametrize("by", ["error", "total", "largest", "distinct", "change"])
@pytest.mark.parametrize("way", SIGNS)
def test_in_every_order_what_is_approached_is_approached_from_its_own_side(way: str, by: Any) -> None:
    size = Fraction(13)
    result = search_train(
        stepped({"targets": [targets(size, None)[way]]}).declaration, rules=(), best=6, by=by,
        tolerance=Fraction(1, 5) if by != "error" else None,
    )  # fmt: skip
    assert result.solutions
    speeds = [carrier(one.teeth["p"], one.teeth["q"]) for one in result.solutions]
    assert None not in speeds
    assert all(speed * SIGNS[way] >= 0 for speed in speeds if speed is not None)
    if by == "error":
        errors = sorted(
            abs((speed * (SIGNS[way] or (1 if speed > 0 else -1))) / size - 1)
            for counts in BOX
            if (speed := carrier(*counts)) is not None and speed * SIGNS[way] >= 0
        )
        assert [abs(one.outputs["carrier"].error) for one in result.solutions] == errors[:6]


@pytest.mark.parametrize("size", SIZES)
def test_counts_in_doubt_are_weighed_by_the_sense_too(size: Fraction) -> None:
    chances = {}
    for way, target in targets(size, "30 %").items():
        found = infer_counts(stepped({"targets": [target]}, "range").declaration, method="exact")
        fits = met(size, Fraction(3, 10), SIGNS[way])
        assert found.evidence.value == Fraction(len(fits), len(BOX))
        chances[way] = {
            count: found["p"].probability(count).value * found.evidence.value for count in range(17, 26)
        }  # fmt: skip
        for count, chance in chances[way].items():
            assert chance == Fraction(sum(p == count for p, _ in fits), len(BOX))
    for count in range(17, 26):
        assert chances["either"][count] == chances["+"][count] + chances["-"][count]


@settings(max_examples=60, deadline=None)
@given(
    st.tuples(st.integers(17, 25), st.integers(17, 25)).filter(lambda counts: carrier(*counts) is not None),
    st.fractions(min_value=Fraction(1, 9), max_value=30, max_denominator=50),
    st.sampled_from(["0", "5 %", "90 %", "1.99"]),
)
def test_an_answer_holds_a_speed_against_its_target_with_its_sign(
    counts: Counts, size: Fraction, tolerance: str
) -> None:
    speed = carrier(*counts)
    assert speed is not None
    share = Fraction(tolerance.split()[0]) / (100 if "%" in tolerance else 1)
    for way, target in targets(size, tolerance).items():
        train = GearTrain(with_counts(stepped({"targets": [target]}).declaration, dict(zip("pq", counts, strict=True))))
        (result,) = train.solve().outputs["carrier"].targets
        own = abs(speed) if way == "either" else speed * SIGNS[way]
        assert result.error == own / size - 1
        assert result.met is (abs(own / size - 1) <= share)
        assert result.compared == ("magnitude" if way == "either" else "speed")


@pytest.mark.parametrize("tolerance", ["0", "1/2", "9", "40"])
def test_a_speed_of_zero_is_searched_by_difference(tolerance: str) -> None:
    target = {"speed": "0", "tolerance": tolerance}
    result = search_train(stepped({"targets": [target]}).declaration, rules=(), best=1000)
    speeds = {counts: carrier(*counts) for counts in BOX}
    near = {counts for counts, speed in speeds.items() if speed is not None and abs(speed) <= Fraction(tolerance)}
    assert {(one.teeth["p"], one.teeth["q"]) for one in result.solutions} == near
    found = infer_counts(stepped({"targets": [target]}, "range").declaration, method="exact") if near else None
    assert found is None or found.evidence.value == Fraction(len(near), len(BOX))


def test_what_turns_wrong_whatever_the_counts_is_said_to() -> None:
    requested = ({"speed": "1/2"}, {"speed": "1/2", "tolerance": "1 %"}, {"period": "2 d", "sense": "direct"})
    for output in ({"expect": "1/2"}, *({"targets": [target]} for target in requested)):
        data = {
            "unit": {"per": "1 d"},
            "links": {
                "frame": {},
                "a": {"wheels": {"p": {"teeth": {"search": [10, 40]}}}},
                "b": {"wheels": {"w": {"teeth": {"search": [10, 40]}}}},
            },
            "revolutes": [{"pair": ["frame", "a"], "axis": "A"}, {"pair": ["frame", "b"], "axis": "B"}],
            "gears": [{"pair": ["p", "w"]}],
            "inputs": {"a": 1},
            "outputs": {"b": output},
        }
        found = search_train(GearTrain.declare(data).declaration, rules=())
        assert found.count == 0
        assert "'b' turn in the opposite sense" in found.parts[0].shortfall.nearest


# told ----------------------------------------------------------------------------------------------------------------


def test_reports_say_where_only_a_magnitude_was_compared() -> None:
    way = targets(Fraction(21), "2 %")
    train = stepped({"targets": [way["-"], way["retrograde"], way["either"], {"speed": 0}]})
    text = to_markdown([train.report()])
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in text.splitlines() if "| carrier" in line]
    assert [row[6] for row in rows if row[1].startswith(("speed", "period"))] == [
        "with sense",
        "with sense",
        "magnitude",
        "difference",
    ]
    assert "either sense of rotation meets it" in text
    beside = to_markdown([describe_comparison([stepped({"targets": [way["either"], {"speed": 0}]})])])
    assert "period 1/21 d (magnitude)" in beside
    assert "off by" in beside


def test_a_search_says_so_too() -> None:
    for way, words in (("either", " in either sense within"), ("direct", " direct within"), ("+", "speed 21 within")):
        (part,) = search_train(stepped({"targets": [targets(Fraction(21), "2 %")[way]]}).declaration, rules=()).parts
        assert words in part.demands[0]


# shipped trains ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", every_train())
def test_shipped_trains_turn_as_their_targets_say(name: str) -> None:
    for answer in geartrain.load(name).answers():
        for result in answer.outputs.values():
            for target in result.targets:
                assert target.ppm is not None
                assert abs(target.ppm) < 10**5, f"{result.name} against {target.label}"


@pytest.mark.parametrize(
    ("name", "output", "sense"),
    [
        ("freeth-2008", "games", 1),  # alone among the pointers of the back
        ("freeth-2008", "metonic", -1),
        ("freeth-2008", "callippic", -1),
        ("freeth-2008", "saros", -1),
        ("freeth-2008", "exeligmos", -1),
        ("freeth-2008", "moon", 1),
        ("freeth-2021", "nodes", -1),  # retrograde through the zodiac
        ("freeth-2021", "saturn", 1),
        ("price-1974", "sun", -1),
        ("price-1974", "moon", -1),
        ("prague-orloj", "sun in zodiac", -1),
        ("huygens-planetarium-1682", "saturn", -1),
        ("longcase-clock", "hour", 1),
        ("voulgaris-2024-a", "draconic", 0),  # the sense is not published
        ("clock-10000-years", "mars", 0),  # nor given here
        ("vitruvius-hodometer", "drum", 0),
    ],
)
def test_shipped_targets_have_the_sense_of_their_source(name: str, output: str, sense: int) -> None:
    (answer,) = geartrain.load(name).answers()
    goals = [target.goal for target in answer.outputs[output].targets]
    assert goals
    for goal in goals:
        assert (goal.signed and (1 if goal.speed > 0 else -1)) == sense
