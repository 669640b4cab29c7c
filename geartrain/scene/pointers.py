"""Outputs as pointers: what they show, on which dial, and what they hang on."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from geartrain.outputs import Number, relative_speed
from geartrain.scene.dials import Key, dial_key, facing
from geartrain.scene.paths import find_paths
from geartrain.scene.result import Pointer
from geartrain.scene.space import dot
from geartrain.scene.stage import Stage, exact, rounded


def find_pointers(stage: Stage, dials: Sequence[Key]) -> tuple[Pointer, ...]:
    """A pointer for every output of the state, in the order declared."""
    paths = find_paths(stage)
    return tuple(_pointer(stage, name, dials, paths.get(name, ())) for name in stage.case.outputs)


def _pointer(stage: Stage, name: str, dials: Sequence[Key], pairs: Sequence[str]) -> Pointer:
    output = stage.case.outputs[name]
    of, base = output.of or name, output.relative_to or stage.train.declaration.frame
    signs = stage.train.signs
    speed, ratio = (_exact(relative_speed(of, base, each, signs)) for each in (stage.speed, stage.ratio))
    # seen from the side to which its axis points, a positive angle is counter-clockwise
    sense = -1 if dot(stage.declared(of), facing(stage, name)) > 0 else 1
    key = dial_key(stage, name)
    circuits = [circuit for circuit in stage.train.circuits if circuit.id in set(pairs)]
    order = {pair: at for at, pair in enumerate(pairs)}
    circuits.sort(key=lambda circuit: order[circuit.id])
    bodies = dict.fromkeys(stage.body[link] for c in circuits for link in (c.j, c.i, c.carrier))
    wheels = dict.fromkeys(stage.wheel[wheel] for c in circuits if c.kind == "gear" for wheel in c.wheels)
    return Pointer(
        output=name,
        body=stage.body[of],
        base=stage.body[base],
        dial=dials.index(key) if key in dials else None,
        speed=exact(ratio),
        shown=stage.shown(speed),
        decimal=rounded(speed),
        sense=sense,
        text=_as_read(sense, speed),
        pairs=tuple(pairs),
        bodies=tuple(bodies),
        wheels=tuple(wheels),
        note=output.note or "",
    )


def _exact(speed: Number | None) -> Fraction | None:
    return None if speed is None else Fraction(speed)


def _as_read(sense: int, speed: Fraction | None) -> str:
    if not speed:
        return "stands still" if speed is not None else ""
    return f"{'clockwise' if (speed > 0) == (sense > 0) else 'counter-clockwise'} as read"
