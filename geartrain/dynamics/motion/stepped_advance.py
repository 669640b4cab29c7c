"""Mean advance of a link that one-way clutches drive in steps, from the motion of the links that drive it.

The driven link has the speed max(0, v_1, v_2, ...), where v_1, v_2, ... are the speeds of its drivers, because friction
holds it while none of them drives it. A common period of the drivers is divided at kinks, and where another driver
becomes the fastest. In each piece, the advance is the difference of the end positions of the fastest driver. For a
single driver, the sum is the positive variation of its angle.
"""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.dynamics.motion.error_composition import common_period, evaluate
from geartrain.dynamics.motion.extreme_search import MOST_KINKS, pieces
from geartrain.dynamics.motion.kink_positions import KinkSearch
from geartrain.dynamics.motion.run_statistics import mean_speed
from geartrain.errors import Problem, QuestionError

if TYPE_CHECKING:
    from geartrain.dynamics.motion.error_composition import ErrorComposition
    from geartrain.dynamics.motion.motion_problem import MotionProblem
    from geartrain.numerics.arrays import Floats, Indices
    from geartrain.train.states import SteppedLink

_PARTS = 8  # subdivisions of each smooth piece of the period
_HALVINGS = 30  # bisections of a part in which the fastest driver changes; the error of the advance is quadratic


def mean_advance(problem: MotionProblem, drivers: ErrorComposition, stepped: SteppedLink) -> float:
    """Return the mean speed of a link that one-way clutches drive in steps, divided by the speed of the input [1].

    drivers   composition whose outputs are the drivers, in the order of `stepped`
    """
    search, period = KinkSearch(drivers), float(common_period(drivers.used) or 0)
    unknown = [each.id for each in problem.circuits if each.swings and each.id not in problem.periods]
    if unknown or (search.rate + 1 / search.step) * period > MOST_KINKS:
        long = f"the drivers have too many kinks in their common period of {period:.6g} turns"
        why = f"the speeds of {', '.join(unknown)} within a turn are not known" if unknown else long
        fix = "declare the dimensions of all couplings, such as `pin_radius`, and no `tooth_form` before the drivers"
        raise QuestionError(Problem(f"the advance of '{stepped.link}' cannot be computed", why, fix))
    senses = problem.way * np.array([*stepped.drivers.values()], dtype=float)[:, None]
    means = np.array([[mean_speed(link, problem.ratio(link))] for link in stepped.drivers])

    def motion(turns: Floats) -> tuple[Floats, Indices]:
        """Return the angles of the drivers [rad], followed by a row of zeros for friction, and the index of the row
        with the maximum speed.
        """
        found, rest = evaluate(drivers, turns), np.zeros((1, len(turns)))
        angles = np.concatenate([rest, senses * (2 * pi * means * turns + found.error)])
        return angles, np.argmax(np.concatenate([rest, senses * (means + found.rate)]), axis=0)

    smooth = pieces([search], 0.0, period, drivers.chunk)
    parts = [np.linspace(low, high, _PARTS + 1).ravel() for low, high in smooth]
    turns = np.unique(np.concatenate([[0.0], *parts, [period]]))
    angles, fastest = motion(turns)
    for _ in range(_HALVINGS):
        at = np.flatnonzero(np.diff(fastest)) + 1
        if not len(at):
            break
        middle = (turns[at - 1] + turns[at]) / 2
        found = motion(middle)
        turns, fastest = np.insert(turns, at, middle), np.insert(fastest, at, found[1])
        angles = np.insert(angles, at, found[0], axis=1)
    return stepped.sense * problem.way * float(np.diff(angles).max(axis=0).sum()) / (2 * pi * period)
