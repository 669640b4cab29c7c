"""Figures and picture of docs/accuracy.md."""

from __future__ import annotations

from fractions import Fraction
from statistics import median
from typing import Any

from studies.left_out_records import LeftOutRecords
from studies.measurement import LIMIT
from studies.page import error_over_time, picture
from studies.records import Record, error_text, number, read, seconds_text, span
from studies.sphere_records import SphereRecords
from studies.tooth_number_records import (
    CHAIN,
    EVERY,
    FACTORED,
    PAIRS,
    PRINTED,
    PRODUCTS,
    RATIO,
    TRAIN,
    WALKED,
    TeethRecord,
    TeethRecords,
)

from accuracy import Comparison, comparisons

PUBLIC = 44.7  # s: time that the public brute-force tool states for the printed question
QUESTION = "tropical month", 3, "30:100", "15:40"
PI = "pi", 3, "12:100", "12:100"
FLOATS = "floats of the fractions", "floats from the axes"
MINIMUM = 1e-17  # exact answers are drawn here


def figures() -> dict[str, object]:
    """All figures of the page."""
    return {"table": table(), **_speeds(), **_teeth(), **_found_again(), **_sphere()}


def rows() -> dict[tuple[str, int, str], Record]:
    """Speeds: (family, links, method) -> record."""
    return {(row.family, row.links, row.method): row for row in read("kinematics").rows}


def last(name: tuple[str, int, str, str], method: str) -> TeethRecord:
    """The run of a method with the most tries on a question."""
    return [row for row in TeethRecords.read("teeth").rows if (row.question, row.method) == (name, method)][-1]


def table() -> str:
    """The comparisons of the page."""
    speed = rows()
    wanted = (
        ("freeth-2021", 48, "scipy spsolve"),
        ("freeth-2021", 48, "compiled rationals, python-flint"),
        ("chain", 1_001, "compiled rationals, python-flint"),
        ("chain", 100_001, "scipy spsolve"),
        ("epicyclic", 100_000, "scipy spsolve"),
        ("cascade", 100_000, "scipy spsolve"),
        ("tree", 1_000_001, "refined floats"),
        ("grid", 885, "scipy spsolve"),
    )
    found = []
    for family, links, method in wanted:
        own, other = speed[family, links, "exact"], speed[family, links, method]
        name = f"speeds: {family}, {links:,} links"
        found.append(
            Comparison(name, error_text(own.error), own.seconds, method, error_text(other.error), other.seconds)
        )
    for question, way in ((QUESTION, EVERY), (QUESTION, WALKED), (PI, PAIRS)):
        best, best_of_way = last(question, PRODUCTS), last(question, way)
        ratio, stages, wheels, pinions = question
        counts = wheels if wheels == pinions else f"{wheels} over {pinions}"
        found.append(
            Comparison(
                f"tooth numbers: {ratio}, {stages} stages, counts {counts}",
                _miss(best),
                best.seconds,
                "loop over every set" if way == EVERY else way,
                _miss(best_of_way),
                best_of_way.seconds,
            )
        )
    sphere = SphereRecords.read("sphere")
    for family in ("hull", "trapezohedron"):
        row = [each for each in sphere.packings if each.family == family][-1]
        found.append(
            Comparison(
                f"circles: {family}, {row.gears:,} gears",
                f"{row.counted[-1][1]:.1e} rad",
                row.newton,
                f"fixed point, {row.sweeps:,} sweeps",
                f"{row.left:.1e} rad",
                row.swept,
            )
        )
    exact, floats = _closures(sphere, "fractions", 7), _closures(sphere, "floats of the fractions", 7)
    found.append(
        Comparison(
            "closure of a loop on a sphere, 10^7 teeth",
            f"{sum(row.wrong for row in exact)} of {sum(row.loops for row in exact):,} wrong",
            median(row.seconds for row in exact),
            "float sums",
            f"{sum(row.wrong for row in floats)} of {sum(row.loops for row in floats):,} wrong",
            median(row.seconds for row in floats),
        )
    )
    return comparisons(found)


def _miss(row: TeethRecord) -> str:
    return error_text(None if row.error is None else float(Fraction(row.error)))


def _closures(sphere: SphereRecords, method: str, power: int) -> list[Any]:
    return [row for row in sphere.closures if (row.method, row.power) == (method, power)]


def _speeds() -> dict[str, object]:
    speed = rows()
    each = {
        (family, links): row.seconds / links * 1e6
        for (family, links, method), row in speed.items()
        if method == "exact" and row.seconds and links > 500 and family not in ("grid", "drift")
    }
    raw = [row.error for (_, _, method), row in speed.items() if method == "scipy spsolve" and row.error is not None]
    refined = [
        row.error for (_, _, method), row in speed.items() if method == "refined floats" and row.error is not None
    ]
    grid = speed["grid", 9_525, "refined floats"]
    drift, one = speed["drift", 100_001, "exact"], speed["drift", 100_001, "exact, one output"]
    tree = speed["tree", 1_000_001, "exact"]
    return {
        "each": span(each.values()),
        "raw": f"{max(raw):.1e}",
        "refined": error_text(max(refined)),
        "grid": seconds_text(grid.seconds),
        "grid_limit": f"{LIMIT:.0f}",
        "drift": seconds_text(drift.seconds),
        "one": seconds_text(one.seconds),
        "tree": seconds_text(tree.seconds),
        "tree_memory": f"{tree.megabytes:.0f} MB",
    }


def _teeth() -> dict[str, object]:
    records = TeethRecords.read("teeth")
    two, three = ([rows for rows in records.questions if rows[0].stages == stages] for stages in (2, 3))

    def took(questions: list[list[TeethRecord]]) -> str:
        return span((row.seconds for rows in questions for row in rows if row.method == PRODUCTS), seconds_text)

    def factors(method: str) -> list[float]:
        """Errors of a method at three stages over the minimum."""
        found = []
        for rows in three:
            best = next(row.miss for row in rows if row.method == PRODUCTS)
            miss = [row.miss for row in rows if row.method == method][-1]
            found += [float(miss / best)] if best and miss else []
        return found

    ended = [rows for rows in records.questions if rows[-1].method == EVERY and rows[-1].proved]
    agree = sum(rows[-1].miss == next(row.miss for row in rows if row.method == PRODUCTS) for rows in ended)
    grown = {(row.family, row.stages, row.counts): row for row in records.growth}
    printed = next(row for row in records.growth if row.family == PRINTED)
    four, ten = grown[RATIO, 4, 200], grown[CHAIN, 5, 46]
    return {
        "two": took(two),
        "three": took(three),
        "four": seconds_text(four.seconds),
        "four_memory": f"{four.megabytes:.0f} MB",
        "four_sets": f"{four.considered:.0e}",
        "factored": number(median(factors(FACTORED))),
        "walked": number(median(factors(WALKED))),
        "pairs": number(median(factors(PAIRS))),
        "tries": f"{max(row.tries for row in records.rows if row.method == PAIRS):,}",
        "ended": len(ended),
        "agree": agree,
        "public": PUBLIC,
        "printed": seconds_text(printed.seconds),
        "solutions": printed.solutions,
        "ten": seconds_text(ten.seconds),
        "ten_solutions": f"{ten.solutions:,}",
        "train": span(
            next(row.seconds for row in rows if row.method == TRAIN)
            / next(row.seconds for row in rows if row.method == PRODUCTS)
            for rows in three
        ),
    }


def _found_again() -> dict[str, object]:
    records = LeftOutRecords.read("left-out")
    ranks = [row.rank for row in records.whole if row.rank is not None]
    ranked = [row for row in records.rows if row.first is not None]
    seen = [row.told for row in records.rows if row.told is not None]
    numbers = {
        "questions": records.possible,
        "trains": len({tree.train for tree in records.trees}),
        "parts": len(records.trees),
        "whole": len(records.whole),
        "listed": len(ranks),
        "reached": sum(row.is_found for row in records.rows),
        "missed": len(records.lost),
        "ranked": len(ranked),
        "first": sum(row.first == 1 for row in ranked),
        "only": sum(rank[1] == 1 for rank in ranks),
        "seen": len(seen),
        "seen_first": sum(rank[0] == 1 for rank in seen),
        "seen_only": sum(rank[1] == 1 for rank in seen),
    }
    times = [row.seconds for row in records.whole if row.seconds is not None]
    return {**{name: f"{value:,}" for name, value in numbers.items()}, "search": seconds_text(median(times))}


def _sphere() -> dict[str, object]:
    sphere = SphereRecords.read("sphere")
    steps = [len(row.counted) for row in sphere.packings]
    small = [row.ratio for row in sphere.packings if row.gears < 20]
    large = [row.ratio for row in sphere.packings if row.gears > 900]
    floats, axes = ([row for row in sphere.closures if row.method == method] for method in FLOATS)
    return {
        "steps": span(steps),
        "fixed_small": span(small),
        "fixed_large": span(large),
        "judged": f"{max(row.judged for row in sphere.packings):.1e}",
        "overlaps": sum(row.overlaps for row in sphere.packings),
        "fits": len(sphere.fits),
        "fitted": sum(row.exact for row in sphere.fits),
        "loops": f"{sum(row.loops for row in sphere.closures if row.method == 'fractions'):,}",
        "loops_wrong": sum(row.wrong for row in sphere.closures if row.method == "fractions"),
        "floats_wrong": min(row.power for row in floats if row.wrong),
        "axes_wrong": min(row.power for row in axes if row.wrong),
    }


def draw() -> None:
    """Error over time: speeds of two families, tooth numbers, circles."""
    speed, names = rows(), {"exact": "exact", "scipy spsolve": "spsolve", "refined floats": "refined floats"}
    with picture("accuracy", 1, 3, figsize=(14.4, 4.8)) as (_, axes):
        series = {}
        for family in ("chain", "epicyclic"):
            for method, name in names.items():
                found = [row for key, row in speed.items() if (key[0], key[2]) == (family, method)]
                series[f"{family}: {name}"] = [(row.seconds, row.error) for row in found if row.error is not None]
        label = f"maximum relative error (0 drawn at {MINIMUM:g})"
        error_over_time(axes[0], "Speeds, 100 to 100,000 links", label, series, MINIMUM)
        ways = {
            way: [
                (row.seconds, float(Fraction(row.error)))
                for row in TeethRecords.read("teeth").rows
                if (row.question, row.method) == (QUESTION, way) and row.error is not None
            ]
            for way in (PRODUCTS, TRAIN, EVERY, PAIRS, WALKED, FACTORED)
        }
        error_over_time(axes[1], "Tooth numbers for 13.368267, three stages", "relative error of the ratio", ways)
        circles = {}
        for row in SphereRecords.read("sphere").packings:
            if row.gears < 900 or row.family == "zonohedron":
                continue
            passed, steps = 0.0, []
            for seconds, residual in row.counted:
                passed += seconds
                steps.append((passed, residual))
            circles[f"{row.family}: Newton"] = steps
            circles[f"{row.family}: fixed point"] = [
                (row.swept * sweeps / row.sweeps, residual) for sweeps, residual in row.trace
            ]
        error_over_time(axes[2], "Circles of about 1,000 gears", "residual (rad)", circles)
