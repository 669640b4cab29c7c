"""Write docs/study.md: could the Antikythera mechanism have worked? Every number in its text comes from its data file.

`python docs/scripts/make_study.py --measure` computes docs/data/study.json again, on two processes, and continues an
interrupted run. `--trials 32` is for a try; the page has 128.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator, Mapping
from concurrent.futures import ProcessPoolExecutor, as_completed
from contextlib import suppress
from math import exp
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from make_budgets import bearings
from studies.page import DOCS, with_numbers

import geartrain
from geartrain import workshop
from geartrain.drawing import render, style
from geartrain.drawing.style import BLACK, BLUE, DOT, GREY, RED, Row
from geartrain.numerics import ProbabilityEstimate
from geartrain.workshop.feasibility.feasibility_plan import FeasibilityPlan

WRITTEN, TEMPLATE = DOCS / "study.md", Path(__file__).with_name("study.md")
HANDLE, MOST, ENOUGH = 30, 300, 48
"""Radius of the handle [mm], largest torque of the hand [N mm], and trials from which figures are not preliminary."""
DATA = DOCS / "data" / "study.json"
MOON, REFERENCE = "moon-triangular", "freeth-2021"
ACCURACIES = (0.02, 0.05, 0.1, 0.15, 0.2, 0.3)
"""Standard deviations of the pitch deviation [deg]."""
EDMUNDS = 0.1
"""Smallest deviation of teeth that is quoted [deg]."""
COARSE = 0.15
"""Accuracy at which most trains of the Moon jam [deg]."""
WINDOWS = (0.3, 0.5, 0.7)
_KNOWN = yaml.safe_load(Path(__file__).with_name("study.yaml").read_text(encoding="utf-8"))
FORM, ASSUMED, SIZES = _KNOWN["form"], _KNOWN["assumed"], _KNOWN["moon"]
CHANGES = {name: (old, new) for name, (old, new) in _KNOWN["changes"].items()}
"""Changes of one assumption of the Moon's train: a text, and the text that replaces it."""


def declared(stem: str, change: tuple[str, str] = ("", "")) -> str:
    """Declaration of a train with all assumptions, one of which is changed."""
    train = geartrain.load(stem)
    own = train.declaration.tooth_form is not None and stem != MOON
    links = SIZES if stem == MOON else "\n".join(bearings(train))
    text = "\n".join((f"extends: {stem}", f"name: {stem}-study", "" if own else FORM, links, ASSUMED))
    return text + best(stem) if change[1] == "BEST" else text.replace(*change) if change[0] else text


def best(stem: str) -> str:
    """Tooth forms of all pairs with the radii of minimum loss: docs/best-radii.md, equation (1)."""
    train, lines = geartrain.load(stem).declaration, ["gears:"]
    for gear in train.gears:
        z1, z2 = (train.wheels[name][1].count or 0 for name in gear.pair)
        ratio = exp(-1.59 * (1 / z1 - 1 / z2) - 0.75 * (1 / z1 + 1 / z2) ** 2)
        form = f"{{form: triangular, half_angle: 30 deg, window: 0.5, radii: {ratio:.5f}}}"
        lines.append(f"  - {{id: {gear.name}, tooth_form: {form}}}")
    return "\n".join([*lines, ""])


# -------------------------------------------------------------------------------------------------------------- studies


def plan(stem: str, change: tuple[str, str] = ("", ""), accuracy: float = EDMUNDS) -> FeasibilityPlan:
    """Plan of a train with all assumptions, one of which is changed."""
    text = declared(stem, change).replace(f"normal: {EDMUNDS} deg", f"normal: {accuracy} deg")
    train = geartrain.load(text)
    return workshop.find_feasibility_plan(train, state=next(iter(train.states), None), per_part=change[1] == "PER_PART")


def curve(cutting: Any, window: float | None, trials: int) -> tuple[list[list[int]], Any]:
    """Number of jams and of trials at each accuracy, and the first case with a jam."""
    cases = workshop.jamming_map(cutting, [window], [each / EDMUNDS for each in ACCURACIES], trials)
    jams = [case.events["jam"] for case in cases]
    first = next((case for case in cases if case.events["jam"].count), None)
    return [[each.count, each.of] for each in jams], first


def study_train(stem: str, trials: int) -> dict[str, Any]:
    """Outcomes of a train with the declared or assumed teeth, and jams at other clearances and accuracies."""
    own = plan(stem)
    curves = {f"declared {window}": curve(own.cutting, window, trials) for window in WINDOWS}
    # filing takes most of the time: an eighth of the trials
    curves["filed"] = curve(plan(stem, CHANGES["filing, strokes of 1 %"]).cutting, None, max(trials // 8, 8))
    with suppress(geartrain.GearTrainError):  # radii that leave a pair without a clearance window
        curves["best"] = curve(plan(stem, ("", "BEST")).cutting, None, trials)
    first = curves["declared 0.5"][1]
    worst = "-" if first is None else max(first.pairs, key=lambda pair: first.pairs[pair]["jam"].count)
    jams = {name: each for name, (each, _) in curves.items()}
    return {"pairs": len(own.cutting.pairs), "curves": jams, "worst": worst, **outcomes(own, trials)}


def outcomes(own: FeasibilityPlan, trials: int) -> dict[str, Any]:
    """Outcomes, crank torque [N mm], breakage if forced, and the standard deviation of the largest pointer error."""
    found = workshop.run_feasibility(own, trials)
    torque, forced = found.crank_torque, found.forced
    return {
        "outcomes": {name: [each.count, each.of] for name, each in found.outcomes.items()},
        "torque": None if torque is None else [1e3 * each.value for each in torque.values()],
        "forced": None if forced is None else [[each.count, each.of] for each in forced.values()],
        "rough": [found.rough.count, found.rough.of],
    }


def study_change(name: str, trials: int) -> dict[str, Any]:
    """Outcomes of the Moon's train with one other assumption at an accuracy at which most trains jam, and all jams."""
    change = CHANGES.get(name, ("", ""))
    jams, _ = curve(plan(MOON, change).cutting, None, trials)
    return {"curve": jams, **outcomes(plan(MOON, change, COARSE), trials)}


def study_claims(_: str, trials: int) -> dict[str, Any]:
    """Figures of the reference train for published statements."""
    teeth = "friction: 0.2\ncutting: {pitch_deviation: {normal: 0.1 deg}}\n"
    found: dict[str, Any] = {}
    for prefix, form in (("", FORM + "\n"), ("best_", best(REFERENCE))):
        train = geartrain.load(f"extends: {REFERENCE}\n{teeth}{form}")
        question = workshop.BudgetQuestion(outputs=("moon", "saros", "mars"), samples=5_000, trials=trials)
        for pointer in workshop.find_budget(train, question, next(iter(train.states), None)).pointers:
            causes = {f"{prefix}{pointer.name}_{cause.name}": cause.degrees for cause in pointer.causes}
            found |= {name.replace(" ", "_"): value for name, value in causes.items()}
    for size in ("0.1", "0.3"):
        errors = workshop.read_error_overrides([f"pitch_deviation={size} deg"])
        moon = workshop.run_trials(
            workshop.find_trial_plan(geartrain.load("freeth-2021-cut"), errors, ["moon"]), trials
        ).pointers[0]
        found[f"moon_{size.replace('.', '_')}"] = float(np.degrees(np.abs(moon.all).max()))
    eccentric = workshop.read_error_overrides(["pitch_deviation=0 %", "eccentricity=2 %"])
    only = workshop.find_trial_plan(geartrain.load(declared(MOON)), eccentric)
    for case in workshop.jamming_map(only, [None], (1.0, 4.0), trials):
        found[f"eccentric_{2 * case.scale:.0f}"] = [case.events["jam"].count, case.events["jam"].of]
    return found


def tasks() -> Iterator[tuple[str, Any, str]]:
    yield "claims", study_claims, ""
    yield from ((f"change {name}", study_change, name) for name in ("none", *CHANGES))
    yield from ((f"train {', '.join(stems)}", study_train, stems[0]) for stems in variants())


def variants() -> list[list[str]]:
    """Names of the shipped reconstructions; those whose pairs have the same tooth counts are in one list."""
    found: dict[tuple[Any, ...], list[str]] = {}
    for path in sorted((DOCS.parent / "trains" / "antikythera").glob("*.yaml")):
        train = geartrain.load(path.stem).declaration
        counts = ([str(train.wheels[name][1].count) for name in gear.pair] for gear in train.gears)
        found.setdefault(tuple(sorted(map(tuple, counts))), []).append(path.stem)
    return [sorted(stems, key=len) for stems in found.values()]  # the simplest declaration first


def measure(trials: int) -> None:
    """Compute all records that the data file does not have with this number of trials."""
    kept = json.loads(DATA.read_text(encoding="utf-8")) if DATA.exists() else {}
    kept = kept if kept.get("trials") == trials else {"trials": trials}
    with ProcessPoolExecutor(2) as pool:
        runs = {pool.submit(work, each, trials): name for name, *each in tasks() if name not in kept}
        for run in as_completed(runs):
            kept[runs[run]] = run.result()
            lines = ",\n".join(f"{json.dumps(name)}: {json.dumps(kept[name])}" for name in sorted(kept))
            DATA.write_text("{\n" + lines + "\n}\n", encoding="utf-8")
            print(runs[run], flush=True)


def work(each: Any, trials: int) -> Any:
    study, name = each
    try:
        return study(name, trials)
    except geartrain.GearTrainError as error:
        return {"why": error.problems[0].what}


# -------------------------------------------------------------------------------------------------------------- figures


def step(curve: list[list[int]]) -> float | None:
    """Accuracy at which half of the trains jam, by linear interpolation [deg]; None outside the curve."""
    jams = [count / max(of, 1) for count, of in curve]
    if jams[0] >= 0.5 or jams[-1] < 0.5:
        return None
    at = next(k for k, jam in enumerate(jams) if jam >= 0.5)
    part = (0.5 - jams[at - 1]) / (jams[at] - jams[at - 1])
    return ACCURACIES[at - 1] + part * (ACCURACIES[at] - ACCURACIES[at - 1])


def draw(name: str, figure: Any) -> None:
    (DOCS / "images" / f"study-{name}.svg").write_bytes(render(figure, ".svg"))


def draw_curves(curves: Mapping[str, list[list[int]]]) -> None:
    figure, (axes,) = style.curve_panels([3.8])
    blue = zip((f"declared {window}" for window in WINDOWS), (":", "-", "--"), strict=True)
    looks = {name: (BLUE, dashes) for name, dashes in blue} | {"best": (BLACK, "-"), "filed": (RED, "-")}
    named = {"best": "radii of minimum loss, at 0.5", "filed": "filed to fit, at 0.5"}
    for name in (name for name in looks if name in curves):
        turns = [ProbabilityEstimate(of - count, of) for count, of in curves[name]]
        low, high = np.array([each.interval for each in turns]).T
        color, dashes = looks[name]
        axes.fill_between(ACCURACIES, low, high, color=color, alpha=0.12, linewidth=0)
        label = named.get(name, name.replace("declared", "clearance at") + " of the window")
        axes.plot(ACCURACIES, [each.value for each in turns], color=color, linestyle=dashes, label=label)
    axes.axvline(EDMUNDS, color=GREY, linewidth=0.8)
    style.name_axes(axes, "standard deviation of the pitches (deg); line: 0.1 deg", "probability of no jam")
    style.legend_below(figure, 2, axes.get_legend_handles_labels()[0])
    draw("curves", figure)


def draw_steps(rows: Mapping[str, Any]) -> None:
    looks = {"declared shape": DOT, "minimum loss": {**DOT, "color": BLUE}, "filed to fit": {**DOT, "color": RED}}
    keys = dict(zip(looks, ("declared 0.5", "best", "filed"), strict=True))
    shown = []
    for name, row in rows.items():
        places = {key: step(curve) for key, curve in row["curves"].items()}
        marks = {mark: place for mark, key in keys.items() if (place := places.get(key)) is not None}
        ends = places["declared 0.3"] or ACCURACIES[0], places["declared 0.7"] or ACCURACIES[-1]
        shown.append(Row(name, marks, [ends]))
    label = "accuracy at which half of the trains turn (deg)\nline: clearance at 0.3 to 0.7 of the window"
    draw("steps", style.interval_chart({label: shown}, looks))


def draw_torques(rows: Mapping[str, Any]) -> None:
    shown = [Row(n, {"m": t[1]}, [(t[0], t[2])], [f"{t[1]:.3g}"]) for n, row in rows.items() if (t := row["torque"])]
    draw(
        "torques",
        style.interval_chart({"crank torque (N mm): median and 90 %": shown}, {"m": DOT}, ("median",), log=True),
    )


# ---------------------------------------------------------------------------------------------------------------- page


def percent(pair: list[int]) -> str:
    low, high = ProbabilityEstimate(*pair).interval
    return f"{100 * pair[0] / pair[1]:.0f} % ({100 * low:.0f} to {100 * high:.0f})" if pair[1] else "-"


def angle(value: float | None) -> str:
    return "-" if value is None else f"{value:.2g}"


def half(curve: list[list[int]]) -> str:
    """Accuracy at which half of the trains turn, as text [deg]."""
    place = step(curve)
    outside = f"below {ACCURACIES[0]}" if curve[0][0] * 2 >= curve[0][1] else f"over {ACCURACIES[-1]}"
    return outside if place is None else f"{place:.2g}"


def spread(torque: list[float] | None) -> str:
    """Median and 90 % of the crank torque, as text [N mm]."""
    return "-" if torque is None else "{1:.3g} ({0:.3g} to {2:.3g})".format(*torque)


def train_table(rows: Mapping[str, Any]) -> str:
    head = "| train | pairs | half turn, deg | best radii | filed | jams first | no jam at 0.1 deg | crank, N mm |"
    lines = [head, "|---|---:|---:|---:|---:|---|---|---|"]
    for names, row in rows.items():
        curves = row["curves"]
        low, middle, high = (half(curves[f"declared {window}"]) for window in WINDOWS)
        shapes = [half(curves[key]) if key in curves else "-" for key in ("best", "filed")]
        count, of = curves["declared 0.5"][ACCURACIES.index(EDMUNDS)]
        cells = [
            f"{middle} ({low} to {high})",
            *shapes,
            f"`{row['worst']}`" if row["worst"] else "-",
            percent([of - count, of]),
        ]
        named = "`, `".join(names.split(", "))
        lines.append(f"| `{named}` | {row['pairs']} | {' | '.join(cells)} | {spread(row['torque'])} |")
    return "\n".join(lines)


def sensitivity(data: Mapping[str, Any]) -> str:
    lines = ["| change of the Moon's train | half turn, deg | crank, N mm | breaks if forced |", "|---|---:|---|---|"]
    for name in ("none", *CHANGES):
        row = data[f"change {name}"]
        forced = " to ".join(percent(each).split(" (")[0] for each in row["forced"])
        lines.append(f"| {name} | {half(row['curve'])} | {spread(row['torque'])} | {forced} |")
    return "\n".join(lines)


def page(data: Mapping[str, Any]) -> str:
    """The page."""
    text = TEMPLATE.read_text(encoding="utf-8")
    for name, table in (("TRAINS", train_table(trains(data))), ("SENSITIVITY", sensitivity(data))):
        text = text.replace(name, table)
    return with_numbers(text, numbers(data, trains(data))) + "\n"


def trains(data: Mapping[str, Any]) -> dict[str, Any]:
    """Records of reconstructions whose teeth can turn, by their names."""
    found = {name.removeprefix("train "): row for name, row in data.items() if name.startswith("train ")}
    return {name: row for name, row in found.items() if "why" not in row}


def main() -> None:
    """Write the page and its pictures from the data file."""
    asked = argparse.ArgumentParser(description="Write docs/study.md from docs/data/study.json.")
    asked.add_argument("--measure", action="store_true", help="compute the data file first")
    asked.add_argument("--trials", type=int, default=128, help="number of trials")
    given, _ = asked.parse_known_args()
    if given.measure:
        measure(given.trials)
    data = json.loads(DATA.read_text(encoding="utf-8"))
    rows = {name.split(",")[0]: row for name, row in trains(data).items()}
    draw_curves(rows[MOON]["curves"])
    draw_steps(rows)
    draw_torques(rows)
    WRITTEN.write_text(page(data), encoding="utf-8")


def numbers(data: Mapping[str, Any], rows: Mapping[str, Any]) -> dict[str, str]:
    """Numbers of the text."""
    moon, whole = (next(row for name, row in rows.items() if stem in name) for stem in (MOON, REFERENCE))
    steps = sorted((row["curves"]["declared 0.5"] for row in rows.values()), key=lambda each: step(each) or 1.0)
    coarse = data["change none"]
    found = {key: angle(value) for key, value in data["claims"].items() if not isinstance(value, list)}
    found |= {key: percent(value) for key, value in data["claims"].items() if isinstance(value, list)}
    for name, row in (("moon", moon), ("whole", whole)):
        curves, torque = row["curves"], row["torque"]
        places = dict(zip(("low", "step", "high"), (f"declared {window}" for window in WINDOWS), strict=True))
        places |= {"best": "best", "filed": "filed"}
        found |= {f"{name}_{key}": half(curves[own]) if own in curves else "-" for key, own in places.items()}
        jams = dict(zip(ACCURACIES, curves["declared 0.5"], strict=True))
        found |= {f"{name}_turns_{100 * at:.0f}": percent([n - k, n]) for at, (k, n) in jams.items()}
        found |= {f"{name}_torque": f"{torque[1]:.3g}", f"{name}_force": f"{torque[1] / HANDLE:.2g}"}
        found[f"{name}_drag"] = f"{MOST / torque[1]:.2g}"
    return found | {
        "stepping": half(data["change stepping dividers, as sd of a step"]["curve"]),
        "plain_median": f"{coarse['torque'][1]:.3g}",
        "pivot_median": f"{data['change pivots, friction 0.1 to 0.2']['torque'][1]:.3g}",
        "trials": str(data["trials"]),
        "preliminary": "" if data["trials"] >= ENOUGH else " (preliminary: the intervals are wide)",
        "trains": str(sum(name.count(",") + 1 for name in rows)),
        "step_first": half(steps[0]),
        "step_last": half(steps[-1]),
        "broken": str(sum(row["outcomes"]["breaks"][0] for row in (*rows.values(), coarse))),
        "forced": percent(coarse["forced"][0]),
        "wedge": percent(coarse["forced"][1]),
        "low_friction": "{0:.3g} to {2:.3g}".format(*data["change friction of 0.06 to 0.2"]["torque"]),
        "friction": "{0:.3g} to {2:.3g}".format(*coarse["torque"]),
    }


if __name__ == "__main__":
    main()
