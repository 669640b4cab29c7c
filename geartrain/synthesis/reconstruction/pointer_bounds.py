"""The speeds that a pointer may have, by all that is declared of its output."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction

from geartrain.errors import DeclarationError, Problem
from geartrain.kinematics.judged_outputs import goal_of
from geartrain.synthesis.reconstruction.base_link import BaseLink
from geartrain.train import Output, Train

Limits = tuple[Fraction, Fraction]


@dataclass(frozen=True)
class PointerBounds:
    """Least and greatest speed, or magnitude where the sense is not known; and what is declared but bounds nothing."""

    limits: Limits
    signed: bool
    unused: tuple[str, ...] = ()

    def allow(self, speed: Fraction) -> bool:
        """Whether a speed is within them."""
        return self.limits[0] <= (speed if self.signed else abs(speed)) <= self.limits[1]


def find_bounds(evidence: Train, name: str, free_sense: bool, base: BaseLink) -> PointerBounds:
    """Bounds of an output of evidence, seen from the base; with a free sense those of its magnitude.

    Raises `DeclarationError` where there is no one range of speeds.
    """
    output, place = evidence.outputs[name], evidence.place("outputs", name)
    if output.relative_to not in (None, evidence.frame, base.name):
        what = f"'{name}' is seen from '{output.relative_to}', which is not taken up by a reconstruction yet"
        carrier = "" if base.name == evidence.frame else f" or the carrier '{base.name}'"
        why = f"a pointer of a reconstruction is seen from the frame{carrier}"
        raise DeclarationError(Problem(what, why, f"give its speed against the frame{carrier}", place))
    if output.of == evidence.frame:
        raise DeclarationError(Problem(f"'{name}' is on the frame, which does not turn", "", "correct `of`", place))
    found = _bounds(evidence, name, free_sense)
    found = _seen_from_base(found, name, base.seen(output.relative_to or evidence.frame), place)
    if output.of is None and base.source == evidence.frame and found.allow(base.driven):
        what = f"'{name}' turns as the frame does, and so the frame itself would show it"
        fix = "name its arbor with `of`, or say `of: new` if that is lost"
        raise DeclarationError(Problem(what, "its arbor is not known", fix, place))
    return found


def _bounds(evidence: Train, name: str, free_sense: bool) -> PointerBounds:
    output, place = evidence.outputs[name], evidence.place("outputs", name)
    known = list(_ranges(evidence, output))
    unused = _unused(name, output)
    if not known:
        why = "it has no `expect`, and no target with a tolerance"
        fix = "add for example `expect: -5/19`, or `tolerance: 1/446` to a target"
        raise DeclarationError(Problem(f"how fast '{name}' turns is not known", why, fix, place))
    signed = [limits for limits, has_sign in known if has_sign and not free_sense]
    plain = [_magnitudes(limits) if has_sign else limits for limits, has_sign in known if not has_sign or free_sense]
    if not signed:
        return PointerBounds(_common(plain, name, place), False, unused)
    limits = _common(signed, name, place)
    if plain:
        limits = _with_magnitude(limits, _common(plain, name, place), name, place)
    return PointerBounds(limits, True, unused)


def _seen_from_base(bounds: PointerBounds, name: str, turning: Fraction, place: str) -> PointerBounds:
    """Bounds for a base that turns so fast."""
    if not turning:
        return bounds
    if not bounds.signed:
        what = f"the sense of '{name}' is not known, and it is seen from the frame"
        why = "then it has two speeds, as seen from the carrier"
        raise DeclarationError(Problem(what, why, "give the sense, or its speed `relative_to` the carrier", place))
    least, greatest = bounds.limits
    return replace(bounds, limits=(least - turning, greatest - turning))


def _ranges(evidence: Train, output: Output) -> Iterator[tuple[Limits, bool]]:
    """What is said of a speed, and whether with its sign."""
    if output.expect is not None:
        value, tolerance = output.expect.value, output.expect.tolerance
        half = tolerance.value if tolerance is not None else value.half or Fraction(0)
        yield (value.value - half, value.value + half), True
    for target in output.targets:
        goal = goal_of(evidence, target)
        if target.tolerance is not None:
            half = target.tolerance.base * (abs(goal.speed) or 1)
        elif target.speed is not None and output.expect is None:
            half = (target.speed.half or Fraction(0)) * target.turns.value
        else:
            continue
        yield (goal.speed - half, goal.speed + half), goal.signed


def _unused(name: str, output: Output) -> tuple[str, ...]:
    lines = [
        f"a target of '{name}' ({target.name or target.period or target.speed}): it has no tolerance"
        for target in output.targets
        if target.tolerance is None and (target.speed is None or output.expect is not None)
    ]
    if output.published is not None:
        lines.append(f"what is published of '{name}': `expect` and targets with a tolerance are taken")
    return tuple(lines)


def _magnitudes(limits: Limits) -> Limits:
    ends = sorted(map(abs, limits))
    return (Fraction(0), ends[1]) if limits[0] < 0 < limits[1] else (ends[0], ends[1])


def _common(ranges: list[Limits], name: str, place: str) -> Limits:
    least, greatest = max(low for low, _ in ranges), min(high for _, high in ranges)
    if least > greatest:
        why = "no speed is within `expect` and all targets with a tolerance"
        raise DeclarationError(Problem(f"what is said of '{name}' contradicts itself", why, "correct one", place))
    return least, greatest


def _with_magnitude(limits: Limits, magnitude: Limits, name: str, place: str) -> Limits:
    """Speeds within limits whose magnitude is within limits too."""
    low, high = magnitude
    if limits[0] >= 0:
        return _common([limits, (low, high)], name, place)
    if limits[1] <= 0:
        return _common([limits, (-high, -low)], name, place)
    if low <= 0:
        return _common([limits, (-high, high)], name, place)
    why = "one part of the evidence gives its sense, and one that does not leaves two ranges of speed"
    raise DeclarationError(Problem(f"the speed of '{name}' is not one range", why, "give one target", place))
