"""The compiled composition of motion is that of numpy to 1e-12, with every law, block and way of turning."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
import pytest
from commands import call, ended, without

from geartrain import GearTrainError, load
from geartrain.dynamics.motion.compiled_composition import CompiledComposition, compiled_composition
from geartrain.errors import MissingExtraError

TOOTHED = ("moon-triangular", "sorge-pairs", "longcase-clock-bs978", "freeth-2021", "freeth-2021-teeth",
           "freeth-2021-cut", "freeth-2006", "voulgaris-2022")  # fmt: skip


def compiled(composition: Any) -> CompiledComposition:
    found = compiled_composition(composition)
    assert found is not None
    return found


@pytest.mark.parametrize("name", TOOTHED)
@pytest.mark.parametrize("way", ["_forward", "_backward"])
def test_every_link_of_a_shipped_train_moves_as_without_kernels(name: str, way: str) -> None:
    train = load(name)
    composition = getattr(train.motion(outputs=list(train.declaration.links)), way)
    turns = np.append(np.linspace(0, 3.7, 1501), [1e3 + 1 / 3, 12345.678, -0.3])
    plain, fast = composition.at(turns), compiled(composition).at(turns)
    assert np.abs(fast.error - plain.error).max() < 1e-12
    # on either side of a corner a speed has another value, and rounding chooses the side
    off = np.abs(fast.rate - plain.rate) / (1 + np.abs(plain.rate))
    assert np.mean(off < 1e-11) > 0.999
    assert fast.reversing_drivers == plain.reversing_drivers
    assert np.array_equal(fast.turns, plain.turns)


def test_transmissions_that_are_read_from_tables_are_read_from_the_same() -> None:
    composition = load("moon-triangular").motion(outputs=["moon"], tolerance=1e-6)._forward
    turns = np.linspace(0, 95, 3001)
    plain, fast = composition.at(turns), compiled(composition).at(turns)
    assert np.abs(fast.error - plain.error).max() < 1e-14
    assert np.abs(fast.error - load("moon-triangular").motion(outputs=["moon"])._forward.at(turns).error).max() > 1e-12


def test_the_kernel_in_plain_python_is_the_compiled_one() -> None:
    for name in ("freeth-2021-teeth", "moon-triangular"):
        train = load(name)
        kernel = compiled(train.motion(outputs=list(train.declaration.links))._forward)
        turns = np.linspace(0, 2, 7)
        plain, fast = CompiledComposition(kernel.composition, kernel.arrays, fast=False).at(turns), kernel.at(turns)
        assert np.abs(plain.error - fast.error).max() < 1e-14
        assert np.abs(plain.rate - fast.rate).max() < 1e-13


def test_pairs_that_depend_on_each_other_are_left_to_numpy() -> None:
    for name in ("pennestri-2002-teeth", "planetary-24-18-60-triangular"):
        assert compiled_composition(load(name).motion()._forward) is None


def test_pairs_that_cannot_be_followed_are_refused_with_their_names() -> None:
    composition = load("pennestri-2002-teeth").motion()._forward
    # the pairs of the step with three sources move each other's drivers a thousand times as far
    composition.steps = tuple(
        step._replace(own=1e3 * step.own) if len(step.sources) > 1 else step for step in composition.steps
    )
    with pytest.raises(GearTrainError, match="coupled pairs"):
        composition.at(np.linspace(0, 1, 2000))


def test_the_command_says_the_same_with_kernels_and_without() -> None:
    words = ("motion", "moon-triangular", "--samples", 3000, "--turns", 2, "--spectrum")
    slow, fast, default = call(*words, "--no-fast"), call(*words, "--fast"), call(*words)
    assert slow.exit_code == 0
    assert slow.output == fast.output == default.output


def test_kernels_that_are_requested_for_and_not_installed_are_named_with_their_extra(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    motion = load("moon-triangular").motion(outputs=["moon"], fast=True)
    with monkeypatch.context() as patch:
        patch.setitem(sys.modules, "numba", None)
        with pytest.raises(MissingExtraError, match=r"pip install 'numba>=0\.61'"):
            motion.at([0.0, 1.0])
        refused = ended("motion", "moon-triangular", "--samples", 100, "--fast")
        assert refused.returncode == 2
        assert "pip install 'numba>=0.61'" in refused.stderr
        assert ended("motion", "moon-triangular", "--samples", 100).returncode == 0


@pytest.mark.parametrize("train", ["moon-triangular", "worm"])
def test_a_motion_of_few_positions_or_of_ideal_teeth_needs_no_numba(train: str) -> None:
    done = without("numba", "llvmlite", arguments=["motion", train, "--samples", 1000])
    assert (done.returncode, done.stderr) == (0, "")
