"""The study of dynamics: its event-driven reference, and the kept run. Times are never judged."""

from __future__ import annotations

from itertools import pairwise
from math import pi

import numpy as np
import pytest
from studies.dynamics_methods import DRAG, FLANKS, INERTIA, RATE, by_events, stepped, yielding
from studies.dynamics_study import DynamicsRecords

pytestmark = pytest.mark.slow  # the script of an accuracy page, no part of the package


def test_a_flight_of_the_oracle_is_a_parabola_from_where_the_flank_falls_away() -> None:
    found = by_events(0.0, 1e-8)
    angles = np.linspace(0, 2 * pi, 400_001)
    bend = np.gradient(FLANKS[0].speed(angles), angles)
    first = int(np.argmax(INERTIA * RATE**2 * bend + DRAG < 0))
    t = angles[first:] / RATE
    q = FLANKS[0].angle(angles[first]) + RATE * FLANKS[0].speed(angles[first]) * (t - t[0])
    q = q - DRAG / INERTIA * (t - t[0]) ** 2 / 2
    gaps = np.minimum(q - FLANKS[0].angle(RATE * t), FLANKS[1].angle(RATE * t) - q)
    landed = int(np.argmax(gaps[10:] < 0)) + 10
    assert found.gap == pytest.approx(gaps[:landed].max(), rel=1e-3)


def test_steps_and_teeth_that_yield_come_to_what_events_say() -> None:
    truth, rigid, soft = by_events(0.5, 1e-8), stepped(0.5, 2000, False), yielding(0.5, 100.0, 2000, False)
    assert rigid.impacts == pytest.approx(truth.impacts, rel=0.06)
    assert soft.impacts == pytest.approx(truth.impacts, rel=0.15)
    assert soft.gap == pytest.approx(truth.gap, rel=0.01)


def test_the_kept_run_falls_to_the_first_order_and_settles() -> None:
    records = DynamicsRecords.read("dynamics")
    # bounces end where flights take two steps, which is not the same blow at each length of the step
    for restitution, within in ((0.0, 0.05), (0.5, 0.15)):
        rows = [row for row in records.pair if (row.restitution, row.method) == (restitution, "rigid steps")]
        orders = [np.log(one.impacts / two.impacts) / np.log(two.steps / one.steps) for one, two in pairwise(rows[1:])]
        assert orders == pytest.approx([1.0] * len(orders), abs=within)
    rigid = [row for row in records.train if not row.stiffness]
    assert {round(100 * row.apart) for row in rigid if row.restitution == 0} == {27}
    assert {round(100 * row.apart) for row in rigid if row.restitution} <= {37, 38, 39}
