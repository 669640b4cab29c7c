"""Write what frames of the viewer cost into docs/viewer.md, from a kept run; `--measure` makes the run anew."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from studies.frame_study import FrameRecords, frames
from studies.page import from_command_line, read

PAGE = Path(__file__).resolve().parents[1] / "viewer.md"
BEGIN, END = "<!-- frames -->\n", "<!-- end of frames -->"
TRAINS = ("freeth-2021", "zf-8hp70", "planetary-24-18-60")


def main() -> None:
    """Read the run, write its table between the two marks."""
    (records,) = read(FrameRecords, "frames")
    before, _, rest = PAGE.read_text(encoding="utf-8").partition(BEGIN)
    _, _, after = rest.partition(END)
    table = "\n".join(records.tables())
    PAGE.write_text(f"{before}{BEGIN}\n{table}\n{END}{after}", encoding="utf-8")
    print("wrote docs/viewer.md")


if __name__ == "__main__":
    from_command_line({"frames": partial(frames, *TRAINS)}, partial(frames, "planetary-24-18-60"), main)
