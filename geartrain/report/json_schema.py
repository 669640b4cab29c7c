"""The JSON answer of each question: of a command, or of one of its uses that is a question of its own.

Shapes are read off the results that are told. Written by hand is what commands add to a result.
"""

from __future__ import annotations

from functools import cache

from geartrain.report.json_shapes import Schema, shape_of
from geartrain.wings import WINGS, has_wing, wing

FLAG = shape_of(bool)


def _list(item: Schema) -> Schema:
    """A list of one kind of thing."""
    return {"type": "array", "items": item}


def _has(keys: Schema) -> Schema:
    """An object with all of these keys; a later version may add others."""
    return {"type": "object", "required": list(keys), "properties": keys}


OBJECT: Schema = {"type": "object"}

# ----------------------------------------------------------------------------------------------------------- questions


@cache
def answers() -> dict[str, Schema]:
    """By question, the schema of its answer."""
    found = {**_of_trains(), **_of_spheres(), **_of_pairs()}
    for name in filter(has_wing, WINGS):
        found |= {question: shape_of(kind) for question, kind in wing(f"{name}.answers").answers().items()}
    return found


def _of_trains() -> dict[str, Schema]:
    from geartrain.analysis.gear_series import GearSearch
    from geartrain.analysis.gearbox import Gearbox
    from geartrain.numerics.labelled_array import LabelledArray
    from geartrain.report.accuracy_report import AccuracyReport
    from geartrain.report.formula_report import FormulaReport
    from geartrain.report.gear_pairs import DrivenPair
    from geartrain.report.motion_figures import MotionFigures
    from geartrain.report.torque_figures import TorqueReport
    from geartrain.report.train_data import TrainAnswers, TrainReport

    report = shape_of(TrainReport)
    report = report | {"properties": report["properties"] | {"teeth": _list(_of_any_form(DrivenPair))}}
    edges = {"nodes": _list(OBJECT), "edges": _list(OBJECT)}
    return {
        "solve": shape_of(TrainAnswers),
        "report": _list(report),
        "compare": _list(report),
        "formula": shape_of(FormulaReport),
        "gearbox": shape_of(Gearbox),
        "gearbox --search": shape_of(GearSearch),
        "torques": shape_of(TorqueReport),
        "motion": shape_of(MotionFigures),
        "bench": shape_of(AccuracyReport),
        "graph --as matrix": shape_of(LabelledArray),
        "graph --as json": _has({"directed": FLAG, "multigraph": FLAG, "graph": OBJECT, **edges}),
    }


def _of_spheres() -> dict[str, Schema]:
    from geartrain.spherical.gear_sphere import GearSphere
    from geartrain.spherical.polyhedron_gears import SurveyRow
    from geartrain.spherical.tooth_count_search import ToothCountSuggestions

    return {
        "sphere": shape_of(GearSphere),
        "sphere --suggest": shape_of(ToothCountSuggestions),
        "sphere --survey": shape_of(list[SurveyRow]),
    }


def _of_any_form(kind: type) -> Schema:
    """A result on a pair with teeth of any form, with the figures of that form."""
    from geartrain.teeth.any_tooth_form import tooth_forms

    pair = shape_of(kind)
    found = []
    for figures in dict.fromkeys(form.figures() for form in tooth_forms().values()):
        own = shape_of(figures)
        required = dict.fromkeys([*pair["required"], *own["required"]])
        found.append(pair | {"properties": pair["properties"] | own["properties"], "required": list(required)})
    return {"anyOf": found}


def _of_pairs() -> dict[str, Schema]:
    from geartrain.report.pair_page import FormedPair, TriangularPair
    from geartrain.teeth.conjugate.conjugate_mesh import PairDesign
    from geartrain.teeth.form_comparison import FormComparison
    from geartrain.teeth.pair_results import PinFigures

    return {
        "mesh triangular": shape_of(TriangularPair),
        "mesh triangular --vary": shape_of(list[dict[str, float | str | None]]),
        "mesh pin": shape_of(PinFigures),
        "mesh FORM": {"anyOf": [shape_of(PairDesign), *_of_any_form(FormedPair)["anyOf"]]},
        "mesh compare": shape_of(FormComparison),
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
