"""F. Sorge, A Note on the Mechanics of Ancient Gear Systems: every equation, figure and claim."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from math import degrees, pi
from typing import Any

import numpy as np

import geartrain
from geartrain.dynamics.motion.pair_impacts import collision_energies
from geartrain.teeth import Triangular
from geartrain.teeth.triangular.clearance_window import find_window
from geartrain.teeth.triangular.tooth_pair import ToothPair
from sources import sorge_contacts as note
from sources.row import Corrected, Equal, Finding, Row, Source, Statements, outside
from sources.sorge_contacts import Contact, contacts, figures, off, transmission
from sources.ways import Command

HISTORY = "history"
A, R = "approach", "recess"


_OWN = Statements(globals())
words, equation = _OWN.words, _OWN.equation


def mesh(z1: int, z2: int, clearance: str, path: str) -> Command:
    """A value of a pair of the figures."""
    return Command(f"mesh {z1} {z2} --form triangular -p clearance_factor={clearance} --friction 0.2", path)


# ------------------------------------------------------------------------------------------------------ II. geometry


def depths() -> float:
    """Eq. (1) against the depths of all pairs."""
    return max(
        float(abs(R * (1 - np.sin(s.beta1) / np.sin(s.beta1 + pi / z)) / h - 1))
        for s in (pair.sizes for pair in figures().values())
        for R, z, h in ((s.R1, s.z1, s.depths[0]), (s.R2, s.z2, s.depths[1]))
    )


def flanks() -> float:
    """Eq. (2) against the distance from an apex to the next valley, from depth and angles."""
    found = []
    for s in (pair.sizes for pair in figures().values()):
        for radius, z, h in ((s.R1, s.z1, s.depths[0]), (s.R2, s.z2, s.depths[1])):
            valley = (radius - h) * np.exp(1j * pi / z)
            found.append(abs(radius * np.sin(pi / z) / np.sin(s.beta1 + pi / z) / abs(radius - valley) - 1))
    return float(max(found))


def radii() -> float:
    """Eq. (3) against the radii of all pairs."""
    found = []
    for s in (pair.sizes for pair in figures().values()):
        one, two = (1 - np.sin(s.beta1) / np.sin(s.beta1 + pi / z) for z in (s.z1, s.z2))
        found.append(abs(one / two / (s.R2 / s.R1) - 1))
    return float(max(found))


def reaches() -> float:
    """Eq. (4) against the reach of both wheels."""
    found = []
    for s in (pair.sizes for pair in figures().values()):
        for own, other, reach in ((s.R1, s.R2, s.reach1), (s.R2, s.R1, s.reach2)):
            found.append(abs((s.D**2 + own**2 - other**2) / (2 * s.D * own) - np.cos(reach)))
    return float(max(found))


def distances() -> float:
    """D = a (R1 + R2 - h)."""
    found = ((pair.sizes, float(note.FIGURES[name][2])) for name, pair in figures().items())
    return max(abs(a * (s.R1 + s.R2 - s.depths[0]) / s.D - 1) for s, a in found)


def matched() -> Finding:
    """Where flank lies on flank the angles are opposite; speed jumps there."""
    angles, jumps = [], []
    for pair in figures().values():
        s, tooth_pair = pair.sizes, pair.contact.path.tooth_pair
        angles.append(abs(tooth_pair.angle("approach", s.matching) + s.matching))
        jumps.append(tooth_pair.speed("recess", s.matching) / tooth_pair.speed("approach", s.matching) - 1)
    return Finding(
        max(angles) < 1e-12 and min(jumps) > 0,
        f"alpha_2 = -alpha_1 to 1e-12; there tau jumps by {100 * min(jumps):.1f} to {100 * max(jumps):.1f} %",
    )


def geometry() -> Iterator[Row]:
    """Sections I and II."""
    yield outside("I, Fig. 1", "find, fragments, x-rays, Olbia, Cicero, Archimedes", HISTORY)
    yield outside(
        "II, Fig. 2",
        "a drawing of approach, matching and recess, z2/z1 = 2, beta = 30 deg",
        "the copy has no pictures; `geartrain mesh 48 96 --form triangular -p clearance_factor=1.01 --at -3deg "
        "--plot contact.svg` draws any position",
    )
    yield words("Fig. 2 b", "profiles match where -alpha_2 = alpha_1; tau changes suddenly there", "matched()")
    yield equation("Eq. (1)", "h = R [1 - sin b / sin(b + pi/z)]", "depths()")
    yield equation("Eq. (2)", "e = R sin(pi/z) / sin(b + pi/z)", "flanks()")
    yield equation("Eq. (3)", "R2/R1 from equal depths", "radii()")
    yield equation("II, D", "D = a D_min, D_min = R1 + R2 - h", "distances()")
    yield equation("Eq. (4)", "cos alpha_i,max = (D^2 + Ri^2 - Rj^2) / (2 D Ri)", "reaches()")


# ---------------------------------------------------------------------------------------------------- III. kinematics


def closure(phase: str, axis: int) -> float:
    """Eqs. (5), (6), (13), (14): both sides in parts of D, v being the distance of the apices."""

    def residual(c: Contact) -> Any:
        if axis:
            return c.R1 * np.sin(c.x) - c.apart * np.sin(c.lean) - c.R2 * np.sin(c.y)
        return c.R1 * np.cos(c.x) - c.apart * np.cos(c.lean) + c.R2 * np.cos(c.y) - c.D

    return float(max(np.abs(residual(c)).max() / c.D for c in contacts(phase)))


def eq_7() -> float:
    """alpha_2 in approach."""
    return off(A, lambda c: np.arcsin(note.inner(c) / c.R2) - c.x - c.beta, lambda c: c.y)


def eq_8() -> float:
    """The quadratic equation of v in approach, in parts of its last term."""

    def term(c: Contact) -> Any:
        return note.square(c) - c.R2**2

    def rest(c: Contact) -> Any:
        return c.apart**2 + 2 * c.apart * (c.D * np.cos(c.x + c.beta) - c.R1 * np.cos(c.beta))

    return off(A, lambda c: -rest(c), term)


def signs_8() -> Finding:
    """What is said of the terms of Eq. (8)."""
    linear = [c.D * np.cos(c.x + c.beta) - c.R1 * np.cos(c.beta) for c in contacts(A)]
    last = [note.square(c) - c.R2**2 for c in contacts(A)]
    return Finding(
        min(each.min() for each in linear) > 0 > max(each.max() for each in last),
        "positive and negative at every contact",
    )


def loci() -> Finding:
    """Contacts on the tip circle of the apex that slides: distances from its centre."""
    driven = max(float(np.abs(np.hypot(c.point[0] - c.D, c.point[1]) / c.R2 - 1).max()) for c in contacts(A))
    driver = max(float(np.abs(np.hypot(*c.point) / c.R1 - 1).max()) for c in contacts(R))
    return Finding(max(driven, driver) < 1e-12, "at every contact, to 1e-12")


def eq_10() -> float:
    """alpha_1m."""
    found = []
    for s in (pair.sizes for pair in figures().values()):
        found.append(abs(np.arcsin((s.R1 + s.R2) * np.sin(s.beta1) / s.D) - s.beta1 - s.matching) / s.reach1)
    return float(max(found))


def signs_15() -> Finding:
    """What is said of the terms of Eq. (15), and of the root of Eq. (16)."""
    last = [c.R2**2 - note.square(c) for c in contacts(R)]
    roots = [note.square(c) - (c.R2 * np.sin(c.beta)) ** 2 for c in contacts(R)]
    good = min(each.min() for each in last) > 0 and min(each.min() for each in roots) > 0
    return Finding(good, "both positive at every contact")


def eq_15() -> float:
    """The quadratic equation of v in recess."""
    return off(
        R,
        lambda c: 2 * c.apart * c.R2 * np.cos(c.beta) - c.apart**2,
        lambda c: c.R2**2 - note.square(c),
    )


def eq_16() -> tuple[float, float]:
    """The distance of the apices with either sign."""
    return off(R, lambda c: note.eq_16(c, 1.0), lambda c: c.apart), off(
        R, lambda c: note.eq_16(c, -1.0), lambda c: c.apart
    )


def eq_17() -> float:
    """alpha_2 in recess by the quotient, on figures and on leaning flanks of few teeth, over the whole ideal path."""
    worst = 0.0
    for z1, z2, half in ((48, 96, 30), (96, 96, 30), (5, 4, 40), (3, 8, 25), (8, 8, 60), (12, 30, 70)):
        form = Triangular.model_validate(
            {"form": "triangular", "half_angle": f"{half} deg", "clearance_factor": "1.05"}
        )
        sizes = form.transmission(z1, z2).sizes
        s = sizes.at(sizes.maximum_excess / 2)
        x = np.linspace(s.exit, s.entry, 101)[1:-1]
        tooth_pair = ToothPair(s)
        c = Contact(z1, z2, s.R1, s.R2, s.D, s.beta1, R, x, tooth_pair.angle("recess", x, np), x, x)
        worst = max(worst, float(np.abs(note.quotient_17(c, note.eq_16(c, -1.0)) - c.y).max()))
    return worst


def sum_of_angles() -> Finding:
    """What the text says of Eq. (17): angles at O2 of V1 from the line of centres and from V2."""
    worst = 0.0
    for c in contacts(R):
        one, two = c.apices
        late = c.x < 0
        v1, v2 = (np.arctan2(each[1], c.D - each[0])[late] for each in (one, two))
        worst = max(worst, float(np.abs(np.abs(v1) + np.abs(v2 - v1) - np.abs(c.y[late])).max()))
    return Finding(worst < 1e-12, "true after the line of centres; before it, up to matching, it is their difference")


def kinematics() -> Iterator[Row]:
    """Sections III A and B."""
    yield words("III, loci", "contact is on the driven tip circle in approach, and on the driver's in recess", "loci()")
    yield equation("Eq. (5)", "closure along the line of centres, approach", "closure(A, 0)")
    yield equation("Eq. (6)", "closure across it, approach", "closure(A, 1)")
    yield equation("Eq. (7)", "alpha_2(alpha_1) in approach", "eq_7()")
    yield equation("Eq. (8)", "the quadratic equation of v in approach", "eq_8()")
    yield words("Eq. (8), signs", "the linear coefficient is positive, the third term negative", "signs_8()")
    yield equation("Eq. (9)", "v in approach", "off(A, note.eq_9, lambda c: c.apart)")
    yield equation(
        "Eq. (9), root",
        "its root is the tip radius R2 projected on the driver's profile",
        "off(A, note.root, lambda c: c.R2 * np.cos(c.lean + c.y))",
    )
    yield equation("Eq. (10)", "alpha_1m", "eq_10()")
    yield equation(
        "Eq. (11)",
        "O2Ca, by the normal through the contact",
        "off(A, lambda c: note.root(c) / np.cos(c.x + c.beta), lambda c: c.D - c.centre)",
    )
    yield equation("Eq. (12)", "tau in approach", "off(A, note.eq_12, lambda c: c.tau)")
    yield equation(
        "III A, tau", "tau = O1Ca/O2Ca = D/O2Ca - 1", "off(A, lambda c: c.centre / (c.D - c.centre), lambda c: c.tau)"
    )
    yield equation("Eq. (13)", "closure along the line of centres, recess", "closure(R, 0)")
    yield equation("Eq. (14)", "closure across it, recess", "closure(R, 1)")
    yield equation("Eq. (15)", "the quadratic equation of v in recess", "eq_15()")
    yield words(
        "Eq. (15), signs", "the third term is positive, and so is the quarter-discriminant of (16)", "signs_15()"
    )
    yield equation("Eq. (16)", "v in recess: plus before the root", "eq_16()", Corrected(), "minus")
    yield equation("Eq. (17)", "alpha_2 as an arctangent of a quotient", "eq_17()", Equal(1e-9))
    yield words("Eq. (17), text", "abs(alpha_2) is a sum of two angles at O2", "sum_of_angles()")
    yield equation(
        "Eq. (18)",
        "O1Cr, by the normal through the contact",
        "off(R, lambda c: c.R1 * note.turned(c) / np.cos(c.lean), lambda c: c.centre)",
    )
    yield equation("Eq. (19)", "tau in recess", "off(R, note.eq_19, lambda c: c.tau)")


# ------------------------------------------------------------------------------------------------- III C. real meshing


def concave_upward() -> Finding:
    """d tau / d alpha_1 on the whole ideal path of every figure, but for the matching position."""
    minimum = []
    for pair in figures().values():
        s, tooth_pair = pair.sizes, pair.contact.path.tooth_pair
        late, early = np.linspace(-s.reach1, s.matching, 500), np.linspace(s.matching, s.reach1, 500)
        minimum += [tooth_pair.slope("recess", late, np).min(), tooth_pair.slope("approach", early, np).min()]
    return Finding(min(minimum) > 0, f"d tau/d alpha_1 at least {min(minimum):.2f} on all six ideal paths")


def shared_bounds() -> Finding:
    """How many pairs with some clearance run, of those tried."""
    failing = {
        f"{z1}/{z2} at {a}": transmission(z1, z2, a).verdict.kind for z1, z2, a in ((15, 60, "1.01"), (96, 96, "1.027"))
    }
    text = ", ".join(f"{name}: {kind}" for name, kind in failing.items())
    return Finding(all(kind == "runs" for kind in failing.values()), text)


def back_profiles() -> Finding:
    """The least play of back flanks at a clearance of 1.01."""
    backlash = {
        f"{z1}/{z2}": transmission(z1, z2, "1.01").verdict.backlash * z2 / (2 * pi) for z1, z2 in ((48, 96), (15, 60))
    }
    text = ", ".join(f"{name}: {part:.3f}" for name, part in backlash.items())
    return Finding(min(backlash.values()) > 0, f"minimum backlash at a = 1.01, in pitches: {text}")


def admissible() -> Finding:
    """Whether another couple would overlap at a contact of the real path: its first contact would come before it."""
    deepest = 0.0
    for pair in figures().values():
        s, tooth_pair = pair.sizes, pair.contact.path.tooth_pair
        for phase in (A, R):
            c = note.seen(pair, phase)
            for x, y in zip(c.x.tolist(), c.y.tolist(), strict=True):
                for j in (-3, -2, -1, 1, 2, 3):
                    if abs(x + j * s.p1) <= s.reach1:
                        deepest = max(deepest, (y + j * s.p2 - tooth_pair.contact(x + j * s.p1)) / s.p2)
    return Finding(
        deepest < 1e-9, f"true at {note.SAMPLES} contacts of each figure, for three tooth pairs before and after"
    )


def real_meshing() -> Iterator[Row]:
    """Section III C."""
    yield words(
        "III C, concavity", "alpha_2(alpha_1) is slightly concave upward except at matching", "concave_upward()"
    )
    yield words(
        "III C, admissible", "points at which no other tooth pair would overlap are below the chord", "admissible()"
    )
    yield words(
        "III C, one couple",
        "one tooth pair at a time is in contact, followed by the next without interruption",
        "shared_bounds()",
        "only within the clearance window",
    )
    yield words(
        "III C, back profiles",
        "the back profiles are quite far from interference",
        "back_profiles()",
        "false for unequal wheels with small clearance",
    )
    yield words("III C, chord", "the active part is one pitch of alpha_1 wide: 360/z1", "widths()")


def widths() -> Finding:
    """Total width of the intervals, and both ends at one level of the chord."""
    worst = 0.0
    for pair in figures().values():
        s = pair.sizes
        worst = max(worst, abs(sum(each.width for each in pair.intervals) / s.p1 - 1))
        if len({each.phase for each in pair.intervals}) == 1:
            first, last = ((at.x, at.y) for at in next(note.ends(next(n for n, p in figures().items() if p is pair))))
            worst = max(worst, abs((first[1] - last[1]) / (first[0] - last[0]) / s.ratio - 1))
    return Finding(worst < 1e-9, "in all six figures; if it is a single phase, its chord has the slope z1/z2")


# ---------------------------------------------------------------------------------------------------- III D. collision


def phases(z1: int, z2: int, clearance: str) -> list[str]:
    """The phases of the real path; `astride` where one runs through the matching position."""
    pair = transmission(z1, z2, clearance)
    names = [each.phase for each in pair.intervals]
    through = any(jump.kind == "matching" for jump in pair.jumps)
    return ["astride"] if through and len(names) == 2 else names


def entered(z1: int, z2: int, a: str, expected: list[str]) -> Finding:
    """Where a pair meshes."""
    found = phases(z1, z2, a)
    return Finding(sorted(found) == sorted(expected), f"{z1}/{z2} at {a}: {' and '.join(found)}")


def faster() -> Finding:
    """Speed ratios before and after each blow."""
    jumps = [jump for pair in figures().values() for jump in pair.jumps]
    return Finding(all(jump.after > jump.before for jump in jumps), f"in all {len(jumps)} impacts of the figures")


def maximum_jumps() -> Finding:
    """The range of the relative jumps."""
    found = [jump.value for pair in figures().values() for jump in pair.jumps]
    return Finding(max(found) < 0.2, f"{min(found):.4f} to {max(found):.4f} in the figures")


def towards_straddling() -> Finding:
    """How far after the matching position (in pitches) contact begins or before it ends, as the clearance grows."""
    starts = [_gap(48, 96, a, 0) for a in ("1.01", "1.02", "1.025", "1.031")]
    ends = [_gap(96, 72, a, 1) for a in ("1.01", "1.012", "1.014")]
    falls = all(b < a for each in (starts, ends) for a, b in pairwise(each))
    return Finding(
        falls,
        "distance of the path from the matching position, in pitches: 48/96 at a = 1.01, 1.02, 1.025, 1.031: "
        + ", ".join(f"{each:.3f}" for each in starts)
        + " (a dwell occurs before it straddles); 96/72 at 1.01, 1.012, 1.014: "
        + ", ".join(f"{each:.3f}" for each in ends),
    )


def _gap(z1: int, z2: int, a: str, late: int) -> float:
    pair = transmission(z1, z2, a)
    edge = min(each.end for each in pair.intervals) if late else max(each.start for each in pair.intervals)
    return abs(edge - pair.sizes.matching) / pair.sizes.p1


def normal_speeds(phase: str, wheel: int) -> float:
    """Eqs. (20), (21), (23), (24) against velocities of the two bodies at the contact."""
    if phase == A:
        printed = (lambda c: c.D * np.cos(c.beta + c.x) - note.root(c), lambda c: c.tau * note.root(c))
    else:
        printed = (
            lambda c: c.R1 * note.turned(c),
            lambda c: c.tau * (c.D * np.cos(c.beta - c.y) - c.R1 * note.turned(c)),
        )
    return off(phase, printed[wheel - 1], lambda c: c.normal_speeds[wheel - 1])


def first_forms(phase: str) -> float:
    """The first halves of the same equations, by the instant centre."""
    if phase == A:
        return max(
            off(A, lambda c: c.centre * np.cos(c.beta + c.x), lambda c: c.normal_speeds[0]),
            off(A, lambda c: c.tau * c.R2 * np.cos(c.beta + c.x + c.y), lambda c: c.normal_speeds[1]),
        )
    return off(R, lambda c: c.tau * (c.D - c.centre) * np.cos(c.beta - c.y), lambda c: c.normal_speeds[1])


def collisions() -> Iterator[Row]:
    """Section III D."""
    yield words("III D, speeds", "the entrance speed ratio is higher than the exit one", "faster()")
    yield words("III D, z1/z2 > 1", "the meshing is entirely in approach", "entered(96, 72, '1.01', [A])")
    yield words("III D, z1/z2 < 1", "the meshing is entirely in recess", "entered(48, 96, '1.01', [R])")
    yield words("III D, z1/z2 = 1", "two sub-phases, approach and recess", "entered(96, 96, '1.01', [A, R])")
    yield words(
        "III D, z1/z2 = 1, backlash",
        "the sub-phases join as the backlash grows",
        "entered(96, 96, '1.025', ['astride'])",
    )
    yield words(
        "III D, straddling", "with more backlash the path tends to straddle both regions", "towards_straddling()"
    )
    yield equation("Eq. (20)", "v1 normal, approach", "normal_speeds(A, 1)")
    yield equation("Eq. (21)", "v2 normal, approach", "normal_speeds(A, 2)")
    yield equation("Eqs. (20), (21), first forms", "by O1Ca and R2", "first_forms(A)")
    yield equation("Eq. (22)", "jump of a meshing in approach, Fig. 4a", "abs(note.eq_22() - note.jump('4a', A))")
    yield equation("Eq. (23)", "v1 normal, recess", "normal_speeds(R, 1)")
    yield equation("Eq. (24)", "v2 normal, recess", "normal_speeds(R, 2)")
    yield equation("Eq. (24), first form", "by O2Cr", "first_forms(R)")
    yield equation(
        "Eq. (25)",
        "jump in recess (Fig. 3a): alpha_2 has no index in the denominators",
        "[abs(note.eq_25(corrected) - note.jump('3a', R)) for corrected in (False, True)]",
        Corrected(),
        "alpha_2i in the upper denominator, alpha_2e in the lower",
    )
    yield equation(
        "Eq. (26)",
        "jump from recess into approach (Fig. 5a): -1 is outside the fraction",
        "[abs(note.eq_26(corrected) - note.jump('5a', A)) for corrected in (False, True)]",
        Corrected(),
        "-1 in the denominator",
    )
    yield equation("Eq. (27)", "jump from approach into recess, Fig. 5a", "abs(note.eq_27('5a') - note.jump('5a', R))")
    yield equation(
        "Eq. (27) at matching",
        "the same at alpha_1m, Figs. 4b and 5b",
        "max(abs(note.eq_27(name) - note.jump(name, 'matching')) for name in ('4b', '5b'))",
    )
    yield words("III D, size", "relative jumps up to the order of 10 %", "maximum_jumps()")


# ------------------------------------------------------------------------------------------------------ IV. power loss


def pressure_angles() -> Finding:
    """Directions of the flanks in contact."""
    found = np.degrees(np.concatenate([c.lean for phase in (A, R) for c in contacts(phase)]))
    return Finding(
        found.min() > 20, f"{found.min():.1f} to {found.max():.1f} deg in the figures; modern gears have 14.5 to 25"
    )


def turned_force() -> Finding:
    """Whether friction brings the line of action nearer to O2 after the line of centres, as it does before."""
    before = [c.arms[1] < c.normal_speeds[1] / c.tau for c in contacts(A)]
    after = [c.arms[1] < c.normal_speeds[1] / c.tau for c in contacts(R)]
    nearer = [each[c.y > 0].all() for each, c in zip(before, contacts(A), strict=True)]
    also = [each[c.x < 0].any() for each, c in zip(after, contacts(R), strict=True)]
    assert all(nearer)
    text = "towards the driven wheel's centre before the line of centres, away from it after"
    return Finding(all(also), text)


def arm(phase: str, wheel: int) -> float:
    """Eqs. (28) to (31) against the moments of a force at a contact."""
    return off(phase, lambda c: note.arms(c)[wheel - 1], lambda c: c.arms[wheel - 1])


def eq_31() -> tuple[float, float]:
    """Eq. (31) as printed and corrected."""
    return off(R, lambda c: note.arms(c, False)[1], lambda c: c.arms[1]), arm(R, 2)


def eq_33() -> tuple[float, float]:
    """Eq. (33) as printed and corrected."""
    found = [off(R, lambda c, s=sign: note.eq_33(c, s), lambda c: c.eta) for sign in (1.0, -1.0)]  # type: ignore[misc]
    return found[0], found[1]


def distances_to_centre() -> float:
    """V2Ca and V1Cr as printed, against the points."""
    one = off(A, lambda c: c.R2 * abs(np.sin(c.y)) / np.cos(c.beta + c.x), _to_centre)
    return max(one, off(R, lambda c: c.R1 * abs(np.sin(c.x)) / np.cos(c.beta - c.y), _to_centre))


def _to_centre(c: Contact) -> Any:
    return np.hypot(c.point[0] - c.centre, c.point[1])


def eq_34() -> float:
    """The integral of Eq. (34) over a pitch, in parts of M1 p1, against 1 less the mean efficiency."""
    worst = 0.0
    for pair in figures().values():
        total = sum(_integral(pair, high, low) for _, high, low in pair.stretches)
        worst = max(worst, abs(total / pair.period / (1 - pair.efficiency_mean()) - 1))
    return worst


def _integral(pair: Any, high: float, low: float) -> float:
    """Of 1 - eta over a smooth stretch of alpha_1, by Gauss's rule."""
    points, weights = np.polynomial.legendre.leggauss(24)
    x = (high + low) / 2 + (high - low) / 2 * points
    return float((high - low) / 2 * weights @ (1 - pair.efficiency(-x)))


def lost_in_impacts() -> tuple[float, float]:
    """What a blow of Fig. 3a dissipates, from momentum and energy of the wheel alone, against both formulas.

    J2 is set to 1 and so is w1: the blow hands J2 w1 (tau+ - tau-) to the wheel while the driver keeps w1, so that it
    does w1 times that over the ratio of arms, tau+; what is not found in the wheel's energy is lost.
    """
    (jump,) = figures()["3a"].jumps
    work = jump.after * (jump.after - jump.before)
    lost = work - (jump.after**2 - jump.before**2) / 2
    printed = (jump.after**2 - jump.before**2) / 2
    ours = collision_energies(figures()["3a"].speed_leaps(), 1.0, 1.0)[1]
    return abs(printed / lost - 1), abs(ours / lost - 1)


def course(phase: str, key: str) -> float:
    """A column of the course that the command gives for all figures, against the note's equation for it, corrected."""
    worst = 0.0
    for name, (z1, z2, a) in note.FIGURES.items():
        s = figures()[name].sizes
        found = mesh(z1, z2, a, "course").value()
        here = np.array(found["phases"]) == phase
        if not here.any():
            continue
        x, y, tau, eta, own = (
            np.array(found[column], dtype=float)[here]
            for column in ("alpha1", "alpha2", "speed_ratio", "efficiency", key)
        )
        c = Contact(z1, z2, s.R1, s.R2, s.D, s.beta1, phase, x, y, tau, eta)
        centre = c.D - note.root(c) / np.cos(c.lean) if phase == A else c.R1 * note.turned(c) / np.cos(c.lean)
        printed = {"instant_centre": centre, "driver_arm": note.arms(c)[0], "driven_arm": note.arms(c)[1]}[key]
        # on the line of centres itself friction has no side
        worst = max(worst, float(np.abs(printed - own)[np.abs(y if phase == A else x) > 1e-12].max() / own.max()))
    return worst


def from_command() -> Iterator[Row]:
    """The instant centre and the arms as the command tells them."""
    for number, phase, key in (
        *(("11", A, "instant_centre"), ("18", R, "instant_centre")),
        *(("28", A, "driver_arm"), ("29", A, "driven_arm"), ("30", R, "driver_arm"), ("31", R, "driven_arm")),
    ):
        claim = f"`course.{key}` of `geartrain mesh --form triangular --json`, all figures"
        yield equation(f"Eq. ({number}), command", claim, f"course('{phase}', '{key}')")


def power_loss() -> Iterator[Row]:
    """Section IV."""
    yield outside(
        "IV, other losses",
        "supports, air drag and others are left aside",
        "neglected in the note; links of a train may declare `bearing` friction and `drag`",
    )
    yield words(
        "IV, pressure angle",
        "beta + alpha_1 and beta - alpha_2 are much larger than in modern gears",
        "pressure_angles()",
    )
    yield words(
        "IV, line of action",
        "friction turns it towards the driven wheel's centre in both phases",
        "turned_force()",
        "towards it before the line of centres, away from it after",
    )
    yield equation("IV, V2Ca, V1Cr", "distances from the contact to the instant centre", "distances_to_centre()")
    yield equation("Eq. (28)", "b1, approach", "arm(A, 1)")
    yield equation("Eq. (29)", "b2, approach", "arm(A, 2)")
    yield equation("Eq. (30)", "b1, recess", "arm(R, 1)")
    yield equation(
        "Eq. (31)",
        "b2, recess: tau divides the whole bracket",
        "eq_31()",
        Corrected(),
        "tau divides the first product only",
    )
    yield equation(
        "IV, efficiency",
        "eta = tau b2/b1",
        "max(off(p, lambda c: c.tau * c.arms[1] / c.arms[0], lambda c: c.eta) for p in (A, R))",
    )
    yield equation("Eq. (32)", "efficiency in approach", "off(A, note.eq_32, lambda c: c.eta)")
    yield equation(
        "Eq. (33)", "[cc + tau ss]/[cc - ss], efficiency in recess", "eq_33()", Corrected(), "[cc - tau ss]/[cc + ss]"
    )
    yield from from_command()
    yield equation("Eq. (34)", "loss of one meshing, at constant driver torque", "eq_34()")
    yield equation(
        "IV, impact",
        "J2 w1^2 (tau+^2 - tau-^2)/2 is lost",
        "lost_in_impacts()",
        Corrected(),
        "J2 w1^2 (tau+ - tau-)^2/2",
    )


# --------------------------------------------------------------------------------------------------------- V. results


MEANS = {"3": "0.5000", "4": "1.3333", "5": "1.0000"}
JUMPS = [
    *(("3a", R, "0.1582"), ("3b", R, "0.1457"), ("4a", A, "0.1117"), ("4b", A, "0.0682")),
    *(("4b", "matching", "0.0314"), ("5a", A, "0.0876"), ("5a", R, "0.0095"), ("5b", A, "0.0696")),
    ("5b", "matching", "0.0119"),
]


def efficiencies() -> Finding:
    """Efficiency nearest to matching and farthest from it, Fig. 3a."""
    c = contacts(R)[0]
    return Finding(
        bool(c.eta.max() == c.eta[c.x.argmax()] and c.eta.min() == c.eta[c.x.argmin()]),
        f"efficiency {c.eta.max():.4f} nearest to it, {c.eta.min():.4f} farthest; {_to_centre(c).min() / c.R1:.4f} and "
        f"{_to_centre(c).max() / c.R1:.4f} R1 from C",
    )


def falling() -> Finding:
    """tau along every interval."""
    falls = all(np.diff(c.tau[np.argsort(c.x)]).min() > 0 for phase in (A, R) for c in contacts(phase))
    return Finding(falls, "in all six figures tau decreases with alpha_1")


def backlash() -> Finding:
    """Ideal width, real path and jump of Figs. 3 a and b."""
    a, b = figures()["3a"], figures()["3b"]
    (one,), (two,) = a.intervals, b.intervals
    less = b.sizes.reach1 / a.sizes.reach1
    moved = abs(one.start - two.start) / a.sizes.p1
    text = (
        f"ideal width {2 * degrees(a.sizes.reach1):.2f} to {2 * degrees(b.sizes.reach1):.2f} deg; the real path moves "
        f"by {moved:.3f} pitch"
    )
    return Finding(less < 0.75 and moved < 0.15 and one.phase == two.phase == R, text)


def larger() -> Finding:
    """What more clearance does to jumps and mean sliding efficiency, in each pair of figures."""
    names = ("3", "4", "5")
    jumps = {n: [max(jump.value for jump in figures()[n + side].jumps) for side in "ab"] for n in names}
    means = {n: [figures()[n + side].efficiency_mean() for side in "ab"] for n in names}
    better = all(b < a for a, b in jumps.values()) and all(b > a for a, b in means.values())
    told = ", ".join(f"Fig. {n}: {a:.3f} to {b:.3f}" for n, (a, b) in jumps.items())
    return Finding(better, f"the maximum jump decreases ({told}); the sliding efficiency increases in all figures")


def two_pitches() -> Finding:
    """Sub-phases of Fig. 5a: widths, distance, outer ends, in pitches."""
    early, late = sorted(figures()["5a"].intervals, key=lambda each: -each.start)
    p = figures()["5a"].sizes.p1
    found = (early.width + late.width) / p, (early.end - late.start) / p, (early.start - late.end) / p
    good = max(abs(one - two) for one, two in zip(found, (1, 1, 2), strict=True)) < 1e-9
    return Finding(good, f"{found[0]:.6f}, {found[1]:.6f} and {found[2]:.6f} pitches")


def sub_phases() -> Finding:
    """Pieces of the path of 96/96 as the clearance grows; one through the matching position counts once."""
    found = {}
    for a in ("1.01", "1.0115", "1.025"):
        pair = transmission(96, 96, a)
        found[a] = len(pair.intervals) - sum(jump.kind == "matching" for jump in pair.jumps)
    text = ", ".join(f"{pieces} at {a}" for a, pieces in found.items())
    return Finding(max(found.values()) <= 2, f"intervals of the path: {text}")


def narrowing() -> Finding:
    """Width of the left (recess) sub-region of 96/96 just before a third is born, in pitches."""
    pairs = {a: transmission(96, 96, a) for a in ("1.001", "1.0111")}
    width = {
        a: next(each.width for each in pair.intervals if each.phase == R) / pair.period for a, pair in pairs.items()
    }
    text = ", ".join(f"{part:.3f} at {a}" for a, part in width.items())
    return Finding(width["1.0111"] < 0.5 * width["1.001"], f"width of the recess sub-phase, in pitches: {text}")


def best_of_figures() -> Finding:
    """Mean sliding efficiencies of the figures."""
    found = {name: pair.efficiency_mean() for name, pair in figures().items()}
    text = ", ".join(f"{name} {mean:.4f}" for name, mean in found.items())
    return Finding(max(found, key=found.__getitem__) == "5b", text)


def best_of_all() -> Finding:
    """96/96 at 1.025 against 1.0117219, friction, and 1.019273, collisions."""
    lost = {a: 1 - transmission(96, 96, a).efficiency_mean() for a in ("1.025", "1.0117219")}
    spent = {a: collision_energies(transmission(96, 96, a).speed_leaps(), 1.0, 1.0)[1] for a in ("1.025", "1.019273")}
    return Finding(
        lost["1.025"] <= lost["1.0117219"] and spent["1.025"] <= spent["1.019273"],
        f"sliding loss {100 * lost['1.025']:.3f} %, at 1.0117219 {100 * lost['1.0117219']:.3f} %; impact loss "
        f"{spent['1.025']:.2e} J2 w1^2, at 1.019273 {spent['1.019273']:.2e}",
    )


def dwell() -> Finding:
    """Where the ideal region of 96/96 is as wide as a pitch, and where the pair begins to stand still."""
    run = transmission(96, 96, "1.01").contact
    window = find_window(run.sizes)
    wide = 2 * run.sizes.at(window.run).reach1 / run.sizes.p1
    kind = transmission(96, 96, f"{1 + window.run + 1e-4:.6f}").verdict.kind
    text = f"at a = {1 + window.run:.6f} it is {wide:.6f} pitches wide; beyond: {kind}"
    return Finding(abs(wide - 1) < 1e-6 and kind == "dwell", text)


def results() -> Iterator[Row]:
    """Section V."""
    for name, (z1, z2, a) in note.FIGURES.items():
        yield outside(
            f"Fig. {name}, curves",
            "alpha_2, tau and eta over alpha_1",
            "the copy has no pictures, and no values are printed; `geartrain mesh "
            f"{z1} {z2} --form triangular -p clearance_factor={a} --friction 0.2 --plot law.svg` draws them",
        )
        yield Row(f"Fig. {name}, tau_mean", "mean speed ratio", MEANS[name[0]], mesh(z1, z2, a, "speed_ratio.mean"))
        for figure, kind, printed in JUMPS:
            if figure == name:
                at = [each.kind for each in figures()[name].jumps].index(kind)
                wrong = "0.0316" if printed == "0.0314" else ""
                yield Row(
                    f"Fig. {name}, {kind}",
                    "relative jump of normal velocity",
                    printed,
                    mesh(z1, z2, a, f"jumps.{at}.value"),
                    erratum=wrong,
                )
    yield words("Fig. 3", "the active part is in recess only", "entered(48, 96, '1.025', [R])")
    yield words("V, Fig. 3, speeds", "the speed ratio decreases as meshing proceeds", "falling()")
    yield words(
        "V, Fig. 3, sliding", "near matching the contact is near C and the sliding efficiency is high", "efficiencies()"
    )
    yield words(
        "V, Fig. 3 a and b",
        "more backlash reduces the ideal width greatly but hardly changes the real mesh",
        "backlash()",
    )
    yield words("V, larger clearances", "rather large clearances do not worsen the mesh", "larger()")
    yield words("Fig. 4 a", "the active part is in approach only", "entered(96, 72, '1.01', [A])")
    yield words("Fig. 4 b", "the active part is astride the matching position", "entered(96, 72, '1.025', ['astride'])")
    yield words(
        "Fig. 5 a, sub-phases",
        "widths sum to 360/z1; they are 360/z1 apart, their outer ends 2 x 360/z1",
        "two_pitches()",
    )
    yield words(
        "V, sub-phases",
        "two sub-phases, one pitch apart, until only one remains",
        "sub_phases()",
        "one, two or three intervals of total width one pitch",
    )
    yield words(
        "V, left sub-region",
        "its width decreases until it vanishes",
        "narrowing()",
        "both remain half a pitch wide until a third interval, astride the matching position, replaces them",
    )
    yield words("Fig. 5 b", "the active part is astride the matching position", "entered(96, 96, '1.025', ['astride'])")
    yield words(
        "V, Fig. 5 b, efficiency",
        "of all figures, this one has the highest mean sliding efficiency",
        "best_of_figures()",
    )
    yield words(
        "V, best conditions",
        "1:1 at 1.025 has the minimum energy losses",
        "best_of_all()",
        "friction losses are minimal at 1.0117219, impact losses near 1.0193",
    )
    yield words(
        "V, dwell",
        "if the ideal region is smaller than 360/z1 the driven wheel dwells",
        "dwell()",
        why="true for equal wheels; with unequal wheels a dwell occurs earlier",
    )


# --------------------------------------------------------------------------------------------- abstract and conclusion


def oscillation() -> Finding:
    """Speed ratio over its mean."""
    found = [speed / float(pair.ratio) - 1 for pair in figures().values() for speed in pair.speed_range()]
    return Finding(max(map(abs, found)) < 0.1, f"{100 * min(found):+.1f} to {100 * max(found):+.1f} % in the figures")


def whole_train() -> Finding:
    """What the train of Pennestri et al. loses with such teeth, to each of three links."""
    train = geartrain.load("pennestri-2002-teeth")
    lost = {link: 1 - float(train.driven(link, "2").efficiency or 0) for link in ("5", "17", "19")}
    text = ", ".join(f"{100 * part:.1f} % to link {link}" for link, part in lost.items())
    pairs = [100 * (1 - pair.efficiency_mean()) for pair in figures().values()]
    one = f"{min(pairs):.1f} to {max(pairs):.1f} %"
    return Finding(max(lost.values()) <= 0.11, f"pairs of the figures {one}; train `pennestri-2002-teeth`: {text}")


def conclusions() -> Iterator[Row]:
    """Abstract and section VI."""
    yield words("Abstract, speed", "the speed ratio oscillates within 10 % of its mean", "oscillation()")
    yield words("Abstract, efficiency", "the efficiency has rather high values", "best_of_figures()")
    yield outside(
        "VI, rattling",
        "a sensible rattling noise, lubrication of the ancients",
        "a historical conjecture; impacts are in `geartrain mesh 48 96 --form triangular -p clearance_factor=1.01 "
        "--inertia '20 g cm2' --rate 1rpm`",
    )
    yield words(
        "VI, losses",
        "energy losses of the order of 10 % or less",
        "whole_train()",
        "true for a pair; a train of such pairs loses several times as much",
    )


def rows() -> tuple[Row, ...]:
    """All of them, in the order of the text."""
    parts = (geometry, kinematics, real_meshing, collisions, power_loss, results, conclusions)
    return tuple(row for part in parts for row in part())


SOURCE = Source(
    "Sorge",
    "F. Sorge, A Note on the Mechanics of Ancient Gear Systems, University of Palermo",
    "Equations are evaluated at 400 contacts of each pair of Figs. 3 to 5, at the angles that geartrain computes. "
    "Positions, normals, velocities and forces are plane vectors computed from these angles.",
    rows(),
)
