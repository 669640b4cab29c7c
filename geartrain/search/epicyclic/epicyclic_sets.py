"""What a search for epicyclic sets found, and a set as a declaration, with its counts or with wheels still to be
found.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Literal

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.exact import abridged_text, as_float, decimal, fraction_text
from geartrain.numerics.results import Key, Result, finite
from geartrain.search.epicyclic.set_kinds import CARRIER, EpicyclicKind, EpicyclicMode, epicyclic_kind, mode_key
from geartrain.search.search_outcome import CountSizes, Shortfall

RatioIs = Literal["input/output", "output/input"]
SetOrder = Literal["error", "total", "largest"]


@dataclass(frozen=True, slots=True)
class EpicyclicSet(CountSizes, Result):
    """Tooth counts of an epicyclic set in one mode.

    Attributes
    ----------
    kind : str
        Name of the kind of set, such as "planetary".
    mode : EpicyclicMode
        Which link drives, which is driven, which is held.
    teeth : mapping of str to int
        Wheel -> count.
    ratio : Fraction
        Speed of the input over that of the output, exact; negative where they turn against each other.
    error : Fraction
        Magnitude of the ratio, as it was asked for, over the wanted one, less 1; exact.
    planets : int
        The number asked for.
    places : int
        At how many equally spaced places identical planets can stand; 0 for anywhere.
    room : float
        Between the tips of neighbouring planets, equally spaced [modules]; negative where they overlap.

    See Also
    --------
    find_sets : finds them.
    """

    KEYS = (
        "kind",
        "mode",
        "teeth",
        Key("input/output", "ratio"),
        Key("output/input", "inverse"),
        Key("value", "ratio", as_float),
        Key("error", to=float),
        Key("exact_error", "error"),
        "planets",
        "places",
        "equally_spaced",
        Key("room", to=finite),
        "total",
        "largest",
    )

    kind: str
    mode: EpicyclicMode
    teeth: Mapping[str, int]
    ratio: Fraction
    error: Fraction
    planets: int
    places: int
    room: float

    @property
    def counts(self) -> Collection[int]:
        """The counts of all wheels."""
        return self.teeth.values()

    @property
    def inverse(self) -> Fraction:
        """Speed of the output over that of the input."""
        return 1 / self.ratio

    @property
    def equally_spaced(self) -> bool:
        """True if the planets can be put in at equal distances."""
        return self.places % self.planets == 0

    @property
    def clears(self) -> bool:
        """True if neighbouring planets do not touch."""
        # wheels that just touch clear each other, whatever rounding says
        return self.room >= -1e-9

    def to_train(self) -> dict[str, Any]:
        """A declaration as plain data: the set with one planet, driven at 1, whose output expects its exact ratio."""
        data = declare(self.kind, self.mode, self.teeth)
        data["outputs"] = {self.mode.output: {"expect": str(self.inverse)}}
        return data

    def __str__(self) -> str:
        teeth = ", ".join(f"{wheel} = {count}" for wheel, count in self.teeth.items())
        return f"{teeth}: {abridged_text(self.ratio)} = {decimal(self.ratio, 7)} ({self.mode})"


@dataclass(frozen=True, slots=True)
class SetFindings(Result):
    """The best sets of a kind, best first.

    Attributes
    ----------
    kind : str
        Name of the kind.
    wanted : Fraction
        Magnitude of the ratio.
    ratio_is : {"input/output", "output/input"}
        What `wanted` is.
    modes : tuple of EpicyclicMode
        The modes that were looked at.
    tolerance : Fraction, optional
        Greatest relative error.
    complete : bool
        True: all sets within the bounds were looked at.
    count : int
        Sets within the tolerance, over all modes; all that run where no tolerance was asked.
    solutions : tuple of EpicyclicSet
        The best of them.
    shortfall : Shortfall
        What became of the others; a set in each mode counts as one candidate.

    See Also
    --------
    find_sets : gives it.
    """

    KEYS = (
        "kind",
        "wanted",
        "ratio_is",
        Key("modes", to=mode_key),
        Key("tolerance", to=float),
        "complete",
        "count",
        "solutions",
        Key("", "shortfall"),
    )

    kind: str
    wanted: Fraction
    ratio_is: RatioIs
    modes: tuple[EpicyclicMode, ...]
    tolerance: Fraction | None
    complete: bool
    count: int
    solutions: tuple[EpicyclicSet, ...]
    shortfall: Shortfall

    def __bool__(self) -> bool:
        return bool(self.solutions)


def set_rank(found: EpicyclicSet, by: SetOrder, mode: int) -> tuple[Any, ...]:
    """The exact key of an order: its own measure first, then error, total, largest wheel, mode, counts."""
    counts = tuple(found.teeth.values())
    measures: dict[SetOrder, Any] = {"error": abs(found.error), "total": sum(counts), "largest": max(counts)}
    return (measures[by], *measures.values(), mode, counts)


Teeth = Mapping[str, int | tuple[int, int]]


def declare(
    kind: str | EpicyclicKind,
    mode: str | EpicyclicMode,
    teeth: Teeth,
    wanted: Fraction | None = None,
    tolerance: Fraction | None = None,
    ratio_is: RatioIs = "input/output",
) -> dict[str, Any]:
    """A train as plain data, with one planet (or one pair in mesh), driven at 1.

    teeth   of every wheel: a count, or the bounds (lowest, highest) within which it is to be found
    wanted  the ratio, negative for an output that turns against the input, which the output gets as its target;
            `tolerance` relative

    Raises `QuestionError` for wheels it does not have or lacks.
    """
    kind = epicyclic_kind(kind) if isinstance(kind, str) else kind
    (mode,) = kind.chosen([mode])
    _check(kind, teeth)
    output: dict[str, Any] = {}
    if wanted is not None:
        speed = Fraction(wanted) if ratio_is == "output/input" else 1 / Fraction(wanted)
        target = {"speed": fraction_text(speed)}
        if tolerance is not None:
            target["tolerance"] = str(float(tolerance))
        output = {"targets": [target]}
    return {
        "name": f"{kind.name}-{mode.key.replace(':', '-')}",
        "title": f"{kind.title}: {mode}",
        "links": _links(kind, teeth),
        **({"axes": _AXES} if kind.bevel else {}),
        "revolutes": list(_revolutes(kind)),
        "gears": [{"pair": [member.wheel, member.mesh]} for member in kind.members]
        + [{"pair": list(pair)} for pair in kind.between],
        "inputs": {mode.input: 1},
        "fixed": [mode.held],
        "outputs": {mode.output: output},
    }


_AXES = {"main": {"direction": [1, 0, 0]}, "planet": {"direction": [0, 1, 0]}}


def _check(kind: EpicyclicKind, teeth: Teeth) -> None:
    unknown = [wheel for wheel in teeth if wheel not in kind.wheels]
    missing = [wheel for wheel in kind.wheels if wheel not in teeth]
    if unknown or missing:
        what = f"'{unknown[0]}' is no wheel of" if unknown else f"wheel '{missing[0]}' is missing from"
        why = f"its wheels are {', '.join(kind.wheels)}"
        raise QuestionError(Problem(f"{what} the kind '{kind.name}'", why, "give a count or bounds for each of them"))


def _links(kind: EpicyclicKind, teeth: Teeth) -> dict[str, Any]:
    links: dict[str, Any] = {"frame": {}}
    for at, member in enumerate(kind.members):
        facing = {"facing": -1} if kind.bevel and at else {}
        links[member.link] = {"wheels": {member.wheel: _wheel(kind, teeth[member.wheel], member.internal) | facing}}
    links[CARRIER] = {}
    for name, wheels in zip(_planet_links(kind), kind.planets, strict=True):
        links[name] = {"wheels": {wheel: _wheel(kind, teeth[wheel], False) for wheel in wheels}}
    return links


def _wheel(kind: EpicyclicKind, teeth: int | tuple[int, int], internal: bool) -> dict[str, Any]:
    wheel: dict[str, Any] = {"teeth": teeth if isinstance(teeth, int) else {"search": list(teeth)}}
    if internal:
        wheel["internal"] = True
    if kind.bevel:
        wheel["kind"] = "bevel"
    return wheel


def _planet_links(kind: EpicyclicKind) -> Sequence[str]:
    return ["planet"] if len(kind.planets) == 1 else [f"planet{at}" for at in range(1, len(kind.planets) + 1)]


def _revolutes(kind: EpicyclicKind) -> Iterator[dict[str, Any]]:
    for link in kind.links:
        yield {"pair": ["frame", link], "axis": "main"}
    for name in _planet_links(kind):
        yield {"pair": [CARRIER, name], "axis": name}
