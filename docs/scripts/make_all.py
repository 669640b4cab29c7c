"""Make every generated page and picture of the documentation again, and the site: `python docs/scripts/make_all.py`."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import make_accuracy
import make_architecture
import make_best_radii
import make_budgets
import make_commands
import make_diagrams
import make_frames
import make_gallery
import make_images
import make_outputs
import make_palette
import make_sources
import make_study

DOCS = Path(__file__).resolve().parents[1]


def main() -> None:
    """Run all makers, the command that writes the reference, and mkdocs."""
    reference = DOCS / "reference.md"
    subprocess.run(
        [sys.executable, "-m", "geartrain", "inspect", "schema", "--as", "markdown", "-o", str(reference), "--force"],
        check=True,
    )
    makers = (
        make_accuracy,
        make_architecture,
        make_budgets,
        make_best_radii,
        make_commands,
        make_diagrams,
        make_frames,
        make_gallery,
        make_images,
        make_palette,
        make_outputs,
        make_sources,
        make_study,
    )
    for maker in makers:
        maker.main()
    subprocess.run([sys.executable, "-m", "mkdocs", "build", "--strict"], cwd=DOCS.parent, check=True)


if __name__ == "__main__":
    main()
