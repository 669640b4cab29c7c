"""Speeds of a scene as exact rational functions of tooth counts, and the conditions under which they are valid."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from geartrain.numerics.results import Shown


@dataclass(frozen=True, slots=True)
class CountFormula(Shown):
    """A quotient of two polynomials in the tooth counts, with integer coefficients.

    See Also
    --------
    SceneFormulas : contains them.
    """

    wheels: Sequence[int]
    """Counts on which it depends, as indices of `SceneFormulas.wheels`.

    An index is repeated if equal planets share a count.
    """
    numerator: Sequence[tuple[str, Sequence[int]]]
    """Terms of the numerator: a coefficient as text, and exponents parallel to `wheels`, all 0 or more."""
    denominator: Sequence[tuple[str, Sequence[int]]]
    """Terms of the denominator, in the same form."""


@dataclass(frozen=True, slots=True)
class CountCondition(Shown):
    """A condition on tooth counts under which the formulas are valid.

    See Also
    --------
    SceneFormulas : contains them.
    """

    formula: CountFormula
    """Function of the counts."""
    zero: bool
    """True if the function must be 0, False if it must not be 0."""
    text: str
    """Statement of the condition."""
    carrier: int | None = None
    """Index of the body relative to which the wheels of a loop are observed; None for other conditions."""


@dataclass(frozen=True, slots=True)
class SceneFormulas(Shown):
    """All speeds of a scene, at the declared inputs and in the train's unit, as functions of tooth counts.

    See Also
    --------
    make_scene : returns it in `Scene.formulas`.
    """

    wheels: Sequence[str]
    """Names of the declared wheels whose counts may be changed."""
    count: Sequence[int | None]
    """Index in `wheels` of the count of each wheel of the scene; None if it has none."""
    formulas: Sequence[CountFormula]
    """Functions, without duplicates."""
    bodies: Sequence[int | None]
    """Index of the function of each body of the scene; None if its speed is not determined."""
    pointers: Sequence[int | None]
    """Index of the function of each pointer of the scene; None if its speed is not determined."""
    conditions: Sequence[CountCondition]
    """Conditions of validity. If one is violated, these functions do not describe the motion."""
    input: str
    """Exact speed of the driving link."""
    exact: bool
    """False if speeds are displayed as decimals."""
    parent: str
    """Name of the shipped train, or of the file, that a declaration of the changed train extends."""
