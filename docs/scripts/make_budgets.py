"""Write docs/budgets.md and docs/budgets/: the budget of every shipped Antikythera and historic train.

`python docs/scripts/make_budgets.py` takes some ten minutes of one core. Trains that declare no teeth are told with
assumed ones, where such teeth can turn; the assumption stands on the page, and as a declaration that can be run.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from textwrap import fill

import geartrain
from geartrain import GearTrain
from geartrain.drawing import render
from geartrain.errors import GearTrainError
from geartrain.report import to_markdown
from geartrain.workshop import BudgetQuestion, PointerBudget, TrainBudget, budget_figure, describe_budget, find_budget

DOCS = Path(__file__).resolve().parents[1]
FOLDER = DOCS / "budgets"
TRAINS = DOCS.parent / "trains"
FORM = "tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}"
PITCH_TRUE = "tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5, radii: pitch_true}"
FRICTION = "friction: 0.2"
DRAG = "1 N mm"
"""Friction torque of the bearing of a pointer."""
CUTTING = "cutting: {pitch_deviation: {normal: 0.1 deg}}"
REQUESTED = BudgetQuestion(samples=10_000, clearances=(0.3, 0.5, 0.7))
WHOLE = "freeth-2021"
"""The reconstruction by which the literature is judged."""


@dataclass(frozen=True)
class Told:
    """A train's budgets, one for each state, with the declaration that was assumed or why none could be."""

    stem: str
    title: str
    budgets: tuple[TrainBudget, ...]
    assumed: str = ""
    refused: str = ""


def main() -> None:
    """Work out every budget, write the pages and pictures."""
    FOLDER.mkdir(exist_ok=True)
    for old in FOLDER.iterdir():
        old.unlink()
    told = {}
    for kind in ("antikythera", "historic"):
        told[kind] = [_tell(path.stem) for path in sorted((TRAINS / kind).glob("*.yaml"))]
        for each in told[kind]:
            _write(each)
    index = "\n".join([HEAD, *_literature(told["antikythera"]), *_list(told), REST])
    (DOCS / "budgets.md").write_text(index, encoding="utf-8")
    print(f"wrote docs/budgets.md and {sum(map(len, told.values()))} pages in docs/budgets")


def _tell(stem: str) -> Told:
    train = geartrain.load(stem)
    lines = _missing(train)
    title = train.declaration.title or stem
    if not lines:
        return Told(stem, title, _budgets(train))
    text = _assumed(stem, lines)
    try:
        return Told(stem, title, _budgets(geartrain.load(text)), text)
    except GearTrainError as error:
        refused = f"{error.problems[0].what}: {error.problems[0].why}"
    drag = _drag(train)
    text = _assumed(stem, drag) if drag else ""
    return Told(stem, title, _budgets(geartrain.load(text) if drag else train), text, refused)


def _assumed(stem: str, lines: list[str]) -> str:
    """A train with what is assumed of it, as a declaration."""
    return "\n".join((f"extends: {stem}", f"name: {stem}-assumed", *lines, ""))


def _missing(train: GearTrain) -> list[str]:
    """What a budget needs and the train leaves open: teeth, friction, drag of pointers, errors of cutting."""
    declared = train.declaration
    own = declared.tooth_form is not None or any(gear.tooth_form for gear in declared.gears)
    lines = [] if own else [FORM]
    lines += [FRICTION] if declared.friction is None and not any(gear.friction for gear in declared.gears) else []
    lines += _drag(train)
    return lines if declared.cutting is not None else [*lines, CUTTING]


def _drag(train: GearTrain) -> list[str]:
    """A bearing that rubs under each pointer of a dial, where nothing says what loads the crank.

    Under each output of a train that has no dial.
    """
    declared = train.declaration
    if declared.drive is not None or any(declared.is_loaded(state) for state in train.states or (None,)):
        return []
    outputs = declared.outputs.items()
    dials = any(output.dial is not None for output in declared.outputs.values())
    shown = [output.of or name for name, output in outputs if output.dial is not None or not dials]
    links = ", ".join(f"{link}: {{bearing: {DRAG}}}" for link in dict.fromkeys(shown) if link in declared.links)
    return [f"links: {{{links}}}"] if links else []


def _budgets(train: GearTrain) -> tuple[TrainBudget, ...]:
    return tuple(find_budget(train, REQUESTED, state) for state in train.states or (None,))


# --------------------------------------------------------------------------------------------------------------- pages


def _write(each: Told) -> None:
    lines = [f"# Budget: {each.stem}", "", f"{each.title}. Written by `python docs/scripts/make_budgets.py`; ", ""]
    lines[2] += "see [what the figures are, and what they rest on](../budgets.md)."
    if each.assumed:
        lines += ["Assumed, where the train declares nothing, and no part of the reconstruction:", ""]
        lines += ["```yaml", each.assumed.strip(), "```", ""]
    if each.refused:
        lines += [f"Triangular teeth cannot be assumed for this train. {each.refused}.", ""]
    if not each.assumed:
        lines += ["As declared; nothing is assumed.", ""]
    for at, budget in enumerate(each.budgets):
        picture = _picture(each.stem, at, budget)
        lines += [f"![What each pointer's error comes from]({picture})", ""] if picture else []
        text = to_markdown([describe_budget(budget)])
        lines += [*text.replace("\n## ", "\n### ").replace("# Error budget", "## Error budget", 1).splitlines(), ""]
    (FOLDER / f"{each.stem}.md").write_text("\n".join(lines).rstrip() + "\n", encoding="utf-8")


def _picture(stem: str, at: int, budget: TrainBudget) -> str:
    """The name of a picture; none where nothing is known to draw."""
    try:
        figure = budget_figure(budget)
    except GearTrainError:
        return ""
    name = f"{stem}{at or ''}.png"
    (FOLDER / name).write_bytes(render(figure, ".png", 80.0))
    return name


def _list(told: dict[str, list[Told]]) -> list[str]:
    lines = ["## The trains", "", "By train the pointer that errs most, and its causes in degrees.", ""]
    for kind, all_of in told.items():
        lines += [f"### {kind.capitalize()}", "", "| train | teeth and cutting | pointers | errs most | causes |"]
        lines += ["|---|---|---|---|---|"]
        for each in all_of:
            budget = each.budgets[0]
            worst = max(budget.pointers, key=lambda pointer: pointer.total)
            assumed = "assumed" if FORM in each.assumed else "assumed in part"
            how = "triangular ones cannot turn" if each.refused else assumed if each.assumed else "declared"
            causes = ", ".join(f"{cause.name} {_listed(cause.degrees)}" for cause in worst.ranked if cause.degrees)
            row = (f"[{each.stem}](budgets/{each.stem}.md)", how, str(len(budget.pointers)), worst.name, causes or "-")
            lines.append(f"| {' | '.join(row)} |")
        lines.append("")
    return lines


def _listed(degrees: float) -> str:
    return f"{degrees:.3g}" if degrees < 1000 else f"{degrees:.0f}"


# ---------------------------------------------------------------------------------------------------------- literature


def _literature(antikythera: list[Told]) -> list[str]:
    """Which conclusions stand, with the figures of one whole reconstruction."""
    budget = next(each for each in antikythera if each.stem == WHOLE).budgets[0]
    true = _pitch_true()
    moon, other = budget["moon"], true["moon"]
    within = moon["cutting"].interval
    small = [each for each in budget.pointers if (each["teeth"].degrees or 0.0) < 1]
    count = len([each for each in budget.pointers if each["teeth"].degrees is not None])
    jam = {case.clearance: case.events["jam"].value for case in budget.jams}
    low, high = min(jam.values()), max(jam.values())
    planets = [budget[name] for name in ("mars", "jupiter", "saturn")]
    words = {
        "teeth": _size(moon, "teeth"),
        "rms": f"{moon['teeth'].rms:.2g}",
        "theory": _size(moon, "theory"),
        "times": f"{_of(moon, 'teeth') / _of(moon, 'theory'):.0f}",
        "ratio": _size(moon, "ratio"),
        "drifts": f"{_of(moon, 'teeth') / _of(moon, 'ratio'):.0f}",
        "cutting": _size(moon, "cutting"),
        "within": "not known" if within is None else f"{within[0]:.2g} to {within[1]:.2g}",
        "lost": _size(moon, "lost motion"),
        "true": _size(other, "teeth"),
        "small": len(small),
        "count": count,
        "saros": _size(budget["saros"], "teeth"),
        "saros_cut": _size(budget["saros"], "cutting"),
        "metonic": _size(budget["metonic"], "teeth"),
        "metonic_cut": _size(budget["metonic"], "cutting"),
        "jams": f"{100 * low:.0f}" if low == high else f"{100 * low:.0f} to {100 * high:.0f}",
        "windows": ", ".join(f"{share:g}" for share in jam),
        "mars_teeth": _size(budget["mars"], "teeth"),
        "mars_cutting": _size(budget["mars"], "cutting"),
        "planets": ", ".join(
            f"of {each.name.capitalize()} {_size(each, 'teeth')} and {_size(each, 'cutting')}" for each in planets
        ),
        "saros_lost": _size(budget["saros"], "lost motion"),
    }
    return [_filled(LITERATURE.format(**words)), ""]


def _filled(text: str) -> str:
    """Paragraphs in lines of a page's width, whatever figures they have got."""
    return "\n\n".join(
        fill(" ".join(part.split()), 118, break_long_words=False, break_on_hyphens=False) for part in text.split("\n\n")
    )


def _pitch_true() -> TrainBudget:
    text = f"extends: {WHOLE}\nname: {WHOLE}-pitch-true\n{PITCH_TRUE}\n"
    requested = BudgetQuestion(outputs=("moon",), samples=REQUESTED.samples)
    return find_budget(geartrain.load(text), requested)


def _of(pointer: PointerBudget, cause: str) -> float:
    return pointer[cause].degrees or 0.0  # type: ignore[index]


def _size(pointer: PointerBudget, cause: str) -> str:
    """`6.07 degrees (0.46 days)`."""
    found = pointer[cause]  # type: ignore[index]
    if found.degrees is None:
        return "not known"
    days = "" if found.days is None else f" ({_digits(found.days)} days)"
    return f"{_digits(found.degrees)} degrees{days}"


def _digits(value: float) -> str:
    """Two digits, a last 0 too."""
    return f"{value:#.2g}".removesuffix(".") if value < 100 else f"{value:.0f}"


HEAD = """# Budgets of the pointers

What does the error of a pointer come from? `geartrain budget TRAIN` takes its causes one by one, in degrees at the
pointer and in days, ranks them, and names what a train does not declare: that is not known, and never counted as 0.

```sh
geartrain budget freeth-2021-cut --plot budget.svg
```

This page and the pages of the trains are written by `python docs/scripts/make_budgets.py`.

## The causes

| cause | what | degrees |
|---|---|---|
| ratio | the mean speed is not the sky's | drift over `--span`, by default a Saros of 6585.3213 days |
| theory | the pins' anomaly is not the true motion of Moon or Sun | peak to peak, at the best phase |
| teeth | the driven wheel lags and leads within a pitch | peak to peak through the train |
| lost motion | the play of the teeth, when the crank turns back | the greatest way a pointer stays behind |
| cutting | teeth are not where they should be | the range that holds 95 % of trains cut by hand |

A pointer of mean speed w (turns a unit) that should turn at t gains over a time T, counted in units,

    ratio = 360 (|w| - |t|) T                                                              (1)

exactly; where it has several targets, a period seen in the sky counts before a relation that its makers meant. With
all teeth ideal its pins give an error d(phi) over one cycle. The true motion has the equation of centre C(M) = nu -
M, by Kepler's M = E - e sin E and tan(nu/2) = sqrt((1 + e)/(1 - e)) tan(E/2), with e = 0.0549 for the Moon and
0.0167 for the Sun, today. The phase at which the pins were set is the best,

    theory = d(phi) - C(phi + s) - mean,   s such that its mean square is least;              (2)

a pointer without pins errs by all of C. A pointer read against another body has the error of both: ranges add, and
squares of rms too, since nothing relates their cycles. What the Sun does to the Moon beside (evection, 1.3 degrees;
variation, 0.7) no pin follows and (2) leaves out, so that the Moon's true error is greater by that.

Teeth are followed as in [motion](motion.md), equation (3) there: e_f, the pointer's error with real teeth and pins
on the drive flanks; e_b, on the coast flanks; e_0, with pins alone. Then

    teeth = e_f - e_0,      lost motion = |e_b - e_f|;                                       (3)

play between a pin and its slot is nothing that can be declared, and is said to be unknown. Of wheels cut by hand,
trial by trial as in [cut by hand](cut-by-hand.md), e_c is the error at a random position, and

    cutting = e_c - (e_f - e_0) there: the range from the 2.5th to the 97.5th percentile,     (4)

with an interval from order statistics. Where nearly all trials jam, it is what the pushing flanks would do were
jams let pass.

Days are degrees over the pointer's mean speed against what it is read from: by so much an eclipse, a conjunction or
a station is missed. Sums of causes are the worst that can come together; drift grows with the span, and the tables
tell after how many years it is as great as the greatest other cause.
"""

LITERATURE = """## What stands of what has been concluded

Figures are of the [reconstruction of 2021](budgets/freeth-2021.md), which declares no teeth: assumed are equilateral
teeth of equal depth in all its pairs (the rule of [Sorge's note](teeth.md)), each in the middle of its window of
clearance, and a normal error of 0.1 degrees in the place of every tooth, the least that is quoted of the fragments.
No clearance, depth or radius of a tooth in mesh has survived: other assumptions give other figures, and with a
declaration anyone can try them.

**"The triangular shape of the teeth alone produces negligible errors"** (Szigety and Arenas 2025, The Impact of
Triangular-Toothed Gears on the Functionality of the Antikythera Mechanism; of this study only the abstract was
read). *Stands for slow pointers, not for the Moon, under these assumptions.* Of {count} pointers whose teeth are
known, {small} ripple by less than a degree: the Saros pointer by {saros}, where a cell of its dial is 6.5 degrees
wide, the Metonic by {metonic}. The Moon ripples by {teeth} peak to peak, {rms} degrees rms: {times} times what its
pin and slot leave against the true Moon, {theory}, and {drifts} times what its ratio drifts in a Saros, {ratio}. This
depends on the radii: with pitch-true ones, in the ratio of the teeth, it is {true}. Whoever finds the ripple
negligible assumes other teeth than Sorge's rule gives, or measures it by something greater; which of these, the
abstract does not say.

**"Manufacturing inaccuracies significantly increase the likelihood of gear jamming or disengagement"**, and the
errors identified by Edmunds exceed the limits that can be tolerated (same abstract). *Stands.* With the least of the
errors quoted, 0.1 degrees, some pair jams in {jams} % of the trials at shares {windows} of each pair's window. It does
not follow that the mechanism did not turn: it is a few pairs of very unequal wheels that jam ([cut by
hand](cut-by-hand.md)), and a maker who files what jams removes the worst teeth.

**That the shape of teeth weighs little beside cutting**, as the same abstract may be read. *Not at 0.1 degrees.*
Cutting moves the Moon by {cutting}, with an interval of {within} degrees: as much as the ripple of even teeth. The
Saros pointer it moves by {saros_cut}, the Metonic by {metonic_cut}. At greater errors it weighs more, in proportion,
where the train still turns.

**"Added to these inherent theoretical errors were significant mechanical inaccuracies because of the way that the
rotations were transmitted"** (Freeth and Jones 2012, The Cosmos in the Antikythera Mechanism, ISAW Papers 4, section
3.10, after an error of nearly 38 degrees that deferent and epicycle leave Mars at its retrogrades; second-hand, as
quoted at drmsh.com/antikythera-mechanism-report). *Stands for the Moon, not for Mars.* Ripple and cutting of the Moon,
{teeth} and {cutting}, are each {times} times what its pin and slot leave or more. Those of Mars, {mars_teeth} and
{mars_cutting}, are together less than a twentieth of the 38 degrees: with Mars it is the theory that fails, and better
teeth would not have helped.

**"Considerable cumulative inaccuracies in the gear trains, which would have cancelled out many of the subtle
anomalies built into its design"** (Wikipedia's article on the mechanism in 2017, second-hand too; which paper it takes
this from was not seen). *Does not stand for the anomalies, stands for how finely they are drawn.* The Moon's anomaly,
13 degrees peak to peak, stands out from ripple and cutting of half its size each. That pin and slot meet the true Moon
within {theory} could not be seen on such a pointer, nor that its ratio drifts by {ratio} in a Saros.

**Remarks on accuracy of cutting in Freeth et al. 2021**, A Model of the Cosmos in the ancient Greek Antikythera
Mechanism. Its text was not to be had beyond abstract and introduction, so that nothing is quoted or judged. What can
be said to whoever asks whether hand-cut wheels could show what this reconstruction intends: at 0.1 degrees, ripple and
cutting are {planets}.

**An indicated position of the Moon could differ by 20 degrees** (Edmunds and Freeth 2011, second-hand). *Stands
from errors of 0.3 degrees on* ([cut by hand](cut-by-hand.md)), and at any error once the crank turns back.

**Lost motion**, of which neither abstract nor second-hand quotation speaks. In the middle of its window a pair of
triangular teeth has a play of a good part of a pitch, and six pairs lie before the Moon. When the crank turns back it
stays behind by up to {lost}, the Saros pointer by {saros_lost}. That is the greatest cause on nearly every pointer,
and one that a user avoids by always turning forward, as all other figures here assume. Whoever sets such a mechanism
to a date must come to it from before.
"""

REST = """## What this rests on

- Speeds and drifts are exact fractions against the shipped table of [periods](reference.md).
- Teeth, play and cutting are those declared or assumed on each page; a form that nobody declares is no finding.
- The driven wheels drag, so that flanks stay in contact while the crank goes one way; teeth do not bend, arbors do
  not yield, bearings have no play unless `fitting` says so.
- The eccentricities are of today, in general knowledge (NASA's planetary fact sheets); the Sun's was 0.0176 two
  thousand years ago, which changes its equation of centre by a twentieth.
- Planets have no true motion here: what their pins leave is not declared.
"""


if __name__ == "__main__":
    main()
