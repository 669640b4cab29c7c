"""Error laws of teeth and pins as tables that a page can carry."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.exact import written
from geartrain.scene.result import Law, Source, Step

if TYPE_CHECKING:
    from geartrain.motion import Composition
    from geartrain.motion.composition import Step as Composed
    from geartrain.teeth.base import Law as ToothLaw

TOLERANCE = 1e-11  # of a driven pitch
_DEGREES = (7, 9, 11, 14)  # tried in turn: the smallest table wins


def step_of(step: Composed) -> Step:
    """A step of a composition in plain numbers."""
    return Step(
        bodies=step.links,
        known=step.known,
        from_known=step.from_known.tolist(),
        sources=step.sources,
        from_sources=step.from_sources.tolist(),
        coupled=step.coupled,
    )


def laws_and_sources(composition: Composition) -> tuple[tuple[Law, ...], tuple[Source, ...]]:
    """Every source with its law; pairs alike share one."""
    laws: dict[tuple[float, bytes, bytes], Law] = {}
    numbers: dict[tuple[float, bytes, bytes], int] = {}
    sources = []
    for source in composition.sources:
        law = tabulated(source.id, source.law)
        key = law.period, law.breaks.tobytes(), law.coefficients.tobytes()
        laws.setdefault(key, law)
        joint = composition.spread.joints[source.pair]
        sources.append(
            Source(
                pair=source.id,
                law=numbers.setdefault(key, len(numbers)),
                driver=joint.driver,
                carrier=joint.carrier,
                driver_sense=source.driver_sense,
                carrier_sense=source.carrier_sense,
                cycles=written(source.cycles),
                start=source.start,
                forward=source.forward,
                sense=source.sense,
            )
        )
    return tuple(laws.values()), tuple(sources)


def tabulated(pair: str, law: ToothLaw) -> Law:
    """The error of a law as polynomials within `TOLERANCE` of a driven pitch, in the fewest numbers."""
    import numpy as np

    from geartrain.teeth.table import Tabulated

    tables = (Tabulated(law, TOLERANCE, degree).error_table for degree in _DEGREES)
    pitch = (float(law.ratio) or 1.0) * law.period
    # where rounding keeps all tables from the tolerance, the nearest one
    table = min(tables, key=lambda each: (max(each.uncertainty / pitch, TOLERANCE), each.coefficients.size))
    breaks = np.sort(np.concatenate((np.arange(table.cells + 1) * (law.period / table.cells), table.corners)))
    breaks[-1] = law.period
    wide = np.diff(breaks) > 0
    return Law(
        pair,
        law.period,
        np.append(breaks[:-1][wide], law.period),
        np.ascontiguousarray(table.coefficients.T[wide]),
        table.uncertainty,
    )
