"""What a declaration of conjugate teeth may say: arcs, pressure angles, kinds of wheels, and which wheel is gear 1."""

from __future__ import annotations

from math import tau
from typing import TYPE_CHECKING

from geartrain.errors import RangeError
from geartrain.numerics.quantity import Angle, Figure, Quantity
from geartrain.teeth.tooth_form import IDEAL, ShaftAngle, ToothForm, bad, refused

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces
    from geartrain.teeth.meshing_wheels import MeshingWheels


def arcs_of(figures: tuple[Figure, Figure], pitch: PitchSurfaces) -> tuple[float, float]:
    """Arcs declared in pitches, as X."""
    return float(figures[0].value) * pitch.p, float(figures[1].value) * pitch.p


def check_arcs(arcs: tuple[Figure, Figure]) -> None:
    """Raises pydantic's error for arcs below 0, or both 0."""
    if min(arc.value for arc in arcs) < 0 or sum(arc.value for arc in arcs) <= 0:
        text = ", ".join(arc.text for arc in arcs)
        raise bad("arcs", f"arcs [{text}] are none", "give those of approach and recess in pitches, a pitch in all")


def check_lengths(backlash: Quantity, centre_distance: Quantity | None) -> None:
    """Raises pydantic's error for a backlash below 0, or a distance not above 0."""
    if backlash.value < 0:
        raise bad("backlash", f"backlash {backlash.text} would jam the teeth", "write 0 or more")
    if centre_distance is not None and centre_distance.value <= 0:
        raise bad("length", f"centre_distance {centre_distance.text} is no length", "write it above 0")


def check_angle(name: str, angle: Angle, below: float = 0.25) -> None:
    """Raises pydantic's error for a pressure angle outside 0 to `below` of a turn, an eighth or a quarter."""
    turns = angle.si / tau
    if not 0 < turns < below:
        raise bad(
            "pressure_angle",
            f"{name} {angle.text} is outside 0 to {360 * below:g} deg",
            f"a pressure angle of these teeth lies between 0 and {360 * below:g} deg; 20 deg is usual",
        )


def check_wheels(form: ToothForm, wheels: MeshingWheels, shaft_angle: ShaftAngle) -> None:
    """Raises `GearTrainError` for wheels of kinds that cannot have conjugate teeth of this form."""
    why, fix = _refusal(wheels.kinds), IDEAL
    if "helical" in wheels.kinds:
        if _are_skew(shaft_angle):
            why = "helical teeth on skew axes touch at a point, and slide along each other"
        elif form.form != "involute":
            why = "its wheels are helical, and only involutes are known to work there"
            fix = "give it `tooth_form: involute`"
    if why:
        raise refused(f"it cannot have {form.words} teeth", why, fix)


def _refusal(kinds: tuple[str, str]) -> str:
    if "worm" in kinds:
        return "a worm's thread slides along the wheel, and rolls on no pitch surface"
    if set(kinds) >= {"bevel", "contrate"}:
        return "a bevel and a contrate wheel have no pair of pitch cones"
    return ""


def wheel_specific_parameters(form: ToothForm) -> list[str]:
    """Parameters that tell the two wheels apart."""
    given = {name: getattr(form, name) for name in type(form).model_fields}
    uneven = [name for name, value in given.items() if isinstance(value, tuple) and value[0].value != value[1].value]
    return uneven + [name for name in ("pins",) if name in form.model_fields_set]


def check_order(form: ToothForm, pair: tuple[str, str]) -> None:
    """Raises `GearTrainError` for a form whose wheels differ on a pair that names its ring first."""
    if uneven := wheel_specific_parameters(form):
        ring, pinion = pair
        raise refused(
            f"it is not plain whose {' and '.join(uneven)} is whose",
            f"the pair names its ring '{ring}' first, and these teeth count the ring as the second wheel",
            f"name the pinion first: `pair: [{pinion}, {ring}]`",
        )


def _are_skew(shaft_angle: ShaftAngle) -> bool:
    """Whether the axes of two helical wheels are not parallel."""
    try:
        return shaft_angle() is not None
    except RangeError:
        return True  # they pass each other, as those of helical wheels may


def shaft_angle_of(form: ToothForm, wheels: MeshingWheels, shaft_angle: ShaftAngle) -> float | None:
    """The angle of a bevel pair (rad); None for wheels that mesh as spur wheels do."""
    if {"contrate", "helical"} & set(wheels.kinds):
        return None
    angle = shaft_angle()
    if angle is None and "bevel" in wheels.kinds:
        raise refused(
            f"it cannot have {form.words} teeth",
            "nothing says how the axes of its bevels meet",
            f"declare `axes` with the `direction` of both, or {IDEAL}",
        )
    return angle
