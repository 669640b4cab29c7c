"""Trials of trains with cutting errors: against single pairs, closed forms, an integral, and printed values."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from fractions import Fraction
from functools import cache
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from drawn_wheels import drawn_wheels, judged, pointer_errors
from sorge import Pair, minimum_backlash
from studies.cut_pair_transmission import CutPairLaw

from geartrain import GearTrain, load
from geartrain.numerics import Execution, Journal, open_executor
from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission
from geartrain.workshop import (
    TrialPlan,
    TrialResults,
    find_sobol_indices,
    find_trial_plan,
    jamming_map,
    read_error_overrides,
    run_course,
    run_trials,
)


def chain(*counts: tuple[int, int], clearance: float = 1.02, **more: Any) -> GearTrain:
    """Pairs one after the other: the driven wheel of each sits on the arbor of the next driver."""
    links: dict[str, Any] = {"frame": {}, "l0": {"wheels": {}}}
    gears, joints = [], [{"pair": ["frame", "l0"], "axis": "A0"}]
    for at, (z1, z2) in enumerate(counts):
        links[f"l{at}"]["wheels"][f"p{at}"] = z1
        links[f"l{at + 1}"] = {"wheels": {f"w{at}": z2}}
        joints.append({"pair": ["frame", f"l{at + 1}"], "axis": f"A{at + 1}"})
        gears.append({"id": f"g{at}", "pair": [f"p{at}", f"w{at}"]})
    data = {
        "name": "chain",
        "links": links,
        "revolutes": joints,
        "gears": gears,
        "inputs": {"l0": 1},
        "outputs": {"end": {"of": f"l{len(counts)}"}},
        "tooth_form": {"form": "triangular", "half_angle": "30 deg", "clearance_factor": clearance},
    }
    return GearTrain.declare(data | more)


def planned(train: GearTrain, *settings: str) -> TrialPlan:
    return find_trial_plan(train, read_error_overrides(settings))


EVERY = ("pitch_deviation=2 %", "eccentricity=6 %", "tip=3 %", "aperture_deviation=uniform 4 %", "centre=2 %")

# ------------------------------------------------------------------------------------------------------ printed figures


@pytest.mark.parametrize("trials", [pytest.param(1024), pytest.param(100_000, marks=pytest.mark.long)])
def test_64_and_38_teeth_jam_as_often_as_printed(trials: int) -> None:
    seen = []
    for sigma in ("4.13 %", "5.16 %", "6.61 %"):
        found = run_trials(planned(chain((64, 38)), f"pitch_deviation={sigma}"), trials)
        jam = found.train.events["jam"]
        seen.append(jam.value)
        assert jam.of == trials
        assert jam.interval[0] <= found.pairs[0].bound
        assert found.pairs[0].backlash == pytest.approx(0.368, abs=5e-4)
    assert seen[0] < (0.01 if trials >= 10**5 else 0.02)
    assert seen[1] == pytest.approx(0.16, abs=0.03 if trials >= 10**5 else 0.04)
    assert seen[2] == pytest.approx(0.80, abs=0.05)


def chance_that_none_rises(z: int, most: float, nodes: int) -> float:
    """Chance that, of z independent uniform numbers on 0..1 in a circle, none exceeds the one before by `most`.

    The trace of the z-th power of an integral operator, by the trapezoidal rule; its kernel ends at `most`, which
    falls between two nodes.
    """
    step = 1 / nodes
    x = (np.arange(nodes) + 0.5) * step
    # the share of each node's cell that lies below the edge, averaged over the cell it comes from: a ramp of one cell
    kernel = np.clip((most - (x[None, :] - x[:, None])) / step + 0.5, 0.0, 1.0) * step
    power = np.linalg.matrix_power(kernel, z)
    return float(np.trace(power))


@pytest.mark.parametrize("trials", [pytest.param(4096), pytest.param(100_000, marks=pytest.mark.long)])
def test_the_probability_of_a_jam_is_its_integral(trials: int) -> None:
    """An even driver, 38 driven teeth out of place by up to 0.1 of a pitch: only neighbours can jam.

    A driven tooth jams if it is later than the one before it by more than the minimum backlash, which comes from a scan
    of the equations in the source.
    """
    plan = planned(chain((64, 38), clearance=1.01), "w0.pitch_deviation=uniform 10 %")
    backlash = minimum_backlash(Pair.of(plan.pairs[0].sizes, np))
    coarse, fine = (chance_that_none_rises(38, backlash / (0.2 * 2 * pi / 38), nodes) for nodes in (400, 800))
    assert abs(fine - coarse) < 1e-3
    true = 1 - (fine + (fine - coarse) / 3)
    low, high = run_trials(plan, trials).train.events["jam"].interval
    margin = (high - low) / 2
    assert low - margin < true < high + margin


# ----------------------------------------------------------------------------------------------------------- one by one


def test_every_trial_follows_the_transmission_of_its_own_wheels() -> None:
    """All kinds of error; every trial is evaluated at its own angle."""
    plan = planned(chain((23, 16)), *EVERY)
    drawn = drawn_wheels(plan, 40, 3)
    turns = np.random.default_rng(1).uniform(0, 16, 40)
    found = pointer_errors(drawn, np.arange(40), turns)[0]
    pair, checked = drawn.pair(0), 0
    for at in range(40):
        if not drawn.good[0][at] or not drawn.good[1][at]:
            continue
        transmission = CutPairLaw.of(pair.sizes, pair.first.taken(at), pair.second.taken(at), float(pair.shift[at]))
        lag = float(transmission.error(2 * pi * turns[at])) - plan.pairs[0].even
        assert abs(found[at]) == pytest.approx(abs(lag), abs=1e-10)
        checked += 1
    assert checked > 30


def test_marks_are_those_of_the_batch_and_a_wheel_is_one_in_all_its_pairs() -> None:
    """An idler: driven in one pair, driving in the next, its teeth the same."""
    train = chain((20, 30), (30, 24))
    data = train.declaration.model_dump(mode="json", exclude_unset=True)
    data["gears"][1]["pair"] = ["w0", "w1"]
    del data["links"]["l1"]["wheels"]["p1"]
    plan = planned(GearTrain.declare(data), "pitch_deviation=2 %", "tip=3 %")
    assert [wheel.name for wheel in plan.wheels] == ["p0", "w0", "w1"]
    drawn = drawn_wheels(plan, 8)
    first, second = drawn.pair(0), drawn.pair(1)
    assert (first.second.place == second.first.place).all()
    jams, backlash = judged(drawn)
    for at, pair in enumerate((first, second)):
        laws = (CutPairLaw.of(pair.sizes, pair.first.taken(n), pair.second.taken(n)).events for n in range(8))
        expected = np.array([events.backlash for events in laws])
        assert (jams[:, at] == (expected < 0)).all()
        assert backlash[:, at] == pytest.approx(expected / pair.sizes.p2, abs=1e-8)


def test_a_chain_is_one_transmission_after_the_other() -> None:
    """The second driver turns as far as the first pair turns it, from where even teeth start; trial by trial."""
    plan = planned(chain((24, 17), (19, 30)), *EVERY[:4])
    drawn = drawn_wheels(plan, 25, 5)
    turns = np.random.default_rng(2).uniform(0, 100, 25)
    found = pointer_errors(drawn, np.arange(25), turns)[0]
    one, two = drawn.pair(0), drawn.pair(1)
    even = 19 / 30 * plan.pairs[0].even + plan.pairs[1].even
    lag = float(TriangularTransmission(one.sizes).angle(0.0))
    for at in np.flatnonzero(drawn.good[0] & drawn.good[1] & drawn.good[2] & drawn.good[3]):
        transmissions = [CutPairLaw.of(pair.sizes, pair.first.taken(at), pair.second.taken(at)) for pair in (one, two)]
        start = 2 * pi * float(turns[at])
        middle = float(transmissions[0].angle(start)) - lag
        end = float(transmissions[1].angle(middle)) + 19 / 30 * lag
        assert found[at] == pytest.approx(end - 24 / 17 * 19 / 30 * start - even, abs=1e-9)


def test_teeth_that_turn_against_their_numbering_are_seen_from_behind() -> None:
    """A planet's wheel that turns one way against its arm and is measured so keeps its teeth in the other pair."""
    plan = find_trial_plan(load("freeth-2021-cut"), outputs=("moon",))
    train = load("freeth-2021-cut").motion()._problem
    signs: dict[str, set[int]] = {}
    for pair in plan.pairs:
        circuit = next(each for each in train.circuits if each.id == pair.name)
        for number, mirrored in zip((pair.first, pair.second), pair.mirrored, strict=True):
            name = plan.wheels[number].name
            link = circuit.i if name == circuit.wheels[0] else circuit.j
            speed = train.relative(link, circuit.carrier)
            signs.setdefault(name, set()).add((-1 if speed < 0 else 1) * (-1 if mirrored else 1))
    assert all(len(each) == 1 for each in signs.values())


# --------------------------------------------------------------------------------------------------------- closed forms


def variances(sizes: Any, of_driver: float, of_driven: float) -> np.ndarray:
    """Variances of the driven angle due to the ripple of perfect teeth, the driver and the driven wheel.

    The standard deviations of the teeth are fractions of a pitch. A late driving tooth delays the driven wheel by tau
    times its error, a late driven tooth by its own error.
    """
    transmission = TriangularTransmission(sizes)
    speed = transmission.speed((np.arange(2000) + 0.5) / 2000 * transmission.period)
    sigma1, sigma2 = of_driver * 2 * pi / sizes.z1, of_driven * 2 * pi / sizes.z2
    ripple = transmission.error_moments()[1]
    return np.array([ripple**2, float(np.mean(speed**2)) * sigma1**2, sigma2**2])


def test_the_variance_of_a_pointer_is_that_of_the_teeth_that_touch() -> None:
    plan = planned(chain((64, 38)), "pitch_deviation=0.6 %")
    true = variances(plan.pairs[0].sizes, 0.006, 0.006).sum()
    # near a change of tooth pairs the smaller lag counts: a few hundredths of the variance
    assert run_trials(plan, 4096).pointers[0].deviation.value ** 2 == pytest.approx(true, rel=0.1)


def test_a_fixed_error_of_the_distance_is_another_clearance() -> None:
    plan = planned(chain((40, 27)), "pitch_deviation=3 %", "centre=value 10 %")
    bare = planned(chain((40, 27)), "pitch_deviation=3 %")
    pair = bare.pairs[0]
    factor = (pair.sizes.D + 0.1 * min(pair.sizes.depths)) / pair.sizes.deepest_distance
    _, backlash = judged(drawn_wheels(plan, 50))
    _, true = judged(drawn_wheels(bare.cleared(factor), 50))
    # one is computed from tables, the other tooth pair by tooth pair
    assert backlash == pytest.approx(true, abs=2e-4)


def test_errors_are_read_in_the_units_of_their_wheel() -> None:
    data = chain((30, 20)).declaration.model_dump(mode="json", exclude_unset=True)
    data["links"]["l0"]["wheels"]["p0"] = {
        "teeth": 30,
        "module": "0.5 mm",
        "cutting": {
            "pitch_deviation": {"normal": "0.6 deg"},
            "eccentricity": {"value": "0.1 mm"},
            "eccentricity_angle": "90 deg",
            "aperture_deviation": {"uniform": "3 deg"},
        },
    }
    measured = [f"{at / 100:g} deg" for at in range(20)]
    data["links"]["l1"]["wheels"]["w0"] = {"teeth": 20, "cutting": {"measured": {"pitch_deviation": measured}}}
    plan = find_trial_plan(GearTrain.declare(data))
    first, second = plan.wheels
    assert first.errors["pitch_deviation"].size == pytest.approx(0.6 / 12)
    assert first.errors["aperture_deviation"].size == pytest.approx(3 / 60)
    # the pitch circle, 7.5 mm, is halfway down teeth whose flanks make 30 degrees with the radius
    outer = 7.5 / (1 - first.depth / 2)
    assert first.errors["eccentricity"].size * first.depth * outer == pytest.approx(0.1)
    drawn = drawn_wheels(plan, 3).pair(0)
    # ahead is early: a tooth's arrays count how late it is
    assert drawn.second.place[0] == pytest.approx(-np.radians(np.arange(20) / 100))
    # seen as the wheel turns forward, ahead is counted up: the middle lies 0.1 mm a quarter of a turn from the first
    tips = drawn.first.r * np.exp(-1j * drawn.first.theta)
    middle = np.mean(tips, axis=1) * outer / drawn.sizes.R1
    assert middle.imag == pytest.approx(0.1, abs=0.05)
    assert second.tables


# -------------------------------------------------------------------------------------------------- the same every time


class CutError(Exception):
    """Stands for a kill."""


def blocks_until(stop: int) -> Any:
    def tell(done: int, total: int) -> None:
        if done >= stop:
            raise CutError

    return tell


def same(one: Any, other: Any) -> bool:
    names = ("marks", "turns", "errors", "linear", "lags")
    return all(getattr(one, name).tobytes() == getattr(other, name).tobytes() for name in names)


@cache
def nine_hundred() -> tuple[TrialPlan, TrialResults]:
    """Trials in one go, against which all ways of sharing them out are held."""
    plan = planned(chain((12, 10), (9, 8)), "pitch_deviation=2 %", "tip=2 %")
    return plan, run_trials(plan, 900, 7)


@pytest.mark.parametrize(
    "workers", [lambda: ThreadPoolExecutor(2), pytest.param(lambda: open_executor(2), marks=pytest.mark.long)]
)
def test_cut_and_taken_up_or_by_two_workers_it_is_the_same_bit_for_bit(workers: Any, tmp_path: Path) -> None:
    plan, true = nine_hundred()
    requested = {"trials": 900}
    path = tmp_path / "journal"
    for stop in (1, 3):
        with Journal(path, requested) as journal, pytest.raises(CutError):
            run_trials(plan, 900, 7, Execution(None, journal, blocks_until(stop)))
    with Journal(path, requested) as journal:
        assert 0 < len(journal) < 16
    with workers() as executor, Journal(path, requested) as journal:
        assert same(run_trials(plan, 900, 7, Execution(executor, journal)), true)
        assert len(journal) == 16


def test_fewer_trials_are_the_first_of_many_and_another_seed_draws_others() -> None:
    plan, true = nine_hundred()
    fewer = run_trials(plan, 300, 7)
    assert (fewer.errors == true.errors[:300]).all()
    assert not (run_trials(plan, 300, 8).errors == fewer.errors).any()


def test_greater_errors_are_the_same_errors_and_other_clearances_meet_the_same_wheels() -> None:
    settings = ("pitch_deviation=2 %", "eccentricity=4 %")
    plan, higher = (planned(chain((20, 15)), *settings, f"tip={tip} %") for tip in (2, 4))
    one, twice = (drawn_wheels(each, 5).wheels[0] for each in (plan, higher))
    assert np.allclose(twice.place, one.place, atol=2e-3)
    placed = [drawn_wheels(each, 5) for each in (planned(chain((20, 15)), f"pitch_deviation={s} %") for s in (1, 2))]
    assert placed[1].wheels[0].place == pytest.approx(2 * placed[0].wheels[0].place)
    assert (drawn_wheels(plan.cleared(1.03), 5).wheels[1].place == drawn_wheels(plan, 5).wheels[1].place).all()


# -------------------------------------------------------------------------------------------------------------- studies


def test_total_indices_are_the_shares_of_the_closed_form() -> None:
    """Each wheel's total share is its part of the variance; the position of the input interacts with all of it."""
    plan = planned(chain((64, 38)), "p0.pitch_deviation=0.5 %", "w0.pitch_deviation=0.9 %")
    parts = variances(plan.pairs[0].sizes, 0.005, 0.009)
    found = {each.name: each for each in find_sobol_indices(plan, 0, "wheel", 1024).indices}
    assert found["p0"].total.value == pytest.approx(parts[1] / parts.sum(), abs=0.07)
    assert found["w0"].total.value == pytest.approx(parts[2] / parts.sum(), abs=0.09)
    assert found["position"].total.value > 0.85
    assert all(each.first.value <= each.total.value + 0.1 for each in found.values())
    kinds = {each.name for each in find_sobol_indices(plan, 0, "kind", 64).indices}
    assert kinds == {"pitch_deviation", "position"}


def test_variance_shares_sum_to_one_and_follow_the_sensitivities() -> None:
    """Of two pairs, the share of each is its variance times the square of the ratio behind it."""
    plan = planned(chain((48, 40), (32, 60)), "pitch_deviation=0.5 %")
    found = run_trials(plan, 2048)
    shares = found.pointers[0].shares
    assert sum(shares.values()) == pytest.approx(1)
    own = [variances(pair.sizes, 0.005, 0.005).sum() for pair in plan.pairs]
    alone = [(32 / 60) ** 2 * own[0], own[1]]
    assert shares["g0"] == pytest.approx(alone[0] / sum(alone), abs=0.06)
    off, size = found.pointers[0].first
    assert 0 < off < size


def test_more_clearance_jams_less_and_every_clearance_meets_the_same_wheels() -> None:
    plan = planned(chain((64, 38)), "pitch_deviation=3 %")
    found = jamming_map(plan, [1.008, 1.012, 1.016, 1.02], [1.0], 256)
    jams = [each.events["jam"].count for each in found]
    assert jams == sorted(jams, reverse=True)
    assert jams[0] > jams[-1]
    assert found[-1].events["jam"].count == run_trials(plan, 256).train.events["jam"].count


def test_along_a_turn_the_bands_are_in_order_and_hold_the_trials() -> None:
    plan = planned(chain((20, 15)), "pitch_deviation=2 %")
    course = run_course(plan, 0, 40, trials=60)
    bands = course.bands()
    assert (np.diff(bands, axis=0) >= 0).all()
    assert course.turns[-1] == pytest.approx(15 / 20)
    alone = pointer_errors(drawn_wheels(plan, 60, 1, 1 << 20), np.full(40, 7), course.turns)[0]
    assert course.errors[7] == pytest.approx(alone, abs=1e-12)
    assert course.maximum[7] == pytest.approx(np.abs(alone).max())


def test_a_cycle_of_teeth_is_no_longer_than_it_is() -> None:
    """Positions are drawn from all that the train can do before it repeats."""
    plan = planned(chain((20, 15), (14, 21)), "pitch_deviation=1 %")
    # all teeth are in their initial positions when both arbors of every pair have made whole turns
    speeds = (Fraction(1), Fraction(20, 15), Fraction(20, 15) * Fraction(14, 21))
    turns = next(n for n in range(1, 100) if all((n * speed).denominator == 1 for speed in speeds))
    assert plan.span == turns


# ---------------------------------------------------------------------------------------- teeth of any form, and filing

PAIR = """
name: pair
links: {frame: {}, a: {wheels: {p: 24}}, b: {wheels: {w: 37}}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
gears: [{pair: [p, w]}]
inputs: {a: 1}
outputs: {b: {}}
tooth_form: {form: FORM, backlash: 0.2}
cutting: {pitch_deviation: {normal: 1 %}}
fitting: {filing: {stroke: 1 %}}
"""


@pytest.mark.parametrize("form", ["involute", "cycloidal"])
def test_a_train_is_cut_filed_and_composed(form: str) -> None:
    plan = find_trial_plan(load(PAIR.replace("FORM", form)))
    found = run_trials(plan, 300)
    pair, train = found.filings
    assert pair.filed.count == train.filed.count > 0
    assert pair.jams.count == found.train.events["jam"].count == 0
    drawn = drawn_wheels(plan, 40)
    turns = np.linspace(0, 3, 40)
    errors = pointer_errors(drawn, np.arange(40), turns)[0]
    cut = drawn.pair(0)
    lag, _ = cut.minimum_lag(np.arange(40), np.mod(turns * 2 * pi, cut.count * 2 * pi / 24))
    # an external pair turns backwards: a lag is a positive error
    assert errors == pytest.approx(lag, abs=1e-10)
    # to first order sigma on each wheel, and a mean lag of none: the standard deviation of one tooth pair
    sigma = 0.01 * 2 * pi / 37 * 2**0.5
    assert 0.6 * sigma < found.pointers[0].deviation.value < 1.05 * sigma


def test_axles_that_are_not_where_the_teeth_are_made_for_are_no_error_of_cutting() -> None:
    text = PAIR.replace("FORM, backlash: 0.2", "cycloidal, backlash: 0.2, centre_distance: 30.55")
    train = load(text)
    plan = find_trial_plan(train, read_error_overrides(["pitch_deviation=0.0001 %"]))
    transmission, pitch, S = train.meshes[0].transmission, 2 * pi / 37, np.linspace(0, 2 * pi / 24, 50)
    lag = drawn_wheels(plan, 1).pair(0).minimum_lag(np.zeros(50, int), S)[0]
    # to first order in 0.05 modules, this is the ripple of the transmission function of the outlines
    assert np.ptp(transmission.error(S)) > 0.001 * pitch
    assert -lag == pytest.approx(transmission.error(S), abs=1e-3 * pitch)
    assert abs(run_trials(plan, 200).pointers[0].mean.value) < 1e-4 * pitch


def test_triangular_pairs_are_filed_until_they_turn() -> None:
    # 15 % of such pairs jam, as docs/cut-by-hand.md prints
    text = PAIR.replace("p: 24", "p: 64").replace("w: 37", "w: 38").replace("normal: 1 %", "normal: 5.16 %")
    form = "{form: triangular, half_angle: 30 deg, clearance_factor: 1.02}"
    plan = find_trial_plan(load(text.replace("{form: FORM, backlash: 0.2}", form)))
    bare = replace(plan, pairs=tuple(replace(pair, stroke=0.0) for pair in plan.pairs))
    before, after = run_trials(bare, 40), run_trials(plan, 40)
    assert before.train.events["jam"].count == after.filings[-1].filed.count > 0
    assert after.train.events["jam"].count == 0
    # against the transmission function of one pair
    drawn = drawn_wheels(plan, 40)
    at = int(np.argmax([work.strokes.sum() for work in drawn.filing.values()]))
    pair, trial = drawn.pair(at), int(drawn.filing[at].strokes.argmax())
    transmission = CutPairLaw.of(pair.sizes, pair.first.taken(trial), pair.second.taken(trial))
    assert transmission.events.backlash >= 0


@pytest.mark.parametrize("form", ["form: involute, backlash: 0.2", "form: triangular, half_angle: 30 deg, window: 0.5"])
def test_a_measured_wheel_is_the_same_in_all_trials(form: str) -> None:
    """Trials of a train without random errors raised an IndexError."""
    deviations = ", ".join(["0.1 deg"] * 23 + ["0 deg"])
    text = PAIR.replace("form: FORM, backlash: 0.2", form).replace("cutting: {pitch_deviation: {normal: 1 %}}\n", "")
    text = text.replace("p: 24", f"p: {{teeth: 24, cutting: {{measured: {{pitch_deviation: [{deviations}]}}}}}}")
    found = run_trials(find_trial_plan(load(text)), 20)
    assert found.filings[0].strokes.value == 0
    assert np.isfinite(found.errors).all()


def test_settings_and_wheels_of_other_forms() -> None:
    settings = read_error_overrides(
        ["pitch_deviation=0.2 %", "eccentricity=1 %", "aperture_deviation=1 %", "tip=1 %", "centre=1 %"]
    )
    for name in ("planetary-24-18-60-involute", "lantern-mill", "longcase-clock-cycloidal"):
        plan = find_trial_plan(load(name), settings)
        found = run_trials(plan, 16)
        assert np.isfinite(found.errors).all()
        assert np.ptp(found.errors) > 0
    plan = find_trial_plan(load("bevel-differential-involute"), settings, state="straight")
    assert np.isfinite(run_trials(plan, 16).errors).all()
