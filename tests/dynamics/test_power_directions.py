"""Directions of power: all patterns by brute force, exact cases, long trains by closed forms."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Sequence
from fractions import Fraction
from itertools import product
from typing import Any, NamedTuple

import pytest
from hypothesis import event, given, reject, settings
from hypothesis import strategies as st
from places import DATA
from reference_solver import echelon

from geartrain import load
from geartrain.dynamics.torques import LoadedPair, TorqueBalance, find_flow_patterns

ZERO, ONE = Fraction(0), Fraction(1)
CASES = json.loads((DATA / "cases.json").read_text(encoding="utf-8"))["efficiency"]


def eliminated(matrix: list[list[Fraction]]) -> tuple[list[Fraction] | None, bool]:
    """The solution of a dense system, right side in the last column, and whether it is the only one."""
    width = len(matrix[0]) - 1
    pivots = echelon(matrix, width)
    if any(row[-1] for row in matrix[len(pivots) :]):
        return None, False
    solution = [ZERO] * width
    for row, column in zip(matrix, pivots, strict=False):
        solution[column] = row[-1]
    return solution, len(pivots) == width


def on_links(mesh: LoadedPair, side: int) -> dict[str, Fraction]:
    """Torques of a mesh by link for a multiplier of 1, from the loss of one wheel's torque."""
    first, second = Fraction(mesh.a), Fraction(mesh.b)
    if side > 0:
        second *= mesh.forward
    elif side < 0:
        first *= mesh.backward
    found: dict[str, Fraction] = {}
    for link, sense, torque in zip(mesh.links, mesh.senses, (first, second, -first - second), strict=True):
        found[link] = found.get(link, ZERO) + sense * torque
    return found


class OpenError(Exception):
    """Some pattern leaves a torque open: no example."""


def by_force(balance: TorqueBalance) -> set[tuple[Fraction, ...]]:
    """Torques of meshes and outside under every pattern that agrees with itself."""
    ways = [(1, -1) if mesh.rolling and (mesh.forward, mesh.backward) != (1, 1) else (0,) for mesh in balance.meshes]
    found = set()
    for sides in product(*ways):
        columns = [on_links(mesh, side) for mesh, side in zip(balance.meshes, sides, strict=True)]
        columns += [{link: ONE} for link in (*balance.unknown, *balance.held)]
        rows = [
            [*(column.get(link, ZERO) for column in columns), -balance.known.get(link, ZERO)] for link in balance.links
        ]
        solution, only = eliminated(rows)
        if solution is None:
            continue
        if not only:
            raise OpenError
        powers = [-x * mesh.rolling for x, mesh in zip(solution, balance.meshes, strict=False)]
        shares = [m.forward if side > 0 else m.backward for m, side in zip(balance.meshes, sides, strict=True)]
        if all(power * side >= 0 for power, side in zip(powers, sides, strict=True)) and not any(
            power and side and share <= 0 for power, side, share in zip(powers, sides, shares, strict=True)
        ):
            found.add(tuple(solution))
    return found


def by_blocks(balance: TorqueBalance) -> set[tuple[Fraction, ...]]:
    flows, complete = find_flow_patterns(balance)
    assert complete
    found = {(*f.solved.multipliers.values(), *f.solved.external.values(), *f.solved.brakes.values()) for f in flows}
    assert len(found) == len(flows)
    for flow in flows:
        for mesh in balance.meshes:
            assert mesh.power(flow.solved.multipliers[mesh.id]) * flow.pattern.get(mesh.id, 0) >= 0
    return found


counts = st.integers(10, 60)
losses = st.sampled_from([ONE, *(Fraction(n, 10) for n in (-1, 0, 3, 5, 7, 9)), Fraction(97, 100)])
torques = st.integers(-9, 9).filter(bool).map(Fraction)


@st.composite
def balances(draw: st.DrawFn) -> TorqueBalance:
    """Any meshes between any links, with powers of any sense: far worse than trains."""
    links = tuple("abcde"[: draw(st.integers(2, 5))])
    meshes = []
    for at in range(draw(st.integers(1, len(links)))):
        i, j, k = draw(st.permutations([*links, "frame"]))[:3]
        sign, rolling = draw(st.sampled_from([1, -1])), draw(st.sampled_from([-2, -1, 0, 1, 3]))
        meshes.append(
            LoadedPair(f"m{at}", (i, j, k), (1, draw(st.sampled_from([1, -1])), 1), draw(counts), sign * draw(counts),
                 Fraction(rolling), draw(losses), draw(losses))
        )  # fmt: skip
    outside = draw(st.permutations(links))[: len(links) - len(meshes)]
    cut = draw(st.integers(0, len(outside)))
    known = draw(st.dictionaries(st.sampled_from(links), torques, min_size=1, max_size=2))
    return TorqueBalance(links, tuple(meshes), known, tuple(outside[:cut]), tuple(outside[cut:]))


@settings(max_examples=300)
@given(balances())
def test_blocks_find_what_a_trial_of_all_patterns_finds(balance: TorqueBalance) -> None:
    try:
        wanted = by_force(balance)
    except OpenError:
        reject()
    event(f"{len(wanted)} flows")
    assert by_blocks(balance) == wanted


class Stage(NamedTuple):
    """One stage from shaft to shaft: a pair, or a compound set whose ring is held or turned by another pair."""

    kind: str
    turned: bool
    teeth: tuple[int, int, int, int, int, int]
    losses: tuple[Fraction, Fraction, Fraction]


def joined(parts: Sequence[Stage]) -> tuple[list[str], list[tuple[str, str, str, int, int, Fraction]], list[str]]:
    """Links, meshes (i, j, carrier, a, b, efficiency) and links held, shafts s0, s1 ... in their order."""
    links, meshes, held = ["s0"], [], []
    for at, stage in enumerate(parts):
        first, last, ring, planet = f"s{at}", f"s{at + 1}", f"r{at}", f"p{at}"
        links.append(last)
        s, p, q, r, u, v = stage.teeth
        if stage.kind == "pair":
            meshes.append((first, last, "frame", u, v, stage.losses[0]))
            continue
        links += [ring, planet]
        sun, arm = (last, first) if stage.turned else (first, last)
        meshes += [(sun, planet, arm, s, p, stage.losses[0]), (planet, ring, arm, q, r, stage.losses[1])]
        if stage.kind == "set":
            held.append(ring)
        else:
            meshes.append((first, ring, "frame", u, v, stage.losses[2]))
    return links, meshes, held


LOCKING = Stage("set", False, (30, 29, 30, 32, 1, 1), (Fraction(9, 10), Fraction(9, 10), ONE))
PLAIN = Stage("pair", False, (1, 1, 1, 1, 23, 41), (Fraction(19, 20), ONE, ONE))


def long_train(parts: Sequence[Stage], loaded: str, requested: str, power: int) -> TorqueBalance:
    """Speeds stage by stage; a set has the speed ratio arm/sun of 1/(1 - i0), i0 its basic ratio."""
    links, meshes, held = joined(parts)
    speeds = {"frame": ZERO, "s0": ONE}
    for at, stage in enumerate(parts):
        s, p, q, r, u, v = stage.teeth
        if stage.kind == "pair":
            speeds[f"s{at + 1}"] = -speeds[f"s{at}"] * u / v
        else:
            # ring at rest: (w_sun - w_arm) = (p r)/(s q) (0 - w_arm)
            speeds[f"r{at}"] = ZERO
            speeds[f"s{at + 1}"] = speeds[f"s{at}"] / (1 - Fraction(p * r, s * q))
            speeds[f"p{at}"] = speeds[f"s{at + 1}"] * (1 + Fraction(r, q))
    return TorqueBalance(
        tuple(links),
        tuple(
            LoadedPair(str(at), (i, j, k), (1, 1, 1), a, b, a * (speeds[i] - speeds[k]), eta, eta)
            for at, (i, j, k, a, b, eta) in enumerate(meshes)
        ),
        {loaded: power / speeds[loaded]},
        (requested,),
        tuple(held),
    )


@pytest.mark.parametrize("size", [1, 20, 1500])
def test_a_chain_of_any_length_multiplies_its_efficiencies(size: int) -> None:
    parts = [PLAIN._replace(teeth=(1, 1, 1, 1, 20 + at % 7, 31 + at % 11)) for at in range(size)]
    flows, complete = find_flow_patterns(long_train(parts, f"s{size}", "s0", -1))
    assert complete
    (flow,) = flows
    assert flow.solved.external["s0"] == 1 / Fraction(19, 20) ** size
    assert set(flow.pattern.values()) == {1}
    flows, complete = find_flow_patterns(long_train(parts, "s0", f"s{size}", -1))
    assert complete
    assert set(flows[0].pattern.values()) == {-1}


@pytest.mark.parametrize("where", [0, 30, 60])
def test_one_set_decides_whether_a_long_train_locks(where: int) -> None:
    parts = [PLAIN] * where + [LOCKING] + [PLAIN] * (60 - where)
    # i0 = (29*32)/(30*30) and e = 0.81: the sun cannot drive the arm, for i0 e < 1; the arm drives with (i0-1)/(i0/e-1)
    forward, complete = find_flow_patterns(long_train(parts, "s61", "s0", -1))
    assert (forward, complete) == ((), True)
    ratio, eta = Fraction(29 * 32, 30 * 30), Fraction(81, 100)
    back, complete = find_flow_patterns(long_train(parts, "s0", "s61", -1))
    assert complete
    (flow,) = back
    speed = long_train(parts, "s61", "s0", 1).known["s61"]  # 1/w
    assert flow.solved.external["s61"] / speed == 1 / ((ratio - 1) / (ratio / eta - 1) * Fraction(19, 20) ** 60)


def test_a_long_train_has_both_flows_where_its_set_has_two() -> None:
    parts = [PLAIN] * 20 + [LOCKING] + [PLAIN] * 20
    flows, complete = find_flow_patterns(long_train(parts, "s41", "s0", 1))
    assert complete
    taken = sorted(flow.solved.external["s0"] for flow in flows)
    assert len(taken) == 2
    # the arm drives: what arrives leaves at s0; or s0 drives as well, and all is lost
    ratio, eta, pair = Fraction(29 * 32, 30 * 30), Fraction(81, 100), Fraction(19, 20) ** 20
    assert taken[0] == -((ratio - 1) / (ratio / eta - 1)) * pair * pair
    assert taken[1] == -((ratio - 1) / (ratio * eta - 1)) * pair / pair > 0


def test_of_two_locking_sets_the_first_has_two_flows_for_one_of_the_second() -> None:
    # where the second hands power on, the first has two answers; where it must be driven too, the first has none
    balance = long_train([LOCKING, PLAIN, LOCKING], "s3", "s0", 1)
    found = by_blocks(balance)
    assert len(found) == 2
    assert found == by_force(balance)


def test_what_hangs_on_two_equal_pairs_between_two_links_is_left_open() -> None:
    # as many unknowns as rows, and yet any share of the two pairs balances
    balance = TorqueBalance(
        ("a", "b", "c", "d"),
        (
            LoadedPair("near", ("a", "b", "d"), (1, 1, 1), 20, 30, ONE),
            LoadedPair("far", ("a", "b", "frame"), (1, 1, 1), 20, 30, ONE),
            LoadedPair("next", ("b", "c", "frame"), (1, 1, 1), 10, 50, ONE, Fraction(9, 10), Fraction(9, 10)),
        ),
        # b drives c, which gets 0.9 * 50 for 10 on b; two thirds of these act on a
        {"c": Fraction(45), "a": Fraction(-20, 30) * 10},
        ("d",),
    )
    (flow,), complete = find_flow_patterns(balance)
    assert complete
    assert flow.solved.multipliers["next"] == -1
    assert (flow.solved.loose, flow.solved.open) == (("near", "far"), ("d",))
    assert "d" not in flow.solved.external
    heavier = TorqueBalance(balance.links, balance.meshes, {**balance.known, "a": ONE}, balance.unknown)
    assert find_flow_patterns(heavier) == ((), True)


def test_directions_of_trains_with_few_losses_a_block_bring_no_array_library() -> None:
    code = "import sys, geartrain; t = geartrain.load('norton-compound'); t.torques(); t.driven('arm', 'F'); "
    code += "geartrain.load('zf-8hp70').driven('OUT', 'IN', '4'); print({'numpy', 'scipy'} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=120)
    assert done.stdout.strip() == "set()"


def ring(size: int, losing: int) -> TorqueBalance:
    """Links each of which hangs on the next two: one block, with as many meshes as links."""
    links = tuple(f"l{at}" for at in range(size))
    meshes = tuple(
        LoadedPair(f"m{at}", (links[at], links[(at + 1) % size], links[(at + 2) % size]), (1, 1, 1), 20 + at, 37,
             Fraction(1 if at % 2 else -1), *[Fraction(9, 10) if at < losing else ONE] * 2)
        for at in range(size)
    )  # fmt: skip
    return TorqueBalance(links, meshes, {"l0": ONE}, ())


def test_a_large_block_of_some_losses_agrees() -> None:
    balance = ring(9, 7)
    assert by_blocks(balance) == by_force(balance)


def test_a_block_with_too_many_losses_is_iterated_and_says_so() -> None:
    balance = ring(19, 17)
    flows, complete = find_flow_patterns(balance)
    assert not complete
    for flow in flows:
        sums = dict(balance.known)
        for mesh in balance.meshes:
            x, side = flow.solved.multipliers[mesh.id], flow.pattern.get(mesh.id, 0)
            assert mesh.power(x) * side >= 0
            for link, torque in on_links(mesh, side).items():
                sums[link] = sums.get(link, ZERO) + x * torque
        assert not any(sums.values())


def test_what_hangs_on_an_open_share_stays_open_and_the_rest_is_certain() -> None:
    gears = ", ".join(f"{{pair: [{a}, {b}], efficiency: 0.9}}" for a, b in (("a20", "b30"), ("b30", "c40"),
                      ("c40", "d50"), ("d50", "a20"), ("e1", "f1"), ("c2", "e2")))  # fmt: skip
    train = load(f"""
extends: four-gear-loop
links: {{c: {{wheels: {{c2: 30}}}}, e: {{wheels: {{e1: 20, e2: 60}}}}, f: {{wheels: {{f1: 70}}}}}}
revolutes: [{{pair: [plate, e], axis: e}}, {{pair: [plate, f], axis: f}}]
gears: [{gears}]
loads: {{f: -1}}
""")
    found = train.torques()
    assert found.verdict.kind == "indeterminate"
    assert set(found.verdict.candidates) == {"a20~b30", "b30~c40", "c40~d50", "d50~a20"}
    # two pairs away from the load nothing is open
    assert abs(found.pairs["c2~e2"].torques[0]) == Fraction(20, 70) * Fraction(30, 60) / Fraction(81, 100)


def fractions(given: dict[str, str]) -> dict[str, Fraction]:
    return {name: Fraction(value) for name, value in given.items()}


def balance_of(case: dict[str, Any]) -> TorqueBalance:
    speeds = fractions(case["speeds"])
    meshes = []
    for at, gear in enumerate(case["gears"]):
        i, j, k = gear["i"], gear["j"], gear["carrier"]
        a, b = gear["zi"], gear["zj"] * (1 if gear["type"] == "external" else -1)
        eta = Fraction(gear["mesh_efficiency"])
        meshes.append(LoadedPair(str(at), (i, j, k), (1, 1, 1), a, b, a * (speeds[i] - speeds[k]), eta, eta))
    return TorqueBalance(
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
    flows, complete = find_flow_patterns(balance)
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


@pytest.mark.parametrize(
    "case", [c for c in CASES if c["n_consistent_solutions"] == 1 and len(c["torque_unknown"]) == 1 and not c["locks"]],
    ids=lambda case: case["id"],
)  # fmt: skip
def test_the_efficiency_is_the_ratio_with_each_tooth_ratio_lessened_by_its_loss(case: dict[str, Any]) -> None:
    """Kreines' and Mueller's rule: the ratio of speeds with every basic ratio times eta to the sign of its flow."""
    (known,), (requested,) = case["torque_known"], case["torque_unknown"]
    balance = balance_of(case)
    plain = TorqueBalance(
        balance.links,
        tuple(LoadedPair(m.id, m.links, m.senses, m.a, m.b, m.rolling) for m in balance.meshes),
        balance.known, balance.unknown, balance.held, balance.locks,
    )  # fmt: skip
    (lossless,), _ = find_flow_patterns(plain)
    links = [link for link in case["links"] if link != case["frame"]]

    def ratio(lossy: bool) -> Fraction:
        rows: list[dict[str, Fraction]] = [{link: Fraction(1)} for link in case["fixed"]]
        for mesh in balance.meshes:
            through = mesh.power(lossless.solved.multipliers[mesh.id])
            share = mesh.forward ** ((through > 0) - (through < 0)) if lossy else Fraction(1)
            row: dict[str, Fraction] = {}
            for link, value in zip(mesh.links, (mesh.a, mesh.b * share, -mesh.a - mesh.b * share), strict=True):
                row[link] = row.get(link, ZERO) + value
            rows.append(row)
        matrix = [[*(row.get(link, ZERO) for link in links), ZERO] for row in rows]
        matrix.append([*(ONE if link == known else ZERO for link in links), ONE])
        speeds, only = eliminated(matrix)
        assert only
        return speeds[links.index(requested)]

    (solution,) = case["solutions"]
    assert ratio(False) / ratio(True) in (Fraction(solution["efficiency"]), 1 / Fraction(solution["efficiency"]))
