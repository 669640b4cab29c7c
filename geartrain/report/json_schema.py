"""JSON Schema (draft 2020-12) of the JSON output of all commands.

The keys of an answer are those of its result class (`geartrain.numerics.results`), the kinds of values follow from
annotations, and descriptions are the docstrings of fields. Keys that a command adds to a result are written by hand.
"""

from __future__ import annotations

import ast
import builtins
import inspect
import math
import sys
from collections.abc import Callable, Iterator, Mapping
from fractions import Fraction
from functools import cache
from importlib import import_module
from types import ModuleType, NoneType, UnionType
from typing import Annotated, Any, ForwardRef, Literal, NotRequired, Required, Union, get_args, get_origin, is_typeddict

from pydantic.json_schema import GenerateJsonSchema

from geartrain.errors import check_choice
from geartrain.numerics.quantity import Figure, Quantity
from geartrain.numerics.results import Key, Result, field_docs, imported_function, keys_of, whole
from geartrain.report.document import Document, Section, Table
from geartrain.wings import WINGS, WingResult, has_wing, wing

Schema = dict[str, Any]

FLAG: Schema = {"type": "boolean"}
OBJECT: Schema = {"type": "object"}


def _list(item: Schema) -> Schema:
    return {"type": "array", "items": item}


# ----------------------------------------------------------------------------------------------------------- questions


_RESULTS = {
    "solve": "report.train_data:TrainAnswers",
    "inspect formula": "report.formula_report:FormulaReport",
    "gearbox": "analysis.gearbox:Gearbox",
    "gearbox --search": "analysis.gear_series:GearSearch",
    "torques": "report.torque_report:TorqueReport",
    "motion": "report.motion_report:MotionFigures",
    "inspect bench": "report.accuracy_report:AccuracyReport",
    "inspect graph --as matrix": "numerics.labelled_array:LabelledArray",
    "sphere": "spherical.gear_sphere:GearSphere",
    "sphere --suggest": "spherical.tooth_count_search:ToothCountSuggestions",
    "mesh --form triangular": "report.pair_page:TriangularPair",
    "pin": "teeth.pair_results:PinFigures",
    "mesh --compare": "teeth.form_comparison:FormComparison",
}
"""Result class, as `package.module:class`, of each JSON output with the data of a single class."""


@cache
def answers() -> dict[str, Schema]:
    """Return the schemas of the JSON output of each command, or of each use of a command, keyed by name."""
    from geartrain.report.gear_pairs import DrivenPair
    from geartrain.report.pair_page import FormedPair
    from geartrain.report.train_data import TrainReport
    from geartrain.spherical.polyhedron_gears import SurveyRow
    from geartrain.teeth.conjugate.conjugate_mesh import PairDesign

    found = {question: shape_of(imported_function(*home.split(":"))) for question, home in _RESULTS.items()}
    report = shape_of(TrainReport)
    teeth = {"description": meaning_of(TrainReport, "teeth"), **_list(_of_any_form(DrivenPair))}
    report = _list(report | {"properties": report["properties"] | {"teeth": teeth}})
    graph = {"directed": FLAG, "multigraph": FLAG, "graph": OBJECT, "nodes": _list(OBJECT), "edges": _list(OBJECT)}
    found |= {
        "report": report,
        "compare": report,
        # an object that has at least these keys, because a later version may add others
        "inspect graph --as json": {"type": "object", "required": list(graph), "properties": graph},
        "sphere --survey": shape_of(list[SurveyRow]),
        "mesh": {"anyOf": [shape_of(PairDesign), *_of_any_form(FormedPair)["anyOf"]]},
        "mesh --form triangular --vary": shape_of(list[dict[str, float | str | None]]),
    }
    for name in filter(has_wing, WINGS):
        found |= {question: shape_of(kind) for question, kind in wing(f"{name}.answers").answers().items()}
    return found


def _of_any_form(kind: type) -> Schema:
    """Return the schema of a result on a pair of any tooth form, with an alternative for the results of each form."""
    from geartrain.teeth.any_tooth_form import tooth_forms

    pair = shape_of(kind)
    found = []
    for figures in dict.fromkeys(form.figures() for form in tooth_forms().values()):
        own = shape_of(figures)
        required = dict.fromkeys([*pair["required"], *own["required"]])
        found.append(pair | {"properties": pair["properties"] | own["properties"], "required": list(required)})
    return {"anyOf": found}


def answer_schema() -> Schema:
    """Return one JSON Schema (draft 2020-12) of all JSON answers; `#/$defs/NAME` describes the answer NAME."""
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Answers of geartrain",
        "description": "Output of each command with --json. Later versions may add keys but do not remove any.",
        "$defs": answers(),
    }


def describe_answer(question: str) -> Document:
    """Return a table of the keys of one JSON answer, with the type and meaning of each value.

    In the keys, `states[]` represents the entries of a list, and `outputs.*` represents the values of an object with
    arbitrary keys.
    """
    known = answers()
    check_choice("question", question, known)
    rows = list(dict.fromkeys(_key_rows(known[question], "")))
    return Document(f"{question} --json", (), [Section("Keys", (), [Table(("key", "kind", "meaning"), rows)])])


def _key_rows(shape: Schema, path: str) -> Iterator[tuple[str, str, str]]:
    for part in shape.get("anyOf", [shape]):
        if isinstance(items := part.get("items"), dict):
            yield from _key_rows(items, f"{path}[]")
        if isinstance(values := part.get("additionalProperties"), dict):
            yield from _key_rows(values, f"{path}.*")
        for name, each in part.get("properties", {}).items():
            key = f"{path}.{name}".removeprefix(".")
            yield key, " or ".join(dict.fromkeys(_kinds(each))), each.get("description", "")
            yield from _key_rows(each, key)


def _kinds(shape: Schema) -> Iterator[str]:
    for part in shape.get("anyOf", [shape]):
        kinds = part.get("type", "string" if "enum" in part else "any")
        for kind in [kinds] if isinstance(kinds, str) else kinds:
            yield "list" if kind == "array" else kind


# ---------------------------------------------------------------------------------------------------- shapes of results


_PLAIN: dict[Any, Schema] = {
    **{str: {"type": "string"}, Fraction: {"type": "string"}, bool: {"type": "boolean"}},
    **{int: {"type": "integer"}, float: {"type": "number"}, math.degrees: {"type": "number"}},
    **{NoneType: {"type": "null"}, Any: {}, object: {}},
}


def shape_of(kind: Any, to: Callable[[Any], Any] | None = None, keys: tuple[str | Key, ...] = ()) -> Schema:
    """Return the JSON Schema of the values that have a given type annotation.

    kind   annotation of the values
    to     function that converts a value to plain data
    keys   keys to include, by default the keys of the class
    """
    origin, parts = get_origin(kind), get_args(kind)
    if origin is Annotated and isinstance(parts[1], WingResult):
        result = parts[1].kind()
        return {} if result is None else shape_of(result, to, keys)
    if origin in (Annotated, Required, NotRequired):
        return shape_of(parts[0], to, keys)
    if origin in (Union, UnionType):
        return _one_of([_PLAIN[NoneType] if part is NoneType else shape_of(part, to, keys) for part in parts])
    if hasattr(kind, "_fields") and not keys:  # a named tuple
        return _fields({name: shape_of(_own_kind(kind, name), to) for name in kind._fields}, kind._fields, kind)
    if not isinstance(origin, type) or not hasattr(origin, "__iter__"):
        return _of_one(kind, to, keys)
    # iterators and numpy arrays do not state the kinds of their items
    if not hasattr(origin, "__len__") or origin.__module__ == "numpy":
        return {"type": "array"}
    if issubclass(origin, Mapping):
        return {"type": "object", "additionalProperties": shape_of(parts[1], to, keys)}
    # only a tuple without an ellipsis has a fixed length
    size = {} if origin is not tuple or parts[-1] is ... else {"minItems": len(parts), "maxItems": len(parts)}
    items = _one_of([shape_of(part, to, keys) for part in parts if part is not ...])
    return {"type": "array", **size, "items": items}


def _of_one(kind: Any, to: Callable[[Any], Any] | None, keys: tuple[str | Key, ...]) -> Schema:
    """Return the schema for the annotation of a single value, which is not a union, mapping or list."""
    if to is not None:
        return shape_of(to) if isinstance(to, type) or to in _PLAIN else shape_of(_returned(to))
    if keys:
        return _record(kind, whole(keys))
    if get_origin(kind) is Literal:
        return {"enum": list(get_args(kind))}
    if kind in _PLAIN:
        return _PLAIN[kind]
    if is_typeddict(kind):
        kinds = {name: _evaluated(part, sys.modules[kind.__module__]) for name, part in kind.__annotations__.items()}
        needed = {Required: True, NotRequired: False}
        required = [name for name, each in kinds.items() if needed.get(get_origin(each), kind.__total__)]
        return _fields({name: shape_of(each) for name, each in kinds.items()}, required, kind)
    # a pydantic model
    if hasattr(kind, "model_json_schema"):
        return dict(kind.model_json_schema(schema_generator=DefaultsAsWritten))
    if hasattr(kind, "to_dict") and not issubclass(kind, Result):  # a class with its own `to_dict`
        return shape_of(_returned(kind.to_dict))
    return _record(kind, keys_of(kind))


def _one_of(shapes: list[Schema]) -> Schema:
    """Return the schema of a union without duplicate alternatives. A single alternative is returned unchanged."""
    # nested unions become one list of alternatives
    flat = [each for shape in shapes for each in shape.get("anyOf", [shape])]
    different = [each for at, each in enumerate(flat) if each not in flat[:at]]
    return different[0] if len(different) == 1 else {"anyOf": different}


def _record(kind: type, keys: tuple[Key, ...]) -> Schema:
    """Return the schema of a result class: its own keys, and the keys of the parts that are merged into it."""
    properties: dict[str, Schema] = {}
    required = []
    for key in keys:
        shape = shape_of(attribute_kind(kind, key.path) if key.path else kind, key.to, key.keys)
        if not key.name:
            parts = [part for part in shape.get("anyOf", [shape]) if "properties" in part]
            properties |= {name: each for part in parts for name, each in part["properties"].items()}
            required += shape.get("required", ())  # a part that may be None has no required keys
            continue
        properties[key.name] = _described(shape, meaning_of(kind, key.path) if key.path else "")
        required.append(key.name)
    return _object(properties, required, kind)


def _described(shape: Schema, meaning: str) -> Schema:
    return {"description": meaning} | shape if meaning and "description" not in shape else shape


def meaning_of(kind: Any, path: str) -> str:
    """Return the docstring of the field or property at a path, such as `part.attribute`; "" if it has no docstring."""
    first, _, rest = path.partition(".")
    if rest:
        whole_kind = attribute_kind(kind, first)
        parts = get_args(whole_kind) if get_origin(whole_kind) in (Union, UnionType) else [whole_kind]
        return next(filter(None, (meaning_of(part, rest) for part in parts if part is not NoneType)), "")
    return field_docs(kind).get(first) or _summary(getattr(kind, first, None))


def _fields(properties: Mapping[str, Schema], required: Any, kind: type) -> Schema:
    meanings = field_docs(kind)
    described = {name: _described(each, meanings.get(name, "")) for name, each in properties.items()}
    return _object(described, required, kind)


def _object(properties: Mapping[str, Schema], required: Any, kind: type) -> Schema:
    return {
        "type": "object",
        "description": _summary(kind),
        "required": [name for name in properties if name in required],
        "properties": properties,
    }


def _summary(what: Any) -> str:
    """Return the first paragraph of a docstring as one line; "" for an object without a docstring in this package."""
    maker = getattr(what, "func", what)  # the function of a cached property
    own = getattr(maker, "__module__", "geartrain").startswith("geartrain")
    text = what.__doc__ if own and (isinstance(what, type | property) or maker is not what) else ""
    return " ".join((text or "").split("\n\n")[0].split())


# ------------------------------------------------------------------------------------------------------- annotations


def attribute_kind(kind: Any, path: str) -> Any:
    """Return the annotation of the field or property at a path such as `part.attribute`, or raise `AttributeError`."""
    for name in path.split("."):
        kind = _own_kind(kind, name)
    return kind


def _own_kind(kind: type, name: str) -> Any:
    for base in kind.__mro__:
        if name in (annotations := inspect.get_annotations(base)):
            return _evaluated(annotations[name], sys.modules[base.__module__])
        member = base.__dict__.get(name)
        if member is not None:
            return _returned(getattr(member, "fget", None) or getattr(member, "func", member))
    raise AttributeError(f"{kind.__name__} has no {name}")


def _returned(function: Any) -> Any:
    return _evaluated(function.__annotations__["return"], sys.modules[function.__module__])


def _evaluated(annotation: Any, module: ModuleType) -> Any:
    if isinstance(annotation, ForwardRef):
        annotation = annotation.__forward_arg__
    # annotations are strings, because modules import `annotations` from `__future__`
    # not `typing.get_type_hints`, which fails for names imported only under TYPE_CHECKING
    return eval(annotation, {}, _Names(module)) if isinstance(annotation, str) else annotation


class _Names(dict[str, Any]):
    """Mapping of all names in a module to their values; names imported only for annotations are imported on access."""

    def __init__(self, module: ModuleType) -> None:
        super().__init__(vars(builtins) | vars(module))
        self.module = module

    def __missing__(self, name: str) -> Any:
        home = _imports(self.module)[name]
        return getattr(import_module(home), name)


@cache
def _imports(module: ModuleType) -> dict[str, str]:
    """Return the module from which each name of a module is imported, also for annotations only."""
    nodes = ast.walk(ast.parse(inspect.getsource(module)))
    return {name.name: node.module or "" for node in nodes if isinstance(node, ast.ImportFrom) for name in node.names}


class DefaultsAsWritten(GenerateJsonSchema):
    """JSON Schema generator that writes default numbers and quantities in the form of a declaration file."""

    def encode_default(self, dft: Any) -> Any:
        """Return a default value as JSON data."""
        if isinstance(dft, tuple):
            return [self.encode_default(each) for each in dft]
        return str(dft) if isinstance(dft, Figure | Quantity) else super().encode_default(dft)
