"""Pennestri, Valentini and Petti 2002, the Antikythera train by graph theory: every table, equation and claim."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import lru_cache

import geartrain
from geartrain import GearTrain
from geartrain.kinematics.graph import adjacency_labels
from geartrain.search import search_train
from geartrain.train import period_table
from sources.row import Digits, Exactly, Finding, Found, Row, Source, Statements, declared, outside
from sources.ways import Command

HISTORY = "history"
SOLVE = "solve pennestri-2002"


_OWN = Statements(globals())
call, exact, digits, words = _OWN.call, _OWN.exact, _OWN.digits, _OWN.words


@lru_cache(maxsize=1)
def paper() -> GearTrain:
    """The paper's train as shipped."""
    return geartrain.load("pennestri-2002")


@lru_cache(maxsize=1)
def price() -> GearTrain:
    """Price's train as shipped."""
    return geartrain.load("price-1974")


def count(wheel: str, train: GearTrain | None = None) -> int | None:
    """The teeth of a wheel."""
    return (train or paper()).declaration.wheels[wheel][1].count


def speed(link: int) -> Fraction:
    """The exact speed of a link, in turns per year."""
    return Fraction(paper().solve()[str(link)])


def period(name: str) -> Fraction:
    """A period of the shipped table (days)."""
    return Fraction(period_table()[name].value)


# ----------------------------------------------------------------------------------------------------------- structure

# gear pair: bodies i, j, carrier k, wheels, as Tables 1 to 3 print them
CIRCUITS = {
    1: {
        "G1": "2 3 1 Z2 Z3", "G2": "2 4 1 Za2 Z4", "G3": "4 10 1 Za4 Z10", "G4": "4 6 1 Za4 Z6", "G5": "4 15 1 Zb4 Z15",
        "G6": "5 11 1 Za5 Za11",
    },
    2: {
        "G7": "5 12 1 Za5 Z12", "G8": "6 7 1 Za6 Z7", "G9": "7 8 1 Za7 Z8", "G10": "8 9 1 Z8 Z9",
        "G11": "10 11 1 Za10 Z11", "G12": "12 13 20 Za12 Z13",
    },
    3: {
        "G13": "13 14 20 Z13 Z14", "G14": "16 20 1 Z16 Za20", "G15": "14 15 20 Za14 Za15", "G16": "16 17 1 Za16 Z17",
        "G17": "17 18 1 Za17 Z18", "G18": "18 19 1 Za18 Z19",
    },
}  # fmt: skip
TEETH = (
    "z2=45 za2=45 z3=225 z4=225 za4=64 zb4=32 za5=32 z6=36 za6=54 z7=96 za7=16 z8=64 z9=32 za9=48 z10=38 za10=48 "
    "z11=24 za11=127 z12=32 za12=32 z13=64 z14=32 za14=48 z15=32 za15=48 z16=48 za16=30 z17=60 za17=20 z18=15 za18=15 "
    "z19=60 za20=192"
)
MAPLE = TEETH.replace("z", "Z").replace("Z18=15", "Z18=60")
LETTERS = (
    "H2=15 M2=16 G1=20 D1=24 F2=30 E1=32 L1=36 C1=38 C2=48 A=48 E5=48 F1=48 K2=48 O2=48 L2=54 G2=60 H1=60 I=60 N=64 "
    "B2=64 M1=96 EK=96 D2=127 E3=192 E4=222 B1=225"
)
# the non-empty cells of each row of Table 7, in their order; columns are shifted in the copy
TABLE_7 = (
    "R(2) R(5) R(6) R(7) R(8) R(9) R(10) R(11) R(15) R(16) R(17) R(18) R(19)",
    "R(2) G1 G2",
    "G1 R(5)",
    "G2 R(5) G4 G3 G5",
    "R(5) R(5) R(5) G6 G7",
    "R(6) G4 G8",
    "R(7) G8 G9",
    "R(8) G9 G10",
    "R(9) G10",
    "R(10) G3 G11",
    "R(11) G6 G11",
    "G7 G12 R(15)",
    "G12 G13 R(13)",
    "G13 G15 R(14)",
    "R(15) G5 R(15) G15 R(15)",
    "R(16) G16 G14",
    "R(17) G16 G17",
    "R(18) G17 G19",
    "R(19) G18",
    "R(13) R(14) R(15) G14",
)


def circuit(name: str) -> str:
    """Bodies i, j, carrier k and both wheels of a fundamental circuit."""
    (found,) = (each for each in paper().circuits if each.id == name)
    return " ".join((found.i, found.j, found.carrier, *found.wheels))


def cells(link: int) -> str:
    """What stands in a row of the adjacency matrix."""
    return " ".join(cell for cell in adjacency_labels(paper().declaration)[link - 1] if cell)


def introduction() -> Iterator[Row]:
    """Abstract, history, description."""
    yield outside("Abstract", "design knowledge of the Greeks, first differential gear", HISTORY)
    yield outside("History", "the find: 1900, 42 m deep, one mile east of Pinakakia; ship of 80-50 B.C.", HISTORY)
    yield outside("Description", "Pappos, Heron, Cicero, Archimedes, Al-Biruni, Willis 1837", HISTORY)
    yield _OWN.outside(
        "Description, sheets",
        "bronze of 2.0 to 2.3 mm",
        "speeds do not depend on thickness",
        "same_speeds('thickness: 2 mm')",
    )
    yield outside(
        "Fig. 1",
        "plan by Price, with dimensions in cm",
        "the copy has no pictures; `geartrain draw pennestri-2002` draws the plan to the ratios of the teeth",
    )
    yield outside("Fig. 2", "numbers of the links", "the copy has no pictures; the numbers are those of Tables 1 to 4")
    yield words(
        "Fig. 3",
        "the graph: links, turning and gear pairs",
        "graph()",
        why="the picture is not in the copy; `geartrain draw pennestri-2002 --kind graph` draws it",
    )
    yield outside("Fig. 5", "a view in space", "the copy has no pictures; `geartrain view pennestri-2002` turns it")


def graph() -> Finding:
    """Nodes and edges of the graph."""
    found = paper().graph
    kinds = [data["kind"] for _, _, data in found.edges(data=True)]
    counts = (len(found), kinds.count("revolute"), kinds.count("gear"))
    return Finding(counts == (20, 19, 18), f"{counts[0]} links, {counts[1]} turning and {counts[2]} gear pairs")


def structure() -> Iterator[Row]:
    """The kinematic structure, Tables 1 to 3 and 7, tooth numbers."""
    mobility = "paper().mobility"
    yield exact("Structure, links", "links, frame included", "20", f"{mobility}.links")
    yield exact("Structure, revolute pairs", "turning pairs", "19", f"{mobility}.turning_pairs")
    yield exact("Structure, gear pairs", "gear pairs", "18", f"{mobility}.gear_pairs")
    yield Row("Eq. (1)", "F = jR - jG", "1", Command(SOLVE, "mobility.by_count"), Exactly())
    yield Row("Analysis, system", "equations of the linear system", "18", Command(SOLVE, "mobility.rank"), Exactly())
    for table, columns in CIRCUITS.items():
        for name, entries in columns.items():
            yield exact(f"Table {table}, {name}", "bodies i, j, k, wheels", entries, f"circuit('{name}')")
    yield exact("Table 3, caption", "fundamental circuits", "8-18", "caption()", "13-18")
    yield words("Eq. (2)", "w_i - tau w_j + (tau - 1) w_k = 0, tau = -z_j/z_i, for each circuit", "willis()")
    for entry in TEETH.split():
        name, _, teeth = entry.partition("=")
        erratum = "60, as in the Maple listing; 15 gives other speeds" if entry == "z18=15" else ""
        expression = f"count('{name.capitalize()}')"
        yield declared(exact(f"Tooth list, {name}", "teeth", teeth, expression, erratum))
    for link, entries in enumerate(TABLE_7, 1):
        yield exact(
            f"Table 7, row {link}",
            "entries of the row",
            entries,
            f"cells({link})",
            "R(18) G17 G18" if link == 18 else "",
        )


def same_speeds(more: str) -> Finding:
    """Whether the train has the same speeds where it declares something more."""
    found = geartrain.load(f"extends: pennestri-2002\n{more}\n").solve()
    return Finding(dict(found.speeds) == dict(paper().solve().speeds), "the speeds are the same")


def no_wheel(name: str) -> Finding:
    """Whether Price's train and the equations of the listing are without a wheel."""
    used = name in price().declaration.wheels or any(f"Z{name}" in text for text in EQUATIONS)
    return Finding(not used, f"there is no wheel {name}")


def price_months() -> Finding:
    """Synodic months a year, of Price's train and of the paper's."""
    ours = abs(speed(17))
    return Finding(price_ratio() == ours, f"both {ours}")


def caption() -> str:
    """The circuits of Table 3, by number."""
    numbers = [name[1:] for name in CIRCUITS[3]]
    assert [each.id for each in paper().circuits][12:] == list(CIRCUITS[3])
    return f"{numbers[0]}-{numbers[-1]}"


def willis() -> Finding:
    """The residuals of Eq. (2)."""
    speeds = paper().solve().speeds
    residuals = []
    for each in paper().circuits:
        i, j, k = (Fraction(speeds[name]) for name in (each.i, each.j, each.carrier))
        tau = Fraction(-each.b, each.a)
        residuals.append(i - tau * j + (tau - 1) * k)
    return Finding(not any(residuals), f"exactly 0 for all {len(residuals)} circuits")


# -------------------------------------------------------------------------------------------------------------- speeds

SPEEDS = {
    1: "0", 2: "5", 3: "-1", 4: "-1", 5: "13.3684", 6: "1.7777", 7: "-1", 8: "0.2500", 9: "-0.5000", 10: "1.6842",
    11: "-3.3684", 12: "-13.3684", 13: "-2.5921", 14: "-13.3684", 15: "1", 16: "24.7368", 17: "-12.3684",
    18: "4.1228", 19: "-1.0307", 20: "-6.1842",
}  # fmt: skip
EQUATIONS = (
    "(n[2]-n[1])/(n[3]-n[1])+Z3/Z2",
    "(n[2]-n[1])/(n[4]-n[1])+Z4/Za2",
    "(n[4]-n[1])/(n[10]-n[1])+Z10/Za4",
    "(n[4]-n[1])/(n[6]-n[1])+Z6/Za4",
    "(n[4]-n[1])/(n[15]-n[1])+Z15/Zb4",
    "(n[5]-n[1])/(n[11]-n[1])+Za11/Za5",
    "(n[5]-n[1])/(n[12]-n[1])+Z12/Za5",
    "(n[6]-n[1])/(n[7]-n[1])+Z7/Za6",
    "(n[7]-n[1])/(n[8]-n[1])+Z8/Za7",
    "(n[8]-n[1])/(n[9]-n[1])+Z9/Z8",
    "(n[10]-n[1])/(n[11]-n[1])+Z11/Za10",
    "(n[12]-n[20])/(n[13]-n[20])+Z13/Za12",
    "(n[13]-n[20])/(n[14]-n[20])+Z14/Z13",
    "(n[16]-n[1])/(n[20]-n[1])+Za20/Z16",
    "(n[14]-n[20])/(n[15]-n[20])+Za15/Za14",
    "(n[16]-n[1])/(n[17]-n[1])+Z17/Za16",
    "(n[17]-n[1])/(n[18]-n[1])+Z18/Za17",
    "(n[18]-n[1])/(n[19]-n[1])+Z19/Za18",
)


def maple(equation: str) -> Fraction:
    """The left side of an equation of the listing, with exact speeds and the teeth of the listing."""
    teeth = {name: Fraction(value) for name, _, value in (entry.partition("=") for entry in MAPLE.split())}
    n = {link: speed(link) for link in range(1, 21)}
    return Fraction(eval(equation, {**teeth, "n": n}))


def speeds() -> Iterator[Row]:
    """Table 4 and the Maple listing."""
    for link, printed in SPEEDS.items():
        yield Row(
            f"Table 4, w{link}",
            "speed (turns per year)",
            printed,
            Command(SOLVE, f"states.0.speeds.{link}.exact"),
            Digits(),
            "1.7778" if link == 6 else "",
            echo=link in (1, 2),  # the frame and the input
        )
    for entry in LETTERS.split():
        name, _, teeth = entry.partition("=")
        place, claim = f"Maple, Z({name})", "teeth, in Price's letters"
        if name == "EK":
            why = "Price's train has no wheel EK, and no equation of the listing uses it"
            yield _OWN.outside(place, claim, why, "no_wheel('EK')", teeth)
        else:
            wrong = "45, see Price 1974 below" if name == "A" else ""
            expression = f"count('{name}', price())"
            yield declared(exact(place, claim, teeth, expression, erratum=wrong))
    for entry in MAPLE.split():
        name, _, teeth = entry.partition("=")
        yield declared(exact(f"Maple, {name}", "teeth, in the paper's numbers", teeth, f"count('{name}')"))
    yield declared(exact("Maple, n[1]", "the frame", "0", "speed(1)"))
    yield declared(exact("Maple, n[2]", "the input", "5", "speed(2)"))
    for number, text in enumerate(EQUATIONS, 1):
        yield exact(f"Maple, eq{number}", f"{text} = 0", "0", f"maple('{text}')")


# ------------------------------------------------------------------------------------------------------------- results


def turns(o1: int, o2: int, x: int) -> Fraction:
    """The speed of X where the wheels of Fig. 4 are added to the train."""
    change = f"""
extends: pennestri-2002
links: {{o: {{wheels: {{O1: {o1}, O2: {o2}}}}}, x: {{wheels: {{X: {x}}}}}}}
revolutes: [{{pair: [1, o], axis: o}}, {{pair: [1, x], axis: x}}]
gears: [{{pair: [Z8, O1]}}, {{pair: [O2, X]}}]
"""
    return abs(Fraction(geartrain.load(change).solve()["x"]))


def missing(planet: str, o1: int, o2: int, x: int) -> Finding:
    """The period of X, against the synodic period of a planet."""
    found = turns(o1, o2, x)
    wanted = period(f"{planet}_synodic_period_jpl") / period("year_tropical_J2000")
    error = float(1 / found / wanted - 1)
    return Finding(abs(error) < 0.0025, f"{found} turns per year, period error {100 * error:+.3f} %")


def misprint() -> Finding:
    """The third row for Venus as printed, and with 30 teeth."""
    printed, corrected = missing("venus", 32, 48, 41), missing("venus", 30, 48, 41)
    assert corrected
    return Finding(bool(printed), f"{printed.text}; corrected, {corrected.text}")


def arrangement() -> Finding:
    """Sets of wheels that give the saros, of all within the bounds."""
    parts = search_train(geartrain.load("pennestri-2002-missing").declaration, best=1).parts
    (found,) = (part for part in parts if part.outputs == ("saros",))
    return Finding(found.complete and found.count > 0, f"{found.count} of {found.considered} sets meet the target")


def calendar() -> Finding:
    """How much the Julian year is too long."""
    minutes = (Fraction("365.25") - Fraction("365.2422")) * 1440
    since = float((1582 - 325) * (Fraction("365.25") - Fraction("365.2422")))
    return Finding(minutes > 11, f"{float(minutes):.2f} minutes; {since:.1f} days from the council of Nicaea to 1582")


def saros_of_years() -> Finding:
    """The saros in years and days."""
    rest = Fraction("6585.32") - 18 * Fraction("365.2422")
    return Finding(round(rest) == 11, f"18 years and {float(rest):.2f} days")


def price_ratio() -> Fraction:
    """Synodic months a year in Price's train as shipped."""
    return Fraction(price().solve()["synodic month"])


def counts_months(link: int, months: int) -> Finding:
    """Whether a link turns once in so many mean synodic months, within a part in ten thousand."""
    wanted = period("year_tropical_J2000") / period("month_synodic_J2000") / months
    found = abs(speed(link))
    return Finding(
        abs(found / wanted - 1) < Fraction(1, 10**4), f"{found} turns per year, required {float(wanted):.4f}"
    )


def years_and_months() -> Iterator[Row]:
    """What the results start from, and Table 5."""
    yield digits(
        "Results, year",
        "Hipparchus' year (days)",
        "365.242",
        "period('year_hipparchus_tropical')",
        "365.24667 = 365 + 1/4 - 1/300",
    )
    yield digits(
        "Results, month",
        "Hipparchus' month (days)",
        "29.53058",
        "period('month_synodic_hipparchus_4267')",
        "29.53059 (Almagest IV 2)",
    )
    yield outside("Results, definitions", "what a sidereal and a synodic month are", "definitions, all correct")
    yield words(
        "Results, its name",
        "Hipparchus' month is the sidereal month",
        "sidereal()",
        "the synodic month",
    )
    yield words("Footnote 1", "the Julian year is more than 11 minutes too long; 10 days in all", "calendar()")
    yield outside(
        "Table 5, year",
        "solar year (days)",
        "an astronomical datum (the mean year of 1900); shipped is that of 2000, 365.242190402 d",
        "365.242199",
    )
    yield declared(digits("Table 5, synodic month", "days", "29.53059", "period('month_synodic_J2000')"))
    yield digits(
        "Table 5, sidereal month",
        "days",
        "27.3229",
        "period('month_sidereal_J2000')",
        "27.32166",
    )


def results() -> Iterator[Row]:
    """Their five points."""
    yield exact("Results 1", "turns of the crank in a year", "5", "speed(2) / abs(speed(3))")
    yield words("Results 2, sun and moon", "wheels 3 and 5 are the Sun and the Moon in the zodiac", "pointers()")
    yield digits("Results 2, w5", "year over sidereal month", "13.3684", "speed(5)")
    yield digits(
        "Results 2, actual",
        "actual ratio of year and sidereal month",
        "13.3676",
        "period('year_tropical_J2000') / period('month_sidereal_J2000')",
        "13.3682; 13.3676 follows from the month of Table 5",
    )
    yield words(
        "Results 3, wheel 19",
        "wheel 19 turns once in a synodic month",
        "counts_months(19, 1)",
        "link 17 does (235/19 turns per year)",
    )
    yield digits(
        "Results 3, actual",
        "365.242199/29.5308, for the divisor of Table 5",
        "12.3681",
        "Fraction('365.242199') / Fraction('29.53059')",
        "12.3683, with 29.53059; the printed divisor lost a digit",
    )
    yield digits("Results 3, w17", "turns of link 17 per year, without sign", "12.3684", "abs(speed(17))")
    yield digits("Results 3, Price", "Price's ratio 236/19", "12.4210", "price_ratio()", "12.3684 = 235/19")
    yield words(
        "Results 4, wheel 9",
        "wheel 9 turns once in a lunar year",
        "counts_months(9, 12)",
        "link 19 does (235/228 turns per year)",
    )
    yield digits(
        "Results 4, actual",
        "365.242199/(29.53059*12)",
        "1.03068",
        "Fraction('365.242199') / (Fraction('29.53059') * 12)",
        "1.03069 (printed without rounding)",
    )
    yield digits("Results 4, w19", "turns of link 19 per year, without sign", "1.0307", "abs(speed(19))")
    yield exact("Results 5, wheel 8", "years in which it turns once", "4", "1 / speed(8)")
    yield words(
        "Results 5, alone",
        "wheel 8 is not engaged with any other",
        "mates()",
        "it meshes with links 7 and 9",
    )


def missing_parts() -> Iterator[Row]:
    """Table 6 and what it is for."""
    yield declared(exact("Missing parts, N", "teeth of wheel N", "64", "count('N', price())"))
    yield digits("Missing parts, speed of N", "turns per year", "0.25", "speed(8)")
    yield declared(exact("Footnote 2, months", "synodic months of a saros", "223", "months_of_saros()"))
    yield declared(digits("Footnote 2, days", "days of a saros", "6585.32", "period('saros_223_synodic_modern')"))
    yield words("Footnote 2, years", "18 years and about 11 days", "saros_of_years()")
    yield words("Fig. 4", "N drives O1; O2 on the same arbor drives X", "fig_4()")
    for planet, rows in {"venus": ("32 50 40", "31 52 43", "32 48 41"), "mars": ("30 50 57", "31 48 53"),
                         "jupiter": ("30 48 28", "32 53 29")}.items():  # fmt: skip
        for number, row in enumerate(rows, 1):
            given = ", ".join(row.split())
            wrong = "30 48 41" if row == "32 48 41" else ""
            yield Row(
                f"Table 6, {planet.capitalize()} {number}",
                "teeth of O1, O2, X that give the synodic period",
                row,
                call("misprint()" if wrong else f"missing('{planet}', {given})"),
                Found(),
                wrong,
            )
    yield outside(
        "Footnote 3",
        "the rows come from Farey series (Di Benedetto, Pennestri 1997)",
        "the cited paper is not among the sources;  `geartrain teeth train pennestri-2002-missing` finds all sets",
    )
    yield digits(
        "Missing parts, saros", "6585.32/(4*365.2422)", "4.5075", "Fraction('6585.32') / (4 * Fraction('365.2422'))"
    )
    yield words(
        "Missing parts, arrangement",
        "an arrangement like Fig. 4 could give the saros",
        "arrangement()",
        why="`geartrain teeth train pennestri-2002-missing`",
    )
    yield _OWN.outside(
        "Conclusion",
        "months more accurate than Price thought",
        "follows from 236/19, an erratum listed above; Price's train has the same speed",
        "price_months()",
    )


def sidereal() -> Finding:
    """Which month has 29.53058 days."""
    days = Fraction("29.53058")
    nearest = min(("month_synodic_J2000", "month_sidereal_J2000"), key=lambda name: abs(period(name) - days))
    return Finding(
        nearest == "month_sidereal_J2000", f"nearest: {nearest.removesuffix('_J2000').removeprefix('month_')} month"
    )


def pointers() -> Finding:
    """Links 3 and 5 against year and sidereal month."""
    sun = abs(speed(3))
    moon = abs(speed(5)) * period("month_sidereal_J2000") / period("year_tropical_J2000") - 1
    return Finding(
        sun == 1 and abs(moon) < Fraction(1, 10**4), f"1 turn per year; sidereal months to {1e6 * float(moon):.0f} ppm"
    )


def mates() -> Finding:
    """What meshes with the wheel of link 8."""
    found = [
        f"{each.j if each.i == '8' else each.i} ({each.id})" for each in paper().circuits if "8" in (each.i, each.j)
    ]
    return Finding(not found, f"it meshes with links {' and '.join(found)}")


def fig_4() -> Finding:
    """The speed of X in all rows of Table 6."""
    given = [(32, 50, 40), (31, 52, 43), (32, 48, 41), (30, 50, 57), (31, 48, 53), (30, 48, 28), (32, 53, 29)]
    same = all(turns(*row) == Fraction(16 * row[1], row[0] * row[2]) for row in given)
    return Finding(same, "X turns 16 O2/(O1 X) times a year, in all rows of Table 6")


def months_of_saros() -> Fraction:
    """The count of the shipped table."""
    return Fraction(period_table()["saros_synodic_months"].value)


def rows() -> tuple[Row, ...]:
    """All of them."""
    return tuple(
        row for part in (introduction, structure, speeds, years_and_months, results, missing_parts) for row in part()
    )


SOURCE = Source(
    "Pennestri",
    "E. Pennestri, P. P. Valentini, F. Petti, Kinematic analysis of the Antikythera gear mechanism by means of graph "
    "theory, ASME DETC2002/EDC-34379, 2002",
    "Speeds are in turns per year. Table 7 is compared by rows, because its columns are shifted in the copy.",
    rows(),
)
