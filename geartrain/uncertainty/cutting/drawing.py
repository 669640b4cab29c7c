"""Errors of cutting as distributions, and wheels drawn from them."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, pi
from typing import TYPE_CHECKING, Literal

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.teeth.triangular.sizes import depth

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.uncertainty.cutting.wheel import CutWheel

    Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Spread:
    """An error without bias: `size` is the standard deviation of a normal one, half the width of a uniform one."""

    size: float = 0.0
    kind: Literal["normal", "uniform"] = "normal"

    def __post_init__(self) -> None:
        if not 0 <= self.size < inf:
            raise RangeError(Problem(f"an error of {self.size:g} is no size", "", "give 0 or more, and finite"))

    def draw(self, rng: np.random.Generator, shape: tuple[int, ...]) -> Floats:
        """Independent errors; zeros are drawn too, so that one size does not change what others draw."""
        unit = rng.standard_normal(shape) if self.kind == "normal" else rng.uniform(-1.0, 1.0, shape)
        return self.size * unit


@dataclass(frozen=True, slots=True)
class Cutting:
    """How badly a wheel is cut.

    place         of each tooth, in pitches
    tip           height of each tooth, in depths of its tooth
    aperture      half angle of each flank apart, in half angles
    eccentricity  distance of the centre from the axle, in depths of a tooth; any direction is as likely
    """

    place: Spread = Spread()
    tip: Spread = Spread()
    aperture: Spread = Spread()
    eccentricity: Spread = Spread()

    def draw(self, even: CutWheel, rng: np.random.Generator, trials: int) -> CutWheel:
        """Wheels (trials, z) cut so, from a wheel without errors. Raises `RangeError` if one of them cannot be cut."""
        if trials < 1:
            raise RangeError(Problem(f"{trials} trials tell nothing", "", "ask for at least 1"))
        shape, high = (trials, even.z), even.radius * depth(even.z, even.half_angle)
        place, tip = self.place.draw(rng, shape), self.tip.draw(rng, shape)
        leading, trailing = self.aperture.draw(rng, shape), self.aperture.draw(rng, shape)
        e, towards = self.eccentricity.draw(rng, (trials,)), rng.uniform(0.0, 2 * pi, trials)
        wheel = even.placed(even.pitch * place)
        if self.tip.size:
            wheel = wheel.grown(high * tip)
        if self.aperture.size:
            wheel = wheel.widened(even.half_angle * leading, even.half_angle * trailing)
        return wheel.eccentric(high * np.abs(e), towards) if self.eccentricity.size else wheel
