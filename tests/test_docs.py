"""The pages say what the code does."""

from __future__ import annotations

import re
from importlib.metadata import version
from pathlib import Path

import pytest

from geartrain.report.reference import declaration_reference

ROOT = Path(__file__).parent.parent
PAGES = [ROOT / "README.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").glob("*.md"))]


def test_the_reference_is_what_the_models_say() -> None:
    assert (ROOT / "docs" / "reference.md").read_text(encoding="utf-8").rstrip() == declaration_reference().rstrip()


def test_the_readme_gives_exactly_two_commands() -> None:
    blocks = re.findall(r"^```sh\n(.*?)^```", (ROOT / "README.md").read_text(encoding="utf-8"), re.S | re.M)
    assert len(blocks) == 2
    assert all("pip install" in block for block in blocks)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_between_pages_lead_somewhere(page: Path) -> None:
    text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.S | re.M)
    for target in re.findall(r"\]\(([^)#\s]+)[^)]*\)", text):
        if not target.startswith("http"):
            assert (page.parent / target).exists(), target


def test_the_changelog_knows_this_version() -> None:
    assert f"## [{version('geartrain')}]" in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
