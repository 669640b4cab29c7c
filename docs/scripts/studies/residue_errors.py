"""How well floats know a residue that exact fractions know: error against tooth numbers, and run time of both."""

from __future__ import annotations

import time
from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from geartrain.kinematics import Circuit
from geartrain.kinematics.components import find_components
from geartrain.kinematics.phasing.azimuths import EPS, PitchPoints, centred_residue, contact_families
from geartrain.kinematics.phasing.phase_system import PhaseSystem


@dataclass(frozen=True)
class PhaseAccuracy:
    """The loops of one planetary, by both methods.

    teeth             of the sun; the planets have half as many, the ring twice as many
    exact, floats     residue of the loop through the first two planets (pitches)
    error             the largest difference between both over all loops (pitches)
    bound             what the floats forecast for it (pitches)
    exact_s, floats_s run time of all residues (s)
    """

    teeth: int
    exact: Fraction
    floats: float
    error: float
    bound: float
    exact_s: float
    floats_s: float


def measure_phase_accuracy(counts: Iterable[int], planets: int = 7) -> list[PhaseAccuracy]:
    """Equal planets, equally spaced, about suns of some tooth numbers: residues by fractions and by floats."""
    return [_measure(teeth, planets) for teeth in counts]


def first_float_failure(planets: int = 7, off: float = 0.01) -> int | None:
    """The least power of ten of teeth on the sun at which floats are off by this much of a pitch; None up to 10^17."""
    return next((10**power for power in range(1, 18) if _measure(10**power, planets).error > off), None)


def _measure(sun: int, planets: int) -> PhaseAccuracy:
    results: list[list[Fraction | float]] = []
    seconds, bounds = [], [0.0]
    for exact in (True, False):
        problem = _planetary(sun, planets, exact)
        begin = time.perf_counter()
        found = problem.conditions
        seconds.append(time.perf_counter() - begin)
        results.append([one.residue for one in found])
        bounds += [one.slack for one in found]
    true, near = results
    apart = [abs(centred_residue(Fraction(b) - Fraction(a))) for a, b in zip(true, near, strict=True)]
    return PhaseAccuracy(sun, Fraction(true[0]), float(near[0]), float(max(apart)), max(bounds), seconds[0], seconds[1])


def _planetary(sun: int, planets: int, exact: bool) -> PhaseSystem:
    """Sun, ring of twice its teeth, and planets at parts of a turn; without families no angle is known exactly."""
    circuits, part, keys = [], [], []
    for at in range(planets):
        here, planet = Fraction(at, planets), f"planet {at}"
        circuits.append(Circuit(f"sun~{at}", "gear", "sun", planet, "carrier", sun, sun // 2, ("s", planet)))
        circuits.append(Circuit(f"{at}~ring", "gear", planet, "ring", "carrier", sun // 2, -2 * sun, (planet, "r")))
        part += [(here, (here + Fraction(1, 2)) % 1), (here, here)]
        keys += [("sun", planet), (planet, "ring")]
    links = ("frame", "carrier", "sun", "ring", *(f"planet {at}" for at in range(planets)))
    family, _ = contact_families(keys if exact else [((at, 0), (at, 1)) for at in range(len(keys))])
    azimuth = np.array([[float(p), float(q)] for p, q in part])
    slack = np.full(azimuth.shape, EPS)
    return PhaseSystem(
        find_components(links, "frame", circuits), PitchPoints(tuple(circuits), azimuth, slack, family, part)
    )
