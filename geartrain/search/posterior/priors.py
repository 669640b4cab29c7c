"""Which tooth counts a wheel may have, and how likely each is before the outputs are looked at."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from geartrain.errors import Problem, QuestionError, RangeError, suggest
from geartrain.numerics.exact import whole_multiple
from geartrain.numerics.results import Result
from geartrain.train import Teeth, Train
from geartrain.train.fields import MOST_TEETH

MOST_COUNTS = 10**5
"""Counts of one wheel; a doubt wider than this is no evidence."""


@dataclass(frozen=True, slots=True)
class ToothCountPrior(Result):
    """The counts one wheel may have, and their prior probabilities.

    Attributes
    ----------
    wheel : str
        Its id.
    counts : tuple of int
        Ascending, each once.
    weights : tuple of int
        In parallel to the counts: positive, without a common divisor; the prior probability is weight / `total`.
    declared : int or None
        The count the train declares.
    assumed : str
        Where the counts come from, in words; all are equally likely unless it says that they are weighted.
    """

    KEYS = ("wheel", "declared", "counts", "priors", "assumed")

    wheel: str
    counts: tuple[int, ...]
    weights: tuple[int, ...]
    declared: int | None
    assumed: str

    @property
    def total(self) -> int:
        """The sum of the weights."""
        return sum(self.weights)

    def weight(self, count: int) -> int:
        """The weight of one of its counts."""
        return self.weights[self.counts.index(count)]

    @property
    def priors(self) -> tuple[Fraction, ...]:
        """The chance of each count before the outputs are looked at; they sum to 1."""
        return tuple(Fraction(weight, self.total) for weight in self.weights)


def find_priors(train: Train, free: Mapping[str, Sequence[int]] | None = None) -> tuple[ToothCountPrior, ...]:
    """The priors of the wheels in doubt, in the order declared.

    free   wheel -> its counts, for wheels that are to have others than those declared; one count takes the doubt away

    A wheel with `range` or `choices` is in doubt with its `weights` (uniform where none are declared), one with
    `search` uniformly. Raises `QuestionError` for wheels the train does not have, for what is no tooth count, for
    weights that are no probabilities, and where no wheel is in doubt; `RangeError` for a doubt too wide to list.
    """
    given = dict(free or {})
    for name in given:
        if name not in train.wheels:
            fix = suggest(name, train.wheels)
            raise QuestionError(Problem(f"'{train.name}' has no wheel '{name}'", "it is not declared", fix))
    found = tuple(_all(train, given))
    if not any(len(doubt.counts) > 1 for doubt in found):
        why = "no wheel has `range` or `choices` with more than one count"
        fix = "declare `teeth: {value: 64, range: [63, 66]}`, or free a wheel: --free WHEEL=63:66"
        raise QuestionError(Problem(f"no wheel of '{train.name}' is in doubt", why, fix))
    return found


def _all(train: Train, given: Mapping[str, Sequence[int]]) -> Iterator[ToothCountPrior]:
    for name, (link, wheel) in train.wheels.items():
        place = train.place("links", link, "wheels", name)
        teeth = wheel.teeth if isinstance(wheel.teeth, Teeth) else Teeth(value=wheel.teeth)
        if name in given:
            counts = _checked(name, given[name])
            yield ToothCountPrior(name, counts, (1,) * len(counts), teeth.value, "asked")
        elif teeth.choices is not None or teeth.range is not None:
            yield _declared(name, teeth, place)
        elif teeth.search is not None:
            _check_width(name, len(teeth.searched), place)
            counts = tuple(teeth.chances)
            yield ToothCountPrior(name, counts, (1,) * len(counts), teeth.value, "search")


def _checked(name: str, counts: Sequence[int]) -> tuple[int, ...]:
    """Counts as asked for: some, and possible."""
    found = tuple(sorted(set(counts)))
    if not found:
        why = "a range ends before it begins, or nothing is listed"
        raise QuestionError(Problem(f"wheel '{name}' has no counts to choose from", why, "write the least count first"))
    for count in (found[0], found[-1]):
        if not 0 < count <= MOST_TEETH:
            fix = "a tooth count is a whole number from 1 to 10^12"
            raise QuestionError(Problem(f"{count} is not a tooth count", f"wheel '{name}' is to have it", fix))
    if len(found) > MOST_COUNTS:
        raise _too_wide(name, len(found), "")
    return found


def _check_width(name: str, count: int, place: str) -> None:
    if count > MOST_COUNTS:
        raise _too_wide(name, count, place)


def _declared(name: str, teeth: Teeth, place: str) -> ToothCountPrior:
    """A doubt as declared, with its weights; counts of weight 0 are left out."""
    if teeth.range is not None and teeth.choices is None:
        _check_width(name, teeth.range[1] - teeth.range[0] + 1, place)
    if why := teeth.fault_of_weights:
        what = f"the weights of wheel '{name}' are no chances"
        raise QuestionError(Problem(what, why, "give weights of 0 and more, one of them above 0", place))
    chances = teeth.chances
    kind = "choices" if teeth.choices is not None else "range"
    said = ", weighted" if teeth.weights is not None else ""
    source = f" ({teeth.source})" if teeth.source else ""
    return ToothCountPrior(
        name, tuple(chances), tuple(whole_multiple(chances.values())), teeth.value, f"{kind}{source}{said}"
    )


def _too_wide(name: str, count: int, place: str) -> RangeError:
    what = f"the doubt of wheel '{name}' is too wide"
    return RangeError(Problem(what, f"{count} counts, and at most {MOST_COUNTS} can be listed", "narrow it", place))
