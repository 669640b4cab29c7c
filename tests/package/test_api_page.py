"""docs/api: every package has its page, and the site finds on it what an import finds."""

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

PAGES = {path.stem: path.read_text(encoding="utf-8") for path in (DOCS / "api").glob("*.md")}
SECTIONS = {section: page for page in PAGES for section in re.findall(r"^::: (\S+)$", PAGES[page], re.MULTILINE)}
"""Page of each package."""


@pytest.fixture(scope="module")
def read() -> griffe.Module:
    """The package as the site reads it: without importing it."""
    extensions = griffe.load_extensions(MarkdownDocstrings())
    found = griffe.load("geartrain", search_paths=[str(ROOT)], extensions=extensions)
    assert isinstance(found, griffe.Module)
    return found


def test_every_public_package_has_a_page_that_the_index_lists() -> None:
    assert set(SECTIONS) == {f"geartrain.{room}" for room in SHOWING}
    for section, page in SECTIONS.items():
        assert section.split(".", 1)[1].replace(".", "-") == page
        assert PAGES[page].startswith(f"# `{section}`: ")
        assert f"({page}.md)" in PAGES["index"]


@pytest.mark.parametrize("page", [page for page in PAGES if "members:" in PAGES[page]])
def test_a_list_of_members_is_complete(page: str) -> None:
    """A list gives the order of use; the names are those of `__all__`."""
    listed = re.search(r"members:\s+\[(.*?)\]", PAGES[page], re.DOTALL)
    assert sorted(re.findall(r"\w+", listed[1])) == importlib.import_module(f"geartrain.{page}").__all__


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
    listed = re.search(r"^The package `geartrain` itself contains .*?\. ", PAGES["index"], re.MULTILINE | re.DOTALL)
    assert set(re.findall(r"`(\w+)`", listed[0])) - {"geartrain"} == names
