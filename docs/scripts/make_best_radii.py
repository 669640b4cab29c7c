"""Write docs/best-radii.md: radii of triangular teeth with minimum loss, by tooth counts, and a formula for makers.

`python docs/scripts/make_best_radii.py --data` searches them again and writes docs/data/best_radii.json (some minutes).
"""

from __future__ import annotations

import json
import sys
from math import exp, log, pi
from pathlib import Path

import numpy as np
from studies.page import with_numbers
from studies.records import span, table

from geartrain.errors import GearTrainError
from geartrain.workshop import ToothSizes
from geartrain.workshop.sizes.size_design import equal_depth_radii
from geartrain.workshop.sizes.size_search import SizeSearch

DOCS = Path(__file__).resolve().parents[1]
PAGE, DATA = DOCS / "best-radii.md", DOCS / "data" / "best_radii.json"
COUNTS = (10, 12, 15, 20, 24, 30, 40, 48, 60, 80, 96, 120)
STEEPEST = 5  # of a ratio of counts
SHOWN = ((12, 24), (15, 60), (24, 48), (48, 48), (48, 96), (60, 15), (96, 96))
FRICTION, HALF_ANGLE, WINDOW = 0.2, pi / 6, 0.5
Row = dict[str, float]


def design(z1: int, z2: int, radii: float) -> ToothSizes:
    """A pair with the friction, half angle and clearance of the page."""
    return ToothSizes((z1, z2), radii, WINDOW, (HALF_ANGLE, HALF_ANGLE), FRICTION)


def loss(z1: int, z2: int, radii: float) -> float | None:
    """Loss of a pair; None if it does not turn."""
    made = design(z1, z2, radii)
    return made.loss if made.runs else None


def find() -> list[dict[str, float | None]]:
    """The best radii of all pairs of counts."""
    rows: list[dict[str, float | None]] = []
    for z1 in COUNTS:
        for z2 in COUNTS:
            if not 1 / STEEPEST <= z1 / z2 <= STEEPEST:
                continue
            try:
                best = SizeSearch(design(z1, z2, 1.0), {"radii": (0.8, 1.25)}).minimum("loss")
            except GearTrainError:
                continue
            equal = equal_depth_radii(z1, z2, (HALF_ANGLE, HALF_ANGLE))
            rows.append(
                {
                    **{"z1": z1, "z2": z2, "radii": round(best.radii, 6), "loss": best.loss},
                    **{"equal_depth": loss(z1, z2, equal), "pitch_true": loss(z1, z2, 1.0)},
                }
            )
    return rows


def fit(rows: list[Row]) -> tuple[float, float]:
    """A and B of formula (1), by least squares of the logarithm."""
    matrix = np.array([[-(1 / row["z1"] - 1 / row["z2"]), -((1 / row["z1"] + 1 / row["z2"]) ** 2)] for row in rows])
    found = np.linalg.lstsq(matrix, np.array([log(row["radii"]) for row in rows]), rcond=None)[0]
    return round(float(found[0]), 2), round(float(found[1]), 2)


def transmission(z1: float, z2: float, A: float, B: float) -> float:
    """Ratio of the radii over that of the teeth, by formula (1)."""
    return exp(-A * (1 / z1 - 1 / z2) - B * (1 / z1 + 1 / z2) ** 2)


def page(rows: list[Row]) -> str:
    """The page."""
    A, B = fit(rows)
    pairs = [(int(row["z1"]), int(row["z2"])) for row in rows]
    off = [100 * abs(transmission(*pair, A, B) / row["radii"] - 1) for pair, row in zip(pairs, rows, strict=True)]
    spent = {pair: loss(*pair, transmission(*pair, A, B)) for pair in pairs}
    times = [(spent[pair] or 1.0) / row["loss"] for pair, row in zip(pairs, rows, strict=True)]
    equal = [row["equal_depth"] / row["loss"] for row in rows if row["equal_depth"] is not None]
    true = [row["pitch_true"] / row["loss"] for row in rows if row["pitch_true"] is not None]
    shown = [row for pair, row in zip(pairs, rows, strict=True) if pair in SHOWN]
    columns = {
        "teeth": lambda row: f"{row['z1']}/{row['z2']}",
        "best": lambda row: f"{row['radii']:.4f}",
        "formula (1)": lambda row: f"{transmission(row['z1'], row['z2'], A, B):.4f}",
        "minimum loss": lambda row: _percent(row["loss"]),
        "with (1)": lambda row: _percent(spent[row["z1"], row["z2"]]),
        "pitch-true": lambda row: _percent(row["pitch_true"]),
        "equal depth": lambda row: _percent(row["equal_depth"]),
    }
    numbers = {
        "A": A,
        "B": B,
        "pairs": len(rows),
        "counts": f"{COUNTS[0]} to {COUNTS[-1]}",
        "ratio": STEEPEST,
        "friction": FRICTION,
        "worst": f"{max(off):.1f}",
        "large": f"{max(each for each, row in zip(off, rows, strict=True) if min(row['z1'], row['z2']) >= 20):.1f}",
        "median": f"{np.median(times):.3f}",
        "most": f"{max(times):.2f}",
        "true": f"{np.median(true):.1f} and {max(true):.1f}",
        "equal": f"{np.median(equal):.1f} and {max(equal):.1f}",
        "table": "\n".join(table(columns, shown)).strip(),
        "equal_driver": f"{100 * (exp(B * (2 / 48) ** 2) - 1):.2f}",
        "share": span((row["loss"] / (1 / row["z1"] + 1 / row["z2"]) for row in rows), lambda each: f"{each:.2f}"),
        "involute": f"{pi * FRICTION / 2:.2f}",
    }
    text = (Path(__file__).parent / "accuracy" / "best-radii.md").read_text(encoding="utf-8")
    return with_numbers(text, numbers) + "\n"


def _percent(value: float | None) -> str:
    return "does not turn" if value is None else f"{100 * value:.2f} %"


def main() -> None:
    """Write the page, with `--data` after a new search."""
    if "--data" in sys.argv[1:]:
        text = ",\n".join(json.dumps(row) for row in find())
        DATA.write_text(f"[\n{text}\n]\n", encoding="utf-8")
    PAGE.write_text(page(json.loads(DATA.read_text(encoding="utf-8"))), encoding="utf-8")
    print("wrote docs/best-radii.md")


if __name__ == "__main__":
    main()
