"""Standard teeth for pairs that declare no tooth form: involutes without profile shift.

Each wheel has the largest addendum, up to 1 module, with which it runs with all its mates. Drawings, the viewer,
layouts and exports of wheels use standard teeth.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache

from geartrain.errors import GearTrainError, Problem
from geartrain.teeth.conjugate.conjugate_form import conjugate_pair_of
from geartrain.teeth.conjugate.wheel_pair import WheelPair
from geartrain.teeth.involute import Involute

ADDENDUM, DEDENDUM = 1.0, 1.25  # modules: maximum addendum, and dedendum of all wheels
BACKLASH = 0.05  # modules: default backlash of a pair of such wheels when they are cut
_ANGLES = (20, 25, 30, 32)  # deg: the smallest at which all connected wheels run is used
_ADDENDA = (ADDENDUM, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3)  # modules: the largest with which a pair runs is used
MOST_TEETH = 10_000


@dataclass(frozen=True, slots=True)
class UndeclaredWheel:
    """Wheel that declares no tooth form: its tooth number, and whether it is a ring."""

    z: int
    internal: bool = False


@dataclass(frozen=True, slots=True)
class StandardTeeth:
    """Standard teeth of a wheel: pressure angle [deg] and addendum [module]."""

    angle: int
    addendum: float

    @property
    def words(self) -> str:
        """Description of the teeth for reports."""
        return f"involute, {self.angle} degrees (no form is declared)"


def standard_teeth(gears: Mapping[str, UndeclaredWheel], pairs: Iterable[tuple[str, str]]) -> dict[str, StandardTeeth]:
    """Return the standard teeth of all wheels by name of the wheel.

    Wheels that are connected by `pairs` have the same pressure angle, and each has the largest addendum with which it
    runs with all its mates. If no pressure angle lets all pairs run, 20 degrees is used, and the verdict on a pair that
    does not run gives the reason.
    """
    mates: dict[str, list[str]] = {name: [] for name in gears}
    for first, second in pairs:
        mates[first].append(second)
        mates[second].append(first)
    found: dict[str, StandardTeeth] = {}
    for name in gears:
        if name not in found:
            group = _connected(name, mates)
            designs = (_design(group, gears, mates, angle) for angle in _ANGLES)
            runs = next((design for design in designs if design is not None), None)
            found |= runs or {each: StandardTeeth(_ANGLES[0], ADDENDUM) for each in group}
    return found


def _connected(first: str, mates: Mapping[str, list[str]]) -> list[str]:
    known, waiting = {first: None}, [first]
    while waiting:
        for mate in mates[waiting.pop()]:
            if mate not in known:
                known[mate] = None
                waiting.append(mate)
    return list(known)


def _design(
    group: Iterable[str], gears: Mapping[str, UndeclaredWheel], mates: Mapping[str, list[str]], angle: int
) -> dict[str, StandardTeeth] | None:
    """Return the teeth of connected wheels by name; None if some pair cannot run at this pressure angle [deg]."""
    addenda: dict[str, float] = {}
    # each pair once, whichever of its wheels is visited first
    edges = {(name, mate) for name in group for mate in mates[name] if name <= mate}
    for name in group:
        heights = [_tallest(*_ring_last(gears[name], gears[mate]), angle) for mate in mates[name]]
        if None in heights:
            return None
        # the mate with the lowest limit decides, since a wheel has one addendum
        addenda[name] = min((height for height in heights if height is not None), default=ADDENDUM)
    # each addendum is the minimum over all mates of a wheel, so that pairs must be checked with both addenda
    for first, second in edges:
        own, mate = (first, second) if not gears[first].internal else (second, first)
        if not _runs(gears[own], gears[mate], angle, addenda[own], addenda[mate]):
            return None
    return {name: StandardTeeth(angle, addendum) for name, addendum in addenda.items()}


def _ring_last(first: UndeclaredWheel, second: UndeclaredWheel) -> tuple[UndeclaredWheel, UndeclaredWheel]:
    return (second, first) if first.internal else (first, second)


def _tallest(first: UndeclaredWheel, second: UndeclaredWheel, angle: int) -> float | None:
    """Return the largest addendum with which a pair runs [module]; None if it runs with no addendum of the list."""
    return next((height for height in _ADDENDA if _runs(first, second, angle, height, height)), None)


# pairs with equal tooth numbers recur in a train and in a search
@lru_cache(maxsize=65536)
def _runs(first: UndeclaredWheel, second: UndeclaredWheel, angle: int, *addenda: float) -> bool:
    try:
        check_size(max(first.z, second.z))
        form = _form(angle, addenda[0], addenda[1], 0.0)
        return not conjugate_pair_of(form, WheelPair(first.z, second.z, second.internal)).faults
    except GearTrainError:
        return False


def lone_mate(gear: UndeclaredWheel) -> UndeclaredWheel:
    """Return a mate for a wheel without a mate: an equal wheel, or for a ring gear a pinion with half as many teeth,
    rounded down.
    """
    return UndeclaredWheel(max(gear.z // 2, 1)) if gear.internal else gear


def standard_form(first: StandardTeeth, second: StandardTeeth, backlash: float) -> Involute:
    """Return the tooth form of a pair of standard wheels with the given backlash [module]."""
    return _form(first.angle, first.addendum, second.addendum, backlash)


def check_size(z: int) -> None:
    """Raise `GearTrainError` for a wheel of more than `MOST_TEETH` teeth."""
    if z > MOST_TEETH:
        what, why = (
            f"the teeth of a wheel with {z} teeth cannot be built",
            f"the maximum is {MOST_TEETH} teeth",
        )
        raise GearTrainError(Problem(what, why, "represent the wheel by a plain disc"))


@lru_cache(maxsize=4096)
def _form(angle: int, first: float, second: float, backlash: float) -> Involute:
    return Involute.model_validate(
        {
            "form": "involute",
            "pressure_angle": f"{angle} deg",
            "addendum": [f"{first:g}", f"{second:g}"],
            "dedendum": f"{DEDENDUM:g}",
            "backlash": f"{backlash:.12f}",
        }
    )
