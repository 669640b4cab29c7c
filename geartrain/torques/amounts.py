"""Amounts of power for a reader: watts where torques and speeds are real, and shares of the whole."""

from __future__ import annotations

from fractions import Fraction

from geartrain.quantity import RADIANS_PER_TURN
from geartrain.train import Case, Train

_PREFIXES = ((1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"))


def in_newton_metres(train: Train, state: str | None) -> bool:
    """True if the loads and bearings of one state are given in units."""
    own = train.states[state].loads if state is not None else None
    loads = train.loads if own is None else own
    bearings = (part.bearing for part in train.links.values() if part.bearing is not None)
    torques = [torque for torque in (*loads.values(), *bearings) if torque.value]
    return bool(torques) and all(torque.unit is not None for torque in torques)


def watts_per_unit(train: Train, case: Case) -> float | None:
    """Watts in one unit of power: N m times the train's unit of speed; None where torques or speeds are plain numbers.

    Speeds are real where the train has a `rate`, that of the first input that turns, or its inputs have units.
    """
    if not in_newton_metres(train, case.state):
        return None
    lead = next((speed for speed in case.inputs.values() if speed), None)
    if train.rate is not None and train.rate.unit is not None and lead is not None:
        return abs(train.rate.si / float(lead))
    if not train.input_unit or train.unit_speed is None:
        return None
    return float(train.unit_speed * RADIANS_PER_TURN)


def in_watts(power: float) -> str:
    """Watts with the prefix that keeps the number short: `2.5 mW`."""
    for size, prefix in _PREFIXES:
        if abs(power) >= size:
            return f"{power / size:.4g} {prefix}W"
    return f"{power * 1e9:.4g} nW" if power else "0 W"


def share(part: Fraction, digits: int = 4) -> str:
    """A share in percent: `97.87 %`; many times the whole as a multiple."""
    return f"{float(100 * part):.{digits}g} %" if abs(part) < 10 else f"{float(part):.{digits}g} times"


def share_of(part: Fraction, whole: str) -> str:
    """`51.75 % of the power in`, `258.8 times the power in`."""
    return f"{share(part)} of {whole}" if abs(part) < 10 else f"{share(part)} {whole}"
