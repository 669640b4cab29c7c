"""Paths of the files that tests read."""

from __future__ import annotations

from pathlib import Path

TESTS = Path(__file__).parent
ROOT = TESTS.parent
DATA = TESTS / "data"
DOCS = ROOT / "docs"
TRAINS = ROOT / "trains"


def train_files() -> list[Path]:
    """Return the declarations of the shipped trains, without the evidence for reconstructions."""
    return sorted(path for path in TRAINS.glob("*/*.yaml") if path.parent.name != "evidence")
