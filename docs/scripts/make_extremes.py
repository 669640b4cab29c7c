"""Write docs/extremes.md: every extreme train is run and judged by its reference of 50 digits."""

from __future__ import annotations

import sys
from itertools import groupby
from pathlib import Path

DOCS = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(DOCS.parent / "tests"))

from extremes import CASES, Case, Measured  # noqa: E402


def main() -> None:
    """Measure, write the page."""
    measured = [(case, case.measure()) for case in CASES]
    text = "\n".join([HEAD, table(measured)])
    (DOCS / "extremes.md").write_text(text, encoding="utf-8")
    print("wrote docs/extremes.md")


def table(measured: list[tuple[Case, Measured]]) -> str:
    """A row a run; name and reason once for all runs of a case."""
    lines = [
        "| case | how extreme | error against 50 digits | bound | time | where it stops and why |",
        "|---|---|---|---|---|---|",
    ]
    for (name, why), runs in groupby(measured, key=lambda each: (each[0].name, each[0].why)):
        for first, (case, found) in zip([True, *[False] * len(measured)], runs, strict=False):
            cells = [
                name if first else "",
                case.extreme,
                f"{found.error:.1e} {case.of}",
                f"{case.bound:.0e}",
                seconds(found.seconds),
                why if first else "",
            ]
            lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def seconds(value: float) -> str:
    """Seconds or milliseconds."""
    if value >= 1:
        return f"{value:.1f} s"
    return f"{value * 1e3:.0f} ms" if value >= 0.01 else f"{value * 1e3:.1f} ms"


HEAD = """# How far it reaches: extreme trains against 50 digits

Written by `python docs/scripts/make_extremes.py`, which runs every train below and its reference: the closure equations
of the source of the tooth law, couple by couple, in 50 digits, and all laws of a train solved at once by Newton's
method. It takes from geartrain the sizes of the teeth, as exact, and its answer as the place to start from. Torques are
balanced again in fractions.

The same runs are tests, in `tests/analysis/test_extremes.py`, which hold each error below its bound: some roundings of
1.1e-16, times what the train makes of them, or the arithmetic that the last column names. The last digits of small
errors are chance. Times are of the floats alone, for motions of all positions of a run, on a machine with two cores.

What cannot be followed is refused: a differential near locking that is driven from its slow side would be moved past a
dead centre by the ripple of its own teeth.
"""

if __name__ == "__main__":
    main()
