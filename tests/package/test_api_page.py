"""docs/api.md: every room that shows names has its section, and the site finds in it what an import finds."""

from __future__ import annotations

import importlib
import re

import pytest
from package.test_public_names import SHOWING
from places import DOCS, ROOT

pytest.importorskip("griffe", reason="the extra 'site' is not installed")

import griffe
from fields import MarkdownDocstrings

import geartrain

PAGE = (DOCS / "api.md").read_text(encoding="utf-8")
SECTIONS = re.findall(r"^::: (\S+)$", PAGE, re.MULTILINE)


@pytest.fixture(scope="module")
def read() -> griffe.Module:
    """The package as the site reads it: without importing it."""
    extensions = griffe.load_extensions(MarkdownDocstrings())
    found = griffe.load("geartrain", search_paths=[str(ROOT)], extensions=extensions)
    assert isinstance(found, griffe.Module)
    return found


def test_every_section_is_a_room_under_its_name_and_every_room_that_shows_names_has_one() -> None:
    """Which names there are is said in the room alone: in its `__all__`."""
    titled = re.findall(r"^## `(geartrain[\w.]+)`: .+\n\n::: (\S+)$", PAGE, re.MULTILINE)
    assert [above for above, _ in titled] == [below for _, below in titled] == SECTIONS
    for section in SECTIONS:
        importlib.import_module(section)
    assert {f"geartrain.{room}" for room in SHOWING} <= set(SECTIONS)


@pytest.mark.parametrize("room", SHOWING)
def test_the_site_shows_what_an_import_brings(room: str, read: griffe.Module) -> None:
    """Also of names that are imported when they are asked for: what a checker of types reads leads to the same."""
    module, seen = importlib.import_module(f"geartrain.{room}"), read[room]
    assert module.__all__
    for name in module.__all__:
        thing, shown = getattr(module, name), seen.members[name]
        assert shown.is_public, name
        shown = shown.final_target if shown.is_alias else shown
        assert shown.docstring is not None, f"{room}.{name} has no docstring that the site could show"
        if isinstance(thing, type) or callable(thing):
            assert shown.canonical_path == f"{thing.__module__}.{thing.__qualname__}"


def test_the_names_of_the_package_itself_are_listed() -> None:
    names = set(geartrain.__all__) - {"__version__"}
    listed = re.search(r"^`geartrain` itself holds .*?\. ", PAGE, re.MULTILINE | re.DOTALL)
    assert listed is not None
    assert set(re.findall(r"`(\w+)`", listed[0])) - {"geartrain"} == names


# ------------------------------------------------------------------------------------------------------- as Markdown

SOURCE = '''
"""Words.

one   the first
two   the second, and
      what goes on
"""
from pydantic import BaseModel, Field
from geartrain.viewer import page


class Part(BaseModel):
    """A part of a*b wheels, as `a*b` says.

    See Also
    --------
    page : shows it
    Other

    Examples
    --------
    >>> 2*Part
    4
    """

    name: str = Field("part", description="A name "
        "in two lines")
    plain: int = 1


class Other:
    """Another."""
'''


def test_docstrings_become_markdown() -> None:
    with griffe.temporary_visited_package("made", {"__init__.py": "", "parts.py": SOURCE}) as made:
        found = made["parts"]
        for each in (found, found["Part"], found["Other"]):
            MarkdownDocstrings().on_object(obj=each)
        assert found.docstring.value == "Words.\n\n- `one`: the first\n- `two`: the second, and\n  what goes on"
        prose, fields, seen, examples = found["Part"].docstring.parse("numpy")
        assert prose.value == r"A part of a\*b wheels, as `a*b` says."
        assert [(each.name, each.description.strip()) for each in fields.value] == [("name", "A name in two lines")]
        assert [str(each.annotation) for each in fields.value] == ["str"]
        link = '- <autoref identifier="{}" optional><code>{}</code></autoref>'
        assert seen.value.contents.splitlines() == [
            link.format("geartrain.viewer.page", "page") + ": shows it",
            link.format("made.parts.Other", "Other"),
        ]
        assert [text for _, text in examples.value] == [">>> 2*Part\n4"]
        assert found["Other"].docstring.value == "Another."
