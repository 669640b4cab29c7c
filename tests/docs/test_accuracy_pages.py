"""Pages of accuracy have the figures of their data, and data files are those that studies write."""

from __future__ import annotations

import json
import re
from importlib import import_module
from typing import get_type_hints

import make_best_radii
import make_study
import pytest
from make_accuracy import PAGES, STUDIES, page
from places import DOCS
from studies.records import StudyRecords, error_text, number, seconds_text, span

OTHERS = {"best_radii", "extras", "frames", "study"}
"""Data of other pages."""


@pytest.mark.parametrize("name", PAGES)
def test_a_page_is_what_its_script_writes_from_the_data(name: str) -> None:
    text = (DOCS / f"{name}.md").read_text(encoding="utf-8")
    assert text == page(name)
    assert len(text.split()) <= 2500
    assert f"(images/{name}.svg)" in text


def test_the_page_on_radii_is_what_its_script_writes_from_the_data() -> None:
    data = json.loads(make_best_radii.DATA.read_text(encoding="utf-8"))
    assert make_best_radii.PAGE.read_text(encoding="utf-8") == make_best_radii.page(data)


def test_the_study_is_what_its_script_writes_from_the_data() -> None:
    data = json.loads(make_study.DATA.read_text(encoding="utf-8"))
    text = make_study.WRITTEN.read_text(encoding="utf-8")
    assert text == make_study.page(data)
    assert len(text.split()) <= 2500
    assert text.count("![") <= 6


@pytest.mark.parametrize(("name", "place"), STUDIES.items())
def test_a_data_file_holds_the_records_of_its_study(name: str, place: str) -> None:
    module, _, function = place.partition(".")
    kind: type[StudyRecords] = get_type_hints(getattr(import_module(f"studies.{module}"), function))["return"]
    assert kind.read(name).text() == (DOCS / "data" / f"{name}.json").read_text(encoding="utf-8")


def test_every_data_file_is_linked_or_read_elsewhere() -> None:
    linked = {name for each in PAGES for name in re.findall(r"\(data/(\S+)\.json\)", page(each))}
    assert linked == {*STUDIES}
    assert {path.stem for path in (DOCS / "data").glob("*")} == linked | OTHERS


def test_numbers_are_written_with_two_digits_and_a_unit() -> None:
    assert [seconds_text(each) for each in (None, 0.00021, 0.5, 3.0, 150.0)] == [
        "-",
        "210 us",
        "500 ms",
        "3 s",
        "2.5 min",
    ]
    assert [error_text(each) for each in (None, 0.0, 1.24e-9)] == ["-", "0", "1.2e-09"]
    assert [number(each) for each in (0.123, 9.46, 9.51, 1234.0, 3.1e7)] == ["0.12", "9.5", "10", "1,200", "3.1e+07"]
    assert (span([2.0, 1.0]), span([1.0, 1.01])) == ("1 to 2", "1")
