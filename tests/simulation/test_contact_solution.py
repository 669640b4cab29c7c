"""One guess of contacts solved in order is the saddle point of the same equations, whatever hangs on what."""

from __future__ import annotations

from fractions import Fraction
from math import tau

import numpy as np
import pytest

from geartrain.simulation.contacts.contact_model import Bearing, ContactModel, ContactPair
from geartrain.simulation.contacts.law_tables import tabled_angle
from geartrain.simulation.steps.contact_solution import solve_guess
from geartrain.simulation.steps.simulation import empty_equations, start_state
from geartrain.teeth.transmission import ExactRatio

EVEN = tabled_angle(ExactRatio(Fraction(1), tau))
STEP, CREEP = 1e-3, 1e-6


def random_model(random: np.random.Generator, given: bool) -> ContactModel:
    """Links that each hang on one before, some on a carrier that moves; masses couple some of them."""
    n = int(random.integers(3, 9))
    pairs = []
    for link in range(1, n):
        driver = int(random.integers(0, link))
        if link > 1 and random.random() < 0.4:
            carrier = int(random.choice([each for each in range(link) if each != driver]))
            ends = {driver: 1.0, carrier: -1.0}, {link: -1.0, carrier: 1.0}
        else:
            ends = {driver: 1.0}, {link: -1.0}
        if random.random() < 0.3:
            # the law may be written from the other side, as long as that never stands
            ends = ends[1], ends[0]
        pairs.append(ContactPair(f"p{link}", *ends, (0.0, 0.0), EVEN, EVEN, None, 0.0, True))
    couple = random.normal(size=(n, n)) * (random.random((n, n)) < 0.3)
    bearings = [Bearing(f"b{at}", {at: 1.0, (at + 1) % n: -0.5}, 0.3, 0.3) for at in range(0, n, 2)]
    mass = np.diag(random.uniform(0.5, 3, n)) + couple @ couple.T
    speed = random.normal(size=n)
    return ContactModel(mass, np.zeros((n, n)), np.zeros(n), {0: 1.0} if given else {}, speed, pairs, bearings)


@pytest.mark.parametrize("seed", range(12))
def test_elimination_in_the_solved_order_is_the_saddle_point(seed: int) -> None:
    random = np.random.default_rng(seed)
    model = random_model(random, given=bool(seed % 2))
    system = model.system(STEP)
    state = start_state(model, system)
    n, pairs = len(model.torque), len(model.pairs)
    here = empty_equations(n, pairs, 0, len(system.near))
    here.load[:] = random.normal(size=n)
    here.bound[:] = random.normal(size=(pairs, 2))
    here.ratio[:] = random.uniform(0.5, 2, (pairs, 2))
    # friction: forces do not act along the gradients of their gaps
    here.arm[:] = here.ratio * random.uniform(1, 1.3, (pairs, 2))
    state.touching[:] = random.integers(0, 3, pairs)
    state.turning[:] = random.integers(-1, 2, len(model.bearings))
    solve_guess(system, state, here, STEP, CREEP)

    # coordinates in solved order, all at once
    A, b = system.matrix.copy(), here.load.copy()
    for at, bearing in enumerate(model.bearings):
        row = np.zeros(n)
        for each, value in bearing.speed.items():
            row[model.order.coordinates.index(each)] = value
        if state.turning[at]:
            b -= STEP * bearing.sliding * state.turning[at] * row
        else:
            A += STEP * bearing.sticking / CREEP * np.outer(row, row)
    rows, forces, bounds = [], [], []
    for m, pair in enumerate(model.pairs):
        if state.touching[m]:
            side, sign = state.touching[m] - 1, 3 - 2 * state.touching[m]
            driver, driven = np.zeros(n), np.zeros(n)
            for form, into in ((pair.driver, driver), (pair.driven, driven)):
                for each, value in form.items():
                    into[model.order.coordinates.index(each)] += value
            rows.append(sign * (driven - here.ratio[m, side] * driver))
            forces.append(sign * (driven - here.arm[m, side] * driver))
            bounds.append(here.bound[m, side])
    held = np.zeros((0, n)) if not rows else np.array(rows)
    pushed = np.zeros((0, n)) if not rows else np.array(forces)
    prescribed = np.flatnonzero(system.given)
    keep = np.zeros((len(prescribed), n))
    keep[np.arange(len(prescribed)), prescribed] = 1
    size = len(held) + len(keep)
    saddle = np.block(
        [[A, -pushed.T, -keep.T], [held, np.zeros((len(held), size))], [keep, np.zeros((len(keep), size))]]
    )
    found = np.linalg.solve(saddle, np.concatenate([b, bounds, state.speed[prescribed]]))
    assert here.v == pytest.approx(found[:n], rel=1e-8, abs=1e-9)
    assert here.P[state.touching > 0] == pytest.approx(found[n : n + len(held)], rel=1e-7, abs=1e-8)
    assert here.drive[prescribed] == pytest.approx(found[n + len(held) :], rel=1e-7, abs=1e-8)
