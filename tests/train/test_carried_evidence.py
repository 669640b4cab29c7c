"""Evidence of arbors on a carrier: how it is read, and what is refused by name."""

from __future__ import annotations

from fractions import Fraction

import pytest

from geartrain import GearTrainError
from geartrain.search.reconstruct import EvidenceQuestion, evidence_question, read_evidence

SOUND = """\
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


def ask(text: str) -> EvidenceQuestion:
    return evidence_question(read_evidence(text))


def test_all_is_seen_from_the_carrier() -> None:
    requested = ask(SOUND)
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
    dial = ask(changed("1/2", "{value: 1/2, tolerance: 1/4}")).problem.dials[1]
    assert (dial.minimum, dial.maximum, dial.signed) == (Fraction(1, 4), Fraction(3, 4), True)
    dial = ask(changed("expect: -5/93", "expect: {value: -1/2, tolerance: 1/4}")).problem.dials[0]
    assert (dial.minimum, dial.maximum) == (Fraction(-15, 4), Fraction(-13, 4))
    text = changed("n: {wheels: {n1: 48}}\n", "\n").replace(", {pair: [frame, n], axis: B}", "")
    text = text.replace("  nodes: {of: n, expect: -5/93}\n", "").replace("  carrier", "  sense: free\n  carrier")
    assert not ask(text).problem.dials[0].signed


def test_a_link_that_is_driven_besides_the_carrier() -> None:
    text = changed("frame: {wheels: {x: 51}}", "sun: {wheels: {x: 51}}").replace("{b: 3}", "{b: 3, sun: -1/2}")
    requested = ask(text)
    assert (requested.base.source, requested.problem.input.name, requested.problem.input_speed) == (
        "sun",
        "sun",
        Fraction(-7, 2),
    )
    assert requested.problem.coaxial == {frozenset(("sun", "n"))}


MISTAKES = {
    "no such link": (changed("carrier: b", "carrier: bb"), 12, "no link 'bb'"),
    "the frame": (changed("carrier: b", "carrier: frame"), 12, "the frame is not a carrier"),
    "a carrier of unknown speed": (changed("{b: 3}", "{p: 3}"), 12, "the speed of the carrier 'b' is not given"),
    "a carrier that stands still": (changed("{b: 3}", "{b: 0}"), 6, "the speed of the carrier 'b' is 0"),
    "two links besides": (changed("{b: 3}", "{b: 3, p: 1, n: 2}"), 6, "2 links are driven besides the carrier"),
    "a link and wheels of the frame": (changed("{b: 3}", "{b: 3, p: 1}"), 6, "'p' is driven, and the frame has wheels"),
    "a link as fast": (
        changed("frame: {wheels: {x: 51}}", "frame: {}").replace("{b: 3}", "{b: 3, p: 3}"),
        6,
        "'p' has the same speed as the carrier",
    ),
    "a link that stands still": (
        changed("frame: {wheels: {x: 51}}", "frame: {}").replace("{b: 3}", "{b: 3, p: 0}"),
        6,
        "the speed of the input 'p' is 0",
    ),
    "a wheel of the carrier": (changed("b: {}", "b: {wheels: {b1: 225}}"), 3, "'b1' is a wheel of the carrier"),
    "an arbor beside": (
        changed("{pair: [frame, n], axis: B}", "{pair: [frame, n], axis: N}"),
        7,
        "'n' turns in the frame",
    ),
    "a second carrier": (changed("{pair: [b, p], axis: P}", "{pair: [n, p], axis: P}"), 7, "second moving link"),
    "a pointer on the carrier": (changed("of: new", "of: b"), 10, "'epicycle' is on the carrier"),
    "seen from elsewhere": (changed("relative_to: b", "relative_to: n"), 10, "the frame or the carrier 'b'"),
    "a sense from the frame": (
        changed("  carrier", "  sense: free\n  carrier"),
        9,
        "the sense of 'nodes' is not known, and its speed is relative to the frame",
    ),
    "as the frame": (changed("of: n, expect: -5/93", "expect: 0"), 9, "'nodes' may be the speed of the frame"),
    "geometry": (changed("  carrier", "  geometry: {}\n  carrier"), 12, "`geometry` is not supported"),
    "given": (
        changed("  carrier", "  given: [{pair: [p, n]}]\n  carrier"),
        12,
        "'n' turns in the frame, but its coupling",
    ),
    "given of the frame": (changed("  carrier", "  given: [{pair: [p, frame]}]\n  carrier"), 12, "lock an arbor"),
    "no carrier": (changed("  carrier: b\n", ""), 2, "the frame has wheels, but no carrier is named"),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_what_cannot_be_requested_is_refused_with_its_line(mistake: str, tmp_path) -> None:
    text, line, words = MISTAKES[mistake]
    path = tmp_path / "evidence.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(GearTrainError) as caught:
        evidence_question(read_evidence(path))
    said = str(caught.value)
    assert words in said
    assert f"evidence.yaml:{line}" in said, said
    assert "fix:" in said
