"""Docstrings of the house as Markdown: what numpydoc's sections leave out, before mkdocstrings reads them.

columns      paragraphs of lines `name   meaning`, with meanings that go on indented, become lists
See Also     names lead to where they are described on the page
fields       those that are described one by one become the section of attributes
products     stars between factors are no emphasis
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from textwrap import indent
from typing import Any

from griffe import Attribute, Class, ExprCall, ExprKeyword, Extension, Module, Object

_COLUMN = re.compile(r"^(\w+(?:, \w+)*)  +(\S.*)$")
_SECTION = re.compile(r"^([A-Z][A-Za-z ]+)\n-{3,}$", re.MULTILINE)
_CODE = re.compile(r"(`[^`]*`|^ *(?:>>>|\.\.\.) .*$)", re.MULTILINE)
_PRODUCT = re.compile(r"(?<=[\w)\]])\*(?=[\w(])")
_SEEN = re.compile(r"^([\w.]+)(?: : (.*))?$")


class MarkdownDocstrings(Extension):
    """Rewrites docstrings as they are read."""

    def on_module(self, *, mod: Module, **_: Any) -> None:
        """The public names of a package that computes `__all__`: those that only checkers of types import."""
        if mod.exports is None and mod.is_init_module:
            mod.exports = [name for name, member in mod.members.items() if member.is_alias and not member.runtime]

    def on_object(self, *, obj: Object, **_: Any) -> None:
        """Every module, class, function and attribute comes by here."""
        if obj.docstring is None or obj.is_alias:
            return
        prose, sections = _parts(obj.docstring.value)
        if isinstance(obj, Class) and "Attributes" not in sections and (fields := list(described_fields(obj))):
            sections = {"Attributes": "\n".join(fields), **sections}
        if "See Also" in sections:
            sections["See Also"] = with_links(sections["See Also"], obj)
        titled = [f"{title}\n{'-' * len(title)}\n{with_stars(text)}" for title, text in sections.items()]
        obj.docstring.value = "\n\n".join([with_lists(with_stars(prose)), *titled])


def _parts(text: str) -> tuple[str, dict[str, str]]:
    """What stands before the first section of numpydoc, and title -> text of each."""
    prose, *rest = _SECTION.split(text)
    return prose.strip("\n"), dict(zip(rest[::2], (each.strip("\n") for each in rest[1::2]), strict=True))


def with_stars(text: str) -> str:
    """Products such as a*b, outside of code, as they are: Markdown would take their stars for emphasis."""
    pieces = _CODE.split(text)
    pieces[::2] = [_PRODUCT.sub(r"\*", piece) for piece in pieces[::2]]
    return "".join(pieces)


def with_lists(text: str) -> str:
    """Prose with its columns as Markdown lists, and its examples as blocks of code."""
    return "\n\n".join(_as_markdown(paragraph) for paragraph in re.split(r"\n\s*\n", text))


def _as_markdown(paragraph: str) -> str:
    lines = paragraph.splitlines()
    if paragraph.startswith(">>> "):
        return f"```pycon\n{paragraph}\n```"
    if not lines or not _COLUMN.match(lines[0]):
        return paragraph
    if not all(_COLUMN.match(line) or line.startswith("    ") for line in lines):
        return paragraph
    items = [_COLUMN.sub(_item, line) if _COLUMN.match(line) else f"  {line.strip()}" for line in lines]
    return "\n".join(items)


def _item(found: re.Match[str]) -> str:
    names = ", ".join(f"`{name}`" for name in found[1].split(", "))
    return f"- {names}: {found[2]}"


def with_links(text: str, seen_from: Object) -> str:
    """A section See Also, `name : why` a line, as a list; a name that the page does not describe leads nowhere."""
    items = []
    for line in text.splitlines():
        if (found := _SEEN.match(line)) is None:
            items.append(line)
            continue
        name, why = found.groups()
        link = f'<autoref identifier="{_full_name(name, seen_from)}" optional><code>{name}</code></autoref>'
        items.append(f"- {link}: {why}" if why else f"- {link}")
    return "\n".join(items)


def _full_name(name: str, seen_from: Object) -> str:
    try:
        return seen_from.resolve(name)
    except Exception:  # a name of another module, in full already
        return name


def described_fields(kind: Class) -> Iterator[str]:
    """The fields of a class as numpydoc has attributes: those with a docstring below them, and those of a model.

    They lose the docstring, so that the site does not show them a second time as members.
    """
    for field in kind.attributes.values():
        if not isinstance(field, Attribute) or field.is_alias or field.name.startswith("_"):
            continue
        if field.docstring is not None and "property" not in field.labels:
            yield f"{field.name} : {field.annotation}\n" + indent(field.docstring.value, "    ")
            field.docstring = None
        elif isinstance(field.value, ExprCall):
            for argument in field.value.arguments:
                if isinstance(argument, ExprKeyword) and argument.name == "description":
                    yield f"{field.name} :\n    {ast.literal_eval(str(argument.value))}"
