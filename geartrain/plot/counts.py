"""A sweep of tooth counts as a picture: what the outputs say of the wheels in doubt."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from geartrain.errors import Problem, QuestionError
from geartrain.plot.corner import Likely, corner_figure
from geartrain.plot.library import Figure

if TYPE_CHECKING:
    from geartrain.uncertainty.counts import CountSweep

Pairs = Mapping[tuple[str, str], Mapping[tuple[int, int], float]]


def counts_figure(found: CountSweep, pairs: Pairs) -> Figure:
    """Posteriors of some wheels, before and after, and of each two of them together.

    pairs   two wheels, in the order declared -> their counts -> probability

    Raises `QuestionError` where nothing fits, and where no wheel or more than a page holds is to be drawn.
    """
    wheels = list(dict.fromkeys(wheel for pair in pairs for wheel in pair))
    if not all(found[wheel].chances for wheel in wheels):
        what = f"no combination of counts of '{found.name}' fits, so there is nothing to draw"
        raise QuestionError(Problem(what, "no count is likelier than another", "widen the tolerances or the counts"))
    single = {
        wheel: {count: float(each) for count, each in zip(one.doubt.counts, one.chances, strict=True) if float(each)}
        for wheel, one in ((wheel, found[wheel]) for wheel in wheels)
    }
    before = {
        wheel: dict(zip(found[wheel].doubt.counts, map(float, found[wheel].doubt.priors), strict=True))
        for wheel in wheels
    }
    declared = {wheel: count for wheel in wheels if (count := found[wheel].doubt.declared) is not None}
    asked = ", ".join(witness.name for witness in found.witnesses)
    return corner_figure(Likely(single, pairs, before, declared), f"{found.name}: counts that give {asked}")
