"""Exceptions of geartrain: one base class, whose problems have a place, a description, a reason and a fix.

All errors that are reported to users are `GearTrainError` or a subclass. A train that is locked or contradictory is not
an error: a verdict is a result (`geartrain.kinematics.Verdict`).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from itertools import islice
from numbers import Integral, Real

__all__ = ["DeclarationError", "GearTrainError", "MissingExtraError", "Problem", "QuestionError", "RangeError"]

Loc = tuple[str | int, ...]
"""Path of a value in a declaration: its keys and list indices."""

Marks = Callable[[Loc], str]
"""Function that converts a `Loc` to a place that a user can open, such as `file.yaml:12`."""


_STEERING = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\u2028\u2029\u202a-\u202e\u2066-\u2069\ud800-\udfff]")
"""Characters that could control a terminal: control characters except tab and line feed, other line separators,
marks that change the writing direction, and lone surrogates.
"""


def printable(text: str) -> str:
    r"""Return the string with all characters escaped that could control a terminal or hide other text.

    >>> printable("sun\x1b[2J")
    'sun\\x1b[2J'
    """
    return _STEERING.sub(lambda found: found[0].encode("unicode_escape").decode("ascii"), text)


def dotted(loc: Loc) -> str:
    """Return the path of a declared value as text, such as `gears[3].pair`."""
    text = ""
    for step in loc:
        text += f"[{step}]" if isinstance(step, int) else f".{step}" if text else step
    return text


def nearest_names(name: str, known: Iterable[str], wide: bool = False) -> list[str]:
    """Return up to two known names that are similar to an unknown name, the most similar first.

    `wide=True`, for long names with several parts, returns up to three names, which may be less similar.
    """
    from difflib import get_close_matches  # slow to import, and most runs have no unknown name

    return get_close_matches(name, tuple(dict.fromkeys(known)), n=3 if wide else 2, cutoff=0.5 if wide else 0.6)


def suggest(name: str, known: Iterable[str], otherwise: str = "", wide: bool = False) -> str:
    """Return a suggestion for an unknown name: similar known names, or `otherwise` if no known name is similar. If
    `otherwise` is empty, the suggestion lists all known names.
    """
    known = tuple(dict.fromkeys(known))
    if close := nearest_names(name, known, wide):
        return f"did you mean {' or '.join(map(repr, close))}?"
    return otherwise or (f"use one of: {', '.join(known)}" if 0 < len(known) <= 30 else "correct the name")


@dataclass(frozen=True, slots=True)
class Problem:
    """One problem of the input: place, description, reason and fix.

    Examples
    --------
    >>> print(Problem("unknown key 'tooths'", "a wheel has no such key", "did you mean 'teeth'?", "train.yaml:7"))
    train.yaml:7: unknown key 'tooths'
      why: a wheel has no such key
      fix: did you mean 'teeth'?
    """

    what: str
    """Description of the problem as a clause, such as "unknown key 'tooths'"."""
    why: str = ""
    """Rule or cause; empty if it is obvious."""
    fix: str = ""
    """Instruction to solve the problem."""
    place: str = ""
    """Place of the problem: `file.yaml:12`, the path of a value such as `gears[3].pair`, or a file. It may be empty."""

    @property
    def text(self) -> str:
        """Description, reason and fix on one line, without the place."""
        return "; ".join(filter(None, (self.what, self.why, self.fix)))

    def __str__(self) -> str:
        head = f"{self.place}: {self.what}" if self.place else self.what
        lines = [head]
        if self.why:
            lines.append(f"  why: {self.why}")
        if self.fix:
            lines.append(f"  fix: {self.fix}")
        return printable("\n".join(lines))


MOST_REPORTED = 20
"""Maximum number of problems reported at once."""


def first_problems(problems: Iterable[Problem], count: int | None = None) -> tuple[Problem, ...]:
    """Return up to `MOST_REPORTED` + 1 problems; if there are more, the last one says so.

    `count` is the total number of problems, if it is known; the last problem then gives the number of omitted problems.
    An iterator is consumed only until it is known that there are more.
    """
    if count is None and isinstance(problems, list | tuple):
        count = len(problems)
    # two beyond the limit show whether problems must be omitted
    first = tuple(islice(problems, MOST_REPORTED + 2))
    if len(first) <= MOST_REPORTED + 1:  # one further problem is reported itself
        return first
    more = "more problems were found" if count is None else f"{count - MOST_REPORTED} more problems were found"
    rest = Problem(f"and {more}", f"only the first {MOST_REPORTED} are reported", "correct these, and run again")
    return (*first[:MOST_REPORTED], rest)


class GearTrainError(Exception):
    """Base class of all exceptions that geartrain raises for invalid input.

    Parameters
    ----------
    problems : Problem or iterable of Problem
        All problems that were found. The first 20 are kept, followed by the number of omitted problems.

    Attributes
    ----------
    problems : tuple of Problem
        The problems that are kept.

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
    """Error for a declaration that cannot be read or does not describe a gear train.

    See Also
    --------
    geartrain.train.declare : raises it with the place of every problem
    """


class QuestionError(GearTrainError):
    """Error for an invalid request to a valid train or function, such as an unknown link, or an argument out of range.

    See Also
    --------
    geartrain.GearTrain.solve : raises it for a state or an output that is not declared
    """


class RangeError(GearTrainError):
    """Error for a request outside the range of a method; another method may be applicable.

    See Also
    --------
    geartrain.kinematics.FloatSpeeds : raises it for a speed outside the range of float64
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
"""Disk space that the packages of each extra require [MB], at least 1; measured by docs/scripts/make_extras.py."""


def install_command(extra: str) -> str:
    """Return the command that installs the packages of an extra, which are named one by one."""
    from importlib.metadata import PackageNotFoundError, requires

    try:
        needs = requires("geartrain") or ()
    except PackageNotFoundError:  # a copy of the sources that is not installed
        needs = ()
    # requirements have the form `numpy>=2; extra == "fast"`
    split = [need.replace('"', "'").partition(";") for need in needs]
    packages = [f"'{package.strip()}'" for package, _, marker in split if f"extra == '{extra}'" in marker]
    return f"pip install {' '.join(packages)}" if packages else f"pip install -e '.[{extra}]'"


class MissingExtraError(GearTrainError):
    """Error for an optional library that is not installed; its fix is the command that installs the library.

    Parameters
    ----------
    library : str
        Name of the library for `import`.
    extra : str
        Extra of geartrain that installs the library.
    purpose : str
        Feature that requires the library.

    Examples
    --------
    >>> print(MissingExtraError("matplotlib", "plot", "a picture"))
    matplotlib is not installed
      why: a picture requires it; it is installed with the extra 'plot'
      fix: pip install 'matplotlib>=3.8' # 98 MB
    """

    def __init__(self, library: str, extra: str, purpose: str) -> None:
        super().__init__(
            Problem(
                what=f"{library} is not installed",
                why=f"{purpose} requires it; it is installed with the extra '{extra}'",
                fix=f"{install_command(extra)} # {_MEGABYTES[extra]} MB",
            )
        )


def check_choice(kind: str, name: str, known: Iterable[str]) -> None:
    """Raise `QuestionError` with a suggestion if a name is not one of the known names."""
    known = tuple(known)
    if name not in known:
        raise QuestionError(Problem(f"unknown {kind} '{name}'", "names must match exactly", suggest(name, known)))


def check_numbers(**given: object) -> None:
    """Raise `QuestionError` for a keyword argument that is not a real number; None is accepted."""
    _check_kind(given, Real, "a number")


def check_whole_numbers(**given: object) -> None:
    """Raise `QuestionError` for a keyword argument that is not an integer; None is accepted."""
    _check_kind(given, Integral, "a whole number")


def _check_kind(given: Mapping[str, object], kind: type, words: str) -> None:
    for name, value in given.items():
        if value is not None and (isinstance(value, bool) or not isinstance(value, kind)):
            what = f"{name}: {value!r} is not {words}"
            raise QuestionError(Problem(what, "", f"give {words}"))
