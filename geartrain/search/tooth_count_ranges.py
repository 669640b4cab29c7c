"""Admissible tooth counts of a wheel, such as "15:120", "30,36,48" or "12:40,48,60", stored as runs of integers."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import chain
from numbers import Integral
from typing import TYPE_CHECKING, Any, overload

from geartrain.errors import Problem, QuestionError, RangeError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

Counts = Sequence[int]
"""Admissible tooth counts: a tuple, a range or `CountRuns`. They are distinct, in ascending order, and from 1 to
10^12.
"""

MOST_TEETH = 10**12
_MOST_LISTED = 10**6
_PART = re.compile(r"\s*(\d+)\s*(?::\s*(\d+)\s*)?", re.ASCII)


@dataclass(frozen=True, slots=True)
class CountRuns(Sequence[int]):
    """Set of tooth counts, stored as runs of consecutive integers. The memory requirement does not depend on the length
    of the runs.

    The object is a sequence of integers in ascending order, with a length and indices. `read_counts` parses it from
    text, and `CountRuns.of` builds it from an iterable.

    Examples
    --------
    >>> counts = CountRuns.of([48, 12, 13, 14])
    >>> str(counts), len(counts), counts[-1], 13 in counts
    ('12:14,48', 4, 48, True)
    """

    spans: tuple[tuple[int, int], ...]
    """First and last tooth count of each run, both inclusive. The runs are in ascending order, and there is a gap
    between consecutive runs.
    """

    @classmethod
    def of(cls, counts: Iterable[int]) -> CountRuns:
        """Build runs from tooth counts in any order.

        Parameters
        ----------
        counts : iterable of int
            One or more tooth counts, each from 1 to 10^12. `QuestionError` is raised for other values.
        """
        if isinstance(counts, CountRuns):
            return counts
        # a range may have 10^12 counts, which must not be enumerated
        if isinstance(counts, range) and counts.step == 1:
            return cls.joined([(counts.start, counts.stop - 1)] if counts else [])
        return cls.joined((count, count) for count in counts)

    @classmethod
    def joined(cls, spans: Iterable[tuple[int, int]]) -> CountRuns:
        """Build runs from the union of one or more spans.

        Parameters
        ----------
        spans : iterable of (int, int)
            First and last count of each span, both inclusive, from 1 to 10^12. The spans may be in any order and may
            overlap.
        """
        found: list[tuple[int, int]] = []
        for first, last in sorted(spans):
            # adjacent spans are merged too
            if found and first <= found[-1][1] + 1:
                found[-1] = (found[-1][0], max(found[-1][1], last))
            else:
                found.append((first, last))
        if not found:
            raise _problem("no tooth counts are given", "a wheel needs at least one admissible count")
        for first, last in found:
            if first < 1 or last > MOST_TEETH:
                raise _problem(
                    f"a wheel cannot have {first if first < 1 else last} teeth", "tooth counts are from 1 to 10^12"
                )
        return cls(tuple(found))

    @property
    def minimum(self) -> int:
        """Minimum tooth count."""
        return self.spans[0][0]

    @property
    def most(self) -> int:
        """Maximum tooth count."""
        return self.spans[-1][1]

    def as_array(self) -> NDArray[np.int64]:
        """Return the tooth counts as an array in ascending order. `RangeError` is raised if there are more than a
        million tooth counts.
        """
        import numpy as np

        if len(self) > _MOST_LISTED:
            raise RangeError(
                Problem(
                    f"{len(self)} tooth counts are too many to list",
                    f"a search lists every count of a wheel, at most {_MOST_LISTED}",
                    "give a shorter range, such as 15:120; `geartrain teeth approximants` lists fractions of any size",
                )
            )
        return np.array(tuple(self), dtype=np.int64)

    def __len__(self) -> int:
        return sum(last - first + 1 for first, last in self.spans)

    def __iter__(self) -> Iterator[int]:
        return chain.from_iterable(range(first, last + 1) for first, last in self.spans)

    def __contains__(self, count: object) -> bool:
        return isinstance(count, Integral) and any(first <= int(count) <= last for first, last in self.spans)

    @overload
    def __getitem__(self, at: int) -> int: ...
    @overload
    def __getitem__(self, at: slice) -> tuple[int, ...]: ...
    def __getitem__(self, at: int | slice) -> int | tuple[int, ...]:
        places = range(len(self))[at]
        if not isinstance(places, int):
            return tuple(self[place] for place in places)
        for first, last in self.spans:
            if places <= last - first:
                return first + places
            places -= last - first + 1
        raise IndexError(at)

    def __str__(self) -> str:
        return ",".join(f"{first}:{last}" if last > first else f"{first}" for first, last in self.spans)

    def to_dict(self) -> dict[str, Any]:
        """Return the tooth counts as plain data for JSON."""
        return {"counts": str(self), "minimum": self.minimum, "most": self.most, "number": len(self)}


def read_counts(text: str) -> CountRuns:
    """Parse tooth counts from a text.

    Parameters
    ----------
    text : str
        Ranges `first:last`, where both ends are inclusive, single tooth counts, and names of construction sets such as
        `meccano`, separated by commas.

    Returns
    -------
    CountRuns
        Distinct tooth counts in ascending order.

    Raises
    ------
    QuestionError
        If the text is empty, if a part is not an integer from 1 to 10^12, or if the first tooth count of a range
        exceeds the last.

    Examples
    --------
    >>> tuple(read_counts("12:15,48,60")), len(read_counts("12:1000000000"))
    ((12, 13, 14, 15, 48, 60), 999999989)
    """
    if not text.strip():
        raise _problem("no tooth counts are given", "a wheel needs at least one admissible count")
    return CountRuns.joined(span for part in text.split(",") for span in _spans(part))


def _spans(part: str) -> list[tuple[int, int]]:
    """Return the first and the last tooth count of each span in `part`, which is a single tooth count, a range, or the
    name of a construction set.
    """
    name = part.strip()
    shown = name if len(name) <= 40 else f"{name[:37]}..."
    if any(letter.isalpha() for letter in part):
        from geartrain.train.mechanism import wheel_sets

        if name not in wheel_sets():
            why = f"a count is an integer, a range is first:last, and the sets of wheels are {', '.join(wheel_sets())}"
            raise _problem(f"'{shown}' is not a tooth count", why)
        return [(count, count) for count in wheel_sets()[name]]
    # longer texts cannot be counts up to 10^12
    match = _PART.fullmatch(part) if len(part) <= 100 else None
    if match is None:
        raise _problem(f"'{shown}' is not a tooth count", "a count is an integer, a range is first:last")
    first, last = int(match[1]), int(match[2] or match[1])
    if first > last:
        raise _problem(f"the range {shown} is reversed", "the first count must not exceed the last", f"{last}:{first}")
    return [(first, last)]


def _problem(what: str, why: str, better: str = "'15:120', '30,36,48' or '12:40,48,60'") -> QuestionError:
    return QuestionError(Problem(what, why, f"for example, write {better}"))
