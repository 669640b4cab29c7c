"""Torque over a turn: closed forms of pins, printed cases, conservation, and the balance of mean torques."""

from __future__ import annotations

from fractions import Fraction
from math import acos, asin, log, pi, sqrt

import numpy as np
import pytest
from dynamics.test_energy import lossy
from models import load
from sampling import all_but

from geartrain import GearTrain
from geartrain.dynamics import TorqueCycle
from geartrain.dynamics.turn import find_torque_period
from geartrain.errors import GearTrainError, QuestionError

_TWO_LINKS = """
links: {{frame: {{}}, a: {{}}, b: {{{bearing}}}}}
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}]
couplings: [{{kind: {kind}, pin: {pin}, slot: {slot}, pin_radius: {r} mm, offset: {e} mm, friction: {f}}}]
inputs: {{a: 1}}
outputs: {{b: {{}}}}
{loads}
"""


def pin_train(r: float, e: float, f: float, loads: str = "", bearing: str = "", driver: str = "pin") -> GearTrain:
    """Link a drives link b by a pin in a slot."""
    pin, slot = ("a", "b") if driver == "pin" else ("b", "a")
    kind = "pin_and_slot" if r > e else "pin_follower"
    return load(_TWO_LINKS.format(kind=kind, pin=pin, slot=slot, r=r, e=e, f=f, loads=loads, bearing=bearing))


def cycle(train: GearTrain, turns: float = 1, samples: int = 1000) -> TorqueCycle:
    return train.torques(turns=turns, samples=samples)


def torque(found: TorqueCycle) -> tuple[float, float, float]:
    assert found.mean is not None
    return found.mean, found.maximum.torque, found.minimum.torque


def test_a_pin_that_drives_a_slot_peaks_at_five_times_its_mean() -> None:
    r, e, f = 10, 8, 0.3
    found = cycle(pin_train(r, e, f, "loads: {b: -10 N m}"))
    mean, maximum, _ = torque(found)
    assert mean == pytest.approx(10 * (1 + f / pi * log((r + e) / (r - e))), rel=1e-9)
    assert maximum == pytest.approx(50.9784589, abs=5e-8)
    assert min(found.maximum.turns, 1 - found.maximum.turns) * 2 * pi == pytest.approx(0.032612, abs=1e-6)
    assert found.efficiency == pytest.approx(0.8265696, abs=5e-8)


@pytest.mark.parametrize(("f", "mean", "maximum"), [(0.3, 12.994123, 21.847911), (0.7, 36.9620, 153.3510)])
def test_a_slot_that_drives_its_pin(f: float, mean: float, maximum: float) -> None:
    found = torque(cycle(pin_train(10, 8, f, "loads: {b: -10 N m}", driver="slot")))
    assert found[0] == pytest.approx(mean, rel=2e-7)
    assert found[1] == pytest.approx(maximum, rel=4e-7)


def test_a_slot_locks_where_friction_holds_the_pin() -> None:
    """Where |sin psi| >= (r/e) / sqrt(1 + f^2), from f = sqrt(r^2 - e^2)/e = 0.75 on."""
    assert not cycle(pin_train(10, 8, 0.7499, "loads: {b: -10 N m}", driver="slot")).locked_share
    found = cycle(pin_train(10, 8, 0.8, "loads: {b: -10 N m}", driver="slot"))
    share = 1 - 2 / pi * asin(10 / 8 / sqrt(1 + 0.8**2))
    assert found.locked_share == pytest.approx(share, abs=1e-9)
    assert found.locked_share == pytest.approx(0.139505, abs=5e-7)
    assert (found.verdict.kind, found.mean, found.efficiency, found.starting) == ("self-locking", None, None, None)
    assert np.isnan(found.torque).any()
    assert len(found.locked) == 2


def test_a_weight_on_a_follower_drives_it_back_and_locks_it_near_its_dead_points() -> None:
    r, e, f = 6, 10, 0.2
    found = cycle(pin_train(r, e, f, "loads: {b: -10 N m}"))
    mean, maximum, minimum = torque(found)
    assert mean == pytest.approx(10 * f / pi * log((e + r) / (e - r)), rel=1e-9)
    assert maximum == pytest.approx(3.9356616, abs=5e-8)
    assert minimum == pytest.approx(-15, abs=1e-7)
    assert found.held_share == pytest.approx(0.0582218, abs=5e-8)
    assert found.energy.put_in / (2 * pi) == pytest.approx(2.5367917, abs=5e-8)
    assert found.energy.returned / (2 * pi) == pytest.approx(1.6542493, abs=5e-8)
    assert found.turns is not None
    weighed = found.powers["b"] > 0
    steps = np.diff(found.turns)
    assert float(steps[weighed[1:] & weighed[:-1]].sum()) == pytest.approx(acos(r / e) / pi, abs=1e-6)


def test_drag_on_a_follower_turns_round_at_its_dead_points() -> None:
    r, e, f = 6, 10, 0.2
    found = cycle(pin_train(r, e, f, bearing="bearing: 1 N m"))
    mean, maximum, minimum = torque(found)
    assert mean == pytest.approx(2 / pi * asin(r / e) + f / pi * log((e + r) / (e - r)), rel=1e-9)
    assert (mean, maximum) == (pytest.approx(0.4979198, abs=5e-8), pytest.approx(1.5185660, abs=3e-7))
    assert minimum == pytest.approx(0.15, abs=1e-8)
    assert torque(cycle(pin_train(r, e, 0, bearing="bearing: 1 N m")))[0] == pytest.approx(0.4096655, abs=5e-8)
    assert found.flank_changes == {"a~b": 2}


def test_a_constant_torque_of_the_driver_has_the_mean_of_the_efficiency() -> None:
    """Equation (34) of the note on ancient gears is for this case, and no other."""
    train = pin_train(10, 8, 0.3, "loads: {a: 10 N m}")
    found = train.torques(turns=1, samples=1000, of="b")
    assert found.link == "b"
    assert found.efficiency == pytest.approx(0.8357499, abs=5e-8)
    assert found.efficiency == pytest.approx(float(train.torques().efficiency or 0), rel=1e-8)
    with pytest.raises(QuestionError, match="carries a load"):
        train.torques(turns=1, of="a")


def test_what_rests_is_harder_to_start() -> None:
    """At S the start takes 1 + f_s |tan d| times r cos d/rho of the load: the peak of sliding with f_s."""
    text = "loads: {b: -10 N m}"
    moving, resting = cycle(pin_train(10, 8, 0.2, text)), cycle(pin_train(10, 8, 0.3, text))
    train = _TWO_LINKS.format(kind="pin_and_slot", pin="a", slot="b", r=10, e=8, f="{sliding: 0.2, static: 0.3}",
                              loads=text, bearing="bearing: {sliding: 1 N m, static: 2 N m}")  # fmt: skip
    found = cycle(load(train))
    assert found.starting.torque == pytest.approx(1.2 * torque(resting)[1], rel=1e-9)
    assert torque(found)[1] == pytest.approx(1.1 * torque(moving)[1], rel=1e-9)


def test_a_bearing_behind_a_retrograde_pointer_takes_twice_what_its_mean_speed_tells() -> None:
    train = load("extends: freeth-2021\nlinks: {saturn: {bearing: 1 N mm}}\n")
    naive = abs(float(train.torques().external["a"]))
    found = cycle(train, 442 / 427)
    mean, maximum, minimum = torque(found)
    assert (mean, maximum) == (pytest.approx(1.50887e-5, rel=4e-7), pytest.approx(2.6959e-5, rel=2e-6))
    assert mean / naive == pytest.approx(2.065600, abs=5e-7)
    assert maximum / naive == pytest.approx(3.690611, abs=5e-7)
    assert minimum == pytest.approx(0, abs=1e-9)


_TEETH = "tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}\nfriction: {sliding: 0.2, static: 0.25}\n"
CONSERVING = {
    "four pairs in a row": "extends: moon-triangular\nloads: {moon: -1 N mm}\nlinks: {d: {bearing: 1 N mm}}\n",
    "bearings of planets, and rest in the play": f"""
extends: freeth-2021
{_TEETH}links:
  moon: {{bearing: 1 N mm}}
  mars: {{bearing: 1 N mm}}
  saturn: {{bearing: {{sliding: 1 N mm, static: 2 N mm}}}}
""",
    "three pairs that depend on each other": f"extends: price-1974\n{_TEETH}links: {{moon: {{bearing: 1 N mm}}}}\n",
    "a pair that moves its own driver": f"extends: prague-orloj\n{_TEETH}links: {{zodiac: {{bearing: 1 N mm}}}}\n",
    "equal planets on opposite axes": """
extends: bevel-differential
remove: {states: [straight, turn, one wheel held, crown held]}
axes: {far: {direction: [1, 0, 0]}}
links: {crown: {bearing: 1 N mm}, right: {bearing: 1 N mm}, spider: {bearing: 1 N mm}, hand: {}}
revolutes: {far: [case, hand]}
couplings: [{kind: pin_and_slot, pin: right, slot: hand, pin_radius: 10 mm, offset: 2 mm}]
inputs: {shaft: 41}
fixed: [left]
outputs: {hand: {}}
loads: {hand: -1 N m}
""",
}


@pytest.mark.parametrize("name", all_but({"bearings of planets, and rest in the play"}, CONSERVING))
def test_what_goes_in_comes_out_or_is_lost_at_every_position(name: str) -> None:
    found = load(CONSERVING[name]).torques(turns=2 if name == "four pairs in a row" else 0.02, samples=500)
    lost = found.losses.values.sum(axis=0)
    maximum = np.abs(found.powers.values).max()
    assert maximum > 0
    assert np.abs(found.powers.values.sum(axis=0) - lost).max() < 1e-11 * maximum
    assert lost.min() > 0
    if found.verdict.kind == "determined":  # where a link rests in its play single pairs may seem to give power
        assert found.losses.values.min() > -1e-12 * maximum


@pytest.mark.slow
def test_four_pairs_over_their_whole_period() -> None:
    # the case measures the angle of each driver from the line of centres, so the pairs before it move its first tooth
    phases = {"[b2, c1]": 0.08621863789, "[c2, d1]": 0.65281115565, "[d2, e]": 0.87273624334}
    gears = ", ".join(f"{{pair: {pair}, phase: {phase}}}" for pair, phase in phases.items())
    train = load(f"extends: moon-triangular\nloads: {{moon: -1 N mm}}\ngears: [{gears}]\n")
    found = cycle(train, 95, 2000)
    mean, maximum, minimum = torque(found)
    assert mean == pytest.approx(3.55536e-3, abs=5e-9)
    assert found.efficiency == pytest.approx(0.752015, abs=2e-6)
    assert maximum == pytest.approx(7.77e-3, abs=1e-5)
    assert minimum == pytest.approx(1.899e-3, abs=2e-6)
    assert found.loses_most == "c2~d1"


_NEAR = """
links: {frame: {wheels: {r: 32}}, sun: {wheels: {s: 30}}, planet: {wheels: {p: 29, q: 30}}, arm: {}}
revolutes: [{pair: [frame, sun], axis: A}, {pair: [frame, arm], axis: A}, {pair: [arm, planet], axis: P}]
gears: [{pair: [s, p], efficiency: 0.9}, {pair: [q, r], efficiency: 0.9}]
inputs: {sun: -1}
"""


def test_every_pattern_that_balances_is_kept() -> None:
    """Power 3.66332 leaves at the sun in one, 6.06796 enters there in the other: docs/torques.md, section 5."""
    found = cycle(load(_NEAR + "loads: {arm: 1 N m}"))
    assert (found.verdict.kind, found.ambiguous_share) == ("ambiguous", pytest.approx(1))
    assert torque(found) == (
        pytest.approx(-3.66332, abs=5e-6),
        pytest.approx(6.06796, abs=5e-6),
        pytest.approx(-3.66332, abs=5e-6),
    )
    assert cycle(load(_NEAR + "loads: {arm: -1 N m}")).locked_share == pytest.approx(1)


def test_a_train_of_declared_efficiencies_has_the_torques_of_its_means_everywhere() -> None:
    train = load(
        """
        extends: planetary-24-18-60
        gears: [{pair: [s, p], efficiency: 0.98}, {pair: [p, ring], efficiency: {forward: 0.97, backward: 0.95}}]
        links: {carrier: {bearing: 0.07 N m}}
        loads: {carrier: -10 N m}
        """
    )
    exact = float(train.torques().external["sun"])
    found = cycle(train)
    assert torque(found) == pytest.approx((exact,) * 3, rel=1e-12)
    assert found.verdict.kind == "determined"


def test_random_trains_of_declared_efficiencies_have_the_torques_of_their_means(seeds: range) -> None:
    """Also backwards, with several inputs, bevels, carriers on carriers: exact fractions stand beside."""
    kinds: dict[str, int] = {}
    for seed in seeds[:: max(1, len(seeds) // 60)]:
        data = lossy(seed, oblique=bool(seed % 2))
        for coupling in data["couplings"]:
            del coupling["pin_radius"], coupling["offset"], coupling["friction"]
        train = GearTrain.declare(data)
        exact = train.torques()
        if not any(Fraction(speed) for speed in data["inputs"].values()) or exact.verdict.kind == "indeterminate":
            continue
        try:
            found = train.torques(turns=1, samples=5)
        except GearTrainError:
            assert train.mobility.redundant, seed
            continue
        kinds[found.verdict.kind] = kinds.get(found.verdict.kind, 0) + 1
        if exact.verdict.kind in ("self-locking", "stalled"):
            assert (found.verdict.kind, found.locked_share) == ("self-locking", pytest.approx(1)), seed
        elif exact.verdict:
            own = float(exact.external[found.link]) * (-1 if exact.speeds[found.link] < 0 else 1)
            scale = max(abs(float(each)) for each in exact.external.values())
            assert found.mean == pytest.approx(own, rel=1e-12, abs=1e-12 * scale), seed
        else:
            assert found.verdict.kind == exact.verdict.kind, seed
    assert kinds["determined"] > 20, kinds


_TEETH_AND_PIN = """
links: {frame: {}, a: {wheels: {p: 24}}, b: {angle: ANGLE rad, wheels: {q: 36}}, c: {bearing: 0.5 N m}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}, {pair: [frame, c], axis: C}]
gears: [{pair: [p, q], tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}, friction: 0.1}]
couplings: [{kind: pin_and_slot, pin: b, slot: c, pin_radius: 10 mm, offset: 5 mm, friction: 0.2}]
inputs: {a: 1}
outputs: {c: {}}
loads: {c: 3 N m}
"""


def test_teeth_before_a_pin_before_a_bearing() -> None:
    """The pin on its slot's side where the law's driven angle is 0, as the case was worked out by plain statics."""
    (mesh,) = load(_TEETH_AND_PIN.replace("ANGLE", "0")).meshes
    train = load(_TEETH_AND_PIN.replace("ANGLE", f"{-float(mesh.transmission.error(0.0)):.15f}"))
    found = cycle(train, 3, 3000)
    mean, maximum, minimum = torque(found)
    assert mean == pytest.approx(2.55551, abs=5e-6)
    assert (maximum, minimum) == pytest.approx((5.5982, 1.3179), abs=5e-5)
    assert found.efficiency == pytest.approx(0.782622, abs=2e-6)
    assert mean == pytest.approx(float(train.torques().external["a"]), rel=5e-6)


def test_without_friction_a_constant_load_asks_for_its_mean_ratio() -> None:
    text = (
        _TEETH_AND_PIN.replace("ANGLE", "0")
        .replace("friction: 0.1", "friction: 0")
        .replace("friction: 0.2", "friction: 0")
    )
    found = cycle(load(text.replace("{bearing: 0.5 N m}", "{}")), 3)
    assert found.mean == pytest.approx(3 * 24 / 36, rel=1e-8)
    assert found.efficiency == pytest.approx(1, rel=1e-12)


def test_drag_goes_with_the_speed_of_the_moment() -> None:
    """c w^2 over w of the crank: without friction the crank gives c w theta'^2, and a start does not drag."""
    train = pin_train(10, 5, 0, "loads: {b: -1 N m}\nrate: 2 turn/s", bearing="drag: 0.01 N m s/rad")
    found = cycle(train, 1, 1000)
    w = 4 * pi
    # mean of theta'^2 of a pin in a slot: by 4096 equal samples of a smooth periodic function
    S = np.arange(4096) * (2 * pi / 4096)
    tau = 10 * (10 - 5 * np.cos(S)) / (100 + 25 - 100 * np.cos(S))
    assert found.mean == pytest.approx(1 + 0.01 * w * float(np.mean(tau**2)), rel=1e-9)
    assert found.starting.torque == pytest.approx(2, rel=1e-8)
    assert [each.what for each in train.torques().neglected] == ["viscous drag", "variation within a turn"]


def test_other_names_and_another_order_change_nothing() -> None:
    text = _TEETH_AND_PIN.replace("ANGLE", "0")
    renamed = text.replace("b:", "zz:").replace("b]", "zz]").replace("pin: b", "pin: zz").replace("p:", "late:")
    renamed = renamed.replace("[p, q]", "[late, q]").replace("{pair: [frame, a], axis: A}, ", "")
    renamed = renamed.replace("axis: C}]", "axis: C}, {pair: [a, frame], axis: A}]")
    ours, theirs = cycle(load(text), 3), cycle(load(renamed), 3)
    assert torque(theirs) == pytest.approx(torque(ours), rel=1e-12)


def test_a_run_goes_forward() -> None:
    with pytest.raises(QuestionError, match="turns = -1"):
        cycle(pin_train(10, 8, 0.3, "loads: {b: -10 N m}"), -1)


# ---------------------------------------------------------------------------------------------------- period of a run


DAYS = """
links: {frame: {}, day: {wheels: {a: 10}}, slow: {wheels: {b: 10000}}, slot: {bearing: 1 N mm}}
revolutes: [{pair: [frame, day], axis: A}, {pair: [frame, slow], axis: B}, {pair: [frame, slot], axis: C}]
gears: [{pair: [a, b]}]
couplings: [{kind: pin_and_slot, pin: slow, slot: slot, pin_radius: 10 mm, offset: 2 mm}]
unit: {per: 1 d}
inputs: {day: 1}
outputs: {slot: {}}
"""


@pytest.mark.parametrize(
    ("text", "period"),
    [
        # between weight and escape wheel 8, 60 and 420 teeth pass in an hour: a quarter of each in a quarter
        ("extends: longcase-clock-bs978\nloads: {escape: -1 N mm}\n", Fraction(1, 4)),
        # constant ratios and friction
        ("extends: longcase-clock\nloads: {escape: -1 N mm}\n", None),
        # a pin that comes round in a thousand days
        (DAYS, 1000),
    ],
)
def test_a_torque_repeats_after_the_common_period_of_its_pairs(text: str, period: Fraction | None) -> None:
    assert find_torque_period(load(text).mechanics) == period


def test_teeth_that_keep_their_ratio_repeat_too_where_their_friction_is_uneven() -> None:
    train = load("extends: longcase-clock-cycloidal\nfriction: 0.2\nloads: {escape: -1 N mm}\n")
    found = train.torques(turns=1, samples=200)
    assert find_torque_period(train.mechanics) == found.period == 0.25
    for turns in (0.0321, 0.2, 0.61):
        assert found.at(turns) == pytest.approx(found.at(turns + 0.25), rel=1e-6)
