"""Write the time of frames of the viewer into docs/viewer.md; `--measure frames` repeats the study first."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from studies.frame_study import frames
from studies.page import from_command_line
from studies.records import read, table

PAGE = Path(__file__).resolve().parents[1] / "viewer.md"
BEGIN, END = "<!-- frames -->\n", "<!-- end of frames -->"
TRAINS = ("freeth-2021", "zf-8hp70", "planetary-24-18-60")
COLUMNS = {
    "train": lambda row: f"`{row.train}`",
    "triangles": lambda row: f"{row.triangles:,}",
    "frame": lambda row: f"{row.milliseconds:.0f} ms",
    "three.js's example, lamps only": lambda row: f"{row.example_milliseconds:.0f} ms",
    "ratio": lambda row: f"{row.ratio:.2f}",
    "ratio to the example with reflections": lambda row: f"{row.room_ratio:.2f}",
    "page": lambda row: f"{row.kilobytes:,.0f} kB",
    "requests": lambda row: str(row.requests),
}


def main() -> None:
    """Write the table between the two marks."""
    before, _, rest = PAGE.read_text(encoding="utf-8").partition(BEGIN)
    _, _, after = rest.partition(END)
    rows = "\n".join(table(COLUMNS, read("frames").frames))
    PAGE.write_text(f"{before}{BEGIN}\n{rows}\n{END}{after}", encoding="utf-8")
    print("wrote docs/viewer.md")


if __name__ == "__main__":
    from_command_line({"frames": partial(frames, *TRAINS)}, main)
