"""The report as plain data, with stable keys (docs/json.md)."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from geartrain.analysis import GearTrain
from geartrain.answer import Answer
from geartrain.report.assembling import closure_data
from geartrain.report.moving import moving_data
from geartrain.report.power import loaded_data
from geartrain.report.teeth import teeth_data
from geartrain.speeds import Mobility


def mobility_data(found: Mobility) -> dict[str, Any]:
    """Mobility as plain data."""
    return {
        "by_count": found.by_count,
        "by_rank": found.by_rank,
        "rank": found.rank,
        "redundant": found.redundant,
        "redundant_loops": [loop.to_dict() for loop in found.loops],
        "locked_loops": [loop.to_dict() for loop in found.locked],
        "still": list(found.still),
        "never_rolling": list(found.idle),
    }


def answers_data(train: GearTrain, answers: Iterable[Answer], whole: bool = True) -> dict[str, Any]:
    """Name, unit, mobility, and `states`, a list of answers: one for each state that was asked for.

    A train without states has one answer, whose `state` is None. `whole` False has None for the mobility: it takes all
    circuits, where one output takes only those that drive it.
    """
    return {
        "name": train.name,
        "title": train.declaration.title,
        "unit": train.declaration.unit_name,
        "mobility": mobility_data(train.mobility) if whole else None,
        "states": [answer.to_dict() for answer in answers],
    }


def train_data(train: GearTrain) -> dict[str, Any]:
    """Everything a report holds: sources, circuits, adjacency, answers, sensitivities and errata."""
    from geartrain.graph import adjacency_labels

    declared = train.declaration
    answers = list(train.answers())
    data = answers_data(train, answers)
    data["gridlock"] = train.gridlock.to_dict()
    data["closure"] = closure_data(train)
    data["sources"] = {key: source.cite for key, source in declared.sources.items()}
    data["circuits"] = [
        {
            "id": c.id,
            "kind": c.kind,
            "i": c.i,
            "j": c.j,
            "carrier": c.carrier,
            "wheels": list(c.wheels),
            "ratio": str(c.ratio),
            "note": c.note,
        }
        for c in train.circuits
    ]
    small = len(declared.links) <= 500
    data["adjacency"] = {"links": list(train.graph), "cells": adjacency_labels(train.graph)} if small else None
    data["remarks"] = [{"place": r.place, "what": r.what, "why": r.why} for r in train.remarks]
    data["sensitivity"] = [
        {
            "state": answer.state,
            "wheel": s.wheel,
            "teeth": s.teeth,
            "output": s.output,
            "one_fewer_ppm": s.less,
            "one_more_ppm": s.more,
        }
        for answer in answers
        if answer.verdict
        for s in train.sensitivity(answer)
    ]
    data |= teeth_data(train)
    data["torques"] = loaded_data(train)
    data["motion"] = moving_data(train)
    data["errata"] = [erratum.model_dump() for erratum in declared.errata]
    return data
