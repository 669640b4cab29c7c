"""An epicyclic set as a declaration: with its counts, or with wheels still to be found."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any

from geartrain.errors import Problem, QuestionError
from geartrain.exact import written
from geartrain.synthesis.epicyclic.found import EpicyclicSet, RatioIs
from geartrain.synthesis.epicyclic.kinds import CARRIER, Kind, Mode, kind_named

Teeth = Mapping[str, int | tuple[int, int]]


def declare(
    kind: str | Kind,
    mode: str | Mode,
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
    kind = kind_named(kind) if isinstance(kind, str) else kind
    (mode,) = kind.chosen([mode])
    _check(kind, teeth)
    output: dict[str, Any] = {}
    if wanted is not None:
        speed = Fraction(wanted) if ratio_is == "output/input" else 1 / Fraction(wanted)
        target = {"speed": written(speed)}
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


def declaration_of(found: EpicyclicSet) -> dict[str, Any]:
    """A set that was found, as a train that expects its ratio."""
    data = declare(found.kind, found.mode, found.teeth)
    data["outputs"] = {found.mode.output: {"expect": str(found.inverse)}}
    return data


_AXES = {"main": {"direction": [1, 0, 0]}, "planet": {"direction": [0, 1, 0]}}


def _check(kind: Kind, teeth: Teeth) -> None:
    unknown = [wheel for wheel in teeth if wheel not in kind.wheels]
    missing = [wheel for wheel in kind.wheels if wheel not in teeth]
    if unknown or missing:
        what = f"'{unknown[0]}' is no wheel of" if unknown else f"wheel '{missing[0]}' is missing from"
        why = f"its wheels are {', '.join(kind.wheels)}"
        raise QuestionError(Problem(f"{what} the kind '{kind.name}'", why, "give a count or bounds for each of them"))


def _links(kind: Kind, teeth: Teeth) -> dict[str, Any]:
    links: dict[str, Any] = {"frame": {}}
    for at, member in enumerate(kind.members):
        facing = {"facing": -1} if kind.bevel and at else {}
        links[member.link] = {"wheels": {member.wheel: _wheel(kind, teeth[member.wheel], member.internal) | facing}}
    links[CARRIER] = {}
    for name, wheels in zip(_planet_links(kind), kind.planets, strict=True):
        links[name] = {"wheels": {wheel: _wheel(kind, teeth[wheel], False) for wheel in wheels}}
    return links


def _wheel(kind: Kind, teeth: int | tuple[int, int], internal: bool) -> dict[str, Any]:
    wheel: dict[str, Any] = {"teeth": teeth if isinstance(teeth, int) else {"search": list(teeth)}}
    if internal:
        wheel["internal"] = True
    if kind.bevel:
        wheel["kind"] = "bevel"
    return wheel


def _planet_links(kind: Kind) -> Sequence[str]:
    return ["planet"] if len(kind.planets) == 1 else [f"planet{at}" for at in range(1, len(kind.planets) + 1)]


def _revolutes(kind: Kind) -> Iterator[dict[str, Any]]:
    for link in kind.links:
        yield {"pair": ["frame", link], "axis": "main"}
    for name in _planet_links(kind):
        yield {"pair": [CARRIER, name], "axis": name}
