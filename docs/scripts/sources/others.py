"""Errata and checks of the other publications from which shipped trains are declared."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import lru_cache
from math import asin, degrees

import geartrain
from geartrain import GearTrain
from geartrain.train import period_table
from sources.row import Finding, Row, Source, Statements

_OWN = Statements(globals())
exact, digits, words = _OWN.exact, _OWN.digits, _OWN.words
load = lru_cache(maxsize=None)(geartrain.load)


def changed(parent: str, change: str, drop: Sequence[str] = ()) -> GearTrain:
    """Return a shipped train with changed lines, without the outputs in `drop`."""
    outputs = f"remove: {{outputs: [{', '.join(drop)}]}}\n" if drop else ""
    return geartrain.load(f"extends: {parent}\n{outputs}{change}\n")


def period(name: str) -> Fraction:
    """Return a period of the shipped table (days)."""
    return Fraction(period_table()[name].value)


def count(train: str, wheel: str) -> int:
    """Return the tooth count of a wheel."""
    teeth = load(train).declaration.wheels[wheel][1].count
    assert teeth is not None
    return teeth


def amplitude(radius: float) -> float:
    """Return the anomaly of the Moon's pin (deg) with the declared offset."""
    pin = next(each for each in load("freeth-2008").declaration.pin_couplings if each.name == "anomaly")
    assert pin.offset is not None
    return degrees(asin(float(pin.offset.value) / radius))


def declared_radius() -> float:
    """Return the declared radius of the Moon's pin (mm)."""
    pin = next(each for each in load("freeth-2008").declaration.pin_couplings if each.name == "anomaly")
    assert pin.pin_radius is not None
    return float(str(pin.pin_radius).split()[0])


def apsides(anomalistic: int, synodic: int) -> Finding:
    """Return the period of the apsides by a relation, compared with the modern one."""
    turns = Fraction(254, 19) - Fraction(235, 19) * Fraction(anomalistic, synodic)
    modern = period("year_tropical_J2000") / period("lunar_apsides_period_tropical_J2000")
    error = float(turns / modern - 1)
    return Finding(abs(error) < 0.005, f"{turns} turns per year, speed error {100 * error:+.3f} %")


def pairs_of_wheels() -> Finding:
    """Compare the equal pairs of Mars and Jupiter in the table and in the diagram."""
    first, second = load("freeth-jones-2012"), load("freeth-jones-2012-shambaugh")
    table = [count("freeth-jones-2012", name) for name in ("ma70s", "ju85s")]
    diagram = [count("freeth-jones-2012-shambaugh", name) for name in ("ma69s", "ju86s")]
    assert all(first.solve()[planet] == second.solve()[planet] for planet in ("mars", "jupiter", "saturn"))
    return Finding(table == diagram, f"table {table}, diagram {diagram}; all speeds are equal")


def mercury() -> Finding:
    """Return the epicycle of Mercury with the last wheel of the caption."""
    train = load("freeth-2021")
    drop = [name for name in ("mercury epicycle", "me20", "mercury rel") if name in train.declaration.outputs]
    change = "links: {me20: {wheels: {me20: 24}}}\noutputs: {epicycle: {of: me20, relative_to: b}}"
    right, wrong = train.solve()["mercury epicycle"], changed("freeth-2021", change, drop).solve()["epicycle"]
    text = f"24 teeth give {wrong} turns of the epicycle per year, 20 teeth {right}; the period relation is 1513/480"
    return Finding(wrong == Fraction(1513, 480), text)


def idler() -> Finding:
    """Return the ratio of the train to Mars with the fourth and with the fifth wheel."""
    names = ("x56", "cp64", "cp38", "ma40", "ma71")
    g1, g2, g3, g4, g5 = (count("freeth-2021", name) for name in names)
    printed, right = Fraction(g1 * g3, g2 * g4), Fraction(g1 * g3, g2 * g5)
    return Finding(printed == Fraction(133, 284), f"Mars: with g4 {printed}, with g5 {right}; the relation is 133/284")


def surviving() -> Finding:
    """Count the wheels behind and including a1 and b1."""
    wheels = load("freeth-2008").declaration.wheels.values()
    first, second = (sum(wheel.status == kind for _, wheel in wheels) for kind in ("surviving", "reconstructed"))
    return Finding(first == 29, f"{first} surviving and {second} reconstructed wheels are listed")


def numerals() -> Finding:
    """Return the periods of Venus and Saturn of the train."""
    solved = load("freeth-2021").solve()
    periods = [Fraction(solved[name]).denominator for name in ("venus epicycle", "saturn anomaly")]
    return Finding(periods == [762, 742], f"the wheels for Venus and Saturn give {periods[0]} and {periods[1]}")


def jupiter() -> Finding:
    """Compare three relations for Jupiter with the synodic period."""
    wanted = period("year_tropical_J2000") / period("jupiter_synodic_period_jpl")
    errors = {f"{a}/{b}": 1e6 * float(Fraction(a, b) / wanted - 1) for a, b in ((315, 344), (847, 925), (1162, 1269))}
    best = min(errors, key=lambda name: abs(errors[name]))
    return Finding(best == "315/344", ", ".join(f"{name} {error:+.1f} ppm" for name, error in errors.items()))


def draconic(teeth: int) -> float:
    """Return the error of the draconic pointer (ppm) with a tooth count of b1."""
    change = f"links: {{b: {{wheels: {{b1: {{teeth: {teeth}}}}}}}}}\noutputs: {{pointer: {{of: s}}}}"
    drop = [] if teeth == 225 else ["crank", "draconic"]
    speed = abs(Fraction(changed("voulgaris-2022", change, drop).solve()["pointer"]))
    return 1e6 * float(speed / Fraction(56870, 4237) - 1)


def needs_225() -> Finding:
    """Return the errors of the draconic pointer for three counts of b1."""
    errors = {teeth: draconic(teeth) for teeth in (223, 224, 225)}
    return Finding(abs(errors[225]) < 100, ", ".join(f"{teeth}: {error:+.0f} ppm" for teeth, error in errors.items()))


def days_per_turn(teeth: int) -> float:
    """Return the days of one turn of Price's crank."""
    change = f"links: {{crank: {{wheels: {{A: {{teeth: {teeth}}}}}}}}}\noutputs: {{handle: {{of: crank}}}}"
    speed = abs(Fraction(changed("price-1974", change, [] if teeth == 45 else ["crank"]).solve()["handle"]))
    return float(period("year_tropical_J2000") / speed)


def wheel_a() -> Finding:
    """Compare the turn of Price's crank for both readings of its wheel."""
    days = {teeth: days_per_turn(teeth) for teeth in (45, 48)}
    return Finding(round(days[45]) == 73, ", ".join(f"{teeth}: {each:.1f} d per turn" for teeth, each in days.items()))


def mercury_of_huygens() -> Finding:
    """Compare Mercury's train with and without the first pair."""
    sky = period("year_sidereal_J2000") / period("mercury_sidereal_period_jpl")
    single = Fraction(count("huygens-planetarium-1682", "me121"), count("huygens-planetarium-1682", "me17"))
    train = Fraction(load("huygens-planetarium-1682").solve()["mercury"])
    text = f"{float(single):.4f} turns per year, with 7/12 {float(train):.4f}; the modern value is {float(sky):.4f}"
    return Finding(abs(single / sky - 1) < Fraction(1, 1000), text)


def saturn_of_huygens() -> Finding:
    """Compare 206/7 with the fraction of Huygens and with the modern period."""
    years = 1 / abs(Fraction(load("huygens-planetarium-1682").solve()["saturn"]))
    own = float(years / Fraction(77708431, 2640858) - 1)
    sky = float(years / (period("saturn_sidereal_period_jpl") / period("year_sidereal_J2000")) - 1)
    return Finding(abs(own) < 2e-4, f"error {1e6 * own:+.1f} ppm; relative to the modern period {1e6 * sky:+.1f} ppm")


def month_of_gosper() -> Finding:
    """Compare the month of the published wheels with the mean synodic month."""
    days = Fraction(293 * 149 * 157, 12 * 83 * 233)
    error = float(days / period("month_synodic_J2000") - 1)
    return Finding(abs(error) < 1e-6, f"{float(days):.9f} d, error {1e6 * error:+.0f} ppm")


def rows() -> Iterator[Row]:
    """Yield all rows."""
    place = "Freeth et al. 2006, Moon"
    claim = "anomaly asin(e/r) of the pin (deg), e = 1.1 mm"
    yield digits(place, claim, "6.5", "amplitude(declared_radius())", "6.58 for r = 9.6 mm")
    yield words("Freeth et al. 2006, apsides", "239 anomalistic months are 223 synodic months", "apsides(239, 223)")
    claim = "equal pairs of Mars and Jupiter"
    yield words("Freeth and Jones 2012", claim, "pairs_of_wheels()", "table and diagram differ")
    place = "Freeth et al. 2021"
    yield words(f"{place}, Fig. S22e", "Mercury's train ends with the pair 40 ~ 24", "mercury()", "40 ~ 20")
    yield words(f"{place}, S4", "ratio (g1 g3)/(g2 g4)", "idler()", "(g1 g3)/(g2 g5)")
    claim = "29 wheels behind and including a1 and b1"
    yield words(f"{place}, 6.3", claim, "surviving()", "28, because 28 + 7 + 34 = 69")
    claim = "periods of 762 and 742 years (Psi for Upsilon)"
    yield words(f"{place}, numerals", claim, "numerals()", "462 and 442 (Author Correction, August 2021)")
    yield exact(f"{place}, total", "number of wheels", "69", "len(load('freeth-2021').declaration.wheels)")
    claim = "the period relation is 315/344"
    yield words(f"{place}, Jupiter", claim, "jupiter()", "two other admissible relations are closer")
    yield words("Voulgaris et al. 2022", "the draconic pointer needs 225 teeth for b1", "needs_225()")
    yield digits("Price 1974", "days per turn of the crank", "73", "days_per_turn(45)")
    yield words("Price 1974, wheel A", "45 teeth, also read as 48", "wheel_a()")
    yield words(
        "Dietzschold p. 307, Mercury", "121 drives 17", "mercury_of_huygens()", "7 drives 12, and 121 drives 17"
    )
    yield words("Dietzschold, Saturn", "206/7 approximates 77708431/2640858", "saturn_of_huygens()")
    claim = "month of 293/12 x 149/83 x 157/233"
    yield words("Gosper 2005, Moon", claim, "month_of_gosper()", "237/389 x 28/211 from the arbor of the Earth")
    claim = "month requested (days)"
    yield digits("Gosper 2005, request", claim, "29.53058853", "period('month_synodic_J2000')", "29.530588853")


SOURCE = Source(
    "Other publications",
    "Shipped trains not based on the four sources above are based on the publications in these tables",
    "`geartrain report TRAIN` lists the errata of a train with their reasons. Statements on whether the Antikythera "
    "mechanism worked are tested in [could it have worked?](study.md).",
    tuple(rows()),
)
