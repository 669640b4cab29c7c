"""Declarations and answers cannot be changed behind the back of who holds them, and go when nobody does."""

from __future__ import annotations

import copy
import gc
import pickle
import weakref
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import fields, is_dataclass
from fractions import Fraction
from types import MappingProxyType
from typing import Any

import numpy as np
import pytest
from pydantic import BaseModel
from shipped import every_train

from geartrain import GearTrainError, load


def mutable(value: Any, path: str, met: set[int]) -> Iterator[str]:
    """Paths to everything below a value that could be changed."""
    if id(value) in met:
        return
    met.add(id(value))
    if isinstance(value, BaseModel):
        for name in type(value).model_fields:
            yield from mutable(getattr(value, name), f"{path}.{name}", met)
    elif is_dataclass(value) and not isinstance(value, type):
        for each in fields(value):
            yield from mutable(getattr(value, each.name), f"{path}.{each.name}", met)
    elif isinstance(value, Mapping):
        with suppress(TypeError, AttributeError):
            value.update({})  # type: ignore[attr-defined]
            yield path
        for key in value:
            yield from mutable(value[key], f"{path}[{key}]", met)
    elif isinstance(value, tuple):
        for at, part in enumerate(value):
            yield from mutable(part, f"{path}[{at}]", met)
    elif isinstance(value, np.ndarray):
        if value.flags.writeable:
            yield path
    elif isinstance(value, list | set | bytearray):
        yield path


@pytest.mark.parametrize("name", every_train())
def test_nothing_in_a_declaration_or_an_answer_can_be_changed(name: str) -> None:
    train = load(name)
    state = train.states[0] if train.states else None
    held = {"declaration": train.declaration, "tree": train.kinematics.tree, "circuits": train.circuits}
    held |= {"answer": train.solve(state), "torques": train.torques(state), "mobility": train.mobility}
    if train.solve(state).verdict:
        held |= {"floats": train.kinematics.floats(state), "sparse": train.solve(state, method="sparse")}
    found = [path for key, value in held.items() for path in mutable(value, key, set())]
    assert not found


def test_the_transmission_finds_what_can_be_changed() -> None:
    assert list(mutable(MappingProxyType({"a": [1], "b": {"c": 1}}), "x", set())) == ["x[a]", "x[b]"]


@pytest.mark.parametrize("output", [None, "8"])
def test_an_answer_in_floats_is_copied_pickled_and_compared_read_or_not(output: str | None) -> None:
    train = load("pennestri-2002")
    answer, unread = (train.solve(output=output, method="sparse") for _ in range(2))
    told = answer.to_dict()
    for again in (copy.copy(unread), copy.deepcopy(unread), pickle.loads(pickle.dumps(unread)), unread):
        assert again == answer
        assert again.to_dict() == told
    assert answer != train.solve(output=output, method="exact")


def test_what_a_train_does_not_have_is_refused_with_what_it_has() -> None:
    train = load("norton-compound")
    one, other = next(iter(train.declaration.inputs)), list(train.declaration.links)[-1]
    floats = train.kinematics.floats
    questions = {
        "unknown method 'quick'": lambda: train.solve(method="quick"),  # type: ignore[arg-type]
        "unknown link 'nowhere'": lambda: train.driven("nowhere", one),
        "unknown link 'noone'": lambda: train.driven(other, "noone"),
        "unknown input 'nothing'": lambda: floats(inputs={one: [1.0], "nothing": [1.0]}),
        "is not finite": lambda: floats(inputs={link: [float("nan")] for link in train.declaration.inputs}),
        "has no state": lambda: train.solve("first"),
        "has no output or link": lambda: train.motion(outputs=["nothing"]),
        "has no pair": lambda: train.motion(without=["nothing"]),
    }
    for said, question in questions.items():
        with pytest.raises(GearTrainError, match=said) as caught:
            question()
        assert all(problem.fix for problem in caught.value.problems)


def test_every_input_needs_as_many_speeds_as_the_others() -> None:
    train = load({"extends": "bevel-differential", "states": None, "inputs": {"left": 1, "right": 2}})
    names = list(train.declaration.inputs)
    with pytest.raises(GearTrainError, match=f"input '{names[1]}' is missing"):
        train.kinematics.floats(inputs={names[0]: [1.0]})
    with pytest.raises(GearTrainError, match="unequal numbers of cases"):
        train.kinematics.floats(inputs={names[0]: [1.0], names[1]: [1.0, 2.0]})
    right = train.kinematics.floats(inputs={names[0]: [1.0, 3.0], names[1]: [2.0, 1.0]})
    exact = train.solve()
    for link, speed in exact.speeds.items():
        assert right.speeds[link][0] == pytest.approx(float(Fraction(speed)))


@pytest.mark.parametrize("name", ["worm", "norton-planetary", "bevel-differential", "pennestri-2002-teeth"])
def test_a_train_that_nobody_holds_is_gone_without_the_garbage_collector(name: str) -> None:
    train = load(name)
    held = weakref.ref(train)
    running = gc.isenabled()
    gc.disable()
    try:
        for question in (train.solve, train.torques, train.motion):
            with suppress(GearTrainError):  # not every train has loads, or teeth
                question()
        del train, question
        assert held() is None
    finally:
        if running:
            gc.enable()
