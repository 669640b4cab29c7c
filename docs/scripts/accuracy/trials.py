"""Figures and picture of docs/uncertainty-accuracy.md."""

from __future__ import annotations

from math import log10
from typing import Any

from studies.cut_pair_trials import EVERY, PLACES
from studies.page import HUES, error_over_time, picture
from studies.records import error_text, number, read, seconds_text, span, table
from studies.uncertainty_records import COUNTS, DISPLACED, SINGLY, RateRecord, UncertaintyRecords, at_one

from accuracy import Comparison, comparisons

UNITS = {COUNTS: "combination", PLACES: "tooth pitch", EVERY: "tooth pitch", DISPLACED: "tooth pitch"}
NAMES = {
    COUNTS: "tooth counts: {}",
    PLACES: "pitch deviations: {}",
    EVERY: "all deviations: {}",
    DISPLACED: "pitch deviations and eccentricity: {}",
}
SHOWN = (
    "differential near locking",
    "pin and slot of ratio 1 on an arm",
    "twelve pairs, 10 to 1 each",
    "pairs in a row, each with a transmission error",
    "efficiency near friction locking",
    "clearance at an end of the window",
    "tips that hardly overlap",
    "recirculating power",
    "pin near the axis of its slot",
    "four pairs in a ring",
)
MINIMUM = 1e-17


def figures() -> dict[str, object]:
    """All figures of the page."""
    return {"table": rates(), "extremes": extremes(), **_trials(), **_extremes(), **_ready()}


def rates() -> str:
    """Batches against loops over single solutions."""
    found = []
    for _loop, batch in _pairs():
        unit = UNITS[batch.family]
        found.append(
            Comparison(
                NAMES[batch.family].format(batch.case) + _what(batch),
                error_text(batch.error) if batch.error is not None else f"{batch.differing} of {batch.checked} differ",
                batch.seconds / batch.trials / batch.work,
                f"loop, one {unit} at a time",
                "reference",
                batch.seconds / batch.trials / batch.work * batch.ratio,
            )
        )
    return comparisons(found)


def _pairs() -> list[tuple[RateRecord, RateRecord]]:
    """Each loop and each batch compared with it."""
    rows = UncertaintyRecords.read("uncertainty").rates
    loops = {(row.family, row.case): row for row in rows if row.method == SINGLY}
    return [(loops[row.family, row.case], row) for row in rows if row.checked or row.error is not None]


def _what(batch: RateRecord) -> str:
    """What is computed for combinations of counts; nothing for teeth."""
    return "" if batch.family != COUNTS else ", fit" if batch.error is None else ", speeds"


def extremes() -> str:
    """The most extreme run of each chosen case."""
    cases = read("extremes").cases
    columns = {
        "case": lambda row: row.name,
        "parameters": lambda row: row.extreme,
        "error relative to 50 digits": lambda row: f"{row.error:.1e} {row.unit}",
        "bound": lambda row: f"{row.bound:.0e}",
        "time": lambda row: seconds_text(row.seconds),
    }
    return "\n".join(table(columns, [[row for row in cases if row.name == name][-1] for name in SHOWN])).strip()


def _trials() -> dict[str, object]:
    records = UncertaintyRecords.read("uncertainty")

    def of(family: str, what: str) -> list[float]:
        return [getattr(batch, what) for _, batch in _pairs() if batch.family == family]

    exact = next(row for row in records.errors if not row.truth_error)
    largest = max(row.trials for row in records.errors)
    cases = [[row for row in records.errors if row.case == case] for case in records.slopes]
    most = max(records.rates, key=lambda row: row.megabytes or 0)
    return {
        "counts": _rate(of(COUNTS, "rate")),
        "places": _rate(of(PLACES, "rate")),
        "places_off": f"{max(of(PLACES, 'error')):.0e}",
        "every": _rate(of(EVERY, "rate")),
        "displaced": _rate(of(DISPLACED, "rate")),
        "displaced_off": f"{max(of(DISPLACED, 'error')):.0e}",
        "checked": sum(batch.checked for _, batch in _pairs()),
        "differing": sum(batch.differing for _, batch in _pairs()),
        "truth": f"{exact.truth:.10f}",
        "trials": f"{largest:,}",
        "points": number(100 * max(map(at_one, cases)) / largest**0.5),
        "slopes": " and ".join(f"{power:.2f} ± {off:.2f}" for power, off in records.slopes.values()),
        "covered": span(100 * row.covered for row in records.errors if row.estimates >= 20),
        "memory": f"{most.megabytes:.0f} MB",
    }


def _rate(values: list[float]) -> str:
    return span(values, lambda value: f"{value / 1e6:.2g} million" if value >= 1e6 else number(value))


def _extremes() -> dict[str, object]:
    cases: list[Any] = read("extremes").cases
    locking = [row.error for row in cases if row.extreme.endswith("constant load")]
    return {
        "cases": len(cases),
        "within": sum(row.error < row.bound for row in cases),
        "digits": round(-log10(locking[-1])),
    }


def _ready() -> dict[str, object]:
    trains = read("ready-to-cut").trains
    return {
        "exported": len(trains),
        "ready": sum(not row.obstacles for row in trains),
        "not_ready": ", ".join(f"`{row.train}` ({row.obstacles})" for row in trains if row.obstacles),
        "meshes": sum(row.meshes for row in trains),
        "backlash": f"{min(row.backlash for row in trains if row.backlash is not None):.3f} mm",
        "export_time": span((row.seconds for row in trains), seconds_text),
    }


def draw() -> None:
    """Rates of batches and loops, errors of estimates over trials, errors of extreme cases over time."""
    records = UncertaintyRecords.read("uncertainty")
    with picture("uncertainty-accuracy", 1, 3, figsize=(14.4, 4.8)) as (_, axes):
        for at, (loop, batch) in enumerate(_pairs()):
            axes[0].plot([loop.rate, batch.rate], [at, at], color=HUES[0], lw=1.4)
            axes[0].plot([loop.rate], [at], color=HUES[1], marker="s", ls="", label="" if at else "loop")
            axes[0].plot([batch.rate], [at], color=HUES[0], marker="o", ls="", label="" if at else "batch")
        names = [
            NAMES[batch.family].format(batch.case.replace(", 35 uncertain wheels", _what(batch))).replace(": ", "\n")
            for _, batch in _pairs()
        ]
        axes[0].set_yticks(range(len(names)), names, fontsize=8)
        axes[0].set(xscale="log", xlabel="combinations, or tooth pitches, a second")
        axes[0].invert_yaxis()
        axes[0].set_title("Rates", fontsize=11)
        axes[0].legend(frameon=False, fontsize=8.5)
        labels = "uniform pitch deviations", "normal pitch deviations"
        for at, (case, label) in enumerate(zip(records.slopes, labels, strict=True)):
            rows = [row for row in records.errors if row.case == case]
            trials = [row.trials for row in rows]
            axes[1].plot(trials, [row.rms for row in rows], color=HUES[at], marker="os"[at], ls="", label=label)
            axes[1].plot(trials, [row.expected for row in rows], color=HUES[at], lw=1, ls="--")
        axes[1].set(xscale="log", yscale="log", xlabel="trials", ylabel="rms error of a probability")
        axes[1].set_title("Estimates (dashed: independent trials)", fontsize=11)
        axes[1].legend(frameon=False, fontsize=8.5, loc="upper right")
        units: dict[str, list[tuple[float, float]]] = {}
        for row in read("extremes").cases:
            units.setdefault(row.unit, []).append((row.seconds, row.error))
        error_over_time(axes[2], "Extreme cases against 50 digits", "error", units, MINIMUM)
        for line in axes[2].lines:
            line.set_linestyle("")
        axes[2].legend(frameon=False, fontsize=8.5)
