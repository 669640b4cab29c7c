"""Declaration of a train read from a REXS file: spur and helical stages on parallel axes, and planetary stages.

Shafts become links. The shafts, pins and side plates of a planet carrier become one link. Couplings become brakes and
locks, switchable couplings become clutches, and the gears of the unit become states. Equal planets become one link with
copies.
"""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping
from functools import cached_property
from itertools import chain, combinations, pairwise
from math import tau
from pathlib import Path
from typing import Any, NamedTuple

from geartrain.errors import GearTrainError, Problem
from geartrain.numerics.graphs import DisjointSets
from geartrain.numerics.vectors import Vector, azimuth, beside, cross, dot, minus, size
from geartrain.train.declaration_files import read_declaration, write_declaration
from geartrain.workshop.rexs.rexs_document import Attributes, RexsComponent, RexsDocument, read_document

_UNITS = {"°": "deg", "1 / min": "rpm", "rad / s": "rad/s"}
"""Unit in a declaration for each REXS unit that is written differently."""
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
_HELIX = "helix_angle_reference_diameter"
_SHIFT = "addendum_modification_coefficient"
_DIGITS = 9  # decimals of positions [mm] and directions
_MOST_GEARS = 1000  # no unit has more
_NEAR = 1e-6  # relative tolerance of positions and directions, which are rounded in files
_FRAME = 0  # id of the casing among links; components of a file have other ids


def declaration_of(path: Path) -> tuple[str, list[str]]:
    """Return the text of a declaration of the gear unit in a REXS file, and notes on the parts that were not imported.

    Raises `GearTrainError` that lists all parts that cannot be read although speeds depend on them.
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
    """Axis of a component in the coordinate system of the gear unit: origin [mm] and unit vector."""

    origin: Vector
    u: Vector


class _GearUnit:
    """Links, axes, wheels and states of a gear unit. The id of a link is that of one of its shafts, or `_FRAME`."""

    def __init__(self, document: RexsDocument) -> None:
        self.document, self.parts, self.relations = document, document.components, document.relations
        self.problems: list[Problem] = []
        self.notes: list[str] = []
        self.unit = self._first("gear_unit", "")
        self.casing = self._first("gear_casing", "casing")
        self.shafts = document.of_type("shaft")
        self.carriers = {stage: self._carrier(stage) for stage in document.of_type("planetary_stage")}
        self._names: dict[int, str] = {}
        self._taken = {("shaft", _clean(self.casing.name))}

    def _first(self, kind: str, name: str) -> RexsComponent:
        found = self.document.of_type(kind)
        return self.parts[found[0]] if found else RexsComponent(_FRAME, kind, name, {})

    def declaration(self) -> dict[str, Any]:
        """Return the declaration as plain data, and collect problems and notes."""
        self._check_types()
        unread = Counter(each.type for each in self.parts.values() if each.type not in _READ)
        if unread:
            self.notes.append("Not read: " + ", ".join(f"{count} {kind}" for kind, count in unread.items()) + ".")
        links = [link for link in self.links if link not in self.dropped]
        meshes = [mesh for mesh in self.meshes if not {self.link_of(gear) for gear in mesh} & self.dropped]
        axes: dict[int, list[int]] = {}  # links on each axis; the first gives the axis its name
        for link in links:
            axes.setdefault(self.axes.find(link), []).append(link)
        gears = [self._gear(mesh) for mesh in meshes]
        form = gears[0].get("tooth_form") if gears else None
        if all(gear.get("tooth_form") == form for gear in gears):
            gears = [{"pair": gear["pair"]} for gear in gears]
        else:
            form = None
        return _if_any(
            name=_clean(self.unit.name) or "gear-unit",
            frame=self.name(_FRAME),
            links={self.name(link): self._link(link) for link in [_FRAME, *links]},
            axes=_if_any(**{self.name(first): self._place(first) for first, *_ in axes.values()}),
            revolutes={
                self.name(first): [self.name(each) for each in (self.top(first), first, *others)]
                for first, *others in axes.values()
            },
            tooth_form=form,
            gears=gears,
            **self._running(links),
        )

    def _check_types(self) -> None:
        stages = [part for part in self.parts.values() if part.type.endswith("_stage")]
        for stage in stages:
            if stage.type not in _READ:
                why = "only cylindrical and planetary stages are read"
                fix = "remove it from the file, and declare its pair with `kind: bevel` or `kind: worm`"
                self._problem(stage, f"{stage.type.replace('_', ' ')} is not read", why, fix)
            if not self.carriers.get(stage.id, True):
                fix = "relate a shaft to the stage with the relation `planet_carrier_shaft`"
                self._problem(stage, "planetary stage has no carrier shaft", "its planets turn on a carrier", fix)
        if not stages:
            what, why = "the gear unit has no gear stage", "a train is made of gears in mesh"
            self.problems.append(Problem(what, why, "export the gear unit with its stages", self.document.place))

    def _problem(self, part: RexsComponent, what: str, why: str, fix: str) -> None:
        place = f"{self.document.place}: component {part.id}"
        self.problems.append(Problem(f"{part.name or part.type}: {what}", why, fix, place))

    def name(self, number: int) -> str:
        """Return the name of a link, wheel or clutch. Names are unique among components of the same kind."""
        if number not in self._names:
            part = self.casing if number == _FRAME else self.parts[number]
            kind = part.type.rpartition("_")[2]
            stem = _clean(part.name) or f"{kind} {number}"
            name = self._names[number] = stem if (kind, stem) not in self._taken else f"{stem} {number}"
            self._taken.add((kind, name))
        return self._names[number]

    # -------------------------------------------------------------------------------------------------- links and axes

    def _carrier(self, stage: int) -> list[int]:
        """Return the ids of shafts, pins and side plates of the carrier of a stage; empty without shaft and pin."""
        shafts, pins = (
            [shaft for whole, shaft in self.relations[relation] if whole == stage]
            for relation in ("planet_carrier_shaft", "planet_pin")
        )
        plates = []
        for carrier in self.document.parts(stage, "planet_carrier"):
            shafts += self.document.parts(carrier, "shaft")
            plates += self.document.parts(carrier, "side_plate")
        found = [*dict.fromkeys(shaft for shaft in shafts if shaft not in pins), *pins]
        return [*found, *plates] if found else []

    @cached_property
    def bodies(self) -> DisjointSets[int]:
        """Disjoint sets of shafts, side plates and casings that are one rigid body; `_FRAME` is in the casing's set."""
        bodies: DisjointSets[int] = DisjointSets()
        for casing in self.document.of_type("gear_casing"):
            bodies.join(_FRAME, casing)
        for first, second in chain.from_iterable(map(pairwise, self.carriers.values())):
            bodies.join(first, second)
        for coupling, *ends in self.relations["side"]:
            # a shaft with the name of the casing is a part of it
            names = {_clean(self.parts[end].name) for end in ends}
            if self.parts[coupling].type in _RIGID and names == {_clean(self.casing.name)}:
                for end in ends:
                    bodies.join(_FRAME, end)
        return bodies

    def link_of(self, part: int) -> int:
        """Return the id of the link of which a shaft, gear, side plate or casing is a part. The result is the id of the
        part itself if it is joined to no other part.
        """
        return self.bodies.find(self.mount.get(part, part))

    @cached_property
    def links(self) -> list[int]:
        """Ids of all links except the frame, in the order of the file."""
        return [link for link in dict.fromkeys(map(self.bodies.find, self.shafts)) if link != _FRAME]

    @cached_property
    def tops(self) -> dict[int, int]:
        """Mapping from each planet link to its carrier link."""
        pairs = ((shaft, self.carriers.get(stage, ())[:1]) for stage, shaft in self.relations["planet_shaft"])
        return {self.link_of(shaft): self.link_of(carrier) for shaft, first in pairs for carrier in first}

    def top(self, link: int) -> int:
        """Return the id of the link that carries the axis of the given link."""
        return self.tops.get(link, _FRAME)

    @cached_property
    def axes(self) -> DisjointSets[int]:
        """Disjoint sets of links that are on the same axis of the same carrier."""
        axes: DisjointSets[int] = DisjointSets()
        for pair in self._coaxial():
            first, second = map(self.link_of, pair)
            # a central shaft may be the frame, or carry the carrier
            if _FRAME not in (first, second) and self.top(first) == self.top(second):
                axes.join(first, second)
        return axes

    def _coaxial(self) -> Iterator[tuple[int, int]]:
        """Yield pairs of shafts that are coaxial according to a stage, a coupling or their positions."""
        for stage, shaft in self.relations["central_shaft"]:
            yield from ((carrier, shaft) for carrier in self.carriers.get(stage, ())[:1])
        for coupling, inner, outer in self.relations["side"]:
            if self.parts[coupling].type in _COUPLINGS:
                yield inner, outer
        for (first, pose), (second, other) in combinations(self.poses.items(), 2):
            distance = size(cross(pose.u, minus(other.origin, pose.origin)))
            scale = 1.0 + size(pose.origin) + size(other.origin)
            if size(cross(pose.u, other.u)) < _NEAR and distance < _NEAR * scale:
                yield first, second

    @cached_property
    def poses(self) -> dict[int, _Pose]:
        """Pose of each link, taken from the first of its shafts and their gears that has a pose."""
        found: dict[int, _Pose] = {}
        for part in (*self.links, *self.shafts, *self.mount):
            given = self.parts[part].attributes
            vectors = [given.get(name, ()) for name in ("support_vector", "u_axis_vector")]
            # a position may be given relative to another component
            base = given.get("reference_component_for_position", self.unit.id)
            if base == self.unit.id and all(len(vector) == 3 for vector in vectors):
                found.setdefault(self.link_of(part), _Pose(*map(tuple, vectors)))
        return found

    @cached_property
    def direction(self) -> Vector:
        """Unit vector of the first axis, to which all other axes are parallel."""
        return next((self.poses[link].u for link in self.links if link in self.poses), (0.0, 0.0, 1.0))

    def sense(self, link: int) -> int:
        """Return the sense of the u-axis of a link: -1 if it is opposite to the direction of the axes, otherwise 1."""
        return -1 if link in self.poses and dot(self.poses[link].u, self.direction) < 0 else 1

    def _place(self, link: int) -> dict[str, Any]:
        """Return direction and position of a link's axis as data of a declaration; empty if its position is unknown."""
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
        """Mapping from each gear to the shaft on which it is mounted."""
        gears = self.document.of_type("cylindrical_gear", "ring_gear")
        shaft_of = {part: whole for whole, part in self.relations["assembly"] if self.parts[whole].type == "shaft"}
        for gear in gears:
            if gear not in shaft_of:
                why, fix = "only gears that are parts of a shaft are read", "relate it to a shaft by `assembly`"
                self._problem(self.parts[gear], "gear is not mounted on a shaft", why, fix)
        return {part: shaft for part, shaft in shaft_of.items() if part in gears}

    @cached_property
    def meshes(self) -> list[tuple[int, int]]:
        """Pairs of meshing gears (component ids), in the order of the file."""
        return [(one, two) for _, one, two in self.relations["stage"] if self.mount.keys() >= {one, two}]

    def _wheel(self, gear: int) -> dict[str, Any]:
        part = self.parts[gear]
        given, ring = part.attributes, part.type == "ring_gear"
        count = given.get("number_of_teeth", 0)
        if count < 1 or count % 1:
            why, fix = "speeds follow from tooth counts", "give the attribute `number_of_teeth`, a whole number above 0"
            self._problem(part, "gear has no tooth count", why, fix)
        angle = given.get(_HELIX, 0)
        # the hand of a ring is that of its mate; programs give its angle different signs
        hand = "" if ring or not angle else "right" if angle > 0 else "left"
        turned = {**given, _HELIX: abs(angle) or None}
        names = {"helix_angle": _HELIX, "module": "normal_module", "face_width": "face_width"}
        sizes = {key: self._quantity(name, turned.get(name)) for key, name in names.items()}
        return {"teeth": max(int(count), 1), **_if_any(internal=ring, hand=hand, **sizes)}

    def _quantity(self, name: str, value: float | None) -> str:
        """Return the value of an attribute with its unit as text of a declaration; empty for None."""
        unit = self.document.units.get(name, "")
        return "" if value is None else f"{_text(value)} {_UNITS.get(unit, unit)}".strip()

    def _gear(self, mesh: tuple[int, int]) -> dict[str, Any]:
        """Return a gear pair as data of a declaration, involute if the file gives pressure angle and profile shift."""
        pair = {"pair": [self.name(gear) for gear in mesh]}
        left = {roles[0]: roles[1] for roles in self.relations["flank"]}
        flanks = [self.parts[left[gear]].attributes if gear in left else {} for gear in mesh]
        angle, shift = (flanks[0].get(name) for name in ("normal_pressure_angle", _SHIFT))
        if angle is None or shift is None:
            return pair
        shifts = [shift, flanks[1].get(_SHIFT, 0.0)]
        for at, gear in enumerate(mesh):
            if self.parts[gear].type == "ring_gear" and shifts[at]:
                ring = f"Profile shift of ring '{self.name(gear)}'"
                self.notes.append(f"{ring} is not read: its sign differs between programs.")
                shifts[at] = 0.0
        form = {"form": "involute", "pressure_angle": self._quantity("normal_pressure_angle", angle)}
        shown = [_text(round(shift, _DIGITS)) for shift in shifts] if any(shifts) else []
        return {**pair, "tooth_form": {**form, **_if_any(shift=shown)}}

    def _link(self, link: int) -> dict[str, Any]:
        wheels = {self.name(gear): self._wheel(gear) for gear in self.mount if self.link_of(gear) == link}
        return _if_any(wheels=wheels, copies=len(self.copies.get(link, ())))

    # ---------------------------------------------------------------------------------------------------- equal planets

    @cached_property
    def dropped(self) -> set[int]:
        """Ids of planets that are omitted, because they are copies of another planet."""
        return {copy for _, *others in self.copies.values() for copy in others}

    @cached_property
    def copies(self) -> dict[int, list[int]]:
        """Groups of evenly spaced planets with equal wheels and mates, keyed by the first planet of each group."""
        meshes: dict[int, list[tuple[Any, ...]]] = defaultdict(list)
        for mesh in self.meshes:
            for own, other in (mesh, mesh[::-1]):
                given = self.parts[own].attributes
                names = ("number_of_teeth", "normal_module", _HELIX)
                sizes = (given.get(name, 0) for name in names)
                # a planet that meshes with another planet has a mate of its own
                meshes[self.link_of(own)].append((*sizes, other, own if self.link_of(other) in self.tops else 0))
        groups: dict[tuple[Any, ...], list[int]] = defaultdict(list)
        for link in self.links:
            if link in self.tops and link not in self.tops.values() and link in meshes:
                groups[self.tops[link], *sorted(meshes[link])].append(link)
        found = {group[0]: group for group in groups.values() if len(group) > 1 and self._is_even(group)}
        for group in found.values():
            equal = ", ".join(f"'{self.name(link)}'" for link in group)
            self.notes.append(f"Equal planets {equal} are one link with copies.")
        return found

    def _is_even(self, group: list[int]) -> bool:
        """Return True if planets are evenly spaced about the axis of their carrier, or have unknown positions."""
        centre, poses = self.poses.get(self.top(group[0])), [self.poses.get(link) for link in group]
        if centre is None or None in poses:
            return True
        origin, axis = centre
        arms = [minus(pose.origin, origin) for pose in poses if pose is not None]
        angles = sorted(azimuth(arm, axis, beside(axis)) for arm in arms)
        return all(abs(b - a - tau / len(group)) < 1e-4 for a, b in pairwise(angles))

    # --------------------------------------------------------------------------------------------------------- running

    def _running(self, links: list[int]) -> dict[str, Any]:
        """Return the inputs, outputs, loads, brakes, locks, clutches and states as data of a declaration."""
        gears = int(min(max(1, self.unit.attributes.get("number_of_gears", 1)), _MOST_GEARS))
        cases = self.document.cases or [{self.unit.id: {"gear_shift_index": 1 + at}} for at in range(gears)]
        in_gear = [int(self._given(self.unit.id, case).get("gear_shift_index", 1)) for case in cases]
        states = [self._state(case, links) for case in cases]
        held: dict[str, list[Any]] = {"fixed": [], "locks": []}
        clutches: dict[str, Any] = {}
        for coupling, ends, flags in self._connections(gears):
            engaged = [flags[min(max(gear, 1), gears) - 1] for gear in in_gear]
            if self.parts[coupling].type in _RIGID or len(cases) == 1:
                held["locks" if ends[1:] else "fixed"] += [ends if ends[1:] else ends[0]] * engaged[0]
                continue
            clutches[self.name(coupling)] = {"locks": ends} if ends[1:] else {"fixes": ends[0]}
            for state in (state for state, is_engaged in zip(states, engaged, strict=True) if is_engaged):
                state.setdefault("engaged", []).append(self.name(coupling))
        # links with an external load that are not inputs
        driven = {name for state in states for name in state.get("inputs", ())}
        loaded = {self.link_of(shaft) for shaft in self.shafts if self.document.parts(shaft, "external_load")}
        names = [self.name(link) for link in links if link in loaded]
        outputs: dict[str, Any] = {name: {} for name in names if name not in driven}
        found = _if_any(**held, clutches=clutches, outputs=outputs)
        if len(states) == 1:
            return {**found, **states[0]}
        return {**found, "states": {str(1 + at): state for at, state in enumerate(states)}}

    def _given(self, part: int, case: Mapping[int, Attributes]) -> Attributes:
        """Return the attributes of a component, including its attributes in a load case."""
        return {**(self.parts[part].attributes if part in self.parts else {}), **case.get(part, {})}

    def _connections(self, gears: int) -> Iterator[tuple[int, list[str], list[bool]]]:
        """Yield id, links (without the frame) and flags of each coupling: True for speeds in which it is engaged."""
        seen = set()
        for coupling, *sides in self.relations["side"]:
            ends, part = [self.link_of(side) for side in sides], self.parts[coupling]
            if part.type not in _COUPLINGS or ends[0] == ends[1] or self.dropped & {*ends}:
                continue
            states = part.attributes.get("is_engaged", [True] * gears)
            if len(states) < gears:
                why, fix = f"it needs one value for each of the {gears} gears", "give it as an array of booleans"
                self._problem(part, "`is_engaged` is incomplete", why, fix)
                continue
            names = [self.name(end) for end in ends if end != _FRAME]
            if (key := (part.type in _RIGID, *sorted(names), *states)) not in seen:
                seen.add(key)
                yield coupling, names, states

    def _state(self, case: Mapping[int, Attributes], links: list[int]) -> dict[str, Any]:
        """Return the inputs and loads of one load case as data of a declaration."""
        inputs: dict[str, str] = {}
        loads: dict[str, float] = defaultdict(float)
        for shaft in self.shafts:
            given, link = self._given(shaft, case), self.link_of(shaft)
            if link not in links:
                continue
            speed = given.get("rotational_speed")
            if given.get("defines_speed") and speed is not None:
                inputs[self.name(link)] = self._quantity("rotational_speed", self.sense(link) * speed)
            for load in self.document.parts(shaft, "external_load"):
                torque = self._torque(self._given(load, case), speed)
                if torque is not None:
                    loads[self.name(link)] += self.sense(link) * torque
        return _if_any(inputs=inputs, loads={link: f"{_text(torque)} N m" for link, torque in loads.items()})

    def _torque(self, given: Attributes, speed: float | None) -> float | None:
        """Return the torque of a load [N m], as given or from its power [kW] and the shaft's speed [1/min]."""
        if not given.get("defines_torque", True):
            return None
        if "torque_around_u_axis" not in given and "power" in given and speed:
            self.notes.append("A load given as a power is read as the torque at the given speed.")
            return float(60_000 * given["power"] / (tau * speed))
        return given.get("torque_around_u_axis")


def _if_any(**parts: Any) -> dict[str, Any]:
    """Return a dictionary of the given parts that are not empty."""
    return {key: part for key, part in parts.items() if part}


def _clean(name: str) -> str:
    """Return a name without the bracketed id that some programs append, and with "-" for "~"."""
    return re.sub(r"\s*\[\d+\].*$", "", name).replace("~", "-").strip()


def _text(value: float) -> str:
    """Return the shortest decimal text of a number that converts back to the same number."""
    return repr(value + 0.0).removesuffix(".0")
