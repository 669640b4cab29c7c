"""The study of uncertainty: what is done together is what a loop does, truths are truths. Times are not judged."""

from __future__ import annotations

from fractions import Fraction
from math import exp, log

import numpy as np
import pytest
from sorge import Pair, minimum_backlash
from studies.count_trials import Counted
from studies.cut_pair_trials import (
    BLOCK,
    EVERY,
    EXACT,
    NORMAL,
    PLACES,
    SHARE,
    Batch,
    chance_of_jam,
    errors_of,
    jams,
    uneven_driven,
)
from studies.uncertainty_records import COUNTS, DISPLACED, SINGLY, ErrorRecord, UncertaintyRecords, slope
from studies.uncertainty_study import uncertainty

from geartrain.workshop.cutting.meshing_cycle import batch_verdicts, nominal_backlash

pytestmark = pytest.mark.slow  # the script of an accuracy page, no part of the package


@pytest.fixture(scope="module")
def records() -> UncertaintyRecords:
    return uncertainty(quick=True)


# ------------------------------------------------------------------------------------------------------------- truths


@pytest.mark.parametrize(("z", "share"), [(3, 0.5), (4, 0.6), (5, 0.75), (6, 0.9)])
def test_the_chance_of_a_jam_is_that_of_all_grids_of_places(z: int, share: float) -> None:
    """Places on a grid, all sets of them counted by a matrix; with a finer grid the error is halved."""
    off = []
    for cells in (20, 40):
        x = (np.arange(cells) + 0.5) / cells
        rises = (x[:, None] - x[None, :] >= share - 1e-12).astype(float)  # [late, the one before]
        none = np.linalg.matrix_power((1 - rises) / cells, z)
        off.append(abs(1 - np.trace(none) - chance_of_jam(z, share)))
    assert off[0] < 0.06
    assert off[1] < 0.6 * off[0] + 1e-12


def test_the_chance_of_a_jam_by_hand() -> None:
    """Three places of which two neighbours lie 1/2 apart or more: no two of the three ways at once."""
    assert chance_of_jam(3, 0.5) == pytest.approx(3 / 8)
    assert chance_of_jam(4, 0.5) == pytest.approx(4 / 8 - 2 / 64)
    assert chance_of_jam(38, 1.0) == 0
    for z, share in ((38, 0.4), (2, 0.6)):
        with pytest.raises(ValueError, match="share"):
            chance_of_jam(z, share)


def test_the_pair_of_the_sum_jams_where_neighbours_use_up_its_backlash_and_only_there() -> None:
    """The least play is that of a scan of the source's equations; the rule is that of the places alone."""
    rng = np.random.default_rng(3)
    places = rng.uniform(-1, 1, (300, 38))
    pair = uneven_driven(places)
    backlash = minimum_backlash(Pair.of(pair.sizes, np))
    assert backlash == pytest.approx(nominal_backlash(pair.sizes) * pair.sizes.p2, rel=1e-6)
    late = pair.second.place - np.roll(pair.second.place, 1, axis=1)
    assert (pair.first.place == 0).all()
    found = batch_verdicts(pair.sizes, pair.first, pair.second).jams
    assert (found == (late.max(axis=1) > backlash)).all()
    assert (found == ((places - np.roll(places, 1, axis=1)).max(axis=1) > 2 * SHARE)).all()
    assert 0.15 < found.mean() < 0.35


# --------------------------------------------------------------------------------------------------------------- ways


@pytest.mark.slow
def test_counts_in_a_batch_are_solved_trains(records: UncertaintyRecords) -> None:
    requested = Counted("freeth-2008", 40)
    singles = requested.singly(8)
    assert len(requested.question.uncertainties) == 35
    assert requested.differing(singles) == 0
    error, share = requested.off(singles)
    assert error < 1e-15 * 5
    assert 0 < share <= 1
    # the Metonic year by the textbook product of its wheels, of every combination
    for at, (speeds, _) in enumerate(singles):
        z = {wheel: int(column[at]) for wheel, column in requested.counts.items()}
        month = Fraction(z["b2"], z["l1"]) * Fraction(z["l2"], z["m1"]) * Fraction(z["m2"], z["n1"])
        assert abs(speeds["metonic"]) == month
        assert float(requested.told()["metonic"][0][at]) == pytest.approx(float(speeds["metonic"]), rel=1e-14)
    rates = [row for row in records.rates if row.family == COUNTS]
    assert len(rates) == 3
    assert rates[0].method == SINGLY


def test_some_drawn_combinations_fit_and_most_do_not() -> None:
    requested = Counted("freeth-2008", 2000)
    fits = requested.decided()
    assert 0.01 < fits.mean() < 0.5
    declared = [
        all(doubt.declared == requested.counts[wheel][at] for wheel, doubt in requested.question.uncertainties.items())
        for at in range(2000)
    ]
    assert fits[declared].all()


@pytest.mark.parametrize("errors", [PLACES, EVERY])
def test_a_comparison_tells_what_differs(errors: str) -> None:
    batch = Batch(15, 20, 0.02, errors, 3)
    found = batch.together()
    singly = batch.singly(3)
    off, differing = batch.compared(found, singly)
    assert off < 1e-6
    assert differing == 0
    moved = [(backlash + 0.01 * batch.pair.sizes.p2, (not stops, *rest)) for backlash, (stops, *rest) in singly]
    off, differing = batch.compared(found, moved)  # type: ignore[arg-type]
    assert off == pytest.approx(0.01, abs=1e-6)
    assert differing == 3
    assert batch.pitches == 60
    assert batch.name == "15/20 at 1.02"


# ------------------------------------------------------------------------------------------------ estimates and workers


def test_trials_are_the_same_for_any_number_of_workers_and_others_for_another_seed() -> None:
    assert (jams(NORMAL, 2, workers=1) == jams(NORMAL, 2, workers=2)).all()
    one, other = jams(NORMAL, 1), jams(NORMAL, 1, seed=9)
    assert one.shape == (BLOCK,)
    assert (one != other).any()
    assert one.mean() == pytest.approx(0.16, abs=0.03)


def test_errors_of_estimates_are_those_of_a_coin() -> None:
    rng = np.random.default_rng(5)
    truth = chance_of_jam(38, SHARE)
    coins = rng.random(200_000) < truth
    rows = errors_of(EXACT, coins, (100, 1000, 10_000))
    for row in rows:
        blocks = coins.reshape(-1, row.trials).mean(axis=1)
        assert row.rms == pytest.approx(float(np.sqrt(((blocks - truth) ** 2).mean())))
        assert row.rms == pytest.approx(row.expected, rel=0.35)
        assert row.covered > 0.85
    power, off = slope(rows)
    assert 0 < off < 0.02
    assert abs(power + 0.5) < 4 * off
    # a biased estimate is told
    biased = errors_of(EXACT, rng.random(200_000) < truth + 0.05, (1000, 10_000))
    assert biased[1].rms > 5 * biased[1].expected
    assert biased[1].covered < 0.1


def test_the_error_of_a_slope_is_how_much_slopes_scatter() -> None:
    """Estimates of a normal variable, their slopes found many times."""
    rng, found = np.random.default_rng(6), []
    for _ in range(300):
        rows = []
        for n, estimates in ((10, 320), (40, 80), (160, 20)):
            rms = float(np.sqrt(np.mean(np.square(rng.standard_normal(estimates) / np.sqrt(n)))))
            rows.append(ErrorRecord("", 0, 0, n, estimates, rms, 1, 1))
        found.append(slope(rows))
    powers, off = np.array(found).T
    assert off[0] == pytest.approx(powers.std(), rel=0.2)
    assert powers.mean() == pytest.approx(-0.5, abs=0.01)


def test_a_slope_is_that_of_its_power() -> None:
    rows = [ErrorRecord("", 0.5, 0, n, 1, exp(-0.7 * log(n)), 1, 1) for n in (10, 100, 1000)]
    assert slope(rows)[0] == pytest.approx(-0.7)


def test_estimates_near_the_exact_chance(records: UncertaintyRecords) -> None:
    exact = [row for row in records.errors if row.case == EXACT]
    assert all(row.truth_error == 0 for row in exact)
    for row in records.errors:
        assert row.rms < 2.5 * row.expected


# ------------------------------------------------------------------------------------------------------------ records


def test_what_is_done_together_is_what_the_loop_does(records: UncertaintyRecords) -> None:
    for row in records.rates:
        assert row.differing == 0
        # displaced flanks are looked at where even teeth stand, at fewer angles than the loop does
        assert row.error is None or row.error < (5e-4 if row.family == DISPLACED else 1e-6)
        assert row.method != SINGLY or row.ratio == 1
    assert {row.family for row in records.rates} == {COUNTS, PLACES, EVERY, DISPLACED}
