"""Options of `geartrain mesh`: the fields of a tooth form, wheels, friction, and the outline of a whole wheel.

The options of a form are the fields of its model, validated as in a declaration. Friction is a coefficient, or a
function of speed with `--rate`. `--profile` writes the outline of a whole wheel, to scale.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, replace
from inspect import Parameter, Signature
from math import cos, pi
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeVar, get_args, get_origin

import typer

from geartrain.cli.common import Sink, emit, sink
from geartrain.cli.option_values import at_option, quantity
from geartrain.cli.option_values import friction as read_coefficient
from geartrain.errors import GearTrainError, Problem, suggest

if TYPE_CHECKING:
    from pydantic.fields import FieldInfo

    from geartrain.teeth.conjugate.wheel_pair import WheelPair
    from geartrain.teeth.friction_law import FrictionLaw
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.meshing_wheels import MeshingWheels
    from geartrain.teeth.outlines.wheel_outline import BlankSizes, WheelOutline
    from geartrain.teeth.tooth_form import ToothForm

    Mesh = TypeVar("Mesh", bound=GearMesh)


FormOptions = dict[str, str | bool | None]

_PER_WHEEL = ("shift", "addendum", "dedendum", "radius", "thickness")
"""Fields with one value for each wheel; other pairs of values are for approach and recess."""

Internal = Annotated[bool, typer.Option("--internal", help="Make the second wheel a ring.")]


def option_name(field: str) -> str:
    """Return the option of a field: `--centre-distance` for `centre_distance`."""
    return f"--{field.replace('_', '-')}"


def own_options(model: type[ToothForm]) -> dict[str, tuple[type, str]]:
    """Return type and help text of the options of a form, by the names of its fields.

    Forms that keep their design at any centre distance have no option for it. Fields for the time domain have no
    option.
    """
    hidden = {"form", *model.in_time} | (set() if model.any_distance else {"centre_distance"})
    return {name: _option(name, field) for name, field in model.model_fields.items() if name not in hidden}


def form_command(
    model: type[ToothForm],
    run: Callable[..., None],
    words: str,
    defaults: Mapping[str, str] | None = None,
    without: Collection[str] = (),
) -> Callable[..., None]:
    """Create the command of a form: the options of `run`, with the form's own options after the first.

    run        function that takes the options by name, and those of the form that it does not name as `own`
    words      help text
    defaults   default values of the form's own options, if the form has none
    without    options of `run` that the form does not have
    """
    first, *rest = Signature.from_callable(run, eval_str=True).parameters.values()
    taken = [each for each in rest if each.kind is not Parameter.VAR_KEYWORD and each.name not in without]
    own = [
        Parameter(
            name,
            Parameter.KEYWORD_ONLY,
            default=(defaults or {}).get(name),
            annotation=Annotated[kind | None, typer.Option(option_name(name), help=text)],
        )
        for name, (kind, text) in own_options(model).items()
        if name not in {each.name for each in taken}
    ]
    parameters = [each.replace(kind=Parameter.KEYWORD_ONLY) for each in (first, *own, *taken)]

    def command(**given: Any) -> None:
        run(**given)

    # typer reads the options from the signature and their types from the annotations
    command.__signature__ = Signature(parameters)  # type: ignore[attr-defined]
    command.__annotations__ = {each.name: each.annotation for each in parameters}
    command.__doc__ = words
    return command


def _option(name: str, field: FieldInfo) -> tuple[type, str]:
    # a declaration takes a list where an option takes two values separated by a comma
    text = re.sub("[,;] one or one a wheel", "", field.description or "").replace(
        "a list of two", "a pair of values with a comma"
    )
    if isinstance(field.default, bool):
        return bool, f"{text}."
    if any(each not in text for each in _words(field.annotation)):
        text += f": {', '.join(_words(field.annotation))}"
    if _is_pair(field.annotation) and "comma" not in text:
        pair = "; one value, or two separated by a comma" + (" (first, second wheel)" if name in _PER_WHEEL else "")
        before, *default = re.split(r"(?=[;.] [Dd]efault )", text, maxsplit=1)
        text = before + pair + "".join(default)
    if field.default is not None and not field.is_required():
        text += f"; default {field.default}"
    return str, f"{text}."


def _words(annotation: Any) -> list[str]:
    """Return the words among which the value of a field is chosen."""
    if get_origin(annotation) is Literal:
        return [each for each in get_args(annotation) if isinstance(each, str)]
    return [word for each in get_args(annotation) for word in _words(each)]


def _is_pair(annotation: Any) -> bool:
    return get_origin(annotation) is tuple or any(map(_is_pair, get_args(annotation)))


def read_form(model: type[ToothForm], given: FormOptions, place: str = "") -> ToothForm:
    """Create the tooth form from options.

    Raises `GearTrainError` for invalid options, at `place` if no single option is at fault.
    """
    fields = model.model_fields
    (form,) = get_args(fields["form"].annotation)
    try:
        return model.declared({name: _value(fields[name], each) for name, each in given.items() if each is not None})
    except GearTrainError as error:
        raise as_options(error, place or f"mesh {form}", f"see geartrain mesh {form} --help") from None


def as_options(error: GearTrainError, place: str, fix: str = "") -> GearTrainError:
    """Convert the parameter names in an error to options; `place` and `fix` are used where it has none."""
    return GearTrainError(
        replace(each, place=option_name(each.place) if each.place else place, fix=each.fix or fix)
        for each in error.problems
    )


def _value(field: FieldInfo, given: str | bool) -> Any:
    """Convert the value of an option as in a declaration: a list if it has a comma, an integer if one can be chosen."""
    if isinstance(given, bool):
        return given
    if given.isdigit() and int(given) in get_args(field.annotation):
        return int(given)
    return [part.strip() for part in given.split(",")] if "," in given else given


def read_shaft_angle(internal: bool, bevel: str | None) -> float | None:
    """Parse the shaft angle [rad] of bevel wheels; None for parallel axes. Raises `GearTrainError`."""
    if internal and bevel is not None:
        why = "a ring and its pinion have parallel axes"
        raise GearTrainError(Problem("a ring is not a bevel wheel", why, "give --internal or --bevel", "--bevel"))
    return None if bevel is None else quantity("--bevel", bevel, "angle")


def read_helix(helix: str | None, shaft_angle: float | None) -> float:
    """Parse the helix angle [rad] of a pair on parallel axes; 0 for spur wheels. Raises `GearTrainError`."""
    angle = 0.0 if helix is None else quantity("--helix", helix, "angle")
    if shaft_angle is not None and angle:
        why = "helical teeth are implemented for parallel axes only"
        raise GearTrainError(Problem("bevel wheels have no helix angle", why, "give --bevel or --helix", "--helix"))
    if not 0 <= angle < pi / 2:
        what = f"a helix angle of {helix} is outside 0 to 90 deg"
        raise GearTrainError(Problem(what, "it is measured from the axis", "give for example --helix 20deg", "--helix"))
    return angle


def read_module(module: str | None, backlash: str | None = None) -> float | None:
    """Parse the module [m]; None if not given.

    Raises `GearTrainError`, also if a backlash with a unit is given without a module.
    """
    size = None if module is None else quantity("--module", module, "length")
    if size is not None and size <= 0:
        raise GearTrainError(Problem(f"the module {module} is not positive", "", "give a module above 0", "--module"))
    if size is None and backlash is not None and quantity("--backlash", backlash, "length", plain=True):
        _check_plain(backlash)
    return size


def _check_plain(backlash: str) -> None:
    from geartrain.numerics.quantity import Quantity

    if Quantity.parse(backlash, "length", True).unit is not None:
        why = "sizes of a tooth form are in modules"
        fix = "give for example --module 2mm, or the backlash as a plain number of modules"
        raise GearTrainError(
            Problem(f"the backlash {backlash} has a unit, but the module is unknown", why, fix, "--module")
        )


def read_wheels(teeth: tuple[int, int], internal: bool, bevel: str | None) -> WheelPair:
    """Create two wheels without a size for conjugate teeth. Raises `GearTrainError`."""
    from geartrain.teeth.conjugate.wheel_pair import WheelPair

    wheels = WheelPair(*teeth, internal, read_shaft_angle(internal, bevel))
    try:
        wheels.check()
    except GearTrainError as error:
        raise at_option(error, "--teeth") from None
    return wheels


def pair_in_mesh(form: ToothForm, wheels: MeshingWheels, shaft_angle: float | None, driver: int) -> GearMesh:
    """Create the mesh of two wheels, driven by the first or the second.

    Raises `GearTrainError` if the form cannot mesh in this pair.
    """
    from geartrain.teeth.meshing_wheels import MeshDriver

    mesh = form.mesh(wheels, lambda: shaft_angle)
    assert mesh is not None  # ideal teeth have no command
    return mesh.driven_by(MeshDriver(wheels.gear.pair[driver - 1], ""))


def two_wheels(
    teeth: tuple[int, int],
    friction: float,
    module: float | None,
    internal: bool = False,
    shaft_angle: float | None = None,
    helix: float = 0.0,
) -> MeshingWheels:
    """Create the wheels of a pair without a train; normal module in m, helix angle of the first wheel in rad."""
    from geartrain.teeth.meshing_wheels import MeshingWheels
    from geartrain.train import GearPair

    kind = "helical" if helix else "spur" if shaft_angle is None else "bevel"
    # the transverse module is the normal module divided by the cosine of the helix angle
    distance = None if module is None else module / cos(helix) * sum(teeth) / 2
    pair = GearPair(pair=("wheel 1", "wheel 2"))
    # external helical wheels have opposite hands, a ring has the hand of its pinion
    lean = (helix, helix if internal else -helix)
    return MeshingWheels(pair, "", teeth, (kind, kind), (False, internal), friction, distance, helix=lean)


# --------------------------------------------------------------------------------------------------- outline of a wheel


Profile = Annotated[
    Path | None, typer.Option("--profile", help="Write the outline of a whole wheel, to scale: .svg, .dxf, .csv.")
]
WheelNumber = Annotated[int, typer.Option("--wheel", min=1, max=2, help="With --profile: number of the wheel, 1 or 2.")]
Bore = Annotated[str | None, typer.Option("--bore", help="With --profile: diameter of the bore, such as 5mm.")]
Tolerance = Annotated[
    str, typer.Option("--tolerance", help="With --profile: maximum deviation of chords from a flank.")
]
FINE = "0.001mm"
"""Default chord tolerance of outlines."""


def profile_sink(profile: Path | None, force: bool) -> Sink:
    """Return the destination of an outline, after checking that it can be written. Raises `GearTrainError`."""
    from geartrain.drawing.flat_files import OUTLINES

    to = sink(profile, force, option="--profile")
    if to.path is not None and to.suffix not in OUTLINES:
        what = f"'{to.suffix}' is not an outline format"
        raise GearTrainError(Problem(what, "", f"use {', '.join(OUTLINES)}", "--profile"))
    return to


def write_profile(mesh: GearMesh, wheel: int, blank: Mapping[str, str | None], to: Sink) -> list[WheelOutline]:
    """Write the outline of a wheel and return it; empty if no file is named.

    `blank` contains the sizes of the wheel as given by options.
    """
    if to.path is None:
        return []
    from geartrain.drawing import outline_text

    made = mesh.wheel_outline(wheel, _blank_sizes(mesh.wheels.module, blank))
    emit(outline_text(made, to.suffix), to)
    return [made]


def _blank_sizes(module: float | None, sizes: Mapping[str, str | None]) -> BlankSizes:
    """Parse the sizes of a wheel [mm]; `module` is in m."""
    from geartrain.teeth.outlines.wheel_outline import BlankSizes

    if module is None:
        why = "an outline is written to scale"
        raise GearTrainError(Problem("the module is missing", why, "give for example --module 2mm", "--module"))
    given = {name: 1000 * quantity(f"--{name}", text, "length") for name, text in sizes.items() if text is not None}
    return BlankSizes(1000 * module, **given)


# ------------------------------------------------------------------------------------------------------------- friction


Friction = Annotated[
    str,
    typer.Option(
        "--friction",
        help="Coefficient of friction, or a friction law: buckingham, dokos, "
        "'stribeck,static=0.2,kinetic=0.08,speed=10 mm/s', or a table.",
    ),
]
Rate = Annotated[str | None, typer.Option("--rate", help="Speed of the driving wheel, such as '1 turn/s'.")]


@dataclass(frozen=True)
class PairFrictionOption:
    """Value of `--friction`: a coefficient, or a friction law."""

    coefficient: float
    """Coefficient of friction; 0 if a law is given."""
    law: FrictionLaw | None = None

    def number(self, option: str) -> float:
        """Return the coefficient. Raises `GearTrainError` if a friction law is given with an option that needs a
        number.
        """
        if self.law is not None:
            what = f"{option} needs a coefficient of friction"
            raise GearTrainError(
                Problem(what, "a friction law is given", "give for example --friction 0.1", "--friction")
            )
        return self.coefficient

    def of(self, mesh: Mesh, rate: str | None) -> Mesh:
        """Return the mesh with this friction at the speed of its driver. Raises `GearTrainError` if that is unknown."""
        if self.law is None:
            return mesh
        radius = mesh.pitch_radius
        if radius is None or rate is None:
            missing = {"--rate": ("the speed of the driver", rate), "--module": ("the module", radius)}
            lacking = {option: word for option, (word, value) in missing.items() if value is None}
            what = f"the friction law '{self.law.law}' depends on the sliding speed"
            why = f"unknown: {' and '.join(lacking.values())}"
            raise GearTrainError(Problem(what, why, f"give {' and '.join(lacking)}", "--friction"))
        if mesh.driver != mesh.gear.pair[0]:
            first, second = mesh.wheels.counts
            # the pitch radius is that of the first wheel, the speed that of the driver
            radius *= second / first
        speed = quantity("--rate", rate, "speed", minimum="above 0") * radius
        return replace(mesh, wheels=replace(mesh.wheels, friction=None, friction_law=self.law, pitch_line=speed))


def read_pair_friction(text: str) -> PairFrictionOption:
    """Parse a coefficient of friction or the friction law that a text names. Raises `GearTrainError`."""
    name = text.split(",")[0].strip()
    if "=" not in text and name not in ("buckingham", "dokos", "stribeck", "table"):
        return PairFrictionOption(read_coefficient(text))
    from pydantic import TypeAdapter, ValidationError

    from geartrain.teeth.friction_law import FrictionLawOfText

    try:
        return PairFrictionOption(0.0, TypeAdapter[Any](FrictionLawOfText).validate_python(text))
    except ValidationError as error:
        raise GearTrainError(map(_problem, error.errors(include_url=False))) from None


def _problem(item: Any) -> Problem:
    if item["type"] == "union_tag_invalid":
        from geartrain.train.validation import unknown_tag

        given = item["ctx"]["tag"]
        return Problem(f"'{given}' is not a friction law", "", suggest(given, unknown_tag(item)[1]), "--friction")
    key = ".".join(str(step) for step in item["loc"][1:])
    what = f"{key}: {item['msg']}" if key else item["msg"]
    return Problem(what, "", str((item.get("ctx") or {}).get("fix", "see docs/shapes.md, section 15")), "--friction")
