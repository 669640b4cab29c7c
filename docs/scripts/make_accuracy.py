"""Write the three pages of accuracy and their pictures from docs/data/; `--measure STUDY` repeats a study first."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import import_module
from pathlib import Path
from types import ModuleType

from studies.page import DOCS, from_command_line, with_numbers
from studies.records import StudyRecords

PAGES = {"accuracy": "speeds", "mesh-accuracy": "teeth", "uncertainty-accuracy": "trials"}
"""Page -> its module, and the name of its text, in the folder accuracy."""
STUDIES = {
    "kinematics": "speed_study.speeds",
    "teeth": "tooth_number_study.tooth_numbers",
    "left-out": "left_out_study.continued",
    "sphere": "sphere_study.sphere",
    "mesh": "mesh_study.meshes",
    "shapes": "shape_study.shapes",
    "motion": "motion_study.motion",
    "dynamics": "dynamics_study.dynamics",
    "drawn-teeth": "drawn_study.all_trains",
    "uncertainty": "uncertainty_study.uncertainty",
    "extremes": "extremes_study.extremes",
    "ready-to-cut": "ready_to_cut_study.ready_to_cut",
}
"""File in docs/data/ -> the function of a study that fills it."""


def page(name: str) -> str:
    """The text of a page."""
    text = (Path(__file__).parent / "accuracy" / f"{PAGES[name]}.md").read_text(encoding="utf-8")
    return with_numbers(text, _module(name).figures()) + "\n"


def main() -> None:
    """Write all pages and pictures."""
    for name in PAGES:
        (DOCS / f"{name}.md").write_text(page(name), encoding="utf-8")
        _module(name).draw()
        print(f"wrote docs/{name}.md and docs/images/{name}.svg")


def _module(name: str) -> ModuleType:
    return import_module(f"accuracy.{PAGES[name]}")


def runs() -> Mapping[str, Callable[[], StudyRecords]]:
    """Studies, each imported when it is run: some need a browser or mpmath."""

    def run(place: str) -> StudyRecords:
        module, _, function = place.partition(".")
        found: StudyRecords = getattr(import_module(f"studies.{module}"), function)()
        return found

    return {name: lambda place=place: run(place) for name, place in STUDIES.items()}


if __name__ == "__main__":
    from_command_line(runs(), main)
