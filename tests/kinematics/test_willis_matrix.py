"""The Willis system as a matrix: against rows written another way, dense elimination over the rationals, and itself."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import pytest
import shipped
from hypothesis import given, settings
from joint_rates import move
from random_trains import driven_train
from reference_solver import echelon, willis_rows
from scipy.sparse import csc_array
from scipy.sparse.linalg import splu, spsolve
from strategies import Data, overdriven_trains, trains

from geartrain import GearTrain, load
from geartrain.errors import RangeError
from geartrain.kinematics import WillisEquation, WillisMatrix, WillisSystem
from geartrain.kinematics.willis_matrix import PaddedRows


def dense_solution(found: WillisMatrix) -> dict[str, Fraction]:
    """The speeds by Gauss and Jordan over the rationals, from the floats of the matrix, which is square and regular."""
    entries = found.matrix.toarray()
    lines = [[*map(Fraction, row), right] for row, right in zip(entries.tolist(), found.exact_right, strict=True)]
    assert len(lines) == len(found.links)
    assert len(echelon(lines, len(found.links))) == len(found.links)
    return {link: line[-1] for link, line in zip(found.links, lines, strict=True)}


def test_elimination_of_the_matrix_gives_the_speeds_of_the_joint_rates() -> None:
    """With bevels, nested carriers, equal planets, and several units of speed."""
    for seed in range(60):
        train = driven_train(seed)
        requested, motion = GearTrain.declare(train.data), move(train)
        found = requested.equations().matrix()
        for link, speed in dense_solution(found).items():
            assert not motion.is_rotation(link) or speed == motion.speed(link), (seed, link)


@given(trains())
def test_rows_of_pairs_are_those_of_the_declaration_in_whole_numbers(data: Data) -> None:
    """Each is a multiple of the row that the naive solver makes of the same declaration."""
    train = GearTrain.declare(data)
    found = train.equations().matrix(whole=True)
    assert found.links == tuple(data["links"])
    rows, _ = willis_rows(data)
    entries = found.matrix.toarray()
    assert (entries == np.rint(entries)).all()
    for circuit, row in zip(train.circuits, rows, strict=True):
        line = dict(zip(found.links, map(Fraction, entries[found.labels.index(circuit.id)].tolist()), strict=True))
        lead = line[circuit.i] / row[circuit.i]
        assert line == {link: lead * row.get(link, Fraction(0)) for link in found.links}


@pytest.mark.parametrize("name", shipped.every_train())
def test_every_shipped_train_has_its_matrix_in_every_state(name: str) -> None:
    train = shipped.train(name)
    for state in train.states or (None,):
        system, answer = train.equations(state), train.solve(state, method="exact")
        found, whole = system.matrix(), system.matrix(whole=True)
        assert isinstance(found.matrix, csc_array)
        assert found.matrix.shape == (len(found.labels), len(found.links))
        assert whole.labels == tuple(row.label for row in system.equations)
        assert {*found.labels, *found.omitted} == set(whole.labels)
        assert whole.links == system.links
        assert whole.omitted == ()
        assert set(system.links) - set(found.links) == {train.declaration.frame}
        for each in (found, whole):
            entries = each.matrix.tocoo()
            exact = {(row.label, link): float(c) for row in each.rows for link, c in row.terms if link in each.links}
            assert {
                (each.labels[row], each.links[column]): value
                for row, column, value in zip(entries.row, entries.col, entries.data.tolist(), strict=True)
            } == exact
            assert each.right.tolist() == [float(right) for right in each.exact_right]
        if answer.verdict.kind == "determined":
            size = len(found.links)
            assert found.matrix.shape == (size, size)
            lu = splu(found.matrix)
            speeds = lu.solve(found.right)
            truth = np.array([float(answer.speeds[link]) for link in found.links])
            assert np.abs(speeds - truth).max() <= 1e-9 * np.abs(truth).max()


def test_the_maximum_counts_are_held_exactly() -> None:
    top = 10**12
    wheels = {"a": {"wheels": {"p": top - 1}}, "b": {"wheels": {"q": top}}, "arm": {"wheels": {}}}
    joints = [{"pair": ["frame", "a"], "axis": "A"}, {"pair": ["frame", "arm"], "axis": "A"}]
    joints.append({"pair": ["arm", "b"], "axis": "B"})
    train = GearTrain.declare(
        {
            "links": {"frame": {}, **wheels},
            "revolutes": joints,
            "gears": [{"pair": ["p", "q"]}],
            "inputs": {"a": 1, "arm": Fraction(1, 3)},
        }
    )
    found = train.equations().matrix()
    assert found.matrix.toarray()[0].tolist() == [top - 1, top, 1 - 2 * top]
    assert found.exact_right == (0, 1, Fraction(1, 3))
    assert found.right.tolist() == [0, 1, 1 / 3]


LOOPED = """
links: {frame: {}, a: {wheels: {p: 20}}, b: {wheels: {q: 30, r: 40}}, c: {wheels: {s: 25}}}
revolutes: {A: [frame, a], B: [frame, b], C: [frame, c]}
gears: [{id: one, pair: [p, q]}, {id: two, pair: [r, s]}, {id: three, pair: [s, p]}]
inputs: {INPUTS}
"""


def test_a_train_that_is_not_determined_has_a_matrix_too() -> None:
    def shape(text: str, inputs: str) -> tuple[Any, ...]:
        found = load(text.replace("INPUTS", inputs)).equations().matrix()
        return (*found.matrix.shape, int(np.linalg.matrix_rank(found.matrix.toarray())), found.omitted)

    assert load(LOOPED.replace("INPUTS", "a: 1")).solve().verdict.kind == "locked"
    assert shape(LOOPED, "") == (3, 3, 3, ("frame",))  # locked: three pairs hold three links
    assert shape(LOOPED, "a: 1") == (4, 3, 3, ("frame",))  # no row follows from the others, and they have no solution
    chain = LOOPED.replace(", {id: three, pair: [s, p]}", "")
    assert shape(chain, "") == (2, 3, 2, ("frame",))  # free
    assert shape(chain, "a: 1") == (3, 3, 3, ("frame",))
    assert shape(chain, "a: 1, b: -2/3") == (3, 3, 3, ("frame", "input b"))  # said twice
    assert shape(chain, "a: 1, b: 1") == (4, 3, 3, ("frame",))  # said against


@settings(max_examples=15)
@given(overdriven_trains())
def test_what_contradicts_is_not_left_out(data: Data) -> None:
    found = GearTrain.declare(data).equations().matrix()
    assert found.matrix.shape[0] > found.matrix.shape[1]


def test_a_speed_beyond_floats_is_refused_in_words() -> None:
    rows = (
        WillisEquation("frame", "frame", (("frame", 1),)),
        WillisEquation("x", "input", (("a", 1),), Fraction(10**400)),
    )
    with pytest.raises(RangeError, match="'x' is beyond the range of float64"):
        WillisSystem(("frame", "a"), rows).matrix()


@pytest.mark.parametrize("name", ["pennestri-2002", "three-planets", "four-gear-loop", "humpage"])
def test_the_sparse_method_factorises_exactly_this_matrix(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    train, factorised = shipped.train(name), []
    original = PaddedRows.factorise

    def seen(self: Any) -> Any:
        factorised.append(self.matrix())
        return original(self)

    monkeypatch.setattr(PaddedRows, "factorise", seen)
    answer = train.solve(method="sparse")
    system = train.equations().matrix()
    (used,) = factorised
    for part in ("data", "indices", "indptr"):
        assert getattr(used, part).tolist() == getattr(system.matrix, part).tolist()
    assert tuple(answer.residual) == system.labels
    plain = spsolve(system.matrix, system.right)
    for link, speed in zip(system.links, plain.tolist(), strict=True):
        allowed = 1e-15 * (answer.accuracy[link].condition if speed else 1) * abs(speed) + 1e-15
        assert abs(answer.speeds[link] - speed) <= allowed


@pytest.mark.parametrize("seed", range(30))
def test_residual_condition_and_estimate_are_what_they_say(seed: int) -> None:
    """In exact arithmetic: the residual of each row, and that no speed is off by more than condition times residual."""
    train = GearTrain.declare(driven_train(seed).data)
    answer, found = train.solve(method="sparse"), train.equations().matrix()
    exact = dense_solution(found) | {train.declaration.frame: Fraction(0)}
    speeds = {link: Fraction(speed) for link, speed in answer.speeds.items()}
    for row in found.rows:
        terms = [c * speeds[link] for link, c in row.terms]
        size = sum(map(abs, terms))
        off = abs(row.right - sum(terms)) / size if size else Fraction(0)
        assert answer.residual[row.label] == pytest.approx(float(off), rel=1e-9, abs=1e-30)
    most = Fraction(max(answer.residual.values())) * Fraction(1 + 1e-9)
    for link, accuracy in answer.accuracy.items():
        error = abs(speeds[link] - exact[link])
        assert error <= Fraction(accuracy.estimate)
        if speeds[link]:
            assert accuracy.condition is not None
            assert error <= most * Fraction(accuracy.condition) * abs(speeds[link])
    # conditions by the dense inverse
    dense, sizes = found.matrix.toarray(), [abs(float(speeds[link])) for link in found.links]
    reach = np.abs(np.linalg.inv(dense)) @ np.abs(dense) @ sizes
    for link, most_changed, size in zip(found.links, reach, sizes, strict=True):
        condition = answer.accuracy[link].condition
        assert condition == (pytest.approx(most_changed / size, rel=1e-6) if size else np.inf)


def test_a_frame_or_a_link_at_rest_has_an_infinite_condition() -> None:
    found = load("two-k-h-10000").kinematics.floats().condition
    assert found["case"] == found["held"] == np.inf
    assert round(found["output"]) == 80399
