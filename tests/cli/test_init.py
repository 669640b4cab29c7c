"""Templates run as they are: sound, in short forms, and with all that their comments promise."""

from __future__ import annotations

from pathlib import Path

import pytest
from commands import call
from places import ROOT

import geartrain

pytestmark = pytest.mark.usefixtures("here")

TEMPLATES = ROOT / "geartrain" / "cli" / "templates"
KINDS = sorted(path.stem for path in TEMPLATES.glob("*.yaml"))


@pytest.mark.parametrize("kind", KINDS)
def test_a_template_is_sound_as_it_is(kind: str) -> None:
    assert call("init", kind).exit_code == 0
    assert call("check", f"{kind}.yaml").output.startswith(f"ok   {kind}.yaml")
    text = Path(f"{kind}.yaml").read_text(encoding="utf-8")
    assert call("format", "--check", f"{kind}.yaml").exit_code == 0
    assert "#" in text
    train = geartrain.load(f"{kind}.yaml")
    assert all(train.answers())
    assert not [each for each in train.build_findings if each.level == "error"]


@pytest.mark.parametrize("kind", KINDS)
def test_what_a_comment_says_can_be_run(kind: str) -> None:
    call("init", kind)
    first = Path(f"{kind}.yaml").read_text(encoding="utf-8").splitlines()[0]
    (command,) = [words for words in first.split("`") if words.startswith("geartrain ")]
    words = command.replace("FILE", f"{kind}.yaml").split()[1:]
    assert call(*words).exit_code == 0


def test_an_unknown_kind_gets_a_suggestion_and_a_template_is_printed_as_it_is() -> None:
    assert "orrery" in str(call("init", "orery").exception)
    printed = call("init", "orrery", "-o", "-")
    assert printed.stdout == (TEMPLATES / "orrery.yaml").read_text(encoding="utf-8")
