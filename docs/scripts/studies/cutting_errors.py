"""Errors of cutting as distributions, and wheels of one pair drawn from them, apart from any train.

A train declares its errors; `geartrain.workshop.find_trial_plan` draws those.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf, pi
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from geartrain.errors import Problem, RangeError
from geartrain.numerics.arrays import Floats
from geartrain.teeth.triangular.pair_geometry import depth
from geartrain.workshop.cutting.cut_wheel import CutWheel


@dataclass(frozen=True, slots=True)
class ErrorDistribution:
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
class CuttingErrorModel:
    """How badly a wheel is cut.

    place         of each tooth, in pitches
    tip           height of each tooth, in depths of its tooth
    aperture      half angle of each flank apart, in half angles
    eccentricity  distance of the centre from the axle, in depths of a tooth; any direction is as likely
    """

    place: ErrorDistribution = ErrorDistribution()
    tip: ErrorDistribution = ErrorDistribution()
    aperture_deviation: ErrorDistribution = ErrorDistribution()
    eccentricity: ErrorDistribution = ErrorDistribution()

    def draw(self, even: CutWheel, rng: np.random.Generator, trials: int) -> CutWheel:
        """Wheels (trials, z) cut so, from a wheel without errors. Raises `RangeError` if one of them cannot be cut."""
        if trials < 1:
            raise RangeError(Problem(f"{trials} trials tell nothing", "", "ask for at least 1"))
        shape, high = (trials, even.z), even.radius * depth(even.sign * even.z, even.half_angle)
        place, tip = self.place.draw(rng, shape), self.tip.draw(rng, shape)
        leading, trailing = self.aperture_deviation.draw(rng, shape), self.aperture_deviation.draw(rng, shape)
        e, towards = self.eccentricity.draw(rng, (trials,)), rng.uniform(0.0, 2 * pi, trials)
        errors = {"place": even.pitch * place, "tip": high * tip if self.tip.size else 0.0}
        if self.aperture_deviation.size:
            errors |= {"leading": even.half_angle * leading, "trailing": even.half_angle * trailing}
        return with_errors(even, **errors, e=high * np.abs(e) if self.eccentricity.size else 0.0, towards=towards)


def with_errors(wheel: CutWheel, e: ArrayLike = 0.0, towards: ArrayLike = 0.0, **more: ArrayLike) -> CutWheel:
    """A wheel with errors added to its arrays, then cut `e` off its axle. Raises `RangeError` if it cannot be cut."""
    wheel = replace(wheel, **{name: getattr(wheel, name) + np.asarray(each) for name, each in more.items()})
    for found in (wheel, wheel.moved(e, towards)) if np.any(e) else (wheel,):
        if not found.cuttable.all():
            what = "a tooth of the wheel cannot be cut"
            raise RangeError(Problem(what, "two flanks do not meet, or leave no space", "give smaller errors"))
    return found
