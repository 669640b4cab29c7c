"""Closure of loops by fractions against closure by floats."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from math import lcm
from statistics import median

import numpy as np
from numpy.typing import NDArray

from geartrain.spherical import from_polyhedron
from geartrain.spherical.assembly import closes, loop_rules, residue
from studies.measurement import timed
from studies.sphere_records import TOLERANCE, ClosureRecord

Whole = NDArray[np.int64]
Rule = Sequence[Fraction | float]
FRACTIONS, ROUNDED, FROM_AXES = "fractions", "floats of the fractions", "floats from the axes"


def closed(solid: str, power: int, draws: int) -> list[ClosureRecord]:
    """The loop of a solid with gears on all faces: by fractions, by these in floats, and by the axes in floats."""
    configuration = from_polyhedron(solid)
    (exact,) = loop_rules(configuration)
    shares = [Fraction(share) for share in exact]
    teeth = draw_teeth(shares, power, draws)
    truth = [true_residue(z, shares) for z in zip(*(each.tolist() for each in teeth), strict=True)]
    loose = loop_rules(replace(configuration, regular=(0,) * len(configuration.axes)))[0]
    rules: dict[str, Rule] = {FRACTIONS: exact, ROUNDED: [float(share) for share in shares], FROM_AXES: loose}
    return [_by_rule(solid, method, power, teeth, rule, truth) for method, rule in rules.items()]


def draw_teeth(shares: Sequence[Fraction], power: int, draws: int) -> list[Whole]:
    """Random teeth of each kind with power + 1 digits, of which half close the loop and half do not."""
    whole = lcm(*(share.denominator for share in shares))
    many = (len(shares), 4 * whole * draws)  # one in `whole` closes
    teeth = np.random.default_rng(power).integers(10**power, 10 ** (power + 1), many)
    parts = np.array([int(share * whole) for share in shares])
    closed = (parts @ (teeth % whole)) % whole == 0
    taken = [np.flatnonzero(each)[: draws // 2] for each in (closed, ~closed)]
    return list(teeth[:, np.concatenate(taken)])


def true_residue(teeth: Sequence[int], shares: Sequence[Fraction]) -> Fraction:
    """What a loop misses by, in whole numbers without bound (pitches)."""
    total = sum((z * share for z, share in zip(teeth, shares, strict=True)), Fraction(0))
    return total - round(total)


def _by_rule(
    solid: str, method: str, power: int, teeth: Sequence[Whole], rule: Rule, truth: Sequence[Fraction]
) -> ClosureRecord:
    closed = np.array([not each for each in truth])
    said = closes(teeth, rule, TOLERANCE)
    seconds = median(timed(lambda: closes(teeth, rule, TOLERANCE))[0] for _ in range(9))
    error = 0.0
    if method != FRACTIONS:
        near = [Fraction(float(each)) for each in residue(teeth, rule)]
        error = max(float(_apart(a, b)) for a, b in zip(near, truth, strict=True))
    wrong = int((said != closed).sum())
    return ClosureRecord(solid, method, power, len(truth), error, wrong, seconds / len(truth))


def _apart(a: Fraction, b: Fraction) -> Fraction:
    off = a - b
    return abs(off - round(off))
