"""The JSON answer of each question: of a command, or of one of its uses that is a question of its own.

Shapes are read off the results that are told. Written by hand are those of pages on one pair of teeth, whose figures
no result holds together, and what commands add to a result.
"""

from __future__ import annotations

from functools import cache

from geartrain.report.json_shapes import Schema, shape_of

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

EFFICIENCY = _maybe(_has({"friction": NUMBER}, {"mean": SOME, "at_constant_load": SOME, "min": SOME, "locks_at": SOME}))
RATIO = _maybe(_has({"mean": NUMBER, "exact": TEXT, "min": NUMBER, "max": NUMBER}))
ERROR = _maybe(_has({"peak_to_peak": NUMBER, "rms": NUMBER, "mean": NUMBER}))
MESH = {
    "teeth": _list(COUNT, 2),
    "verdict": _has({"kind": TEXT, "text": TEXT, "why": TEXT, "fix": TEXT}),
    "clearance": NUMBER,
    "window": _maybe(
        _has({"jam": NUMBER, "jam_kind": TEXT, "run": NUMBER, "run_kind": TEXT, "reach": NUMBER, "works": FLAG})
    ),
    "sizes": _has(
        {
            "radii": _list(NUMBER, 2),
            "half_angles": _list(NUMBER, 2),
            "depths": _list(NUMBER, 2),
            "centre_distance": NUMBER,
            "reach": NUMBER,
            "matching": SOME,
        }
    ),
    "play": SOME,
    "speed_ratio": RATIO,
    "transmission_error": ERROR,
    "efficiency": EFFICIENCY,
    "intervals": _list(_has({"phase": TEXT, "start": NUMBER, "end": NUMBER})),
    "jumps": _list(_has({"kind": TEXT, "alpha1": NUMBER, "before": NUMBER, "after": NUMBER, "value": NUMBER})),
    "impacts": _maybe(
        _has(
            {
                "inertia": NUMBER,
                "rate": SOME,
                "handed": SOME,
                "dissipated": SOME,
                "work": SOME,
                "load_to_stay_in_contact": SOME,
                "void_above": SOME,
            }
        )
    ),
}
_LINE = _has({"order": NUMBER, "exact": TEXT, "expected": NUMBER, "measured": NUMBER, "pairs": _list(OBJECT)})
_PAIR = {
    "pair": TEXT,
    "driver": TEXT,
    "driver_is": TEXT,
    "determined": FLAG,
    "states": TEXTS,
    "form": TEXT,
}
_FORMED = {
    "teeth": _list(COUNT, 2),
    "gears": _list(TEXT, 2),
    "note": TEXT,
    "verdict": _has({"kind": TEXT, "text": TEXT, "why": TEXT, "fix": TEXT, "play": SOME, "faults": _list(OBJECT)}),
    "play": SOME,
    "speed_ratio": RATIO,
    "transmission_error": ERROR,
    "efficiency": EFFICIENCY,
}
_PATH = {"arcs": _maybe(_list(NUMBER)), "contact_ratio": SOME, "pressure_angle": SOME, "shaft_angle": SOME}

PIN = _has(
    {
        "pin_radius": NUMBER,
        "offset": NUMBER,
        "speed_ratio": RATIO,
        "amplitude": SOME,
        "transmission_error": ERROR,
        "efficiency": EFFICIENCY,
    }
)
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

PINS = _has({"coupling": TEXT, "ratio": TEXT, "amplitude": NUMBER, "speed_ratio": _has({"min": NUMBER, "max": NUMBER})})


# ----------------------------------------------------------------------------------------------------------- questions


@cache
def answers() -> dict[str, Schema]:
    """By question, the schema of its answer."""
    return {**_of_trains(), **_of_doubt(), **_of_spheres(), **_of_tooth_numbers(), **_of_pairs()}


def _of_trains() -> dict[str, Schema]:
    from geartrain.numerics.labelled_array import LabelledArray
    from geartrain.report.accuracy_report import AccuracyReport
    from geartrain.report.motion_report import MotionFigures
    from geartrain.report.power_report import TorqueReport
    from geartrain.report.train_data import TrainAnswers, TrainReport

    report = shape_of(TrainReport)
    teeth = {"anyOf": [_has(_PAIR | MESH), _has(_PAIR | _FORMED, _PATH)]}
    report = report | {"properties": report["properties"] | {"teeth": _list(teeth), "pins": _list(PINS)}}
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


def _of_pairs() -> dict[str, Schema]:
    return {
        "mesh triangular": _has(MESH),
        "mesh triangular --vary": shape_of(list[dict[str, float | str | None]]),
        "mesh pin": PIN,
        "mesh FORM": SHAPE,
        "mesh compare": COMPARED,
    }


def answer_schema() -> Schema:
    """One JSON Schema; `#/$defs/QUESTION` is that of one question's answer."""
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Answers of geartrain",
        "description": "What each command prints with --json; keys may be added, and none is left out.",
        "$defs": answers(),
    }
