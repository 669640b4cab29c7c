"""The rows of W. D. Smith's note, in the order of its text; what they ask is worked out in `sources.smith`."""

from __future__ import annotations

from collections.abc import Iterator

from sources import smith, smith_axes
from sources.row import Corrected, Equal, Row, Source, Statements, outside
from sources.smith import BOTH, ONCE, TWICE

HISTORY = "history"
DATUM = "a measurement quoted in the note"


_OF_SMITH = Statements(vars(smith))
words, equation, digits = _OF_SMITH.words, _OF_SMITH.equation, _OF_SMITH.digits
_OF_AXES = Statements(vars(smith_axes))


def introduction() -> Iterator[Row]:
    """Sections 1 to 7."""
    yield outside("Eq. (1)", "friction is mu times the normal force", "an assumption; `friction` of a train is this mu")
    yield _OF_AXES.words(
        "Theorem 1", "only cones with one apex and parallel cylinders roll without sliding along a curve", "rolling()"
    )
    yield _OF_AXES.words(
        "Section 2, efficiencies",
        "97-99.7 % for bevel and spur wheels, 50-95 % for worms and crossed helices",
        "efficiencies()",
        why="bearings and oil, which measured efficiencies include, are not counted",
    )
    yield _OF_AXES.words(
        "Section 2, hyperboloids", "hyperboloids are the general case and have a common generatrix", "generatrix()"
    )
    yield outside("Section 3", "terms", "definitions; the [glossary](glossary.md) has ours")
    for kind, number in (("spur", 2), ("bevel", 3)):
        yield equation(
            f"Eq. ({number})",
            f"angle between radius and tooth, {kind}",
            f"off('{kind}', cosine_of_psi, lambda v: v.slope[0] / v.along(1))",
            Equal(ONCE),
        )
    yield outside("Section 4", "gears of 280 B.C., Archimedes, Desargues, La Hire, Euler, Savary, Sang", HISTORY)
    yield outside("Section 4, wreck", "65 +- 15 B.C., more than 20 bronze gears", HISTORY)
    yield outside("Footnote 2", "harmonic drives of 50-320 to 1, 80-90 %", DATUM)
    yield words(
        "Section 5",
        "teeth transmit a constant ratio if their normal passes through the pitch point",
        "law_of_gearing()",
    )
    yield equation(
        "Eq. (4)",
        "the curve of constant torque ratio: modified normals at one distance from the centre",
        "eq_4()",
        Equal(ONCE),
    )
    yield equation("Section 6, involute", "theta = sqrt((r/r0)^2 - 1) - arccos(r0/r)", "strings('spur')", Equal(ONCE))
    yield equation("Eq. (5)", "involute on the sphere", "strings('bevel')", Equal(ONCE))
    yield equation(
        "Section 6, cycloid",
        "contact runs on the generating circle, its normal turns half as fast as it",
        "cycloid_normal()",
        Equal(ONCE),
    )
    yield equation(
        "Section 6, line",
        "the contact of involutes runs on a straight line at constant speed",
        "involute_line()",
        Equal(ONCE),
    )
    yield words(
        "Section 6, clocks",
        "cycloids supposedly have less friction than involutes",
        "cycloids_rub()",
        "at the same arcs they have more",
    )
    for form in ("involute", "cycloid"):
        yield words(
            f"Section 6, {form}s",
            "these gears need not be made in pairs: any size meshes with any other",
            f"same_flank('{form}')",
        )
    yield words("Section 7, force", "only involutes transmit a constant force", "steady_force()")
    yield words("Section 7, spacing", "only involutes run well at other centre distances", "spacing()")
    yield words(
        "Section 7, contacts", "gears with more than 1.4 contacts on average have been made", "contact_number()"
    )
    yield _OF_AXES.outside(
        "Section 7, few teeth",
        "cycloids work with one or two teeth",
        "geartrain constructs conjugate teeth only for wheels of three or more teeth",
        "fewest_teeth()",
    )


def conjugates() -> Iterator[Row]:
    """Sections 8 and 9."""
    yield equation(
        "Eq. (6)",
        "where a given bevel gear touches",
        "off('bevel', eq_6, lambda v: np.sin(v.r[1]) / tan(v.R2))",
        Equal(ONCE),
    )
    yield equation(
        "Eq. (7), s",
        "sin s",
        "off('bevel', lambda v: np.sin(gamma(v)) / np.cos(v.psi(2)) * sin(v.R2), lambda v: -np.sin(v.s))",
        Equal(ONCE),
    )
    yield equation(
        "Eq. (7), phi",
        "sin phi",
        "off('bevel', lambda v: np.sin(v.r[1]) / sin(v.R2) * np.cos(v.psi(2)), lambda v: v.sin_phi)",
        Equal(ONCE),
    )
    yield equation(
        "Eq. (8), first",
        "cos r1 = cos R1 cos s + sin R1 sin s cos phi",
        "(eq_8(1.0), eq_8(-1.0))",
        Corrected(),
        "minus",
    )
    yield equation(
        "Eq. (8), second",
        "tan(w1 t + theta1)",
        "off('bevel', lambda v: v.sin_phi / (np.sin(v.R1) / np.tan(v.s) + np.cos(v.R1) * v.cos_phi), "
        "lambda v: np.tan(v.turned[0]))",
        Equal(),
    )
    yield equation(
        "Eq. (9)",
        "where a given spur gear touches",
        "off('spur', lambda v: np.cos(gamma(v)) + np.sin(gamma(v)) * np.tan(v.psi(2)), lambda v: v.r[1] / v.R2)",
        Equal(ONCE),
    )
    yield equation(
        "Eq. (10), s",
        "s",
        "off('spur', lambda v: np.sin(gamma(v)) / np.cos(v.psi(2)) * v.R2, lambda v: -v.s)",
        Equal(ONCE),
    )
    yield equation(
        "Eq. (10), phi",
        "sin phi",
        "off('spur', lambda v: v.r[1] / v.R2 * np.cos(v.psi(2)), lambda v: v.sin_phi)",
        Equal(ONCE),
    )
    yield equation(
        "Eq. (11), first", "r1^2 = s^2 + R1^2 - 2 R1 s cos phi", "(eq_11(-1.0), eq_11(1.0))", Corrected(), "plus"
    )
    yield equation(
        "Eq. (11), second",
        "tan(w1 t + theta1)",
        "off('spur', lambda v: v.s * v.sin_phi / (v.R1 + v.s * v.cos_phi), lambda v: np.tan(v.turned[0]))",
        Equal(),
    )
    for number, what in (
        (12, "C(t) of a pin gear"),
        (13, "the contact"),
        (14, "the mate's r and theta"),
        (15, "its r, in full"),
        (16, "its theta, in full"),
    ):
        yield equation(f"Eq. ({number})", what, "pins()", Equal())
    yield outside(
        "Theorems 2, 3",
        "gears of one symmetric rack mate with each other",
        "local proofs, with nothing to compute; what follows from it is seen on the flanks in section 6 above",
    )
    for theorem, shape in (("10", "friction"), ("11", "temperature")):
        yield words(
            f"Section 9, Don Juan, {shape}",
            f"the gear of theorem {theorem} is the same for every mate",
            f"same_flank('{shape}')",
        )
    yield words("Section 9, not Don Juan", "the gear of theorem 8 is not the same for every mate", "not_one_flank()")
    yield _OF_AXES.outside(
        "Section 9, steady heat",
        "a gear whose rate of heat is constant could be had",
        "geartrain does not offer this form, since the note gives no use for it",
        "no_steady_heat()",
    )


def friction() -> Iterator[Row]:
    """Sections 10 and 11."""
    yield equation("Eq. (17)", "sliding by r and psi, spur", "sliding('spur')", Equal(ONCE))
    yield equation("Eq. (18)", "sliding by r and psi, bevel", "sliding('bevel')", Equal(ONCE))
    yield equation(
        "Eq. (19)",
        "sliding by s, bevel",
        "of_path('bevel', lambda v: rate(v) * np.sin(v.s), lambda c: c.U1 - c.U2)",
        Equal(ONCE),
    )
    yield equation(
        "Eq. (20)", "sliding by s, spur", "of_path('spur', lambda v: rate(v) * v.s, lambda c: c.U1 - c.U2)", Equal(ONCE)
    )
    yield equation("Eq. (21)", "cos R1 by r1, s and psi1", "eq_21()", Equal(ONCE))
    yield equation(
        "Eq. (22)", "sin s: upper sign of the root", "(eq_22(1.0), eq_22(-1.0))", Corrected(ONCE), "lower sign"
    )
    yield equation("Eq. (23)", "s: upper sign of the root", "(eq_23(1.0), eq_23(-1.0))", Corrected(ONCE), "lower sign")
    yield words(
        "Theorem 4", "sliding is unavoidable; it is 0 only at the pitch point, where it reverses", "sliding_turns()"
    )
    yield outside("Section 10, bearings", "pins with ball bearings, belts", "outside the scope (bearings, not teeth)")
    for place, what, printed in (
        ("teflon", "mu of teflon on teflon", "0.04"),
        ("soap", "mu of metals with stearic acid", "0.05"),
        ("Dudley, minimum", "mu over oils and speeds", "0.017"),
        ("Dudley, maximum", "the same", "0.061"),
    ):
        yield outside(f"Section 11, {place}", what, DATUM, printed)
    for place, what, printed, expression in (
        ("Dokos, slow", "mu of dry steel", "0.53", "dokos(1)"),
        ("Dokos, fast", "mu at 10^7 times the speed", "0.18", "dokos(10**7)"),
        ("Buckingham, 150 ft/min", "mu of cast iron in oil", "0.0112", "buckingham(150)"),
        ("Buckingham, 2100 ft/min", "mu of cast iron in oil", "0.0385", "buckingham(2100)"),
        ("Buckingham, stationary", "mu of cast iron in oil", "0.0517", "buckingham(0)"),
    ):
        transmission = expression.partition("(")[0]
        yield digits(
            f"Section 11, {place}",
            what,
            printed,
            expression,
            why=f"measured; `friction: {{law: {transmission}}}` goes by it",
        )
    yield outside(
        "Section 11, formulas",
        "mu = c2 exp(-c1 sqrt V) + c3 sqrt V; rises as V^p, 0.51 <= p <= 0.60; worms V^-p, 0.5 < p < 1",
        "fits to measurements (the note does not give the constants); what the law here puts between the three values "
        "is (17) of [Tooth shapes](shapes.md)",
    )
    yield outside("Section 11, oil", "what fails at high power", "lubrication is not modelled")


def curvatures() -> Iterator[Row]:
    """Sections 12 to 14."""
    yield equation("Eq. (24)", "ds of y(x): an eighth of a circle", "eq_24()", Equal())
    yield equation(
        "Eq. (25)", "ds of r(theta), from points", "off('spur', arc_rate, lambda v: v.along(1))", Equal(ONCE)
    )
    yield equation("Eq. (26)", "the same on the sphere", "off('bevel', arc_rate, lambda v: v.along(1))", Equal(ONCE))
    yield equation(
        "Eq. (27), y(x)", "radius of curvature, against circles through three points", "eq_27_first()", Equal(TWICE)
    )
    yield equation("Eq. (27), r(theta)", "radius of curvature of both teeth", "curvature('spur')", Equal(TWICE))
    yield equation("Eq. (28)", "by psi and its slope", "eq_28('spur')", Equal(TWICE))
    yield equation("Eq. (29)", "on the sphere, by r and its slopes", "curvature('bevel')", Equal(TWICE))
    yield equation("Eq. (29), middle", "on the sphere, by psi and its slope", "eq_28('bevel')", Equal(TWICE))
    yield equation("Eq. (30)", "both centres of curvature", "eq_30()", Equal(TWICE))
    yield equation("Eq. (31)", "their ratio z", "eq_31()", Equal(TWICE))
    yield equation("Eq. (32), theorem 5", "Euler and Savary's equation", "savary('spur')", Equal(TWICE))
    yield equation("Eq. (33)", "cos phi = (r1/R1) cos psi1", "cosine_of_phi('spur')", Corrected(ONCE), "sin phi")
    yield equation("Eq. (34)", "cos A2", "spherical_centres(2)", Equal())
    yield equation(
        "Eq. (35)",
        "cos A1 = ... - sin(s - c1) sin R1 cos phi1",
        "(spherical_centres(1, -1.0), spherical_centres(1))",
        Corrected(),
        "plus",
    )
    yield equation("Eq. (36)", "both cotangents", "eq_36()", Equal(TWICE))
    yield equation("Eq. (37), theorem 6", "Euler and Savary's equation on the sphere", "savary('bevel')", Equal(TWICE))
    yield equation(
        "Eq. (38)", "cos phi = (sin r1/sin R1) cos psi1", "cosine_of_phi('bevel')", Corrected(ONCE), "sin phi"
    )
    yield equation(
        "Eq. (39)", "four parts of the triangle of pitch point, axis, centre of curvature", "triangle(39)", Equal()
    )
    yield outside("Eq. (40)", "speed of the contact is sin c times the rate of alpha", "a definition; (42) follows")
    yield equation("Eq. (41)", "the cosine law in it", "triangle(41)", Equal())
    yield equation(
        "Eq. (42)",
        "speed of the contact, bevel, with c + s",
        "speed_of_contact('bevel')",
        Corrected(TWICE),
        "c - s, with the signed s of (23)",
    )
    yield equation("Eq. (43)", "cos A", "eq_43()", Equal(ONCE))
    yield equation(
        "Eq. (44)",
        "speed of the contact, spur, with c + s",
        "speed_of_contact('spur')",
        Corrected(TWICE),
        "c - s",
    )
    yield equation(
        "Eq. (45), theorem 7",
        "speed of the contact by the law of cosines, with c + s",
        "speed_of_contact('spur')",
        Corrected(TWICE),
        "c - s",
    )


def work_and_stress() -> Iterator[Row]:
    """Sections 15 to 17."""
    yield outside(
        "Section 15, (Wrong)", "work as an integral of force over the tooth", "marked as wrong in the note itself"
    )
    yield equation(
        "Section 15, spirals",
        "it would give loxodromes 2 arctan(exp(theta)/2), at 45 deg to radii",
        "spirals()",
        Equal(TWICE),
    )
    yield equation("Eq. (46)", "work of friction, spur: what stands under the integral", "work('spur')", Equal(ONCE))
    yield words(
        "Section 15, n contacts",
        "n contacts that share the force do not change the work W",
        "shared_work()",
        "the work decreases, since each point of a tooth carries less force",
    )
    yield words(
        "Footnote 6",
        "45 deg makes involutes most efficient",
        "heights()",
        "only for equal tooth heights; for equal arcs, all pressure angles are equally efficient",
    )
    yield equation("Eq. (47)", "normal force of a torque, spur", "forces('spur')", Equal(ONCE))
    yield equation("Eq. (48)", "normal force of a rack", "rack_force()", Equal())
    yield equation("Eq. (49)", "normal force of a torque, bevel", "forces('bevel')", Equal(ONCE))
    yield equation("Eq. (50)", "work of friction between two angles, bevel", "work('bevel')", Equal(ONCE))
    yield equation(
        "Eq. (51)",
        "lost part (R1/R2 + R2/R1) G kappa mu, spur",
        "losses('spur')",
        Corrected(ONCE),
        "(1/R1 + 1/R2) G kappa mu",
    )
    yield equation(
        "Eq. (52)",
        "lost part, bevel",
        "losses('bevel')",
        Corrected(ONCE),
        "cot R1 + cot R2",
        "the printed formula is right for perpendicular axes",
    )
    for place, printed, key in (
        ("saving", "33", "33"),
        ("X", "1.932", "X"),
        ("X^3", "7.21", "cube"),
        ("X^2", "5.27", "two"),
    ):
        yield digits(
            f"Section 16, {place}",
            "arithmetic from (51) as printed",
            printed,
            f"arithmetic('{key}')",
            why="the arithmetic; what is concluded from it is the erratum below",
        )
    yield words(
        "Section 16, trains",
        "trains lose less than one pair of large ratio",
        "trains()",
        "they lose more if (51) is corrected",
    )
    yield equation("Eqs. (53), (54)", "stress by force and curvatures, plane and sphere", "stress()", Equal(TWICE))
    yield equation("Eq. (55)", "what is uniform, spur", "stress()", Equal(TWICE))
    yield equation(
        "Eq. (56), theorem 8",
        "uniform stress: -2 r^3 r'^3 H - r^5 r' H - r r'^5 H",
        "long_one(56)",
        Corrected(TWICE),
        "+ H Q (r^2 + r'^2)^2",
    )
    yield equation("Eq. (57)", "Q", "eq_57()", Equal(ONCE))
    yield equation("Eq. (58), theorem 9", "what is uniform, bevel", "stress()", Equal(TWICE))
    yield equation("Eq. (59)", "tan c1", "curvature('bevel')", Equal(TWICE))
    yield words(
        "Section 17, involutes",
        "c decreases as sqrt(r - r0), and stress increases as (r - r0)^(-1/4)",
        "involute_root()",
    )
    yield _OF_AXES.equation("Footnote 8", "stress of two balls", "two_balls()")


def heat_and_optima() -> Iterator[Row]:
    """Sections 18 to 21, the six problems."""
    yield equation("Eqs. (60), (61)", "rate of heat and how long it lasts: their product", "heat()", Equal(TWICE))
    yield equation("Eq. (62)", "heat of an area", "heat()", Equal(TWICE))
    yield equation(
        "Eq. (63)",
        "Z: a square over a sum of twelve terms",
        "long_one(63)",
        Corrected(TWICE),
        "Z is linear in r'', with the opposite sign",
    )
    yield equation(
        "Eq. (64)",
        "a differential equation of the fourth order",
        "order_of_64()",
        Corrected(1e-20),
        "it is of the second order and has a closed-form solution",
    )
    yield words(
        "Theorem 10",
        "the gear has minimum friction between given ends of the path",
        "extremal_is_minimum()",
        why="in closed form: (10) of [Tooth shapes](shapes.md)",
    )
    names = (("friction", "minimum friction"), ("stress", "uniform stress"), ("temperature", "uniform temperature"))
    for kind in BOTH:
        for number, (form, name) in enumerate(names, 1):
            yield words(
                f"Problem {number}, {kind}", f"{name}, {kind}: the gear is found", f"uniform('{form}', '{kind}')"
            )
    yield outside(
        "Theorem 10, existence", "that a best shape exists", "a qualitative argument; the closed form answers it"
    )
    yield _OF_AXES.outside(
        "Section 20",
        "n contacts: other constants in other pieces",
        "shapes are constructed only for a single tooth pair in contact",
        "one_pair()",
    )
    for shape, tilt in (("stress", 45), ("temperature", 80)):
        yield words(
            f"Section 21, {shape}",
            f"uniform {shape} plausibly has the smallest maximum {shape}",
            f"minimum_height('{shape}')",
            f"not without a bound on the pressure angle, here {tilt} deg",
        )
    yield outside("Section 21, pieces", "where pieces join, collisions", "left open in the note; here every form says")
    yield outside(
        "Figs. 1 to 5",
        "drawings for the derivations",
        "contain no numerical values; `geartrain mesh 24 36 --compare --plot forms.svg` draws shapes",
    )


_PARTS = (introduction, conjugates, friction, curvatures, work_and_stress, heat_and_optima)
SOURCE = Source(
    "Smith",
    "W. D. Smith, Optimal shapes for gears, NEC Research Institute, 22 December 1993 (19 pages)",
    "The copy consists of the abstract with the contexts of its references; equations are numbered as in the full "
    "note, whose PostScript file was published by its author. The equations are evaluated on finished spur and bevel "
    "profiles of 24 and 36 teeth (involute, uniform stress and uniform temperature). Points of both teeth are turned "
    "to the positions at which they touch, and derivatives are computed numerically.",
    tuple(row for part in _PARTS for row in part()),
)
