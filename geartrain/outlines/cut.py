"""What a maker says of a wheel beside its teeth: scale, root, bore, rim."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite

from geartrain.errors import Problem, QuestionError


@dataclass(frozen=True, slots=True)
class Cut:
    """Sizes in mm.

    module      pitch diameter over teeth
    clearance   between a tip and the mate's root; None: a quarter of a module
    fillet      radius of the round at the root; None: 0.38 modules, or what fits
    bore        diameter of the hole in the middle; None: no hole
    rim         what stands round the roots of a ring, or the pins of a lantern; None: two modules, or a pin
    tolerance   how far a chord may leave a flank
    """

    module: float = 1.0
    clearance: float | None = None
    fillet: float | None = None
    bore: float | None = None
    rim: float | None = None
    tolerance: float = 0.001

    def __post_init__(self) -> None:
        """Raise `QuestionError` for what is no size."""
        above = {"module": self.module, "bore": self.bore, "rim": self.rim, "tolerance": self.tolerance}
        least = {"fillet": self.fillet, "clearance": self.clearance}
        problems = [
            Problem(f"a {name} of {value:g} mm is no size", "", f"give a {name} above 0", f"--{name}")
            for name, value in above.items()
            if value is not None and not (isfinite(value) and value > 0)
        ]
        problems += [
            Problem(f"a {name} of {value:g} mm is no size", "", f"give a {name} of 0 or more", f"--{name}")
            for name, value in least.items()
            if value is not None and not (isfinite(value) and value >= 0)
        ]
        if problems:
            raise QuestionError(problems)
