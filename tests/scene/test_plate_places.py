"""Search for positions of plates: equal to an exhaustive search, with a bounded number of computed distances."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import product
from typing import Any

import pytest
from shipped import train as load

from geartrain.scene import ManufacturingSizes, SolidModel
from geartrain.scene.parts import frame_plan

EFFORT = {"between": Fraction(3), "beyond": Fraction(3, 2), "passes": Fraction(11, 10)}
CORES = (4.0, 3.0, 2.0, 1.5, 1.0, 0.8)

Search = tuple[Any, Any, Sequence[Any], Sequence[float], Callable[..., int], Callable[[float], int]]


def searched(name: str, patch: pytest.MonkeyPatch) -> tuple[Search, frame_plan.PlateChoice]:
    """Return the arguments and the result of the first search for a train."""
    calls: list[Any] = []
    search = frame_plan.best_places
    patch.setattr(frame_plan, "best_places", lambda *call: calls.append(call) or search(*call))
    plan = SolidModel(load(name), ManufacturingSizes()).plan
    assert plan is not None
    assert plan.choice is not None
    return calls[0], search(*calls[0])


def effort(column: Any, places: Any) -> Fraction:
    back, front = places.back[0], places.front[0]
    if "stud" in column.bearing.value:
        inside = [each for each in column.members if each.high > back and each.low < front]
        return EFFORT["between" if inside else "beyond"]
    passed = [at for at in (back, front) if any(each.low < at < each.high for each in column.members)]
    return EFFORT["passes"] * len(passed)


def every_place(search: Search, kind: type[Any]) -> Iterator[tuple[tuple[int, Fraction], bool, Any, tuple[Any, ...]]]:
    """Yield the costs of every pair of gaps with every combination of carrier seats."""
    axes, discs, seats, gaps, blocked, cut = search
    pairs = [(gaps[low], gaps[high]) for high in range(len(gaps) - 1, 0, -1) for low in range(high)]
    for inside in (False, True):
        for chosen in product(*seats):
            stack = [*discs, *(plate.disc for seat in chosen for plate in seat.plates)]
            problems = [frame_plan.with_discs(axis, stack) for axis in axes]
            for back, front in pairs:
                if (back > gaps[0] and front < gaps[-1]) == inside:
                    places = kind((back, back), (front, front))
                    best = [frame_plan.best_column(each.columns(places)) for each in problems]
                    bad = sum(len(each.hit) + (each.tangled is not None) for each in best)
                    bad += blocked(chosen) + cut(back) + cut(front)
                    yield (bad, sum((effort(each, places) for each in best), Fraction(0))), inside, places, chosen


@pytest.mark.parametrize("name", ["longcase-clock", "huygens-planetarium-1682", "zf-9hp48", "pennestri-2002"])
def test_no_place_of_the_plates_is_better_than_the_one_found(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    search, choice = searched(name, monkeypatch)
    every = list(every_place(search, type(choice.places)))
    outer = min((each for each in every if not each[1]), key=lambda each: each[0])
    expected = outer if not outer[0][0] else min(every, key=lambda each: each[0])
    assert (choice.places, choice.seats) == expected[2:]
    assert choice.cost[0] == expected[0][0]


def test_the_arbor_is_the_thickest_usual_one_that_passes_all_wheels(monkeypatch: pytest.MonkeyPatch) -> None:
    (axes, discs, _, gaps, *_), choice = searched("freeth-2021", monkeypatch)
    thinned = 0
    for back, front in [(gaps[0], gaps[-1]), (gaps[0], gaps[9]), (gaps[5], gaps[-1]), (gaps[3], gaps[12])]:
        places = type(choice.places)((back, back), (front, front))
        for problem in (frame_plan.with_discs(axis, discs) for axis in axes):
            for at, column in enumerate(problem.columns(places)):
                usual = {core: list(replace(problem, core=core).columns(places))[at] for core in CORES}
                fit = [core for core in CORES if not usual[core].hit]
                if column.hit:
                    assert [core for core in fit if core < column.core] == []
                elif column.core in CORES:
                    thinned += 1
                    assert column.core == max(fit)
    assert thinned > 0
