"""Flow of power: every shaft and pair balances exactly, loops are found, losses named, pictures true to scale."""

from __future__ import annotations

import json
from fractions import Fraction
from functools import cache
from itertools import pairwise
from math import pi
from typing import Any

import pytest
import shipped as catalogue
from hypothesis import given
from hypothesis import strategies as st
from models import torque_figures, torque_page

from geartrain import GearTrain, GearTrainError, load
from geartrain.dynamics import PowerFlow, PowerNode, Torques, find_power_flow
from geartrain.train import Train

RING = """
extends: planetary-24-18-60
gears: [{pair: [s, p], efficiency: 0.98}, {pair: [p, ring], efficiency: 0.99}]
loads: {carrier: -10 N m}
"""
CLOCK = """
extends: longcase-clock
inputs: {great: -1/12}
gears:
  - {pair: [g96, c8], efficiency: 0.96}
  - {pair: [c60, t8], efficiency: 0.95}
  - {pair: [t56, e7], efficiency: 0.94}
  - {pair: [mw6, h72], efficiency: 0.97}
links: {centre: {bearing: 2 N mm}, third: {bearing: 0.5 N mm}, hour: {bearing: 4 N mm}}
loads: {escape: -0.1 N mm}
"""
SPLIT = """
extends: prius-power-split
gears: [{pair: [s30, p23], efficiency: 0.98}, {pair: [p23, r78], efficiency: 0.99}]
states: {cruising: {loads: {MG2: -80 N m}}, boost: {inputs: {engine: 1, MG1: -1/2}, loads: {MG2: -80 N m}}}
"""
REVERSE = """
extends: zf-8hp70
states:
  R: {loads: {OUT: 300 N m}}
"""
RUBBING_PLANET = RING + "links: {planet: {bearing: 0.5 N m}, carrier: {bearing: 0.2 N m}}\n"
SHARED = """
links: {frame: {}, a: {wheels: {a1: 20, a2: 20}}, b: {wheels: {b1: 30, b2: 30}}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
gears: [{pair: [a1, b1]}, {pair: [a2, b2]}]
inputs: {a: 1}
loads: {b: 3}
"""
TRAINS = {
    "ring": RING, "clock": CLOCK, "rubbing": RUBBING_PLANET, "split": SPLIT, "reverse": REVERSE,
    "norton": "extends: norton-compound\n",
}  # fmt: skip


@cache
def flows(train: GearTrain) -> list[tuple[Torques, PowerFlow]]:
    """Under the declared loads, and driven from each end to the other."""
    figures = [torque_figures(train, state) for state in train.states or (None,)]
    torques = [found for each in figures for found in (each.torques, *(way.way.torques for way in each.drives or ()))]
    known = (each for each in torques if each.verdict and not any(pair.loose for pair in each.pairs.values()))
    return [(each, find_power_flow(each)) for each in known]


def surplus(flow: PowerFlow, node: PowerNode) -> Fraction:
    """The power into a node minus the power out of it and its loss."""
    taken = sum((stream.power for stream in flow.streams if stream.target == node), Fraction(0))
    given = sum((stream.power for stream in flow.streams if stream.source == node), Fraction(0))
    return taken - given - flow.losses.get(node, Fraction(0))


def require_balance(found: Torques, flow: PowerFlow) -> None:
    """Nothing appears or vanishes: not at a node, not in all, not of what circles."""
    assert all(0 <= stream.circling <= stream.power > 0 for stream in flow.streams)
    for node in flow.nodes:
        if node.kind not in ("in", "out"):
            assert surplus(flow, node) == 0, node
        into = sum(stream.circling for stream in flow.streams if stream.target == node)
        assert into == sum(stream.circling for stream in flow.streams if stream.source == node)
    ends = {
        kind: sum((-surplus(flow, node) for node in flow.nodes if node.kind == kind), Fraction(0))
        for kind in ("in", "out")
    }
    powers = list(found.powers.values())
    assert ends["in"] == found.power_in == flow.power_in == sum(power for power in powers if power > 0)
    assert ends["out"] == sum(power for power in powers if power < 0)
    assert flow.loss == found.loss == ends["in"] + ends["out"]
    assert all(loss > 0 for loss in flow.losses.values())
    for name, pair in found.pairs.items():
        assert flow.losses.get(PowerNode("pair", name), 0) == pair.loss
    require_no_loop([(stream.source, stream.target) for stream in flow.streams if stream.circling < stream.power])
    assert sum(loop.power for loop in flow.loops) >= max((stream.circling for stream in flow.streams), default=0)


def require_no_loop(edges: list[tuple[PowerNode, PowerNode]]) -> None:
    while edges:
        left = [(a, b) for a, b in edges if any(b == source for source, _ in edges)]
        assert len(left) < len(edges), "what does not circle leads on"
        edges = left


@cache
def lossy(name: str) -> GearTrain:
    """A shipped train, every pair of which loses and every link of which rubs, with a load on its output."""
    train = catalogue.train(name)
    declared = train.declaration
    data: dict[str, Any] = {"extends": name, "name": name}
    data["gears"] = [
        {"id": gear.name, "pair": list(gear.pair), "efficiency": f"0.9{1 + at % 9}"}
        for at, gear in enumerate(declared.gears)
    ]
    unit = torque_unit(declared)
    turning = (link for link in declared.links if link != declared.frame and link not in declared.sliding)
    data["links"] = {link: {"bearing": f"1/100{unit}"} for link in turning}
    loads = {state: load_of(train, state) for state in train.states or (None,)}
    if train.states:
        data["states"] = {state: {"loads": given} for state, given in loads.items()}
    else:
        data["loads"] = loads[None]
    return load(json.dumps(data, indent=1))


def torque_unit(declared: Train) -> str:
    """A force on a slide, or a declared load, may have a unit, and then all torques have one."""
    loads = (load for case in declared.cases for load in case.loads.values())
    return " N m" if declared.sliding or any(load.unit for load in loads) else ""


def load_of(train: GearTrain, state: str | None) -> dict[str, str]:
    drives = torque_figures(train, state).drives
    if drives is None:
        return {}
    link = drives.forward.way.load
    speed = Fraction(train.solve(state).speeds[link])
    declared = train.declaration
    unit = " N" if link in declared.sliding else torque_unit(declared)
    return {link: f"{-1 if speed > 0 else 1}{unit}"} if speed else {}


@pytest.mark.parametrize("name", catalogue.every_train())
def test_every_shaft_and_pair_of_a_shipped_train_gives_on_what_it_takes_in(name: str) -> None:
    for train in (catalogue.train(name), lossy(name)):
        for found, flow in flows(train):
            require_balance(found, flow)


def test_shipped_trains_put_the_balance_to_the_test() -> None:
    """Most of them carry power with losses of both kinds, several in loops."""
    seen = [flow for name in catalogue.KINDS for _, flow in flows(lossy(name)) if flow.streams]
    assert sum({"pair", "bearing"} == {node.kind for node in flow.losses} for flow in seen) >= 10
    assert sum(bool(flow.loops) for flow in seen) >= 5


@pytest.mark.parametrize("name", TRAINS)
def test_every_shaft_and_pair_of_a_loaded_train_gives_on_what_it_takes_in(name: str) -> None:
    found = flows(load(TRAINS[name]))
    assert any(flow.streams for _, flow in found)
    for torques, flow in found:
        require_balance(torques, flow)


@given(
    st.lists(st.integers(12, 90), min_size=4, max_size=4),
    st.lists(st.integers(80, 100), min_size=4, max_size=4),
    st.integers(-5, 5), st.integers(-5, 5),
)  # fmt: skip
def test_two_planetaries_in_any_arrangement_balance(z: list[int], eta: list[int], w: int, v: int) -> None:
    """Sun and arm driven, ring loaded, through planets with two wheels: power may enter anywhere and circle."""
    train = load(f"""
links:
  frame: {{}}
  sun: {{wheels: {{s: {z[0]}}}}}
  planet: {{wheels: {{p: {z[1]}, q: {z[2]}}}}}
  ring: {{wheels: {{r: {{teeth: {z[3] + z[2] + 1}, internal: true}}}}}}
  arm: {{bearing: 1/7}}
revolutes: {{A: [frame, sun, ring, arm], P: [arm, planet]}}
gears: [{{pair: [s, p], efficiency: {eta[0]}/100}}, {{pair: [q, r], efficiency: {eta[1]}/100}}]
inputs: {{sun: {w}, arm: {v}}}
loads: {{ring: 3}}
""")
    found = train.torques()
    if found.verdict:
        require_balance(found, find_power_flow(found))


def power(flow: PowerFlow, source: tuple[str, str], target: tuple[str, str]) -> Fraction:
    (found,) = [stream.power for stream in flow.streams if (stream.source, stream.target) == (source, target)]
    return found


def test_half_the_power_of_this_planetary_goes_by_the_planet() -> None:
    """Sun at 7, arm at 2, planet at -14/3: torques 24, -42 and 18 to one another, so powers 168, -84 and -84."""
    train = load("planetary-24-18-60")
    flow = find_power_flow(train.driven("carrier", "sun"))
    assert power(flow, ("shaft", "sun"), ("pair", "s~p")) == 1
    assert power(flow, ("pair", "s~p"), ("shaft", "planet")) == Fraction(1, 2)
    assert power(flow, ("pair", "s~p"), ("shaft", "carrier")) == Fraction(1, 2)
    assert power(flow, ("pair", "p~ring"), ("shaft", "carrier")) == Fraction(1, 2)
    assert flow.loops == ()


def test_power_circulates_in_the_compound_train_of_norton() -> None:
    train = load("norton-compound")
    found = train.torques()
    flow = find_power_flow(found)
    assert found.efficiency == Fraction(1250, 17117)
    (loop,) = flow.loops
    assert set(loop.pairs) == {"a82~b84", "c86~d82", "e82~f84"}
    assert set(loop.shafts) == {"arm", "P1", "P2"}
    # gear A is held by 1750.3064, so P1 turns its pair with 84/82 of that at 83/42
    assert found.external["A"] == Fraction("1750.3064")
    assert loop.power == found.external["A"] * Fraction(84, 82) * Fraction(83, 42)
    assert train.driven("arm", "F").verdict.kind == "self-locking"


def test_links_that_turn_together_are_one_shaft() -> None:
    train = load("extends: planetary\nloads: {carrier: -1}\n")
    flow = find_power_flow(train.torques("direct drive"))
    shaft = PowerNode("shaft", "sun + carrier")
    assert [(stream.source, stream.target) for stream in flow.streams] == [
        (PowerNode("in", "sun"), shaft),
        (shaft, PowerNode("out", "carrier")),
    ]


def test_a_bearing_on_a_carrier_takes_from_both() -> None:
    train = load(RUBBING_PLANET)
    flow = find_power_flow(train.torques())
    bearing = PowerNode("bearing", "planet")
    taken = {stream.source.name: stream.power for stream in flow.streams if stream.target == bearing}
    # planet at -2/3, carrier at 2/7, rubbing with 1/2
    assert taken == {"planet": Fraction(1, 3), "carrier": Fraction(1, 7)}
    assert flow.losses[bearing] == Fraction(1, 2) * Fraction(20, 21)


def test_two_loops_that_share_no_shaft_are_told_apart() -> None:
    """Two compound trains, the second driven by the output of the first."""
    links: dict[str, Any] = {"frame": {}}
    revolutes: list[Any] = [{"pair": ["frame", "arm"], "axis": "main"}]
    gears: list[Any] = []
    for arm, out, x in (("arm", "F", ""), ("F", "Fx", "x")):
        links |= {
            arm: links.get(arm, {}),
            f"A{x}": {"wheels": {f"a{x}": 82}},
            f"P{x}": {"wheels": {f"b{x}": 84, f"c{x}": 86}},
            f"Q{x}": {"wheels": {f"d{x}": 82, f"e{x}": 82}},
            out: {"wheels": {f"f{x}": {"teeth": 84, "internal": True}}},
        }
        revolutes += [{"pair": ["frame", link], "axis": "main"} for link in (f"A{x}", out)]
        revolutes += [{"pair": [arm, f"{planet}{x}"], "axis": f"{planet}{x}"} for planet in "PQ"]
        gears += [{"pair": [f"{one}{x}", f"{other}{x}"]} for one, other in ("ab", "cd", "ef")]
    train = load(
        {
            "links": links, "revolutes": revolutes, "gears": gears,
            "fixed": ["A", "Ax"], "inputs": {"arm": 1}, "loads": {"Fx": -1},
        }
    )  # fmt: skip
    found = train.torques()
    flow = find_power_flow(found)
    require_balance(found, flow)
    assert {loop.pairs for loop in flow.loops} == {("a~b", "c~d", "e~f"), ("ax~bx", "cx~dx", "ex~fx")}
    assert flow.loops[0].power >= flow.loops[1].power


def test_what_is_shared_in_no_certain_way_has_no_flow() -> None:
    train = load(SHARED)
    found = train.torques()
    assert found.verdict.kind == "indeterminate"
    assert find_power_flow(found).streams == ()


def test_a_bearing_that_turns_at_no_certain_speed_takes_no_part_in_the_flow() -> None:
    train = load(
        """
        links:
          frame: {}
          a: {wheels: {x: 20}, bearing: 1 N mm}
          b: {wheels: {y: 40}}
          loose: {bearing: 2 N mm}
        revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}, {pair: [frame, loose], axis: C}]
        gears: [{pair: [x, y], efficiency: 0.9}]
        inputs: {a: 1}
        loads: {b: 10 N mm}
        """
    )
    flow = find_power_flow(train.torques())
    # b turns at -1/2 and puts 5e-3 in against its load; a tenth is lost in the teeth, 1e-3 in the bearing
    assert flow.losses == {PowerNode("pair", "x~y"): Fraction(1, 1800), PowerNode("bearing", "a"): Fraction(1, 1000)}


@pytest.mark.parametrize(
    ("more", "watts"),
    [
        ("", None),
        ("rate: 10 turn/s\n", 20 * pi),
        ("rate: 600 rpm\n", 20 * pi),
        ("rate: -5 rad/s\n", 5.0),
        ("rate: 10\n", None),
        ("inputs: {sun: 600 rpm}\n", pi / 30),
        ("inputs: {sun: 4}\nrate: 10 turn/s\n", 5 * pi),
    ],
)
def test_powers_are_watts_where_torques_and_speeds_are_real(more: str, watts: float | None) -> None:
    train = load(RING + more)
    assert torque_figures(load(RING.replace(" N m", "") + more)).watts_per_unit is None
    found = torque_figures(train).watts_per_unit
    assert found == (None if watts is None else pytest.approx(watts, rel=1e-14))


def test_a_friction_torque_is_not_negative() -> None:
    with pytest.raises(GearTrainError, match="must not be negative"):
        load("extends: planetary\nlinks: {carrier: {bearing: -1 N m}}\n")


STRUCK = """
links:
  frame: {}
  first: {wheels: {a: 20}}
  second: {inertia: 4 g cm2, wheels: {b: 30, c: 24}}
  third: {inertia: 7 g cm2, wheels: {d: 40}}
revolutes: [{pair: [frame, first], axis: A}, {pair: [frame, second], axis: B}, {pair: [frame, third], axis: C}]
gears: [{pair: [a, b]}, {pair: [c, d]}]
tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}
friction: 0.1
inputs: {first: 1}
rate: 3 turn/s
loads: {third: -2 N m}
outputs: {third: {}}
"""


def page(train: GearTrain) -> str:
    return torque_page(train, *(train.torques(state) for state in train.states or (None,)))


def rows(text: str, first: str) -> list[list[str]]:
    """The table whose header begins with a word."""
    lines = text.splitlines()
    start = next(at for at, line in enumerate(lines) if line.startswith(f"| {first} "))
    table = []
    for line in lines[start:]:
        if not line.startswith("|"):
            break
        table.append([cell.strip() for cell in line.strip("|").split("|")])
    return [table[0], *table[2:]]


def test_losses_are_named_with_their_shares_and_sum_up() -> None:
    table = rows(page(load(CLOCK)), "where")
    assert table[0] == ["where", "lost", "of power in", "of all lost"]
    named = {row[0]: [float(cell.split()[0]) for cell in row[1:]] for row in table[1:]}
    single = [name for name in named if name not in ("all pairs", "all bearings", "total")]
    assert set(single) == {
        "g96~c8", "c60~t8", "t56~e7", "mw6~h72", "bearing of centre", "bearing of third", "bearing of hour"
    }  # fmt: skip
    for column in range(3):
        parts = sum(named[name][column] for name in single)
        assert named["total"][column] == pytest.approx(parts, rel=1e-3)
        assert parts == pytest.approx(named["all pairs"][column] + named["all bearings"][column], rel=1e-3)
    assert named["total"][2] == 100


def test_the_torque_needed_at_the_crank_is_said_where_bearings_rub() -> None:
    train = load(CLOCK)
    torque = float(train.torques().external["great"])
    assert f"Torque needed, with the friction of bearings: at 'great' {torque:.6g} N m." in page(train)
    assert "Torque needed" not in page(load(RING))


def test_the_loop_is_named_with_what_circulates() -> None:
    text = page(load("norton-compound"))
    assert "3543.3 circulates, 258.8 times the power in: through pairs a82~b84, c86~d82, e82~f84 and shafts " in text
    assert "circulates" not in page(load("extends: planetary\nloads: {carrier: -1}\n"))


def test_collisions_stand_beside_sliding() -> None:
    """Two pairs in a row: each blow strikes all that turns with the driven wheel."""
    train = load(STRUCK)
    table = rows(page(train), "where")
    assert table[0] == ["where", "sliding", "of power in", "of all sliding", "impact", "of power in"]
    transmission = train.meshes[0].transmission
    lost = sum(leap.size**2 / 2 for leap in transmission.speed_leaps())
    energy = lost * (4 + 7 * (24 / 40) ** 2) * 1e-7 * (2 * pi * 3) ** 2
    data = torque_figures(train).to_dict()["losses"]
    assert data[0]["impact"] == pytest.approx(energy * 3 * 20, rel=1e-12)
    assert {loss["name"] for loss in data} == {"a~b", "c~d"}
    assert table[-1][4] == f"{1e6 * sum(loss['impact'] for loss in data):.4g} µW"


@cache
def drawn(name: str, state: str | None) -> tuple[PowerFlow, Any]:
    pytest.importorskip("matplotlib")
    torques = load(TRAINS[name]).torques(state)
    return find_power_flow(torques), torques.plot()


PICTURES = [("ring", None), ("clock", None), ("rubbing", None), ("norton", None), ("reverse", "R"),
            ("split", "cruising"), ("split", "boost")]  # fmt: skip


@pytest.mark.parametrize(("name", "state"), PICTURES)
def test_a_picture_names_every_shaft_pair_and_loss(name: str, state: str | None) -> None:
    flow, figure = drawn(name, state)
    from geartrain.drawing import render

    svg = render(figure, ".svg").decode()
    for node in flow.nodes:
        if node.kind in ("shaft", "pair"):
            assert f"<!-- {node.name} -->" in svg
            assert f'id="{node.kind} {node.name}"' in svg
    for loss in flow.losses.values():
        assert f"<!-- {100 * float(loss / flow.power_in):.3g} % -->" in svg
    for loop in flow.loops:
        part = float(loop.power / flow.power_in)
        share = f"{100 * part:.4g} % of" if part < 1 else f"{part:.4g} times"
        assert f"<!-- {share} the power in circulates -->" in svg
    assert render(figure, ".png").startswith(b"\x89PNG")
    assert render(figure, ".pdf").startswith(b"%PDF")


@pytest.mark.parametrize(("name", "state"), PICTURES)
def test_bands_are_as_wide_as_their_powers_and_fill_their_nodes(name: str, state: str | None) -> None:
    pytest.importorskip("matplotlib")
    from geartrain.drawing.sankey import lay_out_sankey

    train = load(TRAINS[name])
    flow = find_power_flow(train.torques(state))
    placed = lay_out_sankey(flow, lambda node, power: 0.5, lambda node, power: 0.4, 9.0)
    assert placed.width >= 9.0 - 1e-9
    pieces = [piece for band in placed.bands for piece in band] + [turn.piece for turn in placed.turns]
    for piece in pieces:
        assert piece.width == pytest.approx(float(piece.stream.power) * placed.scale, rel=1e-12)
    for band in placed.bands:
        assert [piece.target.column - piece.source.column for piece in band] == [1] * len(band)
    assert {turn.piece.stream.circling / turn.piece.stream.power for turn in placed.turns} <= {Fraction(1)}
    for spot in placed.spots:
        for side, shed in ((spot.before, 0.0), (spot.after, spot.shed)):
            if side:
                assert sum(piece.width for piece in side) + shed == pytest.approx(spot.height, rel=1e-9)
        # one beneath the other, from the top
        tops = sorted((piece.start, piece.width) for piece in spot.after)
        assert [top for top, _ in tops] == pytest.approx(
            [spot.top + sum(width for _, width in tops[:at]) for at in range(len(tops))]
        )
    for column in range(len(placed.x)):
        spots = sorted((spot for spot in placed.spots if spot.column == column), key=lambda spot: spot.top)
        for upper, lower in pairwise(spots):
            assert upper.top + upper.height + upper.below <= lower.top - lower.above + 1e-6
    assert all(b - a > 0 for a, b in pairwise(placed.x))


def test_a_gearbox_in_neutral_with_bearing_friction_loses_power_only_in_bearings_of_known_speed() -> None:
    train = load(
        "name: n\nextends: simpson-set\nlinks: {SUN: {bearing: 1/100}, IN: {bearing: 1/100}}\n"
        "states: {N: {engaged: [], expect: free}}\n"
    )
    assert find_power_flow(train.torques("N")).losses == {PowerNode("bearing", "IN"): Fraction(1, 100)}
