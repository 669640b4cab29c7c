"""Evidence of a train that is to be found, also with a carrier: what is read of it, and what is refused."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest

from geartrain import GearTrain, GearTrainError, load, shipped
from geartrain.search.reconstruct import EvidenceQuestion, PriorFactors, evidence_question, read_evidence

SOUND = """\
links:
  frame: {}
  a: {wheels: {p: 20}}
  b:
    wheels:
      v: {teeth: {value: 30, range: [30, 32]}, status: surviving}
      w: 40
inputs: {a: 1}
outputs:
  sun: {expect: 1/3}
reconstruct:
  add: {wheels: 2, teeth: [10, 20]}
"""


# arbors on a carrier
CARRIED = """\
links:
  frame: {wheels: {x: 51}}
  b: {}
  p: {wheels: {p1: 20, p2: 30}}
  n: {wheels: {n1: 48}}
inputs: {b: 3}
revolutes: [{pair: [frame, b], axis: B}, {pair: [frame, n], axis: B}, {pair: [b, p], axis: P}]
outputs:
  nodes: {of: n, expect: -5/93}
  epicycle: {of: new, relative_to: b, expect: 1/2}
reconstruct:
  carrier: b
  add: {wheels: 2, teeth: [10, 20]}
"""


def changed(old: str, new: str) -> str:
    assert SOUND.count(old) == 1, old
    return SOUND.replace(old, new)


def carried(old: str, new: str) -> str:
    assert CARRIED.count(old) == 1, old
    return CARRIED.replace(old, new)


def ask(text: str) -> EvidenceQuestion:
    return evidence_question(read_evidence(text))


def test_what_is_requested() -> None:
    problem = ask(SOUND).problem
    assert problem.input.name == "a"
    assert [arbor.name for arbor in problem.arbors] == ["b"]
    assert problem.arbors[0].wheels[0].counts == tuple((count, Fraction(1, 3)) for count in (30, 31, 32))
    assert problem.arbors[0].wheels[1].is_sure
    dial = problem.dials[0]
    assert (dial.name, dial.minimum, dial.maximum, dial.signed, dial.place) == (
        "sun",
        Fraction(1, 3),
        Fraction(1, 3),
        True,
        None,
    )
    assert (problem.use, problem.idlers, problem.additions.on) == ("wheels", False, "any")
    assert problem.factors == PriorFactors()


def test_a_pointer_without_of_may_stand_anywhere_even_if_an_arbor_has_its_name() -> None:
    assert ask(changed("  sun:", "  b:")).problem.dials[0].place is None
    assert ask(changed("{expect", "{of: b, expect")).problem.dials[0].place == "b"
    assert ask(changed("{expect", "{of: new, expect")).problem.dials[0].place == "new"


def test_a_ring_is_taken_up() -> None:
    problem = ask(changed("      w: 40", "      w: {teeth: 40, internal: true}")).problem
    assert problem.rings == {"w"}
    assert [wheel.internal for wheel in problem.arbors[0].wheels] == [False, True]


def test_a_frame_need_not_be_listed() -> None:
    assert ask(changed("  frame: {}\n", "")).problem == ask(SOUND).problem


def test_all_of_the_block() -> None:
    block = """\
  add: {wheels: 3, arbors: 1, teeth: [10, 20], on: new}
  use: some
  sense: free
  idlers: true
  apart: [[p, w]]
  cost: {wheel: 5, arbor: 2.5, unused: 7}
gears: [{pair: [p, v]}]
"""
    problem = ask(changed("  add: {wheels: 2, teeth: [10, 20]}\n", block)).problem
    assert (problem.additions.wheels, problem.additions.arbors, problem.additions.on) == (3, 1, "new")
    assert (problem.use, problem.idlers, problem.dials[0].signed) == ("some", True, False)
    assert problem.apart == {frozenset("pw")}
    assert problem.meshes == {frozenset("pv")}
    assert problem.factors == PriorFactors(Fraction(5), Fraction(5, 2), Fraction(7))


@pytest.mark.parametrize(
    ("said", "limits", "signed"),
    [
        ("expect: 0.33", ("13/40", "67/200"), True),
        ("expect: {value: -1/3, tolerance: 1/30}", ("-11/30", "-3/10"), True),
        ("targets: [{speed: -1/3}]", ("-1/3", "-1/3"), True),
        ("targets: [{speed: -1/3, tolerance: 10 %}]", ("-11/30", "-3/10"), True),
        ("targets: [{period: 3 d, tolerance: 10 %}]", ("3/10", "11/30"), False),
        ("targets: [{period: 3 d, tolerance: 10 %, sense: retrograde}]", ("-11/30", "-3/10"), True),
        ("expect: -0.3, targets: [{period: 3 d, tolerance: 10 %}]", ("-7/20", "-3/10"), True),
        (
            "expect: {value: 1/10, tolerance: 3/10}, targets: [{period: 3 d, tolerance: 10 %}]",
            ("3/10", "11/30"),
            True,
        ),
    ],
)
def test_what_is_said_of_a_speed(said: str, limits: tuple[str, str], signed: bool) -> None:
    dial = ask("unit: {per: 1 d}\n" + changed("expect: 1/3", said)).problem.dials[0]
    assert (dial.minimum, dial.maximum, dial.signed) == (Fraction(limits[0]), Fraction(limits[1]), signed)


def test_arbors_on_one_axis_do_not_mesh() -> None:
    joints = "revolutes: [{pair: [frame, a], axis: B}, {pair: [b, frame], axis: B}]\n"
    assert ask(SOUND + joints).problem.coaxial == {frozenset("ab")}
    assert ask(SOUND).problem.coaxial == frozenset()


def test_the_sense_may_be_given_up() -> None:
    text = changed("1/3", "-1/3").replace("reconstruct:\n", "reconstruct:\n  sense: free\n")
    dial = ask(text).problem.dials[0]
    assert (dial.minimum, dial.maximum, dial.signed) == (Fraction(1, 3), Fraction(1, 3), False)


def test_all_is_seen_from_the_carrier() -> None:
    requested = ask(CARRIED)
    problem = requested.problem
    assert (requested.base.name, requested.base.speed, requested.base.source, requested.base.driven) == (
        "b",
        3,
        "frame",
        -3,
    )
    assert (problem.input.name, problem.input_speed) == ("frame", -3)
    assert [wheel.name for wheel in problem.input.wheels] == ["x"]
    assert [arbor.name for arbor in problem.arbors] == ["p", "n"]
    assert [dial.minimum for dial in problem.dials] == [Fraction(-5, 93) - 3, Fraction(1, 2)]
    assert problem.coaxial == {frozenset(("frame", "n"))}


def test_a_tolerance_and_a_sense_that_is_not_known() -> None:
    dial = ask(carried("1/2", "{value: 1/2, tolerance: 1/4}")).problem.dials[1]
    assert (dial.minimum, dial.maximum, dial.signed) == (Fraction(1, 4), Fraction(3, 4), True)
    dial = ask(carried("expect: -5/93", "expect: {value: -1/2, tolerance: 1/4}")).problem.dials[0]
    assert (dial.minimum, dial.maximum) == (Fraction(-15, 4), Fraction(-13, 4))
    text = carried("n: {wheels: {n1: 48}}\n", "\n").replace(", {pair: [frame, n], axis: B}", "")
    text = text.replace("  nodes: {of: n, expect: -5/93}\n", "").replace("  carrier", "  sense: free\n  carrier")
    assert not ask(text).problem.dials[0].signed


def test_a_link_that_is_driven_besides_the_carrier() -> None:
    text = carried("frame: {wheels: {x: 51}}", "sun: {wheels: {x: 51}}").replace("{b: 3}", "{b: 3, sun: -1/2}")
    requested = ask(text)
    assert (requested.base.source, requested.problem.input.name, requested.problem.input_speed) == (
        "sun",
        "sun",
        Fraction(-7, 2),
    )
    assert requested.problem.coaxial == {frozenset(("sun", "n"))}


MISTAKES = {
    "misspelt key": (changed("  add:", "  ad:"), 12, ["unknown key 'ad'", "did you mean 'add'?"]),
    "misspelt key of a part": (changed("{wheels: 2, t", "{wheel: 2, t"), 12, ["unknown key 'wheel'", "'wheels'"]),
    "no bounds": (changed(", teeth: [10, 20]", ""), 12, ["no range of tooth counts", "teeth: [12, 225]"]),
    "empty bounds": (changed("[10, 20]", "[20, 10]"), 12, ["the range 20 to 10 is empty"]),
    "negative number": (changed("{wheels: 2, t", "{wheels: -1, t"), 12, ["-1 is not a valid number of parts"]),
    "no such word": (
        changed("  add:", "  use: all\n  add:"),
        12,
        ["not one of the allowed values", "'wheels', 'arbors' or 'some'"],
    ),
    "no such wheel": (changed("  add:", "  apart: [[p, x]]\n  add:"), 12, ["no wheel 'x'"]),
    "a mesh that is none": (
        changed("  add:", "  apart: [[p, v]]\n  add:") + "gears: [{pair: [v, p]}]\n",
        12,
        ["and not"],
    ),
    "no such arbor": (changed("{expect", "{of: bb, expect"), 10, ["no link 'bb'", "did you mean 'b'?"]),
    "a link called new": (changed("  b:\n", "  new:\n"), 4, ["'new' is not allowed as the name of a surviving link"]),
    "no such factor": (
        changed("  add:", "  cost: {wheel: 0}\n  add:"),
        12,
        ["the value must be greater than 0, not 0"],
    ),
    "given to the frame": (changed("  add:", "  given: [{pair: [a, frame]}]\n  add:"), 12, ["lock an arbor"]),
    "given of nothing": (changed("  add:", "  given: [{pair: [a, c]}]\n  add:"), 12, ["no link 'c'"]),
    "a lock": (SOUND + "locks: [[a, b]]\n", 13, ["`locks` is not supported"]),
    "a bevel wheel": (changed("      w: 40", "      w: {teeth: 40, kind: bevel}"), 7, ["'w' is a bevel wheel, which"]),
    "a place beside a ring": (
        changed("      w: 40", "      w: {teeth: 40, internal: true}")
        + "  geometry: {}\naxes: {B: {position: [0 mm, 1 mm, 0 mm]}}\nrevolutes: [{pair: [frame, b], axis: B}]\n",
        14,
        ["the position of 'b' cannot be used as evidence, because 'w' is a ring gear", "remove the position"],
    ),
    "a moving axis": (SOUND + "revolutes: [{pair: [a, b], axis: B}]\n", 13, ["an arbor turns on a moving link"]),
    "seen from an arbor": (changed("{expect", "{relative_to: a, expect"), 10, ["is relative to 'a'"]),
    "no speed": (changed("{expect: 1/3}", "{}"), 10, ["the speed of 'sun' is not known"]),
    "no tolerance": ("unit: {per: 1 d}\n" + changed("expect: 1/3", "targets: [{period: 3 d}]"), 11, ["is not known"]),
    "two speeds": (changed("1/3", "1/3, targets: [{speed: 1/2, tolerance: 1 %}]"), 10, ["contradict each other"]),
    "two senses": (
        "unit: {per: 1 d}\n" + changed("1/3", "{value: 0, tolerance: 1/2}, targets: [{period: 3 d, tolerance: 10 %}]"),
        11,
        ["are two intervals", "keep only one"],
    ),
    "two inputs": (changed("{a: 1}", "{a: 1, b: 1}"), 8, ["2 links are driven"]),
    "no input": (changed("inputs: {a: 1}\n", ""), 1, ["0 links are driven"]),
}


MISTAKES |= {
    "no such link": (carried("carrier: b", "carrier: bb"), 12, "no link 'bb'"),
    "the frame": (carried("carrier: b", "carrier: frame"), 12, "the frame is not a carrier"),
    "a carrier of unknown speed": (carried("{b: 3}", "{p: 3}"), 12, "the speed of the carrier 'b' is not given"),
    "a carrier that stands still": (carried("{b: 3}", "{b: 0}"), 6, "the speed of the carrier 'b' is 0"),
    "two links besides": (carried("{b: 3}", "{b: 3, p: 1, n: 2}"), 6, "2 links are driven besides the carrier"),
    "a link and wheels of the frame": (carried("{b: 3}", "{b: 3, p: 1}"), 6, "'p' is driven, and the frame has wheels"),
    "a link as fast": (
        carried("frame: {wheels: {x: 51}}", "frame: {}").replace("{b: 3}", "{b: 3, p: 3}"),
        6,
        "'p' has the same speed as the carrier",
    ),
    "a link that stands still": (
        carried("frame: {wheels: {x: 51}}", "frame: {}").replace("{b: 3}", "{b: 3, p: 0}"),
        6,
        "the speed of the input 'p' is 0",
    ),
    "a wheel of the carrier": (carried("b: {}", "b: {wheels: {b1: 225}}"), 3, "'b1' is a wheel of the carrier"),
    "an arbor beside": (
        carried("{pair: [frame, n], axis: B}", "{pair: [frame, n], axis: N}"),
        7,
        "'n' turns in the frame",
    ),
    "a second carrier": (carried("{pair: [b, p], axis: P}", "{pair: [n, p], axis: P}"), 7, "second moving link"),
    "a pointer on the carrier": (carried("of: new", "of: b"), 10, "'epicycle' is on the carrier"),
    "seen from elsewhere": (carried("relative_to: b", "relative_to: n"), 10, "the frame or the carrier 'b'"),
    "a sense from the frame": (
        carried("  carrier", "  sense: free\n  carrier"),
        9,
        "the sense of 'nodes' is not known, and its speed is relative to the frame",
    ),
    "as the frame": (carried("of: n, expect: -5/93", "expect: 0"), 9, "'nodes' may be the speed of the frame"),
    "geometry": (carried("  carrier", "  geometry: {}\n  carrier"), 12, "`geometry` is not supported"),
    "given": (
        carried("  carrier", "  given: [{pair: [p, n]}]\n  carrier"),
        12,
        "'n' turns in the frame, but its coupling",
    ),
    "given of the frame": (carried("  carrier", "  given: [{pair: [p, frame]}]\n  carrier"), 12, "lock an arbor"),
    "no carrier": (carried("  carrier: b\n", ""), 2, "the frame has wheels, but no carrier is named"),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_is_reported_with_its_line(mistake: str, train_file: Callable[..., Path]) -> None:
    text, line, words = MISTAKES[mistake]
    with pytest.raises(GearTrainError) as caught:
        evidence_question(read_evidence(train_file(text, "evidence.yaml")))
    said = str(caught.value)
    for word in (*([words] if isinstance(words, str) else words), "fix:", f"evidence.yaml:{line}"):
        assert word in said, said


def test_what_backlashes_no_part_is_told() -> None:
    text = changed("      w: 40", "      w: {teeth: 40, module: 0.5 mm}")
    text = text.replace("expect: 1/3", "expect: 1/3, targets: [{period: 3 d}], published: 0.3333")
    text = text.replace("published: 0.3333", "published: {value: 0.3333}")
    text += "unit: {per: 1 d}\naxes: {B: {position: [0 mm, 1 mm, 0 mm]}}\nrevolutes: [{pair: [frame, b], axis: B}]\n"
    told = " ".join(ask(text).unused)
    assert "module of 'w'" in told
    assert "position of axis 'B'" in told
    assert "target of 'sun'" in told
    assert "`published` of 'sun'" in told


def test_the_number_of_wheels_and_idlers_may_be_requested_otherwise() -> None:
    evidence = read_evidence(SOUND)
    assert evidence_question(evidence, wheels=0).problem.additions.wheels == 0
    assert evidence_question(evidence, idlers=True).problem.idlers
    bare = read_evidence(changed("{wheels: 2, teeth: [10, 20]}", "{}"))
    assert evidence_question(bare).problem.additions.wheels == 0
    with pytest.raises(GearTrainError, match="have no limits"):
        evidence_question(bare, wheels=1)


def test_evidence_is_no_train_and_a_train_no_evidence() -> None:
    with pytest.raises(GearTrainError, match="is evidence, not a train"):
        load(SOUND)
    with pytest.raises(GearTrainError, match="is evidence, not a train"):
        GearTrain.declare(read_evidence(SOUND).model_dump(mode="json", exclude_unset=True, by_alias=True))
    with pytest.raises(GearTrainError, match="is not evidence"):
        read_evidence(shipped()["planetary-24-18-60"])


def test_evidence_has_its_own_catalogue() -> None:
    for name in ("back-train", "metonic-l-m"):
        assert read_evidence(name).name == name
        assert name not in shipped()


@pytest.mark.parametrize(
    ("name", "fix"),
    [
        ("back-trian", ["did you mean 'back-train'"]),
        ("zzz", ["give a file, or one of:", "back-train", "metonic-l-m"]),
        ("freeth-2008", ["it is a shipped train", "--lost ARBOR", "back-train"]),
    ],
)
def test_evidence_that_is_not_shipped(name: str, fix: list[str]) -> None:
    with pytest.raises(GearTrainError) as caught:
        read_evidence(name)
    assert all(part in caught.value.problems[0].fix for part in fix)


def test_shipped_evidence_is_no_shipped_train() -> None:
    with pytest.raises(GearTrainError, match="it is evidence: `geartrain reconstruct back-train`"):
        load("back-train")


def test_shipped_evidence_is_extended_by_its_name(tmp_path: Path) -> None:
    path = tmp_path / "seen.yaml"
    path.write_text("extends: back-train\ngears: [{pair: [e4, f1]}]\n", encoding="utf-8")
    for source in (
        path,
        path.read_text(encoding="utf-8"),
        {"extends": "back-train", "gears": [{"pair": ["e4", "f1"]}]},
    ):
        problem = evidence_question(read_evidence(source)).problem
        plain = evidence_question(read_evidence("back-train")).problem
        assert problem == replace(plain, meshes=frozenset({frozenset({"e4", "f1"})}))
    path.write_text("extends: back-trian\n", encoding="utf-8")
    with pytest.raises(
        GearTrainError,
        match=r"seen\.yaml:1: `extends` names the unknown parent 'back-trian'\n.*\n.*did you mean 'back-train'",
    ):
        read_evidence(path)


BACK_TRAIN = """\
name: back-train
sources: {W: Wright, F06: Freeth et al. 2006}
unit: {per: year_tropical_J2000}
frame: frame
links:
  b: {wheels: {b2: {teeth: {value: 64, range: [64, 66]}, status: surviving, module: 0.484 mm}}}
  m: {wheels: {m1: {teeth: {value: 96, range: [95, 99]}, source: W}, m2: 15}}
  E: {wheels: {e3: {teeth: 223}, e4: 188}}
  f: {wheels: {f1: 53, f2: 30}}
  g: {wheels: {g1: 54}}
  h:
inputs: {b: 1}
axes: {M: {position: [0 mm, 61 mm, 0 mm]}}
revolutes: [{pair: [frame, m], axis: M}]
gears: [{pair: [e4, f1], source: F06}]
outputs:
  metonic: {expect: -5/19}
  saros:   {of: g, targets: [{speed: -940/4237, tolerance: 1/446}]}
reconstruct:
  add: {wheels: 3, arbors: 2, teeth: [12, 225], on: any}
  use: wheels
  sense: given
  idlers: false
  apart: [[m1, g1]]
  cost: {wheel: 10, arbor: 10, unused: 100}
"""


def test_a_whole_file_of_evidence() -> None:
    found = ask(BACK_TRAIN)
    problem = found.problem
    assert [arbor.name for arbor in problem.arbors] == ["m", "E", "f", "g", "h"]
    assert problem.arbors[-1].wheels == ()
    metonic, saros = problem.dials
    assert metonic.is_exact
    assert metonic.place is None
    assert saros.place == "g"
    half = Fraction(940, 4237) / 446
    assert (saros.minimum, saros.maximum) == (Fraction(-940, 4237) - half, Fraction(-940, 4237) + half)
    assert problem.meshes == {frozenset(("e4", "f1"))}
    assert problem.additions.arbors == 2
    assert len(found.unused) == 2


def test_what_is_given_joins_arbors() -> None:
    found = ask(BACK_TRAIN + "  given: [{pair: [f, g], kind: pin_and_slot}]\n")
    assert found.joined == {"f": ("f", "g")}
    assert [[wheel.name for wheel in arbor.wheels] for arbor in found.problem.arbors if arbor.name in "fg"] == [
        ["f1", "f2", "g1"]
    ]
    assert found.problem.dials[1].place == "f"
