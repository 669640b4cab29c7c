"""Writer and reader of REXS files in JSON (.rexsj) and in XML (.rexs).

The structure follows the JSON file: components with attributes, relations of components, and load cases. See the
specification of REXS 1.4, "Interface structure" and "JSON as an alternative file format" (www.rexs.info).
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from io import BytesIO
from math import isfinite
from pathlib import Path
from typing import Any
from xml.etree import ElementTree
from zipfile import BadZipFile, ZipFile

from geartrain.errors import GearTrainError, Problem

_UNREADABLE = (LookupError, TypeError, AttributeError, ArithmeticError, ValueError, RecursionError)
Model = dict[str, Any]
"""REXS model with the structure of a JSON file: metadata, `relations`, `components`, and optionally `load_spectrum`."""
Attributes = Mapping[str, Any]
"""Values of attributes, keyed by attribute name."""

_NAMES = {
    ("floating_point_array", "mm"): "u_axis_vector support_vector w_axis_vector",
    ("floating_point", "mm"): "normal_module axial_module face_width center_distance u_coordinate_on_shaft",
    ("floating_point", "deg"): "helix_angle_reference_diameter normal_pressure_angle pitch_angle",
    ("floating_point", "N m"): "torque_around_u_axis "
    "torque_acting_on_inner_component_u torque_acting_on_outer_component_u",
    ("floating_point", "1 / min"): "rotational_speed",
    ("floating_point", "kW"): "power",
    ("floating_point", ""): "addendum_modification_coefficient",
    ("integer", ""): "number_of_teeth number_of_gears gear_shift_index",
    ("boolean", ""): "defines_speed defines_torque transmits_torque is_driving_gear",
    ("boolean_array", ""): "is_engaged",
    ("reference_component", ""): "reference_component_for_position",
}
_ATTRIBUTES = {name: kind for kind, names in _NAMES.items() for name in names.split()}
"""Type and unit of the attributes that are written or read."""
_OTHER_UNITS = {"deg": ("°", "rad"), "1 / min": ("rad / s",)}
"""Alternative spellings of units that are accepted from older files and from files of other programs."""
_ROLES: Mapping[str, Sequence[str]] = {
    **{"assembly": ("assembly", "part"), "side": ("assembly", "inner_part", "outer_part")},
    **{"stage": ("stage", "gear_1", "gear_2"), "flank": ("gear", "left")},
    **dict.fromkeys(("central_shaft", "planet_shaft"), ("planetary_stage", "shaft")),
    **dict.fromkeys(("planet_pin", "planet_carrier_shaft"), ("planetary_stage", "shaft")),
}
"""Roles of the components in each type of relation that is read."""
_EXPORT = "export the gear unit again as REXS 1.0 to 1.4, in JSON (.rexsj) or XML (.rexs)"


@dataclass(frozen=True, slots=True)
class RexsComponent:
    """Component of a gear unit, such as a shaft, a gear or a stage."""

    id: int
    type: str
    name: str
    attributes: Attributes


@dataclass(frozen=True, slots=True)
class RexsDocument:
    """Gear unit as read from a REXS file."""

    place: str
    """Name of the file."""
    origin: str
    """Name of the program that wrote the file, and REXS version of the file."""
    components: Mapping[int, RexsComponent]
    """Components keyed by id, in the order of the file."""
    relations: Mapping[str, Sequence[tuple[int, ...]]]
    """Component ids of each relation in the order of `_ROLES`, keyed by the type of the relation."""
    cases: Sequence[Mapping[int, Attributes]]
    """Attributes of components in each load case, keyed by component id."""
    units: Mapping[str, str]
    """Unit of each attribute as written in the file; empty for pure numbers and flags."""

    def parts(self, assembly: int, kind: str) -> list[int]:
        """Return the ids of all components of one type that are parts of the component `assembly`."""
        found = (part for whole, part in self.relations["assembly"] if whole == assembly)
        return [part for part in found if self.components[part].type == kind]

    def of_type(self, *kinds: str) -> list[int]:
        """Return the ids of all components of the given types."""
        return [each.id for each in self.components.values() if each.type in kinds]


# ------------------------------------------------------------------------------------------------------------- writing


def written(attributes: Attributes) -> list[Model]:
    """Return all attributes whose value is not None as a list of REXS attributes with their types and units."""
    found = []
    for name, value in attributes.items():
        kind, unit = _ATTRIBUTES[name]
        if value is not None:
            found.append({"id": name, **({"unit": unit} if unit else {}), kind: value})
    return found


def to_json(model: Model) -> str:
    """Return the content of a JSON file that contains the given model."""
    # JSON has no NaN, so an undefined size must raise an error here and not in the reading program
    return json.dumps({"model": model}, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def to_xml(model: Model) -> str:
    """Return the content of an XML file with the given model, and with the byte order mark that REXS 1.4 requires."""
    root = _element("model", model)
    ElementTree.indent(root)
    return f'\ufeff<?xml version="1.0" encoding="UTF-8"?>\n{ElementTree.tostring(root, encoding="unicode")}\n'


def _element(tag: str, content: Any) -> ElementTree.Element:
    """Return a part of a JSON structure as an XML element with the given tag."""
    node = ElementTree.Element(tag)
    if not isinstance(content, dict):
        node.text = _scalar(content)
        return node
    for key, value in content.items():
        if isinstance(value, dict):
            node.append(_element(key, value))
        elif isinstance(value, list):
            name, item = ("array", "c") if tag == "attribute" else (key, key[:-1])
            # other lists have no element of their own
            inside = ElementTree.SubElement(node, name) if tag in ("model", "attribute") else node
            inside.extend(_element(item, each) for each in value)
        elif tag == "attribute" and key not in ("id", "unit"):
            node.text = _scalar(value)
        else:
            node.set(key, _scalar(value))
    return node


def _scalar(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


# ------------------------------------------------------------------------------------------------------------- reading


def read_document(path: Path) -> RexsDocument:
    """Read a REXS file in JSON or XML.

    Raises `GearTrainError` if the file cannot be read, or does not contain a REXS model.
    """
    place = str(path)
    try:
        data = path.read_bytes()
    except OSError as error:
        what, fix = "the file cannot be read", "give the name of a .rexsj or .rexs file"
        raise GearTrainError(Problem(what, str(error.strerror), fix, place)) from None
    try:
        text = _unpacked(data).decode("utf-8-sig").lstrip()
        model = _from_xml(text) if text.startswith("<") else json.loads(text)["model"]
        return _document(model, place)
    except (*_UNREADABLE, ElementTree.ParseError, BadZipFile) as error:
        missing = f"key '{error.args[0]}' is missing" if isinstance(error, KeyError) else ""
        why = missing or str(error) or type(error).__name__
        raise GearTrainError(Problem("this is not a REXS model", why, _EXPORT, place)) from None


def _unpacked(data: bytes) -> bytes:
    """Return the model file in a ZIP archive (.rexsz), or the given data if they are not an archive."""
    if data[:2] != b"PK":
        return data
    with ZipFile(BytesIO(data)) as archive:
        names = [
            each for each in archive.namelist() if Path(each).suffix in (".rexs", ".rexsj") and "__MACOSX" not in each
        ]
        if not names:
            raise ValueError("the archive contains no .rexs or .rexsj file")
        return archive.read(names[0])


def _from_xml(text: str) -> Model:
    """Return the model in the text of an XML file, converted to the structure of a JSON file."""
    # entities could expand to an endless text, and REXS has none
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise ValueError("a document type declaration is not allowed")
    root = ElementTree.fromstring(text)
    if root.tag != "model":
        raise ValueError(f"the root element is <{root.tag}>, not <model>")
    return _object(root)


def _object(node: ElementTree.Element) -> Model:
    """Return an XML element as an object of the JSON structure. The value of an attribute has the key `value`."""
    found: Model = dict(node.attrib)
    if node.tag == "attribute":
        values = node.find("array")
        texts = [(each.text or "").strip() for each in ([node] if values is None else values.findall("c"))]
        return {**found, "value": texts[0] if values is None else texts}
    for child in node:
        if child.tag in ("relations", "components"):
            found[child.tag] = [_object(each) for each in child]
        elif child.tag == "load_spectrum":
            found[child.tag] = _object(child)
        else:
            found.setdefault(f"{child.tag}s", []).append(_object(child))
    return found


def _document(model: Model, place: str) -> RexsDocument:
    components: dict[int, RexsComponent] = {}
    units: dict[str, str] = {}
    for part in model["components"]:
        number = int(part["id"])
        if number in components:
            raise ValueError(f"two components have the id {number}")
        name = str(part.get("name") or "")
        components[number] = RexsComponent(number, str(part["type"]), name, dict(_values(part, units)))
    relations: dict[str, list[tuple[int, ...]]] = {kind: [] for kind in _ROLES}
    for relation in model.get("relations", ()):
        kind, roles = str(relation["type"]), {ref["role"]: int(ref["id"]) for ref in relation["refs"]}
        for role in _ROLES.get(kind, ()):
            if role not in roles:
                raise ValueError(f"a relation '{kind}' has no role '{role}'")
            if roles[role] not in components:
                raise ValueError(
                    f"the role '{role}' of a relation '{kind}' refers to the missing component {roles[role]}"
                )
        relations.setdefault(kind, []).append(tuple(roles[role] for role in _ROLES.get(kind, ())))
    found = (model.get("load_spectrum") or {}).get("load_cases", ())
    cases = [{int(part["id"]): dict(_values(part, units)) for part in case.get("components", ())} for case in found]
    origin = f"{model.get('applicationId', 'unknown program')}, REXS {model.get('version', 'of unknown version')}"
    return RexsDocument(place, origin, components, relations, cases, units)


def _values(part: Model, units: dict[str, str]) -> Iterator[tuple[str, Any]]:
    """Yield name and value of each attribute that an import uses; its unit is added to the mapping `units`."""
    for given in part.get("attributes", ()):
        name, unit = str(given["id"]), str(given.get("unit") or "none").replace("none", "")
        value = next((value for key, value in given.items() if key not in ("id", "unit")), None)
        if name not in _ATTRIBUTES or value in (None, ""):
            continue
        kind, expected = _ATTRIBUTES[name]
        known = units.setdefault(name, unit or expected)
        if unit not in ("", known) or known not in (expected, *_OTHER_UNITS.get(expected, ())):
            raise ValueError(f"`{name}` of component {part['id']} has the unit '{unit}', not '{expected}'")
        is_list = kind.endswith("_array")
        try:
            if is_list != isinstance(value, list):
                raise TypeError
            given_values = value if is_list else [value]
            is_flag = kind.startswith("boolean")
            read = [str(each).lower() == "true" if is_flag else float(each) for each in given_values]
        except (TypeError, ValueError, OverflowError):
            raise ValueError(f"`{name}` of component {part['id']} is {value!r}, not a {kind}") from None
        if all(map(isfinite, read)):
            yield name, read if is_list else read[0]
