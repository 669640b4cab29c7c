"""Reports on the best sizes of triangular teeth of a pair and of a train."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import degrees
from typing import TYPE_CHECKING

from geartrain.report.document import Document, Section, Table

if TYPE_CHECKING:
    from geartrain.workshop.sizes.best_sizes import BestToothSizes, OutlineAgreement
    from geartrain.workshop.sizes.size_design import SizeLimit, ToothSizes
    from geartrain.workshop.sizes.train_size_search import BestTrainSizes, PairSizes

AIM_WORDS: Mapping[str, str] = {
    "loss": "minimum loss",
    "error": "minimum transmission error",
    "impact": "minimum impact",
    "jam": "maximum margin before a jam",
}
_HEADER = ("sizes", "radii", "window", "half angle (deg)", "loss", "error p-p", "impact", "margin", "phases")
_WORDS = (
    "Radii: R2/R1 divided by z2/z1. Loss: 1 minus the mean efficiency at constant driving torque. Error: transmission "
    "error of the driven wheel, peak to peak. Impact: energy dissipated by impacts in a pitch, divided by the kinetic "
    "energy of the driven side. Margin: change of the centre distance, in modules, at which the teeth jam or lose "
    "contact."
)


def describe_tooth_sizes(found: BestToothSizes) -> Document:
    """Return the report on the best sizes of a pair, with rule-based sizes, outline check and Pareto front."""
    aims = " and ".join(AIM_WORDS[aim] for aim in found.aims)
    z1, z2 = found.teeth
    stops = (
        ""
        if found.stops is None
        else (f" With the given errors, the best design jams or clashes in {100 * found.stops:.3g} % of the trials.")
    )
    best = found.best
    angles = ", ".join(f"{degrees(angle):.6g} deg" for angle in dict.fromkeys(best.half_angles))
    angle = angles if "," not in angles else f"[{angles}]"
    summary = [
        f"The wheel of {found.teeth[found.driver - 1]} teeth drives the wheel of {found.teeth[2 - found.driver]} "
        f"teeth; coefficient of friction {found.friction:g}. Free parameters: {free_text(found.free)}."
        f"{_limits_text(found.limits)}{stops} Designs evaluated: {found.evaluations}.",
        f"Declared as {{form: triangular, half_angle: {angle}, window: {best.window:.6g}, radii: {best.radii:.6g}}}.",
    ]
    sections = [Section("Sizes", (_WORDS,), (Table(_HEADER, list(_rows(found))),)), _agreement(found.outlines)]
    if found.front:
        sections.append(_front(found))
    return Document(f"Triangular teeth {z1}/{z2}: {aims}", summary, sections)


def describe_train_sizes(found: BestTrainSizes) -> Document:
    """Return the report on the best sizes of a train, and of each pair before and after the optimisation."""
    aim = found.aim
    rows = [
        (
            name,
            "does not run" if each is None else figure_text(aim, each),
            *(["-" if each is None else f"{1 - each:.6f}"] if aim == "loss" else ()),
        )
        for name, each in (
            ("as declared", found.before),
            ("optimised separately", found.apart),
            ("optimised together", found.together),
        )
    ]
    header = ("sizes", _TRAIN_FIGURES[aim], *(("efficiency",) if aim == "loss" else ()))
    sections = [Section("Improvement", (), (Table(header, rows),)), _pairs_section(found)]
    if found.untouched:
        reasons: dict[str, list[str]] = {}
        for name, reason in found.untouched.items():
            reasons.setdefault(reason, []).append(name)
        rows = [(reason, ", ".join(names)) for reason, names in reasons.items()]
        sections.append(Section("Unchanged pairs", (), (Table(("reason", "pairs"), rows),)))
    shared = ""
    if "half_angle" in found.free:
        shared = (
            " Pairs with a common wheel have the same half angle. It remains as declared if one of them is not "
            "optimised."
        )
    summary = [
        f"Power enters at '{found.source}'. Free parameters: {free_text(found.free)}.{_limits_text(found.limits)} Each "
        f"pair is optimised separately, then all pairs together for the whole train.{shared}",
    ]
    return Document(f"{found.train}: {AIM_WORDS[aim]} at {found.output}", summary, sections)


_TRAIN_FIGURES = {
    "loss": "loss of the train",
    "error": "error of the output, p-p",
    "impact": "sum of impacts",
    "jam": "minimum margin",
}


def _pairs_section(found: BestTrainSizes) -> Section:
    """Return the report section that lists radii, free parameters and objective of each pair, before and after."""
    sizes = [("radii", "radii"), *((name, name.replace("_", " ")) for name in found.free if name != "radii")]
    header = ["pair", "drives", "teeth"]
    for _, words in sizes:
        header += [f"{words} as declared", "separately", "together"]
    header += [f"{found.aim} as declared", "separately", "together", "outline difference"]
    rows = [_pair_row(pair, [name for name, _ in sizes], found.aim) for pair in found.pairs]
    text = (
        f"{_WORDS} Outline difference: relative difference between the contact of the drawn outlines and the "
        "transmission function."
    )
    return Section("Pairs", (text,), (Table(header, rows, True),))


def _pair_row(pair: PairSizes, sizes: Sequence[str], aim: str) -> tuple[str, ...]:
    designs = (pair.declared, pair.apart, pair.together)
    cells: list[str] = []
    for name in sizes:
        cells += ["-" if each is None else _size(name, each.parameter(name)) for each in designs]
    cells += ["-" if each is None else figure_text(aim, getattr(each, aim)) for each in designs]
    agreed = f"{pair.outlines.difference:.1g}" if pair.outlines.turns else "does not turn"
    return (pair.name, pair.driver, f"{pair.teeth[0]}/{pair.teeth[1]}", *cells, agreed)


def _size(name: str, value: float) -> str:
    return figure_text(name, value) if name == "half_angle" else f"{value:.5f}"


def figure_text(figure: str, value: float) -> str:
    """Return a property of a design with its unit, as text."""
    if figure == "loss":
        return f"{100 * value:.4f} %"
    if figure in ("error", "backlash", "half_angle"):
        return f"{degrees(value):.5g} deg"
    return f"{value:.5g}"


def free_text(free: Mapping[str, tuple[float, float]]) -> str:
    """Return a list of the free parameters with their bounds, as text."""
    parts = []
    for name, (low, high) in free.items():
        unit = (degrees(low), degrees(high), " deg") if name == "half_angle" else (low, high, "")
        parts.append(f"{name} {unit[0]:.6g} to {unit[1]:.6g}{unit[2]}")
    return ", ".join(parts)


def _limits_text(limits: Sequence[SizeLimit]) -> str:
    if not limits:
        return ""
    parts = []
    for limit in limits:
        side = "at least" if limit.figure in limit.MINIMUM else "at most"
        parts.append(f"{limit.figure} {side} {figure_text(limit.figure, limit.bound)}")
    return f" Limits: {', '.join(parts)}."


def _rows(found: BestToothSizes) -> Iterator[Sequence[str]]:
    yield _row("best", found.best)
    for name, each in (("equal depth", found.equal_depth), ("pitch-true", found.pitch_true)):
        yield (name, "does not turn", *("" for _ in _HEADER[2:])) if each is None else _row(name, each)


def _row(name: str, sizes: ToothSizes) -> tuple[str, ...]:
    angles = ", ".join(f"{degrees(angle):.5g}" for angle in dict.fromkeys(sizes.half_angles))
    figures = (figure_text(figure, getattr(sizes, figure)) for figure in ("loss", "error", "impact", "jam"))
    return (name, f"{sizes.radii:.5f}", f"{sizes.window:.4f}", angles, *figures, sizes.phases)


def _agreement(found: OutlineAgreement) -> Section:
    text = (
        "Comparison with the contact of the drawn outlines, which is computed independently of the transmission "
        f"function. The wheels {'turn' if found.turns else 'do not turn'}. The maximum relative difference is "
        f"{found.difference:.2g}."
    )
    rows = [
        (name, *(figure_text(name, each) for each in getattr(found, name)), f"{off:.2g}")
        for name, off in found.differences.items()
    ]
    header = ("figure", "transmission function", "outlines", "relative difference")
    return Section("Contact of the outlines", (text,), (Table(header, rows),))


def _front(found: BestToothSizes) -> Section:
    """Return the report section with at most twelve designs, distributed over the Pareto front."""
    most, front = 12, found.front
    chosen = front if len(front) <= most else [front[round(k * (len(front) - 1) / (most - 1))] for k in range(most)]
    rows = [_row(str(at + 1), each) for at, each in enumerate(chosen)]
    first, second = found.aims
    text = (
        f"Designs that no other evaluated design surpasses in both {first} and {second}. {len(rows)} of {len(front)} "
        "are shown."
    )
    return Section("Pareto front", (text,), (Table(_HEADER, rows),))
