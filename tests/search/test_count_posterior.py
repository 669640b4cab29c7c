"""Counts in doubt: every figure against brute force with the solver, one combination at a time."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from fractions import Fraction
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from commands import call

from geartrain import load
from geartrain.analysis import GearTrain
from geartrain.errors import GearTrainError, QuestionError, RangeError
from geartrain.numerics import Journal, open_executor
from geartrain.search import ToothCountPosterior, infer_counts

LONG = 10**18  # sums of products of such weights need integers of Python
CHAIN: dict[str, Any] = {
    "name": "chain",
    "links": {
        "frame": {},
        "a": {"wheels": {"a1": {"teeth": {"value": 20, "range": [19, 22]}}}},
        "b": {
            "wheels": {
                "b1": {"teeth": {"value": 60, "choices": [58, 60, 61], "weights": [LONG, 2 * LONG, LONG + 1]}},
                "b2": {"teeth": {"value": 30, "range": [29, 31], "weights": ["1/2", "1/3", "1/6"]}},
            }
        },
        "c": {"wheels": {"c1": {"teeth": {"value": 90, "range": [88, 91]}}}},
    },
    "revolutes": [{"pair": ["frame", link], "axis": link.upper()} for link in "abc"],
    "gears": [{"pair": ["a1", "b1"]}, {"pair": ["b2", "c1"]}],
    "inputs": {"a": 1},
    "outputs": {
        "b": {"targets": [{"speed": "-1/3", "tolerance": "3 %"}]},
        "c": {"targets": [{"speed": "1/9", "tolerance": "4 %"}]},
    },
}
PLANETARY: dict[str, Any] = {
    "name": "planetary",
    "links": {
        "frame": {"wheels": {"ring": {"teeth": {"value": 60, "range": [57, 63]}, "internal": True}}},
        "sun": {"wheels": {"s": {"teeth": {"value": 24, "choices": [22, 24, 25], "weights": [1, 3, 2]}}}},
        "planet": {"wheels": {"p": {"teeth": {"value": 18, "range": [17, 19]}}}},
        "carrier": {},
    },
    "revolutes": [
        {"pair": ["frame", "sun"], "axis": "main"},
        {"pair": ["frame", "carrier"], "axis": "main"},
        {"pair": ["carrier", "planet"], "axis": "planet"},
    ],
    "gears": [{"pair": ["s", "p"]}, {"pair": ["p", "ring"]}],
    "inputs": {"sun": 1},
    "outputs": {
        "carrier": {"targets": [{"speed": "2/7", "tolerance": "2 %"}]},
        "planet": {"expect": {"value": -0.66, "tolerance": 0.05}},
    },
}
LOOP: dict[str, Any] = {  # both ways from a to d must have one ratio, or nothing turns
    "name": "loop",
    "links": {
        "frame": {},
        "a": {"wheels": {"a1": {"teeth": {"value": 20, "range": [18, 22]}}, "a2": {"teeth": 20}}},
        "b": {"wheels": {"b1": {"teeth": {"value": 40, "range": [36, 44]}}}},
        "d": {"wheels": {"d1": {"teeth": {"value": 60, "range": [58, 62]}}, "d2": {"teeth": 60}}},
        "c": {"wheels": {"c1": {"teeth": 30}}},
    },
    "revolutes": [{"pair": ["frame", link], "axis": link.upper()} for link in "abcd"],
    "gears": [{"pair": ["a1", "b1"]}, {"pair": ["b1", "d1"]}, {"pair": ["a2", "c1"]}, {"pair": ["c1", "d2"]}],
    "inputs": {"a": 1},
    "outputs": {"b": {"targets": [{"speed": "-1/2", "tolerance": "6 %"}]}},
}
TRAINS = {"chain": CHAIN, "planetary": PLANETARY, "loop": LOOP}


def doubts_of(data: Mapping[str, Any]) -> dict[str, dict[int, Fraction]]:
    """Wheel -> count -> prior, read off the plain data by hand."""
    found = {}
    for link in data["links"].values():
        for wheel, teeth in link.get("wheels", {}).items():
            doubt = teeth["teeth"]
            if not isinstance(doubt, dict):
                continue
            counts = doubt.get("choices") or list(range(doubt["range"][0], doubt["range"][1] + 1))
            weights = [Fraction(weight) for weight in doubt.get("weights", [1] * len(counts))]
            found[wheel] = {count: weight / sum(weights) for count, weight in zip(counts, weights, strict=True)}
    return found


def with_teeth(data: Mapping[str, Any], teeth: Mapping[str, int]) -> dict[str, Any]:
    links = {}
    for name, link in data["links"].items():
        wheels = {
            wheel: {**made, "teeth": teeth.get(wheel, made["teeth"])} for wheel, made in link.get("wheels", {}).items()
        }
        links[name] = {"wheels": wheels} if wheels else {}
    return {**data, "links": links}


def all_of(data: Mapping[str, Any]) -> Iterator[tuple[dict[str, int], Fraction, dict[str, Fraction] | None]]:
    """Every combination with its prior and the solver's speeds; None where the train does not turn."""
    doubts = doubts_of(data)
    for counts in product(*doubts.values()):
        teeth = dict(zip(doubts, counts, strict=True))
        answer = GearTrain.declare(with_teeth(data, teeth)).solve()
        prior = math.prod((doubts[wheel][count] for wheel, count in teeth.items()), start=Fraction(1))
        turns = bool(answer.verdict) and all(answer.speeds[link] is not None for link in answer.speeds)
        yield teeth, prior, {name: Fraction(answer[name]) for name in data["outputs"]} if turns else None


def misfit_of(data: Mapping[str, Any], speeds: Mapping[str, Fraction]) -> list[Fraction]:
    """(error / tolerance) of every output."""
    found = []
    for name, output in data["outputs"].items():
        if "targets" in output:
            target = output["targets"][0]
            wanted = Fraction(target["speed"])
            share = Fraction(target["tolerance"].split()[0]) / 100
            found.append((speeds[name] - wanted) / (share * wanted))
        else:
            wanted, half = (Fraction(str(output["expect"][key])) for key in ("value", "tolerance"))
            found.append((speeds[name] - wanted) / half)
    return found


@pytest.fixture(scope="module", params=TRAINS)
def case(request: pytest.FixtureRequest) -> tuple[dict[str, Any], list[Any]]:
    data = TRAINS[request.param]
    return data, list(all_of(data))


def run(data: Mapping[str, Any], **options: Any) -> ToothCountPosterior:
    return infer_counts(GearTrain.declare(data).declaration, **options)


def test_what_fits_is_what_the_solver_says_fits(case: tuple[dict[str, Any], list[Any]]) -> None:
    data, everything = case
    found = run(data, method="exact", most=5)
    turning = [row for row in everything if row[2] is not None]
    fitting = [row for row in turning if all(abs(off) <= 1 for off in misfit_of(data, row[2]))]
    assert 0 < len(fitting) < len(turning)
    assert (found.method, found.combinations, found.ranked) == ("exact", len(everything), True)
    assert found.turning.value == sum(prior for _, prior, _ in turning)
    evidence = sum(prior for _, prior, _ in fitting)
    assert (found.fits, found.evidence.value) == (len(fitting), evidence)
    misfits = sorted(sum(off**2 for off in misfit_of(data, speeds)) for _, _, speeds in fitting)
    assert [one.misfit for one in found.best] == misfits[:5]
    for wheel, counts in doubts_of(data).items():
        for count in counts:
            share = sum(prior for teeth, prior, _ in fitting if teeth[wheel] == count) / evidence
            assert found[wheel].probability(count).value == share
    weights = np.array([float(prior / evidence) for _, prior, _ in fitting])
    for pair, value in found.correlations.items():
        one, other = (np.array([teeth[wheel] for teeth, _, _ in fitting], dtype=float) for wheel in pair)
        spread = np.cov(one, other, aweights=weights, ddof=0)
        assert value == pytest.approx(spread[0, 1] / math.sqrt(spread[0, 0] * spread[1, 1]), abs=1e-9)
    for one in found.best:
        speeds = next(row[2] for row in fitting if row[0] == {**row[0], **one.teeth})
        assert all(one.speeds[name] == speeds[name] for name in one.speeds)
    assert found.correlations or data["name"] == "loop", "two of its wheels are forced"


def test_the_order_of_the_declaration_changes_nothing(case: tuple[dict[str, Any], list[Any]]) -> None:
    data = case[0]
    turned = data | {name: dict(reversed(data[name].items())) for name in ("links", "outputs")}
    one, other = run(data, method="exact"), run(turned | {"gears": data["gears"][::-1]}, method="exact")
    assert one.evidence == other.evidence
    assert {wheel: one[wheel].probabilities for wheel in one.posteriors} == {
        wheel: other[wheel].probabilities for wheel in one.posteriors
    }
    assert [each.misfit for each in one.best] == [each.misfit for each in other.best]


@pytest.mark.parametrize("method", ["exact", "sample"])
@pytest.mark.parametrize("size", [1, 10**3, 10**9])
def test_the_ends_of_a_tolerance_are_within_it_and_nothing_beyond_is(method: str, size: int) -> None:
    """23/70 against 1/3 is off by 1/70 of it: no float tells that from 1/70 less a 10^-30th."""
    for share, fits in (("1/70", True), (str(Fraction(1, 70) - Fraction(1, 10**30)), False)):
        data = with_teeth(CHAIN, {"b2": 30, "c1": 90})
        data["outputs"] = {"b": {"targets": [{"speed": "-1/3", "tolerance": share}]}}
        found = run(data, method=method, samples=1000, free={"a1": [23 * size], "b1": [70 * size, 80 * size]})
        assert found.evidence.value == pytest.approx(0.5 if fits else 0, abs=0 if method == "exact" else 0.1)
        assert bool(found.best) is fits


def test_a_sample_covers_the_truth_as_often_as_its_intervals_promise(case: tuple[dict[str, Any], list[Any]]) -> None:
    exact = run(case[0], method="exact")
    covered = examined = 0
    for seed in range(1, 21):
        found = run(case[0], method="sample", samples=3000, seed=seed)
        pairs = [(found.evidence, exact.evidence)]
        for wheel, posterior in exact.posteriors.items():
            pairs += (
                list(zip(found[wheel].probabilities, posterior.probabilities, strict=True))
                if not posterior.idle
                else []
            )
        for estimate, truth in pairs:
            assert estimate.low is not None
            assert estimate.high is not None
            covered += estimate.low <= float(truth) <= estimate.high
            examined += 1
    assert 0.92 < covered / examined <= 1


def test_a_sample_depends_on_its_seed_alone() -> None:
    one, other, third = (run(CHAIN, method="sample", samples=20_000, seed=seed) for seed in (3, 3, 4))
    assert one == other
    assert one.evidence != third.evidence
    assert not one.ranked


def shares_by_force(data: Mapping[str, Any], output: str) -> dict[str, tuple[Fraction, Fraction]]:
    """First-order and total shares by conditional means over all combinations."""
    rows = [(teeth, prior, speeds[output]) for teeth, prior, speeds in all_of(data) if speeds is not None]
    mean = sum(prior * speed for _, prior, speed in rows)
    variance = sum(prior * (speed - mean) ** 2 for _, prior, speed in rows)
    found = {}
    for wheel in doubts_of(data):
        parts = []
        for known in ([wheel], [other for other in doubts_of(data) if other != wheel]):
            sums: dict[tuple[int, ...], list[Fraction]] = {}
            for teeth, prior, speed in rows:
                key = tuple(teeth[each] for each in known)
                weight, total = sums.get(key, (Fraction(0), Fraction(0)))
                sums[key] = [weight + prior, total + prior * speed]
            parts.append(sum(total**2 / weight for weight, total in sums.values()) - mean**2)
        found[wheel] = parts[0] / variance, 1 - parts[1] / variance
    return found


def test_shares_of_variance_are_those_of_conditional_means() -> None:
    for data, output, exact in ((CHAIN, "c", True), (PLANETARY, "carrier", False), (PLANETARY, "planet", False)):
        shares = run(data).shares[output]
        for wheel, (own, whole) in shares_by_force(data, output).items():
            if wheel not in shares.own:
                assert own == whole == 0
            elif exact:
                assert (shares.own[wheel], shares.whole[wheel]) == (own, whole)
            else:
                assert float(shares.own[wheel]) == pytest.approx(float(own), abs=1e-10)
                assert float(shares.whole[wheel]) == pytest.approx(float(whole), abs=1e-10)


@pytest.mark.parametrize("step", [Fraction(10**8), Fraction(1, 10**8)])
def test_speeds_beyond_float64_have_shares_and_a_standard_deviation(step: Fraction, tmp_path: Path) -> None:
    """44 pairs of 10^8 teeth and of 1 make 10^352, or its inverse; one wheel of a single tooth may have two."""
    up, last = step > 1, 44
    driver, driven = (10**8, 1) if up else (1, 10**8)
    links: dict[str, Any] = {f"l{at}": {"wheels": {f"p{at}": driver, f"w{at}": driven}} for at in range(last + 1)}
    links["l1"]["wheels"]["w1" if up else "p1"] = {"teeth": {"value": 1, "range": [1, 2]}}
    data = {
        "name": "far",
        "links": {"frame": {}, **links},
        "revolutes": [{"pair": ["frame", link], "axis": link} for link in links],
        "gears": [{"pair": [f"p{at}", f"w{at + 1}"]} for at in range(last)],
        "inputs": {"l0": 1},
        "outputs": {"far": {"of": f"l{last}"}, "near": {"of": "l2", "targets": [{"speed": 1, "tolerance": "1e40"}]}},
    }
    found = run(data)
    shares = found.shares["far"]
    far = step**last
    ends = (far, far / 2) if up else (far, 2 * far)
    assert shares.mean == sum(ends) / 2
    assert shares.spread is None
    assert list(shares.whole.values()) == [1]
    assert shares.to_dict()["mean"] is shares.to_dict()["spread"] is None
    (tmp_path / "far.yaml").write_text(json.dumps(data), encoding="utf-8")
    assert f"e{'+' if up else '-'}35" in call("posterior", tmp_path / "far.yaml").stdout


def test_an_output_of_too_many_combinations_has_no_shares(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("geartrain.search.posterior.posterior_summary._LISTED", 1)
    assert not run(PLANETARY).shares


def test_an_output_that_is_free_for_some_counts_has_no_shares_and_does_not_fit_there() -> None:
    """sun -> carrier through 20 ~ 20, p2 ~ 20 on a held wheel: 1 / (1 - p2/20), and no speed at all for p2 = 20."""
    data = {
        "name": "pole",
        "links": {
            "frame": {"wheels": {"held": 20}},
            "planet": {"wheels": {"p1": 20, "p2": {"teeth": {"value": 19, "range": [17, 21]}}}},
            "sun": {"wheels": {"s": 20}},
            "carrier": {},
        },
        "revolutes": [
            {"pair": ["frame", "sun"], "axis": "main"},
            {"pair": ["frame", "carrier"], "axis": "main"},
            {"pair": ["carrier", "planet"], "axis": "planet"},
        ],
        "gears": [{"pair": ["held", "p1"]}, {"pair": ["p2", "s"]}],
        "unit": {"per": "1 d"},
        "inputs": {"sun": 1},
        "outputs": {"carrier": {"targets": [{"period": "1/20 d", "tolerance": "60 %"}]}},
    }
    found = run(data, method="exact")
    speeds = {count: 1 / (1 - Fraction(count, 20)) for count in (17, 18, 19, 21)}
    fits = {count for count, speed in speeds.items() if abs(abs(speed) / 20 - 1) <= Fraction(6, 10)}
    assert {count for count in range(17, 22) if found["p2"].probability(count).value} == fits == {18, 19, 21}
    assert not found.shares


def test_the_antikythera_fits_its_inscriptions_and_others_fit_as_well() -> None:
    """What freeth-2008 prints meets every demand exactly; the evidence leaves more."""
    found = infer_counts(load("freeth-2008-doubt").declaration, most=3)
    assert found.method == "exact"
    assert found.best[0].misfit == 0
    printed = {"b2": 64, "c1": 38, "c2": 48, "e3": 223, "e4": 188, "m3": 27, "n1": 53, "f1": 53, "g1": 54}
    assert {wheel: found.best[0].teeth[wheel] for wheel in printed} == printed
    assert found.best[0].speeds["saros"] == -Fraction(940, 4237)
    assert found.best[0].speeds["metonic"] == -Fraction(5, 19)
    assert found["b2"].probability(64).value == 1
    assert {count for count in range(15, 81) if found["n1"].probability(count).value} == {52, 53, 55}
    assert found["a1"].idle
    assert sum(chance.value for chance in found["e3"].probabilities) == 1


def test_pointers_that_must_be_exact_force_the_published_counts() -> None:
    """Only wheels that mesh and cancel (e5 ~ k1, k2 ~ e6), and those that no dial sees, may be other than printed."""
    found = infer_counts(load("freeth-2008-doubt").declaration, scale=Fraction(0), most=3)
    forced = {w: p.likeliest for w, p in found.posteriors.items() if max(c.value for c in p.probabilities) == 1}
    printed = {"b2": 64, "c1": 38, "c2": 48, "e3": 223, "e4": 188, "l1": 38, "m1": 96, "m3": 27, "n1": 53, "nO": 57}
    assert forced == printed | {"o1": 60, "f1": 53, "g1": 54, "h1": 60, "i1": 60}
    both = len({50, 51, 52} & {48, 49, 50, 51}), len({48, 49, 50, 51, 52} & {49, 50, 51, 52, 53, 54, 55})
    assert found.fits == both[0] * both[1] * 9 * 16


def test_the_metonic_train_alone_by_brute_force() -> None:
    """5 turns in 19 years through b2, l1, l2, m1, m2, n1, of which four are in doubt: plain fractions, no train."""
    found = infer_counts(load("freeth-2008-doubt").declaration, outputs=["metonic"])
    fits = [
        (b2, l1, m1, n1)
        for b2, l1, m1, n1 in product(range(64, 67), (37, 38), range(95, 100), range(15, 81))
        if abs(Fraction(b2 * 53 * 15, l1 * m1 * n1) / Fraction(5, 19) - 1) <= Fraction(1, 470)
    ]
    assert found.evidence.value == Fraction(len(fits), 3 * 2 * 5 * 66)
    for n1 in range(15, 81):
        assert found["n1"].probability(n1).value == Fraction(sum(row[3] == n1 for row in fits), len(fits))


def test_a_tighter_tolerance_never_lets_more_through() -> None:
    shares = [run(CHAIN, scale=Fraction(factor)).evidence.value for factor in ("2", "1", "1/2", "0")]
    assert shares == sorted(shares, reverse=True)
    assert shares[-1] > 0, "the declared counts give the targets exactly"


def test_who_does_the_work_changes_nothing(tmp_path: Any) -> None:
    whole = run(CHAIN, method="sample", samples=60_000)
    with open_executor(2) as executor:
        assert run(CHAIN, method="sample", samples=60_000, executor=executor) == whole
    with Journal(tmp_path / "j.jsonl", {"train": "chain"}) as journal:
        assert run(CHAIN, method="sample", samples=60_000, journal=journal) == whole
        kept = len(journal)
    with Journal(tmp_path / "j.jsonl", {"train": "chain"}) as journal:
        assert len(journal) == kept > 1
        assert run(CHAIN, method="sample", samples=60_000, journal=journal) == whole
    with pytest.raises(QuestionError, match="another run"):
        Journal(tmp_path / "j.jsonl", {"train": "planetary"})


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"free": {"x9": [1]}}, "no wheel 'x9'"),
        ({"free": {"a1": []}}, "has no possible counts"),
        ({"free": {"a1": [0, 1]}}, "0 is not a tooth count"),
        ({"free": {"a1": [20], "b1": [60], "b2": [30], "c1": [90]}}, "is uncertain"),
        ({"outputs": ["moon"]}, "no output 'moon'"),
        ({"state": "night"}, "no state 'night'"),
        ({"against": "figures"}, "no output that depends on uncertain counts"),
        ({"against": "hopes"}, "'hopes' is not a kind of observation"),
        ({"limit": 0}, "limit is 0"),
        ({"most": 0}, "most is 0"),
        ({"samples": 0}, "samples is 0"),
        ({"method": "guess"}, "'guess' is not a method"),
        ({"scale": Fraction(-1)}, "tolerance factor -1"),
        ({"tolerance": Fraction(-1)}, "the tolerance -1 is negative"),
        ({"method": "exact", "limit": 1}, "the exact method needs more than 1 steps"),
    ],
)
def test_what_cannot_be_requested_is_refused_with_a_way_out(options: dict[str, Any], said: str) -> None:
    with pytest.raises((QuestionError, RangeError)) as caught:
        run(CHAIN, **options)
    assert said in str(caught.value)
    assert all(problem.fix for problem in caught.value.problems)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"range": [22, 19]}, "is empty"),
        ({"range": [19, 21], "weights": [1, -1, 1]}, "do not define probabilities"),
        ({"range": [19, 21], "weights": [0, 0, 0]}, "do not define probabilities"),
        ({"range": [1, 10**6]}, "possible counts"),
        ({"fixed": ["b"]}, "cannot turn"),
        ({"outputs": {"c": {"targets": [{"speed": "1e-400", "tolerance": "50 %"}]}}}, "from 1e-300 to 1e300"),
    ],
)
def test_declarations_that_cannot_be_weighed_are_refused(change: dict[str, Any], said: str) -> None:
    is_train = change.keys() <= {"fixed", "outputs"}
    data = CHAIN | change if is_train else with_teeth(CHAIN, {"a1": {"value": 20, **change}})  # type: ignore[dict-item]
    with pytest.raises(GearTrainError, match=said):
        run(data)


def test_an_output_without_a_tolerance_is_no_evidence() -> None:
    data = {**CHAIN, "outputs": {**CHAIN["outputs"], "c": {"targets": [{"speed": "1/9"}]}}}
    found = run(data)
    assert [witness.name for witness in found.witnesses] == ["b"]
    assert any("'c' is not used" in remark for remark in found.remarks)
    assert found["c1"].idle
    with pytest.raises(QuestionError, match="the speed of output 'c' is not known"):
        run(data, outputs=["c"])
    assert run(data, tolerance=Fraction(4, 100)).evidence == run(CHAIN).evidence


def test_counts_of_no_weight_are_left_out() -> None:
    doubt = {"value": 20, "range": [19, 21], "weights": [1, 1, 0]}
    found = run(with_teeth(CHAIN, {"a1": doubt}))  # type: ignore[dict-item]
    assert found["a1"].uncertainty.counts == (19, 20)
