"""Equal planets declared by `copies`: held against the same trains with every planet declared, and closed forms."""

from __future__ import annotations

from fractions import Fraction
from math import cos, isclose, sin, tau

import pytest
import yaml

import geartrain
from geartrain.errors import DeclarationError, QuestionError
from geartrain.simulation import find_link_inertias

SET = """
name: planetary set
links:
  frame: {{}}
  sun: {{wheels: {{s: {{teeth: {s}, module: 1 mm}}}}}}
  planet: {{wheels: {{p: {p}}}, copies: {n}{more}}}
  ring: {{wheels: {{r: {{teeth: {r}, internal: true}}}}}}
  carrier: {{inertia: 100 g mm2}}
revolutes: {{main: [frame, sun, ring, carrier], P: [carrier, planet]}}
gears: [s ~ p, {{pair: [p, r], tooth_form: {{form: involute, addendum: [1, 0.9], backlash: 0.05}}}}]
inputs: {{sun: 60 rpm}}
fixed: [ring]
loads: {{carrier: -0.3 N m}}
outputs: {{carrier: {{}}}}
"""


def read(text: str) -> geartrain.GearTrain:
    return geartrain.GearTrain.declare(yaml.safe_load(text))


def planetary(s: int = 24, p: int = 18, n: int = 3, more: str = "", rest: str = "") -> geartrain.GearTrain:
    return read(SET.format(s=s, p=p, r=s + 2 * p, n=n, more=more) + rest)


@pytest.mark.parametrize("name", ["nrel-grc-750", "bevel-differential", "bevel-differential-involute"])
def test_speeds_are_those_of_all_planets_declared(name: str) -> None:
    train = geartrain.load(name)
    every = train.unfolded
    assert len(every.declaration.links) > len(train.declaration.links)
    assert every.mobility.by_rank == train.mobility.by_rank
    unfolded = [link for link in every.declaration.links if "." in link]
    top = every.kinematics.tree.top
    seen = {  # about its own axis, as its carrier sees it
        f"{each} in {link}": {"of": each, "relative_to": top[link]}
        for link in unfolded
        for each in (link, link.partition(".")[0])
    }
    every = every.with_changes(outputs=seen)
    for state in train.states or (None,):
        one, all_ = train.solve(state), every.solve(state)
        assert all_.verdict.kind == one.verdict.kind == "determined"
        for link in train.declaration.links:
            assert one[link] == all_[link]
        for link in unfolded:
            first = link.partition(".")[0]
            assert all_[f"{link} in {link}"] == all_[f"{first} in {link}"], (state, link)


def test_a_train_without_copies_is_its_own() -> None:
    train = geartrain.load("planetary-24-18-60")
    assert train.unfolded is train
    assert train.mechanics.planets_as_one is train.mechanics


@pytest.mark.parametrize("n", [2, 3, 4])
def test_each_planet_bears_its_part_of_the_load(n: int) -> None:
    found = planetary(n=n).torques()
    # sun and ring against a carrier of 0.3: 24 and 60 parts of 84
    assert found.external["sun"] == Fraction(3, 10) * Fraction(24, 84)
    assert len(found.pairs) == 2 * n
    for name, pair in found.pairs.items():
        whole = Fraction(24, 84) if name.startswith("s") else Fraction(60, 84)
        assert abs(pair.torques[0 if name.startswith("s") else 1]) == Fraction(3, 10) * whole / n


def test_loads_on_a_planet_act_on_each() -> None:
    text = SET.format(s=24, p=18, r=60, n=3, more="").replace(
        "carrier: -0.3 N m}", "carrier: -0.3 N m, planet: 0.01 N m}"
    )
    # by virtual work: the carrier makes 2/7 of the sun's turns, each planet 2/3 backwards
    wanted = Fraction(3, 10) * Fraction(2, 7) + 3 * Fraction(1, 100) * Fraction(2, 3)
    assert read(text).torques().external["sun"] == wanted


def heavy_set() -> geartrain.GearTrain:
    rest = "tooth_form: {form: involute, backlash: 0.05}\n"
    return planetary(more=", inertia: 20 g mm2, mass: 10 g", rest=rest)


def test_equal_planets_in_time_are_one_as_heavy_as_all() -> None:
    planet, carrier = (
        next(each for each in find_link_inertias(heavy_set().mechanics) if each.link == link)
        for link in ("planet", "carrier")
    )
    assert isclose(planet.value, 3 * 20e-9)
    assert isclose(carrier.value, 100e-9 + 3 * 10e-3 * 21e-3**2)


def test_a_set_driven_at_a_rate_in_time_bears_what_statics_say() -> None:
    """An input without inertia once let the mesh with the ring go."""
    run = heavy_set().dynamics(turns=0.1)
    torques = {each.name: each.torque for each in run.contacts}
    assert isclose(run.torque, 0.3 * 24 / 84, rel_tol=1e-3)
    assert isclose(torques["p~r"], 0.3 * 60 / 84, rel_tol=1e-3)
    assert run.deviations[0].behind < 1e-6


def test_planets_declared_one_by_one_in_time_are_told_what_to_do() -> None:
    with pytest.raises(QuestionError, match="copies: 3"):
        geartrain.GearTrain(heavy_set().unfolded.declaration).dynamics(turns=0.1)


def test_positions_and_directions_are_turned_about_the_axis_of_the_carrier() -> None:
    placed = SET.replace(
        "revolutes", "axes: {{main: {{position: [5 mm, 0 mm, 0 mm]}}, P: {{position: [26 mm, 0 mm, 0 mm]}}}}\nrevolutes"
    )
    found = read(placed.format(s=24, p=18, r=60, n=3, more="")).unfolded.declaration.axes
    for at, label in enumerate(("P", "P.2", "P.3")):
        x, y, z = (1e3 * part.si for part in found[label].position)
        assert isclose(x, 5 + 21 * cos(at * tau / 3), abs_tol=1e-12)
        assert isclose(y, 21 * sin(at * tau / 3), abs_tol=1e-12)
        assert z == 0
    spider = geartrain.load("bevel-differential").unfolded.declaration.axes["spider.2"].direction
    assert [figure.value for figure in spider] == [0, -1, 0]


def test_unfolded_parts_were_written_where_the_first_was() -> None:
    every = planetary().unfolded.declaration
    assert every.place("links", "planet.3") == every.place("links", "planet")
    assert every.place("gears", 2) == every.place("gears", 0)
    assert every.place("gears", 5) == planetary().declaration.place("gears", 1)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (("P: [carrier, planet]", "P: [frame, planet]"), "have no carrier"),
        (("copies: 3", "copies: 0"), "copies"),
        (("P: [carrier, planet]}", "P: [carrier, planet], Q: [planet, rider]}\n  "), "turns on 'planet'"),
    ],
)
def test_copies_that_have_no_place_are_refused(change: tuple[str, str], words: str) -> None:
    text = SET.format(s=24, p=18, r=60, n=3, more="").replace(*change)
    if "rider" in text:
        text = text.replace("  carrier:", "  rider: {}\n  carrier:")
    with pytest.raises(DeclarationError, match=words):
        read(text).solve()


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (("ring", "planet.2"), "link 'planet.2' is declared"),
        (("{s: {", "{p.3: 12, s: {"), "wheel 'p.3' is declared"),
        (
            (
                "revolutes: {main: [frame, sun, ring, carrier]",
                "revolutes: {main: [frame, sun, ring], P.2: [frame, carrier]",
            ),
            "axis 'P.2' is declared",
        ),
        (("gears: [s ~ p, {pair: [p, r]", "gears: [{id: x, pair: [s, p]}, {id: x.2, pair: [p, r]"), "pair 'x.2' is"),
    ],
)
def test_names_that_copies_will_bear_are_free(change: tuple[str, str], words: str) -> None:
    text = SET.format(s=24, p=18, r=60, n=3, more="")
    assert change[0] in text
    with pytest.raises(DeclarationError, match=words):
        read(text.replace(*change)).solve()


def test_unequal_copies_cannot_mesh() -> None:
    text = SET.format(s=24, p=18, r=96, n=3, more="").replace(
        "  ring:", "  outer: {wheels: {o: 18}, copies: 2}\n  ring:"
    )
    text = text.replace("P: [carrier, planet]", "P: [carrier, planet], Q: [carrier, outer]").replace(
        "pair: [p, r]", "pair: [p, o]}, {pair: [o, r]"
    )
    with pytest.raises(DeclarationError, match="cannot be connected"):
        read(text).solve()
    assert read(text.replace("copies: 2", "copies: 3")).unfolded.mobility.by_rank == 2


def test_a_rounded_position_of_a_planet_gives_positions_of_its_copies() -> None:
    """A third of a turn from (67.549981495, -39) mm, rounded at 1e-9 mm, is (0, 78) mm up to 1e-10 mm."""
    train = geartrain.load("""
links: {frame: {}, carrier: {}, p: {wheels: {w: 20}, copies: 3}}
axes:
  A: {direction: [1, 0, 0], position: [0 mm, 0 mm, 0 mm]}
  B: {direction: [1, 0, 0], position: [100 mm, 67.549981495 mm, -39 mm]}
revolutes: {A: [frame, carrier], B: [carrier, p]}
inputs: {carrier: 1, p: 0}
""")
    places = [axis.position for label, axis in train.unfolded.declaration.axes.items() if label.startswith("B")]
    assert [[round(part.si * 1000, 6) for part in place or ()] for place in places] == [
        [100, 67.549981, -39],
        [100, 0, 78],
        [100, -67.549981, -39],
    ]
