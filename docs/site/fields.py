"""Docstrings of the house as Markdown: columns of names and meanings become lists, examples become blocks of code."""

from __future__ import annotations

import re
from typing import Any

from griffe import Extension, Object

_FIELD = re.compile(r"^(\w+(?:, \w+)*)  +(\S.*)$")


class FieldLists(Extension):
    """Rewrites docstrings as they are read."""

    def on_object(self, *, obj: Object, **_: Any) -> None:
        """Every module, class, function and attribute comes by here."""
        if obj.docstring is not None and not obj.is_alias:
            obj.docstring.value = with_lists(obj.docstring.value)


def with_lists(text: str) -> str:
    """Paragraphs of lines `name   meaning`, with meanings that go on indented, as Markdown lists."""
    return "\n\n".join(_as_markdown(paragraph) for paragraph in re.split(r"\n\s*\n", text))


def _as_markdown(paragraph: str) -> str:
    lines = paragraph.splitlines()
    if lines[0].startswith(">>> "):
        return f"```pycon\n{paragraph}\n```"
    if not _FIELD.match(lines[0]) or not all(_FIELD.match(line) or line.startswith("    ") for line in lines):
        return paragraph
    items = [_FIELD.sub(_item, line) if _FIELD.match(line) else f"  {line.strip()}" for line in lines]
    return "\n".join(items)


def _item(found: re.Match[str]) -> str:
    names = ", ".join(f"`{name}`" for name in found[1].split(", "))
    return f"- {names}: {found[2]}"
