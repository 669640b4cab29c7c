"""Energy, amplitude and rate of clocks, against printed figures and limit cycles computed piece by piece."""

from __future__ import annotations

from math import cos, degrees, exp, pi, radians, sin, sqrt
from typing import Any

import pytest
from commands import call
from scipy.optimize import brentq

from geartrain import GearTrain, GearTrainError, load
from geartrain.dynamics.clock_rate import circular_error, escapement_error, find_timekeeping
from geartrain.train import Drive

DAY = 86400
GRAVITY = 9.80665  # m/s2, standard gravity


def clock(**escapement: Any) -> Any:
    """Return the figures of the loaded clock with the given keys of its escapement."""
    data = load("longcase-clock-loaded").declaration.model_dump(exclude_defaults=True)
    data["escapement"] = {"link": "escape", "teeth": 30, "beat": "1 s"} | escapement
    found = figures(GearTrain.declare(data))
    assert found is not None
    return found


def escapement(**keys: Any) -> Any:
    """Return a declared escapement."""
    return GearTrain.declare(
        PAIR | {"escapement": {"link": "b", "teeth": 30, "beat": "1 s"} | keys}
    ).declaration.escapement


def figures(train: GearTrain) -> Any | None:
    setting = train.mechanics.unfolded.load_case(None)
    assert setting is not None
    return find_timekeeping(setting)


PAIR = {
    "links": {"frame": {}, "a": {"wheels": {"p": 60}}, "b": {"wheels": {"w": 20}}},
    "revolutes": {"A": ["frame", "a"], "B": ["frame", "b"]},
    "gears": ["p ~ w"],
    "inputs": {"a": 1},
}
SWING = {
    "efficiency": "40 %",
    "pendulum": {"length": f"{1000 * GRAVITY / pi**2:.12g} mm", "bob": "4.5 kg", "quality": 5000},
}


def test_d1_power_of_the_weight_and_its_descent() -> None:
    assert clock().power == pytest.approx(1.06901417e-4, abs=5e-13)
    hung = figures(load("longcase-clock"))
    assert hung is not None
    assert hung.power == pytest.approx(1.06874115e-4, abs=5e-13)
    assert hung.descent is not None
    assert 3.6e6 * hung.descent == pytest.approx(6.64970445, abs=5e-9)  # mm/h
    assert 8 * DAY * hung.descent == pytest.approx(1.27674325, abs=5e-9)
    # 16 turns of the drum are eight days
    assert hung.going_time == pytest.approx(1.28 / 1.27674325 * 8 * DAY, rel=1e-8)


def test_d2_energy_of_a_beat() -> None:
    found = clock()
    assert found.efficiency == pytest.approx(0.901141, abs=5e-7)
    # the printed energy is that of the printed efficiency
    assert found.beat_energy == pytest.approx(9.63332495e-5, rel=5e-7)
    # in one beat the weight gives this energy divided by the efficiency
    assert found.beat_energy / found.efficiency == pytest.approx(found.power, rel=1e-12)


def test_d6_amplitude() -> None:
    amplitude = clock(**SWING).amplitude
    assert amplitude is not None
    assert degrees(amplitude) == pytest.approx(3.03067501, rel=5e-7)


def test_d7_minimum_torque() -> None:
    found = clock(**SWING, arc="1.5 deg")
    assert found.minimum_torque is not None
    assert 1000 * found.minimum_torque == pytest.approx(180.080869, rel=5e-7)
    assert found.minimum_weight == pytest.approx(1.45, abs=5e-3)
    assert found.goes


def test_constant_friction_is_part_of_the_minimum_torque() -> None:
    """With the minimum torque as its load, the clock has exactly the amplitude at which it is released."""
    data = load("longcase-clock-loaded").declaration.model_dump(exclude_defaults=True)
    data["escapement"] = {"link": "escape", "teeth": 30, "beat": "1 s", "arc": "1.5 deg"} | SWING
    data["links"]["centre"]["bearing"] = "10 N mm"
    found = figures(GearTrain.declare(data))
    assert found is not None
    assert found.minimum_torque is not None
    data["loads"] = {"great": f"{-1000 * found.minimum_torque:.15g} N mm"}
    least = figures(GearTrain.declare(data))
    assert least is not None
    assert least.amplitude == pytest.approx(radians(1.5), rel=1e-9)
    data["links"]["centre"]["bearing"] = "70 N mm"
    stopped = figures(GearTrain.declare(data))
    assert stopped is None or stopped.goes is False


@pytest.mark.parametrize(("angle", "loss"), [(1, 1.64496277), (2, 6.58019562), (3, 14.8067323), (5, 41.1413028)])
def test_d8_circular_error(angle: float, loss: float) -> None:
    rate = circular_error(radians(angle))
    # the printed figures are relative to the period of small oscillations
    assert DAY * (1 / (1 + rate) - 1) == pytest.approx(loss, abs=5e-8)
    # arithmetic-geometric mean of 1 and cos(A/2)
    a, b = 1.0, cos(radians(angle) / 2)
    for _ in range(8):
        a, b = (a + b) / 2, sqrt(a * b)
    assert 1 + rate == pytest.approx(a, rel=1e-14)


@pytest.mark.parametrize(("rod", "loss"), [("steel", 0.4968), ("brass", 0.8208), ("pine", 0.1728), ("invar", 0.0432)])
def test_d9_thermal_expansion(rod: str, loss: float) -> None:
    assert clock(pendulum={"length": "994 mm", "rod": rod}).thermal == pytest.approx(-loss, abs=5e-5)


def test_d10_and_d11_escapement_errors() -> None:
    dead = escapement(deadbeat=["0.5 deg", "1 deg"])
    rate = escapement_error(dead, radians(2), 5000)
    assert rate is not None
    assert DAY * rate == pytest.approx(-1.17757939, abs=5e-8)
    recoil = escapement(recoil="1 deg")
    rate, more = (escapement_error(recoil, radians(3) * factor, 3000) for factor in (1, sqrt(1.1)))
    assert rate is not None
    assert more is not None
    assert DAY * rate == pytest.approx(40.7293506, abs=5e-7)
    assert DAY * (more - rate) == pytest.approx(2.22997901, abs=5e-8)
    periods = [1 / (1 + circular_error(radians(3) * factor)) for factor in (1, sqrt(1.1))]
    assert DAY * (periods[0] - periods[1]) == pytest.approx(-1.48092911, abs=5e-8)
    assert escapement_error(dead, radians(0.9), 5000) is None


Piece = tuple[float | None, float]
"""End of a piece of the swing from -A to A [rad], None for the last, and the torque in it relative to a strength."""


def rest_of(x: float, v: float, force: float, end: float | None, quality: float) -> tuple[float, float, float]:
    """Return x, v and the time when x'' + x'/Q + x = force comes to rest, or to the position `end`."""
    damping = 1 / (2 * quality)
    own = sqrt(1 - damping**2)

    def at(time: float) -> tuple[float, float]:
        decay, c, s, offset = exp(-damping * time), cos(own * time), sin(own * time), x - force
        here = force + decay * (offset * c + (v + damping * offset) / own * s)
        return here, decay * (v * c - (offset + damping * v) / own * s)

    low = 0.05 if end is None else 0.0
    time = brentq(
        lambda each: at(each)[1] if end is None else at(each)[0] - end, low, 3.1 if end is None else 2.5, xtol=1e-15
    )
    return *at(time), time


def limit_cycle(pieces: list[Piece], amplitude: float, quality: float) -> float:
    """Return the rate [s/day] of a damped oscillator that a torque keeps at an amplitude, relative to the undamped
    period.
    """

    def half(strength: float) -> tuple[float, float]:
        x, v, total = -amplitude, 0.0, 0.0
        for end, force in pieces:
            x, v, time = rest_of(x, v, strength * force, end, quality)
            total += time
        return x, total

    # work of the torque equals the loss of half a period, pi A^2/(2 Q)
    ends = [-amplitude, *(end for end, _ in pieces if end is not None), amplitude]
    work = sum(force * (high - low) for (_, force), low, high in zip(pieces, ends[:-1], ends[1:], strict=True))
    guess = pi * amplitude**2 / (2 * quality * work)
    strength = brentq(lambda each: half(each)[0] - amplitude, guess / 2, 2 * guess, xtol=1e-18)
    return DAY * (pi / half(strength)[1] - 1)


def test_d10_and_d11_are_the_rates_of_limit_cycles() -> None:
    dead = limit_cycle([(radians(-0.5), 0.0), (radians(1), 1.0), (None, 0.0)], radians(2), 5000)
    recoil = limit_cycle([(radians(1), 1.0), (None, -1.0)], radians(3), 3000)
    assert (dead, recoil) == pytest.approx((-1.17764, 40.73994), abs=6e-6)


def test_d12_going_time() -> None:
    drive = Drive(weight="5.9 kg", drum="25.4 mm", falls=2, drop="1.3 m")
    assert drive.drop is not None
    assert drive.arm is not None
    turns = drive.drop.si / (2 * pi * drive.arm)
    assert turns == pytest.approx(16.2914509, abs=5e-8)
    assert turns / 2 == pytest.approx(8.14572543, abs=5e-9)


def test_a_weight_that_slides_drives_as_one_on_a_drum() -> None:
    hung, slid = figures(load("longcase-clock")), figures(load("longcase-clock-weight"))
    assert hung is not None
    assert slid is not None
    assert slid.torque == pytest.approx(5.9 * GRAVITY, rel=1e-12)
    assert slid.power == pytest.approx(hung.power, rel=1e-6)
    assert slid.descent == pytest.approx(hung.descent, rel=1e-6)


def test_the_report_says_whether_a_clock_goes() -> None:
    page = call("report", "longcase-clock-loaded", "--section", "Timekeeping").output
    assert "The clock goes: at least 1.446 kg is needed at 'great'." in page
    assert "Timekeeping" not in call("report", "watch-going-train").output


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"efficiency": "140 %"}, "above 0 and at most 1"),
        ({"deadbeat": ["0.5 deg", "1 deg"], "recoil": "1 deg"}, "exactly one kind"),
        ({"pendulum": {"bob": "4 kg"}}, "'length' is missing"),
        ({"pendulum": "700 mm"}, "does not match the beat"),
    ],
)
def test_mistakes_are_named(keys: dict[str, Any], words: str) -> None:
    with pytest.raises(GearTrainError, match=words):
        clock(**keys)


@pytest.mark.parametrize("keys", [{"torque": "1 N m", "drop": "1 m"}, {"torque": "1 N m", "drum": "1 mm"}])
def test_sizes_of_a_line_need_a_weight(keys: dict[str, str]) -> None:
    with pytest.raises(Exception, match="is given without `weight`"):
        Drive.model_validate(keys)


@pytest.mark.parametrize(
    "changes",
    [
        {"loads": {"escape": "-1 N mm"}, "solve_for": None},  # what the escape wheel receives is then unknown
        {"loads": {"great": "1 N mm"}},  # a load that resists
        {"loads": {"great": -0.7}, "drive": None},
        {"loads": None, "drive": {"torque": 0.7}},
    ],
)
def test_a_torque_at_the_escape_wheel_without_a_known_drive_is_not_computed(changes: dict[str, Any]) -> None:
    assert figures(load("longcase-clock-loaded").with_changes(changes)) is None
