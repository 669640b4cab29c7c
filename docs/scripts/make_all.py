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
import make_drawn_teeth
import make_dynamics_accuracy
import make_extremes
import make_frames
import make_gallery
import make_images
import make_left_out
import make_lines
import make_mesh_accuracy
import make_motion_accuracy
import make_outputs
import make_palette
import make_ready_to_cut
import make_shapes_accuracy
import make_sources
import make_sphere_accuracy
import make_teeth_accuracy
import make_uncertainty_accuracy

DOCS = Path(__file__).resolve().parents[1]


def main() -> None:
    """Run all makers, the command that writes the reference, and mkdocs."""
    reference = DOCS / "reference.md"
    subprocess.run(
        [sys.executable, "-m", "geartrain", "schema", "--as", "markdown", "-o", str(reference), "--force"], check=True
    )
    accuracy = (
        make_accuracy,
        make_mesh_accuracy,
        make_motion_accuracy,
        make_dynamics_accuracy,
        make_sphere_accuracy,
        make_teeth_accuracy,
        make_shapes_accuracy,
        make_uncertainty_accuracy,
    )
    facts = (
        make_architecture,
        make_budgets,
        make_best_radii,
        make_commands,
        make_diagrams,
        make_drawn_teeth,
        make_extremes,
        make_frames,
        make_gallery,
        make_images,
        make_left_out,
        make_lines,
        make_palette,
        make_outputs,
        make_ready_to_cut,
        make_sources,
    )
    for maker in (*accuracy, *facts):
        maker.main()
    subprocess.run([sys.executable, "-m", "mkdocs", "build", "--strict"], cwd=DOCS.parent, check=True)


if __name__ == "__main__":
    main()
