"""A gearbox with three states takes thirteen lines, as docs/how-to.md shows."""

from __future__ import annotations

import re

import yaml
from places import DOCS

from geartrain import GearTrain


def test_a_gearbox_with_three_states_takes_thirteen_lines() -> None:
    page = (DOCS / "how-to.md").read_text(encoding="utf-8")
    (text,) = re.findall(r"^<!-- file: small-box.yaml -->\n```yaml\n(.*?)^```$", page, re.S | re.M)
    assert len(text.splitlines()) <= 13
    box = GearTrain.declare(yaml.safe_load(text)).gearbox()
    assert len(box.states) == 3
    assert len({state.ratio for state in box.states}) == 3
