"""Write docs/budgets.md: causes of pointer errors, and the largest error of each Antikythera and historic train.

`python docs/scripts/make_budgets.py` takes about ten minutes on one core. Where a train declares no teeth, triangular
teeth are assumed if such teeth can turn.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from make_outputs import refresh

import geartrain
from geartrain import GearTrain
from geartrain.drawing import render
from geartrain.errors import GearTrainError
from geartrain.workshop import BudgetQuestion, TrainBudget, find_budget
from geartrain.workshop.budget.budget_bars import budget_figure

DOCS = Path(__file__).resolve().parents[1]
PAGE, PICTURE = DOCS / "budgets.md", DOCS / "images" / "budget.svg"
TRAINS = DOCS.parent / "trains"
FORM = "tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}"
FRICTION = "friction: 0.2"
DRAG = "1 N mm"
"""Friction torque of the bearing of a pointer."""
CUTTING = "cutting: {pitch_deviation: {normal: 0.1 deg}}"
REQUESTED = BudgetQuestion(samples=10_000, clearances=(0.3, 0.5, 0.7))
REFERENCE = "freeth-2021"
"""The train of the example and the picture."""


@dataclass(frozen=True)
class TrainRow:
    """Budget of a train in its first state, and the origin of its tooth data."""

    stem: str
    budget: TrainBudget
    teeth: str


def main() -> None:
    """Compute all budgets, write the page and the picture."""
    paths = [path for kind in ("antikythera", "historic") for path in sorted((TRAINS / kind).glob("*.yaml"))]
    rows = {path.stem: find_row(path.stem) for path in paths}
    reference = rows[REFERENCE].budget
    PICTURE.write_bytes(render(budget_figure(reference), ".svg"))
    example = assumed(REFERENCE, [FORM, FRICTION, f"links: {{moon: {{bearing: {DRAG}}}}}", CUTTING]).strip()
    head = HEAD.replace("ASSUMED", example)
    parts = (head, *table(list(rows.values())), REST)
    PAGE.write_text("\n".join(parts), encoding="utf-8")
    refresh(PAGE)


def find_row(stem: str) -> TrainRow:
    """Return the budget of a train, with assumed teeth where it declares none and triangular teeth can turn."""
    train = geartrain.load(stem)
    lines = missing(train)
    if not lines:
        return TrainRow(stem, first(train), "declared")
    try:
        return TrainRow(
            stem, first(geartrain.load(assumed(stem, lines))), "assumed" if FORM in lines else "partly assumed"
        )
    except GearTrainError:
        drag = bearings(train)
        return TrainRow(stem, first(geartrain.load(assumed(stem, drag)) if drag else train), "none")


def first(train: GearTrain) -> TrainBudget:
    """Return the budget of a train in its first state."""
    return find_budget(train, REQUESTED, next(iter(train.states), None))


def assumed(stem: str, lines: list[str]) -> str:
    """Return a declaration that extends a train by assumptions."""
    return "\n".join((f"extends: {stem}", f"name: {stem}-assumed", *lines, ""))


def missing(train: GearTrain) -> list[str]:
    """Return lines for the data that a budget needs and the train does not declare."""
    declared = train.declaration
    own = declared.tooth_form is not None or any(gear.tooth_form for gear in declared.gears)
    lines = [] if own else [FORM]
    lines += [FRICTION] if declared.friction is None and not any(gear.friction for gear in declared.gears) else []
    lines += bearings(train)
    return lines if declared.cutting is not None else [*lines, CUTTING]


def bearings(train: GearTrain) -> list[str]:
    """Return bearing friction for each pointer with a dial (each output if there is no dial) of an unloaded train."""
    declared = train.declaration
    if declared.drive is not None or any(declared.is_loaded(state) for state in train.states or (None,)):
        return []
    outputs = declared.outputs.items()
    dials = any(output.dial is not None for output in declared.outputs.values())
    shown = [output.of or name for name, output in outputs if output.dial is not None or not dials]
    links = ", ".join(f"{link}: {{bearing: {DRAG}}}" for link in dict.fromkeys(shown) if link in declared.links)
    return [f"links: {{{links}}}"] if links else []


# --------------------------------------------------------------------------------------------------------------- tables


def table(rows: list[TrainRow]) -> list[str]:
    """Return the pointer with the largest total error of each train and its two largest causes.

    Trains with equal figures share a line. Trains without a known error are named below.
    """
    lines: dict[str, list[str]] = {}
    for row in rows:
        worst = max(row.budget.pointers, key=lambda pointer: pointer.total)
        causes = [f"{cause.name} {degrees(cause.degrees)}" for cause in worst.ranked if cause.degrees]
        causes += ["-"] * (2 - len(causes))
        cells = (row.teeth, worst.name, degrees(worst.total), *causes[:2]) if worst.total else ()
        lines.setdefault(" | ".join(cells), []).append(f"`{row.stem}`")
    exact = lines.pop("", [])
    head = (
        "| train | tooth data | pointer | total, deg | largest cause | second cause |",
        "|---|---|---|---:|---|---|",
    )
    return [
        *head,
        *(f"| {', '.join(names)} | {cells} |" for cells, names in lines.items()),
        "",
        f"All known contributions are 0 in {', '.join(exact)}.",
        "",
    ]


def degrees(value: float) -> str:
    """Three digits without an exponent."""
    return f"{value:.3g}" if value < 1000 else f"{value:.0f}"


HEAD = """# Budgets of the pointers

How large is the error of a pointer, and which causes contribute to it? `geartrain budget TRAIN` computes the
contributions of five causes separately, in degrees at the pointer and in days, and sorts these contributions by size.
If the data for a cause are not declared, the command reports "not declared"; it never assumes that the contribution is
0.

![Causes of the error of each pointer of freeth-2021](images/budget.svg)

*The eight pointers of `freeth-2021` with the largest errors, with assumed teeth.*

## Run it

The train `freeth-2021` declares no tooth form. To examine the effect of real teeth, extend the train with an assumed
tooth form:

<!-- file: assumed.yaml -->
```yaml
ASSUMED
```

<!-- show: Ranked -->
```console
$ geartrain budget assumed.yaml --of moon
```

`--span` sets the time over which the errors of ratios accumulate, by default one Saros of 6585.3213 days.
`--plot budget.svg` draws the picture above.

## Causes

| cause | meaning | printed value, in degrees |
|---|---|---|
| ratio | the mean speed differs from the target | drift over the span |
| theory | the anomaly that the pins produce differs from that of the Moon or Sun | peak to peak, at the best phase |
| teeth | transmission error of perfectly made teeth | peak to peak |
| lost motion | backlash of the teeth if the crank is turned back | maximum |
| cutting | pointer error due to deviations of teeth and wheels | central 95 % range of the Monte Carlo trials |

**Ratio.** If $w$ is the mean speed of a pointer (turns per unit of time) and $t$ its target, the angle that the pointer
gains during the time $T$ is

$$ 360^\\circ\\,(|w| - |t|)\\,T, \\tag{1} $$

which is computed exactly. A target is a declared period or speed, such as a period that `geartrain periods` lists. If a
pointer has several targets, an observed period takes precedence over a period relation that the makers intended.

**Theory.** If the teeth are perfect, the pins give the pointer an anomaly $d(\\varphi)$ at the phase $\\varphi$. The
equation of centre of the true motion is $C(M) = \\nu - M$, where $M$ is the mean anomaly. The true anomaly $\\nu$
follows from Kepler's equation $M = E - e \\sin E$ and $\\tan(\\nu/2) = \\sqrt{(1 + e)/(1 - e)} \\tan(E/2)$, where the
eccentricity $e$ is 0.0549 for the Moon and 0.0167 for the Sun. The theory error of the pointer is

$$ d(\\varphi) - C(\\varphi + s) - \\text{mean}, \\tag{2} $$

where $s$ is the phase that minimises the mean square of this error, and the mean of the other terms is subtracted. If
no pins drive the pointer, its theory error is the whole equation of centre $C$. If a pointer is read relative to
another moving body, the peak-to-peak errors of both bodies are added. Evection (1.3 degrees) and variation (0.7
degrees) of the Moon are not included.

**Teeth and lost motion.** Let $e_f$ be the error of the pointer if all real teeth and pins are in contact on their
drive flanks. Let $e_b$ be the error if they are in contact on their coast flanks, and $e_0$ the error with the same
pins and perfect teeth ([motion](motion.md), equation (3)). Then

$$ \\text{teeth} = e_f - e_0, \\qquad \\text{lost motion} = |e_b - e_f|. \\tag{3} $$

The backlash between a pin and its slot cannot be declared, so it is reported as unknown.

**Cutting.** In each Monte Carlo trial, the deviations of the teeth and wheels are drawn at random
([cut by hand](cut-by-hand.md)). If $e_c$ is the error of the pointer in a trial at a random position of the crank, the
contribution of cutting is the range from the 2.5th to the 97.5th percentile of

$$ e_c - (e_f - e_0), \\tag{4} $$

and the confidence interval of this range follows from order statistics. If nearly all trials jam, the errors are
computed from the drive flanks as if jamming teeth could pass each other.

The value of a contribution in days is its value in degrees divided by the mean speed of the pointer relative to the
body against which it is read. The total is the sum of the contributions of all causes, which is an upper bound of the
error.

## Largest error of each train

For each shipped train in its first state, the table lists the pointer with the largest total error and the two largest
contributions to this error, in degrees. "Assumed" means that the train declares no teeth, so the budget assumes the
teeth of the example and bearing friction at every pointer. "Partly assumed" means that the train declares teeth, but
some of its other data are assumed. "None" means that triangular teeth cannot be assumed, because triangular wheels with
these tooth counts cannot turn.
"""

REST = """[Could it have worked?](study.md) compares statements of the literature with these causes.

In most rows of the [table of trains](#largest-error-of-each-train), the largest cause is lost motion. To
avoid lost motion, always turn the crank forward.

## Assumptions

- The driven wheels are braked, so that the flanks remain in contact while the crank turns in one direction. Teeth and
  arbors are rigid. Bearings have no clearance unless `fitting` declares it.
- The eccentricities are modern values (NASA's planetary fact sheets). Two thousand years ago, the eccentricity of the
  Sun was 0.0176, so its equation of centre was one twentieth larger.
- The true motions of the planets are not modelled.

This page is written by `python docs/scripts/make_budgets.py`.
"""


if __name__ == "__main__":
    main()
