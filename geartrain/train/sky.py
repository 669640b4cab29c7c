"""Mean angles of the Sun, the Moon and the planets, to which outputs can be set (data in `mean_elements.csv`).

Longitudes are geocentric and counted from the mean equinox of the date. Each angle is a polynomial of the time in
Julian centuries of Terrestrial Time since J2000.0. The anomaly of a planet is its angle on its epicycle, measured from
the direction away from the Earth; the anomaly of the Moon is measured from the perigee.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import cache
from importlib import resources
from itertools import zip_longest
from types import MappingProxyType

from geartrain.errors import suggest

Polynomial = Sequence[float]
"""Coefficients of a polynomial, in ascending order of powers."""

_J2000 = 2451545
_DELTA_T = 2385800.5  # Julian day of 1820-01-01 at midnight
_CENTURY = 36525  # days
_TERM = re.compile(r"\s*([+-]?)\s*(?:(\d+(?:\.\d+)?)\s*deg|([a-z_]+))\s*")


@cache
def mean_elements() -> Mapping[str, Mapping[str, Polynomial]]:
    """Return the mean orbital elements of the Earth, the Moon and the planets: body -> quantity -> polynomial.

    Angles (longitudes, perihelia, perigee and node) are in degrees, and semi-major axes in astronomical units.
    """
    text = resources.files(__package__).joinpath("mean_elements.csv").read_text(encoding="utf-8")
    rows: dict[str, dict[str, Polynomial]] = {}
    for row in csv.DictReader(text.splitlines()):
        found = tuple(float(Fraction(row[f"c{power}"])) for power in range(5) if row[f"c{power}"])
        rows.setdefault(row["body"], {})[row["quantity"]] = found
    return MappingProxyType(rows)


@cache
def sky_angles() -> Mapping[str, Polynomial]:
    """Return the angles [deg] to which an output can be set, by name."""
    rows = mean_elements()
    moon, sun = rows["moon"], _sum((1, rows["earth"]["longitude"]), (1, (180.0,)))
    found = {"sun": sun, "moon": moon["longitude"], "moon_node": moon["node"], "moon_perigee": moon["perigee"]}
    found["moon_anomaly"] = _sum((1, moon["longitude"]), (-1, moon["perigee"]))
    for planet in ("mercury", "venus"):
        # the centre of the epicycle of an inferior planet is the mean Sun
        found[planet] = sun
        found[f"{planet}_anomaly"] = _sum((1, rows[planet]["longitude"]), (-1, sun))
    for planet in ("mars", "jupiter", "saturn"):
        found[planet] = rows[planet]["longitude"]
        found[f"{planet}_anomaly"] = _sum((1, sun), (-1, rows[planet]["longitude"]))
    return MappingProxyType(found)


def _sum(*terms: tuple[int, Polynomial]) -> Polynomial:
    scaled = [[sign * each for each in polynomial] for sign, polynomial in terms]
    return tuple(sum(column) for column in zip_longest(*scaled, fillvalue=0.0))


def angle_at(polynomial: Polynomial, julian_day: float) -> float:
    """Return the value of a polynomial in degrees, as an angle [turn], at a Julian day in Universal Time.

    Terrestrial Time is ahead of Universal Time by 32 t^2 - 20 seconds, where t is the time since 1820 in centuries
    (Morrison and Stephenson 2004, Journal for the History of Astronomy 35:327-336).
    """
    t = (julian_day - _DELTA_T) / _CENTURY
    time = (julian_day + (32 * t * t - 20) / 86400 - _J2000) / _CENTURY
    return sum(each * time**power for power, each in enumerate(polynomial)) / 360


def read_sky_angle(text: str) -> tuple[Polynomial, str]:
    """Parse an angle such as `sun`, `moon - sun`, `mars_anomaly + 180 deg` or `33.1 deg`.

    Returns the polynomial of the angle [deg], and the body whose longitude the angle is (empty for any other angle).
    Raises `ValueError` with a description of the problem and a fix if the text is not a sum of angles.
    """
    terms, names, end = list[tuple[int, Polynomial]](), list[str](), 0
    while (found := _TERM.match(text, end)) and (found[1] or not terms):
        sign, constant, name = found.groups()
        if name and name not in sky_angles():
            raise ValueError(f"'{name}' is not an angle of the sky", suggest(name, sky_angles(), wide=True))
        terms.append((-1 if sign == "-" else 1, sky_angles()[name] if name else (float(constant),)))
        names.append(name or "")
        end = found.end()
    if not terms or end < len(text):
        raise ValueError(f"'{text[:40]}' is not an angle", "write sun, moon - sun, mars_anomaly + 180 deg or 33.1 deg")
    single = len(terms) == 1 and terms[0][0] > 0 and not names[0].endswith(("_anomaly", "_perigee"))
    return _sum(*terms), names[0] if single else ""
