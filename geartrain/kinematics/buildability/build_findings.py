"""What a check of a train as a thing to be made finds: the rule, how grave it is, and the problem in words."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

from geartrain.errors import Problem
from geartrain.numerics.results import Key, Result

BuildLevel = Literal["error", "note"]
"""An error cannot be built; a note can, and is unwise or open."""


@dataclass(frozen=True, slots=True)
class BuildFinding(Result):
    """One rule of building that a train does not keep.

    `check`, reports, pictures and exports all tell it in the words of its problem.

    Examples
    --------
    >>> from geartrain.errors import Problem
    >>> problem = Problem("ring 16 does not hold planet 20", "a < 0", "swap them", "t.yaml:7")
    >>> found = BuildFinding("R1", "error", problem)
    >>> print(found)
    t.yaml:7: ring 16 does not hold planet 20; a < 0; swap them [R1]
    >>> found.is_error
    True
    """

    KEYS = (
        *("rule", "level", Key("place", "problem.place"), Key("what", "problem.what")),
        *(Key("why", "problem.why"), Key("fix", "problem.fix")),
    )

    rule: str
    """Which rule, as docs/buildability.md lists them: `M1`, `P2`."""
    level: BuildLevel
    """An error cannot be built; a note can, and is unwise or open."""
    problem: Problem
    """Place, what, why, and what to do that cures it."""

    def _summary(self) -> str:
        return f"{self.level} {self.rule}: {self.problem.what}"

    @property
    def is_error(self) -> bool:
        """True for what cannot be built."""
        return self.level == "error"

    @property
    def text(self) -> str:
        """What, why and what to do on one line, without the place."""
        return f"{self.problem.text} [{self.rule}]"

    def __str__(self) -> str:
        return f"{self.problem.place}: {self.text}" if self.problem.place else self.text


def build_errors(findings: Iterable[BuildFinding]) -> tuple[BuildFinding, ...]:
    """Those that cannot be built."""
    return tuple(found for found in findings if found.is_error)
