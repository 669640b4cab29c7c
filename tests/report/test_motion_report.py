"""The page of a motion: the table of pairs tells what it leaves out, and leaves nothing out when asked."""

from __future__ import annotations

import shipped

from geartrain.dynamics import MotionRun
from geartrain.report import Section
from geartrain.report.motion_report import collect_motion, describe_motion

TRAIN = "pennestri-2002-teeth"


def pairs(*outputs: str, every_output: bool) -> Section:
    run = MotionRun(shipped.train(TRAIN).motion(outputs=list(outputs)), turns=1.0, samples=11)
    run.run()
    page = describe_motion(collect_motion(run, TRAIN, None), every_output)
    (section,) = (each for each in page.sections if each.title == "Pairs")
    return section


def columns(section: Section) -> list[str]:
    return [head.removesuffix(" (deg)") for table in section.tables for head in table.header[4:]]


def test_outputs_that_are_left_out_are_named() -> None:
    section = pairs(every_output=False)
    assert columns(section) == [str(link) for link in range(3, 11)]
    others = ", ".join([*map(str, range(11, 21)), "sun", "moon"])
    assert list(section.paragraphs)[1:] == [
        "No pair affects 1, 2.",
        f"Not shown: {others}; `--wide` or `--of` shows them.",
    ]


def test_every_output_has_its_column_when_requested() -> None:
    section = pairs(every_output=True)
    assert columns(section) == [*map(str, range(3, 21)), "sun", "moon"]
    assert not any("Not shown" in line for line in section.paragraphs)
    assert {len(table.rows) for table in section.tables} == {18}


def test_a_share_is_the_range_of_the_pair_times_its_lever() -> None:
    """G18 drives link 19 from 18; G17 reaches 19 through G18, whose 15 teeth drive 60."""
    section = pairs("18", "19", every_output=True)
    (table,) = section.tables
    share = {row[0]: [float(cell) for cell in row[4:]] for row in table.rows}
    assert share["G18"][0] == 0
    assert abs(share["G17"][0] / share["G17"][1] - 4) < 2e-3
