"""Every way to the motion of whole trains with real teeth and pins: error and time, as ratios to direct composition.

Direct asks every law itself, in the solved order. Its alternatives: tables of the laws, sums over pairs to first order,
two estimates without any position, and marching in time as a general multibody program does. The direct composition
itself is judged by the laws' definitions in 40 digits.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from geartrain.bench.chains import TEETH, grown
from geartrain.bench.methods import Case, Effort
from geartrain.bench.motion_records import MotionRecord, MotionRecords

Advance = Callable[[str], None]
_DIALS = ("sun", "moon", "synodic month", "lunar year", "four years")
_POINTERS = ("moon", "mercury", "venus", "mars", "jupiter", "saturn")
_PAIRS = (10, 100, 1_000, 10_000)
_FEW_PAIRS = (10, 30)
_QUICKEST = 20_000  # most positions of a quick run


def motion(quick: bool = False, positions: int = 1_000_000, advance: Advance = lambda _: None) -> MotionRecords:
    """Measure all methods on all trains (`quick`: two trains, few positions); `advance` hears of every step."""
    rows: list[MotionRecord] = []
    trains, growth = [], []
    for case in _cases(quick, positions):
        for name, step in case.steps():
            advance(f"{case.name}: {name}")
            step()
        rows += case.rows()
        trains.append(case.summary())
    for pairs in _chains(quick):
        advance(f"chain of {pairs} pairs")
        growth.append(grown(pairs, 1 if quick else 5))
    return MotionRecords("Motion of whole trains: error against run time", rows, trains, growth)


def count_motion_steps(quick: bool = False) -> int:
    """How many steps `motion` will tell of."""
    return sum(len(list(case.steps())) for case in _cases(quick, 2)) + len(_chains(quick))


def _cases(quick: bool, positions: int) -> list[Case]:
    if quick:
        effort = Effort(min(positions, _QUICKEST), rounds=1, marched=5, sample=3)
    else:
        effort = Effort(positions, rounds=5, marched=max(10, positions // 200), sample=100)
    cases = [
        Case("moon-triangular", "moon-triangular", ("moon",), 95.0, effort),
        Case("price-1974, triangular teeth", _toothed("price-1974"), _DIALS, 19.0, effort),
        Case("freeth-2021, pins", "freeth-2021", _POINTERS, 19.0, effort),
        Case("freeth-2021, pins and triangular teeth", _toothed("freeth-2021"), _POINTERS, 19.0, effort),
    ]
    return cases[:2] if quick else cases


def _toothed(name: str) -> str:
    """A shipped train with triangular teeth in the middle of each pair's window."""
    form = ", ".join(f"{key}: {value}" for key, value in TEETH.items())
    return f"extends: {name}\nname: {name}-triangular\ntooth_form: {{{form}}}\n"


def _chains(quick: bool) -> Sequence[int]:
    return _FEW_PAIRS if quick else _PAIRS
