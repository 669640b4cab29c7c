"""Torques and losses: exact cases, closed forms, conservation of power, self-locking, sharing."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from commands import call
from hypothesis import given
from hypothesis import strategies as st

from geartrain import load, shipped
from geartrain.torques import Balance, Mesh, find_flows

CASES = json.loads((Path(__file__).parent / "data" / "cases.json").read_text(encoding="utf-8"))["efficiency"]

# sun, ring and arm on one axis, one planet with two wheels: basic ratio (w_sun - w_arm)/(w_ring - w_arm)
SET = """
links:
  frame: {{}}
  sun: {{wheels: {{s: {s}}}}}
  planet: {{wheels: {{p: {p}, q: {q}}}}}
  ring: {{wheels: {{r: {r}}}}}
  arm: {{}}
revolutes:
  - {{pair: [frame, sun], axis: A}}
  - {{pair: [frame, ring], axis: A}}
  - {{pair: [frame, arm], axis: A}}
  - {{pair: [arm, planet], axis: P}}
gears: [{{pair: [s, p], efficiency: {e}}}, {{pair: [q, r], efficiency: {f}}}]
{rest}
"""


def fractions(given: dict[str, str]) -> dict[str, Fraction]:
    return {name: Fraction(value) for name, value in given.items()}


def balance_of(case: dict[str, Any]) -> Balance:
    speeds = fractions(case["speeds"])
    meshes = []
    for at, gear in enumerate(case["gears"]):
        i, j, k = gear["i"], gear["j"], gear["carrier"]
        a, b = gear["zi"], gear["zj"] * (1 if gear["type"] == "external" else -1)
        eta = Fraction(gear["mesh_efficiency"])
        meshes.append(Mesh(str(at), (i, j, k), (1, 1, 1), a, b, a * (speeds[i] - speeds[k]), eta, eta))
    return Balance(
        tuple(link for link in case["links"] if link != case["frame"]),
        tuple(meshes),
        fractions(case["torque_known"]),
        tuple(case["torque_unknown"]),
        tuple(case["fixed"]),
        tuple(((a, 1), (b, 1)) for a, b in case["locks"]),
    )


@pytest.mark.parametrize("case", CASES, ids=lambda case: case["id"])
def test_all_consistent_flows_are_those_of_the_case(case: dict[str, Any]) -> None:
    balance = balance_of(case)
    flows, complete = find_flows(balance)
    assert complete
    found = [(flow.solved.external, flow.solved.brakes, flow.pattern, flow.solved.multipliers) for flow in flows]
    assert len(found) == case["n_consistent_solutions"] == len(case["solutions"])
    for solution in case["solutions"]:
        wanted = {name: t for name, t in fractions(solution["external_torque"]).items() if name in balance.unknown}
        (match,) = (each for each in found if each[0] == wanted)
        assert match[1] == fractions(solution["brake_torque"])
        power = [mesh.power(match[3][mesh.id]) for mesh in balance.meshes]
        for mesh, through, loss in zip(balance.meshes, power, solution["mesh_loss_power"], strict=True):
            side = match[2].get(mesh.id, 0)
            assert through * side >= 0
            eta = mesh.forward if through > 0 else mesh.backward
            assert abs(through) * (1 - eta) == Fraction(loss)
        losses = sum(abs(p) * (1 - m.forward) for p, m in zip(power, balance.meshes, strict=True))
        speeds = fractions(case["speeds"])
        outside = {**balance.known, **match[0]}
        assert sum(torque * speeds[link] for link, torque in outside.items()) == losses


def solved(rows: list[dict[str, Fraction]], links: list[str], given: dict[str, Fraction]) -> dict[str, Fraction]:
    """Speeds by plain elimination, each row a sum that vanishes."""
    left = [dict(row) for row in rows]
    left += [{link: Fraction(1), "": -speed} for link, speed in given.items()]
    pivots: list[tuple[str, dict[str, Fraction]]] = []
    for link in links:
        row = next(row for row in left if row.get(link))
        left.remove(row)
        row = {name: value / row[link] for name, value in row.items()}
        for other in [*left, *(each for _, each in pivots)]:
            factor = other.get(link, Fraction(0))
            for name, value in row.items():
                other[name] = other.get(name, Fraction(0)) - factor * value
        pivots.append((link, row))
    return {link: -row.get("", Fraction(0)) for link, row in pivots}


@pytest.mark.parametrize(
    "case", [c for c in CASES if c["n_consistent_solutions"] == 1 and len(c["torque_unknown"]) == 1 and not c["locks"]],
    ids=lambda case: case["id"],
)  # fmt: skip
def test_the_efficiency_is_the_ratio_with_each_tooth_ratio_lessened_by_its_loss(case: dict[str, Any]) -> None:
    """Kreines' and Mueller's rule: the ratio of speeds with every basic ratio times eta to the sign of its flow."""
    (known,), (asked,) = case["torque_known"], case["torque_unknown"]
    balance = balance_of(case)
    plain = Balance(
        balance.links,
        tuple(Mesh(m.id, m.links, m.senses, m.a, m.b, m.rolling) for m in balance.meshes),
        balance.known, balance.unknown, balance.held, balance.locks,
    )  # fmt: skip
    (lossless,), _ = find_flows(plain)
    links = [link for link in case["links"] if link != case["frame"]]

    def ratio(lossy: bool) -> Fraction:
        rows: list[dict[str, Fraction]] = [{link: Fraction(1)} for link in case["fixed"]]
        for mesh in balance.meshes:
            through = mesh.power(lossless.solved.multipliers[mesh.id])
            share = mesh.forward ** ((through > 0) - (through < 0)) if lossy else Fraction(1)
            row: dict[str, Fraction] = {}
            for link, value in zip(mesh.links, (mesh.a, mesh.b * share, -mesh.a - mesh.b * share), strict=True):
                if link != case["frame"]:
                    row[link] = row.get(link, Fraction(0)) + value
            rows.append(row)
        speeds = solved(rows, links, {known: Fraction(1)})
        return speeds[asked]

    (solution,) = case["solutions"]
    assert ratio(False) / ratio(True) in (Fraction(solution["efficiency"]), 1 / Fraction(solution["efficiency"]))


teeth = st.integers(12, 90)
shares = st.integers(80, 99).map(lambda percent: Fraction(percent, 100))


def efficiency(rest: str, numbers: tuple[int, int, int, int], e: Fraction, f: Fraction, load_at: str, at: str) -> Any:
    s, p, q, r = numbers
    return load(SET.format(s=s, p=p, q=q, r=r, e=e, f=f, rest=rest)).driven(load_at, at)


@given(st.tuples(teeth, teeth, teeth, teeth), shares, shares)
def test_a_compound_set_has_the_efficiency_of_its_closed_form(
    numbers: tuple[int, int, int, int], e: Fraction, f: Fraction
) -> None:
    s, p, q, r = numbers
    ratio, eta = Fraction(p * r, s * q), e * f  # basic ratio above 0: two external meshes
    if ratio == 1:
        return
    rest = "fixed: [ring]\ninputs: {sun: 1}"
    forward = efficiency(rest, numbers, e, f, "arm", "sun")
    back = efficiency(rest.replace("sun: 1", "arm: 1"), numbers, e, f, "sun", "arm")
    if ratio > 1:
        # sun to arm: (i e - 1)/(i - 1), locked where i e <= 1; arm to sun: (i - 1)/(i/e - 1)
        assert (forward.verdict.kind == "self-locking") == (ratio * eta <= 1)
        if forward.verdict:
            assert forward.efficiency == (ratio * eta - 1) / (ratio - 1)
        assert back.efficiency == (ratio - 1) / (ratio / eta - 1)
    else:
        # arm to sun: (1 - i)/(1 - e i); sun to arm: (1 - i/e)/(1 - i), locked where i >= e
        assert (forward.verdict.kind == "self-locking") == (ratio >= eta)
        if forward.verdict:
            assert forward.efficiency == (1 - ratio / eta) / (1 - ratio)
        assert back.efficiency == (1 - ratio) / (1 - eta * ratio)


@pytest.mark.parametrize("name", [name for name in shipped() if not load(name).states])
def test_without_losses_powers_sum_to_zero_exactly(name: str) -> None:
    train = load(name)
    case = train.declaration.case(None)
    if len(case.inputs) != 1:
        pytest.skip("several inputs")
    (source,) = case.inputs
    answer = train.solve()
    plain = {gear.name for gear in train.declaration.gears if gear.efficiency is None}
    assert plain
    for output in list(case.outputs)[:4]:
        link = answer.outputs[output].of
        if link == source or not answer.speeds[link]:
            continue
        found = train.driven(link, source)
        if train.meshes:
            assert sum(found.powers.values()) == found.loss > 0
            continue
        assert sum(found.powers.values()) == 0
        assert found.efficiency == 1
        # torque ratio is the inverse speed ratio
        assert found.external[source] * answer.speeds[source] == 1


def test_real_teeth_lose_what_their_laws_say() -> None:
    train = load("sorge-pairs")
    for mesh in train.meshes:
        found = train.driven(f"fig{mesh.name}", "crank")
        assert float(found.efficiency) == pytest.approx(mesh.law.efficiency_mean(), rel=1e-14)
        assert found.pairs[mesh.name].driver == mesh.driver
        back = train.driven("crank", f"fig{mesh.name}")
        assert float(back.efficiency) == pytest.approx(mesh.reversed.efficiency_mean(), rel=1e-14)


def test_equal_planets_share_alike() -> None:
    train = load("three-planets")
    (source,) = train.declaration.inputs
    load_at = next(link for link in train.declaration.links if link not in (source, "frame") and "carrier" in link)
    found = train.driven(load_at, source)
    assert found.verdict.kind == "determined"
    suns = [pair for pair in found.pairs.values() if source in pair.links[:2]]
    assert len(suns) == 3
    assert len({pair.torques for pair in suns}) == 1


LOADED = SET.format(s=24, p=18, q=18, r=60, e=1, f=1, rest="fixed: [ring]\ninputs: {sun: 3}\nloads: {arm: 10 N m}")


def test_a_load_decides_the_torque_of_the_input() -> None:
    found = load(LOADED).torques()
    assert found.verdict.kind == "determined"
    assert found.asked == ("sun",)
    assert sum(found.powers.values()) == 0
    # three external torques about one axis: sun, arm and the brake of the ring balance
    assert sum(found.external.values()) == 0


def test_bearings_take_their_torque_times_their_speed() -> None:
    text = LOADED.replace("arm: {}", "arm: {bearing: 1 N m}")
    free, rubbing = load(LOADED).torques(), load(text).torques()
    arm = abs(rubbing.speeds["arm"])
    assert rubbing.loss == rubbing.bearing_loss == arm
    assert sum(rubbing.powers.values()) == arm
    assert rubbing.power_in == free.power_in + arm


def test_an_input_with_a_load_needs_a_name_for_what_is_unknown() -> None:
    text = LOADED.replace("loads: {arm: 10 N m}", "loads: {sun: 10 N m}\noutputs: {arm: {}, planet: {}}")
    found = load(text).torques()
    assert found.verdict.kind == "undecided"
    assert found.verdict.candidates == ("arm", "planet")
    named = load(text + "solve_for: arm\n").torques()
    assert named.verdict.kind == "determined"
    assert named.external["arm"] * named.speeds["arm"] == -named.external["sun"] * named.speeds["sun"]


def test_a_worm_that_cannot_be_driven_back_says_so() -> None:
    train = load("extends: worm\ngears: [{pair: [w, g], efficiency: {forward: 0.5, backward: -0.1}}]\n".replace(
        "[w, g]", str(list(load("worm").declaration.gears[0].pair)).replace("'", "")
    ))  # fmt: skip
    assert train.driven("wheel", "screw").efficiency == Fraction(1, 2)
    assert train.driven("screw", "wheel").verdict.kind == "self-locking"


def test_a_pair_may_lose_more_on_the_way_back() -> None:
    text = LOADED.replace("[s, p], efficiency: 1", "[s, p], efficiency: {forward: 0.9, backward: 0.7}")
    text = text.replace("fixed: [ring]\ninputs: {sun: 3}", "fixed: [arm]\ninputs: {sun: 3}")
    train = load(text.replace("loads: {arm: 10 N m}", ""))
    for way, efficiency in (
        (train.driven("ring", "sun"), Fraction(9, 10)),
        (train.driven("sun", "ring"), Fraction(7, 10)),
    ):
        assert way.efficiency == efficiency
        assert sum(way.powers.values()) == way.loss == way.power_in - 1


def test_the_command_prints_keys_and_verdicts(tmp_path: Path) -> None:
    path = tmp_path / "t.yaml"
    path.write_text(LOADED, encoding="utf-8")
    data = json.loads(call("torques", path, "--json").output)
    assert set(data) == {
        "state", "verdict", "efficiency", "circulating", "links", "pairs", "power_in", "loss", "drives",
    }  # fmt: skip
    assert data["links"]["sun"]["asked"] is True
    assert set(data["pairs"]["s~p"]) == {"driver", "torques", "power", "loss", "shared"}
    assert data["efficiency"] == 1.0
    assert call("torques", path).exit_code == 0
    path.write_text(LOADED.replace("{arm: 10 N m}", "{sun: 10 N m}"), encoding="utf-8")
    assert call("torques", path).exit_code == 1
    assert call("torques", "worm").exit_code == 0


def test_a_gearbox_has_its_published_efficiencies() -> None:
    # ZF 8HP70 with a basic efficiency of 0.98 for each set, 0.9899 a mesh: cases of the same name above
    train = load("zf-8hp70")
    for state in train.states:
        (source,) = train.declaration.case(state).inputs
        found = train.driven("OUT", source, state)
        assert found.verdict
        assert found.efficiency == 1
