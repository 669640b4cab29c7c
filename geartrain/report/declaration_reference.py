"""The reference of the declaration, written from the models themselves."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

from geartrain.report.json_shapes import DefaultsAsWritten
from geartrain.train import Train

_URL = "https://json-schema.org/draft/2020-12/schema"
_SECTIONS = re.compile(r"\n\n[A-Z][A-Za-z ]+\n-{3,}\n.*", re.DOTALL)
"""The sections of a numpydoc docstring, from the first on."""

_MERGED = (
    "Wheel",
    "GearPair",
    "Revolute",
    "PinAndSlot",
    "PinFollower",
    "PinsInHoles",
    "Parallel",
    "Source",
    "Published",
)
"""Parts that a child of `extends` may give in pieces: an editor must not ask it for all of them."""


def schema() -> dict[str, Any]:
    """The JSON Schema of a declaration, as editors take it."""
    found = {key: part for key, part in _models().items() if key not in ("title", "required")}
    for name in _MERGED:
        part = found["$defs"][name]
        body = next((option for option in part.get("anyOf", ()) if "properties" in option), part)
        body["required"] = [key for key in body.pop("required", ()) if key == "kind"]
    whole = {"if": {"required": ["extends"]}, "then": {}, "else": {"required": ["links"]}}
    return {"$schema": _URL, "title": "geartrain declaration"} | found | whole


def _models() -> dict[str, Any]:
    found: dict[str, Any] = _without_sections(Train.model_json_schema(schema_generator=DefaultsAsWritten))
    return found


def _without_sections(schema: Any) -> Any:
    """A schema whose descriptions end where a docstring turns to examples and what else to see."""
    if isinstance(schema, list):
        return [_without_sections(part) for part in schema]
    if not isinstance(schema, dict):
        return schema
    found = {key: _without_sections(part) for key, part in schema.items()}
    if isinstance(text := found.get("description"), str):
        found["description"] = _SECTIONS.sub("", text)
    return found


def declaration_reference() -> str:
    """One table of keys for the train and for each of its parts, as Markdown."""
    found = _models()
    parts: dict[str, Any] = found["$defs"]
    lines = [
        "# The declaration, key by key",
        "",
        "Written by `geartrain schema --as markdown` from the models that read the files.",
        "",
        *_part("Train", found),
    ]
    for name, part in parts.items():
        lines += _part(name, part)
    return "\n".join(lines)


def _part(name: str, part: Mapping[str, Any]) -> Iterator[str]:
    short = [option for option in part.get("anyOf", ()) if "properties" not in option]
    body = next((option for option in part.get("anyOf", ()) if "properties" in option), part)
    if "properties" not in body:
        return
    yield from (f"## {name}", "")
    if text := body.get("description"):
        yield from (" ".join(text.split()), "")
    if short:
        yield from (f"Short form: {' or '.join(_kind(option) for option in short)}.", "")
    yield "| key | what | value |"
    yield "|---|---|---|"
    required = body.get("required", ())
    for key, field in body["properties"].items():
        need = " (required)" if key in required else ""
        default = (
            f"; default `{field['default']}`"
            if isinstance(field.get("default"), str | int) and field["default"] != ""
            else ""
        )
        yield f"| `{key}`{need} | {_text(field)} | {_kind(field)}{default} |".replace("\n", " ")
    yield ""


def _text(field: Mapping[str, Any]) -> str:
    return " ".join(str(field.get("description", "")).split()).replace("|", "\\|")


def _kind(field: Mapping[str, Any]) -> str:
    """What a value may be, in a few words."""
    if "$ref" in field:
        name = field["$ref"].rsplit("/", 1)[-1]
        return f"[{name}](#{name.lower()})"
    if "enum" in field:
        return ", ".join(f"`{value}`" for value in field["enum"])
    if "const" in field:
        return f"`{field['const']}`"
    options = field.get("anyOf") or field.get("oneOf")
    if options:
        return " or ".join(dict.fromkeys(_kind(option) for option in options if option.get("type") != "null"))
    kind = field.get("type", "anything")
    if kind == "object":
        inside = field.get("additionalProperties")
        return f"mapping of names to {_kind(inside)}" if isinstance(inside, dict) else "mapping"
    if kind == "array":
        items: Mapping[str, Any] = field.get("items") or next(iter(field.get("prefixItems", ())), {})
        count = f"{len(field['prefixItems'])} times " if "prefixItems" in field else "list of "
        return count + _kind(items)
    return " or ".join(kind) if isinstance(kind, list) else str(kind)
