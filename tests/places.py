"""Where the repository keeps what tests read."""

from __future__ import annotations

from pathlib import Path

TESTS = Path(__file__).parent
ROOT = TESTS.parent
DATA = TESTS / "data"
DOCS = ROOT / "docs"
TRAINS = ROOT / "trains"


def train_files() -> list[Path]:
    """The declarations of the shipped trains; the evidence for reconstructions is not among them."""
    return sorted(path for path in TRAINS.glob("*/*.yaml") if path.parent.name != "evidence")
