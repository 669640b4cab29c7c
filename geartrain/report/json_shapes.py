"""The shapes of JSON answers as JSON Schema (draft 2020-12), read off the results that are told.

Keys are those of `geartrain.numerics.results`, kinds of values come from annotations, and words from docstrings.
"""

from __future__ import annotations

import ast
import builtins
import inspect
import math
import re
import sys
from collections.abc import Callable, Mapping
from fractions import Fraction
from functools import cache
from importlib import import_module
from types import ModuleType, NoneType, UnionType
from typing import Annotated, Any, ForwardRef, Literal, NotRequired, Required, Union, get_args, get_origin, is_typeddict

from pydantic.json_schema import GenerateJsonSchema

from geartrain.numerics.long_float import LongFloat
from geartrain.numerics.quantity import Figure, Quantity
from geartrain.numerics.results import Key, Result, keys_of, whole
from geartrain.wings import WingResult

Schema = dict[str, Any]

_PLAIN: dict[Any, Schema] = {
    **{str: {"type": "string"}, Fraction: {"type": "string"}, bool: {"type": "boolean"}},
    **{int: {"type": "integer"}, float: {"type": "number"}, math.degrees: {"type": "number"}},
    **{NoneType: {"type": "null"}, LongFloat: {"type": "null"}, Any: {}, object: {}},
}
_LINE = re.compile(r"^    (\w+(?:, \w+)*)   *(\S.*(?:\n      .*)*)", re.MULTILINE)
"""A line of a class's docstring that tells of fields, with those that go on with it."""
_ENTRY = re.compile(r"^    (\w+(?:, \w+)*) :.*((?:\n {8}.*)+)", re.MULTILINE)
"""The same as an entry of numpydoc: names and kind, the meaning indented below."""


def shape_of(kind: Any, to: Callable[[Any], Any] | None = None, keys: tuple[str | Key, ...] = ()) -> Schema:
    """The schema of values of a kind, told as plain data; `to` and `keys` as in `Key`."""
    origin, parts = get_origin(kind), get_args(kind)
    if origin is Annotated and isinstance(parts[1], WingResult):
        result = parts[1].kind()
        return {} if result is None else shape_of(result, to, keys)
    if origin in (Annotated, Required, NotRequired):
        return shape_of(parts[0], to, keys)
    if origin in (Union, UnionType):
        return _one_of([_PLAIN[NoneType] if part is NoneType else shape_of(part, to, keys) for part in parts])
    if hasattr(kind, "_fields") and not keys:  # a named tuple
        return _object({name: shape_of(_own_kind(kind, name), to) for name in kind._fields}, kind._fields, kind)
    if not isinstance(origin, type) or not hasattr(origin, "__iter__"):
        return _of_one(kind, to, keys)
    if not hasattr(origin, "__len__") or origin.__module__ == "numpy":
        return {"type": "array"}
    if issubclass(origin, Mapping):
        return {"type": "object", "additionalProperties": shape_of(parts[1], to, keys)}
    size = {} if origin is not tuple or parts[-1] is ... else {"minItems": len(parts), "maxItems": len(parts)}
    items = _one_of([shape_of(part, to, keys) for part in parts if part is not ...])
    return {"type": "array", **size, "items": items}


def _of_one(kind: Any, to: Callable[[Any], Any] | None, keys: tuple[str | Key, ...]) -> Schema:
    """The schema of what is no mapping, list or None."""
    if to is not None:
        return shape_of(to) if isinstance(to, type) or to in _PLAIN else shape_of(_returned(to))
    if keys:
        return _record(kind, whole(keys))
    if get_origin(kind) is Literal:
        return {"enum": list(get_args(kind))}
    if kind in _PLAIN:
        return _PLAIN[kind]
    if is_typeddict(kind):
        return _typed_dict(kind)
    if hasattr(kind, "model_json_schema"):
        return dict(kind.model_json_schema(schema_generator=DefaultsAsWritten))
    if hasattr(kind, "to_dict") and not issubclass(kind, Result):  # one of its own
        return shape_of(_returned(kind.to_dict))
    return _record(kind, keys_of(kind))


def _typed_dict(kind: Any) -> Schema:
    """A dictionary with known keys, of which some may be left out."""
    kinds = {name: _evaluated(part, sys.modules[kind.__module__]) for name, part in kind.__annotations__.items()}
    needed = {Required: True, NotRequired: False}
    required = [name for name, each in kinds.items() if needed.get(get_origin(each), kind.__total__)]
    return _object({name: shape_of(each) for name, each in kinds.items()}, required, kind)


def _one_of(shapes: list[Schema]) -> Schema:
    """Any of these; one alone as itself."""
    flat = [each for shape in shapes for each in shape.get("anyOf", [shape])]
    different = [each for at, each in enumerate(flat) if each not in flat[:at]]
    return different[0] if len(different) == 1 else {"anyOf": different}


def _record(kind: type, keys: tuple[Key, ...]) -> Schema:
    """A result: its keys, and those of its parts that stand among them."""
    words = _words(kind)
    properties: dict[str, Schema] = {}
    required = []
    for key in keys:
        shape = shape_of(attribute_kind(kind, key.path) if key.path else kind, key.to, key.keys)
        if not key.name:
            parts = [part for part in shape.get("anyOf", [shape]) if "properties" in part]
            properties |= {name: each for part in parts for name, each in part["properties"].items()}
            required += shape.get("required", ())  # keys of a part that may be None are not needed
            continue
        said = words.get(key.of) or words.get(key.name) or _summary(getattr(kind, key.path, None))
        properties[key.name] = ({"description": said} if said else {}) | shape
        required.append(key.name)
    return _object(properties, required, kind)


def _object(properties: Mapping[str, Schema], required: Any, kind: type) -> Schema:
    return {
        "type": "object",
        "description": _summary(kind),
        "required": [name for name in properties if name in required],
        "properties": properties,
    }


def _summary(what: Any) -> str:
    """The first paragraph of a docstring, on one line; "" for what has none of its own."""
    own = getattr(what, "__module__", "geartrain").startswith("geartrain")
    text = what.__doc__ if own and (isinstance(what, type | property) or hasattr(what, "func")) else ""
    return " ".join((text or "").split("\n\n")[0].split())


@cache
def _words(kind: type) -> dict[str, str]:
    """What the docstring of a class says of its fields."""
    found: dict[str, str] = {}
    for base in reversed(kind.__mro__):
        said = base.__doc__ or ""
        for names, text in (*_LINE.findall(said), *_ENTRY.findall(said)):
            found |= dict.fromkeys(names.split(", "), " ".join(text.split()))
    return found


# ------------------------------------------------------------------------------------------------------- annotations


def attribute_kind(kind: Any, path: str) -> Any:
    """The annotation of a field or property, `part.attribute` for one of a part. Raises `AttributeError`."""
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
    return eval(annotation, {}, _Names(module)) if isinstance(annotation, str) else annotation


class _Names(dict[str, Any]):
    """Names in a module, those among them that it imports for annotations alone."""

    def __init__(self, module: ModuleType) -> None:
        super().__init__(vars(builtins) | vars(module))
        self.module = module

    def __missing__(self, name: str) -> Any:
        home = _imports(self.module)[name]
        return getattr(import_module(home), name)


@cache
def _imports(module: ModuleType) -> dict[str, str]:
    """Where names come from that a module imports, be it for annotations alone."""
    nodes = ast.walk(ast.parse(inspect.getsource(module)))
    return {name.name: node.module or "" for node in nodes if isinstance(node, ast.ImportFrom) for name in node.names}


class DefaultsAsWritten(GenerateJsonSchema):
    """Numbers and quantities as a declaration writes them, where pydantic would write out their fields."""

    def encode_default(self, dft: Any) -> Any:
        """A default value as JSON."""
        if isinstance(dft, tuple):
            return [self.encode_default(each) for each in dft]
        return str(dft) if isinstance(dft, Figure | Quantity) else super().encode_default(dft)
