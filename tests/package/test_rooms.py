"""The house of the package: its rooms, its words, and the size of what stands in them."""

from __future__ import annotations

import ast
import importlib
import re
from collections import defaultdict
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import NamedTuple

from places import ROOT, TESTS

from geartrain.errors import MissingExtraError
from geartrain.wings import WINGS

PACKAGE = ROOT / "geartrain"
ROOMS = {
    *("cli", "report", "drawing", "viewer", "scene", "spherical", "analysis"),
    *("dynamics", "kinematics", "train", "teeth", "numerics", "errors", "wings"),
    *("search", "workshop", "simulation"),
}
FILES = {"__init__", "__main__", "py"}

# words in -ing that the field uses as nouns
NOUNS = {
    "bearing",
    "coupling",
    "cutting",
    "drawing",
    "manufacturing",
    "matching",
    "packing",
    "phasing",
    "ring",
    "scaling",
    "sharing",
}


@cache
def modules() -> dict[str, Path]:
    """Every module of the package by its dotted name."""
    found = sorted(path.relative_to(ROOT) for path in PACKAGE.rglob("*.py"))
    return {".".join(path.with_suffix("").parts).removesuffix(".__init__"): path for path in found}


class Syntax(NamedTuple):
    """What the tests ask of a module's source."""

    docstring: str | None
    public_classes: list[str]


@cache
def syntax(path: Path) -> Syntax:
    tree = ast.parse((ROOT / path).read_text(encoding="utf-8"))
    classes = [part.name for part in tree.body if isinstance(part, ast.ClassDef) and not part.name.startswith("_")]
    return Syntax(ast.get_docstring(tree), classes)


def test_every_entry_of_the_package_is_a_room_of_the_house() -> None:
    entries = {path.name.partition(".")[0] for path in PACKAGE.iterdir() if path.name != "__pycache__"}
    assert entries - FILES == ROOMS


def test_every_room_says_what_it_is() -> None:
    rooms = [name for name, path in modules().items() if path.name == "__init__.py"]
    silent = [name for name in rooms if not syntax(modules()[name]).docstring]
    assert silent == []


def mapped(docstring: str) -> set[str]:
    """Modules that the map of a package names: the first column of a list, or what stands in backticks after "Map:"."""
    rows = re.findall(r"^ {0,4}([a-z_]+(?:, [a-z_]+)*) {2,}\S", docstring, re.MULTILINE)
    _, _, prose = docstring.partition("\nMap: ")
    return {name for row in rows for name in row.split(", ")} | set(re.findall(r"`([a-z_]+)`", prose.split("\n\n")[0]))


def test_the_map_of_a_package_names_what_is_in_it() -> None:
    wrong = {}
    for name, path in modules().items():
        if path.name == "__init__.py":
            inside = {part.stem for part in (ROOT / path).parent.iterdir()}
            public = set(getattr(importlib.import_module(name), "__all__", ()))
            wrong[name] = mapped(syntax(path).docstring or "") - inside - public
    assert {name: missing for name, missing in wrong.items() if missing} == {}
    assert mapped("Sums.\n\nparts, other   what is there\n\nMap: `one` and `two`.\n\n`three`") == {
        *("parts", "other", "one", "two"),
    }


def test_a_folder_holds_two_modules_or_more_and_depth_is_bounded() -> None:
    folders = {path.parent for path in PACKAGE.rglob("*.py")}
    assert [str(folder) for folder in folders if len(list(folder.glob("*.py"))) < 2] == []
    paths = [folder.relative_to(PACKAGE).parts for folder in folders - {PACKAGE}]
    assert [path for path in paths if len(path) > (3 if path[0] in WINGS else 2)] == []


def test_no_two_public_classes_share_a_name() -> None:
    homes: dict[str, list[str]] = defaultdict(list)
    for name, path in modules().items():
        for public_class in syntax(path).public_classes:
            homes[public_class].append(name)
    assert {name: where for name, where in homes.items() if len(where) > 1} == {}


def test_modules_are_named_by_nouns() -> None:
    def participle(stem: str) -> bool:
        last = stem.rpartition("_")[2]
        return last.endswith(("ing", "ed")) and last not in NOUNS

    stems = {part for name in modules() for part in name.split(".")}
    assert sorted(filter(participle, stems)) == []


# files whose `geartrain` is the object that a page with the viewer gives to scripts
OF_THE_PAGE = {"docs/viewer.md", *(f"tests/browser/{path.name}" for path in (TESTS / "browser").glob("*.py"))}
# files that a command writes, and a name that is to be missing
NO_MODULE = {"geartrain.schema.json", "geartrain.drawing.nothing"}


def dotted_names() -> Iterator[tuple[str, str]]:
    """Each dotted name below `geartrain` in tests, in the documentation and in settings, with its place."""
    files = [ROOT / "README.md", ROOT / "pyproject.toml", ROOT / "mkdocs.yml"]
    for folder in (TESTS, ROOT / "docs"):
        files += [path for path in folder.rglob("*") if path.suffix in (".py", ".md", ".yml")]
    for path in files:
        place = str(path.relative_to(ROOT))
        if place not in OF_THE_PAGE:
            for name in re.findall(r"\bgeartrain(?:\.[A-Za-z_]\w*)+", path.read_text(encoding="utf-8")):
                yield name, place


def exists(name: str) -> bool:
    """Whether a dotted name is a module, or an attribute of one, or an attribute of that."""
    parts = name.split(".")
    known = max(at for at in range(1, len(parts) + 1) if ".".join(parts[:at]) in modules())
    try:
        thing: object = importlib.import_module(".".join(parts[:known]))
    except MissingExtraError:  # the module exists, and the library that it imports is not installed
        return True
    for part in parts[known:]:
        if not hasattr(thing, part):
            return False
        thing = getattr(thing, part)
    return True


def test_every_module_that_a_test_or_a_page_names_is_there() -> None:
    """A test that asks whether an old name is *not* imported would go on passing and ask nothing."""
    places = defaultdict(set)
    for name, place in dotted_names():
        places[name].add(place)
    missing = {name: sorted(where) for name, where in places.items() if name not in NO_MODULE and not exists(name)}
    assert missing == {}


def test_every_name_that_a_page_imports_is_there() -> None:
    missing = []
    for path in (ROOT / "README.md", *(ROOT / "docs").glob("*.md")):
        text = path.read_text(encoding="utf-8")
        for module, names in re.findall(r"^ *from (geartrain[\w.]*) import (\([^)]*\)|[^\n(]+)$", text, re.MULTILINE):
            for name in re.split(r"[,\s]+", names.strip("() \n").split(" as ")[0]):
                if name and not exists(f"{module}.{name}"):
                    missing.append(f"{path.name}: {module}.{name}")
    assert missing == []
