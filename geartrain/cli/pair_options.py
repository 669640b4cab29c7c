"""Parsers for options of `geartrain mesh`: parameters of the tooth form, wheels, friction, outline of a wheel.

The parameters are the keys of `tooth_form` in a declaration, validated by the model of the form.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import cos, pi
from typing import TYPE_CHECKING, Any, Literal, TypeVar, get_args, get_origin

from geartrain.cli.common import Sink, emit, option_error
from geartrain.cli.option_values import at_option, quantity
from geartrain.cli.option_values import friction as read_coefficient
from geartrain.errors import GearTrainError, Problem, suggest
from geartrain.teeth.triangular.triangular_form import CLEARANCES, FEWEST, Triangular

if TYPE_CHECKING:
    from pydantic.fields import FieldInfo

    from geartrain.report.document import Document
    from geartrain.teeth.conjugate.wheel_pair import WheelPair
    from geartrain.teeth.friction_law import FrictionLaw
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.outlines.wheel_outline import WheelOutline
    from geartrain.teeth.tooth_form import ToothForm

    Mesh = TypeVar("Mesh", bound=GearMesh)


COUNTS = "Z1 Z2"
"""Location at which errors in the tooth counts are reported."""
PAIR = ("friction", "z1", "z2")
"""Quantities that can be varied in addition to the parameters of the tooth form."""


# ------------------------------------------------------------------------------------------------- parameters of a form


def parameters_of(model: type[ToothForm]) -> dict[str, FieldInfo]:
    """Return the fields of a tooth form that can be set for a single pair, keyed by name.

    Fields for simulations in time, internal fields, and a `centre_distance` that has no effect are omitted.
    """
    hidden = {"form", *model.in_time} | (set() if model.any_distance else {"centre_distance"})
    return {name: field for name, field in model.model_fields.items() if name not in hidden and field.repr}


def describe_parameters(form: str, model: type[ToothForm]) -> Document:
    """Return a document with a table of the parameters of a tooth form: key, default value and meaning."""
    from geartrain.report.document import Document, Section, Table

    required = model.with_defaults({})
    rows = []
    for name, field in parameters_of(model).items():
        default = "" if field.is_required() or field.default is None else field.default
        rows.append((name, str(required.get(name, default)), _meaning(field)))
    table = Table(("key", "default", "meaning"), rows)
    text = f"Give each as `-p KEY=VALUE`. They are the keys of `tooth_form: {{form: {form}}}` in a declaration."
    return Document(f"Parameters of {form} teeth", (text,), [Section("Keys", (), [table])])


def _meaning(field: FieldInfo) -> str:
    """Return the description of a parameter, in which a list of two values is written with a comma, as in an option."""
    text = (field.description or "").replace("a list of two gives", "a,b gives").replace("a list of two", "two: a,b")
    words = [word for word in _words(field.annotation) if word not in text]
    return f"{text}: {', '.join(words)}" if words else text


def _words(annotation: Any) -> list[str]:
    """Return the literal strings that a field with this type annotation accepts as values."""
    if get_origin(annotation) is Literal:
        return [each for each in get_args(annotation) if isinstance(each, str)]
    return [word for each in get_args(annotation) for word in _words(each)]


def read_assignments(texts: Iterable[str], known: Sequence[str], option: str, fix: str = "") -> dict[str, str]:
    """Parse KEY=VALUE options into a mapping; raise `QuestionError` if a key is unknown or given twice."""
    found: dict[str, str] = {}
    for text in texts:
        name, equals, value = map(str.strip, text.partition("="))
        if not equals or not value:
            raise option_error(option, f"'{text}' is not an assignment", "write it as KEY=VALUE")
        if name not in known:
            ways = "; ".join(filter(None, (suggest(name, known), fix)))
            raise option_error(f"{option} {name}", f"unknown key '{name}'", ways)
        if name in found:
            raise option_error(f"{option} {name}", "this key is given twice", "give it once")
        found[name] = value
    return found


def read_form(model: type[ToothForm], given: Mapping[str, str]) -> ToothForm:
    """Create the tooth form from parameters; errors have the location `-p KEY`."""
    fields = model.model_fields
    try:
        return model.declared(model.with_defaults({name: _value(fields[name], each) for name, each in given.items()}))
    except GearTrainError as error:
        (form,) = get_args(fields["form"].annotation)
        raise at_parameter(error, "-p", f"`geartrain mesh --form {form} --keys` lists the parameters") from None


def at_parameter(error: GearTrainError, place: str, fix: str = "") -> GearTrainError:
    """Return a copy of the error in which each problem has a location: `-p KEY` if the problem names a key, the option
    if it names an option, and `place` if it names neither. The remedy `fix` is added to problems that have no remedy.
    """

    def located(named: str) -> str:
        return place if not named else named if named.startswith("-") else f"-p {named}"

    return GearTrainError(replace(each, place=located(each.place), fix=each.fix or fix) for each in error.problems)


def _value(field: FieldInfo, given: str) -> Any:
    """Convert text to a field's value: YAML if it begins with a bracket or brace, a list if it contains a comma."""
    if given[:1] in ("[", "{"):
        from geartrain.train.yaml_nodes import parse_yaml

        return parse_yaml(f"value: {given}", "-p").plain()["value"]
    if given.isdigit() and int(given) in get_args(field.annotation):
        return int(given)
    return [part.strip() for part in given.split(",")] if "," in given else given


# --------------------------------------------------------------------------------------------------------------- wheels


def read_shaft_angle(internal: bool, angle: str | None) -> float | None:
    """Parse the shaft angle of bevel wheels [rad]; None for parallel axes. An angle for a ring gear is an error."""
    if internal and angle is not None:
        why, fix = "a ring and its pinion have parallel axes", "omit --internal or --shaft-angle"
        raise option_error("--shaft-angle", "a ring gear is given with a shaft angle", fix, why)
    return None if angle is None else quantity("--shaft-angle", angle, "angle")


def read_helix(helix: str | None, shaft_angle: float | None) -> float:
    """Parse the helix angle of a pair on parallel axes [rad], from 0 to less than 90 deg; 0 if `helix` is None."""
    angle = 0.0 if helix is None else quantity("--helix", helix, "angle")
    if shaft_angle is not None and angle:
        why = "helical teeth are implemented for parallel axes only"
        raise option_error("--helix", "a helix angle is given for bevel wheels", "omit --shaft-angle or --helix", why)
    if not 0 <= angle < pi / 2:
        what = f"a helix angle of {helix} is out of range"
        why = "it is measured from the axis, and must be at least 0 and less than 90 deg"
        raise option_error("--helix", what, "for example, give --helix 20deg", why)
    return angle


def read_module(module: str | None) -> float | None:
    """Parse the module [m]; None if it is not given. A value that is not a positive length raises an error."""
    return None if module is None else quantity("--module", module, "length", minimum="above 0")


def read_wheels(teeth: tuple[int, int], internal: bool, angle: str | None) -> WheelPair:
    """Create a pair of wheels without dimensions; raise `GearTrainError` if the wheels cannot mesh."""
    from geartrain.teeth.conjugate.wheel_pair import WheelPair

    wheels = WheelPair(*teeth, internal, read_shaft_angle(internal, angle))
    try:
        wheels.check()
    except GearTrainError as error:
        raise at_option(error, COUNTS) from None
    return wheels


@dataclass(frozen=True)
class PairRequest:
    """Pair of wheels that is described by the options of `geartrain mesh`. A sweep replaces some of their values."""

    model: type[ToothForm]
    teeth: tuple[int, int]
    own: Mapping[str, str]
    """Parameters of the tooth form as text, keyed by parameter name."""
    module: float | None = None
    """Normal module of the pair [m]; None if no module is given."""
    friction: str = "0"
    driver: int = 1
    rate: str | None = None
    internal: bool = False
    shaft_angle: float | None = None
    """Shaft angle of bevel wheels [rad]; None for parallel axes."""
    helix: float = 0.0
    """Helix angle of the first wheel [rad]; 0 for spur wheels."""

    def mesh(self, **varied: str) -> GearMesh:
        """Create the gear mesh of the pair with the values in `varied`; raise `GearTrainError` if it is invalid."""
        from geartrain.teeth.meshing_wheels import MeshDriver, MeshingWheels
        from geartrain.train import GearPair

        # tooth counts in a sweep are floats
        z1, z2 = (round(float(varied.get(name, z))) for name, z in zip(("z1", "z2"), self.teeth, strict=True))
        rub = read_pair_friction(varied.get("friction", self.friction))
        ring = self.internal or self.model.ringed
        kind = "helical" if self.helix else "spur" if self.shaft_angle is None else "bevel"
        # the transverse module is the normal module divided by the cosine of the helix angle
        distance = None if self.module is None else self.module / cos(self.helix) * (z1 + z2) / 2
        # external helical wheels have opposite hands, a ring has the hand of its pinion
        helices = (self.helix, self.helix if ring else -self.helix)
        pair, kinds, rings = GearPair(pair=("wheel 1", "wheel 2")), (kind, kind), (False, ring)
        wheels = MeshingWheels(pair, "", (z1, z2), kinds, rings, rub.coefficient, distance, helix=helices)
        form = self.form({name: value for name, value in varied.items() if name not in PAIR})
        try:
            mesh = form.mesh(wheels, lambda: self.shaft_angle)
            assert mesh is not None  # ideal teeth are not among the forms of the command
            return rub.of(mesh.driven_by(MeshDriver(wheels.gear.pair[self.driver - 1], "")), self.rate)
        except GearTrainError as error:
            # with enough teeth a clearance is the likely cause, otherwise the tooth counts
            placed = [name for name in CLEARANCES if name in self.own and self.model is Triangular]
            raise at_parameter(error, f"-p {placed[0]}" if placed and min(z1, z2) >= FEWEST else COUNTS) from None

    def form(self, varied: Mapping[str, str]) -> ToothForm:
        """Create the tooth form with the values in `varied`. If one of them is a clearance, others are not used."""
        replaced = {*CLEARANCES} if {*varied} & {*CLEARANCES} else set()
        return read_form(
            self.model, {name: text for name, text in self.own.items() if name not in replaced} | dict(varied)
        )


# --------------------------------------------------------------------------------------------------- outline of a wheel


BLANK = ("bore", "tolerance", "clearance", "fillet", "rim")
"""Sizes of a wheel that its tooth form does not fix; `clearance`, `fillet` and `rim` are for conjugate teeth only."""


def write_profile(mesh: GearMesh, wheel: int, blank: Mapping[str, str], to: Sink) -> list[WheelOutline]:
    """Write the outline of a wheel to the file `to`; return a list with the outline, empty if there is no file."""
    if to.path is None:
        return []
    from geartrain.drawing import outline_text
    from geartrain.teeth.outlines.wheel_outline import BlankSizes

    if (module := mesh.wheels.module) is None:
        fix, why = "for example, give --module 2mm", "an outline is written to scale"
        raise option_error("--module", "the module is missing", fix, why)
    sizes = {"tolerance": FINE, **blank}
    lengths = {name: 1000 * quantity(f"--blank {name}", text, "length") for name, text in sizes.items()}
    made = mesh.wheel_outline(wheel, BlankSizes(1000 * module, **lengths))
    emit(outline_text(made, to.suffix), to)
    return [made]


FINE = "0.001mm"
"""Default chord tolerance of the outline of a wheel, as a length with its unit."""


# ------------------------------------------------------------------------------------------------------------- friction


@dataclass(frozen=True)
class PairFrictionOption:
    """Value of the option `--friction`: a coefficient of friction, or a friction law."""

    coefficient: float
    """Coefficient of friction; 0 if a friction law is given."""
    law: FrictionLaw | None = None

    def number(self, option: str) -> float:
        """Return the coefficient of friction; raise `QuestionError` for a law, because `option` needs a coefficient."""
        if self.law is not None:
            what, fix = f"{option} needs a coefficient of friction", "for example, give --friction 0.1"
            raise option_error("--friction", what, fix, "a friction law is given")
        return self.coefficient

    def of(self, mesh: Mesh, rate: str | None) -> Mesh:
        """Return a mesh with the friction of the option; raise `QuestionError` if a law lacks data, such as a speed."""
        if self.law is None:
            return mesh
        radius = mesh.pitch_radius
        if radius is None or rate is None:
            missing = {"--rate": ("the speed of the driver", rate), "--module": ("the module", radius)}
            lacking = {option: word for option, (word, value) in missing.items() if value is None}
            what = f"the friction law '{self.law.law}' needs the sliding speed, which is unknown"
            why = f"the sliding speed follows from {' and '.join(lacking.values())}"
            raise option_error("--friction", what, f"give {' and '.join(lacking)}", why)
        if mesh.driver != mesh.gear.pair[0]:
            first, second = mesh.wheels.counts
            # the pitch radius is that of the first wheel, the speed that of the driver
            radius *= second / first
        speed = quantity("--rate", rate, "speed", minimum="above 0") * radius
        return replace(mesh, wheels=replace(mesh.wheels, friction=None, friction_law=self.law, pitch_line=speed))


def read_pair_friction(text: str) -> PairFrictionOption:
    """Parse a coefficient of friction or a friction law; raise `QuestionError` for text that is neither of them."""
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
