"""Limits and fits of ISO 286-1, for the diameters that arbors have: the tables are those of the standard.

Hole basis: H is a hole whose least diameter is the nominal one, small letters are shafts. The number is the grade.
"""

from __future__ import annotations

from geartrain.errors import Problem, QuestionError

_STEPS = (3, 6, 10, 18, 30, 50)  # mm: a row holds for nominal diameters up to it, from 1 or the row before
_LIMITS = {  # least and greatest deviation (um) in each step
    "H7": ((0, 10), (0, 12), (0, 15), (0, 18), (0, 21), (0, 25)),
    "f7": ((-16, -6), (-22, -10), (-28, -13), (-34, -16), (-41, -20), (-50, -25)),
    "g6": ((-8, -2), (-12, -4), (-14, -5), (-17, -6), (-20, -7), (-25, -9)),
    "h6": ((-6, 0), (-8, 0), (-9, 0), (-11, 0), (-13, 0), (-16, 0)),
    "p6": ((6, 12), (12, 20), (15, 24), (18, 29), (22, 35), (26, 42)),
    "s6": ((14, 20), (19, 27), (23, 32), (28, 39), (35, 48), (43, 59)),
}


def limits(nominal: float, zone: str) -> tuple[int, int]:
    """Least and greatest deviation (um) of a diameter (mm) in a tolerance zone.

    Raises `QuestionError` for a zone or a diameter that the table does not hold.

    Examples
    --------
    >>> limits(3.0, "g6")
    (-8, -2)
    """
    if zone not in _LIMITS:
        raise QuestionError(Problem(f"no tolerance zone '{zone}'", "", f"use some of {', '.join(_LIMITS)}"))
    if not 1 <= nominal <= _STEPS[-1]:
        why = f"the table of fits goes from 1 to {_STEPS[-1]} mm"
        raise QuestionError(Problem(f"no limits for a diameter of {nominal:g} mm", why, "give the sizes by hand"))
    return _LIMITS[zone][next(at for at, step in enumerate(_STEPS) if nominal <= step)]


def clearance(nominal: float, fit: str) -> tuple[int, int]:
    """Least and greatest diametral clearance (um) of a fit such as H7/g6; negative is press.

    Examples
    --------
    >>> clearance(3.0, "H7/p6")
    (-12, 4)
    """
    hole, _, shaft = fit.partition("/")
    (low, high), (least, most) = limits(nominal, hole), limits(nominal, shaft)
    return low - most, high - least
