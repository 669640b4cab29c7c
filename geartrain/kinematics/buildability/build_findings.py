"""Findings of buildability checks: the violated rule, its severity, and the problem."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

from geartrain.errors import Problem
from geartrain.numerics.results import Key, Result

BuildLevel = Literal["error", "note"]
"""Severity of a finding: `error` if the train cannot be built, `note` if it can be built but is inadvisable, or if the
declaration does not determine whether the rule is violated.
"""


@dataclass(frozen=True, slots=True)
class BuildFinding(Result):
    """Violation of one buildability rule by a train: the rule, its severity and a description of the problem.

    `geartrain check`, reports, drawings and exports print the text of the problem.

    Examples
    --------
    >>> from geartrain.errors import Problem
    >>> problem = Problem("ring 16 is too small for planet 20", "a < 0", "swap them", "t.yaml:7")
    >>> found = BuildFinding("R1", "error", problem)
    >>> print(found)
    t.yaml:7: ring 16 is too small for planet 20; a < 0; swap them [R1]
    >>> found.is_error
    True
    """

    KEYS = (
        *("rule", "level", Key("place", "problem.place"), Key("what", "problem.what")),
        *(Key("why", "problem.why"), Key("fix", "problem.fix")),
    )

    rule: str
    """Identifier of the rule in docs/buildability.md, such as `M1` or `P2`."""
    level: BuildLevel
    """Severity. `error`: the train cannot be built as declared. `note`: it can be built but is inadvisable, or the
    declaration does not determine whether the rule is violated.
    """
    problem: Problem
    """Description of the problem: location, problem, reason and fix."""

    def _summary(self) -> str:
        return f"{self.level} {self.rule}: {self.problem.what}"

    @property
    def is_error(self) -> bool:
        """True if the level is `error`, so that the train cannot be built as declared."""
        return self.level == "error"

    @property
    def text(self) -> str:
        """Problem, reason and fix on one line, without the location."""
        return f"{self.problem.text} [{self.rule}]"

    def __str__(self) -> str:
        return f"{self.problem.place}: {self.text}" if self.problem.place else self.text


def build_errors(findings: Iterable[BuildFinding]) -> tuple[BuildFinding, ...]:
    """Return the findings whose level is `error`."""
    return tuple(found for found in findings if found.is_error)
