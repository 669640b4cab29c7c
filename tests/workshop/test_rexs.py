"""Gear units in REXS: what version 1.4 allows, and the same speeds after writing and reading."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import pytest
import shipped
from commands import call
from shipped import train as load

import geartrain
from geartrain import GearTrain, GearTrainError
from geartrain.scene import ManufacturingSizes, SolidModel
from geartrain.workshop import notices, train_file

# ------------------------------------------------------------------------------------- what version 1.4 allows

# extract of the database of REXS 1.4 (https://database.rexs.info): unit and type of attributes
POSE = {"u_axis_vector", "support_vector", "w_axis_vector", "reference_component_for_position"}
GEAR = {*POSE, "number_of_teeth", "u_coordinate_on_shaft"}
SPUR = {*GEAR, "normal_module", "helix_angle_reference_diameter", "face_width"}
REACTIONS = {"torque_acting_on_inner_component_u", "torque_acting_on_outer_component_u"}
ATTRIBUTES = {
    **dict.fromkeys(("u_axis_vector", "support_vector", "w_axis_vector"), ("mm", "floating_point_array")),
    **dict.fromkeys(("normal_module", "axial_module", "face_width", "center_distance"), ("mm", "floating_point")),
    **dict.fromkeys(("normal_pressure_angle", "pitch_angle"), ("deg", "floating_point")),
    **dict.fromkeys(("torque_around_u_axis", *REACTIONS), ("N m", "floating_point")),
    **dict.fromkeys(("number_of_teeth", "number_of_gears", "gear_shift_index"), (None, "integer")),
    **dict.fromkeys(("defines_speed", "defines_torque", "transmits_torque", "is_driving_gear"), (None, "boolean")),
    "helix_angle_reference_diameter": ("deg", "floating_point"),
    "u_coordinate_on_shaft": ("mm", "floating_point"),
    "rotational_speed": ("1 / min", "floating_point"),
    "addendum_modification_coefficient": (None, "floating_point"),
    "reference_component_for_position": (None, "reference_component"),
    "is_engaged": (None, "boolean_array"),
}
# the attributes of each component that are used here
COMPONENTS = {
    "gear_unit": {*POSE, "number_of_gears", "gear_shift_index"},
    "shaft": {*POSE, "defines_speed", "rotational_speed"},
    "external_load": {"defines_torque", "transmits_torque", "torque_around_u_axis"},
    "cylindrical_gear": SPUR,
    "ring_gear": SPUR,
    "bevel_gear": {*GEAR, "face_width", "pitch_angle"},
    "worm_gear": {*GEAR, "axial_module"},
    "worm_wheel": {*GEAR, "axial_module"},
    "cylindrical_gear_flank": {"normal_pressure_angle", "addendum_modification_coefficient"},
    "cylindrical_stage": {"center_distance"},
    "worm_stage": {"center_distance"},
    "coupling": REACTIONS,
    "switchable_coupling": {*REACTIONS, "is_engaged"},
    **{f"{kind}_stage_gear_data": {"is_driving_gear"} for kind in ("cylindrical", "bevel", "worm")},
    **{kind: set() for kind in ("gear_casing", "planetary_stage", "planet_carrier", "side_plate", "concept_bearing")},
    **{kind: set() for kind in ("bevel_stage", "bevel_gear_flank", "worm_gear_flank")},
}
STAGES = ("cylindrical_stage", "bevel_stage", "worm_stage")
OF_PLANETS = ("central_shaft", "planet_shaft", "planet_pin", "planet_carrier_shaft")
ALLOWED = {
    "assembly": {
        *(("gear_unit", part) for part in ("gear_casing", "shaft", "planetary_stage", *STAGES)),
        *(("shaft", part) for part in ("cylindrical_gear", "ring_gear", "bevel_gear", "worm_gear", "worm_wheel")),
        *(("planetary_stage", "planet_carrier"), ("planetary_stage", "cylindrical_stage"), ("shaft", "external_load")),
        *(("planet_carrier", "shaft"), ("planet_carrier", "side_plate")),
    },
    **{kind: {("planetary_stage", "shaft")} for kind in OF_PLANETS},
    "flank": {
        *((gear, *["cylindrical_gear_flank"] * 2) for gear in ("cylindrical_gear", "ring_gear")),
        *((gear, *["worm_gear_flank"] * 2) for gear in ("worm_gear", "worm_wheel")),
        ("bevel_gear", *["bevel_gear_flank"] * 2),
    },
    "side": {
        *((kind, "shaft", "gear_casing") for kind in ("concept_bearing", "coupling", "switchable_coupling")),
        *((kind, "shaft", "shaft") for kind in ("concept_bearing", "coupling", "switchable_coupling")),
        ("coupling", "shaft", "side_plate"),
    },
    "stage": {
        *(("cylindrical_gear", gear, "cylindrical_stage") for gear in ("cylindrical_gear", "ring_gear")),
        *(("bevel_gear", "bevel_gear", "bevel_stage"), ("worm_gear", "worm_wheel", "worm_stage")),
    },
    "stage_gear_data": {
        *((gear, "cylindrical_stage", "cylindrical_stage_gear_data") for gear in ("cylindrical_gear", "ring_gear")),
        *((gear, "worm_stage", "worm_stage_gear_data") for gear in ("worm_gear", "worm_wheel")),
        ("bevel_gear", "bevel_stage", "bevel_stage_gear_data"),
    },
}
ROLES = {
    "assembly": ("assembly", "part"),
    **dict.fromkeys(OF_PLANETS, ("planetary_stage", "shaft")),
    "flank": ("gear", "left", "right"),
    "side": ("assembly", "inner_part", "outer_part"),
    "stage": ("gear_1", "gear_2", "stage"),
    "stage_gear_data": ("gear", "stage", "stage_gear_data"),
}


def solid(train: GearTrain) -> SolidModel:
    return SolidModel(train, ManufacturingSizes(), train.states[0] if train.states else None)


def rexs(train: str | GearTrain) -> dict[str, Any]:
    work = solid(load(train) if isinstance(train, str) else train)
    return dict(json.loads(train_file(work, "rexs"))["model"])


def parts(model: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """Components of the model, and of its load cases."""
    yield from model["components"]
    for case in model.get("load_spectrum", {"load_cases": []})["load_cases"]:
        yield from case["components"]


def values(part: dict[str, Any]) -> dict[str, Any]:
    return {each["id"]: next(v for k, v in each.items() if k not in ("id", "unit")) for each in part["attributes"]}


EXAMPLES = ["planetary", "nrel-grc-750", "bevel-differential", "worm", "freeth-2021", "zf-8hp70", "planets-in-place"]


@pytest.mark.parametrize("name", EXAMPLES)
def test_components_attributes_and_relations_are_those_of_version_1_4(name: str) -> None:
    model = rexs(name)
    assert model["version"] == "1.4"
    assert re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\+\d\d:\d\d", model["date"])
    components = {each["id"]: each for each in model["components"]}
    assert len(components) == len(model["components"])
    for part in parts(model):
        assert part["type"] == components[part["id"]]["type"]
        assert {each["id"] for each in part["attributes"]} <= COMPONENTS[part["type"]], part["type"]
        for each in part["attributes"]:
            unit, key = ATTRIBUTES[each["id"]]
            assert each.get("unit") == unit
            assert set(each) == {"id", key} | ({"unit"} if unit else set())
    for relation in model["relations"]:
        assert all(components[ref["id"]]["type"] == ref["hint"] for ref in relation["refs"])
        hints = {ref["role"]: ref["hint"] for ref in relation["refs"]}
        roles = ROLES[relation["type"]]
        assert set(hints) == set(roles)
        assert tuple(hints[role] for role in roles) in ALLOWED[relation["type"]]
    related = {ref["id"] for relation in model["relations"] for ref in relation["refs"]}
    assert related == set(components)


def test_teeth_distances_and_speeds_of_a_turbine_gearbox() -> None:
    model = rexs("nrel-grc-750")
    components = {each["name"]: each for each in model["components"] if "name" in each}
    declaration = load("nrel-grc-750").declaration
    for wheel, (_, kind) in declaration.wheels.items():
        assert values(components[wheel])["number_of_teeth"] == kind.count
        assert components[wheel]["type"] == ("ring_gear" if kind.internal else "cylindrical_gear")
    for first, second in pairwise(["s21", "p39"]):
        stage = next(gear.name for gear in declaration.gears if set(gear.pair) == {first, second})
        distance = values(components[stage])["center_distance"]
        assert distance == pytest.approx(values(components[first])["normal_module"] * (21 + 39) / 2)
    (case,) = model["load_spectrum"]["load_cases"]
    speeds = {part["name"]: values(part)["rotational_speed"] for part in case["components"]}
    assert speeds["low"] / speeds["rotor"] == pytest.approx(1 + 99 / 21), "Willis: 1 + ring over sun"


def test_a_loaded_set_has_its_torques_and_the_flanks_of_its_gears() -> None:
    """The carrier bears -(1 + 61/17) of the sun's torque, and the casing 61/17 of it."""
    train = geartrain.load(SET + "loads: {sun: 1591.549 N m}\ntooth_form: {form: involute, shift: [0.3, -0.3]}\n")
    model = rexs(train)
    (case,) = model["load_spectrum"]["load_cases"]
    torques = {part["name"]: values(part) for part in case["components"] if part["type"] != "shaft"}
    assert torques["load on sun"]["torque_around_u_axis"] == 1591.549
    assert torques["load on carrier"]["torque_around_u_axis"] == pytest.approx(-1591.549 * 78 / 17, rel=1e-12)
    assert torques["ring held"]["torque_acting_on_inner_component_u"] == pytest.approx(1591.549 * 61 / 17, rel=1e-12)
    external = [part for part in model["components"] if part["type"] == "external_load"]
    defined = {part["name"]: values(part)["defines_torque"] for part in external}
    assert defined == {"load on sun": True, "load on carrier": False}
    components = {part["id"]: part for part in model["components"]}
    flanks = {
        components[refs["gear"]]["name"]: values(components[refs["left"]])
        for relation in model["relations"]
        if relation["type"] == "flank"
        for refs in [{ref["role"]: ref["id"] for ref in relation["refs"]}]
    }
    assert flanks["g17"] == {"normal_pressure_angle": 20.0, "addendum_modification_coefficient": 0.3}
    assert flanks["g22"]["addendum_modification_coefficient"] == -0.3
    assert "addendum_modification_coefficient" not in flanks["g61"], "the sign of a ring's shift is ambiguous"


def test_parts_that_rexs_cannot_represent_are_named() -> None:
    for name, expected in OMITTED.items():
        assert expected in " ".join(each.what for each in notices(solid(load(name)), ["rexs"]))
    assert not notices(solid(load("planetary-24-18-60")), ["rexs"])
    jack = [part["name"] for part in parts(rexs("screw-jack")) if "rotational_speed" in values(part)]
    assert jack == ["screw"], "the travel of the ram is not a speed of rotation"


OMITTED = {
    "cycloidal-reducer": "coupling 'holes' is omitted",
    "crossed-helical": "gear pair 'd20~w20' is omitted",
    "screw-jack": "motion of sliding link 'ram' is omitted",
    "norton-compound": "load without a unit on link 'F' is omitted",
    "planetary-24-18-60-triangular": "tooth form 'triangular' is omitted",
}

# ------------------------------------------------------------------------------------------------ there and back

SET = """
name: set
links:
  casing: {}
  sun: {wheels: {g17: {teeth: 17, module: 4 mm, face_width: 50 mm}}}
  ring: {wheels: {g61: {teeth: 61, internal: true, module: 4 mm}}}
  planet: {wheels: {g22: {teeth: 22, module: 4 mm}}, copies: 3}
  carrier: {}
frame: casing
revolutes: {main: [casing, sun, ring, carrier], P: [carrier, planet]}
gears: [g17 ~ g22, g22 ~ g61]
fixed: [ring]
inputs: {sun: 1500 rpm}
outputs: {carrier: {}}
"""


def written(train: GearTrain, folder: Path, suffix: str = ".rexsj") -> Path:
    path = folder / f"unit{suffix}"
    path.write_bytes(train_file(solid(train), {".rexsj": "rexs", ".rexs": "rexs-xml"}[suffix]))
    return path


def unit(path: Path) -> GearTrain:
    """Return the train that `init` reads from a file."""
    done = call("init", "--from", path, "-o", "-")
    if done.exception is not None:
        raise done.exception
    return geartrain.load(done.stdout)


def assert_same_speeds(train: GearTrain, read: GearTrain) -> None:
    """Every link of the read train has its speed in the written one; speeds are in turns per minute in the file."""
    states = train.states or (None,)
    assert len(states) == len(read.states or (None,))
    for state, other in zip(states, read.states or (None,), strict=True):
        case, found, again = train.declaration.case(state), train.solve(state), read.solve(other)
        assert again.verdict.kind == found.verdict.kind
        if not found.verdict:
            continue
        # a written input is a float, so all speeds have its rounding error as common factor
        factors = {Fraction(again[link]) / Fraction(speed) for link, speed in case.inputs.items() if speed}
        for link, speed in found.speeds.items():
            if len(factors) == 1 and link in again.speeds:
                assert Fraction(again[link]) == Fraction(speed) * next(iter(factors)), link
            elif link in again.speeds:
                scale = 60 * train.declaration.unit_speed if train.declaration.unit_speed else 1
                assert float(again[link]) == pytest.approx(float(Fraction(speed) * scale), rel=1e-12)
        kept = train.declaration.links.keys() - read.declaration.links.keys()
        # equal planets that were declared one by one are one link with copies
        assert all(train.declaration.links[link].wheels for link in kept)


PLANETARY = [
    *("planetary", "planetary-24-18-60", "planetary-24-18-60-involute", "planetary-24-18-60-triangular"),
    *("planets-in-place", "three-planets", "norton-planetary", "norton-compound", "wolfrom-175", "two-k-h-10000"),
    *("ferguson-paradox", "prius-power-split", "ravigneaux-set", "simpson-set", "gm-4t60", "nrel-grc-750"),
    *("zf-8hp70", "zf-9hp48", "ford-10r80", "mercedes-9g-tronic", "pennestri-2002"),
]


@pytest.mark.parametrize("name", PLANETARY)
def test_a_planetary_is_read_with_the_same_speeds_in_every_state(name: str, tmp_path: Path) -> None:
    train = load(name)
    read = {suffix: unit(written(train, tmp_path, suffix)) for suffix in (".rexsj", ".rexs")}
    assert read[".rexsj"].declaration.model_dump() == read[".rexs"].declaration.model_dump()
    assert_same_speeds(train, read[".rexsj"])


@pytest.mark.parametrize("name", shipped.every_train(step=2))
def test_every_train_is_read_with_the_same_speeds_or_what_is_missing_is_named(name: str, tmp_path: Path) -> None:
    train = load(name)
    kinds = {wheel.kind for _, wheel in train.declaration.wheels.values()}
    path = written(train, tmp_path)
    ways = {(0.0, 0.0, 1.0), *(axis.way for axis in train.declaration.axes.values())}
    if kinds & {"bevel", "worm", "contrate"} or len(ways) > 1:
        with pytest.raises(GearTrainError, match=r"stage is not read|not parallel") as found:
            unit(path)
        assert all(each.why and each.fix for each in found.value.problems)
    elif train.declaration.couplings:
        assert [each for each in notices(solid(train), ["rexs"]) if "coupling" in each.what]
    else:
        assert_same_speeds(train, unit(path))


def test_sizes_loads_teeth_and_copies_are_read_with_their_units(tmp_path: Path) -> None:
    text = SET.replace("module: 4 mm}", "module: 4 mm, helix_angle: 12 deg}")
    text = text.replace("face_width: 50 mm}", "face_width: 50 mm, helix_angle: 12 deg, hand: left}")
    train = geartrain.load(text + "loads: {sun: 10 N m}\ntooth_form: {form: involute, pressure_angle: 25 deg}\n")
    read = unit(written(train, tmp_path)).declaration
    wheels: dict[str, Any] = {name: wheel for name, (_, wheel) in read.wheels.items()}
    form: Any = read.tooth_form
    assert {name: wheel.count for name, wheel in wheels.items()} == {"g17": 17, "g61": 61, "g22": 22}
    assert wheels["g61"].internal
    assert wheels["g17"].module.si == pytest.approx(0.004, rel=1e-12)
    assert wheels["g17"].face_width.text == "50 mm"
    assert (wheels["g17"].hand, wheels["g22"].hand, wheels["g61"].hand) == ("left", "right", None)
    assert wheels["g22"].helix_angle.si == pytest.approx(0.20943951, rel=1e-7)
    assert read.links["planet"].copies == 3
    assert {link: load.text for link, load in read.loads.items()} == {"sun": "10 N m"}
    assert {link: speed.text for link, speed in read.inputs.items()} == {"sun": "1500 rpm"}
    assert form.pressure_angle.text == "25 deg"
    assert (read.fixed, [*read.outputs]) == (("ring",), ["carrier"])
    position: Any = read.axes["planet"].position
    # a module of 4 mm across a helix of 12 deg, whose cosine is 0.9781476007
    assert float(position[0].si) == pytest.approx(0.004 * 39 / 2 / 0.9781476007, rel=1e-9)


@pytest.mark.parametrize("cases", [True, False])
def test_clutches_and_gears_are_states_with_and_without_load_cases(cases: bool, tmp_path: Path) -> None:
    path = written(load("ravigneaux-set"), tmp_path)
    model = json.loads(path.read_text(encoding="utf-8"))
    if not cases:
        del model["model"]["load_spectrum"]
    path.write_text(json.dumps(model), encoding="utf-8")
    read = unit(path).declaration
    assert {name: each.fixes or each.locks for name, each in read.clutches.items()} == {
        **{"K1": ("IN", "SMALL"), "K2": ("IN", "LARGE"), "K3": ("IN", "CARRIER")},
        **{"B1": "LARGE", "B2": "CARRIER"},
    }
    engaged = [{*state.engaged} for state in read.states.values()]
    assert engaged == [{"K1", "B2"}, {"K1", "B1"}, {"K1", "K3"}, {"K3", "B1"}, {"K2", "B2"}]


# ------------------------------------------------------------------------------------------- files of other programs

# in the form of files that other programs write: ids in names, version 1.1 with its own names of types, planets as
# separate components, pins and side plates of the carrier, a ring held by a switchable coupling, no load cases
OLD = """<?xml version="1.0" encoding="UTF-8" standalone="no"?>
<model applicationId="Program" applicationVersion="5" date="2019-06-05T11:46:35+02:00" version="1.1">
<relations>{relations}</relations>
<components>
<component id="1" name="Gear unit [1]" type="gear_unit"/>
<component id="2" name="Casing [2]" type="gear_casing"/>
<component id="3" name="Carrier [3]" type="planet_carrier"/>
<component id="8" name="Pin [8] @ 0,0°" type="shaft">{pin}</component>
<component id="4" name="Arm [4]" type="shaft">{middle}</component>
<component id="5" name="Sun [5]" type="shaft">{middle}
  <attribute id="rotational_speed" unit="1 / min">1500.0</attribute>
  <attribute id="defines_speed" unit="none">true</attribute></component>
<component id="6" name="Ring [6]" type="shaft">{middle}</component>
<component id="7" name="Planet [7] @ 0,0°" type="shaft">{pin}</component>
<component id="17" name="Planet [7] @ 180,0°" type="shaft">{other}</component>
<component id="9" name="Stage [9]" type="planetary_stage"/>
<component id="10" name="Mesh [10]" type="cylindrical_stage"/>
<component id="11" name="Mesh [11]" type="cylindrical_stage"/>
<component id="20" name="Mesh [10]" type="cylindrical_stage"/>
<component id="21" name="Mesh [11]" type="cylindrical_stage"/>
<component id="12" name="Sun gear [12]" type="cylindrical_gear">{teeth[17]}</component>
<component id="13" name="Planet gear [13]" type="cylindrical_gear">{teeth[22]}</component>
<component id="23" name="Planet gear [13]" type="cylindrical_gear">{teeth[22]}</component>
<component id="14" name="Ring gear [14]" type="ring_gear">{teeth[61]}</component>
<component id="15" name="Brake [15]" type="switchable_coupling">
  <attribute id="is_engaged" unit="none"><array><c>true</c></array></attribute></component>
<component id="16" name="Plate [16]" type="side_plate"/>
<component id="18" name="Fit [18]" type="coupling"/>
<component id="19" name="Load [19]" type="external_load">
  <attribute id="torque_around_u_axis" unit="N m">1591.5</attribute>
  <attribute id="defines_torque" unit="none">true</attribute></component>
<component id="25" name="Load [25]" type="external_load">
  <attribute id="transmits_torque" unit="none">true</attribute></component>
<component id="22" name="Flank [22]" type="flank_geometry">
  <attribute id="normal_pressure_angle" unit="°">20.0</attribute></component>
<component id="24" name="Steel [24]" type="material"/>
</components></model>"""
RELATED = [
    *("assembly assembly=1 part=2", "assembly assembly=9 part=3", "assembly assembly=3 part=4"),
    *("assembly assembly=3 part=8", "assembly assembly=3 part=16", "assembly assembly=9 part=10"),
    *("planet_carrier_shaft planetary_stage=9 shaft=4", "planet_pin planetary_stage=9 shaft=8"),
    *("planet_shaft planetary_stage=9 shaft=7", "planet_shaft planetary_stage=9 shaft=17"),
    *("central_shaft planetary_stage=9 shaft=5", "central_shaft planetary_stage=9 shaft=6"),
    *("assembly assembly=5 part=12", "assembly assembly=7 part=13", "assembly assembly=17 part=23"),
    *("assembly assembly=6 part=14", "assembly assembly=5 part=19", "assembly assembly=4 part=25"),
    *("stage stage=10 gear_1=12 gear_2=13", "stage stage=11 gear_1=13 gear_2=14"),
    *("stage stage=20 gear_1=12 gear_2=23", "stage stage=21 gear_1=23 gear_2=14"),
    *("side assembly=15 inner_part=6 outer_part=2", "side assembly=18 inner_part=8 outer_part=16"),
    "flank gear=12 left=22 right=22",
]


def old_file(folder: Path, changes: dict[str, str] | None = None, related: list[str] = RELATED) -> Path:
    def pose(x: float, y: float) -> str:
        vectors = {"support_vector": (0, x, y), "u_axis_vector": (1, 0, 0), "w_axis_vector": (0, 0, 1)}
        rows = {name: "".join(f"<c>{each}</c>" for each in vector) for name, vector in vectors.items()}
        return "".join(f'<attribute id="{k}" unit="mm"><array>{row}</array></attribute>' for k, row in rows.items())

    def relation(number: int, text: str) -> str:
        kind, *roles = text.split()
        refs = "".join('<ref role="{}" id="{}"/>'.format(*role.split("=")) for role in roles)
        return f'<relation id="{number}" type="{kind}">{refs}</relation>'

    module = '<attribute id="normal_module" unit="mm">4.0</attribute>'
    teeth = {count: f'<attribute id="number_of_teeth">{count}</attribute>{module}' for count in (17, 22, 61)}
    text = OLD.format(
        relations="".join(relation(at, each) for at, each in enumerate(related)),
        **{"middle": pose(0, 0), "pin": pose(0, 78), "other": pose(0, -78), "teeth": teeth},
    )
    for old, new in (changes or {}).items():
        assert old in text
        text = text.replace(old, new)
    path = folder / "old.rexs"
    path.write_text(text, encoding="utf-8")
    return path


def test_a_planetary_of_another_program_is_read(tmp_path: Path) -> None:
    done = call("init", "--from", old_file(tmp_path), "-o", "-")
    read = geartrain.load(done.stdout)
    assert {link: str(speed) for link, speed in read.solve().speeds.items()} == {
        **{"Casing": "0", "Arm": "4250/13", "Sun": "1500", "Ring": "0", "Planet": "-6375/11"},
    }
    assert read.declaration.links["Planet"].copies == 2
    assert read.torques().external["Arm"] == Fraction(-3183, 2) * Fraction(78, 17)
    assert "note: Not read: 1 material." in done.stderr
    assert "# Read from old.rexs (Program, REXS 1.1)." in done.stdout


def test_planets_that_are_not_evenly_spaced_stay_separate_and_an_archive_is_read(tmp_path: Path) -> None:
    with ZipFile(tmp_path / "old.rexsz", "w") as archive:
        archive.write(old_file(tmp_path, {"<c>-78</c>": "<c>70</c>"}), "rexs-model.rexs")
    read = unit(tmp_path / "old.rexsz")
    assert [link for link in read.declaration.links if link.startswith("Planet")] == ["Planet", "Planet 17"]
    assert read.solve()["Arm"] == Fraction(4250, 13)


def helical(folder: Path, last_axis: float, driver: int, speed: float) -> Path:
    """Two helical stages with two load cases; the last of shafts 12 to 14 may have its u-axis against the others."""

    def part(number: int, kind: str, *attributes: tuple[str, str, str, Any]) -> dict[str, Any]:
        written = [{"id": name, "unit": unit, key: value} for name, unit, key, value in attributes]
        return {"id": number, "type": kind, "name": f"{kind} [{number}]", "attributes": written}

    def relation(kind: str, **roles: int) -> dict[str, Any]:
        return {"id": 1, "type": kind, "refs": [{"id": number, "role": role} for role, number in roles.items()]}

    components = [part(20, "cylindrical_stage"), part(21, "cylindrical_stage")]
    for number, y, along in ((12, 0.0, 1.0), (13, 80.0, 1.0), (14, 155.0, last_axis)):
        pose = {"support_vector": [0.0, y, 0.0], "u_axis_vector": [along, 0.0, 0.0], "w_axis_vector": [0.0, 0.0, 1.0]}
        vectors = [(name, "mm", "floating_point_array", vector) for name, vector in pose.items()]
        components.append(part(number, "shaft", *vectors, ("defines_speed", "none", "boolean", number == driver)))
    for number, teeth, helix in ((15, 20, 15.0), (16, 60, -15.0), (17, 25, 10.0), (18, 50, -10.0)):
        angle = ("helix_angle_reference_diameter", "deg", "floating_point", helix)
        components.append(part(number, "cylindrical_gear", ("number_of_teeth", "none", "integer", teeth), angle))
    components.append(part(40, "external_load", ("defines_torque", "none", "boolean", True)))
    cases = []
    for number, share, torque in ((1, 1.0, 5.0), (2, 0.5, 7.5)):
        turns = part(driver, "shaft", ("rotational_speed", "1 / min", "floating_point", share * speed))
        load = part(40, "external_load", ("torque_around_u_axis", "N m", "floating_point", torque))
        cases.append({"id": number, "components": [turns, load]})
    model = {
        **{"version": "1.4", "applicationId": "Other", "applicationVersion": "1", "date": "2022-04-21T11:42:31+01:00"},
        "relations": [
            *(relation("assembly", assembly=a, part=b) for a, b in ((12, 15), (13, 16), (13, 17), (14, 18), (12, 40))),
            relation("stage", stage=20, gear_1=15, gear_2=16),
            relation("stage", stage=21, gear_1=17, gear_2=18),
        ],
        "components": components,
        "load_spectrum": {"id": 1, "load_cases": cases},
    }
    path = folder / "helical.rexsj"
    path.write_text(json.dumps({"model": model}), encoding="utf-8")
    return path


@pytest.mark.parametrize("last_axis", [1.0, -1.0])
def test_load_cases_are_states_and_speeds_are_about_the_u_axis_of_a_shaft(last_axis: float, tmp_path: Path) -> None:
    read = unit(helical(tmp_path, last_axis, 12, 600.0))
    # 600 (20/60) (25/50) about the axis of the first shaft, whichever way the u-axis of the last one points
    assert [read.solve(state)["shaft 14"] for state in ("1", "2")] == [100, 50]
    loads = [state.loads["shaft"].text for state in read.declaration.states.values() if state.loads]
    assert loads == ["5 N m", "7.5 N m"]
    assert unit(helical(tmp_path, last_axis, 14, 100 * last_axis)).solve("1")["shaft"] == 600


WORM = {'name="Mesh [10]" type="cylindrical_stage"': 'name="Mesh [10]" type="worm_stage"'}


@pytest.mark.parametrize(
    ("changes", "lost", "said"),
    [
        (WORM, "", "Mesh [10]: worm stage is not read"),
        ({'<attribute id="number_of_teeth">17</attribute>': ""}, "", "Sun gear [12]: gear has no tooth count"),
        ({"<c>true</c>": ""}, "", "Brake [15]: `is_engaged` is incomplete"),
        ({"<array><c>true</c></array>": "false"}, "", "`is_engaged` of component 15 is 'false', not a boolean_array"),
        ({">4.0<": ">four<"}, "", "`normal_module` of component 12 is 'four', not a floating_point"),
        ({'unit="N m"': 'unit="kN m"'}, "", "`torque_around_u_axis` of component 19 has the unit 'kN m', not 'N m'"),
        ({"<c>-78</c>": "<c>y</c>"}, "", "`support_vector` of component 17 is ['0', '0', 'y']"),
        ({}, "assembly assembly=5 part=12", "Sun gear [12]: gear is not mounted on a shaft"),
        ({}, "planet_carrier_shaft planetary_stage=9 shaft=4", ""),
        ({'type="cylindrical_stage"': 'type="mesh"', 'type="planetary_stage"': 'type="set"'}, "", "has no gear stage"),
        ({'role="part" id="19"': 'role="part" id="99"'}, "", "refers to the missing component 99"),
        ({'role="gear_2" id="13"': 'role="gear" id="13"'}, "", "a relation 'stage' has no role 'gear_2'"),
        ({"<model ": "<!DOCTYPE model><model "}, "", "document type declaration is not allowed"),
        ({"<model ": "<gear ", "</model>": "</gear>"}, "", "the root element is <gear>, not <model>"),
        ({"</components>": ""}, "", "this is not a REXS model"),
    ],
)
def test_what_cannot_be_read_is_named(changes: dict[str, str], lost: str, said: str, tmp_path: Path) -> None:
    path = old_file(tmp_path, changes, [each for each in RELATED if each != lost])
    if not said:
        # the carrier is known from its parts as well
        assert unit(path).solve()["Arm"] == Fraction(4250, 13)
        return
    with pytest.raises(GearTrainError) as found:
        unit(path)
    assert any(said in f"{each.what} {each.why}" for each in found.value.problems)
    assert all(each.place and each.why and each.fix for each in found.value.problems)


# -------------------------------------------------------------------------------------------------------- command line


def test_init_reads_a_gear_unit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for suffix in ("rexsj", "rexs"):
        assert call("export", "wolfrom-175", "-o", f"unit.{suffix}").exit_code == 0
        done = call("init", "--from", f"unit.{suffix}", "--force")
        assert done.exit_code == 0
        assert "next: geartrain check unit.yaml" in done.output
        assert geartrain.load("unit.yaml").solve()["output"] * 175 == 1
        assert call("check", "unit.yaml").exit_code == 0
    assert "give KIND" in call("init").output
    assert "both given" in call("init", "clock", "--from", "unit.rexs").output
    assert "cannot be read" in call("init", "--from", "missing.rexs", "-o", "-").output
    noted = call("export", "cycloidal-reducer", "-o", "cycloidal.rexs").output
    assert "note: REXS: coupling 'holes' is omitted" in noted
