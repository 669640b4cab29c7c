"""Figures and picture of docs/mesh-accuracy.md."""

from __future__ import annotations

from collections.abc import Sequence
from math import log

from studies.dynamics_study import RESTITUTIONS, DynamicsRecords, PairRecord
from studies.mesh_study import DIRECT, TABULATED
from studies.motion_records import ADAPTIVE, BOUND, FIXED, INDEPENDENT, LAGGED, MotionRecord, MotionRecords
from studies.page import error_over_time, picture
from studies.records import Record, error_text, number, read, seconds_text, span
from studies.shape_study import ShapeRecords, WorkRecord, quickest

from accuracy import Comparison, comparisons

SAMPLED = "sampled, 100000"
MILLION = 1_000_000  # angles to which times of transmission functions are scaled, building included
PAIRS = ("48/96", "3/7", "100000/100000")
TRAINS = (
    "moon-triangular",
    "price-1974, triangular teeth",
    "freeth-2021, pins",
    "freeth-2021, pins and triangular teeth",
)
RIGID, SOFT = "rigid steps", "teeth that yield"
MINIMUM = 1e-16


def figures() -> dict[str, object]:
    """All figures of the page."""
    return {"table": table(), **_mesh(), **_shapes(), **_motion(), **_dynamics(), **_drawn(), **_torques()}


def meshes() -> dict[tuple[str, str, str], Record]:
    """(pair, method, quantity) -> record."""
    return {(row.family, row.method, row.quantity): row for row in read("mesh").rows}


def seconds(rows: dict[tuple[str, str, str], Record], pair: str, method: str) -> float:
    """Building and a million angles."""
    built, evaluated = rows[pair, method, "path"], rows[pair, method, "error"]
    return float(built.seconds + evaluated.seconds / evaluated.angles * MILLION)


def motions() -> dict[tuple[str, str], MotionRecord]:
    """(train, method) -> record."""
    return {(row.family, row.method): row for row in MotionRecords.read("motion").rows}


def pair_rows(restitution: float, method: str) -> list[PairRecord]:
    """The runs of one method on the pair that hits."""
    rows = DynamicsRecords.read("dynamics").pair
    return [row for row in rows if (row.restitution, row.method) == (restitution, method)]


def table() -> str:
    """The comparisons of the page."""
    mesh, motion, shapes = meshes(), motions(), ShapeRecords.read("shapes").work
    found = []
    for pair in PAIRS:
        own, other = mesh[pair, DIRECT, "error"], mesh[pair, SAMPLED, "error"]
        times = seconds(mesh, pair, DIRECT), seconds(mesh, pair, SAMPLED)
        name, errors = f"transmission function, {pair} teeth", [f"{row.error:.1e} pitch" for row in (own, other)]
        found.append(Comparison(name, errors[0], times[0], "100,000 samples", errors[1], times[1]))
    for problem, method in (("stress spur", "Radau"), ("heat bevel", "DOP853"), ("friction spur", "direct search")):
        own_work = next(row for row in shapes if (row.problem, row.method) == (problem, "package"))
        other_work = _best(shapes, problem, method)
        errors = [error_text(row.error) for row in (own_work, other_work)]
        name = f"tooth shape of {SHAPES[problem]}"
        found.append(Comparison(name, errors[0], own_work.seconds, method, errors[1], other_work.seconds))
    for train, method in ((TRAINS[0], ADAPTIVE), (TRAINS[1], ADAPTIVE), (TRAINS[2], ADAPTIVE), (TRAINS[3], FIXED)):
        own_run, other_run = motion[train, "direct"], motion[train, method]
        errors = [f"{row.error:.1e} deg" for row in (own_run, other_run)]
        found.append(
            Comparison(
                f"motion of {train}", errors[0], own_run.seconds or 0, METHODS[method], errors[1], other_run.seconds
            )
        )
    for restitution in RESTITUTIONS:
        rigid, soft = pair_rows(restitution, RIGID)[-1], pair_rows(restitution, SOFT)[-1]
        found.append(
            Comparison(
                f"impacts of a pin, restitution {restitution:g}",
                f"{abs(rigid.impacts):.1e} of the energy",
                rigid.seconds,
                "elastic teeth, 100,000 N m/rad",
                f"{abs(soft.impacts):.1e} of the energy",
                soft.seconds,
            )
        )
    return comparisons(found)


SHAPES = {
    "stress spur": "uniform stress, spur",
    "heat bevel": "uniform temperature, bevel",
    "friction spur": "minimum friction, spur",
}
METHODS = {ADAPTIVE: "time integration, RK45", FIXED: "time integration, RK4"}


def _best(rows: Sequence[WorkRecord], problem: str, method: str) -> WorkRecord:
    """The quickest run to 1e-12, or else the one with the smallest error."""
    own = [row for row in rows if (row.problem, row.method) == (problem, method)]
    return quickest(own, 1e-12) or min(own, key=lambda row: row.error or 1.0)


def _mesh() -> dict[str, object]:
    rows = meshes()
    pairs = [pair for pair, method, what in rows if (method, what) == (DIRECT, "error")]

    def errors(method: str, what: str = "error") -> list[float]:
        return [row.error for (_, name, quantity), row in rows.items() if (name, quantity) == (method, what)]

    def rate(method: str) -> list[float]:
        found = (rows[pair, method, "error"] for pair in pairs)
        return [row.angles / row.seconds / 1e6 for row in found]

    small, large = (
        next(rows[pair, DIRECT, "path"] for pair, *_ in rows if pair.startswith(f"growth {z}/"))
        for z in ("100", "1000000")
    )
    return {
        "direct": f"{max(errors(DIRECT)):.1e}",
        "direct_rate": span(rate(DIRECT)),
        "table_rate": span(rate(TABULATED)),
        "tabulated": f"{max(errors(TABULATED)):.1e}",
        "sampled": span(errors(SAMPLED), lambda value: f"{value:.0e}"),
        "sampled_speed": number(100 * max(errors(SAMPLED, "speed"))),
        "built": span((rows[pair, DIRECT, "path"].seconds for pair in pairs), seconds_text),
        "growth": f"{large.seconds / small.seconds:.1f}",
    }


def _shapes() -> dict[str, object]:
    records = ShapeRecords.read("shapes")
    own = [row for row in records.work if row.method == "package"]
    extreme = [row for row in records.extremes if row.method == "package"]
    near, far = (
        [row.error for row in records.extremes if row.method == f"DOP853 from {start}" and row.error is not None]
        for start in ("1e-04", "1e-02")
    )

    def over(method: str) -> list[float]:
        """Times to 1e-12 over those of the package."""
        return [_best(records.work, row.problem, method).seconds / row.seconds for row in own]

    searched = [row for row in records.work if row.method == "direct search" and row.error is not None]
    return {
        "shapes": f"{max(row.error or 0 for row in own):.1e}",
        "shapes_time": span((row.seconds for row in own), seconds_text),
        "dop853": span(over("DOP853")),
        "radau": span(over("Radau")),
        "searched": span((row.error or 0 for row in searched), lambda value: f"{value:.0e}"),
        "extreme_pairs": len(extreme),
        "extreme_off": f"{max(row.error or 0 for row in extreme):.1e}",
        "extreme_time": seconds_text(max(row.seconds for row in extreme)),
        "started_far": f"{max(far):.0e}",
        "started_near": f"{max(near):.0e}",
    }


def _motion() -> dict[str, object]:
    records, rows = MotionRecords.read("motion"), motions()
    ripple = {train.family: train.outputs for train in records.trains}
    toothed = [train for train in TRAINS if train != TRAINS[2]]

    def of(trains: tuple[str, ...] | list[str], method: str, what: str) -> list[float]:
        return [getattr(rows[train, method], what) for train in trains]

    def share(method: str, what: str, of_what: str, trains: tuple[str, ...] | list[str]) -> str:
        found = ((rows[train, method], ripple[train]) for train in trains)
        return number(max(100 * getattr(row, what) / outputs[row.output][of_what] for row, outputs in found))

    chain = records.growth[-1]
    return {
        "composed": f"{max(of(TRAINS, 'direct', 'error')):.1e}",
        "links": span([rate / 1e6 for rate in of(TRAINS, "direct", "rate")]),
        "adaptive": span(of(toothed, ADAPTIVE, "ratio")),
        "adaptive_off": span(of(toothed, ADAPTIVE, "error"), lambda value: f"{value:.1g}"),
        "fixed": span(of(toothed, FIXED, "ratio")),
        "fixed_off": span(of(toothed, FIXED, "error")),
        "smooth": number(rows[TRAINS[2], ADAPTIVE].ratio or 0),
        "smooth_off": f"{rows[TRAINS[2], ADAPTIVE].error:.0e}",
        "lagged": share(LAGGED, "error", "peak_to_peak", toothed),
        "bound": share(BOUND, "error", "peak_to_peak", TRAINS),
        "rms": share(INDEPENDENT, "rms", "rms", TRAINS),
        "estimates": span(
            (value for method in (BOUND, INDEPENDENT) for value in of(TRAINS, method, "seconds")), seconds_text
        ),
        "memory": f"{max(max(train.peaks.values()) for train in records.trains):.0f} MB",
        "pairs": f"{chain.pairs:,}",
        "pairs_rate": number(chain.rate / 1e6),
    }


def _dynamics() -> dict[str, object]:
    records = DynamicsRecords.read("dynamics")

    def order(restitution: float) -> float:
        first, *_, last = pair_rows(restitution, RIGID)[1:]
        return log(abs(first.impacts / last.impacts)) / log(last.steps / first.steps)

    def apart(restitution: float, what: str) -> float:
        one, other = [row for row in records.train if row.restitution == restitution and not row.stiffness][-2:]
        return float(abs(getattr(one, what) - getattr(other, what)))

    rows = [row for each in RESTITUTIONS for row in pair_rows(each, RIGID)]
    last = pair_rows(0.0, RIGID)[-1]
    return {
        "order": span([order(each) for each in RESTITUTIONS], lambda value: f"{value:.2f}"),
        "steps": f"{last.steps:,}",
        "step_rate": span([2 * row.steps / row.seconds / 1e6 for row in rows if row.steps > 30_000]),
        "events": span((pair_rows(each, "events")[0].seconds for each in RESTITUTIONS), seconds_text),
        "near_steps": " and ".join(
            f"{row.steps:,}"
            for row in records.train
            if row.steps > 50_000 and not row.stiffness and not row.restitution
        ),
        "calm": number(apart(0.0, "moon_position")),
        "calm_share": number(100 * apart(0.0, "apart")),
        "chaos": number(apart(0.3, "moon_position")),
        "chaos_share": number(100 * apart(0.3, "apart")),
    }


def _drawn() -> dict[str, object]:
    rows = read("drawn-teeth").trains
    return {
        "drawn": f"{sum(row.pairs for row in rows):,}",
        "drawn_trains": len(rows),
        "drawn_positions": f"{sum(row.positions for row in rows):,}",
        "drawn_worst": f"{max(row.worst for row in rows):.0e}",
        "drawn_turned": sum(row.turned > 0.01 for row in rows),
    }


def _torques() -> dict[str, object]:
    rows = read("extremes").cases
    return {
        "torques": f"{max(row.error for row in rows if row.name == 'recirculating power'):.0e}",
        "friction": f"{max(row.error for row in rows if 'constant driver torque' in row.extreme):.0e}",
    }


def draw() -> None:
    """Error over time: a transmission function, a tooth shape, the motion of a train, impacts."""
    mesh, motion = meshes(), motions()
    with picture("mesh-accuracy", 2, 2, figsize=(10.4, 8.4)) as (_, axes):
        counts = ("100", "1000", "10000", "100000")
        ways = {
            "geartrain: direct": [DIRECT],
            "geartrain: tabulated": [TABULATED],
            "samples, 100 to 100,000": [f"sampled, {count}" for count in counts],
        }
        points = {
            name: [(seconds(mesh, "48/96", way), mesh["48/96", way, "error"].error) for way in methods]
            for name, methods in ways.items()
        }
        error_over_time(axes[0, 0], "Transmission function, 48/96, 1,000,000 angles", "error (pitches)", points)
        work = ShapeRecords.read("shapes").work
        shape = {
            f"geartrain: {method}" if method == "package" else method: [
                (row.seconds, row.error)
                for row in work
                if (row.problem, row.method) == ("heat bevel", method) and row.error is not None
            ]
            for method in ("package", "collocation", "DOP853", "RK45", "Radau", "BDF")
        }
        error_over_time(axes[0, 1], "Tooth shape of uniform temperature, bevel", "relative error", shape, MINIMUM)
        run = {
            name: [(row.seconds or 0, row.error or 0) for row in (motion[TRAINS[1], way] for way in methods)]
            for name, methods in {
                "geartrain: direct": ("direct",),
                "superposition with lag": (LAGGED,),
                "sum of ranges": (BOUND,),
                "time integration, RK4": (FIXED,),
                "time integration, RK45": (ADAPTIVE,),
            }.items()
        }
        error_over_time(axes[1, 0], f"Motion of {TRAINS[1]}", "maximum error (deg)", run)
        hits = {
            f"{name}, restitution {each:g}": [(row.seconds, abs(row.impacts)) for row in pair_rows(each, way)]
            for name, way in (("geartrain: rigid", RIGID), ("geartrain: elastic", SOFT))
            for each in RESTITUTIONS
        }
        error_over_time(axes[1, 1], "Energy of the impacts of a pin in its slot", "relative error", hits)
