"""The evidence on docs/reconstruct.md has the answers that the page tells: found by hand, or by other programs."""

from __future__ import annotations

import re
from fractions import Fraction
from pathlib import Path

import pytest
from places import DOCS, ROOT

from geartrain.search.reconstruct import Arbor, Reconstructions, evidence_question, find_reconstructions, read_evidence

PAGE = (DOCS / "reconstruct.md").read_text(encoding="utf-8")
FILES = dict(re.findall(r"^<!-- file: (\S+) -->\n```yaml\n(.*?)^```$", PAGE, re.S | re.M))
FILES["metonic.yaml"] = "".join(FILES.pop(f"{part}.yaml") for part in ("dial", "wheels", "question"))
BOTH = [[27, 53], [27, 53], [54, 192], [54, 192]]
"""64/38 53/96 15/53 = 5/19 and 64/38 53/96 27/223 188/53 30/54 = 940/4237; 64/38 53/53 30/192 = 5/19, and so on."""
ANSWERS: dict[str, list[list[int]]] = {
    "metonic.yaml": [[53], [53]],
    "back.yaml": BOTH,
    "seen.yaml": BOTH[:1],
    "metonic-seen.yaml": BOTH[:2],
    "smaller.yaml": BOTH[:2],
    "games.yaml": [[53, 57]] * 2,  # 5/19 57/60 = 1/4
    "price.yaml": [[64]] * 2,  # 64/36 54/96 16/64 = 1/4
    "price-metonic.yaml": [],
    "ring.yaml": [[20]],  # 20/24 12/20 = 1/2
    "draconic.yaml": [[22]],  # 75/16 63/22 = 4725/352
    "nodes.yaml": [[31 * times, 32 * times] for times in range(1, 8)],  # 49/31 32/48 = 98/93 = 1 + 5/93
}
"""By file, counts of the added wheels of each train."""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with all evidence of the page."""
    (tmp_path / "evidence").symlink_to(ROOT / "evidence")
    for name, text in FILES.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def requested(name: str) -> Reconstructions:
    return find_reconstructions(evidence_question(read_evidence(name)).problem)


def added(arbor: Arbor) -> list[int]:
    """Counts of the added wheels on an arbor and below it."""
    wheels = [wheel for wheel, _ in arbor.drives] + [arbor.driven] * (arbor.driven is not None)
    found = [wheel.teeth for wheel in wheels if wheel is not None and wheel.name is None]
    return sorted(found + [teeth for _, below in arbor.drives for each in below for teeth in added(each)])


def speeds(arbor: Arbor, speed: Fraction) -> dict[str, Fraction]:
    """Speeds of the dials on an arbor and below it."""
    found = dict.fromkeys(arbor.dials, speed)
    for wheel, below in arbor.drives:
        for each in below:
            assert each.driven is not None
            found |= speeds(each, -speed * wheel.teeth / each.driven.teeth)
    return found


def test_every_evidence_of_the_page_has_its_answer_here() -> None:
    assert set(FILES) == set(ANSWERS)


@pytest.mark.parametrize("name", ANSWERS)
def test_evidence_of_the_page_has_the_trains_that_are_told(name: str, folder: Path) -> None:
    found = requested(name)
    assert found.complete
    assert sorted(added(one.arbor) for one in found.candidates) == ANSWERS[name]
    assert sum(count.solutions for count in found.counts) == len(ANSWERS[name])


def test_all_four_trains_of_the_back_turn_both_pointers_as_the_dials_are_divided(folder: Path) -> None:
    right = {"metonic": Fraction(-5, 19), "saros": Fraction(-4, 223) * Fraction(235, 19)}
    assert [speeds(one.arbor, Fraction(1)) for one in requested("back.yaml").candidates] == [right] * 4


def test_the_page_shows_as_many_trains_as_other_programs_found() -> None:
    blocks = re.findall(r"^```console\n\$ geartrain reconstruct (back-train\S*)(.*?)^```", PAGE, re.S | re.M)
    said = {name: re.search(r"^2 +(\d+) +\d+ +\d+$", text, re.M) for name, text in blocks if "\nCounts\n" in text}
    right = {"back-train": "4", "back-train-exeligmos": "4", "back-train-moon": "12", "back-train-doubt": "22"}
    assert {name: shown and shown[1] for name, shown in said.items()} == right
    assert re.search(r"^without the sense of any dial +0 +0 +29 +29$", PAGE, re.M)
