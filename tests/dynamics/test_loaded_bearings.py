"""Friction of bearings that grows with the load, section 6 of docs/torques.md.

The references solve all forces at once with cross products about the axes, without ratios, efficiencies of the train or
iteration. A pair with the efficiency eta has its line of action through the point of the line of centres whose
distances from both axes are in the ratio eta z2/z1, so that both torques are moments of one force.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from math import cos, hypot, pi, radians, sin
from typing import Any

import numpy as np
import pytest
from scipy.optimize import fsolve

import geartrain
from geartrain.dynamics.motion import find_motion_problem
from geartrain.dynamics.torques.torque_results import TorqueVerdict
from geartrain.dynamics.turn import find_turn_balance
from geartrain.simulation.steps import BEARINGS, IMPACT_COUNT, UNSOLVED, WORK_DRIVE, StepPlan, simulate
from geartrain.simulation.time import model_in_time

MU = 0.15
STANDARD = 9.80665  # m/s2


def friction_circle(mu: float, radius: float) -> float:
    return radius * mu / hypot(1, mu)


# ---------------------------------------------------------------------------------------------------------- one arbor

ARM = """
links:
  frame: {{}}
  a: {{wheels: {{w: 20}}}}
  b: {{wheels: {{v: 20}}, mass: {mass} kg, bearing: {{coefficient: {mu}, radius: {radius} mm}}}}
revolutes: {{A: [frame, a], B: [frame, b]}}
axes: {{A: {{position: [{x} mm, {y} mm, 0 mm]}}, B: {{position: [0 mm, 0 mm, 0 mm]}}}}
gears: [w ~ v]
inputs: {{a: 1}}
loads: {{b: 60 N mm}}
gravity: {gravity}
"""


def arm(gravity: str, mu: float = MU, radius: float = 1.5) -> geartrain.GearTrain:
    """An arbor with the torque 60 N mm, driven by a force along y with the arm 20 mm, under the weight 10 N."""
    slope, pitch = radians(20), 20 / cos(radians(20))
    # the driver's axis, so that the force, 20 degrees from the common tangent, is along y
    x, y = (-2 * pitch * part for part in (cos(slope), sin(slope)))
    return geartrain.load(
        ARM.format(mass=repr(10 / STANDARD), mu=mu, radius=radius, x=f"{x:.15g}", y=f"{y:.15g}", gravity=gravity)
    )


@pytest.mark.parametrize(
    ("name", "gravity", "force", "load"),
    [
        ("A1a", "[0, -1, 0]", 3.07702183, 6.92297817),
        ("A1b", "[0, 1, 0]", 3.14625915, 13.14625915),
        ("A1c", "[-1, 0, 0]", 3.11653315, hypot(10, 3.11653315)),
    ],
)
def test_an_arbor_under_its_weight_needs_the_force_of_the_closed_form(
    name: str, gravity: str, force: float, load: float
) -> None:
    found = arm(gravity).torques()
    # the pair has no loss: the torque on the arbor is force times arm
    assert abs(float(found.pairs["w~v"].torques[1])) == pytest.approx(20e-3 * force, rel=3e-9), name
    assert found.bearings[0].load == pytest.approx(load, rel=3e-9)
    assert float(found.bearings[0].torque) == pytest.approx(1e-3 * 0.222510679 * load, rel=3e-9)


def test_a_weight_that_relieves_the_bearing_frees_an_arbor_that_would_lock() -> None:
    # rho = 21 mm exceeds the arm of 20 mm; of the two solutions 6.58536585 and 150 the smaller one is found
    radius = 21 * hypot(1, MU) / MU
    found = arm("[0, -1, 0]", radius=radius).torques()
    assert abs(float(found.pairs["w~v"].torques[1])) == pytest.approx(20e-3 * 6.58536585, rel=3e-9)
    locked = arm("[0, 1, 0]", radius=radius).torques().verdict
    assert locked.kind == "self-locking"
    assert "bearings of b" in locked.text


VERTICAL = """
links: {frame: {}, a: {wheels: {w: 20}}, b: {wheels: {v: 20}, mass: MASS kg, BEARING}}
revolutes: {A: [frame, a], B: [frame, b]}
axes: {A: {position: [20 mm, 0 mm, 0 mm]}, B: {position: [0 mm, 0 mm, 0 mm]}}
gears: [w ~ v]
gravity: [0, 0, -1]
inputs: {a: 1}
loads: {b: 0 N mm}
rate: 1 turn/s
"""
SHOULDER = "bearing: {coefficient: 0.15, radius: 1 mm, shoulder: [1 mm, 3 mm]}"


def test_a_vertical_arbor_rubs_on_its_shoulder_as_in_case_a4() -> None:
    train = geartrain.load(VERTICAL.replace("MASS", repr(2 / STANDARD)).replace("BEARING", SHOULDER))
    (found,) = train.torques().bearings
    pivot = friction_circle(MU, 1e-3) * found.load
    assert 1e3 * (abs(float(found.torque)) - pivot) == pytest.approx(0.65, rel=1e-9)
    # the force of the pair turns the arbor against both: the arm is 10 mm, and the pivot is pressed by it alone
    assert found.load * 10e-3 * cos(radians(20)) == pytest.approx(0.65e-3 + pivot, rel=1e-9)
    # the pressure 2 N/(area) times mu times the arm, summed over rings
    edges = np.linspace(1, 3, 100_001)
    middle, area = (edges[1:] + edges[:-1]) / 2, np.diff(edges**2)
    assert np.sum(0.15 * 2 * middle * area) / 8 == pytest.approx(0.65, rel=1e-9)
    run = with_inertia(train).dynamics(turns=0.1, skip=0.1, steps=200, fast=False)
    assert run.torque == pytest.approx(0.65e-3 + pivot, rel=1e-9)


def test_a_shoulder_with_exchanged_radii_is_refused() -> None:
    with pytest.raises(geartrain.GearTrainError, match="inner radius"):
        geartrain.load(VERTICAL.replace("MASS", "1").replace("BEARING", SHOULDER.replace("1 mm, 3 mm", "3 mm, 1 mm")))


# ------------------------------------------------------------------------------------------------------- three arbors

TRAIN = """
links:
  frame: {{}}
  A: {{mass: {m[0]} kg, wheels: {{a: {{teeth: 64, along: 10 mm}}}}, bearing: {{coefficient: {mu}, radius: 2 mm{at}}}}}
  B:
    mass: {m[1]} kg
    wheels: {{b: {{teeth: 38, along: 10 mm}}, b2: {{teeth: 48, along: 30 mm}}}}
    bearing: {{coefficient: {mu}, radius: 1.5 mm{at}}}
  C: {{mass: {m[2]} kg, wheels: {{c: {{teeth: 24, along: 30 mm}}}}, bearing: {{coefficient: {mu}, radius: 1 mm{at}}}}}
revolutes: {{A: [frame, A], B: [frame, B], C: [frame, C]}}
axes: {{A: {{position: [{p[0]}]}}, B: {{position: [{p[1]}]}}, C: {{position: [{p[2]}]}}}}
gears: [{{pair: [a, b], efficiency: {eta}}}, {{pair: [b2, c], efficiency: {eta}}}]
inputs: {{A: {way}}}
loads: {{C: {load} N mm}}
{gravity}
"""
WEIGHTS = (0.3, 0.2, 0.1)


def three_arbors(
    c: tuple[float, float] = (25.5, 18),
    eta: float = 1,
    mu: float = MU,
    at: bool = False,
    gravity: bool = False,
    load: float = 10,
    turned: float = 0,
    way: int = 1,
) -> geartrain.GearTrain:
    places = [(0.0, 0.0), (25.5, 0.0), c]
    about = [(x * cos(turned) - y * sin(turned), x * sin(turned) + y * cos(turned)) for x, y in places]
    return geartrain.load(
        TRAIN.format(
            m=[repr(weight / STANDARD) for weight in WEIGHTS],
            p=[f"{x:.15g} mm, {y:.15g} mm, 0 mm" for x, y in about],
            mu=mu,
            eta=eta,
            at=", at: [0 mm, 40 mm]" if at else "",
            gravity="gravity: [0, -1, 0]" if gravity else "",
            load=-load * way,
            way=way,
        )
    )


def crank(train: geartrain.GearTrain) -> float:
    return 1e3 * float(train.torques().external["A"])


def reference(
    c: tuple[float, float], eta: float, at: bool = False, weights: tuple[float, ...] = (0, 0, 0), load: float = 10
) -> tuple[float, ...]:
    """Forces of both pairs and torque at the crank [N, N mm], from the moments about all axes at once."""
    axes, angle = np.array([(0, 0), (25.5, 0), c]), radians(20)
    radii = [friction_circle(MU, radius) for radius in (2, 1.5, 1)]
    ways, points = [], []
    for at_pair, (z1, z2) in enumerate(((64, 38), (48, 24))):
        centre_line = axes[at_pair + 1] - axes[at_pair]
        apart = centre_line / np.hypot(*centre_line)
        tangent = (1 - 2 * at_pair) * np.array([-apart[1], apart[0]])
        ways.append(cos(angle) * tangent + sin(angle) * apart)
        points.append(axes[at_pair] + centre_line / (1 + eta * z2 / z1))

    def moment(arbor: int, pair: int, force: float) -> float:
        arm = points[pair] - axes[arbor]
        return force * (arm[0] * ways[pair][1] - arm[1] * ways[pair][0])

    def rubbed(arbor: int, forces: list[tuple[float, float]]) -> float:
        """Friction of one bearing, or of two at 0 and 40, of forces (size along its way, place)."""
        down = np.array([0, -weights[arbor]])
        vectors = [(size * ways[min(arbor, 1) if place == 30 else 0], place) for size, place in forces]
        if not at:
            return radii[arbor] * np.hypot(*(sum(vector for vector, _ in vectors) + down))
        first = sum(vector * (40 - place) / 40 for vector, place in vectors) + down / 2
        second = sum(vector * place / 40 for vector, place in vectors) + down / 2
        return radii[arbor] * (np.hypot(*first) + np.hypot(*second))

    def balance(x: np.ndarray) -> list[float]:
        first, second, torque = x
        return [
            torque - rubbed(0, [(-first, 10)]) + moment(0, 0, -first),
            # the second arbor turns backwards
            moment(1, 0, first) + moment(1, 1, -second) + rubbed(1, [(first, 10), (-second, 30)]),
            moment(2, 1, second) - rubbed(2, [(second, 30)]) - load,
        ]

    return tuple(fsolve(balance, [2, 2, 40], xtol=1e-13))


def test_arbors_in_a_line_and_at_a_right_angle_press_as_in_cases_a2a_and_a2b() -> None:
    line, angle = three_arbors(c=(43.5, 0)).torques(), three_arbors().torques()
    assert [1e3 * float(each.external["A"]) for each in (line, angle)] == pytest.approx(
        [36.7948545, 35.9742775], rel=2e-9
    )
    torques = [abs(1e3 * float(each.torque)) for each in (*line.bearings, angle.bearings[1])]
    assert torques == pytest.approx([0.712007541, 0.883769803, 0.270210281, 0.405980268], rel=2e-9)
    assert (line.efficiency, angle.efficiency) == pytest.approx((0.915459811, 0.936341543), abs=1e-9)


@pytest.mark.parametrize(
    ("name", "at", "gravity", "load", "torque"),
    [
        ("A2c", False, False, 10, 38.2580830655),
        ("A2d", True, False, 10, 38.5733656547),
        ("A2e", True, True, 10, 38.5982036398),
        ("A2e without load", True, True, 0, 0.218575661226),
    ],
)
def test_losses_of_teeth_two_bearings_and_weights(
    name: str, at: bool, gravity: bool, load: float, torque: float
) -> None:
    weights = WEIGHTS if gravity else (0.0, 0.0, 0.0)
    expected = reference((25.5, 18), 0.97, at, weights, load)
    assert expected[2] == pytest.approx(torque, rel=1e-9), name
    assert crank(three_arbors(eta=0.97, at=at, gravity=gravity, load=load)) == pytest.approx(torque, rel=2e-11)


def test_the_same_friction_as_constant_torques_gives_the_same_crank_torque() -> None:
    found = three_arbors(eta=0.97).torques()
    declared = three_arbors(eta=0.97, mu=0).declaration
    links = dict(declared.links)
    for each in found.bearings:
        links[each.link] = links[each.link].changed(
            bearing=geartrain.train.mechanism.BearingFriction(sliding=f"{abs(float(each.torque))!r} N m")
        )
    again = geartrain.GearTrain(declared.changed(links=links)).torques()
    assert float(again.external["A"]) == pytest.approx(float(found.external["A"]), rel=1e-14)


# ------------------------------------------------------------------------------------------------------------- planets

PLANETS = """
extends: planetary-24-18-60
links: {{planet: {{copies: {copies}, bearing: {{coefficient: {mu}, radius: {radius} mm}}}}, {more}}}
axes: {{main: {{position: [0 mm, 0 mm, 0 mm]}}, planet: {{position: [{x} mm, {y} mm, 0 mm]}}}}
loads: {{carrier: -1 N m}}
{shares}
"""


def planets(copies: int, mu: float = MU, radius: float = 2, more: str = "", shares: str = "", turned: float = 0) -> str:
    x, y = 21 * cos(turned), 21 * sin(turned)
    return PLANETS.format(copies=copies, mu=mu, radius=radius, more=more, shares=shares, x=f"{x:.15g}", y=f"{y:.15g}")


@pytest.mark.parametrize("copies", [1, 3])
@pytest.mark.parametrize(
    ("mu", "radius", "k", "efficiency"), [(0.15, 2, 0.0329669181, 0.954407449), (0.3, 4, 0.127848363, 0.838062877)]
)
def test_pins_of_planets_lose_what_the_closed_form_says(
    copies: int, mu: float, radius: float, k: float, efficiency: float
) -> None:
    """Cases A3a and A3b: (1 - k 9/21)/(1 + k) with the pin's friction on the carrier."""
    found = geartrain.load(planets(copies, mu, radius)).torques()
    sun, ring = (abs(found.pairs[name].torques[at] / arm) for name, at, arm in (("s~p", 0, 12), ("p~ring", 1, 30)))
    assert float(ring / sun) == pytest.approx((1 - k) / (1 + k), rel=1e-9)
    assert found.efficiency == pytest.approx(efficiency, abs=1e-9)
    assert float(found.loss) == pytest.approx(float(sum(found.powers.values())), abs=1e-15)


@pytest.mark.parametrize(
    ("copies", "shares", "part"),
    [(1, (1,), 1), (2, (0.5, 0.5), 0), (3, (1 / 3, 1 / 3, 1 / 3), 0), (3, (0.5, 0.3, 0.2), 0.07**0.5)],
)
def test_planets_press_on_the_sun_with_their_vector_sum(copies: int, shares: tuple[float, ...], part: float) -> None:
    """Case A3c: one force of the sun's torque at its pitch circle, 12 mm, leaning by 20 degrees."""
    suns = "sun: {bearing: {coefficient: 0.15, radius: 2 mm}}"
    text = planets(1, 0, 2, suns)
    if copies > 1:
        # planets one by one, so that their shares may differ
        planet, pin, place, pairs = [], [], [], []
        for at, share in enumerate(shares):
            x, y = (21 * part(2 * pi * at / copies) for part in (cos, sin))
            planet.append(f"p{at}: {{wheels: {{w{at}: 18}}}}")
            pin.append(f"P{at}: [carrier, p{at}]")
            place.append(f"P{at}: {{position: [{x:.11f} mm, {y:.11f} mm, 0 mm]}}")
            pairs.append(f"{{pair: [s, w{at}], share: {share!r}}}, {{pair: [w{at}, ring]}}")
        text = f"""
links:
  {{frame: {{wheels: {{ring: {{teeth: 60, internal: true}}}}}}, carrier: {{}}, {", ".join(planet)},
   {suns.replace("sun: {", "sun: {wheels: {s: 24}, ")}}}
revolutes: {{main: [frame, sun, carrier], {", ".join(pin)}}}
axes: {{main: {{position: [0 mm, 0 mm, 0 mm]}}, {", ".join(place)}}}
gears: [{", ".join(pairs)}]
inputs: {{sun: 1}}
loads: {{carrier: -1 N m}}
"""
    found = geartrain.load(text).torques()
    bearing = next(each for each in found.bearings if each.link == "sun")
    torque = float(abs(found.external["sun"])) - abs(float(bearing.torque))
    assert bearing.load == pytest.approx(part * torque / (12e-3 * cos(radians(20))), rel=1e-9, abs=1e-9)


# ---------------------------------------------------------------------------------------------------------------- laws


def test_a_pair_with_losses_presses_with_the_sum_of_its_torques_over_the_centre_distance() -> None:
    """Tangential force of case A5a: involutes 24, 36, module 2, 1 N m, contact 2 mm before the pitch point."""
    train = geartrain.load(
        """
links: {frame: {}, a: {wheels: {w: 24}}, b: {wheels: {v: 36}, bearing: {coefficient: 1e-9, radius: 1 mm}}}
revolutes: {A: [frame, a], B: [frame, b]}
axes: {A: {position: [0 mm, 0 mm, 0 mm]}, B: {position: [60 mm, 0 mm, 0 mm]}}
gears: [{pair: [w, v], efficiency: 0.984801351}]
inputs: {a: 1}
loads: {b: 1000 N mm}
"""
    )
    found = train.torques()
    assert 1e3 * float(abs(found.external["a"])) == pytest.approx(676.955475, rel=2e-9)
    # the load is tangential and radial, as for the pressure angle of 20 degrees
    assert found.bearings[0].load * cos(radians(20)) == pytest.approx(27.9492579, rel=2e-9)


def test_without_friction_the_answer_is_bit_for_bit_that_without_bearings() -> None:
    plain, none = three_arbors(eta=0.97, mu=0), three_arbors(eta=0.97, mu=1e-300)
    assert [float(each) for each in plain.torques().external.values()] == [
        float(each) for each in none.torques().external.values()
    ]
    assert isinstance(plain.torques().efficiency, Fraction)


def test_turning_the_layout_changes_nothing_without_gravity() -> None:
    torques = [crank(three_arbors(eta=0.97, at=True, turned=angle)) for angle in (0, 0.7, 2, 4.5)]
    assert torques == pytest.approx([torques[0]] * 4, rel=1e-12)
    for angle in (0.3, 1.1):
        assert geartrain.load(planets(3, turned=angle)).torques().efficiency == pytest.approx(0.954407449, abs=1e-9)


def test_mirror_images_agree() -> None:
    for at in (False, True):
        assert crank(three_arbors((25.5, 18), 0.97, at=at)) == pytest.approx(
            -crank(three_arbors((25.5, -18), 0.97, at=at, way=-1)), rel=1e-12
        )


def test_efficiency_never_rises_with_friction() -> None:
    for at in (False, True):
        found = [three_arbors(eta=0.97, mu=mu, at=at).torques().efficiency for mu in np.linspace(0, 1.2, 13)]
        assert all(after < before for before, after in pairwise(found))


def test_energy_is_balanced_and_no_loss_is_negative() -> None:
    for train in (three_arbors(eta=0.97, at=True, gravity=True), geartrain.load(planets(3))):
        found = train.torques()
        assert float(sum(found.powers.values()) - found.loss) == pytest.approx(0, abs=1e-12 * float(found.power_in))
        assert all(each.loss >= 0 for each in (*found.bearings, *found.pairs.values()))


def test_two_bearings_never_lose_less_than_one() -> None:
    for c in ((43.5, 0), (25.5, 18), (25.5, -18), (7.5, 0)):
        assert crank(three_arbors(c, 0.97, at=True)) >= crank(three_arbors(c, 0.97))


def test_torques_are_proportional_to_the_load_without_weights() -> None:
    ratios = [crank(three_arbors(eta=0.97, at=True, load=load)) / load for load in (1e-3, 1, 1e6)]
    assert ratios == pytest.approx([ratios[0]] * 3, rel=1e-12)


def test_a_bearing_without_positions_of_its_axes_names_them() -> None:
    train = geartrain.load(
        """
links: {frame: {}, a: {wheels: {w: 24}}, b: {wheels: {v: 36}, bearing: {coefficient: 0.15, radius: 1 mm}}}
revolutes: {A: [frame, a], B: [frame, b]}
axes: {A: {position: [0 mm, 0 mm, 0 mm]}}
gears: [w ~ v]
inputs: {a: 1}
loads: {b: -1 N m}
"""
    )
    found = train.torques()
    assert found.verdict.kind == "incomplete"
    (effect,) = found.neglected
    assert (effect.what, effect.where) == ("forces on bearings", ("w~v",))
    assert "axes B" in effect.why
    assert found.loss == 0


# -------------------------------------------------------------------------------------------------------------- a clock


def clock(places: tuple[tuple[float, float], ...], mu: float = MU, drive: float = 735.0, line: float = 25.4) -> float:
    """Torque at the escape wheel of the longcase clock [N mm], from the moments about its arbors at once.

    Cycloidal teeth press at right angles to the line of centres. The line pulls down at the barrel.
    """
    counts, efficiencies = ((96, 8), (60, 8), (56, 7)), clock_efficiencies()
    radii = [friction_circle(mu, radius) for radius in (1.5, 1, 0.5, 0.4)]
    axes = np.array(places)
    ways, arms = [], []
    for number, (z1, z2) in enumerate(counts):
        centre_line = axes[number + 1] - axes[number]
        distance = np.hypot(*centre_line)
        # the great wheel turns clockwise
        ways.append((-1) ** (number + 1) * np.array([-centre_line[1], centre_line[0]]) / distance)
        first = distance / (1 + efficiencies[number] * z2 / z1)
        arms.append((first, distance - first))
    pull = np.array([0, -drive / line])

    def balance(x: np.ndarray) -> list[float]:
        on = [x[number] * ways[number] for number in range(3)]
        rubbed = [pull - on[0], on[0] - on[1], on[1] - on[2], on[2]]
        lost = [radius * np.hypot(*load) for radius, load in zip(radii, rubbed, strict=True)]
        return [
            drive - lost[0] - x[0] * arms[0][0],
            x[0] * arms[0][1] - lost[1] - x[1] * arms[1][0],
            x[1] * arms[1][1] - lost[2] - x[2] * arms[2][0],
            x[2] * arms[2][1] - lost[3] - x[3],
        ]

    return float(fsolve(balance, [15, 2, 0.3, 0.8], xtol=1e-13)[3])


def clock_efficiencies() -> list[float]:
    found = geartrain.load("longcase-clock-loaded").torques().pairs
    return [float(found[name].efficiency) for name in ("g96~c8", "c60~t8", "t56~e7")]


STRAIGHT = ((0.0, 0.0), (0.0, 52.0), (0.0, 82.6), (0.0, 107.8))
TO_THE_RIGHT = ((0.0, 0.0), (0.0, 52.0), (30.6, 52.0), (30.6, 77.2))


@pytest.mark.parametrize(
    ("name", "places", "mu", "extra", "line", "torque"),
    [
        ("D3", STRAIGHT, 0.15, "", 25.4, 0.831324577),
        ("D4, third arbor to the right", TO_THE_RIGHT, 0.15, "", 25.4, 0.838107),
        ("D4, 0.1", STRAIGHT, 0.1, "", 25.4, 0.859742),
        ("D4, 0.2", STRAIGHT, 0.2, "", 25.4, 0.804217),
        ("D5, without a pulley", STRAIGHT, 0.15, "drive: {weight: 5.9 kg, drum: 12.7 mm, falls: 1}", 12.7, 0.824428),
    ],
)
def test_pivots_of_a_clock_take_as_much_as_all_moments_at_once_say(
    name: str, places: tuple[tuple[float, float], ...], mu: float, extra: str, line: float, torque: float
) -> None:
    # seen from the dial the great wheel turns against the clock: a mirror image of the reference
    positions = "".join(
        f"  {axis}: {{position: [{-x} mm, {y} mm, 0 mm]}}\n"
        for axis, (x, y) in zip(("great", "centre", "third", "escape"), places, strict=True)
    )
    links = "".join(
        f"  {link}: {{bearing: {{coefficient: {mu}}}}}\n" for link in ("great", "centre", "third", "escape")
    )
    train = geartrain.load(f"extends: longcase-clock-pivots\naxes:\n{positions}links:\n{links}{extra}")
    expected = clock(places, mu, line=line)
    assert expected == pytest.approx(torque, rel=2e-6), name
    assert 1e3 * abs(float(train.torques().external["escape"])) == pytest.approx(expected, rel=1e-9)


def test_the_report_on_a_clock_gives_the_loss_of_its_pivots() -> None:
    from geartrain.dynamics.clock_rate import find_timekeeping

    train = geartrain.load("longcase-clock-pivots")
    found = find_timekeeping(train.mechanics.load_case())
    assert found is not None
    expected = clock(STRAIGHT) / 735 * 720
    assert found.efficiency == pytest.approx(expected, rel=1e-9)
    # friction in proportion to the load scales with the weight, so no torque is constant
    lossless = geartrain.load("longcase-clock-loaded")
    assert found.minimum_torque is not None
    arc, amplitude = radians(1.5), found.amplitude
    assert amplitude is not None
    assert found.minimum_torque == pytest.approx(0.735 * (1 - cos(arc)) / (1 - cos(amplitude)), rel=1e-12)
    assert found.lost_in_bearings == pytest.approx(0.0914636, abs=1e-6)
    plain = find_timekeeping(lossless.mechanics.load_case())
    assert plain is not None
    assert plain.lost_in_bearings == 0


# ---------------------------------------------------------------------------------------------------------- over a turn


@pytest.mark.parametrize(("at", "gravity", "load"), [(False, False, 10), (True, True, 10), (True, True, 0)])
def test_over_a_turn_a_train_of_constant_efficiency_has_its_mean_torque_at_every_position(
    at: bool, gravity: bool, load: float
) -> None:
    train = three_arbors(eta=0.97, at=at, gravity=gravity, load=load)
    cycle = train.torques(turns=1, samples=30)
    assert np.asarray(cycle.torque) == pytest.approx(float(train.torques().external["A"]), rel=1e-12)
    assert cycle.parts["bearing B"].loss == pytest.approx(2 * pi * float(train.torques().bearings[1].loss), rel=1e-12)


def test_energy_is_balanced_at_every_position() -> None:
    train = geartrain.load("longcase-clock-pivots")
    cycle = train.torques(turns=0.05, samples=200)
    powers, losses = cycle.powers.values, cycle.losses.values
    assert losses.min() >= 0
    largest = np.abs(powers).max()
    assert np.abs(powers.sum(axis=0) - losses.sum(axis=0)).max() < 1e-12 * largest
    assert cycle.parts["bearing centre"].loss > 0


def test_forces_on_a_planet_turn_with_its_carrier_and_weights_do_not() -> None:
    """One planet presses on the carrier's bearing with both meshes, 2 F along the tangent, which turns; its weight does
    not turn.
    """
    train = geartrain.load(
        planets(1, 0, 2, "carrier: {bearing: {coefficient: 0.15, radius: 3 mm}}")
        .replace("planet: {copies", "planet: {mass: 0.5 kg, copies")
        .replace("loads:", "gravity: [0, -1, 0]\nloads:")
    )
    cycle = train.torques(turns=3.5, samples=400)
    turned = 2 * pi * np.asarray(cycle.turns) * 2 / 7
    # the loss of the carrier's bearing gives its friction torque: its speed is 2/7 of that of the sun
    rubbed = cycle.losses.values[-1] / (2 / 7)
    force = (1 + rubbed) / 21e-3  # torque on the carrier over its radius
    # the sun turns forwards and drives the planet forwards along the tangent
    x, y = -force * np.sin(turned), force * np.cos(turned) - 0.5 * STANDARD
    assert rubbed == pytest.approx(friction_circle(MU, 3e-3) * np.hypot(x, y), rel=1e-9)
    assert rubbed.max() / rubbed.min() > 1.1


PAIR = """
links:
  frame: {{}}
  a: {{wheels: {{w: {z[0]}}}}}
  b: {{wheels: {{v: {z[1]}}}, bearing: {{coefficient: 1e-9, radius: 1 mm}}}}
revolutes: {{A: [frame, a], B: [frame, b]}}
axes: {{A: {{position: [0 mm, 0 mm, 0 mm]}}, B: {{position: [{distance} mm, 0 mm, 0 mm]}}}}
gears: [{{pair: [w, v], tooth_form: {form}, friction: {mu}}}]
inputs: {{a: 1}}
loads: {{b: {load} N mm}}
"""
INVOLUTE = "{form: involute, addendum: [0.62, 0.62]}"  # one tooth pair in contact 2 mm about the pitch point
TRIANGULAR = "{form: triangular, half_angle: 30 deg, clearance_factor: 1.01}"
_BASE = 24 * cos(radians(20))  # radius of the driver's base circle, module 2 mm


@pytest.mark.parametrize(
    ("name", "form", "z", "mu", "distance", "load", "angle", "torque", "force"),
    [
        ("A5a", INVOLUTE, (24, 36), 0.1, 60, 1000, -pi / 48 - 2 / _BASE, 676.955475, (13.4574343, 27.9492579)),
        ("A5b", INVOLUTE, (24, 36), 0.1, 60, 1000, -pi / 48 + 2 / _BASE, 676.228668, (7.11558833, 27.9371445)),
        # the centre distance is the sum of both torques over the tangential force
        ("A6a", TRIANGULAR, (48, 96), 0.2, 2.809639307808837, 1, radians(5), 0.518866501, (0.225661120, 0.540591281)),
        ("A6b", TRIANGULAR, (96, 72), 0.2, 1.7296254855060114, 1, radians(-3), 1.35144658, (1.32715237, 1.35951198)),
    ],
)
def test_one_pair_of_teeth_presses_as_statics_of_its_contact_says(
    name: str,
    form: str,
    z: tuple[int, int],
    mu: float,
    distance: float,
    load: float,
    angle: float,
    torque: float,
    force: tuple[float, float],
) -> None:
    """Cases A5 and A6: normal force and friction at one point of contact, before and after the line of centres."""
    train = geartrain.load(PAIR.format(form=form, z=z, mu=mu, distance=repr(distance), load=load))
    balance = find_turn_balance(train.mechanics.load_case(), find_motion_problem(train.mechanics, None), None)
    assert not isinstance(balance, TorqueVerdict)
    found = balance.at(np.array([angle / (2 * pi)]))
    assert 1e3 * found.torque[0, 0] == pytest.approx(torque, rel=2e-9), name
    loaded = found.losses[-1, 0] / abs(found.slipping[-1, 0]) / friction_circle(1e-9, 1e-3)
    assert loaded == pytest.approx(hypot(*force), rel=2e-8), name


@pytest.mark.parametrize("along", [-2.0, -0.7, 0.7, 2.0])
def test_a_ring_and_its_wheel_press_as_statics_of_their_contact_says(along: float) -> None:
    """Involutes 24 in a ring of 60, module 2, at a distance from the pitch point along the line of action [mm]."""
    text = PAIR.format(form="{form: involute, addendum: [0.62, 0.55]}", z=(24, 60), mu=0.1, distance=-36, load=1000)
    train = geartrain.load(text.replace("v: 60", "v: {teeth: 60, internal: true}").replace("b: 1000", "b: -1000"))
    balance = find_turn_balance(train.mechanics.load_case(), find_motion_problem(train.mechanics, None), None)
    assert not isinstance(balance, TorqueVerdict)
    found = balance.at(np.array([(-pi / 48 + along / _BASE) / (2 * pi)]))
    # the wheel turns about the origin and pushes the ring upwards and outwards, to the right
    normal = np.array([sin(radians(20)), cos(radians(20))])
    point = np.array([24, 0]) + along * normal
    arms = point, point + np.array([36, 0])
    slides = np.array([-arms[0][1], arms[0][0]]) - 24 / 60 * np.array([-arms[1][1], arms[1][0]])
    force = normal + 0.1 * slides / np.hypot(*slides)
    first, second = (arm[0] * force[1] - arm[1] * force[0] for arm in arms)
    assert 1e3 * found.torque[0, 0] == pytest.approx(1000 * first / second, rel=1e-9)
    loaded = found.losses[-1, 0] / abs(found.slipping[-1, 0]) / friction_circle(1e-9, 1e-3)
    assert loaded == pytest.approx(1000 * np.hypot(*force) / second, rel=1e-7)


def test_a_locked_bearing_locks_at_every_position() -> None:
    radius = 21 * hypot(1, MU) / MU
    assert arm("[0, 1, 0]", radius=radius).torques(turns=1, samples=10).verdict.kind == "self-locking"
    relieved = arm("[0, -1, 0]", radius=radius)
    assert relieved.torques(turns=1, samples=10).mean == pytest.approx(20e-3 * 6.58536585, rel=3e-9)


# ------------------------------------------------------------------------------------------------------- in time steps


def three_arbors_with_teeth() -> str:
    """Triangular teeth, which collide, with bearings by load and a drag on the last arbor."""
    return TRAIN.format(
        m=[0, 0, 0], p=["0 mm, 0 mm, 0 mm", "25.5 mm, 0 mm, 0 mm", "25.5 mm, 18 mm, 0 mm"], mu=MU, eta=1, at="", way=1,
        load=-1, gravity="tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}\nfriction: 0.1",
    ).replace(", efficiency: 1", "").replace("mass: 0 kg, ", "").replace("    mass: 0 kg\n", "")  # fmt: skip


def with_inertia(train: geartrain.GearTrain, inertia: str = "1 g mm2", **links: str) -> geartrain.GearTrain:
    """The train with a moment of inertia of every link but the frame."""
    declared = train.declaration
    heavy = {name: part.changed(inertia=links.get(name, inertia)) for name, part in declared.links.items()}
    heavy[declared.frame] = declared.links[declared.frame]
    return geartrain.GearTrain(declared.changed(links=heavy))


@pytest.mark.parametrize(
    ("name", "given", "torque"),
    [
        ("A2a", {"c": (43.5, 0)}, 36.7948545),
        ("A2b", {}, 35.9742775),
        ("A2c", {"eta": 0.97}, 38.2580830655),
        ("A2e", {"eta": 0.97, "at": True, "gravity": True}, 38.5982036398),
        ("A2e without load", {"eta": 0.97, "at": True, "gravity": True, "load": 0}, 0.218575661226),
    ],
)
def test_time_steps_settle_at_the_torque_of_statics(name: str, given: dict[str, Any], torque: float) -> None:
    train = three_arbors(**given)
    run = with_inertia(train).dynamics("0.1 turn/s", turns=0.05, skip=0.05, steps=200, fast=False)
    assert 1e3 * run.torque == pytest.approx(torque, rel=2e-9), name
    assert run.torque == pytest.approx(float(train.torques().external["A"]), rel=1e-11), name
    assert run.energy.closure < 1e-12
    assert run.unsolved == 0
    assert run.notes == ()
    lost = sum(float(abs(each.loss)) for each in train.torques().bearings)
    assert run.energy.bearings == pytest.approx(lost * 2 * pi * 0.05, rel=1e-9), name


@pytest.mark.parametrize("copies", [1, 3])
def test_planets_in_time_steps_need_the_torque_of_the_closed_form(copies: int) -> None:
    train = geartrain.load(planets(copies))
    run = with_inertia(train).dynamics("0.1 turn/s", turns=0.1, skip=0.05, steps=200, fast=False)
    # the load of 1 N m on the carrier, ratio 7/2, efficiency of case A3a
    assert run.torque == pytest.approx(2 / 7 / 0.954407449, rel=2e-9)
    assert run.energy.closure < 1e-12


def test_forces_turn_with_their_carrier_in_time_steps() -> None:
    train = geartrain.load(
        planets(1, 0, 2, "carrier: {bearing: {coefficient: 0.15, radius: 3 mm}}")
        .replace("planet: {copies", "planet: {mass: 0.5 kg, copies")
        .replace("loads:", "gravity: [0, -1, 0]\nloads:")
    )
    run = with_inertia(train).dynamics("0.001 turn/s", turns=1.75, skip=0, steps=200, samples=350, fast=False)
    cycle = train.torques(turns=1.75, samples=800)
    # samples are means over an interval
    middle = run.turns - (run.turns[1] - run.turns[0]) / 2
    expected = np.interp(middle, cycle.turns, np.asarray(cycle.torque).ravel())
    assert np.ptp(expected) > 1e-3
    assert run.drive[2:] == pytest.approx(expected[2:], abs=2e-3 * np.ptp(expected))


def test_every_step_loses_energy_in_bearings_and_its_energy_is_balanced() -> None:
    train = with_inertia(geartrain.load(three_arbors_with_teeth()), "1e-6 kg m2")
    model = model_in_time(train.mechanics, None, (), 20.0, 0.3).model
    run = simulate(model, StepPlan(2e-5, 0, 3000, 1, 1))
    energies = np.array([each.energy for each in run.blocks])
    assert len(energies) == 3000
    assert run.numbers[UNSOLVED] == 0
    assert run.counts[:, IMPACT_COUNT].sum() > 10
    assert energies[:, BEARINGS].min() >= 0
    assert energies[:, BEARINGS].sum() > 1e-3 * energies[:, WORK_DRIVE].sum()
    put_in, lost = energies[:, :3].sum(axis=1), energies[:, 3:].sum(axis=1)
    kinetic = np.diff([0.5 * each @ model.mass @ each for each in run.speeds])
    assert (put_in - lost)[1:] == pytest.approx(kinetic, abs=1e-12 * kinetic.max())


def test_a_coefficient_of_0_gives_the_run_without_it_bit_for_bit() -> None:
    plain = three_arbors(eta=0.97, mu=0).declaration
    links = {name: part.changed(bearing=None) for name, part in plain.links.items()}
    bare = geartrain.GearTrain(plain.changed(links=links))
    runs = [
        with_inertia(each).dynamics("1 turn/s", turns=0.1, skip=0, steps=200, fast=False)
        for each in (geartrain.GearTrain(plain), bare)
    ]
    assert runs[0].to_csv() == runs[1].to_csv()
    assert runs[0].energy == runs[1].energy


FREE = """
links: {frame: {}, a: {inertia: 1e-5 kg m2, mass: 2 kg, bearing: {coefficient: 0.15, radius: 1.5 mm}}}
revolutes: {A: [frame, a]}
axes: {A: {position: [0 mm, 0 mm, 0 mm]}}
gravity: [0, -1, 0]
inputs: {a: 1}
rate: 1 turn/s
drive: {torque: 20 N mm}
"""


def test_a_free_arbor_is_slowed_by_the_friction_of_its_weight_over_its_inertia() -> None:
    friction = friction_circle(MU, 1.5e-3) * 2 * STANDARD
    arbor = geartrain.load(FREE).simulation(step=1e-4, fast=False)
    arbor.advance(0.1)
    assert arbor.speed == pytest.approx(0.1 * (20e-3 - friction) / 1e-5, rel=1e-12)
    start = arbor.speed
    arbor.set_drive(0.0)
    arbor.advance(0.05)
    assert arbor.speed == pytest.approx(start - 0.05 * friction / 1e-5, rel=1e-12)
    arbor.advance(0.5)
    assert abs(arbor.speed) < 1e-6
    # static friction by load holds what sliding friction would not move
    arbor.set_drive(0.99 * friction)
    arbor.advance(0.1)
    assert abs(arbor.speed) < 1e-6
    arbor.set_drive(1.01 * friction)
    arbor.advance(0.1)
    assert arbor.speed == pytest.approx(0.1 * 0.01 * friction / 1e-5, rel=1e-6)


IMPACT = """
links:
  frame: {}
  a: {inertia: 2e-6 kg m2, wheels: {w: {teeth: 24, module: 1 mm}}}
  b: {inertia: 5e-6 kg m2, wheels: {v: {teeth: 24, module: 1 mm}}, bearing: {coefficient: 0.15, radius: 4 mm}}
revolutes: {A: [frame, a], B: [frame, b]}
axes: {A: {position: [0 mm, 0 mm, 0 mm]}, B: {position: [24 mm, 0 mm, 0 mm]}}
gears: [{pair: [w, v], tooth_form: {form: involute, backlash: 0.2 mm}}]
inputs: {a: 1}
rate: 1 turn/s
drive: {torque: 1 N mm}
"""


def test_the_impulse_of_an_impact_rubs_in_the_bearing() -> None:
    """The force of the impulse P is P/(r cos 20 deg), and rubs against the rotation: both lose the same impulse."""
    train = geartrain.load(IMPACT).simulation(step=1e-5, fast=False)
    train.advance(0.02)
    train.set_drive(-1e-3)
    seen = []
    while len(seen) < 1500:
        own = train._of.speeds @ train._state.speed
        seen.append([own[train._of.index[link]] for link in "ab"])
        train.advance(1e-5)
    speeds = np.array(seen)
    # driver: reversed torque and impulse; driven wheel: only the impulse and its friction
    jumps = np.diff(speeds, axis=0)
    at = int(np.argmax(np.abs(jumps[:, 1])))
    lost = 5e-6 * abs(jumps[at, 1])
    impulse = 2e-6 * abs(jumps[at, 0] + 1e-3 * 1e-5 / 2e-6)
    friction = friction_circle(MU, 4e-3) / (12e-3 * cos(radians(20)))
    assert lost == pytest.approx(impulse * (1 + friction), rel=1e-6)
    assert lost > 1e-4 * 5e-6


# ---------------------------------------------------------------------------------------------- joints and directions


def test_an_axis_in_the_opposite_direction_changes_no_friction() -> None:
    declared = three_arbors(eta=0.97, at=True, gravity=True).declaration
    found = geartrain.GearTrain(declared).torques()
    axis = declared.axes["B"].changed(direction=(0, 0, -1))
    again = geartrain.GearTrain(declared.changed(axes={**declared.axes, "B": axis})).torques()
    assert float(again.external["A"]) == pytest.approx(float(found.external["A"]), rel=1e-13)
    assert [each.load for each in again.bearings] == pytest.approx([each.load for each in found.bearings], rel=1e-13)


PIPE = """
links:
  frame: {}
  a: {wheels: {w: 24}}
  arbor: {bearing: {coefficient: 0.15, radius: 1 mm}}
  pipe: {wheels: {v: 36}, bearing: {coefficient: 0.15, radius: 3 mm}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, arbor], axis: B}, {pair: [arbor, pipe], axis: B}]
axes: {A: {position: [0 mm, 0 mm, 0 mm]}, B: {position: [60 mm, 0 mm, 0 mm]}}
gears: [w ~ v]
inputs: {a: 1, arbor: ARBOR}
loads: {pipe: -1 N m}
"""


@pytest.mark.parametrize("speed", [Fraction(0), Fraction(-2, 3), Fraction(2, 3)])
def test_a_pipe_rubs_on_its_arbor_with_their_relative_speed_and_presses_on_the_bearing_of_the_arbor(
    speed: Fraction,
) -> None:
    """The pipe turns by -2/3: on a still arbor, with the arbor, and against it."""
    train = geartrain.load(PIPE.replace("ARBOR", str(speed)))
    found = train.torques()
    pipe, arbor = (next(each for each in found.bearings if each.link == link) for link in ("pipe", "arbor"))
    assert pipe.load == arbor.load
    relative = abs(Fraction(-2, 3) - speed)
    size = friction_circle(MU, 3e-3) * pipe.load
    assert float(pipe.loss) == pytest.approx(size * relative, abs=1e-15)
    assert float(arbor.loss) == pytest.approx(friction_circle(MU, 1e-3) * arbor.load * abs(speed), abs=1e-15)
    # the friction of the pipe acts on the arbor, which must be held or driven
    assert abs(float(pipe.torque)) == abs(float(pipe.reaction)) == pytest.approx(size if relative else 0)
    assert float(sum(found.powers.values()) - found.loss) == pytest.approx(0, abs=1e-14)
