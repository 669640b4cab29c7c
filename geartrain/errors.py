"""Errors: one exception for a user to catch, and its problems with place, what, why and fix.

In: a fault found by a reader, a check or a method. Out: `GearTrainError` or a subclass; users see no other exception.
A train that is locked or contradictory is not an error: a verdict is a result (`geartrain.kinematics.Verdict`).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from itertools import islice
from numbers import Integral, Real

__all__ = ["DeclarationError", "GearTrainError", "MissingExtraError", "Problem", "QuestionError", "RangeError"]

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
    """One thing that is wrong, in four parts.

    Examples
    --------
    >>> print(Problem("unknown key 'tooths'", "a wheel has no such key", "did you mean 'teeth'?", "train.yaml:7"))
    train.yaml:7: unknown key 'tooths'
      why: a wheel has no such key
      fix: did you mean 'teeth'?
    """

    what: str
    """What is wrong, in a few words."""
    why: str = ""
    """Why it cannot stand; empty where that is plain."""
    fix: str = ""
    """What to do about it."""
    place: str = ""
    """Where: `file.yaml:12`, the path of a declared value such as `gears[3].pair`, or a file; may be empty."""

    @property
    def text(self) -> str:
        """What, why and what to do on one line, without the place."""
        return "; ".join(filter(None, (self.what, self.why, self.fix)))

    def __str__(self) -> str:
        head = f"{self.place}: {self.what}" if self.place else self.what
        lines = [head]
        if self.why:
            lines.append(f"  why: {self.why}")
        if self.fix:
            lines.append(f"  fix: {self.fix}")
        return printable("\n".join(lines))


MOST_TOLD = 20
"""Problems reported at once; the others are seen when these are mended."""


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
    """Input that cannot be read or used. Everything that geartrain raises at a user is one of these.

    Parameters
    ----------
    problems : Problem or iterable of Problem
        What is wrong. All that could be collected, of which the first 20 are kept, and how many more there are.

    Attributes
    ----------
    problems : tuple of Problem
        Those that are kept.

    Examples
    --------
    >>> import geartrain
    >>> try:
    ...     geartrain.load("planetary").solve("drive")
    ... except GearTrainError as error:
    ...     for problem in error.problems:
    ...         print(problem.what)
    'planetary' has no state 'drive'
    """

    def __init__(self, problems: Problem | Iterable[Problem]) -> None:
        self.problems = (problems,) if isinstance(problems, Problem) else first_problems(problems)
        super().__init__("\n".join(str(p) for p in self.problems))


class DeclarationError(GearTrainError):
    """The declaration cannot be read, or does not describe a gear train.

    See Also
    --------
    geartrain.train.declare : raises it with the place of every problem
    """


class QuestionError(GearTrainError):
    """The train is sound, but it was asked for something it does not have: a link, a state, a method.

    See Also
    --------
    geartrain.GearTrain.solve : raises it for a state or an output that is not declared
    """


class RangeError(GearTrainError):
    """A method of calculation cannot answer within its range; another one can.

    See Also
    --------
    geartrain.kinematics.FloatSpeeds : raises it for a speed that float64 does not hold
    """


_MEGABYTES = {
    "report": 1,
    "plot": 98,
    "dask": 37,
    "dxf": 55,
    "proof": 14,
    "step": 391,
    "tables": 258,
    "fast": 213,
    "fmu": 1,
    "sympy": 80,
    "watch": 7,
}
"""What each extra adds to the core on the disk, rounded up to 1; measured by docs/scripts/make_extras.py."""


def install_command(extra: str) -> str:
    """The command that installs the packages of an extra, by the names that the metadata of geartrain list.

    The name of an extra is not used: it works only where an index has this distribution.
    """
    from importlib.metadata import PackageNotFoundError, requires

    try:
        needs = requires("geartrain") or ()
    except PackageNotFoundError:  # a copy of the sources that is not installed
        needs = ()
    split = [need.replace('"', "'").partition(";") for need in needs]
    packages = [f"'{package.strip()}'" for package, _, marker in split if f"extra == '{extra}'" in marker]
    return f"pip install {' '.join(packages)}" if packages else f"pip install -e '.[{extra}]'"


class MissingExtraError(GearTrainError):
    """An optional library is not installed.

    Parameters
    ----------
    library : str
        The library as it is imported.
    extra : str
        The extra of geartrain that brings it.
    purpose : str
        What needs it.

    Examples
    --------
    >>> print(MissingExtraError("matplotlib", "plot", "a picture"))
    matplotlib is not installed
      why: a picture needs it, and it comes with the extra 'plot'
      fix: pip install 'matplotlib>=3.8' # 98 MB
    """

    def __init__(self, library: str, extra: str, purpose: str) -> None:
        super().__init__(
            Problem(
                what=f"{library} is not installed",
                why=f"{purpose} needs it, and it comes with the extra '{extra}'",
                fix=f"{install_command(extra)} # {_MEGABYTES[extra]} MB",
            )
        )


def check_choice(kind: str, name: str, known: Iterable[str]) -> None:
    """Raise `QuestionError` for a name that is none of those known."""
    known = tuple(known)
    if name not in known:
        raise QuestionError(Problem(f"there is no {kind} '{name}'", "it is not known here", suggest(name, known)))


def check_numbers(**given: object) -> None:
    """Raise `QuestionError` for an argument that is no number; None is one that is not given."""
    _check_kind(given, Real, "a number")


def check_whole_numbers(**given: object) -> None:
    """Raise `QuestionError` for an argument that is no whole number; None is one that is not given."""
    _check_kind(given, Integral, "a whole number")


def _check_kind(given: Mapping[str, object], kind: type, words: str) -> None:
    for name, value in given.items():
        if value is not None and (isinstance(value, bool) or not isinstance(value, kind)):
            what = f"{name}: {value!r} is not {words}"
            raise QuestionError(Problem(what, "", f"give {words}"))
