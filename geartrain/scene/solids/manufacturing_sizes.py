"""What a maker says beside the declaration, and the train at the sizes asked for."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from fractions import Fraction
from math import isfinite

from geartrain.analysis.gear_train import GearTrain
from geartrain.errors import Problem, QuestionError
from geartrain.numerics.containers import FrozenDict
from geartrain.numerics.quantity import Quantity
from geartrain.scene.layout import Layout
from geartrain.teeth.standard_teeth import DEDENDUM, PLAY
from geartrain.train import GearPair, Train


@dataclass(frozen=True, slots=True)
class ManufacturingSizes:
    """Sizes in which a train is made; None leaves one to the layout.

    Parameters
    ----------
    module : float, optional
        Pitch diameter over tooth count [mm], above 0; only where the declaration gives no sizes of its own.
    thickness : float, optional
        Of wheels and plates [mm], above 0.
    bore : float, optional
        Diameter of the arbors, and so of the holes in wheels and plates [mm]; 0: no holes.
    backlash : float, optional
        Play on the pitch circle of every pair that does not declare its own [mm], 0 or more; by default a twentieth
        of the module.

    Raises
    ------
    QuestionError
        For a size that is none.

    Examples
    --------
    >>> ManufacturingSizes(module=2.0, bore=6.0)
    ManufacturingSizes(module=2.0, thickness=None, bore=6.0, backlash=None)
    """

    module: float | None = None
    thickness: float | None = None
    bore: float | None = None
    backlash: float | None = None

    def __post_init__(self) -> None:
        """Raise `QuestionError` for what is no size."""
        problems = []
        for name in (each.name for each in fields(self)):
            value = getattr(self, name)
            zero = name in ("bore", "backlash")
            if value is not None and not (isfinite(value) and (value >= 0 if zero else value > 0)):
                fix = f"give a {name} of 0 or more" if zero else f"give a {name} above 0"
                problems.append(Problem(f"a {name} of {value:g} mm is no size", "", fix, f"--{name}"))
        if problems:
            raise QuestionError(problems)


def sized(train: GearTrain, layout: Layout, making: ManufacturingSizes) -> GearTrain:
    """The train with the modules and the play asked for, as if it declared them; itself where none are.

    layout   of the train as it is declared
    Raises `QuestionError` where the declaration gives sizes, which always win, and where teeth cannot have the play.
    """
    declared, factor = train.declaration, scale_of(layout, making)
    modules = {name: Fraction(place.module) * Fraction(factor) for name, place in layout.wheels.items()}
    if making.module is not None:
        declared = _with_modules(declared, modules)
    declared = _with_backlash(declared, modules, making.backlash)
    return train if declared is train.declaration else GearTrain(declared)


def scale_of(layout: Layout, making: ManufacturingSizes) -> float:
    """How many times larger everything is to be for the module asked for.

    Raises `QuestionError` where the declaration gives sizes, which always win.
    """
    if making.module is None or not layout.wheels:
        return 1.0
    given = [name for name, place in layout.wheels.items() if place.given]
    placed = [label for label, axis in layout.axes.items() if axis.how == "given"]
    if given or placed:
        named = f"the module of '{given[0]}'" if given else f"the position of axis '{placed[0]}'"
        why = f"it gives {named}, and what is declared wins"
        fix = "leave --module out, or take the sizes out of the file"
        raise QuestionError(Problem("the declaration has sizes of its own", why, fix, "--module"))
    # rounded: modules that are equal but for rounding count as one
    usual, _ = Counter(round(place.module, 9) for place in layout.wheels.values()).most_common(1)[0]
    return making.module / usual


def _with_modules(declared: Train, modules: Mapping[str, Fraction]) -> Train:
    links = {
        name: link.changed(
            wheels=FrozenDict(
                {
                    id_: wheel.changed(module=Quantity(modules[id_], "mm", f"{float(modules[id_]):.9g} mm"))
                    for id_, wheel in link.wheels.items()
                }
            )
        )
        for name, link in declared.links.items()
    }
    return declared.changed(links=FrozenDict(links))


def _with_backlash(declared: Train, modules: Mapping[str, Fraction], backlash: float | None) -> Train:
    """With the play asked for, in modules, on every pair whose form says nothing of it."""
    own = {gear.name: problem for gear in declared.gears if (problem := _own_play(declared, gear)) is not None}
    if backlash is not None and own and len(own) == sum(declared.form_of(gear) is not None for gear in declared.gears):
        places = {gear.name: declared.place("gears", at) for at, gear in enumerate(declared.gears)}
        raise QuestionError(replace(problem, place=places[name]) for name, problem in own.items())
    gears = tuple(gear if gear.name in own else _thinned(declared, gear, modules, backlash) for gear in declared.gears)
    if all(new is old for new, old in zip(gears, declared.gears, strict=True)):
        return declared  # no pair declares a form: standard teeth are thinned as they are cut, and nothing moves
    return declared.changed(gears=gears)


def _thinned(declared: Train, gear: GearPair, modules: Mapping[str, Fraction], backlash: float | None) -> GearPair:
    form = declared.form_of(gear)
    if form is None:
        return gear
    play = Fraction(str(PLAY)) if backlash is None else Fraction(backlash) / modules[gear.pair[0]]
    thinner = form.thinned(Quantity(play, None, f"{float(play):.9g}"))
    return gear if thinner is form else gear.changed(tooth_form=thinner)


def _own_play(declared: Train, gear: GearPair) -> Problem | None:
    """Why the play of a pair is not for a maker to say; None where it is."""
    form = declared.form_of(gear)
    return None if form is None else form.own_play(gear.name)


def thick(layout: Layout, making: ManufacturingSizes) -> Layout:
    """The layout with wheels of the thickness asked for."""
    if making.thickness is None:
        return layout
    wheels = {name: replace(place, thickness=making.thickness) for name, place in layout.wheels.items()}
    return replace(layout, wheels=wheels)


def bores(layout: Layout, making: ManufacturingSizes) -> dict[str, float]:
    """Diameter (mm) of the arbor on each axis: the one asked for, or a third of the smallest wheel's, 6 at most."""
    if making.bore is not None:
        return dict.fromkeys(layout.axes, making.bore)
    found = {}
    for label in layout.axes:
        radii = [place.radius - DEDENDUM * place.module for place in layout.wheels.values() if place.axis == label]
        smallest = min((radius for radius in radii if radius > 0), default=3.0)
        found[label] = round(min(6.0, 2 * smallest / 3), 2)
    return found
