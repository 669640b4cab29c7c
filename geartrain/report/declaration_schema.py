"""JSON Schema of the declaration, for editors, and the reference of its keys in Markdown, for readers.

Schema and reference are generated from the models that read declarations, and from the examples in
`geartrain/train/examples.yaml`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from geartrain.numerics.quantity import UNITS
from geartrain.report.json_schema import DefaultsAsWritten, Schema
from geartrain.train import Train
from geartrain.train.examples import example_data, examples, one_line

_URL = "https://json-schema.org/draft/2020-12/schema"
_SECTIONS = re.compile(r"\n\n[A-Z][A-Za-z ]+\n-{3,}\n.*", re.DOTALL)
"""Regular expression that matches the sections of a numpydoc docstring, from the first section to the end."""
_DEFAULT = re.compile(r"[;.] [Dd]efault (?!of )")
"""Separator of the meaning of a key and its default value in a description."""

_MERGED = (
    "Wheel",
    "GearPair",
    "Revolute",
    "Slide",
    "Rack",
    "Screw",
    "Drum",
    "CrankSlider",
    "PinAndSlot",
    "PinFollower",
    "PinsInHoles",
    "Parallel",
    "Belt",
    "Ratio",
    "Source",
    "Published",
)
"""Parts that a child of `extends` may give without all required keys, which an editor must accept."""


def schema() -> Schema:
    """Return the JSON Schema of a declaration for editors."""
    found = {key: part for key, part in _models().items() if key not in ("title", "required")}
    for name in _MERGED:
        body = _body(found["$defs"][name])
        # `kind` selects the model of a part, so even an incomplete part must have it
        body["required"] = [key for key in body.pop("required", ()) if key == "kind"]
    # a child of `extends` inherits its links
    whole = {"if": {"required": ["extends"]}, "then": {}, "else": {"required": ["links"]}}
    return {"$schema": _URL, "title": "geartrain declaration"} | found | whole


def _models() -> Schema:
    """Return the JSON Schema of all parts of a declaration, with an example of each key."""
    found: Schema = _without_sections(Train.model_json_schema(schema_generator=DefaultsAsWritten))
    values = _example_values(found)
    parts = {"Train": found, **found["$defs"]}
    keys = [(name, key, shape) for name, part in parts.items() for key, shape in _body(part)["properties"].items()]
    same = {(key, shape["description"]): values[name, key] for name, key, shape in keys if (name, key) in values}
    for name, key, shape in keys:
        shape["examples"] = [values.get((name, key), same.get((key, shape["description"])))]
    return found


def _without_sections(shape: Any) -> Any:
    """Return a schema in which the descriptions omit the numpydoc sections of docstrings."""
    if isinstance(shape, list):
        return [_without_sections(part) for part in shape]
    if not isinstance(shape, dict):
        return shape
    found = {key: _without_sections(part) for key, part in shape.items()}
    if isinstance(text := found.get("description"), str):
        found["description"] = _SECTIONS.sub("", text)
    return found


def _options(shape: Schema) -> list[Schema]:
    """Return the members of a union, with nested unions expanded; only the schema itself if it is not a union."""
    members = shape.get("anyOf") or shape.get("oneOf")
    return [shape] if members is None else [option for member in members for option in _options(member)]


def _body(part: Schema) -> Schema:
    """Return the schema of a part; if the part also has a short form, the schema of its long form, a mapping."""
    return next((option for option in _options(part) if "properties" in option), part)


# ------------------------------------------------------------------------------------------------------------- examples


def _example_values(models: Schema) -> dict[tuple[str, str], Any]:
    """Return the shortest example of each key of each part. Examples of the part itself are preferred to examples of
    other parts that contain it.
    """
    found: dict[tuple[str, str], tuple[bool, int, Any]] = {}
    for source, data in example_data():
        for part, key, value in _values(models, models, data, "Train"):
            rank = (part != source, len(one_line(key, value)))
            if (part, key) not in found or rank < found[part, key][:2]:
                found[part, key] = (*rank, value)
    return {place: value for place, (_, _, value) in found.items()}


def _values(models: Schema, shape: Schema, data: Any, name: str) -> Iterator[tuple[str, str, Any]]:
    """Yield the part, the key and the value of each entry of a declaration, which is given as plain data."""
    for option in _options(shape):
        if "$ref" in option:
            inner = option["$ref"].rsplit("/", 1)[-1]
            if _fits(_body(models["$defs"][inner]), data):
                yield from _values(models, models["$defs"][inner], data, inner)
        elif isinstance(data, list):
            for value in data:
                yield from _values(models, option.get("items", {}), value, name)
        elif isinstance(data, dict) and "properties" in option:
            for key, value in data.items():
                if value not in ({}, [], None):
                    yield name, key, value
                yield from _values(models, option["properties"][key], value, name)
        elif isinstance(data, dict) and isinstance(values := option.get("additionalProperties"), dict):
            for value in data.values():
                yield from _values(models, values, value, name)


def _fits(body: Schema, data: Any) -> bool:
    """Return True if plain data are a mapping that the schema `body` of a part allows: keys and fixed values agree."""
    keys = body["properties"]
    return isinstance(data, dict) and all(
        key in keys and keys[key].get("const", value) == value for key, value in data.items()
    )


# ------------------------------------------------------------------------------------------------------------ reference

_TITLE = "Top-level keys"
_HEAD = """\
# The declaration, key by key

This page is printed by `geartrain inspect schema --as markdown`. Each section has an example that you can load, and a
table of its keys with a YAML line as an example of each. `geartrain inspect schema` prints the same information as a
JSON Schema, which editors use to complete and check your files.

## Values

A *number* is an integer, a fraction `254/19` or `1:30`, or a decimal; fractions are exact. A *name* is any text without
quotes. A quantity is a number and a unit, such as `2.5 mm`:

| quantity | units |
|---|---|"""


@dataclass(frozen=True)
class _Chapter:
    """Section of the reference, on one part of a declaration, or on a key with parts of several kinds as values."""

    title: str
    depth: int
    parts: tuple[str, ...]

    @property
    def anchor(self) -> str:
        """Anchor of the section, which is the fragment of its address within the page."""
        return _anchor(self.title)

    @property
    def shown(self) -> str:
        """Title of the section in Markdown."""
        return self.title if self.title == _TITLE else f"`{self.title}`"


def _anchor(title: str) -> str:
    return re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-")


def declaration_reference() -> str:
    """Return the reference of all keys as Markdown text: first the top-level keys, then the keys of their parts."""
    models = _models()
    chapters = [_Chapter(_TITLE, 2, ("Train",)), *_chapters(models, "Train", 2, set())]
    kinds = {part: f"[keys](#{each.anchor})" for each in reversed(chapters) for part in each.parts}
    for part in kinds:
        short = [_kind(option, kinds) for option in _options(_part(models, part)) if "properties" not in option]
        kinds[part] = " or ".join([*filter(None, short), kinds[part]])
    lines = [_HEAD]
    for dimension in dict.fromkeys(dimension for dimension, _ in UNITS.values()):
        units = ", ".join(f"`{unit}`" for unit, (of, _) in UNITS.items() if of == dimension)
        lines.append(f"| {dimension} | {units} |")
    lines.append("")
    printed: dict[tuple[str, ...], _Chapter] = {}
    for each in chapters:
        lines += _section(models, each, kinds, printed)
    return "\n".join(lines)


def _part(models: Schema, name: str) -> Schema:
    found: Schema = models if name == "Train" else models["$defs"][name]
    return found


def _references(shape: Any) -> Iterator[str]:
    """Yield the names of the parts to which a schema refers."""
    if isinstance(shape, dict) and "$ref" in shape:
        yield shape["$ref"].rsplit("/", 1)[-1]
    elif isinstance(shape, dict | list):
        for inner in shape.values() if isinstance(shape, dict) else shape:
            yield from _references(inner)


def _chapters(models: Schema, name: str, depth: int, seen: set[str]) -> Iterator[_Chapter]:
    """Yield the sections of the parts below the part `name`, at heading level `depth`, without the parts in `seen`."""
    found = {
        key: tuple(dict.fromkeys(_references(shape))) for key, shape in _body(_part(models, name))["properties"].items()
    }
    if name == "Train":
        seen |= {part for parts in found.values() for part in parts}
    for key, parts in found.items():
        if not parts or (name != "Train" and seen.issuperset(parts)):
            continue
        seen.update(parts)
        yield _Chapter(key, depth, parts)
        for part in parts:
            if len(parts) > 1:
                yield _Chapter(_kind_title(models, part), depth + 1, (part,))
            yield from _chapters(models, part, depth + min(len(parts), 2), seen)


def _kind_title(models: Schema, name: str) -> str:
    """Return the key and value that select one kind of part, such as `form: involute`; the first key of the part if no
    key selects it.
    """
    keys = _body(_part(models, name))["properties"]
    return next((f"{key}: {shape['const']}" for key, shape in keys.items() if "const" in shape), next(iter(keys)))


def _section(
    models: Schema, chapter: _Chapter, kinds: Mapping[str, str], printed: dict[tuple[str, ...], _Chapter]
) -> Iterator[str]:
    """Yield the lines of a section; keys that an earlier section explains are only named, with a link to it."""
    several = len(chapter.parts) > 1
    name = chapter.title if several else chapter.parts[0]
    part = models["properties"][name] if several else _part(models, name)
    text = " ".join(_body(part)["description"].split("\n\n")[0].split())
    yield from (f"{'#' * chapter.depth} {chapter.shown}", "")
    yield from (f"{text}." if several else text, "", "```yaml", examples()[name][0].rstrip(), "```", "")
    if several:
        each = [_kind_title(models, part) for part in chapter.parts]
        yield from (f"Declare one of {', '.join(f'[`{title}`](#{_anchor(title)})' for title in each)}.", "")
    tables = [_rows(_part(models, part), kinds) for part in chapter.parts]
    common = [row for row in tables[0] if all(row in table for table in tables)]
    new = [row for row in common if row not in printed]
    if new:
        yield from ("| key with an example | type | default | meaning |", "|---|---|---|---|")
        for row in new:
            cells = (f"`{tables[0][row]}`", *row[1:])
            # `chr(92)` is a backslash, which f-strings may not contain before Python 3.12
            yield f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in cells)} |"
        yield ""
    known: dict[_Chapter, list[str]] = {}
    for row in common:
        if row in printed:
            known.setdefault(printed[row], []).append(f"`{row[0]}`")
    if known:
        groups = (f"{', '.join(keys)}, as in [{above.shown}](#{above.anchor})" for above, keys in known.items())
        yield from (f"{'Further keys' if new else 'Keys'}: {'; '.join(groups)}.", "")
    printed |= dict.fromkeys(new, chapter)


def _rows(part: Schema, kinds: Mapping[str, str]) -> dict[tuple[str, ...], str]:
    """Return the table of a part: for each row of cells (key, type, default and meaning), an example as a YAML line."""
    body, rows = _body(part), {}
    for key, shape in body["properties"].items():
        meaning, *default = _DEFAULT.split(" ".join(shape["description"].split()), maxsplit=1)
        if key in body.get("required", ()):
            default = ["required"]
        # the model's default, unless the description states it in words
        elif not default and isinstance(value := shape.get("default"), str | int) and value != "":
            default = [f"`{str(value).lower() if isinstance(value, bool) else value}`"]
        row = key, _kind(shape, kinds), *(default or [""]), meaning
        rows[row] = one_line(key, shape["examples"][0])
    return rows


def _kind(shape: Schema, parts: Mapping[str, str]) -> str:
    """Return the type of a key in a few words, in the notation of YAML. `parts` contains the types of all parts."""
    if "$ref" in shape:
        return parts[shape["$ref"].rsplit("/", 1)[-1]]
    if len(options := _options(shape)) > 1:
        each = (_kind(option, parts) for option in options)
        words = (word for kind in each if kind for word in ([kind] if kind[0] == "[" else kind.split(" or ")))
        return " or ".join(dict.fromkeys(words))
    if "enum" in shape or "const" in shape:
        values = shape.get("enum", [shape.get("const")])
        return "name" if len(values) > _MOST_VALUES else ", ".join(f"`{value}`" for value in values)
    types = shape.get("type", [])
    types = [types] if isinstance(types, str) else [each for each in types if each != "null"]
    if types == ["object"]:
        return f"name: {_kind(shape['additionalProperties'], parts)}"
    if types == ["array"] and "prefixItems" in shape:
        return f"[{', '.join(_kind(item, parts) for item in shape['prefixItems'])}]"
    if types == ["array"]:
        return f"[{_kind(shape['items'], parts)}, ...]"
    if "format" in shape:
        return f"{shape['format']} or number" if "number" in types else str(shape["format"])
    if len(types) > 1:
        return "number" if types[0] == "number" else "name"
    return "".join(_PLAIN.get(each, each) for each in types if each != "null")


_MOST_VALUES = 6  # a longer list is in the section of the kinds
_PLAIN = {"string": "text", "boolean": "true or false", "null": ""}
