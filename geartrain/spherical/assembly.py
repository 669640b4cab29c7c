"""Assembly conditions of gears on a sphere: phases of their meshes, and rules for their tooth numbers.

The set can be assembled if each loop of a cycle basis contains an integer number of teeth, equation (3) of
docs/closure.md.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import lcm, tau
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.kinematics.circuits import Circuit
from geartrain.kinematics.components import find_components
from geartrain.kinematics.phasing import DivisibilityRule, MeshPhasing
from geartrain.kinematics.phasing.azimuths import EPS, MOUNT, PitchPoints, contact_families
from geartrain.kinematics.phasing.phase_system import PhaseSystem
from geartrain.spherical.configuration import Configuration, kinds_in_order, require_tooth_numbers
from geartrain.spherical.pitch_cones import azimuths

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats

    Mask = NDArray[np.bool_]

_FRAME = MOUNT  # cannot be the name of a gear
_OFF = 1e-6  # tolerance (turns) of the positions of contacts declared as regular


def spherical_phasing(configuration: Configuration, teeth: Mapping[str, int] | None = None) -> MeshPhasing:
    """Check the assembly condition of gears whose axes pass through one point.

    Parameters
    ----------
    configuration : Configuration
        Set of gears.
    teeth : mapping of str to int, optional
        Tooth count of each kind of gear; by default the counts of the configuration.

    Returns
    -------
    MeshPhasing
        Phases of the teeth. Angles of links are measured from the first vector of `configuration.frame`.

    Raises
    ------
    QuestionError
        If a kind has no tooth count.

    Examples
    --------
    For gears on the faces of an icosidodecahedron, 3 must divide z3, and 5 must divide z5:

    >>> from geartrain.spherical import from_polyhedron, solid
    >>> gears = from_polyhedron(solid("icosidodecahedron"))
    >>> [bool(spherical_phasing(gears, {"5": five, "3": 6})) for five in (10, 12)]
    [True, False]
    """
    counts = {**configuration.teeth, **(teeth or {})}
    fix = "give `teeth` for every kind, or use `spherical_divisibility_rule`"
    require_tooth_numbers(kinds_in_order(configuration), counts, "phases depend on tooth numbers", fix)
    return _closure(configuration, [counts[kind] for kind in configuration.kinds])


def spherical_divisibility_rule(configuration: Configuration) -> DivisibilityRule | None:
    """Return the divisibility rule that tooth counts must satisfy for the assembly of gears whose axes pass
    through one point.

    Parameters
    ----------
    configuration : Configuration
        Set of gears; its tooth counts are not used.

    Returns
    -------
    DivisibilityRule or None
        Divisibility rule; None if the angles between contacts are not known rational fractions of a turn.

    Examples
    --------
    >>> from geartrain.spherical import from_polyhedron, solid
    >>> spherical_divisibility_rule(from_polyhedron(solid("icosidodecahedron"))).text
    '3 divides z3 and 5 divides z5'
    """
    return _closure(configuration, [1] * len(configuration.names)).rule


def _closure(configuration: Configuration, counts: Sequence[int]) -> MeshPhasing:
    names = configuration.names
    circuits = tuple(
        Circuit(
            f"{names[i]}~{names[j]}", "gear", names[i], names[j], _FRAME, counts[i], counts[j], (names[i], names[j])
        )
        for i, j in configuration.meshes
    )
    contacts = _contacts(configuration, circuits)
    parts = find_components((_FRAME, *names), _FRAME, circuits)
    return MeshPhasing(PhaseSystem(parts, contacts), {}, lambda: dict(zip(names, configuration.kinds, strict=True)))


def _contacts(configuration: Configuration, circuits: tuple[Circuit, ...]) -> PitchPoints:
    meshes = np.array(configuration.meshes, int).reshape(-1, 2)
    axes, (i, j) = configuration.axes, meshes.T
    azimuth = np.stack([azimuths(axes, i, j), azimuths(axes, j, i)], axis=1) / tau % 1.0
    sine = np.linalg.norm(np.cross(axes[i], axes[j]), axis=1)
    keys: list[tuple[object, object]] = []
    part: list[tuple[Fraction, Fraction]] = []
    first: dict[int, float] = {}
    for pair, turns in zip(meshes.tolist(), azimuth.tolist(), strict=True):
        found = []
        key: list[object] = []
        for gear, turn in zip(pair, turns, strict=True):
            parts = configuration.regular[gear]
            step = (turn - first.setdefault(gear, turn)) * parts
            if abs(step - round(step)) > _OFF * parts:
                what = f"'{configuration.names[gear]}' has contacts that are not multiples of 1/{parts} turn apart"
                why = f"it is declared with `regular` {parts}"
                raise QuestionError(Problem(what, why, "set `regular` to 0 for this gear"))
            found.append(Fraction(round(step), parts) % 1 if parts else Fraction(0))
            # each contact of an irregular gear is a family of its own, because its angle is only a float
            key.append(gear if parts else (len(keys), gear))
        part.append((found[0], found[1]))
        keys.append((key[0], key[1]))
    family, _ = contact_families(keys)
    # the rounding error of a direction normal to an axis grows as the angle between the axes decreases
    slack = 16 * EPS / sine[:, None] * np.ones(2)
    return PitchPoints(circuits, azimuth, slack, family, part)


def wrapped(turns: Floats) -> Floats:
    """Return the difference between `turns` and the nearest integer, from -1/2 to 1/2."""
    return np.asarray(turns - np.round(turns), dtype=float)


def closes(teeth: Sequence[NDArray[np.int64]], rule: Sequence[Fraction | float], tolerance: float) -> Mask:
    """Return a boolean mask of the tooth numbers z_k for which sum z_k a_k is an integer, equation (3) of
    docs/closure.md.

    The test is exact if all factors a_k in `rule` are Fractions; otherwise it has the tolerance `tolerance` [pitch].
    The product z_k a_k is the signed number of teeth that gears of kind k have inside one loop of meshes.
    """
    if all(isinstance(share, Fraction) for share in rule):
        # integer arithmetic over the common denominator
        whole = lcm(*(Fraction(share).denominator for share in rule))
        total = sum(z * int(Fraction(share) * whole) for z, share in zip(teeth, rule, strict=True))
        return np.asarray(total % whole == 0)
    return np.asarray(np.abs(residue(teeth, rule)) <= tolerance)


def residue(teeth: Sequence[Any], rule: Sequence[Fraction | float]) -> Floats:
    """Return the closing error of a loop [pitch]: the sum of z_k a_k minus the nearest integer, where z_k are the tooth
    numbers and a_k the factors of the loop (see `loop_rules`).
    """
    return wrapped(np.asarray(sum(z * float(share) for z, share in zip(teeth, rule, strict=True)), dtype=float))


def divisors(rules: Sequence[Sequence[Fraction | float]], kinds: int) -> list[int]:
    """Return for each kind of gear an integer that must divide its tooth number for all exact rules to be satisfied.

    The rules are those of `loop_rules`. If sum z_k a_k is an integer, then m a_i z_i is also an integer, where m is the
    common denominator of the other factors a_k.
    """
    found = [1] * kinds
    for rule in rules:
        if all(isinstance(share, Fraction) for share in rule):
            shares = [Fraction(share) for share in rule]
            for at, share in enumerate(shares):
                others = lcm(*(other.denominator for k, other in enumerate(shares) if k != at))
                found[at] = lcm(found[at], (others * share).denominator)
    return found


def loop_rules(configuration: Configuration) -> tuple[tuple[Fraction | float, ...], ...]:
    """Return the distinct assembly conditions, each as a factor a_k of the tooth number z_k of each kind of gear.

    For every loop of a cycle basis, sum z_k a_k must be an integer. The factors are Fractions if the contacts of every
    gear in the loop are equally spaced. Raises `QuestionError` if a loop has an odd number of gears, because such a set
    cannot turn.
    """
    phasing = _closure(configuration, [1] * len(configuration.names))
    parts = phasing.problem.parts
    if parts.breaking:
        names = " - ".join(parts.loop(parts.breaking[0]).links)
        raise QuestionError(
            Problem(
                f"loop {names} has an odd number of gears",
                "meshing gears turn in opposite senses, so an odd loop locks",
                "remove one mesh of the loop",
            )
        )
    kind_of = dict(zip(configuration.names, configuration.kinds, strict=True))
    found: dict[tuple[Fraction | float, ...], None] = {}
    for loop in phasing.loops:
        total: dict[str, Fraction | float] = dict.fromkeys(kinds_in_order(configuration), Fraction(0))
        for gear, share in (loop.inside or {}).items():
            total[kind_of[gear]] += share
        shares: tuple[Fraction | float, ...]
        # factors modulo integers, in a form that does not depend on the sense in which the loop is traversed
        if all(isinstance(share, Fraction) for share in total.values()):
            shares = min(tuple(share % 1 for share in total.values()), tuple(-share % 1 for share in total.values()))
        else:
            # kinds outside a float loop stay 0; rounding to 1e-13 merges equal loops into one rule
            around = [round(float(wrapped(np.asarray(share, dtype=float))), 13) for share in total.values()]
            shares = max(tuple(around), tuple(-share if share else 0.0 for share in around))
        if any(shares):
            found[shares] = None
    return tuple(found)
