"""A train at rest: steps that would all be alike are taken at once, up to the next beat of an escapement.

Between two beats a clock stands most of the time: its stop holds, bearings stick, and torques do not change. A step
that starts and ends without speed, and for which no guess was turned round, is then followed by the same step again.
"""

from __future__ import annotations

from math import floor
from typing import TYPE_CHECKING

from geartrain.dynamics.contacts.contact_system import ContactSystem
from geartrain.dynamics.steps.contact_solution import StepRules
from geartrain.dynamics.steps.run_record import IMPULSE, TIME_APART, TIME_COAST, ContactState
from geartrain.numerics.kernels import kernel

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


@kernel
def is_at_rest(before: Floats, after: Floats, still: float) -> bool:
    """Whether nothing moves, neither before a step nor after it.

    still   speed that is none (rad/s)
    """
    fastest = 0.0
    for d in range(len(after)):
        fastest = max(fastest, abs(after[d]), abs(before[d]))
        if fastest > still:
            break
    return fastest <= still


@kernel
def find_idle_steps(system: ContactSystem, state: ContactState, rules: StepRules, most: int) -> int:
    """How many steps, at most so many, a train at rest has before what acts on it changes."""
    for m in range(len(system.spring_rate)):
        if system.spring_rate[m] != 0.0:
            return 0
    idle = most
    for m in range(len(system.stop_beat)):
        beats = floor((state.clock[0] + rules.step / 2) / system.stop_beat[m])
        # one step less, whatever rounding does to the moment of the beat
        idle = min(idle, floor((beats + 1) * system.stop_beat[m] / rules.step - state.clock[1] - 1.5))
    return max(idle, 0)


@kernel
def repeat_counts(counts: Floats, before: Floats, times: int) -> None:
    """Count the last step so many times more, of all contacts.

    before   counts before that step
    """
    for m in range(len(counts)):
        for column in (TIME_APART, TIME_COAST, IMPULSE):
            counts[m, column] += times * (counts[m, column] - before[m, column])
