"""Speeds of a scene as exact functions of tooth counts, for pages on which counts are changed.

Equal planets have one count.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from geartrain.errors import GearTrainError
from geartrain.kinematics.formulas import Formula, Formulas, find_formulas
from geartrain.kinematics.planet_copies import originals
from geartrain.numerics.containers import FrozenDict
from geartrain.numerics.decimal_text import fraction_text
from geartrain.scene.count_formulas import CountCondition, CountFormula, SceneFormulas
from geartrain.train import Output

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from geartrain.analysis.gear_train import GearTrain
    from geartrain.scene.elements import SceneBody, SceneWheel
    from geartrain.scene.train_scene import Pointer
    from geartrain.train import Train

_MOST_WHEELS = 300  # functions of the links of a long chain are long themselves


def find_count_formulas(
    train: GearTrain,
    state: str | None,
    bodies: Sequence[SceneBody],
    wheels: Sequence[SceneWheel],
    pointers: Sequence[Pointer],
) -> SceneFormulas | None:
    """The functions of a train as declared, for the parts of its scene; None where there are none to be had.

    A train without inputs has none, nor has one that is too coupled or too large for them.
    """
    declared, unfolded = train.declaration, train.unfolded
    case = declared.case(state)
    lead = next((link for link, speed in case.inputs.items() if speed), None)
    free = {name: (wheel.count,) for name, (_, wheel) in declared.wheels.items() if wheel.count}
    if lead is None or not free or len(free) > _MOST_WHEELS:
        return None
    frame = declared.frame
    asked = [(bodies[each.body].id, bodies[each.base].id) for each in pointers]
    links = [None if body.parent is None else (body.id, frame) for body in bodies]
    own = originals(declared)
    counted = {wheel.id: _original(wheel.id, own, bodies[wheel.body].id) for wheel in wheels}
    try:
        train_asked = _asking(unfolded.declaration, state, [*asked, *filter(None, links)])
        found = find_formulas(train_asked, state, {name: free[of] for name, of in counted.items() if of in free})
    except GearTrainError:
        return None
    place = {name: at for at, name in enumerate(free)}
    table = _Table({name: place[of] for name, of in counted.items() if of in free})
    return SceneFormulas(
        wheels=tuple(free),
        count=tuple(table.place.get(wheel.id) for wheel in wheels),
        bodies=tuple(table.index(found, each) for each in links),
        pointers=tuple(table.index(found, each) for each in asked),
        conditions=_conditions(unfolded, found, table, [body.id for body in bodies]),
        formulas=tuple(table.formulas),
        input=fraction_text(case.inputs[lead]),
        exact=case.exact,
        parent=_parent(declared),
    )


def _name(asked: tuple[str, str]) -> str:
    return " seen from ".join(asked)


def _asking(train: Train, state: str | None, asked: Sequence[tuple[str, str]]) -> Train:
    """The train with other outputs: links as they are seen from links."""
    outputs = FrozenDict({_name(each): Output(of=each[0], relative_to=each[1]) for each in asked})
    states = {
        name: each.changed(outputs=FrozenDict({})) if name == state else each for name, each in train.states.items()
    }
    return train.changed(outputs=outputs, states=FrozenDict(states))


def _original(wheel: str, own: dict[str, str], link: str) -> str:
    """The declared wheel of a copy's wheel, whose name ends as that of its link does."""
    end = link.removeprefix(own[link])
    return wheel.removesuffix(end) if end else wheel


def _parent(train: Train) -> str:
    """What would extend it: a shipped train by name, else the file that it was read from."""
    from geartrain.train.declaration_files import shipped

    file = train.place("name").rpartition(":")[0]
    if file in ("", "text"):
        return f"{train.name}.yaml"
    own = Path(file).resolve()
    return next((name for name, path in shipped().items() if path == own), own.name)


class _Table:
    """Functions by index, each once."""

    def __init__(self, place: Mapping[str, int]) -> None:
        self.place = place  # of each wheel, that of its count
        self.formulas: dict[CountFormula, int] = {}

    def index(self, found: Formulas, asked: tuple[str, str] | None) -> int | None:
        formula = None if asked is None else found.outputs.get(_name(asked))
        return None if formula is None else self.formulas.setdefault(self.plain(formula), len(self.formulas))

    def plain(self, formula: Formula) -> CountFormula:
        upper, lower = (
            tuple((fraction_text(term.coefficient), tuple(term.exponents)) for term in terms)
            for terms in (formula.numerator, formula.denominator)
        )
        return CountFormula(tuple(self.place[wheel] for wheel in formula.wheels), upper, lower)


def _conditions(train: GearTrain, found: Formulas, table: _Table, bodies: Sequence[str]) -> tuple[CountCondition, ...]:
    carriers = {f"loop {' - '.join(loop.links)} closes": loop.carrier for loop in train.mobility.loops}
    must = [
        CountCondition(
            table.plain(each), True, each.label, bodies.index(carriers[each.label]) if each.label in carriers else None
        )
        for each in found.conditions
    ]
    return (*must, *(CountCondition(table.plain(each), False, each.label) for each in found.exclusions))
