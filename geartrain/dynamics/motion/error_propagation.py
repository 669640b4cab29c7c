"""Propagation of the errors of pairs to links: exact solution of equation (2) of docs/motion.md (section 2).

One elimination gives the error of every link as a sum over the errors of pairs. Coupled pairs, as around a
differential, are solved simultaneously by Newton's method with step halving, equation (5), because transmission
functions have kinks. If halving fails, as in a dwell of a single pair, bisection is used.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.errors import GearTrainError, Problem, RangeError
from geartrain.numerics.containers import ItemwiseMapping
from geartrain.numerics.elimination import LinearForm, eliminate
from geartrain.numerics.exact import nearest_float

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats, Ints
    from geartrain.teeth.transmission import TransmissionFunction

    Flags = NDArray[np.bool_]
    from geartrain.kinematics.willis_system import WillisSystem

_MOST_STEPS = 120  # maximum iterations, including halved steps
_CONVERGED = 2e-15  # rad: tolerance of the residual, relative to the scale of the angles
_FORGIVEN = 1e-9  # rad: accepted residual if no step reduces it further, as at a kink
_HALVINGS = 64  # bisections of four pitches, or of four turns for cut wheels, to rounding

_NO_FIT = "no angles satisfy all transmission functions simultaneously"
_DEAD_CENTRE = "the motion is past a dead centre: an error turns its own driver by more than the error itself"


@dataclass(frozen=True)
class CoupledErrors:
    """Pairs whose transmission errors change one another's driver angles. `senses` contains the mean sense of rotation
    (1 or -1) of each driven link.
    """

    names: tuple[str, ...]
    transmissions: tuple[TransmissionFunction, ...]
    senses: Floats
    gain: Floats
    """Change of the angle of driver m in its mean sense of rotation per unit error of the driven link of pair n
    [rad/rad], shape (pairs, pairs).
    """

    def transmissions_at(self, S: Floats, columns: Ints) -> tuple[Floats, Floats]:
        """Return the signed errors of the driven links [rad] and their derivatives with respect to the driver angles
        [1], each of shape (pairs, n), for driver angles S [rad].
        """
        error, slope = np.empty_like(S), np.empty_like(S)
        for at, transmission in enumerate(self.transmissions):
            error[at], tau = transmission.picked(columns).error_and_speed(S[at])
            slope[at] = tau - float(transmission.ratio)
        error *= self.senses[:, None]
        slope *= self.senses[:, None]
        return error, slope

    def jacobian(self, slope: Floats) -> Floats:
        """Return the matrix I - s G at each position, equation (5) of docs/motion.md, shape (n, pairs, pairs), where I
        is the unit matrix, s the derivatives `slope` of the errors, and G the matrix `gain`.
        """
        return np.eye(len(self.transmissions)) - slope.T[:, :, None] * self.gain


def solve_coupled_errors(pairs: CoupledErrors, base: Floats, turning: Floats) -> tuple[Floats, Floats, Floats]:
    """Return the errors [rad], the speed deviations [1] and the driver speeds [1] of coupled pairs, each of shape
    (pairs, n), given the driver angles and speeds without these errors. Speeds are divided by the speed of the input.

    base      driver angles [rad], shape (pairs, n)
    turning   driver speeds divided by the speed of the input [1], shape (pairs, n)

    Raises `GearTrainError` if the solution is not unique, because the train would then jump or lock.
    """
    delta, slope = _newton(pairs, base)
    jacobian = pairs.jacobian(slope)
    # the determinant is 1 for ideal teeth and changes sign at a dead centre
    if not (_determinants(jacobian) > 0).all():
        raise _refusal(pairs.names, _DEAD_CENTRE)
    rate = _solve_coupled(jacobian, slope * turning)
    return delta, rate, turning + pairs.gain @ rate


@np.errstate(invalid="ignore")  # inf - inf where nothing touches
def _newton(pairs: CoupledErrors, base: Floats) -> tuple[Floats, Floats]:
    """Return the errors of coupled pairs [rad] and the derivatives of the errors with respect to the driver angles [1],
    found by Newton's method with step halving.
    """
    tolerance = _CONVERGED * (1 + np.max(np.abs(base), initial=0.0) + np.abs(pairs.gain).sum(axis=1).max())
    active = np.arange(base.shape[1])
    delta, slopes = pairs.transmissions_at(base, active)
    now = delta.copy()
    length, size, step = np.ones(len(active)), np.full(len(active), np.inf), np.zeros_like(now)
    for _ in range(_MOST_STEPS):
        trial = now - length * step
        # the initial step is 0 and the initial residual infinite, so the first trial is the starting point
        error, slope = pairs.transmissions_at(base[:, active] + pairs.gain @ trial, active)
        residual = trial - error
        found = np.max(np.abs(residual), axis=0)
        better = found < size
        # a residual that no step reduces is rounding, or due to a kink
        done = (better & (found <= tolerance)) | (~better & (length < 1e-9) & (size <= _FORGIVEN))
        length = np.where(better, 1.0, length / 2)
        now, size = np.where(better, trial, now), np.where(better, found, size)
        delta[:, active] = now
        slopes[:, active[better]] = slope[:, better]
        onward = better & ~done
        if onward.any():
            step[:, onward] = _stepped(pairs.jacobian(slope[:, onward]), residual[:, onward])
        left = ~done
        if not left.any():
            return delta, slopes
        active, now, step, length, size = active[left], now[:, left], step[:, left], length[left], size[left]
    stuck = active[size > _FORGIVEN]
    if stuck.size:
        delta[:, stuck], slopes[:, stuck] = _bisected(pairs, base[:, stuck], stuck)
    return delta, slopes


@np.errstate(invalid="ignore")
def _bisected(pairs: CoupledErrors, base: Floats, columns: Ints) -> tuple[Floats, Floats]:
    """Return the error of a single pair [rad] and its derivative with respect to the driver angle [1], found by
    bisection. The derivative is 0 where the error jumps; the error is infinite where the teeth do not touch.
    """
    if len(pairs.transmissions) > 1:
        raise _refusal(pairs.names, _NO_FIT)
    high = np.full_like(base, 2 * float(pairs.transmissions[0].ratio) * pairs.transmissions[0].period)
    low = -high
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        error, slope = pairs.transmissions_at(base + pairs.gain * middle, columns)
        if (slope * pairs.gain > 1 + _FORGIVEN).any():
            raise _refusal(pairs.names, _DEAD_CENTRE)
        low, high = np.where(middle < error, middle, low), np.where(middle < error, high, middle)
    slope[np.abs(middle - error) > _FORGIVEN] = 0.0  # the transmission function jumps past the solution here
    return np.where(np.isfinite(error), middle, error), slope


def _stepped(matrices: Floats, right: Floats) -> Floats:
    """Return the solution x of J x = r at each position for the Jacobians `matrices` (J) and the residuals `right` (r);
    x is 0 where J is singular.
    """
    dead = _determinants(matrices) == 0
    if not dead.any():
        return _solve_coupled(matrices, right)
    step = np.zeros_like(right)
    if not dead.all():
        step[:, ~dead] = _solve_coupled(matrices[~dead], right[:, ~dead])
    return step


def _solve_coupled(matrices: Floats, right: Floats) -> Floats:
    """Return the solutions x of n small systems A x = b, with `matrices` (A) of shape (n, pairs, pairs); x and `right`
    (b) have the shape (pairs, n).
    """
    if len(right) == 1:  # the usual case; LAPACK would take half of the time of the motion
        return np.asarray(right / matrices[:, 0, 0])
    return np.ascontiguousarray(np.linalg.solve(matrices, right.T[:, :, None])[:, :, 0].T)


def _determinants(matrices: Floats) -> Floats:
    return np.asarray(matrices[:, 0, 0] if matrices.shape[1] == 1 else np.linalg.det(matrices))


def _refusal(pairs: Sequence[str], why: str) -> GearTrainError:
    names = ", ".join(pairs)
    if len(pairs) == 1:
        what = f"the motion of pair {names}, whose error turns its own driver, has no unique solution"
        return GearTrainError(
            Problem(
                what, why, "declare it without `tooth_form` (ideal teeth), or declare its driving wheel with `driver`"
            )
        )
    what = f"the motion of the coupled pairs {names} has no unique solution"
    return GearTrainError(Problem(what, why, "declare some of these pairs without `tooth_form` (ideal teeth)"))


class ErrorPath(NamedTuple):
    """Links of one pair, by index, and the coefficient c of the driven link in equation (2) of docs/motion.md."""

    driver: int
    driven: int
    carrier: int
    """Index of the link whose angle is subtracted from the driver's angle; usually the carrier of both links."""
    coefficient: int
    driven_carrier: int
    """Index of the link whose angle is subtracted from the angle of the driven link."""


@dataclass(frozen=True)
class ErrorPropagation:
    """Errors of the links as linear combinations of the errors of the pairs. Indices refer to `links` and `pairs`."""

    links: tuple[str, ...]
    pairs: tuple[str, ...]
    joints: Mapping[int, ErrorPath]
    """Links that determine the error of each pair, by index of the pair; they are determined on first access."""
    forms: Sequence[Mapping[int, Fraction]]
    """Error of each link per unit of the right-hand side c delta of each pair's equation (2), by index of the pair."""
    reached: frozenset[int]
    """Indices of the pairs whose error affects the requested links, directly or through the driver angle of another
    pair. The errors of all other pairs are taken as 0.
    """

    @cached_property
    def response(self) -> Floats:
        """Change of each link's angle per unit error of each pair's driven link [rad/rad], shape (links, pairs)."""
        found = np.zeros((len(self.links), len(self.pairs)))
        for link, form in enumerate(self.forms):
            for pair in self.reached.intersection(form):
                # exact up to here, rounded only once
                found[link, pair] = nearest_float(form[pair] * self.joints[pair].coefficient)
        return found

    def errors(self, deltas: Floats) -> Floats:
        """Return the errors of all links [rad], shape (links, n), from the errors of all pairs, shape (pairs, n)."""
        with np.errstate(invalid="ignore"):  # an infinite response times 0, which `sensitivity` refuses
            return np.asarray(self.response @ deltas)

    def sensitivity(self, link: int, base: int, sense: int = 1) -> Floats:
        """Return the sensitivity of a link's angle, relative to link `base`, to the error of each pair [rad/rad].

        sense   -1 if the axes of the two links have opposite directions, 1 if not

        Raises `RangeError` if a sensitivity exceeds the range of float64.
        """
        with np.errstate(invalid="ignore"):
            found: Floats = self.response[link] - sense * self.response[base]
        if not np.isfinite(found).all():
            what = f"'{self.links[link]}' turns by more than 1e308 times the error of a pair"
            why = "motion is computed in float64, which has a range of 1e-308 to 1e308"
            raise RangeError(Problem(what, why, "choose an input nearer to this output, or use `solve`"))
        return found


def find_error_propagation(
    system: WillisSystem, ends: Mapping[str, Sequence[int]], path: Callable[[str], ErrorPath], wanted: Iterable[int]
) -> ErrorPropagation | None:
    """Return the propagation of errors to the requested links of a square Willis system; None if its equations do not
    determine these errors.

    ends     indices of both links and the carrier of each pair, by row label; other rows (inputs, locks) have no error
    path     function that returns the `ErrorPath` for a row label; it is called on demand
    wanted   indices of the requested links
    """
    at = {link: number for number, link in enumerate(system.links)}
    pairs = tuple(ends)
    # errors of pairs are symbols (negative columns), which elimination does not solve for
    symbol = {label: -1 - number for number, label in enumerate(pairs)}
    rows: list[LinearForm] = []
    for row in system.equations:
        rows.append({at[link]: Fraction(coefficient) for link, coefficient in row.terms})
        if row.label in symbol:
            rows[-1][symbol[row.label]] = Fraction(-1)
    solved = eliminate(rows)
    # a redundant row would determine the error of a pair from those of other pairs
    if len(rows) != len(at) or solved.rank < len(at):
        return None
    by_link = solved.forms()
    forms = [{-1 - each: value for each, value in by_link[link].items()} for link in range(len(at))]
    reached: set[int] = set()
    waiting, seen = list(wanted), set()
    while waiting:
        link = waiting.pop()
        if link not in seen:
            seen.add(link)
            reached.update(forms[link])
            # the angle of a pair depends on its driver and its carrier
            waiting += [end for pair in forms[link] for end in ends[pairs[pair]]]
    joints = ItemwiseMapping(range(len(pairs)), lambda pair: path(pairs[pair]))
    return ErrorPropagation(system.links, pairs, joints, forms, frozenset(reached))
