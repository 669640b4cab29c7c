"""The pages lead where they say: headings, extras, keys and commands that exist."""

from __future__ import annotations

import re
import tomllib
from importlib.metadata import metadata, version
from pathlib import Path

import pytest
from commands import call
from places import ROOT

PAGES = [
    ROOT / "README.md",
    ROOT / "CHANGELOG.md",
    *(ROOT / "docs").glob("*.md"),
    *(ROOT / "docs" / "api").glob("*.md"),
]


def prose(page: Path) -> str:
    return re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.S | re.M)


def anchors(page: Path) -> list[str]:
    """The fragments of a page's headings as GitHub makes them."""
    found: list[str] = []
    for heading in re.findall(r"^#+ (.*)$", prose(page), re.M):
        text = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
        slug = re.sub(r"[^\w\- ]", "", text).replace(" ", "-")
        found.append(f"{slug}-{found.count(slug)}" if slug in found else slug)
    return found


def links(page: Path) -> list[tuple[Path, str]]:
    """Relative links as the file they name and the fragment in it."""
    targets = re.findall(r"\]\(([^()\s]+)\)", prose(page))
    parts = [target.partition("#") for target in targets if not re.match(r"[a-z]+:", target)]
    return [((page.parent / file).resolve() if file else page.resolve(), fragment) for file, _, fragment in parts]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_to_files_and_to_headings_in_them(page: Path) -> None:
    for target, fragment in links(page):
        assert target.exists(), target
        assert target.is_relative_to(ROOT)
        if fragment:
            assert fragment in anchors(target), f"{target.name}#{fragment}"


def test_every_page_can_be_reached_from_the_readme() -> None:
    seen, todo = set(), [(ROOT / "README.md").resolve()]
    while todo:
        page = todo.pop()
        if page in seen or page.suffix != ".md" or not page.exists():
            continue
        seen.add(page)
        todo += [target for target, _ in links(page)]
    assert {page.resolve() for page in PAGES} - seen == {ROOT / "docs" / "index.md"} - seen


def test_the_two_commands_of_the_readme_use_extras_and_files_that_exist() -> None:
    blocks = re.findall(r"^```sh\n(.*?)^```", (ROOT / "README.md").read_text(encoding="utf-8"), re.S | re.M)
    assert len(blocks) == 2
    assert all("pip install" in block for block in blocks)
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = {extra for block in blocks for extra in re.findall(r"\.\[(\w+)\]", block)}
    assert extras == {"dev"} <= set(project["optional-dependencies"])
    files = [word for block in blocks for word in block.split() if word.endswith(".yaml")]
    assert files
    assert all((ROOT / file).is_file() for file in files)


def test_the_version_is_one_everywhere() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    released = re.findall(r"^## \[(\d[^]]*)\]", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), re.M)
    assert released[0] == project["version"] == version("geartrain") == metadata("geartrain")["Version"]


def test_the_first_train_of_the_readme_is_short_and_solves_as_shown(tmp_path: Path) -> None:
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    lesson = text.partition("## An example")[2]
    declared, shown = re.findall(r"^```(?:yaml|console)\n(.*?)^```", lesson, re.S | re.M)[:2]
    path = tmp_path / "first.yaml"
    path.write_text(declared, encoding="utf-8")
    assert len(declared.splitlines()) <= 12
    assert shown == "$ geartrain solve first.yaml\n" + call("solve", path).output
