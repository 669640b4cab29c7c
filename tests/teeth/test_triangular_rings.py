"""Triangular teeth in rings and on racks: reference pairs, outlines that touch, planetary sets.

The reference figures were computed from points and straight segments, with no formula of the package, and checked
against polygons and against Coulomb friction by vector mechanics. Lengths are in radii of the pinion's tips.
"""

from __future__ import annotations

from fractions import Fraction
from math import degrees, pi, radians
from typing import Any, Literal

import numpy as np
import pytest
from polygons import Judge

from geartrain import GearTrain, GearTrainError, load
from geartrain.drawing.tooth_contact import tooth_pair_pose
from geartrain.teeth import Triangular
from geartrain.teeth.triangular import TriangularSizes, TriangularTransmission, equal_depth, find_window
from geartrain.workshop import ToothSizes, find_tooth_sizes

# driver; teeth of pinion and ring; ratio of the radii over that of the teeth (None: equal depth); half angles (deg);
# excess; tip radius of the ring, centre distance, reach of the driver (deg); window of excess; verdict, play (deg)
PAIRS: dict[str, tuple[Any, ...]] = {
    "I1": ("pinion", (20, 60), 1.0, (30, 30), 0.05, (3.0000000000, 2.0952175287, 30.51447793),
        (0.010786897, 0.088924258, "clash"), ("runs", 3.371286534)),
    "I2": ("ring", (20, 60), 1.0, (30, 30), 0.05, (3.0000000000, 2.0952175287, 9.74433297),
        (0.010786897, 0.088924258, "dwell"), ("runs", 9.914372398)),
    "I5": ("pinion", (24, 48), 0.95, (30, 33), 0.06, (1.9000000000, 1.0139405731, 38.73142239),
        (0.014321533, 0.149974555, "dwell"), ("runs", 2.840653785)),
    "I6": ("ring", (24, 48), 0.95, (30, 33), 0.06, (1.9000000000, 1.0139405731, 19.22631204),
        (0.014321533, 0.149974555, "clash"), ("runs", 5.661414913)),
    "I8": ("ring", (15, 60), 0.9, (28, 28), 0.04, (3.6000000000, 2.7548466276, 9.73671564),
        (0.006110586, 0.073813848, "clash"), ("runs", 12.511494862)),
    "I10": ("pinion", (12, 72), 1.0, (30, 30), 0.03, (6.0000000000, 5.1341064222, 32.69855991),
        (0.005111788, 0.048853793, "clash"), ("runs", 2.993838464)),
    "I11": ("ring", (12, 72), 1.0, (30, 30), 0.03, (6.0000000000, 5.1341064222, 5.16570854),
        (0.005111788, 0.048853793, "dwell"), ("runs", 18.581293813)),
    "I12": ("pinion", (30, 33), 1.0, (30, 30), 0.35, (1.1000000000, 0.1620769746, 55.47249203),
        (0.173914694, 0.596660669, "clash"), ("runs", 5.160111732)),
    "I13": ("ring", (30, 33), 0.94, (30, 30), 0.3, (1.0340000000, 0.1283444342, 71.17862502),
        (0.123491884, 0.520137744, "clash"), ("runs", 4.197333475)),
    "I14": ("pinion", (20, 21), 1.0, (30, 30), 0.5, (1.0500000000, 0.1277460677, 70.28671877),
        (0.250762024, 0.801381675, "clash"), ("runs", 8.587428917)),
    "I15": ("pinion", (100, 300), None, (30, 30), 0.012, (2.7606548033, 1.7900669078, 17.36961185),
        (0.005646942, 0.019404935, "dwell"), ("runs", 0.237906855)),
    "I16": ("pinion", (20, 60), 1.0, (30, 30), 0.005, (3.0000000000, 2.1944646748, 43.48657258),
        (0.010786897, 0.088924258, "clash"), ("jam", -0.547580691)),
    "I17": ("pinion", (15, 60), 1.0, (30, 30), 0.072, (4.0000000000, 3.0185628809, 12.74940291),
        (0.008723285, 0.071762606, "clash"), ("clash", 5.690798341)),
    "I18": ("ring", (15, 60), 1.0, (30, 30), 0.072, (4.0000000000, 3.0185628809, 3.16271820),
        (0.008723285, 0.071762606, "dwell"), ("dwell", 22.744666307)),
    "I19": ("pinion", (20, 60), 0.9, (30, 30), 0.09, (2.7000000000, 1.7339978433, 18.78584908),
        (0.004850308, 0.084268555, "dwell"), ("dwell", 4.786567875)),
    "I20": ("pinion", (20, 60), None, (30, 30), 0.05,
        (2.0276568262, 1.1714915136, 42.07945884), None, ("jam", -4.280903999)),
}  # fmt: skip

# intervals of alpha_1 (deg); least and greatest tau over its mean; error peak to peak, and at 0, 1/4, 1/2, 3/4 of the
# driver's pitch (deg); mean efficiency at constant driver torque and at constant load; relative jumps
FIGURES: dict[str, tuple[Any, ...]] = {
    "I1": ([("approach", 21.31242793, 3.31242793)], (0.9030818285, 1.1353461598), 0.1728213028,
        (1.289372862, 1.347176069, 1.314356733, 1.211411299), (0.9591423686, 0.9567217741), [0.204575784]),
    "I2": ([("recess", 0.07064114, -5.92935886)], (0.8807886399, 1.1073193684), 0.5184639085,
        (3.546874681, 3.913551500, 4.042813801, 3.908888771), (0.9685539705, 0.9694385476), [0.204575784]),
    "I5": ([("approach", 20.29935832, 5.29935832)], (0.9384667639, 1.0773960673), 0.1300228052,
        (2.329673108, 2.328353409, 2.266996484, 2.259733274), (0.9706198415, 0.9697264016), [0.128949147]),
    "I6": ([("recess", -0.44248136, -7.94248136)], (0.9281637741, 1.0655678373), 0.2600456104,
        (4.474020934, 4.570014166, 4.669292543, 4.639927653), (0.9777484481, 0.9780748842), [0.128949147]),
    "I8": ([("approach", 1.80174760, 1.69923702), ("recess", 1.69923702, -4.19825240)], (0.8496154244, 1.1208949470),
        0.8380391422, (5.744252569, 5.935208906, 5.677809455, 5.192036268), (0.9732422836, 0.9741366610),
        [0.107325727, 0.153116407]),
    "I10": ([("approach", 27.30470076, -0.86036846), ("recess", -0.86036846, -2.69529924)],
        (0.8219632092, 1.3420281401), 0.2973545766, (0.742163317, 0.907947788, 1.003080768, 0.924244117),
        (0.9433570784, 0.9335938355), [0.287697229, 0.153646842]),
    "I11": ([("approach", 1.15505955, 0.86036846), ("recess", 0.86036846, -3.84494045)],
        (0.7451408582, 1.2165994643), 1.7841274596, (5.270557917, 5.990797141, 5.709353093, 4.377442242),
        (0.9537543519, 0.9570977110), [0.287697229, 0.153646842]),
    "I12": ([("approach", 35.80234981, 23.80234981)], (0.9831623859, 1.0177987345), 0.0472882478,
        (2.830197183, 2.861560075, 2.874489588, 2.863696863), (0.9771124072, 0.9770775149), [0.034030646]),
    "I13": ([("recess", -12.30033675, -23.20942766)], (0.9863169214, 1.0131343995), 0.0403038620,
        (3.882046807, 3.880895013, 3.901333262, 3.901923277), (0.9889863051, 0.9889972921), [0.026469813]),
    "I14": ([("approach", 50.50196192, 32.50196192)], (0.9773321726, 1.0237435940), 0.0997218777,
        (4.253839257, 4.213691973, 4.277714113, 4.290553619), (0.9742357594, 0.9741876115), [0.045335005]),
    "I15": ([("recess", -8.62191255, -12.22191255)], (0.9861684893, 1.0136372592), 0.0041199020,
        (0.481046573, 0.479155746, 0.478643046, 0.480868408), (0.9708985068, 0.9709131313), [0.027099211]),
}  # fmt: skip


def pair(name: str) -> TriangularSizes:
    driver, (zp, zr), rho, half_angles, excess, *_ = PAIRS[name]
    beta_p, beta_r = map(radians, half_angles)
    ratio = equal_depth(zp, zr, beta_p, beta_r, 2)[1] if rho is None else rho * zr / zp
    sizes = TriangularSizes(zp, zr, 1.0, ratio, beta_p, beta_r, excess, 2)
    return sizes if driver == "pinion" else sizes.swapped()


@pytest.mark.parametrize("name", PAIRS)
def test_a_pair_with_a_ring_has_the_reference_sizes_window_and_verdict(name: str) -> None:
    *_, lengths, window, (kind, backlash) = PAIRS[name]
    sizes = pair(name)
    transmission = TriangularTransmission(sizes)
    assert (max(sizes.radii) / min(sizes.radii), sizes.D) == pytest.approx(lengths[:2], abs=6e-11)
    assert degrees(sizes.reach1) == pytest.approx(lengths[2], abs=6e-9)
    assert transmission.verdict.kind == kind
    assert degrees(transmission.verdict.backlash) == pytest.approx(backlash, abs=6e-10)
    found = find_window(sizes)
    assert bool(found) == (window is not None)
    if window:
        assert (found.jam, found.run) == pytest.approx(window[:2], abs=6e-10)
        assert (found.jam_kind, found.run_kind) == ("jam", window[2])


@pytest.mark.parametrize("name", FIGURES)
def test_a_pair_with_a_ring_has_the_reference_motion_and_losses(name: str) -> None:
    intervals, speeds, peak, errors, (driver, load_), jumps = FIGURES[name]
    transmission = TriangularTransmission(pair(name), 0.2)
    assert {each.phase for each in transmission.intervals} == {phase for phase, _, _ in intervals}
    for each in transmission.intervals:
        ((start, end),) = [ends for phase, *ends in intervals if phase == each.phase]
        assert (degrees(each.start), degrees(each.end)) == pytest.approx((start, end), abs=1.1e-8)
    assert np.array(transmission.speed_range()) / float(transmission.ratio) == pytest.approx(speeds, abs=6e-11)
    low, high = transmission.error_range()
    assert degrees(high - low) == pytest.approx(peak, abs=6e-11)
    at = np.degrees(transmission.error(np.array([0, 0.25, 0.5, 0.75]) * transmission.period))
    assert at == pytest.approx(errors, abs=6e-10)
    assert transmission.efficiency_mean() == pytest.approx(driver, abs=6e-11)
    assert transmission.efficiency_at_constant_load() == pytest.approx(load_, abs=6e-11)
    assert sorted(jump.value for jump in transmission.jumps) == pytest.approx(sorted(jumps), abs=6e-10)


def test_figures_of_pairs_that_do_not_run() -> None:
    clash, idle, stands = (TriangularTransmission(pair(name)).contact for name in ("I17", "I18", "I19"))
    assert degrees(clash.dragged.clash) == pytest.approx(0.0105459290, abs=6e-11)
    assert (degrees(idle.idle), degrees(idle.lost)) == pytest.approx((0.0105459290, 0.0467052895), abs=6e-11)
    assert (degrees(stands.idle), degrees(stands.lost)) == pytest.approx((0.4204070996, 0.1528032784), abs=6e-11)


# driver; distance of the axis from the tips; tau over its mean; error peak to peak; error at 0, 1/4, 1/2, 3/4 of a
# pitch; mean efficiencies; jump; play. Errors and play in pitches of the rack, where the rack drives in deg
RACKS: dict[str, tuple[Any, ...]] = {
    "R1": ("pinion", 0.9, (0.8722586411, 1.2047947300), 0.0405704812,
           (0.1968628138, 0.2255243857, 0.2280810839, 0.2122813681), (0.9549313577, 0.9502578546), 0.2760105773,
           0.5438378323),
    "R2": ("rack", 0.9, (0.8300169108, 1.1464489463), 0.7302686620,
           (3.7489885959, 4.0915349395, 4.0810571520, 3.6804774569), (0.9642342199, 0.9658974482), 0.2760105773,
           9.8378856960),
    "R3": ("pinion", 0.85, (0.8418349993, 1.2552278126), 0.0501491011,
           (0.3736222853, 0.3765567873, 0.3569622156, 0.3383549122), (0.9344148193, 0.9267595872), 0.3293368814,
           0.2527554293),
}  # fmt: skip


def rack(driver: str, apart: float, ring: Literal[0, 2]) -> TriangularTransmission:
    count = 10**9
    sizes = TriangularSizes(20, count, 1.0, count / 20, radians(30), radians(30), 0.0, ring)
    sizes = sizes.at((min(sizes.depths) - (1 - apart)) / sizes.deepest_distance)
    return TriangularTransmission(sizes if driver == "pinion" else sizes.swapped(), 0.2)


@pytest.mark.parametrize("name", RACKS)
def test_a_rack_has_the_reference_figures(name: str) -> None:
    driver, apart, *expected = RACKS[name]
    unit = 10**9 / (2 * pi) if driver == "pinion" else 180 / pi

    def figures(ring: Literal[0, 2]) -> np.ndarray:
        transmission = rack(driver, apart, ring)
        low, high = transmission.error_range()
        at = transmission.error(np.array([0, 0.25, 0.5, 0.75]) * transmission.period)
        speeds = np.array(transmission.speed_range()) / float(transmission.ratio)
        losses = transmission.efficiency_mean(), transmission.efficiency_at_constant_load()
        angles = np.array([high - low, *at, transmission.verdict.backlash]) * unit
        return np.array([*speeds, *angles[:5], *losses, transmission.jumps[0].value, angles[5]])

    flat = np.hstack([np.ravel(each) for each in expected])
    assert (figures(0) + figures(2)) / 2 == pytest.approx(flat, abs=2e-10)


def random_pairs() -> list[TriangularSizes]:
    """Ten pairs of 8 to 40 teeth in rings of 1 to 60 more, unlike half angles and radii, within their windows."""
    rng, found = np.random.default_rng(43), []
    while len(found) < 10:
        zp, more = int(rng.integers(8, 41)), int(rng.integers(1, 61))
        beta = np.radians(rng.uniform(25, 38) + rng.uniform(-3, 3, 2))
        sizes = TriangularSizes(zp, zp + more, 1.0, float(rng.uniform(0.93, 1.02)) * (zp + more) / zp, *beta, 0.0, 2)
        try:
            window = find_window(sizes)
        except GearTrainError:
            continue
        if window and not sizes.at(window.at(0.5)).surrounds:
            found.append(sizes.at(window.at(float(rng.uniform(0.1, 0.9)))))
    return found


@pytest.mark.parametrize("driver", ["pinion", "ring"])
def test_polygons_touch_where_the_transmission_function_says(driver: str) -> None:
    """Front and back flanks, by halving the driven angle; outlines know no formula of the package."""
    rng = np.random.default_rng(7)
    for drawn in random_pairs():
        sizes = drawn if driver == "pinion" else drawn.swapped()
        transmission = TriangularTransmission(sizes)
        S = rng.uniform(0, 2 * pi, 6)
        upper = -transmission.error(S) - sizes.ratio * S
        lower = transmission.error(-S) - sizes.ratio * S - sizes.p2
        low, high = Judge.of(sizes).free(-S, (upper + lower) / 2, 0.75 * sizes.p2, 100)
        assert transmission.verdict.kind == "runs", sizes
        assert np.abs(high - upper).max() < 1e-10, sizes
        assert np.abs(low - lower).max() < 1e-10, sizes


def test_the_inverse_pair_undoes_the_pair() -> None:
    """q_rp(q_pr(S)) = S for mirrored contacts, and a loss is undone by friction of the other sign."""
    for drawn in random_pairs():
        tooth_pair, inverse = (
            TriangularTransmission(each).contact.path.tooth_pair for each in (drawn, drawn.swapped())
        )
        for x in np.linspace(-0.8, 0.8, 5) * drawn.reach1:
            y = tooth_pair.contact(float(x))
            assert -inverse.contact(-y) == pytest.approx(x, abs=1e-13)
            phase = "approach" if tooth_pair.angle("approach", x) <= tooth_pair.angle("recess", x) else "recess"
            back = "recess" if phase == "approach" else "approach"
            assert tooth_pair.speed(phase, x) * inverse.speed(back, -y) == pytest.approx(1, abs=1e-11)
            there, here = inverse.efficiency(back, -y, 0.15), tooth_pair.efficiency(phase, x, -0.15)
            assert here * there == pytest.approx(1, abs=1e-10)


def test_the_contact_of_drawn_outlines_confirms_a_design_with_a_ring() -> None:
    design = ToothSizes((20, 60), 0.95, 0.5, (pi / 6, pi / 6), 0.2, 1, 2)
    found = find_tooth_sizes(design, free={"radii": (0.95, 0.951)}).outlines
    assert found.turns
    assert found.difference < 1e-4


def test_the_force_between_the_axes_is_that_of_the_drawn_normal() -> None:
    """Where the normal in the picture passes the driven centre, and how it leans, at 2,000 positions of a pitch."""
    for driver in ("p", "r"):
        train = load(f"""
links: {{frame: {{}}, a: {{wheels: {{p: 20}}}}, b: {{wheels: {{r: {{teeth: 60, internal: true}}}}}}}}
revolutes: {{A: [frame, a], B: [frame, b]}}
gears: [{{pair: [p, r], driver: {driver}}}]
tooth_form: {{form: triangular, half_angle: 30 deg, window: 0.5}}
inputs: {{a: 1}}
""")
        (mesh,) = train.meshes
        sizes, found = mesh.transmission.sizes, []
        for x in mesh.transmission.alpha1((np.arange(2_000) + 0.5) / 2_000 * mesh.transmission.period):
            here = tooth_pair_pose(mesh.transmission, float(x))
            (px, py), (nx, ny) = here.contact, here.normal
            arm = abs((px - here.axis2) * ny - py * nx)
            centre = mesh.transmission.contact.path.tooth_pair.instant_centre(here.phase, float(x))
            assert here.centre[0] == pytest.approx(centre, rel=1e-9)
            found.append(sizes.D * sizes.z2 / 40 / arm * abs(nx))
        assert mesh.separation == pytest.approx(float(np.mean(found)), rel=1e-4)


def planetary(counts: tuple[int, int, int], beyond: float, distance: float, held: str, driver: str) -> GearTrain:
    """Module 1, half angle 30 degrees, tips `beyond` their pitch circles, friction 0.2."""
    (zs, zp, zr), tips = counts, [z / 2 + side * beyond for z, side in zip(counts, (1, 1, -1), strict=True)]
    form = f"form: triangular, half_angle: 30 deg, centre_distance: {distance}"
    out = next(each for each in ("carrier", "sun", "ring") if each not in (held, driver))
    return load(f"""
name: planetary
links:
  frame: {{}}
  sun: {{wheels: {{s: {zs}}}}}
  planet: {{wheels: {{p: {zp}}}}}
  ring: {{wheels: {{r: {{teeth: {zr}, internal: true}}}}}}
  carrier: {{}}
revolutes: {{main: [frame, sun, ring, carrier], P: [carrier, planet]}}
gears:
  - {{pair: [s, p], tooth_form: {{{form}, radii: {tips[:2]}}}}}
  - {{pair: [p, r], tooth_form: {{{form}, radii: {tips[1:]}}}}}
friction: 0.2
fixed: [{held}]
inputs: {{{driver}: 1}}
outputs: {{out: {{of: {out}}}}}
loads: {{{out}: {1 if held == "carrier" else -1}}}  # against its turning
""")


# counts, tips beyond the pitch circles, distance; held, driver; error peak to peak (deg); speed over its mean;
# efficiency at constant load, and at constant torque of the driver
SETS: dict[str, tuple[Any, ...]] = {
    "P1": ((24, 18, 60), 0.6, 21, "ring", "sun", 0.244168624, (0.84148058, 1.21413058), 0.958595070, 0.959440780),
    "P2": ((24, 18, 60), 0.6, 21, "ring", "carrier", 0.854590185, (0.82363464, 1.18838155), 0.960837078, 0.961060388),
    "P3": ((24, 18, 60), 0.6, 21, "carrier", "sun", 0.341836074, (0.79130566, 1.32786520), 0.941212916, 0.943217092),
    "P4": ((24, 18, 60), 0.65, 21.1, "ring", "sun", 0.198523208, (0.86281148, 1.19237006), 0.955056925, 0.955310987),
    "P5": ((30, 15, 60), 0.55, 22.5, "ring", "sun", 0.130215742, (0.86201630, 1.14531352), 0.958197628, 0.959134181),
}


@pytest.mark.parametrize("name", SETS)
def test_a_planetary_set_has_the_reference_motion_and_efficiency(name: str) -> None:
    counts, beyond, distance, held, driver, peak, speeds, efficiency, driven = SETS[name]
    train = planetary(counts, beyond, distance, held, driver)
    motion = train.motion()
    assert motion.period is not None
    span = np.linspace(0, float(motion.period), 2_001)

    def extreme(sign: int) -> float:
        """The maximum of the error, times a sign, zoomed in on: it may be at a kink."""
        turns = span
        for _ in range(3):
            error = sign * motion.at(turns).error[0]
            at, step = turns[error.argmax()], turns[1] - turns[0]
            turns = np.linspace(at - step, at + step, 2_001)
        return float(error.max())

    assert degrees(extreme(1) + extreme(-1)) == pytest.approx(peak, abs=6e-10)
    ripple = motion.transmission_errors(float(motion.period), 20_001)["out"]
    relative = sorted(float(each) / ripple.mean for each in (ripple.speed.min(), ripple.speed.max()))
    assert relative == pytest.approx(speeds, abs=1e-4)
    out = train.declaration.outputs["out"].of
    for loads, wanted in ((None, efficiency), ({"loads": {driver: 1}, "solve_for": out}, driven)):
        changed = train if loads is None else train.with_changes(**loads)
        cycle = changed.torques(turns=float(motion.period), of=driver if loads is None else out)
        assert cycle.efficiency == pytest.approx(wanted, abs=2e-9)


@pytest.mark.parametrize(
    ("form", "counts", "words"),
    [
        ({"clearance_factor": "1.02"}, (20, 60), ["1.02", "maximum, in a ring", "below 1"]),
        ({"clearance_factor": "0.98"}, (20, 60, 0), ["0.98", "minimum", "above 1"]),
        ({"window": "0.5", "radii": "equal_depth"}, (20, 60), ["no clearance", "pitch_true"]),
        ({"window": "0.5"}, (60, 60), ["a ring of 60 teeth cannot contain a wheel of 60 teeth"]),
        ({"excess": "0.9", "radii": "0.9"}, (20, 21), ["overlap at every angle"]),
        ({"backlash": "0.05", "radii": ["18", "10"]}, (20, 60), ["overlap at every angle"]),
    ],
)
def test_what_no_ring_can_have_is_refused(form: dict[str, str], counts: tuple[int, ...], words: list[str]) -> None:
    zp, zr, *rest = counts
    ring: Literal[0, 2] = 0 if rest else 2
    with pytest.raises(GearTrainError) as refused:
        Triangular.declared({"form": "triangular", "half_angle": "30 deg"} | form).sizes(zp, zr, ring=ring)
    assert all(word in str(refused.value) for word in words), str(refused.value)


def test_the_radii_of_a_pair_with_a_ring_are_pitch_true_unless_declared() -> None:
    form = Triangular.declared({"form": "triangular", "half_angle": "30 deg", "window": "0.5"})
    assert form.sizes(20, 60, ring=2).R2 == 3.0
    assert equal_depth(20, 60, radians(30), radians(30))[1] == form.sizes(20, 60).R2


def test_the_shipped_set_repeats_over_21_degrees_of_the_sun() -> None:
    train = load("planetary-24-18-60-triangular")
    assert train.motion(outputs=["carrier"]).period == Fraction(21, 360)
    assert train.torques(turns=21 / 360).efficiency == pytest.approx(0.958595070, abs=1e-9)
