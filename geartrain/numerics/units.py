"""Units of measure: what dimension each has, and how many base units it is, exactly.

Base units are m, turn, s, turn/s, m/s, N m, kg m2, kg, kg/m3, Pa, N m/rad, N/m, N m s/rad, N s/m and 1. A radian is no
rational part of a turn: its scale holds to 50 digits, and what is for each radian is kept so.
"""

from __future__ import annotations

from fractions import Fraction

from geartrain.errors import nearest_names

TURN = "turn"
RADIANS_PER_TURN = 6.283185307179586

# unit -> (dimension, how many base units one of it is); every scale is exact
UNITS: dict[str, tuple[str, Fraction]] = {
    "m": ("length", Fraction(1)),
    "cm": ("length", Fraction(1, 100)),
    "mm": ("length", Fraction(1, 1000)),
    "um": ("length", Fraction(1, 10**6)),
    "in": ("length", Fraction(254, 10**4)),
    "ft": ("length", Fraction(3048, 10**4)),
    "km": ("length", Fraction(1000)),
    "mile": ("length", Fraction(1609344, 1000)),
    "turn": ("angle", Fraction(1)),
    "deg": ("angle", Fraction(1, 360)),
    "arcmin": ("angle", Fraction(1, 21600)),
    "arcsec": ("angle", Fraction(1, 1296000)),
    "s": ("time", Fraction(1)),
    "min": ("time", Fraction(60)),
    "h": ("time", Fraction(3600)),
    "d": ("time", Fraction(86400)),
    "rpm": ("speed", Fraction(1, 60)),
    "turn/s": ("speed", Fraction(1)),
    "turn/min": ("speed", Fraction(1, 60)),
    "turn/h": ("speed", Fraction(1, 3600)),
    "turn/d": ("speed", Fraction(1, 86400)),
    "deg/s": ("speed", Fraction(1, 360)),
    "m/s": ("velocity", Fraction(1)),
    "mm/s": ("velocity", Fraction(1, 1000)),
    "ft/min": ("velocity", Fraction(3048, 10**4) / 60),
    "in/s": ("velocity", Fraction(254, 10**4)),
    "N m": ("torque", Fraction(1)),
    "N mm": ("torque", Fraction(1, 1000)),
    "kN m": ("torque", Fraction(1000)),
    "kg m2": ("inertia", Fraction(1)),
    "kg mm2": ("inertia", Fraction(1, 10**6)),
    "g mm2": ("inertia", Fraction(1, 10**9)),
    "g cm2": ("inertia", Fraction(1, 10**7)),
    "kg": ("mass", Fraction(1)),
    "g": ("mass", Fraction(1, 1000)),
    "Pa": ("pressure", Fraction(1)),
    "MPa": ("pressure", Fraction(10**6)),
    "GPa": ("pressure", Fraction(10**9)),
    "kg/m3": ("density", Fraction(1)),
    "g/cm3": ("density", Fraction(1000)),
    "N m/rad": ("torsional stiffness", Fraction(1)),
    "N mm/rad": ("torsional stiffness", Fraction(1, 1000)),
    "N/m": ("stiffness", Fraction(1)),
    "N/mm": ("stiffness", Fraction(1000)),
    "N/um": ("stiffness", Fraction(10**6)),
    "N m s/rad": ("torsional damping", Fraction(1)),
    "N mm s/rad": ("torsional damping", Fraction(1, 1000)),
    "N s/m": ("damping", Fraction(1)),
    "N s/mm": ("damping", Fraction(1000)),
    "%": ("fraction", Fraction(1, 100)),
    "ppm": ("fraction", Fraction(1, 10**6)),
}
# a radian is no rational part of a turn: these two scales hold to 50 digits, and say so by being apart
_TURNS_PER_RADIAN = 1 / (2 * Fraction("3.14159265358979323846264338327950288419716939937511"))
IRRATIONAL: dict[str, tuple[str, Fraction]] = {
    "rad": ("angle", _TURNS_PER_RADIAN),
    "rad/s": ("speed", _TURNS_PER_RADIAN),
}
_EXACT = Fraction(0), Fraction("1e300")
_FLOATS = Fraction(1, 10**30), Fraction(10**30)  # up to the tenth power such a measure is a float
_SIZES = Fraction(1, 10**12), Fraction(10**6)  # of bodies, in m or as plain numbers: what can be laid out and drawn
_BOUNDS = {"length": _SIZES, "length or fraction": (_FLOATS[0], _SIZES[1])} | {
    dimension: _FLOATS
    for one, other in (("torsional stiffness", "stiffness"), ("torsional damping", "damping"))
    for dimension in ("angle", "velocity", "inertia", "mass", "density", "pressure", one, f"{one} or {other}")
}
SPELT = {
    "Nm": "N m",
    "N*m": "N m",
    "N·m": "N m",
    "Nmm": "N mm",
    "°": "deg",
    "µm": "um",
    "μm": "um",
    "feet": "ft",
    "day": "d",
    "days": "d",
    "turns": "turn",
    "rev": "turn",
    "rev/s": "turn/s",
    "rev/min": "rpm",
    "kg m^2": "kg m2",
    "g mm^2": "g mm2",
    "kg*m^2": "kg m2",
    "kg/m^3": "kg/m3",
    "g/cm^3": "g/cm3",
    "Nm/rad": "N m/rad",
    "Nmm/rad": "N mm/rad",
    "N/mm2": "MPa",
    "N/mm^2": "MPa",
    "N/µm": "N/um",
    "N/μm": "N/um",
    "Nms/rad": "N m s/rad",
}


def scale(unit: str) -> tuple[str, Fraction]:
    """The dimension of a unit, and how many base units one of it is."""
    return UNITS.get(unit) or IRRATIONAL[unit]


def turns_in(unit: str) -> Fraction:
    """Turns in one unit of time at a speed of 1: 1/360 for deg/s, 1 for rpm and for plain numbers."""
    angle = unit.partition("/")[0] if "/" in unit else TURN
    return scale(angle)[1]


def same_kind(first: str | None, second: str | None) -> bool:
    """True if one unit is a rational multiple of the other: a radian of no unit but a radian."""
    return (first in IRRATIONAL) == (second in IRRATIONAL)


def nearest_unit(unit: str, dimension: str) -> str:
    """What may be meant by an unknown unit: `rpm` for RPM."""
    known = units_of(dimension)
    spelt = {name.casefold(): name for name, meant in SPELT.items() if meant in known.split(", ")}
    names = spelt | {name.casefold(): name for name in known.split(", ")}
    close = nearest_names(unit.casefold(), names)
    return f"did you mean '{names[close[0]]}'? Known here: {known}" if close else f"use one of: {known}"


def units_of(dimension: str) -> str:
    """All units of a dimension, or of several joined by `or`, for a reader."""
    known = [*UNITS.items(), *IRRATIONAL.items()]
    return ", ".join(unit for unit, (kind, _) in known if kind in dimension.split(" or "))


def base_unit(dimension: str) -> str:
    """The unit in which quantities of a dimension are counted.

    >>> base_unit("length"), base_unit("angle")
    ('m', 'turn')
    """
    return next(unit for unit, (kind, factor) in UNITS.items() if kind == dimension and factor == 1)


def bounds_of(dimension: str) -> tuple[Fraction, Fraction]:
    """Least and greatest magnitude of a quantity other than 0, in base units; "time or length" allows both.

    Sizes of bodies have the narrowest, all that is computed with in floats narrow ones.
    """
    return _BOUNDS.get(dimension, _EXACT)
