"""Standard teeth for pairs that declare no tooth form: involutes without profile shift.

Each wheel has the largest addendum, up to 1 module, at which it runs with all its mates. Drawings, the viewer, layouts
and exports of wheels use standard teeth.
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
    """Wheel that declares no tooth form: its tooth count, and whether it is a ring gear."""

    z: int
    internal: bool = False


@dataclass(frozen=True, slots=True)
class StandardTeeth:
    """Standard teeth of a wheel: pressure angle [deg] and addendum [module]."""

    angle: int
    addendum: float

    @property
    def words(self) -> str:
        """Text that describes the standard teeth in reports."""
        return f"involute, {self.angle} degrees (no form is declared)"


def standard_teeth(gears: Mapping[str, UndeclaredWheel], pairs: Iterable[tuple[str, str]]) -> dict[str, StandardTeeth]:
    """Return the standard teeth of all wheels, keyed by wheel.

    Wheels that are connected by `pairs` have the same pressure angle, and each wheel has the largest addendum at which
    it runs with all its mates. If no pressure angle lets all pairs run, 20 degrees is used, and the verdict on a pair
    that does not run gives the reason.
    """
    # the ring of a pair is named last, as the tooth form requires
    edges = [(second, first) if gears[first].internal else (first, second) for first, second in pairs]
    found: dict[str, StandardTeeth] = {}
    for name in gears:
        if name not in found:
            group = _connected(name, edges)
            own = {edge for edge in edges if edge[0] in group}
            designs = (_design(group, own, gears, angle) for angle in _ANGLES)
            runs = next((design for design in designs if design is not None), None)
            found |= runs or {each: StandardTeeth(_ANGLES[0], ADDENDUM) for each in group}
    return found


def _connected(first: str, edges: Iterable[tuple[str, str]]) -> list[str]:
    """Return all wheels that are connected with the wheel `first` by the pairs `edges`, including `first` itself."""
    known = [first]
    # the list grows while it is read
    for name in known:
        mates = (mate for edge in edges if name in edge for mate in edge)
        known += [mate for mate in dict.fromkeys(mates) if mate not in known]
    return known


def _design(
    group: Iterable[str], edges: Iterable[tuple[str, str]], gears: Mapping[str, UndeclaredWheel], angle: int
) -> dict[str, StandardTeeth] | None:
    """Return the standard teeth of connected wheels, the `group`, with a pressure angle of `angle` degrees; None if one
    of the pairs `edges` cannot run with them.
    """
    addenda = dict.fromkeys(group, ADDENDUM)
    for first, second in edges:
        heights = (height for height in _ADDENDA if _runs(gears[first], gears[second], angle, (height, height)))
        if (tallest := next(heights, None)) is None:
            return None
        # the mate with the lowest limit decides, since a wheel has one addendum
        addenda[first], addenda[second] = min(addenda[first], tallest), min(addenda[second], tallest)
    # each addendum is the minimum over all mates of a wheel, so that pairs must be checked with both addenda
    if not all(_runs(gears[one], gears[two], angle, (addenda[one], addenda[two])) for one, two in edges):
        return None
    return {name: StandardTeeth(angle, addendum) for name, addendum in addenda.items()}


# pairs with equal tooth numbers recur in a train and in a search
@lru_cache(maxsize=65536)
def _runs(first: UndeclaredWheel, second: UndeclaredWheel, angle: int, addenda: tuple[float, float]) -> bool:
    try:
        check_size(max(first.z, second.z))
        form = standard_form(StandardTeeth(angle, addenda[0]), StandardTeeth(angle, addenda[1]), 0.0)
        return not conjugate_pair_of(form, WheelPair(first.z, second.z, second.internal)).faults
    except GearTrainError:
        return False


def lone_mate(gear: UndeclaredWheel) -> UndeclaredWheel:
    """Return a mate for a wheel that has none: an equal wheel, or for a ring gear a pinion with half its teeth."""
    return UndeclaredWheel(max(gear.z // 2, 1)) if gear.internal else gear


@lru_cache(maxsize=4096)
def standard_form(first: StandardTeeth, second: StandardTeeth, backlash: float) -> Involute:
    """Return the tooth form of a pair of standard wheels with the given backlash [module]."""
    return Involute.model_validate(
        {
            "form": "involute",
            "pressure_angle": f"{first.angle} deg",
            "addendum": [f"{first.addendum:g}", f"{second.addendum:g}"],
            "dedendum": f"{DEDENDUM:g}",
            "backlash": f"{backlash:.12f}",
        }
    )


def check_size(z: int) -> None:
    """Raise `GearTrainError` if a wheel has more than `MOST_TEETH` teeth."""
    if z > MOST_TEETH:
        what, why = f"the teeth of a wheel with {z} teeth cannot be built", f"the maximum is {MOST_TEETH} teeth"
        raise GearTrainError(Problem(what, why, "represent the wheel by a plain disc"))
