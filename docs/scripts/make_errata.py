"""Write docs/errata.md: what the sources print, beside what their own numbers give. Every figure is computed here."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from math import asin, degrees
from pathlib import Path

from errata_smith import smith
from errata_sorge import sorge
from errata_sphere import sphere

import geartrain
from geartrain import Answer, GearTrain
from geartrain.kinematics import adjacency_labels
from geartrain.train import period_table

PAGE = Path(__file__).resolve().parents[1] / "errata.md"
YEAR, SYNODIC, SIDEREAL = Fraction("365.242199"), Fraction("29.53059"), Fraction("27.3229")  # Table 5, in days


def paper() -> GearTrain:
    """The train of Pennestri, Valentini and Petti as shipped."""
    return geartrain.load("pennestri-2002")


def changed(parent: str, change: str, drop: Sequence[str] = ()) -> GearTrain:
    """A shipped train with a few lines of declaration laid over it, without the outputs in `drop`."""
    outputs = f"remove: {{outputs: [{', '.join(drop)}]}}\n" if drop else ""
    return geartrain.load(f"extends: {parent}\n{outputs}{change}\n")


def number(value: Fraction | float, digits: int = 7) -> str:
    """A decimal for a reader."""
    return f"{float(value):.{digits}g}"


def rows(header: Sequence[str], body: Iterable[Sequence[object]]) -> Iterator[str]:
    """A Markdown table."""
    yield "| " + " | ".join(header) + " |"
    yield "|" + "---|" * len(header)
    for row in body:
        yield "| " + " | ".join(str(cell) for cell in row) + " |"
    yield ""


def cut_off(printed: str, value: Fraction | float) -> Iterator[str]:
    """A remark where a printed number is not the value rounded to its decimals."""
    decimals = len(printed.partition(".")[2])
    rounded = f"{float(round(value, decimals)):.{decimals}f}"
    if decimals and rounded != printed:
        yield f"printed cut off, for {rounded}"


def table_3() -> Iterator[str]:
    """The caption of Table 3."""
    pairs = [gear.name for gear in paper().declaration.gears]
    yield from ("## Table 3", "")
    yield (
        f"Its columns are {pairs[12]} to {pairs[-1]}, the last {len(pairs[12:])} of {len(pairs)} circuits; Tables 1 "
        f"and 2 hold {pairs[0]} to {pairs[5]} and {pairs[6]} to {pairs[11]}. Its caption says 8-18, for 13-18."
    )
    yield ""


def teeth_of_18() -> Iterator[str]:
    """z18 = 15 or 60."""
    yield from ("## z18: 15 or 60", "")
    yield "The list of tooth numbers prints z18 = 15, the Maple listing Z18 := 60. Both, solved:"
    yield ""
    listed, printed = paper().solve(), changed("pennestri-2002", "links: {18: {wheels: {Z18: 15}}}").solve()
    table_4 = paper().declaration.outputs
    yield from rows(
        ("link", "with z18 = 15", "with z18 = 60", "Table 4"),
        (
            (link, f"{printed[link]} = {number(printed[link])}", f"{listed[link]} = {number(listed[link])}",
             table_4[link].published.value)  # type: ignore[union-attr]
            for link in ("17", "18", "19")
        ),
    )  # fmt: skip
    yield "Only 60 gives the speeds that the paper prints. The shipped train has 60."
    yield ""


def months() -> Iterator[str]:
    """The quotients of years and months."""
    solved = paper().solve()
    yield from ("## Years over months", "")
    yield (
        f"With the day counts of the paper's Table 5: year {number(YEAR, 9)}, synodic month {number(SYNODIC)}, "
        f"sidereal month {number(SIDEREAL, 6)}."
    )
    yield ""
    modern = period_table()["year_tropical_J2000"].value / period_table()["month_sidereal_J2000"].value
    body = [
        ("365.242199/29.5308", "12.3681", YEAR / Fraction("29.5308"), "the paper's text drops a digit of the divisor"),
        ("365.242199/29.53059", "", YEAR / SYNODIC, "the quotient it means, with the divisor of Table 5"),
        ("235/19", "12.3684", solved["17"] * -1, "speed of link 17, without its sign"),
        ("236/19", "12.4210", Fraction(236, 19), "given as Price's ratio; Price has 235/19"),
        ("365.242199/(12 x 29.53059)", "1.03068", YEAR / SYNODIC / 12, "lunar years of twelve months in a year"),
        ("235/228", "1.0307", solved["19"] * -1, "speed of link 19, without its sign"),
        ("365.242199/27.3229", "13.3676", YEAR / SIDEREAL, "the paper's actual value, with the month of Table 5"),
        ("365.242199/27.32166", "", YEAR / Fraction("27.32166"), "with the sidereal month to five decimals"),
        ("year/month of the shipped table", "", modern, "year_tropical_J2000 over month_sidereal_J2000"),
        ("254/19", "13.3684", solved["5"], "speed of link 5"),
    ]
    yield from rows(
        ("quotient", "printed", "computed", "remark"),
        ((a, b, number(c), "; ".join([d, *cut_off(b, c)])) for a, b, c, d in body),
    )
    yield "So the divisor 29.5308 is a misprint of 29.53059, and 12.3681 is the quotient of the misprint."
    yield (
        f"The sidereal month of Table 5 is long by "
        f"{number(SIDEREAL - period_table()['month_sidereal_J2000'].value, 3)} d, "
        "and 13.3676 in the text is its consequence. The text also calls 29.53058 d a sidereal month; it is synodic."
    )
    yield ""
    yield from items(solved)
    yield ""


def items(solved: Answer) -> Iterator[str]:
    """What the paper says of single wheels, and of Hipparchus."""
    yield "The items of the results that name wheel 19 and wheel 9 are out of step with Table 4:"
    yield ""
    yield from rows(
        ("the paper says", "turns a year", "what counts it"),
        (
            ("wheel 19 counts synodic months", f"{solved['19']} = {number(solved['19'])}",
             f"link 17: {solved['17']} = {number(solved['17'])}"),
            ("wheel 9 counts lunar years", f"{solved['9']} = {number(solved['9'])}",
             f"link 19: {solved['19']} = {number(solved['19'])}"),
            ("wheel 8 is engaged with no other", f"{solved['8']} = {number(solved['8'])}",
             f"its wheel meshes with those of links {' and '.join(mates('8'))}"),
        ),
    )  # fmt: skip
    table = period_table()
    year, month = (table[name].value for name in ("year_hipparchus_tropical", "month_synodic_hipparchus_4267"))
    yield f"Hipparchus' year, given as 365.242 d, is 365 + 1/4 - 1/300 = {number(year, 8)} d (Almagest III 1);"
    yield f"Hipparchus' month, given as 29.53058 d, is {number(month, 8)} d (Almagest IV 2)."


def mates(link: str) -> list[str]:
    """The links that mesh with one, each with the gear pair."""
    pairs = [each for each in paper().circuits if link in (each.i, each.j)]
    return [f"{each.j if each.i == link else each.i} ({each.id})" for each in pairs]


def table_4() -> Iterator[str]:
    """Table 4 digit by digit."""
    yield from ("## Table 4, digit by digit", "")
    solved, outputs = paper().solve(), paper().declaration.outputs
    body = []
    for link in paper().declaration.links:
        published = outputs[link].published
        assert published is not None
        printed = str(published.value)
        body.append((link, solved[link], printed, "; ".join(cut_off(printed, solved[link]))))
    yield from rows(("link", "exact", "printed", "remark"), body)


def table_7() -> Iterator[str]:
    """Row 18 of the adjacency matrix."""
    cells = adjacency_labels(paper().declaration)[17]
    found = ", ".join(f"{cell} at column {column}" for column, cell in enumerate(cells, 1) if cell)
    yield from ("## Table 7", "")
    yield f"Row 18 of the matrix holds {found}; the paper prints G19 at column 19, and has"
    pairs = len(paper().declaration.gears)
    yield f"{pairs} gear pairs. `geartrain inspect graph pennestri-2002` prints the whole matrix."
    yield ""


def table_6() -> Iterator[str]:
    """Table 6: conjectured wheels, solved as additions to the train, against synodic periods."""
    yield from ("## Table 6: the conjectured wheels", "")
    yield "Each row is added to the train: wheel 8 (64 teeth, 1/4 turn a year) drives O1, and O2 beside it drives X."
    yield "The rows are fits to synodic periods. Errors are of the period; a positive one is slow."
    yield ""
    printed = [
        ("venus", 32, 50, 40), ("venus", 31, 52, 43), ("venus", 32, 48, 41), ("venus", 30, 48, 41),
        ("mars", 30, 50, 57), ("mars", 31, 48, 53), ("jupiter", 30, 48, 28), ("jupiter", 32, 53, 29),
    ]  # fmt: skip
    body = []
    for planet, o1, o2, x in printed:
        speed = conjecture(o1, o2, x)["x"]
        assert isinstance(speed, Fraction)
        target = period_table()[f"{planet}_synodic_period_jpl"].value / period_table()["year_tropical_J2000"].value
        error = 1 / abs(speed) / target - 1
        remark = ""
        if abs(error) > Fraction(1, 100):
            remark = "misses"
        elif (o1, o2, x) == (30, 48, 41):
            remark = "not printed: the row above with O1 = 30"
        body.append((planet.capitalize(), o1, o2, x, speed, f"{100 * float(error):+.3f} %", remark))
    yield from rows(("planet", "O1", "O2", "X", "turns a year", "error of the period", "remark"), body)
    saros = Fraction("6585.32") / (4 * Fraction("365.2422"))
    yield f"The saros ratio 6585.32/(4 x 365.2422), printed as 4.5075, is {number(saros, 7)}."
    yield ""


def conjecture(o1: int, o2: int, x: int) -> geartrain.Answer:
    """The paper's train with the three wheels of its Figure 4."""
    change = f"""
links: {{o: {{wheels: {{O1: {o1}, O2: {o2}}}}}, x: {{wheels: {{X: {x}}}}}}}
revolutes: [{{pair: [1, o], axis: o}}, {{pair: [1, x], axis: x}}]
gears: [{{pair: [Z8, O1]}}, {{pair: [O2, X]}}]
"""
    return changed("pennestri-2002", change).solve()


def freeth_2021() -> Iterator[str]:
    """Freeth et al. 2021 against itself."""
    yield from ("## Freeth et al. 2021", "")
    outputs = ("mercury epicycle", "me20", "mercury rel")
    train = geartrain.load("freeth-2021")
    drop = [name for name in outputs if name in train.declaration.outputs]
    right = train.solve()["mercury epicycle"]
    wrong = changed(
        "freeth-2021", "links: {me20: {wheels: {me20: 24}}}\noutputs: {epicycle: {of: me20, relative_to: b}}", drop
    ).solve()["epicycle"]
    wheels = train.declaration.wheels
    count = {
        kind: sum(wheel.status == kind for _, wheel in wheels.values())
        for kind in ("surviving", "reconstructed", "hypothetical")
    }
    behind = geartrain.load("freeth-2008").declaration.wheels
    split = [sum(w.status == kind for _, w in behind.values()) for kind in ("surviving", "reconstructed")]
    yield from rows(
        ("place", "printed", "computed"),
        (
            ("supplement, caption of Fig. S22e", "Mercury's train ends in 40 ~ 24",
             f"with 24 the epicycle makes {wrong} turns a year, with 20 {right}; the period relation is 1513/480"),
            ("supplement, section 6.3", "29 wheels behind and including a1, b1",
             f"the table has {split[0]} surviving and {split[1]} reconstructed ones there"),
            ("title count", "69 wheels",
             f"{len(wheels)} declared: {count['surviving']} surviving, {count['reconstructed']} reconstructed, "
             f"{count['hypothetical']} hypothetical"),
        ),
    )  # fmt: skip
    yield "The period relation (315, 344) for Jupiter is not the only one that its authors' rules allow. Against the"
    yield "synodic period of the shipped table (positive is fast):"
    yield ""
    year = period_table()["year_tropical_J2000"].value
    synodic = period_table()["jupiter_synodic_period_jpl"].value
    found = [Fraction(315, 344), Fraction(847, 925), Fraction(1162, 1269)]
    yield from rows(
        ("relation", "turns a year", "error in ppm"),
        ((ratio, number(ratio, 10), f"{1e6 * float(ratio * synodic / year - 1):+.1f}") for ratio in found),
    )


def freeth_jones() -> Iterator[str]:
    """The equal pairs of Freeth and Jones 2012, on which the sources disagree."""
    yield from ("## Freeth and Jones 2012", "")
    yield "The paper's table and a diagram drawn after it disagree on the equal pairs of Mars and Jupiter."
    yield "The pairs change no speed:"
    yield ""
    first, second = geartrain.load("freeth-jones-2012"), geartrain.load("freeth-jones-2012-shambaugh")
    one, two = first.solve(), second.solve()
    pairs = {"mars": ("ma70s", "ma69s"), "jupiter": ("ju85s", "ju86s"), "saturn": ("sa60s", "sa60s")}
    yield from rows(
        ("planet", "pair in the table", "pair in the diagram", "turns a year, table", "turns a year, diagram"),
        (
            (planet.capitalize(), first.declaration.wheels[a][1].count, second.declaration.wheels[b][1].count,
             one[planet], two[planet])
            for planet, (a, b) in pairs.items()
        ),
    )  # fmt: skip


def freeth_2006() -> Iterator[str]:
    """The amplitude of the lunar anomaly."""
    yield from ("## The pin of the Moon, Freeth et al. 2006", "")
    pin = next(c for c in geartrain.load("freeth-2008").declaration.couplings if c.name == "anomaly")
    assert pin.pin_radius is not None
    assert pin.offset is not None
    yield "The amplitude of the anomaly is asin(e/r) for pin radius r and offset e. The paper prints 6.5 degrees."
    yield ""
    radii = (str(pin.pin_radius), "9.67 mm", "9.9 mm")
    offset = float(pin.offset.value)
    yield from rows(
        ("r", "e", "asin(e/r) in degrees"),
        ((radius, pin.offset, f"{degrees(asin(offset / float(radius.split()[0]))):.3f}") for radius in radii),
    )
    yield "9.6 mm is declared in the shipped train. 9.9 mm is a later measurement, and 9.67 mm a figure used in models."
    yield ""
    year = period_table()["year_tropical_J2000"].value
    modern = year / period_table()["lunar_apsides_period_tropical_J2000"].value
    body = [
        ("239 anomalistic in 223 synodic months", Fraction(254, 19) - Fraction(235, 19) * Fraction(239, 223)),
        ("269 in 251 (Hipparchus)", Fraction(254, 19) - Fraction(235, 19) * Fraction(269, 251)),
    ]
    yield "The turntable makes the apsides turn by the first of these relations. The second needs a wheel with a"
    yield f"multiple of the prime 251. Periods are in tropical years; the sky's is {number(1 / modern)}:"
    yield ""
    yield from rows(
        ("relation", "apsides, turns a year", "period", "error of the speed"),
        ((a, b, number(1 / b), f"{100 * float(b / modern - 1):+.3f} %") for a, b in body),
    )


def voulgaris() -> Iterator[str]:
    """The draconic train of 2022 stands or falls with b1."""
    yield from ("## Voulgaris et al. 2022", "")
    yield "The draconic pointer is an approximation to 56870/4237 turns a year and depends on the teeth of b1:"
    yield ""
    target = Fraction(56870, 4237)
    body = []
    for teeth in (223, 224, 225):
        change = f"links: {{b: {{wheels: {{b1: {{teeth: {teeth}}}}}}}}}\noutputs: {{pointer: {{of: s}}}}"
        drop = [] if teeth == 225 else ["crank", "draconic"]
        speed = changed("voulgaris-2022", change, drop).solve()["pointer"]
        assert isinstance(speed, Fraction)
        body.append((teeth, speed, number(speed, 8), f"{1e6 * float(abs(speed) / target - 1):+.1f}"))
    yield from rows(("b1", "turns a year", "decimal", "error in ppm"), body)


def price() -> Iterator[str]:
    """Price's crank."""
    yield from ("## Price 1974", "")
    yield "The contrate wheel of the crank is read as 45 or 48 teeth. Price's 73 days for a turn of the crank needs 45:"
    yield ""
    body = []
    for teeth in (45, 48):
        drop = [] if teeth == 45 else ["crank"]
        change = f"links: {{crank: {{wheels: {{A: {{teeth: {teeth}}}}}}}}}\noutputs: {{handle: {{of: crank}}}}"
        speed = changed("price-1974", change, drop).solve()["handle"]
        assert isinstance(speed, Fraction)
        days = period_table()["year_tropical_J2000"].value / abs(speed)
        body.append((teeth, abs(speed), number(days, 5)))
    yield from rows(("teeth", "turns of the crank a year", "days a turn"), body)


def huygens() -> Iterator[str]:
    """Mercury in Huygens' planetarium."""
    yield from ("## Huygens' planetarium 1682, after Dietzschold", "")
    train = geartrain.load("huygens-planetarium-1682")
    wheels = {name: wheel.count for name, (_, wheel) in train.declaration.wheels.items()}
    year = period_table()["year_sidereal_J2000"].value
    sky = year / period_table()["mercury_sidereal_period_jpl"].value
    single = Fraction(wheels["me121"] or 0, wheels["me17"] or 1)
    compound = train.solve()["mercury"]
    assert isinstance(compound, Fraction)
    yield "Dietzschold gives Mercury's train as 121 and 17 only. Against the sky:"
    yield ""
    yield from rows(
        ("train", "turns a year", "decimal", "sky", "error"),
        (
            (name, value, number(value), number(sky), f"{100 * float(value / sky - 1):+.4f} %")
            for name, value in (("121/17", single), ("(7/12)(121/17)", compound))
        ),
    )
    saturn = train.solve()["saturn"]
    assert isinstance(saturn, Fraction)
    own = Fraction(77708431, 2640858)
    sky_saturn = period_table()["saturn_sidereal_period_jpl"].value / year
    yield "Saturn's 7 and 206, against the fraction that Huygens set out to approximate, and against the sky:"
    yield ""
    yield from rows(
        ("what", "years a turn", "error of 206/7"),
        (
            ("206/7 of the train", number(1 / abs(saturn)), ""),
            ("77708431/2640858, Huygens", number(own), f"{1e6 * float(1 / abs(saturn) / own - 1):+.1f} ppm"),
            ("shipped table", number(sky_saturn), f"{1e6 * float(1 / abs(saturn) / sky_saturn - 1):+.1f} ppm"),
        ),
    )


def lead() -> Iterator[str]:
    """Head of the page."""
    yield from ("# Errata of the sources", "")
    yield "Written by `python docs/scripts/make_errata.py`, which loads the shipped trains, changes them where a source"
    yield "is in doubt, solves them exactly, and compares. Every computed figure comes from that run."
    yield ""
    yield from ("## The Antikythera train of Pennestri, Valentini and Petti 2002", "")
    yield "`geartrain report pennestri-2002` lists the errata in its last section:"
    yield ""
    errata = paper().declaration.errata
    yield from rows(("place", "printed", "right"), ((e.place, e.printed, e.right) for e in errata))
    yield "The sections below check them one by one."
    yield ""


def main() -> None:
    """Write the page."""
    parts = (
        lead, table_3, teeth_of_18, months, table_4, table_6, table_7, freeth_2006, freeth_jones, freeth_2021,
        voulgaris, price, huygens, sorge, smith, sphere,
    )  # fmt: skip
    lines = [line for part in parts for line in part()]
    PAGE.write_text("\n".join(lines).rstrip() + "\n", encoding="utf-8")
    print("wrote docs/errata.md")


if __name__ == "__main__":
    main()
