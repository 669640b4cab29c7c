"""How much a reconstruction asks: what survives, in how many ways it may be read, and what may be added."""

from __future__ import annotations

from dataclasses import dataclass
from math import prod

from geartrain.errors import Problem
from geartrain.numerics.plain_data import Result
from geartrain.synthesis.reconstruction.reconstruction_problem import ReconstructionProblem

_MOST_DOUBTS = 3


@dataclass(frozen=True, slots=True)
class AskedQuestion(Result):
    """What is asked.

    Attributes
    ----------
    arbors : int
        Surviving ones, the input included.
    wheels : int
        Surviving ones.
    readings : int
        Combinations of counts in doubt; 1 where all are sure.
    dials : int
        Pointers whose speed is known.
    added : int
        The most wheels that may be added.
    teeth : tuple of int
        The least and the greatest count that an added wheel may have.
    """

    arbors: int
    wheels: int
    readings: int
    dials: int
    added: int
    teeth: tuple[int, int]

    @classmethod
    def of(cls, problem: ReconstructionProblem) -> AskedQuestion:
        """What a question asks."""
        arbors, limits = (problem.input, *problem.arbors), problem.additions
        counts = [len(wheel.counts) for arbor in arbors for wheel in arbor.wheels]
        teeth = (limits.least, limits.greatest)
        return cls(len(arbors), len(counts), prod(counts), len(problem.dials), limits.wheels, teeth)

    def __str__(self) -> str:
        read = f", their counts in {self.readings} ways" if self.readings > 1 else ""
        wheels = f"{_many(self.arbors, 'arbor')} with {_many(self.wheels, 'wheel')}{read}"
        least, greatest = self.teeth
        added = f"at most {_many(self.added, 'added wheel')} of {least} to {greatest} teeth"
        return f"{wheels}; {_many(self.dials, 'dial')}; {added if self.added else 'nothing added'}"


def too_wide(problem: ReconstructionProblem, what: str) -> Problem:
    """What to say of a question that is too wide: how much it asks, and how to ask for less."""
    wheels = [wheel for arbor in (problem.input, *problem.arbors) for wheel in arbor.wheels if not wheel.is_sure]
    widest = sorted(wheels, key=lambda wheel: -len(wheel.counts))[:_MOST_DOUBTS]
    doubts = ", ".join(f"{wheel.name} has {len(wheel.counts)}" for wheel in widest)
    ways = [f"narrow counts in doubt ({doubts})"] if doubts else []
    if problem.additions.wheels:
        ways.insert(0, f"add fewer wheels (`-k {problem.additions.wheels - 1}`)")
    ways.append("leave out arbors, or dials with the arbors that lead to them alone")
    return Problem(what, f"asked are {AskedQuestion.of(problem)}", "; or ".join(ways))


def _many(count: int, noun: str) -> str:
    return f"{count} {noun}{'' if count == 1 else 's'}"
