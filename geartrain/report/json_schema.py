"""The JSON answer of each question: of a command, or of one of its uses that is a question of its own.

Shapes are read off the results that are told. Written by hand are those of pages on one pair of teeth, whose figures
no result holds together, and what commands add to a result.
"""

from __future__ import annotations

from functools import cache

from geartrain.report.json_shapes import Schema, shape_of
from geartrain.teeth.transmission_figures import SlidingEfficiency

TEXT, NUMBER, COUNT, FLAG, NULL = map(shape_of, (str, float, int, bool, None.__class__))
TEXTS, EXACT, SOME = shape_of(list[str]), shape_of(str | None), shape_of(float | None)


def _list(item: Schema, length: int | None = None) -> Schema:
    """A list of one kind of thing, of a length if it has one."""
    fixed = {} if length is None else {"minItems": length, "maxItems": length}
    return {"type": "array", "items": item, **fixed}


def _maybe(kind: Schema) -> Schema:
    return {"anyOf": [kind, NULL]}


def _has(keys: Schema, optional: Schema | None = None) -> Schema:
    """An object with all of these keys. `optional` ones are told of in docs/json.md; a later version may add others."""
    return {"type": "object", "required": list(keys), "properties": keys | (optional or {})}


OBJECT: Schema = {"type": "object"}

# ------------------------------------------------------------------------------------------------------ a pair of teeth

EFFICIENCY = shape_of(SlidingEfficiency | None)

SHAPE = _has(
    {
        "form": TEXT,
        "teeth": _list(COUNT, 2),
        "verdict": _has({"kind": TEXT, "text": TEXT, "play": SOME, "faults": _list(OBJECT)}),
        "pitch_radii": _list(NUMBER, 2),
        "arcs": _list(NUMBER, 2),
        "contact_ratio": SOME,
        "pressure_angles": _list(SOME),
        "costs": _maybe(OBJECT),
        "efficiency": EFFICIENCY,
        "outlines": _list(OBJECT),
    }
)
COMPARED = _has(
    {
        "teeth": _list(COUNT, 2),
        "matched": TEXT,
        "base": _has({"form": TEXT}),
        "forms": _list(_has({"form": TEXT, "runs": FLAG, "ratios": _maybe(OBJECT), "faults": _list(OBJECT)})),
    }
)


# ----------------------------------------------------------------------------------------------------------- questions


@cache
def answers() -> dict[str, Schema]:
    """By question, the schema of its answer."""
    return {**_of_trains(), **_of_doubt(), **_of_spheres(), **_of_tooth_numbers(), **_of_pairs()}


def _of_trains() -> dict[str, Schema]:
    from geartrain.numerics.labelled_array import LabelledArray
    from geartrain.report.accuracy_report import AccuracyReport
    from geartrain.report.motion_figures import MotionFigures
    from geartrain.report.torque_figures import TorqueReport
    from geartrain.report.train_data import TrainAnswers, TrainReport

    report = shape_of(TrainReport)
    report = report | {"properties": report["properties"] | {"teeth": _list(_driven_pair())}}
    edges = {"nodes": _list(OBJECT), "edges": _list(OBJECT)}
    return {
        "solve": shape_of(TrainAnswers),
        "report": _list(report),
        "compare": _list(report),
        "torques": shape_of(TorqueReport),
        "motion": shape_of(MotionFigures),
        "bench": shape_of(AccuracyReport),
        "graph --as matrix": shape_of(LabelledArray),
        "graph --as json": _has({"directed": FLAG, "multigraph": FLAG, "graph": OBJECT, **edges}),
    }


def _of_doubt() -> dict[str, Schema]:
    from geartrain.uncertainty.monte_carlo.monte_carlo_result import MonteCarloResult
    from geartrain.uncertainty.posterior.posterior_result import ToothCountPosterior

    return {"montecarlo": shape_of(MonteCarloResult), "posterior": shape_of(ToothCountPosterior)}


def _of_spheres() -> dict[str, Schema]:
    from geartrain.spherical.gear_sphere import GearSphere
    from geartrain.spherical.polyhedron_survey import SurveyRow
    from geartrain.spherical.tooth_count_search import ToothCountSuggestions

    return {
        "sphere": shape_of(GearSphere),
        "sphere --suggest": shape_of(ToothCountSuggestions),
        "sphere --survey": shape_of(list[SurveyRow]),
    }


def _of_tooth_numbers() -> dict[str, Schema]:
    from geartrain.synthesis.epicyclic.epicyclic_sets import SetFindings
    from geartrain.synthesis.epicyclic.set_kinds import EpicyclicKind
    from geartrain.synthesis.orrery.orrery_result import Orrery
    from geartrain.synthesis.ratio.stage_search import StageFindings
    from geartrain.synthesis.stern_brocot import Approximants
    from geartrain.synthesis.train.train_findings import TrainFindings

    return {
        "teeth ratio": shape_of(StageFindings),
        "teeth approximants": shape_of(Approximants),
        "teeth set": shape_of(SetFindings),
        "teeth set --kind list": shape_of(dict[str, EpicyclicKind]),
        "teeth train": shape_of(TrainFindings),
        "teeth orrery": shape_of(Orrery),
    }


def _driven_pair() -> Schema:
    """A pair with teeth of any form, with the figures of that form."""
    from geartrain.report.gear_pairs import DrivenPair
    from geartrain.teeth.any_tooth_form import tooth_forms

    pair = shape_of(DrivenPair)
    found = []
    for figures in dict.fromkeys(form.figures() for form in tooth_forms().values()):
        own = shape_of(figures)
        required = dict.fromkeys([*pair["required"], *own["required"]])
        found.append(pair | {"properties": pair["properties"] | own["properties"], "required": list(required)})
    return {"anyOf": found}


def _of_pairs() -> dict[str, Schema]:
    from geartrain.report.gear_pairs import TriangularPair
    from geartrain.teeth.pin_figures import PinFigures

    return {
        "mesh triangular": shape_of(TriangularPair),
        "mesh triangular --vary": shape_of(list[dict[str, float | str | None]]),
        "mesh pin": shape_of(PinFigures),
        "mesh FORM": SHAPE,
        "mesh compare": COMPARED,
    }


def answer_schema() -> Schema:
    """One JSON Schema (draft 2020-12) for all answers; `#/$defs/QUESTION` is that of one question's answer.

    Returns
    -------
    dict
        Keys and kinds of values are read off the results that are told, their descriptions off docstrings. Questions
        are commands, or uses of a command whose answer has another shape; docs/json.md tells of them.

    Examples
    --------
    >>> answer = answer_schema()["$defs"]["solve"]
    >>> answer["required"]
    ['name', 'title', 'unit', 'mobility', 'states']
    """
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Answers of geartrain",
        "description": "What each command prints with --json; keys may be added, and none is left out.",
        "$defs": answers(),
    }
