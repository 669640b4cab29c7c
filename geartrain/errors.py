"""What can go wrong, said with place, what, why and what to do; and the verdict on a train, which is data."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import islice

Loc = tuple[str | int, ...]
"""Where in a declaration: the keys and list positions that lead to a value."""

Marks = Callable[[Loc], str]
"""Turns a `Loc` into a place a reader can open, such as `file.yaml:12`."""


_STEERING = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\u2028\u2029\u202a-\u202e\u2066-\u2069\ud800-\udfff]")
"""Control characters but tab and line feed, other ends of a line, turns of the writing direction, lone surrogates."""


def printable(text: str) -> str:
    """Text of a user as it may be shown: what could steer a terminal, or hide what follows, is written out.

    >>> printable("sun\\x1b[2J")
    'sun\\\\x1b[2J'
    """
    return _STEERING.sub(lambda found: found[0].encode("unicode_escape").decode("ascii"), text)


def dotted(loc: Loc) -> str:
    """The path of a declared value when no file is known: `gears[3].pair`."""
    text = ""
    for step in loc:
        text += f"[{step}]" if isinstance(step, int) else f".{step}" if text else step
    return text


def nearest_names(name: str, known: Iterable[str], wide: bool = False) -> list[str]:
    """The known names that may be meant by an unknown one, the most alike first.

    wide   where names are long and made of parts, as those of periods and files: less likeness will do, and one more
           is named
    """
    from difflib import get_close_matches  # most runs misspell nothing

    return get_close_matches(name, tuple(dict.fromkeys(known)), n=3 if wide else 2, cutoff=0.5 if wide else 0.6)


def suggest(name: str, known: Iterable[str], otherwise: str = "", wide: bool = False) -> str:
    """What to write instead of an unknown name: the nearest known ones, else `otherwise`, else all if they are few."""
    known = tuple(dict.fromkeys(known))
    if close := nearest_names(name, known, wide):
        return f"did you mean {' or '.join(map(repr, close))}?"
    return otherwise or (f"use one of: {', '.join(known)}" if 0 < len(known) <= 30 else "correct the name")


@dataclass(frozen=True, slots=True)
class Problem:
    """One thing that is wrong: place, what, why, what to do."""

    what: str
    why: str = ""
    fix: str = ""
    place: str = ""

    def __str__(self) -> str:
        head = f"{self.place}: {self.what}" if self.place else self.what
        lines = [head]
        if self.why:
            lines.append(f"  why: {self.why}")
        if self.fix:
            lines.append(f"  fix: {self.fix}")
        return printable("\n".join(lines))


MOST_TOLD = 20
"""Problems told at once: who has mended these sees the rest."""


def first_problems(problems: Iterable[Problem], count: int | None = None) -> tuple[Problem, ...]:
    """The first `MOST_TOLD` of some problems, and one that says how many more there are (of `count` in all, if known).

    An iterator is not asked for more than it takes to know that there are more.
    """
    if count is None and isinstance(problems, list | tuple):
        count = len(problems)
    told = tuple(islice(problems, MOST_TOLD + 2))
    if len(told) <= MOST_TOLD + 1:  # one more is told sooner than said
        return told
    more = "more problems were found" if count is None else f"{count - MOST_TOLD} more problems were found"
    rest = Problem(f"and {more}", f"only the first {MOST_TOLD} are told", "mend these, and ask again")
    return (*told[:MOST_TOLD], rest)


class GearTrainError(Exception):
    """Input that cannot be read or used; carries the first `MOST_TOLD` of the problems that could be collected."""

    def __init__(self, problems: Problem | Iterable[Problem]) -> None:
        self.problems = (problems,) if isinstance(problems, Problem) else first_problems(problems)
        super().__init__("\n".join(str(p) for p in self.problems))


class DeclarationError(GearTrainError):
    """The declaration cannot be read, or does not describe a gear train."""


class QuestionError(GearTrainError):
    """The train is sound, but it was asked for something it does not have."""


class RangeError(GearTrainError):
    """A method of calculation cannot answer within its range; another one can."""


class MissingExtraError(GearTrainError):
    """An optional library is not installed."""

    def __init__(self, library: str, extra: str, purpose: str) -> None:
        super().__init__(
            Problem(
                what=f"{library} is not installed",
                why=f"{purpose} needs it, and it comes with an extra",
                fix=f"pip install 'geartrain[{extra}]'",
            )
        )


def check_choice(kind: str, name: str, known: Iterable[str]) -> None:
    """Raise `QuestionError` for a name that is none of those known."""
    known = tuple(known)
    if name not in known:
        raise QuestionError(Problem(f"there is no {kind} '{name}'", "it is not known here", suggest(name, known)))
