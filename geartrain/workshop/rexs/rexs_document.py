"""REXS files in JSON (.rexsj) and in XML (.rexs): writers of both from one structure, and a reader of both.

The structure is that of the JSON file: components with attributes, relations of components, and load cases. See the
specification of REXS 1.4, "Interface structure" and "JSON as an alternative file format" (www.rexs.info).
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import Any, NamedTuple
from xml.etree import ElementTree
from zipfile import BadZipFile, ZipFile

from geartrain.errors import GearTrainError, Problem

_UNREADABLE = (ValueError, ElementTree.ParseError, BadZipFile, RecursionError)
Model = dict[str, Any]
"""Model as in a JSON file: metadata, `relations`, `components`, and perhaps `load_spectrum`."""

_ROLES: Mapping[str, Sequence[str]] = {
    **{"assembly": ("assembly", "part"), "side": ("assembly", "inner_part", "outer_part")},
    **{"stage": ("stage", "gear_1", "gear_2"), "flank": ("gear", "left")},
    **dict.fromkeys(("central_shaft", "planet_shaft"), ("planetary_stage", "shaft")),
    **dict.fromkeys(("planet_pin", "planet_carrier_shaft"), ("planetary_stage", "shaft")),
}
"""Roles of the relations that are read."""
_EXPORT = "export the gear unit again as REXS 1.0 to 1.4, in JSON (.rexsj) or XML (.rexs)"


class RexsValue(NamedTuple):
    """Value of an attribute with its unit."""

    value: Any
    """Text, number, boolean, or list of these; in XML all scalars are text."""
    unit: str = ""
    """Unit as written in the file; empty for `none`."""


LoadCase = Mapping[int, Mapping[str, RexsValue]]
"""Attributes of components in one load case, by the id of the component."""


@dataclass(frozen=True, slots=True)
class RexsComponent:
    """Component of a gear unit, such as a shaft, a gear or a stage."""

    id: int
    type: str
    name: str
    attributes: Mapping[str, RexsValue]


@dataclass(frozen=True, slots=True)
class RexsDocument:
    """Gear unit as read from a file."""

    place: str
    """Name of the file."""
    origin: str
    """Program that wrote the file, and the version of REXS."""
    components: Mapping[int, RexsComponent]
    """Components by id, in the order of the file."""
    relations: tuple[tuple[str, Mapping[str, int]], ...]
    """Relations: type, and id of the component in each role."""
    cases: tuple[LoadCase, ...]
    """Load cases."""

    def related(self, kind: str) -> Iterator[Mapping[str, int]]:
        """Yield the components of all relations of one type, by role."""
        return (roles for each, roles in self.relations if each == kind)

    def parts(self, assembly: int, kind: str) -> list[int]:
        """Return the components of one type that are assembled into a component."""
        found = (roles["part"] for roles in self.related("assembly") if roles["assembly"] == assembly)
        return [part for part in found if self.components[part].type == kind]

    def of_type(self, *kinds: str) -> list[RexsComponent]:
        """Return the components of the given types."""
        return [each for each in self.components.values() if each.type in kinds]


# --------------------------------------------------------------------------------------------------------------- files


def to_json(model: Model) -> str:
    """Return a model as JSON file."""
    # JSON has no NaN, so an undefined size must raise an error here and not in the reading program
    return json.dumps({"model": model}, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def to_xml(model: Model) -> str:
    """Return a model as XML file, with the byte order mark that REXS 1.4 requires."""
    root = ElementTree.Element("model", {key: value for key, value in model.items() if isinstance(value, str)})
    relations = ElementTree.SubElement(root, "relations")
    for relation in model["relations"]:
        node = ElementTree.SubElement(relations, "relation", id=str(relation["id"]), type=relation["type"])
        for ref in relation["refs"]:
            ElementTree.SubElement(node, "ref", {key: str(value) for key, value in ref.items()})
    _add_components(ElementTree.SubElement(root, "components"), model)
    if spectrum := model.get("load_spectrum"):
        cases = ElementTree.SubElement(root, "load_spectrum", id=str(spectrum["id"]))
        for case in spectrum["load_cases"]:
            _add_components(ElementTree.SubElement(cases, "load_case", id=str(case["id"])), case)
    ElementTree.indent(root)
    return f'\ufeff<?xml version="1.0" encoding="UTF-8"?>\n{ElementTree.tostring(root, encoding="unicode")}\n'


def _add_components(node: ElementTree.Element, model: Model) -> None:
    for part in model["components"]:
        names = {key: str(part[key]) for key in ("id", "type", "name") if key in part}
        component = ElementTree.SubElement(node, "component", names)
        for given in part["attributes"]:
            head = {key: value for key, value in given.items() if key in ("id", "unit")}
            attribute = ElementTree.SubElement(component, "attribute", head)
            (value,) = (value for key, value in given.items() if key not in head)
            if isinstance(value, list):
                values = ElementTree.SubElement(attribute, "array")
                for each in value:
                    ElementTree.SubElement(values, "c").text = _scalar(each)
            else:
                attribute.text = _scalar(value)


def _scalar(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


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
    except (LookupError, TypeError, AttributeError, ArithmeticError, *_UNREADABLE) as error:
        raise GearTrainError(Problem("this is not a REXS model", _reason(error), _EXPORT, place)) from None


def _unpacked(data: bytes) -> bytes:
    """Return the model in a ZIP archive (.rexsz), or the data themselves if they are not an archive."""
    if data[:2] != b"PK":
        return data
    with ZipFile(BytesIO(data)) as archive:
        names = [
            each for each in archive.namelist() if Path(each).suffix in (".rexs", ".rexsj") and "__MACOSX" not in each
        ]
        if not names:
            raise ValueError("the archive contains no .rexs or .rexsj file")
        return archive.read(names[0])


def _reason(error: Exception) -> str:
    return f"key '{error.args[0]}' is missing" if isinstance(error, KeyError) else str(error) or type(error).__name__


def _from_xml(text: str) -> Model:
    """Return the model of an XML file in the structure of a JSON file."""
    # entities could expand to an endless text, and REXS has none
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise ValueError("a document type declaration is not allowed")
    root = ElementTree.fromstring(text)
    if root.tag != "model":
        raise ValueError(f"the root element is <{root.tag}>, not <model>")
    cases = [{"components": _components(case)} for case in root.findall("load_spectrum/load_case")]
    relations = [
        {"id": node.get("id"), "type": node.get("type"), "refs": [ref.attrib for ref in node.findall("ref")]}
        for node in root.findall("relations/relation")
    ]
    found = {"relations": relations, "components": _components(root.find("components"))}
    return {**root.attrib, **found, "load_spectrum": {"load_cases": cases}}


def _components(node: ElementTree.Element | None) -> list[Model]:
    return [
        {**part.attrib, "attributes": [_attribute(each) for each in part.findall("attribute")]}
        for part in (() if node is None else node.findall("component"))
    ]


def _attribute(node: ElementTree.Element) -> Model:
    values, value = node.find("array"), (node.text or "").strip()
    if values is None:
        return {**node.attrib, "value": value}
    return {**node.attrib, "value": [(each.text or "").strip() for each in values.findall("c")]}


def _document(model: Model, place: str) -> RexsDocument:
    components = {}
    for part in model["components"]:
        number = int(part["id"])
        if number in components:
            raise ValueError(f"two components have the id {number}")
        name = str(part.get("name") or "")
        components[number] = RexsComponent(number, str(part["type"]), name, _values(part))
    relations = tuple(
        (str(each["type"]), {str(ref["role"]): int(ref["id"]) for ref in each["refs"]}) for each in model["relations"]
    )
    for kind, roles in relations:
        if missing := [role for role in _ROLES.get(kind, ()) if role not in roles]:
            raise ValueError(f"a relation '{kind}' has no role '{missing[0]}'")
        for role, number in roles.items():
            if number not in components:
                raise ValueError(f"the role '{role}' of a relation '{kind}' refers to the missing component {number}")
    cases = tuple(
        {int(part["id"]): _values(part) for part in case["components"]}
        for case in (model.get("load_spectrum") or {}).get("load_cases", ())
    )
    origin = f"{model.get('applicationId', 'unknown program')}, REXS {model.get('version', 'of unknown version')}"
    return RexsDocument(place, origin, components, relations, cases)


def _values(part: Model) -> dict[str, RexsValue]:
    found = {}
    for given in part["attributes"]:
        value = next((value for key, value in given.items() if key not in ("id", "unit")), None)
        unit = str(given.get("unit") or "")
        found[str(given["id"])] = RexsValue(value, "" if unit == "none" else unit)
    return found
