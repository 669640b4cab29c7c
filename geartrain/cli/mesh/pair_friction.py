"""Friction of a pair without a train, as `--friction` gives it: a coefficient, or a law of speed with `--rate`."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated, Any, TypeVar

import typer

from geartrain.cli.option_values import friction as read_coefficient
from geartrain.cli.option_values import quantity
from geartrain.errors import GearTrainError, Problem, suggest

if TYPE_CHECKING:
    from geartrain.teeth.friction_law import FrictionLaw
    from geartrain.teeth.gear_mesh import GearMesh

    Mesh = TypeVar("Mesh", bound=GearMesh)

Friction = Annotated[
    str,
    typer.Option(
        "--friction",
        help="Coefficient of friction, or a law of speed: buckingham, dokos, "
        "'stribeck,static=0.2,kinetic=0.08,speed=10 mm/s', or a table.",
    ),
]
Rate = Annotated[str | None, typer.Option("--rate", help="Speed of the driver, such as '1 turn/s'.")]


@dataclass(frozen=True)
class PairFrictionOption:
    """What `--friction` says.

    coefficient   0 where a law is given
    """

    coefficient: float
    law: FrictionLaw | None = None

    def number(self, option: str) -> float:
        """The coefficient. Raises `GearTrainError` where a law is given to an option that asks for a number."""
        if self.law is not None:
            what = f"{option} asks for friction as a number"
            raise GearTrainError(Problem(what, "a law of speed was given", "give a coefficient", "--friction"))
        return self.coefficient

    def of(self, mesh: Mesh, rate: str | None) -> Mesh:
        """The mesh with that friction, at the speed of its driver. Raises `GearTrainError` where none is known."""
        if self.law is None:
            return mesh
        radius = mesh.pitch_radius
        if radius is None or rate is None:
            missing = {"--rate": ("fast", rate), "--module": ("large", radius)}
            lacking = {option: word for option, (word, value) in missing.items() if value is None}
            what = f"friction by the law '{self.law.law}' depends on the speed of the pair"
            why = f"nothing says how {' or '.join(lacking.values())} it is"
            raise GearTrainError(Problem(what, why, f"give {' and '.join(lacking)}", "--friction"))
        if mesh.driver != mesh.gear.pair[0]:
            first, second = mesh.wheels.counts
            radius *= second / first
        speed = quantity("--rate", rate, "speed", least="above 0") * radius
        return replace(mesh, wheels=replace(mesh.wheels, friction=None, friction_law=self.law, pitch_line=speed))


def read_pair_friction(text: str) -> PairFrictionOption:
    """A coefficient, or the law that a text names. Raises `GearTrainError`."""
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
        return Problem(f"there is no law of friction '{given}'", "", suggest(given, unknown_tag(item)[1]), "--friction")
    key = ".".join(str(step) for step in item["loc"][1:])
    what = f"{key}: {item['msg']}" if key else item["msg"]
    return Problem(what, "", str((item.get("ctx") or {}).get("fix", "see docs/shapes.md, section 15")), "--friction")
