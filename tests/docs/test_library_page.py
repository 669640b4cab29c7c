"""The scripts of docs/library.md run, find what they assert, and print what the page shows."""

from __future__ import annotations

import re
import runpy
from pathlib import Path

import pytest
from places import DOCS

PAGE = (DOCS / "library.md").read_text(encoding="utf-8")
FILES = dict(re.findall(r"^<!-- file: (\S+) -->\n```\w+\n(.*?)^```$", PAGE, re.S | re.M))
SHOWN = re.findall(r"^```console\n\$ python (\S+)\n(.*?)^```$", PAGE, re.S | re.M)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with every file of the page."""
    for name, text in FILES.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_every_script_of_the_page_is_run_and_every_block_of_python_is_a_script() -> None:
    assert [name for name, _ in SHOWN] == [name for name in FILES if name.endswith(".py")]
    assert len(re.findall(r"^```python$", PAGE, re.M)) == len(SHOWN) == 5


@pytest.mark.parametrize(("name", "shown"), SHOWN, ids=[name for name, _ in SHOWN])
def test_a_script_runs_and_prints_what_is_shown(
    name: str, shown: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    runpy.run_path(str(folder / name), run_name="__main__")
    assert capsys.readouterr().out == shown
