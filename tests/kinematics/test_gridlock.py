"""Why meshes lock a train, and which to disengage: against known tables, enumeration and dense elimination."""

from __future__ import annotations

import itertools
import random
from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

import networkx as nx
import pytest
from commands import call, imported_by
from hypothesis import given
from hypothesis import strategies as st
from reference_solver import echelon, willis_rows
from strategies import trains
from test_cases import KINEMATIC, REJECT, declaration

from geartrain import GearTrain, load
from geartrain.kinematics.gridlock.removal import MeshRemoval
from geartrain.spherical import Configuration, from_polyhedron, solid_names, survey

Data = dict[str, Any]


def ordinary(teeth: Sequence[int], meshes: Iterable[tuple[int, int]], rings: Iterable[int] = ()) -> Data:
    """Gears on fixed axes, one wheel each."""
    count = len(teeth)
    links: Data = {
        f"g{at}": {"wheels": {f"w{at}": {"teeth": z, "internal": at in rings}}} for at, z in enumerate(teeth)
    }
    return {
        "links": {"frame": {}, **links},
        "revolutes": [{"pair": ["frame", f"g{at}"], "axis": f"A{at}"} for at in range(count)],
        "gears": [{"id": f"{i}-{j}", "pair": [f"w{i}", f"w{j}"]} for i, j in meshes],
        "inputs": {"g0": 1},
    }


def less(data: Data, gone: Iterable[str]) -> Data:
    out = set(gone)
    return {**data, "gears": [gear for gear in data["gears"] if gear["id"] not in out]}


def proved(release: MeshRemoval, firm: Iterable[str] = ()) -> int:
    """The bound of its proofs, after counting how often each mesh is in a loop of each."""
    for proof in release.proofs:
        times = [pair for loop in proof.loops for pair in loop.pairs if pair not in firm]
        assert all(times.count(pair) <= proof.sharing for pair in times)
        assert all(not loop.closes for loop in proof.loops)
    return sum(proof.at_least for proof in release.proofs)


OTHERS = ("J37", "rhombic dodecahedron", "pentagonal hexecontahedron", "5-bipyramid", "8-bipyramid", "6-antiprism")


@pytest.mark.parametrize("name", [*solid_names()[:18], *OTHERS])
def test_gears_on_all_faces_need_the_minimum_disengaging_of_the_survey(name: str) -> None:
    solid, (row,) = from_polyhedron(name), survey([name])
    train = GearTrain.declare(data := on_faces(solid))
    assert train.mobility.by_rank == (1 if row.drop == 0 else 0)
    found = train.kinematics.gridlock
    assert found.moves == (row.drop == 0)
    if found.release is not None:
        assert len(found.release.meshes) == row.drop
        assert found.release.minimum
        assert GearTrain.declare(less(data, found.release.meshes)).solve().verdict


def on_faces(solid: Configuration) -> Data:
    """The gears of a solid on fixed axes, with teeth in proportion to the edges of their faces."""
    return ordinary([6 + 2 * int(kind.rstrip("abc")) for kind in solid.kinds], solid.meshes)


def test_the_thirty_meshes_of_a_truncated_icosahedron_are_proved_by_loops() -> None:
    solid = from_polyhedron("truncated icosahedron")
    data = on_faces(solid)
    release = GearTrain.declare(data).kinematics.gridlock.release
    assert release.method == "search"
    assert proved(release) == 30
    hexagons = [f"{i}-{j}" for i, j in solid.meshes if solid.kinds[i] == solid.kinds[j] == "6"]
    assert len(hexagons) == 30
    assert GearTrain.declare(less(data, hexagons)).solve().verdict
    assert [(len(proof.loops), proof.sharing) for proof in release.proofs] == [(60, 2)]
    told = str(release)
    assert all(number in told for number in ("30", "60")), "how many meshes, and how many loops prove it"
    assert sum(mesh in told.replace(",", " ").replace(";", " ").split() for mesh in release.meshes) == 12


@pytest.mark.parametrize("case", [KINEMATIC["K45"], REJECT["R13"]], ids=["K45", "R13"])
def test_of_three_wheels_in_a_ring_any_one_mesh_frees(case: Data) -> None:
    data = declaration(case)
    found = GearTrain.declare(data).kinematics.gridlock
    (jam,) = found.jams
    assert (set(jam.loop.links), jam.loop.product, jam.by) == ({"a", "b", "c"}, -1, "sign")
    assert set(found.release.choices) == {"G0", "G1", "G2"}
    assert len(found.release.meshes) == 1
    for mesh in found.release.choices:
        assert GearTrain.declare({**less(data, [mesh]), "inputs": {"a": 1}}).solve().verdict.kind != "locked"


def test_of_two_parallel_meshes_of_different_ratio_either_frees() -> None:
    found = GearTrain.declare(declaration(KINEMATIC["K46"])).kinematics.gridlock
    (jam,) = found.jams
    assert jam.by == "ratio"
    assert jam.loop.product in (Fraction(20, 21), Fraction(21, 20))
    assert set(found.release.choices) == set(jam.loop.pairs)
    assert len(jam.loop.pairs) == 2
    assert str(jam.loop.product) in str(jam)


@pytest.mark.parametrize("name", [name for name, case in KINEMATIC.items() if case["mobility"] > 0])
def test_a_train_that_moves_has_nothing_to_disengage(name: str) -> None:
    assert GearTrain.declare(declaration(KINEMATIC[name])).kinematics.gridlock.moves


def lattice(k: int, diagonals: Iterable[tuple[int, int]] = (), seed: int = 5) -> Data:
    draw = random.Random(seed)
    right = [(at, at + 1) for at in range(k * k) if (at + 1) % k]
    down = [(at, at + k) for at in range(k * (k - 1))]
    crossing = [(r * k + c, (r + 1) * k + c + 1) for r, c in diagonals]
    return ordinary([draw.randint(17, 99) for _ in range(k * k)], [*right, *down, *crossing])


@pytest.mark.parametrize("k", [3, 10, 40, pytest.param(100, marks=pytest.mark.long)])
def test_a_lattice_moves_and_one_diagonal_more_is_the_one_mesh_to_take_out(k: int) -> None:
    train = GearTrain.declare(lattice(k))
    assert train.kinematics.gridlock.moves
    assert train.mobility.redundant == (k - 1) ** 2
    found = GearTrain.declare(lattice(k, [(0, 0)])).kinematics.gridlock
    (jam,) = found.jams
    assert len(jam.loop.links) == 3
    assert f"0-{k + 1}" in jam.loop.pairs
    assert found.release.meshes == (f"0-{k + 1}",)
    assert found.release.choices == (f"0-{k + 1}",)


def test_each_diagonal_of_a_lattice_costs_one_mesh() -> None:
    data = lattice(30, [(3, 4), (3, 20), (17, 9), (28, 28)])
    found = GearTrain.declare(data).kinematics.gridlock
    assert found.release.minimum
    assert proved(found.release) == 4
    assert set(found.release.meshes) == {gear["id"] for gear in data["gears"][-4:]}
    assert found.release.method == "loops"


def test_a_ring_in_a_loop_of_three_lets_it_turn_and_in_a_loop_of_four_locks_it() -> None:
    three = ordinary([60, 20, 20], [(0, 1), (1, 2), (2, 0)], rings=[0])
    one_ring = {**three, "gears": three["gears"][:2]}
    one_ring["links"]["g0"]["wheels"]["x0"] = 60
    one_ring["gears"].append({"id": "2-0", "pair": ["w2", "x0"]})
    assert GearTrain.declare(one_ring).kinematics.gridlock.moves, "internal, external, external: two reversals"
    assert GearTrain.declare(three).kinematics.gridlock.release is not None, (
        "internal, internal, external: one reversal"
    )


PLANETARY: Data = {
    "links": {
        "frame": {},
        "sun": {"wheels": {"s": 24, "s2": 30}},
        "ring": {"wheels": {"r": {"teeth": 60, "internal": True}, "r2": 40}},
        "p": {"wheels": {"p": 18}},
        "q": {"wheels": {"q": 18}},
        "carrier": {"wheels": {"c": 50}},
    },
    "revolutes": [
        {"pair": ["frame", "sun"], "axis": "main"},
        {"pair": ["frame", "ring"], "axis": "main"},
        {"pair": ["frame", "carrier"], "axis": "main"},
        {"pair": ["carrier", "p"], "axis": "p"},
        {"pair": ["carrier", "q"], "axis": "q"},
    ],
    "gears": [
        {"id": "sp", "pair": ["s", "p"]},
        {"id": "pr", "pair": ["p", "r"]},
        {"id": "sq", "pair": ["s", "q"]},
        {"id": "qr", "pair": ["q", "r"]},
    ],
}


def test_planets_that_touch_lock_the_set_to_its_carrier_though_the_whole_turns() -> None:
    touching = {**PLANETARY, "gears": [*PLANETARY["gears"], {"id": "pq", "pair": ["p", "q"]}]}
    assert GearTrain.declare(PLANETARY).kinematics.gridlock.moves
    train = GearTrain.declare({**touching, "inputs": {"carrier": 1}})
    assert train.solve().verdict, "as one block"
    (jam,) = train.kinematics.gridlock.jams
    assert jam.carrier == "carrier"
    assert set(jam.links) == {"sun", "ring", "p", "q"}
    assert train.kinematics.gridlock.release.choices == ("pq",)


def test_brakes_inputs_and_locks_are_no_gridlock_and_are_never_taken_out() -> None:
    held = {**PLANETARY, "fixed": ["sun", "ring"], "locks": [["carrier", "sun"]], "inputs": {"carrier": 1}}
    train = GearTrain.declare(held)
    assert train.solve().verdict.kind == "locked"
    assert train.kinematics.gridlock.moves


def coupled(*wheels: tuple[str, int, str]) -> Data:
    """The planetary set with fixed-axis idlers from one of its central wheels to another."""
    data: Data = {key: dict(part) if isinstance(part, dict) else list(part) for key, part in PLANETARY.items()}
    for at, (first, teeth, second) in enumerate(wheels):
        data["links"][f"idler{at}"] = {"wheels": {f"i{at}": teeth}}
        data["revolutes"].append({"pair": ["frame", f"idler{at}"], "axis": f"idler{at}"})
        data["gears"] += [{"id": f"{first}{at}", "pair": [first, f"i{at}"]}]
        data["gears"] += [{"id": f"{second}{at}", "pair": [f"i{at}", second]}]
    return data


def test_meshes_about_two_carriers_that_hold_each_other_are_found_without_a_loop_that_fails() -> None:
    # sun, ring and carrier are all geared together, at speeds that Willis does not allow
    data = coupled(("s2", 20, "r2"), ("s2", 25, "c"))
    train = GearTrain.declare(data)
    assert train.mobility.by_rank == 0
    assert not train.mobility.locked
    found = train.kinematics.gridlock
    assert not found.moves
    assert not found.jams
    assert set(found.held) == set(data["links"]) - {"frame"}
    release = found.release
    assert (len(release.meshes), release.method) == (1, "one")
    assert set(release.choices) == {gear for gear in ("s20", "r20", "s21", "c1") if _frees(data, [gear])}
    assert all(link in str(found) for link in found.held)
    assert release.choices[0] in str(found)


def test_a_wheel_that_its_ratio_keeps_upright_is_not_held() -> None:
    assert load("freeth-2021").kinematics.gridlock.moves, "sun56 stands still while its mesh rolls"


def test_a_pin_in_a_slot_is_never_taken_out() -> None:
    data = {
        "links": {"frame": {}, "p": {"wheels": {"p": 8}}, "s": {"wheels": {"s": 8}}},
        "revolutes": [{"pair": ["frame", link], "axis": link} for link in "ps"],
        "gears": [{"id": "mesh", "pair": ["p", "s"]}],
        "couplings": [{"id": "pin", "kind": "pin_and_slot", "pin": "p", "slot": "s"}],
    }
    found = GearTrain.declare(data).kinematics.gridlock
    assert found.jams[0].meshes == 1
    assert found.release.choices == ("mesh",)


def test_a_follower_holds_nothing_but_itself() -> None:
    data = {
        "links": {"frame": {}, "p": {"wheels": {"p": 8}}, "s": {"wheels": {"s": 8}}, "t": {"wheels": {"t": 9}}},
        "revolutes": [{"pair": ["frame", link], "axis": link} for link in "pst"],
        "gears": [{"id": "mesh", "pair": ["s", "t"]}],
        "couplings": [{"id": "pin", "kind": "pin_follower", "pin": "p", "slot": "s"}],
    }
    train = GearTrain.declare(data)
    assert set(train.mobility.still) == {"s", "t"}
    assert train.kinematics.gridlock.moves


@pytest.mark.parametrize("count", [5, 6, 7])
def test_up_to_seven_mutual_wheels_are_searched(count: int) -> None:
    pairs = list(itertools.combinations(range(count), 2))
    release = GearTrain.declare(ordinary([20] * count, pairs)).kinematics.gridlock.release
    # what no two halves can keep
    assert len(release.meshes) == release.at_least == len(pairs) - (count // 2) * (count - count // 2)


def test_a_greedy_set_says_that_a_smaller_one_may_do() -> None:
    good, minimum = (MeshRemoval(("a", "b", "c"), "greedy", bound) for bound in (2, 3))
    assert (good.minimum, minimum.minimum) == (False, True)
    assert "at least 2" in str(good)
    assert "at least" not in str(minimum)
    assert all("a, b, c" in str(each) for each in (good, minimum))


def _frees(data: Data, gone: Iterable[str]) -> bool:
    """Every loop about each carrier closes, and no link stands still both with these ratios and with others."""
    rest = less(data, gone)
    rest = {**rest, "couplings": [one for one in rest.get("couplings", ()) if one["kind"] != "pin_follower"]}
    rows, carriers = willis_rows(rest)
    relative = [
        (carrier, {link: value for link, value in row.items() if link != carrier})
        for carrier, row in zip(carriers.values(), rows, strict=True)
    ]
    nodes = sorted({(carrier, link) for carrier, row in relative for link in row})
    graph = nx.Graph()
    graph.add_edges_from([(carrier, link) for link in row] for carrier, row in relative)
    matrix = [
        [row.get(link, Fraction(0)) if where == carrier else Fraction(0) for where, link in nodes]
        for carrier, row in relative
    ]
    if len(echelon(matrix, len(nodes))) != len(nodes) - nx.number_connected_components(graph):
        return False
    draw = random.Random(1)
    others = {node: draw.randint(1000, 9999) for node in nodes}
    varied = [
        (carrier, {link: value / others[carrier, link] for link, value in row.items()}) for carrier, row in relative
    ]
    return not _still(rest, relative) & _still(rest, varied)


def _still(data: Data, relative: list[tuple[str, dict[str, Fraction]]]) -> set[str]:
    """Links whose speed is 0 in every motion, from rows in speeds relative to a carrier."""
    links = [link for link in data["links"] if link != "frame"]
    matrix = [
        [row.get(link, Fraction(0)) - (sum(row.values()) if link == carrier else 0) for link in links]
        for carrier, row in relative
    ]
    pivots = echelon(matrix, len(links))
    free = [at for at in range(len(links)) if at not in pivots]
    return {links[pivot] for top, pivot in enumerate(pivots) if not any(matrix[top][at] for at in free)}


@st.composite
def fixed_axis_trains(draw: st.DrawFn) -> Data:
    """Seven gears with up to twelve meshes, parallel ones among them; each mesh has wheels of its own."""
    data, end = ordinary([20] * 7, ()), st.integers(0, 6)
    ends = draw(st.lists(st.tuples(end, end).filter(lambda pair: pair[0] != pair[1]), min_size=2, max_size=12))
    for mesh, pair in enumerate(ends):
        for side, link in zip("ij", pair, strict=True):
            ring = side == "j" and draw(st.booleans())
            wheel = {"teeth": draw(st.sampled_from((20, 20, 20, 30))), "internal": ring}
            data["links"][f"g{link}"]["wheels"][f"{side}{mesh}"] = wheel
        data["gears"].append({"id": f"m{mesh}", "pair": [f"i{mesh}", f"j{mesh}"]})
    return data


@pytest.mark.parametrize("rounds", [None, 1])
@given(data=st.one_of(trains(most=7, pairs=8), fixed_axis_trains()))
def test_what_random_trains_disengage_is_what_trying_all_sets_finds(rounds: int | None, data: Data) -> None:
    """Without enough rounds for a proof the set is minimal, and the bound of its size is valid."""
    with pytest.MonkeyPatch.context() as patch:
        if rounds is not None:
            patch.setattr("geartrain.kinematics.gridlock.locked_subgraphs._ROUNDS", rounds)
        found = GearTrain.declare(data).kinematics.gridlock
    names = [gear["id"] for gear in data["gears"]]
    sets = (some for size in range(len(names) + 1) for some in itertools.combinations(names, size))
    minimum = next((some for some in sets if _frees(data, some)), None)
    assert found.moves == (minimum == ())
    release = found.release
    if release is None:
        assert found.moves or minimum is None
        return
    assert minimum is not None
    assert _frees(data, release.meshes)
    assert not any(_frees(data, set(release.meshes) - {mesh}) for mesh in release.meshes)
    assert release.at_least <= len(minimum) <= len(release.meshes)
    if rounds is None:
        assert release.minimum
        assert len(release.meshes) == len(minimum)
    if release.method == "one" and len(release.meshes) == 1:
        assert set(release.choices) == {name for name in names if _frees(data, [name])}
    pins = [coupling["id"] for coupling in data["couplings"]] if "couplings" in data else []
    assert proved(release, pins) <= len(release.meshes)
    for jam in found.jams:
        assert jam.loop.product != 1
        links = [link for link in jam.loop.links if link != jam.carrier]
        assert len(set(links)) == len(jam.loop.links) == len(jam.loop.pairs)


def test_a_loop_that_locks_what_is_held_already_does_not_upset_the_mobility() -> None:
    links = {
        "frame": {"wheels": {"f": 8}},
        "a": {"wheels": {"a": 8}},
        "b": {"wheels": {"b": 8}},
        "c": {"wheels": {"c": 8}},
    }
    data = {
        "links": links,
        "revolutes": [
            {"pair": ["frame", "a"], "axis": "A"},
            {"pair": ["frame", "b"], "axis": "B"},
            {"pair": ["a", "c"], "axis": "C"},
        ],
        "gears": [{"id": "ab", "pair": ["a", "b"]}, {"id": "fc", "pair": ["f", "c"]}],
        "couplings": [
            {"id": "pin", "kind": "pin_and_slot", "pin": "a", "slot": "b"},
            {"id": "follower", "kind": "pin_follower", "pin": "frame", "slot": "c"},
            {"id": "pin2", "kind": "pin_and_slot", "pin": "frame", "slot": "c"},
        ],
    }
    train = GearTrain.declare(data)
    assert train.mobility.by_rank == 0
    assert train.mobility.shared == ()
    assert set(train.kinematics.gridlock.release.meshes) == {"ab", "fc"}


THREE = """
links:
  frame: {}
  a: {wheels: {a20: 20}}
  b: {wheels: {b30: 30}}
  c: {wheels: {c40: 40}}
revolutes: {A: [frame, a], B: [frame, b], C: [frame, c]}
gears: [{pair: [a20, b30]}, {pair: [b30, c40]}, {pair: [c40, a20]}]
inputs: {a: 1}
"""


def test_check_and_report_say_what_to_disengage(train_file: Callable[..., Path]) -> None:
    path = train_file(THREE)
    done = call("check", path)
    out = done.stdout
    assert done.exit_code == 1
    (locked,) = (line for line in out.splitlines() if "gridlock:" in line)
    assert all(said in locked for said in ("a - b - c", "a20~b30, b30~c40, c40~a20", "ratio product -1"))
    assert "disengage one of a20~b30, b30~c40, c40~a20" in out
    done = call("report", path)
    assert done.exit_code == 1
    assert "disengage one of a20~b30, b30~c40, c40~a20" in done.stdout


@pytest.mark.parametrize("source", ["'pennestri-2002'", "'freeth-2021'", repr(THREE)])
def test_neither_a_train_that_moves_nor_a_small_gridlock_needs_networkx(source: str) -> None:
    used = imported_by(f"import geartrain; geartrain.load({source}).kinematics.gridlock")
    assert not used & {"networkx", "numpy", "scipy"}
