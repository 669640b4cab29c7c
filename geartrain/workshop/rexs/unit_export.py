"""Gear unit as a REXS model (FVA's Reusable Engineering Exchange Standard, version 1.4).

Component types, attributes, units and relations are taken from the REXS 1.4 database; see www.rexs.info. A carrier with
spur wheels on its axes becomes a planetary stage. Each state of the train becomes a gear of the unit and a load case.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from fractions import Fraction
from functools import cached_property
from math import degrees
from typing import TYPE_CHECKING, Any

from geartrain.errors import GearTrainError, Problem
from geartrain.numerics.exact import as_float
from geartrain.numerics.vectors import Vector, basis, dot, minus
from geartrain.teeth import Involute
from geartrain.workshop.rexs.rexs_document import Attributes, Model, to_json, to_xml, written

if TYPE_CHECKING:
    from geartrain.dynamics.torques.torque_results import Torques
    from geartrain.scene.layout import AxisPlace, WheelPlace
    from geartrain.scene.solids.solid_assembly import SolidModel
    from geartrain.train import GearPair, Wheel

VERSION = "1.4"
_ANGLE = 20.0  # deg, if no tooth form is declared
_DATE = "2000-01-01T00:00:00+00:00"  # fixed, so that the same train gives the same file
_STAGES = {
    ("cylindrical_gear", "cylindrical_gear"): "cylindrical_stage",
    ("cylindrical_gear", "ring_gear"): "cylindrical_stage",
    ("bevel_gear", "bevel_gear"): "bevel_stage",
    ("worm_gear", "worm_wheel"): "worm_stage",
}
"""Type of stage that REXS defines for each pair of gear types."""
_REACTIONS = ("torque_acting_on_inner_component_u", "torque_acting_on_outer_component_u")
_FLANKS = {"bevel_gear": "bevel_gear_flank", "worm_gear": "worm_gear_flank", "worm_wheel": "worm_gear_flank"}


def to_rexs(work: SolidModel, xml: bool = False) -> str:
    """Return the gear unit of a train as a REXS file, in XML if `xml` is True and in JSON if it is False."""
    return (to_xml if xml else to_json)(_Unit(work).model())


def omitted_parts(work: SolidModel) -> Iterator[Problem]:
    """Yield a problem for each part of a train that REXS cannot represent."""
    unit = _Unit(work)
    declared = unit.declared
    pairs = [gear.name for gear in declared.gears if unit.stage_of(gear) is None]
    forms = {form.form for gear in declared.gears if (form := declared.form_of(gear)) and form.form != "involute"}
    loads = [link for case in unit.cases for link, load in case.loads.items() if load.unit is None and load.value]
    shifted = [wheel for wheel in declared.wheels if declared.wheels[wheel][1].internal and unit.teeth(wheel)[1]]
    for names, what, why in (
        ([each.name for each in declared.couplings], "coupling", "REXS has only stages of two gears"),
        (pairs, "gear pair", "REXS has stages of spur wheels on parallel axes, of bevels, and of a worm and its wheel"),
        (sorted(forms), "tooth form", "REXS has flanks of involute gears only"),
        (loads, "load without a unit on link", "a torque in REXS is in N m"),
        (sorted(declared.sliding), "motion of sliding link", "a shaft in REXS only turns"),
        (shifted, "profile shift of ring", "the sign of the shift of internal gears differs between programs"),
    ):
        if names:
            text = ", ".join(f"'{name}'" for name in dict.fromkeys(names))
            yield Problem(f"REXS: {what} {text} is omitted", why, "add it in the program that reads the file")


class _Unit:
    """Components, relations and load cases of one train."""

    def __init__(self, work: SolidModel) -> None:
        self.work, self.declared = work, work.train.declaration
        self.tree, self.circuits = work.train.kinematics.tree, {each.id: each for each in work.train.circuits}
        self.components: list[Model] = []
        self.relations: list[Model] = []
        self.numbers: dict[tuple[str, str], int] = {}
        states = work.train.states or (work.scene.state,)
        self.cases = [self.declared.case(state) for state in states]

    def model(self) -> Model:
        from importlib.metadata import version

        gears = len(self.cases) if self.work.train.states else None
        first = gears and 1 + self.first
        self.unit = self.add("gear_unit", self.declared.name, number_of_gears=gears, gear_shift_index=first, **_pose())
        self.numbers["unit", ""] = self.unit
        self.casing = self.add("gear_casing", self.declared.frame, self.unit)
        for link in self.declared.links:
            self.shaft(link)
        for carrier in dict.fromkeys(self.tree.top.values()):
            self.carrier(carrier)
        for gear in self.declared.gears:
            self.stage(gear)
        for links, engaged in self.engagement.items():
            self.clutch(links, engaged)
        cases = [{"id": 1 + at, "components": self.running(at)} for at in range(len(self.cases))]
        return {
            "version": VERSION,
            "applicationId": "geartrain",
            "applicationVersion": version("geartrain"),
            "date": _DATE,
            "applicationLanguage": "en",
            "relations": self.relations,
            "components": self.components,
            **({"load_spectrum": {"id": 1, "load_cases": cases}} if any(case["components"] for case in cases) else {}),
        }

    def add(self, kind: str, name: str = "", *wholes: int, **attributes: Any) -> int:
        """Add a component that is a part of the components `wholes` and has REXS attributes; return its id."""
        number = len(self.components) + 1
        named = {"name": name} if name else {}
        self.components.append({"id": number, "type": kind, **named, "attributes": written(attributes)})
        for whole in wholes:
            self.relate("assembly", assembly=whole, part=number)
        return number

    def relate(self, kind: str, **roles: int) -> None:
        """Add a relation. Each member has its role, and its component type as a hint."""
        refs = [
            {"id": number, "role": role, "hint": self.components[number - 1]["type"]} for role, number in roles.items()
        ]
        self.relations.append({"id": len(self.relations) + 1, "type": kind, "refs": refs})

    def join(self, kind: str, name: str, inner: int, outer: int, **attributes: Any) -> int:
        """Add a bearing or coupling between two components, and return its id."""
        number = self.add(kind, name, **attributes)
        self.relate("side", assembly=number, inner_part=inner, outer_part=outer)
        return number

    # ------------------------------------------------------------------------------------------------ shafts and gears

    def shaft(self, link: str) -> None:
        """Add a shaft for a link that turns or has wheels. The coordinate along its axis is u."""
        wheels = self.declared.links[link].wheels
        if link == self.declared.frame and not wheels:
            return
        axis = self.work.layout.axes.get(self.tree.axis(link) or "")
        drives = any(link in case.inputs for case in self.cases)
        number = self.add("shaft", link, self.unit, defines_speed=drives, **_pose(axis))
        self.numbers["link", link] = number
        if link == self.declared.frame:
            self.join("coupling", f"{link} in casing", number, self.casing)
        elif self.tree.top[link] == self.declared.frame:
            self.join("concept_bearing", f"bearing of {link}", number, self.casing)
        for name, wheel in wheels.items():
            self.gear(name, wheel, number)
        if any(link in self.loads(at) for at in range(len(self.cases))):
            known = any(link in case.loads for case in self.cases)
            load = self.add("external_load", f"load on {link}", number, defines_torque=known, transmits_torque=True)
            self.numbers["load", link] = load

    def gear(self, name: str, wheel: Wheel, shaft: int) -> None:
        place = self.work.layout.wheels[name]
        axis = self.work.layout.axes.get(place.axis)
        kind, pose = self.kind(name), _pose(axis, place.centre)
        above = dot(minus(place.centre, axis.point), axis.direction) if axis else None
        sizes = {**_sizes(kind, place, wheel), **pose, "u_coordinate_on_shaft": above}
        number = self.add(kind, name, shaft, number_of_teeth=wheel.count or None, **sizes)
        self.numbers["wheel", name] = number
        teeth: Attributes = {}
        if kind in ("cylindrical_gear", "ring_gear"):
            angle, shift = self.teeth(name)
            # the sign of the shift of a ring differs between programs
            clear = None if shift and wheel.internal else shift
            teeth = {"normal_pressure_angle": angle, "addendum_modification_coefficient": clear}
        flanks = {side: self.add(_FLANKS.get(kind, "cylindrical_gear_flank"), **teeth) for side in ("left", "right")}
        self.relate("flank", gear=number, **flanks)

    def kind(self, name: str) -> str:
        """Return the component type of a gear. A wheel in mesh with a worm is a worm wheel."""
        wheel, place = self.declared.wheels[name][1], self.work.layout.wheels[name]
        if wheel.kind == "worm":
            return "worm_gear"
        if wheel.kind in ("bevel", "contrate") or place.cone:
            return "bevel_gear"
        pairs = (gear.pair for gear in self.declared.gears if name in gear.pair)
        worm = any(self.declared.wheels[mate][1].kind == "worm" for pair in pairs for mate in pair)
        return "ring_gear" if wheel.internal else "worm_wheel" if worm else "cylindrical_gear"

    def teeth(self, name: str) -> tuple[float | None, float | None]:
        """Return pressure angle [deg] and profile shift of a wheel, from its first pair with involute teeth.

        If its pairs declare no tooth form, the pressure angle is 20 deg, and the profile shift is None. If they declare
        only other tooth forms, both are None.
        """
        pairs = [gear for gear in self.declared.gears if name in gear.pair]
        forms = [(gear.pair.index(name), self.declared.form_of(gear)) for gear in pairs]
        for side, form in forms:
            if isinstance(form, Involute):
                return degrees(form.rack_angle), float(form.shift[side].value)
        return (_ANGLE if any(form is None for _, form in forms) or not forms else None), None

    # ------------------------------------------------------------------------------------------------ stages, carriers

    def stage_of(self, gear: GearPair) -> tuple[str, str, str] | None:
        """Return the stage type of a pair and the names of its two gears, or None if REXS has no such stage."""
        first, second = sorted(gear.pair, key=self.kind)
        kind = _STAGES.get((self.kind(first), self.kind(second)))
        skew = kind == "cylindrical_stage" and self.work.layout.axis_distance(first, second) is None
        return None if kind is None or skew else (kind, first, second)

    def stage(self, gear: GearPair) -> None:
        """Add a gear pair as a stage. An internal wheel becomes its second gear."""
        found = self.stage_of(gear)
        if found is None:
            return
        kind, first, second = found
        carrier = ("stage", self.circuits[gear.name].carrier)
        whole = self.numbers.get(carrier, self.unit) if kind == "cylindrical_stage" else self.unit
        distance = self.work.layout.axis_distance(first, second)
        number = self.add(kind, gear.name, whole, center_distance=distance)
        one, two = (self.numbers["wheel", wheel] for wheel in (first, second))
        self.relate("stage", stage=number, gear_1=one, gear_2=two)
        driver = self.work.train.mechanics.drivers(self.cases[self.first].state)[gear.name]
        for wheel, each in ((first, one), (second, two)):
            drives = driver.wheel == wheel if driver.known else None
            data = self.add(f"{kind}_gear_data", is_driving_gear=drives)
            self.relate("stage_gear_data", stage=number, gear=each, stage_gear_data=data)

    def carrier(self, carrier: str) -> None:
        """Add the planetary stage of a carrier with its planets, pins, side plate and central shafts."""
        planets = [link for link, top in self.tree.top.items() if top == carrier]
        if carrier == self.declared.frame:
            return
        meshes = [gear for gear in self.declared.gears if self.circuits[gear.name].carrier == carrier]
        shaft = self.numbers["link", carrier]
        if not any((self.stage_of(gear) or [""])[0] == "cylindrical_stage" for gear in meshes):
            for link in planets:
                self.join("concept_bearing", f"bearing of {link}", self.numbers["link", link], shaft)
            return
        stage = self.add("planetary_stage", f"planetary stage of {carrier}", self.unit)
        self.numbers["stage", carrier] = stage
        body = self.add("planet_carrier", carrier, stage)
        plate = self.add("side_plate", f"side plate of {carrier}", body)
        self.relate("assembly", assembly=body, part=shaft)
        self.relate("planet_carrier_shaft", planetary_stage=stage, shaft=shaft)
        self.join("coupling", f"{carrier} in side plate", shaft, plate)
        wheels = self.declared.wheels
        for link in dict.fromkeys(wheels[wheel][0] for gear in meshes for wheel in gear.pair):
            if link not in planets:
                self.relate("central_shaft", planetary_stage=stage, shaft=self.numbers["link", link])
        for label in dict.fromkeys(self.tree.axis(link) for link in planets):
            self.pin(label or "", stage, body, plate, [link for link in planets if self.tree.axis(link) == label])

    def pin(self, label: str, stage: int, body: int, plate: int, planets: Sequence[str]) -> None:
        """Add the pin of the axis `label` on a carrier, with the links `planets` that turn on it.

        stage, body, plate   ids of the planetary stage, of the shaft of the carrier and of its side plate
        """
        pin = self.add("shaft", f"pin {label}", self.unit, body, **_pose(self.work.layout.axes[label]))
        self.relate("planet_pin", planetary_stage=stage, shaft=pin)
        self.join("coupling", f"pin {label} in side plate", pin, plate)
        for link in planets:
            self.relate("planet_shaft", planetary_stage=stage, shaft=self.numbers["link", link])
            self.join("concept_bearing", f"bearing of {link}", pin, self.numbers["link", link])

    # ----------------------------------------------------------------------------------------------- clutches, running

    @cached_property
    def first(self) -> int:
        """Index of the selected state; 0 if no states are declared."""
        return [case.state for case in self.cases].index(self.work.scene.state) if self.work.train.states else 0

    @cached_property
    def engagement(self) -> Mapping[tuple[str, ...], list[bool]]:
        """Flags of each brake (key: one link) and lock (key: two links), True in states in which it is engaged."""
        found: dict[tuple[str, ...], list[bool]] = {}
        for at, case in enumerate(self.cases):
            for links in (*((link,) for link in case.fixed), *case.locks):
                if case.causes.get(links, links) == links:
                    found.setdefault(links, [False] * len(self.cases))[at] = True
        return found

    def clutch_name(self, links: tuple[str, ...]) -> str:
        """Return the declared name of a brake or clutch, or a name composed of the links that it connects."""
        declared = {links: name for case in self.cases for links, name in case.clutches.items()}
        return declared.get(links, f"{' - '.join(links)} held")

    def clutch(self, links: tuple[str, ...], engaged: list[bool]) -> None:
        """Add a brake on one link, or a lock between two links; it is switchable if a state releases it."""
        ends = [self.numbers["link", link] for link in links if ("link", link) in self.numbers]
        name, fixed = self.clutch_name(links), all(engaged) and not any(links in case.clutches for case in self.cases)
        if ends:
            kind, outer = "coupling" if fixed else "switchable_coupling", ends[1] if ends[1:] else self.casing
            states = None if fixed else engaged
            self.numbers["clutch", name] = self.join(kind, name, ends[0], outer, is_engaged=states)

    @cached_property
    def torques(self) -> Mapping[int, Torques]:
        """Torques by state index, without states whose loads are not in N m or do not determine the torques."""
        found = {}
        for at, case in enumerate(self.cases):
            if case.loads and all(load.unit or not load.value for load in case.loads.values()):
                with suppress(GearTrainError):
                    found[at] = self.work.train.torques(case.state)
        return {at: torques for at, torques in found.items() if torques.verdict}

    def loads(self, at: int) -> Mapping[str, float]:
        """Return the external torques on each link in a state [N m], without brakes and sliding links."""
        apart = {link for links in self.engagement for link in links} | self.declared.sliding
        computed = self.torques[at].external if at in self.torques else {}
        given = self.cases[at].loads.items()
        declared = {x: load.si for x, load in given if (load.unit or not load.value) and x not in self.declared.sliding}
        return {link: float(torque) for link, torque in computed.items() if link not in apart} | declared

    def running(self, at: int) -> list[Model]:
        """Return the data of one load case: engaged gear of the unit, speeds [1/min] and torques [N m]."""
        case, found = self.cases[at], []
        answer = self.work.train.solve(case.state, method="exact")
        # speeds that are not per time are taken as turns per minute
        factor = Fraction(1) if self.declared.unit_speed is None else 60 * self.declared.unit_speed
        for link, speed in (answer.speeds if answer.verdict else case.inputs).items():
            rpm = None if link in self.declared.sliding else as_float(Fraction(speed) * factor)
            if ("link", link) in self.numbers and rpm is not None:
                drives = link in case.inputs
                found.append(self.data("link", link, rotational_speed=rpm, defines_speed=drives))
        for link, torque in self.loads(at).items():
            found.append(self.data("load", link, torque_around_u_axis=torque))
        for held in self.torques[at].held if at in self.torques else ():
            if ("clutch", name := self.clutch_name(held.links)) in self.numbers and held.torques is not None:
                reactions = zip(_REACTIONS, map(float, held.torques), strict=False)
                found.append(self.data("clutch", name, **dict(reactions)))
        gear = [self.data("unit", "", gear_shift_index=1 + at)] if len(self.cases) > 1 else []
        return [*gear, *found] if found else []

    def data(self, kind: str, name: str, **attributes: Any) -> Model:
        """Return the data of one component in a load case."""
        part = self.components[self.numbers[kind, name] - 1]
        return {"id": part["id"], "type": part["type"], "name": part["name"], "attributes": written(attributes)}


def _sizes(kind: str, place: WheelPlace, wheel: Wheel) -> Attributes:
    if kind == "bevel_gear":
        return {"face_width": place.thickness, "pitch_angle": degrees(place.cone)}
    if kind in ("worm_gear", "worm_wheel"):
        return {"axial_module": place.module}
    sizes = {"normal_module": place.module / wheel.slant, "helix_angle_reference_diameter": degrees(wheel.helix)}
    return {**sizes, "face_width": place.thickness}


def _pose(axis: AxisPlace | None = None, point: Vector | None = None) -> Attributes:
    """Return the attributes of a component's pose: u is directed along its axis, and w perpendicular to it."""
    along, origin = (axis.direction, axis.point) if axis else ((0.0, 0.0, 1.0), (0.0, 0.0, 0.0))
    vectors = {"u_axis_vector": along, "support_vector": point or origin, "w_axis_vector": basis(along)[0]}
    return {name: [*map(float, each)] for name, each in vectors.items()} | {"reference_component_for_position": 1}
