"""Speeds of a scene as exact functions of tooth counts: quotients of sums of products, and what must hold for them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from geartrain.numerics.results import Shown


@dataclass(frozen=True, slots=True)
class CountFormula(Shown):
    """A quotient of two sums of products of counts; coefficients are whole.

    See Also
    --------
    SceneFormulas : holds them
    """

    wheels: Sequence[int]
    """The counts it depends on, as indices of `SceneFormulas.wheels`; one twice where equal planets have it."""
    numerator: Sequence[tuple[str, Sequence[int]]]
    """Terms of the numerator: a coefficient as text, and powers parallel to `wheels`, all 0 or more."""
    denominator: Sequence[tuple[str, Sequence[int]]]
    """Terms of the denominator, likewise."""


@dataclass(frozen=True, slots=True)
class CountCondition(Shown):
    """What counts must not break for the formulas to hold.

    See Also
    --------
    SceneFormulas : holds them
    """

    formula: CountFormula
    """A function of the counts."""
    zero: bool
    """True where it must be 0, False where it must not."""
    text: str
    """What it states."""
    carrier: int | None = None
    """Of a loop, the body from which its wheels are seen."""


@dataclass(frozen=True, slots=True)
class SceneFormulas(Shown):
    """All speeds of a scene, at the declared inputs and in the train's unit, as functions of tooth counts.

    See Also
    --------
    make_scene : gives it, in `Scene.formulas`.
    """

    wheels: Sequence[str]
    """Names of the declared wheels whose counts may change."""
    count: Sequence[int | None]
    """For each wheel of the scene the index of its count in `wheels`; None where it has none."""
    formulas: Sequence[CountFormula]
    """Functions, each once."""
    bodies: Sequence[int | None]
    """Index of the function of each body of the scene; None where nothing determines it."""
    pointers: Sequence[int | None]
    """Index of the function of each pointer of the scene; None where nothing determines it."""
    conditions: Sequence[CountCondition]
    """Where one is broken, the train does not turn by these functions."""
    input: str
    """Speed of the lead, exact."""
    exact: bool
    """False where speeds are told in decimal."""
    parent: str
    """What a declaration of the changed train extends: the name of a shipped train, or of a file."""
