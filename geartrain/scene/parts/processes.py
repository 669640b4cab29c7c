"""How parts are made: what a process cuts away, the thinnest web it leaves, and the fits that it can hold.

The numbers are usual ones of makers and of their machines' vendors, not limits: cut a test piece. Their sources
stand in docs/export.md.
"""

from __future__ import annotations

from dataclasses import dataclass

from geartrain.errors import Problem, QuestionError, suggest


@dataclass(frozen=True, slots=True)
class Process:
    """A way to make flat parts and what turns in them; lengths in mm."""

    name: str
    """Laser, cnc, fdm or hand."""
    kerf: float
    """Width that the cut takes away; half of it is added to every outline."""
    web: float
    """The thinnest wall or land that holds."""
    running: float
    """Diametral clearance of what turns, and of what is joined (0: nominal sizes, fitted as `joint` says)."""
    press: float
    """Diametral clearance of what turns, and of what is joined (0: nominal sizes, fitted as `joint` says)."""
    backlash: float
    """Of teeth along the pitch circle [modules]."""
    wall: float
    """The thinnest wall of a pipe."""
    joint: str
    """How wheels are held on arbors."""


PROCESSES = {
    each.name: each
    for each in (
        Process("laser", 0.2, 1.0, 0.15, 0.0, 0.1, 0.5, "pushed on and glued"),
        Process("cnc", 0.0, 0.8, 0.03, 0.0, 0.05, 0.5, "pressed, H7/s6"),
        Process("fdm", 0.0, 1.2, 0.5, 0.2, 0.2, 1.2, "pressed"),
        Process("hand", 0.0, 0.5, 0.08, 0.0, 0.05, 0.5, "broached to a tight fit, or soldered"),
    )
}
"""By name."""

USUAL = "hand"
"""The process of those who name none: true size, a clockmaker's fits."""


def process_named(name: str | None) -> Process:
    """The process of a name; the usual one for None. Raises `QuestionError` for any other."""
    wanted = USUAL if name is None else name
    if wanted not in PROCESSES:
        fix = suggest(wanted, PROCESSES)
        raise QuestionError(Problem(f"there is no process '{wanted}'", "", fix, "--process"))
    return PROCESSES[wanted]
