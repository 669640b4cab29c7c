"""What of a declared train cannot be built: each rule by trains that break it and trains that keep it."""

from __future__ import annotations

import re
from math import atan, cos, pi, radians, tan

import pytest
from commands import imported_by
from shipped import every_train

from geartrain import load
from geartrain.errors import GearTrainError

PAIR = """
links: {{frame: {{}}, a: {{wheels: {{a20: {first}}}}}, b: {{wheels: {{b40: {second}}}}}}}
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}]
gears: [{{pair: [a20, b40]}}]
inputs: {{a: 1}}
{more}
"""
COAXIAL = """
links:
  frame: {{}}
  a: {{wheels: {{a20: {a20}, a30: {a30}}}}}
  b: {{wheels: {{b40: {b40}}}}}
  c: {{wheels: {{c50: {c50}}}}}
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}, {{pair: [frame, c], axis: B}}]
gears: [{{pair: [a20, b40]}}, {{pair: [a30, c50]}}]
inputs: {{a: 1}}
{more}
"""
PLANETARY = """
links:
  frame: {{wheels: {{ring: {{teeth: {ring}, internal: true}}}}}}
  sun: {{wheels: {{s: {sun}}}}}
  planet: {{wheels: {{p: {planet}}}}}
  carrier: {{}}
revolutes: {{main: [frame, sun, carrier], P: [carrier, planet]}}
gears: [{{pair: [s, p]}}, {{pair: [p, ring]}}]
inputs: {{sun: 1}}
{more}
"""
RING = """
links: {{frame: {{}}, a: {{wheels: {{p: {planet}}}}}, b: {{wheels: {{r: {{teeth: {ring}, internal: true}}}}}}}}
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}]
gears: [{{pair: [p, r]}}]
inputs: {{a: 1}}
{more}
"""


def pair(first: object = 20, second: object = 40, more: str = "") -> str:
    return PAIR.format(first=first, second=second, more=more)


def coaxial(a20: object = 20, b40: object = 40, a30: object = 30, c50: object = 50, more: str = "") -> str:
    return COAXIAL.format(a20=a20, b40=b40, a30=a30, c50=c50, more=more)


def planetary(sun: int = 24, planet: int = 18, ring: int = 60, more: str = "") -> str:
    return PLANETARY.format(sun=sun, planet=planet, ring=ring, more=more)


def found(text: str) -> list[tuple[str, str]]:
    """Rules that a train breaks, with their level; each has a place, a reason and a cure."""
    findings = load(text).build_findings
    for finding in findings:
        problem = finding.problem
        assert all((problem.place, problem.what, problem.why, problem.fix)), finding
    return [(finding.rule, finding.level) for finding in findings]


def words(text: str) -> str:
    return " ".join(map(str, load(text).build_findings))


def sized(teeth: int, module: str) -> str:
    return f"{{teeth: {teeth}, module: {module}}}"


def places(**x: str) -> str:
    entries = (f"{label}: {{position: [{value}, 0 mm, 0 mm]}}" for label, value in x.items())
    return f"axes: {{{', '.join(entries)}}}"


def mm(teeth: int, module: int = 1) -> str:
    return sized(teeth, f"{module} mm")


def chain(a: object = 20, c: object = 40, more: str = "") -> str:
    return CHAIN.format(a=a, c=c, more=more)


def ring(planet: object, ring: int, more: str = "") -> str:
    return RING.format(planet=planet, ring=ring, more=more)


def apart(distance: str, form: str = "", first: object = mm(20), second: object = mm(40)) -> str:
    return pair(first, second, places(A="0 mm", B=f"{distance} mm") + (f"\ntooth_form: {form}" if form else ""))


def kind(name: str, teeth: int = 20) -> str:
    return f"{{teeth: {teeth}, kind: {name}}}"


def helical(teeth: int, angle: int = 45, more: str = "hand: right") -> str:
    return f"{{teeth: {teeth}, helix_angle: {angle} deg, {more}}}"


def leaning(distance: str, form: str = "") -> str:
    first, second = (helical(z, 30, f"hand: {hand}, module: 2 mm") for z, hand in ((20, "right"), (40, "left")))
    return apart(distance, form, first, second)


def skew(first: object, second: object, distance: str = "7") -> str:
    return pair(first, second, PASS.replace("7 mm", f"{distance} mm"))


CHAIN = """
links: {{frame: {{}}, a: {{wheels: {{a: {a}}}}}, b: {{wheels: {{b: 30}}}}, c: {{wheels: {{c: {c}}}}}}}
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}, {{pair: [frame, c], axis: C}}]
gears: [{{pair: [a, b]}}, {{pair: [b, c]}}{more}]
inputs: {{a: 1}}
"""
FLAT = "axes: {A: {direction: [0, 0, 1]}, B: {direction: [0, 0, 1]}}"
CROSSED = "axes: {A: {direction: [1, 0, 0]}, B: {direction: [0, 0, 1]}}"
MEET = "axes: {A: {direction: [1, 0, 0], position: [9 mm, 0 mm, 0 mm]}, B: {position: [0 mm, 0 mm, 4 mm]}}"
PASS = MEET.replace("9 mm, 0 mm", "9 mm, 7 mm")
INVOLUTE = "tooth_form: {form: involute}"
SCREW = "{teeth: 2, kind: worm, helix_angle: 80 deg, hand: right, module: 2 mm}"
SIZED = {"a20": mm(20), "b40": mm(40), "a30": mm(30)}
SPARE = pair().replace("a20: 20}", "a20: 20, spare: 33}")

# a train, the rules that it breaks (`!` an error, `?` a note), and what is said of them
TRAINS = [
    # mates have one module, also through other mates, and in mm without a unit
    (pair(mm(20), mm(40, 2)), "M1!", "'a20' has module 1 mm and 'b40' has module 2 mm"),
    *((text, "") for text in (pair(mm(20), sized(40, "0.1 cm")), pair(mm(20)), pair(sized(20, "1"), mm(40)))),
    (chain(mm(20), mm(40, 2)), "M1!", "'b' has module 1 mm through its other mates and 'c' has module 2 mm"),
    (chain(mm(20), mm(40)), ""),
    (apart("40", second=40), "M2!", "40 mm apart", "need 30 mm", "must be 1.33333 mm"),
    (apart("30", second=40), ""),
    (apart("40", "", 20, 40), ""),
    # declared places agree with radii
    (apart("100"), "P1!", "their pitch circles are 70 mm apart"),
    (apart("20"), "P1!", "their pitch circles overlap by 10 mm"),
    (apart("30.00002"), ""),  # a millionth of the radii, as positions are rounded
    *((apart(each), "P1?") for each in ("30.01", "30.5", "29.5")),  # half a module: shifted profiles
    (apart("30.05", "involute"), "P1?", "0.036397 mm more backlash"),  # measured on outlines: 0.0352
    (apart("29.99", "involute"), "P1?"),
    (apart("29.95", "involute"), "P1!"),  # such teeth jam
    (apart("30.01", "cycloidal"), "P1?"),
    (apart("30.05", "cycloidal"), "P1!"),
    *((apart("30.5", f"{{form: involute, centre_distance: {each}}}"), "") for each in ("30.5 mm", "30.5")),
    (apart("30.05", "{form: triangular, half_angle: 30 deg, clearance_factor: 1.01}"), "P1?"),
    (leaning("69.282032"), ""),  # 2 (20 + 40)/2 / cos 30 deg
    (leaning("69.282032", "{form: involute, shift: [0.3, -0.3]}"), ""),
    (leaning("60.282032"), "P1!"),
    # no module is declared: the first two axes give it
    (chain() + places(A="0 mm", B="50 mm", C="120 mm"), ""),
    (chain() + places(A="0 mm", B="50 mm", C="150 mm"), "P1!"),
    # pairs between two axes have one distance; wheels that do not mesh may have two modules
    (coaxial(**SIZED, c50=mm(50)), "P2!", "30 mm and 40 mm", "their sum by 20"),
    *((coaxial(**SIZED, c50=mm(teeth)), said) for teeth, said in ((30, ""), (31, "P2?"), (32, "P2?"), (33, "P2!"))),
    (coaxial(), ""),
    (coaxial(a20=mm(20), a30=sized(30, "0.75 mm")), ""),
    (coaxial(a20=mm(20), a30=mm(30)), "P2!"),
    (planetary(), ""),
    (planetary(ring=62), "P2?"),
    (planetary(ring=70), "P2!", "pinion"),
    (planetary(ring=62, more=INVOLUTE), "P2?"),
    (planetary(ring=58, more=INVOLUTE), "P2!"),  # the sun requires a distance of at least 21, and the ring at most 20
    # a ring is larger than its planet, and standard tips pass those of the ring
    *((ring(20, z), "R1!", f"ring 'r' ({z} teeth) is too small for wheel 'p' (20 teeth)") for z in (3, 16, 20)),
    *((ring(p, z), "") for p, z in ((20, 60), (43, 60), (64, 80), (84, 100), (33, 50), (17, 34))),
    *((ring(p, z), "R3?") for p, z in ((51, 60), (92, 100), (44, 60), (65, 80), (85, 100), (34, 50), (18, 34))),
    (ring(53, 60), "R2?"),
    (ring(53, 60, INVOLUTE), ""),  # declared teeth are judged by their own outlines
    (ring(198, 200), "R2?"),
    *((ring(f"{{teeth: {p}, flexible: true}}", z), "") for p, z in ((198, 200), (92, 100))),
    (ring("{teeth: 200, flexible: true}", 200), "R1!"),
    # kinds go with axes and with each other
    *((pair(20, 40, axes), said) for axes, said in (("", ""), (FLAT, ""), (CROSSED, "K1!"))),
    *((pair(kind("bevel"), kind("bevel", 40), axes), "") for axes in (CROSSED, MEET)),
    *((pair(kind("bevel"), kind("bevel", 40), axes), said) for axes, said in (("", "K1?"), (FLAT, "K1!"))),
    (pair(kind("bevel"), kind("bevel", 40), PASS), "K1!", "pass each other at a distance of 7 mm"),
    *((pair(kind("contrate"), 40, axes), said) for axes, said in ((CROSSED, ""), (FLAT, "K1!"))),
    *((pair(kind("worm", 1), 40, axes), said) for axes, said in ((PASS, ""), (MEET, "K1!"), (FLAT, "K1!"))),
    *((pair(kind("bevel"), 40, axes), "K2!") for axes in (CROSSED, "")),
    *((pair(kind("contrate"), kind(each, 40), CROSSED), "K2!") for each in ("contrate", "bevel")),
    (pair(kind("worm", 1), kind("bevel", 40), PASS), "K2!"),
    *((pair(helical(20), helical(40), axes), said) for axes, said in ((PASS, ""), (MEET, "K1!"))),
    # axes pass each other at the sum of pitch radii: 1.5 (20 + 40)/(2 cos 45); without a module at any distance
    *(
        (skew(helical(20, more="hand: right, module: 1.5 mm"), helical(40), distance), said)
        for distance, said in (("63.639610307", ""), ("63.65", "K4?"), ("60", "K4!"))
    ),
    (skew(helical(20), helical(40), "60"), ""),
    (skew(SCREW, helical(40, 10), "52.134605442"), ""),  # 2/(2 sin 10) * 2 = 11.51754 and 2 * 40/(2 cos 10) = 40.61706
    (skew(SCREW, helical(40, 10), "40"), "K4!", "are 40 mm apart, but the pair needs 52.1346 mm"),
    # locks join links of one axis, and brakes hold what turns about an axis of the frame, or all that carries it
    (coaxial(more="locks: [[b, c]]"), ""),
    (coaxial(more="locks: [[a, b]]"), "G1!", "across the axes 'A' and 'B'"),
    *((planetary(more=f"locks: [[{each}]]"), "") for each in ("planet, carrier", "sun, carrier")),
    (planetary(more="locks: [[planet, sun]]"), "G1!"),
    (planetary(more="fixed: [planet]"), "G2!", "fix 'carrier'"),
    *((planetary(more=f"fixed: [{each}]"), "") for each in ("carrier", "planet, carrier")),
    # a wheel without a mate may be of the escapement
    (SPARE, "W1?", "wheel 'spare' is not in mesh"),
    (SPARE.replace("33", "{teeth: 33, note: survives without a mate}"), ""),
    (SPARE + "escapement: {link: a, teeth: 33, beat: 1 s}", ""),
    (SPARE + "escapement: {link: a, teeth: 30, beat: 1 s}", "W1?"),
]


@pytest.mark.parametrize("case", TRAINS)
def test_what_cannot_be_built_is_found(case: tuple[str, ...]) -> None:
    text, rule, *said = case
    assert found(text) == ([(rule[:-1], {"!": "error", "?": "note"}[rule[-1]])] if rule else [])
    assert all(each in words(text) for each in said)


def distance_of(total: float, teeth: int, slant: float = 1.0) -> float:
    """Distance (normal modules) of involutes of 20 deg whose shifts sum to `total`, by bisection of the equation."""
    normal = radians(20)
    across = atan(tan(normal) * slant)
    wanted = tan(across) - across + 2 * tan(normal) * total / teeth
    low, high = 0.0, pi / 2
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if tan(middle) - middle < wanted else (low, middle)
    return teeth / 2 * slant * cos(across) / cos(low)


def test_the_sum_of_shifts_of_a_catalogue_stage() -> None:
    """Printed: 53 mm, 23 and 67 teeth of 1 mm leaning 30 deg; 1.094 = sum of its profile shifts."""
    assert distance_of(1.0943, 90, 1 / cos(radians(30))) == pytest.approx(53, abs=1e-3)


@pytest.mark.parametrize(
    ("total", "level"), [(-1.01, "error"), (-0.99, "note"), (0.63, "note"), (1.99, "note"), (2.01, "error")]
)
@pytest.mark.parametrize("helix", [0, 30])
def test_undeclared_teeth_are_shifted_to_the_distance_of_the_positions(total: float, level: str, helix: int) -> None:
    """The fix names the sum, and the train that declares it has no error."""
    slant = 1 / cos(radians(helix))
    lean = [f"{{teeth: {z}, module: 1 mm, helix_angle: {helix} deg, hand: {hand}}}"
            for z, hand in ((20, "right"), (40, "left"))]  # fmt: skip
    wheels = lean if helix else [sized(20, "1 mm"), sized(40, "1 mm")]
    text = pair(*wheels, more=places(A="0 mm", B=f"{distance_of(total, 60, slant):.6f} mm"))
    assert found(text) == [("P1", level)]
    assert (f"the sum of the shifts must be {total:.4g}" in words(text)) == (level == "note")
    if level == "note":
        (form,) = re.findall(r"`(tooth_form: [^`]*)`", words(text))
        assert found(f"{text}\n{form}") in ([], [("P1", "note")])


def test_a_ring_is_shifted_against_its_mate() -> None:
    """inv a_w = inv a + 2 tan a (x_ring - x_mate)/(z_ring - z_mate): 20 in 60 with a difference of 0.8."""
    text = RING.format(planet=sized(20, "1 mm"), ring=60, more=places(A="0 mm", B=f"{distance_of(0.8, 40):.6f} mm"))
    text = text.replace("{teeth: 60", "{teeth: 60, module: 1 mm")
    assert found(text) == [("P1", "note")]
    assert "the shift of 'r' minus that of 'p', which `pair` names first, must be 0.8" in words(text)
    assert found(f"{text}\ntooth_form: {{form: involute, shift: [0, 0.8]}}") in ([], [("P1", "note")])


def test_declared_teeth_that_cannot_reach_are_an_error_that_names_the_shifts() -> None:
    far = pair(sized(20, "1 mm"), sized(40, "1 mm"), more=places(A="0 mm", B=f"{distance_of(1, 60):.6f} mm"))
    involute, cycloidal = (words(f"{far}\ntooth_form: {form}") for form in ("involute", "cycloidal"))
    assert found(f"{far}\ntooth_form: involute") == found(f"{far}\ntooth_form: cycloidal") == [("P1", "error")]
    assert "declare `shift: [0.5, 0.5]`: the sum of the shifts must be 1" in involute
    assert "shift" not in cycloidal


def test_shifted_involutes_are_held_against_their_own_distance() -> None:
    """x1 + x2 = 0.5 on 20 and 40 teeth: inv a_w = inv 20 deg + 2 tan 20 deg 0.5/60, so a = 30.4826 (by hand)."""
    form = "\ntooth_form: {form: involute, shift: [0.5, 0]}"
    at = {far: found(pair(sized(20, "1 mm"), sized(40, "1 mm"), more=places(A="0 mm", B=far) + form)) for far in
          ("30 mm", "30.4826 mm", "30.47 mm")}  # fmt: skip
    assert at["30 mm"] == [("P1", "error")]
    assert at["30.47 mm"] == [("P1", "note")]
    assert at["30.4826 mm"] in ([], [("P1", "note")])


def test_three_axes_keep_the_triangle_inequality() -> None:
    loop = ", {pair: [c, a]}"
    assert found(CHAIN.format(a=20, c=40, more=loop)) == []
    text = (
        CHAIN.format(a=20, c=40, more="")
        .replace("{b: 30}", "{b: 4}")
        .replace("c: {wheels: {c: 40}}", "c: {wheels: {c: 4}}")
    )
    text = (
        text.replace("gears: [", "gears: [{pair: [a9, c9]}, ")
        .replace("{a: 20}", "{a: 4, a9: 60}")
        .replace("{c: 4}", "{c: 4, c9: 60}")
    )
    assert found(text) == []  # a9 and c9 may have a module of their own
    text = text.replace("a: 4,", "a: {teeth: 4, module: 1 mm},").replace("a9: 60", "a9: {teeth: 60, module: 1 mm}")
    assert found(text) == [("P3", "error")]
    assert "4 mm + 4 mm is less than 60 mm" in words(text)


@pytest.mark.parametrize(("keys", "what"), [("internal: true", "a ring"), ("kind: bevel", "a bevel wheel")])
def test_only_a_spur_wheel_is_bent(keys: str, what: str) -> None:
    with pytest.raises(GearTrainError, match=f"{what} cannot be flexible"):
        load(pair(f"{{teeth: 20, flexible: true, {keys}}}"))


def test_the_shipped_strain_wave_has_no_remark_on_its_tips() -> None:
    assert [each.rule for each in load("strain-wave").build_findings if each.rule in ("R1", "R2", "R3")] == []


def test_a_clutch_is_told_once_for_all_states_with_its_place() -> None:
    more = "clutches: {K: {locks: [planet, sun]}}\nstates: {low: {engaged: [K]}, high: {engaged: [K]}}"
    (finding,) = load(planetary(more=more)).build_findings
    assert finding.rule == "G1"
    assert "by K" in finding.problem.what
    assert finding.problem.place.startswith("text:")


SPIDER = """
frame: case
axes: {axle: {direction: [1, 0, 0]}, spider: {direction: [0, 1, 0]}}
links:
  case: {}
  crown: {}
  left: {wheels: {l: {teeth: 16, kind: bevel}}}
  right: {wheels: {r: {teeth: 16, kind: bevel, facing: -1}}}
  spider: {wheels: {p: {teeth: 10, kind: bevel}}}
revolutes: {axle: [case, crown, left, right], spider: [crown, spider]}
gears: [l ~ p, r ~ p]
inputs: {left: 1, right: 3}
"""


def test_a_differential_whose_bevels_face_one_side_is_refused_with_the_side_to_give() -> None:
    assert found(SPIDER) == []
    assert load(SPIDER).solve()["crown"] == 2  # the mean of both
    wrong = SPIDER.replace(", facing: -1", "")
    assert found(wrong) == [("K5", "error")]
    (finding,) = load(wrong).build_findings
    assert "`facing: -1`" in finding.problem.fix
    verdict = load(wrong).solve().verdict
    assert verdict.kind == "contradictory"
    assert "'l' and 'r' meet 'p' from the same side: give one of them `facing: -1`" in verdict.text


@pytest.mark.parametrize("way", [1, -1])
@pytest.mark.parametrize(("left", "right"), [(1, 1), (1, -1), (-1, 1), (-1, -1)])
def test_bevels_of_one_axis_need_opposite_sides_whichever_way_it_points(way: int, left: int, right: int) -> None:
    text = SPIDER.replace("direction: [1, 0, 0]", f"direction: [{way}, 0, 0]")
    text = text.replace("l: {teeth: 16, kind: bevel}", f"l: {{teeth: 16, kind: bevel, facing: {left}}}")
    text = text.replace("facing: -1}}}\n  spider", f"facing: {right}}}}}}}\n  spider")
    assert found(text) == ([("K5", "error")] if left == right else [])


@pytest.mark.parametrize(
    ("counts", "first", "second", "how"),
    [
        ((20, 40), "{form: involute}", "{form: involute}", ""),  # one flank for all mates
        ((20, 40), "{form: involute, backlash: 0.1}", "{form: involute, addendum: [1, 0.9], backlash: 0.1}", ""),
        ((20, 40), "{form: involute}", "{form: involute, pressure_angle: 25 deg}", "involute flanks of two shapes"),
        ((20, 40), "{form: involute}", "{form: involute, addendum: [1.2, 1]}", "tips 16 and 16.2 modules"),
        ((20, 40), "{form: involute}", "{form: cycloidal}", "involute teeth and cycloidal teeth"),
        # epicycloids that circles of a quarter of the mate's teeth roll
        ((20, 20), "{form: cycloidal}", "{form: cycloidal}", ""),
        ((20, 40), "{form: cycloidal, addendum: 0.3}", "{form: cycloidal, addendum: 0.3}", "cycloidal flanks of two"),
        ((20, 40), "", "{form: cycloidal}", ""),  # a pair without a form asks for nothing
    ],
)
def test_a_wheel_has_teeth_of_one_shape(counts: tuple[int, int], first: str, second: str, how: str) -> None:
    forms = (f", tooth_form: {form}" if form else "" for form in (first, second))
    text = CHAIN.format(a=counts[0], c=counts[1], more="")
    for named, form in zip(("[a, b]", "[b, c]"), forms, strict=True):
        text = text.replace(f"{{pair: {named}}}", f"{{pair: {named}{form}}}")
    assert found(text) == ([("W3", "note")] if how else [])
    if how:
        assert "wheel 'b' is not cut: pairs 'a~b' and 'b~c' require different teeth; they require" in words(text)
        assert how in words(text)


@pytest.mark.parametrize("name", every_train())
def test_no_shipped_train_is_impossible(name: str) -> None:
    assert [finding for finding in load(name).build_findings if finding.is_error] == []


def test_the_check_of_a_plain_train_brings_no_array_library() -> None:
    used = imported_by("import geartrain; assert geartrain.load('norton-compound').build_findings")
    assert not used & {"scipy", "matplotlib", "networkx", "numpy"}
