"""Manufacturing processes: kerf, minimum web, and attainable fits.

The numbers are typical values of makers and machine vendors, not limits, so a test piece should be cut. Their sources
are listed in docs/export.md.
"""

from __future__ import annotations

from dataclasses import dataclass

from geartrain.errors import Problem, QuestionError, suggest


@dataclass(frozen=True, slots=True)
class Process:
    """Manufacturing process with its kerf and fits [mm].

    `web` is the minimum width of material between two cuts, and `wall` the minimum wall thickness of a pipe.
    """

    name: str
    """Name of the process: laser, cnc, fdm or hand."""
    kerf: float
    """Width of the cut [mm]; half of it is added to every outline."""
    web: float
    running: float
    """Diametral clearance of a running fit [mm]."""
    press: float
    """Diametral clearance of a fixed joint [mm]; 0 for nominal sizes, which are fitted as described by `joint`."""
    backlash: float
    """Circumferential backlash at the pitch circle [modules]."""
    wall: float
    joint: str
    """Method by which wheels are fixed on arbors, as text."""


PROCESSES = {
    each.name: each
    for each in (
        Process("laser", 0.2, 1.0, 0.15, 0.0, 0.1, 0.5, "pushed on and glued"),
        Process("cnc", 0.0, 0.8, 0.03, 0.0, 0.05, 0.5, "pressed, H7/s6"),
        Process("fdm", 0.0, 1.2, 0.5, 0.2, 0.2, 1.2, "pressed"),
        Process("hand", 0.0, 0.5, 0.08, 0.0, 0.05, 0.5, "broached to a tight fit, or soldered"),
    )
}
"""Manufacturing processes by name."""

USUAL = "hand"
"""Default process: nominal sizes, with a clockmaker's fits."""


def process_named(name: str | None) -> Process:
    """Return the process with a given name, the default process for None; raise `QuestionError` if it is unknown."""
    wanted = USUAL if name is None else name
    if wanted not in PROCESSES:
        what, fix = f"'{wanted}' is not a manufacturing process", suggest(wanted, PROCESSES)
        raise QuestionError(Problem(what, "the processes are predefined", fix, "--process"))
    return PROCESSES[wanted]
