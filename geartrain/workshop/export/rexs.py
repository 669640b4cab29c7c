"""Gear unit as REXS JSON (FVA's Reusable Engineering Exchange Standard, version 1.4), as far as REXS can represent it.

Component types, attributes and units are those of the REXS 1.4 database; see www.rexs.info.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from fractions import Fraction
from math import degrees
from typing import TYPE_CHECKING, Any

from geartrain.numerics.exact import as_float
from geartrain.scene.solids.bearing_plates import basis

if TYPE_CHECKING:
    from geartrain.scene.layout import WheelPlace
    from geartrain.scene.solids.solid_assembly import SolidModel
    from geartrain.train import GearPair, Wheel

VERSION = "1.4"
_ANGLE = 20.0  # deg, if no tooth form is declared
_DATE = "2000-01-01T00:00:00+00:00"  # fixed, so that the same train gives the same file


def to_rexs(work: SolidModel) -> str:
    """Return the gear unit of a train in REXS JSON format."""
    # JSON has no NaN, so an undefined size must raise an error here and not in the reading program
    return json.dumps({"model": _Unit(work).model()}, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


class _Unit:
    def __init__(self, work: SolidModel) -> None:
        self.work, self.declared = work, work.train.declaration
        self.components: list[dict[str, Any]] = []
        self.relations: list[dict[str, Any]] = []
        self.numbers: dict[tuple[str, str], int] = {}
        self.speeds = _per_minute(work)

    def model(self) -> dict[str, Any]:
        from importlib.metadata import version

        unit = self.add("gear_unit", self.declared.name, [*_frame((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), 1)])
        casing = self.add("gear_casing", self.declared.frame, [])
        self.relate("assembly", assembly=unit, part=casing)
        for link in self.declared.links:
            self.shaft(link, unit)
        for gear in self.declared.gears:
            self.stage(gear, unit)
        load = {"id": 1, "load_cases": [{"id": 1, "components": self.running()}]}
        return {
            "version": VERSION,
            "applicationId": "geartrain",
            "applicationVersion": version("geartrain"),
            "date": _DATE,
            "applicationLanguage": "en",
            "relations": self.relations,
            "components": self.components,
            **({"load_spectrum": load} if load["load_cases"][0]["components"] else {}),  # type: ignore[index]
        }

    def add(self, kind: str, name: str, attributes: list[dict[str, Any]]) -> int:
        number = len(self.components) + 1
        self.components.append({"id": number, "type": kind, "name": name, "attributes": attributes})
        return number

    def relate(self, kind: str, **roles: int) -> None:
        """Add a relation; each member has its role, and its component type as a hint."""
        refs = [
            {"id": number, "role": role, "hint": self.components[number - 1]["type"]} for role, number in roles.items()
        ]
        self.relations.append({"id": len(self.relations) + 1, "type": kind, "refs": refs})

    def shaft(self, link: str, unit: int) -> None:
        """Add a shaft for a link that turns or has wheels; u is the coordinate along its axis."""
        wheels = self.declared.links[link].wheels
        label = self.work.train.kinematics.tree.axis(link)
        if link == self.declared.frame and not wheels:
            return
        axis = self.work.layout.axes.get(label or "")
        point, along = (axis.point, axis.direction) if axis else ((0.0, 0.0, 0.0), (0.0, 0.0, 1.0))
        driven = {"id": "defines_speed", "boolean": link in self.declared.case(self.work.scene.state).inputs}
        number = self.numbers["link", link] = self.add("shaft", link, [driven, *_frame(point, along, 1)])
        self.relate("assembly", assembly=unit, part=number)
        for name, wheel in wheels.items():
            self.gear(name, wheel, number)

    def gear(self, name: str, wheel: Wheel, shaft: int) -> None:
        place = self.work.layout.wheels[name]
        axis = self.work.layout.axes.get(place.axis)
        along = axis.direction if axis else (0.0, 0.0, 1.0)
        kind = _kind(wheel, place)
        attributes = [
            {"id": "number_of_teeth", "integer": wheel.count or 0},
            *_sizes(kind, place, self.angle(name), wheel),
            *_frame(place.centre, along, 1),
        ]
        if axis is not None:
            above = sum((a - b) * c for a, b, c in zip(place.centre, axis.point, along, strict=True))
            attributes.append(_mm("u_coordinate_on_shaft", above))
        number = self.numbers["wheel", name] = self.add(kind, name, attributes)
        self.relate("assembly", assembly=shaft, part=number)

    def angle(self, name: str) -> float:
        """Return the rack angle of the first pair of a wheel whose tooth form has a rack [deg]; 20 without a rack."""
        forms = (self.declared.form_of(gear) for gear in self.declared.gears if name in gear.pair)
        angles = (form.rack_angle for form in forms if form is not None)
        return next((degrees(angle) for angle in angles if angle is not None), _ANGLE)

    def stage(self, gear: GearPair, unit: int) -> None:
        """Add a gear pair as a stage; an internal wheel is its second gear."""
        first, second = gear.pair
        # an internal gear is the second gear of a stage
        if self.declared.wheels[first][1].internal:
            first, second = second, first
        kinds = {self.components[self.numbers["wheel", each] - 1]["type"] for each in (first, second)}
        worm = "worm_gear" in kinds
        kind = "worm_stage" if worm else "bevel_stage" if "bevel_gear" in kinds else "cylindrical_stage"
        attributes = []
        distance = self.work.layout.axis_distance(first, second)
        if kind == "cylindrical_stage" and distance is not None:
            attributes.append(_mm("center_distance", distance))
        number = self.add(kind, gear.name, attributes)
        self.relate("assembly", assembly=unit, part=number)
        if worm and self.declared.wheels[second][1].kind == "worm":
            first, second = second, first
        roles = {"gear_1": self.numbers["wheel", first], "gear_2": self.numbers["wheel", second]}
        self.relate("stage", stage=number, **roles)

    def running(self) -> list[dict[str, Any]]:
        """Return the REXS data of all shafts whose speed is known, each with its rotational speed [1/min]."""
        found = []
        for (kind, link), number in self.numbers.items():
            speed = as_float(self.speeds[link]) if kind == "link" and link in self.speeds else None
            if speed is not None:
                value = {"id": "rotational_speed", "unit": "1 / min", "floating_point": speed}
                found.append({"id": number, "type": "shaft", "name": link, "attributes": [value]})
        return found


def _per_minute(work: SolidModel) -> Mapping[str, Fraction]:
    """Return the speeds of links in turns per minute; empty if the train is not solved.

    Speeds that are not per time are taken as turns per minute.
    """
    answer = work.train.solve(work.scene.state, method="exact")
    declared = work.train.declaration
    factor = Fraction(1) if declared.unit_speed is None else 60 * declared.unit_speed
    return {link: Fraction(speed) * factor for link, speed in answer.speeds.items()} if answer.verdict else {}


def _kind(wheel: Wheel, place: WheelPlace) -> str:
    if wheel.kind == "worm":
        return "worm_gear"
    if wheel.kind == "bevel" or wheel.kind == "contrate":
        return "bevel_gear"
    return "ring_gear" if wheel.internal else "bevel_gear" if place.cone else "cylindrical_gear"


def _sizes(kind: str, place: WheelPlace, angle: float, wheel: Wheel) -> Iterator[dict[str, Any]]:
    if kind == "bevel_gear":
        yield _mm("face_width", place.thickness)
        yield {"id": "pitch_angle", "unit": "deg", "floating_point": degrees(place.cone)}
    elif kind == "worm_gear":
        yield _mm("axial_module", place.module)
    else:
        yield _mm("normal_module", place.module / wheel.slant)
        yield {"id": "normal_pressure_angle", "unit": "deg", "floating_point": angle}
        yield {"id": "helix_angle_reference_diameter", "unit": "deg", "floating_point": degrees(wheel.helix)}
        yield _mm("face_width", place.thickness)


def _mm(name: str, value: float) -> dict[str, Any]:
    return {"id": name, "unit": "mm", "floating_point": value}


def _frame(
    point: tuple[float, float, float], along: tuple[float, float, float], reference: int
) -> Iterator[dict[str, Any]]:
    """Yield the attributes of the position of a component: u along its axis, w perpendicular to it."""
    right, _ = basis(along)
    for name, vector in (("u_axis_vector", along), ("support_vector", point), ("w_axis_vector", right)):
        yield {"id": name, "unit": "mm", "floating_point_array": [float(each) for each in vector]}
    yield {"id": "reference_component_for_position", "reference_component": reference}
