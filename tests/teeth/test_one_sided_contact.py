"""Involutes whose contact is wholly before or after the pitch point: judged by drawn flanks, losses by summing."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cached_property
from math import cos, hypot, pi, sin, sqrt, tan

import numpy as np
import pytest
from commands import call
from hypothesis import Phase, assume, example, given, settings
from hypothesis import strategies as st
from sampling import few_or_many

import geartrain
from geartrain.errors import GearTrainError
from geartrain.teeth import Involute
from geartrain.teeth.conjugate import measure
from geartrain.teeth.contact import GearOutline, OutlineCurve, ToothFlanks, solve

ALPHA = pi / 9
BACKLASH = 0.05
CLEAR = 0.25
ISSUED = (36, 70, "--internal", "-p", "shift=0.696,0.226")


def inv(angle: float) -> float:
    return tan(angle) - angle


def inverse(value: float) -> float:
    low, high = 0.0, 1.5
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if inv(middle) < value else (low, middle)
    return low


@dataclass(frozen=True)
class Drawn:
    """A pair by the textbook alone: sizes, ends of the line of action from the pitch point, drawn teeth."""

    z1: int
    z2: int
    x1: float
    x2: float
    add1: float
    add2: float
    ring: bool

    @property
    def sign(self) -> int:
        return -1 if self.ring else 1

    @cached_property
    def angle(self) -> float:
        teeth, shifts = self.z2 + self.sign * self.z1, self.x2 + self.sign * self.x1
        return inverse(inv(ALPHA) + 2 * tan(ALPHA) * shifts / teeth)

    @property
    def distance(self) -> float:
        return (self.z2 + self.sign * self.z1) / 2 * cos(ALPHA) / cos(self.angle)

    def base(self, at: int) -> float:
        return (self.z1, self.z2)[at] / 2 * cos(ALPHA)

    def tip(self, at: int) -> float:
        if at:
            return self.z2 / 2 + self.x2 + self.sign * self.add2
        return self.z1 / 2 + self.x1 + self.add1

    def root(self, at: int) -> float:
        if at:
            return self.z2 / 2 + self.x2 - self.sign * (self.add1 + CLEAR)
        return self.z1 / 2 + self.x1 - self.add2 - CLEAR

    def pitch_radius(self, at: int) -> float:
        return self.base(at) / cos(self.angle)

    @cached_property
    def ends(self) -> tuple[float, float]:
        """Along the line of action from the pitch point: where contact begins, and where it ends."""
        over = [sqrt(self.tip(at) ** 2 - self.base(at) ** 2) - self.pitch_radius(at) * sin(self.angle) for at in (0, 1)]
        return -self.sign * over[1], over[0]

    @property
    def ratio(self) -> float:
        first, last = self.ends
        return (last - first) / (pi * cos(ALPHA))

    def half(self, at: int, r: float | np.ndarray) -> float | np.ndarray:
        """Half the angle of a tooth at a radius; straight towards the axle inside the base circle."""
        z, x, sign = ((self.z1, self.x1, 1), (self.z2, self.x2, self.sign))[at]
        angle = np.arccos(np.minimum(self.base(at) / np.maximum(r, self.base(at)), 1.0))
        roll = np.tan(angle) - angle
        thin = BACKLASH / 4 / self.pitch_radius(at)
        return (pi / 2 + sign * 2 * x * tan(ALPHA)) / z + sign * (inv(ALPHA) - roll) - thin

    def wheel(self, at: int) -> GearOutline:
        low, high, base = self.root(at), self.tip(at), self.base(at) * (1 + 1e-9)

        def curve(start: float, end: float) -> OutlineCurve:
            def points(t: np.ndarray) -> np.ndarray:
                r = start + (end - start) * t
                half = self.half(at, r)
                return np.stack([r * np.sin(half), r * np.cos(half)], axis=1)

            return OutlineCurve(points)

        flank = [curve(low, base), curve(base, high)] if low < base < high else [curve(low, high)]
        return GearOutline((ToothFlanks.symmetric(flank),), (self.z1, self.z2)[at], ring=bool(at and self.ring))

    @cached_property
    def runs(self) -> bool:
        """True if drawn teeth keep the ratio to rounding all through a pitch, with play left behind."""
        S = np.linspace(0, 2 * pi / self.z1, 160, endpoint=False)
        touch = solve(self.wheel(0), self.wheel(1), self.distance, S)
        error = touch.front.angle - S * self.z1 / self.z2
        return bool(np.isfinite(error).all() and np.ptp(error) < 1e-9 and touch.backlash.min() > 0)

    def whole(self) -> bool:
        """True if a rack can make these wheels: no undercut, no point, no tip in a root."""
        thick = all(self.half(at, self.tip(at)) > 1e-6 for at in (0, 1))
        fits = 1 if self.ring else 2
        cut = all(
            max(self.add1, self.add2) - x <= z / 2 * sin(ALPHA) ** 2
            for z, x in [(self.z1, self.x1), (self.z2, self.x2)][:fits]
        )
        if self.ring:
            clear = self.root(1) - self.distance > self.tip(0) and self.tip(1) - self.distance > self.root(0)
        else:
            clear = self.distance - self.root(1) > self.tip(0) and self.distance - self.root(0) > self.tip(1)
        return thick and cut and clear

    def form(self) -> Involute:
        return Involute(
            form="involute",
            shift=[repr(self.x1), repr(self.x2)],
            addendum=[repr(self.add1), repr(self.add2)],
            dedendum=[repr(self.add2 + CLEAR), repr(self.add1 + CLEAR)],
            backlash=repr(BACKLASH),
        )

    def loss(self, shared: bool, count: int = 20_000) -> float:
        """Mean loss over friction by summing over the line of action, first order."""
        first, last = self.ends
        pitch = pi * cos(ALPHA)
        x = first + (last - first) * (np.arange(count) + 0.5) / count
        pairs = np.floor((last - x) / pitch) + np.floor((x - first) / pitch) + 1
        weight = 1 / pairs if shared else np.ones(count)
        slide = np.abs(x) * (1 / self.base(0) + self.sign / self.base(1))
        return float((slide * weight).sum() / weight.sum())


@st.composite
def pairs(draw: st.DrawFn) -> Drawn:
    ring = draw(st.booleans())
    z1 = draw(st.integers(14, 60))
    z2 = z1 + draw(st.integers(10, 60)) if ring else draw(st.integers(14, 90))
    # the wheels' tips are set beside the pitch circles: all contact before the pitch point, or after it, or neither
    # numbers that a declaration takes: 0, or not below 1e-300
    x1 = round(draw(st.floats(-1.5, 1.8)), 12)
    x2 = round((x1 if ring else -x1) + draw(st.floats(-0.6, 0.6)), 12)
    add1, add2 = draw(st.floats(0.5, 1.3)), draw(st.floats(0.5, 1.3))
    return Drawn(z1, z2, x1, x2, add1, add2, ring)


SAMPLE = few_or_many(15, 60)  # `--slow` draws new pairs, and twice as many

ISSUE = Drawn(36, 70, 0.696, 0.226, 1.0, 1.0, True)
AFTER = Drawn(40, 60, 1.15, -1.15, 1.0, 1.0, False)
BEFORE = Drawn(60, 40, -1.15, 1.15, 1.0, 1.0, False)


def possible(pair: Drawn) -> bool:
    shifts = (pair.x2 + pair.sign * pair.x1) / (pair.z2 + pair.sign * pair.z1)
    return inv(ALPHA) + 2 * tan(ALPHA) * shifts > 1e-4 and all(pair.tip(at) > pair.base(at) * 1.0001 for at in (0, 1))


@example(ISSUE)
@example(AFTER)
@example(BEFORE)
@given(pairs())
@settings(max_examples=SAMPLE, deadline=None, phases=(Phase.explicit, Phase.reuse, Phase.generate))
def test_a_pair_runs_where_its_drawn_flanks_keep_the_ratio_and_nowhere_else(pair: Drawn) -> None:
    assume(possible(pair) and pair.whole() and abs(pair.ratio - 1) > 0.02)
    if pair.ratio <= 0:
        with pytest.raises(GearTrainError, match="do not reach each other"):
            pair.form().transmission(pair.z1, pair.z2, internal=pair.ring)
        return
    transmission = pair.form().transmission(pair.z1, pair.z2, 1e-7, internal=pair.ring)
    assert bool(transmission.verdict) == pair.runs, transmission.verdict.text
    if not transmission.verdict:
        return
    first, last = (end / cos(pair.angle) for end in pair.ends)
    assert transmission.pair.arcs == pytest.approx((-first, last), abs=1e-9)
    assert transmission.path.contact_ratio == pytest.approx(pair.ratio, rel=1e-9)
    found = measure(transmission.path)
    assert found.one_pair.loss == pytest.approx(pair.loss(False), rel=1e-4)
    assert found.shared.loss == pytest.approx(pair.loss(True), rel=1e-3)
    for way in (transmission, transmission.reversed, transmission.reversed_motion()):
        assert (1 - way.efficiency_mean()) / 1e-7 == pytest.approx(found.shared.loss, rel=1e-4)
        assert np.ptp(way.error(np.linspace(0, 9, 50))) == 0


def test_both_sides_of_the_pitch_point_are_met_by_the_examples() -> None:
    assert ISSUE.ends[0] > 0
    assert AFTER.ends[0] > 0
    assert BEFORE.ends[1] < 0
    assert all(pair.runs and pair.whole() for pair in (ISSUE, AFTER, BEFORE))
    assert ISSUE.ratio == pytest.approx(1.546, abs=5e-4)


def test_pressure_under_a_shared_load_is_that_of_half_the_force_where_two_touch() -> None:
    """Hertz: the root of force over relative curvature radius, by the radii of two involutes on the line of action."""
    pair = Drawn(24, 36, 0, 0, 1, 1, False)
    first, last = pair.ends
    pitch = pi * cos(ALPHA)
    x = np.linspace(first, last, 400_001)
    long = sum(pair.pitch_radius(at) * sin(ALPHA) for at in (0, 1))
    rho = pair.pitch_radius(0) * sin(ALPHA) + x
    bend = np.sqrt(long / (rho * (long - rho)) / cos(ALPHA))
    two = (x + pitch <= last) | (x - pitch >= first)
    data = json.loads(call("mesh", 24, 36, "--form", "involute", "--json").output)["losses_and_stresses"]
    assert data["one_pair"]["stress"] == pytest.approx(bend.max(), rel=1e-6)
    assert data["shared"]["stress"] == pytest.approx(max(bend[~two].max(), (bend[two] / sqrt(2)).max()), rel=1e-5)
    assert data["shared"]["stress"] < data["one_pair"]["stress"]


@pytest.mark.parametrize("shift", [1.2, -1.2])
def test_bevels_touch_on_one_side_where_their_tips_end_on_the_sphere(shift: float) -> None:
    """The arc by bisecting for the tip cone along the great circle of the path."""
    transmission = Involute(form="involute", shift=[shift, -shift]).transmission(40, 60, shaft_angle=pi / 2)
    assert transmission.verdict, transmission.verdict.text
    cones = np.arctan2(40, 60), np.arctan2(60, 40)
    ends = []
    for at, z in enumerate((40, 60)):
        tip = cones[at] + np.arctan((1 + (shift, -shift)[at]) * 2 * sin(cones[at]) / z)

        def off(d: float, at: int = at, tip: float = tip) -> float:
            return cos(d) * cos(cones[at]) - sin(d) * sin(ALPHA) * sin(cones[at]) - cos(tip)

        low, high = -0.2, 0.4
        for _ in range(80):
            middle = (low + high) / 2
            low, high = (middle, high) if off(middle) > 0 else (low, middle)
        ends.append(low / cos(ALPHA))
    assert transmission.pair.arcs == pytest.approx((ends[1], ends[0]), abs=1e-12)
    assert min(transmission.pair.arcs) < 0
    assert transmission.path.contact_ratio == pytest.approx(sum(ends) / (2 * pi * sin(cones[0]) / 40), rel=1e-9)


def test_the_command_takes_contact_on_one_side() -> None:
    done = call("mesh", *ISSUED, "--friction", 0.1)
    assert done.exit_code == 0, done.output
    assert "Contact ratio 1.54589" in done.output
    assert "all contact is on the other side of the pitch point" in done.output
    first, last = ISSUE.ends
    data = json.loads(call("mesh", *ISSUED, "--json").output)
    assert data["arcs"] == pytest.approx([-first / (pi * cos(ALPHA)), last / (pi * cos(ALPHA))])
    # the flank works between its own tip and where the mate's tip meets it
    low = hypot(ISSUE.base(0), ISSUE.pitch_radius(0) * sin(ISSUE.angle) + first)
    assert data["flanks"][0] == pytest.approx([low, ISSUE.tip(0)], rel=1e-12)
    assert data["losses_and_stresses"]["shared"]["loss"] == pytest.approx(ISSUE.loss(True), rel=1e-6)


TRAIN = """
links:
  a: {{wheels: {{p: {{teeth: {z1}, module: 2 mm}}}}}}
  b: {{wheels: {{q: {{teeth: {z2}, module: 2 mm{internal}}}}}}}
  frame: {{}}
frame: frame
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}]
gears:
  - pair: [p, q]
    friction: 1e-4
    tooth_form: {{form: involute, shift: [{x1}, {x2}], addendum: [{add1}, {add2}]}}
inputs: {{a: 1}}
outputs: {{b: }}
loads: {{b: {load} N m}}
"""


@pytest.mark.parametrize("pair", [ISSUE, AFTER, BEFORE], ids=["ring", "after", "before"])
def test_a_train_moves_and_loses_what_its_one_sided_teeth_say(pair: Drawn) -> None:
    given = {name: getattr(pair, name) for name in ("z1", "z2", "x1", "x2", "add1", "add2")}
    # against the turning of b, so that a drives
    text = TRAIN.format(**given, internal=", internal: true" if pair.ring else "", load=-1 if pair.ring else 1)
    train = geartrain.load(text)
    (mesh,) = train.meshes
    assert not mesh.faults
    assert mesh.transmission.speed_range() == pytest.approx((pair.z1 / pair.z2,) * 2)
    assert np.ptp(train.motion().at(np.linspace(0, 2, 50)).error[0]) == 0
    lost = 1 - float(train.torques().efficiency)
    assert lost / 1e-4 == pytest.approx(pair.loss(True), rel=2e-4)
