"""Evidence on docs/which-counts.md gives the trains on the page, derived by hand or found by other programs."""

from __future__ import annotations

import re
from fractions import Fraction
from pathlib import Path

import make_outputs
import pytest
from places import DOCS, ROOT

from geartrain.search.reconstruct import Arbor, Reconstructions, evidence_question, find_reconstructions, read_evidence

PAGE = (DOCS / "which-counts.md").read_text(encoding="utf-8")
FILES = dict(re.findall(r"^<!-- file: (\S+) -->\n```yaml\n(.*?)^```$", PAGE, re.S | re.M))
BOTH = [[27, 53], [27, 53], [54, 192], [54, 192]]
"""64/38 53/96 15/53 = 5/19 and 64/38 53/96 27/223 188/53 30/54 = 940/4237; 64/38 53/53 30/192 = 5/19, and so on."""
ANSWERS: dict[str, list[list[int]]] = {
    "metonic.yaml": [[53], [53]],
    "back.yaml": BOTH,
    "seen.yaml": BOTH[:1],
    "misread.yaml": [],
    "nodes.yaml": [[31 * times, 32 * times] for times in range(1, 8)],  # 49/31 32/48 = 98/93 = 1 + 5/93
}
"""Counts of the added wheels of each train, by file."""
OTHERS: dict[str, tuple[str, list[list[int]]]] = {
    "smaller.yaml": ("extends: back-train\nreconstruct: {add: {wheels: 2, teeth: [12, 191]}}\n", BOTH[:2]),
    "metonic-seen.yaml": ("extends: back-train\ngears: [l2 ~ m1]\n", BOTH[:2]),
    "games.yaml": (  # 5/19 57/60 = 1/4
        "extends: metonic.yaml\nlinks: {o: {wheels: {o1: {teeth: 60, status: surviving, source: F06}}}}\n"
        "outputs: {games: {of: o, expect: 1/4}}\nreconstruct: {add: {wheels: 2, teeth: [12, 225]}}\n",
        [[53, 57]] * 2,
    ),
    "price.yaml": (  # 64/36 54/96 16/64 = 1/4
        "frame: frame\nlinks:\n  frame: {}\n  b: {wheels: {B2: 64}}\n  l: {wheels: {L1: 36, L2: 54}}\n"
        "  m: {wheels: {M1: 96, M2: 16}}\ninputs: {b: 1}\noutputs: {dial: {of: new, expect: -1/4}}\n"
        "reconstruct: {add: {wheels: 1, teeth: [12, 225]}}\n",
        [[64]] * 2,
    ),
    "ring.yaml": (  # 20/24 12/20 = 1/2
        "frame: frame\nlinks:\n  frame: {}\n  a: {wheels: {a1: 20}}\n"
        "  r: {wheels: {r1: {teeth: 24, internal: true}, r2: 12}}\ninputs: {a: 1}\n"
        "outputs: {dial: {of: new, expect: -1/2}}\nreconstruct: {add: {wheels: 1, teeth: [10, 30]}}\n",
        [[20]],
    ),
    "draconic.yaml": (  # 75/16 63/22 = 4725/352
        "frame: frame\nunit: {per: year_tropical_J2000}\nlinks:\n  frame: {}\n  a: {wheels: {r1: 63}}\n"
        "inputs: {a: 75/16}\noutputs:\n  draconic: {of: new, targets: [{name: lunar_draconic_per_year_saros, "
        "tolerance: 100 ppm}]}\nreconstruct: {sense: free, add: {wheels: 1, teeth: [12, 225]}}\n",
        [[22]],
    ),
}
"""Further evidence by file, with the counts of the added wheels of each train."""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a folder with all evidence."""
    (tmp_path / "evidence").symlink_to(ROOT / "evidence")
    for name, text in {**FILES, **{name: text for name, (text, _) in OTHERS.items()}}.items():
        (tmp_path / name).write_text(f"name: {name[:-5]}\n{text}" if name in OTHERS else text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def requested(name: str) -> Reconstructions:
    return find_reconstructions(evidence_question(read_evidence(name)).problem)


def added(arbor: Arbor) -> list[int]:
    """Return the counts of the added wheels on an arbor and below it."""
    wheels = [wheel for wheel, _ in arbor.drives] + [arbor.driven] * (arbor.driven is not None)
    found = [wheel.teeth for wheel in wheels if wheel is not None and wheel.name is None]
    return sorted(found + [teeth for _, below in arbor.drives for each in below for teeth in added(each)])


def speeds(arbor: Arbor, speed: Fraction) -> dict[str, Fraction]:
    """Return the speeds of the dials on an arbor and below it."""
    found = dict.fromkeys(arbor.dials, speed)
    for wheel, below in arbor.drives:
        for each in below:
            found |= speeds(each, -speed * wheel.teeth / each.driven.teeth)
    return found


def test_every_evidence_of_the_page_has_its_answer_here() -> None:
    assert set(FILES) - {"hands.yaml"} == set(ANSWERS)


@pytest.mark.parametrize("name", [*ANSWERS, *OTHERS])
def test_evidence_has_the_trains_that_are_derived_by_hand(name: str, folder: Path) -> None:
    right = ANSWERS[name] if name in ANSWERS else OTHERS[name][1]
    found = requested(name)
    assert found.complete
    assert sorted(added(one.arbor) for one in found.candidates) == right
    assert sum(count.solutions for count in found.counts) == len(right)


def test_all_four_trains_of_the_back_turn_both_pointers_as_the_dials_are_divided(folder: Path) -> None:
    right = {"metonic": Fraction(-5, 19), "saros": Fraction(-4, 223) * Fraction(235, 19)}
    assert [speeds(one.arbor, Fraction(1)) for one in requested("back.yaml").candidates] == [right] * 4


def test_the_page_shows_as_many_trains_as_other_programs_found() -> None:
    said = dict(re.findall(r"^(back-train\S*): (\d+) trains explain the evidence", PAGE, re.M))
    assert said == {"back-train": "4", "back-train-exeligmos": "4", "back-train-moon": "12", "back-train-doubt": "22"}
    assert re.search(r"^3 +21 +7 +7$", PAGE, re.M)
    assert re.search(r"^without the sense of any dial +0 +0 +29 +29$", PAGE, re.M)


@pytest.mark.parametrize("start", ["geartrain teeth ratio", "geartrain teeth train hands", "geartrain reconstruct met"])
def test_a_command_of_the_page_prints_what_the_page_shows(start: str, folder: Path) -> None:
    blocks = re.findall(r"^(?:<!-- show: (.*?) -->\n)?```console\n\$ (.*?)\n(.*?)^```$", PAGE, re.S | re.M)
    marks, command, printed = next(block for block in blocks if block[1].startswith(start))
    output, status = make_outputs.run(command, folder)
    assert status == 0
    assert [*make_outputs._shown(output, marks or None)] == printed.split("\n$ ")[0].splitlines()
