"""Gear pairs in words, and which of them keep the train from turning."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from geartrain.scene.result import Pair
from geartrain.scene.stage import Stage

if TYPE_CHECKING:
    from geartrain.circuits import Circuit
    from geartrain.errors import Loop


def find_pairs(stage: Stage, forms: Mapping[str, str], faults: Mapping[str, str]) -> tuple[Pair, ...]:
    """All gear pairs in the order declared.

    forms    name of the drawn tooth form by pair; faults, what is wrong, by pair
    """
    return tuple(
        Pair(
            id=circuit.id,
            wheels=(stage.wheel[circuit.wheels[0]], stage.wheel[circuit.wheels[1]]),
            carrier=stage.body[circuit.carrier],
            ratio=str(circuit.ratio),
            form=forms.get(circuit.id, ""),
            text=in_words(circuit, stage.train.signs),
            broken=circuit.id in faults,
            fault=faults.get(circuit.id, ""),
        )
        for circuit in stage.train.circuits
        if circuit.kind == "gear"
    )


def in_words(circuit: Circuit, signs: Mapping[str, int]) -> str:
    """A circuit as one reads it: `64 (b - frame) + 38 (c - frame) = 0`; names stand for declared speeds."""
    i, j, k = (f"-{link}" if signs.get(link, 1) < 0 else link for link in (circuit.i, circuit.j, circuit.carrier))
    minus = "+" if k.startswith("-") and signs.get(circuit.carrier, 1) < 0 else "-"
    k = k.removeprefix("-") if minus == "+" else k
    first = _term(circuit.a, f"({i} {minus} {k})", "")
    if not circuit.b:
        return f"{first} = 0"
    return f"{first} {'-' if circuit.b < 0 else '+'} {_term(abs(circuit.b), f'({j} {minus} {k})', '')} = 0"


def _term(factor: int, what: str, sign: str) -> str:
    return f"{sign}{what}" if factor == 1 else f"{sign}{factor} {what}"


def find_verdict(stage: Stage) -> tuple[dict[str, Any], dict[str, str]]:
    """The verdict as plain data with its loops, and what is wrong with each pair, by name."""
    verdict = stage.answer.verdict
    faults: dict[str, str] = {}
    loops = {loop.pairs: _said(loop) for loop in verdict.loops}
    if verdict.kind != "determined" or stage.train.mobility.locked:
        for jam in stage.train.gridlock.jams:
            loops.setdefault(jam.loop.pairs, {**_said(jam.loop), "text": str(jam)})
    for loop in (*loops.values(), *_unfit(stage)):
        loops.setdefault(tuple(loop["pairs"]), loop)
        for pair in loop["pairs"]:
            faults.setdefault(pair, loop["text"])
    fixes = [] if stage.train.gridlock.moves else list(stage.train.gridlock.lines())
    return {
        "kind": verdict.kind,
        "text": verdict.text,
        "links": list(verdict.links),
        "loops": list(loops.values()),
        "advice": fixes,
    }, faults


def _said(loop: Loop) -> dict[str, Any]:
    return {"pairs": list(loop.pairs), "links": list(loop.links), "text": f"{loop} does not close"}


def _unfit(stage: Stage) -> Iterator[dict[str, Any]]:
    """Pairs whose real teeth cannot run, each named like a loop, with why and what would mend it."""
    for mesh in stage.meshes:
        if (fault := mesh.fault) is not None:
            links = [stage.train.declaration.wheels[wheel][0] for wheel in mesh.gear.pair]
            said = "; ".join(filter(None, (fault.what, fault.why, fault.fix)))
            yield {"pairs": [mesh.name], "links": links, "text": said}
