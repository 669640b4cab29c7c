"""Templates run as they are: sound, in short forms, and with all that their comments promise."""

from __future__ import annotations

from pathlib import Path

import pytest
from typer.testing import CliRunner

import geartrain
from geartrain.cli import app
from geartrain.cli.declarations import TEMPLATES
from geartrain.train.declaration_style import with_short_forms

KINDS = sorted(path.stem for path in TEMPLATES.glob("*.yaml"))
runner = CliRunner()


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("kind", KINDS)
def test_a_template_is_sound_as_it_is(kind: str) -> None:
    assert runner.invoke(app, ["init", kind]).exit_code == 0
    assert runner.invoke(app, ["check", f"{kind}.yaml"]).output.startswith(f"ok   {kind}.yaml")
    text = Path(f"{kind}.yaml").read_text(encoding="utf-8")
    assert with_short_forms(text) == text
    assert "#" in text
    train = geartrain.load(f"{kind}.yaml")
    assert all(train.answers())
    assert not [each for each in train.build_findings if each.level == "error"]


@pytest.mark.parametrize("kind", KINDS)
def test_what_a_comment_says_can_be_run(kind: str) -> None:
    runner.invoke(app, ["init", kind])
    first = Path(f"{kind}.yaml").read_text(encoding="utf-8").splitlines()[0]
    (command,) = [words for words in first.split("`") if words.startswith("geartrain ")]
    words = command.replace("FILE", f"{kind}.yaml").split()[1:]
    assert runner.invoke(app, words).exit_code == 0


def test_a_file_that_is_there_is_kept_and_an_unknown_kind_gets_a_suggestion() -> None:
    Path("clock.yaml").write_text("mine", encoding="utf-8")
    assert "the file exists" in str(runner.invoke(app, ["init", "clock"]).exception)
    assert Path("clock.yaml").read_text(encoding="utf-8") == "mine"
    assert "orrery" in str(runner.invoke(app, ["init", "orery"]).exception)
    printed = runner.invoke(app, ["init", "orrery", "-o", "-"])
    assert printed.stdout == (TEMPLATES / "orrery.yaml").read_text(encoding="utf-8")
