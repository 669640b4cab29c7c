"""Draw the pictures of docs/images: a report as a terminal shows it, triangular teeth in contact, their law,
pointers in motion."""

from __future__ import annotations

import io
import re
from math import radians
from pathlib import Path

from rich.console import Console

import geartrain
from geartrain.motion import Run
from geartrain.plot import law_figure, motion_figure, render, teeth_figure
from geartrain.report import Document, report_train, to_terminal

IMAGES = Path(__file__).resolve().parent / "images"
SECTIONS = ("Fundamental circuits", "Mobility", "Against the targets")


def main() -> None:
    """Write the pictures."""
    IMAGES.mkdir(exist_ok=True)
    report()
    teeth()
    pointers()


def teeth() -> None:
    """The pair of Fig. 5a of Sorge's note: its law, and its wheels in approach."""
    mesh = next(mesh for mesh in geartrain.load("sorge-pairs").meshes if mesh.name == "5a")
    for name, figure in (("law", law_figure(mesh.law)), ("teeth", teeth_figure(mesh.law, radians(3)))):
        (IMAGES / f"{name}.svg").write_bytes(render(figure, ".svg"))
        print(f"wrote docs/images/{name}.svg")


def pointers() -> None:
    """The pointers of the reconstruction of 2021 over a year, and Mars over its whole period."""
    train = geartrain.load("freeth-2021")
    planets = ("mercury", "venus", "mars", "jupiter", "saturn")
    for name, outputs, turns in (("pointers-year", ("moon", *planets), 1.0), ("mars-period", ("mars",), 284.0)):
        figure = motion_figure(Run(train.motion(outputs=outputs), turns, 100_001))
        (IMAGES / f"{name}.svg").write_bytes(render(figure, ".svg"))
        print(f"wrote docs/images/{name}.svg")


def report() -> None:
    """Part of the report on the Antikythera train."""
    whole = report_train(geartrain.load("pennestri-2002"))
    part = Document(whole.title, whole.lead, [section for section in whole.sections if section.title in SECTIONS])
    console = Console(record=True, width=100, highlight=False, file=io.StringIO(), force_terminal=True)
    to_terminal([part], console)
    title = "geartrain report trains/antikythera/pennestri-2002.yaml"
    picture = console.export_svg(title=title, unique_id="report")
    picture = re.sub(r"@font-face \{.*?\}\s*", "", picture, flags=re.DOTALL)  # no fonts from elsewhere
    (IMAGES / "report.svg").write_text(picture, encoding="utf-8")
    print("wrote docs/images/report.svg")


if __name__ == "__main__":
    main()
