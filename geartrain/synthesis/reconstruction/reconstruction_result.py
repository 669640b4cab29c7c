"""What a reconstruction finds: exact counts, and the candidates in their order."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from geartrain.numerics.plain_data import Key, Result
from geartrain.synthesis.reconstruction.reconstruction_problem import Arbor
from geartrain.synthesis.reconstruction.skeleton_tasks import CountedSkeleton


@dataclass(frozen=True, slots=True)
class ExplanationCount(Result):
    """How many explanations there are with just so many added wheels.

    Attributes
    ----------
    added : int
        Added wheels.
    mechanisms : int
        Trains, all different.
    bags : int or None
        Trains that differ by more than the order of arbors on the path of a dial; None where they are too many.
    classes : int or None
        Trains that differ by more than which wheel drives which on the path of a dial; None likewise.
    """

    added: int
    mechanisms: int
    bags: int | None
    classes: int | None


@dataclass(frozen=True, slots=True)
class Candidate(Result):
    """One explanation.

    Attributes
    ----------
    arbor : Arbor
        The train from its input on.
    added : int
        Added wheels.
    weight : float
        Its share of the weight of all explanations.
    ranks : tuple of int
        First and last rank by weight that it may have among all explanations, from 1 on; some may weigh the same.
    """

    KEYS = ("added", Key("weight", to=float), "ranks")

    arbor: Arbor
    added: int
    weight: float
    ranks: tuple[int, int]


@dataclass(frozen=True, slots=True)
class WeightClass(Result):
    """Explanations of one weight.

    Attributes
    ----------
    added : int
        Added wheels of each.
    weight : Fraction
        What each weighs before its dials are looked at, up to a factor that all share.
    mechanisms : int
        How many they are.
    """

    added: int
    weight: Fraction
    mechanisms: int


@dataclass(frozen=True, slots=True)
class Reconstructions(Result):
    """All explanations of a question, counted, and the best of them.

    Attributes
    ----------
    counts : tuple of ExplanationCount
        By number of added wheels, from 0 on.
    complete : bool
        Whether all were looked at.
    candidates : tuple of Candidate
        The best first.
    skeletons : tuple of CountedSkeleton
        All structures with the numbers of their trains, where each train weighs as its structure; else none.
    weights : tuple of WeightClass
        All trains by number of added wheels and weight, the greatest first; none where each is weighed by itself.
    """

    KEYS = ("counts", "complete", "candidates")

    counts: tuple[ExplanationCount, ...]
    complete: bool
    candidates: tuple[Candidate, ...]
    skeletons: tuple[CountedSkeleton, ...] = ()
    weights: tuple[WeightClass, ...] = ()
