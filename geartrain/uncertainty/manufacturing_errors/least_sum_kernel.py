"""The least of two contacts that come towards each other, f(x) + f'(delta - x), as a kernel: `least_backlash`."""

from __future__ import annotations

from math import inf

from geartrain.numerics.kernels import kernel
from geartrain.uncertainty.manufacturing_errors.couple_kernel import CutCouple, approach, contact, recess

_MOST_STEPS = 30  # bisections alone would leave 1e-9 of the reach
_NEAR = 1e-6  # of the common reach: a step this short leaves nothing but rounding in the value


@kernel
def phase(couple: CutCouple, approaches: int, x: float) -> tuple[float, float, float]:
    """alpha_2, tau and its slope at x, in approach or in recess."""
    return approach(couple, x) if approaches else recess(couple, x)


@kernel
def least_contact_sum(front: CutCouple, back: CutCouple, delta: float) -> float:
    """The least of f(x) + f'(delta - x) over the common reach (rad); inf where there is none."""
    low, high = max(-front.reach, delta - back.reach), min(front.reach, delta + back.reach)
    if not low < high:
        return inf
    least = min(contact(front, low) + contact(back, delta - low), contact(front, high) + contact(back, delta - high))
    for first in range(2):
        for second in range(2):
            least = min(least, _least_of_phases(front, back, delta, first, second, low, high, least))
    return least


@kernel
def _least_of_phases(
    front: CutCouple, back: CutCouple, delta: float, first: int, second: int, low: float, high: float, known: float
) -> float:
    """The same of two phases: Newton's method safeguarded by bisection, its last step taken in the value.

    Infinite where a tangent tells at once that it is no less than what is known.
    """
    near = _NEAR * (high - low)
    x = min(max(delta / 2, low), high)
    for attempt in range(_MOST_STEPS):
        one, two = phase(front, first, x), phase(back, second, delta - x)
        slope, bend = one[1] - two[1], one[2] + two[2]
        if attempt == 0 and bend > 0 and one[0] + two[0] + slope * ((low if slope > 0 else high) - x) > known:
            return inf
        if slope < 0:
            low = x
        if slope > 0:
            high = x
        step = x - slope / bend
        # a step out of the bracket, or none where the bend is 0 or NaN, is a bisection
        if not (step >= low and step <= high):
            step = low + (high - low) / 2
        moved = abs(step - x)
        x = step
        if not moved > near:
            break
    one, two = phase(front, first, x), phase(back, second, delta - x)
    value, slope, bend = one[0] + two[0], one[1] - two[1], one[2] + two[2]
    if bend > 0 and abs(slope / bend) < near:  # at an end of the reach it is no bottom
        value -= slope * (slope / bend) / 2
    return value
