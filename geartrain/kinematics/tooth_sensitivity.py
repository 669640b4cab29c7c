"""What one tooth more or fewer on an uncertain wheel does to the outputs of a train."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from geartrain.kinematics.circuits import Circuit
from geartrain.kinematics.judged_outputs import OutputResult, Relative, as_plain_product
from geartrain.numerics.results import Key, Result
from geartrain.train import Train


@dataclass(frozen=True, slots=True)
class Sensitivity(Result):
    """What one tooth fewer and one tooth more on an uncertain wheel do to an output, solved again exactly.

    Attributes
    ----------
    wheel : str
        The wheel whose count is in doubt.
    teeth : int
        The count used.
    allowed : tuple of int
        All counts that the evidence allows.
    output : str
        Name of the output.
    less, more : float or None
        Change of its speed with one tooth fewer, and with one more [ppm]; None for a train that no longer turns, or an
        output that stands still.

    Examples
    --------
    With 63 teeth in place of 64 the Moon is slower by 1/64:

    >>> import geartrain
    >>> train = geartrain.load("freeth-2008-doubt")
    >>> found = next(train.kinematics.sensitivity(train.solve()))
    >>> found.wheel, found.output, found.less, found.less == -1e6 / found.teeth
    ('b2', 'moon', -15625.0, True)
    """

    KEYS = ("wheel", "teeth", "output", Key("one_fewer_ppm", "less"), Key("one_more_ppm", "more"))

    wheel: str
    teeth: int
    allowed: tuple[int, ...]
    output: str
    less: float | None
    more: float | None


def sensitivity(
    train: Train,
    outputs: Sequence[OutputResult],
    solve_with: Callable[[Sequence[Circuit]], Relative],
    circuits: Sequence[Circuit],
) -> Iterator[Sensitivity]:
    """Solve again, exactly, with each uncertain wheel one tooth off.

    solve_with   circuits -> relative speeds, for changed circuits
    """
    for name, wheel in train.uncertain_wheels():
        teeth = wheel.count
        if teeth is None or not any(name in circuit.wheels for circuit in circuits):
            continue
        changed = {
            step: solve_with([circuit.with_counts({name: teeth + step}) for circuit in circuits])
            for step in (-1, 1)
            if teeth + step > 0
        }
        for result in outputs:
            shift = {step: _shift(result, relative) for step, relative in changed.items()}
            if any(value != 0 for value in shift.values()):
                allowed = wheel.doubt.allowed if wheel.doubt else ()
                yield Sensitivity(name, teeth, allowed, result.name, shift.get(-1), shift.get(1))


def _shift(result: OutputResult, relative: Relative) -> float | None:
    speed = relative(result.of, result.relative_to)
    if speed is None or result.speed is None:
        return None
    if speed == result.speed:
        return 0.0
    # in Fractions where the answer is exact: of floats so near to each other few digits would be left
    return as_plain_product(speed / result.speed - 1, 10**6) if result.speed else None
