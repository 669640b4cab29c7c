"""Draw docs/images/report.svg: a part of the report on the Antikythera train, as a terminal shows it."""

from __future__ import annotations

import io
import re
from pathlib import Path

from rich.console import Console

import geartrain
from geartrain.report import Document, report_train, to_terminal

PICTURE = Path(__file__).resolve().parent / "images" / "report.svg"
SECTIONS = ("Fundamental circuits", "Mobility", "Against the targets")


def main() -> None:
    """Write the picture."""
    whole = report_train(geartrain.load("pennestri-2002"))
    part = Document(whole.title, whole.lead, [section for section in whole.sections if section.title in SECTIONS])
    console = Console(record=True, width=100, highlight=False, file=io.StringIO(), force_terminal=True)
    to_terminal([part], console)
    title = "geartrain report trains/antikythera/pennestri-2002.yaml"
    PICTURE.parent.mkdir(exist_ok=True)
    picture = console.export_svg(title=title, unique_id="report")
    picture = re.sub(r"@font-face \{.*?\}\s*", "", picture, flags=re.DOTALL)  # no fonts from elsewhere
    PICTURE.write_text(picture, encoding="utf-8")
    print("wrote docs/images/report.svg")


if __name__ == "__main__":
    main()
