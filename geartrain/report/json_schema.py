"""The shapes of JSON answers as JSON Schema (draft 2020-12): one shape for each question, whatever the train."""

from __future__ import annotations

from typing import Any

Schema = dict[str, Any]


def _of(kind: str) -> Schema:
    return {"type": kind}


TEXT, NUMBER, COUNT, FLAG, NULL = map(_of, ("string", "number", "integer", "boolean", "null"))


def _list(item: Schema, length: int | None = None) -> Schema:
    """A list of one kind of thing, of a length if it has one."""
    fixed = {} if length is None else {"minItems": length, "maxItems": length}
    return {"type": "array", "items": item, **fixed}


def _named(item: Schema) -> Schema:
    """Things of one kind by names that are the user's."""
    return {"type": "object", "additionalProperties": item}


def _or(*kinds: Schema) -> Schema:
    return {"anyOf": list(kinds)}


def _maybe(kind: Schema) -> Schema:
    return _or(kind, NULL)


def _has(keys: Schema, optional: Schema | None = None) -> Schema:
    """An object with all of these keys. `optional` ones are told of in docs/json.md; a later version may add others."""
    return {"type": "object", "required": list(keys), "properties": keys | (optional or {})}


def _enum(*words: str) -> Schema:
    return {"enum": list(words)}


TEXTS, NUMBERS = _list(TEXT), _list(NUMBER)
EXACT, SOME, WORDS = _maybe(TEXT), _maybe(NUMBER), _maybe(TEXT)

# ------------------------------------------------------------------------------------------------ speeds of one train

LOOP = _has({"carrier": TEXT, "links": TEXTS, "pairs": TEXTS, "product": TEXT})
VERDICT = _has(
    {
        "kind": _enum("determined", "free", "locked", "contradictory"),
        "text": TEXT,
        "links": TEXTS,
        "fixes": TEXTS,
        "prescriptions": TEXTS,
        "loops": _list(LOOP),
    }
)
SPEED_KEYS = {"exact": EXACT, "value": SOME}
SPEED = _has(SPEED_KEYS, {"decimal": TEXT, "estimate": SOME, "true_error": SOME})
TARGET = _has(
    {
        "target": TEXT,
        "speed": SOME,
        "compared": _enum("speed", "magnitude", "difference"),
        "ppm": SOME,
        "days_per_century": SOME,
        "degrees_per_unit": SOME,
        "met": _maybe(FLAG),
    }
)
PUBLISHED = _has(
    {
        "value": TEXT,
        "as": _enum("speed", "input/output", "output/input"),
        "place": WORDS,
        "found": _or(TEXT, NUMBER, NULL),
        "holds": FLAG,
    }
)
OUTPUT = _has(
    {
        **SPEED_KEYS,
        "of": TEXT,
        "relative_to": TEXT,
        "output/input": _or(TEXT, NUMBER, NULL),
        "expect": _maybe(_has({"value": TEXT, "holds": FLAG})),
        "published": _maybe(PUBLISHED),
        "targets": _list(TARGET),
    },
    {"decimal": TEXT},
)
ANSWER = _has(
    {
        "state": WORDS,
        "verdict": VERDICT,
        "method": _enum("exact", "floats"),
        "speeds": _named(SPEED),
        "outputs": _named(OUTPUT),
    }
)
MOBILITY = _has(
    {
        "by_count": COUNT,
        "by_rank": COUNT,
        "rank": COUNT,
        "redundant": COUNT,
        "redundant_loops": _list(LOOP),
        "locked_loops": _list(LOOP),
        "still": TEXTS,
        "never_rolling": TEXTS,
    }
)
TRAIN = {"name": TEXT, "title": TEXT, "unit": TEXT, "mobility": _maybe(MOBILITY), "states": _list(ANSWER)}

# ------------------------------------------------------------------------------------------------------------- torques

_TORQUE_KINDS = (
    *("determined", "incomplete", "self-locking", "ambiguous", "indeterminate", "contradictory"),
    *("unbalanced", "stalled", "undecided", "unloaded", "still"),
)
TORQUE_VERDICT = _has({"kind": _enum(*_TORQUE_KINDS), "text": TEXT, "candidates": TEXTS})
LEFT_OUT = _list(_has({"what": TEXT, "where": TEXTS, "why": TEXT}))
HELD = _has({"links": TEXTS, "clutch": WORDS, "cause": _maybe(TEXTS), "torques": _maybe(_named(SOME))})
DRIVE = _maybe(_has({"verdict": TORQUE_VERDICT, "efficiency": SOME, "exact": EXACT, "left_out": LEFT_OUT}))
END = _has({"kind": _enum("in", "shaft", "pair", "bearing", "out"), "name": TEXT})
TORQUES = _has(
    {
        "state": WORDS,
        "verdict": TORQUE_VERDICT,
        "efficiency": SOME,
        "circulating": SOME,
        "links": _named(_has({"torque": SOME, "power": SOME, "asked": FLAG})),
        "pairs": _named(
            _has(
                {
                    "driver": TEXT,
                    "torques": _has({"first": SOME, "second": SOME, "carrier": SOME}),
                    "power": SOME,
                    "loss": SOME,
                    "shared": FLAG,
                }
            )
        ),
        "held": _list(HELD),
        "left_out": LEFT_OUT,
        "power_in": SOME,
        "loss": SOME,
        "drives": _maybe(_has({"forward": DRIVE, "backward": DRIVE})),
        "watts_per_unit": SOME,
        "losses": _list(_has({"kind": TEXT, "name": TEXT, "power": SOME, "of_power_in": SOME, "of_loss": SOME})),
        "flow": _has(
            {
                "streams": _list(_has({"from": END, "to": END, "power": SOME, "circling": SOME})),
                "loops": _list(_has({"pairs": TEXTS, "shafts": TEXTS, "power": SOME, "of_power_in": SOME})),
            }
        ),
    }
)

# -------------------------------------------------------------------------------------------------- real teeth, motion

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
_LINE = _has({"order": NUMBER, "exact": TEXT, "expected": NUMBER, "measured": NUMBER, "pairs": _list(_of("object"))})
MOTION = {
    "name": TEXT,
    "state": WORDS,
    "input": TEXT,
    "turns": NUMBER,
    "positions": COUNT,
    "period": EXACT,
    "drivers": _named(_has({"driver": TEXT, "driver_is": TEXT, "determined": FLAG})),
    "turned_back": TEXTS,
    "rigid": TEXTS,
    "outputs": _named(
        _has(
            {
                "transmission_error": _has({"peak_to_peak": NUMBER, "rms": NUMBER}),
                "speed": _has({"min": NUMBER, "max": NUMBER, "mean": NUMBER}),
                "ratio": TEXT,
                "setting": NUMBER,
                "sensitivity": _named(NUMBER),
                "phases": _maybe(_has({"peak_to_peak": _list(NUMBER, 2), "rms": _list(NUMBER, 2)})),
                "estimates": _maybe(
                    _has(dict.fromkeys(("bound", "independent", "superposed", "superposed_with_lag"), _of("object")))
                ),
                "spectrum": _maybe(_list(_LINE)),
            }
        )
    ),
    "phases": _maybe(_has({"sets": COUNT, "seed": COUNT})),
    "partial": _maybe(_has({"done": COUNT, "of": COUNT})),
}
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
    "verdict": _has(
        {"kind": TEXT, "text": TEXT, "why": TEXT, "fix": TEXT, "play": SOME, "faults": _list(_of("object"))}
    ),
    "play": SOME,
    "speed_ratio": RATIO,
    "transmission_error": ERROR,
    "efficiency": EFFICIENCY,
}
_PATH = {"arcs": _maybe(NUMBERS), "contact_ratio": SOME, "pressure_angle": SOME, "shaft_angle": SOME}

# ------------------------------------------------------------------------------------------------------------- reports

RELEASE = _has(
    {
        "meshes": TEXTS,
        "method": TEXT,
        "least": FLAG,
        "at_least": COUNT,
        "choices": _list(TEXT),
        "proofs": _list(_has({"sharing": COUNT, "loops": _list(LOOP)})),
    }
)
GRIDLOCK = _has(
    {
        "moves": FLAG,
        "jams": _list(
            _has({"carrier": TEXT, "loop": LOOP, "links": TEXTS, "meshes": COUNT, "by": TEXT, "release": RELEASE})
        ),
        "held": _list({}),
        "release": _maybe(RELEASE),
    }
)
CLOSURE = _maybe(_has({"verdict": TEXT, "text": TEXT, "loops": _list(_of("object")), "angles": _named(NUMBER)}))
_ENTRY = {"place": TEXT, "why": TEXT}
REPORT = _has(
    TRAIN
    | {
        "mobility": MOBILITY,
        "gridlock": GRIDLOCK,
        "closure": CLOSURE,
        "sources": _named(TEXT),
        "circuits": _list(
            _has(
                {
                    **dict.fromkeys(("id", "kind", "i", "j", "carrier", "ratio", "note"), TEXT),
                    "wheels": TEXTS,
                }
            )
        ),
        "adjacency": _maybe(_has({"links": TEXTS, "cells": _list(TEXTS)})),
        "remarks": _list(_has(_ENTRY | {"what": TEXT})),
        "sensitivity": _list(
            _has(
                {
                    "state": WORDS,
                    "wheel": TEXT,
                    "teeth": COUNT,
                    "output": TEXT,
                    "one_fewer_ppm": SOME,
                    "one_more_ppm": SOME,
                }
            )
        ),
        "teeth": _list(_or(_has(_PAIR | MESH), _has(_PAIR | _FORMED, _PATH))),
        "pins": _list(
            _has(
                {
                    "coupling": TEXT,
                    "ratio": TEXT,
                    "amplitude": NUMBER,
                    "speed_ratio": _has({"min": NUMBER, "max": NUMBER}),
                }
            )
        ),
        "torques": _list(TORQUES),
        "motion": _list(_or(_has(MOTION), _has({"name": TEXT, "state": WORDS, "error": TEXT}))),
        "errata": _list(_has(_ENTRY | {"printed": TEXT, "right": TEXT})),
    }
)

# -------------------------------------------------------------------------------------------------------------- search

WANTED = _has({"label": TEXT, "ratio": TEXT, "value": SOME, "sense": _or(COUNT, NULL), "note": TEXT})
SHORTFALL = _has({"considered": COUNT, "removed": _named(COUNT), "nearest": TEXT, "advice": TEXT})
ENDED = _enum("whole", "interrupted")
STAGES = _has(
    {
        "teeth": _list(_list(COUNT), 2),
        "ratio": TEXT,
        "value": SOME,
        "error": SOME,
        "exact_error": TEXT,
        "stages": _list(_list(COUNT, 2)),
        "total": COUNT,
        "largest": COUNT,
        "distinct": COUNT,
    }
)
OF_RATIO = _has(
    {
        "wanted": WANTED,
        "stages": COUNT,
        "top": TEXT,
        "beneath": TEXT,
        "fit": _of("object"),
        "order": TEXT,
        "tolerance": SOME,
        "complete": FLAG,
        "count": _or(COUNT, NULL),
        "considered": COUNT,
        "solutions": _list(STAGES),
        "shortfall": SHORTFALL,
        "note": TEXT,
        "ended": ENDED,
    }
)
FRACTIONS = _has(
    {
        "wanted": WANTED,
        "most": COUNT,
        "solutions": _list(_has({"value": TEXT, "kind": TEXT, "error": SOME, "exact_error": TEXT})),
    }
)
ASSIGNMENT = _has(
    {
        "teeth": _named(COUNT),
        "outputs": _named(_of("object")),
        "error": SOME,
        "total": COUNT,
        "largest": COUNT,
        "distinct": COUNT,
        "changed": TEXTS,
    }
)
_FOUND = {"complete": FLAG, "ranked": FLAG, "considered": COUNT, "count": COUNT, "solutions": _list(ASSIGNMENT)}
_PART = _has(
    _FOUND
    | {
        "wheels": TEXTS,
        "outputs": TEXTS,
        "demands": TEXTS,
        "rules": TEXTS,
        "reason": TEXT,
        "tolerance": SOME,
        "shortfall": SHORTFALL,
    }
)
OF_TRAIN = _has(
    _FOUND
    | {
        "train": TEXT,
        "by": TEXT,
        "remarks": TEXTS,
        "parts": _list(_PART),
        "where": _list(_of("object")),
        "ended": ENDED,
    }
)
OF_ORRERY = _has(
    {
        "wheels": COUNT,
        "pairs": _list(_has({"driver": COUNT, "driven": COUNT, "parent": TEXT, "child": TEXT})),
        "arbors": _list(
            _has({"name": TEXT, "period": TEXT, "value": SOME, "sense": COUNT, "wheels": _list(COUNT), "shows": FLAG})
        ),
        "errors": _named(_has({"value": SOME, "exact": TEXT})),
        "least_pairs": COUNT,
        "least_wheels": COUNT,
        "complete": FLAG,
        "ended": TEXT,
    }
)
KINDS = _named(_has({"title": TEXT, "wheels": TEXTS, "modes": TEXTS}))
OF_SET = _has({"solutions": _list(_has({"mode": {}, "teeth": _named(COUNT)}))})

# --------------------------------------------------------------------------------------------------------------- doubt

SHARE = _has({"value": SOME, "exact": EXACT, "low": SOME, "high": SOME})
SWEEP = _has(
    {
        "train": TEXT,
        "method": _enum("exact", "sample"),
        "soft": FLAG,
        "combinations": COUNT,
        "looked": COUNT,
        "evidence": SHARE,
        "turning": SHARE,
        "fits": _or(COUNT, NULL),
        "ranked": FLAG,
        "seed": _or(COUNT, NULL),
        "ended": ENDED,
        "assumed": TEXTS,
        "remarks": TEXTS,
        "witnesses": _list(_has({"output": TEXT, "claims": TEXTS, "formula": TEXT, "alone": SHARE})),
        "wheels": _named(
            _has(
                {
                    "wheel": TEXT,
                    "declared": _or(COUNT, NULL),
                    "counts": _list(COUNT),
                    "priors": _list(TEXT),
                    "posterior": _list(SHARE),
                    "likeliest": _or(COUNT, NULL),
                    "bits": SOME,
                    "idle": FLAG,
                }
            )
        ),
        "correlations": _list(_list(_or(TEXT, NUMBER))),
        "shares": _named(_of("object")),
        "best": _list(
            _has({"teeth": _named(COUNT), "outputs": _named(_of("object")), "misfit": SOME, "chance": _maybe(SHARE)})
        ),
    }
)
CHANCE = _has({"count": COUNT, "of": COUNT, "share": SOME, "interval": _list(SOME, 2)})
EVENTS = dict.fromkeys(("jam", "clash", "stops", "standstill", "disengaged"), CHANCE)
PAIR_CUT = _has({"pair": TEXT, "uncut": COUNT, "play": SOME, "bound": SOME, **EVENTS})
_AMOUNT = _list(SOME, 3)
ERRORS = _has(
    {
        "train": TEXT,
        "seed": COUNT,
        "trials": COUNT,
        "block": COUNT,
        "confidence": NUMBER,
        "assumptions": TEXTS,
        "errors": _has({"wheels": _named(_of("object")), "pairs": _named(_of("object"))}),
        "any_pair": PAIR_CUT,
        "pairs": _list(PAIR_CUT),
        "outputs": _list(
            _has(
                {
                    "output": TEXT,
                    "trials": COUNT,
                    "stopped": COUNT,
                    "of_all": FLAG,
                    "mean_deg": _AMOUNT,
                    "deviation_deg": _AMOUNT,
                    "percentiles_deg": _named(_AMOUNT),
                    "greatest_deg": SOME,
                    "deviation_of_all_deg": _AMOUNT,
                    "first_order": _of("object"),
                    "variance_shares": _named(SOME),
                }
            )
        ),
        "convergence": _has({"jam": _list(_of("object")), "stops": _list(_of("object"))}),
        "partial": _maybe(_has({"done": COUNT, "of": COUNT})),
        "clearances": _list(_has({"clearance": SOME, "scale": SOME})),
        "courses": _list(_has({"output": TEXT, "trials": COUNT, "turns": NUMBERS})),
        "indices": _list(_has({"output": TEXT, "by": _enum("wheel", "kind"), "trials": COUNT, "indices": _list({})})),
        "tolerance": _maybe(_has({"kind": TEXT, "event": TEXT, "chance": NUMBER, "scale": SOME})),
    }
)

# ------------------------------------------------------------------------------------------------------------- spheres

SPHERE = _has(
    {
        "title": TEXT,
        "gears": COUNT,
        "meshes": COUNT,
        "kinds": _named(COUNT),
        "teeth": _named(COUNT),
        "mobility": COUNT,
        "gridlock": _maybe(GRIDLOCK),
        "rule": WORDS,
        "closes": _maybe(FLAG),
        "residue": SOME,
        "loop_residue": SOME,
        "closure": CLOSURE,
        "sphere_radius": NUMBER,
        "radii": _named(SOME),
        "cones": _named(SOME),
        "angles": _named(NUMBER),
        "graph": _maybe(_has({"aim": TEXT, "exact": TEXTS, "axes_moved": SOME, "pitch_spread": SOME, "residue": SOME})),
        "sizing": _maybe(
            _has(
                {
                    "teeth": _named(COUNT),
                    "module": NUMBER,
                    "exact": FLAG,
                    "mismatch": NUMBER,
                    "meshes": _list(
                        _has({"gears": TEXTS, "cones": NUMBERS, "pitch": NUMBER, "pressure_angle": NUMBER})
                    ),
                    "collisions": _list({}),
                    "undercut": _named(NUMBER),
                }
            )
        ),
    }
)
SUGGESTED = _has(
    {
        "considered": COUNT,
        "removed": _named(COUNT),
        "meshes": _list(_has({"kinds": TEXTS, "angle": NUMBER})),
        "solutions": _list(
            _has(
                {
                    "teeth": _named(COUNT),
                    "mismatch": NUMBER,
                    "cones": _list(NUMBERS),
                    "pressure_angles": NUMBERS,
                    "room": NUMBER,
                    "residue": SOME,
                }
            )
        ),
    }
)

# ------------------------------------------------------------------------------------------------------ a pair of teeth

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
        "verdict": _has({"kind": TEXT, "text": TEXT, "play": SOME, "faults": _list(_of("object"))}),
        "pitch_radii": _list(NUMBER, 2),
        "arcs": _list(NUMBER, 2),
        "contact_ratio": SOME,
        "pressure_angles": _list(SOME),
        "costs": _maybe(_of("object")),
        "efficiency": EFFICIENCY,
        "outlines": _list(_of("object")),
    }
)
COMPARED = _has(
    {
        "teeth": _list(COUNT, 2),
        "matched": TEXT,
        "base": _has({"form": TEXT}),
        "forms": _list(
            _has({"form": TEXT, "runs": FLAG, "ratios": _maybe(_of("object")), "faults": _list(_of("object"))})
        ),
    }
)

METHOD = _has(
    {
        "stage": _enum("speeds", "transmission functions", "motion", "torques"),
        "method": TEXT,
        "seconds": NUMBER,
        "error": SOME,
        "unit": _enum("relative", "pitches", "deg"),
        "reference": TEXT,
        "prepared": SOME,
        "ratio": NUMBER,
    }
)
ACCURACY = _has({"state": WORDS, "positions": COUNT, "methods": _list(METHOD), "left_out": _named(TEXT)})

ANSWERS: dict[str, Schema] = {
    "solve": _has(TRAIN),
    "report": _list(REPORT),
    "compare": _list(REPORT),
    "torques": _has({"name": TEXT, "title": TEXT, "states": _list(TORQUES)}),
    "motion": _has(MOTION),
    "montecarlo": ERRORS,
    "posterior": SWEEP,
    "bench": _has({"name": TEXT, "title": TEXT, "states": _list(ACCURACY)}),
    "sphere": SPHERE,
    "sphere --suggest": SUGGESTED,
    "sphere --survey": _list(_of("object")),
    "teeth ratio": OF_RATIO,
    "teeth approximants": FRACTIONS,
    "teeth set": OF_SET,
    "teeth set --kind list": KINDS,
    "teeth train": OF_TRAIN,
    "teeth orrery": OF_ORRERY,
    "mesh triangular": _has(MESH),
    "mesh triangular --vary": _list(_named(_or(NUMBER, TEXT, NULL))),
    "mesh pin": PIN,
    "mesh FORM": SHAPE,
    "mesh compare": COMPARED,
}
"""By question: the JSON of a command, or of one of its uses that is a question of its own."""


def answer_schema() -> Schema:
    """One JSON Schema; `#/$defs/QUESTION` is that of one question's answer."""
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Answers of geartrain",
        "description": "What each command prints with --json; keys may be added, and none is left out.",
        "$defs": ANSWERS,
    }
