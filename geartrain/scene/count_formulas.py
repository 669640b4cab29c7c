"""Speeds of a scene as exact rational functions of tooth counts, and the conditions under which they are valid."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from geartrain.numerics.results import Shown


@dataclass(frozen=True, slots=True)
class CountFormula(Shown):
    """Ratio of two polynomials in the tooth counts, with integer coefficients, for one speed or one condition."""

    wheels: Sequence[int]
    """Indices in `SceneFormulas.wheels` of the counts in the formula, repeated for equal planets that share a count."""
    numerator: Sequence[tuple[str, Sequence[int]]]
    """Terms of the numerator, each as a coefficient (a string) and the power of each entry of `wheels`, 0 or more."""
    denominator: Sequence[tuple[str, Sequence[int]]]
    """Terms of the denominator, in the same form as the terms of the numerator."""


@dataclass(frozen=True, slots=True)
class CountCondition(Shown):
    """Condition on tooth counts under which the formulas of a scene are valid."""

    formula: CountFormula
    """Function of the tooth counts that must be 0, or must not be 0."""
    zero: bool
    """True if the value of `formula` must be 0, False if it must not be 0."""
    text: str
    """Description of the condition, such as `loop a - b - c closes`."""
    carrier: int | None = None
    """Index of the body relative to which the wheels of a loop turn; None if the condition does not concern a loop."""


@dataclass(frozen=True, slots=True)
class SceneFormulas(Shown):
    """Speeds of a scene as functions of tooth counts, at the declared inputs and in the train's unit."""

    wheels: Sequence[str]
    """Names of the declared wheels whose counts may be changed."""
    count: Sequence[int | None]
    """Index in `wheels` of the tooth count of each wheel of the scene; None if the count is not in `wheels`."""
    formulas: Sequence[CountFormula]
    """Distinct functions of the tooth counts, to which `bodies` and `pointers` refer."""
    bodies: Sequence[int | None]
    """Index in `formulas` of the speed of each body of the scene; None if the speed is not determined."""
    pointers: Sequence[int | None]
    """Index in `formulas` of the speed of each pointer of the scene; None if the speed is not determined."""
    conditions: Sequence[CountCondition]
    """Conditions of validity. If one is violated, the formulas do not describe the motion."""
    input: str
    """Exact declared speed of the driving link, in the train's unit."""
    exact: bool
    """True if speeds are displayed as fractions, False if as decimals."""
    parent: str
    """Name of the bundled example, or of the file, that the declaration of a train with changed counts extends."""
