"""A pair of triangular teeth as options describe it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from geartrain.cli.mesh.options import placed
from geartrain.cli.numbers import friction as _friction
from geartrain.cli.numbers import quantity
from geartrain.errors import GearTrainError, Problem

if TYPE_CHECKING:
    from geartrain.teeth import Triangular
    from geartrain.teeth.triangular.law import TriangularLaw

VARIED = ("half_angle", "clearance", "excess", "window", "backlash", "centre_distance", "friction", "z1", "z2")
FORM = VARIED[:-3]


class Pair:
    """The options that describe a pair; any of them can be varied."""

    def __init__(
        self,
        teeth: tuple[int, int],
        half_angle: str,
        given: dict[str, str | None],
        radii: str,
        module: str | None,
        friction: str,
        driver: int,
        direction: int,
    ) -> None:
        self.teeth, self.half_angle, self.radii, self.friction = teeth, half_angle, radii, friction
        self.given = {name: value for name, value in given.items() if value is not None}
        self.module, self.driver, self.direction = module, driver, direction

    def law(self, **varied: str | float) -> TriangularLaw:
        """The law with some options replaced by what is varied."""
        z1, z2 = (varied.pop(name, z) for name, z in zip(("z1", "z2"), self.teeth, strict=True))
        friction = _friction(str(varied.pop("friction", self.friction)))
        z1, z2 = round(float(z1)), round(float(z2))
        size = None if self.module is None else quantity("--module", self.module, "length", least="above 0")
        distance = None if size is None else size * (z1 + z2) / 2
        try:
            return self.form(**varied).law(z1, z2, friction, self.driver, self.direction, distance)
        except GearTrainError as error:
            raise placed(error, "--teeth" if min(z1, z2) < 3 else "--" + next(iter(self.given), "clearance")) from None

    def check(self, ranges: dict[str, list[float]], units: dict[str, str]) -> None:
        """Complain of a unit or an option that no point of a sweep can have."""
        self.form(**{name: f"{values[0]!r}{units[name]}" for name, values in ranges.items() if name in FORM})

    def form(self, **varied: str | float) -> Triangular:
        """The tooth form with some options replaced."""
        from pydantic import ValidationError

        from geartrain.teeth import Triangular

        half_angle = str(varied.pop("half_angle", self.half_angle))
        clearances = {name: str(value) for name, value in varied.items()} if varied else self.given
        data: dict[str, Any] = {
            "form": "triangular",
            "half_angle": [part.strip() for part in half_angle.split(",")] if "," in half_angle else half_angle,
            "radii": [part.strip() for part in self.radii.split(",")] if "," in self.radii else self.radii,
            **clearances,
        }
        try:
            return Triangular.model_validate(data)
        except ValidationError as error:
            # one half angle given for both wheels would be complained of twice
            raise GearTrainError(dict.fromkeys(map(_problem, error.errors(include_url=False)))) from None


def _problem(item: Any) -> Problem:
    context = item.get("ctx") or {}
    name = str(item["loc"][0]) if item["loc"] else item["type"] if item["type"] in VARIED else "radii"
    what = item["msg"] if "fix" in context else f"'{item['input']}' does not fit here"
    fix = str(context.get("fix") or "see geartrain mesh triangular --help")
    return Problem(what, "", fix, f"--{name.replace('_', '-')}")
