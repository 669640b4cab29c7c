"""Write docs/missing-parts.md: the lost wheels of a paper, all solutions beside the printed ones. Computed here."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import groupby
from pathlib import Path

from make_errata import changed, number, rows

from geartrain import GearTrain, load
from geartrain.search import Assignment, TrainFindings, search_train
from geartrain.search.train.train_findings import PartFindings
from geartrain.train import period_table

PAGE = Path(__file__).resolve().parents[1] / "missing-parts.md"
NAME = "pennestri-2002-missing"
LETTERS = {"venus": "V", "mars": "M", "jupiter": "J", "saros": "S"}
TABLE_6 = {
    "venus": ((32, 50, 40), (31, 52, 43), (32, 48, 41)),
    "mars": ((30, 50, 57), (31, 48, 53)),
    "jupiter": ((30, 48, 28), (32, 53, 29)),
    "saros": (),
}
ALL = 10**4


def bounded(low: int, high: int) -> GearTrain:
    """The train with all its free wheels between two counts."""
    links = []
    for planet, letter in LETTERS.items():
        free = f"{{teeth: {{value: {high}, search: [{low}, {high}]}}}}"
        links.append(f"  {planet} arbor: {{wheels: {{{letter}O1: {free}, {letter}O2: {free}}}}}")
        links.append(f"  {planet}: {{wheels: {{{letter}X: {free}}}}}")
    return changed(NAME, "links:\n" + "\n".join(links))


def part_of(found: TrainFindings, planet: str) -> PartFindings:
    """The part of a search that moves one output."""
    return next(part for part in found.parts if part.outputs == (planet,))


def wheels(planet: str, row: tuple[int, int, int]) -> dict[str, int]:
    """O1, O2, X under their names in the train."""
    return dict(zip((f"{LETTERS[planet]}{name}" for name in ("O1", "O2", "X")), row, strict=True))


def row_of(solution: Assignment) -> tuple[int, ...]:
    """O1, O2, X of a solution."""
    return tuple(solution.teeth.values())


def written(row: tuple[int, ...]) -> str:
    """Counts as the page shows them."""
    return "/".join(map(str, row))


def by_speed(part: PartFindings, planet: str) -> Iterator[tuple[Fraction, list[Assignment]]]:
    """The solutions of a part in their order, those of one speed together."""
    for speed, same in groupby(part.solutions, lambda one: one.outputs[planet].speed):
        yield speed, list(same)


def relation(speed: Fraction) -> str:
    """The period relation of the shipped table that a speed is exactly."""
    known = (row for row in period_table().values() if row.kind == "speed" and row.value == speed)
    return ", ".join(f"{row.source} ({row.name})" for row in known)


def period_error(error: Fraction) -> str:
    """Error of the period, from that of the speed."""
    return f"{100 * float(1 / (1 + error) - 1):+.3f} %"


def lead() -> Iterator[str]:
    """Head of the page."""
    yield from ("# The missing parts of the Antikythera train", "")
    yield "Written by `python docs/scripts/make_missing.py`. Every figure is computed there."
    yield ""
    yield "Pennestri, Valentini and Petti (2002) close with a conjecture on the lost wheels: wheel N (64 teeth, a"
    yield "quarter turn a year) drives O1, and O2 beside it on the arbor drives X. By Figure 4 the wheel X turns"
    yield "(1/4)(64/O1)(O2/X) = 16 O2/(O1 X) times a year. Table 6 prints counts for Venus, Mars and Jupiter. Its rows"
    yield "fit the synodic periods, which the paper does not say."
    yield ""
    yield f"In the shipped train `{NAME}` these wheels are free: 28 to 60 teeth for the planets, which is"
    yield "what the rows suggest. Targets are modern mean synodic periods, the rows `..._synodic_period_jpl` of"
    yield "`geartrain periods`, derived from JPL's mean longitudes. The tolerance of 0.25 % was chosen to hold every"
    yield "printed row that is right. Whatever meets it is found and counted. O1 and X can change places, for only"
    yield "their product matters."
    yield ""


def printed(train: GearTrain, found: TrainFindings) -> Iterator[str]:
    """Where the rows of Table 6 stand."""
    yield from ("## Where the printed rows stand", "")
    body = []
    for planet, printed_rows in TABLE_6.items():
        part = part_of(found, planet)
        for row in printed_rows:
            (standing,) = found.standing(wheels(planet, row))
            assert standing.assignment is not None
            reached = standing.assignment.outputs[planet]
            better = sum(abs(one.error) < abs(reached.error) for one in part.solutions)
            place = f"{better} of {part.count} are better" if reached.met else "**misses: a misprint**"
            cells = (planet.capitalize(), written(row), reached.speed, f"{1e6 * float(reached.error):+.0f}")
            body.append((*cells, period_error(reached.error), place))
    head = ("planet", "O1/O2/X", "turns a year", "error of the speed, ppm", "of the period", "within 0.25 %")
    yield from rows(head, body)


def misprint(found: TrainFindings) -> Iterator[str]:
    """The third row for Venus, and what mends it."""
    row = TABLE_6["venus"][2]
    near = [
        one
        for one in part_of(found, "venus").solutions
        if sum(a != b for a, b in zip(row_of(one), row, strict=True)) == 1
    ]
    yield f"The third row for Venus, {written(row)}, cannot be meant. Of all {part_of(found, 'venus').count} solutions"
    yield f"{len(near)} differs from it in one count only:"
    yield ""
    head = ("O1/O2/X", "turns a year", "error of the period")
    body = [
        (written(row_of(one)), one.outputs["venus"].speed, period_error(one.outputs["venus"].error)) for one in near
    ]
    yield from rows(head, body)
    yield "That is an error like those of its neighbours, so 32 stands where 30 was meant."
    yield ""


def solutions(found: TrainFindings) -> Iterator[str]:
    """Every solution of every part."""
    for planet in TABLE_6:
        part = part_of(found, planet)
        known = set(TABLE_6[planet])
        yield from (f"## {planet.capitalize()}", "")
        state = "complete" if part.complete else f"not complete: {part.reason}"
        yield f"{part.count} of {part.considered} sets meet the target ({state})."
        yield "Sets of one speed share a line" + ("; rows of Table 6 are in bold." if known else ".")
        yield ""
        body = []
        for speed, same in by_speed(part, planet):
            error = same[0].outputs[planet].error
            sets = ", ".join(
                f"**{written(row_of(one))}**" if row_of(one) in known else written(row_of(one)) for one in same
            )
            body.append((speed, f"{1e6 * float(error):+.1f}", period_error(error), sets, relation(speed)))
        yield from rows(("turns a year", "error of the speed, ppm", "of the period", "O1/O2/X", "known relation"), body)


def saros() -> Iterator[str]:
    """Why the saros needs larger wheels."""
    ratio = Fraction("6585.32") / (4 * Fraction("365.2422"))
    part = part_of(search_train(bounded(28, 60).declaration), "saros")
    most = Fraction(60 * 60, 64 * 28)
    yield from ("## The saros needs larger wheels", "")
    yield f"The paper asks for a ratio of 6585.32/(4 x 365.2422) = {number(ratio)} with a similar arrangement. It is"
    yield "the slowing of X against wheel N, (O1/64)(X/O2). With all wheels from 28 to 60, which suit the planets, two"
    yield f"meshes reach {number(most, 4)} at most (60/64 times 60/28): {part.count} solutions. The search says so:"
    yield ""
    for text in (part.shortfall.nearest, part.shortfall.advice):
        if text:
            yield f"- {text}"
    yield ""
    yield f"Two meshes do it only if O1 times X is about {number(64 * ratio, 5)} times O2. The shipped train has bounds"
    yield "of 15 to 127 for these wheels, the span of its own but for the turntable and the great wheels, and 100 ppm."
    yield ""


def wider() -> Iterator[str]:
    """What larger bounds and no tolerance give."""
    yield from ("## With wheels from 15 to 127", "")
    yield "The three best speeds for each planet, and up to four sets of each:"
    yield ""
    found = search_train(bounded(15, 127).declaration, best=400)
    body = []
    for planet in TABLE_6:
        if planet == "saros":
            continue
        part = part_of(found, planet)
        for speed, same in list(by_speed(part, planet))[:3]:
            error = same[0].outputs[planet].error
            shown = ", ".join(written(row_of(one)) for one in same[:4]) + (", ..." if len(same) > 4 else "")
            cells = (planet.capitalize(), part.count, speed, f"{1e6 * float(error):+.2f}", shown)
            body.append((*cells, relation(speed)))
    head = ("planet", "within 0.25 %", "turns a year", "error of the speed, ppm", "O1/O2/X", "known relation")
    yield from rows(head, body)


def surviving(train: GearTrain) -> Iterator[str]:
    """The pair that Price has in this place."""
    counts = {name: wheel.count for name, (_, wheel) in train.declaration.wheels.items()}
    o1, o2 = counts["Z9"], counts["Za9"]
    assert o1 is not None
    assert o2 is not None
    yield from ("## The pair that is there", "")
    yield f"Price's train has a pair O of {o1} and {o2} teeth driven by wheel N already (Z9 and Za9 of the paper). With"
    yield "these as O1 and O2, the best X for each planet:"
    yield ""
    body = []
    for planet in ("venus", "mars", "jupiter"):
        wanted = train.solve().outputs[planet].targets[0].speed
        x, error = min(
            ((x, Fraction(16 * o2, o1 * x) / wanted - 1) for x in range(15, 128)), key=lambda pair: abs(pair[1])
        )
        body.append((planet.capitalize(), written((o1, o2, x)), period_error(error)))
    yield from rows(("planet", "O1/O2/X", "error of the period"), body)
    yield "None comes near the printed rows, so the conjecture needs new wheels beside this pair."
    yield ""


def main() -> None:
    """Write the page."""
    train = load(NAME)
    found = search_train(train.declaration, best=ALL)
    parts = (lead(), printed(train, found), misprint(found), solutions(found), saros(), wider(), surviving(train))
    lines = [line for part in parts for line in part]
    PAGE.write_text("\n".join(lines).rstrip() + "\n", encoding="utf-8")
    print("wrote docs/missing-parts.md")


if __name__ == "__main__":
    main()
