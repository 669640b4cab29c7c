"""A mark by which two runs know that they were asked the same."""

from __future__ import annotations

import hashlib
import json
from dataclasses import fields, is_dataclass
from fractions import Fraction

from geartrain.synthesis.reconstruction.reconstruction_problem import ReconstructionProblem


def question_digest(problem: ReconstructionProblem) -> str:
    """SHA-256 of a question: its evidence, bounds and rules, the same whatever the order of facts without one."""
    return hashlib.sha256(json.dumps(_plain(problem), sort_keys=True).encode("utf-8")).hexdigest()


def _plain(value: object) -> object:
    if is_dataclass(value):
        return {each.name: _plain(getattr(value, each.name)) for each in fields(value)}
    if isinstance(value, frozenset):
        return sorted((_plain(each) for each in value), key=json.dumps)
    if isinstance(value, tuple):
        return [_plain(each) for each in value]
    return str(value) if isinstance(value, Fraction) else value
