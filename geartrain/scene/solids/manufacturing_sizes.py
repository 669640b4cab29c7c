"""Manufacturing sizes of a train, and the train with its modules, thicknesses and backlash set to these sizes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from math import log
from statistics import median

from geartrain.analysis.gear_train import GearTrain
from geartrain.errors import Problem, QuestionError
from geartrain.numerics.containers import FrozenDict
from geartrain.numerics.quantity import Quantity
from geartrain.numerics.results import Shown
from geartrain.scene.layout import Layout
from geartrain.scene.layout.wheel_modules import WIDE
from geartrain.scene.parts.processes import process_named
from geartrain.teeth.standard_teeth import BACKLASH, DEDENDUM
from geartrain.train import GearPair, Train
from geartrain.train.declaration import wheel_thickness

_SAME_LEVEL = 1e-3  # mm: tolerance for equal thicknesses
_STOCK = (
    *(0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0),
    *(10.0, 12.0, 15.0, 20.0, 25.0, 30.0),
)  # mm: standard thicknesses of sheet
_MADE = {"module": (0.05, 100), "thickness": (0.01, 1000), "bore": (0.01, 1000), "backlash": (1e-6, 100)}
"""Minimum and maximum of each size that can be made [mm]. Outlines are accurate to 0.001 mm, and arbors and plates are
a few mm thick.
"""
_SHEET = (1, 1e5)  # mm: limits of the sides of sheets
_NEAR = 1.3  # maximum ratio of a sheet's thickness to 2.5 modules, or the inverse


@dataclass(frozen=True, slots=True)
class ManufacturingSizes(Shown):
    """Manufacturing sizes of the parts of a train. Sizes that are None are chosen to suit the train.

    Raises
    ------
    QuestionError
        If a size is out of the range that can be made, or the process is unknown.

    Examples
    --------
    >>> ManufacturingSizes(module=2.0, bore=6.0)
    <ManufacturingSizes module=2, bore=6>
    """

    module: float | None = None
    """Module, which is the pitch diameter divided by the tooth count [mm], above 0. Only for declarations without
    sizes.
    """
    thickness: float | None = None
    """Thickness of wheels and plates [mm], above 0."""
    bore: float | None = None
    """Diameter of the arbors [mm]. If it is 0, arbors, plates and the holes of wheels are omitted."""
    backlash: float | None = None
    """Circumferential backlash at the pitch circle of every pair whose backlash is not determined by its declaration
    [mm], 0 or more.

    If it is None, it is the backlash of the process, or 1/20 of the module if no process is named.
    """
    process: str | None = None
    """Manufacturing process: laser, cnc, fdm or hand; None for hand. It determines the kerf and the fits."""
    arms: int | None = None
    """Number of spokes, 3 or more, of each wheel that has enough space for openings between spokes; None for solid
    webs.
    """
    sheet: tuple[float, float] | None = None
    """Width and height of the sheets on which flat parts are arranged [mm], above 0; None if parts are not arranged on
    sheets.
    """

    def __post_init__(self) -> None:
        """Raise `QuestionError` if a size is out of range or the process is unknown."""
        process_named(self.process)
        problems = []
        if self.arms is not None and self.arms < 3:
            what = f"a wheel cannot have {self.arms} spokes"
            why, fix = "a wheel with spokes has at least 3 of them", "pass 3 or more, or omit --spokes for solid webs"
            problems.append(Problem(what, why, fix, "--spokes"))
        for name, bounds in _MADE.items():
            value = getattr(self, name)
            if value is not None and not (value == 0 and name in ("bore", "backlash")):
                problems += _beyond(f"a {name}", value, bounds, f"--{name}")
        for side in self.sheet or ():
            problems += _beyond("a side of a sheet", side, _SHEET, "--sheet")
        if problems:
            raise QuestionError(problems)


def _beyond(noun: str, value: float, bounds: tuple[float, float], place: str) -> list[Problem]:
    """Return a problem if a size [mm] is out of the range that can be made; empty if it is within the range."""
    low, high = bounds
    if low <= value <= high:
        return []
    why = "drawings are accurate to 0.001 mm, and arbors and plates are a few millimetres thick"
    return [Problem(f"{noun} of {value:g} mm cannot be made", why, f"give {noun} from {low:g} to {high:g} mm", place)]


def sized(train: GearTrain, layout: Layout, making: ManufacturingSizes) -> GearTrain:
    """Return the train with the requested modules and backlash, as if they were declared.

    The same train is returned if no module is requested and no tooth form is declared.

    Raise `QuestionError` if a module is requested but the train declares sizes, if a wheel is too small or too large to
    be made, or if the requested backlash is not possible for the teeth.

    layout   layout of the train as declared
    """
    declared, factor = train.declaration, scale_of(layout, making)
    modules = {name: Fraction(place.module) * Fraction(factor) for name, place in layout.wheels.items()}
    _check_made(declared, modules, layout)
    if making.module is not None:
        declared = _with_modules(declared, modules)
    declared = _with_backlash(declared, modules, making.backlash)
    return train if declared is train.declaration else GearTrain(declared)


def _check_made(declared: Train, modules: Mapping[str, Fraction], layout: Layout) -> None:
    """Raise `QuestionError` if the declared size of a wheel is too small or too large to be made."""
    problems: list[Problem] = []
    for name, module in modules.items():
        place = declared.place("links", declared.wheels[name][0], "wheels", name)
        problems += _beyond("a module", float(module), _MADE["module"], place)
        problems += _beyond("a thickness", layout.wheels[name].thickness, _MADE["thickness"], place)
    if problems:
        raise QuestionError(problems)


def scale_of(layout: Layout, making: ManufacturingSizes) -> float:
    """Return the factor by which a requested module enlarges a layout; 1 if no module is requested.

    Raise `QuestionError` if a module is requested but the train declares sizes.
    """
    if making.module is None or not layout.wheels:
        return 1.0
    given = [name for name, place in layout.wheels.items() if place.given]
    placed = [label for label, axis in layout.axes.items() if axis.how == "given"]
    if given or placed:
        named = f"the module of '{given[0]}'" if given else f"the position of axis '{placed[0]}'"
        why = f"it gives {named}, and declared sizes take precedence"
        fix = "omit --module, or remove the sizes from the file"
        raise QuestionError(Problem("no module can be set: the declaration already has sizes", why, fix, "--module"))
    return making.module / usual_module(layout)


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
    """Return the declaration with the given backlash where pairs allow it; raise `QuestionError` if none allows it."""
    own = {gear.name: problem for gear in declared.gears if (problem := _own_backlash(declared, gear)) is not None}
    if backlash is not None and own and len(own) == sum(declared.form_of(gear) is not None for gear in declared.gears):
        places = {gear.name: declared.place("gears", at) for at, gear in enumerate(declared.gears)}
        raise QuestionError(replace(problem, place=places[name]) for name, problem in own.items())
    gears = tuple(gear if gear.name in own else _thinned(declared, gear, modules, backlash) for gear in declared.gears)
    if all(new is old for new, old in zip(gears, declared.gears, strict=True)):
        return declared  # no pair declares a form: standard teeth are thinned when cut
    return declared.changed(gears=gears)


def _thinned(declared: Train, gear: GearPair, modules: Mapping[str, Fraction], backlash: float | None) -> GearPair:
    form = declared.form_of(gear)
    if form is None:
        return gear
    if not form.has_shape:
        # standard teeth are cut, which keep the ratio whatever error is given
        return gear if form.form == "ideal" else gear.changed(tooth_form={"form": "ideal"})
    # from the decimal string: the float itself is not exactly that decimal
    share = Fraction(str(BACKLASH)) if backlash is None else Fraction(backlash) / modules[gear.pair[0]]
    thinner = form.thinned(Quantity(share, None, f"{float(share):.9g}"))
    return gear if thinner is form else gear.changed(tooth_form=thinner)


def _own_backlash(declared: Train, gear: GearPair) -> Problem | None:
    """Return a problem if the tooth form of a pair determines its backlash; None if the backlash can be chosen."""
    form = declared.form_of(gear)
    return None if form is None or not form.has_shape else form.own_backlash(gear.name)


def with_backlash(train: GearTrain, layout: Layout, making: ManufacturingSizes) -> ManufacturingSizes:
    """Return the sizes with the backlash of the named process, unless it is given or fixed by all tooth forms."""
    declared = train.declaration
    own = [_own_backlash(declared, gear) is not None for gear in declared.gears if declared.form_of(gear) is not None]
    if making.process is None or making.backlash is not None or not layout.wheels or (own and all(own)):
        return making
    backlash = process_named(making.process).backlash * usual_module(layout) * scale_of(layout, making)
    return replace(making, backlash=backlash)


def usual_module(layout: Layout) -> float:
    """Return the most frequent module among the wheels [mm]."""
    # rounded, so that equal modules count as one
    return Counter(round(place.module, 9) for place in layout.wheels.values()).most_common(1)[0][0]


def thick(declared: Train, layout: Layout, making: ManufacturingSizes) -> Layout:
    """Return the layout with wheels of the requested thickness, or, by default, with thicknesses of standard sheets.

    If all axes are along z, levels are moved apart as wheels become thicker.
    """
    wanted = _thicknesses(declared, layout, making)
    if all(wanted[name] == place.thickness for name, place in layout.wheels.items()):
        return layout
    upright = all(abs(layout.axes[place.axis].direction[2]) == 1 for place in layout.wheels.values())
    more: dict[float, float] = {}
    for name, place in layout.wheels.items():
        height = round(place.centre[2], 6)
        more[height] = max(more.get(height, 0.0), wanted[name] - place.thickness)
    wheels = {}
    for name, place in layout.wheels.items():
        below = [growth for height, growth in sorted(more.items()) if height < place.centre[2] - _SAME_LEVEL]
        x, y, z = place.centre
        centre = (x, y, z + sum(below)) if upright else place.centre
        wheels[name] = replace(place, thickness=wanted[name], centre=centre)
    return replace(layout, wheels=wheels)


def _thicknesses(declared: Train, layout: Layout, making: ManufacturingSizes) -> dict[str, float]:
    """Return the thickness of each wheel [mm], by name: as requested, as declared, or one standard thickness."""
    if making.thickness is not None:
        return dict.fromkeys(layout.wheels, making.thickness)
    own = {name: place.thickness for name, place in layout.wheels.items()}
    # spur wheels with the default thickness for their module, which is neither declared nor increased
    free = [
        name
        for name, place in layout.wheels.items()
        if declared.wheels[name][1].kind == "spur"
        and wheel_thickness(declared, declared.wheels[name][1]) is None
        and abs(place.thickness - WIDE * place.module) <= _SAME_LEVEL
    ]
    if not free:
        return own
    usual = median(own[name] for name in free)
    # nearest by ratio, because stock sizes are roughly a geometric series
    stock = min(_STOCK, key=lambda each: abs(log(each / usual)))
    return own if abs(log(stock / usual)) > log(_NEAR) else own | dict.fromkeys(free, stock)


def bores(layout: Layout, making: ManufacturingSizes) -> dict[str, float]:
    """Return the diameter of the arbor of each axis of a mechanism without plates [mm]: the given diameter, or 1/3 of
    the smallest root diameter on the axis.
    """
    if making.bore is not None:
        return dict.fromkeys(layout.axes, making.bore)
    found = {}
    for label in layout.axes:
        radii = [place.radius - DEDENDUM * place.module for place in layout.wheels.values() if place.axis == label]
        smallest = min((radius for radius in radii if radius > 0), default=3.0)
        found[label] = round(min(6.0, 2 * smallest / 3), 2)
    return found
