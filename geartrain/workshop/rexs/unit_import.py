"""Declaration of a train read from a REXS file: spur and helical stages on parallel axes, and planetary stages.

Shafts are links. Shafts of a planet carrier, with its pins and side plates, are one link. Couplings are brakes and
locks; switchable couplings are clutches, and the gears of the unit are states. Equal planets are one link with copies.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from functools import cached_property
from itertools import pairwise
from math import atan2, isfinite, nan, tau
from pathlib import Path
from typing import Any, NamedTuple

from geartrain.errors import GearTrainError, Problem
from geartrain.numerics.graphs import DisjointSets
from geartrain.numerics.vectors import Vector, cross, dot, minus, size
from geartrain.train.declaration_files import read_declaration, write_declaration
from geartrain.workshop.rexs.rexs_document import LoadCase, RexsComponent, RexsDocument, RexsValue, read_document

_UNITS = {"°": "deg", "1 / min": "rpm", "rad / s": "rad/s"}
"""Units in declarations by units in REXS; others are the same."""
_RIGID = {
    *("coupling", "cylindrical_interference_fit", "tapered_interference_fit"),
    *("feather_key_connection", "involute_spline_connection"),
}
_COUPLINGS = {"switchable_coupling", *_RIGID}
_READ = {
    *("gear_unit", "gear_casing", "shaft", "planet_carrier", "planetary_stage", "side_plate", "cylindrical_stage"),
    *("cylindrical_gear", "ring_gear", "cylindrical_gear_flank", "flank_geometry", "external_load"),
    *_COUPLINGS,
}
"""Types of components from which the declaration is made."""
_DIGITS = 9  # decimals of positions [mm] and directions
_MOST_GEARS = 1000  # no unit has more
_NEAR = 1e-6  # relative tolerance of positions and directions, which are rounded in files
_FRAME = 0  # id of the casing among links; components of a file have other ids


def declaration_of(path: Path) -> tuple[str, list[str]]:
    """Return the text of a declaration of the gear unit in a REXS file, and notes on what was not read.

    Raises `GearTrainError` with all parts on which speeds depend and which cannot be read.
    """
    from geartrain.train.declaration_style import with_short_forms

    document = read_document(path)
    unit = _GearUnit(document)
    data = unit.declaration()
    if unit.problems:
        raise GearTrainError(unit.problems)
    notes = [*dict.fromkeys(unit.notes)]
    head = [f"# Read from {path.name} ({document.origin}).", *(f"# {note}" for note in notes)]
    text = with_short_forms(write_declaration(read_declaration(data)))
    return "\n".join([*head, text]), notes


class _Pose(NamedTuple):
    """Local coordinate system of a component in that of the gear unit: origin [mm] and unit vectors."""

    origin: Vector
    u: Vector
    w: Vector

    def is_coaxial(self, other: _Pose) -> bool:
        """Return True if the u-axes of both lie on one line."""
        across = minus(other.origin, self.origin)
        scale = 1.0 + size(self.origin) + size(other.origin)
        return size(cross(self.u, other.u)) < _NEAR and size(cross(self.u, across)) < _NEAR * scale


class _GearUnit:
    """Links, axes, wheels and states of a gear unit. A link is the id of one of its shafts, or `_FRAME`."""

    def __init__(self, document: RexsDocument) -> None:
        self.document, self.parts = document, document.components
        self.problems: list[Problem] = []
        self.notes: list[str] = []
        self.stages = [each.id for each in document.of_type("planetary_stage")]
        self.unit = next(iter(document.of_type("gear_unit")), RexsComponent(0, "gear_unit", "", {}))
        self.casing = next(iter(document.of_type("gear_casing")), RexsComponent(0, "gear_casing", "casing", {}))
        self._names: dict[int, str] = {}
        self._taken = {("shaft", _clean(self.casing.name))}

    def declaration(self) -> dict[str, Any]:
        """Return the declaration as data; problems and notes are collected."""
        self._check_types()
        unread = Counter(each.type for each in self.parts.values() if each.type not in _READ)
        if unread:
            self.notes.append("Not read: " + ", ".join(f"{count} {kind}" for kind, count in unread.items()) + ".")
        links = [link for link in self.links if link not in self.dropped]
        meshes = [mesh for mesh in self.meshes if not {self.link_of(gear) for gear in mesh} & self.dropped]
        axes: dict[int, int] = {}  # the first link of each axis, which gives the axis its name
        for link in links:
            axes.setdefault(self.axes.find(link), link)
        return {
            "name": _clean(self.unit.name) or "gear-unit",
            "frame": self.name(_FRAME),
            "links": {self.name(link): self._link(link) for link in [_FRAME, *links]},
            **_if_any(axes={self.name(first): place for first in axes.values() if (place := self._place(first))}),
            "revolutes": {
                self.name(first): [
                    self.name(self.top(first)),
                    *(self.name(x) for x in links if self.axes.find(x) == axis),
                ]
                for axis, first in axes.items()
            },
            **_shared_form([self._gear(mesh) for mesh in meshes]),
            **self._running(links),
        }

    def _check_types(self) -> None:
        stages = [part for part in self.parts.values() if part.type.endswith("_stage")]
        for stage in stages:
            if stage.type not in _READ:
                why = "only cylindrical and planetary stages are read"
                fix = "remove it from the file, and declare its pair with `kind: bevel` or `kind: worm`"
                self._problem(stage, f"{stage.type.replace('_', ' ')} is not read", why, fix)
            if stage.type == "planetary_stage" and not self._carrier_shafts(stage.id):
                fix = "relate a shaft to the stage with the relation `planet_carrier_shaft`"
                self._problem(stage, "planetary stage has no carrier shaft", "its planets turn on a carrier", fix)
        if not stages:
            what, why = "the gear unit has no gear stage", "a train is made of gears in mesh"
            self.problems.append(Problem(what, why, "export the gear unit with its stages", self.document.place))

    def _problem(self, part: RexsComponent, what: str, why: str, fix: str) -> None:
        place = f"{self.document.place}: component {part.id}"
        self.problems.append(Problem(f"{part.name or part.type}: {what}", why, fix, place))

    def name(self, number: int) -> str:
        """Return the name of a link, wheel or clutch, made unique among those of its kind."""
        if number not in self._names:
            part = self.casing if number == _FRAME else self.parts[number]
            kind = part.type.rpartition("_")[2]
            stem = _clean(part.name) or f"{kind} {number}"
            name = self._names[number] = stem if (kind, stem) not in self._taken else f"{stem} {number}"
            self._taken.add((kind, name))
        return self._names[number]

    # -------------------------------------------------------------------------------------------------- links and axes

    def _carrier_shafts(self, stage: int) -> list[int]:
        """Return the shafts of the carrier of a stage, its pins last."""
        found = [roles["shaft"] for roles in self._of_stage("planet_carrier_shaft", stage)]
        for carrier in self.document.parts(stage, "planet_carrier"):
            found += self.document.parts(carrier, "shaft")
        pins = [roles["shaft"] for roles in self._of_stage("planet_pin", stage)]
        return [*dict.fromkeys(shaft for shaft in found if shaft not in pins), *pins]

    def _of_stage(self, relation: str, stage: int) -> Iterator[Mapping[str, int]]:
        return (roles for roles in self.document.related(relation) if roles["planetary_stage"] == stage)

    @cached_property
    def bodies(self) -> DisjointSets[int]:
        """Shafts, side plates and casings that are one rigid body by construction; `_FRAME` is the casing."""
        bodies: DisjointSets[int] = DisjointSets()
        for casing in self.document.of_type("gear_casing"):
            bodies.join(_FRAME, casing.id)
        for stage in self.stages:
            carriers = self.document.parts(stage, "planet_carrier")
            plates = (plate for each in carriers for plate in self.document.parts(each, "side_plate"))
            for first, second in pairwise([*self._carrier_shafts(stage), *plates]):
                bodies.join(first, second)
        for kind, roles in self._sides:
            # a shaft with the name of the casing is a part of it
            ends = [self.parts[roles[role]] for role in ("inner_part", "outer_part")]
            if kind in _RIGID and all(_clean(end.name) == _clean(self.casing.name) for end in ends):
                for end in ends:
                    bodies.join(_FRAME, end.id)
        return bodies

    @property
    def _sides(self) -> Iterator[tuple[str, Mapping[str, int]]]:
        """Connections of two components: type of the connecting component, and the relation."""
        return ((self.parts[roles["assembly"]].type, roles) for roles in self.document.related("side"))

    def link_of(self, part: int) -> int:
        """Return the link to which a shaft, gear, side plate or casing belongs; a missing one is the part itself."""
        return self.bodies.find(self.mount.get(part, part))

    @cached_property
    def links(self) -> list[int]:
        """Links other than the frame, in the order of the file."""
        found = dict.fromkeys(self.bodies.find(shaft.id) for shaft in self.document.of_type("shaft"))
        return [link for link in found if link != _FRAME]

    @cached_property
    def tops(self) -> dict[int, int]:
        """Carrier of each planet."""
        found: dict[int, int] = {}
        for stage in self.stages:
            for roles in self._of_stage("planet_shaft", stage):
                for carrier in self._carrier_shafts(stage)[:1]:
                    found[self.bodies.find(roles["shaft"])] = self.bodies.find(carrier)
        return found

    def top(self, link: int) -> int:
        """Return the link that carries the axis of a link."""
        return self.tops.get(link, _FRAME)

    @cached_property
    def axes(self) -> DisjointSets[int]:
        """Links on the same axis of the same carrier."""
        axes: DisjointSets[int] = DisjointSets()
        for stage in self.stages:
            for carrier in map(self.bodies.find, self._carrier_shafts(stage)[:1]):
                for roles in self._of_stage("central_shaft", stage):
                    shaft = self.bodies.find(roles["shaft"])
                    # a central shaft may be the frame, or carry the carrier
                    if shaft != _FRAME and self.top(shaft) == self.top(carrier):
                        axes.join(carrier, shaft)
        for kind, roles in self._sides:
            first, second = (self.link_of(roles[role]) for role in ("inner_part", "outer_part"))
            # shafts that a coupling joins are coaxial
            if kind in _COUPLINGS and _FRAME not in (first, second) and self.top(first) == self.top(second):
                axes.join(first, second)
        placed = [(link, pose) for link in self.links if (pose := self.poses.get(link))]
        for at, (link, pose) in enumerate(placed):
            for other, there in placed[:at]:
                if self.top(link) == self.top(other) and pose.is_coaxial(there):
                    axes.join(other, link)
                    break
        return axes

    @cached_property
    def poses(self) -> dict[int, _Pose]:
        """Position of each link, from the first of its shafts and their gears that has a position."""
        found: dict[int, _Pose] = {}
        shafts = [shaft.id for shaft in self.document.of_type("shaft")]
        for part in (*self.links, *shafts, *self.mount):
            if (pose := self._pose(part)) is not None:
                found.setdefault(self.link_of(part), pose)
        return found

    def _pose(self, number: int) -> _Pose | None:
        """Return the pose of a component; None if it is not given, or not given in the gear unit."""
        given = self.parts[number].attributes
        vectors = [_vector(given.get(name)) for name in ("support_vector", "u_axis_vector", "w_axis_vector")]
        base = _number(given.get("reference_component_for_position"))
        local = base is not None and (int(base) not in self.parts or self.parts[int(base)].type != "gear_unit")
        return None if local or None in vectors else _Pose(*vectors)  # type: ignore[arg-type]

    @cached_property
    def direction(self) -> Vector:
        """Direction of the first axis; all axes are parallel to it."""
        return next((pose.u for link in self.links if (pose := self.poses.get(link))), (0.0, 0.0, 1.0))

    def sense(self, link: int) -> int:
        """Return -1 if the u-axis of a link points against the direction of the axes, else 1."""
        pose = self.poses.get(link)
        return -1 if pose is not None and dot(pose.u, self.direction) < 0 else 1

    def _place(self, link: int) -> dict[str, Any]:
        """Return direction and position of the axis of a link; empty if the file does not give them."""
        pose = self.poses.get(link)
        if pose is None:
            return {}
        if size(cross(pose.u, self.direction)) > _NEAR:
            why, fix = "only units with parallel axes are read", "declare this unit by hand: docs/tutorial.md"
            self._problem(self.parts[link], "its axis is not parallel to the others", why, fix)
        along = [_text(round(each, _DIGITS)) for each in self.direction]
        return {"direction": along, "position": [f"{_text(round(each, _DIGITS))} mm" for each in pose.origin]}

    # -------------------------------------------------------------------------------------------------- wheels, meshes

    @cached_property
    def mount(self) -> dict[int, int]:
        """Shaft of each gear."""
        gears = {each.id for each in self.document.of_type("cylindrical_gear", "ring_gear")}
        found = {
            roles["part"]: roles["assembly"]
            for roles in self.document.related("assembly")
            if roles["part"] in gears and self.parts[roles["assembly"]].type == "shaft"
        }
        for gear in gears - found.keys():
            why, fix = "only gears that are parts of a shaft are read", "relate it to a shaft by `assembly`"
            self._problem(self.parts[gear], "gear is not mounted on a shaft", why, fix)
        return found

    @cached_property
    def meshes(self) -> list[tuple[int, int]]:
        """Pairs of gears in mesh, in the order of the file."""
        pairs = ((roles["gear_1"], roles["gear_2"]) for roles in self.document.related("stage"))
        return [pair for pair in pairs if self.mount.keys() >= {*pair}]

    def _wheel(self, gear: int) -> dict[str, Any]:
        part = self.parts[gear]
        given, count = part.attributes, _number(part.attributes.get("number_of_teeth"))
        if count is None or count < 1 or count % 1:
            why, fix = "speeds follow from tooth counts", "give the attribute `number_of_teeth`, a whole number above 0"
            self._problem(part, "gear has no tooth count", why, fix)
            count = 1
        wheel: dict[str, Any] = {"teeth": int(count)}
        if part.type == "ring_gear":
            wheel["internal"] = True
        if angle := _number(given.get("helix_angle_reference_diameter")):
            wheel["helix_angle"] = _quantity(given["helix_angle_reference_diameter"], abs(angle))
            # the hand of a ring is that of its mate; programs give its angle different signs
            if part.type != "ring_gear":
                wheel["hand"] = "right" if angle > 0 else "left"
        sizes = {"module": given.get("normal_module"), "face_width": given.get("face_width")}
        return wheel | {key: _quantity(value) for key, value in sizes.items() if value is not None}

    def _gear(self, mesh: tuple[int, int]) -> dict[str, Any]:
        """Return the declaration of a pair, with involute teeth if its flanks give pressure angle and profile shift."""
        pair = {"pair": [self.name(gear) for gear in mesh]}
        flanks = [self._flank(gear) for gear in mesh]
        if not {"normal_pressure_angle", "addendum_modification_coefficient"} <= flanks[0].keys():
            return pair
        shifts = [_number(flank.get("addendum_modification_coefficient")) or 0.0 for flank in flanks]
        for at, gear in enumerate(mesh):
            if self.parts[gear].type == "ring_gear" and shifts[at]:
                ring = f"Profile shift of ring '{self.name(gear)}'"
                self.notes.append(f"{ring} is not read: its sign differs between programs.")
                shifts[at] = 0.0
        form: dict[str, Any] = {"form": "involute", "pressure_angle": _quantity(flanks[0]["normal_pressure_angle"])}
        shift = {"shift": [_text(round(shift, _DIGITS)) for shift in shifts]} if any(shifts) else {}
        return {**pair, "tooth_form": {**form, **shift}}

    def _flank(self, gear: int) -> Mapping[str, RexsValue]:
        flanks = (roles for roles in self.document.related("flank") if roles["gear"] == gear)
        return next((self.parts[roles["left"]].attributes for roles in flanks), {})

    def _link(self, link: int) -> dict[str, Any]:
        gears = [gear for gear in self.mount if self.link_of(gear) == self.bodies.find(link)]
        wheels = {self.name(gear): self._wheel(gear) for gear in gears}
        copies = len(self.copies.get(link, ()))
        return {**_if_any(wheels=wheels), **({"copies": copies} if copies > 1 else {})}

    # ---------------------------------------------------------------------------------------------------- equal planets

    @cached_property
    def dropped(self) -> set[int]:
        """Planets that are copies of another one."""
        return {copy for first, group in self.copies.items() for copy in group if copy != first}

    @cached_property
    def copies(self) -> dict[int, list[int]]:
        """Equal planets by the first of them: evenly spaced, with equal wheels in mesh with the same central wheels."""
        meshes: dict[int, list[tuple[Any, ...]]] = {}
        for mesh in self.meshes:
            for own, other in (mesh, mesh[::-1]):
                planet = self.link_of(other) in self.tops
                # a planet that meshes with another planet has a mate of its own
                meshes.setdefault(self.link_of(own), []).append((*self._size(own), other, own if planet else 0))
        groups: dict[tuple[Any, ...], list[int]] = {}
        for link in self.links:
            if link in self.tops and link not in self.tops.values() and link in meshes:
                groups.setdefault((self.tops[link], *sorted(meshes[link])), []).append(link)
        found = {group[0]: group for group in groups.values() if len(group) > 1 and self._is_even(group)}
        for group in found.values():
            equal = ", ".join(f"'{self.name(link)}'" for link in group)
            self.notes.append(f"Equal planets {equal} are one link with copies.")
        return found

    def _size(self, gear: int) -> tuple[float, ...]:
        names = ("number_of_teeth", "normal_module", "helix_angle_reference_diameter")
        return tuple(_number(self.parts[gear].attributes.get(name)) or 0.0 for name in names)

    def _is_even(self, group: list[int]) -> bool:
        """Return True if planets are evenly spaced about the axis of their carrier, or their positions are unknown."""
        centre, poses = self.poses.get(self.top(group[0])), [self.poses.get(link) for link in group]
        if centre is None or None in poses:
            return True
        right, up = centre.w, cross(centre.u, centre.w)
        arms = [minus(pose.origin, centre.origin) for pose in poses if pose is not None]
        angles = sorted(atan2(dot(arm, up), dot(arm, right)) for arm in arms)
        return all(abs(b - a - tau / len(group)) < 1e-4 for a, b in pairwise(angles))

    # --------------------------------------------------------------------------------------------------------- running

    def _running(self, links: list[int]) -> dict[str, Any]:
        """Return inputs, outputs, loads, brakes, locks, clutches and states."""
        cases = self.document.cases or ({},) * self.gears
        held: dict[str, list[Any]] = {"fixed": [], "locks": []}
        clutches: dict[str, Any] = {}
        engaged: list[list[str]] = [[] for _ in cases]
        for name, ends, in_gear in self._connections():
            in_case = [in_gear[self._gear_index(case)] for case in cases]
            if name is None or len(cases) == 1:
                held["locks" if ends[1:] else "fixed"] += [ends if ends[1:] else ends[0]] * in_case[0]
                continue
            clutches[name] = {"locks": ends} if ends[1:] else {"fixes": ends[0]}
            for names, state in zip(engaged, in_case, strict=True):
                names += [name] * state
        states = [self._state(case, links) for case in cases]
        found = {**_if_any(**held, clutches=clutches), **self._outputs(links, states)}
        if len(states) == 1:
            return {**found, **states[0]}
        numbered = {str(1 + at): {**_if_any(engaged=engaged[at]), **each} for at, each in enumerate(states)}
        return {**found, "states": numbered}

    @property
    def gears(self) -> int:
        """Number of gears (shifting states) of the unit."""
        return int(min(max(1, _number(self.unit.attributes.get("number_of_gears")) or 1), _MOST_GEARS))

    def _gear_index(self, case: LoadCase) -> int:
        """Return the index of the gear in force in a load case."""
        index = {**self.unit.attributes, **case.get(self.unit.id, {})}.get("gear_shift_index")
        return min(max(int(_number(index) or 1), 1), self.gears) - 1

    def _connections(self) -> Iterator[tuple[str | None, list[str], list[bool]]]:
        """Yield couplings of two links: name (None if permanent), links without the frame, state in each gear."""
        seen = set()
        for kind, roles in self._sides:
            ends = [self.link_of(roles[role]) for role in ("inner_part", "outer_part")]
            part = self.parts[roles["assembly"]]
            if kind not in _COUPLINGS or ends[0] == ends[1] or self.dropped & {*ends}:
                continue
            flags = part.attributes.get("is_engaged", RexsValue([True] * self.gears)).value
            if not isinstance(flags, list) or len(flags) < self.gears:
                why, fix = f"it needs one value for each of the {self.gears} gears", "give it as an array of booleans"
                self._problem(part, "`is_engaged` is incomplete", why, fix)
                continue
            states = [str(flag).lower() == "true" for flag in flags]
            names = [self.name(end) for end in ends if end != _FRAME]
            if (key := (kind in _RIGID, *sorted(names), *states)) not in seen:
                seen.add(key)
                yield None if kind in _RIGID else self.name(part.id), names, states

    def _state(self, case: LoadCase, links: list[int]) -> dict[str, Any]:
        """Return the inputs and loads of one load case."""
        inputs: dict[str, str] = {}
        loads: dict[str, float] = {}
        for shaft in self.document.of_type("shaft"):
            given, link = {**shaft.attributes, **case.get(shaft.id, {})}, self.link_of(shaft.id)
            if link not in links:
                continue
            speed = _number(given.get("rotational_speed"))
            if _is_true(given.get("defines_speed")) and speed is not None:
                inputs[self.name(link)] = _quantity(given["rotational_speed"], self.sense(link) * speed)
            for load in self.document.parts(shaft.id, "external_load"):
                torque = self._torque({**self.parts[load].attributes, **case.get(load, {})}, speed)
                if torque is not None:
                    loads[self.name(link)] = loads.get(self.name(link), 0.0) + self.sense(link) * torque
        return _if_any(inputs=inputs, loads={link: f"{_text(torque)} N m" for link, torque in loads.items()})

    def _torque(self, given: Mapping[str, RexsValue], speed: float | None) -> float | None:
        """Return a torque that a load defines [N m], also from its power [kW] and the speed of the shaft [1/min]."""
        if "defines_torque" in given and not _is_true(given["defines_torque"]):
            return None
        torque, power = _number(given.get("torque_around_u_axis")), _number(given.get("power"))
        if torque is None and power is not None and speed:
            self.notes.append("A load given as a power is read as the torque at the given speed.")
            return 60_000 * power / (tau * speed)
        return torque

    def _outputs(self, links: list[int], states: list[dict[str, Any]]) -> dict[str, Any]:
        """Return as outputs the links with an external load that are not inputs."""
        inputs = {name for state in states for name in state.get("inputs", ())}
        shafts = [each.id for each in self.document.of_type("shaft")]
        loaded = {self.link_of(shaft) for shaft in shafts if self.document.parts(shaft, "external_load")}
        return _if_any(outputs={self.name(x): {} for x in links if x in loaded and self.name(x) not in inputs})


def _if_any(**parts: Any) -> dict[str, Any]:
    """Return the parts that are not empty."""
    return {key: part for key, part in parts.items() if part}


def _shared_form(gears: list[dict[str, Any]]) -> dict[str, Any]:
    """Return gear pairs; a tooth form that all have in common is that of the train."""
    forms = [gear.get("tooth_form") for gear in gears]
    if not forms or not forms[0] or any(form != forms[0] for form in forms):
        return {"gears": gears}
    return {"tooth_form": forms[0], "gears": [{"pair": gear["pair"]} for gear in gears]}


def _clean(name: str) -> str:
    """Return a name without the id in brackets that programs append, and without characters that join wheels."""
    return re.sub(r"\s*\[\d+\].*$", "", name).replace("~", "-").strip()


def _number(given: RexsValue | None) -> float | None:
    """Return a finite number, or None if it is not given."""
    try:
        number = float(given.value if given is not None else nan)
    except (TypeError, ValueError, OverflowError):
        return None
    return number if isfinite(number) else None


def _vector(given: RexsValue | None) -> Vector | None:
    values = given.value if given is not None and isinstance(given.value, list) else []
    numbers = [number for each in values if (number := _number(RexsValue(each))) is not None]
    return (numbers[0], numbers[1], numbers[2]) if len(numbers) == len(values) == 3 else None


def _is_true(given: RexsValue | None) -> bool:
    return given is not None and str(given.value).lower() == "true"


def _quantity(given: RexsValue, value: float | None = None) -> str:
    """Return a value of an attribute, by default its own, with its unit as written in declarations."""
    number = _number(given) if value is None else value
    return f"{given.value if number is None else _text(number)} {_UNITS.get(given.unit, given.unit)}".strip()


def _text(value: float) -> str:
    """Return the shortest decimal text of a number that gives the same number again."""
    return repr(value + 0.0).removesuffix(".0")
