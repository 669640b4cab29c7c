"""Large and treacherous trains with answers in closed form, built without any text."""

from __future__ import annotations

import math
import random
from fractions import Fraction
from typing import Any

import pytest
from studies.train_families import FAMILIES, grid

from geartrain import GearTrain, GearTrainError
from geartrain.kinematics.speeds import exact_speeds

Data = dict[str, Any]


def fixed_axes(count: int) -> Data:
    """A frame and `count` links g0, g1, ... each on an axis of its own."""
    links: dict[str, Any] = {"frame": {}, **{f"g{at}": {"wheels": {}} for at in range(count)}}
    revolutes = [{"pair": ["frame", f"g{at}"], "axis": f"x{at}"} for at in range(count)]
    return {"links": links, "revolutes": revolutes, "gears": [], "inputs": {"g0": 1}}


def mesh(data: Data, i: str, z_i: int, j: str, z_j: int, ring: bool = False) -> None:
    """One more gear pair, with wheels of its own; `ring` makes the second wheel internal."""
    at = len(data["gears"])
    data["links"][i]["wheels"][f"i{at}"] = z_i
    data["links"][j]["wheels"][f"j{at}"] = {"teeth": z_j, "internal": True} if ring else z_j
    data["gears"].append({"pair": [f"i{at}", f"j{at}"]})


def bounded_chain(count: int, seed: int = 1) -> tuple[Data, list[tuple[int, int]]]:
    """Fixed-axis gears with random teeth; a mesh is turned round where the ratio would leave 1e-6 to 1e6."""
    rng = random.Random(seed)
    data, meshes, level = fixed_axes(count), [], 0.0
    for at in range(count - 1):
        z_1, z_2 = rng.randint(12, 119), rng.randint(12, 119)
        if abs(level + math.log10(z_1 / z_2)) > 6:
            z_1, z_2 = z_2, z_1
        level += math.log10(z_1 / z_2)
        mesh(data, f"g{at}", z_1, f"g{at + 1}", z_2)
        meshes.append((z_1, z_2))
    return data, meshes


def product(meshes: list[tuple[int, int]]) -> Fraction:
    """The product of -z_1/z_2, by exponents of primes below 120: no long number is ever divided."""
    exponents = dict.fromkeys((p for p in range(2, 120) if all(p % q for q in range(2, p))), 0)
    for z_1, z_2 in meshes:
        for prime in exponents:
            for number, step in ((z_1, 1), (z_2, -1)):
                while number % prime == 0:
                    number //= prime
                    exponents[prime] += step
    top = math.prod(prime**power for prime, power in exponents.items() if power > 0)
    bottom = math.prod(prime**-power for prime, power in exponents.items() if power < 0)
    return Fraction((-1) ** len(meshes) * top, bottom)


@pytest.mark.parametrize("count", [100, 1000, 10_000, pytest.param(100_000, marks=pytest.mark.slow)])
def test_a_bounded_random_chain_is_the_product_of_its_meshes(count: int) -> None:
    data, meshes = bounded_chain(count)
    train = GearTrain.declare(data)
    answer = train.solve()
    assert answer.method == "exact"
    assert answer.verdict.kind == "determined"
    for at in (1, count // 3, count - 1):
        assert answer[f"g{at}"] == product(meshes[:at])
    floats = train.kinematics.floats()
    for at in range(0, count, max(1, count // 50)):
        exact = answer[f"g{at}"]
        assert abs(Fraction(floats[f"g{at}"]) / exact - 1) <= count * Fraction(2.2e-16)


def test_one_output_of_a_long_chain_costs_only_what_drives_it() -> None:
    data, meshes = bounded_chain(2000)
    answer = GearTrain.declare(data).solve(output="g10")
    assert answer["g10"] == product(meshes[:10])
    assert answer.work == 10


def planetary_cascade(stages: int, seed: int = 2) -> Data:
    """Sun, planet and fixed ring with R = S + 2P; sun to carrier and back in turns, in pairs of like teeth."""
    rng = random.Random(seed)
    links: Data = {"frame": {"wheels": {}}, "m0": {"wheels": {}}}
    revolutes = [{"pair": ["frame", "m0"], "axis": "main"}]
    gears = []
    for at in range(stages):
        if at % 2 == 0:
            sun, planet = rng.randint(12, 60), rng.randint(12, 60)
        links[f"m{at + 1}"] = {"wheels": {}}
        inner, arm = (f"m{at}", f"m{at + 1}") if at % 2 == 0 else (f"m{at + 1}", f"m{at}")
        links[inner]["wheels"][f"s{at}"] = sun
        links["frame"]["wheels"][f"r{at}"] = {"teeth": sun + 2 * planet, "internal": True}
        links[f"p{at}"] = {"wheels": {f"p{at}": planet}}
        revolutes.append({"pair": ["frame", f"m{at + 1}"], "axis": "main"})
        revolutes.append({"pair": [arm, f"p{at}"], "axis": f"a{at}"})
        gears += [{"pair": [f"s{at}", f"p{at}"]}, {"pair": [f"p{at}", f"r{at}"]}]
    return {"links": links, "revolutes": revolutes, "gears": gears, "inputs": {"m0": 1}}


@pytest.mark.parametrize(
    "stages", [500, pytest.param(5000, marks=pytest.mark.long), pytest.param(50_000, marks=pytest.mark.slow)]
)
def test_every_second_carrier_of_a_planetary_cascade_returns_to_speed_one(stages: int) -> None:
    train = GearTrain.declare(planetary_cascade(stages))
    answer = train.solve()
    assert answer.verdict.kind == "determined"
    assert answer.method == "exact"
    assert all(answer[f"m{at}"] == 1 for at in range(0, stages + 1, 2))
    assert all(answer[f"m{at}"] < 1 for at in range(1, stages + 1, 2)), "every first half is a reduction"
    floats = train.kinematics.floats()
    assert abs(floats[f"m{stages - stages % 2}"] - 1) <= 1e-9


def ten_thousand_cascade(stages: int, scale: int = 1) -> Data:
    """100/101 - 100/99 with the first wheel fixed: the carrier turns 10^4 times for one turn of the last wheel."""
    links: Data = {"frame": {"wheels": {}}, "m0": {"wheels": {}}}
    revolutes = [{"pair": ["frame", "m0"], "axis": "main"}]
    gears = []
    for at in range(stages):
        links["frame"]["wheels"][f"f{at}"] = 99 * scale
        links[f"p{at}"] = {"wheels": {f"p{at}": 100 * scale, f"q{at}": 101 * scale}}
        links[f"m{at + 1}"] = {"wheels": {f"o{at}": 100 * scale}}
        revolutes.append({"pair": ["frame", f"m{at + 1}"], "axis": "main"})
        revolutes.append({"pair": [f"m{at}", f"p{at}"], "axis": f"a{at}"})
        gears += [{"pair": [f"f{at}", f"p{at}"]}, {"pair": [f"q{at}", f"o{at}"]}]
    return {"links": links, "revolutes": revolutes, "gears": gears, "inputs": {"m0": 1}}


def test_a_cascade_of_ten_thousand_links_reduces_beyond_all_floats_and_stays_exact() -> None:
    stages = 5000
    answer = GearTrain.declare(ten_thousand_cascade(stages)).solve(method="exact")
    assert answer[f"m{stages}"] == Fraction(1, 10 ** (4 * stages))


def lattice(side: int, diagonal: bool = False, seed: int = 4) -> tuple[Data, list[int]]:
    """side x side external gears, every neighbour meshes; `diagonal` adds (0,0) with (1,1)."""
    rng = random.Random(seed)
    teeth = [rng.randint(17, 99) for _ in range(side * side)]
    data = fixed_axes(side * side)
    for at, count in enumerate(teeth):
        data["links"][f"g{at}"]["wheels"] = {f"w{at}": count}
    for row in range(side):
        for column in range(side):
            here = row * side + column
            if column + 1 < side:
                data["gears"].append({"pair": [f"w{here}", f"w{here + 1}"]})
            if row + 1 < side:
                data["gears"].append({"pair": [f"w{here}", f"w{here + side}"]})
    if diagonal:
        data["gears"].append({"id": "one too many", "pair": ["w0", f"w{side + 1}"]})
    return data, teeth


@pytest.mark.parametrize("side", [10, 32, 100, pytest.param(316, marks=pytest.mark.slow)])
def test_a_lattice_turns_and_counts_its_redundant_meshes(side: int) -> None:
    data, teeth = lattice(side)
    train = GearTrain.declare(data)
    mobility = train.mobility
    assert mobility.gear_pairs == 2 * side * (side - 1)
    assert mobility.rank == side * side - 1
    assert mobility.redundant == (side - 1) ** 2
    assert mobility.by_rank == 1
    answer, floats = train.solve(), train.kinematics.floats()
    for at in range(0, side * side, max(1, side * side // 500)):
        exact = Fraction((-1) ** (at // side + at % side) * teeth[0], teeth[at])
        assert answer[f"g{at}"] == exact
        assert abs(Fraction(floats[f"g{at}"]) / exact - 1) <= Fraction(1, 10**14)


@pytest.mark.parametrize(
    "side", [10, 32, pytest.param(100, marks=pytest.mark.long), pytest.param(316, marks=pytest.mark.slow)]
)
def test_one_diagonal_mesh_locks_a_lattice_with_an_odd_loop_as_witness(side: int) -> None:
    train = GearTrain.declare(lattice(side, diagonal=True)[0])
    assert train.mobility.by_rank == 0
    verdict = train.solve().verdict
    assert (verdict.kind, verdict.loops[0].product) == ("locked", -1)
    assert len(verdict.loops[0].links) % 2 == 1


@pytest.mark.parametrize("meshes", [700, 2000, pytest.param(10_000, marks=pytest.mark.long)])
def test_a_speed_below_the_range_of_floats_is_exact_and_no_float(meshes: int) -> None:
    data = fixed_axes(meshes + 1)
    for at in range(meshes):
        mesh(data, f"g{at}", 20, f"g{at + 1}", 60)
    train = GearTrain.declare(data)
    answer = train.solve()
    assert answer[f"g{meshes}"] == Fraction((-1) ** meshes, 3**meshes)
    speed = answer.to_dict()["speeds"][f"g{meshes}"]
    assert (speed["value"], speed["exact"]) == (None, f"1/{3**meshes}")
    mantissa, exponent = speed["decimal"].split("e")
    assert abs(math.log10(float(mantissa)) + int(exponent) + meshes * math.log10(3)) < 1e-6
    with pytest.raises(GearTrainError, match="too small or too large for floating-point"):
        train.kinematics.floats()


@pytest.mark.parametrize(
    ("meshes", "product"),
    [
        (((113, 117), (95, 96), (113, 108)), Fraction(1213055, 1213056)),
        (((113, 117), (117, 96), (96, 113)), 1),
        (((102334155, 63245986), (39088169, 63245986)), Fraction(102334155 * 39088169, 63245986**2)),  # 1 in floats
    ],
)
def test_a_loop_that_all_but_closes_is_a_gridlock(meshes: tuple[tuple[int, int], ...], product: Fraction) -> None:
    data = fixed_axes(len(meshes))
    for at, (z_i, z_j) in enumerate(meshes):
        mesh(data, f"g{at}", z_i, f"g{(at + 1) % len(meshes)}", z_j, ring=at == 2)
    train = GearTrain.declare(data)
    verdict, mobility = train.solve().verdict, train.mobility
    assert (mobility.by_rank, mobility.redundant) == ((1, 1) if product == 1 else (0, 0))
    assert verdict.kind == ("determined" if product == 1 else "locked")
    for jam in train.kinematics.gridlock.jams:
        for loop in (*verdict.loops, jam.loop):
            assert product in (loop.product, 1 / loop.product)
        assert (jam.by, len(train.kinematics.gridlock.release.choices)) == ("ratio", len(meshes)), "any mesh frees it"


def count_eliminations(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """The modulus of every elimination to come; 0 is an elimination in fractions."""
    met: list[int] = []
    eliminate = exact_speeds.eliminate

    def count(rows: Any, budget: int | None = None, modulus: int = 0) -> Any:
        met.append(modulus)
        return eliminate(rows, budget, modulus)

    monkeypatch.setattr(exact_speeds, "eliminate", count)
    return met


def test_a_large_grid_of_differentials_is_solved_in_floats_without_a_single_fraction(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    met, data = count_eliminations(monkeypatch), grid(6666)
    answer = GearTrain.declare(data).solve()
    assert answer.method == "floats"
    assert answer.verdict.kind == "determined"
    assert 0 not in met
    wheels = {
        name: (link, entry) for link, each in data["links"].items() for name, entry in each.get("wheels", {}).items()
    }
    for sun, (first, teeth) in ((name, wheel) for name, wheel in wheels.items() if name.startswith("sun")):
        place = sun.removeprefix("sun")
        second, ring = wheels[f"ring{place}"]
        carrier, one, other = (Fraction(answer[link]) for link in (f"s{place}", first, second))
        assert abs(teeth * (one - carrier) + ring["teeth"] * (other - carrier)) <= ring["teeth"] * 1e-13, place
    for link, speed in data["inputs"].items():
        assert answer[link] == speed


@pytest.mark.parametrize(
    ("change", "kind"),
    [
        pytest.param({"s20_20": 1}, "contradictory", id="one input too many"),
        pytest.param({"s0_0": None, "s20_20": 1}, "contradictory", id="as many equations as links, and singular"),
        pytest.param({"s0_5": None}, "free", id="one input too few"),
    ],
)
def test_a_large_grid_that_is_not_determined_is_never_called_determined(change: Data, kind: str) -> None:
    data = grid(4000)
    data["inputs"] = {link: speed for link, speed in (data["inputs"] | change).items() if speed is not None}
    assert GearTrain.declare(data).solve().verdict.kind == kind


@pytest.mark.parametrize("family", sorted(FAMILIES))
def test_every_family_is_solved_exactly_up_to_a_thousand_links(family: str) -> None:
    assert GearTrain.declare(FAMILIES[family](1000)).solve().method == "exact"


def test_only_fill_is_predicted_and_length_is_not() -> None:
    assert GearTrain.declare(FAMILIES["cascade"](20_000)).solve().method == "exact"
    assert GearTrain.declare(grid(1700)).solve().method == "exact"
