"""docs/lines.md says how long the shipped trains are, and a gearbox with three states takes thirteen lines."""

from __future__ import annotations

import re

import yaml
from places import DOCS, train_files

from geartrain import GearTrain


def test_every_shipped_train_is_no_longer_than_in_long_forms() -> None:
    page = (DOCS / "lines.md").read_text(encoding="utf-8")
    rows = {name: (int(long), int(short)) for name, long, short in re.findall(r"\| `(\S+)` \| (\d+) \| (\d+)", page)}
    assert rows.keys() <= {path.stem for path in train_files()}
    assert len(rows) >= 65
    assert all(short <= long for long, short in rows.values())
    long, short = (sum(each) for each in zip(*rows.values(), strict=True))
    assert f"| all | {long:,} | {short:,} |" in page


def test_a_gearbox_with_three_states_takes_thirteen_lines() -> None:
    page = (DOCS / "how-to.md").read_text(encoding="utf-8")
    (text,) = re.findall(r"^<!-- file: small-box.yaml -->\n```yaml\n(.*?)^```$", page, re.S | re.M)
    assert len(text.splitlines()) <= 13
    box = GearTrain.declare(yaml.safe_load(text)).gearbox()
    assert len(box.states) == 3
    assert len({state.ratio for state in box.states}) == 3
