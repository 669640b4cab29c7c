"""Results that show themselves, by what draws them."""

from __future__ import annotations

import importlib
import inspect
import pkgutil
from typing import Any

import pytest
import shipped

import geartrain
from geartrain.dynamics import MotionRun
from geartrain.errors import QuestionError
from geartrain.numerics.results import Pictured

pytest.importorskip("matplotlib")


def every_kind() -> list[type[Any]]:
    for room in ("analysis", "dynamics", "teeth", "search", "simulation", "workshop"):
        package = importlib.import_module(f"geartrain.{room}")
        for module in pkgutil.walk_packages(package.__path__, f"geartrain.{room}."):
            importlib.import_module(module.name)
    return Pictured.__subclasses__()


def test_each_kind_of_result_names_what_draws_it() -> None:
    kinds = every_kind()
    assert len(kinds) >= 7
    for kind in kinds:
        module, name = kind.FIGURE.split(":")
        maker = getattr(importlib.import_module(f"geartrain.{module}"), name)
        first, *_ = inspect.signature(maker).parameters.values()
        assert first.annotation == kind.__name__, f"{kind.__name__}: {kind.FIGURE} takes {first.annotation}"


def test_a_motion_draws_the_outputs_that_are_requested_for() -> None:
    motion = shipped.train("moon-triangular").motion(outputs=["moon"])
    figure = motion.plot("moon", turns=0.25, samples=101)
    own = MotionRun(motion, 0.25, 101).plot()
    assert figure._repr_svg_() == own._repr_svg_()
    with pytest.raises(QuestionError, match="unknown output 'mars'"):
        motion.plot("mars")


def test_torques_draw_their_flow_of_power() -> None:
    train = geartrain.load("""
        extends: planetary-24-18-60
        loads: {carrier: -10 N m}
    """)
    texts = {text.get_text() for text in train.torques().plot().axes[0].texts}
    assert {"sun", "carrier"} <= texts


def test_a_train_draws_itself_and_turns_in_a_frame() -> None:
    from geartrain.drawing import picture

    train = shipped.train("planetary-24-18-60")
    assert train.draw("stick")._repr_svg_() == picture(train, "stick")._repr_svg_()
    assert train.draw(turns=1)._repr_svg_() != train.draw()._repr_svg_()
    assert "height:300px" in train.view(height=300)._repr_html_()
